"""Whether an FMU is what was built: hashes of its members, a detached signature, a rebuild that gives the same bytes.

Signatures are those of OpenSSH (``ssh-keygen -Y``), beside the FMU as ``NAME.fmu.sig``:
keys and tools are at hand wherever people log in to machines, and it is the one format
that GitHub, Git and every Linux, macOS and Windows read without more.
"""

import json
import re
import shutil
import subprocess
import tempfile
import zipfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fmu_src import references
from fmu_src.faults import InputFault, RunFault
from fmu_src.manifest import FORMAT, MANIFEST, hashes, made_with
from fmu_src.package import build_fmu, build_native, build_source
from fmu_src.source_hash import KERNEL_PACKAGES, ROOT, STAMP, USER_EFFECTS, source_hash, user_effect_files

# Of OpenSSH's signatures: any file.
NAMESPACE = "file"
SUFFIX = ".sig"
REFERENCE_PAGES = ("documentation/index.html", "documentation/effects.html", "documentation/fmi-ls-ref.html")
Completion = Callable[[Path, dict[str, Any]], bool]


@dataclass
class Findings:
    """``problems`` are differences, each as (kind, text); ``held`` is what was looked at and holds; ``notes`` all else."""

    held: list[str] = field(default_factory=list)
    problems: list[tuple[str, str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def as_json(self, path: Path) -> dict[str, object]:
        problems = [{"kind": kind, "text": text} for kind, text in self.problems]
        return {"fmu": str(path), "verified": not self.problems, "held": self.held, "problems": problems, "notes": self.notes}


def members(path: Path) -> tuple[dict[str, bytes], list[str]]:
    """(contents by name, names that occur twice) of an FMU."""
    if not path.is_file():
        raise InputFault(f"no FMU at {path}; this project's own are built with: rvwear build")
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            damaged = archive.testzip()
            if damaged is not None:
                raise RunFault(f"{path} is damaged: {damaged} does not fit its checksum in the archive; get the file anew")
            return {name: archive.read(name) for name in names}, sorted(name for name, count in Counter(names).items() if count > 1)
    except zipfile.BadZipFile as problem:
        raise InputFault(f"{path} is not an FMU, which is a zip archive: {problem}") from None


def check_hashes(path: Path, findings: Findings) -> dict[str, bytes]:
    """Every member against the manifest; the members."""
    files, doubled = members(path)
    for name in doubled:
        findings.problems.append(("doubled", f"{name} is in the archive more than once: importers may read either"))
    try:
        manifest = json.loads(files[MANIFEST])
        listed: dict[str, str] = manifest["sha256"]
        if manifest["format"] != FORMAT:
            findings.problems.append(("manifest", f"{MANIFEST} is of format {manifest['format']}, known is {FORMAT}: verify with the version that built it"))
            return files
    except KeyError:
        findings.problems.append(("manifest", f"it carries no hashes ({MANIFEST}): it was built by another tool or an older version; build it anew"))
        return files
    except (ValueError, TypeError):
        findings.problems.append(("manifest", f"{MANIFEST} cannot be read as JSON: it was changed"))
        return files
    present = hashes(files)
    for name in sorted(listed.keys() - present.keys()):
        findings.problems.append(("missing", f"{name} is missing: the manifest lists it"))
    for name in sorted(present.keys() - listed.keys()):
        findings.problems.append(("added", f"{name} was added: the manifest does not list it"))
    for name in sorted(present.keys() & listed.keys()):
        if present[name] != listed[name]:
            findings.problems.append(("changed", f"{name} was changed: its SHA-256 is {present[name][:16]}..., the manifest says {listed[name][:16]}..."))
    if not findings.problems:
        findings.held.append(f"hashes of {len(present)} members are those of the manifest")
    return files


def ssh_keygen(*arguments: str | Path, given: bytes | None = None) -> subprocess.CompletedProcess[bytes]:
    program = shutil.which("ssh-keygen")
    if program is None:
        raise InputFault("signatures need ssh-keygen of OpenSSH, which is not in the search path; install OpenSSH")
    return subprocess.run([program, *arguments], input=given, capture_output=True)


def sign(path: Path, key: Path) -> Path:
    """Write the signature of a file beside it, by a private SSH key (or a public one whose private one an agent holds)."""
    if not path.is_file():
        raise InputFault(f"no file at {path} to sign")
    if not key.is_file():
        raise InputFault(f"no key at {key}; ssh-keygen -t ed25519 -f {key} makes one")
    made = path.with_name(path.name + SUFFIX)
    made.unlink(missing_ok=True)
    done = ssh_keygen("-Y", "sign", "-f", key, "-n", NAMESPACE, path)
    if done.returncode != 0 or not made.is_file():
        raise InputFault(f"{path} could not be signed with {key}: {done.stderr.decode(errors='replace').strip()}")
    return made


def check_signature(path: Path, findings: Findings, signature: Path | None = None, signers: Path | None = None) -> None:
    """The signature beside the FMU, or the one given; ``signers`` (OpenSSH's allowed_signers) says whose keys count."""
    beside = signature or path.with_name(path.name + SUFFIX)
    if signers is not None and not signers.is_file():
        raise InputFault(f"no file of signers at {signers}; it has lines like: someone@example.com ssh-ed25519 AAAA...")
    if not beside.is_file():
        if signature is not None or signers is not None:
            findings.problems.append(("unsigned", f"there is no signature at {beside}; the maker writes one with: rvwear fmu sign {path.name} --key KEY"))
        else:
            findings.notes.append(f"not signed: there is no {beside.name}")
        return
    content = path.read_bytes()
    intact = ssh_keygen("-Y", "check-novalidate", "-n", NAMESPACE, "-s", beside, given=content)
    if intact.returncode != 0:
        said = intact.stderr.decode(errors="replace").strip() or intact.stdout.decode(errors="replace").strip()
        text = f"{beside.name} does not fit the file: the FMU was changed after it was signed, or it is of another file ({said})"
        findings.problems.append(("signature", text))
        return
    key = re.search(r"with (\S+) key (\S+)", intact.stdout.decode(errors="replace"))
    named = " ".join(key.groups()) if key else "a key"
    if signers is None:
        findings.notes.append(f"signed by {named}; whose that is only a file of signers says: --signers FILE")
        return
    found = ssh_keygen("-Y", "find-principals", "-s", beside, "-f", signers)
    names = found.stdout.decode(errors="replace").split()
    if found.returncode != 0 or not names:
        findings.problems.append(("signer", f"signed by {named}, which {signers} does not list"))
        return
    done = ssh_keygen("-Y", "verify", "-f", signers, "-I", names[0], "-n", NAMESPACE, "-s", beside, given=content)
    if done.returncode != 0:
        said = done.stdout.decode(errors="replace").strip() or done.stderr.decode(errors="replace").strip()
        findings.problems.append(("signer", f"the signature of {names[0]} does not count: {said}"))
        return
    findings.held.append(f"signed by {names[0]}, {named}")


def check_rebuild(path: Path, files: dict[str, bytes], findings: Findings, complete: Completion | None = None) -> None:
    """Build it anew from its stamp and the sources that are installed, and compare bytes."""
    stamp = json.loads(files.get(f"resources/{STAMP}", b"null"))
    if stamp is None:
        findings.problems.append(("stamp", f"it cannot be built anew: resources/{STAMP} is missing, so it is none of this project's"))
        return
    if stamp["source_hash"] != source_hash():
        maker = stamp.get("made_by", {}).get("version", "unknown")
        findings.problems.append((
            "sources", f"it cannot be built anew here: it was made from sources {stamp['source_hash'][:16]} (version {maker}),"
            f" installed are {source_hash()[:16]}; verify with {needed(files, maker)}, or leave the rebuild out: --no-rebuild",
        ))  # fmt: skip
        return
    with tempfile.TemporaryDirectory() as temporary:
        again = rebuilt(path.stem, stamp, files, Path(temporary))
        is_whole = references.MANIFEST not in files or (complete is not None and complete(again, stamp))
        if again.read_bytes() == path.read_bytes():
            findings.held.append("a rebuild gives the same bytes")
            return
        anew, _ = members(again)
    before = len(findings.problems)
    for name in sorted(files.keys() | anew.keys()):
        if name != MANIFEST and files.get(name) != anew.get(name) and (is_whole or not is_reference(name)):
            findings.problems.append(("rebuild", difference(name, files.get(name), anew.get(name))))
    if len(findings.problems) == before and not is_whole:
        named = stamp["specification"]["reducer"]
        findings.held.append(f"a rebuild gives the same members, experiments and their results apart: the reducer {named} is another here, or unknown")
    elif len(findings.problems) == before:
        findings.notes.append("a rebuild gives the same members; the archive around them was packed otherwise")
    elif differing := tools_that_differ(files):
        findings.notes.append(f"tools differ: {differing}; bytes are those of a build with the same ones")


def needed(files: dict[str, bytes], maker: str) -> str:
    """What a rebuild lacks here: effects of somebody's own that the unit has, or else the version that built it."""
    have = {file.stem for package in KERNEL_PACKAGES for file in (ROOT / package / "effects").glob("*.py")}
    have |= {file.stem for package in KERNEL_PACKAGES for _, file in user_effect_files(package)}
    carried = {name.decode() for name in re.findall(rb'name="effects\.(\w+)\.', files.get("modelDescription.xml", b""))}
    own = sorted(carried - have)
    if not own:
        return f"those (version {maker}, {USER_EFFECTS} if there were own effects)"
    return f"{USER_EFFECTS}=DIR, the folder of its own effect{'s' if len(own) > 1 else ''} {', '.join(own)}"


def is_reference(name: str) -> bool:
    """Whether a member is made with the reducer file, which an FMU does not carry."""
    return name.startswith(f"{references.FOLDER}/") or name in REFERENCE_PAGES


def rebuilt(name: str, stamp: dict[str, Any], files: dict[str, bytes], folder: Path) -> Path:
    """The FMU that the stamp describes."""
    found = re.search(rb'fmiVersion="(\d)', files.get("modelDescription.xml", b""))
    version = found.group(1).decode() if found else "2"
    identifier = re.search(rb'modelIdentifier="(\w+)"', files.get("modelDescription.xml", b""))
    name = identifier.group(1).decode() if identifier else name
    facts = (name, stamp["specification"], stamp["step_size"], stamp["tool"], folder)
    if stamp["flavour"] == "python":
        return build_fmu(*facts)
    if stamp["flavour"] == "source":
        return build_source(*facts, (version,))[0]
    folders = {member.split("/")[1] for member in files if member.startswith("binaries/")}
    wasm = any(member.endswith(".wasm") for member in files)
    return build_native(*facts, (version,), all_platforms=len(folders) > 1 + wasm, wasm=wasm)[0]


def difference(name: str, there: bytes | None, anew: bytes | None) -> str:
    """What a rebuild says of one member."""
    if there is None:
        return f"{name} is missing: a rebuild has it"
    if anew is None:
        return f"{name} is not what a rebuild has: it was added, or compiled from the sources later"
    if name.endswith((".xml", ".json", ".c", ".h", ".py", ".html", ".txt", ".toml")):
        lines = zip(there.decode(errors="replace").splitlines(), anew.decode(errors="replace").splitlines())
        for number, (a, b) in enumerate(lines, 1):
            if a != b:
                return f"{name} differs from a rebuild first in line {number}: {shortened(a)} instead of {shortened(b)}"
    return f"{name} differs from a rebuild: {len(there)} bytes, {len(anew)} anew"


def shortened(line: str) -> str:
    line = line.strip()
    return line if len(line) <= 60 else line[:60] + "..."


def tools_that_differ(files: dict[str, bytes]) -> str:
    """Tools of the build against those here."""
    try:
        then: dict[str, str] = json.loads(files[MANIFEST])["made_with"]
    except (KeyError, ValueError):
        return ""
    return ", ".join(f"{name} {then.get(name)} then, {now} here" for name, now in made_with().items() if then.get(name) != now)


def verify(
    path: Path, signature: Path | None = None, signers: Path | None = None, rebuild: bool = True, complete: Completion | None = None
) -> Findings:
    """All three; ``complete(fmu, stamp)`` adds to a rebuilt FMU what is made with its reducer, or says that it cannot."""
    findings = Findings()
    files = check_hashes(path, findings)
    check_signature(path, findings, signature, signers)
    if rebuild:
        check_rebuild(path, files, findings, complete)
    return findings

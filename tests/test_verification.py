"""rvwear fmu verify: each kind of difference is named; what was built holds."""

import json
import shutil
import subprocess
import zipfile

import pytest

from cli.commands.fmu import verdict
from cli.main import main
from fmu_src.manifest import MANIFEST
from fmu_src.package import build_source, write_archive
from fmu_src.verification import Findings, needed, verify
from studies.reference_material import add_references

ssh = pytest.mark.skipif(shutil.which("ssh-keygen") is None, reason="no ssh-keygen")


@pytest.fixture(scope="module")
def built(rv20e, tmp_path_factory):
    (path,) = build_source("RvWear", rv20e.specification("wear_fmu"), 1e-3, "rvwear test", tmp_path_factory.mktemp("built"), ("3",))
    return path


@pytest.fixture
def fmu(built, tmp_path):
    return shutil.copy(built, tmp_path / "RvWear.fmu")


def changed(fmu, **contents):
    """Members replaced (None: left out) without a new manifest."""
    with zipfile.ZipFile(fmu) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    files |= contents["files"]
    with zipfile.ZipFile(fmu, "w") as archive:
        for name, content in files.items():
            if content is not None:
                archive.writestr(name, content)


def verified(capsys, *arguments):
    code = main(["fmu", "verify", *map(str, arguments), "--json"])
    said = json.loads(capsys.readouterr().out)
    return code, said, {problem["kind"]: problem["text"] for problem in said["problems"]}


def test_source_fmu_holds_and_is_built_anew_to_the_byte(fmu, capsys):
    code, said, _ = verified(capsys, fmu)
    assert code == 0 and said["verified"]
    assert any("members are those of the manifest" in text for text in said["held"]) and "a rebuild gives the same bytes" in said["held"]
    assert said["notes"] == ["not signed: there is no RvWear.fmu.sig"]


@pytest.mark.parametrize("flavour", ["fmi2", "fmi3", "python"])
def test_other_flavours_are_built_anew_to_the_byte(flavour, fmus, native_fmus, capsys):
    path = fmus / "RvPlant.fmu" if flavour == "python" else native_fmus / flavour / "RvPlant.fmu"
    code, said, _ = verified(capsys, path)
    assert code == 0 and "a rebuild gives the same bytes" in said["held"], said


def test_experiments_that_it_carries_are_made_anew_too(rv20e, native_fmus, tmp_path, capsys):
    path = tmp_path / "RvPlant.fmu"
    shutil.copy(native_fmus / "fmi3" / "RvPlant.fmu", path)
    add_references([path], rv20e, "rv_plant", 1e-3)
    code, said, _ = verified(capsys, path)
    assert code == 0 and "a rebuild gives the same bytes" in said["held"], said
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    spoilt = next(name for name in files if name.endswith("smoke-test-results.csv"))
    write_archive(files | {spoilt: files[spoilt] + b"1\n"}, path)
    assert spoilt in verified(capsys, path)[2]["rebuild"]
    # Without the reducer file the rest is compared.
    findings = verify(path)
    assert not findings.problems and any("experiments and their results apart" in text for text in findings.held)


@pytest.mark.parametrize("files, kind, words", [
    ({"modelDescription.xml": b"<x/>"}, "changed", "modelDescription.xml was changed: its SHA-256 is"),
    ({"sources/all.c": None}, "missing", "sources/all.c is missing: the manifest lists it"),
    ({"binaries/x86_64-linux/RvWear.so": b"ELF"}, "added", "RvWear.so was added: the manifest does not list it"),
    ({MANIFEST: None}, "manifest", "it carries no hashes (extra/rvwear/manifest.json)"),
    ({MANIFEST: b"{"}, "manifest", "cannot be read as JSON"),
    ({MANIFEST: b'{"format": 9, "sha256": {}}'}, "manifest", "is of format 9, known is 1"),
])  # fmt: skip
def test_difference_of_a_member_is_named(fmu, capsys, files, kind, words):
    changed(fmu, files=files)
    code, said, problems = verified(capsys, fmu, "--no-rebuild")
    assert code == 1 and not said["verified"] and words in problems[kind]


def test_member_twice_is_named(fmu, capsys):
    with zipfile.ZipFile(fmu, "a") as archive, pytest.warns(UserWarning, match="Duplicate name"):
        archive.writestr("sources/all.c", "other")
    assert "sources/all.c is in the archive more than once" in verified(capsys, fmu, "--no-rebuild")[2]["doubled"]


def test_forged_manifest_is_found_by_the_rebuild(fmu, capsys):
    with zipfile.ZipFile(fmu) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    spoilt = files["sources/unit_kernels.c"].replace(b"2.0 *", b"2.5 *", 1)
    write_archive(files | {"sources/unit_kernels.c": spoilt, "sources/more.c": b""}, fmu)
    code, _, problems = verified(capsys, fmu, "--no-rebuild")
    assert code == 0
    code, said, _ = verified(capsys, fmu)
    texts = [problem["text"] for problem in said["problems"]]
    assert code == 1 and any(text.startswith("sources/unit_kernels.c differs from a rebuild first in line") and "2.5 *" in text for text in texts)
    assert any("sources/more.c is not what a rebuild has" in text for text in texts)


def test_tools_that_differ_are_named(fmu, capsys, monkeypatch):
    monkeypatch.setattr("fmu_src.manifest.made_with", lambda: {"llvmlite": "0.1"})
    with zipfile.ZipFile(fmu) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    write_archive(files | {"sources/unit_table.c": b"\n"}, fmu)
    assert any("llvmlite 0.1 then" in note for note in verified(capsys, fmu)[1]["notes"])


def test_of_other_sources_is_not_built_anew(fmu, capsys):
    with zipfile.ZipFile(fmu) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    stamp = json.loads(files["resources/unit.json"]) | {"source_hash": "f" * 64}
    write_archive(files | {"resources/unit.json": json.dumps(stamp).encode()}, fmu)
    code, _, problems = verified(capsys, fmu)
    assert code == 1 and "made from sources ffffffffffffffff" in problems["sources"] and "--no-rebuild" in problems["sources"]
    assert "RVWEAR_EFFECTS if there were own effects" in problems["sources"]
    # The last line frightens nobody, and of one's own effects says which.
    description = files["modelDescription.xml"].replace(b'name="effects.edge_loading.', b'name="effects.my_own.')
    assert description != files["modelDescription.xml"] and needed({"modelDescription.xml": description}, "0").endswith("effect my_own")
    assert main(["fmu", "verify", str(fmu)]) == 1
    said = capsys.readouterr().out
    assert said.splitlines()[-1].endswith("could not be built anew here; verify again as said above") and "not looked at (sources)" in said
    assert verdict(Findings(problems=[("sources", "text"), ("changed", "text")])) == "NOT VERIFIED"


def test_strangers_fmu_and_no_fmu(tmp_path, spring, capsys):
    assert "none of this project's" in verified(capsys, spring)[2]["stamp"]
    (tmp_path / "text.fmu").write_text("no archive", encoding="utf-8")
    assert main(["fmu", "verify", str(tmp_path / "text.fmu")]) == 2
    assert "is not an FMU, which is a zip archive" in capsys.readouterr().err
    assert main(["fmu", "verify", str(tmp_path / "none.fmu")]) == 2
    assert "no FMU at" in capsys.readouterr().err


@pytest.fixture
def key(tmp_path):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", tmp_path / "key"], check=True)
    (tmp_path / "signers").write_text(f"maker@example.com {(tmp_path / 'key.pub').read_text(encoding='utf-8')}", encoding="utf-8")
    return tmp_path / "key"


@ssh
def test_signature_holds_and_says_whose_it_is(fmu, key, capsys):
    for _ in range(2):  # a second signature replaces the first
        assert main(["fmu", "sign", str(fmu), "--key", str(key)]) == 0
    assert capsys.readouterr().out.strip().endswith("RvWear.fmu.sig")
    code, said, _ = verified(capsys, fmu, "--signers", key.parent / "signers", "--no-rebuild")
    assert code == 0 and any(text.startswith("signed by maker@example.com, ED25519 SHA256:") for text in said["held"])
    code, said, _ = verified(capsys, fmu, "--no-rebuild")
    assert code == 0 and any("whose that is only a file of signers says" in note for note in said["notes"])


@ssh
def test_signature_that_does_not_hold_is_said(fmu, key, tmp_path, capsys):
    code, _, problems = verified(capsys, fmu, "--signers", tmp_path / "signers", "--no-rebuild")
    assert code == 1 and "there is no signature at" in problems["unsigned"]
    main(["fmu", "sign", str(fmu), "--key", str(key)])
    capsys.readouterr()
    (tmp_path / "others").write_text("other@example.com ssh-ed25519 " + "A" * 68 + "\n", encoding="utf-8")
    assert "does not list" in verified(capsys, fmu, "--signers", tmp_path / "others", "--no-rebuild")[2]["signer"]
    with zipfile.ZipFile(fmu, "a") as archive:
        archive.writestr("more.txt", "added later")
    assert "was changed after it was signed" in verified(capsys, fmu, "--no-rebuild")[2]["signature"]
    assert main(["fmu", "sign", str(fmu), "--key", str(tmp_path / "none")]) == 2
    assert "ssh-keygen -t ed25519" in capsys.readouterr().err


def test_compile_and_verdict_on_the_screen(fmu, tmp_path, capsys):
    assert main(["fmu", "verify", str(fmu), "--no-rebuild"]) == 0
    assert capsys.readouterr().out.endswith("RvWear.fmu: verified\n")
    if shutil.which("gcc"):
        assert main(["fmu", "compile", str(fmu), "--output", str(tmp_path / "made" / "RvWear.fmu")]) == 0
        capsys.readouterr()
        code, _, problems = verified(capsys, tmp_path / "made" / "RvWear.fmu", "--no-rebuild")
        assert code == 0 and not problems

"""``rvwear fmu``: verify, sign and compile FMUs that were built."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from cli.options import add_json
from cli.written import say_file

if TYPE_CHECKING:
    from fmu_src.verification import Findings


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    fmu = sub.add_parser("fmu", help="FMUs that were built: verify, sign, compile one of sources")
    actions = fmu.add_subparsers(dest="action", required=True, metavar="ACTION")

    verify = actions.add_parser("verify", help="hashes of all members, the signature, and a rebuild that must give the same bytes")
    verify.add_argument("file", help="an FMU of this project")
    verify.add_argument("--signature", metavar="FILE", help="its signature (default FILE.fmu.sig beside it, if there is one)")
    verify.add_argument("--signers", metavar="FILE", help="whose signatures count: OpenSSH's allowed_signers; one of them is then needed")
    verify.add_argument("--no-rebuild", action="store_true", help="do not build it anew")
    add_json(verify, "print findings as JSON, nothing else")
    verify.set_defaults(run=run_verify)

    sign = actions.add_parser("sign", help="write FILE.fmu.sig beside an FMU, with an SSH key")
    sign.add_argument("file", help="an FMU")
    sign.add_argument("--key", required=True, help="private key, for instance ~/.ssh/id_ed25519")
    sign.set_defaults(run=run_sign)

    compiled = actions.add_parser("compile", help="an FMU of sources with this machine's binary besides")
    compiled.add_argument("file", help="an FMU with sources: rvwear build --flavour source")
    compiled.add_argument("--output", metavar="FILE", required=True, help="the FMU to write")
    compiled.set_defaults(run=run_compile)


def run_verify(options: argparse.Namespace) -> int:
    """Exit code 0 if all holds that was looked at, 1 if anything differs, 2 if there is no FMU."""
    from cli.screen import json_text
    from fmu_src.progress import task
    from fmu_src.verification import verify
    from studies.rebuilding import complete

    signature, signers = (Path(name) if name else None for name in (options.signature, options.signers))
    with task("verifying"):
        findings = verify(Path(options.file), signature, signers, not options.no_rebuild, complete)
    if options.json:
        json_text(findings.as_json(Path(options.file)))
        return 1 if findings.problems else 0
    for text in findings.held:
        print(f"holds: {text}")
    for text in findings.notes:
        print(f"note: {text}")
    for kind, text in findings.problems:
        print(f"{'not looked at' if kind == 'sources' else 'differs'} ({kind}): {text}")
    print(f"{options.file}: {verdict(findings)}")
    return 1 if findings.problems else 0


def verdict(findings: "Findings") -> str:
    """The last line: what differs, what could not be looked at, or that all holds."""
    if not findings.problems:
        return "verified"
    if {kind for kind, _ in findings.problems} == {"sources"}:
        return "nothing was found changed, but it could not be built anew here; verify again as said above"
    return "NOT VERIFIED"


def run_sign(options: argparse.Namespace) -> int:
    from fmu_src.verification import sign

    say_file(sign(Path(options.file), Path(options.key)))
    return 0


def run_compile(options: argparse.Namespace) -> int:
    from fmu_src.package import compile_sources

    say_file(compile_sources(Path(options.file), Path(options.output)))
    return 0

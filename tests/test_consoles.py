"""Consoles that know few signs: every command that prints tables ends as it would elsewhere."""

import io
import shutil
import sys
from pathlib import Path

import pytest

from cli.main import main

# No encoding but UTF-8 has all of them.
NAME = "Prüfstand μ − → 試"
# Of Windows' consoles, and of systems without a language.
ENCODINGS = ("ascii", "cp1252")
EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Files with names and signs of all kinds: a campaign, a model and its ladder, an ensemble, a reducer."""
    folder = tmp_path_factory.mktemp("consoles") / NAME.replace(" ", "_")
    shutil.copytree(EXAMPLES / "raceway_depths", folder / NAME[:9])
    step = 'effects = ["needle_clearance"]\ncampaign = "{0}"\nverdict = "{0}"\ntraining_before = 2.0\ntraining_after = 1.0\n'
    (folder / "model.toml").write_text(
        f'[model]\nname = "{NAME}"\nreducer = "RV20E-121"\n\n[[steps]]\n{step.format(NAME)}', encoding="utf-8"
    )
    (folder / "ensemble.toml").write_text(
        'reducer = "RV20E-121"\nsamples = 2\nhours = 100\n[parameters]\n'
        'bearing_clearance = { distribution = "uniform", low = 2, high = 3, unit = "um" }\n', encoding="utf-8"
    )  # fmt: skip
    return folder


@pytest.fixture
def printed(monkeypatch):
    """What ``main`` prints on a console of an encoding: (exit code, stdout, stderr)."""
    def run(encoding, *arguments):
        streams = [io.TextIOWrapper(io.BytesIO(), encoding=encoding) for _ in range(2)]
        with monkeypatch.context() as context:
            context.setattr(sys, "stdout", streams[0])
            context.setattr(sys, "stderr", streams[1])
            code = main(list(arguments))
        for stream in streams:
            stream.flush()
        return code, *(stream.buffer.getvalue().decode(encoding) for stream in streams)

    return run


SHORT = ("solve --positions 8", "effects", "ladder model.toml")
LONGER = (
    "compare model.toml Prüfstand",
    "hysteresis", "modes", "effects needle_clearance", "example", "campaign check Prüfstand", "campaign template 試",
    "run --positions 8 --output μ.nc", "life --hours 60 --positions 8 --output μ_life.nc", "report μ_life.nc",
    "reproduce N14 --output μ_claims.html",
    *(pytest.param(command, marks=pytest.mark.campaign) for command in (
        "dynamics-wear --hours 1 --cycles 1 --speeds 1 --output μ.html", "ensemble ensemble.toml --jobs 1 --output μ.json",
        "build --flavour python --output μ",
    )),
)  # fmt: skip


def ends_as_elsewhere(printed, folder, monkeypatch, encoding, command):
    monkeypatch.chdir(folder)
    code, out, err = printed(encoding, *command.split(" "))
    assert code == 0, err
    assert len(out) > 1


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("command", SHORT)
def test_short_commands_end_as_elsewhere(printed, folder, monkeypatch, encoding, command):
    ends_as_elsewhere(printed, folder, monkeypatch, encoding, command)


@pytest.mark.parametrize("command", LONGER)
def test_longer_commands_end_as_elsewhere(printed, folder, monkeypatch, command):
    ends_as_elsewhere(printed, folder, monkeypatch, "ascii", command)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_an_error_names_a_file_as_far_as_the_console_can(printed, folder, monkeypatch, encoding):
    monkeypatch.chdir(folder)
    code, _, err = printed(encoding, "life", "--duty", f"{NAME}.toml")
    assert code == 2 and "no duty file at Pr" in err


def test_help_is_printed(printed):
    with pytest.raises(SystemExit) as stop:
        printed("ascii", "--help")
    assert stop.value.code == 0

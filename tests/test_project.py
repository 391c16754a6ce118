"""One entry in pyproject.toml says version, authors and licence; everything else follows it."""

import json
from importlib import import_module
from importlib.metadata import PathDistribution
from pathlib import Path

import pytest

from benchmarks.changelog_figures import HOURS, KEPT, KEPT_DIGITS, all_figures, as_text, changes, read
from fmu_src.project import UNDECIDED, Project, of_checkout, of_installation, project

ROOT = Path(__file__).resolve().parents[1]


def citation() -> dict[str, str]:
    """Plain ``key: value`` lines of CITATION.cff."""
    lines = (ROOT / "CITATION.cff").read_text(encoding="utf-8").splitlines()
    return {key.strip(" -"): value.strip().strip('"') for key, _, value in (line.partition(":") for line in lines)}


def test_citation_agrees_with_the_project():
    cited = citation()
    assert (cited["version"], cited["name"]) == (project().version, project().author)
    # The format knows listed licences alone.
    assert cited.get("license", UNDECIDED) == project().licence


def test_set_up_passes_on_what_pip_warns_of_but_for_folders_that_lack_a_package(monkeypatch, capsys):
    """Forty lines of the machine's own indexes stood before each first run."""
    monkeypatch.syspath_prepend(ROOT)
    build = import_module("build")
    retrying = "WARNING: Retrying (Retry(total=4)) after connection broken\n"
    build.pass_on(["WARNING: Location 'file:///opt/more/lxml/' is ignored: it is neither a file nor a directory.\n", retrying, "ERROR: no version of it\n"])
    assert capsys.readouterr().err == retrying + "ERROR: no version of it\n"


def test_changelog_has_the_present_version():
    assert f"\n## {project().version}\n" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


def test_readme_names_the_licence():
    assert f"`{project().licence}`" in (ROOT / "README.md").read_text(encoding="utf-8")


def test_undecided_licence_says_so():
    assert "not decided" in Project("1", "we", UNDECIDED).terms()


def test_checkout_and_installed_wheel_say_the_same(tmp_path):
    (tmp_path / "pyproject.toml").write_text(
        '[project]\nname = "rvwear"\nversion = "1.2"\nlicense = "MIT"\nauthors = [{name = "A"}, {name = "B"}]\n'
    )
    (tmp_path / "LICENSE").write_text("Do as you like.\n")
    installed = tmp_path / "rvwear-1.2.dist-info"
    (installed / "licenses").mkdir(parents=True)
    (installed / "licenses" / "LICENSE").write_text("Do as you like.\n")
    (installed / "METADATA").write_text(
        "Metadata-Version: 2.4\nName: rvwear\nVersion: 1.2\nAuthor: A, B\nLicense-Expression: MIT\nLicense-File: LICENSE\n"
    )
    found = of_checkout(tmp_path / "pyproject.toml")
    assert found == of_installation(PathDistribution(installed)) == Project("1.2", "A, B", "MIT", ("Do as you like.\n",))
    assert "licence MIT" in found.terms() and "Do as you like." in found.terms()


def test_changes_are_lines_of_a_changelog():
    flank = "flank wear of BX-40E after 10,000 h"
    before = {flank: (6.412, "um"), "lag": (45.01, "arcsec"), "old": (1.0, "1")}
    now = {flank: (6.428, "um"), "lag": (45.02, "arcsec"), "stiffness": (1111.8, "N m/arcmin")}
    assert changes(before, now) == [f"{flank}: 6.41 -> 6.43 um", "stiffness: 1,110 N m/arcmin (new)", "old: no longer reckoned"]


def test_kept_figures_are_read_as_they_were_written():
    assert as_text(read(KEPT)) == KEPT.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["RV20E-121", "BX-40E"])
def test_kept_figures_are_those_of_the_golden_results(name):
    golden, kept = json.loads((ROOT / "tests" / "golden" / f"{name}.json").read_text())["turn"], read(KEPT)
    figures = {"peak pin force": "peak_pin_force_N", "lag": "mean_lag_arcsec", "transmission error": "transmission_error_pp_arcsec",
               "torsional stiffness": "torsional_stiffness_Nm_per_arcmin"}  # fmt: skip
    for what, key in figures.items():
        assert kept[f"{what} of {name}"][0] == float(f"{golden[key]:.{KEPT_DIGITS}g}")
    assert f"flank wear of {name} after {HOURS:,.0f} h" in kept


@pytest.mark.campaign
def test_kept_figures_are_the_present_ones():
    assert changes(read(KEPT), all_figures()) == []

"""The workbench's walls: who is let in, what is read and written, what the page fetches.  No browser."""

from pathlib import Path

import pytest
from workbench_server import CSV, asked

from fmu_src.faults import InputFault
from workbench.folder import opened
from workbench.intake import view

pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')


def test_nobody_is_let_in_without_the_token(served):
    _, address = served
    start = address.rsplit("/", 2)[0]
    assert asked(address)[0] == 200
    assert asked(start + "/")[0] == 404
    assert asked(start + "/state")[0] == 404
    assert asked(start + "/" + "x" * 32 + "/state")[0] == 404


def test_nobody_is_let_in_by_another_name_of_this_machine(served):
    """A page elsewhere may let its own name point here; it does not know what to call us."""
    _, address = served
    assert asked(address, "state", Host="evil.example:80")[0] == 403


def test_other_pages_change_nothing(served):
    folder, address = served
    for origin in ({}, {"Origin": "http://evil.example"}, {"Origin": "null"}):
        assert asked(address, "files/a.csv", "PUT", b"x", **origin)[0] == 403
    assert not (folder.root / "a.csv").exists()


def test_the_page_fetches_nothing_from_elsewhere(served):
    _, address = served
    status, body, headers = asked(address)
    assert "default-src 'self'" in headers["content-security-policy"]
    assert headers["referrer-policy"] == "no-referrer"
    root = Path(__file__).parents[1] / "workbench" / "static"
    texts = {path.name: path.read_text(encoding="utf-8") for path in root.iterdir()}
    elsewhere = [name for name, text in texts.items() if "https://" in text or ("http://" in text.replace("http://www.w3.org/2000/svg", ""))]
    assert status == 200 and not elsewhere
    # What the first view needs is small: it paints at once.
    first = ("index.html", "style.css", "app.js", "net.js", "dom.js", "in.js", "in_runs.js", "in_conditions.js", "plot.js", "paint.js", "hand.js", "behind.js",
             "scale.js")  # fmt: skip
    assert sum(len(texts[name]) for name in first) < 120_000


@pytest.mark.parametrize("name", ["../out.csv", "a/../../out.csv", "..", ".hidden.csv", "campaign.toml", "a\x00.csv", "con:.csv"])
def test_nothing_is_written_outside_of_the_folder(tmp_path, name):
    folder = opened(tmp_path / "in")
    with pytest.raises(InputFault):
        folder.new_file(name, b"x")
    assert [p.name for p in tmp_path.iterdir()] == ["in"] and not list((tmp_path / "in").iterdir())


def test_a_link_leads_nowhere_else(tmp_path):
    folder = opened(tmp_path / "in")
    (tmp_path / "secret.csv").write_text("1")
    (folder.root / "link.csv").symlink_to(tmp_path / "secret.csv")
    with pytest.raises(InputFault, match="outside"):
        folder.inside("link.csv")
    assert folder.measurements() == []


@pytest.mark.parametrize("name", ["/etc/passwd.toml", "../other.toml", "../../x", "/etc/hosts", "RV20E-122"])
def test_no_model_is_read_from_elsewhere(tmp_path, name):
    (tmp_path / "other.toml").write_text("[reducer]")
    folder = opened(tmp_path / "in")
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    folder.remember("wishes", {"reducer": name})
    with pytest.raises(InputFault, match="outside|no such reducer"):
        folder.model({"model": name})
    assert "outside" in view(folder)["fault"] or "no such reducer" in view(folder)["fault"]


def test_a_dropped_file_overwrites_nothing(tmp_path):
    folder = opened(tmp_path)
    folder.new_file("a.csv", b"1")
    folder.new_file("a.csv", b"1")
    with pytest.raises(InputFault, match="other content"):
        folder.new_file("a.csv", b"2")
    assert (tmp_path / "a.csv").read_bytes() == b"1"

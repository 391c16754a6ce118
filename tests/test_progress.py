"""What takes a while is told: how far it is, how long it will take, in a pipe too, and nothing of it on stdout."""

import io
import sys
import time

import pytest

from cli import progress as shown
from cli.bars import Bars
from fmu_src.progress import Task, say, task, told_to


@pytest.mark.parametrize("given, begun, text", [
    ({}, 0.5, "loading"), ({}, 20.0, "loading, for 20 s now"), ({"about": 60.0}, 20.0, "loading, about 40 s left"),
    ({"about": 6.0}, 20.0, "loading, about 1 s left"), ({"total": 8}, 20.0, "loading: 0 of 8, for 20 s now"),
    ({"total": 8, "done": 2}, 20.0, "loading: 2 of 8, about 60 s left"), ({"total": 8, "done": 8}, 20.0, "loading: 8 of 8"),
    ({"total": 8, "done": 1}, 60.0, "loading: 1 of 8, about 7 min left"),
])  # fmt: skip
def test_a_task_is_told_in_a_sentence(given, begun, text):
    known = Task("loading", **given)
    known.begun = time.monotonic() - begun
    assert known.sentence() == text


def test_in_a_pipe_the_innermost_task_is_told_if_it_takes_long(monkeypatch, capsys):
    monkeypatch.setattr(shown, "SOON", 0.05)
    with told_to(shown.Lines()), task("outer"), task("inner", total=4) as inner:
        inner.advance()
        time.sleep(0.4)
        say("a result on the way")
    with told_to(shown.Lines()), task("quick"):
        pass
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.splitlines() == ["rvwear: inner: 1 of 4, about 1 s left", "a result on the way"]


def test_on_a_terminal_there_are_bars_and_they_go(monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm-256color")
    bars = shown.new_screen()
    assert isinstance(bars, Bars)
    with told_to(bars), task("equilibria", total=4) as turning:
        turning.advance(2)
        say("a result on the way")
        time.sleep(0.3)
    assert "equilibria: 2 of 4" in terminal.getvalue() and "a result on the way" in terminal.getvalue()
    assert bars.drawn is None


def test_without_a_listener_nothing_happens(capsys):
    with task("unheard") as silent:
        silent.advance()
        say("unheard")
    assert capsys.readouterr() == ("", "")

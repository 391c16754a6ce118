"""What takes a while is told: how far it is, how long it will take, in a pipe too, and nothing of it on stdout."""

import io
import sys
import time
from types import SimpleNamespace

import pytest

from cli import progress as shown
from cli.bars import Bars
from fmu_src.durations import Durations
from fmu_src.progress import Task, beside_text, left_in_all, say, task, told_to


@pytest.mark.parametrize("given, begun, text", [
    ({}, 0.5, "loading"), ({}, 20.0, "loading, for 20 s now"), ({"about": 60.0}, 20.0, "loading, about 40 s left"),
    ({"about": 6.0}, 20.0, "loading, about 1 s left"), ({"total": 8}, 20.0, "loading: 0 of 8, for 20 s now"),
    ({"total": 8, "done": 2}, 20.0, "loading: 2 of 8, about 60 s left"), ({"total": 8, "done": 8}, 20.0, "loading: 8 of 8"),
    ({"total": 8, "done": 1}, 60.0, "loading: 1 of 8, about 7 min left"),
    # Effects that are screened first cost a tenth of the others: "about 18 s left" became 80.
    ({"total": 85, "done": 4}, 0.9, "loading: 4 of 85"), ({"total": 85, "done": 4}, 70.0, "loading: 4 of 85, about 24 min left"),
    ({"total": 85, "done": 4, "before": 80.0}, 1.0, "loading: 4 of 85, about 76 s left"),
    ({"total": 85, "done": 80, "before": 100.0}, 40.0, "loading: 80 of 85, about 6 s left"),
])  # fmt: skip
def test_a_task_is_told_in_a_sentence(given, begun, text):
    known = Task("loading", **given)
    known.begun = time.monotonic() - begun
    assert known.sentence() == text


def told_over(known, monkeypatch, steps):
    """What is said of a task at each of ``steps``: (seconds since its beginning, steps done)."""
    now = known.begun
    said = []
    for passed, done in steps:
        monkeypatch.setattr(time, "monotonic", lambda at=now + passed: at)
        known.done = done
        said.append(known.sentence().partition(", ")[2])
    return said


def test_an_end_that_was_told_is_never_put_off(monkeypatch):
    """Of 90 effects that are screened the dear ones are not the first: "about 26 s left" became 52 while 19 and 20 were done, and again at the 27th."""
    steps = [(5.0, 12), (6.0, 15), (8.0, 17), (11.0, 19), (16.0, 20), (27.0, 27), (31.5, 28), (31.9, 80), (40.0, 81)]
    assert told_over(Task("screening", 90, begun=1000.0), monkeypatch, steps) == [
        "about 33 s left", "about 30 s left", "about 28 s left", "at least 25 s left", "at least 20 s left", "at least 9 s left", "at least 4 s left",
        "about 4 s left", "for 40 s now, longer than foretold",
    ]  # fmt: skip
    # A step that takes its time puts nothing off either: "1 of 2, about 13 s left" became 17.
    assert told_over(Task("fitting", 2, begun=0.0), monkeypatch, [(13.0, 1), (17.0, 1), (25.0, 1), (27.0, 1)]) == [
        "about 13 s left", "at least 9 s left", "at least 1 s left", "for 27 s now, longer than foretold",
    ]  # fmt: skip
    # What goes faster than foretold is told anew.
    assert told_over(Task("fitting", 10, begun=0.0), monkeypatch, [(10.0, 1), (20.0, 5), (24.0, 8)]) == ["about 2 min left", "about 20 s left", "about 6 s left"]


def test_a_range_is_put_off_only_where_more_is_to_be_done(monkeypatch):
    now = 1000.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    whole = Task("the whole", begun=now)
    whole.foretell(60.0, 200.0)
    now += 20.0
    # What is looked for beside a large effect may take longer than what was left of it, and was told as part of it.
    whole.foretell(60.0, 300.0)
    assert whole.foretold == (80.0, 200.0)
    whole.foretell(60.0, 300.0, more=True)
    assert whole.foretold == (80.0, 320.0)
    whole.foretell(10.0, 30.0)
    now += 60.0
    whole.foretell(20.0, 90.0)
    assert whole.foretold == (50.0, 50.0) and whole.span == "" and whole.left is None
    assert beside_text([whole]) == "; the whole takes longer than foretold"


def test_in_a_pipe_the_innermost_task_is_told_if_it_takes_long(monkeypatch, capsys):
    monkeypatch.setattr(shown, "SOON", 0.05)
    monkeypatch.setattr(shown, "SHORT", 0.05)
    with told_to(shown.Lines()), task("outer"), task("inner", total=4) as inner:
        inner.advance()
        time.sleep(0.4)
        say("a result on the way")
    with told_to(shown.Lines()), task("quick"):
        pass
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.splitlines() == ["rvwear: inner: 1 of 4, about 1 s left", "a result on the way"]


def test_in_a_pipe_a_step_is_told_with_what_is_left_of_the_whole(monkeypatch, capsys):
    monkeypatch.setattr(shown, "SOON", 0.05)
    monkeypatch.setattr(shown, "SHORT", 0.05)
    with told_to(shown.Lines()), task("outer") as whole, task("inner", total=4) as inner:
        whole.foretell(90.0, 350.0)
        inner.advance()
        time.sleep(0.4)
    assert capsys.readouterr().err.splitlines() == ["rvwear: inner: 1 of 4, about 1 s left; in all 1 to 6 min left"]


def test_what_follows_is_said_where_nobody_knows_how_long_it_takes():
    """"In all 25 to 80 s left" stood there while effects were screened, and then "the rest takes 1 to 2 min"."""
    whole = Task("the whole", then="fits after it take longer")
    assert beside_text([whole]) == "; fits after it take longer" and beside_text([Task("another")]) == ""
    whole.foretell(90.0, 350.0)
    assert beside_text([whole]) == "; in all 1 to 6 min left"


@pytest.mark.parametrize("given, foretold, passed, text", [
    ({}, None, 5.0, ""), ({"before": 60.0}, None, 5.0, ""), ({"before": 60.0, "whole": True}, None, 20.0, "about 40 s"),
    ({"whole": True}, (90.0, 350.0), 0.0, "1 to 6 min"), ({"before": 200.0, "whole": True}, (90.0, 350.0), 20.0, "about 3 min"),
    ({"before": 60.0, "whole": True}, None, 70.0, ""),
])  # fmt: skip
def test_what_is_left_in_all_is_told_as_foretold_or_as_the_last_time(given, foretold, passed, text):
    """Where the last time said it closer than what was foretold, a step's "about 1 s left" stood alone."""
    whole = Task("the whole", **given)
    if foretold:
        whole.foretell(*foretold)
    whole.begun -= passed
    assert left_in_all([Task("around it", before=5.0), whole, Task("a part", total=4, done=1)]) == text


def test_in_a_pipe_what_is_over_when_it_is_read_gets_no_line(monkeypatch):
    """"placing the roller cages, about 1 s left" came again and again in a diagnosis of 3 minutes."""
    lines, now = shown.Lines(), 1000.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    quick, slow = Task("placing", total=4, done=3, begun=now - 1.0), Task("placing", total=4, done=1, begun=now - 1.0)
    assert not lines.is_due(quick, now) and lines.is_due(slow, now) and lines.is_due(Task("fitting", begun=now - 1.0), now)
    # It took longer than it was foreseen to.
    now += 1.0
    assert lines.is_due(quick, now)


def test_in_a_pipe_a_task_is_told_once_and_then_every_ten_seconds_at_most(monkeypatch):
    """A diagnosis of six minutes wrote a line of the same at 1, 4, 7, 12, 20 and 33 s of each step."""
    lines, now = shown.Lines(), 1000.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    whole, told = Task("whole", begun=now), []
    lines.tasks.append(whole)
    for name, lasts in (("long", 60), ("short", 2), ("another", 5)):
        inner = Task(name, begun=now)
        lines.outer.update(lines.tasks)
        lines.tasks.append(inner)
        for _ in range(5 * lasts):
            now += 0.2
            if lines.is_due(lines.tasks[-1], now):
                lines.spoken[inner] = lines.last = now
                told.append((name, round(now - inner.begun)))
        lines.end(inner)
        # A moment in between.
        now += 0.2
        assert not lines.is_due(whole, now)
    assert told == [("long", 1), ("long", 11), ("long", 21), ("long", 35), ("long", 58), ("short", 1), ("another", 2)]
    assert not lines.spoken and lines.outer == {whole}
    now += 10.0
    assert lines.is_due(whole, now)


def test_on_a_terminal_there_are_bars_and_they_go(monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm-256color")
    bars = shown.new_screen(["solve"]).inner
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


def test_what_nobody_can_count_is_told_from_the_last_time(tmp_path, monkeypatch):
    """By the command line, else by what is done; short tasks and those that know it themselves are left alone."""
    monkeypatch.setattr("fmu_src.durations.cache_folder", lambda name: tmp_path)

    def run(words, what, passed, **more):
        task = Task(what, **more)
        durations = Durations(words)
        durations.begin(task)
        before = task.before
        task.begun -= passed
        durations.end(task)
        return before

    assert run(["compare", "a"], "comparing", 20.0) is None
    assert run(["compare", "b"], "comparing", 40.0) == 20.0
    assert run(["compare", "a"], "comparing", 1.0) == 20.0 and run(["compare", "c"], "comparing", 1.0) == 40.0
    assert run(["diagnose", "a"], "comparing", 1.0) is None
    # Steps are told by their number; what ended before its last one says nothing.
    assert run(["compare", "a"], "comparing", 9.0, total=3) is None and run(["compare", "a"], "comparing", 9.0, total=3, done=3) is None
    assert run(["compare", "b"], "comparing", 1.0, total=6) == pytest.approx(18.0)
    task = Task("comparing", before=20.0)
    task.begun -= 5.0
    assert task.sentence() == "comparing, about 15 s left"
    task.begun -= 30.0
    assert task.sentence() == "comparing, for 35 s now, longer than foretold"
    # Another command's time, which may be that of another model, is told as such.
    task = Task("comparing")
    Durations(["compare", "d"]).begin(task)
    assert task.sentence() == "comparing, about 40 s left if it takes as long as the last compare"
    Durations(["compare", "a"]).begin(task)
    assert "last" not in task.sentence()
    # How long a diagnosis takes hangs on what it finds: "about 17 s left" stood over 76 s of another campaign's.
    task = Task("comparing", whole=True)
    Durations(["compare", "d"]).begin(task)
    assert task.before is None
    Durations(["compare", "a"]).begin(task)
    assert task.before == 20.0
    # What was interrupted says nothing of how long it takes.
    run(["compare", "a"], "comparing", 5.0, broken=True)
    assert run(["compare", "a"], "comparing", 1.0) == 20.0
    (tmp_path / "tasks").write_bytes(b"damaged")
    assert run(["compare", "a"], "comparing", 1.0) is None


def test_what_ends_before_its_time_is_known():
    heard = []
    listener = SimpleNamespace(begin=heard.append, end=lambda _: None)
    with told_to(listener):
        with pytest.raises(KeyboardInterrupt), task("stopped"):
            raise KeyboardInterrupt
        with task("whole"):
            pass
    assert [t.broken for t in heard] == [True, False]

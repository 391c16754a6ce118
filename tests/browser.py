"""A headless Chromium, and the workbench's command with a page of it."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
EXAMPLE = ROOT / "examples" / "hidden_effect" / "campaign"
# A diagnosis as the page has it.
ANSWER = {"model": "RV20E-121", "tone": "fair", "verdict": "stopped", "headline": "h", "reason": "r", "seconds": 9.0, "effects": [], "confusable": [],
          "base_off": [], "left": "", "sizes": "", "together": "", "stand_ins": [], "rejected": [], "laws": [],
          "page": {"cards": [], "sections": [], "warnings": []}, "doubts": [], "command": "c"}  # fmt: skip


class Bench:
    """The command, its folder, and a page; what the page asks of others or complains of is kept."""

    def __init__(self, chromium, folder: Path, **more: str):
        self.folder, self.chromium, self.more = folder, chromium, more
        self.trouble: list[str] = []
        self.start()
        self.page = self.tab()

    def start(self):
        command = [sys.executable, "-m", "cli", "workbench", str(self.folder), "--no-browser"]
        self.process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, env=os.environ | self.more)
        assert self.process.stdout
        assert self.process.stdout.readline().startswith("workbench of ")
        self.address = self.process.stdout.readline().strip()

    def tab(self):
        page = self.chromium.new_page(viewport={"width": 1280, "height": 900})
        page.set_default_timeout(60_000)
        page.on("pageerror", lambda e: self.trouble.append(f"script: {e}"))
        page.on("request", lambda r: None if r.url.startswith((self.address, "data:", "blob:")) else self.trouble.append(f"asked elsewhere: {r.url}"))
        return page

    def kill(self):
        self.process.kill()
        self.close()

    def close(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        assert self.process.wait(10) in (0, -signal.SIGKILL)
        assert self.process.stdout
        self.process.stdout.close()

    def view(self, name):
        self.page.goto(f"{self.address}#{name}")
        self.page.locator(f"#tab-{name}[aria-selected=true]").wait_for()


def until(page, told, argument=None, seconds=30.0):
    """Waits until JavaScript tells something; ``page.wait_for_function`` evaluates in the page later on, which the workbench forbids its pages."""
    end = time.monotonic() + seconds
    while not page.evaluate(told, argument):
        assert time.monotonic() < end, f"after {seconds:g} s: {told}"
        page.wait_for_timeout(50)


def loop_file(path: Path, rows: int, stiffness: float) -> Path:
    """A loop as a bench writes it: semicolons, decimal commas, a unit in the head."""
    torque = 160.0 * np.sin(np.linspace(0.0, 2.0 * np.pi, rows))
    turning = torque / stiffness + 0.05 * np.sign(torque) + 0.003 * np.random.default_rng(rows).standard_normal(rows)
    text = "Drehmoment [Nm];Verdrehung [arcmin]\n" + "\n".join(f"{t:.3f};{y:.4f}" for t, y in zip(torque, turning))
    path.write_text(text.replace(".", ","), encoding="utf-8")
    return path


def dropped(bench, tmp_path):
    """The page with two repetitions of a loop."""
    page = bench.page
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", [str(loop_file(tmp_path / f"loop_20degC_{k}.csv", 200 + k, 400.0)) for k in (1, 2)])
    page.get_by_text("2 runs in 2 files, 1 condition").wait_for()
    return page

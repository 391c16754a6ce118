"""Is what a clean answer would have seen seen?  Effects hidden at the sizes that it says, in campaigns of other noise.

    python3 -m benchmarks.would_show --seeds 2 --most 8              a minute and a half for each campaign

A sound RV20E-121 is measured (``first_hour.files``) and diagnosed; of the plant's effects that are hardest to see each is hidden at the size from which
it would have been seen, and at ``--share`` of it, and diagnosed: seen is any answer but "none".
"""

import argparse
import contextlib
import io
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from cli.main import main as rvwear
from discrepancy.campaign.load import load_campaign
from discrepancy.inference.verdict import NONE
from discrepancy.model_file import ModelFile
from discrepancy.prediction.bench import Bench
from discrepancy.verdict import Answer, diagnose
from reducers.reducer import load_reducer

REDUCER = "RV20E-121"


def answer_of(folder: Path, seed: int, hidden: dict[str, float]) -> Answer:
    """The diagnosis of new measurements with ``hidden`` numbers [SI]."""
    values = [f"{name}={value!r}" for name, value in hidden.items()]
    subprocess.run([sys.executable, "-m", "benchmarks.first_hour.files", "en", str(folder), *values, "--seed", str(seed)], check=True, capture_output=True)
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        rvwear(["campaign", "from", str(folder), "--reducer", REDUCER, "--condition", "locked_at=named"])
    campaign = load_campaign(folder)
    return diagnose(ModelFile(REDUCER, load_reducer(REDUCER)), campaign, jobs=2)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=2, help="campaigns for each size")
    parser.add_argument("--most", type=int, default=8, help="effects, the hardest to see")
    parser.add_argument("--share", type=float, default=0.4, help="of the size, at which it should seldom be seen")
    options = parser.parse_args()
    known = set(Bench(load_reducer(REDUCER), {}).starts[0])
    with tempfile.TemporaryDirectory() as place:
        clean = answer_of(Path(place) / "clean", 1, {})
        if clean.verdict != NONE:
            sys.exit(f"the sound reducer is {clean.verdict}: another seed")
        visible = sorted((v for v in clean.diagnosis.visible if v.parameter in known and math.isfinite(v.size) and not v.or_less), key=lambda v: -v.times)
        print("| effect | number | size [SI] | seen | at a share of it |\n|---|---|---|---|---|")
        total = [0, 0]
        for v in visible[: options.most]:
            seen = [0, 0]
            for k, share in enumerate((1.0, options.share)):
                for seed in range(options.seeds):
                    answer = answer_of(Path(place) / f"{v.parameter} {share} {seed}", 100 + seed, {v.parameter: share * v.size})
                    seen[k] += answer.verdict != NONE
            total = [a + b for a, b in zip(total, seen)]
            print(f"| {v.candidate} | {v.parameter} | {v.size:.3g} | {seen[0]} of {options.seeds} | {seen[1]} of {options.seeds} |", flush=True)
        count = options.seeds * len(visible[: options.most])
        print(f"\nseen: {total[0]} of {count} (95 of 100 are meant); at {options.share:g} of the size: {total[1]} of {count}")


if __name__ == "__main__":
    main()

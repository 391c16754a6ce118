"""The blind trial: makes campaigns, seals their truths, asks the tool, unseals and scores.

    python -m benchmarks.blind_trial.run --final                                                  # the one whose levels are fixed
    python -m benchmarks.blind_trial.run --final --seed SEED --pack                               # the next one, kept as far as it is done
    python -m benchmarks.blind_trial.run --campaigns 1000 --folder /tmp/trial
    python -m benchmarks.blind_trial.run --folder /tmp/trial --scheduler tcp://10.0.0.1:8786      # a Dask cluster
    python -m benchmarks.blind_trial.run --folder /tmp/trial --publish                            # docs/blind_trial.md

Run from the repository's root.  Ctrl-C leaves what is done; the same command goes on, and does none again that has a line in
results.jsonl.  A folder belongs to one plan (its seed): another one is refused.
The seals (SHA-256 of every truth) are printed and stored before the tool sees anything.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Set
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.final import SEED as FINAL_SEED
from benchmarks.blind_trial.final import final_plan
from benchmarks.blind_trial.generator.make import CannotMake, Task, make
from benchmarks.blind_trial.plan import SIZE_ODDS, plan
from benchmarks.blind_trial.results import end_line, finished, pack, packed, resolved, unpack
from benchmarks.blind_trial.words import ABOUT, EXPERIMENTS, RESULTS, SEALS


def one(task: Task, folder: Path, keep: bool, peers: bool) -> dict[str, Any]:
    """Makes, seals, diagnoses and unseals one campaign."""
    from benchmarks.blind_trial import tool
    from benchmarks.blind_trial.generator.folder import seal_of

    started, cpu = time.perf_counter(), time.process_time()
    try:
        seal = make(task, folder / "campaigns", folder / "sealed")["seal"]
    except (CannotMake, RuntimeError) as problem:
        return {"number": task.number, "task": vars(task), "not_made": str(problem), "seconds": time.perf_counter() - started}
    made, cpu_made = time.perf_counter() - started, time.process_time() - cpu
    # Before the tool sees anything.
    with (folder / SEALS).open("a", encoding="utf-8") as seals:
        seals.write(f"{seal}  {task.name}\n")
    print(f"{task.name} sealed {seal}", flush=True)
    campaign = folder / "campaigns" / task.name
    answer = tool.answer_of(campaign)
    cpu_answer = time.process_time() - cpu - cpu_made
    others = {}
    if peers:
        from benchmarks.blind_trial.peers import peers_of

        others = peers_of(campaign)
    # Only now is the truth looked at.
    truth = json.loads((folder / "sealed" / f"{task.name}.json").read_text(encoding="utf-8"))
    if seal_of(truth)[1] != seal:
        raise RuntimeError(f"{task.name}: the truth was changed after it was sealed")
    if not keep:
        shutil.rmtree(campaign)
    return {"number": task.number, "task": vars(task), "seal": seal, "truth": truth, "answer": shortened(answer), "peers": others,
            "making": made, "seconds": time.perf_counter() - started,
            "cpu": {"making": cpu_made, "answering": cpu_answer, "whole": time.process_time() - cpu}}


def shortened(answer: dict[str, Any]) -> dict[str, Any]:
    keys = ("verdict", "effects", "confusable", "alternatives", "captured", "held_out", "p_screen", "p_localise", "warnings", "reason",
            "error", "times", "calls", "base_off")
    return {k: answer[k] for k in keys if k in answer} | {"rejected": answer.get("rejected", [])[:4]}


def results_of(tasks: list[Task], folder: Path, keep: bool, peers: Set[int], jobs: int, scheduler: str) -> Iterator[dict[str, Any]]:
    """Results as they come."""
    if scheduler:
        from dask.distributed import Client, as_completed

        with Client(scheduler) as client:
            futures = [client.submit(one, t, folder, keep, t.number in peers, pure=False) for t in tasks]
            for future in as_completed(futures):
                yield future.result()
        return
    from joblib import Parallel, delayed

    yield from Parallel(n_jobs=jobs, return_as="generator_unordered", batch_size=1)(
        delayed(one)(t, folder, keep, t.number in peers) for t in tasks
    )


def commit() -> str:
    found = subprocess.run(["git", "describe", "--always", "--dirty"], capture_output=True, text=True)
    return found.stdout.strip() or "unknown"


def commits(about: Path) -> str:
    """This code, after that with which the folder was begun."""
    before = json.loads(about.read_text(encoding="utf-8"))["commit"].split(", ") if about.is_file() else []
    return ", ".join(dict.fromkeys([*before, commit()]))


def trial(tasks: list[Task], folder: Path, keep: bool = False, peers: Set[int] = frozenset(), jobs: int = -1, scheduler: str = "",
          quiet: bool = False) -> dict[int, dict[str, Any]]:
    """Runs what is missing; returns all results by number."""
    folder.mkdir(parents=True, exist_ok=True)
    done = finished(folder)
    missing = [t for t in tasks if t.number not in done]
    started, count = time.perf_counter(), 0
    end_line(folder / RESULTS)
    with (folder / RESULTS).open("a", encoding="utf-8") as lines:
        try:
            for result in results_of(missing, folder, keep, peers, jobs, scheduler):
                done[result["number"]] = result
                lines.write(json.dumps(result, default=float) + "\n")
                lines.flush()
                count += 1
                if not quiet:
                    left = (time.perf_counter() - started) / count * (len(missing) - count)
                    cpu = sum(r.get("cpu", {}).get("whole", 0.0) for r in done.values())
                    print(line_of(result), f"[{len(done)} of {len(tasks)}, {left / 60.0:.0f} min left, {cpu / 60.0:.0f} min of CPU so far]", flush=True)
        except KeyboardInterrupt:
            print(f"\nstopped; {len(done)} of {len(tasks)} are done, the same command goes on from here", file=sys.stderr)
    return done


def line_of(result: dict[str, Any]) -> str:
    if "not_made" in result:
        return f"{result['number']:5d} not made: {result['not_made'][:90]}"
    truth, answer = result["truth"], result["answer"]
    laws = " + ".join(law["law"] for law in truth["laws"]) or truth["fault"] or truth.get("trouble") or "nothing"
    names = ", ".join(e["name"] for e in answer["effects"])
    return (f"{result['number']:5d} {truth['kind']} {truth['size']} d'={truth['strength']:g}"
            f" {laws} -> {answer['verdict']}: {names}{answer.get('error', '')} ({result['answer']['times']['whole']:.0f} s)")


def other_plan(about: Path, seed: int, final: bool) -> str:
    """What is wrong if the folder holds results of another plan."""
    if not about.is_file():
        return ""
    known = json.loads(about.read_text(encoding="utf-8"))
    if (known["seed"], known.get("final", False)) == (seed, final):
        return ""
    return f"{about.parent} holds a trial of seed {known['seed']}{' (final)' if known.get('final') else ''}; take another --folder"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--campaigns", type=int, default=1000)
    parser.add_argument("--seed", type=int, help="default 20261; with --final that of the published one, another one is the next final trial")
    parser.add_argument("--final", action="store_true", help="the final trial's plan, fixed in final.py")
    parser.add_argument("--folder", type=Path, help="where results go and are found again (default blind_trial_results/SEED)")
    parser.add_argument("--jobs", type=int, default=-1)
    parser.add_argument("--scheduler", default="", help="address of a Dask scheduler; workers must see the same folder")
    parser.add_argument("--size", choices=("small", "poor", "middle", "rich", "bench"), help="this size of design only")
    parser.add_argument("--kinds", nargs="+", help="these kinds only (null, effect, outside, pair, wrong base, fault)")
    parser.add_argument("--laws", nargs="+", help="campaigns with a law whose name contains one of these words")
    parser.add_argument("--numbers", nargs="+", type=int, help="these campaigns of the plan only")
    parser.add_argument("--peers", type=int, default=0, help="every nth campaign is also given to the peers")
    parser.add_argument("--keep", action="store_true", help="keep the campaign folders")
    parser.add_argument("--publish", action="store_true", help="write docs/blind_trial.md from the results")
    parser.add_argument("--pack", action="store_true", help="keep the final trial's results in the repository, from where --final goes on")
    arguments = parser.parse_args()
    # Workers of joblib share the cores; more threads in each would only wait.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    if arguments.seed is None:
        arguments.seed = FINAL_SEED if arguments.final else 20261
    if arguments.final:
        tasks = final_plan(arguments.seed)
        arguments.campaigns = len(tasks)
    else:
        tasks = plan(arguments.campaigns, arguments.seed, {arguments.size: 1.0} if arguments.size else SIZE_ODDS)
    arguments.folder = arguments.folder or Path(f"blind_trial_results/{arguments.seed}")
    if arguments.kinds:
        tasks = [t for t in tasks if t.kind in arguments.kinds]
    if arguments.laws:
        tasks = [t for t in tasks if any(word in law for word in arguments.laws for law in t.laws)]
    if arguments.numbers:
        tasks = [t for t in tasks if t.number in arguments.numbers]
    arguments.folder.mkdir(parents=True, exist_ok=True)
    place = packed(arguments.seed)
    if arguments.final and len(tasks) == arguments.campaigns and place.is_file() and not (arguments.folder / RESULTS).is_file():
        unpack(arguments.folder, place)
    if arguments.pack:
        pack(arguments.folder, place)
        return 0
    if arguments.publish:
        from benchmarks.blind_trial.publish import publish

        about = json.loads((arguments.folder / ABOUT).read_text(encoding="utf-8"))
        if (arguments.folder / EXPERIMENTS).is_file():
            about["experiments"] = resolved(arguments.folder)
        publish(finished(arguments.folder), Path("docs/blind_trial.md"), about)
        return 0
    if problem := other_plan(arguments.folder / ABOUT, arguments.seed, arguments.final):
        parser.error(problem)
    if arguments.peers:
        from benchmarks.blind_trial.peers import lacking

        if problem := lacking():
            parser.error(problem)
    (arguments.folder / ABOUT).write_text(json.dumps({"commit": commits(arguments.folder / ABOUT), "seed": arguments.seed, "final": arguments.final, "campaigns": arguments.campaigns}), encoding="utf-8")
    peers = {t.number for t in tasks if arguments.peers and t.number % arguments.peers == 0}
    trial(tasks, arguments.folder.resolve(), arguments.keep, peers, arguments.jobs, arguments.scheduler)
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""What the best possible test could make of a campaign: how near other effects come to a hidden law.

    python -m benchmarks.blind_trial.nearest "play of the first stage" --strength 12 --seed 305

Draws a campaign as the trial does and prints, for every other effect in the same quantities, the distance d' of its nearest law and the share of
campaigns in which a test errs that is told both (Neyman and Pearson, equal risk).
"""

import argparse
import sys

from benchmarks.blind_trial.generator.make import LAWS, Task, drawn
from discrepancy.inference.separable import best_error


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("law", choices=sorted(LAWS), metavar="LAW", help=f"one of {', '.join(sorted(LAWS))}")
    parser.add_argument("--strength", type=float, default=12.0, help="d' of the hidden law")
    parser.add_argument("--size", choices=("tiny", "small", "poor", "middle", "rich"), default="small")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    made = drawn(Task(0, arguments.seed, "effect", (arguments.law,), arguments.strength, arguments.size, rivals=True))
    print(f"{arguments.law}, d' {made.sizes[0]:.1f}, in {', '.join(sorted(made.design.quantities()))} of {len(made.design.conditions)} conditions")
    for effect, d in sorted(made.rivals.items(), key=lambda x: x[1]):
        print(f"  {effect}: d' {d:.2f}, the best test errs in {100.0 * best_error(d):.1f} %")
    return 0


if __name__ == "__main__":
    sys.exit(main())

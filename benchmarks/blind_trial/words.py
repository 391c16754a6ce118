"""Words that answers and files of a trial have in common."""

# The base model itself is off: an answer to a null campaign whose base is.
BASE_OFF = "base off"
NONE, ONE, SET, SEVERAL, INCOMPLETE, UNKNOWN, CRASH = (
    "none", "one effect", "set", "several effects", "named but incomplete", "unknown", "crash")  # fmt: skip
# Who chooses an experiment, beside the criteria of the literature.
PROPOSED, RANDOM = "proposed", "random"
# Files in a trial's folder.
RESULTS, SEALS, ABOUT, EXPERIMENTS, BESIDE = "results.jsonl", "seals.txt", "about.json", "experiments.jsonl", "peers.jsonl"

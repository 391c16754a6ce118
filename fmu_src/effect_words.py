"""Names of effects as people say them: lobes are those of a disc, what a crank has is an eccentric.  Keys, which files and commands hold, stay."""

SAID = {"crank lobe": "crank eccentric"}


def effect_words(name: str) -> str:
    """``crank_lobe_errors`` as "crank eccentric errors"."""
    words = name.replace("_", " ")
    for key, said in SAID.items():
        words = words.replace(key, said)
    return words

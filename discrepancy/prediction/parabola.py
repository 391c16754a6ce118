"""Between places of a search: where the least would be."""


def vertex(before: float, at: float, after: float, furthest: float = 0.5) -> float:
    """Of a parabola through three values at even steps, in steps from the middle one and no further than ``furthest``; 0 where they do not bend up."""
    bend = before - 2.0 * at + after
    return min(max(0.5 * (before - after) / bend, -furthest), furthest) if bend > 0.0 else 0.0

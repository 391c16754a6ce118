"""A model's predictions, each computed once."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import numpy as np

from discrepancy.problem import Cheaper, Glimpsing, Model, Places, Placing, Settling
from fmu_src.arrays import Floats

# Of each thread its own: one searches while another settles what is reported.
SEARCHING: ContextVar[bool] = ContextVar("searching", default=False)
# Values from which others are seen.
ANCHOR: ContextVar[Mapping[str, float] | None] = ContextVar("anchor", default=None)

Key = tuple[tuple[str, float], ...]


class Predictions:
    """Predictions of a model by values and record, each computed once."""

    def __init__(self, model: Model):
        self.model = model
        self.off = {p.name: p.off for p in model.nuisances}
        for c in model.candidates:
            self.off.update({p.name: p.off for p in c.amplitudes})
        self.amplitudes = {p.name for c in model.candidates for p in c.amplitudes}
        # By shape the amplitudes of whatever has it: variants of one effect can have a shape in common.
        self.shaping: dict[str, set[str]] = {}
        for c in model.candidates:
            for shape in c.shapes:
                self.shaping.setdefault(shape.name, set()).update(p.name for p in c.amplitudes)
        self.store: dict[Key, dict[int, Floats]] = {}
        # By how they are seen ("exactly", "roughly" to first order, or "near"), values, and those that they are seen from.
        self.beside_store: dict[tuple[str, Key, Key], dict[int, Floats]] = {}
        self.rough_store: dict[Key, dict[int, Floats]] = {}
        self.calls = 0
        self.reported: set[Key] = set()
        # While a search is under way all of them may be needed again.
        self.unfinished = False

    def __getstate__(self) -> dict[str, Any]:
        """Without what only a search needed, once it is over."""
        if self.unfinished:
            return dict(self.__dict__)
        kept = {key: known for key, known in self.store.items() if key in self.reported}
        return self.__dict__ | {"store": kept, "rough_store": {}, "beside_store": {}}

    def report(self, values: Mapping[str, float]) -> None:
        """The predictions of these values stay when this is kept for later."""
        self.reported.add(tuple(sorted(self.active(values).items())))

    def active(self, values: Mapping[str, float]) -> dict[str, float]:
        """The values that differ from the base model's; shapes of effects that are off do not count."""
        active = {n: float(v) for n, v in values.items() if v != self.off.get(n)}
        for name in [n for n in active if n in self.shaping and self.shaping[n].isdisjoint(active)]:
            del active[name]
        return active

    def __call__(self, values: Mapping[str, float], which: Sequence[int]) -> list[Floats]:
        model, active = self.model, self.active(values)
        if self.rough and active and isinstance(model, Cheaper):
            known = self.rough_store.setdefault(tuple(sorted(active.items())), {})
            return self._kept(known, which, lambda missing: model.predict_roughly(active, missing))
        if (seen_from := ANCHOR.get()) is not None and seen_from != active and isinstance(model, Cheaper):
            anchor = dict(seen_from)
            known = self.beside_store.setdefault(("near", tuple(sorted(active.items())), tuple(sorted(anchor.items()))), {})
            return self._kept(known, which, lambda missing: model.predict_near(active, anchor, missing))
        known = self.store.setdefault(tuple(sorted(active.items())), {})
        return self._kept(known, which, lambda missing: model.predict(active, missing))

    def beside(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int]) -> list[Floats]:
        """Predictions for values next to ``base``, to first order if the model has them (``Cheaper``)."""
        model = self.model
        if not isinstance(model, Cheaper):
            return self(values, which)
        values, base, rough = self.active(values), self.active(base), self.rough
        known = self.beside_store.setdefault(("roughly" if rough else "exactly", tuple(sorted(values.items())), tuple(sorted(base.items()))), {})
        return self._kept(known, which, lambda missing: model.predict_beside(values, base, missing, rough))

    def changes(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int], first_order: bool) -> list[Floats]:
        """What ``values`` change next to ``base``, whole or to first order."""
        if first_order:
            high, low = self.beside(values, base, which), self.beside(base, base, which)
        else:
            high, low = self(values, which), self(base, which)
        return [a - b for a, b in zip(high, low)]

    def glimpse(self, values: Mapping[str, float], base: Mapping[str, float], which: Sequence[int], first_order: bool) -> Floats:
        """``changes`` at a few places of the records, roughly in units of the noise, if the model has such (``Glimpsing``)."""
        if isinstance(self.model, Glimpsing):
            return self.model.glimpse(self.active(values), self.active(base), which, first_order)
        return np.concatenate(self.changes(values, base, which, first_order))

    def settle(self, values: Mapping[str, float], which: Sequence[int] | None = None) -> bool:
        """Let the model find its own corrections for the effects in ``values``, for the records ``which`` alone where only these are looked at; what was
        predicted with others is forgotten.  False if it has none."""
        if not (isinstance(self.model, Settling) and self.model.settle(self.active(values), which)):
            return False
        self.forget(values)
        return True

    def put(self, values: Mapping[str, float], places: Places) -> None:
        """Let the model place what it has beside the effects in ``values`` as it was elsewhere (``Placing``)."""
        if isinstance(self.model, Placing):
            self.model.put(self.active(values), places)
            self.forget(values)

    def forget(self, values: Mapping[str, float]) -> None:
        """What was predicted with the effects in ``values``, beside which something was placed anew."""
        effects = self.effects(self.active(values))
        for store in (self.store, self.rough_store):
            # Other threads may add to them meanwhile.
            for key in list(store):
                if self.effects(dict(key)) == effects:
                    store.pop(key, None)
        for pair in list(self.beside_store):
            if self.effects(dict(pair[1])) | self.effects(dict(pair[2])) >= effects:
                self.beside_store.pop(pair, None)

    def unsettled(self, values: Mapping[str, float]) -> bool:
        """Whether what was found in ``settle`` is that of other values."""
        return isinstance(self.model, Settling) and self.model.stands_elsewhere(self.active(values))

    def effects(self, active: Mapping[str, float]) -> frozenset[str]:
        return frozenset(name for name in active if name in self.amplitudes)

    @property
    def rough(self) -> bool:
        """Whether predictions are rough here and now: while something is searched for, by a model that has such."""
        return SEARCHING.get() and isinstance(self.model, Cheaper)

    @contextmanager
    def roughly(self) -> Iterator[None]:
        """Predictions in this block may be rough: while something is searched for."""
        before = SEARCHING.set(True)
        try:
            yield
        finally:
            SEARCHING.reset(before)

    @contextmanager
    def anchored(self, values: Mapping[str, float]) -> Iterator[None]:
        """Predictions in this block may err by a share of what they differ by from those of ``values``: near an end of a search."""
        before = ANCHOR.set(self.active(values))
        try:
            yield
        finally:
            ANCHOR.reset(before)

    def _kept(self, known: dict[int, Floats], which: Sequence[int], predict: Callable[[list[int]], list[Floats]]) -> list[Floats]:
        missing = [i for i in which if i not in known]
        if missing:
            self.calls += 1
            known.update((i, np.asarray(y, dtype=float)) for i, y in zip(missing, predict(missing)))
        return [known[i] for i in which]

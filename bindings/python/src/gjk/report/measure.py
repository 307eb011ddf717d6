# SPDX-License-Identifier: MIT
"""Every pair of a scene solved at a ladder of accuracies, against the clock."""

from __future__ import annotations

from typing import Any, Callable, NamedTuple

from .._gjk import ffi
from .._native import Variant, variant
from ..cases import QUERIES
from ..errors import about
from ..query import distance
from .scene import Pair

__all__ = ["STEPS", "TOLERANCES", "Answer", "Answers", "Level", "check", "ladder", "solve"]

TOLERANCES = {"double": [10.0**-k for k in range(1, 15)] + [0.0], "float": [10.0**-k for k in range(1, 8)] + [0.0]}
STEPS = [1, 2, 3, 4, 6, 8, 12, 16, 24]

BUDGET = 4e9  # nanoseconds that the rounds of one precision may take together
ROUNDS = (5, 200)
PASS = 20_000  # nanoseconds below which a pass over the pairs is too short for the clock


class Level(NamedTuple):
    """One rung of the ladder."""

    kind: str
    """ "rel_tol", "tight" or "max_steps", of a distance; "intersect" or "penetration"."""
    setting: float

    @property
    def label(self) -> str:
        if self.kind in ("tight", "intersect", "penetration"):
            return self.kind
        if self.setting == 0:
            return "full"
        return f"tol {self.setting:.0e}" if self.kind == "rel_tol" else f"{self.setting:.0f} steps"


class Answer(NamedTuple):
    value: float
    lower: float
    upper: float
    status: int
    supports: int


class Answers(NamedTuple):
    """To all pairs at one level."""

    level: Level
    answers: list[Answer]
    ns: float
    """Nanoseconds per query: the mean over the pairs, in the fastest of the rounds."""


def ladder(precision: str) -> list[Level]:
    tolerances = [Level("rel_tol", tolerance) for tolerance in TOLERANCES[precision]]
    steps = [Level("max_steps", steps) for steps in STEPS]
    return [*tolerances, Level("tight", 1), *steps, Level("intersect", 0), Level("penetration", 0)]


def solve(pairs: list[Pair], dim: int, precision: str, step: Callable[[int, int], None]) -> list[Answers]:
    """All pairs at all levels. The levels take turns, so that a busy moment of the machine hits them alike."""
    v = variant(dim, precision)
    watches = [_Watch(v, level, pairs) for level in ladder(precision)]
    first = sum(watch.run() for watch in watches)
    rounds = int(min(max(BUDGET / first, ROUNDS[0]), ROUNDS[1]))
    for i in range(rounds):
        for watch in watches:
            watch.run()
        step(i + 1, rounds)
    return [watch.answers() for watch in watches]


def check(pairs: list[Pair], precision: str) -> None:
    """Raise where a pair is bad input. `solve` is for good ones: its stop watch does not look at statuses."""
    for pair in pairs:
        with about(f"{pair.name_a} and {pair.name_b}"):
            distance(pair.a, pair.b, precision=precision, max_steps=1)


class _Watch:
    """The queries of one level, ready to run again and again without Python in between."""

    def __init__(self, v: Variant, level: Level, pairs: list[Pair]) -> None:
        self.v, self.level, self.count, self.repeats = v, level, len(pairs), 1
        self.pairs = pairs  # keeps alive what the copies below point to
        self.a = _array(v, [pair.a._native(v).struct for pair in pairs])
        self.b = _array(v, [pair.b._native(v).struct for pair in pairs])
        self.options = v.new("options", {"size": v.options_size})
        if level.kind not in QUERIES:
            setattr(self.options, level.kind, level.setting if level.kind == "rel_tol" else int(level.setting))
        self.out = ffi.new(f"{v.name}_result[]", len(pairs))
        self.best = float("inf")

    def run(self) -> float:
        """One pass; returns its nanoseconds."""
        asked = self.level.kind if self.level.kind in QUERIES else "distance"
        ns: int = self.v.bench(QUERIES.index(asked), self.a, self.b, self.count, self.repeats, self.options, self.out)
        self.best = min(self.best, ns / (self.repeats * self.count))
        if ns < PASS:
            self.repeats *= 2
        return float(ns)

    def answers(self) -> Answers:
        found = [Answer(r.value, r.lower, r.upper, r.status, r.supports) for r in self.out]
        return Answers(self.level, found, self.best)


def _array(v: Variant, shapes: list[Any]) -> Any:
    array = ffi.new(f"{v.name}_shape[]", len(shapes))
    for i, shape in enumerate(shapes):
        array[i] = shape[0]
    return array

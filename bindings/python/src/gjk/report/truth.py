# SPDX-License-Identifier: MIT
"""The exact truth about the pairs of a scene, found by several processes."""

from __future__ import annotations

import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from typing import Any, Callable, NamedTuple

from .. import exact
from ..cases import shape_to_json
from .scene import Pair

__all__ = ["Truth", "find"]


class Truth(NamedTuple):
    lower: Fraction
    upper: Fraction
    """The distance lies between; both are equal, or agree to some 30 digits."""
    relation: str
    proven: bool
    """Whether the relation is; round sets may come closer to touching than can be told."""
    scale: float
    """The largest |coordinate| of the two bodies, seen from the midpoint of a closest pair."""
    separation: tuple[Fraction, Fraction] | None = None
    """The signed separation lies between; None: not known, of round sets that overlap."""


def find(pairs: list[Pair], dim: int, jobs: int | None, step: Callable[[int, int], None]) -> list[Truth]:
    """The truth about each pair. step is told how many are done, and of how many."""
    tasks = [(shape_to_json(pair.a), shape_to_json(pair.b), dim) for pair in pairs]
    workers = min(jobs or os.cpu_count() or 1, len(tasks))
    if workers == 1:
        return _gather(map(_truth, tasks), len(tasks), step)
    with ProcessPoolExecutor(workers, multiprocessing.get_context("spawn")) as pool:
        return _gather(pool.map(_truth, tasks, chunksize=16), len(tasks), step)


def _gather(found: Any, total: int, step: Callable[[int, int], None]) -> list[Truth]:
    truths = []
    for truth in found:
        truths.append(truth)
        step(len(truths), total)
    return truths


def _truth(task: tuple[dict[str, Any], dict[str, Any], int]) -> Truth:
    found = exact.distance(*task)
    return Truth(found.lower, found.upper, found.relation, found.proven, float(found.scale), found.separation)

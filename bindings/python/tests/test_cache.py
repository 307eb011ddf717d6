# SPDX-License-Identifier: MIT
"""Warm starts."""

from __future__ import annotations

import copy
import gc
import math
import pickle
import weakref
from itertools import product

import pytest

import gjk
from gjk._native import variant

precisions = pytest.mark.parametrize("precision", ["double", "float"])
TURN = [0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6]


def at(x):
    return [c for i in range(3) for c in (*TURN[3 * i : 3 * i + 3], x if i == 0 else 0.5)]


def corners_of(*half):
    return gjk.Points([[s * h for s, h in zip(signs, half, strict=True)] for signs in product((-1, 1), repeat=3)])


@precisions
def test_a_warm_query_needs_fewer_calls(precision):
    a, b, cache = corners_of(1, 1, 1), corners_of(0.5, 0.7, 0.9), gjk.Cache()
    warm = [gjk.distance(a, b.at(at(4 + i / 1000)), precision=precision, cache=cache).supports for i in range(20)]
    cold = gjk.distance(a, b.at(at(4)), precision=precision).supports
    assert warm[0] == cold
    assert max(warm[1:]) <= 4 < cold
    cache.clear()
    assert gjk.distance(a, b.at(at(4)), precision=precision, cache=cache).supports == cold


@precisions
def test_other_shapes_cost_time_never_truth(precision):
    cache, a = gjk.Cache(), gjk.Box((1, 1, 1))
    for i in range(200):
        b = gjk.Box((0.5, 0.5 + i % 7, 0.5)).at(at(6.0 + i % 3))
        hot, cold = gjk.distance(a, b, precision=precision, cache=cache), gjk.distance(a, b, precision=precision)
        assert hot.lower <= cold.upper
        assert cold.lower <= hot.upper
        del b  # its address may come back with the next


def test_the_cache_keeps_alive_what_it_remembers():
    """Also what it may remember from before a query that was refused."""
    cache, a = gjk.Cache(), corners_of(1, 1, 1)
    first = corners_of(1, 1, 1).at(at(5))
    gjk.distance(a, first, cache=cache)
    with pytest.raises(gjk.BadSupport):
        gjk.distance(a, gjk.Box((1, -1, 1)), cache=cache)
    assert any(held is first for held in cache._held["gjk3"])
    second = corners_of(2, 1, 1).at(at(5))
    gjk.distance(a, second, cache=cache)
    assert cache._held["gjk3"] == (a, second)


@precisions
def test_what_c_goes_on_remembering_stays_alive(precision):
    """Not each answer changes it; and the address of a set that is gone may be that of the next one."""
    cache, box = gjk.Cache(), gjk.Box((1, 1, 1))
    dot = gjk.Support(lambda _: (3, 0, 0), reach=4)
    first = gjk.Support(lambda d: (1, math.copysign(1, d[1]), 0), reach=2)
    gjk.distance(first, dot, cache=cache, precision=precision)
    gone = weakref.ref(first)
    gjk.intersect(box, box.at((5, 0, 0)), cache=cache, precision=precision)
    del first
    gc.collect()
    (name,) = cache._native
    held = [shape._native(variant(3, precision)).struct.data for shape in cache._held[name]]
    assert all(data in held for data in cache._native[name].data)
    assert gone() is not None
    for i in range(2):
        gjk.distance(corners_of(1, 2, 3), corners_of(1, 1, 1).at(at(6 + i)), cache=cache, precision=precision)
    gc.collect()
    assert gone() is None, "C remembers others now"


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda cache: pickle.loads(pickle.dumps(cache))])
def test_a_copy_starts_cold(copied):
    cache, a, b = gjk.Cache(), gjk.Box((1, 1, 1)), gjk.Points([(5, 0, 0), (6, 1, 0), (6, 0, 1), (7, 0, 0)])
    gjk.distance(a, b, cache=cache)
    other = copied(cache)
    assert (repr(cache), repr(other)) == ("<gjk.Cache warm>", "<gjk.Cache cold>")
    assert gjk.distance(a, b, cache=other).value == 4
    other.clear()
    assert repr(cache) == "<gjk.Cache warm>"


def test_a_support_may_clear_the_cache_it_is_asked_with():
    cache = gjk.Cache()
    clears = gjk.Support(lambda _: cache.clear() or (0, 0, 0), reach=1)
    assert gjk.distance(clears, gjk.Sphere(1).at((9, 0, 0)), cache=cache).value == 8
    assert repr(cache) == "<gjk.Cache cold>"


def test_queries_refused_leave_nothing_behind():
    """However many: only the shapes that C may remember are kept."""

    def failing(_):
        raise RuntimeError

    cache, a, bad = gjk.Cache(), gjk.Box((1, 1, 1)), gjk.Support(failing, reach=1)
    first = gjk.Box((2, 1, 1)).at((5, 0, 0))
    gjk.distance(a, first, cache=cache)
    for i in range(50):
        with pytest.raises(RuntimeError):
            gjk.distance(a, bad.at((i, 0, 0)), cache=cache)
        with pytest.raises(gjk.BadSupport):
            gjk.distance(gjk.Box((1, -1 - i, 1)), first, cache=cache)
        assert len(cache._held["gjk3"]) <= 4
    warm, cold = gjk.distance(a, first, cache=cache), gjk.distance(a, first)
    assert warm.lower <= cold.upper
    assert cold.lower <= warm.upper


def test_one_cache_for_all_variants():
    cache = gjk.Cache()
    assert repr(cache) == "<gjk.Cache cold>"
    for precision in ("double", "float"):
        for dim in (2, 3):
            a, b = gjk.Sphere(1, dim=dim), gjk.Sphere(1, dim=dim).at([4.0] + [0.0] * (dim - 1))
            for _ in range(2):
                assert gjk.distance(a, b, precision=precision, cache=cache).value == 2
                assert gjk.intersect(a, b, precision=precision, cache=cache).relation is gjk.Relation.APART
    assert repr(cache) == "<gjk.Cache warm>"

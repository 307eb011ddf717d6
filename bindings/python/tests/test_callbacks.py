# SPDX-License-Identifier: MIT
"""Sets told by a Python function."""

from __future__ import annotations

import itertools
import math
import pickle
import threading

import numpy as np
import pytest
from pairs import length

import gjk

precisions = pytest.mark.parametrize("precision", ["double", "float"])


def corner(direction):
    """A farthest point of the cube of half side 1."""
    return [math.copysign(1, x) for x in direction]


def unit_ball(direction):
    size = length(direction)
    return [x / size for x in direction]


@precisions
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("reach", [None, 2.0])
def test_a_python_cube_is_a_cube(precision, dim, reach):
    own, made = gjk.Support(corner, dim, reach), gjk.Box([1.0] * dim)
    other = gjk.Sphere(0.5, dim=dim).at([3.0, 0.25, 0.5][:dim])
    mine = gjk.distance(own, other, precision=precision)
    ready = gjk.distance(made, other, precision=precision)
    assert mine.lower <= ready.upper
    assert ready.lower <= mine.upper
    assert mine.value == pytest.approx(1.5, rel=1e-6)
    assert gjk.intersect(own, other.at([1.0] * dim), precision=precision).relation is gjk.Relation.OVERLAPPING


def test_reach_spares_calls():
    calls = []

    def counted(direction):
        calls.append(direction)
        return corner(direction)

    other = gjk.Sphere(1).at((4, 1, 0))
    result = gjk.distance(gjk.Support(counted, reach=2), other)
    spared = len(calls)
    calls.clear()
    gjk.distance(gjk.Support(counted), other)
    assert len(calls) == spared + 6
    assert result.supports >= spared
    assert all(len(d) == 3 and all(isinstance(c, float) for c in d) and any(d) for d in calls)


@precisions
def test_arrays_from_a_callback(precision):
    shape = gjk.Support(lambda d: np.sign(d) + (np.asarray(d) == 0), reach=2)
    assert gjk.distance(shape, gjk.Sphere(1).at((5, 0, 0)), precision=precision).value == pytest.approx(3, abs=1e-5)


@precisions
@pytest.mark.parametrize("error", [ZeroDivisionError, KeyboardInterrupt, StopIteration])
@pytest.mark.parametrize("nth", [1, 2, 9])
def test_what_a_callback_raises_comes_out(precision, error, nth):
    calls = []

    def fails(direction):
        calls.append(direction)
        if len(calls) == nth:
            raise error("as it was")
        return unit_ball(direction)

    shape = gjk.Support(fails)
    far = gjk.Ellipsoid((1, 2, 3), pose=(1, 0, 0, 3, 0, 1, 0, 4, 0, 0, 1, 5))
    with pytest.raises(error, match="as it was"):
        gjk.distance(shape, far, precision=precision)
    assert len(calls) == nth, "no more calls after the first that failed"
    assert gjk.distance(gjk.Sphere(1), gjk.Sphere(1), precision=precision).value == 0, "nothing is left behind"


@pytest.mark.parametrize("answer", [None, 5, [1], ["x", 1, 1], [None] * 3, object()])
def test_c_never_sees_an_exception(answer, capfd):
    """cffi would print it and go on."""
    for shape in (gjk.Support(lambda d: answer), gjk.Hull(gjk.Support(lambda d: answer, reach=9), gjk.Sphere(1))):
        with pytest.raises(gjk.BadArgument, match="support") as wrong:
            gjk.distance(shape, gjk.Sphere(1))
        assert [entry.name for entry in wrong.traceback].count("_answer") == 1
    assert capfd.readouterr() == ("", "")


@precisions
def test_inside_a_sum_and_a_hull(precision):
    def fails(direction):
        raise LookupError("inside")

    for couple in (gjk.Sum, gjk.Hull):
        with pytest.raises(LookupError, match="inside"):
            gjk.distance(couple(gjk.Sphere(1), gjk.Support(fails)), gjk.Sphere(1), precision=precision)
        whole = couple(gjk.Support(corner), gjk.Sphere(0.5))
        assert gjk.distance(whole, gjk.Sphere(1).at((5, 0, 0)), precision=precision).value > 2


@precisions
@pytest.mark.parametrize("point", [[math.nan, 0, 0], [0, math.inf, 0], [math.nan] * 3])
def test_points_that_are_not_finite(precision, point):
    with pytest.raises(gjk.BadSupport, match="^support: .* is not finite"):
        gjk.distance(gjk.Support(lambda d: point), gjk.Sphere(1).at((4, 0, 0)), precision=precision)


@precisions
def test_points_beyond_the_reach(precision):
    other = gjk.Sphere(1).at((4, 0, 0))
    corners = gjk.Support(corner, reach=3**0.5)  # a rounding below it
    assert gjk.distance(corners, other, precision=precision).value == 2
    with pytest.raises(gjk.BadSupport, match="^support: .* farther out than the reach, 1.7"):
        gjk.distance(gjk.Support(corner, reach=1.7), other, precision=precision)


@pytest.mark.parametrize("point", [[1, 2], [1, 2, 3, 4], [], "123", None, [None, 1, 2]])
def test_answers_that_are_no_points(point):
    with pytest.raises(gjk.BadArgument, match="support"):
        gjk.distance(gjk.Support(lambda d: point), gjk.Sphere(1))


@pytest.mark.parametrize("reach", [-1.0, math.nan, math.inf])
def test_a_reach_that_is_none(reach):
    with pytest.raises(gjk.BadSupport, match="reach"):
        gjk.distance(gjk.Support(corner, reach=reach), gjk.Sphere(1))


@precisions
def test_points_that_contradict_each_other(precision):
    """Asked twice for the farthest point, the function gives a nearer one."""
    ends = itertools.cycle([(3.0, 0.0, 0.0), (-3.0, 0.0, 0.0)])
    with pytest.raises(gjk.BadSupport):
        gjk.distance(gjk.Support(lambda d: next(ends), reach=3), gjk.Sphere(1).at((9, 2, 1)), precision=precision)


def test_a_query_inside_a_callback():
    def asks(direction):
        assert gjk.distance(gjk.Sphere(1), gjk.Sphere(1).at((5, 0, 0))).value == 3
        return unit_ball(direction)

    assert gjk.distance(gjk.Support(asks), gjk.Sphere(1).at((4, 0, 0))).value == pytest.approx(2)


@pytest.mark.parametrize("couple", [gjk.Sum, gjk.Hull])
@pytest.mark.parametrize("fails_first", [True, False])
def test_an_error_is_that_of_its_own_query(couple, fails_first):
    """Not of a query that the other part asks, which is well; nor is it lost there."""
    inner = []

    def fails(direction):
        raise LookupError("of the outer query")

    def asks(direction):
        inner.append(gjk.distance(gjk.Support(unit_ball, reach=1), gjk.Sphere(1).at((5, 0, 0))).value)
        with pytest.raises(ZeroDivisionError):
            gjk.distance(gjk.Support(lambda d: 1 / 0, reach=1), gjk.Sphere(1))
        return (0, 0, 0)

    parts = [gjk.Support(fails, reach=1), gjk.Support(asks, reach=1)]
    with pytest.raises(LookupError, match="of the outer query"):
        gjk.distance(couple(*(parts if fails_first else parts[::-1])), gjk.Sphere(1).at((9, 0, 0)))
    assert inner == pytest.approx([3] * len(inner))
    assert inner


def test_threads_do_not_mix_errors():
    seen = {}

    def work(name):
        def fails(direction):
            raise RuntimeError(name)

        for _ in range(50):
            try:
                gjk.distance(gjk.Support(fails), gjk.Sphere(1))
            except RuntimeError as error:
                seen.setdefault(name, set()).add(str(error))

    threads = [threading.Thread(target=work, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert seen == {name: {name} for name in "abcd"}


def test_pickle():
    shape = pickle.loads(pickle.dumps(gjk.Support(corner, 2, 3.0, radius=1)))
    assert shape == gjk.Support(corner, 2, 3.0, radius=1)
    assert shape.rounded(1).at((1, 1)).reach == 3.0

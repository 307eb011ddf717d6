# SPDX-License-Identifier: MIT
"""What must not change an answer, or change it in a known way."""

from __future__ import annotations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from pairs import lattice, pairs, points, poses, prepared, size

import gjk
from gjk.cases import shape_from_json

precisions = pytest.mark.parametrize("precision", ["double", "float"])


def meet(x, y):
    """Two brackets of one number overlap."""
    return x[0] <= y[1] and y[0] <= x[1]


def bracket(result):
    return result.lower, result.upper


@precisions
@given(pair=pairs())
def test_swap(precision, pair):
    a, b, _ = prepared(pair, precision)
    there, back = gjk.distance(a, b, precision=precision), gjk.distance(b, a, precision=precision)
    assert meet(bracket(there), bracket(back))
    relations = {gjk.intersect(*both, precision=precision).relation for both in ((a, b), (b, a))}
    assert gjk.Relation.APART not in relations or not relations & {gjk.Relation.OVERLAPPING, gjk.Relation.MEETING}


@precisions
@given(pair=pairs(), shift=st.lists(lattice, min_size=3, max_size=3))
def test_lattice_motion(precision, pair, shift):
    """A shift by integers and a quarter turn, which round nothing on the lattice: the same set, elsewhere."""
    dim, _, _ = pair
    a, b, truth = prepared(pair, precision)
    quarter = [0, -1, 0, 1, 0, 0, 0, 0, 1] if dim == 3 else [0, -1, 1, 0]
    pose = [c for i in range(dim) for c in (*quarter[i * dim : (i + 1) * dim], shift[i])]
    still = gjk.Points([[0.0] * dim])
    moved = gjk.distance(gjk.Sum(a, still).at(pose), gjk.Sum(b, still).at(pose), precision=precision)
    assert moved.lower <= truth.upper
    assert truth.lower <= moved.upper


@precisions
@given(pair=pairs(), power=st.integers(-20, 20))
def test_scaling_by_a_power_of_two(precision, pair, power):
    """Everything times 2**k: the answer to the last bit."""
    dim, _, _ = pair
    a, b, _ = prepared(pair, precision)
    factor = 2.0**power
    once = gjk.distance(times(a, 1.0), times(b, 1.0), precision=precision)
    scaled = gjk.distance(times(a, factor), times(b, factor), precision=precision)
    assume(once.upper == 0 or once.upper > 1e-30)  # below, the allowance for underflow shows, which has no scale
    assert scaled.value == once.value * factor
    assert (scaled.lower, scaled.upper) == (once.lower * factor, once.upper * factor)
    assert scaled.normal == once.normal


@precisions
@given(pair=pairs(), power=st.integers(-20, 20))
def test_scaling_a_depth_by_a_power_of_two(precision, pair, power):
    a, b, _ = prepared(pair, precision)
    factor = 2.0**power
    once = gjk.penetration(times(a, 1.0), times(b, 1.0), precision=precision)
    scaled = gjk.penetration(times(a, factor), times(b, factor), precision=precision)
    assume(abs(once.lower) > 1e-30)
    assert scaled.value == once.value * factor
    assert (scaled.lower, scaled.upper) == (once.lower * factor, once.upper * factor)
    assert scaled.normal == once.normal


def times(shape, factor):
    """The set multiplied by a power of two, with nothing rounded."""
    dim = shape.dim
    pose = shape.pose or [float(i == j) for i in range(dim) for j in range(dim + 1)]
    return shape._with(pose=tuple(c * factor for c in pose), radius=shape.radius * factor)


@precisions
@given(pair=pairs(), grow=size)
def test_radius_shift(precision, pair, grow):
    """A ball around b brings it nearer by just its radius."""
    a, b, truth = prepared(pair, precision)
    grown = gjk.distance(a, gjk.Sum(b, gjk.Sphere(grow, dim=b.dim)), precision=precision)
    direct = gjk.distance(a, b.rounded(grow) if b.radius == 0 else b, precision=precision)
    least = max(truth.lower - int(grow * 2**30 + 1) / 2**30, 0)
    assert grown.upper >= least
    assert grown.lower <= truth.upper
    if b.radius == 0:
        assert meet(bracket(grown), bracket(direct))


@precisions
@given(data=st.data(), dim=st.sampled_from([2, 3]))
def test_permuted_and_repeated_points(precision, data, dim):
    cloud = data.draw(points(dim, 2, 8))
    other = shape_from_json({"shape": "points", "points": data.draw(points(dim))}, dim)
    shuffled = data.draw(st.permutations(cloud + data.draw(st.lists(st.sampled_from(cloud), max_size=4))))
    once = gjk.distance(gjk.Points(cloud), other, precision=precision)
    again = gjk.distance(gjk.Points(shuffled), other, precision=precision)
    assert meet(bracket(once), bracket(again))


@precisions
@given(pair=pairs(), moves=st.lists(st.lists(lattice, min_size=3, max_size=3), min_size=1, max_size=4))
def test_warm_equals_cold(precision, pair, moves):
    dim, _, _ = pair
    a, b, _ = prepared(pair, precision)
    warm = gjk.Cache()
    for move in moves:
        there = b.at([c / 16 for c in move[:dim]])
        hot = gjk.distance(a, there, precision=precision, cache=warm)
        assert meet(bracket(hot), bracket(gjk.distance(a, there, precision=precision)))
        verdicts = {gjk.intersect(a, there, precision=precision, cache=cache).relation for cache in (warm, None)}
        assert gjk.Relation.APART not in verdicts or not verdicts & {gjk.Relation.OVERLAPPING, gjk.Relation.MEETING}


@precisions
@given(pair=pairs())
def test_equal_questions_equal_answers(precision, pair):
    a, b, _ = prepared(pair, precision)
    assert gjk.distance(a, b, precision=precision) == gjk.distance(a, b, precision=precision)


@pytest.mark.parametrize("dim", [2, 3])
def test_far_from_the_origin_nothing_is_lost(dim):
    """The same boxes 2**20 away: the coordinates stay exact, and so does the answer."""
    a, b, far = gjk.Box([1.0] * dim), gjk.Box([0.5] * dim), 2.0**20
    near = gjk.distance(a, b.at([4.0] + [0.0] * (dim - 1)))
    away = gjk.distance(a.at([far] * dim), b.at([far + 4.0] + [far] * (dim - 1)))
    assert meet(bracket(near), bracket(away))
    assert away.value == near.value == 2.5


@given(pose=poses(3))
def test_one_shape_with_itself_meets(pose):
    box = gjk.Box((1, 2, 3), pose=pose)
    assert gjk.distance(box, box).lower == 0
    assert gjk.intersect(box, box).relation is not gjk.Relation.APART

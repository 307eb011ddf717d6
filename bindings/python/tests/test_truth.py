# SPDX-License-Identifier: MIT
"""Every answer against the exact truth: all shapes, both dimensions, both precisions, random and degenerate."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pairs import UNIT, holds, inside, length, pairs, prepared

import gjk
from gjk import Relation, Status, exact

precisions = pytest.mark.parametrize("precision", ["double", "float"])


@precisions
@given(pair=pairs())
def test_distance_holds_the_truth(precision, pair):
    a, b, truth = prepared(pair, precision)
    assert holds(gjk.distance(a, b, precision=precision), truth)


@precisions
@given(pair=pairs(), steps=st.integers(1, 6), tolerance=st.sampled_from([0.5, 1e-1, 1e-3, 1e-6]))
def test_a_query_that_stops_early_holds_the_truth(precision, pair, steps, tolerance):
    a, b, truth = prepared(pair, precision)
    limited = gjk.distance(a, b, precision=precision, max_steps=steps)
    assert holds(limited, truth)
    assert limited.steps <= steps
    loose = gjk.distance(a, b, precision=precision, rel_tol=tolerance)
    assert holds(loose, truth)
    if loose.status is Status.OK:
        assert loose.upper - loose.lower <= tolerance * loose.upper * (1 + 1e-6)


@precisions
@given(pair=pairs(), cutoff=st.sampled_from([1e-3, 0.1, 1.0, 5.0]))
def test_a_cutoff_holds_the_truth(precision, pair, cutoff):
    a, b, truth = prepared(pair, precision)
    result = gjk.distance(a, b, precision=precision, cutoff=cutoff)
    assert holds(result, truth)
    if result.status is Status.DECIDED:
        assert truth.upper > cutoff * (1 - 1e-6)


@precisions
@given(pair=pairs())
def test_intersect_tells_the_truth(precision, pair):
    a, b, truth = prepared(pair, precision)
    result = gjk.intersect(a, b, precision=precision)
    assert inside(result)
    if result.relation is Relation.APART:
        assert truth.relation == exact.APART or not truth.proven
    elif result.relation is Relation.MEETING:
        assert truth.relation != exact.APART or not truth.proven
    elif result.relation is Relation.OVERLAPPING:
        assert truth.relation == exact.OVERLAPPING or not truth.proven
    if truth.separation is not None:
        assert result.lower <= truth.separation[1]
        assert truth.separation[0] <= result.upper
    else:
        assert result.lower <= 0


@precisions
@given(pair=pairs())
def test_the_normal_is_unit(precision, pair):
    a, b, _ = prepared(pair, precision)
    for ask in (gjk.distance, gjk.intersect):
        normal = ask(a, b, precision=precision).normal
        assert abs(length(normal) - 1) <= 8 * float(UNIT[precision])


@precisions
@given(pair=pairs())
def test_the_points_lie_on_the_shapes_and_realise_upper(precision, pair):
    dim, _, _ = pair
    a, b, truth = prepared(pair, precision)
    result = gjk.distance(a, b, precision=precision)
    far = float(truth.scale) + max(abs(c) for c in (*result.point_a, *result.point_b))
    room = 64 * float(UNIT[precision]) * far
    for shape, point in ((a, result.point_a), (b, result.point_b)):
        off = gjk.distance(shape, gjk.Sphere(0, dim=dim).at(point))
        assert off.lower <= room
    between = length([p - q for p, q in zip(result.point_a, result.point_b)])
    assert abs(between - result.upper) <= room + (result.upper - result.lower)


@precisions
@given(pair=pairs())
def test_values_are_of_the_precision_asked(precision, pair):
    a, b, _ = prepared(pair, precision)
    result = gjk.distance(a, b, precision=precision)
    numbers = [result.value, result.lower, result.upper, *result.point_a, *result.point_b, *result.normal]
    if precision == "float":
        assert numbers == [exact.to_float32(x) for x in numbers]
    assert all(isinstance(x, float) for x in numbers)


def test_the_error_on_boxes_is_small():
    """Seeded boxes in general position: the error in u * scale that the report shows."""
    turn = [0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6]
    worst = Fraction(0)
    for i in range(50):
        pose = [c for r in range(3) for c in (*turn[3 * r : 3 * r + 3], 2.0 + 0.07 * i * (r + 1))]
        a, b = {"shape": "box", "half": [1, 0.5, 0.25]}, {"shape": "box", "half": [0.3, 0.2, 0.9], "pose": pose}
        truth = exact.distance(a, b, 3)
        result = gjk.distance(gjk.Box(a["half"]), gjk.Box(b["half"], pose=pose))
        worst = max(worst, abs(Fraction(result.value) - truth.lower) / (UNIT["double"] * truth.scale))
    assert 0 < worst <= 4

# SPDX-License-Identifier: MIT
"""The option tight: points, boxes, segments, triangles and spheres to the last bit; no change for other shapes."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pairs import inside, pairs, prepared, shapes, sharp_pairs

import gjk
from gjk import Relation, exact
from gjk.cases import shape_from_json

precisions = pytest.mark.parametrize("precision", ["double", "float"])


def ulp(x, precision):
    """The step from x, or from the number that x rounds to, to the next larger in size."""
    _, e = math.frexp(float(x))
    return Fraction(2) ** (max(e, -1021) - 53 if precision == "double" else max(e, -125) - 24)


def check_distance(result, truth, precision):
    assert result.lower <= truth.upper
    assert truth.lower <= result.upper
    assert inside(result)
    if truth.upper == 0:
        assert result.lower == result.value == result.upper == 0
        return
    step = ulp(truth.upper, precision)
    assert abs(Fraction(result.value) - truth.upper) <= step
    assert Fraction(result.upper) - Fraction(result.lower) <= 2 * step
    assert result.lower > 0, "what is apart is proven so"


def check_verdict(result, truth):
    assert inside(result)
    assert (result.lower > 0) == (truth.relation == exact.APART)
    assert (result.upper <= 0) == (truth.relation != exact.APART)
    assert result.upper == 0 or truth.relation != exact.TOUCHING
    if truth.separation is not None:
        assert result.lower <= truth.separation[1]
        assert truth.separation[0] <= result.upper


@precisions
@given(pair=sharp_pairs())
def test_the_last_bit(precision, pair):
    a, b, truth = prepared(pair, precision)
    check_distance(gjk.distance(a, b, precision=precision, tight=True), truth, precision)


@precisions
@given(pair=sharp_pairs())
def test_the_verdict_is_always_told(precision, pair):
    a, b, truth = prepared(pair, precision)
    check_verdict(gjk.intersect(a, b, precision=precision, tight=True), truth)


@precisions
@given(pair=sharp_pairs(), steps=st.integers(1, 4))
def test_with_other_options_the_bracket_holds(precision, pair, steps):
    a, b, truth = prepared(pair, precision)
    cache = gjk.Cache()
    for settings in ({"max_steps": steps}, {"cutoff": 0.5}, {"rel_tol": 0.1}, {"slack": 0.25}, {}, {}):
        result = gjk.distance(a, b, precision=precision, tight=True, cache=cache, **settings)
        assert result.lower <= truth.upper
        assert truth.lower <= result.upper
        assert inside(result)
    check_distance(result, truth, precision)  # warm


@precisions
@given(pair=pairs())
def test_any_shapes_are_allowed(precision, pair):
    a, b, truth = prepared(pair, precision)
    result = gjk.distance(a, b, precision=precision, tight=True)
    assert result.lower <= truth.upper
    assert truth.lower <= result.upper
    assert inside(result)
    verdict = gjk.intersect(a, b, precision=precision, tight=True)
    assert not (verdict.lower > 0 and truth.proven and truth.relation != exact.APART)
    assert not (verdict.upper < 0 and truth.proven and truth.relation != exact.OVERLAPPING)


@st.composite
def couples(draw):
    dim = draw(st.sampled_from([2, 3]))
    part, other = draw(shapes(dim, couples=False)), draw(shapes(dim, couples=False))
    return shape_from_json({"shape": "sum", "a": part, "b": part}, dim), shape_from_json(other, dim)


@precisions
@given(pair=couples())
def test_other_shapes_do_not_change(precision, pair):
    """A couple is not among the shapes that tight is for."""
    for ask in (gjk.distance, gjk.intersect):
        assert ask(*pair, precision=precision, tight=True) == ask(*pair, precision=precision)


@precisions
def test_exact_contact(precision):
    box = gjk.Box((1, 1, 1))
    corner = gjk.Points([(0, 0, 0), (1, 2, 3), (2, -1, 1)]).at((1, 1, 1))
    for other in (box.at((2, 0, 0)), box.at((2, 2, 0)), box.at((2, 2, 2)), corner, gjk.Sphere(1).at((0, 0, 2))):
        far = gjk.distance(box, other, precision=precision, tight=True)
        assert (far.lower, far.value, far.upper) == (0, 0, 0)
        verdict = gjk.intersect(box, other, precision=precision, tight=True)
        assert verdict.upper == 0
        assert verdict.relation is Relation.MEETING


@precisions
@pytest.mark.parametrize("gap", [1e-3, 1e-7, 1e-12, 1e-14, 3e-16])
def test_gaps_far_below_the_size(precision, gap):
    """A triangle over a turned box's face; the gap is set by the shift and keeps what the shift's rounding leaves."""
    a = {"shape": "box", "half": [1, 0.5, 0.25], "pose": [0.6, -0.8, 0, 0, 0.8, 0.6, 0, 0, 0, 0, 1, 0]}
    b = {"shape": "triangle", "v": [[0, 0, 0], [1, 0, 1], [0, 1, 2]], "pose": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.25]}
    b["v"][0][2] = gap
    shape_a, shape_b, truth = prepared((3, a, b), precision)
    assert truth.relation == exact.APART
    check_distance(gjk.distance(shape_a, shape_b, precision=precision, tight=True), truth, precision)
    check_verdict(gjk.intersect(shape_a, shape_b, precision=precision, tight=True), truth)


@precisions
@pytest.mark.parametrize("tight", [1, 0, 2, -1, 1.0, "yes", None, float("nan")])
def test_only_true_and_false_are_taken(precision, tight):
    for ask in (gjk.distance, gjk.intersect, gjk.penetration):
        with pytest.raises(gjk.BadArgument, match="^option tight is True or False"):
            ask(gjk.Sphere(1), gjk.Sphere(1), precision=precision, tight=tight)

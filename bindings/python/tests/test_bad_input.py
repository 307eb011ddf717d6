# SPDX-License-Identifier: MIT
"""Numbers that no set can have are refused by name, in both precisions, never answered."""

from __future__ import annotations

import array
import decimal
import math
from fractions import Fraction

import numpy as np
import pytest

import gjk

NAN, INF = math.nan, math.inf
POSE = (1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0)
precisions = pytest.mark.parametrize("precision", ["double", "float"])


def broken_pose(bad):
    return [bad if i == 5 else c for i, c in enumerate(POSE)]


BAD = [
    (gjk.BadArgument, r"pose\[5\] is nan", lambda: gjk.Box((1, 1, 1), pose=broken_pose(NAN))),
    (gjk.BadArgument, r"pose\[5\] is inf", lambda: gjk.Sphere(1, pose=broken_pose(INF))),
    (gjk.BadArgument, r"radius is nan", lambda: gjk.Box((1, 1, 1), radius=NAN)),
    (gjk.BadArgument, r"radius is inf", lambda: gjk.Sphere(INF)),
    (gjk.BadArgument, r"radius is -1", lambda: gjk.Capsule(-1, 1)),
    (gjk.BadSupport, r"half\[1\] is -2", lambda: gjk.Box((1, -2, 1))),
    (gjk.BadSupport, r"half\[2\] is nan", lambda: gjk.Box((1, 1, NAN))),
    (gjk.BadSupport, r"half_length is -1", lambda: gjk.Capsule(1, -1)),
    (gjk.BadSupport, r"half_length is inf", lambda: gjk.Capsule(1, INF)),
    (gjk.BadSupport, r"r is -1", lambda: gjk.Ball(-1)),
    (gjk.BadSupport, r"r is nan", lambda: gjk.Disc(NAN)),
    (gjk.BadSupport, r"r is inf", lambda: gjk.Cylinder(INF, 1)),
    (gjk.BadSupport, r"half_length is -1", lambda: gjk.Cone(1, -1)),
    (gjk.BadSupport, r"radii\[0\] is -1", lambda: gjk.Ellipsoid((-1, 1, 1))),
    (gjk.BadSupport, r"radii\[1\] is nan", lambda: gjk.Ellipsoid((1, NAN, 1))),
    (gjk.BadSupport, r"no points", lambda: gjk.Points([], dim=3)),
    (gjk.BadSupport, r"points\[1\]\[0\] is nan", lambda: gjk.Points([(0, 0, 0), (NAN, 0, 0)])),
    (gjk.BadSupport, r"points\[1\]\[0\] is nan", lambda: gjk.Points([(0, 0, 0), (NAN, 0, 0)], indexed=True)),
    (gjk.BadSupport, r"no points", lambda: gjk.Points([], dim=3, indexed=True)),
    (gjk.BadSupport, r"points\[0\]\[2\] is -inf", lambda: gjk.Points([(0, 0, -INF), (0, 0, 0)])),
    (gjk.BadSupport, r"v\[1\]\[1\] is nan", lambda: gjk.Segment([(0, 0, 0), (1, NAN, 1)])),
    (gjk.BadSupport, r"v\[2\]\[0\] is inf", lambda: gjk.Triangle([(0, 0, 0), (1, 1, 1), (INF, 0, 0)])),
    (gjk.Error, r"b: half\[0\] is -1", lambda: gjk.Sum(gjk.Sphere(1), gjk.Box((-1, 1, 1)))),
    (gjk.Error, r"a: r is nan", lambda: gjk.Hull(gjk.Ball(NAN), gjk.Sphere(1))),
]


@precisions
@pytest.mark.parametrize(("kind", "words", "make"), BAD, ids=[words for _, words, _ in BAD])
def test_bad_shapes(precision, kind, words, make):
    good = gjk.Box((1, 1, 1), pose=POSE)
    for ask in (gjk.distance, gjk.intersect, gjk.penetration):
        with pytest.raises(kind, match=words) as wrong:
            ask(make(), good, precision=precision)
        assert wrong.value.status < 0
        with pytest.raises(kind, match=f"^b: .*{words}"):
            ask(good, make(), precision=precision)


@precisions
@pytest.mark.parametrize("option", ["cutoff", "abs_tol", "rel_tol", "slack"])
@pytest.mark.parametrize("number", [NAN, INF, -INF, -1.0, "1", None])
def test_bad_options(precision, option, number):
    for ask in (gjk.distance, gjk.penetration):
        with pytest.raises(gjk.BadArgument, match="option"):
            ask(gjk.Sphere(1), gjk.Sphere(1), precision=precision, **{option: number})


@pytest.mark.parametrize("steps", [-1, 2**32, 1.5, "3"])
def test_bad_step_limits(steps):
    for ask in (gjk.distance, gjk.penetration):
        with pytest.raises(gjk.BadArgument, match="option"):
            ask(gjk.Sphere(1), gjk.Sphere(1), max_steps=steps)


@precisions
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("corners", [7, 16001, 0, -1, 2**32 + 64, 64.0, NAN, "64", None, True, [64]])
def test_bad_numbers_of_corners(precision, dim, corners):
    words = "^option corners is a whole number from 8 to 16000, not "
    with pytest.raises(ValueError, match=words) as wrong:
        gjk.penetration(gjk.Sphere(1, dim=dim), gjk.Sphere(1, dim=dim), precision=precision, corners=corners)
    assert wrong.value.status is gjk.Status.BAD_ARGUMENT


@pytest.mark.parametrize("precision", ["half", None, 2, [], np.timedelta64(1)])
def test_bad_precision(precision):
    with pytest.raises(gjk.BadArgument, match="precision"):
        gjk.distance(gjk.Sphere(1), gjk.Sphere(1), precision=precision)


@pytest.mark.parametrize("thing", [3, None, "box", (1, 1, 1), np.ones(3), gjk.Sphere])
def test_what_is_no_shape(thing):
    for ask in (gjk.distance, gjk.intersect, gjk.penetration):
        with pytest.raises(gjk.BadArgument, match=f"^a: a shape is expected, not {type(thing).__name__}$"):
            ask(thing, gjk.Sphere(1))
        with pytest.raises(gjk.BadArgument, match=f"^b: a shape is expected, not {type(thing).__name__}$"):
            ask(gjk.Sphere(1), thing)


@pytest.mark.parametrize("cache", [{}, 3, False, gjk.Cache])
def test_what_is_no_cache(cache):
    for ask in (gjk.distance, gjk.intersect, gjk.penetration):
        with pytest.raises(gjk.BadArgument, match=f"^cache: a Cache is expected, not {type(cache).__name__}$"):
            ask(gjk.Sphere(1), gjk.Sphere(1), cache=cache)


@pytest.mark.parametrize("dim", [3.0, 2.7, 1, 4, "3", True, None, [3]])
def test_what_is_no_dimension(dim):
    for make in (lambda: gjk.Support(tuple, dim), lambda: gjk.Sphere(1, dim=dim), lambda: gjk.Points([], dim=dim)):
        with pytest.raises(gjk.BadArgument, match="dim"):
            make()


def test_dimensions_must_agree():
    with pytest.raises(gjk.BadArgument, match="dimensions"):
        gjk.distance(gjk.Sphere(1), gjk.Sphere(1, dim=2))


def test_what_overflows_a_float_is_refused_there_alone():
    box = gjk.Box((1e300, 1, 1))
    result = gjk.distance(box, gjk.Sphere(1).at((0, 5, 0)))
    assert result.lower <= 3 <= result.upper
    with pytest.raises(gjk.Error, match="range"):
        gjk.distance(box, gjk.Sphere(1), precision="float")


def test_flat_poses_are_legal():
    flat = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 3)
    assert gjk.distance(gjk.Box((1, 1, 1), pose=flat), gjk.Box((1, 1, 1))).value == 2
    assert gjk.distance(gjk.Box((1, 1, 1), pose=[0] * 12), gjk.Sphere(1).at((0, 0, 3))).value == 2


@pytest.mark.parametrize(
    ("words", "options"),
    [
        (r"^option max_steps is 5\.0: ", {"max_steps": 5.0}),
        (r"^option max_steps is -1: ", {"max_steps": -1}),
        (r"^option max_steps is True: ", {"max_steps": True}),
        (r"^option abs_tol is None: ", {"abs_tol": None}),
        (r"^option slack is 'much': ", {"slack": "much"}),
        (r"^option rel_tol is -1: negative, not finite", {"rel_tol": -1}),
        (r"^option cutoff is inf: negative, not finite", {"cutoff": INF}),
    ],
)
def test_bad_options_are_named(words, options):
    with pytest.raises(gjk.BadArgument, match=words):
        gjk.distance(gjk.Box((1, 1, 1)), gjk.Sphere(1), **options)


def test_what_is_out_of_range_in_float_is_named():
    box, ball = gjk.Box((1, 1, 1)), gjk.Sphere(1).at((9, 0, 0))
    with pytest.raises(gjk.BadArgument, match="^option abs_tol is 1e.300: .*range of this precision"):
        gjk.distance(box, ball, abs_tol=1e300, precision="float")
    with pytest.raises(gjk.BadArgument, match="^b: radius is 1e.39, out of the range of this precision"):
        gjk.distance(box, ball.rounded(1e39), precision="float")
    assert gjk.distance(box, ball, abs_tol=1e300).upper >= 7


@pytest.mark.parametrize(
    "points",
    [
        np.ma.masked_array(np.eye(3), mask=np.eye(3) > 0),
        np.eye(3) * 1j,
        [[1, 2, 3j]],
        np.eye(3) > 0,
        np.ones((2, 2, 3)),
    ],
    ids=["masked", "complex", "a complex number", "truth values", "three axes"],
)
def test_what_numpy_has_and_is_no_table_of_numbers(points):
    with pytest.raises(gjk.BadArgument, match="^points: "):
        gjk.Points(points)


def test_a_mask_that_hides_nothing():
    assert gjk.Points(np.ma.masked_array(np.eye(3), mask=False)) == gjk.Points(np.eye(3))


HUGE = 10**5000  # has more digits than Python likes to print


def kind_of(x):
    return type(x).__name__


def released():
    view = memoryview(array.array("d", [1, 2, 3]))
    view.release()
    return view


@pytest.mark.parametrize(
    "make",
    [
        lambda: gjk.Box((HUGE, 1, 1)),
        lambda: gjk.Sphere(1, dim=HUGE),
        lambda: gjk.Points(HUGE),
        lambda: gjk.Points([(1, 2, 3)], dim=HUGE),
        lambda: gjk.Points([(1, 2, 3)], dim=np.array([3, 3])),
        lambda: gjk.Points([(1, 2, 3)], indexed=np.array([1, 2])),
        lambda: gjk.Points([(1, 2, 3)], indexed="no"),
        lambda: gjk.Support(HUGE),
        lambda: gjk.Sphere(1, pose=HUGE),
        lambda: gjk.Sphere(np.array([1.0])),
        lambda: gjk.Sphere(np.array([1.0, 2.0])),
        lambda: gjk.Sphere(np.ma.masked),
        lambda: gjk.Sphere(np.complex128(1)),
        lambda: gjk.Sphere(np.complex64(1)),
        lambda: gjk.Sphere(decimal.Decimal("sNaN")),
        lambda: gjk.Box([np.ma.masked, 1, 1]),
        lambda: gjk.Box(np.ones(3, complex)),
        lambda: gjk.Box(np.ones(3, "m8[s]")),
        lambda: gjk.Box(np.array([b"abc"], "V3")),
        lambda: gjk.Box(released()),
        lambda: gjk.Shape(3, None, 0),
        lambda: gjk.Box((1, 1, 1), radius=1).rounded(-0.5),
        lambda: gjk.Sphere(1).rounded(-2),
    ],
)
def test_what_no_shape_is_made_of(make):
    with pytest.raises(gjk.BadArgument) as wrong:
        make()
    assert len(str(wrong.value)) < 300
    assert "\n" not in str(wrong.value)


class Speechless:
    def __repr__(self):
        raise RuntimeError


@precisions
@pytest.mark.parametrize(
    "number",
    [HUGE, 10**400, True, False, np.True_, 1j, np.complex128(1), np.ones(1), np.ones(2), [1], {}, b"1", Speechless()]
    + [decimal.Decimal(text) for text in ("NaN", "sNaN", "-1", "Infinity")]
    + [Fraction(-1, 10), np.float64("nan")],
    ids=kind_of,
)
def test_what_is_no_length(precision, number):
    for option in ("cutoff", "abs_tol", "rel_tol", "slack"):
        with pytest.raises(gjk.BadArgument, match=f"^option {option} is "):
            gjk.penetration(gjk.Sphere(1), gjk.Sphere(1), precision=precision, **{option: number})


@pytest.mark.parametrize(
    "number",
    [HUGE, Fraction(65, 2), Fraction(64), decimal.Decimal("64.5"), np.float64(64), np.ones(2)],
    ids=kind_of,
)
def test_what_is_no_count(number):
    for option in ("max_steps", "corners"):
        with pytest.raises(gjk.BadArgument, match=f"^option {option} is "):
            gjk.penetration(gjk.Sphere(1), gjk.Sphere(1), **{option: number})


@pytest.mark.parametrize("thing", [HUGE, Speechless(), np.array([True, False]), np.True_], ids=kind_of)
def test_what_is_neither_true_nor_false_nor_a_precision(thing):
    for option, words in (("tight", "^option tight is True or False"), ("precision", "^precision is")):
        with pytest.raises(gjk.BadArgument, match=words):
            gjk.distance(gjk.Sphere(1), gjk.Sphere(1), **{option: thing})


def test_numbers_of_all_kinds():
    one, far = gjk.Box((1, 1, 1)), gjk.Box((1, Fraction(1), decimal.Decimal(1))).at((4, 0.5, np.float32(0.25)))
    for tenth in (0.1, Fraction(1, 10), decimal.Decimal("0.1"), np.float64(0.1), np.array(0.1)):
        loose = gjk.distance(one, far, abs_tol=tenth, cutoff=tenth, max_steps=np.int8(9))
        assert loose == gjk.distance(one, far, abs_tol=0.1, cutoff=0.1, max_steps=9)


def test_a_cutoff_that_float_has_not():
    """It would be 0, which is none."""
    one, far = gjk.Box((1, 1, 1)), gjk.Box((1, 1, 1)).at((4, 0, 0))
    assert gjk.distance(one, far, cutoff=1e-60).status is gjk.Status.DECIDED
    assert gjk.distance(one, far, cutoff=1e-45, precision="float").status is gjk.Status.DECIDED
    for ask in (gjk.distance, gjk.penetration):
        with pytest.raises(gjk.BadArgument, match="^option cutoff is 1e-60: 0 in this precision"):
            ask(one, far, cutoff=1e-60, precision="float")

# SPDX-License-Identifier: MIT
"""How deep: the signed separation against the exact one, and against closed forms."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pairs import UNIT, coordinate, inside, lattice, length, pairs, prepared, sharp_pairs, size, turns

import gjk
from gjk import Status, exact
from gjk.cases import shape_from_json

precisions = pytest.mark.parametrize("precision", ["double", "float"])
dims = pytest.mark.parametrize("dim", [2, 3])
settings.register_profile("depth", settings.get_profile("gjk"), max_examples=75)  # the exact depth takes its time
few = settings.get_profile("depth")


@st.composite
def bodies(draw, dim):
    """A box or a hull, turned, not far from the origin."""
    near = st.lists(lattice | st.floats(-1, 1, width=32), min_size=dim, max_size=dim)
    if draw(st.booleans()):
        shape = {"shape": "box", "half": draw(st.lists(size.filter(bool), min_size=dim, max_size=dim))}
    else:
        point = st.lists(coordinate, min_size=dim, max_size=dim)
        shape = {"shape": "points", "points": draw(st.lists(point, min_size=dim + 1, max_size=12))}
    m, p = draw(turns(dim)), draw(near)
    return {**shape, "pose": [c for i in range(dim) for c in (*m[i * dim : (i + 1) * dim], p[i])]}


@st.composite
def deep_pairs(draw):
    dim = draw(st.sampled_from([2, 3]))
    return dim, draw(bodies(dim)), draw(bodies(dim))


LEAST = {"double": Fraction(1, 2**1022), "float": Fraction(1, 2**126)}


def in_length(times, scale, precision):
    """So many u * scale; where that is nothing, the least normal number."""
    return times * UNIT[precision] * scale + LEAST[precision]


def holds(result, truth):
    """Whether the bracket holds the signed separation, or what is known of it."""
    lower, upper = truth.separation or (None, truth.upper)
    return inside(result) and result.lower <= upper and (lower is None or lower <= result.upper)


def scale_of(truth, *shapes):
    """The largest |coordinate| of the two bodies, and of their own origins, seen from a point between them."""
    middle = [(p + q) / 2 for p, q in zip(truth.point_a, truth.point_b)]
    origins = [(shape.pose or (0.0,) * shape.dim * (shape.dim + 1))[shape.dim :: shape.dim + 1] for shape in shapes]
    return max(truth.scale, *(abs(Fraction(p) - m) for origin in origins for p, m in zip(origin, middle)))


def check(result, a, b, truth, precision):
    """What is promised of shapes whose corners are known."""
    scale = scale_of(truth, a, b)
    lower, upper = truth.separation
    assert holds(result, truth)
    assert abs(Fraction(result.value) - (lower + upper) / 2) <= in_length(4, scale, precision)
    if truth.depth_squared is not None:  # the cores meet
        width = Fraction(result.upper) - Fraction(result.lower)
        assert width <= in_length(16, scale + Fraction(a.radius) + Fraction(b.radius), precision)


@precisions
@few
@given(pair=deep_pairs())
def test_the_depth_of_boxes_and_hulls(precision, pair):
    a, b, truth = prepared(pair, precision)
    result = gjk.penetration(a, b, precision=precision)
    check(result, a, b, truth, precision)
    assert result.status in (Status.OK, Status.LIMIT)  # where no more room is, there may yet be none needed
    assert abs(length(result.normal) - 1) <= 8 * float(UNIT[precision])


@precisions
@few
@given(pair=sharp_pairs(), tight=st.booleans())
def test_all_shapes_with_corners(precision, pair, tight):
    """Flat and crooked ones too, and balls about them."""
    a, b, truth = prepared(pair, precision)
    check(gjk.penetration(a, b, precision=precision, tight=tight), a, b, truth, precision)


@precisions
@few
@given(pair=deep_pairs(), steps=st.integers(1, 8), corners=st.integers(8, 24))
def test_a_query_that_stops_early_holds_the_truth(precision, pair, steps, corners):
    a, b, truth = prepared(pair, precision)
    cache = gjk.Cache()
    for options in (
        {"max_steps": steps},
        {"corners": corners},
        {"cutoff": 0.5},
        {"slack": 0.25},
        {"abs_tol": 0.25},
        {},
    ):
        result = gjk.penetration(a, b, precision=precision, cache=cache, **options)
        assert holds(result, truth)
        assert result.steps <= options.get("max_steps", 256)
        if result.status is Status.OK and "abs_tol" in options:
            assert result.upper - result.lower <= 0.25
    check(result, a, b, truth, precision)  # warm


@precisions
@few
@given(pair=pairs(), corners=st.sampled_from([8, 64, 200]))
def test_every_shape(precision, pair, corners):
    """Of round shapes that overlap the truth is known by its bounds alone: any plane gives one."""
    dim, *shapes = pair
    a, b, truth = prepared(pair, precision)
    result = gjk.penetration(a, b, precision=precision, corners=corners)
    assert holds(result, truth)
    if precision == "float":
        shapes = [exact.round_to_float(shape) for shape in shapes]
    known = exact.Pair(*shapes, dim)
    room = 64 * UNIT[precision] * (truth.scale + max(abs(Fraction(x)) for x in (*result.point_a, *result.point_b)))
    axes = [[float(i == j) for j in range(dim)] for i in range(dim)]
    for normal in (result.normal, *axes):
        low, high = height(known, normal)
        assert low <= result.upper
        if normal is result.normal:
            assert result.lower <= high + room


def height(pair, normal):
    """A bracket of the separation along a direction: how far the nearest of b is beyond the farthest of a."""
    d, e = exact.to_grid(normal)
    (w, _, _), least = pair.farthest(tuple(d))
    along, radii = exact.root(Fraction(exact.dot(d, d)), True), pair.ra + pair.rb
    grid = Fraction(1, 1 << pair.grid)
    return (Fraction(least) / along - radii) * grid, (Fraction(exact.dot(d, w)) / along - radii) * grid


@precisions
@few
@given(pair=pairs())
def test_apart_it_is_the_distance(precision, pair):
    a, b, _ = prepared(pair, precision)
    far = gjk.distance(a, b, precision=precision)
    result = gjk.penetration(a, b, precision=precision)
    assert max(far.lower, result.lower) <= min(far.upper, max(result.upper, 0))
    if far.lower > 0:
        assert result.value == far.value
        assert result.point_a == pytest.approx(far.point_a, rel=1e-6, abs=1e-6)
        assert result.point_b == pytest.approx(far.point_b, rel=1e-6, abs=1e-6)


@precisions
@few
@given(pair=deep_pairs())
def test_the_move_out(precision, pair):
    """Moving b by -value * normal makes them touch, to the rounding of the move."""
    dim, a, b = pair
    shape_a, shape_b, truth = prepared(pair, precision)
    result = gjk.penetration(shape_a, shape_b, precision=precision)
    pose = list(b["pose"])
    for i in range(dim):
        pose[i * (dim + 1) + dim] -= result.value * result.normal[i]
    _, _, moved = prepared((dim, a, {**b, "pose": pose}), precision)
    far = truth.scale + max(abs(Fraction(pose[i * (dim + 1) + dim])) for i in range(dim))
    assert max(map(abs, moved.separation)) <= in_length(16, far, precision)


@precisions
@few
@given(pair=deep_pairs())
def test_the_points_are_those_deepest_in_the_other(precision, pair):
    dim, _, _ = pair
    a, b, truth = prepared(pair, precision)
    result = gjk.penetration(a, b, precision=precision)
    far = float(truth.scale) + max(abs(c) for c in (*result.point_a, *result.point_b))
    room = 64 * float(UNIT[precision]) * far
    for shape, point in ((a, result.point_a), (b, result.point_b)):
        assert gjk.distance(shape, gjk.Sphere(0, dim=dim).at(point)).lower <= room
    if result.upper < 0:
        way = [p - q + result.value * n for p, q, n in zip(result.point_a, result.point_b, result.normal)]
        assert length(way) <= room


SIDE = {2: ((1.0, 0.0), (0.0, 1.0)), 3: ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))}


@precisions
@dims
@few
@given(data=st.data())
def test_two_spheres(precision, dim, data):
    """3, 4, 5: the distance of the centres is a whole number, or 0."""
    r, s = data.draw(size), data.draw(size)
    way = data.draw(st.sampled_from([(0, 0), (3, 4), (-4, 3), (0, -5)]))
    centre = [*way, 0][:dim]
    result = gjk.penetration(gjk.Sphere(r, dim=dim), gjk.Sphere(s, dim=dim).at(centre), precision=precision)
    truth = (5 if any(way) else 0) - Fraction(r) - Fraction(s)
    assert result.lower <= truth <= result.upper
    assert inside(result)
    assert abs(Fraction(result.value) - truth) <= in_length(4, 5 + Fraction(r) + Fraction(s), precision)
    assert abs(length(result.normal) - 1) <= 8 * float(UNIT[precision])


@precisions
@dims
@few
@given(data=st.data())
def test_crossed_capsules(precision, dim, data):
    """In space their difference is flat, and the way out is across it; in the plane it is a rectangle."""
    (r, h), (s, k) = [(data.draw(size), data.draw(size)) for _ in range(2)]
    turn = [0, 1, 0, -1, 0, 0] if dim == 2 else [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0]
    a, b = gjk.Capsule(r, h, dim=dim), gjk.Capsule(s, k, dim=dim, pose=turn)
    result = gjk.penetration(a, b, precision=precision)
    truth = -Fraction(r) - Fraction(s) - (min(Fraction(h), Fraction(k)) if dim == 2 else 0)
    assert result.lower <= truth <= result.upper
    assert abs(Fraction(result.value) - truth) <= in_length(4, Fraction(h) + Fraction(k) - truth, precision)


@precisions
@dims
def test_a_ball_and_a_box(precision, dim):
    for depth in (0.0, 0.25, 0.75, 1.0, 1.5):
        for axis in SIDE[dim]:
            ball = gjk.Sphere(0.5, dim=dim).at([(1.5 - depth) * c for c in axis])
            result = gjk.penetration(gjk.Box([1.0] * dim), ball, precision=precision)
            assert result.value == -depth
            if depth < 1.5:
                assert result.normal == axis


@precisions
@pytest.mark.parametrize(
    ("a", "b", "depth"),
    [
        (gjk.Ball(1), gjk.Ball(2), 3),
        (gjk.Ball(1), gjk.Ball(2).at((1, 0, 0)), 2),
        (gjk.Ball(1), gjk.Sphere(2).at((0, 1, 0)), 2),
        (gjk.Box((3, 3, 3)), gjk.Cylinder(1, 2), 4),
        (gjk.Cylinder(2, 1), gjk.Cylinder(1, 0.5), 1.5),
        (gjk.Disc(1), gjk.Disc(2), 0),
        (gjk.Ellipsoid((1, 2, 3)), gjk.Ellipsoid((2, 1, 3)), 3),
        (gjk.Ball(1, dim=2), gjk.Box((2, 3)), 3),
    ],
)
def test_round_shapes(precision, a, b, depth):
    # In float the workspace is lent to the sister in double, whose corners take more room.
    corners = 2000 if precision == "double" else 3400
    result = gjk.penetration(a, b, precision=precision, corners=corners, max_steps=5000)
    assert result.lower <= -depth <= result.upper
    assert inside(result)
    assert result.upper - result.lower < 0.01  # of balls about one centre no direction is the best


LEMON, MELON = gjk.Ellipsoid((1, 2, 3)), gjk.Ellipsoid((2, 1, 1.5)).at((0.3, 0.2, 0.1))


@precisions
def test_more_corners_no_wider_a_bracket(precision):
    a, b = gjk.Ellipsoid((1, 2, 3)), gjk.Cone(2, 1).at((0.3, 0.2, 0.1))
    asked = [gjk.penetration(a, b, precision=precision, corners=n, max_steps=1000) for n in (8, 16, 32, 64, 300)]
    widths = [result.upper - result.lower for result in asked]
    assert widths == sorted(widths, reverse=True)
    assert max(result.lower for result in asked) <= min(result.upper for result in asked)
    if precision == "double":
        assert widths[0] > 1e6 * widths[4]
        assert asked[0].status is Status.LIMIT
    else:
        assert asked[0] == asked[3]  # float's sister in double has room for 64 of her own
    assert widths[4] < (1e-13 if precision == "double" else 2e-6)


@precisions
def test_room_to_spare_changes_nothing(precision):
    asked = [gjk.penetration(LEMON, MELON, precision=precision, corners=n, max_steps=999) for n in (300, 301, 16000)]
    assert asked[0] == asked[1] == asked[2]
    box = gjk.Box((1, 1, 1))
    asked = [gjk.penetration(box, box.at((1, 0.5, 0)), precision=precision, corners=n) for n in (64, 65, 16000)]
    assert asked[0] == asked[1] == asked[2]


@precisions
@few
@given(pair=deep_pairs(), moves=st.lists(st.lists(lattice, min_size=3, max_size=3), min_size=1, max_size=4))
def test_warm_and_cold_agree(precision, pair, moves):
    dim, _, _ = pair
    a, b, _ = prepared(pair, precision)
    cache = gjk.Cache()
    for move in moves:
        there = b.at([c / 16 for c in move[:dim]])
        warm = gjk.penetration(a, there, precision=precision, cache=cache)
        cold = gjk.penetration(a, there, precision=precision)
        assert max(warm.lower, cold.lower) <= min(warm.upper, cold.upper)
        gjk.distance(a, there, precision=precision, cache=cache)  # one cache for all questions


def test_a_support_in_python():
    def ball(direction):
        far = length(direction)
        return [2 * c / far for c in direction]

    def broken(direction):
        raise KeyError("oops")

    result = gjk.penetration(gjk.Support(ball, 3, reach=2), gjk.Box((1, 1, 1)), corners=500, max_steps=1000)
    assert result.lower <= -3 <= result.upper
    assert result.upper - result.lower < 1e-6
    with pytest.raises(KeyError, match="oops"):
        gjk.penetration(gjk.Support(broken, 3), gjk.Box((1, 1, 1)))


@dims
def test_equal_bodies_in_one_place(dim):
    box = shape_from_json({"shape": "box", "half": [1.0, 2.0, 3.0][:dim]}, dim)
    result = gjk.penetration(box, box)
    assert result.lower <= -2 <= result.upper
    assert result.value == -2
    assert result.normal[1:] == (0.0,) * (dim - 1)

# SPDX-License-Identifier: MIT
"""The oracle, against closed forms, laws, brute force over all simplices, and lies."""

import dataclasses
import doctest
import importlib
import json
import random
import re
import subprocess
import sys
from fractions import Fraction
from itertools import combinations, product
from math import gcd

import cases_to_c
import depth
import draw
import proof
import pytest
import write_cases
from alone import ROOT, exact

CASES = [json.loads(line) for path in sorted((ROOT / "tests/cases").glob("*.jsonl")) for line in path.open()]


def at(*p):
    dim = len(p)
    return [x for i in range(dim) for x in [int(i == j) for j in range(dim)] + [p[i]]]


def box(*half, p=None):
    return {"shape": "box", "half": list(half), "pose": at(*(p or [0] * len(half)))}


def sphere(r, *p):
    return {"shape": "sphere", "r": r, "pose": at(*p)}


def points(*found, **more):
    return {"shape": "points", "points": list(found), **more}


def solve(a, b, dim):
    truth = exact.distance(a, b, dim)
    proof.prove(truth, a, b, dim)
    return truth


def rounded_inputs(case):
    a, b = case["a"], case["b"]
    return (exact.round_to_float(a), exact.round_to_float(b)) if case["precision"] == "float" else (a, b)


# ---- closed forms


@pytest.mark.parametrize("dim", (2, 3))
@pytest.mark.parametrize("seed", range(60))
def test_aligned_boxes(dim, seed):
    d = draw.Draw(f"aligned {seed}", dim, "double")
    half_a, half_b = d.box()["half"], d.box()["half"]
    p = [d.coordinate(1.5) for _ in range(dim)]
    gaps = [abs(Fraction(x)) - Fraction(h) - Fraction(k) for x, h, k in zip(p, half_a, half_b)]
    truth = solve(box(*half_a), box(*half_b, p=p), dim)
    assert truth.core_squared == sum(max(g, 0) ** 2 for g in gaps)
    widest = max(gaps)
    assert truth.relation == ("apart" if widest > 0 else "touching" if widest == 0 else "overlapping")
    assert truth.depth_squared == (None if widest > 0 else widest**2)
    if widest <= 0:
        assert truth.separation[0] <= widest <= truth.separation[1]
        axis = [abs(c) for c in exact.reduced(truth.direction, 0)[0]]
        assert sorted(axis) == [0] * (dim - 1) + [1] and gaps[axis.index(1)] == widest


@pytest.mark.parametrize("dim", (2, 3))
@pytest.mark.parametrize("seed", range(40))
def test_spheres(dim, seed):
    d = draw.Draw(f"spheres {seed}", dim, "double")
    p, q, r, s = d.point(), d.point(), d.uniform(0, 0.6), d.uniform(0, 0.6)
    square = sum((Fraction(x) - Fraction(y)) ** 2 for x, y in zip(p, q))
    radii = Fraction(r) + Fraction(s)
    truth = solve(sphere(r, *p), sphere(s, *q), dim)
    assert truth.core_squared == square
    assert (truth.relation == "apart") == (square > radii**2)
    low, high = truth.separation
    assert max(low + radii, 0) ** 2 <= square <= (high + radii) ** 2
    assert high - low < Fraction(1, 10**38)


def test_spheres_touch_exactly():
    assert solve(sphere(2, 0, 0), sphere(3, 3, 4), 2).relation == "touching"
    assert solve(sphere(2, 0, 0), sphere(3 + 2**-51, 3, 4), 2).relation == "overlapping"
    assert solve(sphere(2, 0, 0), sphere(3 - 2**-51, 3, 4), 2).relation == "apart"


@pytest.mark.parametrize(
    "a, b, distance",
    [
        ({"shape": "cylinder", "r": 0.5, "half_length": 1}, box(1, 1, 1, p=[0, 0, 2.5]), 0.5),
        ({"shape": "cylinder", "r": 0.5, "half_length": 1}, points([3, 4, 0.25]), 4.5),
        ({"shape": "cone", "r": 1, "half_length": 1}, points([0, 0, 3]), 2),
        ({"shape": "cone", "r": 1, "half_length": 1}, points([-3, -4, -1]), 4),
        ({"shape": "cone", "r": 1.5, "half_length": 1}, points([0, 2.75, 1.5]), 2.5),
        ({"shape": "disc", "r": 2}, points([6, 8, 0]), 8),
        ({"shape": "disc", "r": 2}, points([1, 1, -3]), 3),
        ({"shape": "ellipsoid", "radii": [1, 2, 3]}, points([0, 0, 5]), 2),
        ({"shape": "ellipsoid", "radii": [1, 1, 1], "pose": at(1, 2, 3)}, points([1, 5, 7]), 4),
        ({"shape": "ball", "r": 1, "pose": [3, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3]}, points([6, 2, 3]), 2),
    ],
)
def test_round_shapes(a, b, distance):
    truth = solve(a, b, 3)
    assert truth.lower <= distance <= truth.upper
    assert truth.upper - truth.lower < Fraction(1, 10**28)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("radius", [0, 0.125])
def test_deep_inside_a_ball(dim, radius):
    """The first two support points lie on a line through the centre: their segment passes by 0 by less than the gap."""
    draw = random.Random(5)
    ball = {"shape": "ellipsoid", "radii": [1] * dim}
    for _ in range(50):
        inner = {"shape": "points", "points": [[draw.uniform(-0.5, 0.5) for _ in range(dim)]], "radius": radius}
        truth = solve(inner, ball, dim)
        assert (truth.relation, truth.proven, truth.separation) == (exact.OVERLAPPING, True, None)
        assert truth.lower == truth.upper == 0


SEGMENTS = [{"shape": "segment", "v": v} for v in ([[-2, 0], [2, 0]], [[0, -1], [0, 1]])]
TRIANGLE = points([0, 0], [4, 0], [0, 3])


@pytest.mark.parametrize(
    "a, b, squared, direction",
    [
        (box(1, 1), box(2, 3, p=[2.5, 0.25]), Fraction(1, 4), (1, 0)),
        (box(1, 1, 1), box(1, 1, 1, p=[0.25, 0.5, -1.75]), Fraction(1, 16), (0, 0, -1)),
        (box(1, 2, 3), box(0.25, 0.25, 0.25, p=[0, 1.5, 0]), Fraction(9, 16), (0, 1, 0)),
        (box(1, 1, 1), box(1, 1, 1), 4, None),
        (box(1, 1, 1), points([0, 0.5, 0]), Fraction(1, 4), (0, 1, 0)),
        (box(1, 2, 3), points([1, 0, 0]), 0, (1, 0, 0)),
        (box(1, 1, 1), box(1, 1, 1, p=[2, 2, 2]), 0, None),
        (TRIANGLE, points([1, 1]), 1, None),
        (TRIANGLE, points([1.5, 1.25]), Fraction(1, 4), (3, 4)),
        (SEGMENTS[0], SEGMENTS[1], 1, None),
        (SEGMENTS[0], {"shape": "segment", "v": [[-1, -1], [1, 1]]}, 1, None),
        (SEGMENTS[0], SEGMENTS[0], 0, None),
        (points([1, 2]), points([1, 2]), 0, None),
        (points([1, 2, 3]), points([1, 2, 3]), 0, None),
        (points([-2, 0, 0], [2, 0, 0]), points([0, -1, 0], [0, 1, 0]), 0, None),
        (points([0, 0, 0], [4, 0, 0], [0, 4, 0]), points([1, 1, 0], [2, 1, 0], [1, 5, 0]), 0, None),
        (points([0, 0, 0], [4, 0, 0], [0, 4, 0]), points([1.25, 1.25, -1], [1.25, 1.25, 2]), 1, (0, 0, 1)),
        (points([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]), points([0.25, 0.25, 0.25]), Fraction(1, 48), (1, 1, 1)),
    ],
)
def test_depths(a, b, squared, direction):
    truth = solve(a, b, len(a.get("half") or (a.get("points") or a["v"])[0]))
    assert truth.depth_squared == squared
    assert direction is None or exact.reduced(truth.direction, 0)[0] == direction
    assert truth.relation == ("overlapping" if squared else "touching")
    assert truth.separation[0] ** 2 >= squared >= truth.separation[1] ** 2 and truth.separation[1] <= 0


def test_radii_add_to_the_depth():
    a, b = {**box(1, 1, 1), "radius": 0.5}, {**box(1, 1, 1, p=[1.5, 0, 0]), "radius": 0.25}
    truth = solve(a, b, 3)
    assert truth.separation == (Fraction(-5, 4), Fraction(-5, 4)) and truth.depth_squared == Fraction(1, 4)
    truth = solve(sphere(1, 1, 2, 3), sphere(2, 1, 2, 3), 3)
    assert truth.separation == (-3, -3) and truth.depth_squared == 0 and truth.relation == "overlapping"
    truth = solve(a, {**box(1, 1, 1, p=[2.5, 0, 0]), "radius": 0.25}, 3)
    assert truth.separation == (Fraction(-1, 4), Fraction(-1, 4)) and truth.depth_squared is None


def test_round_sets_have_no_depth():
    truth = solve({"shape": "disc", "r": 1}, box(1, 1, 1), 3)
    assert truth.depth_squared is truth.separation is truth.normal is None and truth.facets == ()


def signed(a, b, dim):
    truth = solve(a, b, dim)
    found = depth.separation(truth, a, b, dim)
    proof.prove_separation(found, truth, a, b, dim)
    return found


CYLINDER = {"shape": "cylinder", "r": 1, "half_length": 2}


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        (CYLINDER, box(1, 1, 0.5, p=[0, 0, 2.25]), Fraction(-1, 4)),
        (CYLINDER, box(1, 3, 3, p=[1.75, 0, 0]), Fraction(-1, 4)),
        ({**CYLINDER, "radius": 0.5}, box(1, 3, 3, p=[1.75, 0, 0]), Fraction(-3, 4)),
        ({"shape": "ellipsoid", "radii": [4, 2, 1]}, points([0, 0, 0.25]), Fraction(-3, 4)),
        ({"shape": "ellipsoid", "radii": [4, 2, 1]}, {"shape": "disc", "r": 1}, Fraction(-1)),
        (
            {"shape": "ellipsoid", "radii": [2, 2, 2]},
            {"shape": "ellipsoid", "radii": [1, 1, 1], "pose": at(2, 1, 0)},
            None,
        ),
    ],
)
def test_round_depths(a, b, expected):
    found = signed(a, b, 3)
    if expected is None:  # of balls: the way between their middles, less both radii
        assert (found.lower + 3) ** 2 <= 5 <= (found.upper + 3) ** 2
    else:
        assert found.lower <= expected <= found.upper
    assert found.upper - found.lower <= Fraction(1, 10**23)


def test_round_depth_without_one_way_out():
    """Any way across is as good: the bracket holds, but it closes slowly."""
    found = signed(CYLINDER, {"shape": "cone", "r": 0.5, "half_length": 1.75}, 3)
    assert found.lower <= -Fraction(3, 2) <= found.upper < found.lower + Fraction(1, 1000)
    assert len(found.corners) == depth.MOST_CORNERS


def test_separations_of_the_rest():
    apart, touching = sphere(1, 3, 0, 0), box(1, 1, 1, p=[2, 0, 0])
    assert signed(box(1, 1, 1), apart, 3).lower == signed(box(1, 1, 1), apart, 3).upper == 1
    assert signed(box(1, 1, 1), touching, 3).lower == signed(CYLINDER, touching, 3).upper == 0
    assert signed(CYLINDER, sphere(1, 1.5, 0, 0), 3).lower <= Fraction(-1, 2)  # outside the cylinder, the ball aside
    assert signed(box(1, 1, 1), box(1, 1, 1, p=[0.5, 0, 0]), 3).upper == -Fraction(3, 2)


def test_couples_of_polytopes_have_a_depth():
    rod = {"shape": "segment", "v": [[0, 0, -1], [0, 0, 1]]}
    square = {"shape": "box", "half": [1, 1, 0]}
    one = solve({"shape": "sum", "a": square, "b": rod}, box(1, 1, 1, p=[1.5, 0.25, 0]), 3)
    assert one.depth_squared == Fraction(1, 4)
    tent = {"shape": "hull", "a": square, "b": points([0, 0, 2]), "pose": at(0, 0, -1)}
    two = solve(tent, points([0, 0, 0]), 3)
    three = solve(points(*[[x, y, -1] for x in (-1, 1) for y in (-1, 1)], [0, 0, 1]), points([0, 0, 0]), 3)
    assert two.depth_squared == three.depth_squared == Fraction(1, 5)


def test_point_and_ellipse():
    """The foot of the normal at the angle with cosine 3/5: (3, 8/5) on x^2/25 + y^2/4 = 1, its normal (3/25, 2/5)."""
    t = 5
    p = [Fraction(3) + t * Fraction(3, 25), Fraction(8, 5) + t * Fraction(2, 5)]
    near = points([float(x) for x in p])
    off = sum(abs(Fraction(x) - y) for x, y in zip(near["points"][0], p))
    truth = solve({"shape": "ellipsoid", "radii": [5, 2]}, near, 2)
    square = t**2 * (Fraction(9, 625) + Fraction(4, 25))
    assert (truth.lower - off) ** 2 <= square <= (truth.upper + off) ** 2


def test_sheared_ball_is_its_ellipsoid():
    ball = {"shape": "ellipsoid", "radii": [1, 1, 1], "pose": [2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0.5, 0]}
    far = box(1, 1, 1, p=[4, 5, 6])
    one, two = solve(ball, far, 3), solve({"shape": "ellipsoid", "radii": [2, 3, 0.5]}, far, 3)
    assert one.lower <= two.upper and two.lower <= one.upper


def test_sum_and_hull():
    disc, rod = {"shape": "disc", "r": 0.75}, {"shape": "segment", "v": [[0, 0, -1], [0, 0, 1]]}
    far = box(1, 1, 1, p=[2, 3, 4])
    one = solve({"shape": "sum", "a": disc, "b": rod}, far, 3)
    two = solve({"shape": "cylinder", "r": 0.75, "half_length": 1}, far, 3)
    assert one.lower <= two.upper and two.lower <= one.upper
    tip = {**disc, "pose": at(0, 0, -1)}
    one = solve({"shape": "hull", "a": tip, "b": points([0, 0, 1])}, far, 3)
    two = solve({"shape": "cone", "r": 0.75, "half_length": 1}, far, 3)
    assert one.lower <= two.upper and two.lower <= one.upper


def test_couples_keep_their_places_once():
    """A sum's pose moves it once; its radii add up outside, where the pose lets them."""
    a = {"shape": "sum", "a": sphere(1, 1, 0), "b": box(1, 1), "pose": at(10, 0)}
    truth = solve(a, points([0, 0]), 2)
    assert truth.core_squared == 100 and truth.lower == 9
    hull = {"shape": "hull", "a": sphere(1, 0, 0), "b": sphere(1, 5, 0), "radius": 0.5}
    assert solve(hull, points([0, 4]), 2).lower == Fraction(5, 2)
    unlike = {"shape": "hull", "a": sphere(1, 0, 0), "b": sphere(2, 8, 0)}
    truth = solve(unlike, points([8, 5]), 2)
    assert truth.lower <= 3 <= truth.upper and truth.upper - truth.lower < Fraction(1, 10**28)
    stretched = {"shape": "sum", "a": sphere(1, 0, 0), "b": points([0, 0]), "pose": [2, 0, 0, 0, 3, 0]}
    truth = solve(stretched, points([0, 5]), 2)
    assert truth.lower <= 2 <= truth.upper


# ---- laws, in rationals

QUARTER = {2: [[0, -1], [1, 0]], 3: [[0, 0, 1], [-1, 0, 0], [0, 1, 0]]}
PYTHAGORAS = {2: [[3, -4], [4, 3]], 3: [[3, -4, 0], [4, 3, 0], [0, 0, 5]]}  # five times a rotation


def drawn_polytopes(seed, dim):
    d = draw.Draw(f"law {seed}", dim, "double")
    return [{**points(*(d.lattice(9) for _ in range(d.integer(1, 7)))), "radius": d.integer(0, 3)} for _ in (0, 1)]


def mapped(shape, m, p, factor=1):
    found = [[factor * (sum(r * x for r, x in zip(row, v)) + t) for row, t in zip(m, p)] for v in shape["points"]]
    return {**shape, "points": found}


@pytest.mark.parametrize("dim", (2, 3))
@pytest.mark.parametrize("seed", range(80))
def test_laws(dim, seed):
    a, b = drawn_polytopes(seed, dim)
    truth = solve(a, b, dim)
    square, relation = signed_square(truth), truth.relation
    p = [2**20 + 3, -7, 11][:dim]
    still = draw.identity(dim)

    def same(a, b, factor=1, radii=1):
        again = solve({**a, "radius": a["radius"] * radii}, {**b, "radius": b["radius"] * radii}, dim)
        assert signed_square(again) == square * factor and again.relation == relation

    same(b, a)
    same(mapped(a, QUARTER[dim], p), mapped(b, QUARTER[dim], p))
    same(mapped(a, PYTHAGORAS[dim], p), mapped(b, PYTHAGORAS[dim], p), 25, 5)
    same(mapped(a, still, [0] * dim, 0.125), mapped(b, still, [0] * dim, 0.125), Fraction(1, 64), 0.125)
    same({**a, "points": a["points"][::-1] + a["points"]}, b)
    turn = QUARTER[dim]
    pose = [x for row, t in zip(turn, p) for x in [*row, t]]
    same({**a, "pose": pose}, {**b, "pose": pose})
    grown = solve({**a, "radius": a["radius"] + 1}, {**b, "radius": b["radius"]}, dim)
    assert abs(grown.separation[0] + 1 - truth.separation[0]) < Fraction(1, 10**30)


def signed_square(truth):
    """Of the distance of the cores, or less that of their depth."""
    return truth.core_squared or -truth.depth_squared


@pytest.mark.parametrize("dim", (2, 3))
@pytest.mark.parametrize("seed", range(40))
def test_moved_by_its_depth_it_touches(dim, seed):
    """The depth times the normal is rational: direction, times its least product with w, over its square. Here it is
    made whole by that square, and a little more or less of it parts the sets or does not."""
    d = draw.Draw(f"moved {seed}", dim, "double")
    a, b = ([d.lattice(9) for _ in range(d.integer(dim, 8))] for _ in (0, 1))
    truth = solve(points(*a), points(*b), dim)
    if truth.core_squared:
        return
    d, factor = truth.direction, exact.dot(truth.direction, truth.direction)
    least = min(exact.dot(d, exact.minus(q, p)) for p, q in product(a, b))
    assert Fraction(least**2, factor) == truth.depth_squared
    large_a, large_b = ([[c * factor for c in p] for p in found] for found in (a, b))
    for more, relation in ((1, "apart"), (0, "touching"), (-1, "overlapping"))[: 3 if least else 2]:
        moved = [[x + (more - least) * c for x, c in zip(p, d)] for p in large_b]
        assert solve(points(*large_a), points(*moved), dim).relation == relation
    vector = [exact.root(truth.depth_squared, True) * c for c in truth.normal]
    assert all(abs(factor * x + least * c) < Fraction(1, 10**30) for x, c in zip(vector, d))


# ---- brute force: every simplex of every corral


def nearest_of_simplex(corner, others):
    """The point nearest to 0 of a simplex's affine hull by Gram-Schmidt, or None if it is outside or flat."""
    basis, v = [], list(corner)
    for w in others:
        e = [Fraction(x - y) for x, y in zip(w, corner)]
        for f in basis:
            c = proof.dot(e, f) / proof.dot(f, f)
            e = [x - c * y for x, y in zip(e, f)]
        if not any(e):
            return None
        basis.append(e)
    for f in basis:
        c = proof.dot(v, f) / proof.dot(f, f)
        v = [x - c * y for x, y in zip(v, f)]
    return v


def brute_force(a, b, dim):
    """The squared distance as the largest lower bound (h / |d|)^2 over the feet of 0 on all affine hulls of up to dim
    points: the true v is among them, and no direction proves more than the truth. 0 where none proves anything."""
    ws = {tuple(y - x for x, y in zip(p, q)) for p, q in product(a, b)}
    best = Fraction(0)
    for size in range(1, dim + 1):
        for corner, *others in combinations(sorted(ws), size):
            v = nearest_of_simplex(corner, others)
            if v is None or not any(v):
                continue
            h = min(proof.dot(v, w) for w in ws)
            if h > 0:
                best = max(best, h * h / proof.dot(v, v))
    return best


def normals(ws, dim):
    """Every direction that can support the hull of ws at a facet, or at all of a flat hull."""
    ws = sorted(ws)
    edges = {tuple(x - y for x, y in zip(p, q)) for p, q in product(ws, ws) if p != q}
    edges = {tuple(x // gcd(*e) for x in e) for e in edges}
    axes = [tuple(int(i == j) for j in range(dim)) for i in range(dim)]
    if dim == 2:
        return {(-y, x) for x, y in edges} | set(axes)
    return {
        (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
        for p, q in combinations(sorted(edges | set(axes)), 2)
    }


@pytest.mark.parametrize("dim", (2, 3))
@pytest.mark.parametrize("seed", range(120))
def test_brute_force(dim, seed):
    d = draw.Draw(f"brute {seed}", dim, "double")
    a, b = ([d.lattice(2) for _ in range(d.integer(1, 4))] for _ in (0, 1))
    b = [[x + d.choice((0, 0, 1)) for x in p] for p in b]
    truth = solve(points(*a), points(*b), dim)
    square = brute_force(a, b, dim)
    assert truth.core_squared == square
    if square == 0:
        ws = {tuple(y - x for x, y in zip(p, q)) for p, q in product(a, b)}
        parted = any(any(n) and min(proof.dot(n, w) for w in ws) >= 0 for n in normals(ws, dim) | {(0,) * dim})
        assert truth.relation == ("touching" if parted else "overlapping")
        assert truth.depth_squared == depth_of_all(a, b, dim)


def depth_of_all(a, b, dim):
    """The squared depth of points that meet, as the least h over all normals. A facet of the differences is at right
    angles to edges of a or b."""
    edges = {exact.minus(q, p) for found in (a, b) for p, q in product(found, found) if p < q}
    edges = {exact.reduced(e, 0)[0] for e in edges} | {tuple(int(i == j) for j in range(dim)) for i in range(dim)}
    if dim == 2:
        found = {(-y, x) for x, y in edges}
    else:
        found = {tuple(proof.normal([(0, 0, 0), e, f])) for e, f in combinations(sorted(edges), 2)}
        found = {exact.reduced(n, 0)[0] for n in found if any(n)}
    found |= {tuple(-x for x in n) for n in found}
    widths = ((max(exact.dot(n, q) for q in b) - min(exact.dot(n, p) for p in a), exact.dot(n, n)) for n in found)
    return min(Fraction(h * h, square) for h, square in widths)


@pytest.mark.parametrize("dim", (2, 3))
@pytest.mark.parametrize("reach, most", [(1, 4), (1, 12), (2, 5), (2, 10), (9, 5), (60, 4)])
def test_depth_by_brute_force(dim, reach, most):
    """Lattices full of ties, of corners in one plane or line, and of flat sets; and wide ones, with none."""
    met = deep = 0
    for seed in range(60):
        d = draw.Draw(f"depth {reach} {most} {seed}", dim, "double")
        a, b = ([d.lattice(reach) for _ in range(d.integer(1, most))] for _ in (0, 1))
        b = [[x // d.choice((1, 1, 2)) for x in p] for p in b]
        truth = solve(points(*a), points(*b), dim)
        if truth.core_squared == 0:
            assert truth.depth_squared == depth_of_all(a, b, dim)
            assert exact.distance(points(*b), points(*a), dim).depth_squared == truth.depth_squared
            met, deep = met + 1, deep + (truth.relation == "overlapping")
    assert met >= 5 and deep >= 3


def test_brute_force_meets_every_relation():
    """The pairs above are of all three sorts, in both dimensions."""
    for dim in (2, 3):
        found = set()
        for seed in range(120):
            d = draw.Draw(f"brute {seed}", dim, "double")
            a, b = ([d.lattice(2) for _ in range(d.integer(1, 4))] for _ in (0, 1))
            b = [[x + d.choice((0, 0, 1)) for x in p] for p in b]
            found.add(exact.distance(points(*a), points(*b), dim).relation)
        assert found == {"apart", "touching", "overlapping"}


# ---- lies


def lies(truth):
    """The truth with one thing wrong."""
    nudge = 1 + Fraction(1, 10**12)
    (weight, x, y), *others = truth.corral
    yield {"upper": truth.upper / nudge, "lower": truth.lower / nudge}
    yield {"core_squared": truth.core_squared * nudge}
    yield {"relation": "touching"}
    yield {"relation": "overlapping"}
    yield {"corral": ((weight * nudge, x, y), *others)}
    yield {"corral": ((weight, tuple(c + Fraction(1, 2**80) for c in x), y), *others)}
    yield {"direction": (truth.direction[0], truth.direction[1], truth.direction[2] * 1001 // 1000 + 1)}
    yield {"direction": tuple(-c for c in truth.direction)}
    yield {"direction": None}
    yield {"exact": False}
    yield {"lower": truth.upper, "upper": truth.lower - 1}


def test_lies_are_noticed():
    d = draw.Draw("lies", 3, "double")
    a, b = d.place(d.hull(8)), d.place(d.hull(8), p=[2.5, 0.5, 0.5])
    truth = exact.distance(a, b, 3)
    proof.prove(truth, a, b, 3)
    for lie in lies(truth):
        with pytest.raises(exact.Unproven):
            proof.prove(dataclasses.replace(truth, **lie), a, b, 3)
    with pytest.raises(exact.Unproven):
        proof.prove(truth, a, moved_by(d, b, Fraction(1, 2**40)), 3)


def depth_lies(truth):
    """The truth of sets that meet with one thing wrong."""
    nudge = 1 + Fraction(1, 10**12)
    low, high = truth.separation
    first, *others = truth.facets
    yield {"depth_squared": truth.depth_squared * nudge}
    yield {"depth_squared": truth.depth_squared / nudge}
    yield {"depth_squared": Fraction(0)}
    yield {"depth_squared": None}
    yield {"separation": (low * nudge, high * nudge)}
    yield {"separation": (low / nudge, high / nudge)}
    yield {"separation": (low * nudge, high / nudge)}
    yield {"separation": (-high, -low)}
    yield {"relation": "touching"}
    yield {"direction": None}
    yield {"direction": tuple(-c for c in truth.direction)}
    yield {"direction": (truth.direction[0] * 1001 // 1000 + 1, *truth.direction[1:])}
    yield {"facets": ()}
    yield {"facets": tuple(others)}
    yield {"facets": (*truth.facets, first)}
    yield {"corners": tuple((b, a) for a, b in truth.corners)}
    yield {"corners": tuple((tuple(2 * c for c in a), tuple(2 * c for c in b)) for a, b in truth.corners)}


@pytest.mark.parametrize("dim", (2, 3))
def test_lies_about_a_depth_are_noticed(dim):
    d = draw.Draw("deep lies", dim, "double")
    a, b = d.place(d.hull(8)), d.place(d.hull(8), p=[0.5, 0.25, 0.125][:dim])
    truth = solve(a, b, dim)
    assert truth.depth_squared > 0
    for lie in depth_lies(truth):
        with pytest.raises(exact.Unproven):
            proof.prove(dataclasses.replace(truth, **lie), a, b, dim)
    for step in (Fraction(1, 2**40), -Fraction(1, 2**40)):
        with pytest.raises(exact.Unproven):
            proof.prove(truth, a, moved_by(d, b, step), dim)


def test_a_depth_along_a_wrong_axis_is_noticed():
    """True along its direction, but there is a shorter way out."""
    a, b = box(1, 1, 1), box(1, 1, 1, p=[1.5, 1, 0])
    truth, longer = solve(a, b, 3), {"depth_squared": Fraction(1), "separation": (Fraction(-1), Fraction(-1))}
    assert truth.depth_squared == Fraction(1, 4)
    with pytest.raises(exact.Unproven, match="a facet nearer"):
        proof.prove(dataclasses.replace(truth, direction=(0, 1, 0), **longer), a, b, 3)


def moved_by(d, shape, step):
    return draw.moved(d, shape, [step] * d.dim)


def test_lies_about_round_shapes_are_noticed():
    a, b = {"shape": "ellipsoid", "radii": [1, 2, 3]}, {"shape": "cone", "r": 1, "half_length": 1, "pose": at(4, 2, 1)}
    truth = solve(a, b, 3)
    for lie in (
        {"lower": truth.lower + truth.scale / 10**20, "upper": truth.upper + truth.scale / 10**20},
        {"lower": truth.lower - truth.scale / 10**20, "upper": truth.upper - truth.scale / 10**20},
        {"direction": (1, 0, 0)},
    ):
        with pytest.raises(exact.Unproven):
            proof.prove(dataclasses.replace(truth, **lie), a, b, 3)


@pytest.mark.parametrize("b", [box(1, 3, 3, p=[1.75, 0, 0]), sphere(1, 1.5, 0, 0), box(1, 1, 1, p=[3, 0, 0])])
def test_lies_about_a_separation_are_noticed(b):
    """Of curved cores that meet, of curved ones whose balls do, and of sets apart."""
    truth = solve(CYLINDER, b, 3)
    found, nudge = depth.separation(truth, CYLINDER, b, 3), Fraction(1, 10**20)
    lies = [
        {"lower": found.lower + nudge, "upper": found.upper + nudge},
        {"lower": found.upper, "upper": found.lower - 1},
    ]
    lies += [{"lower": found.lower - nudge, "upper": found.upper - nudge}]
    if truth.relation == "overlapping":
        lies += [{"direction": tuple(-c for c in found.direction)}, {"direction": (1, 9, 9)}]
    if found.facets:
        lies += [{"facets": found.facets[1:]}, {"corners": tuple((q, p) for p, q in found.corners)}]
    for lie in lies:
        with pytest.raises(exact.Unproven):
            proof.prove_separation(dataclasses.replace(found, **lie), truth, CYLINDER, b, 3)


def test_touching_and_overlapping_are_not_mistaken():
    a, b, deeper = box(1, 1, 1), box(1, 1, 1, p=[2, 1, 0]), box(1, 1, 1, p=[1.5, 1, 0])
    truth = solve(a, b, 3)
    assert truth.relation == "touching" and solve(a, deeper, 3).relation == "overlapping"
    with pytest.raises(exact.Unproven):
        proof.prove(dataclasses.replace(exact.distance(a, deeper, 3), direction=(0, 1, 0)), a, deeper, 3)
    with pytest.raises(exact.Unproven):
        proof.prove(dataclasses.replace(exact.distance(a, deeper, 3), relation="touching"), a, deeper, 3)
    with pytest.raises(exact.Unproven):
        proof.prove(dataclasses.replace(truth, direction=(1, 1, 0)), a, b, 3)


# ---- what a truth carries


@pytest.mark.parametrize("case", CASES[::7], ids=lambda case: case["id"])
def test_witnesses(case):
    """The points lie on both bodies and realise the distance; the normal is a unit vector from a to b."""
    a, b = rounded_inputs(case)
    truth, dim = exact.distance(a, b, case["dim"]), case["dim"]
    slack = (truth.scale + Fraction(1, 10**90)) / 10**25
    apart = [q - p for p, q in zip(truth.point_a, truth.point_b)]
    length = exact.root(proof.dot(apart, apart), True)
    assert truth.lower - slack <= length <= truth.upper + slack
    for d in proof.directions(dim, 10):
        for shape, p in ((a, truth.point_a), (b, truth.point_b)):
            assert proof.dot(d, p) <= proof.reach(shape, d) + slack * proof.length(d)
    if truth.normal:
        assert abs(proof.dot(truth.normal, truth.normal) - 1) < Fraction(1, 10**30)
        assert abs(proof.dot(truth.normal, apart) - length) <= slack
    axes = [[sign * (i == j) for j in range(dim)] for i in range(dim) for sign in (1, -1)]
    middle = [(p + q) / 2 for p, q in zip(truth.point_a, truth.point_b)]
    reached = max(proof.reach(s, list(map(Fraction, x))) - proof.dot(x, middle) for s in (a, b) for x in axes)
    assert abs(reached - truth.scale) <= slack


# ---- the case files


def test_case_files_are_fresh():
    """Every ninth case, made again alone from its name; write_cases.py --check makes them all."""
    for variant in write_cases.VARIANTS:
        lines = (write_cases.CASES / f"{variant}.jsonl").read_text().splitlines()
        todo = write_cases.names(variant)
        assert len(lines) == len(todo)
        for line, (group, index) in list(zip(lines, todo))[::9]:
            assert write_cases.make(variant, group, index) == line


def test_museum_is_fresh():
    path = write_cases.CASES / f"{write_cases.MUSEUM}.jsonl"
    assert list(write_cases.solved_again(path)) == path.read_text().splitlines()


def test_case_files_are_of_a_size_to_commit():
    assert len(CASES) > 2000 and len({case["id"] for case in CASES}) == len(CASES)
    assert sum(path.stat().st_size for path in (ROOT / "tests/cases").glob("*.jsonl")) <= 1_600_000


@pytest.mark.parametrize("variant", ("2 double", "2 float", "3 double", "3 float"))
def test_c_headers(variant, tmp_path):
    """Each number of the JSON is in the header; the brackets only widen, by the rounding of a double-double."""
    dim, precision = variant.split()
    writer = cases_to_c.Writer(int(dim), precision)
    kept = [c for c in CASES if c["dim"] == int(dim) and c["precision"] == precision]
    out = tmp_path / "cases.h"
    paths = sorted(map(str, write_cases.CASES.glob("*.jsonl")))
    program = [sys.executable, cases_to_c.__file__, "--dim", dim, "--precision", precision, "-o", str(out), *paths]
    subprocess.run(program, check=True)
    rows = [line for line in out.read_text().splitlines() if line.startswith('    {"')]
    assert len(rows) == len(kept)
    for row, case in zip(rows, kept):
        assert json.dumps(case["id"]) in row
        *numbers, scale, relation = re.sub("[{}]", "", row.rstrip(",")).split(", ")
        expect, parts = case["expect"], [Fraction(float.fromhex(x)) for x in numbers[-8:]]
        for kind, (l_hi, l_lo, u_hi, u_lo) in (("distance", parts[:4]), ("separation", parts[4:])):
            kind = kind if f"{kind}_lower" in expect else "distance"
            true_lower, true_upper = (Fraction(expect[f"{kind}_{k}"]) for k in ("lower", "upper"))
            lower, upper = l_hi + l_lo, u_hi + u_lo
            assert lower <= true_lower <= true_upper <= upper
            assert true_lower - lower <= abs(true_lower) / 2**100 + Fraction(5e-324)
            assert upper - true_upper <= abs(true_upper) / 2**100 + Fraction(5e-324)
        assert Fraction(float.fromhex(scale)) >= Fraction(str(case["expect"]["scale"]))
        assert relation == f"{writer.prefix}_{case['expect']['relation']}".upper()
        literals = {float.fromhex(x) for x in re.findall(r"-?0x[0-9a-f.]+p[+-]\d+", row)}
        assert {writer.round(x) for k in "ab" for x in numbers_of(case[k])} - {0.0} <= literals


def numbers_of(shape):
    """The numbers of a shape that are in the table as they are."""
    if shape["shape"] in ("sum", "hull"):
        return numbers_of(shape["a"]) + numbers_of(shape["b"]) + list(shape.get("pose", []))
    if shape["shape"] == "ellipsoid":
        return []
    found = [shape.get("r", 0), shape.get("half_length", 0), *shape.get("half", []), *shape.get("pose", [])]
    return found + [x for p in shape.get("points", []) + shape.get("v", []) for x in p]


def test_numbers_as_text():
    assert exact.decimal(Fraction(1, 3), False, 5) == "0.33333" and exact.decimal(Fraction(1, 3), True, 5) == "0.33334"
    assert (
        exact.decimal(Fraction(-1, 3), False, 5) == "-0.33334" and exact.decimal(Fraction(-1, 3), True, 5) == "-0.33333"
    )
    assert exact.decimal(Fraction(2, 3 * 10**9), True, 3) == "6.67e-10"
    assert exact.decimal(Fraction(99999, 100000), True, 3) == "1" and exact.decimal(Fraction(5, 2), False) == "2.5"
    assert exact.decimal(Fraction(10) ** 30, False) == "1e30" and exact.decimal(Fraction(1200), True) == "1200"
    for x in (Fraction(1), Fraction(7, 10**40), Fraction(123456789) ** 7, Fraction(-1, 7), Fraction(10**9 - 1, 10**9)):
        for digits in (1, 5, 34):
            low, high = (Fraction(exact.decimal(x, up, digits)) for up in (False, True))
            assert low <= x <= high and high - low <= abs(x) * Fraction(10) ** (1 - digits)


def test_square_roots_are_on_their_side():
    for x in (Fraction(2), Fraction(1, 3), Fraction(7, 10**50), Fraction(10**41), Fraction(9, 4)):
        low, high = exact.root(x, False), exact.root(x, True)
        assert low**2 <= x <= high**2 and high - low <= high / 2**399
    assert exact.root(Fraction(9, 4), False) == exact.root(Fraction(9, 4), True) == Fraction(3, 2)


@pytest.mark.parametrize("square", (Fraction(2), Fraction(2, 9), Fraction(1, 10**9)))
def test_cores_less_their_radii(square):
    for radii in (Fraction(1), Fraction(0), Fraction(5)):
        low, high = exact.apart_exactly(square, radii)
        assert (low + radii) ** 2 < square < (high + radii) ** 2
    assert exact.apart_exactly(Fraction(4), Fraction(2)) == (0, 0)


def test_float_cases_are_rounded_first():
    case = {"dim": 2, "precision": "float", "a": points([0.1, 0]), "b": points([0, 0])}
    assert exact.solve_case(case).lower == Fraction(exact.to_float32(0.1)) != Fraction(0.1)


@pytest.mark.parametrize(
    "shape",
    [
        {"shape": "points", "points": []},
        {"shape": "points", "points": [[float("nan"), 0, 0]]},
        {"shape": "box", "half": [1, -1, 1]},
        {"shape": "sphere", "r": float("inf")},
        {"shape": "cone", "r": -1, "half_length": 1},
        {"shape": "sphere", "r": 1, "pose": [1, 0, 0]},
        {"shape": "teapot"},
    ],
)
def test_bad_shapes_are_refused(shape):
    with pytest.raises(ValueError):
        exact.distance(shape, sphere(1, 0, 0, 0), 3)


def test_documentation():
    assert doctest.testmod(importlib.import_module("gjk_exact")).failed == 0

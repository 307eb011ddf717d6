# SPDX-License-Identifier: MIT
"""A second look at a truth, from the shapes alone and by other formulas: support values instead of support points.

h(shape, d) is the largest d.x over the set, h(-d) the least negated; then
    (-h(b, -d) - h(a, d)) / |d|    is a lower bound of the signed separation for every d, and
    a point x is outside the set exactly if d.x > h(shape, d) for some d.

A depth of polytopes is an upper bound by its direction, and a lower one by a closed shell of facets around 0."""

import random
from collections import Counter
from fractions import Fraction
from itertools import product

from alone import exact

Unproven = exact.Unproven


def fractions(numbers):
    return [Fraction(x) for x in numbers]


def dot(x, y):
    return sum((p * q for p, q in zip(x, y)), Fraction(0))


def length(d):
    return exact.root(dot(d, d), True)


def local_reach(shape, d, grown):
    """h before the pose, rounded up."""
    kind = shape["shape"]
    if kind == "points":
        return max(dot(fractions(p), d) for p in shape["points"])
    if kind in ("segment", "triangle"):
        return max(dot(fractions(p), d) for p in shape["v"])
    if kind == "box":
        return sum(Fraction(h) * abs(c) for h, c in zip(shape["half"], d))
    if kind == "sphere":
        return Fraction(0)
    if kind == "ellipsoid":
        return length([Fraction(r) * c for r, c in zip(shape["radii"], d)])
    if kind == "ball":
        return Fraction(shape["r"]) * length(d)
    if kind in ("sum", "hull"):
        parts = [reach(shape[k], d, grown) for k in "ab"]
        return sum(parts) if kind == "sum" else max(parts)
    round_part, z = (Fraction(shape.get("r", 0)) * length(d[:-1]) if kind != "capsule" else 0), d[-1]
    half = Fraction(shape.get("half_length", 0))
    if kind == "cone":
        return max(half * z, round_part - half * z)
    return round_part + half * abs(z)


def ball(shape):
    inner = Fraction(shape["r"]) if shape["shape"] in ("sphere", "capsule") else Fraction(0)
    return inner + Fraction(shape.get("radius") or 0)


def posed(shape, dim):
    pose = fractions(shape.get("pose") or [int(i == j) for i in range(dim) for j in range(dim + 1)])
    rows = [pose[i : i + dim] for i in range(0, dim * (dim + 1), dim + 1)]
    return rows, [pose[i * (dim + 1) + dim] for i in range(dim)]


def reach(shape, d, grown=True):
    """h of the posed set; not grown: without any ball."""
    dim = len(d)
    m, p = posed(shape, dim)
    local = [sum((m[i][j] * d[i] for i in range(dim)), Fraction(0)) for j in range(dim)]
    return dot(p, d) + local_reach(shape, local, grown) + (ball(shape) * length(d) if grown and ball(shape) else 0)


def core_reach(shape, d):
    return reach(shape, d, grown=False)


def keeps_balls(shape, dim):
    m, _ = posed(shape, dim)
    return m == [[int(i == j) for j in range(dim)] for i in range(dim)]


def outer_ball(shape, dim):
    """The radius that stands outside everything: of a couple whose pose keeps balls, its children's too."""
    if shape["shape"] not in ("sum", "hull") or not keeps_balls(shape, dim):
        return ball(shape)
    inner = [outer_ball(shape[k], dim) for k in "ab"]
    return ball(shape) + (sum(inner) if shape["shape"] == "sum" else min(inner))


def is_polytope(shape, dim):
    """Whether it is one, grown by a ball or not."""
    if shape["shape"] not in ("sum", "hull"):
        return shape["shape"] in ("points", "segment", "triangle", "box", "sphere", "capsule")
    a, b = (outer_ball(shape[k], dim) for k in "ab")
    stays = a == b == 0 or keeps_balls(shape, dim) and (shape["shape"] == "sum" or a == b)
    return stays and all(is_polytope(shape[k], dim) for k in "ab")


def corners(shape, dim):
    """A polytope's points, all of them: its core is their hull."""
    kind = shape["shape"]
    if kind in ("sum", "hull"):
        a, b = corners(shape["a"], dim), corners(shape["b"], dim)
        points = a + b if kind == "hull" else [[p + q for p, q in zip(x, y)] for x, y in product(a, b)]
    elif kind == "box":
        points = [fractions(p) for p in product(*((-h, h) for h in shape["half"]))]
    elif kind in ("sphere", "capsule"):
        half = Fraction(shape.get("half_length", 0))
        points = [[Fraction(0)] * (dim - 1) + [z] for z in (-half, half)]
    else:
        points = [fractions(p) for p in shape["points" if kind == "points" else "v"]]
    m, p = posed(shape, dim)
    return [[dot(row, x) + t for row, t in zip(m, p)] for x in points]


def directions(dim, count):
    rng = random.Random(7)
    return [[Fraction(rng.randint(-999, 999)) for _ in range(dim)] for _ in range(count)]


def require(condition, what):
    if not condition:
        raise Unproven(what)


def prove(truth, a, b, dim):
    """Raises Unproven unless the truth follows from what it carries."""
    weights = [w for w, _, _ in truth.corral]
    require(sum(weights) == 1 and min(weights) > 0, "weights are not those of a point of the hull")
    for which, shape in ((1, a), (2, b)):
        prove_members([s[which] for s in truth.corral], shape, dim)
    x, y = ([dot(weights, [s[k][i] for s in truth.corral]) for i in range(dim)] for k in (1, 2))
    v = [q - p for p, q in zip(x, y)]
    square, radii = dot(v, v), outer_ball(a, dim) + outer_ball(b, dim)
    require(truth.exact == (is_polytope(a, dim) and is_polytope(b, dim)), "exactness misjudged")
    require(0 <= truth.lower <= truth.upper, "bracket upside down")
    require((truth.upper + radii) ** 2 >= square or square <= radii**2, "upper is not above the pair of points")
    require((truth.depth_squared is not None) == (truth.exact and not square), "a depth where there is none, or none")
    if truth.direction is not None:
        prove_direction(truth, a, b, square)
    else:
        require(truth.lower == 0, "a lower bound without a direction")
    if truth.exact and square:
        require(truth.core_squared == square, "squared distance is not that of the points")
        side = (square > radii**2) - (square < radii**2)
        require(truth.relation == {1: "apart", 0: "touching", -1: "overlapping"}[side], "relation")
        require(truth.upper - truth.lower <= truth.upper * Fraction(1, 10**30), "bracket of a polytope too wide")
    if truth.relation == "apart":
        require(truth.lower > 0, "apart without a lower bound")
    if truth.exact and not square:
        prove_depth(truth, a, b, dim)
        prove_depth_as_answer(truth, radii)
    elif truth.relation == "overlapping" and square == 0 and not radii:
        prove_interior(a, b, dim)
    if truth.relation == "overlapping" and square:
        require(square < radii**2, "overlapping without a common point")


def prove_members(points, shape, dim):
    if is_polytope(shape, dim):
        allowed = {tuple(p) for p in corners(shape, dim)}
        require(all(tuple(p) in allowed for p in points), "not a point of the set")
    else:
        for d in directions(dim, 12):
            bound = reach(shape, d) - outer_ball(shape, dim) * exact.root(dot(d, d), False)
            require(all(dot(d, p) <= bound for p in points), "outside the set")


def prove_direction(truth, a, b, square):
    d = fractions(truth.direction)
    least = -reach(b, [-c for c in d]) - reach(a, d)
    if truth.exact:
        core, depth = -core_reach(b, [-c for c in d]) - core_reach(a, d), truth.depth_squared or 0
        require(core * abs(core) == (square - depth) * dot(d, d), "the direction does not realise the separation")
    elif truth.lower > 0:
        require(least / exact.root(dot(d, d), True) >= truth.lower - truth.scale / 10**35, "lower is not proven")


def prove_depth(truth, a, b, dim):
    """The direction bounds the depth from above. Below: seen from 0 every facet of the shell turns the same way and
    each side of one is a side of another, the other way round. So every ray from 0 leaves through one of them, and all
    that lies nearer than their planes is among the differences, as 0 and the corners are."""
    require(truth.direction is not None and any(truth.direction), "no direction")
    if truth.depth_squared > 0:
        prove_shell(truth, truth.depth_squared, a, b, dim)


def prove_shell(found, depth_squared, a, b, dim):
    for which, shape in ((0, a), (1, b)):
        prove_members([c[which] for c in found.corners], shape, dim)
    w = [[q - p for p, q in zip(*c)] for c in found.corners]
    sides = Counter()
    for corners in found.facets:
        n = normal([w[i] for i in corners])
        h = dot(n, w[corners[0]])
        require(h * h >= depth_squared * dot(n, n) and h != 0, "a facet nearer than the depth")
        sides.update(oriented_sides(corners if h > 0 else (corners[1], corners[0], *corners[2:])))
    require(sides and all(sides[side] == sides[opposite(side)] for side in sides), "the shell is not closed")


def normal(points):
    """The cross product of the edges: its product with a point is the determinant of all."""
    edges = [[y - x for x, y in zip(points[0], p)] for p in points[1:]]
    if len(points) == 2:
        ((x, y),) = edges
        return [y, -x]
    (p, q, r), (x, y, z) = edges
    return [q * z - r * y, r * x - p * z, p * y - q * x]


def oriented_sides(corners):
    """Of a triangle its three edges, as they are passed through; of an edge its ends, as they are left and reached."""
    if len(corners) == 2:
        return [("from", corners[0]), ("to", corners[1])]
    return list(zip(corners, corners[1:] + corners[:1]))


def opposite(side):
    x, y = side
    return ({"from": "to", "to": "from"}[x], y) if isinstance(x, str) else (y, x)


def prove_depth_as_answer(truth, radii):
    low, high = (-x - radii for x in reversed(truth.separation))
    require(max(low, 0) ** 2 <= truth.depth_squared <= high**2 and high >= 0, "the separation is not that of the depth")
    require(high - low <= (high + radii) / 10**30, "separation of a polytope too wide")
    overlapping = truth.depth_squared > 0 or radii > 0
    require(truth.relation == ("overlapping" if overlapping else "touching"), "relation of sets that meet")


def prove_separation(found, truth, a, b, dim):
    """Of a pair whose truth is proven: its signed separation too, where it overlaps."""
    require(found.lower <= found.upper, "separation upside down")
    if truth.relation != "overlapping":
        expected = (truth.lower, truth.upper) if truth.relation == "apart" else (0, 0)
        require((found.lower, found.upper) == expected, "separation is not the distance")
        return
    d, radii = fractions(found.direction), outer_ball(a, dim) + outer_ball(b, dim)
    least, square = -core_reach(b, [-c for c in d]) - core_reach(a, d), dot(d, d)
    least /= exact.root(square, least > 0)
    require(least - radii >= found.lower - truth.scale / 10**35, "lower is not along the direction")
    if found.upper >= -radii:
        v = [sum(weight * (q[i] - p[i]) for weight, p, q in truth.corral) for i in range(dim)]
        require((found.upper + radii) ** 2 >= dot(v, v), "upper is not above the pair of points")
    else:
        prove_shell(found, (found.upper + radii) ** 2, a, b, dim)


def prove_interior(a, b, dim):
    """No plane may lie between. A sample only: test_exact.py tries every plane of small sets."""
    for d in directions(dim, 40):
        require(-reach(b, [-c for c in d]) - reach(a, d) < 0, "a plane lies between")

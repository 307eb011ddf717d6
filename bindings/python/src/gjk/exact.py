# SPDX-License-Identifier: MIT
"""The truth about a pair of convex sets, without rounding.

Every float of the input is taken as the rational it is: m x + p is an exact affine map, whether m is a rotation or
not. All numbers of a pair are multiples of one power of two, the *grid*, so that the work is done in Python's
integers; nothing outside the standard library is needed.

The nearest pair of the cores (the sets before their balls) is found by Wolfe's minimum-norm-point algorithm over
w = b - a. In exact arithmetic it needs no tolerance, meets no degenerate case and ends after finitely many steps:

    corral     affinely independent points w whose affine hull is nearest to 0 inside their simplex, at v
    certificate v.w >= v.v for every w, which two support calls decide

Polytopes are solved exactly. Where they meet, a polytope of points w is grown about 0 until its nearest facet is one of
the whole: that far 0 is from outside, and this depth is the least translation that separates.

Round sets give support points rounded into the set, and support values rounded up: the corral then proves an upper
bound, a direction a lower one, and the two are driven together.

    >>> sphere = {"shape": "sphere", "r": 1, "pose": [1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0]}
    >>> truth = distance({"shape": "box", "half": [1, 1, 1]}, sphere)
    >>> truth.relation, float(truth.lower), truth.lower == truth.upper
    ('apart', 1.0, True)
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import gcd, isfinite, isqrt

APART, TOUCHING, OVERLAPPING = "apart", "touching", "overlapping"

ROUND_BITS = 128  # of a point on a round set, relative to the set's size
SHORT_BITS = 128  # of a direction that need not be exact
GAP_BITS = 104  # round sets: solved when the bracket is 2**-104 of the size
ROOT_BITS = 400  # of a square root
MAX_STEPS = 2000  # round sets only; the bracket holds wherever it stops
MORE_STEPS = 16  # round sets only: within the gap, but with nothing yet to say that they are apart


class Unproven(ArithmeticError):
    """A certificate that does not prove what it says."""


@dataclass(frozen=True)
class Truth:
    """How two sets stand. Lengths are fractions; square roots among them are rounded in their 140th bit."""

    relation: str  # APART, TOUCHING or OVERLAPPING
    proven: bool  # False: the relation is open; round sets closer to touching than the bracket can tell
    exact: bool  # both are polytopes, grown or not
    lower: Fraction  # <= the distance
    upper: Fraction  # >= the distance
    separation: tuple | None  # bracket of the signed separation; None where round cores meet, or may
    core_squared: Fraction | None  # squared distance of the cores, exact; None for round sets
    depth_squared: Fraction | None  # squared depth of the cores, exact; None for round sets and where they are apart
    scale: Fraction  # largest |coordinate| of either body, grown, from the midpoint of a closest pair
    point_a: tuple  # a closest pair; meeting, one point of both
    point_b: tuple
    normal: tuple | None  # unit, from a to b; None where the cores are round and overlap
    corral: tuple  # the certificate: (weight, point of core a, point of core b), ...
    direction: tuple | None  # the certificate: the least d.w over all w is the cores' separation times |d|; or None
    corners: tuple  # the certificate of a depth: (point of core a, point of core b), ...; each gives a w
    facets: tuple  # of which of them: a closed shell about 0, nowhere nearer than the depth; () only at depth 0
    steps: int


# ---------------------------------------------------------------------------------------------------- integers


def dot(x, y):
    return sum(p * q for p, q in zip(x, y))


def minus(x, y):
    return tuple(p - q for p, q in zip(x, y))


def ceil_div(x, y):
    return -(-x // y)


def shift_up(x, bits):
    """x * 2**bits, rounded up."""
    return x << bits if bits >= 0 else -(-x >> -bits)


def to_grid(numbers):
    """Floats as integers n and one exponent e: each number is n * 2**-e."""
    pairs = []
    for x in numbers:
        if not isfinite(x):
            raise ValueError(f"not finite: {x}")
        pairs.append(x.as_integer_ratio())
    e = max((d.bit_length() - 1 for _, d in pairs), default=0)
    return [n << (e + 1 - d.bit_length()) for n, d in pairs], e


def shorten(v, bits=SHORT_BITS):
    excess = max(abs(x) for x in v).bit_length() - bits
    return tuple(x >> excess for x in v) if excess > 0 else v


def reduced(v, d):
    g = gcd(d, *v)
    return tuple(x // g for x in v), d // g


def root(square, up, bits=ROOT_BITS):
    """The square root of a fraction, rounded down or up to that many bits."""
    n, d = square.numerator, square.denominator
    if n == 0:
        return Fraction(0)
    t = max(0, bits + (d.bit_length() - n.bit_length() + 1) // 2 + 1)
    scaled = n << 2 * t
    if up:
        return Fraction(isqrt(ceil_div(scaled, d) - 1) + 1, 1 << t)
    return Fraction(isqrt(scaled // d), 1 << t)


def rounded(x, up, bits=140):
    """A fraction rounded to a dyadic one of that many bits."""
    if x == 0:
        return x
    t = bits + x.denominator.bit_length() - x.numerator.bit_length()
    n, d = (x.numerator << t, x.denominator) if t >= 0 else (x.numerator, x.denominator << -t)
    n = ceil_div(n, d) if up else n // d
    return Fraction(n, 1 << t) if t >= 0 else Fraction(n << -t)


def solve_linear(matrix, right):
    """Numbers n and d > 0 with matrix n = d right, by elimination without fractions (Bareiss).
    The matrix is positive definite, so that every pivot is a leading minor and positive."""
    rows = [list(r) + [b] for r, b in zip(matrix, right)]
    size, before = len(rows), 1
    for k in range(size):
        pivot = rows[k][k]
        if pivot <= 0:
            raise Unproven("the corral is not affinely independent")
        for i in range(size):
            if i != k:
                factor = rows[i][k]
                rows[i] = [(pivot * x - factor * y) // before for x, y in zip(rows[i], rows[k])]
        before = pivot
    return [r[size] for r in rows], before


# ------------------------------------------------------------------------------------------------------- poses


class Affine:
    """x goes to (m x) 2**-em + p 2**-ep, all integers."""

    def __init__(self, m, em, p, ep):
        self.m, self.em, self.p, self.ep = m, em, p, ep

    @staticmethod
    def identity(dim):
        return Affine([[int(i == j) for j in range(dim)] for i in range(dim)], 0, [0] * dim, 0)

    @staticmethod
    def of(pose, dim):
        if pose is None:
            return Affine.identity(dim)
        if len(pose) != dim * (dim + 1):
            raise ValueError(f"a pose has {dim * (dim + 1)} numbers, not {len(pose)}")
        rows = [pose[i * (dim + 1) : (i + 1) * (dim + 1)] for i in range(dim)]
        m, em = to_grid([x for row in rows for x in row[:dim]])
        p, ep = to_grid([row[dim] for row in rows])
        return Affine([m[i * dim : (i + 1) * dim] for i in range(dim)], em, p, ep)

    def points(self, points, e):
        """Where points of grid e go, and their grid."""
        to = max(self.em + e, self.ep)
        left, p = to - self.em - e, [x << (to - self.ep) for x in self.p]
        return [tuple((dot(row, x) << left) + q for row, q in zip(self.m, p)) for x in points], to

    def after(self, inner):
        """This map after the inner one."""
        dim = len(self.p)
        columns = [[inner.m[i][j] for i in range(dim)] for j in range(dim)]
        m = [[dot(row, column) for column in columns] for row in self.m]
        (p,), ep = self.points([inner.p], inner.ep)
        return Affine(m, self.em + inner.em, p, ep)

    def linear(self):
        return Affine(self.m, self.em, [0] * len(self.p), 0)

    def is_identity(self):
        """Whether m is: such a map leaves balls as they are."""
        return all(x == int(i == j) << self.em for i, row in enumerate(self.m) for j, x in enumerate(row))


# ------------------------------------------------------------------------------------------------------- cores
# A core has grid (the exponent it needs), round (whether its support is rounded), place(grid), which settles the
# grid of all its points, and support(d): a point of the set and a bound h >= d.x over the set, equal to d.point
# for a polytope.


class Points:
    round = False

    def __init__(self, points, e):
        self.points, self.grid = list(dict.fromkeys(points)), e

    def place(self, grid):
        self.points = [tuple(x << (grid - self.grid) for x in p) for p in self.points]
        self.grid = grid

    def support(self, d):
        if len(d) == 3:
            x, y, z = d
            values = [x * p[0] + y * p[1] + z * p[2] for p in self.points]
        else:
            x, y = d
            values = [x * p[0] + y * p[1] for p in self.points]
        h = max(values)
        return self.points[values.index(h)], h


class Round:
    """The image under an affine map of a ball (all coordinates), cylinder, cone or disc (round about the last)."""

    round = True

    def __init__(self, kind, affine, r, half):
        self.kind, self.affine = kind, affine
        (self.r, self.half), self.e = to_grid([r, half])
        self.own = affine.em + self.e + ROUND_BITS
        self.grid = max(self.own, affine.ep)

    def place(self, grid):
        self.grid = grid
        self.centre = [x << (grid - self.affine.ep) for x in self.affine.p]

    def circle(self, g):
        """The point r g / |g|, rounded into the ball, and r |g|, rounded up; both on grid e + ROUND_BITS."""
        square = dot(g, g)
        if square == 0:
            return [0] * len(g), 0
        t = max(0, ROUND_BITS + 16 - square.bit_length() // 2)
        s = isqrt(square << 2 * t)
        s += s * s != square << 2 * t  # |g| 2**t, rounded up
        x = [(self.r * abs(c) << ROUND_BITS + t) // s for c in g]
        return [-q if c < 0 else q for q, c in zip(x, g)], shift_up(self.r * s, ROUND_BITS - t)

    def local(self, g):
        """A farthest point along g before the map, and a bound of g.x; both on grid e + ROUND_BITS."""
        if self.kind == "ball":
            return self.circle(g)
        (x, reach), z = self.circle(g[:-1]), self.half << ROUND_BITS
        if self.kind == "disc":
            return x + [0], reach
        if self.kind == "cylinder":
            return x + [z if g[-1] >= 0 else -z], reach + z * abs(g[-1])
        apex, base = z * g[-1], reach - z * g[-1]
        return ([0] * len(x) + [z], apex) if apex >= base else (x + [-z], base)

    def support(self, d):
        g = [sum(row[j] * q for row, q in zip(self.affine.m, d)) for j in range(len(d))]
        x, h = self.local(g)
        left = self.grid - self.own
        point = tuple((dot(row, x) << left) + c for row, c in zip(self.affine.m, self.centre))
        return point, (h << left) + dot(d, self.centre)


class Couple:
    def __init__(self, kind, a, b):
        self.kind, self.a, self.b = kind, a, b
        self.round, self.grid = a.round or b.round, max(a.grid, b.grid)

    def place(self, grid):
        self.grid = grid
        self.a.place(grid)
        self.b.place(grid)

    def support(self, d):
        (x, hx), (y, hy) = self.a.support(d), self.b.support(d)
        if self.kind == "sum":
            return tuple(p + q for p, q in zip(x, y)), hx + hy
        return (x if dot(d, x) >= dot(d, y) else y), max(hx, hy)


def box_corners(half):
    corners = [()]
    for h in half:
        corners = [c + (s,) for c in corners for s in ((-h, h) if h else (h,))]
    return corners


def size(x, name):
    if not (isfinite(x) and x >= 0):
        raise ValueError(f"bad {name}: {x}")
    return x


def build(shape, dim, outer=None):
    """The core of a shape, under the outer map if any, and its radius as a fraction."""
    affine = Affine.of(shape.get("pose"), dim)
    if outer is not None:
        affine = outer.after(affine)
    kind, radius = shape["shape"], Fraction(size(shape.get("radius") or 0, "radius"))
    if kind in ("sphere", "capsule"):
        radius += Fraction(size(shape["r"], "r"))
    stretched = Fraction(0)  # by the outer map: that ball is part of the core
    if outer is not None and not outer.is_identity():
        stretched, radius = radius, Fraction(0)

    if kind in ("sum", "hull"):
        core, grown = build_couple(kind, shape, dim, affine)
        radius += grown
    elif kind == "ellipsoid":
        stretch = [x for i, h in enumerate(shape["radii"]) for x in [0] * i + [size(h, "radii")] + [0] * (dim - i)]
        core = Round("ball", affine.after(Affine.of(stretch, dim)), 1, 0)
    elif kind == "ball":
        core = Round(kind, affine, size(shape["r"], "r"), 0)
    elif kind in ("cylinder", "cone", "disc") and dim == 3:
        core = Round(kind, affine, size(shape["r"], "r"), size(shape.get("half_length", 0), "half_length"))
    else:
        core = polytope(vertices(shape, dim), affine)
    return (fatten(core, stretched, outer.linear()) if stretched else core), radius


def build_couple(kind, shape, dim, affine):
    if kind == "sum":
        (a, ra), (b, rb) = build(shape["a"], dim, affine), build(shape["b"], dim, affine.linear())
        return Couple(kind, a, b), ra + rb
    (a, ra), (b, rb) = build(shape["a"], dim, affine), build(shape["b"], dim, affine)
    less, still = min(ra, rb), Affine.identity(dim)
    a, b = (fatten(core, r - less, still) if r > less else core for core, r in ((a, ra), (b, rb)))
    return Couple(kind, a, b), less


def fatten(core, radius, linear):
    """The core grown by the image of a ball."""
    return Couple("sum", core, Round("ball", linear, radius, 0))


def vertices(shape, dim):
    kind = shape["shape"]
    if kind == "sphere":
        found = [[0] * dim]
    elif kind == "capsule":
        half = size(shape["half_length"], "half_length")
        found = [[0] * (dim - 1) + [s] for s in (-half, half)]
    elif kind == "points":
        found = shape["points"]
    elif kind == "box":
        found = box_corners([size(h, "half") for h in shape["half"]])
    elif kind in ("segment", "triangle"):
        found = shape["v"]
    else:
        raise ValueError(f"no such shape in {dim}-D: {kind}")
    if not found or any(len(p) != dim for p in found):
        raise ValueError(f"{kind}: points of {dim} numbers, at least one")
    return found


def polytope(found, affine):
    dim = len(found[0])
    numbers, e = to_grid([x for p in found for x in p])
    points = [tuple(numbers[i : i + dim]) for i in range(0, len(numbers), dim)]
    return Points(*affine.points(points, e))


# --------------------------------------------------------------------------------------------- the nearest pair


class Pair:
    """The cores of two shapes on one grid, and their radii on it."""

    def __init__(self, a, b, dim):
        (self.a, ra), (self.b, rb) = build(a, dim), build(b, dim)
        (ra, rb), er = to_grid([ra, rb])
        self.dim, self.grid = dim, max(self.a.grid, self.b.grid, er)
        self.a.place(self.grid)
        self.b.place(self.grid)
        self.ra, self.rb = ra << (self.grid - er), rb << (self.grid - er)
        self.exact = not (self.a.round or self.b.round)

    def farthest(self, d, shift=None):
        """The w = b - a least along d, with its a and b, and a bound h <= d.w over all w. All of it moved by minus
        shift."""
        a, ha = self.a.support(d)
        b, hb = self.b.support(tuple(-x for x in d))
        w, h = minus(b, a), -hb - ha
        if shift is not None:
            w, h = minus(w, shift), h - dot(d, shift)
        return (w, a, b), h

    def boxes(self):
        """The bounding boxes of the two cores: [(low, high) of a, of b], rounded outwards."""
        found = []
        for core in (self.a, self.b):
            low, high = [], []
            for i in range(self.dim):
                axis = tuple(int(i == j) for j in range(self.dim))
                high.append(core.support(axis)[1])
                low.append(-core.support(tuple(-x for x in axis))[1])
            found.append((low, high))
        return found


def barycentre(corral):
    """The point of the corral's affine hull nearest to 0, as integer weights over a positive sum."""
    last = corral[-1][0]
    edges = [minus(s[0], last) for s in corral[:-1]]
    weights, total = solve_linear([[dot(e, f) for f in edges] for e in edges], [-dot(e, last) for e in edges])
    return weights + [total - sum(weights)], total


def settle(corral, weights):
    """Wolfe's minor cycle. From a point of the simplex walk towards the point of its affine hull nearest to 0;
    where a face is met, drop what is not on it and look again. Ends with all weights positive."""
    while True:
        aims, total = barycentre(corral)
        if min(aims) > 0:
            return corral, aims, total
        aims = [Fraction(n, total) for n in aims]
        step = min(w / (w - m) for w, m in zip(weights, aims) if m <= 0)
        weights = [w + step * (m - w) for w, m in zip(weights, aims)]
        kept = [i for i, w in enumerate(weights) if w > 0]
        corral, weights = [corral[i] for i in kept], [weights[i] for i in kept]


@dataclass
class Nearest:
    """Where Wolfe's algorithm ended. The nearest point is v / scale, weights / total of the corral."""

    corral: list
    weights: list
    total: int
    v: tuple
    scale: int
    lower: Fraction  # proven by direction, which is None while no direction separates
    direction: tuple | None
    steps: int

    def upper(self):
        return root(Fraction(dot(self.v, self.v), self.scale**2), True)


def nearest(pair, corral, weights, tolerance=None, shift=None):
    """Wolfe's algorithm from a simplex and a point in it. Without a tolerance (polytopes) it ends at the optimum;
    with one, in units of the grid, as soon as upper - lower is within it and a direction separates. Where none does,
    it looks a little further: a simplex that is flat or small may pass by 0 and yet lie deep in the set."""
    lower, direction, steps, more = Fraction(0), None, 0, MORE_STEPS
    while True:
        corral, aims, total = settle(corral, weights)
        v, scale = reduced([dot(aims, [s[0][i] for s in corral]) for i in range(pair.dim)], total)
        end = Nearest(corral, aims, total, v, scale, lower, direction, steps)
        square = dot(v, v)
        if square == 0 or steps == MAX_STEPS and tolerance is not None:
            return end
        steps += 1
        for d in dict.fromkeys((shorten(v), v)):
            found, h = pair.farthest(d, shift)
            nearer = dot(v, found[0]) * scale < square
            if tolerance is not None and h > 0 and h / root(Fraction(dot(d, d)), True) > lower:
                lower, direction = h / root(Fraction(dot(d, d)), True), d
            if nearer:
                break
        end.lower, end.direction, end.steps = lower, direction, steps
        if not nearer and tolerance is None:
            end.lower, end.direction = root(Fraction(square, scale * scale), False), v
            return end
        if tolerance is not None and end.upper() - lower <= tolerance:
            more = 0 if direction else more - 1
        if not nearer or more == 0:
            return end
        corral = corral + [found]
        weights = [Fraction(n, total) for n in aims] + [Fraction(0)]


def interior(pair, boxes, end):
    """Whether a ball about 0 lies in the set of all w, where end.v is 0; if not, the direction that says so.

    A corral that spans the space holds 0 inside. Otherwise look at points around 0: if all are in the set, so is
    a ball. For round sets only: polytopes have their depth."""
    if len(end.corral) == pair.dim + 1:
        return True, None
    low, high = (pick(pick(box[k]) for box in boxes) for k, pick in ((0, min), (1, max)))
    step = (high - low >> 60) + 1
    weights = [Fraction(n, end.total) for n in end.weights]
    axes = [tuple(step * (i == j) for j in range(pair.dim)) for i in range(pair.dim)]
    for shift in axes + [(-step,) * pair.dim]:
        corral = [(minus(w, shift), a, b) for w, a, b in end.corral]
        moved = nearest(pair, corral, weights, Fraction(step, 1000), shift)
        if any(moved.v):
            return False, moved.v
    return True, None


# --------------------------------------------------------------------------------------------------- the depth
# Of cores that meet: the set of all w holds 0. The depth is the least h(n) / |n| over all n, h(n) the largest n.w, and
# moving b by it along -n separates. A spot is a w with its a and b.


@dataclass
class Facet:
    corners: tuple  # places among the spots, ascending
    n: tuple  # outwards
    h: int  # n.w at the corners; nowhere in the hull of the spots is it larger
    level: Fraction  # squared distance of its plane from 0


@dataclass
class Shell:
    """A direction that realises the depth, and the facets of a hull of spots, none of them nearer to 0."""

    squared: Fraction
    direction: tuple
    spots: list
    facets: list


def across(edges, dim):
    """A vector at right angles to fewer than dim independent edges, not 0."""
    edges = edges or [(1,) + (0,) * (dim - 1)]
    if dim == 2:
        ((x, y),) = edges
        n = (y, -x)
    else:
        if len(edges) == 1:
            least = min(range(dim), key=lambda i: abs(edges[0][i]))
            edges = edges + [tuple(int(i == least) for i in range(dim))]
        (p, q, r), (x, y, z) = edges
        n = (q * z - r * y, r * x - p * z, p * y - q * x)
    return reduced(n, 0)[0]


def widen(pair, spots):
    """The spots, affinely independent with 0 in their hull, and more of them until they span the space; or until a
    direction says that none is needed, 0 being on the border. Across the flat of the spots 0 and they are level: no w
    below them, and the plane through them parts the sets, be the set of all w flat or not."""
    while len(spots) <= pair.dim:
        d = across([minus(s[0], spots[0][0]) for s in spots[1:]], pair.dim)
        spot, least = pair.farthest(d)
        if least == 0:
            return spots, d
        spots = spots + [spot]
    return spots, None


def facet(corners, spots, inside):
    """The facet through these corners, inside being on its inner side; that is the sum of the first dim + 1 spots."""
    first = spots[corners[0]][0]
    n = across([minus(spots[i][0], first) for i in corners[1:]], len(first))
    if dot(n, inside) > dot(n, first) * (len(first) + 1):
        n = tuple(-x for x in n)
    h = dot(n, first)
    return Facet(corners, n, h, Fraction(h * h, dot(n, n)))


def grow(facets, spots, inside):
    """The facets of the hull with the last spot. Those that it lies beyond give way to facets from their rim to it.
    One whose plane holds it stays, and is made larger by new ones in that plane. No new one is flat: in line with a
    side of a facet, and so in its plane, is nothing that lies beyond it."""
    w, rim = spots[-1][0], set()
    kept = [f for f in facets if dot(f.n, w) <= f.h]
    for f in facets:
        if dot(f.n, w) > f.h:
            rim ^= set(combinations(f.corners, len(w) - 1))  # a side between two of them comes twice
    return kept + [facet(side + (len(spots) - 1,), spots, inside) for side in sorted(rim)]


def depth(pair, corral):
    """The depth of polytopes that meet, from a corral whose hull holds 0, as then do all later ones. Its nearest facet
    is a lower bound, and once no w lies beyond that an upper one too. It comes to that: each spot is a new corner."""
    spots, border = widen(pair, corral)
    if border:
        return Shell(Fraction(0), border, spots, [])
    inside = tuple(map(sum, zip(*(s[0] for s in spots))))
    facets = [facet(corners, spots, inside) for corners in combinations(range(len(spots)), pair.dim)]
    while True:
        near = min(facets, key=lambda f: f.level)
        direction = tuple(-x for x in near.n)
        spot, least = pair.farthest(direction)
        if least == -near.h:
            return Shell(near.level, direction, spots, facets)
        spots = spots + [spot]
        facets = grow(facets, spots, inside)


# ------------------------------------------------------------------------------------------------------ answers


def distance(a, b, dim=3):
    """The truth about a pair of shapes, given as the objects of a case (a dict with "shape", "pose", ...)."""
    pair = Pair(a, b, dim)
    boxes = pair.boxes()
    start = tuple(sum(boxes[1][k][i] - boxes[0][k][i] for k in (0, 1)) for i in range(dim))
    first, _ = pair.farthest(shorten(start) if any(start) else (1,) + (0,) * (dim - 1))
    tolerance = None if pair.exact else gap_wanted(pair, boxes, first[0])
    end = nearest(pair, [first], [Fraction(1)], tolerance)
    return judge(pair, boxes, end)


def gap_wanted(pair, boxes, w):
    widest = max(max(minus(box[1], box[0])) for box in boxes) + pair.ra + pair.rb + isqrt(dot(w, w))
    return Fraction(widest, 1 << GAP_BITS)


def judge(pair, boxes, end):
    """The truth, from the nearest pair of the cores."""
    unit, radii = Fraction(1, 1 << pair.grid), pair.ra + pair.rb
    square = Fraction(dot(end.v, end.v), end.scale**2)
    proven, direction, separation, shell = True, end.direction, None, None
    if square == 0 and pair.exact:
        shell = depth(pair, end.corral)
        direction = shell.direction
        separation = tuple(rounded(-(root(shell.squared, up) + radii) * unit, not up) for up in (True, False))
        relation = OVERLAPPING if shell.squared or radii else TOUCHING
        lower = upper = Fraction(0)
    elif square == 0:  # round: the separation stays open, a smooth set has no facets to count
        relation, direction, proven = judge_meeting(pair, boxes, end, radii)
        lower = upper = Fraction(0)
    elif direction is None:  # the cores may meet
        high = rounded((end.upper() - radii) * unit, True)
        relation, proven = (OVERLAPPING, True) if high < 0 else (TOUCHING, False)
        lower, upper = Fraction(0), max(high, Fraction(0))
    else:
        low, high = end.lower - radii, end.upper() - radii
        if pair.exact:
            low, high = apart_exactly(square, radii)
        separation = rounded(low * unit, False), rounded(high * unit, True)
        relation = APART if low > 0 else OVERLAPPING if high < 0 else TOUCHING
        proven = relation != TOUCHING or low == high
        lower, upper = (max(x, Fraction(0)) for x in separation)
    point_a, point_b, normal = witnesses(pair, end, direction)
    return Truth(
        relation=relation,
        proven=proven,
        exact=pair.exact,
        lower=lower,
        upper=upper,
        separation=separation,
        core_squared=square * unit * unit if pair.exact else None,
        depth_squared=shell and shell.squared * unit * unit,
        scale=rounded(spread(pair, boxes, point_a, point_b) * unit, True),
        point_a=tuple(x * unit for x in point_a),
        point_b=tuple(x * unit for x in point_b),
        normal=normal,
        corral=tuple(
            (Fraction(n, end.total), tuple(x * unit for x in a), tuple(x * unit for x in b))
            for n, (_, a, b) in zip(end.weights, end.corral)
        ),
        direction=direction,
        corners=tuple(tuple(tuple(x * unit for x in p) for p in s[1:]) for s in shell.spots) if shell else (),
        facets=tuple(f.corners for f in shell.facets) if shell else (),
        steps=end.steps,
    )


def apart_exactly(square, radii):
    """The bracket of sqrt(square) - radii, with the exact sign; no digits cancel."""
    excess = square - radii * radii
    if excess == 0:
        return Fraction(0), Fraction(0)
    low, high = root(square, False) + radii, root(square, True) + radii
    return (excess / high, excess / low) if excess > 0 else (excess / low, excess / high)


def judge_meeting(pair, boxes, end, radii):
    """Round cores share a point: relation, separating direction, whether it is proven. Sets that touch are proven
    to where a plane across an axis parts them; the general case no finite search decides."""
    inside, direction = (True, None) if radii else interior(pair, boxes, end)
    if inside:
        return OVERLAPPING, None, True
    axes = [tuple(sign * (i == j) for j in range(pair.dim)) for i in range(pair.dim) for sign in (1, -1)]
    for d in [direction] + axes:
        if pair.farthest(d)[1] >= 0:
            return TOUCHING, d, True
    return TOUCHING, direction, False


def witnesses(pair, end, direction):
    """A closest pair (meeting: one point of both), on the grid, and the unit normal."""
    dims = range(pair.dim)
    x, y = ([Fraction(dot(end.weights, [s[k][i] for s in end.corral]), end.total) for i in dims] for k in (1, 2))
    if not any(end.v):
        length = None if direction is None else root(Fraction(dot(direction, direction)), False)
        return tuple(x), tuple(y), length and tuple(rounded(c / length, False) for c in direction)
    length = root(Fraction(dot(end.v, end.v)), False)
    normal = tuple(rounded(c / length, False) for c in end.v)
    core = length / end.scale
    from_a, from_b = Fraction(pair.ra), core - pair.rb
    if from_a > from_b:
        from_a = from_b = (min(from_a, core) + max(from_b, 0)) / 2
    a = tuple(c + n * from_a for c, n in zip(x, normal))
    b = a if from_a == from_b else tuple(c - n * pair.rb for c, n in zip(y, normal))
    return a, b, normal


def spread(pair, boxes, point_a, point_b):
    middle = [(p + q) / 2 for p, q in zip(point_a, point_b)]
    return max(
        max(high - m, m - low) + radius
        for (lows, highs), radius in zip(boxes, (pair.ra, pair.rb))
        for low, high, m in zip(lows, highs, middle)
    )


# ----------------------------------------------------------------------------------------------- numbers as text


def to_float32(x):
    """The nearest float, as the double that equals it."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def round_to_float(thing):
    """A shape, or any JSON value, with every number rounded to float."""
    if isinstance(thing, dict):
        return {k: round_to_float(v) for k, v in thing.items()}
    if isinstance(thing, (list, tuple)):
        return [round_to_float(x) for x in thing]
    return to_float32(thing) if isinstance(thing, (int, float)) and not isinstance(thing, bool) else thing


def solve_case(case):
    """The truth of a case object; its numbers rounded to float where its precision says so."""
    a, b = case["a"], case["b"]
    if case.get("precision") == "float":
        a, b = round_to_float(a), round_to_float(b)
    return distance(a, b, case["dim"])


def decimal(x, up, digits=34):
    """A fraction as a decimal, rounded down or up to that many digits."""
    if x == 0:
        return "0"
    e = len(str(abs(x.numerator))) - len(str(x.denominator))
    e -= abs(x) < Fraction(10) ** e
    scaled = x / Fraction(10) ** (e - digits + 1)
    n = ceil_div(scaled.numerator, scaled.denominator) if up else scaled.numerator // scaled.denominator
    text = str(abs(n)).rstrip("0")
    e += len(str(abs(n))) - digits
    sign = "-" if n < 0 else ""
    if -5 <= e < 16:
        text = text[: e + 1].ljust(e + 1, "0") + "." + text[e + 1 :] if e >= 0 else "0." + "0" * (-e - 1) + text
        return sign + text.rstrip(".")
    return f"{sign}{text[0]}{'.' * (len(text) > 1)}{text[1:]}e{e}"

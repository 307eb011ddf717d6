# SPDX-License-Identifier: MIT
"""Pairs of shapes, drawn by seed. The same bits on every machine: only random(), + - * / and the square root."""

import random
from fractions import Fraction
from itertools import chain
from math import sqrt

from alone import exact

# what one variant draws with: how far two things nearly agree, how far from the origin, how unlike in size
TURN = {"double": 1e-9, "float": 1e-4}
FAR = {"double": 1e6, "float": 1e3}
RATIO = {"double": 1e9, "float": 1e4}
UNIT = {"double": 1e60, "float": 1e8}
GAPS = {"double": (1e-6, 1e-8, 1e-10, 1e-12), "float": (1e-2, 1e-3, 1e-4, 1e-5)}
POSE_BITS = {"double": 40, "float": 14}  # of an ellipsoid's pose: times a radius of at most 7 bits still exact


def squared(v):
    """Added up one by one: sum() does it otherwise from Python 3.12 on."""
    total = 0.0
    for x in v:
        total += x * x
    return total


class Draw:
    """Random numbers and shapes for one case."""

    def __init__(self, seed, dim, precision):
        self.rng, self.dim, self.precision = random.Random(seed), dim, precision

    def number(self, x):
        return exact.to_float32(x) if self.precision == "float" else float(x)

    def uniform(self, low, high):
        return low + (high - low) * self.rng.random()

    def integer(self, low, high):
        return low + int(self.rng.random() * (high - low + 1))

    def choice(self, items):
        return items[self.integer(0, len(items) - 1)]

    def coordinate(self, reach=1.0, digits=3):
        return round(self.uniform(-reach, reach), digits)

    def point(self, reach=1.0, digits=3):
        return [self.coordinate(reach, digits) for _ in range(self.dim)]

    def lattice(self, reach):
        return [self.integer(-reach, reach) for _ in range(self.dim)]

    def direction(self):
        """A unit vector, the same way all around."""
        while True:
            v = [self.uniform(-1, 1) for _ in range(self.dim)]
            square = squared(v)
            if 0.01 < square < 1:
                return [x / sqrt(square) for x in v]

    def rotation(self):
        if self.dim == 2:
            c, s = self.direction()
            return [[c, -s], [s, c]]
        while True:
            q = [self.uniform(-1, 1) for _ in range(4)]
            square = squared(q)
            if 0.01 < square < 1:
                break
        w, x, y, z = (c / sqrt(square) for c in q)
        return [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]

    def small_turn(self, angle):
        m = identity(self.dim)
        i, j = self.choice([(i, j) for i in range(self.dim) for j in range(i)])
        m[i][j], m[j][i] = angle, -angle
        return m

    def quarter_turn(self):
        """One of the cube's own symmetries, mirrors included."""
        axes = list(range(self.dim))
        for i in range(self.dim - 1, 0, -1):
            j = self.integer(0, i)
            axes[i], axes[j] = axes[j], axes[i]
        return [[self.choice((-1, 1)) if j == axes[i] else 0 for j in range(self.dim)] for i in range(self.dim)]

    def shear(self):
        return [[round(self.uniform(-1.5, 1.5), 2) for _ in range(self.dim)] for _ in range(self.dim)]

    def mirror(self):
        m = self.rotation()
        m[0] = [-x for x in m[0]]
        return m

    def singular(self):
        """A map onto a plane or a line."""
        m = self.shear()
        factor = self.choice((0.0, 0.5, -2.0))
        m[self.dim - 1] = [factor * x for x in m[0]]
        if self.integer(0, 3) == 0:
            m[1] = [0.0] * self.dim
        return m

    def pose(self, m=None, p=None, bits=None):
        m = m or self.rotation()
        p = p or [0] * self.dim
        if bits:
            m = [[round(x * 2**bits) / 2**bits for x in row] for row in m]
        return list(chain.from_iterable([*map(self.number, row), self.number(t)] for row, t in zip(m, p)))

    # ---- shapes, about the origin, of a size near 1

    def points(self, count, digits=3):
        return {"shape": "points", "points": [self.point(digits=digits) for _ in range(count)]}

    def hull(self, count):
        """Points all of which are corners: on a sphere, but for rounding."""
        return {"shape": "points", "points": [[round(x, 4) for x in self.direction()] for _ in range(count)]}

    def box(self, low=0.1, high=1.0):
        return {"shape": "box", "half": [round(self.uniform(low, high), 3) for _ in range(self.dim)]}

    def segment(self):
        return {"shape": "segment", "v": [self.point(), self.point()]}

    def triangle(self):
        return {"shape": "triangle", "v": [self.point(), self.point(), self.point()]}

    def single(self):
        return {"shape": "points", "points": [self.point()]}

    def sphere(self):
        return {"shape": "sphere", "r": round(self.uniform(0.1, 1), 3)}

    def capsule(self):
        return {"shape": "capsule", "r": round(self.uniform(0.1, 0.6), 3), "half_length": round(self.uniform(0, 1), 3)}

    def ellipsoid(self):
        return {"shape": "ellipsoid", "radii": [self.integer(1, 96) / 64 for _ in range(self.dim)]}

    def turned(self, kind):
        """Cylinder, cone or disc."""
        shape = {"shape": kind, "r": round(self.uniform(0.1, 1), 3)}
        return shape if kind == "disc" else {**shape, "half_length": round(self.uniform(0.1, 1), 3)}

    def flat(self):
        """One of the simple polytopes."""
        makers = [lambda: self.points(self.integer(1, 7)), self.box, self.segment, self.single]
        return self.choice(makers + [self.triangle] * (self.dim == 3))()

    def curved(self):
        if self.dim == 2:
            return self.ellipsoid()
        return self.choice([self.ellipsoid] + [lambda k=k: self.turned(k) for k in ("cylinder", "cone", "disc")])()

    def any(self):
        return self.choice([self.flat, self.flat, self.curved, self.sphere, self.capsule])()

    def place(self, shape, m=None, p=None):
        """The shape under a pose; an ellipsoid's is short enough to be multiplied by its radii exactly."""
        bits = POSE_BITS[self.precision] if shape["shape"] == "ellipsoid" else None
        return {**shape, "pose": self.pose(m, p, bits)}

    def near(self, low=1.0, high=3.0):
        """A place at some distance from the origin."""
        reach = self.uniform(low, high)
        return [round(reach * x, 3) for x in self.direction()]

    def beside(self, a, b, low=1.0, high=3.0):
        """Both turned at random, a at the origin, b near it."""
        return self.place(a), self.place(b, p=self.near(low, high))


def identity(dim):
    return [[int(i == j) for j in range(dim)] for i in range(dim)]


def moved(draw, shape, step):
    """The shape further on by a step, as far as its numbers allow."""
    dim = draw.dim
    pose = list(shape.get("pose") or draw.pose(identity(dim)))
    for i in range(dim):
        at = i * (dim + 1) + dim
        pose[at] = draw.number(float(Fraction(pose[at]) + step[i]))
    return {**shape, "pose": pose}


def at_gap(draw, a, b, gap):
    """b moved along the normal until about a gap from a (less than 0: into it)."""
    truth = exact.distance(exact_numbers(draw, a), exact_numbers(draw, b), draw.dim)
    if truth.relation != exact.APART:
        return None
    return a, moved(draw, b, [n * (Fraction(gap) - truth.lower) for n in truth.normal])


def exact_numbers(draw, shape):
    return exact.round_to_float(shape) if draw.precision == "float" else shape


# ---- groups: each takes a Draw and gives a pair, or None to be drawn again


def random_hulls(d):
    return d.beside(d.points(d.integer(4, 10)), d.points(d.integer(4, 10)), 0.5, 3.5)


def large_hulls(d):
    return d.beside(d.hull(d.integer(30, 60)), d.hull(d.integer(30, 60)), 1.5, 2.5)


def boxes_aligned(d):
    p = d.near(0, 3)
    return d.box(), d.place(d.box(), d.quarter_turn(), p)


def boxes_turned(d):
    return d.beside(d.box(), d.box())


def boxes_stacked(d):
    """Sizes are dyadic: they touch exactly, on a face, an edge or a corner."""
    a, b = ([d.integer(1, 32) / 16 for _ in range(d.dim)] for _ in (0, 1))
    axis = d.integer(0, d.dim - 1)
    p = [d.integer(-32, 32) / 16 for _ in range(d.dim)]
    p[axis] = d.choice((-1, 1)) * (a[axis] + b[axis])
    return {"shape": "box", "half": a}, d.place({"shape": "box", "half": b}, identity(d.dim), p)


def lattice(d):
    """Few points of a small lattice: touching, flat, repeated, collinear, every sort of contact."""
    reach = d.integer(1, 3)
    step = [d.integer(0, reach + 1)] + [d.integer(-1, 1) for _ in range(d.dim - 1)]
    a = [d.lattice(reach) for _ in range(d.integer(1, 8))]
    b = [[x + s for x, s in zip(d.lattice(reach), step)] for _ in range(d.integer(1, 8))]
    return {"shape": "points", "points": a}, {"shape": "points", "points": b}


def simple_pairs(d):
    return d.beside(d.flat(), d.flat(), 0.2, 2.5)


def rounded(d):
    def one():
        shape = d.flat()
        return d.choice([d.sphere(), d.capsule(), {**shape, "radius": round(d.uniform(0.01, 0.5), 3)}])

    return d.beside(one(), one(), 0.3, 3)


def rounded_touching(d):
    """Pythagorean numbers: the radii meet exactly."""
    x, y, z = d.choice([(3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (20, 21, 29)])
    p = [x, y] + [0] * (d.dim - 2)
    turn = d.quarter_turn()
    p = [sum(row[j] * p[j] for j in range(d.dim)) for row in turn]
    part = d.integer(0, z)
    r, s = part, z - part
    a = d.choice([{"shape": "sphere", "r": r}, {"shape": "points", "points": [[0] * d.dim], "radius": r}])
    return a, d.place({"shape": "sphere", "r": s}, identity(d.dim), p)


def needles_and_plates(d):
    def thin():
        half = [d.choice((1e-4, 1e-3, 1.0)) for _ in range(d.dim)]
        half[d.integer(0, d.dim - 1)] = 1.0
        return {"shape": "box", "half": half}

    return d.beside(thin(), thin(), 0.05, 1.5)


def nearly_parallel(d):
    t = TURN[d.precision] * d.choice((1, 0.1, 10))
    a, b = d.box(0.5), d.box(0.5)
    axis = d.integer(0, d.dim - 1)
    p = [d.coordinate(0.5) for _ in range(d.dim)]
    p[axis] = a["half"][axis] + b["half"][axis] + d.choice((0.5, 0.01, TURN[d.precision]))
    return a, d.place(b, d.small_turn(t), p)


def unlike_sizes(d):
    ratio = RATIO[d.precision]
    big = d.place({"shape": "box", "half": [round(ratio * x, 0) for x in d.box()["half"]]})
    found = at_gap(d, big, d.place(d.box(), p=[3 * ratio * x for x in d.direction()]), d.uniform(0.1, 2))
    return found and d.choice((found, found[::-1]))


def far_away(d):
    far = [Fraction(FAR[d.precision] * x) for x in d.direction()]
    a, b = d.beside(d.any(), d.any())
    return moved(d, a, far), moved(d, b, far)


def repeated_points(d):
    a = d.points(d.integer(2, 4))
    a["points"] = [d.choice(a["points"]) for _ in range(d.integer(4, 8))]
    return d.beside(a, d.points(4), 0.5, 2)


def collinear(d):
    """On one line, or nearly, as the rounding of coordinates has it."""
    p, q = d.point(), d.point()
    ts = [d.uniform(-1, 2) for _ in range(d.integer(3, 6))]
    a = {"shape": "points", "points": [[d.number(x + t * y) for x, y in zip(p, q)] for t in ts]}
    return a, d.place(d.points(d.integer(2, 5)), p=d.near(0.5, 2))


def coplanar(d):
    """Both in one plane, which is turned."""
    turn = d.rotation()
    pair = []
    for shift in (0, d.uniform(0.5, 2.5)):
        flat = [[d.coordinate() + shift] + d.point()[1 : d.dim - 1] + [0] for _ in range(d.integer(3, 5))]
        pair.append(d.place({"shape": "points", "points": flat}, turn))
    return tuple(pair)


def identical(d):
    a = d.place(d.any())
    return a, a


def contained(d):
    a = d.place(d.box(0.8, 1.0))
    b = d.choice([d.sphere, d.box, d.capsule, d.curved, d.single])()
    return d.choice(((a, d.place(b, p=d.near(0, 0.3))), (d.place(b, p=d.near(0, 0.3)), a)))


def gap_of(make):
    def group(d):
        gap = d.choice(GAPS[d.precision]) * d.choice((1, 1, 1, -1))
        return at_gap(d, *d.beside(make(d), make(d), 4, 5), gap)

    return group


def curved_pairs(d):
    return d.beside(d.curved(), d.any(), 0.8, 3)


def curved_touching(d):
    """Across an axis, on dyadic sizes."""
    axis = d.integer(0, d.dim - 1)
    found = []
    for _ in (0, 1):
        size = d.integer(1, 32) / 16
        kind = d.choice(("cylinder", "ellipsoid", "disc", "box") if d.dim == 3 else ("ellipsoid", "box"))
        half = [d.integer(1, 32) / 16 for _ in range(d.dim)]
        if kind in ("cylinder", "disc"):
            shape = {"shape": kind, "r": size} | ({"half_length": half[2]} if kind == "cylinder" else {})
            reach = (size, size, half[2] if kind == "cylinder" else 0)
        else:
            shape, reach = {"shape": kind, {"ellipsoid": "radii", "box": "half"}[kind]: half}, half
        found.append((shape, reach[axis]))
    (a, reach_a), (b, reach_b) = found
    p = [0] * d.dim
    p[axis] = d.choice((-1, 1)) * (reach_a + reach_b)
    return a, d.place(b, identity(d.dim), p)


def maps(make):
    def group(d):
        pair = [d.place(d.choice((d.flat, d.curved))(), make(d), p) for p in (None, d.near(1, 3))]
        return tuple(pair)

    return group


def small(d):
    """A shape with a short pose, or none, to be half of a couple."""
    shape = d.choice([d.flat, d.flat, d.sphere, d.capsule] + [d.curved] * (d.dim == 3))()
    return d.choice((shape, {**shape, "pose": d.pose(d.quarter_turn(), d.point())}))


def couple(d, kind):
    return {"shape": kind, "a": small(d), "b": small(d)}


def couples(kind):
    def group(d):
        a = couple(d, kind)
        if d.integer(0, 2) == 0:
            a["radius"] = round(d.uniform(0.05, 0.3), 2)
        if d.integer(0, 2):
            a = d.place(a, d.choice((d.rotation, d.shear, d.quarter_turn))())
        return a, d.place(d.choice((d.any(), couple(d, "sum"))), p=d.near(1.5, 4))

    return group


def couples_of_couples(d):
    inner = {"shape": "sum", "a": couple(d, "hull"), "b": d.sphere()}
    return {"shape": "hull", "a": inner, "b": small(d)}, d.place(couple(d, "hull"), p=d.near(2, 4))


def no_size(d):
    """Sizes of zero: points, lines and plates in disguise."""

    def one():
        half = [d.choice((0, 0, 0.5)) for _ in range(d.dim)]
        p = d.point(digits=1)
        shapes = [
            {"shape": "box", "half": half},
            {"shape": "sphere", "r": 0},
            {"shape": "capsule", "r": 0, "half_length": 0.5},
            {"shape": "capsule", "r": 0.5, "half_length": 0},
            {"shape": "segment", "v": [p, p]},
            {"shape": "ellipsoid", "radii": half},
        ]
        if d.dim == 3:
            shapes += [
                {"shape": "triangle", "v": [p, d.point(), p]},
                {"shape": "cylinder", "r": 0, "half_length": 0.5},
                {"shape": "cylinder", "r": 0.5, "half_length": 0},
                {"shape": "cone", "r": 0, "half_length": 0},
                {"shape": "disc", "r": 0},
            ]
        return d.choice(shapes)

    return one(), d.place(one(), d.quarter_turn(), d.lattice(1))


def odd_units(d):
    """All lengths times a power of ten."""
    unit = UNIT[d.precision] ** d.choice((-1, 1))
    a, b = d.beside(d.points(4), d.points(4), 0.8, 3)
    a, b = ({**s, "points": [[d.number(x * unit) for x in p] for p in s["points"]]} for s in (a, b))
    pose = [x * unit if (i + 1) % (d.dim + 1) == 0 else x for i, x in enumerate(b["pose"])]
    return a, {**b, "pose": [d.number(x) for x in pose]}


BOTH = {
    "random-hulls": (random_hulls, 20),
    "large-hulls": (large_hulls, 2),
    "boxes-aligned": (boxes_aligned, 20),
    "boxes-turned": (boxes_turned, 24),
    "boxes-stacked": (boxes_stacked, 20),
    "lattice": (lattice, 84),
    "simple": (simple_pairs, 26),
    "rounded": (rounded, 24),
    "rounded-touching": (rounded_touching, 12),
    "needles-plates": (needles_and_plates, 24),
    "nearly-parallel": (nearly_parallel, 24),
    "unlike-sizes": (unlike_sizes, 12),
    "far-away": (far_away, 20),
    "repeated-points": (repeated_points, 10),
    "collinear": (collinear, 14),
    "identical": (identical, 12),
    "contained": (contained, 14),
    "gap-hulls": (gap_of(lambda d: d.points(d.integer(4, 6))), 20),
    "gap-boxes": (gap_of(Draw.box), 20),
    "gap-simple": (gap_of(Draw.flat), 20),
    "gap-curved": (gap_of(Draw.curved), 16),
    "gap-rounded": (gap_of(lambda d: {**d.flat(), "radius": 0.25}), 12),
    "curved": (curved_pairs, 30),
    "curved-touching": (curved_touching, 10),
    "sheared": (maps(Draw.shear), 14),
    "mirrored": (maps(Draw.mirror), 8),
    "singular": (maps(Draw.singular), 14),
    "sum": (couples("sum"), 20),
    "hull": (couples("hull"), 20),
    "nested": (couples_of_couples, 10),
    "no-size": (no_size, 30),
    "odd-units": (odd_units, 8),
}
GROUPS = {2: BOTH, 3: {**BOTH, "coplanar": (coplanar, 14)}}

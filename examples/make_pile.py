# SPDX-License-Identifier: MIT
"""Makes pile2.json: 200 rounded bodies in the plane, dropped and come to rest, and the pairs of them that are near.

    python make_pile.py [OUT]

The fall is pymunk's, with no random numbers but the seeded ones, so it ends the same each time. Bodies at rest stand
on each other a little deep or a little apart, as a solver leaves them."""

import itertools
import math
import pathlib
import random
import sys

import pymunk

import scene

SEED = 3
COUNT = 200
NEAR = 0.06  # a pair is in the scene when its bounding boxes are this near
STEPS, STEP = 2400, 1 / 240
WALL = 0.1


def polygon(rng, size):
    corners = rng.randint(3, 8)
    start, stretch = rng.uniform(0, math.tau), rng.uniform(0.7, 1.0)
    angles = [start + math.tau * (k + rng.uniform(-0.3, 0.3)) / corners for k in range(corners)]
    points = [scene.lengths((size * math.cos(t), stretch * size * math.sin(t))) for t in angles]
    return {"shape": "points", "points": points, "radius": grid(size * rng.uniform(0.05, 0.3))}


def box(rng, size):
    half = scene.lengths((size * rng.uniform(0.5, 1.0), size * rng.uniform(0.3, 0.8)))
    return {"shape": "box", "half": half, "radius": grid(rng.choice([0, 0.1]) * size)}


def disc(rng, size):
    return {"shape": "sphere", "r": grid(size * rng.uniform(0.5, 1.0))}


def capsule(rng, size):
    r, half_length = scene.lengths((size * rng.uniform(0.2, 0.5), size * rng.uniform(0.4, 1.2)))
    return {"shape": "capsule", "r": r, "half_length": half_length}


def grid(x):
    return scene.on_grid(x, scene.LENGTH_STEP)


def outline(body, shape):
    """The same set for pymunk."""
    kind = shape["shape"]
    if kind == "sphere":
        return pymunk.Circle(body, shape["r"])
    if kind == "capsule":
        end = shape["half_length"]
        return pymunk.Segment(body, (0, -end), (0, end), shape["r"])
    return pymunk.Poly(body, corners(shape), radius=shape["radius"])


def corners(shape):
    if shape["shape"] == "points":
        return shape["points"]
    x, y = shape["half"]
    return [(-x, -y), (x, -y), (x, y), (-x, y)]


def fall(rng):
    """(name, shape, position, angle, bounding box) of everything, at rest."""
    space = pymunk.Space()
    space.gravity = 0, -9.81
    space.iterations = 30
    space.collision_slop = 0.0005
    parts = []

    def add(name, shape, body, position, angle=0.0):
        body.position, body.angle = position, angle
        part = outline(body, shape)
        part.density, part.friction = 1.0, 0.6
        space.add(body, part)
        parts.append((name, shape, part))

    for name, half, position, angle in (
        ("ground", (2.5, WALL), (0, -WALL), 0.0),
        ("wall/left", (WALL, 1.2), (-1.85, 0.9), 0.4),
        ("wall/right", (WALL, 1.2), (1.85, 0.9), -0.4),
    ):
        add(name, {"shape": "box", "half": scene.lengths(half), "radius": 0.0}, static_body(), position, angle)
    for n in range(COUNT):
        kind = rng.choice([polygon, polygon, polygon, box, disc, capsule])
        place = (-1.0 + 0.25 * (n % 9) + rng.uniform(-0.04, 0.04), 0.3 + 0.25 * (n // 9))
        shape = kind(rng, rng.uniform(0.05, 0.1))
        add(f"{kind.__name__}{n:03d}", shape, pymunk.Body(), place, rng.uniform(0, math.tau))
    for _ in range(STEPS):
        space.step(STEP)
        for body in space.bodies:
            settle(body)
    # Nothing of pymunk leaves: its parts die with their space.
    return [(n, s, tuple(p.body.position), p.body.angle, p.bb) for n, s, p in parts]


def settle(body):
    """Rounds where the body is and how it moves. The sine of one machine is not that of another in its last bit, and a
    pile would make two different heaps of that; so the last bits go at each step."""
    body.position = tuple(scene.lengths(body.position))
    body.velocity = tuple(scene.lengths(body.velocity))
    body.angle, body.angular_velocity = grid(body.angle), grid(body.angular_velocity)


def static_body():
    return pymunk.Body(body_type=pymunk.Body.STATIC)


def apart(a, b):
    """How far the bounding boxes are apart along the axis where they are most so."""
    return max(a.left - b.right, b.left - a.right, a.bottom - b.top, b.bottom - a.top)


def build():
    bodies, boxes = [], {}
    for name, shape, position, angle, bounds in fall(random.Random(SEED)):
        cos, sin = math.cos(angle), math.sin(angle)
        bodies.append({"name": name, "shape": shape, "pose": scene.pose([[cos, -sin], [sin, cos]], position)})
        boxes[name] = bounds
    return {
        "name": "pile2",
        "dim": 2,
        "units": "metre",
        "licence": "MIT",
        "source": "made up; let fall by pymunk " + pymunk.version,
        "queries": ["distance", "intersect"],
        "bodies": bodies,
        "pairs": [[a, b] for a, b in itertools.combinations(boxes, 2) if apart(boxes[a], boxes[b]) < NEAR],
    }


if __name__ == "__main__":
    beside = pathlib.Path(__file__).with_name("pile2.json")
    scene.write(sys.argv[1] if len(sys.argv) > 1 else beside, build())

# SPDX-License-Identifier: MIT
"""Writes the pairs of a scene as a block of the binary file that the bench reads; tests/compare/pair_file.h says how.

    robot_pairs.py SCENE.json PAIRS FILE     appended: so many of its pairs, spread evenly over them all
"""

import json
import struct
import sys

POINTS, BOX, SEGMENT, CYLINDER, CONE, ELLIPSOID, ORIGIN = range(7)  # enum peer_core
DISTANCE, INTERSECT = 1, 2  # a bit for each question


def core(shape):
    """The core, its points, its sizes and the radius that it is grown by."""
    kind = shape["shape"]
    if kind == "points":
        return POINTS, shape["points"], [], 0.0
    if kind == "box":
        return BOX, [], shape["half"], 0.0
    if kind == "sphere":
        return ORIGIN, [], [], shape["r"]
    if kind == "capsule":
        ends = [[0.0, 0.0, shape["half_length"]], [0.0, 0.0, -shape["half_length"]]]
        return SEGMENT, ends, [], shape["r"]
    if kind == "ellipsoid":
        return ELLIPSOID, [], shape["radii"], 0.0
    sizes = [shape["r"], shape["half_length"]]
    return {"cylinder": CYLINDER, "cone": CONE}[kind], [], sizes, 0.0


def packed(shape, pose):
    what, points, sizes, radius = core(shape)
    rows = [pose[4 * i : 4 * i + 3] for i in range(3)]
    numbers = [*sizes, *[0.0] * (3 - len(sizes)), *sum(rows, []), *pose[3::4], radius, *sum(points, [])]
    return struct.pack(f"=4i{len(numbers)}d", what, len(points), 1, 0, *numbers)


def head(name, pairs):
    questions = DISTANCE | INTERSECT
    return struct.pack("=48s16s16s7i", name, b"scene", b"", 3, 0, questions, pairs, 0, 0, 0)


def main(path, limit, file):
    with open(path, encoding="utf-8") as text:
        scene = json.load(text)
    bodies = {body["name"]: packed(scene["shapes"][body["shape"]], body["pose"]) for body in scene["bodies"]}
    pairs = scene["pairs"]
    count = min(limit, len(pairs))
    with open(file, "ab") as out:
        out.write(head(b"robot", count))
        for i in range(count):
            a, b = pairs[i * len(pairs) // count]
            out.write(bodies[a] + bodies[b])


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3])

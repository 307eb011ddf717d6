# SPDX-License-Identifier: MIT
"""Draws a scene.

    python draw_scene.py SCENE PICTURE [--only q07] [--view ELEVATION AZIMUTH] [--skip NAME ...]

In 3-D, bodies of a moment (their names have a slash after it) are drawn for one moment only."""

import argparse
import json
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from scipy.spatial import ConvexHull

MOMENT = re.compile(r"q\d+/")


def ball(dim):
    if dim == 2:
        angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
        return np.stack([np.cos(angle), np.sin(angle)], axis=1)
    z = np.linspace(-1, 1, 13)
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = np.sqrt(1 - z**2)
    return np.array([[r * np.cos(t), r * np.sin(t), h] for r, h in zip(ring, z, strict=True) for t in angle])


def corners(shape, dim):
    """Points whose hull is the shape, or near it where it is round."""
    kind, r = shape["shape"], shape.get("r", 0)
    top = np.eye(dim)[-1] * shape.get("half_length", 0)
    if kind == "points":
        points = np.array(shape["points"])
    elif kind == "box":
        points = np.array(np.meshgrid(*[[-h, h] for h in shape["half"]])).reshape(dim, -1).T
    elif kind == "ellipsoid":
        points = ball(dim) * shape["radii"]
    elif kind in ("sphere", "ball", "capsule"):
        points = np.concatenate([ball(dim) * r + top, ball(dim) * r - top])
    else:
        rim = np.pad(ball(2) * r, ((0, 0), (0, 1)))
        points = np.concatenate([rim - top, rim + top if kind == "cylinder" else [top]])
    if shape.get("radius"):
        points = (points[:, None] + ball(dim) * shape["radius"]).reshape(-1, dim)
    return placed(points, shape.get("pose"))


def placed(points, pose):
    if pose is None:
        return points
    pose = np.array(pose).reshape(points.shape[1], -1)
    return points @ pose[:, :-1].T + pose[:, -1]


def triangles(points):
    """The hull's faces, outward, cut small: the painter sorts them by their middles."""
    hull = ConvexHull(points)
    faces = points[hull.simplices]
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    inward = np.sum(normals * hull.equations[:, :3], axis=1) < 0
    faces[inward] = faces[inward][:, ::-1]
    while True:
        long = np.linalg.norm(faces - np.roll(faces, -1, axis=1), axis=2).max(axis=1) > 0.1
        if not long.any():
            return faces
        a, b, c = faces[long].transpose(1, 0, 2)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        pieces = [np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
        faces = np.concatenate([faces[~long], *pieces])


def colour(number, name):
    return plt.cm.tab20(number % 20) if "/" not in name or not MOMENT.match(name) else plt.cm.Wistia(number % 7 / 7)


def outlines(scene, options):
    """(colour, points) of each body that is to be drawn."""
    for number, body in enumerate(scene["bodies"]):
        name = body["name"]
        if name in options.skip or (MOMENT.match(name) and not name.startswith(options.only + "/")):
            continue
        shape = body["shape"] if isinstance(body["shape"], dict) else scene["shapes"][body["shape"]]
        yield colour(number, name), placed(corners(shape, scene["dim"]), body.get("pose"))


def draw(scene, options):
    drawn = list(outlines(scene, options))
    every = np.concatenate([points for _, points in drawn])
    names = ("xlim", "ylim", "zlim")[: scene["dim"]]
    limits = dict(zip(names, np.stack([every.min(axis=0), every.max(axis=0)], axis=1), strict=True))
    figure = plt.figure(figsize=(9, 9))
    if scene["dim"] == 2:
        axes = figure.add_subplot()
        for fill, points in drawn:
            axes.add_patch(Polygon(points[ConvexHull(points).vertices], facecolor=fill, edgecolor="k", lw=0.4))
    else:
        axes = figure.add_subplot(projection="3d")
        faces = [triangles(points) for _, points in drawn]
        fills = [fill for (fill, _), f in zip(drawn, faces, strict=True) for _ in f]
        axes.add_collection3d(Poly3DCollection(np.concatenate(faces), facecolors=fills, shade=True, lw=0))
        axes.view_init(*options.view)
    axes.set(**limits)
    axes.set_aspect("equal")
    figure.savefig(options.picture, dpi=110, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description="Draws a scene.")
    parser.add_argument("scene")
    parser.add_argument("picture")
    parser.add_argument("--only", default="q00", metavar="MOMENT")
    parser.add_argument("--view", nargs=2, type=float, default=(18, -150), metavar=("ELEVATION", "AZIMUTH"))
    parser.add_argument("--skip", nargs="*", default=[], metavar="NAME")
    options = parser.parse_args()
    with open(options.scene, encoding="utf-8") as file:
        draw(json.load(file), options)


if __name__ == "__main__":
    main()

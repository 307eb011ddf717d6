# SPDX-License-Identifier: MIT
"""The committed scenes: what they promise, and that their makers still make them."""

import collections
import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest
from scipy.spatial import ConvexHull

HERE = pathlib.Path(__file__).parent
SCENES = {"panda": "make_panda.py", "pile2": "make_pile.py"}
NUMBERS = {
    "points": {"points"},
    "box": {"half"},
    "sphere": {"r"},
    "capsule": {"r", "half_length"},
    "cylinder": {"r", "half_length"},
    "cone": {"r", "half_length"},
    "ellipsoid": {"radii"},
}


@pytest.fixture(params=SCENES)
def scene(request):
    return json.loads((HERE / f"{request.param}.json").read_text())


@pytest.fixture
def panda():
    return json.loads((HERE / "panda.json").read_text())


def shapes(scene):
    in_place = (body["shape"] for body in scene["bodies"] if isinstance(body["shape"], dict))
    return [*scene.get("shapes", {}).values(), *in_place]


def moment(name):
    head = name.split("/")[0]
    return head if head[0] == "q" and head[1:].isdigit() else None


def test_fields(scene):
    for field in ("name", "units", "licence", "source"):
        assert isinstance(scene[field], str), field
        assert scene[field], field
    assert scene["dim"] in (2, 3)
    assert scene["queries"] == ["distance", "intersect"]
    assert scene["licence"] == "MIT" or (HERE / "licences" / f"{scene['licence']}.txt").is_file()


def test_names_resolve(scene):
    names = [body["name"] for body in scene["bodies"]]
    assert len(set(names)) == len(names)
    used = {body["shape"] for body in scene["bodies"] if isinstance(body["shape"], str)}
    assert used == set(scene.get("shapes", {}))
    pairs = [frozenset(pair) for pair in scene["pairs"]]
    assert all(len(pair) == 2 for pair in pairs)
    assert len(set(pairs)) == len(pairs)
    assert set().union(*pairs) <= set(names)


def test_shapes_have_their_numbers(scene):
    for shape in shapes(scene):
        assert shape.keys() - {"shape", "radius"} == NUMBERS[shape["shape"]]
        sizes = [np.ravel(value) for key, value in shape.items() if key not in ("shape", "points")]
        assert all((s >= 0).all() for s in sizes)


@pytest.mark.parametrize("name", SCENES)
def test_every_answer_holds_the_truth(name, tmp_path):
    subprocess.run([sys.executable, "-m", "gjk", "report", HERE / f"{name}.json", "--out", tmp_path], check=True)


def test_floats_hold_every_number_exactly(scene):
    numbers = [np.ravel(value) for shape in shapes(scene) for key, value in shape.items() if key != "shape"]
    numbers += [body["pose"] for body in scene["bodies"]]
    every = np.concatenate(numbers).astype(float)
    assert np.isfinite(every).all()
    assert (every == every.astype(np.float32)).all()


def test_poses_are_rigid_to_rounding(scene):
    dim = scene["dim"]
    for body in scene["bodies"]:
        rotation = np.array(body["pose"]).reshape(dim, dim + 1)[:, :dim]
        # Each entry is rounded by up to 2^-25; a product of two columns gathers 2 dim of these, and their sizes
        # are at most 1.
        assert np.abs(rotation.T @ rotation - np.eye(dim)).max() <= 2 * dim * 2.0**-25, body["name"]
        assert np.linalg.det(rotation) > 0, body["name"]


def extreme(points):
    """Which points are proven to be corners: a direction, kept whole, along which each lies alone at the far end."""
    hull = ConvexHull(points)
    directions = np.zeros_like(points)
    for corners, face in zip(hull.simplices, hull.equations, strict=True):
        directions[corners] += face[:-1]
    exact = [[int(c * 2**200) for c in p] for p in points.tolist()]
    assert all(c / 2**200 == x for e, p in zip(exact, points.tolist(), strict=True) for c, x in zip(e, p, strict=True))
    alone = []
    for number, direction in enumerate(directions.tolist()):
        whole = [int(c * 2**60) for c in direction]
        heights = [sum(d * c for d, c in zip(whole, p, strict=True)) for p in exact]
        alone.append(heights.count(max(heights)) == 1 and heights[number] == max(heights))
    return alone


def test_every_hull_point_is_a_corner(scene):
    clouds = [np.array(shape["points"]) for shape in shapes(scene) if shape["shape"] == "points"]
    assert clouds
    for points in clouds:
        assert all(extreme(points))


def test_panda_is_large_enough_and_small_enough(panda):
    assert (HERE / "panda.json").stat().st_size <= 2_000_000
    assert len(panda["pairs"]) >= 1000
    moments = {moment(body["name"]) for body in panda["bodies"]} - {None}
    assert len(moments) >= 20
    links = collections.Counter(moment(body["name"]) for body in panda["bodies"])
    assert len({links[m] for m in moments}) == 1


def test_panda_pairs_are_of_one_moment_and_of_both_kinds(panda):
    kinds = collections.Counter()
    for a, b in panda["pairs"]:
        kinds[sum(m is not None for m in (moment(a), moment(b)))] += 1
        assert None in (moment(a), moment(b)) or moment(a) == moment(b)
    assert kinds[1] >= 500  # link and thing
    assert kinds[2] >= 500  # link and link
    assert kinds[0] >= 20  # what stands on what


def test_panda_poses_differ_between_moments(panda):
    hands = [tuple(body["pose"]) for body in panda["bodies"] if body["name"].endswith("/hand")]
    assert len(set(hands)) == len(hands)


def test_pile_is_of_the_promised_kinds():
    pile = json.loads((HERE / "pile2.json").read_text())
    kinds = collections.Counter(shape["shape"] for shape in shapes(pile))
    assert all(kinds[kind] >= 10 for kind in ("points", "box", "sphere", "capsule"))
    assert len(pile["bodies"]) >= 200
    assert len(pile["pairs"]) >= 500


@pytest.mark.parametrize("name", SCENES)
def test_made_again_byte_for_byte(name, tmp_path):
    again = tmp_path / "again.json"
    subprocess.run([sys.executable, HERE / SCENES[name], again], check=True)
    assert again.read_bytes() == (HERE / f"{name}.json").read_bytes()

# SPDX-License-Identifier: MIT
"""Shapes as Python objects."""

from __future__ import annotations

import array
import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pairs import poses, shapes

import gjk
from gjk import exact
from gjk.cases import posed, shape_from_json, shape_to_json

SHIFT = (1.0, 0.0, 0.0, 5.0, 0.0, 1.0, 0.0, 6.0, 0.0, 0.0, 1.0, 7.0)
ONE_OF_EACH = [
    gjk.Points([(0, 0, 0), (1, 0, 0), (0, 1, 0)], radius=0.5),
    gjk.Points([], dim=2),
    gjk.Points([(0, 0), (1, 0), (0, 1)], indexed=True),
    gjk.Box((1, 2, 3), pose=SHIFT),
    gjk.Box((1, 2)),
    gjk.Segment([(0, 0), (1, 1)]),
    gjk.Triangle([(0, 0, 0), (1, 0, 0), (0, 1, 0)]),
    gjk.Sphere(2),
    gjk.Sphere(2, dim=2),
    gjk.Capsule(0.5, 2, pose=SHIFT),
    gjk.Capsule(0.5, 2, dim=2),
    gjk.Ball(2, dim=2, radius=1),
    gjk.Ellipsoid((1, 2, 3), radius=0.25),
    gjk.Cylinder(1, 2),
    gjk.Cone(1, 2, pose=SHIFT),
    gjk.Disc(1),
    gjk.Sum(gjk.Box((1, 1, 1)), gjk.Sphere(1)),
    gjk.Hull(gjk.Box((1, 1)), gjk.Sphere(1, dim=2), pose=(1, 2), radius=1),
    gjk.Support(math.prod, reach=2),
]
each = pytest.mark.parametrize("shape", ONE_OF_EACH, ids=lambda shape: f"{type(shape).__name__}{shape.dim}")


@each
def test_repr_is_what_makes_it(shape):
    names = {name: getattr(gjk, name) for name in gjk.__all__}
    if not isinstance(shape, gjk.Support):
        assert eval(repr(shape), names) == shape


@each
def test_pickle_equality_and_hash(shape):
    copy = pickle.loads(pickle.dumps(shape))
    assert copy == shape
    assert hash(copy) == hash(shape)
    assert shape.rounded(1) != shape
    assert shape.at(None).at(shape.pose) == shape
    assert shape != "a shape"


class Cube(gjk.Box):
    """A class whose constructor takes something else."""

    def __init__(self, side):
        super().__init__((side / 2,) * 3)


def test_pickle_of_a_class_of_ones_own():
    cube = Cube(2).at((5, 0, 0)).rounded(0.5)
    copied = pickle.loads(pickle.dumps(cube))
    assert type(copied) is Cube
    assert copied == cube
    assert gjk.distance(copied, gjk.Sphere(1)).value == 2.5


def test_shapes_of_different_classes_differ():
    assert gjk.Ball(1) != gjk.Disc(1)
    assert gjk.Cone(1, 2) != gjk.Cylinder(1, 2)
    assert len({*ONE_OF_EACH, *ONE_OF_EACH}) == len(ONE_OF_EACH)


@each
def test_shapes_are_immutable(shape):
    with pytest.raises(AttributeError, match="immutable"):
        shape.radius = 2.0
    with pytest.raises(AttributeError, match="immutable"):
        del shape.pose


def test_all_forms_of_a_pose():
    table = [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7]]
    square = [*table, [0, 0, 0, 1]]
    couple = ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], (5, 6, 7))
    forms = [SHIFT, list(SHIFT), table, square, couple, (5, 6, 7), iter(SHIFT), array.array("f", SHIFT)]
    forms += [np.array(table), np.array(square, dtype=np.float32), (np.eye(3), np.array([5, 6, 7]))]
    forms += [np.array(square).ravel(), [np.array(row) for row in table], np.array([5, 6, 7], dtype=">f8")]
    for form in forms:
        assert gjk.Box((1, 1, 1)).at(form).pose == SHIFT
    flat = (0.0, -1.0, 2.0, 1.0, 0.0, 3.0)
    forms2 = [flat, [[0, -1, 2], [1, 0, 3]], [[0, -1, 2], [1, 0, 3], [0, 0, 1]], ([[0, -1], [1, 0]], [2, 3])]
    for form in forms2:
        assert gjk.Box((1, 1)).at(form).pose == flat
    assert gjk.Box((1, 1)).at((2, 3)).pose == (1, 0, 2, 0, 1, 3)


def test_poses_of_iterators_are_read_once():
    m, p = ((1, 0), (0, 1)), (5, 6)
    rows = [(1, 0, 5), (0, 1, 6)]
    forms = [(map(iter, m), iter(p)), [iter(map(iter, m)), p], map(iter, rows), [iter(row) for row in rows]]
    forms += [(row for row in rows), iter([m, p]), ((list(row) for row in m), p), [[iter(row) for row in m], iter(p)]]
    for form in forms:
        assert gjk.Box((1, 1)).at(form).pose == (1, 0, 5, 0, 1, 6)


class Frame:
    """A table as others have it: mask is a method, and iteration gives the names of the columns."""

    def __init__(self, table):
        self.table = table

    def mask(self, *_):
        raise NotImplementedError

    def __array__(self, dtype=None, copy=None):
        return np.array(self.table, dtype=dtype)

    def __iter__(self):
        return iter("abcdef"[: len(self.table)])


@pytest.mark.parametrize("dtype", [float, int, object, ">f4"])
def test_tables_that_are_no_arrays(dtype):
    square = np.array([[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]], dtype)
    assert gjk.Points(Frame(square[:, :3])) == gjk.Points(square[:, :3])
    assert gjk.Box(Frame(square[1, 1:]).table) == gjk.Box((1, 0, 6))
    assert gjk.Box(Frame(square[1, 1:])) == gjk.Box((1, 0, 6))
    assert gjk.Box((1, 1, 1)).at(Frame(square)).pose == SHIFT


def test_arrays_of_records():
    cloud = np.array([(0, 0, 0), (1, 2, 3)], [("x", "f8"), ("y", "f4"), ("z", "i4")])
    assert gjk.Points(cloud) == gjk.Points([(0, 0, 0), (1, 2, 3)])


@pytest.mark.parametrize(
    "pose",
    [
        (1, 2),
        range(13),
        [[1, 0, 0, 5]],
        [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1]],
        [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 2]],
        ([[1, 0, 0], [0, 1, 0]], (1, 2, 3)),
        "123",
        7,
        [None] * 12,
    ],
)
def test_what_is_not_a_pose(pose):
    with pytest.raises(gjk.BadArgument, match=r"pose|not") as wrong:
        gjk.Box((1, 1, 1), pose=pose)
    assert wrong.value.status is gjk.Status.BAD_ARGUMENT
    assert isinstance(wrong.value, ValueError)


def test_arrays_of_any_layout():
    cloud = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.5), (0.0, 2.0, 0.25)]
    grid = np.array(cloud)
    forms = [cloud, grid, np.asfortranarray(grid), np.repeat(grid, 2, axis=0)[::2], grid.astype(np.float32)]
    forms += [grid.astype(">f8"), grid.astype(np.float16), (tuple(row) for row in cloud), list(grid)]
    assert {gjk.Points(form) for form in forms} == {gjk.Points(cloud)}
    assert gjk.Points(np.array([[1, 2], [3, 4]])) == gjk.Points([(1, 2), (3, 4)])
    assert gjk.Box(np.array([1, 2, 3])) == gjk.Box((1, 2, 3))


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("dim", [2, 3])
def test_an_index_changes_no_answer(dim, precision):
    rng = np.random.default_rng(dim)
    cloud = rng.normal(size=(300, dim))
    cloud /= np.linalg.norm(cloud, axis=1, keepdims=True)
    plain, indexed = gjk.Points(cloud), gjk.Points(cloud, indexed=True)
    assert indexed.at([1] * dim).indexed
    assert indexed == plain
    for shift in rng.normal(size=(20, dim)):
        other = gjk.Box([0.5] * dim, pose=list(2 * shift))
        for ask in (gjk.distance, gjk.penetration):
            one, two = ask(plain, other, precision=precision), ask(indexed, other, precision=precision)
            assert one.status == two.status
            assert one.value == pytest.approx(two.value, rel=1e-5)
            assert max(one.lower, two.lower) <= min(one.upper, two.upper)


def test_what_is_given_is_copied():
    grid = np.ones((1, 3))
    shape = gjk.Points(grid)
    grid[0, 0] = 7
    assert shape.points == ((1, 1, 1),)


@pytest.mark.parametrize(
    "make",
    [
        lambda: gjk.Points([]),
        lambda: gjk.Points([(1, 2), (1, 2, 3)]),
        lambda: gjk.Points([(1, 2)], dim=3),
        lambda: gjk.Points([(1, 2, 3, 4)]),
        lambda: gjk.Points([1, 2, 3]),
        lambda: gjk.Points(["123"]),
        lambda: gjk.Box((1,)),
        lambda: gjk.Box(("1", "2")),
        lambda: gjk.Box((True, 1)),
        lambda: gjk.Box((10**400, 1)),
        lambda: gjk.Segment([(0, 0)]),
        lambda: gjk.Triangle([(0, 0), (1, 0)]),
        lambda: gjk.Sphere(1, dim=4),
        lambda: gjk.Sphere(None),
        lambda: gjk.Sum(gjk.Sphere(1), 7),
        lambda: gjk.Hull(gjk.Sphere(1), gjk.Sphere(1, dim=2)),
        lambda: gjk.Support("not a function"),
    ],
)
def test_what_is_not_a_shape(make):
    with pytest.raises(gjk.BadArgument):
        make()


def test_nesting_has_an_end():
    shape = gjk.Sphere(1)
    for _ in range(100):
        shape = gjk.Sum(shape, gjk.Sphere(1)).at((0, 0, 0))
    assert gjk.distance(shape, gjk.Sphere(0).at((200, 0, 0))).value == pytest.approx(99)
    with pytest.raises(gjk.BadArgument, match="nested deeper"):
        gjk.Sum(shape, gjk.Sphere(1))


@pytest.mark.parametrize("couple", [gjk.Sum, gjk.Hull])
def test_parts_have_an_end(couple):
    """A part used twice is asked twice, and what uses that twice asks four times."""
    shape = gjk.Box((1, 1, 1))
    for _ in range(12):
        shape = couple(shape, shape).rounded(0)
    times = 4096 if couple is gjk.Sum else 1
    assert gjk.distance(shape, gjk.Sphere(1).at((5000, 0, 0))).value == pytest.approx(4999 - times)
    for one, other in ((shape, gjk.Sphere(1)), (gjk.Sphere(1), shape), (shape, shape)):
        with pytest.raises(gjk.BadArgument, match="parts in all, where 4096 are the most"):
            couple(one, other)


def test_radii_are_added_and_rounded():
    """A sum of two keeps both."""
    sphere, aside = gjk.Sphere(1e16), gjk.Sphere(0).at((1e16 + 64, 0, 0))
    assert sphere.rounded(1) == sphere
    assert gjk.distance(sphere.rounded(1), aside, tight=True).lower > 63
    both = gjk.distance(gjk.Sum(sphere, gjk.Sphere(1)), aside)
    assert both.lower <= 63 <= both.upper


@given(data=st.data(), dim=st.sampled_from([2, 3]))
def test_json_and_back(data, dim):
    tells = data.draw(shapes(dim))
    shape = shape_from_json(tells, dim)
    again = shape_from_json(shape_to_json(shape), dim)
    assert again == shape
    there, back = exact.distance(tells, shape_to_json(shape), dim), exact.distance(tells, tells, dim)
    assert there.lower == back.lower == 0


def test_a_ball_is_asked_as_one_again():
    """Not as an ellipsoid, whose last places are others."""
    a, b = gjk.Ball(0.7).at((0.1, 0.2, 0.3)), gjk.Ball(0.9).at((3, 1, 2))
    assert shape_to_json(gjk.Ball(0.7)) == {"shape": "ball", "r": 0.7}
    again = [shape_from_json(shape_to_json(shape), 3) for shape in (a, b)]
    assert gjk.distance(*again) == gjk.distance(a, b)


@given(data=st.data(), dim=st.sampled_from([2, 3]))
def test_a_posed_shape_keeps_both_poses(data, dim):
    """body.pose(shape.pose(x)), then the radius, whatever the poses are."""
    inner, outer = data.draw(poses(dim)), data.draw(poses(dim))
    result = gjk.distance(posed(gjk.Box([1.0] * dim, pose=inner, radius=0.5), outer), gjk.Points([[9.0] * dim]))
    box = {"shape": "box", "half": [1.0] * dim, "pose": inner}
    origin = {"shape": "points", "points": [[0.0] * dim]}
    body = {"shape": "sum", "a": box, "b": origin, "pose": outer, "radius": 0.5}
    truth = exact.distance(body, {"shape": "points", "points": [[9.0] * dim]}, dim)
    assert result.lower <= truth.upper
    assert truth.lower <= result.upper


def test_poses_that_need_no_care_stay_simple():
    box = gjk.Box((1, 1, 1))
    assert posed(box, None) == box
    assert posed(box, SHIFT) == box.at(SHIFT)
    assert posed(box.at(SHIFT), None) == box.at(SHIFT)


@pytest.mark.parametrize("dim", [np.int64(2), np.uint8(2), np.array(2)])
def test_dim_is_any_integer(dim):
    ball = gjk.Ball(1, dim=dim)
    assert ball.dim == 2
    assert type(ball.dim) is int
    assert gjk.distance(ball, gjk.Sphere(1, dim=dim, pose=(3, 0))).value == 1


@pytest.mark.parametrize("dim", [np.float64(2), np.bool_(True), True, np.array([2, 2]), "2", None, 4])
def test_dim_is_2_or_3(dim):
    with pytest.raises(gjk.BadArgument, match="the integer 2 or 3"):
        gjk.Ball(1, dim=dim)

# SPDX-License-Identifier: MIT
"""Random shapes as case objects, half of them degenerate, and what the truth allows an answer to be."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from hypothesis import strategies as st

import gjk
from gjk import exact
from gjk.cases import shape_from_json

UNIT = {"double": Fraction(1, 2**53), "float": Fraction(1, 2**24)}

# Small integers make parallel faces, shared corners and exact contact; the rest is anything.
lattice = st.integers(-3, 3).map(float)
anywhere = st.floats(-10, 10, width=32).filter(lambda x: x == 0 or abs(x) > 1e-6)
coordinate = lattice | anywhere
size = st.integers(0, 3).map(float) | st.floats(0.0009765625, 5, width=32)


@st.composite
def poses(draw: Any, dim: int) -> list[float]:
    """A turn, a lattice map (mirrors, shears, flat ones), or none; and a shift."""
    m = draw(st.one_of(turns(dim), st.lists(lattice, min_size=dim * dim, max_size=dim * dim)))
    p = draw(st.lists(coordinate, min_size=dim, max_size=dim))
    return [c for i in range(dim) for c in (*m[i * dim : (i + 1) * dim], p[i])]


@st.composite
def turns(draw: Any, dim: int) -> list[float]:
    m = [float(i == j) for i in range(dim) for j in range(dim)]
    for i, j in ((0, 1), (1, 2))[: dim - 1]:
        angle = draw(st.sampled_from([0.0, math.pi / 2, 1e-9, 1e-4]) | st.floats(-3, 3))
        c, s = math.cos(angle), math.sin(angle)
        for row in range(dim):
            x, y = m[row * dim + i], m[row * dim + j]
            m[row * dim + i], m[row * dim + j] = c * x + s * y, c * y - s * x
    return m


def points(dim: int, least: int = 1, most: int = 8) -> Any:
    return st.lists(st.lists(coordinate, min_size=dim, max_size=dim), min_size=least, max_size=most)


def sets(dim: int) -> Any:
    """The kinds of shape without pose and radius."""
    half = st.lists(size, min_size=dim, max_size=dim)
    kinds = [
        st.fixed_dictionaries({"shape": st.just("points"), "points": points(dim)}),
        st.fixed_dictionaries({"shape": st.just("box"), "half": half}),
        st.fixed_dictionaries({"shape": st.just("sphere"), "r": size}),
        st.fixed_dictionaries({"shape": st.just("capsule"), "r": size, "half_length": size}),
        st.fixed_dictionaries({"shape": st.just("segment"), "v": points(dim, 2, 2)}),
        st.fixed_dictionaries({"shape": st.just("triangle"), "v": points(dim, 3, 3)}),
        st.fixed_dictionaries({"shape": st.just("ellipsoid"), "radii": half}),
        st.fixed_dictionaries({"shape": st.just("ball"), "r": size}),
    ]
    if dim == 3:
        round_ = {"r": size, "half_length": size}
        kinds += [st.fixed_dictionaries({"shape": st.just(kind), **round_}) for kind in ("cylinder", "cone")]
        kinds.append(st.fixed_dictionaries({"shape": st.just("disc"), "r": size}))
    return st.one_of(kinds)


@st.composite
def shapes(draw: Any, dim: int, couples: bool = True) -> dict[str, Any]:
    if couples and draw(st.integers(0, 4)) == 0:
        kind = draw(st.sampled_from(["sum", "hull"]))
        shape = {"shape": kind, "a": draw(shapes(dim, False)), "b": draw(shapes(dim, False))}
    else:
        shape = draw(sets(dim))
    if draw(st.booleans()):
        shape = {**shape, "pose": draw(poses(dim))}
    if draw(st.integers(0, 3)) == 0:
        shape = {**shape, "radius": draw(size)}
    return shape


@st.composite
def pairs(draw: Any, couples: bool = True) -> tuple[int, dict[str, Any], dict[str, Any]]:
    dim = draw(st.sampled_from([2, 3]))
    return dim, draw(shapes(dim, couples)), draw(shapes(dim, couples))


SHARP = {"points", "box", "segment", "triangle", "sphere", "capsule"}


@st.composite
def sharp_shapes(draw: Any, dim: int) -> dict[str, Any]:
    """Those with corners that the library knows."""
    shape = draw(sets(dim).filter(lambda shape: shape["shape"] in SHARP))
    if draw(st.booleans()):
        shape = {**shape, "pose": draw(poses(dim))}
    if shape["shape"] not in ("sphere", "capsule") and draw(st.integers(0, 3)) == 0:
        shape = {**shape, "radius": draw(size)}
    return shape


@st.composite
def sharp_pairs(draw: Any) -> tuple[int, dict[str, Any], dict[str, Any]]:
    dim = draw(st.sampled_from([2, 3]))
    return dim, draw(sharp_shapes(dim)), draw(sharp_shapes(dim))


def prepared(pair: Any, precision: str) -> tuple[gjk.Shape, gjk.Shape, exact.Truth]:
    """The shapes, and the truth about them as this precision holds them."""
    dim, a, b = pair
    if precision == "float":
        a, b = exact.round_to_float(a), exact.round_to_float(b)
    return shape_from_json(a, dim), shape_from_json(b, dim), exact.distance(a, b, dim)


def holds(result: gjk.Result, truth: exact.Truth) -> bool:
    """Whether a bracket of the distance holds the truth."""
    return result.lower <= truth.upper and truth.lower <= result.upper and inside(result)


def inside(result: gjk.Result) -> bool:
    return result.lower <= result.value <= result.upper


def length(x: Any) -> float:
    return math.sqrt(sum(c * c for c in x))

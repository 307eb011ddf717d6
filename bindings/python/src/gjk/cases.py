# SPDX-License-Identifier: MIT
"""Cases and shapes as JSON objects: the one format of tests, tools and bug reports.

A case is {"id", "dim": 2 | 3, "precision": "double" | "float", "query": "distance" | "intersect" | "penetration",
"a": SHAPE, "b": SHAPE, "options": {...}}. Fields not known here are ignored, but for those of "options": an option that
is misspelt would not do what it was written for. SHAPE is described in `shape_from_json`.
"""

from __future__ import annotations

from typing import Any, Callable

from .errors import BadArgument, Error, Status, about, told
from .query import Result, distance, intersect, penetration
from .shapes import (
    Ball,
    Box,
    Capsule,
    Cone,
    Cylinder,
    Disc,
    Ellipsoid,
    Hull,
    Points,
    Segment,
    Shape,
    Sphere,
    Sum,
    Triangle,
)

__all__ = ["QUERIES", "dimension", "posed", "result_to_json", "shape_from_json", "shape_to_json", "solve_case"]

OPTIONS = {
    "distance": ("cutoff", "max_steps", "abs_tol", "rel_tol", "slack", "tight"),
    "intersect": ("max_steps", "slack", "tight"),
    "penetration": ("cutoff", "max_steps", "abs_tol", "rel_tol", "slack", "tight", "corners"),
}
QUERIES = tuple(OPTIONS)
_FUNCTIONS: dict[str, Callable[..., Result]] = dict(zip(QUERIES, (distance, intersect, penetration)))


def dimension(dim: Any) -> int:
    """The number that a field "dim" holds."""
    if dim not in (2, 3) or isinstance(dim, (bool, float)):
        raise BadArgument(f"dim is 2 or 3, not {told(dim)}")
    return int(dim)


def shape_from_json(shape: Any, dim: int) -> Shape:
    """The shape that a JSON object tells of.

    {"shape": KIND, ...} with the fields of the kind - points: points; box: half; segment, triangle: v; sphere, ball,
    disc: r; capsule, cylinder, cone: r and half_length; ellipsoid: radii; sum, hull: a and b - and for every kind
    "radius" and "pose", dim * (dim + 1) numbers.
    """
    if not isinstance(shape, dict):
        raise BadArgument(f"a shape is an object, not {told(shape)}")
    kind = shape.get("shape")
    make = _KINDS.get(kind) if isinstance(kind, str) else None
    if make is None:
        raise BadArgument(f"no such shape: {told(kind)}")
    try:
        made = make(shape, dim)
    except KeyError as missing:
        raise BadArgument(f"{kind} without {missing}") from None
    if made.dim != dim:
        raise BadArgument(f"{kind}: {made.dim}-D in a {dim}-D case")
    made = made.at(shape.get("pose"))
    radius = shape.get("radius")
    if radius is None or type(radius) in (int, float) and radius == 0:
        return made
    if isinstance(made, (Sphere, Capsule)):
        return Sum(made, Sphere(radius, dim=dim))  # adding the radii in Python would round
    return made.rounded(radius)


def _part(whole: dict[str, Any], name: str, dim: int) -> Shape:
    with about(name):
        return shape_from_json(whole[name], dim)


_KINDS: dict[str, Callable[[dict[str, Any], int], Shape]] = {
    "points": lambda s, dim: Points(s["points"], dim=dim),
    "box": lambda s, dim: Box(s["half"]),
    "segment": lambda s, dim: Segment(s["v"]),
    "triangle": lambda s, dim: Triangle(s["v"]),
    "sphere": lambda s, dim: Sphere(s["r"], dim=dim),
    "capsule": lambda s, dim: Capsule(s["r"], s["half_length"], dim=dim),
    "ball": lambda s, dim: Ball(s["r"], dim=dim),
    "cylinder": lambda s, dim: Cylinder(s["r"], s["half_length"]),
    "cone": lambda s, dim: Cone(s["r"], s["half_length"]),
    "disc": lambda s, dim: Disc(s["r"]),
    "ellipsoid": lambda s, dim: Ellipsoid(s["radii"]),
    "sum": lambda s, dim: Sum(_part(s, "a", dim), _part(s, "b", dim)),
    "hull": lambda s, dim: Hull(_part(s, "a", dim), _part(s, "b", dim)),
}


def shape_to_json(shape: Shape) -> dict[str, Any]:
    """The JSON object of a shape; a Support has none."""
    made = _fields(shape)
    if shape.pose is not None:
        made["pose"] = list(shape.pose)
    if shape.radius and not isinstance(shape, (Sphere, Capsule)):
        made["radius"] = shape.radius
    return made


def _fields(shape: Shape) -> dict[str, Any]:
    kind = type(shape).__name__.lower()
    if isinstance(shape, Sphere):
        return {"shape": kind, "r": shape.radius}
    if isinstance(shape, Capsule):
        return {"shape": kind, "r": shape.radius, "half_length": shape.half_length}
    if isinstance(shape, (Sum, Hull)):
        return {"shape": kind, "a": shape_to_json(shape.a), "b": shape_to_json(shape.b)}
    if kind not in _KINDS:
        raise BadArgument(f"{shape!r} cannot be written as JSON")
    return {"shape": kind, **{name: _listed(getattr(shape, name)) for name in shape._sizes}}


def _listed(value: Any) -> Any:
    return [_listed(v) for v in value] if isinstance(value, tuple) else value


def posed(shape: Shape, pose: Any) -> Shape:
    """The set { pose(x) : x in the shape without its radius }, grown by that radius.

    Where the shape has a pose of its own, the two stay apart: their product would round.
    """
    if shape.pose is None or pose is None:
        return shape if pose is None else shape.at(pose)
    core = shape._with(radius=0.0)
    return Sum(core, Points([(0.0,) * shape.dim])).at(pose).rounded(shape.radius)


def solve_case(case: dict[str, Any], query: str | None = None) -> dict[str, Any]:
    """The answer to a case as a JSON object. query is the question where the case does not say one.

    Bad input makes an object with the status and a message; nothing is raised.
    """
    answer = {"id": case["id"]} if "id" in case else {}
    asked = case.get("query", query or QUERIES[0])
    if asked not in QUERIES:
        return {
            **answer,
            "status": "unsupported query",
            "message": f"query {told(asked)}; known are {', '.join(QUERIES)}",
        }
    try:
        return {**answer, **result_to_json(_ask(case, asked))}
    except RecursionError:
        return {**answer, "status": Status.BAD_ARGUMENT.label, "message": "shapes nested too deep"}
    except Error as wrong:
        return {**answer, "status": wrong.status.label, "message": str(wrong)}


def _ask(case: dict[str, Any], asked: str) -> Result:
    dim = dimension(case.get("dim", 3))
    if "a" not in case or "b" not in case:
        raise BadArgument("a case has two shapes, a and b")
    a, b = _part(case, "a", dim), _part(case, "b", dim)
    given = {} if case.get("options") is None else case["options"]
    if not isinstance(given, dict):
        raise BadArgument(f"options is an object, not {told(given)}")
    unknown = [name for name in given if name not in OPTIONS["penetration"]]
    if unknown:
        raise BadArgument(f"no such option: {unknown[0]!r}; known are {', '.join(OPTIONS['penetration'])}")
    options = {name: given[name] for name in OPTIONS[asked] if name in given}
    return _FUNCTIONS[asked](a, b, precision=case.get("precision", "double"), **options)


def result_to_json(result: Result) -> dict[str, Any]:
    """A result as a JSON object. "intersect" is there where the bracket proves it either way."""
    answer = {**result._asdict(), "status": result.status.label}
    meet = _meet(result)
    if meet is not None:
        answer["intersect"] = meet
    return answer


def _meet(result: Result) -> bool | None:
    if result.lower > 0:
        return False
    return True if result.upper <= 0 else None

# SPDX-License-Identifier: MIT
"""Scenes: bodies, and the pairs of them to ask about."""

from __future__ import annotations

import itertools
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from ..cases import dimension, posed, shape_from_json, shape_to_json
from ..errors import BadArgument, about, told
from ..exact import round_to_float
from ..shapes import Shape

__all__ = ["Pair", "Scene", "SceneError", "load"]


class SceneError(ValueError):
    """A file that is not a scene."""


class Pair(NamedTuple):
    name_a: str
    name_b: str
    a: Shape
    b: Shape


@dataclass(frozen=True)
class Scene:
    name: str
    dim: int
    pairs: list[Pair]
    total: int
    """Pairs of the whole scene; pairs may be a part of them."""
    source: str

    def rounded(self) -> list[Pair]:
        """The pairs with every number rounded to float."""
        known: dict[int, Shape] = {}

        def single(name: str, shape: Shape) -> Shape:
            if id(shape) not in known:
                try:
                    known[id(shape)] = shape_from_json(round_to_float(shape_to_json(shape)), self.dim)
                except OverflowError:
                    raise SceneError(f"{name}: out of the range of float: ask with --precision double") from None
            return known[id(shape)]

        return [Pair(p.name_a, p.name_b, single(p.name_a, p.a), single(p.name_b, p.b)) for p in self.pairs]


def load(path: Path, limit: int | None = None) -> Scene:
    """Read a scene file. limit: take that many of its pairs, evenly spread over them all."""
    try:
        return _scene(json.loads(path.read_bytes()), path.stem, limit)
    except RecursionError:
        raise SceneError(f"{path}: not a scene: nested too deep") from None
    except ValueError as wrong:
        raise SceneError(f"{path}: not a scene: {wrong}") from None


def _scene(scene: Any, stem: str, limit: int | None) -> Scene:
    dim = dimension(_field(scene, "dim", "a scene"))
    bodies = _bodies(scene, dim)
    couples = _couples(_field(scene, "pairs", "a scene"), bodies)
    pairs = [Pair(a, b, bodies[a], bodies[b]) for a, b in _spread(couples, limit)]
    if not pairs:
        raise BadArgument("there are no pairs")
    return Scene(_text(scene.get("name", stem)), dim, pairs, len(couples), _text(scene.get("source", "")))


def _field(whole: Any, name: str, what: str) -> Any:
    if not isinstance(whole, dict):
        raise BadArgument(f"{what} is an object, not {told(whole)}")
    if name not in whole:
        raise BadArgument(f"{what} without {name!r}")
    return whole[name]


def _text(words: Any) -> str:
    """Such that it can be printed and written: JSON can spell halves of characters."""
    return str(words).encode("utf-8", "replace").decode("utf-8")


def _bodies(scene: dict[str, Any], dim: int) -> dict[str, Shape]:
    """The bodies by their names, each of which is of one body alone."""
    shapes, listed = scene.get("shapes", {}), _field(scene, "bodies", "a scene")
    if not isinstance(shapes, dict):
        raise BadArgument(f"shapes is an object, not {told(shapes)}")
    if not isinstance(listed, list):
        raise BadArgument(f"bodies is a list, not {told(listed)}")
    ready = {name: _named(name, shape, dim) for name, shape in shapes.items()}
    bodies: dict[str, Shape] = {}
    for number, body in enumerate(listed, 1):
        name = _field(body, "name", f"body {number}")
        if not isinstance(name, str) or name in bodies:
            raise BadArgument(f"body {number}: its name is {told(name)}, which is no text or that of another body")
        bodies[name] = _body(body, dim, ready, f"body {told(name)}")
    return bodies


def _named(name: str, shape: Any, dim: int) -> Shape:
    with about(f"shape {told(name)}"):
        return shape_from_json(shape, dim)


def _body(body: dict[str, Any], dim: int, ready: dict[str, Shape], what: str) -> Shape:
    shape = _field(body, "shape", what)
    with about(what):
        if isinstance(shape, str) and shape not in ready:
            raise BadArgument(f"no shape {told(shape)} in shapes")
        made = ready[shape] if isinstance(shape, str) else shape_from_json(shape, dim)
        return posed(made, body.get("pose"))


def _couples(pairs: Any, bodies: dict[str, Shape]) -> list[tuple[str, str]]:
    """The names of the two bodies of each pair."""
    if pairs == "all":
        return list(itertools.combinations(bodies, 2))
    if not isinstance(pairs, list):
        raise BadArgument(f'pairs is a list or "all", not {told(pairs)}')
    for number, pair in enumerate(pairs, 1):
        if not (isinstance(pair, list) and len(pair) == 2 and all(isinstance(name, str) for name in pair)):
            raise BadArgument(f"pair {number} is the names of two bodies, not {told(pair)}")
        unknown = [name for name in pair if name not in bodies]
        if unknown:
            raise BadArgument(f"pair {number}: no body {told(unknown[0])}")
    return [(a, b) for a, b in pairs]


def _spread(items: list[Any], limit: int | None) -> list[Any]:
    if limit is None or limit >= len(items):
        return items
    return [items[i * len(items) // limit] for i in range(limit)]

# SPDX-License-Identifier: MIT
"""Scenes: bodies, and the pairs of them to ask about."""

from __future__ import annotations

import itertools
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from ..cases import dimension, posed, shape_from_json, shape_to_json
from ..errors import Error
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
                    raise SceneError(f"{name}: a number out of the range of float") from None
            return known[id(shape)]

        return [Pair(p.name_a, p.name_b, single(p.name_a, p.a), single(p.name_b, p.b)) for p in self.pairs]


def load(path: Path, limit: int | None = None) -> Scene:
    """Read a scene file. limit: take that many of its pairs, evenly spread over them all."""
    try:
        scene = json.loads(path.read_bytes())
        bodies = _bodies(scene)
        names = scene["pairs"]
        couples = list(itertools.combinations(bodies, 2)) if names == "all" else [(a, b) for a, b in names]
        chosen = _spread(couples, limit)
        pairs = [Pair(a, b, bodies[a], bodies[b]) for a, b in chosen]
    except KeyError as missing:
        raise SceneError(f"{path}: no {missing}") from None
    except RecursionError:
        raise SceneError(f"{path}: not a scene: nested too deep") from None
    except (Error, ValueError, TypeError, AttributeError) as wrong:
        raise SceneError(f"{path}: not a scene: {wrong}") from None
    if not pairs:
        raise SceneError(f"{path}: a scene without pairs")
    name, source = scene.get("name", path.stem), scene.get("source", "")
    return Scene(_text(name), scene["dim"], pairs, len(couples), _text(source))


def _text(words: Any) -> str:
    """Such that it can be printed and written: JSON can spell halves of characters."""
    return str(words).encode("utf-8", "replace").decode("utf-8")


def _bodies(scene: dict[str, Any]) -> dict[str, Shape]:
    dim, shapes = dimension(scene["dim"]), scene.get("shapes", {})
    ready = {name: shape_from_json(shape, dim) for name, shape in shapes.items()}
    bodies = {}
    for body in scene["bodies"]:
        shape = body["shape"]
        made = ready[shape] if isinstance(shape, str) else shape_from_json(shape, dim)
        bodies[body["name"]] = posed(made, body.get("pose"))
    return bodies


def _spread(items: list[Any], limit: int | None) -> list[Any]:
    if limit is None or limit >= len(items):
        return items
    return [items[i * len(items) // limit] for i in range(limit)]

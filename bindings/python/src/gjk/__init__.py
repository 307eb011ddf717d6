# SPDX-License-Identifier: MIT
"""gjk: how two convex sets stand to each other, with proof.

    >>> import gjk
    >>> box = gjk.Box((1, 1, 1))
    >>> rod = gjk.Capsule(0.5, 2).at((4, 0, 0))
    >>> answer = gjk.distance(box, rod)
    >>> answer.value, answer.lower <= 2.5 <= answer.upper
    (2.5, True)
    >>> answer = gjk.penetration(box, rod.at((1, 0, 0)))
    >>> answer.value, answer.lower <= -0.5 <= answer.upper
    (-0.5, True)

Every answer is a bracket, lower <= truth <= upper, that holds in floating point and whenever the query stops.
It is of the numbers as they are held: what is given, of any kind of real numbers, is taken as the nearest double, and
in precision "float" as the float nearest to that.

Lengths are in any one unit; there are no angles. The poses put both shapes in one frame, and points and normals
come back in that frame. Shapes are immutable; what is given to them is copied. Threads may share shapes, but not a
cache; README.md says how much stack they need.
"""

from __future__ import annotations

from ._gjk import lib as _lib
from .errors import BadArgument, BadSupport, Error, Status
from .query import Cache, Relation, Result, Separation, distance, intersect, penetration
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
    Support,
    Triangle,
)

__all__ = [
    "BadArgument",
    "BadSupport",
    "Ball",
    "Box",
    "Cache",
    "Capsule",
    "Cone",
    "Cylinder",
    "Disc",
    "Ellipsoid",
    "Error",
    "Hull",
    "Points",
    "Relation",
    "Result",
    "Segment",
    "Separation",
    "Shape",
    "Sphere",
    "Status",
    "Sum",
    "Support",
    "Triangle",
    "__version__",
    "distance",
    "intersect",
    "penetration",
]

_number = _lib.gjk_version()
__version__ = f"{_number // 10000}.{_number // 100 % 100}.{_number % 100}"

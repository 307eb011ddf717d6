# SPDX-License-Identifier: MIT
"""The questions: how far apart, do they meet, and how deep in each other."""

from __future__ import annotations

from enum import Enum
from operator import index
from typing import Any, NamedTuple

from ._gjk import ffi
from ._native import Variant, ask_with_callbacks, variant
from .coordinates import number
from .errors import BadArgument, Status, error, told
from .shapes import Shape

__all__ = ["Cache", "Relation", "Result", "Separation", "distance", "intersect", "penetration"]

OWN_CORNERS = 64
"""For so many corners C has room of its own."""


class Result(NamedTuple):
    """An answer with its proof. Lengths are in the unit of the shapes, points and normal in their common frame."""

    value: float
    """The answer, inside the bracket."""
    lower: float
    """Proven: the truth is not below."""
    upper: float
    """Proven: the truth is not above."""
    point_a: tuple[float, ...]
    """A point of a. Where the shapes are apart, it is as far from point_b as upper says, and where the bracket is tight
    the two are a closest pair. Where the shapes meet, it is by `penetration` the point of a that lies deepest in b;
    otherwise it is the same point as point_b, by `intersect` to within the bracket."""
    point_b: tuple[float, ...]
    """A point of b, which stands to point_a as is said there. Where the shapes meet, it is by `penetration` the point
    of b that lies deepest in a."""
    normal: tuple[float, ...]
    """Unit, from a to b, always; where lower is not 0, the direction that realises it."""
    status: Status
    steps: int
    """Steps taken. A step is one support call on each shape."""
    supports: int
    """Support calls, both shapes together."""


class Relation(Enum):
    """How two sets stand to each other."""

    APART = "apart"
    OVERLAPPING = "overlapping"
    MEETING = "meeting"
    """Proven to have points in common; whether they overlap or touch exactly is not told."""
    TOUCHING = "touching"
    """Contact, to this precision: rounding, or the slack given, allows no verdict on either side of it."""
    UNDECIDED = "undecided"
    """Stopped by max_steps before a proof was found."""


class Separation(Result):
    """The answer of `intersect`: a bracket of the signed separation, which is the distance of sets that are apart
    and minus the depth of an overlap. It is only as tight as the proof needs."""

    __slots__ = ()

    @property
    def relation(self) -> Relation:
        if self.lower > 0:
            return Relation.APART
        if self.upper < 0:
            return Relation.OVERLAPPING
        if self.upper == 0:
            return Relation.MEETING
        return Relation.UNDECIDED if self.status is Status.LIMIT else Relation.TOUCHING


class Cache:
    """A warm start: where the last query of a pair ended.

    Hand one cache to each query of the same pair; a query of a pair that has moved a little then needs about one
    support call on each shape. Move the shapes with `at`, which keeps the set itself: a set built anew is another
    set to the cache. Meeting other shapes costs time, never truth. Threads may share shapes, but not a cache.
    """

    __slots__ = ("_held", "_native")

    def __init__(self) -> None:
        self._native: dict[str, Any] = {}
        self._held: dict[str, tuple[Any, ...]] = {}

    def __repr__(self) -> str:
        return f"<gjk.Cache {'warm' if self._held else 'cold'}>"

    def __reduce__(self) -> tuple[Any, ...]:
        """A copy starts cold: what makes this one warm are addresses."""
        return Cache, ()

    def clear(self) -> None:
        """Forget everything: the next query starts cold."""
        self._native.clear()
        self._held.clear()

    def _prepare(self, v: Variant) -> Any:
        """The C struct for a variant."""
        native = self._native.get(v.name)
        if native is None:
            native = self._native[v.name] = v.new("cache")
        return native

    def _settle(self, v: Variant, native: Any, a: Shape, b: Shape) -> None:
        """Keep alive the shapes that C remembers after a query, and no others.

        It knows them by the addresses of their data, which are not to be free for other sets. Not each query
        changes what it remembers: some are told without a search, or refused.
        """
        cleared = self._native.get(v.name) is not native  # meanwhile, by a support
        if cleared:
            return
        shapes = {shape._native(v).struct.data: shape for shape in (*self._held.get(v.name, ()), a, b)}
        self._held[v.name] = tuple(shapes[data] for data in dict.fromkeys(native.data) if data in shapes)


def distance(
    a: Shape,
    b: Shape,
    *,
    precision: str = "double",
    cutoff: float = 0.0,
    max_steps: int = 0,
    abs_tol: float = 0.0,
    rel_tol: float = 0.0,
    slack: float = 0.0,
    tight: bool = False,
    cache: Cache | None = None,
) -> Result:
    """How far apart are a and b? 0 where they meet.

    The query stops at upper - lower <= abs_tol + rel_tol * upper; both 0, the default: as tight as rounding allows.
    cutoff > 0: stop once the answer is proven above it (Status.DECIDED). max_steps 0: 256. slack is how far a
    support may fall short of the farthest point, beyond its rounding; it widens the bracket. tight: of points, boxes,
    segments, capsules, triangles and spheres, in any pose and rounded or not, value is within one unit in the last
    place of the truth and the bracket two units wide, by exact arithmetic; for other shapes it changes nothing. Where
    a pair has sizes that are some 1e-115 of others, these are left out, and the bracket is wider by that.
    precision "float" rounds the shapes and the options to single precision and solves there: the bracket is then of
    the distance between the rounded shapes. A cutoff that is 0 there is refused.
    """
    v = _variant(a, b, precision)
    options = _Options(cutoff, max_steps, abs_tol, rel_tol, slack, tight)
    return Result._make(_ask(v, v.distance, a, b, options, cache))


def intersect(
    a: Shape,
    b: Shape,
    *,
    precision: str = "double",
    max_steps: int = 0,
    slack: float = 0.0,
    tight: bool = False,
    cache: Cache | None = None,
) -> Separation:
    """Do a and b meet? Ends at the first proof; `relation` of the answer says what was proven.

    The options are as for `distance`, of which cutoff and tolerances have no part in this.
    """
    v = _variant(a, b, precision)
    options = _Options(max_steps=max_steps, slack=slack, tight=tight)
    return Separation._make(_ask(v, v.intersect, a, b, options, cache))


def penetration(
    a: Shape,
    b: Shape,
    *,
    precision: str = "double",
    cutoff: float = 0.0,
    max_steps: int = 0,
    abs_tol: float = 0.0,
    rel_tol: float = 0.0,
    slack: float = 0.0,
    tight: bool = False,
    corners: int = OWN_CORNERS,
    cache: Cache | None = None,
) -> Result:
    """How far apart are a and b, or how deep in each other? The signed separation: the distance where they are apart,
    else minus the depth, the length of the shortest move of one of them that leaves them touching. To move b by
    -value * normal is such a move.

    The depth is sought by a polytope that grows within the difference of the shapes. corners is how many it may have,
    from 8 to 16000. Where they run out (Status.LIMIT) the bracket holds, and is wider than asked. 64, the default, do
    for everyday bodies with corners, and for round ones unless they are all but concentric; C takes the room for them
    from its stack, other numbers cost an allocation a call. Round bodies in float are asked in double, whose corners
    take more room: of these it has 64, or some 0.6 of corners where that is more.
    The other options are those of `distance`. tight goes for depths too, unless the polytope comes to its end in the
    noise of nearly flat bodies: then the bracket is the usual one.
    """
    v = _variant(a, b, precision)
    workspace, size = _workspace(v, corners)
    options = _Options(cutoff, max_steps, abs_tol, rel_tol, slack, tight, size)
    return Result._make(_ask(v, v.penetration, a, b, options, cache, workspace))


def _workspace(v: Variant, corners: int) -> tuple[Any, int]:
    """Room for so many corners, and its bytes; none where C has as much of its own."""
    try:
        size: int = v.workspace_size(_whole(corners))
    except (TypeError, OverflowError):
        size = 0
    if size == 0:
        raise BadArgument(f"option corners is a whole number from 8 to 16000, not {told(corners)}")
    return (ffi.NULL, 0) if corners == OWN_CORNERS else (ffi.new("double[]", size // 8 + 1), size)


def _variant(a: Shape, b: Shape, precision: str) -> Variant:
    """The variant that answers for the two, which must be shapes of one dimension."""
    for name, shape in (("a", a), ("b", b)):
        if not isinstance(shape, Shape):
            raise BadArgument(f"{name}: a shape is expected, not {type(shape).__name__}")
    if a.dim != b.dim:
        raise BadArgument(f"a has {a.dim} dimensions, b has {b.dim}")
    return variant(a.dim, precision)


class _Options(NamedTuple):
    """The fields of the C struct that are not pointers, by their names there."""

    cutoff: float = 0.0
    max_steps: int = 0
    abs_tol: float = 0.0
    rel_tol: float = 0.0
    slack: float = 0.0
    tight: bool = False
    workspace_bytes: int = 0


_DEFAULTS = _Options()
_PLAIN = tuple(type(value) for value in _DEFAULTS)
_REALS = tuple(name for name, value in _DEFAULTS._asdict().items() if type(value) is float)


def _whole(x: Any) -> int:
    """x, of any type of integers, or TypeError."""
    if isinstance(x, bool):
        raise TypeError
    return index(x)


def _plain(v: Variant, options: _Options) -> _Options:
    """The options as numbers such as C has, none of which is taken for another there."""
    if not isinstance(options.tight, bool):
        raise BadArgument(f"option tight is True or False, not {told(options.tight)}")
    if tuple(map(type, options)) != _PLAIN:
        reals = {name: getattr(options, name) for name in _REALS}
        reals = {name: number(value, f"option {name} is {told(value)}") for name, value in reals.items()}
        options = options._replace(max_steps=_steps(options.max_steps), **reals)
    if not 0 <= options.max_steps < 2**32:
        raise BadArgument(f"option max_steps is {told(options.max_steps)}: not from 0 to 2**32 - 1")
    if 0 < options.cutoff <= v.least / 2:
        raise BadArgument(f"option cutoff is {options.cutoff}: 0 in this precision, where 0 stands for none")
    return options


def _steps(given: Any) -> int:
    try:
        return _whole(given)
    except TypeError:
        raise BadArgument(f"option max_steps is {told(given)}: not a whole number") from None


def _ask(
    v: Variant,
    question: Any,
    a: Shape,
    b: Shape,
    options: _Options,
    cache: Cache | None,
    workspace: Any = ffi.NULL,
) -> tuple[Any, ...]:
    """The fields of a Result, or the exception that the status means."""
    if cache is not None and not isinstance(cache, Cache):
        raise BadArgument(f"cache: a Cache is expected, not {type(cache).__name__}")
    options = _plain(v, options)
    native_a, native_b = a._native(v), b._native(v)  # held here until C has answered
    settings = ffi.NULL
    if cache is not None or options != _DEFAULTS:
        held = ffi.NULL if cache is None else cache._prepare(v)
        settings = _settings(v, options, held, workspace)
    out = ffi.new(v.result_type)
    try:
        if native_a.python or native_b.python:
            status = ask_with_callbacks(question, native_a.struct, native_b.struct, settings, out)
        else:
            status = question(native_a.struct, native_b.struct, settings, out)
    finally:
        if cache is not None:
            cache._settle(v, held, a, b)
    if status < 0:
        raise error(status, _fault(v, a, b, options))
    return _fields(out, Status(status))


def _fields(out: Any, status: Status) -> tuple[Any, ...]:
    return (
        out.value,
        out.lower,
        out.upper,
        tuple(out.point_a),
        tuple(out.point_b),
        tuple(out.normal),
        status,
        out.steps,
        out.supports,
    )


def _settings(v: Variant, options: _Options, cache: Any, workspace: Any) -> Any:
    """The C struct; it does not keep alive what its pointers point to."""
    pointers = {"cache": cache, "workspace": workspace}
    return ffi.new(v.options_type, {"size": v.options_size, **pointers, **options._asdict()})


def _fault(v: Variant, a: Shape, b: Shape, options: _Options) -> str:
    """Words for what the library has refused."""
    for name, shape in (("a", a), ("b", b)):
        fault = shape._fault()
        if fault:
            return f"{name}: {fault}"
        if shape.radius > v.most:
            return f"{name}: radius is {shape.radius}, out of the range of this precision"
    for name, value in options._asdict().items():
        if not 0 <= value <= v.most:
            return f"option {name} is {value:g}: negative, not finite or out of the range of this precision"
    return "a point not finite, out of the range of this precision or beyond its reach; or points of no convex set"

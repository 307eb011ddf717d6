# SPDX-License-Identifier: MIT
"""The convex sets that a query can be asked about."""

from __future__ import annotations

from collections.abc import Iterable
from operator import index
from typing import Any, Callable, ClassVar, TypeVar

from ._gjk import ffi
from ._native import Native, NativeShape, Variant, callback_handle
from .coordinates import Numbers, PoseLike, fault_in, number, number_fault, numbers, pose_numbers, rows
from .errors import BadArgument, told

__all__ = [
    "Ball",
    "Box",
    "Capsule",
    "Cone",
    "Cylinder",
    "Disc",
    "Ellipsoid",
    "Hull",
    "Points",
    "Segment",
    "Shape",
    "Sphere",
    "Sum",
    "Support",
    "Triangle",
]

S = TypeVar("S", bound="Shape")

# C walks a sum of sums by recursion: the first bounds its stack; the second its time, as a part that is used twice is
# walked twice, and what holds it twice doubles that.
_DEEPEST = 100
_MOST_PARTS = 4096


def _dimensions(dim: Any, name: str) -> int:
    """2 or 3, by any type of integers."""
    try:
        whole = 0 if isinstance(dim, bool) else index(dim)
    except TypeError:
        whole = 0
    if whole not in (2, 3):
        raise BadArgument(f"{name}: {told(dim)} dimensions, where the integer 2 or 3 is expected")
    return whole


class Shape:
    """A convex set: { m x + p : x in the set of its class }, grown by a ball. Immutable; threads may share it.

    dim: 2 or 3.
    pose: dim * (dim + 1) numbers, [m | p] by rows, or None for the identity. m may be any linear map: it may rotate,
        scale, shear, mirror or flatten. Accepted are these numbers in a row, a 3x4 or 4x4 table (2-D: 2x3 or 3x3),
        a couple (m, p), and dim numbers for a mere translation; lists, tuples or arrays alike.
    radius: of the ball. It comes after the pose, which does not scale it.
    """

    __slots__ = ("__weakref__", "_natives", "_sets", "dim", "pose", "radius")
    _sizes: ClassVar[tuple[str, ...]] = ()
    """The arguments that make the set, in the order of the constructor."""
    _more: ClassVar[tuple[str, ...]] = ()
    """Further attributes that belong to the set."""

    _natives: dict[str, NativeShape]
    _sets: dict[str, Native]
    dim: int
    pose: tuple[float, ...] | None
    radius: float

    def __init__(self, dim: int, pose: PoseLike | None, radius: float, **sizes: Any) -> None:
        if type(self)._set is Shape._set:
            raise BadArgument(f"{type(self).__name__}: a set of no kind; take one of the classes made from this one")
        dim = _dimensions(dim, type(self).__name__)
        for name, value in sizes.items():
            object.__setattr__(self, name, value)
        object.__setattr__(self, "dim", dim)
        object.__setattr__(self, "pose", None if pose is None else pose_numbers(pose, dim))
        object.__setattr__(self, "radius", number(radius, "radius"))
        object.__setattr__(self, "_sets", {})
        object.__setattr__(self, "_natives", {})

    def at(self: S, pose: PoseLike | None) -> S:
        """The same set at another pose, which replaces the present one. dim numbers are a translation.

        The two share their data: a `Cache` stays warm from one to the other.
        """
        return self._with(pose=None if pose is None else pose_numbers(pose, self.dim))

    def rounded(self: S, radius: float) -> S:
        """This shape grown by a ball of that radius, on top of the radius it has.

        The two are added and the sum is rounded: Sphere(1e16).rounded(1) is Sphere(1e16). Sum(shape, Sphere(radius))
        keeps both as they are.
        """
        more = number(radius, "radius")
        if more < 0:
            raise BadArgument(f"radius is {more}: no shape is rounded by less than 0")
        return self._with(radius=self.radius + more)

    def _fields(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in (*self._sizes, *self._more, "dim", "pose", "radius")}

    def _with(self: S, **changes: Any) -> S:
        return _rebuild(type(self), {**self._fields(), "_sets": self._sets, **changes})

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} is immutable; at() and rounded() give changed copies")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{type(self).__name__} is immutable")

    def _key(self) -> tuple[Any, ...]:
        return (*(getattr(self, name) for name in self._sizes), self.dim, self.pose, self.radius)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash((type(self).__name__, *self._key()))

    def __repr__(self) -> str:
        words = [repr(getattr(self, name)) for name in self._sizes]
        words += [f"{name}={value!r}" for name, value in self._keywords().items()]
        return f"{type(self).__name__}({', '.join(words)})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuild, (type(self), self._fields())

    def _keywords(self) -> dict[str, Any]:
        """The arguments by keyword that are not at their default."""
        words: dict[str, Any] = {}
        if self.pose is not None:
            words["pose"] = self.pose
        if self.radius:
            words["radius"] = self.radius
        return words

    def _native(self, v: Variant) -> NativeShape:
        """The shape as a C struct. Of threads that make it at once the first gives it to all: one that others may
        already read in C is never replaced. The same goes for the set."""
        found = self._natives.get(v.name)
        return self._natives.setdefault(v.name, self._make_native(v)) if found is None else found

    def _native_set(self, v: Variant) -> Native:
        found = self._sets.get(v.name)
        return self._sets.setdefault(v.name, self._set(v)) if found is None else found

    def _make_native(self, v: Variant) -> NativeShape:
        dim = self.dim
        native = self._native_set(v)
        pose = ffi.NULL
        if self.pose is not None:
            m = [c for i, c in enumerate(self.pose) if i % (dim + 1) < dim]
            pose = v.new("pose", {"m": m, "p": self.pose[dim :: dim + 1]})
        fields = {"support": native.support, "data": native.data, "pose": pose, "radius": self.radius}
        return NativeShape(v.new("shape", fields), native.python, (pose, native))

    def _set(self, v: Variant) -> Native:
        """The support and the data of the set without pose and radius."""
        raise NotImplementedError

    def _fault(self) -> str:
        """The first number that no set can have, in words; "" where there is none."""
        return fault_in("pose", self.pose or ()) or number_fault("radius", self.radius) or self._set_fault()

    def _set_fault(self) -> str:
        return ""


def _rebuild(kind: type[S], fields: dict[str, Any]) -> S:
    """A shape of fields that another has, whatever the constructor of its class takes."""
    shape = object.__new__(kind)
    for name, value in {"_sets": {}, "_natives": {}, **fields}.items():
        object.__setattr__(shape, name, value)
    return shape


def _ready(v: Variant, support: str, struct: str, fields: dict[str, Any], *keep: Any) -> Native:
    """One of the library's ready-made supports."""
    data = v.new(struct, fields)
    return Native(v.ready(support), data, (data, *keep), False)


class Points(Shape):
    """The convex hull of points, each of dim coordinates. dim is needed only where there are none.

    indexed: once, at the first query, which of the points may be farthest in which direction is noted, and only these
    are looked at from then on. That pays from about 40 points on, if they are asked about often: to note it takes
    thousands of looks at all of them. Answers are as exact.
    """

    __slots__ = ("indexed", "points")
    _sizes = ("points",)
    _more = ("indexed",)
    points: tuple[tuple[float, ...], ...]
    indexed: bool

    def __init__(
        self,
        points: Iterable[Numbers],
        *,
        dim: int | None = None,
        indexed: bool = False,
        pose: PoseLike | None = None,
        radius: float = 0.0,
    ) -> None:
        table = rows(points, "points")
        if dim is None:
            if not table:
                raise BadArgument("Points: no points, and no dim to tell the dimension")
            dim = len(table[0])
        elif table and len(table[0]) != _dimensions(dim, "Points"):
            raise BadArgument(f"Points: {len(table[0])} coordinates in {dim}-D")
        if not isinstance(indexed, bool):
            raise BadArgument(f"Points: indexed is True or False, not {told(indexed)}")
        super().__init__(dim, pose, radius, points=table, indexed=indexed)

    def _keywords(self) -> dict[str, Any]:
        words = super()._keywords()
        if self.indexed:
            words["indexed"] = True
        return words if self.points else {"dim": self.dim, **words}

    def _set(self, v: Variant) -> Native:
        flat = v.reals([c for point in self.points for c in point] or [0.0])
        data = v.new("indexed_points", {"points": {"v": flat, "count": len(self.points)}})
        reach = v.function("points_reach")(ffi.addressof(data.points))
        data.points.reach = reach if reach >= 0 else 0.0  # NaN: the query is to say what is wrong
        index = self._index(v, data) if self.indexed else None
        return Native(v.ready("support_points"), data, (data, flat, index), False)

    @staticmethod
    def _index(v: Variant, data: Any) -> Any:
        """The memory of an index that is given to the data; none of points that have none."""
        size = v.function("index_points")(data, ffi.NULL, 0)
        memory = ffi.new("uint32_t[]", size // ffi.sizeof("uint32_t"))
        v.function("index_points")(data, memory, size)
        return memory

    def _set_fault(self) -> str:
        if not self.points:
            return "no points"
        faults = (fault_in(f"points[{i}]", point) for i, point in enumerate(self.points))
        return next((fault for fault in faults if fault), "")


class Box(Shape):
    """|x_i| <= half[i]. Two half sides make a rectangle, three a box."""

    __slots__ = ("half",)
    _sizes = ("half",)
    half: tuple[float, ...]

    def __init__(self, half: Numbers, *, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        sides = numbers(half, "half")
        super().__init__(len(sides), pose, radius, half=sides)

    def _set(self, v: Variant) -> Native:
        return _ready(v, "support_box", "box", {"half": self.half})

    def _set_fault(self) -> str:
        return fault_in("half", self.half, sign=True)


class Segment(Shape):
    """From v[0] to v[1]."""

    __slots__ = ("v",)
    _sizes = ("v",)
    v: tuple[tuple[float, ...], ...]

    def __init__(self, v: Iterable[Numbers], *, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        ends = _corners(v, 2, "Segment")
        super().__init__(len(ends[0]), pose, radius, v=ends)

    def _set(self, v: Variant) -> Native:
        return _ready(v, "support_segment", "segment", {"v": self.v})

    def _set_fault(self) -> str:
        return fault_in("v[0]", self.v[0]) or fault_in("v[1]", self.v[1])


class Triangle(Shape):
    """With the corners v[0], v[1] and v[2]. A triangle in 2-D is three Points to the library."""

    __slots__ = ("v",)
    _sizes = ("v",)
    v: tuple[tuple[float, ...], ...]

    def __init__(self, v: Iterable[Numbers], *, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        corners = _corners(v, 3, "Triangle")
        super().__init__(len(corners[0]), pose, radius, v=corners)

    def _set(self, v: Variant) -> Native:
        if self.dim == 2:
            return Points(self.v)._set(v)
        return _ready(v, "support_triangle", "triangle", {"v": self.v})

    def _set_fault(self) -> str:
        faults = (fault_in(f"v[{i}]", corner) for i, corner in enumerate(self.v))
        return next((fault for fault in faults if fault), "")


def _corners(v: Iterable[Numbers], count: int, kind: str) -> tuple[tuple[float, ...], ...]:
    corners = rows(v, "v")
    if len(corners) != count:
        raise BadArgument(f"{kind}: {count} points expected, not {len(corners)}")
    return corners


class Sphere(Shape):
    """A ball (2-D: a disc) as the library likes it best: one point with a radius. No pose scales it; see `Ball`."""

    __slots__ = ()
    _sizes = ("radius",)

    def __init__(self, radius: float, *, dim: int = 3, pose: PoseLike | None = None) -> None:
        super().__init__(dim, pose, radius)

    def _keywords(self) -> dict[str, Any]:
        return _without_radius(super()._keywords(), self.dim)

    def _set(self, v: Variant) -> Native:
        return Native(v.ready("support_origin"), ffi.NULL, (), False)


class Capsule(Shape):
    """The points within radius of the segment from -half_length to +half_length on the last axis: y in 2-D, z in 3-D.

    A pose acts on the segment and does not scale the radius.
    """

    __slots__ = ("half_length",)
    _sizes = ("radius", "half_length")
    half_length: float

    def __init__(self, radius: float, half_length: float, *, dim: int = 3, pose: PoseLike | None = None) -> None:
        super().__init__(dim, pose, radius, half_length=number(half_length, "half_length"))

    def _keywords(self) -> dict[str, Any]:
        return _without_radius(super()._keywords(), self.dim)

    def _set(self, v: Variant) -> Native:
        # A negative length would pass for a segment turned round: NaN lets the library refuse it.
        z = self.half_length if self.half_length >= 0 else float("nan")
        axis = [0.0] * (self.dim - 1)
        return _ready(v, "support_segment", "segment", {"v": ((*axis, -z), (*axis, z))})

    def _set_fault(self) -> str:
        return number_fault("half_length", self.half_length)


def _without_radius(words: dict[str, Any], dim: int) -> dict[str, Any]:
    words.pop("radius", None)
    return words if dim == 3 else {"dim": dim, **words}


class Ball(Shape):
    """|x| <= r. Where no pose stretches it, `Sphere` is cheaper."""

    __slots__ = ("r",)
    _sizes = ("r",)
    r: float

    def __init__(self, r: float, *, dim: int = 3, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        super().__init__(dim, pose, radius, r=number(r, "r"))

    def _keywords(self) -> dict[str, Any]:
        words = super()._keywords()
        return words if self.dim == 3 else {"dim": self.dim, **words}

    def _set(self, v: Variant) -> Native:
        return _ready(v, "support_ball", "ball", {"radius": self.r})

    def _set_fault(self) -> str:
        return number_fault("r", self.r)


class Ellipsoid(Shape):
    """With half axes radii[i] along the coordinate axes, before its pose. Two of them make an ellipse."""

    __slots__ = ("radii",)
    _sizes = ("radii",)
    radii: tuple[float, ...]

    def __init__(self, radii: Numbers, *, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        axes = numbers(radii, "radii")
        super().__init__(len(axes), pose, radius, radii=axes)

    def _set(self, v: Variant) -> Native:
        return _ready(v, "support_ellipsoid", "ellipsoid", {"radii": self.radii})

    def _set_fault(self) -> str:
        return fault_in("radii", self.radii, sign=True)


class _Round(Shape):
    """A solid of revolution about z."""

    __slots__ = ("half_length", "r")
    _sizes = ("r", "half_length")
    r: float
    half_length: float

    def __init__(self, r: float, half_length: float, *, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        sizes = {"r": number(r, "r"), "half_length": number(half_length, "half_length")}
        super().__init__(3, pose, radius, **sizes)

    def _set_fault(self) -> str:
        return number_fault("r", self.r) or number_fault("half_length", self.half_length)


class Cylinder(_Round):
    """x^2 + y^2 <= r^2, |z| <= half_length. 3-D only."""

    __slots__ = ()

    def _set(self, v: Variant) -> Native:
        return _ready(v, "support_cylinder", "cylinder", {"radius": self.r, "half_length": self.half_length})


class Cone(_Round):
    """The hull of the apex (0, 0, half_length) and the disc of radius r at z = -half_length. 3-D only."""

    __slots__ = ()

    def _set(self, v: Variant) -> Native:
        return _ready(v, "support_cone", "cone", {"radius": self.r, "half_length": self.half_length})


class Disc(Shape):
    """x^2 + y^2 <= r^2, z = 0. 3-D only; a disc in 2-D is a `Sphere`."""

    __slots__ = ("r",)
    _sizes = ("r",)
    r: float

    def __init__(self, r: float, *, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        super().__init__(3, pose, radius, r=number(r, "r"))

    def _set(self, v: Variant) -> Native:
        return _ready(v, "support_disc", "disc", {"radius": self.r})

    def _set_fault(self) -> str:
        return number_fault("r", self.r)


class _Couple(Shape):
    """Two shapes as one, poses and radii included."""

    __slots__ = ("_depth", "_parts", "a", "b")
    _sizes = ("a", "b")
    _more = ("_depth", "_parts")
    _support: ClassVar[str]
    _depth: int
    _parts: int
    a: Shape
    b: Shape

    def __init__(self, a: Shape, b: Shape, *, pose: PoseLike | None = None, radius: float = 0.0) -> None:
        if not isinstance(a, Shape) or not isinstance(b, Shape):
            raise BadArgument(f"{type(self).__name__} is made of two shapes")
        if a.dim != b.dim:
            raise BadArgument(f"{type(self).__name__}: a has {a.dim} dimensions, b has {b.dim}")
        depth = 1 + max(getattr(a, "_depth", 0), getattr(b, "_depth", 0))
        if depth > _DEEPEST:
            raise BadArgument(f"{type(self).__name__}: sums and hulls nested deeper than {_DEEPEST}")
        parts = getattr(a, "_parts", 1) + getattr(b, "_parts", 1)
        if parts > _MOST_PARTS:
            raise BadArgument(f"{type(self).__name__}: {parts} parts in all, where {_MOST_PARTS} are the most")
        super().__init__(a.dim, pose, radius, a=a, b=b, _depth=depth, _parts=parts)

    def _set(self, v: Variant) -> Native:
        a, b = self.a._native(v), self.b._native(v)
        data = v.new("couple", {"a": a.struct[0], "b": b.struct[0]})
        return Native(v.ready(self._support), data, (data, a, b), a.python or b.python)

    def _set_fault(self) -> str:
        for name, member in (("a", self.a), ("b", self.b)):
            fault = member._fault()
            if fault:
                return f"{name}: {fault}"
        return ""


class Sum(_Couple):
    """{ x + y : x in a, y in b }, the Minkowski sum. Sums and hulls nest 100 deep and of 4096 parts in all; a shape
    that is used in two places counts twice."""

    __slots__ = ()
    _support = "support_sum"


class Hull(_Couple):
    """The convex hull of a and b together; nested as `Sum`."""

    __slots__ = ()
    _support = "support_hull"


class Support(Shape):
    """A convex set of your own, told by a function: it takes a direction, a tuple of dim floats that is not zero and
    not unit, and returns a point of the set that lies farthest along it.

    Equal directions must give equal points. The function may fall short of the farthest point by 8 units of roundoff
    times the reach of the set; what falls shorter is declared in the option slack of the query.
    reach: no point of the set lies farther than this from its own origin; a bound will do. Unless it is given, each
    query spends a few more calls to find one. What the function raises comes out of the query.
    """

    __slots__ = ("function", "reach")
    _sizes = ("function",)
    _more = ("reach",)
    function: Callable[[tuple[float, ...]], Numbers]
    reach: float | None

    def __init__(
        self,
        function: Callable[[tuple[float, ...]], Numbers],
        dim: int = 3,
        reach: float | None = None,
        *,
        pose: PoseLike | None = None,
        radius: float = 0.0,
    ) -> None:
        if not callable(function):
            raise BadArgument(f"Support: {told(function)} is not a function")
        bound = None if reach is None else number(reach, "reach")
        super().__init__(dim, pose, radius, function=function, reach=bound)

    def _key(self) -> tuple[Any, ...]:
        return (*super()._key(), self.reach)

    def _keywords(self) -> dict[str, Any]:
        words = {} if self.reach is None else {"reach": self.reach}
        return {"dim": self.dim, **words, **super()._keywords()}

    def _set(self, v: Variant) -> Native:
        handle = callback_handle(self.function, self.dim, self.reach or 0.0)
        return Native(v.python_support(), handle, (handle,), True)

    def _set_fault(self) -> str:
        return number_fault("reach", self.reach or 0.0)

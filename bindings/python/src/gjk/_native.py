# SPDX-License-Identifier: MIT
"""The four variants of the C library behind one face, and the way back from C into a Python support."""

from __future__ import annotations

import math
import sys
import threading
from collections.abc import Sequence
from typing import Any, Callable, NamedTuple

from ._gjk import ffi, lib
from .coordinates import numbers
from .errors import BadArgument, BadSupport, told

__all__ = ["PRECISIONS", "Native", "NativeShape", "Variant", "ask_with_callbacks", "callback_handle", "variant"]

PRECISIONS = ("double", "float")


class Variant:
    """The types and functions of one of gjk2_, gjk2f_, gjk3_ and gjk3f_."""

    def __init__(self, dim: int, precision: str) -> None:
        self.dim = dim
        self.precision = precision
        self.name = f"gjk{dim}" + ("f" if precision == "float" else "")
        self.most: float = (2 - 2**-23) * 2.0**127 if precision == "float" else sys.float_info.max
        """The largest number."""
        self.least: float = 2.0**-149 if precision == "float" else 2.0**-1074
        """The smallest above 0."""
        self.distance = self.function("distance")
        self.intersect = self.function("intersect")
        self.penetration = self.function("penetration")
        self.workspace_size = self.function("workspace_size")
        self.options_type = ffi.typeof(f"{self.name}_options *")
        self.options_size: int = ffi.sizeof(f"{self.name}_options")
        self.result_type = ffi.typeof(f"{self.name}_result *")
        self.bench = getattr(lib, self.name.replace("gjk", "bench"))

    def __repr__(self) -> str:
        return f"<{self.name}>"

    def function(self, stem: str) -> Any:
        return getattr(lib, f"{self.name}_{stem}")

    def ready(self, stem: str) -> Any:
        """A ready-made support, as the library knows it."""
        return self.function(f"ready_{stem}")

    def python_support(self) -> Any:
        """The one that calls back into Python."""
        return ffi.addressof(lib, f"{self.name}_python_support")

    def new(self, stem: str, value: Any = None) -> Any:
        """A new C struct, such as new("box", {"half": (1, 2, 3)}); it lives as long as the object returned."""
        return ffi.new(f"{self.name}_{stem} *", value)

    def reals(self, values: Sequence[float]) -> Any:
        return ffi.new(f"{self.precision}[]", values)


_VARIANTS = {(dim, precision): Variant(dim, precision) for dim in (2, 3) for precision in PRECISIONS}


def variant(dim: int, precision: str) -> Variant:
    try:
        return _VARIANTS[dim, precision]
    except (KeyError, TypeError, ValueError):
        raise BadArgument(f'precision is "double" or "float", not {told(precision)}') from None


class Native(NamedTuple):
    """A support and its data as C knows them. `keep` holds what the pointers point to."""

    support: Any
    data: Any
    keep: tuple[Any, ...]
    python: bool
    """Whether a query may call back into Python."""


class NativeShape(NamedTuple):
    """A set at its pose and with its radius, as a C struct. `keep` holds what its pointers point to: whoever uses the
    struct holds all of this as long."""

    struct: Any
    python: bool
    keep: tuple[Any, ...]


_query = threading.local()
"""raised: of the query that is under way on this thread, the first error of its supports, if any, in a list."""


def callback_handle(function: Callable[..., Any], dim: int, reach: float) -> Any:
    """What C hands back to `_answer` as data. Keep it alive as long as C holds it."""
    return ffi.new_handle((function, dim, reach))


def ask_with_callbacks(question: Callable[..., int], *arguments: Any) -> int:
    """The status of a query. What a Python support raised during it is raised here.

    Each query has a list of its own for that: a support may ask queries itself, whose errors are its own affair.
    """
    outer, raised = getattr(_query, "raised", None), list[BaseException]()
    try:
        _query.raised = raised
        status = question(*arguments)
    finally:
        _query.raised = outer
    if raised:
        raise raised[0]
    return status


def _answer(data: Any, direction: Any, point: Any) -> float:
    function, dim, reach = ffi.from_handle(data)
    point[0:dim] = (float("nan"),) * dim  # what C finds where the lines below raise
    x = numbers(function(tuple(direction[0:dim])), "support")
    if len(x) != dim:
        raise BadArgument(f"support: {len(x)} coordinates instead of {dim}")
    point[0:dim] = x
    _refuse(x, reach)
    return float(reach)


def _refuse(x: tuple[float, ...], reach: float) -> None:
    """Raise where the point is none that a set of such a reach has; reach 0: of any that is finite."""
    if not all(map(math.isfinite, x)):
        raise BadSupport(f"support: {told(x)} is not finite")
    if 0 < reach * (1 + 2**-20) < math.hypot(*x):  # more than a float rounds
        raise BadSupport(f"support: {told(x)} is farther out than the reach, {reach}")


def _keep(kind: type[BaseException], error: BaseException, traceback: Any) -> None:
    """C cannot carry what `_answer` has raised: it is kept here, and raised when the query has ended."""
    if not _query.raised:
        _query.raised.append(error.with_traceback(traceback))


for _variant in _VARIANTS.values():
    ffi.def_extern(f"{_variant.name}_python_support", error=float("nan"), onerror=_keep)(_answer)

# SPDX-License-Identifier: MIT
"""From whatever a caller has - nested sequences, arrays with a buffer, iterables - to tuples of floats.

Only the form is judged here. Whether a number is finite or of the right sign is for the library to say.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import Any, Union

from .errors import BadArgument, Error, told

__all__ = ["Numbers", "PoseLike", "fault_in", "number", "number_fault", "numbers", "pose_numbers", "rows"]

Numbers = Iterable[float]
"""Numbers in a row: a sequence, a one-dimensional array, or any iterable."""

PoseLike = Union[Numbers, Iterable[Numbers], tuple[Iterable[Numbers], Numbers]]
"""What a pose may be given as; see `gjk.Shape`."""


def number(x: Any, what: str) -> float:
    """x as a float: the one nearest to it."""
    if type(x) is float:
        return x
    if _is_no_real(x):
        raise BadArgument(f"{what}: {told(x)} is not a real number")
    try:
        if getattr(x, "ndim", 0) != 0:
            raise TypeError
        return float(x)
    except TypeError:
        raise BadArgument(f"{what}: a {type(x).__name__} where a number is expected") from None
    except (ValueError, OverflowError) as wrong:
        raise BadArgument(f"{what}: {wrong}") from None


def _is_no_real(x: Any) -> bool:
    """Whether x is something else that float() would take, or take a part of: a text, a truth value, a complex number,
    a span of time, a masked value."""
    kind = getattr(getattr(x, "dtype", None), "kind", "")
    return isinstance(x, (str, bytes, bytearray, bool, complex)) or kind in {*"bcmMSU"} or _hides(x)


def _hides(x: Any) -> bool:
    """Whether x is a masked array of NumPy with values that are masked."""
    ma = sys.modules.get("numpy.ma")  # loaded, if x is one
    if ma is None or not isinstance(x, ma.MaskedArray):
        return False
    return any(any(flags) if isinstance(flags, tuple) else flags for flags in ma.getmaskarray(x).ravel().tolist())


def numbers(x: Any, what: str) -> tuple[float, ...]:
    """x as a tuple of floats."""
    return tuple(number(c, what) for c in _plain(x, what))


def rows(x: Any, what: str) -> tuple[tuple[float, ...], ...]:
    """x, a table with rows of one length, as a tuple of tuples."""
    table = tuple(numbers(row, what) for row in _plain(x, what))
    if len({len(row) for row in table}) > 1:
        raise BadArgument(f"{what}: points of different dimension")
    return table


def _plain(x: Any, what: str) -> list[Any]:
    """x as a list, arrays through their buffer, which is much the faster way."""
    if isinstance(x, (str, bytes, bytearray)):
        raise BadArgument(f"{what}: {told(x)} is not a row of numbers")
    if _hides(x):
        raise BadArgument(f"{what}: masked values are no numbers")
    table = _buffered(x)
    if table is None:
        x = _as_array(x)
        table = _buffered(x)
    if table is not None:
        return table
    try:
        return list(x)
    except Error:
        raise
    except (TypeError, ValueError) as wrong:
        raise BadArgument(f"{what}: {told(x)} is not a row of numbers") from wrong


def _buffered(x: Any) -> list[Any] | None:
    """What the buffer of an array holds; None: no buffer, or one that memoryview does not read."""
    try:
        buffer = memoryview(x)
        return list(buffer.tolist()) if buffer.ndim else None
    except (TypeError, ValueError, BufferError, NotImplementedError):
        return None


def _as_array(x: Any) -> Any:
    """A table that can be had as an array, such as one of pandas, which iterates over its names. Others as they are."""
    try:
        array = x.__array__()
        return array if array.ndim else x
    except Exception:  # none, or one that is not to be had just now
        return x


def pose_numbers(pose: Any, dim: int) -> tuple[float, ...]:
    """A pose in any of its forms as [m | p] by rows, dim * (dim + 1) numbers."""
    items = [_plain(item, "pose") if _nested(item) else item for item in _plain(pose, "pose")]
    if not any(_nested(item) for item in items):
        return _flat_pose(numbers(items, "pose"), dim)
    if len(items) == 2 and _nested(items[0]) and any(_nested(row) for row in items[0]):
        m, p = rows(items[0], "pose"), numbers(items[1], "pose")
        table = tuple((*row, c) for row, c in zip(m, p)) if len(m) == len(p) else ()
    else:
        table = rows(items, "pose")
    return _flat_pose(tuple(c for row in table for c in row), dim, table)


def _nested(x: Any) -> bool:
    return not isinstance(x, (str, bytes)) and hasattr(x, "__iter__") and getattr(x, "ndim", 1) != 0


def _flat_pose(flat: tuple[float, ...], dim: int, table: tuple[tuple[float, ...], ...] = ()) -> tuple[float, ...]:
    length = dim * (dim + 1)
    if table and any(len(row) != dim + 1 for row in table):
        raise BadArgument(f"pose: rows of {dim + 1} numbers expected in {dim}-D")
    if len(flat) == dim and not table:
        return tuple(c for i in range(dim) for c in (*(float(i == j) for j in range(dim)), flat[i]))
    if len(flat) == length + dim + 1:
        if flat[length:] != (0.0,) * dim + (1.0,):
            raise BadArgument(f"pose: the last row of a square pose is {(0,) * dim + (1,)}")
        return flat[:length]
    if len(flat) != length:
        raise BadArgument(f"pose: {length} numbers expected in {dim}-D, not {len(flat)}")
    return flat


def fault_in(name: str, values: Iterable[float], sign: bool = False) -> str:
    """What is wrong with the numbers: "half[1] is nan"; with sign, negative ones are wrong too."""
    for i, c in enumerate(values):
        if not abs(c) < float("inf") or (sign and c < 0):
            return f"{name}[{i}] is {c}"
    return ""


def number_fault(name: str, x: float) -> str:
    """What is wrong with a size: "radius is -1.0"."""
    return "" if 0 <= x < float("inf") else f"{name} is {x}"

# SPDX-License-Identifier: MIT
"""What an answer or a refusal is called."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from enum import IntEnum
from typing import Any

from ._gjk import ffi, lib

__all__ = ["BadArgument", "BadSupport", "Error", "Status", "about", "told"]


class Status(IntEnum):
    """How a query ended. From 0 up the bracket holds; below 0 the caller has erred and an `Error` is raised."""

    OK = lib.GJK_OK
    """The bracket is as tight as asked."""
    DECIDED = lib.GJK_DECIDED
    """Stopped early, the question being settled: a sign proven, or the cutoff passed."""
    FLOOR = lib.GJK_FLOOR
    """Rounding allows no more: the bracket is wider than asked, or straddles contact."""
    LIMIT = lib.GJK_LIMIT
    """Stopped at max_steps."""
    BAD_ARGUMENT = lib.GJK_BAD_ARGUMENT
    """A number that is not finite or is negative, or an argument of the wrong form."""
    BAD_SUPPORT = lib.GJK_BAD_SUPPORT
    """A support gave a point that is not finite or beyond its reach, or points that no convex set has."""

    @property
    def label(self) -> str:
        """The library's own words, such as "bad support"."""
        text: bytes = ffi.string(lib.gjk_status_name(int(self)))
        return text.decode("ascii")


class Error(ValueError):
    """The caller's mistake. `status` is the library's name for it."""

    status: Status


class BadArgument(Error):
    """A number that is not finite or is negative, or an argument of the wrong form."""

    status = Status.BAD_ARGUMENT


class BadSupport(Error):
    """A support gave a point that is not finite or beyond its reach, or points that no convex set has; or a set has
    no points."""

    status = Status.BAD_SUPPORT


def told(x: Any) -> str:
    """A value in the words of a message: a line, cut where it is long; its type where it has no words."""
    try:
        words = " ".join(repr(x).split())
    except Exception:  # an integer of too many digits, lists nested too deep, or what a class of the caller's raises
        return f"some {type(x).__name__}"
    return words if len(words) <= 200 else f"{words[:200]}..."


@contextmanager
def about(what: str) -> Iterator[None]:
    """What is wrong in here is told of that."""
    try:
        yield
    except Error as wrong:
        raise type(wrong)(f"{what}: {wrong}") from None


def error(status: int, message: str) -> Error:
    """The exception that belongs to a status below 0."""
    kind = BadSupport if status == Status.BAD_SUPPORT else BadArgument
    return kind(message)

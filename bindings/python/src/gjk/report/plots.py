# SPDX-License-Identifier: MIT
"""The pictures of the page, as SVG whose colours are the page's own."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from .drawing import STYLE, decades, power, svg
from .table import Report, Row

__all__ = ["FLOOR", "ladder", "promise"]

FLOOR = 0.01
"""What is smaller is drawn here: a logarithm has no place for 0."""

TRUE, PROMISED = "#030303", "#040404"
VARIABLES = {TRUE: "true", PROMISED: "promised"}
SIZE = (4.6, 3.4)  # inches, so that letters keep their size on a phone
MARKED = {1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 0.0, 1, 2, 4, 8, 16}


def ladder(report: Report, kind: str, ymax: float) -> str:
    """Error and promise against run time, along one of the two ladders."""
    rows = [row for row in report.rows if row.level.kind == kind]
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=SIZE, layout="constrained")
        axes = figure.subplots()
        ns = [row.ns for row in rows]
        axes.fill_between(ns, _line(rows, "error", 0), _line(rows, "error", 2), color=TRUE, alpha=0.13, linewidth=0)
        for which, colour, marker in (("width", PROMISED, "s"), ("error", TRUE, "o")):
            for i in (0, 2):
                axes.plot(ns, _line(rows, which, i), color=colour, linewidth=0.8, alpha=0.75)
            axes.plot(ns, _line(rows, which, 1), color=colour, linewidth=1.8, marker=marker, markersize=3.8)
        _name_rungs(axes, rows)
        axes.set_yscale("log")
        decades(axes.yaxis, FLOOR, ymax, name=_tick)
        axes.set_ylim(FLOOR / 1.8, ymax)
        _time_axis(axes, max(row.ns for row in report.rows if row.level.kind in ("rel_tol", "max_steps")))
        axes.set_ylabel("u · scale")
        return svg(figure, f"{report.precision}-{kind}", VARIABLES)


def _line(rows: list[Row], which: str, i: int) -> list[float]:
    return [max(getattr(row, which)[i], FLOOR) for row in rows]


def _name_rungs(axes: Any, rows: list[Row]) -> None:
    """Words at some of the rungs, from the last one back and not on top of each other."""
    last = float("inf")
    for row in reversed(rows):
        setting = row.level.setting
        if setting not in MARKED or row.ns > 0.93 * last:
            continue
        last = row.ns
        text = "full" if setting == 0 else f"{setting:.0f}" if row.level.kind == "max_steps" else power(setting)
        at = (row.ns, max(row.width.max, FLOOR))
        axes.annotate(text, at, (3, 3), textcoords="offset points", ha="left", va="bottom", fontsize=8)


def promise(report: Report) -> str:
    """True error of each pair over the error promised, at full accuracy: every dot is under the diagonal."""
    row = report.full
    x, y = _dots(row)
    low, most = min(x) / 2, 3 * max([*x, *y])
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=SIZE, layout="constrained")
        axes = figure.subplots()
        axes.plot([low, most], [low, most], color=PROMISED, linewidth=1.6)
        axes.scatter(x, y, s=10, color=TRUE, alpha=0.3, linewidth=0)
        axes.annotate("true = promised", (most, most), (-4, -40), textcoords="offset points", ha="right", fontsize=8)
        axes.set_xscale("log")
        axes.set_yscale("log")
        decades(axes.xaxis, low, most, (1, 2, 5), name=_tick)
        decades(axes.yaxis, FLOOR, most, name=_tick)
        axes.set_xlim(low, most)
        axes.set_ylim(FLOOR / 1.5, most)
        axes.set_xlabel("error promised, u · scale")
        axes.set_ylabel("true error, u · scale")
        return svg(figure, f"{report.precision}-promise", VARIABLES)


def _dots(row: Row, count: int = 1200) -> tuple[list[float], list[float]]:
    """The pairs to draw: those closest to breaking the promise, and of the others an even choice.
    Exact answers promised to be exact, such as pairs that meet, have no place on logarithms."""
    dots = [(max(w, FLOOR), max(e, FLOOR)) for w, e in zip(row.widths, row.errors) if w or e] or [(1.0, FLOOR)]
    dots.sort(key=lambda dot: dot[0] / dot[1])
    rest = dots[count // 4 :]
    chosen = dots[: count // 4] + rest[:: max(1, len(rest) // (3 * count // 4))]
    return [w for w, _ in chosen], [e for _, e in chosen]


def _time_axis(axes: Any, most: float) -> None:
    """Linear and from 0, so that what is noise looks like noise."""
    axes.set_xlim(0, 1.12 * most)
    axes.set_xlabel("ns per query")


def _tick(x: float) -> str:
    return "0" if x <= FLOOR else power(x)

# SPDX-License-Identifier: MIT
"""The report in the terminal: progress while it is made, tables when it is."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Callable

from rich import box
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table
from rich.text import Text

from .scene import Scene
from .table import Report, Row

__all__ = ["Steps", "figure", "progress", "show"]


SPREADS = ("error\nmedian", "\np99", "\nmax", "promise\nmedian", "\np99", "\nmax")


class _Console(Console):
    """One that leaves a pipe closed by its reader to the command."""

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError


class Steps:
    """Bars, one for each stretch of work."""

    def __init__(self, bars: Progress) -> None:
        self._bars = bars

    def step(self, name: str) -> Callable[[int, int], None]:
        bar = self._bars.add_task(name, total=None)
        return lambda done, total: self._bars.update(bar, completed=done, total=total)


@contextmanager
def progress() -> Iterator[Steps]:
    columns = (TextColumn("{task.description:22}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=_Console(stderr=True)) as bars:
        yield Steps(bars)


def figure(x: float) -> str:
    """A length in u * scale, short enough for a table."""
    if x == 0:
        return "0"
    if x < 0.01:
        return "<0.01"
    if x < 100:
        return f"{x:.2f}" if x < 10 else f"{x:.1f}"
    return f"{x:.0f}" if x < 1e5 else f"{x:.1e}".replace("e+", "e")


def show(scene: Scene, reports: list[Report], files: list[Path]) -> None:
    console = _Console()
    for report in reports:
        console.print()
        console.print(_table(scene, report))
        console.print(_intersect(report), highlight=False)
        console.print(_penetration(report), highlight=False)
    console.print(Text("tol: the option rel_tol, relative to the distance; tight: that option.", "dim"))
    console.print(Text("Error and promise (bracket width) in u·scale; ns: the mean in the fastest round.", "dim"))
    console.print(_verdict(reports))
    for file in files:
        name = str(file).encode("utf-8", "replace").decode("utf-8")
        console.print(f"wrote {name}", highlight=False, soft_wrap=True, markup=False)


def _table(scene: Scene, report: Report) -> Table:
    table = Table(
        title=Text(f"{scene.name}: distance of {len(report.pairs)} pairs, {scene.dim}-D {report.precision}"),
        title_style="bold",
        title_justify="left",
        box=box.SIMPLE_HEAD,
        show_edge=False,
        pad_edge=False,
        padding=(0, 0),
    )
    table.add_column("\naccuracy", no_wrap=True)
    for heading in ("\nns", "\ncalls", *SPREADS, "\nbroken"):
        table.add_column(heading, justify="right", no_wrap=True)
    for before, row in zip([None, *report.rows], report.rows):
        if before is not None and before.level.kind != row.level.kind:
            table.add_section()
        table.add_row(*_cells(row), style="bold" if row is report.full else None)
    return table


def _cells(row: Row) -> list[str]:
    spreads = [figure(x) for x in (*row.error, *row.width)]
    return [row.level.label, f"{row.ns:.0f}", f"{row.supports:.1f}", *spreads, str(row.violations)]


def _intersect(report: Report) -> str:
    v = report.intersect
    return (
        f"Intersect: {v.ns:.0f} ns, {v.supports:.1f} calls; "
        f"{v.apart} apart, {v.meeting} meeting, {v.touching} touching, {v.violations} wrong"
    )


def _penetration(report: Report) -> str:
    d = report.penetration
    return (
        f"Penetration: {d.ns:.0f} ns, {d.supports:.1f} calls; of {d.known} pairs with a known truth "
        f"error up to {figure(d.error)}, promise up to {figure(d.width)}; {d.violations} broken"
    )


def _verdict(reports: list[Report]) -> Text:
    broken = sum(report.violations for report in reports)
    asked = sum(report.asked for report in reports)
    if broken:
        return Text(f"{broken} of {asked} answers do not hold the truth.", "bold red")
    return Text(f"All {asked} answers hold the truth.", "bold green")

# SPDX-License-Identifier: MIT
"""gjk report: error against run time, for every pair of a scene."""

from __future__ import annotations

import sys
from pathlib import Path

from rich.console import Console

from ..errors import Error
from . import measure, page, table, terminal, truth
from .scene import Scene, SceneError, load

__all__ = ["run"]


def run(path: Path, out: Path, precision: str, jobs: int | None, limit: int | None) -> int:
    """Make the report and write it to the folder out. Returns 1 where a bracket was broken, 2 on bad input, else 0."""
    try:
        scene = load(path, limit)
        out.mkdir(parents=True, exist_ok=True)  # before the long work, not to lose it to a folder that cannot be
        precisions = ["double", "float"] if precision == "both" else [precision]
        reports = _measure(scene, precisions, jobs)
        table.write(out / "report.csv", reports)
        page.write(out / "report.html", scene, reports)
    except (SceneError, Error, OSError) as wrong:
        print(f"gjk report: {wrong}", file=sys.stderr)
        return 2
    terminal.show(scene, reports, [out / "report.html", out / "report.csv"])
    return int(any(report.violations for report in reports))


def _measure(scene: Scene, precisions: list[str], jobs: int | None) -> list[table.Report]:
    reports = []
    with terminal.progress(Console(stderr=True)) as progress:
        for precision in precisions:
            pairs = scene.rounded() if precision == "float" else scene.pairs
            measure.check(pairs, precision)
            truths = truth.find(pairs, scene.dim, jobs, progress.step(f"{precision}: exact truth"))
            answers = measure.solve(pairs, scene.dim, precision, progress.step(f"{precision}: queries"))
            reports.append(table.summarise(precision, pairs, truths, answers))
    return reports

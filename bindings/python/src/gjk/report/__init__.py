# SPDX-License-Identifier: MIT
"""gjk report: error against run time, for every pair of a scene."""

from __future__ import annotations

import sys
from concurrent.futures import BrokenExecutor
from pathlib import Path

from ..errors import Error
from . import measure, page, table, terminal, truth
from .scene import Pair, Scene, SceneError, load

__all__ = ["run"]


def run(path: Path, out: Path, precision: str, jobs: int | None, limit: int | None) -> int:
    """Make the report and write it to the folder out. Returns 1 where a bracket was broken and there alone, 2 where
    there is no report, else 0."""
    try:
        scene = load(path, limit)
        out.mkdir(parents=True, exist_ok=True)  # before the long work, not to lose it to a folder that cannot be
        precisions = ["double", "float"] if precision == "both" else [precision]
        pairs = {precision: _pairs(scene, precision) for precision in precisions}
        reports = _measure(scene.dim, pairs, jobs)
        table.write(out / "report.csv", reports)
        page.write(out / "report.html", scene, reports)
    except BrokenPipeError:
        raise
    except (SceneError, Error, OSError, BrokenExecutor) as wrong:
        print(f"gjk report: {wrong}", file=sys.stderr)
        return 2
    terminal.show(scene, reports, [out / "report.html", out / "report.csv"])
    return int(any(report.violations for report in reports))


def _pairs(scene: Scene, precision: str) -> list[Pair]:
    """The pairs as this precision has them, all of which it can take."""
    pairs = scene.rounded() if precision == "float" else scene.pairs
    measure.check(pairs, precision)
    return pairs


def _measure(dim: int, pairs_by: dict[str, list[Pair]], jobs: int | None) -> list[table.Report]:
    reports = []
    with terminal.progress() as progress:
        for precision, pairs in pairs_by.items():
            truths = truth.find(pairs, dim, jobs, progress.step(f"{precision}: exact truth"))
            answers = measure.solve(pairs, dim, precision, progress.step(f"{precision}: queries"))
            reports.append(table.summarise(precision, pairs, truths, answers))
    return reports

# SPDX-License-Identifier: MIT
"""From answers and truths to the rows of the report."""

from __future__ import annotations

import csv
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

from ..cases import QUERIES
from ..exact import APART, OVERLAPPING
from .measure import Answer, Answers, Level
from .scene import Pair
from .truth import Truth

__all__ = ["COLUMNS", "UNIT", "Depths", "Report", "Row", "Spread", "Verdicts", "summarise", "write"]

UNIT = {"double": 2.0**-53, "float": 2.0**-24}
LEAST = {"double": 2.0**-1074, "float": 2.0**-149}
"""The smallest numbers above 0. Of bodies that have no size to speak of these are the units."""


class Spread(NamedTuple):
    median: float
    p99: float
    max: float


class Row(NamedTuple):
    """One level of the ladder: all pairs asked for their distance."""

    level: Level
    ns: float
    supports: float
    """Support calls per query, both shapes together; the mean."""
    error: Spread
    """|value - truth| in u * scale."""
    width: Spread
    """upper - lower in u * scale: the error promised."""
    violations: int
    """Brackets that do not hold the truth."""
    errors: list[float]
    widths: list[float]


class Verdicts(NamedTuple):
    """All pairs asked whether they meet."""

    ns: float
    supports: float
    apart: int
    meeting: int
    touching: int
    """Neither was proven: contact, to this precision."""
    violations: int
    """Verdicts against the truth."""


class Depths(NamedTuple):
    """All pairs asked how far apart or how deep in each other."""

    ns: float
    supports: float
    error: float
    """The largest |value - truth| in u * scale of the pairs whose depth is known; ..."""
    width: float
    """... and the largest upper - lower."""
    known: int
    """So many pairs are these."""
    violations: int
    """Brackets that do not hold the truth, as far as it is known."""


class Report(NamedTuple):
    precision: str
    pairs: list[Pair]
    truths: list[Truth]
    rows: list[Row]
    intersect: Verdicts
    penetration: Depths

    @property
    def full(self) -> Row:
        """The row of full accuracy."""
        return next(row for row in self.rows if row.level == Level("rel_tol", 0.0))

    @property
    def violations(self) -> int:
        return sum(row.violations for row in self.rows) + self.intersect.violations + self.penetration.violations

    @property
    def asked(self) -> int:
        """Answers in all."""
        return len(self.pairs) * (len(self.rows) + 2)


def summarise(precision: str, pairs: list[Pair], truths: list[Truth], answers: list[Answers]) -> Report:
    by_query = {level.level.kind: level for level in answers if level.level.kind in QUERIES}
    rows = [_row(level, truths, precision) for level in answers if level.level.kind not in QUERIES]
    verdicts = _verdicts(by_query["intersect"], truths)
    depths = _depths(by_query["penetration"], truths, precision)
    return Report(precision, pairs, truths, rows, verdicts, depths)


def _row(level: Answers, truths: list[Truth], precision: str) -> Row:
    solved = list(zip(level.answers, truths))
    errors = [_error(answer, truth, precision) for answer, truth in solved]
    widths = [_in_units(answer.upper - answer.lower, truth, precision) for answer, truth in solved]
    return Row(
        level=level.level,
        ns=level.ns,
        supports=_mean_supports(level),
        error=_spread(errors),
        width=_spread(widths),
        violations=sum(not _holds(answer, truth) for answer, truth in solved),
        errors=errors,
        widths=widths,
    )


def _verdicts(level: Answers, truths: list[Truth]) -> Verdicts:
    apart = [answer.lower > 0 for answer in level.answers]
    meeting = [answer.upper <= 0 for answer in level.answers]
    wrong = sum(truth.proven and _contradicts(answer, truth) for answer, truth in zip(level.answers, truths))
    touching = len(apart) - sum(apart) - sum(meeting)
    return Verdicts(level.ns, _mean_supports(level), sum(apart), sum(meeting), touching, wrong)


def _depths(level: Answers, truths: list[Truth], precision: str) -> Depths:
    solved = list(zip(level.answers, truths))
    signed = [(answer, _signed(truth)) for answer, truth in solved if truth.separation]
    errors = [_error(answer, truth, precision) for answer, truth in signed]
    widths = [_in_units(answer.upper - answer.lower, truth, precision) for answer, truth in signed]
    wrong = sum(not _holds(*pair) for pair in signed)
    wrong += sum(answer.lower > truth.upper for answer, truth in solved if not truth.separation)
    most = max(errors, default=0.0), max(widths, default=0.0)
    return Depths(level.ns, _mean_supports(level), *most, len(signed), wrong)


def _signed(truth: Truth) -> Truth:
    """The truth about the signed separation, where that about the distance stood."""
    lower, upper = truth.separation or (truth.lower, truth.upper)
    return truth._replace(lower=lower, upper=upper)


def _contradicts(answer: Answer, truth: Truth) -> bool:
    """Whether a verdict is against the truth."""
    return (
        (answer.lower > 0 and truth.relation != APART)
        or (answer.upper <= 0 and truth.relation == APART)
        or (answer.upper < 0 and truth.relation != OVERLAPPING)
    )


def _mean_supports(level: Answers) -> float:
    return sum(answer.supports for answer in level.answers) / len(level.answers)


def _holds(answer: Answer, truth: Truth) -> bool:
    return answer.lower <= truth.upper and truth.lower <= answer.upper


def _error(answer: Answer, truth: Truth, precision: str) -> float:
    exact = (truth.lower + truth.upper) / 2
    return _in_units(float(abs(Fraction(answer.value) - exact)), truth, precision)


def _in_units(length: float, truth: Truth, precision: str) -> float:
    return length / max(UNIT[precision] * truth.scale, LEAST[precision])


def _spread(values: list[float]) -> Spread:
    ordered = sorted(values)
    rank = -(-99 * len(ordered) // 100)
    return Spread(ordered[len(ordered) // 2], ordered[rank - 1], ordered[-1])


COLUMNS = [
    *("precision", "query", "setting", "pairs", "ns_per_query", "supports_per_query"),
    *("error_median", "error_p99", "error_max", "width_median", "width_p99", "width_max", "violations"),
]


def write(path: Path, reports: list[Report]) -> None:
    """The rows as CSV. Errors and widths are in u * scale; intersect has neither, and of penetration only the largest
    are told."""
    with path.open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(COLUMNS)
        for report in reports:
            for row in report.rows:
                out.writerow(_cells(report, "distance", row.level.label, row.ns, row.supports, row.violations, row))
            v = report.intersect
            out.writerow(_cells(report, "intersect", "first proof", v.ns, v.supports, v.violations, None))
            d = report.penetration
            cells = _cells(report, "penetration", "full", d.ns, d.supports, d.violations, None)
            for name, number in (("error_max", d.error), ("width_max", d.width)):
                cells[COLUMNS.index(name)] = f"{number:.6g}"
            out.writerow(cells)


def _cells(
    report: Report, query: str, setting: str, ns: float, supports: float, violations: int, row: Row | None
) -> list[str]:
    spreads = [f"{x:.6g}" for x in (*row.error, *row.width)] if row else [""] * 6
    head = [report.precision, query, setting, str(len(report.pairs))]
    return [*head, f"{ns:.1f}", f"{supports:.3f}", *spreads, str(violations)]

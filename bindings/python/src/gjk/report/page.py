# SPDX-License-Identifier: MIT
"""The report as one HTML page that needs nothing beside it."""

from __future__ import annotations

import platform
from html import escape
from pathlib import Path
from string import Template

from .. import __version__
from . import plots
from .scene import Scene
from .table import Report, Row
from .terminal import figure

__all__ = ["COLOURS", "CSS", "document", "write"]

COLOURS = """\
:root { --ink: #1b1f24; --soft: #59636e; --rule: #d1d9e0; --page: #ffffff; --card: #f6f8fa;
        --true: #0072b2; --promised: #d55e00; --bad: #b3261e; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6edf3; --soft: #9aa6b2; --rule: #3a434d; --page: #0f1318; --card: #181e25;
          --true: #56b4e9; --promised: #f0a04b; --bad: #ff8a80; } }
"""
CSS = (
    COLOURS
    + """\
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 2rem 1rem 4rem; background: var(--page); color: var(--ink);
       font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
h1 { font-size: clamp(1.5rem, 5vw, 2.2rem); line-height: 1.15; letter-spacing: -.02em; margin: 0 0 .5rem; }
h2 { font-size: 1.25rem; margin: 3rem 0 .25rem; }
h3 { font-size: .95rem; margin: 0 0 .25rem; font-weight: 600; }
p { max-width: 44rem; margin: .5rem 0; }
.soft, footer, figcaption { color: var(--soft); }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(10rem, 1fr)); gap: .75rem; margin: 1.5rem 0; }
.card { background: var(--card); border-radius: .75rem; padding: .9rem 1rem; }
.card b { display: block; font-size: 1.6rem; line-height: 1.2; letter-spacing: -.02em;
          font-variant-numeric: tabular-nums; }
.card span { color: var(--soft); font-size: .85rem; line-height: 1.3; display: block; }
.bad b { color: var(--bad); }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 1.5rem;
         margin: 1rem 0; }
figure { margin: 0; min-width: 0; }
figure svg { width: 100%; height: auto; display: block; overflow: visible; }
figure svg text { font-family: system-ui, -apple-system, "Segoe UI", Roboto, sans-serif !important; }
.key { display: flex; flex-wrap: wrap; gap: .25rem 1.5rem; margin: .75rem 0; padding: 0; list-style: none; }
.key li::before { content: ""; display: inline-block; width: 1.6em; height: .2em; margin-right: .5em;
  border-radius: .1em; vertical-align: middle; background: var(--c); }
.table { overflow-x: auto; margin: .75rem 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .88rem; width: 100%; }
caption { text-align: left; font-weight: 600; padding: .5rem 0; }
th, td { padding: .28rem .6rem; text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; position: sticky; left: 0;
  background: var(--page); }
thead th { color: var(--soft); font-weight: 500; border-bottom: 1px solid var(--rule); }
thead tr:first-child th { border: 0; padding-bottom: 0; }
th[colspan] { text-align: center; color: var(--c); }
tbody tr.full td { font-weight: 600; background: var(--card); }
tr.next td { border-top: 1px solid var(--rule); }
footer { margin-top: 3rem; font-size: .85rem; border-top: 1px solid var(--rule); padding-top: 1rem; }
"""
)
"""Of this page and others."""

DOCUMENT = Template(
    """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,">
<title>$title</title>
<style>
$css</style>
</head>
<body>
$body</body>
</html>
"""
)

PAGE = Template(
    """\
<header>
<h1>$name: error against run time</h1>
<p>$lead</p>
</header>
<div class="cards">
$cards
</div>

<h2>The further a query runs, the closer it comes</h2>
<p>Each point is a whole scene, solved once: to a tolerance asked for, or for so many steps. The query can stop
anywhere, and at each stop it promises a bracket. The promise is never smaller than the true error.</p>
<ul class="key"><li style="--c: var(--true)">true error</li>
<li style="--c: var(--promised)">error promised: upper &minus; lower</li></ul>
<p class="soft">With marks: the 99th percentile. Thin: the largest above it, the median below.</p>
<div class="plots">
$ladders
</div>

<h2>No pair breaks its promise</h2>
<p>Each dot is a pair at full accuracy: how far the answer is from the truth, over how far the bracket says it may
be. $promise Pairs whose bracket is a single number, the truth, are not drawn.</p>
<div class="plots">
$promises
</div>

<h2>The numbers</h2>
<p>With tol the query had the option rel_tol, relative to the distance; full is as tight as rounding allows; with tight,
exact arithmetic finishes the pairs of points, boxes, segments, triangles and spheres.</p>
$tables

<footer>
<p>Lengths are in u&thinsp;·&thinsp;scale: u is 2<sup>&minus;53</sup> in double and 2<sup>&minus;24</sup> in float;
scale is the largest coordinate of the pair, seen from the midpoint of its closest points. The truth is exact: rational
arithmetic on the very numbers that the query was given, for float after rounding them. What is below 0.01 is
drawn at 0. Time is the mean of all pairs, cold, one thread, in the fastest of interleaved rounds, measured in C around
the query alone.</p>
<p>gjk $version on $machine.$source</p>
</footer>
"""
)

KINDS = {"rel_tol": "by tolerance asked", "max_steps": "by steps allowed"}


def document(title: str, css: str, body: str) -> str:
    """A whole page; its parts are HTML already."""
    return DOCUMENT.substitute(title=title, css=css, body=body)


def write(path: Path, scene: Scene, reports: list[Report]) -> None:
    name = escape(scene.name)
    body = PAGE.substitute(
        name=name,
        lead=_lead(scene, reports),
        cards="\n".join(_cards(reports)),
        ladders="\n".join(_ladders(reports)),
        promise=_promise(reports),
        promises="\n".join(_promises(reports)),
        tables="\n".join(_table(report) for report in reports),
        version=__version__,
        machine=escape(_machine()),
        source=f" Scene: {escape(scene.source)}" if scene.source else "",
    )
    path.write_text(document(f"{name}: error against run time", CSS, body), encoding="utf-8")


def _lead(scene: Scene, reports: list[Report]) -> str:
    pairs = f"{len(scene.pairs):,}"
    if len(scene.pairs) < scene.total:
        pairs += f" of {scene.total:,}"
    precisions = " and ".join(report.precision for report in reports)
    levels = len(reports[0].rows)
    return (
        f"{pairs} pairs of convex bodies in {scene.dim}-D, each asked for its distance at {levels} accuracies, in "
        f"{precisions}; every answer held against the exact truth."
    )


def _cards(reports: list[Report]) -> list[str]:
    asked = sum(report.asked for report in reports)
    broken = sum(report.violations for report in reports)
    cards = [_card(f"{broken}", f"of {asked:,} answers miss the truth", "bad" if broken else "")]
    for report in reports:
        full = report.full
        text = f"per distance in {report.precision}; largest error {figure(full.error.max)} u\u2009·\u2009scale"
        cards.append(_card(f"{full.ns:.0f} ns", text))
    times = " / ".join(f"{report.intersect.ns:.0f}" for report in reports)
    return [*cards, _card(f"{times} ns", f"per intersect in {' / '.join(report.precision for report in reports)}")]


def _card(number: str, text: str, kind: str = "") -> str:
    return f'<div class="card {kind}"><b>{escape(number)}</b><span>{escape(text)}</span></div>'


def _ladders(reports: list[Report]) -> list[str]:
    return [
        _figure(
            f"{report.precision}, {words}",
            plots.ladder(report, kind, _top(report)),
            f"True and promised error against run time in {report.precision}, {words}; the numbers are in the table.",
        )
        for report in reports
        for kind, words in KINDS.items()
    ]


def _top(report: Report) -> float:
    """The largest finite error or width, with room above for words."""
    sizes = [x for row in report.rows for x in (row.error.max, row.width.max) if x < float("inf")]
    return 20 * max([*sizes, 1.0])


def _promises(reports: list[Report]) -> list[str]:
    text = "True error of each pair over the error promised; all dots are below the diagonal."
    return [_figure(report.precision, plots.promise(report), text) for report in reports]


def _figure(title: str, svg: str, text: str) -> str:
    svg = svg.replace("<svg", f'<svg role="img" aria-label="{escape(text)}"', 1)
    return f"<figure><h3>{escape(title)}</h3>{svg}</figure>"


def _promise(reports: list[Report]) -> str:
    broken = sum(report.full.violations for report in reports)
    if broken:
        return f"{broken} are above the line, where none should be."
    return "All are below the line, as they must be."


def _table(report: Report) -> str:
    before = [None, *report.rows]
    rows = "\n".join(_row(report, last, row) for last, row in zip(before, report.rows))
    v, d = report.intersect, report.penetration
    return f"""<div class="table"><table>
<caption>Distance, {report.precision}, {len(report.pairs):,} pairs</caption>
<thead><tr><th></th><th></th><th></th><th colspan="3" style="--c: var(--true)">true error</th>
<th colspan="3" style="--c: var(--promised)">error promised</th><th></th></tr>
<tr><th>accuracy</th><th>ns</th><th>support calls</th><th>median</th><th>p99</th><th>max</th><th>median</th><th>p99</th>
<th>max</th><th>broken</th></tr></thead>
<tbody>
{rows}
</tbody></table></div>
<p>Intersect: {v.ns:.0f} ns and {v.supports:.1f} support calls per query; {v.apart:,} apart, {v.meeting:,}
meeting, {v.touching:,} touching, {v.violations} wrong.</p>
<p>Penetration: {d.ns:.0f} ns and {d.supports:.1f} support calls per query; of {d.known:,} pairs with a known truth
error up to {figure(d.error)}, promise up to {figure(d.width)}; {d.violations} broken.</p>"""


def _row(report: Report, before: Row | None, row: Row) -> str:
    kind = "full" if row is report.full else "next" if before and before.level.kind != row.level.kind else ""
    cells = [
        row.level.label,
        f"{row.ns:.0f}",
        f"{row.supports:.1f}",
        *(figure(x) for x in (*row.error, *row.width)),
        str(row.violations),
    ]
    return f'<tr class="{kind}">' + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"


def _machine() -> str:
    """The processor by its name, where the system tells."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        name = platform.processor() or platform.machine()
    return f"{name}, {platform.system()}"

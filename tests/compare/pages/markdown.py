# SPDX-License-Identifier: MIT
"""docs/comparison.md: the tables, at everyone's defaults."""

from . import tables, words
from .writing import case_text, line, rule, sentence


def table(t):
    yield line(t.columns)
    yield rule(len(t.columns), t.words)
    yield from map(line, t.rows)


def page(measured, command, plot):
    yield "<!-- SPDX-License-Identifier: MIT -->"
    yield "# Comparison"
    yield ""
    yield words.LEAD
    yield "This page is written by a program; do not edit it. To write it anew, with build/comparison/index.html, the"
    yield "page that has all plots and all settings:"
    yield ""
    yield "```sh"
    yield command
    yield "```"
    yield ""
    yield words.head(measured)
    if plot:
        yield ""
        yield f"![{words.PLOT}]({plot})"
    yield ""
    yield from table(tables.peers(measured))
    for title, parts in sections(measured):
        yield ""
        yield f"## {title}"
        yield ""
        yield from parts


def sections(measured):
    yield "Marks", [words.MARKS, "", *table(tables.marks(measured))]
    yield "Where ours is not first", not_first(measured)
    yield "Right and wrong", [words.COUNTS, "", *table(tables.counts(measured))]
    yield "How to read it", [words.HOW_TO_READ, "", words.FAIR]
    for ask in measured.asks():
        yield sentence(ask.title), asked(measured.of(ask))
    yield "Cases to replay", [words.REPLAY, *replays(measured)]


def not_first(measured):
    yield words.NOT_FIRST
    for title, lines in tables.not_first(measured):
        yield ""
        yield f"**{sentence(title)}**"
        yield ""
        yield from (f"- {text}" for text in lines)


def asked(places):
    yield words.TIMES
    yield ""
    yield from table(tables.times(places))
    warm = tables.times(places, warm=True)
    if warm.rows:
        yield ""
        yield words.WARM
        yield ""
        yield from table(warm)
    yield ""
    yield words.ERRORS if places[0].ask.question != "intersect" else words.VERDICTS
    yield ""
    yield from table(tables.errors(places))


def replays(measured):
    for library, picked in tables.examples(measured):
        yield ""
        yield f"### {library}"
        for place, a in picked:
            yield ""
            yield tables.said(place, a)
            yield ""
            yield "```json"
            yield case_text(a.example, place.ask.precision == "float")
            yield "```"

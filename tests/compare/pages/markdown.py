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
    yield ""
    yield from (f"- **{question}** {answer}" for question, answer in tables.glance(measured))
    yield ""
    yield words.head(measured)
    if plot:
        yield ""
        yield f"![{words.PLOT}]({plot})"
    for title, parts in sections(measured, command):
        yield ""
        yield f"## {title}"
        yield ""
        yield from parts


def how_to_make(command):
    yield "This page is written by a program; do not edit it. To write it anew, with build/comparison/index.html, the"
    yield "page that has all plots and all settings:"
    yield ""
    yield "```sh"
    yield command
    yield "```"


def sections(measured, command):
    yield "Where ours is not first", not_first(measured)
    yield "Right and wrong", [words.COUNTS, "", *table(tables.counts(measured))]
    yield "Marks", [words.MARKS, "", *table(tables.marks(measured))]
    yield "How to make it anew", how_to_make(command)
    yield "How to read it", [words.HOW_TO_READ, "", words.FAIR]
    yield "Libraries", table(tables.peers(measured))
    for ask in measured.asks():
        yield sentence(ask.title), asked(measured.of(ask))
    yield "Cases to replay", [words.REPLAY, "", *folded("Cases", replays(measured))]


def not_first(measured):
    yield words.NOT_FIRST
    for text, t in tables.lost(measured):
        yield ""
        yield text
        yield ""
        yield from table(t)


def folded(title, parts):
    yield f"<details><summary>{title}</summary>"
    yield ""
    yield from parts
    yield ""
    yield "</details>"


def asked(places):
    yield from folded("Times", times(places))
    yield ""
    yield from folded("Errors", errors(places))


def times(places):
    yield words.TIMES
    yield ""
    yield from table(tables.times(places))
    warm = tables.times(places, warm=True)
    if warm.rows:
        yield ""
        yield words.WARM
        yield ""
        yield from table(warm)


def errors(places):
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

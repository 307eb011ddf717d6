# SPDX-License-Identifier: MIT
"""What the bench measured, and how ours stands in it."""

from __future__ import annotations

import glob
import json
import math
import os
import re
from collections import Counter
from typing import NamedTuple


class Incomplete(Exception):
    """A file of results without its last row."""


class Answers(NamedTuple):
    """Of one library at one setting to one class of pairs."""

    question: str
    library: str
    knob: str
    setting: str
    default: bool
    """As its documentation advises; ours without options."""
    warm: bool
    asked: int
    wrong: int
    failed: int
    least: float | None
    """Nanoseconds an answer; so is the median. None where no pair was safe to time."""
    median: float | None
    instructions: float | None
    supports: float | None
    promised: float | None
    """The widest bracket, in scales of the pair; so are the errors. None without an answer that has a number."""
    max_error: float | None
    median_error: float | None
    excess: float | None
    """Of a depth: the largest of what the way along its normal is longer."""
    example: dict | None
    truth: float | None
    said: float | None
    """Signed, as the truth is; of intersect whether they meet."""
    failure: str | None

    @property
    def bad(self):
        return self.wrong + self.failed

    @property
    def is_ours(self):
        return self.library.startswith("gjk")

    @property
    def is_timed(self):
        return self.median is not None and self.median > 0

    @property
    def name(self):
        return f"{self.library}, warm" if self.warm else self.library

    def ratio(self, ours):
        """What it takes divided by what ours takes."""
        return self.median / ours.median if ours and ours.is_timed and self.is_timed else None

    def instruction_ratio(self, ours):
        return self.instructions / ours.instructions if ours and self.instructions and ours.instructions else None


class Ask(NamedTuple):
    """What is asked, and in which numbers."""

    question: str
    dim: int
    precision: str

    @property
    def title(self):
        return f"{self.question}, {self.dim}-D, {self.precision}"

    @property
    def variant(self):
        """Which of ours is asked."""
        return f"gjk{self.dim}{'f' if self.precision == 'float' else ''}"


class Place(NamedTuple):
    """A class of pairs in one state, asked one question."""

    ask: Ask
    name: str
    state: str
    pairs: int
    timed: int
    truth_width: float
    supports_alone: float | None
    """Nanoseconds to ask each body for one corner, by the functions of ours; None where no pair was safe to time."""
    answers: list[Answers]

    @property
    def title(self):
        return f"{self.name}, {self.state}"

    def defaults(self, warm=False):
        return [a for a in self.answers if a.default and a.warm == warm]

    def default(self, library, warm=False):
        return next((a for a in self.defaults(warm) if a.library == library), None)

    def ours(self, warm=False):
        """Everyone is held against this one."""
        return self.default(self.ask.variant, warm) or self.default("gjk", warm)

    def most_exact_of_ours(self, warm=False):
        """In the precision of the pairs or, of pairs in float, in double: the two stand side by side in one library."""
        own = [a for a in self.defaults(warm) if a.is_ours and a.max_error is not None]
        return min(own, key=lambda a: (a.bad > 0, a.max_error), default=None)

    def theirs(self, warm=False):
        return [a for a in self.defaults(warm) if not a.is_ours]

    def is_warm(self):
        """Whether someone was timed both ways."""
        return any(a.warm and a.is_timed for a in self.answers)


class Measured:
    """All rows of some runs, and what runs under callgrind counted: their own rows, and the folders they wrote to."""

    def __init__(self, paths, counted=(), counts=()):
        files = [read(path) for path in paths]
        counting = [row for path in counted for row in read(path)]
        instructions = instructions_of(counting, counts)
        self.counted = next((row["pairs"] for row in counting if row["row"] == "head"), 0)
        self.heads = [rows[0] for rows in files]
        self.failures = sum(rows[-1]["failures"] for rows in files)
        rows = [row for file in files for row in file]
        self.growth = [row for row in rows if row["row"] == "growth"]
        answers = {}
        for row in rows:
            if row["row"] == "answers":
                answers.setdefault(where(row), []).append(_answers(row, instructions))
        self.places = [_place(row, answers.get(where(row), [])) for row in rows if row["row"] == "class"]
        self.peers = {p["name"]: p for head in self.heads for p in head["peers"]}
        self.missing = list(dict.fromkeys(name for head in self.heads for name in head["missing"]))

    @property
    def head(self):
        return self.heads[0]

    @property
    def libraries(self):
        """Ours first."""
        names = dict.fromkeys([a.library for p in self.places for a in p.answers] + [r["library"] for r in self.growth])
        return sorted(names, key=lambda name: not name.startswith("gjk"))

    def asks(self):
        return list(dict.fromkeys(p.ask for p in self.places))

    def of(self, ask):
        return [p for p in self.places if p.ask == ask]


def read(path):
    with open(path, encoding="utf-8") as lines:
        rows = [json.loads(row) for row in lines]
    if not rows or rows[-1]["row"] != "end":
        raise Incomplete(f"{path} is not complete")
    return rows


def where(row):
    return Ask(row["question"], row["dim"], row["precision"]), row["class"], row["state"]


def _place(row, answers):
    return Place(*where(row), row["pairs"], row["timed"], row["truth_width"], row["supports_median"], answers)


def _answers(row, instructions):
    fields = {name: row[name] for name in Answers._fields if name != "failure"}
    fields["instructions"] = instructions.get(row["label"], row["instructions"])
    return Answers(**fields, failure=row.get("failure"))


def instructions_of(rows, counts):
    """Instructions of an answer, by label, what asking costs by itself taken off. Callgrind wrote a file for each."""
    answers, totals = Counter(), Counter()
    for row in rows:
        if row["row"] == "counted":
            answers[row["label"]] += row["answers"]
    for path in (path for folder in counts for path in glob.glob(os.path.join(glob.escape(folder), "callgrind.*"))):
        with open(path, encoding="utf-8") as lines:
            text = lines.read()
        label = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.MULTILINE)
        total = re.search(r"^totals: (\d+)", text, re.MULTILINE)
        if label and total:
            totals[label.group(1)] += int(total.group(1))
    each = {label: total / answers[label] for label, total in totals.items() if answers[label]}
    return {label: count - each.get("nothing", 0) for label, count in each.items()}


def mean_ratio(ratios):
    """The geometric mean: of x and 1/x it is 1."""
    return math.exp(sum(map(math.log, ratios)) / len(ratios))

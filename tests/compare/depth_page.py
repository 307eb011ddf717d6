# SPDX-License-Identifier: MIT
"""Writes docs/depth.md from what the program depth measured. All of its words about results are computed.

Ends with 1 where the library failed; the page is written even so.
"""

import argparse
import glob
import json
import os
import re
import sys
import time

from page import depth_cell, failed_of, line, machine, peer_table, rule, short, small

OURS = "gjk"

HOW_TO_READ = """\
## How to read it

Each class of pairs is drawn at random, from a seed; all overlap by the way they are drawn, or touch exactly. Sizes are
about 1. All are asked of the same pairs, of the same numbers: those of the poses too. The peers' support functions are
plain ones, as their manuals have them, and do the work that the library's own do: of points each is looked at, of a box
the signs, of a round body one root.

Every answer is judged by the truth about that pair: whole numbers of any length where the bodies are spelled by their
corners, else a bracket of 113 bits, whose width is given where it is more than rounding. The *scale* of a pair is its
largest coordinate relative to a point between the bodies.

| column | what it says |
|---|---|
| error | of the depth, in scales: median and largest |
| of the depth | the largest error as a part of the depth |
| excess | how much further than the depth the second body must really be moved along the normal that came back, at most, in scales |
| wrong | depths off by more than a hundredth of themselves, and beyond rounding |
| failed | answers without a number; a process that died or took more than a quarter of a second; *missed*: no overlap, or no depth above 0, though they overlap by more than rounding; *no normal*: none of length 1 |
| ns | nanoseconds an answer on the processor: least and median of the rounds; in each round everyone in turn answers all pairs of the class. What asking costs by itself is taken off |
| instructions | an answer, counted by callgrind; likewise |
| ÷ ours | what it takes divided by what `gjk` takes: above 1 it is slower, below 1 faster; time by the medians |

Whoever asks for less accuracy does less work: the rows say what each was asked for. `gjk` stops at its tolerance too,
but proves its bracket, rounding included, and where rounding leaves a sign or a digit of bodies with corners open it
decides that without rounding; the peers return what they have got. A run fails where the library's own answer, of bodies
with corners and no radius, is off by more than 4 u·scale, its way out longer by more than 16, or where it fails at all.
"""


class Measured:
    """What the program wrote, and what callgrind counted."""

    def __init__(self, path, counted, counts):
        rows = read(path)
        self.head, self.failures = rows[0], rows[-1]["failures"]
        self.classes = [row for row in rows if row["row"] == "class"]
        self.answers = {(row["class"], row["peer"]): row for row in rows if row["row"] == "answers"}
        self.peers = [p["name"] for p in self.head["peers"]]
        self.instructions = instructions(counted, counts) if counted else {}

    def of(self, name):
        """The rows of one class."""
        return [self.answers[name, p] for p in self.peers if (name, p) in self.answers]

    def asked(self):
        """The peers that took part in anything."""
        return [p for p in self.head["peers"] if any((c["class"], p["name"]) in self.answers for c in self.classes)]

    def counted(self, name, peer):
        """Instructions an answer; None: not counted."""
        own, nothing = (self.instructions.get(f"{name}/{who}") for who in (peer, "nothing"))
        return None if own is None or nothing is None else own - nothing


def read(path):
    with open(path, encoding="utf-8") as lines:
        rows = [json.loads(row) for row in lines]
    if not rows or rows[-1]["row"] != "end":
        sys.exit(f"{path} is not complete")
    return rows


def instructions(counted, counts):
    """Of each label how many an answer: callgrind writes a file for each."""
    answers = {row["label"]: row["answers"] for row in read(counted) if row["row"] == "counted"}
    found = {}
    for path in glob.glob(os.path.join(glob.escape(counts), "callgrind.*")):
        with open(path, encoding="utf-8") as lines:
            text = lines.read()
        label = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.MULTILINE)
        total = re.search(r"^totals: (\d+)", text, re.MULTILINE)
        if label and total and answers.get(label.group(1)):
            found[label.group(1)] = int(total.group(1)) / answers[label.group(1)]
    return found


def ratio(own, ours):
    return "–" if own is None or not ours else f"{own / ours:.2f}"


def ns(x):
    return f"{x:.0f}"


def time_table(measured):
    """Of each class what everyone takes, beside ours."""
    others = [p["name"] for p in measured.asked() if p["name"] != OURS]
    yield line(["", f"{OURS}: ns", "instructions", *(f"{p} ÷ ours" for p in others)])
    yield rule(3 + len(others))
    for c in measured.classes:
        name = c["class"]
        ours, count = measured.answers[name, OURS]["median"], measured.counted(name, OURS)
        cells = []
        for p in others:
            row = measured.answers.get((name, p))
            by_count = ratio(measured.counted(name, p), count)
            text = ratio(row["median"], ours) if row else "–"
            cells.append(text if by_count == "–" else f"{text}, {by_count}")
        yield line([name, ns(ours), "–" if count is None else ns(count), *cells])


def error_table(measured):
    peers = [p["name"] for p in measured.asked()]
    yield line(["", *peers])
    yield rule(1 + len(peers))
    for c in measured.classes:
        rows = [measured.answers.get((c["class"], p)) for p in peers]
        yield line([c["class"], *(depth_cell(row, c["pairs"]) if row else "–" for row in rows)])


def class_text(c):
    text = f"{c['pairs']} pairs"
    if c["most"] > 1e-15:
        text += f", from {small(c['least'])} to {small(c['most'])} scales deep"
    else:
        text += ", which touch"
    if c["truth_width"] > 1e-20:
        text += f"; the truth is known to {small(c['truth_width'])} scales"
    if c["timed"] != c["pairs"]:
        text += f"; {c['pairs'] - c['timed']} on which one crashes or hangs are left out of the times of all"
    return text + "."


def class_table(measured, c):
    columns = ["error: median", "largest", "of the depth", "excess", "wrong", "failed"]
    columns += ["ns: least", "median", "÷ ours", "instructions", "÷ ours"]
    yield line(["", *columns])
    yield rule(1 + len(columns))
    name = c["class"]
    ours, count = measured.answers[name, OURS], measured.counted(name, OURS)
    for row in measured.of(name):
        own = measured.counted(name, row["peer"])
        errors = [small(row[k]) for k in ("median_error", "error", "relative", "excess")]
        times = [ns(row["least"]), ns(row["median"]), ratio(row["median"], ours["median"])]
        counts = ["–" if own is None else ns(own), ratio(own, count)]
        yield line([row["peer"], *errors, str(row["wrong"]), str(failed_of(row)), *times, *counts])


def page(measured, command):
    head = measured.head
    yield "<!-- SPDX-License-Identifier: MIT -->"
    yield "# Depth"
    yield ""
    yield "How deep everyday shapes overlap, how well gjk and other libraries say so, and what that costs. This page is"
    yield "written by a program; do not edit it. To write it anew:"
    yield ""
    yield "```sh"
    yield command
    yield "```"
    yield ""
    yield f"{time.strftime('%Y-%m-%d', time.gmtime())}: gjk {head['version']}, {head['pairs']} pairs of each class, seed"
    yield f"{head['seed']}, {head['rounds']} rounds; {head['compiler']}; {machine()}. The peers are as their"
    yield "packagers compiled them, where the version does not say otherwise. Pairs that are hard on purpose, other"
    yield "dimensions and precisions: [stability](stability.md)."
    yield ""
    yield from peer_table(measured.asked(), head["missing"], ("how_deep",))
    left_out = [p["name"] for p in head["peers"] if p not in measured.asked()]
    if left_out:
        yield ""
        yield f"Not asked, for they are fed points without a pose only: {', '.join(left_out)}."
    yield ""
    yield "## Time"
    yield ""
    yield "Nanoseconds and instructions an answer, and of the others what each takes divided by that: by time"
    yield "(medians)" + (", by instructions." if measured.instructions else ". Instructions were not counted.")
    yield ""
    yield from time_table(measured)
    yield ""
    yield "## Error"
    yield ""
    yield "Largest error of the depth, largest excess of the way out, in scales; then how many are wrong or failed."
    yield ""
    yield from error_table(measured)
    yield ""
    yield HOW_TO_READ.rstrip()
    for c in measured.classes:
        yield ""
        yield f"## {c['class'][0].upper()}{c['class'][1:]}"
        yield ""
        yield class_text(c)
        yield ""
        yield from class_table(measured, c)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--command", default="sh tests/compare/depth.sh", help="that wrote the page")
    parser.add_argument("--counted", metavar="RESULTS.jsonl", help="of the run under callgrind")
    parser.add_argument("--counts", metavar="FOLDER", help="with what callgrind wrote")
    parser.add_argument("-o", "--output", required=True, metavar="PAGE")
    parser.add_argument("results", metavar="RESULTS.jsonl")
    options = parser.parse_args()
    measured = Measured(options.results, options.counted, options.counts)
    with open(options.output, "w", encoding="utf-8") as out:
        for text in page(measured, options.command):
            print(text, file=out)
    print(
        f"{measured.head['pairs']} pairs of each of {len(measured.classes)} classes, {measured.failures} failures;"
        f" missing peers: {', '.join(measured.head['missing']) or 'none'}"
    )
    return 1 if measured.failures else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: MIT
"""Writes docs/stability.md from what the programs stability.* measured. All of its words about results are computed.

Ends with 1 where the library failed; the page is written even so.
"""

import argparse
import json
import os
import re
import sys
import time

from pages.writing import case_text, line, machine, rule, short, small

VARIANTS = {
    "gjk2": "2-D, double",
    "gjk2f": "2-D, float",
    "gjk3": "3-D, double",
    "gjk3f": "3-D, float",
}
CASES = ["museum", "worked cases"]
FAR, DEEP = range(2)  # what a peer may be asked

HOW_TO_READ = """\
## How to read it

Each family of pairs is drawn at random, from a seed, around one kind of trouble; they are listed below. The
*museum* holds the cases that broke other libraries, taken from their bug trackers; the *worked cases* are
`tests/cases`, solved in exact arithmetic by other code. Every answer is judged by the exact truth about that pair:
whole numbers of any length where the bodies are spelled by their corners, else a bracket of 113 bits.

*u* is the unit of roundoff, 2^-53 in double and 2^-24 in float. The *scale* of a pair is its largest coordinate
relative to a point between the bodies. So 1 u·scale is what rounding one coordinate can do. What lies below the least
normal number counts as one unit.

Ours:

| column | what it says |
|---|---|
| failures | no answer, or one that ended early; a polytope's distance off by more than 4 u·scale; a tight one off by more than 1 ulp, wider than 2 ulp, or not 0 in exact contact; a verdict left open more than 300 roundings away from contact; those of `penetration`, below |
| violations | brackets that miss the truth: of `distance`, of `distance` with `tight`, of `intersect`, of `penetration` |
| error | the largest error of `distance`, in u·scale |
| width | the widest bracket of `distance`, `upper - lower`, in u·scale |
| tight error, width | the same with `options.tight`, in ulp of the truth: relative, however small the gap; – where the family has no bodies that it is for |
| calls | mean and largest number of support calls of `distance`, one on each shape counted as one |

The peers are fed the best that they can take: every corner mapped in 113 bits relative to the origin of A, then rounded
to the peer's own type. They are judged by the exact truth about what they were fed, in u of their own precision; so a
peer in float is asked about pairs of double, too. Those that take no radius, or no more than 8 corners, are asked about
the others: *(of 52)* says about how many. Each is asked in a process of its own, for at most a quarter of a second.

| column | what it says |
|---|---|
| of a peer that says only whether they meet | wrong verdicts beyond 1e-9 of the scale from contact + wrong ones nearer than that, but beyond 4 u·scale |
| of a peer that measures | the largest error, in u·scale; where it is above 4, then how many pairs are off by more than 4 / 16 / 1000 u·scale |
"""

HOW_TO_READ_DEPTHS = """\
How deep: `penetration` of those pairs that overlap or touch, or may. Ours, in u·scale:

| column | what it says |
|---|---|
| failures | no answer; of bodies with known corners and no radius also a depth off by more than 4 u·scale, a bracket wider than 16, a normal along which b must be moved further than the depth by more than 16 |
| error, width, excess | the largest error, the widest bracket and the most that the way along the normal is longer than the depth, of bodies with known corners and no radius |
| others | the largest error and the widest bracket of all other bodies; of round ones that is how far 64 corners go |
| calls | mean and largest number of support calls, one on each shape counted as one |

The peers, in scales, not in u: the largest error of a depth, the largest excess of a way out; then how many depths are
off by more than a hundredth of themselves, and how many answers failed: *missed* an overlap that is deeper than
rounding, or gave it no depth above 0; gave *no normal* of length 1; an *absurd* length, beyond a million scales; or
none at all.
"""


class Results:
    """All rows of all variants."""

    def __init__(self, paths):
        self.heads, self.ours, self.theirs, self.depths = {}, {}, {}, {}
        for path in paths:
            with open(path, encoding="utf-8") as lines:
                rows = lines.read().splitlines()
            if not rows or rows[-1] != '{"row": "end"}':
                sys.exit(f"{path} is not complete")
            rows = [json.loads(row) for row in rows]
            self.heads[rows[0]["variant"]] = rows[0]
            theirs = {"peer": self.theirs, "peer depth": self.depths}
            for row in rows[1:-1]:
                if row["row"] == "ours":
                    self.ours[row["variant"], row["group"]] = row
                else:
                    theirs[row["row"]][row["variant"], row["group"], row["peer"]] = row
        self.variants = [v for v in VARIANTS if v in self.heads]

    def groups(self, variant):
        return [group for v, group in self.ours if v == variant]

    def peers(self, variant, question=FAR):
        head = self.heads[variant]
        return [p for p in head["peers"] if p["dim"] == head["dim"] and p["asked"][question]]

    def all_peers(self, question=None):
        peers = next(iter(self.heads.values()))["peers"]
        return [p for p in peers if question is None or p["asked"][question]]

    def missing(self):
        return next(iter(self.heads.values()))["missing"]

    def total(self, variant, key):
        return sum(row[key] for (v, _), row in self.ours.items() if v == variant)

    def worst(self, variant, key, of=lambda row: row):
        """The largest and its group; nothing is larger than what is not a number."""
        rows = [(of(row)[key], group) for (v, group), row in self.ours.items() if v == variant]
        return max(rows, key=lambda r: float("inf") if r[0] is None else r[0])

    def failed(self):
        return sum(self.total(v, "failures") + self.total(v, "violations") for v in self.variants)


def wrong_of(row):
    """How many of a peer's answers are wrong beyond excuse."""
    return row["wrong"] + row["over"][2]


def silent_of(row):
    return row["gave_up"] + row["crashed"] + row["hung"]


def cell(peer, row, pairs):
    if not row["asked"]:
        return "–"
    if peer["distances"]:
        text = short(row["error"])
        if row["over"][0]:
            text += ": " + " / ".join(map(str, row["over"]))
    else:
        text = f"{row['wrong']} + {row['near_wrong']}" if row["wrong"] or row["near_wrong"] else "0"
    text = ", ".join([text, *failures_of(row)])
    if row["asked"] != pairs:
        text += f" (of {row['asked']})"
    return text


FAILURES = {"gave_up": "no answer", "crashed": "crashed", "hung": "hung", "missed": "missed", "no_normal": "no normal",
            "absurd": "absurd"}  # fmt: skip


def failures_of(row):
    return [f"{row[key]} {word}" for key, word in FAILURES.items() if row.get(key)]


def depth_cell(row, pairs):
    if not row["asked"]:
        return "–"
    text = f"{small(row['error'])}, {small(row['excess'])}"
    bad = [f"{row['wrong']} wrong"] if row["wrong"] else []
    bad += failures_of(row)
    if bad:
        text += ": " + ", ".join(bad)
    return text if row["asked"] == pairs else f"{text} (of {row['asked']})"


OURS = ["pairs", "failures", "violations", "error", "width", "tight error", "tight width", "calls"]


def our_cells(row):
    bad = [f"**{row[k]}**" if row[k] else "0" for k in ("failures", "violations")]
    tight = [short(row["tight_error"]), short(row["tight_width"])] if row["tight_pairs"] else ["–", "–"]
    calls = f"{row['mean_calls']:.1f}, {row['max_calls']:g}"
    return [str(row["pairs"]), *bad, short(row["error"]), short(row["width"]), *tight, calls]


def table(results, variant, groups, first="family"):
    peers = results.peers(variant)
    yield line([first, *OURS, *(p["name"] for p in peers)])
    yield rule(1 + len(OURS) + len(peers))
    for group in groups:
        ours = results.ours[variant, group]
        cells = [cell(p, results.theirs[variant, group, p["name"]], ours["pairs"]) for p in peers]
        yield line([group, *our_cells(ours), *cells])


OUR_DEPTHS = ["overlap or touch", "failures", "violations", "error", "width", "excess", "others: error", "width", "calls"]


def our_depth_cells(row):
    bad = [f"**{row[k]}**" if row[k] else "0" for k in ("failures", "violations")]
    sharp = [short(row[k]) if row["sharp"] else "–" for k in ("error", "width", "excess")]
    others = [short(row[k]) if row["sharp"] < row["pairs"] else "–" for k in ("round_error", "round_width")]
    return [str(row["pairs"]), *bad, *sharp, *others, f"{row['mean_calls']:.1f}, {row['max_calls']:g}"]


def depth_table(results, variant, groups, first="family"):
    """Of those groups that have pairs which overlap or touch."""
    peers = results.peers(variant, DEEP)
    yield line([first, *OUR_DEPTHS, *(p["name"] for p in peers)])
    yield rule(1 + len(OUR_DEPTHS) + len(peers))
    for group in groups:
        ours = results.ours[variant, group]["deep"]
        if ours["pairs"]:
            cells = [depth_cell(results.depths[variant, group, p["name"]], ours["pairs"]) for p in peers]
            yield line([group, *our_depth_cells(ours), *cells])


def depth_summary(results):
    columns = ["largest error", "widest bracket", "longest way", "others: largest error", "most calls"]
    yield line(["`penetration`", "overlap or touch", "failures", "violations", *columns])
    yield rule(9)
    for v in results.variants:
        rows = [row["deep"] for (w, _), row in results.ours.items() if w == v]
        cells = [str(sum(row[k] for row in rows)) for k in ("pairs", "failures", "violations")]
        for key in ("error", "width", "excess", "round_error", "max_calls"):
            value, group = results.worst(v, key, lambda row: row["deep"])
            cells.append(f"{short(value)} ({group})" if value else "0")
        yield line([f"`{v}`, {VARIANTS[v]}", *cells])


def failed_of(row):
    return sum(row[key] for key in FAILURES)


def depth_lines(results):
    """Of each peer how often its depth is wrong or missing."""
    for peer in results.all_peers(DEEP):
        rows = [row for (_, _, name), row in results.depths.items() if name == peer["name"] and row["asked"]]
        for extreme, where in ((0, ""), (1, " At extreme lengths: ")):
            some = [row for row in rows if row["extreme"] == extreme]
            if not some:
                continue
            wrong, failed, asked = (sum(map(f, some)) for f in (lambda r: r["wrong"], failed_of, lambda r: r["asked"]))
            what = {word: sum(row[key] for row in some) for key, word in FAILURES.items()}
            words = ", ".join(f"{count} {word}" for word, count in what.items() if count)
            text = f"{wrong} depths wrong and {failed} answers failed{f' ({words})' if words else ''} of {asked}"
            if not extreme:
                largest = max(some, key=error_of)
                place = f"{largest['group']} of `{largest['variant']}`"
                text = f"- **{peer['name']}**: {text}; largest error {small(largest['error'])} scales, in {place}."
            else:
                text = f"{text}."
            yield ("  " if extreme else "") + where.lstrip() + text


def summary(results):
    columns = ["largest error", "widest bracket", "tight: largest error", "widest bracket", "most calls"]
    yield line(["", "pairs", "failures", "violations", *columns])
    yield rule(9)
    for v in results.variants:
        cells = [str(results.total(v, k)) for k in ("pairs", "failures", "violations")]
        for key in ("error", "width", "tight_error", "tight_width", "max_calls"):
            value, group = results.worst(v, key)
            cells.append(f"{short(value)} ({group})" if value else "0")
        yield line([f"`{v}`, {VARIANTS[v]}", *cells])


def error_of(row):
    """What is not a number is larger than all."""
    return float("inf") if row["error"] is None else row["error"]


def sums(peer, rows):
    """In words: how often wrong or silent."""
    asked, wrong, silent = (sum(map(f, rows)) for f in (lambda r: r["asked"], wrong_of, silent_of))
    text = f"{wrong} wrong"
    if not peer["distances"]:
        text += f", {sum(r['near_wrong'] for r in rows)} more nearer to contact,"
    if silent:
        text += f" and {silent} missing"
    return f"{text} of {asked} answers"


def peer_lines(results):
    """Of each peer how often it is wrong, and the families where it is most."""
    for peer in results.all_peers(FAR):
        rows = [row for (_, _, name), row in results.theirs.items() if name == peer["name"] and row["asked"]]
        usual, extreme = ([r for r in rows if r["extreme"] == k] for k in (0, 1))
        if not usual:
            yield f"- **{peer['name']}** was asked nothing."
            continue
        text = f"- **{peer['name']}**: {sums(peer, usual)}"
        bad = [r for r in worst_rows(usual) if wrong_of(r) + silent_of(r) + r["near_wrong"]]
        if bad:
            places = [f"{r['group']} of `{r['variant']}` ({share(r)})" for r in bad]
            text += f", most in {', '.join(places)}"
        if peer["distances"]:
            largest = max(usual, key=error_of)
            place = f"{largest['group']} of `{largest['variant']}`"
            text += f"; largest error {short(largest['error'])} u·scale, in {place}"
        if extreme:
            text += f". At extreme lengths: {sums(peer, extreme)}"
        yield text + "."


def share(row):
    return f"{wrong_of(row) + silent_of(row) + row['near_wrong']} of {row['asked']}"


def worst_rows(rows):
    """At most three, of different families."""
    picked, seen = [], set()
    order = sorted(rows, key=lambda r: (wrong_of(r) + silent_of(r), r["near_wrong"], error_of(r)), reverse=True)
    for row in order:
        if "example" in row and row["group"] not in seen:
            picked.append(row)
            seen.add(row["group"])
    return picked[:3]


def truth_text(example):
    low, high = example["lower"], example["upper"]
    if low > 0:
        return f"apart by {low:.9g}"
    if high < 0:
        return f"overlapping by {-high:.9g}"
    return "touching"


SILENCES = {"gave up": "gives no answer", "crashed": "crashes", "hung": "does not come back"}


def said_how_deep(example):
    if example["meet"]:
        return f"says {example['depth'] or 0:.9g} deep" + (
            f", off by {small(example['error'])} scales" if example["failure"] == "sound" else ""
        )
    return "says that they do not overlap"


def said(peer, example):
    silence = SILENCES.get(example.get("outcome", example.get("failure", "").replace("_", " ")))
    if silence:
        return silence
    if "depth" in example:
        return said_how_deep(example)
    if peer["distances"]:
        return f"says {example['distance']:.9g}, off by {short(example['error'])} u·scale"
    return "says that they meet" if example["meet"] else "says that they do not meet"


def is_short(row):
    """Whether its example can be shown; a hull of hundreds of vertices can't."""
    return len(json.dumps(row.get("example"))) <= 3000


def worst_depths(rows):
    """At most two, of different families."""
    rows = [row for row in rows if failed_of(row) + row["wrong"]]
    order = sorted(rows, key=lambda r: (failed_of(r) + r["wrong"], error_of(r)), reverse=True)
    groups = {row["group"]: row for row in reversed(order)}
    return [row for row in order if groups[row["group"]] is row][:2]


def shown(results, peer):
    """The rows of a peer whose examples can be shown."""
    for rows, pick in ((results.theirs, worst_rows), (results.depths, worst_depths)):
        yield from pick(
            row
            for (_, _, name), row in rows.items()
            if name == peer["name"] and not row["extreme"] and is_short(row)
        )


def examples(results):
    for peer in results.all_peers():
        rows = list(shown(results, peer))
        if not rows:
            continue
        yield ""
        yield f"### {peer['name']}"
        for row in rows:
            example = row["example"]
            yield ""
            yield (
                f"{row['group']}, pair {example['index']} of `{row['variant']}`: they are {truth_text(example)};"
                f" {peer['name']} {said(peer, example)}."
            )
            yield ""
            yield "```json"
            yield case_text(example["case"], peer["single"])
            yield "```"


def families(names):
    """What each is, in the words of tests/pairs.h."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "pairs.h")
    with open(path, encoding="utf-8") as source:
        words = re.search(r"enum family \{(.*?)\n\};", source.read(), re.DOTALL).group(1)
    about = dict(re.findall(r"(\w+)(?: = \w+)?,?\s*/\*\s*(.*?)\s*\*/", words, re.DOTALL))
    yield line(["family", "what it holds"])
    yield rule(2, 2)
    for name in names:
        text = " ".join(about.get(name.upper().replace(" ", "_"), "as above").split())
        yield line([name, text])


def peer_table(peers, missing, asked=("how", "how_deep")):
    heads = {"how": "how far: asked by", "how_deep": "how deep: asked by"}
    yield line(["peer", "version", *(heads[k] for k in asked), "precision"])
    yield rule(3 + len(asked), 3 + len(asked))
    for p in peers:
        how = [p[k] or "–" for k in asked]
        yield line([p["name"], p["version"], *how, f"{p['dim']}-D, {'float' if p['single'] else 'double'}"])
    for name in missing:
        yield line([name, "missing: neither installed nor brought", *("" for _ in asked), ""])


def page(results, command):
    head = next(iter(results.heads.values()))
    yield "<!-- SPDX-License-Identifier: MIT -->"
    yield "# Stability"
    yield ""
    yield "How gjk and other libraries stand up to pairs that are hard on floating-point arithmetic: the same pairs for"
    yield "all, judged by exact truth. This page is written by a program; do not edit it. To write it anew:"
    yield ""
    yield "```sh"
    yield command
    yield "```"
    yield ""
    yield f"{time.strftime('%Y-%m-%d', time.gmtime())}: gjk {head['version']}, {head['pairs']} pairs of each family in"
    yield f"each variant, seed {head['seed']}; {head['compiler']}; {machine()}."
    yield ""
    yield from peer_table(results.all_peers(), results.missing())
    yield ""
    yield "## What stands out"
    yield ""
    yield "Errors and brackets are in u·scale, what rounding one coordinate can do, and the tight ones in the last place of"
    yield "the answer. In parentheses: the family where it was."
    yield ""
    yield from summary(results)
    yield ""
    yield from depth_summary(results)
    yield ""
    yield "The others, who were asked about those pairs that they can take. A distance counts as wrong beyond 1000 u·scale,"
    yield "a verdict where the bodies are further than 1e-9 of the scale from contact."
    yield ""
    yield from peer_lines(results)
    yield ""
    yield "How deep, of pairs that overlap or touch; a depth counts as wrong beyond a hundredth of itself, and beyond"
    yield "rounding:"
    yield ""
    yield from depth_lines(results)
    yield ""
    yield HOW_TO_READ.rstrip()
    yield ""
    yield HOW_TO_READ_DEPTHS.rstrip()
    yield ""
    yield from families(dict.fromkeys(g for v in results.variants for g in results.groups(v) if g not in CASES))
    for v in results.variants:
        yield ""
        yield f"## {v}: {VARIANTS[v]}"
        yield ""
        yield from table(results, v, [g for g in results.groups(v) if g not in CASES])
        yield ""
        yield from depth_table(results, v, [g for g in results.groups(v) if g not in CASES], "how deep")
    yield ""
    yield "## The museum and the worked cases"
    for v in results.variants:
        yield ""
        yield from table(results, v, [g for g in CASES if (v, g) in results.ours], v)
        yield ""
        yield from depth_table(results, v, [g for g in CASES if (v, g) in results.ours], f"{v}, how deep")
    yield ""
    yield "## Cases to replay"
    yield ""
    yield "Of each peer up to three families, extreme lengths apart, where it is wrong most often or else furthest off, and"
    yield "of each the smallest pair that shows it; then two where its depth is. The numbers are those that it was fed. `gjk"
    yield "query`, which comes with the Python package, says what ours answers: `echo 'CASE' | gjk query`."
    yield from examples(results)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--command", default="sh tests/compare/stability.sh", help="that wrote the page")
    parser.add_argument("-o", "--output", required=True, metavar="PAGE")
    parser.add_argument("results", nargs="+", metavar="RESULTS.jsonl")
    options = parser.parse_args()
    results = Results(options.results)
    with open(options.output, "w", encoding="utf-8") as out:
        for text in page(results, options.command):
            print(text, file=out)
    for v in results.variants:
        print(
            f"{v}: {results.total(v, 'pairs')} pairs, {results.total(v, 'failures')} failures,"
            f" {results.total(v, 'violations')} violations; missing peers: {', '.join(results.missing()) or 'none'}"
        )
    return 1 if results.failed() else 0


if __name__ == "__main__":
    sys.exit(main())

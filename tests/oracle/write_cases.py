# SPDX-License-Identifier: MIT
"""Writes tests/cases/*.jsonl, or with --check says whether they are what it would write.

Each case has its own seed, its name, so that any of them can be made alone."""

import argparse
import json
import sys
from fractions import Fraction

import depth
from alone import ROOT, exact
from draw import GROUPS, Draw
from proof import prove, prove_separation

VARIANTS = {"gjk2": (2, "double"), "gjk2f": (2, "float"), "gjk3": (3, "double"), "gjk3f": (3, "float")}
MUSEUM = "museum"  # kept by hand: what users of other libraries reported; only its expectations are written here
CASES = ROOT / "tests/cases"


def names(variant):
    dim, _ = VARIANTS[variant]
    return [(group, i) for group, (_, count) in GROUPS[dim].items() for i in range(count)]


def short(x):
    """The shortest decimal that gives a float back; read as a double it may be another double."""
    digits = next(n for n in range(1, 10) if exact.to_float32(float(f"{x:.{n}g}")) == x)
    return float(f"{x:.{digits}g}")


def printable(thing, precision):
    """Numbers as they are written: whole ones without a point, floats as short as they can be."""
    if isinstance(thing, dict):
        return {k: printable(v, precision) for k, v in thing.items()}
    if isinstance(thing, (list, tuple)):
        return [printable(x, precision) for x in thing]
    if not isinstance(thing, (int, float)):
        return thing
    x = float(thing)
    if x == int(x) and abs(x) < 1000:
        return int(x)
    return short(exact.to_float32(x)) if precision == "float" else x


def expectation(truth, separation):
    found = {
        "distance_lower": exact.decimal(truth.lower, False),
        "distance_upper": exact.decimal(truth.upper, True),
        "relation": truth.relation,
        "scale": float(exact.decimal(truth.scale, True, 6)),
    }
    if truth.relation == exact.OVERLAPPING:
        found["separation_lower"] = exact.decimal(separation.lower, False)
        found["separation_upper"] = exact.decimal(separation.upper, True)
    return found


def solved(case):
    """The case with its expectation, proven twice; None where touching cannot be told from nearly so."""
    truth = exact.solve_case(case)
    a, b = case["a"], case["b"]
    if case["precision"] == "float":
        a, b = exact.round_to_float(a), exact.round_to_float(b)
    prove(truth, a, b, case["dim"])
    if not truth.proven:
        return None
    if truth.upper - truth.lower > truth.scale * Fraction(1, 10**25):
        raise exact.Unproven(f"{case['id']}: bracket too wide")
    separation = depth.separation(truth, a, b, case["dim"])
    prove_separation(separation, truth, a, b, case["dim"])
    return {**case, "expect": expectation(truth, separation)}


def make(variant, group, index):
    """One case, as its line."""
    dim, precision = VARIANTS[variant]
    name = f"{variant}/{group}/{index}"
    draw = Draw(name, dim, precision)
    found = None
    while found is None:
        pair = GROUPS[dim][group][0](draw)
        if pair is not None:
            a, b = printable(pair, precision)
            case = {"id": name, "group": group, "dim": dim, "precision": precision, "query": "distance", "a": a, "b": b}
            found = solved(case)
    return json.dumps(found, separators=(",", ":"))


def drawn(variant):
    todo = names(variant)
    for k, (group, index) in enumerate(todo):
        yield make(variant, group, index)
        if sys.stderr.isatty():
            print(f"\r{variant}: {k + 1} of {len(todo)} ", end="", file=sys.stderr)


def solved_again(path):
    """The cases of a file kept by hand, with their expectations as they should be."""
    for line in path.read_text().splitlines():
        case = {k: v for k, v in json.loads(line).items() if k != "expect"}
        found = solved(case)
        if found is None:
            raise exact.Unproven(f"{case['id']}: touching or not?")
        yield json.dumps(found, separators=(",", ":"))


def write(name, check):
    path = CASES / f"{name}.jsonl"
    lines = list(drawn(name) if name in VARIANTS else solved_again(path))
    text = "".join(line + "\n" for line in lines)
    same = path.exists() and path.read_text() == text
    if not check:
        path.write_text(text)
    print(f"{path.relative_to(ROOT)}: {len(lines)} cases, {len(text)} bytes{', stale' if check and not same else ''}")
    return same


def main():
    files = [*VARIANTS, MUSEUM]
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; 1 where a file is stale")
    parser.add_argument("files", nargs="*", default=files, metavar="FILE", help=" ".join(files))
    options = parser.parse_args()
    same = [write(name, options.check) for name in options.files]
    return 1 if options.check and not all(same) else 0


if __name__ == "__main__":
    sys.exit(main())

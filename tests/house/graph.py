# SPDX-License-Identifier: MIT
"""Whether docs/design.md draws the includes of src/core as they are: every file stands in it, an include leads to what
is drawn to its left, and each arrow is one."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def drawn(page):
    """The arrows, from a file to what stands before it; "a, b <- c <- d; e | f <- g" are c to a, c to b, d to c..."""
    block = re.search(r"^src/core/ +(.*?)^tests/", page, re.S | re.M).group(1)
    arrows = set()
    for line in block.replace("\n               ", "\n").splitlines():
        for chain in line.split(";"):
            ranks = [re.findall(r"\w+", rank) for rank in chain.split("<-")]
            for left, right in zip(ranks, ranks[1:]):
                arrows |= {(r, x) for r in right for x in left}
    return arrows


def included():
    found = {}
    for path in sorted((ROOT / "src/core").glob("*.h")):
        found[path.stem] = set(re.findall(r'^#include "(\w+)\.h"', path.read_text(), re.M))
    return found


def reached(start, steps):
    seen, open_ends = set(), [start]
    while open_ends:
        for x in steps.get(open_ends.pop(), ()):
            if x not in seen:
                seen.add(x)
                open_ends.append(x)
    return seen


arrows = drawn((ROOT / "docs/design.md").read_text())
files = included()
graph = {}
for right, left in arrows:
    graph.setdefault(right, set()).add(left)
faults = [f"{f} is not drawn" for f in files if f not in {x for arrow in arrows for x in arrow}]
faults += [f"{x} includes {y}, which is not drawn" for x in files for y in files[x] - reached(x, graph)]
faults += [f"{y} <- {x} is drawn, and no include leads there" for x, y in sorted(arrows) if y not in reached(x, files)]
print("\n".join(faults))
sys.exit(bool(faults) or not arrows)

# SPDX-License-Identifier: MIT
"""Tells what instructions.sh counted."""

import sys

from pages.measured import instructions_of, read, where


def told(name, count, ours):
    """Divided by ours, save of ours itself."""
    return f"{name} {count:.0f}" + (f" ({count / ours:.2f})" if ours and count != ours else "")


def lines(rows, counts):
    """One for each class and question; ours first."""
    each = instructions_of(rows, [counts])
    asked = {}
    for row in rows:
        if row["row"] == "counted" and row.get("default"):
            asked.setdefault(where(row), []).append(row)
    for (ask, name, state), own in asked.items():
        ours = {row["warm"]: each[row["label"]] for row in own if row["ours"]}
        yield f"{ask.title}: {name}, {state}:  " + "  ".join(
            told(row["library"] + ", warm" * row["warm"], each[row["label"]], ours.get(row["warm"])) for row in own
        )


if __name__ == "__main__":
    print("\n".join(lines(read(sys.argv[1]), sys.argv[2])))

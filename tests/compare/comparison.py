# SPDX-License-Identifier: MIT
"""Writes docs/comparison.md, the page with all plots, and the plot of the README, from what the bench measured.

Ends with 1 where the library failed; the pages are written even so. The plots need the package gjk[report].
"""

import argparse
import os
import sys

from pages import markdown
from pages.measured import Incomplete, Measured


def write(path, text):
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    with open(path, "w", encoding="utf-8") as out:
        out.write(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--command", default="sh tests/compare/comparison.sh", help="that wrote the page")
    parser.add_argument("--counted", nargs="+", default=[], metavar="COUNTED.jsonl", help="of runs under callgrind")
    parser.add_argument("--counts", nargs="+", default=[], metavar="FOLDER", help="with what callgrind wrote")
    parser.add_argument("-o", "--output", metavar="PAGE.md")
    parser.add_argument("--html", metavar="PAGE.html")
    parser.add_argument("--plot", metavar="PLOT.svg", help="the one of the README")
    parser.add_argument("results", nargs="+", metavar="RESULTS.jsonl")
    options = parser.parse_args()
    try:
        measured = Measured(options.results, options.counted, options.counts)
    except Incomplete as wrong:
        sys.exit(str(wrong))
    if options.html or options.plot:
        from pages import webpage

        if options.html:
            write(options.html, webpage.page(measured, options.command))
        if options.plot:
            write(options.plot, webpage.plot(measured))
    if options.output:
        plot = options.plot and os.path.relpath(options.plot, os.path.dirname(options.output))
        write(options.output, "\n".join(markdown.page(measured, options.command, plot)) + "\n")
    missing = ", ".join(measured.missing) or "none"
    print(f"{len(measured.places)} classes of pairs, {measured.failures} failures; missing peers: {missing}")
    return 1 if measured.failures else 0


if __name__ == "__main__":
    sys.exit(main())

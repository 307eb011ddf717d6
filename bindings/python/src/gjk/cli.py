# SPDX-License-Identifier: MIT
"""The command gjk."""

from __future__ import annotations

import argparse
import json
import os
import sys
import traceback
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, TextIO

from . import __version__
from .cases import QUERIES, solve_case

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code, as README.md has it."""
    chosen = _parser().parse_args(arguments)
    if sys.stdout is None:
        return _failed(chosen, "standard output is closed")
    try:
        return int(chosen.run(chosen))
    except BrokenPipeError:  # the reader has seen enough: say no more
        _drop_output()
        return 141
    except OSError as wrong:
        _drop_output()
        return _failed(chosen, wrong)
    except KeyboardInterrupt:
        return 130
    except Exception:  # our own mistake, which Python would end with 1: that a bracket misses the truth
        traceback.print_exc()
        return 2


def _failed(chosen: argparse.Namespace, wrong: object) -> int:
    if sys.stderr is not None:  # of none, print would make standard output
        print(f"gjk {chosen.command}: {wrong}", file=sys.stderr)
    return 2


def _drop_output() -> None:
    """What cannot be written is not tried once more at exit."""
    try:
        sys.stdout.flush()
    except OSError:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), sys.stdout.fileno())


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="gjk", description="How two convex sets stand to each other, with proof.")
    parser.add_argument("--version", action="version", version=f"gjk {__version__}")
    commands = parser.add_subparsers(title="commands", dest="command", required=True, metavar="COMMAND")
    _add_query(commands)
    _add_report(commands)
    return parser


def _add_query(commands: Any) -> None:
    text = "Answer cases. Reads one JSON object a line, writes one a line."
    query = commands.add_parser("query", help="answer cases, one JSON object a line", description=text)
    query.add_argument("file", nargs="?", metavar="FILE", help="of cases; standard input where absent")
    query.add_argument("--query", choices=QUERIES, help="the question where a case does not say one (distance)")
    query.set_defaults(run=_run_query)


def _add_report(commands: Any) -> None:
    text = "Solve every pair of a scene at a ladder of accuracies; show error against run time."
    report = commands.add_parser("report", help="error against run time of a scene", description=text)
    report.add_argument("scene", type=Path, metavar="SCENE", help="a scene file (JSON)")
    report.add_argument("--out", type=Path, default=Path("report"), metavar="DIR", help="folder to write to (report)")
    report.add_argument("--precision", choices=("double", "float", "both"), default="both", help="(both)")
    report.add_argument("--jobs", type=_positive, default=None, metavar="N", help="processes for the exact truth")
    report.add_argument("--limit", type=_positive, default=None, metavar="N", help="ask about N of the pairs only")
    report.set_defaults(run=_run_report)


def _positive(text: str) -> int:
    try:
        number = int(text)
    except ValueError:
        number = 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"a whole number from 1 up is expected, not {text!r}")
    return number


def _run_query(chosen: argparse.Namespace) -> int:
    if chosen.file is not None:
        with open(chosen.file, "rb") as lines:
            return answer_lines(lines, sys.stdout, chosen.query)
    if sys.stdin is None:
        return _failed(chosen, "standard input is closed")
    return answer_lines(sys.stdin.buffer, sys.stdout, chosen.query)


def answer_lines(lines: Iterable[bytes], out: TextIO, query: str | None = None) -> int:
    """One line of answer for each that is not blank. Returns 1 where a line was not a JSON object, else 0."""
    code = 0
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            case = _parse(line)
            json.dumps([case.get("id")], allow_nan=False)  # such as it stands in the answer
        except (ValueError, RecursionError) as wrong:
            answer: dict[str, Any] = {"line": number, "status": "bad line", "message": str(wrong)}
            code = 1
        else:
            answer = solve_case(case, query)
        print(json.dumps(answer), file=out, flush=True)
    return code


def _parse(line: bytes) -> dict[str, Any]:
    case = json.loads(line)
    if not isinstance(case, dict):
        raise ValueError("a case is a JSON object")
    return case


def _run_report(chosen: argparse.Namespace) -> int:
    try:
        from .report import run
    except ImportError as missing:
        return _failed(chosen, f"needs {missing.name}: pip install './bindings/python[report]'")
    return run(chosen.scene, chosen.out, chosen.precision, chosen.jobs, chosen.limit)


if __name__ == "__main__":
    sys.exit(main())

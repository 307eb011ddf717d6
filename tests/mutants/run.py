# SPDX-License-Identifier: MIT
"""Weakens the library in one place at a time, in a copy, and says which of the C tests notices.

A mutant is a text in a source file and what takes its place; mutants.txt lists them. The exit status is 0 only if each
one applies and builds, each is noticed, and those that are listed as equivalent are not."""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from queue import Queue

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
LEFT = shutil.ignore_patterns(".*", "build", "bindings", "docs", "__pycache__")
SETTINGS = ["CMAKE_BUILD_TYPE=Release", "GJK_BUILD_SHARED=OFF", "GJK_TEST_WARNINGS=OFF"]
OF_A_VARIANT = re.compile(r"(?!compare\.)\w+\.gjk[23]f?$")  # those of the code alone: not of peers, fuzzers, files


@dataclass
class Mutant:
    name: str
    file: str = ""
    old: list = field(default_factory=list)
    new: list = field(default_factory=list)
    equivalent: str = ""

    def apply(self, text):
        """The text with the mutant in it; None where that is not one place."""
        old, new = "\n".join(self.old), "\n".join(self.new)
        return text.replace(old, new) if old and text.count(old) == 1 else None


def read_mutants(path):
    """'== NAME' starts one; 'file: PATH'; '- ' and '+ ' lines; 'equivalent: WHY', which may go on below, indented."""
    mutants = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        if line.startswith("== "):
            mutants.append(Mutant(line[3:].strip()))
            continue
        key, _, rest = line.partition(": ")
        if line[:2] in ("- ", "+ ") or line in ("-", "+"):
            (mutants[-1].old if line[0] == "-" else mutants[-1].new).append(line[2:])
        elif key in ("file", "equivalent"):
            setattr(mutants[-1], key, rest.strip())
        elif line.startswith("  ") and mutants and mutants[-1].equivalent:
            mutants[-1].equivalent += " " + line.strip()
        else:
            sys.exit(f"{path.name}:{number}: not understood: {line}")
    names = [mutant.name for mutant in mutants]
    if len(set(names)) != len(names):
        sys.exit(f"{path.name}: two mutants of one name")
    return mutants


class Tree:
    """A copy of the sources, its build and its tests."""

    def __init__(self, path, settings):
        self.path, self.build, self.times = path, path / "build", {}
        shutil.copytree(ROOT, path, ignore=LEFT)
        command = ["cmake", "-S", path, "-B", self.build, *(f"-D{setting}" for setting in settings)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        self.tests = self.shown()
        self.make(check=True)
        self.tests = self.shown()  # and now with their commands

    def shown(self):
        command = ["ctest", "--test-dir", self.build, "--show-only=json-v1"]
        shown = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
        return {test["name"]: test for test in shown["tests"] if OF_A_VARIANT.match(test["name"])}

    def make(self, check=False):
        command = ["cmake", "--build", self.build, "--target", *self.tests]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if check and done.returncode:
            sys.exit(f"the sources do not build as they are:\n{done.stdout[-3000:]}")
        return done.returncode == 0

    def run(self, name, timeout):
        """'' where the test passes; otherwise what happened."""
        test = self.tests[name]
        wanted = {p["name"]: p["value"] for p in test.get("properties", [])}
        env = {**os.environ, **dict(pair.split("=", 1) for pair in wanted.get("ENVIRONMENT", []))}
        try:
            done = subprocess.run(
                test["command"],
                env=env,
                cwd=wanted.get("WORKING_DIRECTORY", self.build),
                timeout=timeout,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return "does not end"
        if done.returncode == 0:
            return ""
        failed = re.findall(r"\[  FAILED  \] ([^\d\s][^\n]*)", done.stdout.decode(errors="replace"))
        return failed[0] if failed else f"ends with {done.returncode}"

    def try_mutant(self, mutant, order, every):
        """What became of it: a word, and by what; by the first test that notices, or by every one."""
        path = self.path / mutant.file
        before = path.read_text(encoding="utf-8") if path.is_file() else ""
        mutated = mutant.apply(before)
        if mutated is None:
            return "does not apply", mutant.file or "no file"
        path.write_text(mutated, encoding="utf-8")
        try:
            if not self.make():
                return "does not build", mutant.file
            by = []
            for name in order:
                what = self.run(name, 60 + 6 * self.times[name])
                if what:
                    by.append(f"{name}: {what}")
                    if not every:
                        break
            return ("noticed", ", ".join(by)) if by else ("not noticed", "")
        finally:
            path.write_text(before, encoding="utf-8")


def baseline(tree):
    """Runs all tests on the sources as they are. Returns their names, the quickest first."""
    for name in sorted(tree.tests):
        start = time.monotonic()
        what = tree.run(name, 1800)
        if what:
            sys.exit(f"{name} fails without any mutant: {what}")
        tree.times[name] = time.monotonic() - start
    return sorted(tree.tests, key=tree.times.get)


def verdict(mutant, outcome):
    """Whether the outcome is as it should be."""
    return outcome == ("not noticed" if mutant.equivalent else "noticed")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="PATTERN", help="only mutants whose names match one of these")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="copies to work on at once (1)")
    parser.add_argument("--pairs", type=int, default=20000, metavar="N", help="drawn by the test 'brackets' (20000)")
    parser.add_argument("--list", default=HERE / "mutants.txt", type=Path, metavar="FILE", help="the mutants")
    parser.add_argument("--all", action="store_true", help="run every test, not only up to the first that notices")
    parser.add_argument("--check", action="store_true", help="only say whether each mutant applies")
    options = parser.parse_args()
    mutants = [
        m for m in read_mutants(options.list) if not options.names or any(re.search(n, m.name) for n in options.names)
    ]
    if options.check:
        stale = [m.name for m in mutants if m.apply((ROOT / m.file).read_text(encoding="utf-8")) is None]
        print(f"{len(mutants)} mutants, {len(stale)} do not apply", *stale, sep="\n  ")
        return 1 if stale else 0
    with tempfile.TemporaryDirectory(prefix="gjk-mutants-") as folder:
        settings = [*SETTINGS, f"GJK_TEST_PAIRS={options.pairs}"]
        trees = Queue()
        first = Tree(Path(folder) / "0", settings)
        order = baseline(first)
        print(f"{len(order)} tests pass on the sources as they are, in {sum(first.times.values()):.0f} s", flush=True)
        trees.put(first)
        for i in range(1, min(options.jobs, len(mutants))):
            tree = Tree(Path(folder) / str(i), settings)
            tree.times = first.times
            trees.put(tree)

        def work(mutant):
            tree = trees.get()
            try:
                outcome, by = tree.try_mutant(mutant, order, options.all)
            finally:
                trees.put(tree)
            good = verdict(mutant, outcome)
            why = f" ({mutant.equivalent})" if mutant.equivalent else ""
            print(f"{'ok ' if good else 'NOT'} {mutant.name}: {outcome}{' by ' if by else ''}{by}{why}", flush=True)
            return good

        with ThreadPoolExecutor(options.jobs) as pool:
            good = list(pool.map(work, mutants))
    print(f"{sum(good)} of {len(good)} mutants came out as they should")
    return 0 if all(good) and good else 1


if __name__ == "__main__":
    sys.exit(main())

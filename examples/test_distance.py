# SPDX-License-Identifier: MIT
"""The Python example, run as a reader would run it."""

import pathlib
import re
import subprocess
import sys


def test_prints_the_distance_and_its_bracket():
    example = pathlib.Path(__file__).with_name("distance.py")
    printed = subprocess.run([sys.executable, example], check=True, capture_output=True, text=True).stdout
    found = re.fullmatch(r"distance 1\.9, proven to be in \[(.*), (.*)\]\n", printed)
    assert found, printed
    lower, upper = map(float, found.groups())
    assert lower <= 1.9 <= upper
    assert upper - lower < 1e-12

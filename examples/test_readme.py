# SPDX-License-Identifier: MIT
"""The README shows the examples that the tests run, to the letter."""

import pathlib
import re
import subprocess

import pytest

EXAMPLES = pathlib.Path(__file__).parent


def blocks(language):
    text = (EXAMPLES.parent / "README.md").read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize(("language", "name"), [("c", "distance.c"), ("python", "distance.py")])
def test_shows_the_example(language, name):
    licence, source = (EXAMPLES / name).read_text(encoding="utf-8").split("\n", 1)
    assert "SPDX" in licence
    assert blocks(language) == [source]


def test_says_what_it_prints(tmp_path):
    """Built as the README says to without a build system, the C example prints the line that the README gives."""
    root, program = EXAMPLES.parent, tmp_path / "distance"
    flags = ["-O2", "-ffp-contract=off", "-DGJK_STATIC", f"-I{root / 'include'}", "-o", program]
    sources = [EXAMPLES / "distance.c", root / "src/common.c", root / "src/gjk3.c"]
    subprocess.run(["cc", *flags, *sources, "-lm"], check=True)
    printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout.strip()
    assert f"It prints `{printed}`" in (root / "README.md").read_text(encoding="utf-8")

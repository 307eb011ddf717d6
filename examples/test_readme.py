# SPDX-License-Identifier: MIT
"""The README shows the examples that the tests run, to the letter."""

import pathlib
import re
import shlex
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
    """Built by the README's own command, without installing anything, the C example prints the line that it gives."""
    root, program = EXAMPLES.parent, tmp_path / "distance"
    (command,) = (line for block in blocks("sh") for line in block.splitlines() if line.startswith("cc "))
    words = shlex.split(command)
    assert words[-2:] == ["-o", program.name]
    subprocess.run([*words[:-1], program], check=True, cwd=root)
    printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout.strip()
    assert f"It prints `{printed}`" in (root / "README.md").read_text(encoding="utf-8")

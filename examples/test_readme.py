# SPDX-License-Identifier: MIT
"""The README shows the examples that the tests run, to the letter."""

import pathlib
import re

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

# SPDX-License-Identifier: MIT
"""The package as a whole: names, version, imports, the examples of the documentation."""

from __future__ import annotations

import doctest
import re
import subprocess
import sys
from pathlib import Path

import gjk

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
HEADERS = [ROOT / "include/gjk" / name for name in ("common.h", "gjk2.h", "gjk2f.h", "gjk3.h", "gjk3f.h")]
SOURCE = HERE.parent / "src/gjk"

# In the headers and on purpose not in the package.
ABSENT = {
    "support_fn",  # supports are reached by their address
    "stride",  # points are copied, packed
    "reach_a",  # the inside of a cache is the library's
    "reach_b",
    "reserved",
    "gjk_status",  # its values are gjk.Status
}


def regions():
    for header in HEADERS:
        text = header.read_text(encoding="utf-8")
        yield re.sub(r"/\*.*?\*/", " ", text[text.index("/*[cdef]*/") : text.index("/*[/cdef]*/")], flags=re.DOTALL)


def names_declared():
    """Functions, types, fields, constants; without the variant's prefix, and parameters left out."""
    names = set()
    for region in regions():
        text = re.sub(r"\([^()]*\)\s*;", ";", region)  # parameters
        words = set(re.findall(r"\b[A-Za-z_]\w*(?=\s*(?:\[\w+\])*\s*[;,=}])", text))
        words |= set(re.findall(r"\bgjk\w*|\bGJK_\w+", text)) - {"GJK_API"}
        names |= {re.sub(r"^gjk[23]f?_", "", word) for word in words}
    return names - {"double", "float"}


def test_every_name_of_the_headers_is_used_or_absent_on_purpose():
    names = names_declared()
    assert {"distance", "penetration", "workspace_bytes", "points_reach", "half_length", "GJK_FLOOR"} <= names
    source = "\n".join(
        path.read_text(encoding="utf-8") for path in sorted(SOURCE.rglob("*.py")) if path.name != "exact.py"
    )
    words = set(re.findall(r"\w+", source))
    unused = {name for name in names if name not in words}
    assert unused == ABSENT & names == ABSENT


def test_the_version_is_one():
    text = (HERE.parent / "pyproject.toml").read_text(encoding="utf-8")
    assert re.search(r'^version = "(.*)"', text, re.MULTILINE)[1] == gjk.__version__


def test_all_is_what_there_is():
    public = {name for name in vars(gjk) if name[0] != "_" and not isinstance(getattr(gjk, name), type(sys))}
    assert public - {"annotations"} == set(gjk.__all__) - {"__version__"}
    assert all(getattr(gjk, name).__doc__ for name in gjk.__all__)


def test_import_is_light():
    heavy = ("numpy", "matplotlib", "rich", "mpmath", "flint", "multiprocessing", "argparse")
    script = f"import sys, gjk; print([name for name in {heavy} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_typed():
    assert (Path(gjk.__file__).parent / "py.typed").exists()


def test_the_docstring_is_true():
    assert doctest.testmod(gjk) == (0, 7)


def test_the_readme_is_true():
    """Every python block of README.md runs, in order, and prints what the block after it says."""
    text = (HERE.parent / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```)?", text, re.DOTALL)
    assert len(blocks) >= 3
    script = "\n".join(code + ("" if said else "") + 'print("----")' for code, said in blocks)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    printed = done.stdout.split("----\n")
    for (_, said), shown in zip(blocks, printed):
        assert shown == said

# SPDX-License-Identifier: MIT
"""Write the C source of the extension module gjk._gjk: build_gjk.py OUTPUT HEADER...

The declarations are read from the headers themselves, between their cdef marks, so that no copy can go stale.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from cffi import FFI

REGION = re.compile(r"/\*\[cdef\]\*/(.*?)/\*\[/cdef\]\*/", re.DOTALL)

# The library knows its ready-made supports by their addresses, and what cffi calls the address of a function is that of
# a wrapper around it: these are the functions themselves.
READY = re.compile(r"^(?:double|float) (gjk\w+)_(support_\w+)\(", re.MULTILINE)

# What a shape made from a Python function has for its support.
CALLBACK = """
extern "Python" {real} {name}_python_support(const void *data, const {real} dir[{dim}], {real} point[{dim}]);
"""


def declarations(header: Path) -> str:
    """The part of a header that cffi is to read."""
    found = REGION.search(header.read_text(encoding="utf-8"))
    if found is None:
        raise SystemExit(f"{header}: no /*[cdef]*/ ... /*[/cdef]*/ region")
    return found.group(1).replace("GJK_API ", "")


def callbacks() -> str:
    """One support for each variant, to be written in Python."""
    variants = [("gjk2", 2, "double"), ("gjk2f", 2, "float"), ("gjk3", 3, "double"), ("gjk3f", 3, "float")]
    return "".join(CALLBACK.format(name=name, dim=dim, real=real) for name, dim, real in variants)


def main(output: str, *headers: str) -> None:
    ffi = FFI()
    includes, names = "", ""
    for header in headers:
        text = declarations(Path(header))
        ffi.cdef(text)
        includes += f'#include "{Path(header).as_posix()}"\n'
        for variant, stem in READY.findall(text):
            ffi.cdef(f"static {variant}_support_fn *const {variant}_ready_{stem};")
            names += f"#define {variant}_ready_{stem} (&{variant}_{stem})\n"
    ffi.cdef(callbacks())
    ffi.set_source("gjk._gjk", includes + names)
    ffi.emit_c_code(output)


if __name__ == "__main__":
    main(*sys.argv[1:])

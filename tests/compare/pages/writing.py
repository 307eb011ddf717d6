# SPDX-License-Identifier: MIT
"""What the pages have in common: numbers, tables, cases to replay."""

import json
import os
import platform
import struct


def short(x):
    """A number to two digits; of what is far below 1 only that it is."""
    if x is None:
        return "∞"
    if x == 0:
        return "0"
    if x < 0.01:
        return "<0.01"
    if x < 9999.5:
        return f"{x:.2g}" if x < 99.5 else f"{x:.0f}"
    mantissa, exponent = f"{x:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def small(x):
    """The same of what may be far below 1."""
    if x is None:
        return "∞"
    mantissa, exponent = f"{x:.1e}".split("e")
    return "0" if x == 0 else short(x) if 0.01 <= x < 9999.5 else f"{mantissa}e{int(exponent)}"


def sentence(text):
    """With a capital."""
    return text[0].upper() + text[1:]


def line(cells):
    return "| " + " | ".join(cells) + " |"


def rule(count, words=1):
    return "|" + "---|" * words + "--:|" * (count - words)


def as_float(x):
    """The shortest decimal that is the same float."""
    single = struct.pack("<f", x)
    for digits in range(1, 10):
        y = float(f"{x:.{digits}g}")
        if abs(y) <= 3.4028234e38 and struct.pack("<f", y) == single:
            return y
    return x


def rounded(numbers):
    """The same as floats, written no longer than that takes."""
    return [rounded(x) if isinstance(x, list) else as_float(x) for x in numbers]


def shape_of(body, dim, single):
    identity = [float(i == j) for i in range(dim) for j in range(dim + 1)]
    shape = {k: v for k, v in body.items() if not (k == "pose" and v == identity)}
    if single:
        for k, v in shape.items():
            shape[k] = rounded(v) if isinstance(v, list) else v if isinstance(v, str) else as_float(v)
    return shape


def case_text(case, single):
    case = dict(case, precision="float" if single else "double")
    for k in "ab":
        case[k] = shape_of(case[k], case["dim"], single)
    return json.dumps(case, separators=(",", ":"))


def machine():
    model = ""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            model = next((x.split(":")[1].strip() + ", " for x in lines if x.startswith("model name")), "")
    except OSError:
        pass
    return f"{model}{platform.machine()}, {os.cpu_count()} cores, {platform.system()}"

# SPDX-License-Identifier: MIT
"""Makes one C header of hex floats from case files, for one dimension and precision. README.md has its layout."""

import argparse
import json
import re
import struct
import sys
from fractions import Fraction

ROUND = ["ball", "ellipsoid", "cylinder", "cone", "disc"]
KINDS = ["origin", "points", "box", "segment", "triangle", *ROUND, "sum", "hull"]
RELATIONS = ["apart", "touching", "overlapping"]

TYPES = """\
enum {x}_kind {{ {kinds} }};
enum {x}_relation {{ {relations} }};

typedef struct {x}_shape {{
    int kind; /* enum {x}_kind */
    size_t count; /* of points */
    const {real} *numbers; /* what the library's struct of that kind holds, in its order; NULL where it holds nothing */
    const {real} *pose; /* m by rows, then p; NULL: identity */
    {real} radius;
    const struct {x}_shape *a, *b; /* of a sum or hull; otherwise NULL */
}} {x}_shape;

typedef struct {x} {{
    const char *id, *group;
    {x}_shape a, b;
    double lower_hi, lower_lo; /* lower_hi + lower_lo <= the distance, lower_lo rounded down */
    double upper_hi, upper_lo; /* the distance <= upper_hi + upper_lo, upper_lo rounded up */
    double separation[4];      /* the signed separation in the same way: lower hi, lo, upper hi, lo */
    double scale;              /* rounded up */
    int relation;              /* enum {x}_relation */
}} {x};
"""


def to_float32(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def next_double(x, up):
    """The neighbour of x, up or down."""
    if x == 0:
        return 5e-324 if up else -5e-324
    (bits,) = struct.unpack("<q", struct.pack("<d", x))
    return struct.unpack("<d", struct.pack("<q", bits + (1 if up == (x > 0) else -1)))[0]


def directed(value, up):
    """A fraction as the nearest double on its one side."""
    x = float(value)
    if Fraction(x) != value and (Fraction(x) < value) == up:
        x = next_double(x, up)
    return x


def double_double(value, up):
    hi = float(value)
    return hi, directed(value - Fraction(hi), up)


def signed(expect):
    """The bracket of the signed separation, as text: apart it is the distance, and 0 where the sets touch."""
    kind = "separation" if expect["relation"] == "overlapping" else "distance"
    return expect[f"{kind}_lower"], expect[f"{kind}_upper"]


class Writer:
    def __init__(self, dim, precision):
        self.dim, self.single = dim, precision == "float"
        self.prefix = f"case{dim}{'f' * self.single}"
        self.real = "float" if self.single else "double"

    def round(self, x):
        return to_float32(x) if self.single else float(x)

    def number(self, x):
        """A literal that holds x exactly, without the zeros Python prints."""
        return re.sub(r"\.?0*p", "p", self.round(x).hex()) + "f" * self.single

    def array(self, numbers):
        return f"(const {self.real}[]){{{', '.join(map(self.number, numbers))}}}"

    def pose(self, shape):
        """m by rows, then p."""
        pose = shape.get("pose")
        if pose is None:
            return "NULL"
        rows = range(0, len(pose), self.dim + 1)
        return self.array([x for i in rows for x in pose[i : i + self.dim]] + [pose[i + self.dim] for i in rows])

    def plain(self, shape):
        """Kind, count of points and numbers, in the library's words."""
        kind = shape["shape"]
        if kind == "sphere":
            return "origin", 0, []
        if kind == "capsule":
            half, zeros = shape["half_length"], [0] * (self.dim - 1)
            return "segment", 0, zeros + [-half] + zeros + [half]
        if kind == "ellipsoid":
            radii = shape["radii"]
            return ("ball", 0, radii[:1]) if len(set(radii)) == 1 else (kind, 0, radii)
        if kind == "ball":
            return kind, 0, [shape["r"]]
        if kind == "box":
            return "box", 0, shape["half"]
        if kind == "points" or kind == "triangle" and self.dim == 2:
            points = shape["points" if kind == "points" else "v"]
            return "points", len(points), [x for p in points for x in p]
        if kind in ("segment", "triangle"):
            return kind, 0, [x for p in shape["v"] for x in p]
        if kind in ("cylinder", "cone", "disc"):
            return kind, 0, [shape["r"]] + ([shape["half_length"]] if kind != "disc" else [])
        return kind, 0, []

    def shape(self, shape):
        kind, count, numbers = self.plain(shape)
        if "r" in shape and shape["shape"] in ("sphere", "capsule") and shape.get("radius"):
            raise ValueError("r and radius in one shape")
        radius = shape["r"] if shape["shape"] in ("sphere", "capsule") else shape.get("radius", 0)
        halves = ["NULL", "NULL"]
        if kind in ("sum", "hull"):
            halves = [f"&(const {self.prefix}_shape){self.shape(shape[k])}" for k in "ab"]
        fields = [
            f"{self.prefix}_{kind}".upper(),
            str(count),
            self.array(numbers) if numbers else "NULL",
            self.pose(shape),
            self.number(radius),
            *halves,
        ]
        return f"{{{', '.join(fields)}}}"

    def case(self, case):
        expect = case["expect"]
        lower = double_double(Fraction(expect["distance_lower"]), False)
        upper = double_double(Fraction(expect["distance_upper"]), True)
        deep, shallow = (double_double(Fraction(x), up) for x, up in zip(signed(expect), (False, True)))
        separation = f"{{{', '.join(x.hex() for x in (*deep, *shallow))}}}"
        scale = directed(Fraction(str(expect["scale"])), True)
        fields = [
            json.dumps(case["id"]),
            json.dumps(case["group"]),
            self.shape(case["a"]),
            self.shape(case["b"]),
            *(x.hex() for x in (*lower, *upper)),
            separation,
            scale.hex(),
            f"{self.prefix}_{expect['relation']}".upper(),
        ]
        return f"    {{{', '.join(fields)}}}"

    def header(self, cases):
        x, guard = self.prefix, f"{self.prefix}_H".upper()
        types = TYPES.format(
            x=x,
            real=self.real,
            kinds=", ".join(f"{x}_{k}".upper() for k in KINDS),
            relations=", ".join(f"{x}_{k}".upper() for k in RELATIONS),
        )
        rows = ",\n".join(map(self.case, cases))
        return (
            f"/* SPDX-License-Identifier: MIT */\n/* Made by cases_to_c.py. */\n#ifndef {guard}\n#define {guard}\n\n"
            f"#include <stddef.h>\n\n{types}\nstatic const {x} {x}_all[] = {{\n{rows}\n}};\n"
            f"static const size_t {x}_count = sizeof {x}_all / sizeof {x}_all[0];\n\n#endif\n"
        )


def read(paths, dim, precision):
    for path in paths:
        with open(path, encoding="utf-8") as lines:
            for line in lines:
                case = json.loads(line)
                if case["dim"] == dim and case.get("precision", "double") == precision:
                    yield case


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--dim", type=int, choices=(2, 3), required=True)
    parser.add_argument("--precision", choices=("double", "float"), required=True)
    parser.add_argument("-o", "--output", required=True, metavar="HEADER")
    parser.add_argument("cases", nargs="+", metavar="CASES.jsonl")
    options = parser.parse_args()
    cases = list(read(options.cases, options.dim, options.precision))
    if not cases:
        sys.exit("no case of that dimension and precision")
    with open(options.output, "w", encoding="utf-8") as out:
        out.write(Writer(options.dim, options.precision).header(cases))


if __name__ == "__main__":
    main()

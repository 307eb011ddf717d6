# SPDX-License-Identifier: MIT
"""What the two makers share: numbers that a float holds exactly, and one way of writing."""

import json
import math

LENGTH_STEP = 2.0**-22  # exact in a float up to 4 units
ROTATION_STEP = 2.0**-24  # exact in a float up to 1


def on_grid(x, step):
    # Adding 0.0 turns -0.0 into 0.0.
    return round(float(x) / step) * step + 0.0


def lengths(values):
    return [on_grid(v, LENGTH_STEP) for v in values]


def pose(rotation, position):
    """Rows of [R | p] on the grids."""
    numbers = []
    for row, p in zip(rotation, position, strict=True):
        numbers += [on_grid(r, ROTATION_STEP) for r in row] + [on_grid(p, LENGTH_STEP)]
    if any(not math.isfinite(v) or abs(v) >= 4 for v in numbers):
        raise ValueError(f"a pose outside the grid: {numbers}")
    return numbers


def write(path, scene):
    """One line for each shape, body and pair, so that a change reads well in a diff."""

    def line(value):
        return json.dumps(value, separators=(",", ":"), allow_nan=False)

    fields = []
    for key, value in scene.items():
        if isinstance(value, list) and key != "queries":
            body = "[\n" + ",\n".join(map(line, value)) + "\n]"
        elif isinstance(value, dict):
            body = "{\n" + ",\n".join(line(k) + ":" + line(v) for k, v in value.items()) + "\n}"
        else:
            body = line(value)
        fields.append(line(key) + ":" + body)
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("{\n" + ",\n".join(fields) + "\n}\n")

# SPDX-License-Identifier: MIT
"""What the plots of all pages have in common: SVG elements whose colours are the page's own."""

from __future__ import annotations

import io
import math
import re
from typing import Any, Callable

from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

__all__ = ["INK", "RULE", "STYLE", "decades", "power", "svg"]

INK, RULE = "#010101", "#020202"
"""matplotlib is given colours such as these; in the SVG each becomes a variable of the page, light or dark."""

STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "svg.hashsalt": "gjk",
    "font.size": 9,
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": RULE,
    "xtick.color": RULE,
    "ytick.color": RULE,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": RULE,
    "grid.linewidth": 0.6,
    "axes.grid": True,
    "axes.axisbelow": True,
}


def power(x: float) -> str:
    if 1 <= x < 1000:
        return f"{x:g}"
    k = round(math.log10(x))
    return "10" + str(k).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def decades(
    axis: Any, low: float, high: float, parts: tuple[int, ...] = (1,), name: Callable[[float], str] = power
) -> None:
    """Decades as ticks, at most eight of them; where there are less than three, their parts too."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    step = max(1, -(-(last - first) // 7))
    ticks = [part * 10.0**k for k in range(first, last + 1, step) for part in (parts if last - first < 3 else (1,))]
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_major_formatter(FuncFormatter(lambda x, _: name(x)))
    axis.set_minor_locator(NullLocator())


def svg(figure: Figure, prefix: str, variables: dict[str, str]) -> str:
    """The figure as an svg element: transparent, in the page's colours, its ids its own."""
    out = io.StringIO()
    figure.savefig(out, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    text = out.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r"\s*\n\s*", " ", re.sub(r"(\.\d\d)\d+", r"\1", text))  # hundredths of a point are enough
    text = re.sub(r'( id="|"#|url\(#)', rf"\g<1>{prefix}-", text)
    for name in ("width", "height"):
        text = re.sub(rf'(<svg[^>]*?) {name}="[^"]*"', r"\1", text, count=1)
    for colour, name in {INK: "ink", RULE: "rule", **variables}.items():
        text = text.replace(colour, f"var(--{name})")
    return text

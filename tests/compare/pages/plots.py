# SPDX-License-Identifier: MIT
"""The plots, as SVG whose colours are the page's own. Each curve is a group of its own, with an id that tells whose."""

import math
import re
from typing import Callable, NamedTuple
from zlib import crc32

import matplotlib as mpl
from gjk.report.drawing import INK, RULE, STYLE, decades, power, svg
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from .writing import sentence

# Okabe and Ito's colours, by family; each library has a marker of its own, and a dash of its own within the family.
FAMILIES = {
    "gjk": ("#0072b2", "#56b4e9"),
    "libccd": ("#b87a00", "#e69f00"),
    "Box2D": ("#d55e00", "#f0803c"),
    "FCL": ("#009e73", "#2cc79b"),
    "Bullet": ("#b0568a", "#cc79a7"),
    "parry": ("#6b6b00", "#f0e442"),
    "Jolt": ("#3d3d3d", "#d0d0d0"),
    "coal": ("#7d4a2f", "#c8977a"),
    "MuJoCo": ("#006d77", "#66c5cc"),
    "": ("#5b4a8a", "#a797d8"),
}
"""In the light and in the dark; the last is anyone else's. The second half, whose colours are nearer to those of the
first, also starts with other dashes."""
MARKERS = "os^DvPX*<>dhp8H"
DASHES = ["-", (0, (5, 1.6)), (0, (1.2, 1.2)), (0, (5, 1.2, 1.2, 1.2))]
WIDTH, HEIGHT = 4.6, 3.2  # inches, so that letters keep their size on a phone
LEFT, RIGHT, LOW, HIGH = 0.12, 0.69, 0.15, 0.87  # of the figure: where the axes are; the names stand to their right
ROW = 0.2  # inches, from row to row
LINE = 0.157  # inches, from name to name beside a plot
PAGE = "#0303ff"
TIME = "ns per query, median"
FARTHEST = 1e3  # of errors, in scales: some say numbers from the end of the format
PROMISED = {"linestyle": (0, (2, 1.5)), "linewidth": 1.0, "alpha": 0.55, "markersize": 2.5}
FLOOR = {"linestyle": (0, (1.2, 1.2)), "linewidth": 1.2, "marker": "_"}


def slug(*words):
    return re.sub(r"[^a-z0-9]+", "-", " ".join(map(str, words)).lower()).strip("-")


def css():
    """The colours of the families as variables of a page."""
    light, dark = (
        " ".join(f"--{_variable(family)}: {colours[i]};" for family, colours in FAMILIES.items()) for i in (0, 1)
    )
    return f":root {{ {light} }}\n@media screen and (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}"


def _variable(family):
    return f"of-{family.lower() or 'others'}"


def _colour(i):
    return f"#03{i:02x}03"


VARIABLES = {PAGE: "page", **{_colour(i): _variable(family) for i, family in enumerate(FAMILIES)}}


def _drawn(figure, name):
    """With a short prefix to its ids, for there are many."""
    return svg(figure, f"f{crc32(name.encode()):x}", VARIABLES)


class Scale(NamedTuple):
    """Of errors. What is below the floor is drawn there: a logarithm has no place for 0."""

    title: str
    floor: float
    least_top: float
    name: Callable[[float], str]


def scale_of(ask):
    if ask.question == "intersect":
        return Scale("answers wrong or failed", 1e-4, 2, lambda y: f"{100 * y:g} %")
    floor = 1e-18 if ask.precision == "double" else 1e-10
    return Scale("largest error, in scales", floor, 1e3 * floor, power)


class Looks:
    """The colour, marker and dash of each library, the same in all plots."""

    def __init__(self, libraries):
        self.markers = {name: MARKERS[i % len(MARKERS)] for i, name in enumerate(libraries)}
        families = [_family(name) for name in libraries]
        firsts = {family: 2 * i // len(FAMILIES) for i, family in enumerate(FAMILIES)}
        self.dashes = {
            name: DASHES[(firsts[families[i]] + families[:i].count(families[i])) % len(DASHES)]
            for i, name in enumerate(libraries)
        }

    def of(self, library):
        colour = _colour(list(FAMILIES).index(_family(library)))
        return {"color": colour, "marker": self.markers[library], "linestyle": self.dashes[library]}


def _family(library):
    return next(family for family in FAMILIES if library.startswith(family))


class Plot:
    """Axes with names beside them, each led to the last point of its curve."""

    def __init__(self, figure, title, x_title, panel=0, panels=1):
        self.axes = figure.add_axes(((panel + LEFT) / panels, LOW, (RIGHT - LEFT) / panels, HIGH - LOW))
        self.axes.set_title(title, fontsize=9, loc="left", x=-LEFT / (RIGHT - LEFT) * 0.92, pad=9, color=INK)
        self.axes.set_xlabel(x_title)
        self.axes.set_xscale("log")
        self.axes.set_yscale("log")
        self.x, self.y, self.names = [], [], []

    def curve(self, key, points, look, name, **more):
        """With an id made of the key; without a name nothing stands beside it."""
        if points:
            x, y = zip(*points)
            self.axes.plot(x, y, gid=f"curve-{slug(key)}", clip_on=False, **{**look, **more})
            self.x += x
            self.y += y
            if name:
                self.names.append((name, x[-1], y[-1], look))

    def write_names(self):
        """One below the other in the order of their curves' ends, as near to them as there is room."""
        axes = self.axes
        to_axes = axes.transData + axes.transAxes.inverted()
        ends = sorted(((*to_axes.transform((x, y)), name, look) for name, x, y, look in self.names), key=lambda e: e[1])
        line = LINE / (axes.figure.get_figheight() * (HIGH - LOW))
        heights = _spread([end[1] for end in ends], line)
        for (x, y, name, look), height in zip(ends, heights):
            axes.plot([x, 1.03], [y, height], transform=axes.transAxes, color=look["color"], linewidth=0.5, alpha=0.6,
                      clip_on=False)  # fmt: skip
            sign = {k: look[k] for k in ("color", "marker")}
            axes.plot([1.055], [height], transform=axes.transAxes, markersize=4.5, clip_on=False, **sign)
            axes.text(1.085, height, name, transform=axes.transAxes, va="center_baseline", fontsize=8)


def _spread(wanted, line):
    """Heights no closer than a line, in the same order, each as near as may be to the one wanted, within the axes."""
    heights = []
    for i, y in enumerate(wanted):
        heights.append(max(y, heights[-1] + line if i else 0))
    top = 1.0
    for i in reversed(range(len(heights))):
        heights[i] = min(heights[i], top)
        top = heights[i] - line
    return heights


def _size(names, panels=1):
    """Of a figure with room for so many names beside each plot."""
    return WIDTH * panels, max(HEIGHT, LINE * (names - 1) / (HIGH - LOW))


def _names(place):
    """How many stand beside its plot, at most."""
    return len({(a.library, a.warm) for a in place.answers if is_drawn(a)}) + 1


def _time_axis(axis, times):
    low, high = min(times) / 1.25, max(times) * 1.25
    axis.axes.set(**{f"{axis.axis_name}lim": (low, high)})
    parts = (1, 2, 5) if high / low < 30 else (1, 3) if high / low < 300 else (1,)
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)))
    ticks = [part * 10.0**k for k in exponents for part in parts if low <= part * 10.0**k <= high]
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.0f}" if x < 1e5 else power(x)))
    axis.set_minor_locator(NullLocator())


def curves_of(place):
    """The answers of a place by curve: a library along one of its knobs, cold or warm; the coarsest first."""
    curves = {}
    for a in place.answers:
        curves.setdefault((a.library, a.knob, a.warm), []).append(a)
    return {key: sorted(answers, key=_fineness) for key, answers in curves.items()}


def _fineness(a):
    return -float(a.setting) if a.knob == "tolerance" else float(a.setting or 0)


def is_drawn(a):
    """Where no answer has a number there is no error to draw."""
    return a.is_timed and error_of(a) is not None


def error_of(a):
    return a.bad / a.asked if a.question == "intersect" else a.max_error


def error_plot(place, looks, prefix):
    """True error against run time: a curve for each library through its settings, and what ours promised."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=_size(_names(place)))
        _draw_errors(Plot(figure, scale_of(place.ask).title, TIME), place, looks)
        return _drawn(figure, prefix)


def readme_plot(places, looks):
    """The same of some places, side by side."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=_size(max(map(_names, places)), len(places)))
        for i, place in enumerate(places):
            title = f"{sentence(place.ask.question)}: {place.title}, {place.ask.precision}\n{scale_of(place.ask).title}"
            _draw_errors(Plot(figure, title, TIME, i, len(places)), place, looks)
        return _drawn(figure, "readme")


def _draw_errors(plot, place, looks):
    scale = scale_of(place.ask)
    floor = scale.floor
    named = set()

    def name_once(name):
        new = name not in named
        named.add(name)
        return name if new else None

    for (library, knob, warm), answers in curves_of(place).items():
        drawn, look = [a for a in answers if is_drawn(a)], looks.of(library)
        if library == place.ask.variant:
            look["linestyle"] = "-"
        promised = [a for a in drawn if a.max_error is not None and a.promised is not None]
        name = f"{library}, warm" if warm else library
        width = 1.0 if knob == "steps" or warm else 1.6
        face = PAGE if warm else look["color"]
        plot.curve(f"{name} {knob}", [(a.median, _height(error_of(a), floor)) for a in drawn], look,
                   drawn and name_once(name), linewidth=width, markersize=3.6, markerfacecolor=face)  # fmt: skip
        plot.curve(f"{name} {knob} promised", [(a.median, _height(a.promised, floor)) for a in promised],
                   {**look, **PROMISED}, len(promised) > 1 and name_once("promised"))  # fmt: skip
        _mark(plot.axes, drawn, floor, look)
    _error_axes(plot, scale)


def _height(error, floor):
    """Where an error is drawn: what is below or beyond the axis, at its end."""
    return min(max(error, floor), FARTHEST)


def _mark(axes, answers, floor, look):
    """Larger what comes unasked; crossed out where some answers are wrong or failed."""
    own = {"color": look["color"], "marker": look["marker"], "markersize": 7, "alpha": 0.55}
    cross = {"color": INK, "marker": "x", "markersize": 4, "markeredgewidth": 0.8}
    for marked, mark in (([a for a in answers if a.default], own), ([a for a in answers if a.bad], cross)):
        if marked:
            at = [a.median for a in marked], [_height(error_of(a), floor) for a in marked]
            axes.plot(*at, linestyle="none", clip_on=False, **mark)


def _error_axes(plot, scale):
    """Logarithms, with a strip for 0; without a curve, bare."""
    axes, floor = plot.axes, scale.floor
    top = max([scale.least_top, *(3 * y for y in plot.y)])
    axes.set_ylim(floor / 2, top)
    decades(axes.yaxis, floor, top, name=lambda y: "0" if y <= floor else scale.name(y))
    axes.axhspan(floor / 2, floor * 2, color=RULE, alpha=0.35, linewidth=0)
    _time_axis(axes.xaxis, plot.x or [1e2, 1e4])
    plot.write_names()


def growth_plot(rows, what, x_title, title, looks, prefix):
    """How `what` grows, by library; beside the time of ours that of its support calls alone."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=_size(2 * len({row["library"] for row in rows})))
        plot = Plot(figure, title, x_title)
        for library in dict.fromkeys(row["library"] for row in rows):
            own = sorted((row for row in rows if row["library"] == library), key=lambda row: row["at"])
            look = looks.of(library)
            points = [(row["at"], row[what]) for row in own if (row[what] or 0) > 0]
            plot.curve(library, points, look, library, linewidth=1.6, markersize=3.6)
            if what == "median":
                floor = [(row["at"], row["floor"]) for row in own if (row["floor"] or 0) > 0]
                plot.curve(f"{library} floor", floor, {**look, **FLOOR}, f"{library}: calls")
        axes = plot.axes
        low, high = min(plot.x) / 1.2, max(plot.x) * 1.2
        axes.set_xlim(low, high)
        decades(axes.xaxis, low, high)
        if what == "median":
            _time_axis(axes.yaxis, plot.y)
        else:
            axes.set_yscale("linear")
            axes.set_ylim(0, 1.15 * max(plot.y))
        plot.write_names()
        return _drawn(figure, prefix)


def warm_plot(places, looks, prefix):
    """Of each class, and in it of each library, how long a query takes cold and warm."""
    rows = []
    for place in places:
        both = [(a.library, place.default(a.library), a) for a in place.defaults(warm=True)]
        both = [(name, cold, warm) for name, cold, warm in both if cold and cold.is_timed and warm.is_timed]
        rows += [(place.name, None, None), *both] if both else []
    high = ROW * len(rows)
    height = high + 0.55
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, height))
        axes = figure.add_axes((0.31, 0.45 / height, 0.64, high / height))
        axes.set_xscale("log")
        for i, (name, cold, warm) in enumerate(rows):
            if cold:
                look = {k: v for k, v in looks.of(name).items() if k != "linestyle"} | {"markersize": 5}
                key = f"curve-{slug(rows[_heading(rows, i)][0], name)}"
                axes.plot([warm.median, cold.median], [i, i], gid=key, linewidth=1.2, markevery=[1], **look)
                axes.plot([warm.median], [i], markerfacecolor=PAGE, **look)
        axes.set_yticks(range(len(rows)), [name for name, _, _ in rows])
        for (_, cold, _), label in zip(rows, axes.get_yticklabels()):
            label.set_fontweight("normal" if cold else "bold")
        axes.tick_params(axis="y", length=0, labelsize=8)
        axes.set_ylim(len(rows) - 0.4, -0.6)
        axes.grid(axis="y", visible=False)
        axes.set_xlabel("ns per query, median: cold, and warm (hollow)")
        _time_axis(axes.xaxis, [a.median for _, *both in rows for a in both if a])
        return _drawn(figure, prefix)


def _heading(rows, i):
    """The row that names the class of row i."""
    return max(k for k in range(i) if rows[k][1] is None)

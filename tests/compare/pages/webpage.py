# SPDX-License-Identifier: MIT
"""The page with all plots, and the one plot of the README. It needs nothing beside it: no script, no network."""

import re
from html import escape
from string import Template

from gjk.report.page import COLOURS, CSS, document

from . import plots, tables, words
from .measured import Ask, where
from .writing import case_text, sentence

PAGE = Template(
    """\
<header>
<h1>Error against run time</h1>
<p>$lead</p>
<ul>
$glance
</ul>
<p class="soft">$head</p>
<pre>$command</pre>
</header>
<div class="cards">
$cards
</div>
<nav><ul>
$contents
</ul></nav>
$sections
<footer><p>gjk $version, MIT licence.</p></footer>
"""
)

STYLE = """
pre { overflow-x: auto; background: var(--card); border-radius: .75rem; padding: .6rem .9rem; font-size: .85rem; }
pre.case { white-space: pre-wrap; overflow-wrap: anywhere; }
nav ul { columns: 14rem; padding: 0; list-style: none; }
a { color: var(--true); }
.cards { grid-template-columns: repeat(auto-fit, minmax(12rem, 1fr)); }
h2 { break-after: avoid; }
h3 { font-size: 1.1rem; margin: 2rem 0 .5rem; break-after: avoid; }
h4 { font-size: .95rem; font-weight: 600; margin: 0 0 .25rem; }
li { margin: .25rem 0; max-width: 44rem; }
nav li { margin: 0 0 .5rem; }
.plots { grid-template-columns: repeat(auto-fill, minmax(min(100%, 20rem), 1fr)); }
figure { break-inside: avoid; }
details { margin: .25rem 0 .5rem; font-size: .85rem; }
summary { color: var(--soft); cursor: pointer; }
td.word, th.word { text-align: left; }
table.prose td { white-space: normal; vertical-align: top; min-width: 6rem; }
@media print {
  body { max-width: none; padding: 0; font-size: 9pt; }
  details, nav { display: none; }
  .plots { grid-template-columns: 1fr 1fr; gap: .75rem; }
  .table { overflow: visible; }
  table { font-size: 6.5pt; }
  th, td { padding: .1rem .25rem; white-space: normal; }
  td { overflow-wrap: anywhere; }
  thead { display: table-header-group; }
  tr { break-inside: avoid; }
  th:first-child, td:first-child { position: static; }
  pre { white-space: pre-wrap; }
}
"""

KEY = """\
Each point is all pairs of a class, answered at one setting: to the right it takes longer, lower down it is more exact;
what errs by less than can be seen is in the grey strip at 0. A curve leads through the settings of one library, thinner
where the number of steps is varied; large marks are the defaults, a small one of ours by itself is `tight`. A cross:
some of these answers are wrong or failed. Hollow: warm. Dashed and light: the error that ours promised, its widest
bracket, which is never below the true one."""
GROWTH = """\
The dotted curve is the floor: what the support calls take by themselves. A curve ends where it takes longer than a
quarter of a second to make the bodies and to answer."""
WARM = "Along a path of small steps: from cold to warm, the nearer to the left the better."


def page(measured, command):
    looks = plots.Looks(measured.libraries)
    parts = list(_sections(measured, looks))
    sections = "\n".join(
        f'<section id="{plots.slug(t)}">\n<h2>{escape(t)}</h2>\n{body}\n</section>' for t, body in parts
    )
    body = PAGE.substitute(
        lead=escape(words.LEAD),
        glance="\n".join(f"<li><b>{escape(q)}</b> {escape(text)}</li>" for q, text in tables.glance(measured)),
        head=escape(words.head(measured)),
        command=escape(command),
        cards="\n".join(_cards(measured)),
        contents="\n".join(f'<li><a href="#{plots.slug(t)}">{escape(t)}</a></li>' for t, _ in parts),
        sections=sections,
        version=escape(measured.head["version"]),
    )
    return document("gjk and other libraries: error against run time", CSS + plots.css() + STYLE, body)


def _sections(measured, looks):
    yield "Marks", prose(words.MARKS) + table(tables.marks(measured), "prose")
    yield "Where ours is not first", _not_first(measured)
    yield "How to read it", prose(KEY, words.HOW_TO_READ, words.FAIR)
    yield "Libraries", table(tables.peers(measured), "prose") + prose(words.COUNTS) + table(tables.counts(measured))
    for ask in measured.asks():
        yield sentence(ask.title), _asked(measured.of(ask), looks)
    if any(p.is_warm() for p in measured.places):
        yield "Warm and cold", prose(WARM) + _grid(_warm_figures(measured, looks))
    if measured.growth:
        yield "How cost grows", prose(GROWTH) + _grid(_growth_figures(measured, looks))
    yield "Cases to replay", prose(words.REPLAY) + "\n".join(_replays(measured))


def prose(*texts):
    """Paragraphs; of Markdown, emphasis and code are kept."""
    marked = escape("\n\n".join(texts), quote=False)
    marked = re.sub(r"`([^`]*)`", r"<code>\1</code>", re.sub(r"\*([^*]+)\*", r"<em>\1</em>", marked))
    return "".join(f"<p>{text}</p>\n" for text in marked.split("\n\n"))


def table(t, kind=""):
    def cells(tag, row):
        return "".join(
            f"<{tag}{' class=word' if i < t.words else ''}>{escape(cell)}</{tag}>" for i, cell in enumerate(row)
        )

    head = f"<thead><tr>{cells('th', t.columns)}</tr></thead>"
    body = "\n".join(f"<tr>{cells('td', row)}</tr>" for row in t.rows)
    return f'<div class="table"><table class="{kind}">{head}<tbody>\n{body}\n</tbody></table></div>\n'


def _card(number, text):
    return f'<div class="card"><b>{escape(number)}</b><span>{escape(text)}</span></div>'


def _cards(measured):
    ours = [a for p in measured.places for a in p.answers if a.is_ours]
    wrong, asked = sum(a.wrong for a in ours), sum(a.asked for a in ours)
    yield _card(f"{wrong}", f"of {asked:,} answers of ours are wrong, at any setting")
    for mark in tables.marks(measured).rows:
        yield _card(mark[1], f"classes: {mark[0]}")


def _not_first(measured):
    parts = [prose(words.NOT_FIRST)]
    parts += [prose(text) + table(t, "prose") for text, t in tables.lost(measured)]
    for title, lines in tables.not_first(measured):
        parts.append(f"<h3>{escape(sentence(title))}</h3>\n<ul>")
        parts += [f"<li>{escape(text)}</li>" for text in lines]
        parts.append("</ul>")
    return "\n".join(parts)


def _asked(places, looks):
    boolean = places[0].ask.question == "intersect"
    parts = [prose(words.TIMES), table(tables.times(places))]
    warm = tables.times(places, warm=True)
    if warm.rows:
        parts += [prose(words.WARM), table(warm)]
    parts += [prose(words.VERDICTS if boolean else words.ERRORS), table(tables.errors(places))]
    for name in dict.fromkeys(p.name for p in places):
        parts.append(f"<h3>{escape(sentence(name))}</h3>")
        parts.append(_grid(_place_figure(p, looks) for p in places if p.name == name))
    return "\n".join(parts)


def place_id(place):
    return plots.slug(place.ask.title, place.name, place.state)


def _place_figure(place, looks):
    drawn = plots.error_plot(place, looks, place_id(place))
    numbers = (
        f"<details><summary>The numbers</summary>{prose(tables.about(place))}{table(tables.settings(place))}</details>"
    )
    return _figure(
        place_id(place), place.title, drawn, f"Error against run time: {place.ask.title}, {place.title}", numbers
    )


def _warm_figures(measured, looks):
    grouped = {}
    for place in measured.places:
        if place.is_warm():
            grouped.setdefault((place.ask, place.state), []).append(place)
    for (ask, state), places in grouped.items():
        title, name = f"{ask.title}, {state}", plots.slug("warm", ask.title, state)
        yield _figure(name, title, plots.warm_plot(places, looks, name), f"Time cold and warm: {title}")


AXES = {"vertices": "vertices of each body", "pairs": "pairs", "accuracy": "accuracy asked for, in scales"}
WHAT = {"median": "ns per query, median", "supports": "support calls per query"}


def _growth_figures(measured, looks):
    grown = {}
    for row in measured.growth:
        grown.setdefault((row["by"], *where(row)), []).append(row)
    for (by, ask, name, state), rows in grown.items():
        for what, title in WHAT.items():
            if any((row[what] or 0) > 0 for row in rows):
                own = plots.slug("growth", by, ask.title, name, state, what)
                heading = f"{ask.title}: {name}, {state}, by {by}"
                drawn = plots.growth_plot(rows, what, AXES[by], title, looks, own)
                yield _figure(own, heading, drawn, f"{heading}: {title}")


def _figure(name, title, drawn, text, more=""):
    drawn = drawn.replace("<svg", f'<svg role="img" aria-label="{escape(text)}"', 1)
    return f'<figure id="{name}"><h4>{escape(sentence(title))}</h4>{drawn}{more}</figure>'


def _grid(figures):
    return '<div class="plots">\n' + "\n".join(figures) + "\n</div>"


def _replays(measured):
    for library, picked in tables.examples(measured):
        yield f"<h3>{escape(library)}</h3>"
        for place, a in picked:
            yield prose(tables.said(place, a))
            yield f'<pre class="case">{escape(case_text(a.example, place.ask.precision == "float"), quote=False)}</pre>'


README = [
    (Ask("distance", 2, "float"), "polygons", "separated"),
    (Ask("penetration", 3, "double"), "hulls of 16", "deep"),
]


def plot(measured):
    """An SVG that stands alone, in light and dark."""
    by_place = {(p.ask, p.name, p.state): p for p in measured.places}
    places = [by_place[key] for key in README if key in by_place] or measured.places[:1]
    drawn = plots.readme_plot(places, plots.Looks(measured.libraries))
    width, height = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', drawn).groups()
    style = f"<style>{COLOURS}{plots.css()} text {{ font-family: system-ui, sans-serif !important; }}</style>"
    head = f'<svg width="{width}" height="{height}" style="background: var(--page)"'
    return re.sub(r"<svg([^>]*)>", rf"{head}\1>{style}", drawn, count=1)

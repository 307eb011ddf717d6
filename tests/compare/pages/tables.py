# SPDX-License-Identifier: MIT
"""What the comparison says in numbers and in words; all of it is computed."""

from __future__ import annotations

from typing import NamedTuple

from . import words
from .measured import Ask, Place, mean_ratio
from .writing import sentence, small

NONE = "–"
UNIT = {"double": 2.0**-53, "float": 2.0**-24}  # of roundoff


class Table(NamedTuple):
    columns: list[str]
    rows: list[list[str]]
    words: int = 1
    """How many columns hold words, not numbers."""


def peers(measured):
    """Everyone with version and settings."""
    rows = []
    for p in measured.peers.values():
        how = "; ".join(dict.fromkeys(p[k] for k in ("how", "how_meet", "how_deep") if p.get(k)))
        rows.append([p["name"], p["version"], f"{p['dim']}-D, {'float' if p['single'] else 'double'}", how])
    rows += [[name, "missing: neither installed nor brought", "", ""] for name in measured.missing]
    return Table(["library", "version", "numbers", "asked by, at the settings that it comes with"], rows, 4)


def ns(x):
    return NONE if x is None else f"{x:.0f}"


def ratio(x):
    return NONE if x is None else f"{x:.2f}"


def size(x):
    return NONE if x is None else small(x)


def _libraries(places, warm=False):
    """Who took part at its default, in order, save ours that the others are held against."""
    return list(dict.fromkeys(a.library for p in places for a in p.defaults(warm) if a is not p.ours(warm)))


def _theirs(places, warm):
    return list(dict.fromkeys(a.library for p in places for a in p.theirs(warm)))


def times(places, warm=False):
    """Of each class what ours takes, and what everyone takes divided by that: by time, by instructions."""
    places = [p for p in places if p.ours(warm)]
    others = _libraries(places, warm)
    rows = []
    for p in places:
        ours, cells = p.ours(warm), []
        for name in others:
            a = p.default(name, warm)
            cell = ratio(a.ratio(ours)) if a else NONE
            cells.append(f"{cell}, {ratio(a.instruction_ratio(ours))}" if a and a.instruction_ratio(ours) else cell)
        rows.append([p.title, ns(ours.median), ns(ours.instructions), *cells])
    return Table(["", "ours: ns", "instructions", *(f"{name} ÷ ours" for name in others)], rows)


def _error(a):
    if a is None:
        return NONE
    sizes = ", ".join(small(x) for x in (a.max_error, a.excess) if x is not None)
    if a.question != "intersect" and not sizes:
        sizes = NONE
    bad = ", ".join(f"{count} {word}" for count, word in ((a.wrong, "wrong"), (a.failed, "failed")) if count)
    return ": ".join(text for text in (sizes, bad) if text) or "0"


def errors(places):
    """Of each class the largest error of everyone, and how many answers are wrong or failed."""
    others = _libraries(places)
    rows = [[p.title, _error(p.ours()), *(_error(p.default(name)) for name in others)] for p in places]
    return Table(["", "ours", *others], rows)


def settings(place):
    """Everyone at every setting."""
    columns = ["library", "setting", "ns: least", "median", "÷ ours", "instructions", "÷ ours", "support calls"]
    columns += ["error: largest", "median", "excess", "promised", "wrong", "failed"]
    rows = []
    for a in sorted(place.answers, key=lambda a: not a.is_ours):
        ours = place.ours(a.warm)
        setting = "" if a.knob == "none" else a.knob if a.knob == "tight" else f"{a.knob} {a.setting}"
        rows.append([a.name, setting + (" (default)" if a.default and setting else "")])
        rows[-1] += [ns(a.least), ns(a.median), ratio(a.ratio(ours))]
        rows[-1] += [ns(a.instructions), ratio(a.instruction_ratio(ours))]
        rows[-1] += [NONE if a.supports is None else f"{a.supports:.1f}"]
        rows[-1] += [size(x) for x in (a.max_error, a.median_error, a.excess, a.promised)]
        rows[-1] += [str(a.wrong), str(a.failed)]
    return Table(columns, rows, 2)


def about(place):
    text = f"{place.pairs} pairs"
    if place.truth_width > 1e-20:
        text += f"; the truth is known to {small(place.truth_width)} scales"
    if place.timed != place.pairs:
        text += f"; {place.pairs - place.timed} on which one crashes or hangs are left out of the times of all"
    return text + "."


# ---- where ours is not first ----


class Rival(NamedTuple):
    """Someone beside ours, in one class."""

    place: Place
    ours: object
    theirs: object

    @property
    def ratio(self):
        return self.theirs.ratio(self.ours)

    @property
    def is_faster(self):
        return self.ratio is not None and self.ratio < 1

    @property
    def is_as_good(self):
        """As right, and as exact but for roundings."""
        return not self.theirs.bad and not _less_exact(self)


def _rivals(places, library, warm):
    both = [Rival(p, p.ours(warm), p.default(library, warm)) for p in places]
    return [r for r in both if r.ours and r.theirs]


def _against_all(place, warm=False):
    return [r for a in place.theirs(warm) for r in _rivals([place], a.library, warm)]


def _of_our_best(r):
    """The same, ours being whichever errs least."""
    return r._replace(ours=r.place.most_exact_of_ours(r.ours.warm))


def _more_exact(measured):
    """Of each class that has errors, who errs less than ours."""
    held = [[r for r in _against_all(p) if _has_errors(r)] for p in measured.places]
    return [[r for r in rivals if _is_exacter(r)] for rivals in held if rivals]


def glance(measured):
    """The whole in three answers: what is lost first."""
    held = [rivals for rivals in map(_against_all, measured.places) if any(r.ratio for r in rivals)]
    faster = [rivals for rivals in held if any(r.is_faster for r in rivals)]
    as_good = [rivals for rivals in faster if any(r.is_faster and r.is_as_good for r in rivals)]
    yield "Fast?", (
        f"In {len(faster)} of {len(held)} classes someone is faster, in {len(as_good)} of these someone who is as right"
        f" and exact. In {len(held) - len(faster)} ours is the fastest."
    )
    exact = _more_exact(measured)
    alone, beaten = (sum(map(bool, found)) for found in (exact, map(_still, exact)))
    text = (
        f"In {beaten} of {len(exact)} classes someone who answers all right has a smaller largest error than ours; in"
        f" {len(exact) - beaten} no one has."
    )
    doubled = _sisters(measured)
    if doubled:
        text += (
            " Of pairs in float the more exact of ours counts, in float or in double: one library has both, and on"
            f" these pairs double takes {ratio(mean_ratio(doubled))} of the time that float takes. With float alone"
            f" someone is more exact in {alone}."
        )
    yield "Exact?", text
    ours, theirs = ([row for row in _counts(measured) if row[0].startswith("gjk") == own] for own in (True, False))
    wrong = sum(a.wrong for p in measured.places for a in p.answers if a.is_ours)
    text = f"Of our answers {_bad(ours)} are wrong or failed; at all settings together {wrong} are wrong."
    if theirs:
        worst = max(theirs, key=lambda row: (row[2] + row[3]) / row[1])
        text += f" Of the others' {_bad(theirs)}, the most of {worst[0]}: {_bad([worst])}."
    yield "Right?", text


def _sisters(measured):
    """Of pairs in float, what ours takes in double divided by what it takes in float."""
    asks = [Ask(question, dim, "float") for question in MEASURING for dim in (2, 3)]
    for_float = [p for p in measured.places if p.ask in asks and p.ours()]
    sisters = [(p.default(p.ours().library.rstrip("f")), p.ours()) for p in for_float]
    return [a.ratio(ours) for a, ours in sisters if a and a is not ours and a.ratio(ours)]


def _bad(rows):
    asked, wrong, failed = (sum(row[k] for row in rows) for k in (1, 2, 3))
    return f"{wrong + failed} of {asked}"


QUESTIONS = ("distance", "intersect", "penetration")
MEASURING = ("distance", "penetration")


def _kinds(measured):
    """Dimension and precision, with the places of each question."""
    kinds = dict.fromkeys((ask.dim, ask.precision) for ask in measured.asks())
    for dim, precision in kinds:
        own = [p for p in measured.places if (p.ask.dim, p.ask.precision) == (dim, precision)]
        yield f"{dim}-D, {precision}", [[p for p in own if p.ask.question == question] for question in QUESTIONS]


def lost(measured):
    """All that tells where ours is not first, each with its words."""
    yield words.BY_CLASS, by_class(measured)
    errors = by_error(measured)
    if errors.rows:
        yield words.BY_ERROR, errors
    yield words.BY_LIBRARY, by_library(measured)


def by_class(measured):
    """By class: in how many states someone as right and exact is faster, and who most."""
    rows = []
    for kind, of_question in _kinds(measured):
        for name in dict.fromkeys(p.name for places in of_question for p in places):
            cells = [_lost([p for p in places if p.name == name]) for places in of_question]
            rows.append([kind, name, *cells])
    return Table(["pairs", "class", *QUESTIONS], rows, 5)


def _lost(places):
    held = [[r for r in _against_all(p) if r.ratio and r.is_as_good] for p in places]
    faster = [min(rivals, key=lambda r: r.ratio) for rivals in held if any(r.is_faster for r in rivals)]
    if not faster:
        return f"0 of {len(places)}" if places else NONE
    most = min(faster, key=lambda r: r.ratio)
    return f"{len(faster)} of {len(places)}: {ratio(most.ratio)}, {most.theirs.library}"


def by_error(measured):
    """By class, where someone is: in how many states someone is more exact, and by how much where that is most."""
    rows = []
    for kind, of_question in _kinds(measured):
        for name in dict.fromkeys(p.name for places in of_question for p in places):
            own = [[p for p in places if p.name == name] for places in of_question]
            cells = [_outdone(own[QUESTIONS.index(question)]) for question in MEASURING]
            if any(cell != NONE for cell in cells):
                rows.append([kind, name, *cells])
    return Table(["pairs", "class", *MEASURING], rows, 4)


def _outdone(places):
    lost = [r for p in places for r in _against_all(p) if _is_exacter(r)]
    if not lost:
        return NONE
    most = max(lost, key=_lead)
    return f"{_states(lost)} of {len(places)}: {_errors_of(most)}, {most.theirs.library}"


def _states(more_exact):
    """How many they are; of pairs in float, in brackets, where someone is more exact than ours in double, too."""
    every, left = ({(r.place.name, r.place.state) for r in found} for found in (more_exact, _still(more_exact)))
    return f"{len(every)} ({len(left)})" if more_exact[0].place.ask.precision == "float" else f"{len(every)}"


def _still(more_exact):
    return [r for r in map(_of_our_best, more_exact) if _is_exacter(r)]


def by_library(measured):
    """By library: what it takes, in how many classes it is faster, in how many of these as right and exact."""
    rows = []
    for kind, of_question in _kinds(measured):
        for warm in (False, True):
            for name in _theirs([p for places in of_question for p in places], warm):
                cells = [_rival(_rivals(places, name, warm)) for places in of_question]
                rows.append([kind, f"{name}, warm" if warm else name, *cells])
    return Table(["pairs", "library", *QUESTIONS], rows, 5)


def _rival(held):
    timed = [r for r in held if r.ratio]
    if not timed:
        return NONE
    faster = [r for r in timed if r.is_faster]
    text = f"{ratio(mean_ratio([r.ratio for r in timed]))}: {len(faster)} of {len(timed)}"
    if faster:
        text += f", {sum(r.is_as_good for r in faster)} as good"
    more_exact = list(filter(_is_exacter, held))
    return f"{text}; {_states(more_exact)} more exact" if more_exact else text


def not_first(measured):
    """Of each question the libraries that are faster or more exact than ours somewhere, and where."""
    for ask in measured.asks():
        places = measured.of(ask)
        lines = [text for warm in (False, True) for name in _theirs(places, warm)
                 for text in _rival_texts(name, _rivals(places, name, warm), warm)]  # fmt: skip
        alone = (
            "Ours is the fastest and the most exact in every class."
            if _theirs(places, False)
            else "No one else answers."
        )
        yield ask.title, lines or [alone]


def _rival_texts(library, rivals, warm):
    name = f"{library}, warm," if warm else library
    faster = [r for r in rivals if r.is_faster]
    if faster:
        text = f"{name} is faster in {len(faster)} of {len(rivals)} classes ({_span(_ratios(faster))} of our time)"
        sound = [r for r in faster if r.is_as_good]
        if len(sound) < len(faster):
            text += f"; in {len(faster) - len(sound)} of these with larger errors, or wrong or failed answers"
        if sound:
            text += f"; as right and exact as ours and faster in {_places(sound, lambda own: _span(_ratios(own)))}"
        yield text + "."
    exacter = [r for r in rivals if _is_exacter(r)]
    if exacter:
        yield (
            f"{name} is more exact in {len(exacter)} of {len(rivals)} classes (largest error, theirs to ours; the"
            f" worst for us): {_places(exacter, _errors_where_most)}."
        )
    righter = [r for r in rivals if r.theirs.bad < r.ours.bad]
    if righter:
        yield f"{name} has fewer wrong or failed answers in {_places(righter, lambda own: f'{own[0].theirs.bad}')}."


def _ratios(rivals):
    return [r.ratio for r in rivals]


def _span(ratios):
    low, high = f"{min(ratios):.2f}", f"{max(ratios):.2f}"
    return low if low == high else f"{low} to {high}"


def _errors_where_most(rivals):
    return _errors_of(max(rivals, key=_lead))


def _lead(r):
    return r.ours.max_error - r.theirs.max_error


def _errors_of(r):
    return f"{size(r.theirs.max_error)} to {size(r.ours.max_error)}"


def _places(rivals, what):
    """By class; how many states where there are several."""
    by_name = {}
    for r in rivals:
        by_name.setdefault(r.place.name, []).append(r)
    parts = []
    for name, own in by_name.items():
        state = own[0].place.state if len(own) == 1 else f"{len(own)} states"
        parts.append(f"{name}, {state} ({what(own)})")
    return "; ".join(parts)


def _has_errors(r):
    return r.theirs.max_error is not None and r.ours.max_error is not None


def _less_exact(r):
    return _has_errors(r) and r.theirs.max_error > max(r.ours.max_error, 4 * UNIT[r.place.ask.precision])


def _is_exacter(r):
    return _has_errors(r) and not r.theirs.bad and r.theirs.max_error < r.ours.max_error


# ---- marks ----


class Mark(NamedTuple):
    """How many times what ours takes these are to take, everywhere."""

    text: str
    factor: float
    rivals: object
    """Of a place: the answers that ours are held against."""
    warm: bool = False


def _of(family, keep=lambda place: True, warm=False):
    return lambda place: [a for a in place.theirs(warm) if a.library.startswith(family)] if keep(place) else []


def _fastest_sound(place):
    """Of those in double that answer everything, and err by no more than roundings."""
    if (place.ask.dim, place.ask.precision) != (3, "double") or place.name not in SHARP:
        return []
    sound = [a for a in place.theirs() if not a.bad and (a.max_error is None or a.max_error < 1e-14)]
    return sorted((a for a in sound if a.is_timed), key=lambda a: a.median)[:1]


SHARP = ("boxes", "hulls of 8", "hulls of 16", "hulls of 64")


def _float_polygons(place):
    return place.ask == ("distance", 2, "float") and place.name == "polygons"


MARKS = [
    Mark("3 times as fast as libccd, in every query that it has", 3, _of("libccd")),
    Mark("level with Box2D 3 on polygons in float", 1, _of("Box2D 3", _float_polygons)),
    Mark("1.3 times as fast as Box2D 3 on these when both are warm", 1.3, _of("Box2D 3", _float_polygons, True), True),
    Mark("level with the fastest sound library in double on boxes and hulls of 8 to 64", 1, _fastest_sound),
]


def marks(measured):
    """What the library is to reach, and what it does."""
    rows = [_mark_row(mark, measured) for mark in MARKS]
    return Table(
        ["ours is to be", "reached in", "beyond reach in", "mean", "least"], [*rows, *_error_rows(measured)], 5
    )


def _mark_row(mark, measured):
    held = [(p, a, a.ratio(p.ours(mark.warm))) for p in measured.places for a in mark.rivals(p)]
    found = [(r, f"{a.library}: {_spelled(p)}") for p, a, r in held if r]
    if not found:
        return [mark.text, "not measured", NONE, NONE, NONE]
    met = sum(r >= mark.factor for r, _ in found)
    beyond = sum(a.median < mark.factor * (p.supports_alone or 0) for p, a, r in held if r)
    least, where = min(found)
    mean = ratio(mean_ratio([r for r, _ in found]))
    return [mark.text, f"{met} of {len(found)}", str(beyond), mean, f"{ratio(least)}: {where}"]


def _error_rows(measured):
    """Whether in each class everyone's largest error is at least ours: of whichever errs least, then of float alone."""
    found = _more_exact(measured)
    text = "as exact as whoever is most exact, of those that are neither wrong nor fail"
    yield _error_row(f"{text}; pairs in float answered in float or in double", list(map(_still, found)))
    yield _error_row("the same with pairs in float answered in float alone", found)


def _error_row(text, found):
    lost = [r for rivals in found for r in rivals]
    if not lost:
        return [text, f"{len(found)} of {len(found)}", NONE, NONE, NONE]
    most = max(lost, key=_lead)
    met = sum(not rivals for rivals in found)
    where = f"{most.theirs.library}: {_spelled(most.place)}"
    return [text, f"{met} of {len(found)}", NONE, NONE, f"{_errors_of(most)}: {where}"]


def _spelled(place):
    return f"{place.ask.title}: {place.title}"


# ---- answers that are wrong ----


def _counts(measured):
    for library in measured.libraries:
        own = [a for p in measured.places for a in p.answers if a.library == library and a.default]
        if own:
            yield library, *(sum(getattr(a, k) for a in own) for k in ("asked", "wrong", "failed"))


def counts(measured):
    """Of each library how many of all its answers at its defaults are wrong or failed."""
    return Table(["library", "answers", "wrong", "failed"], [list(map(str, row)) for row in _counts(measured)])


def examples(measured, most=2, length=1500):
    """Of each library up to two pairs that it answers wrong at its defaults, short ones, of different classes."""
    for library in measured.libraries:
        picked = {}
        for p in measured.places:
            a = p.default(library)
            if a and a.bad and a.example and len(str(a.example)) <= length:
                picked.setdefault(p.name, (p, a))
        worst = sorted(picked.values(), key=lambda pa: -pa[1].bad)[:most]
        if worst:
            yield library, worst


SILENCES = {
    "gave_up": "gives no answer",
    "crashed": "crashes",
    "hung": "does not come back",
    "no_normal": "gives no normal",
    "undecided": "does not decide",
}


def said(place, a):
    """The truth of an example, and what the library said instead."""
    if a.failure in SILENCES:
        says = SILENCES[a.failure]
    elif place.ask.question == "intersect":
        says = f"says that they {'meet' if a.said else 'do not meet'}"
    else:
        says = f"says {_separation(a.said)}"
    return f"{sentence(_spelled(place))}. They are {_separation(a.truth)}; {a.library} {says}."


def _separation(x):
    return f"apart by {x:.9g}" if x > 0 else f"overlapping by {-x:.9g}" if x < 0 else "touching"

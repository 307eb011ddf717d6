# SPDX-License-Identifier: MIT
"""The comparison's page in a real browser: all is drawn, nothing overlaps, nothing is cut, on a phone, a desk, paper.

The results are those of the small bench that ctest ran in build/release, or the files that GJK_COMPARE_RESULTS names.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

import pytest
from pages import tables, words
from pages.measured import Incomplete, Measured
from selenium import webdriver
from selenium.webdriver.chrome.service import Service

HERE = Path(__file__).parent
SMALL = HERE.parents[1] / "build/release/tests/compare"
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
MEDIA = {"phone": (360, "screen"), "desk": (1200, "screen"), "paper": (718, "print")}  # A4 with margins of a centimetre

LOOK = """
const box = e => { const r = e.getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom] };
return {
    width: document.documentElement.scrollWidth,
    loaded: [...document.querySelectorAll('*')].flatMap(e => ['src', 'href', 'xlink:href'].map(k => e.getAttribute(k)))
        .filter(name => name && !name.startsWith('#') && !name.startsWith('data:')),
    uncut: [...document.querySelectorAll('figure')].every(e => getComputedStyle(e).breakInside === 'avoid'),
    tables: [...document.querySelectorAll('.table')].filter(e => e.offsetParent)
        .map(e => e.scrollWidth - e.clientWidth),
    figures: [...document.querySelectorAll('figure')].map(figure => ({
        id: figure.id, box: box(figure),
        drawn: [...figure.querySelectorAll('svg')].map(box),
        curves: [...figure.querySelectorAll('svg [id*="-curve-"]')]
            .map(e => [e.id, box(e), e.querySelectorAll('use').length]),
        texts: [...figure.querySelectorAll('svg text')].map(e => [e.textContent, box(e)])
    }))
}"""


def results():
    named = os.environ.get("GJK_COMPARE_RESULTS", "").split()
    return named or sorted(map(str, SMALL.glob("small.bench*.jsonl")))


@pytest.fixture(scope="module")
def rows():
    found = results()
    assert found, f"{SMALL} has no results: run ctest there first"
    return [json.loads(line) for path in found for line in Path(path).read_text(encoding="utf-8").splitlines()]


def write(folder, files):
    """All that is written of some results."""
    options = ["-o", folder / "comparison.md", "--html", folder / "index.html", "--plot", folder / "comparison.svg"]
    subprocess.run([sys.executable, HERE / "comparison.py", *files, *options], check=True)
    return folder


@pytest.fixture(scope="module")
def made(rows, tmp_path_factory):
    return write(tmp_path_factory.mktemp("made"), results())


@pytest.fixture(scope="module")
def few(rows):
    """One class of pairs of each question, and all that is not of a class."""
    first = {}
    return [r for r in rows if "state" not in r or first.setdefault(asked(r)[:3], r["class"]) == r["class"]]


@pytest.fixture(scope="module")
def small(few, tmp_path_factory):
    folder = tmp_path_factory.mktemp("small")
    path = folder / "few.jsonl"
    path.write_text("".join(json.dumps(row) + "\n" for row in few), encoding="utf-8")
    return write(folder, [path])


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    for flag in [*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"]:
        options.add_argument(flag)
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    yield driver
    driver.quit()


def look(browser, page, medium):
    """What the browser sees."""
    width, media = MEDIA[medium]
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": media})
    browser.get_log("browser")  # what was there before
    browser.get(page.as_uri())
    browser.execute_script("return document.fonts.ready.then(() => null)")
    return {**browser.execute_script(LOOK), "console": browser.get_log("browser")}


def faults(seen, expected, medium):
    """What is wrong with it; expected are the curves of each figure."""
    width, media = MEDIA[medium]
    yield from (f"console: {entry['message']}" for entry in seen["console"])
    yield from (f"not self-contained: {name}" for name in seen["loaded"])
    if seen["width"] > width:
        yield f"wider than the page: {seen['width']}"
    if media == "print":
        yield from (f"a table is cut by {by}" for by in seen["tables"] if by > 0)
        if not seen["uncut"]:
            yield "figures may be cut"
    figures = {figure["id"]: figure for figure in seen["figures"]}
    if len(figures) != len(seen["figures"]):
        yield "two figures have one name"
    yield from (f"{name}: no such figure" for name in expected.keys() - figures.keys())
    for name, figure in figures.items():
        yield from (f"{name}: {text}" for text in figure_faults(figure, expected.get(name)))


def figure_faults(figure, expected):
    if len(figure["drawn"]) != 1 or is_empty(figure["drawn"][0]):
        yield "not drawn"
    yield from (f"{curve} is not seen" for curve, box, _ in figure["curves"] if is_empty(box))
    drawn = {curve.split("-curve-")[1]: points for curve, _, points in figure["curves"]}
    if expected is not None and drawn != expected:
        yield f"curves are {drawn}, not {expected}"
    if not figure["texts"]:
        yield "no words"
    for i, (text, box) in enumerate(figure["texts"]):
        yield from (f"'{text}' is upon '{other}'" for other, place in figure["texts"][:i] if overlap(box, place))
        if not contains(figure["box"], box):
            yield f"'{text}' leaves the figure"


def is_empty(box):
    return box[2] - box[0] < 1 and box[3] - box[1] < 1


def overlap(a, b):
    return all(min(a[k + 2], b[k + 2]) - max(a[k], b[k]) > 0.5 for k in (0, 1))


def contains(outer, inner):
    return all(outer[k] <= inner[k] + 1 and inner[k + 2] <= outer[k + 2] + 1 for k in (0, 1))


def slug(*words):
    return re.sub("[^a-z0-9]+", "-", " ".join(map(str, words)).lower()).strip("-")


def asked(row):
    return row["question"], f"{row['dim']}-D", row["precision"], row["class"], row["state"]


def curves(rows):
    """By figure, from the rows themselves: a curve for each library and knob, and for what is promised; of how many
    points. And one for each library that was timed cold and warm."""
    expected, timed = defaultdict(Counter), set()
    for row in rows:
        if row["row"] == "class":
            expected[slug(*asked(row))].update()
        if row["row"] == "answers" and (row["median"] or 0) > 0:
            name = f"{row['library']}{', warm' if row['warm'] else ''} {row['knob']}"
            if row["default"]:
                timed.add((asked(row), row["library"], row["warm"]))
            own, has_error = expected[slug(*asked(row))], row["max_error"] is not None
            own[slug(name)] += row["question"] == "intersect" or has_error
            own[slug(name, "promised")] += has_error and row["promised"] is not None
        if row["row"] == "growth":
            for what in ("median", "supports"):
                own = expected[slug("growth", row["by"], *asked(row), what)]
                own[slug(row["library"])] += (row[what] or 0) > 0
                own[slug(row["library"], "floor")] += what == "median" and (row["floor"] or 0) > 0
    for where, library, warm in timed:
        if warm and (where, library, False) in timed:
            expected[slug("warm", *where[:3], where[4])][slug(where[3], library)] += 1
    return {name: dict(+own) for name, own in expected.items() if +own or "growth" not in name}


@pytest.mark.parametrize("medium", MEDIA)
def test_all_is_drawn_and_nothing_overlaps(browser, made, rows, medium):
    expected = curves(rows)
    assert sum(map(len, expected.values())) > 20
    found = list(faults(look(browser, made / "index.html", medium), expected, medium))
    assert not found, "\n".join(found)


BROKEN = [
    ("console", "<body>", "<body><script>console.error('no')</script>"),
    ("self-contained", "<body>", '<body><img src="none.png">'),
    ("wider", "<body>", '<body><div style="width: 5000px">no</div>'),
    ("no such figure", "<figure", '<div class="figure"'),
    ("not drawn", "<svg", '<svg style="display: none"'),
    ("curves are", "-curve-", "-line-"),
    ("curves are", "(-curve-.*?)<use ", r"\1<text "),
    ("is not seen", '<g id="([^"]*)-curve-', r'<g style="display: none" id="\1-curve-'),
    ("is upon", "</svg>", '<text x="150" y="50">one</text><text x="155" y="50">two</text></svg>'),
    ("leaves", "</svg>", '<text x="300" y="50">far too long to fit into the figure</text></svg>'),
    ("figures may be cut", "break-inside: avoid", "break-inside: auto"),
    ("a table is cut", '<div class="table">', '<div class="table" style="width: 20px">'),
]


@pytest.mark.parametrize(("fault", "pattern", "by"), BROKEN)
def test_what_is_broken_is_noticed(browser, small, few, fault, pattern, by):
    cut = "cut" in fault
    text, count = re.subn(pattern, by, (small / "index.html").read_text(encoding="utf-8"), count=0 if cut else 1)
    assert count
    page = small / "broken.html"
    page.write_text(text, encoding="utf-8")
    medium = "paper" if cut else "phone"
    assert any(fault in found for found in faults(look(browser, page, medium), curves(few), medium))


def test_the_readme_s_plot_stands_alone(browser, made):
    browser.get((made / "comparison.svg").as_uri())
    box = browser.execute_script(
        "const r = document.documentElement.getBoundingClientRect(); return [r.width, r.height]"
    )
    assert min(box) > 100
    assert browser.find_elements("css selector", '[id*="-curve-"]')
    assert browser.get_log("browser") == []


def test_the_markdown_tells_the_same(made, rows):
    text = (made / "comparison.md").read_text(encoding="utf-8")
    head = next(row for row in rows if row["row"] == "head")
    assert all(f"| {peer['name']} | {peer['version']} |" in text for peer in head["peers"])
    assert all(f"| {name} | missing" in text for name in head["missing"])
    for row in rows:
        if row["row"] == "class":
            assert f"| {row['class']}, {row['state']} |" in text


def test_the_cases_replay(made):
    """What ours answers to them holds the truth that the page tells."""
    text = (made / "comparison.md").read_text(encoding="utf-8")
    cases = re.findall(r"They are (.*?);[^\n]*\n\n```json\n(.*?)\n```", text)
    assert cases
    lines = "".join(f"{case}\n" for _, case in cases)
    asked = subprocess.run(
        [sys.executable, "-m", "gjk", "query"], input=lines, capture_output=True, text=True, check=True
    )
    answers = [json.loads(line) for line in asked.stdout.splitlines()]
    assert len(answers) == len(cases)
    for (told, case), answer in zip(cases, answers):
        word, *number = told.split(" by ")
        truth = {"apart": 1, "overlapping": -1, "touching": 0}[word] * float(*number)
        truth = max(truth, 0) if json.loads(case)["query"] == "distance" else truth
        digits = 1e-8 * abs(truth)
        assert answer["lower"] - digits <= truth <= answer["upper"] + digits, case


def test_instructions_are_read_and_what_asking_costs_is_taken_off(few, tmp_path):
    row = next(row for row in few if row["row"] == "answers")
    results, counted = tmp_path / "results.jsonl", tmp_path / "counted.jsonl"
    results.write_text("".join(json.dumps(row) + "\n" for row in few), encoding="utf-8")
    counts = [{"row": "counted", "label": label, "answers": 10} for label in (row["label"], "nothing")]
    counts = [{"row": "head", "pairs": 7}, *counts, {"row": "end"}]
    counted.write_text("".join(json.dumps(row) + "\n" for row in counts), encoding="utf-8")
    for i, (label, total) in enumerate([(row["label"], 5000), ("nothing", 70)]):
        text = f"desc: Trigger: Client Request: {label}\nsummary: {total}\n\ntotals: {total}\n"
        (tmp_path / f"callgrind.out.{i}").write_text(text, encoding="utf-8")
    measured = Measured([results], [counted], [str(tmp_path)])
    assert [a.instructions for p in measured.places for a in p.answers if a.instructions] == [493]
    assert "; instructions of 7 of them" in words.head(measured)


def test_instructions_are_counted_of_the_classes_asked_for():
    script = [HERE / "instructions.sh", "-b", SMALL.parents[1], "-n", "2", "^distance 3 double boxes (path|separated)"]
    counted = subprocess.run(["sh", *script], capture_output=True, text=True, check=True)
    separated, path = counted.stdout.splitlines()
    assert re.fullmatch(r"distance, 3-D, double: boxes, separated:  gjk3 \d{3,5}", separated)
    assert re.fullmatch(r"distance, 3-D, double: boxes, path:  gjk3 \d{3,5}  gjk3, warm \d{3,5}", path)


def test_results_without_an_end_are_refused(few, tmp_path):
    path = tmp_path / "results.jsonl"
    path.write_text("".join(json.dumps(row) + "\n" for row in few[:-1]), encoding="utf-8")
    with pytest.raises(Incomplete):
        Measured([path])


@pytest.fixture(scope="module")
def odd():
    """The rows of peers that answer as none should, and their file."""
    path = SMALL / "odd.1.jsonl"
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    return {(r["library"], r["question"], r["state"]): r for r in rows if r["row"] == "answers" and r["default"]}, path


def test_where_no_answer_has_a_number_there_is_no_error(odd):
    """In the rows of a peer that never answers, and of whether bodies meet; a dash, not a 0, on the page."""
    answers, path = odd
    for name in ("max_error", "median_error", "excess"):
        assert answers["silent", "distance", "separated"][name] is None
        assert answers["gjk3", "intersect", "separated"][name] is None
    assert answers["gjk3", "distance", "separated"]["max_error"] is not None
    place = next(p for p in Measured([path]).places if p.ask.question == "distance")
    failed = answers["silent", "distance", "separated"]["asked"]
    assert tables.errors([place]).rows[0][2] == f"–: {failed} failed"
    shown = next(row for row in tables.settings(place).rows if row[0] == "silent")
    assert shown[8:12] == ["–"] * 4
    assert shown[-2:] == ["0", str(failed)]


def test_an_absurd_length_is_no_answer(odd):
    """1e300 between bodies of size 1 has failed; it is not an error of 1e300."""
    answers, path = odd
    for question, state, told in (("distance", "separated", "apart"), ("penetration", "deep", "overlapping")):
        row = answers["absurd", question, state]
        assert (row["wrong"], row["failed"], row["failure"]) == (0, row["asked"], "absurd")
        assert row["max_error"] is None
        place = next(p for p in Measured([path]).places if (p.ask.question, p.state) == (question, state))
        assert f"absurd says {told} by 1e+300" in tables.said(place, place.default("absurd"))


def test_who_dies_is_left_out_of_the_counting():
    """Of those counted natively, where callgrind would write what it counts, the others are all there."""
    rows = [json.loads(line) for line in (SMALL / "odd.0.jsonl").read_text(encoding="utf-8").splitlines()]
    counted = Counter(row.get("library", row["label"]) for row in rows if row["row"] == "counted")
    assert counted.keys() == {"nothing", "gjk3", "silent", "absurd"}
    assert counted["nothing"] == 1
    assert counted["silent"] == counted["absurd"] == 4


def test_one_huge_error_leaves_all_curves_to_be_seen(browser, rows, tmp_path):
    """Ours falls by many powers of ten with its steps, and is not flattened by what another says."""
    rows = [dict(row) for row in rows if "state" not in row or asked(row)[::3] == ("penetration", "hulls of 8")]
    row = next(r for r in rows if r.get("library") == "libccd MPR")
    row["max_error"] = 1e307
    path = tmp_path / "few.jsonl"
    path.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
    page = write(tmp_path, [path]) / "index.html"
    assert "1.0e307" in page.read_text(encoding="utf-8")
    seen = look(browser, page, "desk")
    assert not list(faults(seen, curves(rows), "desk"))
    figure = next(figure for figure in seen["figures"] if figure["id"] == slug(*asked(row)))
    _, box, _ = next(curve for curve in figure["curves"] if curve[0].endswith("-curve-gjk3-steps"))
    assert box[3] - box[1] > 50


def test_where_ours_is_not_first_is_said(few, tmp_path):
    """A faster and more exact peer stands in the words and in the marks; a slower and less exact one does not. Where it
    leaves less time than two support calls take, the mark is out of reach."""

    def told(factor, error, alone=200.0):
        rows = [dict(row) for row in few]
        for row in rows:
            if row["row"] == "class":
                row["supports_median"] = alone
            if row["row"] == "answers":
                ours = row["library"].startswith("gjk")
                row.update(median=1e3 if ours else 1e3 * factor, wrong=0, failed=0)
                if row["max_error"] is not None:
                    row["max_error"] = 1e-15 if ours else error
        path = tmp_path / "results.jsonl"
        path.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
        measured = Measured([path])
        reached = [row[1:3] for row in tables.marks(measured).rows if row[1] != "not measured"]
        assert len(reached) >= 3
        beyond = [int(none) for _, none in reached if none != tables.NONE]
        reached = [text for text, _ in reached]
        by_class, by_library = (
            {row[1]: row[4] for row in t(measured).rows if row[0] == "3-D, double"}
            for t in (tables.by_class, tables.by_library)
        )
        tabled = by_class["boxes"], by_library["libccd MPR"], dict(tables.glance(measured))["Fast?"]
        return dict(tables.not_first(measured))["penetration, 3-D, double"], reached, beyond, tabled

    lines, reached, beyond, tabled = told(0.5, 1e-16)
    assert beyond[0] == int(reached[0].split()[-1]) and not any(beyond[1:])
    assert tabled[0] == "4 of 4: 0.50, libccd GJK"
    assert re.fullmatch(r"0\.50: (\d+) of \1, \1 as good; \1 more exact", tabled[1])
    assert re.fullmatch(r"In (\d+) of \1 classes someone is faster, in \1 .* In 0 ours is the fastest.", tabled[2])
    assert any("is faster in" in line and "(0.50 of our time)" in line for line in lines)
    assert any("is more exact in" in line and "1.0e-16 to 1.0e-15" in line for line in lines)
    assert all(text.startswith("0 of") for text in reached)
    assert not any(told(0.5, 1e-16, None)[2]) and all(told(0.5, 1e-16, 501.0)[2])
    lines, reached, beyond, tabled = told(4, 5e-15)
    assert not any(beyond)
    assert tabled[0] == "0 of 4"
    assert re.fullmatch(r"4\.00: 0 of \d+", tabled[1])
    assert re.fullmatch(r"In 0 of (\d+) classes someone is faster, .* In \1 ours is the fastest.", tabled[2])
    assert lines == ["Ours is the fastest and the most exact in every class."]
    assert not any(text.startswith("0 of") for text in reached)


def test_of_pairs_in_float_the_more_exact_of_ours_counts(few, tmp_path):
    """A peer that errs less than our float, not than our double, is ahead of float alone; one that errs less than both is
    ahead of both. An answer of ours in double that is wrong does not count."""

    def told(error, wrong=0):
        rows = [dict(row) for row in few]
        for row in rows:
            if row["row"] == "answers":
                ours, single = row["library"].startswith("gjk"), row["library"].endswith("f")
                row.update(median=500.0 if single else 400.0, wrong=wrong if ours and not single else 0, failed=0)
                if row["max_error"] is not None:
                    row["max_error"] = 1e-8 if single else 1e-16 if ours else error
        path = tmp_path / "results.jsonl"
        path.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
        measured = Measured([path])
        held = [p for p in measured.places if p.ask.question != "intersect" and p.ours() and p.theirs()]
        marks = [row[1] for row in tables.marks(measured).rows[-2:]]
        cells = {tuple(row[:2]): row[3] for row in tables.by_error(measured).rows}  # of penetration
        library = next(row[4] for row in tables.by_library(measured).rows if row[:2] == ["3-D, float", "libccd MPR"])
        exact = dict(tables.glance(measured))["Exact?"]
        assert "on these pairs double takes 0.80 of the time that float takes" in exact
        numbers = tuple(int(re.search(pattern, exact).group(1)) for pattern in (r"^In (\d+) of", r"in (\d+)\.$"))
        return len(held), sum(p.ask.precision == "float" for p in held), numbers, marks, cells, library

    places, in_float, exact, marks, cells, library = told(1e-15)
    assert 0 < in_float < places
    assert exact == (0, in_float)
    assert marks == [f"{places} of {places}", f"{places - in_float} of {places}"]
    assert set(cells) == {("2-D, float", "polygons"), ("3-D, float", "boxes")}
    assert re.fullmatch(r"(\d) \(0\) of \1: 1\.0e-15 to 1\.0e-8, .*", cells["3-D, float", "boxes"])
    assert re.search(r"; \d \(0\) more exact", library)
    assert told(1e-15, wrong=1)[2] == (in_float, in_float)
    places, in_float, exact, marks, cells, library = told(1e-17)
    assert exact == (places, places)
    assert marks == [f"0 of {places}"] * 2
    assert re.fullmatch(r"(\d) \(\1\) of \1: .*", cells["3-D, float", "boxes"])
    assert re.fullmatch(r"(\d) of \1: 1\.0e-17 to 1\.0e-16, .*", cells["3-D, double", "boxes"])
    assert re.search(r"; (\d) \(\1\) more exact", library)

# SPDX-License-Identifier: MIT
"""The command gjk report, on a scene small enough for a test."""

from __future__ import annotations

import csv
import io
import json
import re
import sys
from fractions import Fraction
from html.parser import HTMLParser

import pytest

from gjk import Box, distance, penetration
from gjk.cli import main
from gjk.exact import APART, OVERLAPPING, TOUCHING
from gjk.report import measure, table, terminal, truth
from gjk.report.scene import Pair, SceneError, load

TURN = [0.36, 0.48, -0.8, 2, -0.8, 0.6, 0, 2.5, 0.48, 0.64, 0.6, 2]
SCENE = {
    "name": "tiny & <small>",
    "dim": 3,
    "shapes": {
        "box": {"shape": "box", "half": [1, 0.5, 0.25]},
        "ball": {"shape": "sphere", "r": 0.3},
        "lemon": {"shape": "ellipsoid", "radii": [0.1, 0.2, 0.7]},
    },
    "bodies": [
        {"name": "floor", "shape": "box"},
        {"name": "turned", "shape": "box", "pose": TURN},
        {"name": "ball", "shape": "ball", "pose": [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0]},
        {"name": "lemon", "shape": "lemon", "pose": [1, 0, 0, -3, 0, 1, 0, 1, 0, 0, 1, 1]},
        {"name": "rod", "shape": {"shape": "capsule", "r": 0.1, "half_length": 1}, "pose": TURN},
    ],
    "pairs": "all",
}
BALL = SCENE["shapes"]["ball"]


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(SCENE))
    return path


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr(measure, "BUDGET", 1e6)


class Page(HTMLParser):
    """Which elements a page has, whether they close, and what it loads."""

    def __init__(self, text):
        super().__init__()
        self.open, self.count, self.loads = [], {}, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1
        if tag not in ("meta", "link", "img", "br"):
            self.open.append(tag)
        links = [value for name, value in attributes if name in ("src", "href", "xlink:href")]
        self.loads += [link for link in links if not link.startswith("data:")]

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.handle_endtag(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_the_report_of_a_tiny_scene(scene, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["report", str(scene), "--out", str(out), "--jobs", "1"]) == 0
    printed = capsys.readouterr()
    assert "hold the truth" in printed.out
    assert "rel_tol, relative to the distance" in printed.out
    assert re.search("^tight +[0-9]", printed.out, re.MULTILINE)
    assert re.search(r"^Penetration: [0-9]+ ns", printed.out, re.MULTILINE)
    assert "exact truth" in printed.err
    check_rows(list(csv.DictReader((out / "report.csv").read_text(encoding="utf-8").splitlines())))
    check_page((out / "report.html").read_text(encoding="utf-8"))


def check_rows(rows):
    levels = {precision: len(measure.ladder(precision)) for precision in ("double", "float")}
    assert list(rows[0]) == table.COLUMNS
    for precision, count in levels.items():
        mine = [row for row in rows if row["precision"] == precision]
        assert len(mine) == count
        for row in mine:
            assert row["pairs"] == "10"
            assert row["violations"] == "0"
            assert float(row["ns_per_query"]) > 0
            assert float(row["supports_per_query"]) >= 2
        full = next(row for row in mine if row["setting"] == "full")
        one = next(row for row in mine if row["setting"] == "1 steps")
        assert 0 < float(full["error_max"]) < 100
        assert float(full["error_max"]) <= float(full["width_max"]) < 1000
        depth = next(row for row in mine if row["query"] == "penetration")
        assert float(depth["error_max"]) <= float(depth["width_max"]) < 1000
        tight = next(row for row in mine if row["setting"] == "tight")
        assert float(tight["error_max"]) <= float(full["error_max"])
        assert float(tight["width_median"]) < float(full["width_median"])
        assert float(one["width_max"]) > 1e3
        assert float(one["supports_per_query"]) < float(full["supports_per_query"])


def check_page(text):
    page = Page(text)
    assert page.open == []
    assert page.count["svg"] == 6
    assert page.count["table"] == 2
    assert "script" not in page.count
    assert all(link.startswith("#") for link in page.loads), "the page needs nothing beside it"
    assert "tiny &amp; &lt;small&gt;" in text
    assert "prefers-color-scheme: dark" in text
    assert "rel_tol, relative to the distance" in text
    assert re.findall(r"#0[1-9]0[1-9]0[1-9]", text) == [], "every colour is a variable"
    ids = re.findall(r' id="([^"]*)"', text)
    assert len(ids) == len(set(ids))
    used = set(re.findall(r"url\(#([^)]*)\)", text)) | {link[1:] for link in page.loads}
    assert used <= set(ids)


def test_a_part_of_the_pairs(scene):
    assert len(load(scene).pairs) == 10
    few = load(scene, 3)
    assert [(p.name_a, p.name_b) for p in few.pairs] == [("floor", "turned"), ("floor", "rod"), ("turned", "rod")]
    assert few.total == 10


def test_a_broken_bracket_is_found(scene):
    """The report is a judge: shown a wrong truth it must say so."""
    pairs = [Pair("a", "b", Box((1, 1, 1)), Box((1, 1, 1)).at((3, 0, 0)))]
    found = truth.find(pairs, 3, 1, lambda done, total: None)
    assert found[0].relation == APART
    assert found[0].lower == found[0].upper == 1
    answers = measure.solve(pairs, 3, "double", lambda done, total: None)
    assert table.summarise("double", pairs, found, answers).violations == 0
    nearer = [t._replace(lower=t.lower / 2, upper=t.upper / 2) for t in found]
    broken = table.summarise("double", pairs, nearer, answers)
    assert broken.full.violations == 1
    assert broken.full.error.max == pytest.approx(0.5 / (2.0**-53 * found[0].scale))
    assert broken.intersect.violations == 0
    for relation in (TOUCHING, OVERLAPPING):
        assert table.summarise("double", pairs, [found[0]._replace(relation=relation)], answers).intersect.violations


def test_a_broken_depth_is_found():
    pairs = [Pair("a", "b", Box((1, 1, 1)), Box((1, 1, 1)).at((1.5, 0, 0)))]
    found = truth.find(pairs, 3, 1, lambda done, total: None)
    assert found[0].separation == (-0.5, -0.5)
    answers = measure.solve(pairs, 3, "double", lambda done, total: None)
    kept = table.summarise("double", pairs, found, answers)
    assert (kept.penetration.known, kept.violations) == (1, 0)
    assert kept.penetration.error <= kept.penetration.width
    deeper = [found[0]._replace(separation=(Fraction(-1), Fraction(-1)))]
    broken = table.summarise("double", pairs, deeper, answers)
    assert broken.violations == broken.penetration.violations == 1
    assert broken.penetration.error == pytest.approx(0.5 / (2.0**-53 * found[0].scale))
    unknown = table.summarise("double", pairs, [found[0]._replace(separation=None)], answers)
    assert (unknown.penetration.known, unknown.penetration.error, unknown.violations) == (0, 0, 0)


def test_a_turned_ellipsoid_in_float(tmp_path):
    """Its radii times its rotation would round: the bracket would be that of another set, and miss this one."""
    box = {"shape": "box", "half": [0.010999917984008789, 0.004400014877319336, 0.0018999576568603516]}
    box_pose = [0.9210752248764038, 0.3893846869468689, -3.528594970703125e-05, 0.23682570457458496]
    box_pose += [0.3893846869468689, -0.9210752248764038, -2.7120113372802734e-05, -0.4888758659362793]
    box_pose += [-4.309415817260742e-05, 1.1265277862548828e-05, -1.0, 0.192824125289917]
    lemon = {"shape": "ellipsoid", "radii": [0.04500007629394531, 0.029999971389770508, 0.029999971389770508]}
    lemon_pose = [0.5403022766113281, -0.8414709568023682, 0.0, 0.09999990463256836]
    lemon_pose += [0.8414709568023682, 0.5403022766113281, 0.0, -0.4700000286102295]
    lemon_pose += [0.0, 0.0, 1.0, 0.13000011444091797]
    bodies = [{"name": "finger", "shape": box, "pose": box_pose}, {"name": "lemon", "shape": lemon, "pose": lemon_pose}]
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({"name": "lemon", "dim": 3, "shapes": {}, "bodies": bodies, "pairs": "all"}))
    pairs = load(path).rounded()
    found = truth.find(pairs, 3, 1, lambda done, total: None)
    answers = measure.solve(pairs, 3, "float", lambda done, total: None)
    assert table.summarise("float", pairs, found, answers).violations == 0


def test_several_processes_find_the_same(scene):
    pairs = load(scene).pairs
    done = []
    alone = truth.find(pairs, 3, 1, lambda n, total: None)
    assert truth.find(pairs, 3, 2, lambda n, total: done.append((n, total))) == alone
    assert done[-1] == (10, 10)


def test_answers_are_those_of_the_library(scene):
    pairs = load(scene).pairs
    for precision in ("double", "float"):
        for level in measure.solve(pairs, 3, precision, lambda done, total: None):
            if level.level.kind in ("rel_tol", "tight"):
                settings = {"tight": True} if level.level.kind == "tight" else {"rel_tol": level.level.setting}
                for pair, answer in zip(pairs, level.answers):
                    result = distance(pair.a, pair.b, precision=precision, **settings)
                    assert (result.value, result.lower, result.upper) == answer[:3]
            if level.level.kind == "penetration":
                for pair, answer in zip(pairs, level.answers):
                    result = penetration(pair.a, pair.b, precision=precision)
                    assert (result.value, result.lower, result.upper) == answer[:3]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pairs": []}, "there are no pairs"),
        ({"pairs": [["floor", "ball"], ["floor", "nobody"]]}, "pair 2: no body 'nobody'"),
        ({"pairs": [["floor"]]}, "pair 1 is the names of two bodies, not ['floor']"),
        ({"pairs": ["ab"]}, "pair 1 is the names of two bodies, not 'ab'"),
        ({"pairs": [["floor", 7]]}, "pair 1 is the names of two bodies, not ['floor', 7]"),
        ({"pairs": 7}, 'pairs is a list or "all", not 7'),
        ({"bodies": {}}, "bodies is a list"),
        ({"bodies": [7]}, "body 1 is an object, not 7"),
        ({"bodies": [{"shape": "box"}]}, "body 1 without 'name'"),
        ({"bodies": [{"name": 7, "shape": "box"}]}, "body 1: its name is 7"),
        ({"bodies": [{"name": "x", "shape": "box"}] * 2}, "body 2: its name is 'x'"),
        ({"bodies": [{"name": "x"}]}, "body 'x' without 'shape'"),
        ({"bodies": [{"name": "x", "shape": "unknown"}]}, "body 'x': no shape 'unknown' in shapes"),
        ({"bodies": [{"name": "x", "shape": {"shape": "box"}}]}, "body 'x': box without 'half'"),
        ({"bodies": [{"name": "x", "shape": "box", "pose": [1]}]}, "body 'x': "),
        ({"dim": 7}, "dim is 2 or 3, not 7"),
        ({"shapes": [1]}, "shapes is an object"),
        ({"shapes": {"odd": {"shape": "box", "half": "?"}}}, "shape 'odd': "),
    ],
)
def test_what_is_not_a_scene(tmp_path, change, words, capsys):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({**SCENE, **change}))
    with pytest.raises(SceneError):
        load(path)
    assert main(["report", str(path), "--out", str(tmp_path / "out")]) == 2
    assert f"{path}: not a scene: {words}" in capsys.readouterr().err


def test_a_file_that_is_no_scene(tmp_path, capsys):
    path = tmp_path / "scene.json"
    for text in ("{", "[]", "7"):
        path.write_text(text)
        assert main(["report", str(path)]) == 2
    assert main(["report", str(tmp_path / "none.json")]) == 2
    assert "none.json" in capsys.readouterr().err


def test_bad_numbers_in_a_scene_are_named(tmp_path, capsys):
    bodies = [{**body, "pose": None} for body in SCENE["bodies"]]
    shapes = {**SCENE["shapes"], "ball": {"shape": "sphere", "r": -1}}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({**SCENE, "bodies": bodies, "shapes": shapes}))
    assert main(["report", str(path), "--out", str(tmp_path / "out"), "--jobs", "1"]) == 2
    assert "floor and ball: b: radius is -1" in capsys.readouterr().err


NOTHING = {"shape": "sphere", "r": 0}
FLAT = {"shape": "box", "half": [0, 0, 0]}
FAINT = {"shape": "box", "half": [1e-310, 5e-324, 0]}


@pytest.mark.parametrize("pair", [(NOTHING, FLAT), (FLAT, FLAT), (FAINT, NOTHING), (FAINT, FAINT)])
def test_bodies_without_size(tmp_path, pair):
    """There is no scale to measure errors by."""
    path = tmp_path / "scene.json"
    bodies = [{"name": name, "shape": shape} for name, shape in zip("ab", pair)]
    path.write_text(json.dumps({"dim": 3, "bodies": bodies, "pairs": "all"}))
    assert main(["report", str(path), "--out", str(tmp_path / "out"), "--jobs", "1"]) == 0


def test_names_are_shown_as_they_are(tmp_path, capsys):
    """Not as markup of the terminal; and halves of characters, which JSON can spell, as question marks."""
    path, out = tmp_path / "scene.json", tmp_path / "[/bold]"
    bodies = [{"name": name, "shape": BALL, "pose": [i, 0, 0]} for i, name in enumerate(["\ud800", "[/red]"])]
    path.write_text(
        json.dumps({"name": "[/a][b]\ud800", "source": "\udfff", "dim": 3, "bodies": bodies, "pairs": "all"})
    )
    assert main(["report", str(path), "--out", str(out), "--jobs", "1", "--precision", "double"]) == 0
    printed = capsys.readouterr().out
    assert "[/a][b]?: distance of 1 pairs" in printed
    assert f"wrote {out}/report.csv" in printed
    assert "Scene: ?" in (out / "report.html").read_text(encoding="utf-8")


def nested(depth):
    shape = BALL
    for _ in range(depth):
        shape = {"shape": "sum", "a": shape, "b": BALL}
    return shape


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"dim": 3.0}, "dim is 2 or 3, not 3.0"),
        ({"bodies": [{"name": "deep", "shape": nested(150)}] * 2}, "nested"),
        ({"shapes": {"deep": nested(150)}}, "nested"),
    ],
)
def test_scenes_that_are_refused_in_a_line(tmp_path, capsys, change, words):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({**SCENE, **change}))
    assert main(["report", str(path), "--out", str(tmp_path / "out")]) == 2
    printed = capsys.readouterr().err
    assert printed.startswith("gjk report: ")
    assert words in printed
    assert printed.count("\n") == 1


def test_a_scene_nested_deeper_than_json_reads(tmp_path, capsys):
    path = tmp_path / "scene.json"
    path.write_text('{"name": ' + "[" * 100_000 + "]" * 100_000 + "}")
    assert main(["report", str(path)]) == 2
    assert "scene.json: not a scene: nested too deep" in capsys.readouterr().err


def test_what_overflows_a_float_is_told_before_the_work(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(truth, "find", lambda *_: pytest.fail("worked before it looked"))
    path = tmp_path / "scene.json"
    bodies = [{"name": "vast", "shape": {"shape": "box", "half": [1e300, 1, 1]}}, {"name": "ball", "shape": BALL}]
    path.write_text(json.dumps({**SCENE, "bodies": bodies}))
    assert main(["report", str(path), "--out", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err == "gjk report: vast: out of the range of float: ask with --precision double\n"


@pytest.mark.parametrize(("error", "code"), [(BrokenPipeError, 141), (OSError, 2)])
def test_output_that_fails_is_no_broken_bracket(scene, tmp_path, monkeypatch, capsys, error, code):
    def fails(*_):
        raise error("no room")

    monkeypatch.setattr(terminal, "show", fails)
    assert main(["report", str(scene), "--out", str(tmp_path / "out"), "--jobs", "1", "--limit", "1"]) == code
    assert capsys.readouterr().err.endswith("gjk report: no room\n") == (code == 2)


def test_a_defect_is_no_broken_bracket(scene, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(truth, "find", lambda *_: 1 / 0)
    assert main(["report", str(scene), "--out", str(tmp_path / "out")]) == 2
    assert "ZeroDivisionError" in capsys.readouterr().err


def test_a_closed_pipe_is_left_to_the_command(monkeypatch):
    """rich would end with 1, which says that a bracket misses the truth."""

    class Closed(io.StringIO):
        def write(self, _):
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stdout", Closed())
    with pytest.raises(BrokenPipeError):
        terminal._Console().print("words")


def test_standard_output_that_is_closed(scene, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdout", None)
    assert main(["report", str(scene), "--out", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err == "gjk report: standard output is closed\n"


def test_a_folder_that_cannot_be_is_told_before_the_work(scene, monkeypatch, capsys):
    monkeypatch.setattr(truth, "find", lambda *_: pytest.fail("worked before it looked"))
    assert main(["report", str(scene), "--out", str(scene)]) == 2
    assert "scene.json" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--limit", "--jobs"])
@pytest.mark.parametrize("text", ["x", "0", "-3", "1.5"])
def test_numbers_that_are_no_counts(scene, option, text, capsys):
    with pytest.raises(SystemExit):
        main(["report", str(scene), option, text])
    assert f"{option}: a whole number from 1 up is expected, not '{text}'" in capsys.readouterr().err


def test_what_the_report_needs_is_told(scene, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "gjk.report", None)
    assert main(["report", str(scene)]) == 2
    assert "pip install './bindings/python[report]'" in capsys.readouterr().err

# SPDX-License-Identifier: MIT
"""The command gjk query."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pairs import pairs, prepared

import gjk
from gjk import cli, exact
from gjk.cli import answer_lines, main

BOX = {"shape": "box", "half": [1, 1, 1]}
BALL = {"shape": "sphere", "r": 0.5, "pose": [1, 0, 0, 4, 0, 1, 0, 0, 0, 0, 1, 0]}
CASE = {"id": "one", "dim": 3, "a": BOX, "b": BALL}


def ask(*lines, query=None):
    """The answers to these lines and the exit code."""
    text = "\n".join(line if isinstance(line, str) else json.dumps(line) for line in lines)
    out = io.StringIO()
    code = answer_lines(io.BytesIO(text.encode()), out, query)
    return [json.loads(line) for line in out.getvalue().splitlines()], code


def test_an_answer():
    (answer,), code = ask(CASE)
    fields = ["id", "value", "lower", "upper", "point_a", "point_b", "normal", "status", "steps", "supports"]
    assert code == 0
    assert list(answer) == [*fields, "intersect"]
    assert answer["id"] == "one"
    assert answer["status"] == "ok"
    assert answer["lower"] <= 2.5 <= answer["upper"]
    assert answer["intersect"] is False
    assert answer["point_a"] == [1, 0, 0]
    assert answer["normal"] == [1, 0, 0]


def test_a_question_for_cases_without_one():
    meeting = {**CASE, "b": {**BALL, "pose": None}}
    answers, _ = ask(CASE, meeting, {**CASE, "query": "distance"}, {**meeting, "query": "distance"}, query="intersect")
    assert [answer["intersect"] for answer in answers] == [False, True, False, True]
    assert answers[0]["status"] == "decided"
    assert answers[2]["status"] == "ok"
    assert answers[1]["upper"] < 0 == answers[3]["lower"]


def test_the_last_bit():
    third = {**CASE, "b": {"shape": "box", "half": [1, 1, 1], "pose": [1, 0, 0, 3, 0, 1, 0, 3, 0, 0, 1, 0]}}
    (answer,), _ = ask({**third, "options": {"tight": True}})
    assert answer["lower"] <= 2**0.5 <= answer["upper"]
    assert answer["upper"] - answer["lower"] <= 2 * 2.0**-52


def test_exact_contact_is_told_where_asked():
    touching = {**CASE, "b": {**BOX, "pose": [1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0]}, "options": {"tight": True}}
    answers, _ = ask(touching, {**touching, "query": "intersect"})
    assert [answer["value"] for answer in answers] == [0, 0]
    assert [answer["upper"] for answer in answers] == [0, 0]
    assert [answer["intersect"] for answer in answers] == [True, True]


def test_touching_is_neither():
    beside = [1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0]
    touching = {**CASE, "b": {"shape": "cylinder", "r": 1, "half_length": 1, "pose": beside}}
    (answer,), _ = ask({**touching, "query": "intersect"})
    assert answer["status"] == "floor"
    assert answer["lower"] <= 0 <= answer["upper"]
    assert "intersect" not in answer


def test_options_and_precision():
    cases = [
        {**CASE, "options": {"max_steps": 1}, "unknown": 7},
        {**CASE, "options": {"cutoff": 1}},
        {**CASE, "precision": "float"},
    ]
    answers, code = ask(*cases)
    assert code == 0
    assert answers[0]["steps"] == 1
    assert answers[1]["status"] == "decided"
    assert answers[2]["upper"] - answers[2]["lower"] > 1e-9


def test_what_is_null_is_absent():
    answers, _ = ask(CASE, {**CASE, "options": None, "a": {**BOX, "radius": None, "pose": None}})
    assert answers[0] == answers[1]


def test_options_of_distances_do_not_spoil_an_intersection():
    (answer,), _ = ask({**CASE, "query": "intersect", "options": {"rel_tol": 0.1, "max_steps": 9}})
    assert answer["status"] == "decided"


def test_options_of_penetrations_do_not_spoil_other_questions():
    cases = [{**CASE, "query": query, "options": {"corners": 7, "cutoff": 1}} for query in ("distance", "intersect")]
    answers, _ = ask(*cases)
    assert [answer["status"] for answer in answers] == ["decided", "decided"]


def test_depth_has_a_sign():
    deep = {**CASE, "b": {**BALL, "pose": [1, 0, 0, 0.75, 0, 1, 0, 0, 0, 0, 1, 0]}}
    answers, code = ask(deep, CASE, query="penetration")
    assert code == 0
    assert [answer["value"] for answer in answers] == [-0.75, 2.5]
    assert [answer["intersect"] for answer in answers] == [True, False]
    assert answers[0]["normal"] == [1, 0, 0]
    assert (answers[0]["point_a"], answers[0]["point_b"]) == ([1, 0, 0], [0.25, 0, 0])


def test_more_corners_for_round_shapes():
    cone = {"shape": "cone", "r": 2, "half_length": 1}
    aside = {**cone, "pose": [1, 0, 0, 0.5, 0, 0, -1, 0.1, 0, 1, 0, 0.2]}
    deep = {**CASE, "query": "penetration", "a": cone, "b": aside}
    few, many = ask(*({**deep, "options": {"corners": n, "max_steps": 1000}} for n in (8, 1000)))[0]
    assert few["status"] == "limit"
    assert many["status"] != "limit"
    assert few["upper"] - few["lower"] > 1e6 * (many["upper"] - many["lower"])
    assert few["lower"] <= many["value"] <= few["upper"]


@given(pair=pairs(), precision=st.sampled_from(["double", "float"]))
def test_cases_of_every_shape(pair, precision):
    dim, a, b = pair
    (answer,), code = ask({"dim": dim, "precision": precision, "a": a, "b": b})
    _, _, truth = prepared(pair, precision)
    assert code == 0
    assert answer["lower"] <= truth.upper
    assert truth.lower <= answer["upper"]


@pytest.mark.parametrize(
    ("change", "status", "words"),
    [
        ({"a": {"shape": "box", "half": [1, "NaN", 1]}}, "bad argument", "half"),
        ({"a": {"shape": "box", "half": [1, float("nan"), 1]}}, "bad support", "half[1] is nan"),
        ({"a": {"shape": "sphere", "r": float("inf")}}, "bad argument", "radius is inf"),
        ({"a": {"shape": "sphere", "r": -1}}, "bad argument", "radius is -1"),
        ({"a": {"shape": "points", "points": []}}, "bad support", "no points"),
        ({"a": {"shape": "points", "points": [[1, 2]]}}, "bad argument", "2"),
        ({"a": {"shape": "points", "points": 5}}, "bad argument", "points"),
        ({"a": {"shape": "torus"}}, "bad argument", "torus"),
        ({"a": {"shape": ["box"]}}, "bad argument", "box"),
        ({"a": {"shape": "box"}}, "bad argument", "a: box without 'half'"),
        ({"b": {"shape": "sum", "a": BOX, "b": {}}}, "bad argument", "b: b: no such shape"),
        ({"a": [1, 2]}, "bad argument", "object"),
        ({"a": None}, "bad argument", "object"),
        ({"a": {**BOX, "pose": [1, 2]}}, "bad argument", "pose"),
        ({"a": {**BOX, "radius": "big"}}, "bad argument", "radius"),
        *(({"a": {**BOX, "radius": nothing}}, "bad argument", "radius") for nothing in (False, "", [], {}, -1)),
        *(({"a": {"shape": "sphere", "r": 1, "radius": nothing}}, "bad argument", "radius") for nothing in (False, "")),
        *(({"options": nothing}, "bad argument", "options is an object") for nothing in (False, "", [], 0)),
        ({"options": {"abs_tol": False}}, "bad argument", "option abs_tol is False"),
        ({"a": {"shape": "sum", "a": BOX}}, "bad argument", "without 'b'"),
        ({"dim": 4}, "bad argument", "dim"),
        ({"dim": 2}, "bad argument", "2-D"),
        ({"dim": "3"}, "bad argument", "dim"),
        ({"precision": "half"}, "bad argument", "precision"),
        ({"precision": []}, "bad argument", "precision"),
        ({"options": {"max_steps": 0.5}}, "bad argument", "option max_steps is 0.5"),
        ({"options": {"rel_tol": float("nan")}}, "bad argument", "option"),
        ({"options": 3}, "bad argument", "options"),
        ({"options": {"tight": 1}}, "bad argument", "tight"),
        ({"options": {"tight": "true"}, "query": "intersect"}, "bad argument", "tight"),
        ({"options": {"rel_tol": 0.1, "max_step": 1}}, "bad argument", "'max_step'"),
        ({"options": {"rel-tol": 0.1}, "query": "intersect"}, "bad argument", "'rel-tol'"),
        ({"options": {"corners": 7}, "query": "penetration"}, "bad argument", "corners"),
        ({"options": {"corners": "64"}, "query": "penetration"}, "bad argument", "corners"),
        ({"options": {"corner": 64}, "query": "penetration"}, "bad argument", "'corner'"),
        ({"query": "cast"}, "unsupported query", "cast"),
        ({"query": ["toi"]}, "unsupported query", "toi"),
    ],
)
def test_bad_cases_are_answered_by_name(change, status, words):
    (answer, good), code = ask({**CASE, **change}, CASE)
    assert code == 0
    assert answer["id"] == "one"
    assert answer["status"] == status
    assert words in answer["message"]
    assert "value" not in answer
    assert good["status"] == "ok"


def test_a_case_without_shapes():
    answers, _ = ask({}, {"a": BOX}, {"id": [1, {}], "a": BOX, "b": BALL})
    assert [answer["status"] for answer in answers] == ["bad argument", "bad argument", "ok"]
    assert answers[2]["id"] == [1, {}]


@pytest.mark.parametrize(
    "bad", ["{", "[1, 2]", "7", "null", '{"a": }', '{"id": NaN}', "\x00", "[" * 100_000, '"' + "x" * 10]
)
def test_a_bad_line_does_not_stop_the_others(bad):
    answers, code = ask(CASE, "", bad, CASE)
    assert code == 1
    assert [answer["status"] for answer in answers] == ["ok", "bad line", "ok"]
    assert answers[1]["line"] == 3
    assert answers[1]["message"]


def test_bytes_that_are_no_text():
    out = io.StringIO()
    assert answer_lines(io.BytesIO(b'{"id": "\xff\xfe"}\n'), out) == 1
    assert json.loads(out.getvalue())["status"] == "bad line"


def test_shapes_nested_too_deep():
    shape: dict = BOX
    for _ in range(150):
        shape = {"shape": "sum", "a": shape, "b": BOX}
    (answer,), _ = ask({**CASE, "a": shape})
    assert answer["status"] == "bad argument"


CASES = Path(__file__).parents[3] / "tests/cases"


@pytest.mark.parametrize("name", ["gjk2", "gjk2f", "gjk3", "gjk3f", "museum"])
def test_the_cases_that_all_tests_share(name):
    cases = [json.loads(line) for line in (CASES / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()]
    for tight in (False, True):
        options = {"tight": tight}
        distances, code = ask(*({**case, "query": "distance", "options": options} for case in cases))
        verdicts, _ = ask(*({**case, "query": "intersect", "options": options} for case in cases))
        assert code == 0
        assert len(distances) == len(verdicts) == len(cases) > 100
        solved = zip(cases, distances, verdicts)
        assert [case["id"] for case, *answers in solved if not agrees(case["expect"], *answers)] == []


@pytest.mark.parametrize("name", ["gjk2", "gjk2f", "gjk3", "gjk3f", "museum"])
def test_the_depths_of_the_cases_that_all_tests_share(name):
    lines = (CASES / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()
    cases = [case for case in map(json.loads, lines) if case["expect"]["relation"] != "apart"]
    answers, code = ask(*({**case, "query": "penetration", "options": {}} for case in cases))
    assert code == 0
    truths = [exact.solve_case(case).separation for case in cases]
    solved = [(case["id"], answer, truth) for case, answer, truth in zip(cases, answers, truths) if truth]
    assert len(solved) > 5
    assert [id for id, answer, (lower, upper) in solved if answer["lower"] > upper or lower > answer["upper"]] == []


def agrees(expect, distance, verdict):
    """Whether both answers are what the truth allows."""
    lower, upper = Fraction(expect["distance_lower"]), Fraction(expect["distance_upper"])
    holds = distance["lower"] <= upper and lower <= distance["upper"]
    meet = expect["relation"] != "apart"
    overlap = verdict["upper"] >= 0 or expect["relation"] == "overlapping"
    return holds and overlap and verdict.get("intersect") in (None, meet) and distance.get("intersect") in (None, meet)


def test_the_command(tmp_path):
    command = [sys.executable, "-m", "gjk"]
    done = subprocess.run([*command, "query"], input=json.dumps(CASE) + "\n{\n", capture_output=True, text=True)
    assert done.returncode == 1
    assert [json.loads(line)["status"] for line in done.stdout.splitlines()] == ["ok", "bad line"]
    assert done.stderr == ""
    file = tmp_path / "cases.jsonl"
    file.write_text(json.dumps(CASE))
    done = subprocess.run([*command, "query", "--query", "intersect", str(file)], capture_output=True, text=True)
    assert done.returncode == 0
    assert json.loads(done.stdout)["intersect"] is False
    done = subprocess.run([*command, "--version"], capture_output=True, text=True)
    assert done.stdout == f"gjk {gjk.__version__}\n"


def test_a_file_that_is_not_there(capsys):
    assert main(["query", "/no/such/file"]) == 2
    assert "no/such/file" in capsys.readouterr().err


@pytest.mark.parametrize("source", ["-", "FILE"])
def test_a_reader_that_leaves(tmp_path, source):
    """head -1 closes the pipe: no traceback, nor any word."""
    file = tmp_path / "cases.jsonl"
    file.write_text((json.dumps(CASE) + "\n") * 20000)
    given = f"<{file}" if source == "-" else str(file)
    pipe = f"{{ {sys.executable} -m gjk query {given}; echo $? >&2; }} | head -1"
    done = subprocess.run(["sh", "-c", pipe], capture_output=True, text=True)
    assert json.loads(done.stdout)["status"] == "ok"
    assert done.stderr == "141\n"


@pytest.mark.parametrize(
    ("redirected", "words"),
    [
        ("{} >/dev/full", "No space"),
        ("<{} >/dev/full", "No space"),
        ("{} >&-", "standard output is closed"),
        ("<{} >&-", "standard output is closed"),
        ("<&-", "standard input is closed"),
        ("/no/such/file", "/no/such/file"),
    ],
)
def test_errors_are_told_in_a_line(tmp_path, redirected, words):
    file = tmp_path / "cases.jsonl"
    file.write_text(json.dumps(CASE) + "\n")
    line = f"{sys.executable} -m gjk query " + redirected.format(file)
    done = subprocess.run(["sh", "-c", line], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.startswith("gjk query: ")
    assert words in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize("field", ["id", "query", "dim", "precision", "a", "options"])
def test_fields_nested_deeper_than_can_be_told(monkeypatch, field):
    """Where json reads deeper than it writes, and than repr goes."""
    deep: list = []
    for _ in range(100_000):
        deep = [deep]
    read = cli._parse
    monkeypatch.setattr(cli, "_parse", lambda line: {**CASE, field: deep} if line == b"deep\n" else read(line))
    answers, code = ask("deep", CASE)
    assert code == (field == "id")
    expected = {"id": "bad line", "query": "unsupported query"}.get(field, "bad argument")
    assert [answer["status"] for answer in answers] == [expected, "ok"]

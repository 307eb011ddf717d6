# SPDX-License-Identifier: MIT
"""Shapes that threads share."""

from __future__ import annotations

import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

import gjk
from gjk._native import variant

KINDS = [
    gjk.Box,
    lambda half: gjk.Points([half, (0, 0, 0)]),
    lambda half: gjk.Sum(gjk.Box(half).at((1, 2, 3)), gjk.Ball(1)),
    lambda half: gjk.Hull(gjk.Support(lambda direction: half, reach=9), gjk.Box(half)),
]


def at_once(monkeypatch, shape, *work):
    """What the works return, one thread each, none of which has made the set of the shape before all are at it."""
    kind, gate = type(shape), threading.Barrier(len(work))
    alone = kind._set

    def together(self, v):
        made = alone(self, v)
        gate.wait(60)
        return made

    monkeypatch.setattr(kind, "_set", together)
    with ThreadPoolExecutor(len(work)) as threads:
        return [done.result() for done in [threads.submit(each) for each in work]]


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("make", KINDS)
def test_the_first_to_make_a_struct_gives_it_to_all(monkeypatch, make, precision):
    """One that is replaced would be freed while C reads it."""
    shape, v = make((1, 1, 1)).at((1, 2, 3)), variant(3, precision)
    one, other = at_once(monkeypatch, shape, *[lambda: shape._native(v)] * 2)
    assert one is other is shape._native(v)
    assert one.struct.data == shape._sets[v.name].data


def test_copies_at_other_poses_share_one_set(monkeypatch):
    shape, v = gjk.Box((1, 2, 3)), variant(3, "double")
    moved = shape.at((1, 2, 3))
    one, other = at_once(monkeypatch, shape, lambda: shape._native(v), lambda: moved._native(v))
    assert one.struct.data == other.struct.data == shape._sets[v.name].data


def test_a_couple_holds_all_that_its_parts_point_to():
    couple, v = gjk.Sum(gjk.Box((1, 1, 1)).at((1, 2, 3)), gjk.Points([(0, 0, 0)])), variant(3, "double")
    kept = couple._native_set(v).keep
    assert couple.a._native(v) in kept
    assert couple.b._native(v) in kept


STRESS = """
import random, sys, threading, gjk

sys.setswitchinterval(1e-6)
chance = random.Random(1)
points = [[chance.gauss(0, 1) for _ in range(3)] for _ in range(20000)]
for _ in range(10):
    shape = gjk.Points(points, pose=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0])
    other = gjk.Ellipsoid((1, 2, 3), pose=[1, 0, 0, 9, 0, 0.6, 0.8, 0, 0, -0.8, 0.6, 0])
    gate, seen = threading.Barrier(4), set()

    def work():
        gate.wait()
        for _ in range(10):
            seen.add(gjk.distance(shape, other))

    threads = [threading.Thread(target=work) for _ in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert len(seen) == 1, seen
"""


def test_threads_that_share_shapes_get_one_answer():
    done = subprocess.run([sys.executable, "-c", STRESS], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


SMALL = """
import threading, gjk

def unit(direction):
    size = sum(x * x for x in direction) ** 0.5
    return [x / size for x in direction]

def work():
    for shape in shapes:
        for tight in (False, True):
            gjk.penetration(shape, other, tight=tight)
            gjk.distance(shape, other.at((400, 3, 2)), tight=tight)

turn = [0.6, 0.8, 0, 0, -0.8, 0.6, 0, 0, 0, 0, 1, 0.1]
shapes, other = [gjk.Box((1, 1, 1)), gjk.Support(unit, reach=1), gjk.Cylinder(1, 1)], gjk.Box((3, 2, 1), pose=turn)
for i in range(3):
    deep = shapes[i]
    for _ in range(100):
        deep = (gjk.Sum, gjk.Hull)[i % 2](gjk.Box((1, 1, 1)), deep, pose=turn)
    shapes.append(deep)
threading.stack_size(256 * 1024)
thread = threading.Thread(target=work)
thread.start()
thread.join()
"""


def test_the_stack_that_a_thread_should_have():
    """As README.md has it."""
    done = subprocess.run([sys.executable, "-c", SMALL], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")

# SPDX-License-Identifier: MIT
"""Makes panda.json: a Franka Panda at a table and a shelf, at 27 joint configurations.

    python make_panda.py [OUT]

The arm, its joints and its collision shapes come from the URDF in example-robot-data. The configurations are found
from one seed: some anywhere, some reaching into the shelf, some with the fingers closed on a thing or a fingertip
on a surface. No link passes through a thing by more than TOUCH."""

import importlib.metadata
import itertools
import math
import pathlib
import sys
import typing

import coal
import numpy as np
import pinocchio as pin
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

import scene

SEED = 20
NEAR = 0.15  # a pair is in the scene when its shapes are this near: what a broad phase would pass on
TOUCH = 0.001  # how deep a shape may stand in another and still count as touching it
FINGER_END = 0.0095  # from the tip's frame on to the fingers' ends
JOINT_STEP = 1e-4  # configurations are rounded, so that the search's last bits do not matter


# ---- the surroundings: name, shape, position, rotation vector ----

FLOOR, TABLE, BOARDS = -0.4, 0.1, (-0.12, 0.22, 0.56, 0.90)
SHELF_X, SHELF_Y, THICK = (0.56, 0.86), 0.42, 0.01


def box(*half):
    return {"shape": "box", "half": scene.lengths(half)}


def rod(kind, *sizes):
    return {"shape": kind} | dict(zip(("r", "half_length"), scene.lengths(sizes), strict=True))


def surroundings():
    mid_x, half_x = sum(SHELF_X) / 2, (SHELF_X[1] - SHELF_X[0]) / 2
    top = BOARDS[-1]
    ball = {"shape": "sphere", "r": scene.lengths([0.06])[0]}
    lemon = {"shape": "ellipsoid", "radii": scene.lengths((0.045, 0.03, 0.03))}
    yield "floor", box(1.5, 1.5, 0.02), (0, 0, FLOOR - 0.02), None
    yield "pedestal", box(0.17, 0.14, -FLOOR / 2), (-0.03, 0, FLOOR / 2), None

    yield "table/top", box(0.4, 0.27, 0.015), (0.15, -0.64, TABLE - 0.015), None
    leg = (TABLE - 0.03 - FLOOR) / 2
    for n, (x, y) in enumerate([(-0.22, -0.88), (0.52, -0.88), (-0.22, -0.40), (0.52, -0.40)]):
        yield f"table/leg{n}", box(0.025, 0.025, leg), (x, y, FLOOR + leg), None

    for n, z in enumerate(BOARDS):
        yield f"shelf/board{n}", box(half_x, SHELF_Y, THICK), (mid_x, 0, z - THICK), None
    for name, side in (("left", 1), ("right", -1)):
        height = (top - FLOOR) / 2
        yield f"shelf/{name}", box(half_x, THICK, height), (mid_x, side * (SHELF_Y + THICK), FLOOR + height), None
    yield "shelf/back", box(THICK, SHELF_Y, (top - FLOOR) / 2), (SHELF_X[1] + THICK, 0, (top + FLOOR) / 2), None

    low, middle, high = BOARDS[:3]
    yield "thing/carton", box(0.05, 0.032, 0.10), (0.65, 0.14, middle + 0.10), (0, 0, 0.12)
    yield "thing/parcel", box(0.09, 0.07, 0.06), (0.72, -0.27, middle + 0.06), (0, 0, -0.21)
    yield "thing/bottle", rod("cylinder", 0.036, 0.09), (0.63, -0.02, middle + 0.09), None
    yield "thing/bottleneck", rod("cylinder", 0.013, 0.035), (0.63, -0.02, middle + 0.215), None
    yield "thing/book", box(0.08, 0.012, 0.11), (0.72, 0.3336, high + 0.1126), (0.15, 0, 0)
    yield "thing/crate", box(0.10, 0.12, 0.07), (0.71, -0.10, high + 0.07), (0, 0, 0.05)
    yield "thing/ball", ball, (0.70, 0.15, high + 0.06), None
    yield "thing/bin", box(0.11, 0.15, 0.09), (0.71, 0.15, low + 0.09), (0, 0, -0.08)

    yield "thing/brick", box(0.055, 0.027, 0.035), (0.25, -0.52, TABLE + 0.035), (0, 0, 0.4)
    yield "thing/mug", rod("cylinder", 0.04, 0.05), (0.02, -0.60, TABLE + 0.05), None
    yield "thing/cone", rod("cone", 0.05, 0.09), (0.40, -0.62, TABLE + 0.09), None
    yield "thing/pen", rod("capsule", 0.006, 0.06), (0.20, -0.70, TABLE + 0.006), (0, math.pi / 2, 0)
    yield "thing/lemon", lemon, (0.10, -0.47, TABLE + 0.03), (0, 0, 1)


# ---- the robot ----


class Robot:
    """The model, its collision shapes by short name, and which of them are joined."""

    def __init__(self):
        distribution = importlib.metadata.distribution("example-robot-data")
        share = pathlib.Path(distribution.locate_file("cmeel.prefix/share")).resolve()
        urdf = str(share / "example-robot-data/robots/panda_description/urdf/panda.urdf")
        self.model = pin.buildModelFromUrdf(urdf)
        self.data = self.model.createData()
        self.tip = self.model.getFrameId("panda_hand_tcp")
        geometry = pin.buildGeomFromUrdf(self.model, urdf, pin.GeometryType.COLLISION, package_dirs=[str(share)])
        self.parts = {self.short(part.name): part for part in geometry.geometryObjects}
        self.shapes = {name: self.shape(part.geometry) for name, part in self.parts.items()}

    @staticmethod
    def short(name):
        link, number = name.removeprefix("panda_").rsplit("_", 1)
        return f"{link}.{number}" if "finger" in link else link

    @staticmethod
    def shape(geometry):
        if isinstance(geometry, coal.Box):
            return box(*geometry.halfSide)
        points = np.unique(geometry.vertices(), axis=0)
        points = points[np.sort(ConvexHull(points).vertices)]
        if not np.array_equal(points, points.astype(np.float32)):
            raise ValueError("the meshes are no longer in single precision")
        return {"shape": "points", "points": (points + 0.0).tolist()}

    def joined(self, a, b):
        """Shapes of one link, or of two links with one joint between them."""
        if a not in self.parts or b not in self.parts:
            return False
        first, second = (self.parts[n].parentJoint for n in (a, b))
        return first == second or first == self.model.parents[second] or second == self.model.parents[first]

    def placed(self, q):
        pin.forwardKinematics(self.model, self.data, q)
        return {name: self.data.oMi[part.parentJoint] * part.placement for name, part in self.parts.items()}

    def at(self, joints, opening):
        limits = self.model.lowerPositionLimit, self.model.upperPositionLimit
        return np.clip(np.round(np.append(joints, [opening, opening]) / JOINT_STEP) * JOINT_STEP, *limits)

    def reach(self, target, joints):
        """Joints that bring the tip to the target, by damped least squares; None where they do not get there."""
        lower, upper = self.model.lowerPositionLimit[:7], self.model.upperPositionLimit[:7]
        for _ in range(200):
            q = np.append(joints, [0, 0])
            pin.computeJointJacobians(self.model, self.data, q)
            error = pin.log6(pin.updateFramePlacement(self.model, self.data, self.tip).actInv(target)).vector
            if np.linalg.norm(error) < 1e-9:
                return joints
            jacobian = pin.getFrameJacobian(self.model, self.data, self.tip, pin.LOCAL)[:, :7]
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-6 * np.eye(6), error)
            joints = np.clip(joints + np.clip(step, -0.3, 0.3), lower, upper)
        return None


# ---- how near two shapes are: a plausibility check, not a truth ----


def solid(shape):
    kind = shape["shape"]
    if kind == "points":
        return coal.Convex.convexHull(points_vector(shape["points"]), False, "")
    if kind == "box":
        return coal.Box(*(2 * h for h in shape["half"]))
    if kind == "sphere":
        return coal.Sphere(shape["r"])
    if kind == "ellipsoid":
        return coal.Ellipsoid(*shape["radii"])
    return getattr(coal, kind.capitalize())(shape["r"], 2 * shape["half_length"])


def points_vector(points):
    vector = coal.StdVec_Vec3s()
    vector.extend(np.array(p) for p in points)
    return vector


def gap(a, b):
    (solid_a, pose_a), (solid_b, pose_b) = a, b
    transforms = [coal.Transform3s(p.rotation, p.translation) for p in (pose_a, pose_b)]
    return coal.distance(solid_a, transforms[0], solid_b, transforms[1], coal.DistanceRequest(), coal.DistanceResult())


# ---- the configurations ----


def facing(approach, across):
    """The rotation whose z is the approach and whose y, along which the fingers open, is across."""
    z = np.array(approach, float) / np.linalg.norm(approach)
    y = np.array(across, float) - z * np.dot(across, z)
    y /= np.linalg.norm(y)
    return np.column_stack([np.cross(y, z), y, z])


# The hand is the same from both sides, but the wrist's limits are not.
HALF_TURN = pin.SE3.Identity(), pin.SE3(np.diag([-1.0, -1, 1]), np.zeros(3))


class Wish(typing.NamedTuple):
    """What to do: where the tip is to be (None: anywhere), and how far each finger is out. The nearest thing is to be
    between least and most away."""

    target: pin.SE3 | None
    opening: float
    least: float = -TOUCH
    most: float = math.inf
    wobble: float = 0.0  # how far the target may be turned, about each axis


def wishes():
    ahead, down = np.array([1.0, 0, 0]), np.array([0, 0, -1.0])
    aside, dipping = np.array([0, 1.0, 0]), np.array([1, 0, -0.3])
    for _ in range(6):
        yield Wish(None, 0.02)
    for _ in range(4):  # what a planner would turn down
        yield Wish(None, 0.03, least=-math.inf, most=-0.005)
    # Into the shelf, at any roll.
    for y, z in ((0.26, 0.36), (-0.16, 0.40), (-0.28, 0.44), (0.24, 0.10), (-0.20, 0.06), (0.22, 0.74), (-0.25, 0.72)):
        yield Wish(pin.SE3(facing(ahead, aside), np.array([0.64, y, z])), 0.03, wobble=0.6)
    # The fingers closed on the carton, the bottle, the brick and the mug.
    carton, brick = Rotation.from_rotvec([[0, 0, 0.12], [0, 0, 0.4]]).as_matrix()
    yield Wish(pin.SE3(facing(carton @ dipping, carton @ aside), np.array([0.625, 0.137, 0.33])), 0.032)
    yield Wish(pin.SE3(facing(dipping, aside), np.array([0.62, -0.02, 0.33])), 0.036)
    yield Wish(pin.SE3(facing(down, brick @ aside), np.array([0.25, -0.52, 0.15])), 0.027)
    yield Wish(pin.SE3(facing(down, ahead), np.array([0.02, -0.60, 0.19])), 0.04)
    # The fingers' ends on the table, and 0.01 mm above it; between the fingers, a third of a millimetre.
    for x, y, above in ((0.10, -0.80, 0.0), (0.32, -0.44, 1e-5), (-0.08, -0.5, 0.0)):
        across = (math.cos(30 * x), math.sin(30 * x), 0)
        yield Wish(pin.SE3(facing(down, across), np.array([x, y, TABLE + FINGER_END + above])), 0.0002)
    # Closed, within a centimetre of a board or of what stands on it.
    for x, y, z in ((0.62, 0.25, 0.235), (0.62, -0.13, 0.2312), (0.585, 0.0, 0.60)):
        yield Wish(pin.SE3(facing(dipping, aside), np.array([x, y, z])), 0.0)


class Search:
    def __init__(self):
        self.robot = Robot()
        self.solids = {name: solid(shape) for name, shape in self.robot.shapes.items()}
        self.moving = [name for name, part in self.robot.parts.items() if part.parentJoint > 0]
        self.shapes, self.things = dict(self.robot.shapes), {}
        for name in self.robot.parts.keys() - self.moving:
            self.things[name] = self.solids[name], self.robot.parts[name].placement
        for name, shape, position, turn in surroundings():
            rotation = Rotation.from_rotvec(turn or (0, 0, 0)).as_matrix()
            self.shapes[name] = shape
            self.things[name] = solid(shape), pin.SE3(rotation, np.array(position, float))

    def gaps(self, q):
        """(a, b, gap) for each moving shape and each other shape, where the two are not joined."""
        place = self.robot.placed(q)
        bodies = {name: (self.solids[name], place[name]) for name in self.moving} | self.things
        for a, b in itertools.combinations(bodies, 2):
            if a in self.moving and not self.robot.joined(a, b):
                yield a, b, gap(bodies[a], bodies[b])

    def configurations(self):
        """(q, gaps), one for each wish."""
        rng = np.random.default_rng(SEED)
        limits = self.robot.model.lowerPositionLimit[:7], self.robot.model.upperPositionLimit[:7]
        for wish in wishes():
            for attempt in range(2000):
                joints = rng.uniform(*limits)
                if wish.target is not None:
                    turn = Rotation.from_rotvec(rng.uniform(-wish.wobble, wish.wobble, 3)).as_matrix()
                    turned = wish.target * pin.SE3(turn, np.zeros(3)) * HALF_TURN[attempt % 2]
                    joints = self.robot.reach(turned, joints)
                if joints is None:
                    continue
                q = self.robot.at(joints, wish.opening)
                gaps = list(self.gaps(q))
                if wish.least < min(distance for _, _, distance in gaps) < wish.most:
                    yield q, gaps
                    break
            else:
                raise RuntimeError(f"no configuration found for {wish}")

    def resting(self):
        """Things that stand on, lean on or are fixed to each other."""
        for a, b in itertools.combinations(self.things, 2):
            if gap(self.things[a], self.things[b]) < TOUCH:
                yield [a, b]


def build():
    search = Search()
    bodies = [body(name, name, place) for name, (_, place) in search.things.items()]
    pairs = list(search.resting())
    for number, (q, gaps) in enumerate(search.configurations()):
        names = {name: name for name in search.things} | {name: f"q{number:02d}/{name}" for name in search.moving}
        place = search.robot.placed(q)
        bodies += [body(names[name], name, place[name]) for name in search.moving]
        pairs += [[names[a], names[b]] for a, b, distance in gaps if distance < NEAR]
    return {
        "name": "panda",
        "dim": 3,
        "units": "metre",
        "licence": "Apache-2.0",
        "source": "Franka Panda of franka_description, from the PyPI package example-robot-data "
        + importlib.metadata.version("example-robot-data")
        + "; hulls of its collision meshes. Everything around it is made up. See licences/panda.txt.",
        "queries": ["distance", "intersect"],
        "shapes": search.shapes,
        "bodies": bodies,
        "pairs": pairs,
    }


def body(name, shape, place):
    return {"name": name, "shape": shape, "pose": scene.pose(place.rotation, place.translation)}


if __name__ == "__main__":
    beside = pathlib.Path(__file__).with_name("panda.json")
    scene.write(sys.argv[1] if len(sys.argv) > 1 else beside, build())

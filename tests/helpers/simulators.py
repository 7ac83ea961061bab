"""What simulators read in exported files, each asked by its own interface: counts, gaps of loops, places of links.

A simulator is a function that reads a file and returns what it read. Values of joints are those of the file: numbers
of hinges and slides, rotations (3, 3) of balls; `rests` are those at which the file stands.
"""

import logging
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from scipy.spatial.transform import Rotation

from assur.export.bodies import bodies
from assur.export.mjcf import mjcf, printed
from assur.model.mechanism import MechanismRecord

Values = Mapping[str, Any]
MECHANISMS = ("fivebar", "delta_4s", "zeng2019", "gough_stewart", "orthoglide")
"""Those of the table in the documentation."""


@dataclass(frozen=True)
class Reading:
    """What was read of an MJCF file.

    Attributes:
        constraints: how many.
        actuators: how many; None where the simulator's models have none.
        gap: of joint values, the largest distance in m, along an axis, of two points that a constraint ties together.
    """

    constraints: int
    actuators: int | None
    gap: Callable[[Values], float]


def mujoco_reading(path: Path, rests: Values) -> Reading:
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT

    def gap(values: Values) -> float:
        for name, value in values.items():
            at = model.joint(name).qposadr[0]
            if np.ndim(value):
                x, y, z, w = Rotation.from_matrix(value).as_quat()
                data.qpos[at : at + 4] = w, x, y, z
            else:
                data.qpos[at] = value
        mujoco.mj_fwdPosition(model, data)
        return float(np.max(np.abs(data.efc_pos), initial=0.0))

    return Reading(model.neq, model.nu, gap)


def drake_reading(path: Path, rests: Values) -> Reading:
    from pydrake.all import MathematicalProgram, MultibodyPlant, Parser
    from pydrake.multibody.inverse_kinematics import AddMultibodyPlantConstraints

    logging.getLogger("drake").setLevel(logging.ERROR)  # it says what it leaves out: sites, the time step, the key
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModels(str(path))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    program = MathematicalProgram()
    unknowns = program.NewContinuousVariables(plant.num_positions())
    bindings = AddMultibodyPlantConstraints(plant, unknowns, program, context)
    found = [item.evaluator() for item in bindings]
    ties = [one for one in found if np.array_equal(one.lower_bound(), one.upper_bound())]  # not the limits of joints

    def gap(values: Values) -> float:
        for name, value in values.items():
            joint = plant.GetJointByName(name)
            if np.ndim(value):
                joint.set_angles(context, Rotation.from_matrix(value).as_euler("xyz"))
            else:
                (joint.set_angle if joint.type_name() == "revolute" else joint.set_translation)(context, value)
        places = plant.GetPositions(context)
        away = [tie.Eval(places) - tie.lower_bound() for tie in ties]
        return float(np.max(np.abs(np.concatenate(away)), initial=0.0))

    return Reading(plant.num_constraints(), plant.num_actuators(), gap)


def pinocchio_reading(path: Path, rests: Values) -> Reading:
    import pinocchio

    model, points, frames = pinocchio.buildModelAndConstraintsFromMJCF(str(path))
    data = model.createData()

    def gap(values: Values) -> float:
        place = pinocchio.neutral(model)
        for name, value in values.items():
            at = model.joints[model.getJointId(name)].idx_q
            if np.ndim(value):
                place[at : at + 4] = Rotation.from_matrix(value).as_quat()
            else:
                place[at] = value
        pinocchio.forwardKinematics(model, data, place)
        ends = [
            [data.oMi[joint].act(frame.translation) for joint, frame in sides]
            for sides in (
                ((tie.joint1_id, tie.joint1_placement), (tie.joint2_id, tie.joint2_placement)) for tie in points
            )
        ]
        return float(max(np.max(np.abs(one - other)) for one, other in ends))

    return Reading(len(points) + len(frames), None, gap)


def newton_reading(path: Path, rests: Values) -> Reading:
    newton, warp = _newton()
    builder = newton.ModelBuilder()
    newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
    builder.add_mjcf(str(path))
    model = builder.finalize(device="cpu")
    counts = model.custom_frequency_counts
    numbers = {label.rpartition("/")[2]: k for k, label in enumerate(builder.joint_label)}
    starts = model.joint_q_start.numpy()
    loops = np.flatnonzero(model.joint_articulation.numpy() < 0)
    ends = [
        (links.numpy()[loops], frames.numpy()[loops])
        for links, frames in ((model.joint_parent, model.joint_X_p), (model.joint_child, model.joint_X_c))
    ]

    def gap(values: Values) -> float:
        place = model.joint_q.numpy()
        for name, value in values.items():
            at = starts[numbers[name]]
            if np.ndim(value):
                place[at : at + 4] = Rotation.from_matrix(value).as_quat()
            else:
                place[at] = value - rests[name]
        state = model.state()
        newton.eval_fk(model, warp.array(place, dtype=float, device="cpu"), model.joint_qd, state)
        poses = state.body_q.numpy()
        points = [
            np.array([_moved(poses, link, frame[:3]) for link, frame in zip(links, frames, strict=True)])
            for links, frames in ends
        ]
        return float(np.max(np.abs(points[0] - points[1]), initial=0.0))

    return Reading(counts["mujoco:equality_constraint"], counts["mujoco:actuator"], gap)


def _newton() -> tuple[Any, Any]:
    import newton
    import warp

    warp.config.quiet = True
    # a hinge's two points are two joints of one pair of bodies, of which it warns
    warnings.filterwarnings("ignore", message="Adding a BALL joint between")
    # nor has it room in single precision for the nominal bodies of a mechanism of 1 mm
    warnings.filterwarnings("ignore", message="Inertia validation corrected")
    return newton, warp


def _moved(poses: np.ndarray, link: int, point: np.ndarray) -> np.ndarray:
    """A point of a link, or of the world, in the world."""
    if link < 0:
        return point
    return np.asarray(poses[link, :3] + Rotation.from_quat(poses[link, 3:]).apply(point))


SIMULATORS = {
    "MuJoCo": ("mujoco", mujoco_reading),
    "Newton": ("newton", newton_reading),
    "Drake": ("drake", drake_reading),
    "Pinocchio": ("pin", pinocchio_reading),
}
"""Name -> its package, and what reads an MJCF file."""

CLOSED = {"MuJoCo": 1e-9, "Newton": 1e-5, "Drake": 1e-9, "Pinocchio": 1e-9}
"""The largest gap of a closed loop, as a share of the characteristic length; Newton computes with single precision."""

SCREWS = {"MuJoCo": True, "Newton": True, "Drake": False, "Pinocchio": False}
"""Whether it reads what ties the turn of a screw to its advance."""


def file_values(record: MechanismRecord, joint_values: np.ndarray) -> dict[str, Any]:
    """Our joint values (n,) as those of the MJCF file."""
    steps = printed(record, bodies(record)).steps.values()
    return {
        step.name: step.rotation(joint_values) if step.kind == "ball" else float(step.value(joint_values))
        for step in steps
    }


def written(record: MechanismRecord) -> tuple[int, int]:
    """How many constraints and actuators stand in the MJCF file."""
    root = ElementTree.fromstring(mjcf(record))
    return len(root.findall("equality/*")), len(root.findall("actuator/*"))


def head(versions: Mapping[str, str]) -> str:
    """The first line of the table of the documentation."""
    names = " | ".join(f"{name} {versions[package]}" for name, (package, _) in SIMULATORS.items())
    return f"| MJCF | written | {names} |"


def row(name: str, counts: tuple[int, int], readings: Mapping[str, Reading]) -> str:
    """One line of it: constraints + actuators, as written and as each simulator reads them."""
    cells = [
        f"{one.constraints}" if one.actuators is None else f"{one.constraints} + {one.actuators}"
        for one in readings.values()
    ]
    return f"| `{name}` | {counts[0]} + {counts[1]} | {' | '.join(cells)} |"


def installed_versions() -> dict[str, str]:
    """Package -> version, of the simulators."""
    return {package: version(package) for package, _ in SIMULATORS.values()}


# ---- URDF, a tree: where each link stands when every joint is at zero, and how many values its joints have ----------

Tree = tuple[int, dict[str, tuple[np.ndarray, np.ndarray]]]
"""Number of values, and the frames of links: orientation (3, 3) and origin (3,) in m."""


def mujoco_tree(path: Path) -> Tree:
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    names = [model.body(k).name for k in range(1, model.nbody)]
    return model.nv, {name: (data.body(name).xmat.reshape(3, 3), data.body(name).xpos) for name in names}


def drake_tree(path: Path) -> Tree:
    from pydrake.all import MultibodyPlant, Parser

    plant = MultibodyPlant(0.0)
    (instance,) = Parser(plant).AddModels(str(path))
    bodies_ = [plant.get_body(index) for index in plant.GetBodyIndices(instance)]
    plant.WeldFrames(plant.world_frame(), bodies_[0].body_frame())  # else Drake lets the base float
    plant.Finalize()
    context = plant.CreateDefaultContext()
    poses = {body.name(): plant.EvalBodyPoseInWorld(context, body) for body in bodies_}
    return plant.num_velocities(), {k: (pose.rotation().matrix(), pose.translation()) for k, pose in poses.items()}


def pinocchio_tree(path: Path) -> Tree:
    import pinocchio

    model = pinocchio.buildModelFromUrdf(str(path))
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, pinocchio.neutral(model))
    links = [(k, frame.name) for k, frame in enumerate(model.frames) if frame.type == pinocchio.BODY]
    return model.nv, {name: (data.oMf[k].rotation, data.oMf[k].translation) for k, name in links}


def newton_tree(path: Path) -> Tree:
    newton, _ = _newton()
    builder = newton.ModelBuilder()
    builder.add_urdf(str(path))
    model = builder.finalize(device="cpu")
    state = model.state()
    newton.eval_fk(model, model.joint_q, model.joint_qd, state)
    poses = dict(zip((label.rpartition("/")[2] for label in builder.body_label), state.body_q.numpy(), strict=True))
    return model.joint_dof_count, {
        name: (Rotation.from_quat(pose[3:]).as_matrix(), pose[:3]) for name, pose in poses.items()
    }


TREES = {"MuJoCo": mujoco_tree, "Newton": newton_tree, "Drake": drake_tree, "Pinocchio": pinocchio_tree}
"""Name -> what reads a URDF file."""

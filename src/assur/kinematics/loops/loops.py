"""Every assembly at given inputs, or at a given pose, loop by loop; and by what right these are all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.joint_graph.tree import joint_graph
from assur.joint_graph.turns import turn_relations
from assur.kinematics import border
from assur.kinematics.closure import assemble
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.limbs.solving import LimbSolutions
from assur.kinematics.loops.alike import alike_merged
from assur.kinematics.loops.circles import System, joint_values, system
from assur.kinematics.loops.hinges import HingeTurn, NoAssemblyError, NotCirclesError, Stiff, middle
from assur.kinematics.loops.orientations import Turning, turnings
from assur.kinematics.loops.parallelograms import crossed_parallelograms, parallelograms
from assur.kinematics.loops.solving import DOUBTFUL, CurveError, Solved, solve
from assur.kinematics.modes import Problem
from assur.kinematics.search import search
from assur.kinematics.turns import lasting_relations, told_by_turns, with_turns_of_home
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, has_quaternion
from assur.numerics import rotations
from assur.work import stage

FloatArray = NDArray[np.float64]


UPRIGHT = 1e-9
"""Cosine of theta below which phi and psi turn about one axis."""
OPEN = "the pose leaves the platform's tilt open"


@dataclass(frozen=True, eq=False)
class LoopSolutions:
    """Assemblies that were found loop by loop.

    Attributes:
        joints: (K, n) joint values, in lengths and rad.
        complete: whether these are all assemblies, as far as `right` says.
        right: by what right they are all, or why they are not known to be; one sentence.
        searched: roots that were looked at, complex ones too.
        kept: names of the parallelograms that are taken to stay such.
        limbs: where any way of each limb goes with any of the others, these (`LimbSolutions`).
    """

    joints: FloatArray
    complete: bool
    right: str
    searched: int
    kept: tuple[str, ...] = ()
    limbs: tuple[LimbSolutions, ...] = ()


@stage("loops solved in turn")
def solve_by_loops(
    record: MechanismRecord, inputs: ArrayLike | None = None, *, pose: ArrayLike | None = None, crossed: bool = False
) -> LoopSolutions:
    """Every assembly at printed inputs (n,), or at a pose (m,), the loops solved one after another.

    Where every link turns about one direction, or not at all, the loops are linear equations in points on circles;
    so they are with rods, which are points on spheres, and platforms on three ball joints, which are triangles. They
    are solved in the order of the mechanism's Assur chains, each for all its complex roots at once.

    Args:
        record: the mechanism.
        inputs: printed, in lengths and rad; the direct problem.
        pose: the inverse problem.
        crossed: whether parallelograms may cross over; otherwise they stay such.

    Example: the planar five-bar.

    >>> from assur.model.registry import load_record
    >>> found = solve_by_loops(load_record("fivebar"), np.radians([127.0, 53.0]))
    >>> len(found.joints), found.complete
    (2, True)
    >>> found.right
    'its loops in turn, each for all its roots: B1 and B2 (2)'
    """
    if (inputs is None) == (pose is None):
        raise UsageError("solve_by_loops: give either inputs or a pose")
    if inputs is not None:
        given = border.checked(inputs, border.input_names(record), f"inputs of {record.name}")
    else:
        given = border.checked_poses(record, pose if pose is not None else ())
    if given.ndim != 1:
        raise UsageError(f"solve_by_loops: one problem at a time, not a batch of shape {given.shape[:-1]}")
    question = PositionQuestion(record, "direct" if inputs is not None else "inverse", given)
    if not crossed:
        return _at_once(question, frozenset(parallelograms(record)))
    return _with_crossed(question)


@dataclass(frozen=True, eq=False)
class PositionQuestion:
    """Printed inputs (n,) or a pose (m,), as what is locked or where the platform is."""

    record: MechanismRecord
    problem: Problem
    given: FloatArray

    @property
    def locked(self) -> dict[int, float]:
        """Index in the joint values -> value."""
        if self.problem == "inverse":
            return {}
        held = border.held_inputs(self.record, self.record.home, self.given)
        inputs = {index: float(held[index]) for index in self.record.input_indices}
        return inputs | told_by_turns(self.record, inputs)

    @property
    def place(self) -> dict[str, float]:
        """Coordinates of the platform's point."""
        if self.problem == "direct":
            return {}
        named = zip(self.record.platform.pose, self.given, strict=True)
        return {name: float(value) for name, value in named if name in LENGTHS}

    @cached_property
    def orientations(self) -> Sequence[Stiff | HingeTurn | None]:
        """All in which the pose lets the platform stand; None where it gives no angle.

        Where it leaves one angle open, the platform turns about one direction: R = Rot(axis, angle) after.
        """
        platform = self.record.platform
        named = dict(zip(platform.pose, self.given, strict=True)) if self.problem == "inverse" else {}
        if not named.keys() & {*ANGLES, *QUATERNION}:
            return [None]
        links = self.record.base, platform.link
        if has_quaternion(platform.pose):
            return [Stiff(*links, rotations.from_quaternion(np.array([named[name] for name in QUATERNION])))]
        if named.keys().isdisjoint(ANGLES[1:]) and _upright(self.record):
            first = [named["phi"] - rotations.to_angles(way)[0] for way in _upright(self.record)]
            upright = zip(first, _upright(self.record), strict=True)
            return [Stiff(*links, rotations.from_angles(phi, np.zeros(()), np.zeros(())) @ way) for phi, way in upright]
        phi, theta, psi = (np.asarray(named.get(name, 0.0)) for name in ANGLES)
        after = rotations.from_angles(phi, theta, psi)
        axes = {"phi": (0.0, 0.0, 1.0), "theta": (-np.sin(phi), np.cos(phi), 0.0), "psi": after[:, 0]}
        left = [np.asarray(axes[name]) for name in ANGLES if name not in named]
        return [HingeTurn(*links, after, left[0]) if len(left) == 1 else Stiff(*links, after)]

    @property
    def tilt_open(self) -> bool:
        """Whether the pose leaves two angles of the platform open, which are taken as zero, and so do the joints."""
        named = len({*ANGLES} & {*self.record.platform.pose})
        return self.problem == "inverse" and named == 1 and not _upright(self.record)

    def closed(self, starts: FloatArray) -> FloatArray:
        """The starts (N, n) that are assemblies, each once, closed to rounding."""
        if not len(starts):
            return starts
        if self.problem == "direct":
            found = assemble(self.record, starts, held=self.record.input_indices)
        else:
            found = assemble(self.record, starts, poses=self.given)
        return self.once(found.values[found.closed])

    def once(self, joints: FloatArray) -> FloatArray:
        """Joint values (N, n) without repetition, angles within one turn where turns do not count."""
        held = self.record.input_indices if self.problem == "direct" else ()
        turned, same = with_turns_of_home(self.record, joints, held)
        return turned[same][distinct(self.record, turned[same])]


@lru_cache(maxsize=64)
def _upright(record: MechanismRecord) -> list[FloatArray]:
    """C of each way in which the joints let the platform turn, Rot(z, psi) C; none where it turns otherwise too."""
    try:
        ways = turnings(record, {}, None, parallel=tuple(parallelograms(record)))
    except NotCirclesError:
        return []
    platforms = [way[record.platform.link] for way in ways]
    return [one.rotation for one in platforms] if all(map(_about_vertical, platforms)) else []


def _about_vertical(turning: Turning) -> bool:
    """Whether a link turns about the vertical alone, and its angle phi is one."""
    upright = np.array([0.0, 0.0, 1.0])
    turns = turning.axis is not None and turning.hinge is None and np.allclose(turning.axis, upright, rtol=0, atol=1e-9)
    return bool(turns and np.linalg.norm(turning.rotation[:2, 0]) > UPRIGHT)


def staying_parallel(names: Sequence[str]) -> str:
    """What is said of parallelograms that are taken to stay such.

    >>> staying_parallel(["Pa1", "Pa2"])
    '; Pa1 and Pa2 stay parallel'
    """
    return f"; {' and '.join(names)} stay{'s' if len(names) == 1 else ''} parallel" if names else ""


def _at_once(question: PositionQuestion, parallel: frozenset[str]) -> LoopSolutions:
    """The assemblies in which these parallelograms stay such."""
    record = question.record
    kept = tuple(name for name in parallelograms(record) if name in parallel)
    note = staying_parallel(kept)
    if parallel & {*crossed_parallelograms(record, home_values(record))}:
        return unsolved(record, False, "not proved, since a parallelogram is crossed at home")
    ways, error = [], None
    for orientation in question.orientations:
        try:
            ways += turnings(record, question.locked, orientation, parallel=parallel)
        except NoAssemblyError as contradiction:
            error = contradiction
        except NotCirclesError as other:
            return unsolved(record, False, f"not proved, since the loops are no system of circles and spheres: {other}")
    if not ways:
        if question.tilt_open:
            return unsolved(record, False, f"not proved, since {OPEN}: with those taken as zero {error}")
        return replace(unsolved(record, True, f"there is no assembly: {error}{note}"), kept=kept)
    parts = [_standing(question, way) for way in ways]
    told = dict.fromkeys(part.right for part in parts)
    # a way whose loops stop closing tells a beginning of what another tells
    right = " or ".join(own for own in told if not any(other != own and other.startswith(own) for other in told))
    if len(parts) > 1:
        right += f", in each of {len(parts)} ways in which links that do not turn can stand"
    right += note
    if len(turn_relations(record)):
        right += "; screws have the turns of home"
    complete = all(part.complete for part in parts)
    joints = question.once(np.concatenate([part.joints for part in parts]))
    return LoopSolutions(joints, complete, right, sum(part.searched for part in parts), kept)


def _standing(question: PositionQuestion, turning: Mapping[str, Turning]) -> LoopSolutions:
    """The assemblies in which links stand in one way."""
    record = question.record
    told = _told_screws(record, turning, question.locked)
    locked = question.locked | told
    try:
        equations = system(record, turning, locked, question.place)
    except NotCirclesError as error:
        return unsolved(record, False, f"not proved, since the loops are no system of circles and spheres: {error}")
    try:
        equations, found = _solved(equations)
    except NotCirclesError as error:
        return unsolved(record, False, f"not proved: {error}")
    except CurveError as error:
        names = _names(equations)
        listed = " and ".join(names[number] for number in error.groups)
        nearly = "nearly " if error.error else ""
        return unsolved(record, False, f"not proved, since {listed} {nearly}have infinitely many values, real or not")
    starts = joint_values(equations, found.unknowns, locked)
    order = np.argsort(found.bent, kind="stable")
    kept = order[distinct(record, starts[order])]  # a rod may stand in two ways in which no joint is elsewhere
    starts, bent = starts[kept], found.bent[kept]
    joints = question.closed(starts)
    right = _right(equations, found)
    if told:
        screws = " and ".join(record.coordinates[index].joint for index in told)
        right += f"; {screws} within half a turn of home's, since each turn more is another solution"
    if question.tilt_open:
        return LoopSolutions(joints, False, f"not proved, since {OPEN}: {right}", found.looked)
    sure = bent <= DOUBTFUL
    if not sure.all() and len(question.closed(starts[sure])) < len(joints):
        return LoopSolutions(joints, False, f"not proved, since roots are too near to tell them: {right}", found.looked)
    return LoopSolutions(joints, True, right, found.looked)


def _told_screws(
    record: MechanismRecord, turning: Mapping[str, Turning], locked: Mapping[int, float]
) -> dict[int, float]:
    """Index -> value, next to home's, of screws between links that stand in known orientations.

    Not of screws whose turns another joint counts: those have one value, which need not be next to home's.
    """
    told, slices = {}, joint_graph(record).slices
    for name, joint in record.joints.items():
        near, far, index = turning[joint.parent], turning[joint.child], slices[name].start
        free = joint.type.screw and index not in locked and near.still and far.still
        if free and not np.any(lasting_relations(record)[:, index]):
            turned = rotations.to_vector(near.rotation.T @ far.rotation @ joint.turn.T) @ joint.axes[0]
            home = home_values(record)[index]
            told[index] = float(home + rotations.nearest_turn(turned - home))
    return told


def _solved(equations: System) -> tuple[System, Solved]:
    """Solved as they are, else with circles that are one taken as one."""
    try:
        return equations, solve(equations)
    except CurveError:
        merged = alike_merged(equations)
        try:
            return merged, solve(merged)
        except NotCirclesError:
            pass
        raise


def _with_crossed(question: PositionQuestion) -> LoopSolutions:
    """Crossed assemblies too: at once where that can be, else with some parallelograms kept, and by a search."""
    record = question.record
    names = tuple(parallelograms(record))
    whole = _at_once(question, frozenset())
    if whole.complete or not names:
        return whole
    parts = [_at_once(question, frozenset(names) - {name}) for name in names]
    more = search(record, question.problem, question.given)
    joints = question.once(np.concatenate([*(part.joints for part in parts), more.joints]))
    proved = [name for name, part in zip(names, parts, strict=True) if part.complete]
    right = f"not proved: found from {more.starts} starts"
    if proved:
        alone = " or ".join(proved)
        right += (
            f"; those in which nothing is crossed, or {alone} alone, are all, since their loops were solved in turn"
        )
    return LoopSolutions(joints, False, right, more.starts + sum(part.searched for part in parts))


def unsolved(record: MechanismRecord, complete: bool, right: str) -> LoopSolutions:
    """No assemblies: there are none, or they are not known, as `right` says."""
    return LoopSolutions(np.zeros((0, len(record.coordinates))), complete, right, 0)


def _right(equations: System, solved: Solved) -> str:
    names = _names(equations)
    sets = [f"{' and '.join(names[number] for number in group.groups)} ({group.roots})" for group in solved.sets]
    return (
        f"its loops in turn, each for all its roots: {', then '.join(sets)}" if sets else "its loops, which are linear"
    )


def _names(equations: System) -> Mapping[int, str]:
    """UnknownGroup -> the joint that slides, or the first that turns its link."""
    names: dict[int, str] = {}
    rods = [number for number, group in enumerate(equations.groups) if group.kind == "rod"]
    balls = [number for number, group in enumerate(equations.groups) if group.kind == "ball"]
    circles = {group.circle // 2: number for number, group in enumerate(equations.groups) if group.kind == "circle"}
    triangles = [number for number, group in enumerate(equations.groups) if group.kind == "triangle"]
    sliders = {number: group.name for number, group in enumerate(equations.groups) if group.kind == "slider"}
    for joint in equations.record.joints.values():
        for link in (joint.child, joint.parent, middle(joint)):
            turning = equations.turnings.get(link, Turning(np.eye(3)))
            if turning.triangle is not None:
                names.setdefault(triangles[turning.triangle], link)
            elif turning.ball is not None:
                names.setdefault(balls[turning.ball], joint.name)
            elif turning.rod is not None:
                names.setdefault(rods[turning.rod], joint.name)
            elif turning.circle in circles:
                names.setdefault(circles[turning.circle], joint.name)
    return names | sliders

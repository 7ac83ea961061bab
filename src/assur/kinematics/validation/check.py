"""What only the closed joint graph tells of a file: whether it moves, as its inputs, pose and limits claim."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from assur.errors import KeyPath, MechanismFileError, Problem
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.home import home_values, without_loops
from assur.kinematics.limits import Limit, limits
from assur.kinematics.loops.parallelograms import crossed_parallelograms
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.architecture import self_motion_dimension
from assur.kinematics.rates.finite_motion import classify_at
from assur.kinematics.rates.restraint import WELL, restraint
from assur.kinematics.rates.velocity import velocity_map_at
from assur.kinematics.status import Status
from assur.kinematics.turns import periodic, unwrapped
from assur.kinematics.validation.claims import Claims, axis_name, claims
from assur.kinematics.validation.freedoms import freedom_problems, pose_problems
from assur.kinematics.validation.gaps import gap_problems
from assur.model.file.place import input_place, place, problem, table_place
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.work import stage

SMALLEST, LARGEST = 1e-3, 50.0
"""A mechanism smaller or larger than this, in metres, has probably its lengths in another unit."""

METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
TINY = 1 / 500
"""A length below this share of the longest may be in another unit."""

TURNS = 1e-6
"""A platform whose angular velocity, of a motion of size one, stays below this keeps its orientation."""

AWAY, AWAY_OF_LENGTH = float(np.radians(1.0)), 0.01
"""A stated home value is noted that is further from the closed one: an angle, a share of the characteristic length."""
MOST_AWAY = 3

ROUND = 1e-7
"""Home may stand on a bound: beyond it by this (rad, or share of the characteristic length) is not outside."""


@lru_cache(maxsize=64)
@stage("soundness of the joint graph")
def faults(record: MechanismRecord) -> tuple[Problem, ...]:
    """Faults of a mechanism whose file reads well: loops that do not close, no freedom, too few or too many inputs,
    inputs or a pose that say the same twice, a constant orientation that turns, a home beyond its limits or in which a
    parallelogram is none.

    All that do not follow from one another, in the order of the file.

    >>> from assur.model.registry import load_record
    >>> faults(load_record("zeng2019"))
    ()
    """
    if not joint_graph(record).cut:
        return (without_loops(record),)
    gaps = () if record.overrides else gap_problems(record)
    if gaps:
        return _ordered(gaps)
    here = claims(record)
    found = freedom_problems(record, here)
    if here.moving:
        found += [*pose_problems(record, here), *_orientation(record, here)]
    return _ordered([*found, *_limits(record), *_parallelograms(record)])


def _ordered(problems: list[Problem] | tuple[Problem, ...]) -> tuple[Problem, ...]:
    return tuple(sorted(problems, key=lambda problem: problem.line or 0))


def check(record: MechanismRecord) -> None:
    """Raise `MechanismFileError` with every fault, if there is one.

    >>> from assur.model.registry import load_record
    >>> check(load_record("fivebar"))
    """
    found = faults(record)
    if found:
        raise MechanismFileError(found)


def doubts(record: MechanismRecord) -> tuple[Problem, ...]:
    """What is no fault but probably not meant: a mechanism of the size of a pin or of a house, a length that is tiny
    against the others, a home of many turns, one that is singular or holds its platform badly, one from which the loops
    close only far off, a workspace box without home in it.

    >>> from assur.model.registry import load_record
    >>> doubts(load_record("zeng2019"))
    ()
    """
    return _ordered(
        [*_size(record), *_tiny(record), *_turns(record), *_away(record), *_box(record), *_singular(record)]
    )


def _size(record: MechanismRecord) -> list[Problem]:
    length = characteristic_length(record)
    size = length * METRES[record.unit]
    if SMALLEST <= size <= LARGEST:
        return []
    hint = f"is it {'m' if size < SMALLEST else 'mm'} that is meant?"
    found = f"the longest link measures {length:.3g} {record.unit}, that is {size:.3g} m"
    return [problem(record, ("unit",), found, f"it is unusual, but may be: {SMALLEST:g} m to {LARGEST:g} m", hint)]


def _tiny(record: MechanismRecord) -> list[Problem]:
    length = characteristic_length(record)
    return [
        problem(
            record,
            ("parameters", name, "value"),
            f"{item.value:.4g} {item.unit}, where the longest link measures {length:.4g} {record.unit}",
            "it is unusual, but may be",
            f"is it in another unit than {item.unit}?",
        )
        for name, item in record.parameters.items()
        if item.unit == record.unit and 0 < abs(item.value) < TINY * length
    ]


def _turns(record: MechanismRecord) -> list[Problem]:
    found: list[Problem] = []
    for item in record.coordinates:
        if periodic(record)[item.index] and abs(record.home[item.index]) > 4 * np.pi:
            turns = record.home[item.index] / (2 * np.pi)
            hint = "are the angles in deg?" if record.angle == "rad" else ""
            text = f"{record.coordinate_label(item)} begins at {turns:.3g} turns"
            found.append(problem(record, place(record, "home", item.joint), text, "it is unusual, but may be", hint))
    return _one_each(found)


def closes_far_off(record: MechanismRecord) -> bool:
    """Whether the loops close by more than a degree, or a hundredth of the longest link, from the file's home.

    >>> from assur.model.registry import load_record
    >>> closes_far_off(load_record("zeng2019"))
    False
    """
    return bool(_away(record))


def _away(record: MechanismRecord) -> list[Problem]:
    """Home values of the file that are not those of the assembly to which the loops close from them."""
    if record.overrides:  # whose home is not the file's
        return []
    home, length = home_values(record), characteristic_length(record)
    angular = np.array([item.kind == "angle" for item in record.coordinates])
    turned = unwrapped(record, home - record.home)
    share = np.abs(turned) / np.where(angular, AWAY, AWAY_OF_LENGTH * length)
    largest = [int(index) for index in np.argsort(-share, kind="stable") if share[index] > 1][:MOST_AWAY]
    if not largest:
        return []
    told = [
        f"{record.coordinate_label(record.coordinates[index])} = "
        f"{_rounded(record, record.home[index] + turned[index], angular=bool(angular[index]))}, "
        f"the file says {_rounded(record, record.home[index], angular=bool(angular[index]))}"
        for index in largest
    ]
    hint = "is it the assembly that is meant?"
    path = table_place(record, "home")
    return [
        problem(record, path, f"the loops close at {'; '.join(told)}", "values near an assembled configuration", hint)
    ]


def _box(record: MechanismRecord) -> list[Problem]:
    """Sides of the workspace box beyond which home stands: then all of it may be out of reach."""
    home = dict(zip(record.platform.pose, pose_of(record, home_values(record)).tolist(), strict=True))
    found = []
    for name, (low, high) in record.box.items():
        angular = is_angle(name)
        spare = ROUND * (1.0 if angular else characteristic_length(record))
        if not low - spare <= home[name] <= high + spare:
            own, least, most = (quantity_text(record, item, _kind(angular)) for item in (home[name], low, high))
            text, hint = f"home has {name} = {own}, outside {least} to {most}", "look for the workspace about home"
            found.append(problem(record, ("workspace", "box", name), text, "it is unusual, but may be", hint))
    return found


def _singular(record: MechanismRecord) -> list[Problem]:
    """A home that is singular where the mechanism in general is not."""
    status = Status(int(classify_at(record, home_values(record))))
    if status <= Status.near_singular or self_motion_dimension(record):
        return _badly_held(record) if status <= Status.near_singular else []
    hint = "paths from home that hold the inputs, or the pose, may not begin there: is there a regular one nearby?"
    path = table_place(record, "home")
    return [problem(record, path, f"home is singular: {status.name}", "it is unusual, but may be", hint)]


def _badly_held(record: MechanismRecord) -> list[Problem]:
    """A home at which what holds the platform is nearly singular, in its constraints or with its inputs held."""
    held = restraint(record, home_values(record))
    if self_motion_dimension(record):
        return []
    if held.condition <= WELL:
        return _badly_conditioned(record)
    turn, move = held.weakest[:3, None], held.weakest[3:, None]
    turns = np.linalg.norm(turn) > np.linalg.norm(move)
    most = f"turns about {axis_name(turn)}" if turns else f"moves along {axis_name(move)}"
    text = f"with inputs held, the platform nearly {most}: condition number {held.condition:.0f} of what holds it"
    hint = "are axes of several legs parallel to one plane, or their forces to one line? turn some, or tilt home"
    return [problem(record, table_place(record, "home"), text, f"it is unusual, but may be: up to {WELL:g}", hint)]


def _badly_conditioned(record: MechanismRecord) -> list[Problem]:
    """A home at which inputs move the platform much better in one direction than in another."""
    condition = float(velocity_map_at(record, home_values(record)).condition)
    if condition <= WELL:
        return []
    text = f"the condition number at home is {condition:.0f}"
    hint = "is home near the end of a leg's reach, or are lengths in another unit?"
    return [problem(record, table_place(record, "home"), text, f"it is unusual, but may be: up to {WELL:g}", hint)]


def _orientation(record: MechanismRecord, claims: Claims) -> list[Problem]:
    turning = claims.motion.twists[..., :3, :]
    if record.platform.orientation != "constant" or float(np.max(np.abs(turning), initial=0.0)) <= TURNS:
        return []
    found = f'"constant", but the platform turns as it moves, about {axis_name(turning)}'
    hint = "leave it out; or which axes should be parallel, which rods equally long?"
    path: KeyPath = ("platform", "orientation")
    return [problem(record, path, found, '"constant" only where it keeps its orientation', hint)]


def _parallelograms(record: MechanismRecord) -> list[Problem]:
    """Parallelograms of rods on balls that are none where the loops close: nothing holds what they join parallel.

    Four hinges can only cross over, which is an assembly of its own.
    """
    rods = {name for name, group in record.generalised.items() if group.kind != "P(4R)"}
    skew = rods.intersection(crossed_parallelograms(record, home_values(record))) if rods else ()
    hint = "if what it joins may turn, its rods are bars by themselves, each S S or U S in the notation"
    found, allowed = "no parallelogram at home", "a parallelogram where the loops close"
    return _one_each([problem(record, place(record, "generalised", name), found, allowed, hint) for name in skew])


def _limits(record: MechanismRecord) -> list[Problem]:
    """Home against limits and cones of joints and strokes of inputs; of repeated limbs the first that is out."""
    home = home_values(record)
    length = characteristic_length(record)
    written = [float(limit.value(record.home)) for limit in limits(record, record.home)]
    return _one_each(
        [
            _outside(record, limit, float(limit.value(home)), before)
            for limit, before in zip(limits(record, home), written, strict=True)
            if float(limit.margin(home)) < -ROUND * (1.0 if limit.angular else length)
        ]
    )


def _outside(record: MechanismRecord, limit: Limit, value: float, written: float) -> Problem:
    kind, name = limit.what, limit.of
    joint = record.coordinates[limit.index].joint
    unit_kind = _kind(limit.angular)
    own, low, high = (quantity_text(record, item, unit_kind) for item in (value, limit.low, limit.high))
    inside = limit.low <= written <= limit.high
    hint = (
        f"the file's home has {quantity_text(record, written, unit_kind)}; from there the loops close at {own}"
        if inside
        else ""
    )
    if kind == "cone":
        path = (*place(record, "joints", joint), "cone")
        found = f"home tilts {joint} by {own}, out of its cone of {high}"
        hint = hint or "the cone's axis has the same components in both frames: is it the middle of the motion?"
        return problem(record, path, found, "a home inside", hint)
    if kind == "stroke":
        path = (*input_place(record, record.coordinates[limit.index]), "stroke")
    else:
        path = (*place(record, "joints", joint), "limits")
    found = f"home has {name} = {own}, outside {low} to {high}"
    return problem(record, path, found, "a home inside", hint)


def _rounded(record: MechanismRecord, value: float, *, angular: bool) -> str:
    """To four digits of the file's unit, which is finer than a home needs."""
    return quantity_text(record, value, _kind(angular), digits=4)


def _kind(angular: bool) -> str:
    return "angle" if angular else "length"


def _one_each(problems: list[Problem]) -> list[Problem]:
    """Of several problems at one place, as the limbs of a template have, the first."""
    return list({item.path: item for item in reversed(problems)}.values())[::-1]

"""What legs miss, against plain geometry of each leg alone."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.closure import assemble
from assur.kinematics.following.following import follow
from assur.kinematics.pose import pose_of
from assur.numerics import rotations
from assur.view import missing
from assur.view.explain import explain, listed
from assur.view.missing import Miss, _sense, misses
from catalogue import each


def _told(record, pose):
    return {item.leg: (item.amount, item.sense) for item in misses(record, record.home_values, np.array(pose))}


def _same(found, amounts, within=1e-3):
    """Which legs miss, by how much, and that the worst is told first."""
    wanted = {leg: amount for leg, amount in amounts.items() if amount > 1e-6}
    assert set(found) == set(wanted)
    for leg, amount in wanted.items():
        assert found[leg][0] == pytest.approx(amount, rel=within)
    told = [amount for amount, _ in found.values()]
    assert told == sorted(told, reverse=True) or np.ptp(told) < 1e-6 * max(told)


@pytest.mark.parametrize("turn", np.arange(7) * 0.9 + 0.1)
@pytest.mark.parametrize("reach", [60.0, 330.0, 420.0])
def test_each_leg_of_a_fivebar_misses_by_what_its_two_circles_say(reach, turn):
    pose = [reach * np.cos(turn), reach * np.sin(turn)]
    found = _told(assur.load("fivebar"), pose)
    away = {"leg1": np.hypot(pose[0] + 70.0, pose[1]), "leg2": np.hypot(pose[0] - 70.0, pose[1])}
    _same(found, {leg: max(item - 294.0, 94.0 - item, 0.0) for leg, item in away.items()})
    for leg, (_, sense) in found.items():
        assert sense == ("too short" if away[leg] > 294.0 else "too long")


@pytest.mark.parametrize("pose", [(230.0, 0.0, 0.0), (100.0, 190.0, 0.7), (-40.0, 250.0, -1.0)])
def test_each_leg_of_a_3rrr_misses_by_the_distance_of_its_ends(pose):
    record = assur.load("planar_3rrr")
    x, y, phi = pose
    amounts = {}
    for k in range(3):
        way = 2 * np.pi * k / 3
        foot = 200.0 * np.array([np.cos(way), np.sin(way)])
        end = np.array([x, y]) + 60.0 * np.array([np.cos(way + phi), np.sin(way + phi)])
        amounts[f"leg{k + 1}"] = max(float(np.linalg.norm(end - foot)) - 220.0, 0.0)
    assert sum(amount > 0 for amount in amounts.values()) > 0
    _same(_told(record, pose), amounts)


@pytest.mark.parametrize("pose", [(0.0, 0.0, -2.0), (0.9, 0.3, -1.4), (-1.2, 0.8, -1.0), (0.0, 0.0, 1.9)])
def test_each_leg_of_a_delta_misses_by_its_rod_from_the_circle_of_its_knee(pose):
    record = assur.load("delta_4s")
    size = {name: item.value for name, item in record.parameters.items()}
    turns = np.linspace(0.0, 2 * np.pi, 200_001)
    amounts = {}
    for k, degrees in enumerate((-90.0, 30.0, 150.0)):
        out = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0.0])
        knees = size["wB"] * out + size["L"] * (np.cos(turns)[:, None] * out + np.sin(turns)[:, None] * [0, 0, 1.0])
        away = np.linalg.norm(np.array(pose) + size["uP"] * out - knees, axis=1)
        amounts[f"leg{k + 1}"] = max(float(np.min(away)) - size["l"], 0.0)
    _same(_told(record, pose), amounts)


def test_of_limbs_that_share_a_bar_the_pair_is_named():
    """Far down all four arms of the robot hang, and their rods after them; the file knows them as two chains."""
    record = assur.load("h4_robot")
    found = misses(record, record.home_values, np.array([0.0, 0.0, -1000.0, 0.0]))
    assert [item.leg for item in found] == ["pair1", "pair2"]
    assert {item.sense for item in found} == {"too short"}


@pytest.mark.parametrize("name", each())
def test_where_every_leg_reaches_none_misses(name):
    record = assur.load(name)
    home = np.array(record.home_values)
    away = assemble(record, home + 0.01 * np.sin(np.arange(len(home))), near=True)
    assert bool(away.closed)
    assert misses(record, home, pose_of(record, away.values)) == ()


def _never_closed(near):
    """`assemble` that says "not closed" of the steps, or of the first assembly."""

    def found(record, start, **options):
        there = assemble(record, start, **options)
        return replace(there, closed=np.array(False)) if options.get("near", False) is near else there

    return found


@pytest.mark.parametrize(
    ("name", "value"),
    [("STEPS", 2), ("assemble", _never_closed(near=False)), ("assemble", _never_closed(near=True))],
    ids=["too few steps", "the start is not closed", "no step is taken"],
)
def test_where_the_least_is_not_found_no_amount_is_said(monkeypatch, name, value):
    record, pose = assur.load("fivebar"), np.array([0.0, 300.0])
    path = follow(record, record.home_values, poses=pose)
    monkeypatch.setattr(missing, name, value)
    assert misses(record, record.home_values, pose) == ()
    assert str(explain(path, pose)) == f"serial singularity: {path.stopped.meaning}"


def test_where_no_foot_can_be_moved_the_push_is_the_least(monkeypatch):
    """A step that promises nothing is the last, whatever the assembly after it would have given by rounding."""

    def nearer(record, start, **options):
        there = assemble(record, start, **options)
        return replace(there, values=there.values * 0.999) if options.get("near") else there

    monkeypatch.setattr(missing, "assemble", nearer)
    monkeypatch.setattr(missing, "null_space", lambda matrix, **_: np.zeros((matrix.shape[1], 0)))
    assert len(_told(assur.load("fivebar"), [0.0, 300.0])) == 2


@pytest.mark.parametrize(
    ("degrees", "said"),
    [(0, "too short"), (44, "too short"), (47, "off"), (90, "off"), (133, "off"), (136, "too long")],
)
def test_a_leg_is_short_or_long_along_its_way_and_off_to_the_side(degrees, said):
    """45.6 deg is where 0.7 of the push lies along the line."""
    way = np.array([3.0, 4.0, 0.0])
    assert _sense(0.1 * rotations.from_vector(np.radians([0.0, 0.0, degrees])) @ way, way) == said


@pytest.mark.parametrize(("count", "more"), [(0, ""), (1, ""), (3, ""), (4, ", and 1 more"), (5, ", and 2 more")])
def test_three_are_named_and_the_others_counted(count, more):
    said = listed("mm", [Miss(f"leg{k}", 10.0 - k, "off") for k in range(count)])
    names = [f"leg{k} is {10 - k} mm off" for k in range(min(count, 3))]
    assert said == ", ".join(names) + more

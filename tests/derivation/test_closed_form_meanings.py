"""What margins and factors are said to mean is so: measured on the joint graph's own frames, and at places drawn."""

import re
import shutil
from functools import lru_cache

import numpy as np
import pytest

from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.derivation import derive
from assur.derivation.factor_meanings import FactorMeanings
from assur.derivation.reach_meanings import ReachMeanings
from assur.derivation.solution import analytic_solution
from assur.joint_graph.frames import frames
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.pose import LENGTHS
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains

AXES = dict(zip("xyz", np.eye(3), strict=True))
NAMES = ("zeng2019", "fivebar", "orthoglide", *(pytest.param(name, marks=pytest.mark.deep) for name in (
    "delta_4s", "tsai_platform", "planar_3rpr", "planar_3rrr", "three_rrc", "linear_delta_4s")))  # fmt: skip


def poses_about(record, number=24):
    """Poses (number, m) about home."""
    home = pose_of(record, home_values(record))
    scales = np.array([0.1 * np.max(np.abs(home)) if name in LENGTHS else 0.2 for name in record.platform.pose])
    return home + scales * np.random.default_rng(4).uniform(-1.0, 1.0, (number, len(home)))


@lru_cache
def derived(name, folder):
    """The record of a mechanism with its derived form."""
    shutil.copy(load_record(name).file, folder / "mechanism.toml")
    (folder / "closed_form.py").write_text(derive(load_record(name)).closed_form(), encoding="utf-8")
    return load_record(folder)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the derived form of the seed is written."""
    return tmp_path_factory.mktemp("derived")


def links_named(record, text):
    """The links that a phrase names, in its order."""
    found = {}
    for name, group in record.generalised.items():
        if "parallelogram" in text and (place := text.find(name)) >= 0:
            joint = record.joints[group.joints[0]]
            found[place] = joint.child if joint.child != group.child else joint.parent
    for match in re.finditer(r"([a-z]+) (\d+)?(?: ?of limb (\d+))?", text):
        part, number, limb = match.groups()
        for name in (f"{part}{number}", f"leg{limb}.{part}"):
            if name in record.links:
                found[match.start()] = name
    return [found[place] for place in sorted(found)]


def line(record, placed, link):
    """Where a link points (3,): from its first joint to the last, or along its slider."""
    own = [joint for joint in record.joints.values() if link in (joint.parent, joint.child)]
    ends = [placed[link][0] @ (joint.at if joint.parent == link else joint.child_at) for joint in own]
    apart = ends[-1] - ends[0]
    return apart if np.any(apart) else placed[link][0] @ own[-1].axes[0]


def measured(record, text, values):
    """What vanishes where a phrase holds, by the frames of an assembly alone."""
    placed = frames(record, np.array([*values.values()]))
    lines = [line(record, placed, link) for link in links_named(record, text)]
    axis = re.search(r"(?:along|across) ([xyz])$", text)
    if axis:
        across = [np.cross(own, AXES[axis[1]]) if "along" in text else own @ AXES[axis[1]] for own in lines]
        return max(float(np.linalg.norm(own)) for own in across)
    if "axis of its turns" in text:
        rod, arm = lines
        (joint,) = [own for own in record.joints.values() if own.child == links_named(record, text)[1]]
        return float(np.dot(placed[joint.parent][0] @ joint.axes[0], np.cross(arm, rod)))
    if "axis of" in text:
        joint = record.joints[text.rpartition(" ")[2]]
        return float(lines[0] @ placed[joint.parent][0] @ joint.axes[0])
    if "meet in one point" in text:
        places = [record.joints[name] for name in re.findall(r" at ([\w.]+)", text)]
        platform = record.platform.link
        points = [placed[platform][0] @ (own.at if own.parent == platform else own.child_at) for own in places]
        rows = [[*own[:2], np.cross(at, own)[2]] for own, at in zip(lines, points, strict=True)]
        return float(np.linalg.det(rows))
    if text.endswith("are parallel"):
        return float(np.linalg.norm(np.cross(*lines)))
    assert text.endswith("parallel to one plane"), text
    return float(np.dot(lines[0], np.cross(lines[1], lines[2])))


@pytest.mark.parametrize("name", NAMES)
def test_a_factor_is_its_meaning_at_every_assembly_by_the_frames_of_the_joint_graph(name, tmp_path):
    record = derived(name, tmp_path)
    listed = [entry for entry in record.closed_form.factor_list if entry.kind != "other"]  # of a determinant
    told = [entry for entry in listed if entry.meaning != "it never vanishes"]
    assert told
    solutions = [own for pose in poses_about(record) for own in inverse(record, pose, method="closed form")]
    for entry in told:
        values = np.array([own.factors[entry.name] for own in solutions])
        if entry.meaning == "link 9 and link 10 are parallel":  # in one sense, which a product of vectors does not tell
            values = values * np.array([own.factors["f2"] for own in solutions])
        geometry = np.array([measured(record, entry.meaning, own.joints) for own in solutions])
        zero = np.abs(values) < 1e-9
        assert np.all(np.abs(geometry[zero]) < 1e-6 * np.max(np.abs(geometry)))
        share = np.abs(geometry[~zero] / values[~zero])
        assert len(share) > 10
        assert np.ptp(share) < 1e-6 * np.max(share), entry


def radicands(name, problem):
    """What it is said to mean that each radicand is negative."""
    return [own.text for own in ReachMeanings(analytic_solution(load_record(name), problem)).radicands.values()]


def test_radicands_say_what_does_not_reach():
    assert radicands("zeng2019", "direct") == [
        "B1 and B2 are too far apart for link 9 and link 10 to meet at link 11",
        "B3a and C3a are too far apart along y for parallelogram Pa1",
        "D1 and D3a are too far apart or too near for link 12 and parallelogram Pa2 to meet at platform",
    ]
    assert radicands("fivebar", "direct") == ["B1 and B2 are too far apart for rod 1 and rod 2 to meet"]
    assert radicands("orthoglide", "inverse")[0] == (
        "leg1.Da and leg1.Ea are too far apart, seen along x, for parallelogram leg1.Pa"
    )


@pytest.mark.parametrize(("inputs", "said"), [
    ((0.0, -900.0, 0.0), "B1 and B2 are too far apart for link 9 and link 10 to meet at link 11"),
    ((100.0, -140.0, 900.0), "B3a and C3a are too far apart along y for parallelogram Pa1"),
])  # fmt: skip
def test_the_derived_form_says_what_fails_as_the_geometry_has_it(inputs, said, folder):
    record = derived("zeng2019", folder)
    (failure,) = direct(record, np.array(inputs), method="closed form").failures
    assert failure.meaning == said


def test_where_circles_coincide_the_platform_moves_on_the_curves_of_the_hand_written_form(folder):
    record, written = derived("zeng2019", folder), load_record("zeng2019")
    inputs = np.array([0.0, -140.0, 0.0])
    curves = [direct(own, inputs, method="closed form").curves for own in (record, written)]
    assert len(curves[0]) == len(curves[1]) == 8
    assert {own.parameter for own in curves[0]} == {"gamma"}
    for first, second in zip(*curves, strict=True):
        assert np.allclose(first.interval, second.interval, rtol=0, atol=1e-9)
        assert np.allclose(first.poses(9), second.poses(9), rtol=0, atol=1e-5)


def draft(chains, path):
    path.write_text(drafted(parse_chains(chains), path).text, encoding="utf-8")
    return load_record(path)


def told(chains, path):
    """What the factors of a draft mean."""
    inverse = analytic_solution(draft(chains, path), "inverse")
    meanings, formulas = FactorMeanings(inverse), ClosedFormFormulas(inverse, inverse, {})
    return [meanings.of(value, kind).text for _, kind, value in formulas.factors]


def test_factors_of_slides_and_of_the_platforms_own_line_are_told(tmp_path):
    assert told(["P[y] R[z] R[z]", "R[z] P[x]"], tmp_path / "slide.toml") == [
        "the linkB of limb a1 and the slide of b1.E are at right angles",
        "b1.D and the platform's point are as near as the offset of platform",
        "the linkB of limb a1 lies along x",
    ]
    assert told(["R[z] P[x] R[z]", "R[z] R[z]"], tmp_path / "point.toml")[1:] == [
        "the line from b1.E to the platform's point and the linkD of limb b1 are parallel",
        "a1.A and a1.C coincide",
    ]


def test_a_distance_of_the_platforms_joints_is_told_where_it_must_not_vanish(tmp_path):
    solution = analytic_solution(draft(["R[z] P[x] R[z]", "R[z] R[z]"], tmp_path / "joints.toml"), "direct")
    ((condition, part),) = [(own, part) for part in solution.sets for own in part.conditions]
    assert ReachMeanings(solution).condition(part, condition).text == "a1.C and b1.E coincide"

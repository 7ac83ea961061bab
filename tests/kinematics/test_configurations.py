"""What counts as one configuration: legs whose slides lie beside the line of their joints, and rods through a pivot."""

import numpy as np
import pytest

import assur
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.position import direct, inverse
from assur.kinematics.search import search
from assur.numerics import rotations

FEET = np.array([[1.0, 0.1, 0.0], [-0.5, 0.9, 0.1], [-0.6, -0.8, -0.1]])
TIPS = np.array([[0.5, 0.3, 1.2], [-0.5, 0.4, 1.1], [0.1, -0.5, 1.25]])


def tripod(tmp_path, end, beside=0.0, drawn=0.0):
    """A platform that turns about a point, on three legs with slides `beside` their lines, `drawn` elsewhere.

    A slide points to the tip of its leg at joint values zero, where it has none of its offset.
    """
    joints = ['O = {type = "spherical", parent = "base", child = "table"}']
    for k, (foot, tip) in enumerate(zip(FEET, TIPS, strict=True), 1):
        along = (tip - foot) / np.linalg.norm(tip - foot)
        across = np.cross(along, [1.0, 0.3, 0.0])
        across /= np.linalg.norm(across)
        other = np.cross(along, across)
        first = (
            f'type = "universal", axes = [{[*across.tolist()]}, {[*other.tolist()]}]'
            if end == "U"
            else 'type = "spherical"'
        )
        ahead = (drawn * across).tolist()
        joints += [
            f'A{k} = {{{first}, parent = "base", child = "barrel{k}", at = {foot.tolist()}}}',
            f'B{k} = {{type = "prismatic", parent = "barrel{k}", child = "rod{k}", axis = {along.tolist()},'
            f" at = {ahead}, child_at = {ahead}}}",
            f'C{k} = {{type = "spherical", parent = "rod{k}", child = "table", '
            f"at = {(beside * other).tolist()}, child_at = {tip.tolist()}}}",
        ]
    lengths = [float(np.linalg.norm(tip - foot)) for foot, tip in zip(FEET, TIPS, strict=True)]
    links = ["base", "table", *(f"{part}{k}" for k in (1, 2, 3) for part in ("barrel", "rod"))]
    path = tmp_path / "tripod.toml"
    path.write_text(
        'format = 1\nname = "tripod"\nunit = "m"\nangle = "rad"\nbase = "base"\n'
        'platform = {link = "table", pose = ["phi", "theta", "psi"]}\n[links]\n'
        + "\n".join(f"{link} = {{}}" for link in links)
        + "\n[joints]\n"
        + "\n".join(joints)
        + "\n[inputs]\n"
        + "\n".join(f'B{k} = {{name = "B{k}"}}' for k in (1, 2, 3))
        + "\n[home]\n"
        + "\n".join(
            f"A{k} = {[0.0] * (2 if end == 'U' else 3)}\nB{k} = {length}\nC{k} = [0, 0, 0]"
            for k, length in enumerate(lengths, 1)
        )
        + "\nO = [0, 0, 0]"
    )
    return assur.load(path)


def ways_of_a_leg(record, k, tip):
    """Strokes and states of the universal joint that take a leg's tip to a place: by trigonometry alone."""
    foot, slide, end = (record.joints[f"{letter}{k}"] for letter in "ABC")
    (first, second), along, off = foot.axes, slide.axes[0], end.at
    to = tip - foot.at
    square = to @ to - off @ off + (off @ along) ** 2
    ways = []
    for stroke in (np.sqrt(square) - off @ along, -np.sqrt(square) - off @ along):
        arm = off + stroke * along
        still, cosine = (first @ second) * (second @ arm), first @ arm - (first @ second) * (second @ arm)
        sine = first @ np.cross(second, arm)
        size = np.hypot(cosine, sine)
        if abs(first @ to - still) <= size:
            about = np.arctan2(sine, cosine)
            ways += [(stroke, about + turn * np.arccos((first @ to - still) / size)) for turn in (1, -1)]
    return ways


def test_a_leg_with_its_slide_beside_its_line_has_two_ways_for_each_stroke(tmp_path):
    record = tripod(tmp_path, "U", beside=0.3)
    pose = np.array([0.1, -0.15, 0.2])
    turned = rotations.from_angles(*pose)
    ways = [ways_of_a_leg(record, k, turned @ tip) for k, tip in enumerate(TIPS, 1)]
    answer = inverse(record, pose)
    assert (answer.complete, len(answer)) == (True, np.prod([len(own) for own in ways]))
    assert [len(own) for own in ways] == [4, 4, 4]
    seconds = [
        next(c.index for c in record.coordinates if (c.joint, c.component) == (f"A{k}", "second")) for k in (1, 2, 3)
    ]
    for k, own in enumerate(ways):
        strokes, turns = answer.joints[:, record.input_indices[k]], answer.joints[:, seconds[k]]
        for stroke, turn in own:
            same = (np.abs(strokes - stroke) < 1e-7) & (np.abs(np.exp(1j * turns) - np.exp(1j * turn)) < 1e-7)
            assert np.sum(same) == len(answer) // len(own)


def test_each_of_these_ways_has_a_name_of_its_own_that_only_singularities_change(tmp_path):
    """A leg's determinant is its arm along the slide times the same along the normal of its universal joint's axes."""
    record = tripod(tmp_path, "U", beside=0.3)
    names: dict[tuple[bool, ...], str] = {}
    for pose in ([0.1, -0.15, 0.2], [-0.3, 0.1, 0.1]):
        turned = rotations.from_angles(*pose)
        for solution in inverse(record, np.array(pose)):
            sides = []
            for k, tip in enumerate(TIPS, 1):
                foot, slide = record.joints[f"A{k}"], record.joints[f"B{k}"]
                first, second = solution.joints[f"A{k}.first"], solution.joints[f"A{k}.second"]
                cross = rotations.about_axis(foot.axes[0], first)
                rod = cross @ rotations.about_axis(foot.axes[1], second) @ slide.axes[0]
                arm = turned @ tip - foot.at
                sides += [arm @ rod > 0, arm @ np.cross(foot.axes[0], cross @ foot.axes[1]) > 0]
            assert names.setdefault(tuple(sides), solution.mode) == solution.mode
    assert len(names) == len({*names.values()}) == 64
    assert not any(mode.strip("+-") for mode in names.values())


def test_where_on_its_line_a_slide_is_drawn_says_nothing(tmp_path):
    pose = np.array([0.1, -0.15, 0.2])
    for drawn in (0.0, 0.2):
        record = tripod(tmp_path, "U", drawn=drawn)
        answer = inverse(record, pose)
        assert (answer.complete, len(answer)) == (True, 8)
        assert len(search(record, "inverse", pose).joints) == 8


def test_a_leg_that_spins_has_one_way_for_each_stroke_wherever_its_slide_is(tmp_path):
    record = tripod(tmp_path, "S", beside=0.3)
    pose = np.array([0.1, -0.15, 0.2])
    answer = inverse(record, pose)
    assert (answer.complete, len(answer)) == (True, 8)
    assert len(search(record, "inverse", pose).joints) == 8


@pytest.mark.parametrize("beside", [0.0, 0.2])
def test_a_rod_through_a_pivot_passes_it_in_either_sense(tmp_path, beside):
    """A crank's rod slides through a pivot: its two ways put no joint elsewhere."""
    path = tmp_path / "pivot.toml"
    path.write_text(f"""
format = 1
name = "pivot"
unit = "m"
angle = "rad"
base = "base"
platform = {{ link = "crank", point = [1, 0, 0], pose = ["phi"] }}
[links]
base = {{}}
crank = {{}}
rod = {{}}
eye = {{}}
[joints]
A = {{ type = "revolute", parent = "base", child = "crank", axis = "z" }}
B = {{ type = "revolute", parent = "crank", child = "rod", axis = "z", at = [1, 0, 0] }}
C = {{ type = "prismatic", parent = "eye", child = "rod", axis = "x", child_at = [0, {beside}, 0] }}
D = {{ type = "revolute", parent = "base", child = "eye", axis = "z", at = [3, 0, 0] }}
[inputs]
A = {{ name = "A" }}
[home]
A = 0.5
B = -0.7
C = -2.2
D = -0.2
""")
    record = assur.load(path)
    answer = direct(record, [0.7])
    assert (answer.complete, len(answer), [solution.mode for solution in answer]) == (True, 2, ["+", "-"])
    strokes = np.sort(answer.joints[:, 2])
    away = np.hypot(3 - np.cos(0.7), np.sin(0.7))
    assert np.allclose(strokes, [-np.sqrt(away**2 - beside**2), np.sqrt(away**2 - beside**2)])
    assert len(distinct(record, np.concatenate([answer.joints, home_values(record)[None]]))) == 3

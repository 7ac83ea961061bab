"""What the joint graph says of a file, told exactly, by `assur check` and where the mechanism is first used alike.

The four-bar is made for exact numbers: its crank (30) and rocker (105) stand upright on the ground (100), the coupler
(125) leads 100 along and 75 up, so that its home closes without a step.
"""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.errors import MechanismFileError
from assur.joint_graph.frames import frames
from assur.kinematics.closure import closure_error
from assur.kinematics.home import home_values
from assur.kinematics.validation.check import check, doubts, faults
from assur.kinematics.validation.gaps import loops
from assur.model.dimensions import with_parameters
from assur.model.file.reader import read_text
from assur.model.registry import load_record, names

TESTS = Path(__file__).parents[2]
FOUR = """format = 1
name = "four"
unit = "mm"
angle = "deg"
base = "ground"
platform = { link = "coupler", point = [100, 75, 0], pose = ["x"] }
[parameters]
crank = { value = 30 }
rocker = { value = 105 }
ground = { value = 100 }
[links]
ground = {}
arm = {}
coupler = {}
rod = {}
[joints]
A = { type = "revolute", parent = "ground", child = "arm", axis = "z" }
B = { type = "revolute", parent = "arm", child = "coupler", at = ["crank", 0, 0], axis = "z" }
C = { type = "revolute", parent = "coupler", child = "rod", at = [100, 75, 0], child_at = ["rocker", 0, 0], axis = "z" }
D = { type = "revolute", parent = "ground", child = "rod", at = ["ground", 0, 0], axis = "z" }
[inputs]
A = { name = "q", stroke = [0, 180] }
[home]
A = 90
B = -90
C = 90
D = 90
"""
DELTA = (TESTS / "model" / "file" / "delta.toml").read_text(encoding="utf-8")
RRR = (Path(assur.__file__).parent / "mechanisms" / "planar_3rrr" / "mechanism.toml").read_text(encoding="utf-8")
NEAR = "allowed: values near an assembled configuration"
SIDE = "allowed: no side longer than the others together"
EACH = "allowed: one input for each freedom"
HOME = "allowed: a home inside"
NOTE = "allowed: it is unusual, but may be"
CONE = "the cone's axis has the same components in both frames: is it the middle of the motion?"
TWO = (
    FOUR.replace("rod = {}", "rod = {}\nslide = {}\nrod1 = {}\nrod2 = {}").replace(
        "[inputs]\n",
        'G = { type = "prismatic", parent = "ground", child = "slide", at = [0, 175, 0], axis = "x" }\n'
        'H = { type = "revolute", parent = "slide", child = "rod1", axis = "z" }\n'
        'K = { type = "revolute", parent = "rod1", child = "rod2", at = [50, 0, 0], axis = "z" }\n'
        'L = { type = "revolute", parent = "coupler", child = "rod2", at = [100, 75, 0], child_at = [50, -70, 0], '
        'axis = "z" }\n[inputs]\nG = { name = "p" }\n',
    ).replace('["x"]', '["x", "y"]').replace('link = "coupler", point = [100, 75, 0]', 'link = "rod2"')
    + "G = 0\nH = 0\nK = 0\nL = 0\n"
)  # fmt: skip
STRUT = (
    ("rod = {}", "rod = {}\nstrut = {}"),
    ("[inputs]", 'E = { type = "revolute", parent = "arm", child = "strut", at = [20, 0, 0], axis = "z" }\n'
     'F = { type = "revolute", parent = "rod", child = "strut", at = [20, 0, 0], child_at = [100, 0, 0], axis = "z" }'
     "\n[inputs]"),
    ("[home]", "[home]\nE = -90\nF = -90"),
)  # fmt: skip

CASES: dict[str, tuple[str, list[tuple[str, str]], list[str]]] = {
    # geometry that can never close
    "a ground that the others cannot span": (
        FOUR, [("{ value = 100 }", "{ value = 300 }")],
        [f"12: links.ground: spans 300 mm between A and D, the rest of its loop only 260 mm; {SIDE}",
         "? whatever the angles, the loop through A, B, C, D cannot close"]),
    "one length in metres": (
        FOUR, [("[100, 75, 0], child_at", "[0.1, 0.075, 0], child_at"), ("value = 105", "value = 65")],
        [f"12: links.ground: spans 100 mm between A and D, the rest of its loop only 95.125 mm; {SIDE}",
         "? whatever the angles, the loop through A, B, C, D cannot close"]),
    "all lengths but one in metres": (
        FOUR, [("value = 30", "value = 0.03"), ("value = 105", "value = 0.105"), ("value = 100 ", "value = 0.1 ")],
        [f"14: links.coupler: spans 125 mm between B and C, the rest of its loop only 0.235 mm; {SIDE}",
         "? it is 532 times as much: are all lengths in mm?"]),
    "a joint out of the plane": (
        FOUR, [('["rocker", 0, 0]', '["rocker", 0, 3.5]')],
        [f"23: home: the loop through A, B, C, D does not close from home: a gap of 3.5 mm remains; {NEAR}",
         "? nor from 96 other starts, so a dimension or an axis is at fault"]),
    "a loop without the platform": (
        TWO, [('child_at = ["rocker", 0, 0]', 'child_at = ["rocker", 0, 3.5]')],
        [f"31: home: the loop through A, B, C, D does not close from home: a gap of 3.5 mm remains; {NEAR}",
         "? nor from 96 other starts, so a dimension or an axis is at fault"]),
    "a strut that nothing can be fitted to": (
        FOUR, [*STRUT, ("child_at = [100, 0, 0]", "child_at = [190, 0, 0]")],
        [f"16: links.strut: spans 190 mm between E and F, the rest of its loop only 140 mm; {SIDE}",
         "? whatever the angles, the loop through A, D, F, E cannot close"]),
    "two faulty loops that are independent": (
        FOUR,
        [*STRUT, ("child_at = [100, 0, 0]", "child_at = [190, 0, 0]"), ('["rocker", 0, 0]', '["rocker", 0, 3.5]')],
        [f"16: links.strut: spans 190 mm between E and F, the rest of its loop only 140 mm; {SIDE}",
         "? whatever the angles, the loop through A, D, F, E cannot close",
         f"26: home: the loop through A, B, C, D does not close from home: a gap of 3.5 mm remains; {NEAR}",
         "? nor from 96 other starts, so a dimension or an axis is at fault"]),
    # freedoms and inputs
    "a structure": (
        FOUR, list(STRUT),
        ["17: joints: a structure that cannot move: 6 joint freedoms, 6 of them held by the loops; "
         "allowed: at least one freedom", "? are axes parallel that should be?"]),
    "redundant inputs before one that would determine": (
        TWO, [("G = { name", "D = { name"), ("[home]", 'G = { name = "r" }\n[home]')],
        ["28: inputs: inputs (p, q) that depend on one another: 1 of 2 are independent; "
         "allowed: inputs that determine the mechanism",
         "? the first 2 must determine the mechanism, others follow: write r before one of p, q"]),
    "one input too few": (
        RRR,
        [('[limbs.leg.inputs]\nA = { name = "q"', '[inputs]\n"leg1.A" = { name = "q1" }\n"leg2.A" = { name = "q2"')],
        [f"39: inputs: 2 inputs (q1, q2); the mechanism has 3 freedoms; {EACH}",
         "? with the inputs locked these still move: leg1.B, leg1.C, leg2.B, leg2.C, leg3.A, leg3.B; "
         "drive one of them"]),
    "inputs that depend on one another": (
        TWO, [("G = { name", "D = { name")],
        ["28: inputs: inputs (p, q) that depend on one another: 1 of 2 are independent; "
         "allowed: inputs that determine the mechanism",
         "? with the inputs locked these still move: G, H, K, L; drive one of them instead of one of p, q"]),
    "a serial arm": (
        FOUR,
        [(FOUR[FOUR.index("D = { type"):FOUR.index("[inputs]")], ""), ("C = 90\nD = 90", "C = 90"),
         ('link = "coupler", point = [100, 75, 0]', 'link = "rod"')],
        ["16: joints: no loop: nothing but serial chains; allowed: at least one closed loop",
         "? its joint values are its position; assur is for closed loops"]),
    # pose
    "a pose that says too much": (
        FOUR, [('pose = ["x"]', 'pose = ["x", "phi"]')],
        ["6: platform.pose: x, phi: only 1 of 2 can be chosen; allowed: coordinates that the platform can choose",
         "? leave out one of x, phi"]),
    "a pose that never changes": (
        FOUR, [('pose = ["x"]', 'pose = ["x", "z"]')],
        ["6: platform.pose: x, z: only 1 of 2 can be chosen; allowed: coordinates that the platform can choose",
         "? z never changes: leave it out"]),
    "an orientation that is not constant": (
        FOUR, [('pose = ["x"]', 'pose = ["x"], orientation = "constant"')],
        ['6: platform.orientation: "constant", but the platform turns as it moves, about z; '
         'allowed: "constant" only where it keeps its orientation',
         "? leave it out; or which axes should be parallel, which rods equally long?"]),
    "a Delta's translations are three": (
        DELTA, [('["x", "y", "z"], orientation = "constant"', '["x", "y"]')],
        ["6: platform.pose: x, y: 2 coordinates for 3 freedoms; allowed: as many as there are freedoms",
         "? with x, y held it still moves along z; add z"]),
    "a Delta does not turn": (
        DELTA, [('["x", "y", "z"], orientation = "constant"', '["x", "y", "phi"]')],
        ["6: platform.pose: x, y, phi: only 2 of 3 can be chosen; allowed: coordinates that the platform can choose",
         "? phi never changes: leave it out"]),
    # limits
    "a stroke without home": (
        FOUR, [("stroke = [0, 180]", "stroke = [100, 180]")],
        [f"22: inputs.A.stroke: home has q = 90 deg, outside 100 deg to 180 deg; {HOME}"]),
    "a limit without home": (
        FOUR, [('axis = "z" }\nD', 'axis = "z", limits = [-45, 60] }\nD')],
        [f"19: joints.C.limits: home has C = 90 deg, outside -45 deg to 60 deg; {HOME}"]),
    "independent faults at once": (
        FOUR,
        [('pose = ["x"]', 'pose = ["x", "y"], orientation = "constant"'),
         ('axis = "z" }\nD', 'axis = "z", limits = [-45, 60] }\nD'),
         ("[0, 180] }", '[100, 180] }\nD = { name = "p" }')],
        ["6: platform.pose: x, y: only 1 of 2 can be chosen; allowed: coordinates that the platform can choose",
         "? leave out one of x, y",
         '6: platform.orientation: "constant", but the platform turns as it moves, about z; '
         'allowed: "constant" only where it keeps its orientation',
         "? leave it out; or which axes should be parallel, which rods equally long?",
         f"19: joints.C.limits: home has C = 90 deg, outside -45 deg to 60 deg; {HOME}",
         f"21: inputs: 2 inputs (q, p); the mechanism has 1 freedom; {EACH}",
         "? leave out one of q, p, or a coordinate of the pose: with as many as there are freedoms the first inputs "
         "determine the mechanism, and further ones follow",
         f"22: inputs.A.stroke: home has q = 90 deg, outside 100 deg to 180 deg; {HOME}"]),
}  # fmt: skip


def written(base: str, edits: list[tuple[str, str]]) -> str:
    for old, new in edits:
        assert old in base, old
        base = base.replace(old, new, 1)
    return base


def lines(problems) -> list[str]:
    texts = [line for problem in problems for line in str(problem).splitlines()]
    return [line.removeprefix("m.toml:").replace("    hint: ", "? ") for line in texts]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path / "m.toml"


@pytest.mark.parametrize("case", CASES)
def test_a_fault_is_told_exactly(case: str) -> None:
    base, edits, expected = CASES[case]
    assert lines(faults(read_text(written(base, edits), Path("m.toml")))) == expected


@pytest.mark.parametrize("case", ["a ground that the others cannot span", "a structure", "independent faults at once"])
def test_check_and_the_first_use_tell_the_same(here, capsys, case: str) -> None:
    from assur.cli.main import main

    base, edits, expected = CASES[case]
    here.write_text(written(base, edits), encoding="utf-8")
    assert main(["check", "m.toml"]) == 3
    head, *told = capsys.readouterr().out.splitlines()
    count = len([line for line in expected if line[0] != "?"])
    assert head == f"four: {count} fault{'s' if count > 1 else ''}"
    assert told == [f"    hint: {line[2:]}" if line[0] == "?" else f"m.toml:{line}" for line in expected]
    mechanism = assur.load("m.toml")
    inputs, pose = [90.0] * len(mechanism.inputs), [90.0] * len(mechanism.platform.pose)
    for use in (lambda: mechanism.direct(inputs), lambda: mechanism.inverse(pose)):
        with pytest.raises(MechanismFileError) as caught:
            use()
        assert lines(caught.value.problems) == expected


def sound(text: str):
    record = read_text(text, Path("m.toml"))
    assert faults(record) == ()
    check(record)
    return record


def test_what_the_cases_are_made_of_is_sound() -> None:
    for text in (FOUR, RRR, TWO):
        assert doubts(sound(text)) == ()
    assert [item.path for item in doubts(sound(DELTA))] == ["limbs.leg.home"]  # roughly written
    record = read_text(FOUR, Path("m.toml"))
    assert float(closure_error(record, record.home)) < 1e-12
    assert np.degrees(home_values(record)) == pytest.approx([90, -90, 90, 90])


@pytest.mark.parametrize("name", names())
def test_every_mechanism_that_comes_with_assur_is_sound(name: str) -> None:
    record = load_record(name)
    assert faults(record) == ()
    assert doubts(record) == ()


KNOWN = {
    "fourbar.toml": "x, y: only 1 of 2 can be chosen",  # read and written only
    "every_type.toml": "1 input (q); the mechanism has",  # for the screws of each type of joint
}


def files_of_mechanisms() -> list[Path]:
    """Every file of the tests that describes joints; others hold expectations."""
    files = sorted(TESTS.rglob("*.toml"))
    return [path for path in files if re.search(r"^\[(.+\.)?joints\]", path.read_text(encoding="utf-8"), re.MULTILINE)]


@pytest.mark.parametrize("path", files_of_mechanisms(), ids=lambda path: path.name)
def test_files_of_the_tests_are_sound(path: Path) -> None:
    found = faults(load_record(path))
    if path.name in KNOWN:
        assert any(KNOWN[path.name] in problem.given for problem in found)
    else:
        assert found == ()


def test_rods_on_balls_that_are_no_parallelogram_at_home_are_a_fault() -> None:
    record = load_record("delta_4s").without_closed_form
    found = assur.load("delta_4s").direct([0.0, 0.0, 0.0], method="search", crossed=True)
    skew = found.joints[next(k for k, label in enumerate(found.labels) if "~" in label)]
    told = [(item.path, item.given) for item in faults(replace(record, home=skew))]
    assert ("limbs.leg.generalised.Pa", "no parallelogram at home") in told


# ---- loops that do not close ----------------------------------------------------------------------------------


def test_loops_are_walked_in_turn() -> None:
    for name in names():
        record = load_record(name)
        for loop in loops(record):
            for place, link in enumerate(loop.links):
                both = [record.joints[loop.joints[(place + step) % len(loop.joints)]] for step in (0, 1)]
                assert all(link in (joint.parent, joint.child) for joint in both)
            assert len(set(loop.links)) == len(loop.links) == len(loop.joints)


def test_another_home_that_the_hint_gives_closes() -> None:
    """All in one line, no joint can begin to close the gap along it."""
    line = math.degrees(math.atan2(75, 100))
    text = written(FOUR, [("A = 90\nB = -90\nC = 90\nD = 90", f"A = 0\nB = {-line}\nC = {line}\nD = 0")])
    (problem,) = faults(read_text(text, Path("m.toml")))
    assert problem.hint.startswith("another home closes: A = ")
    values = problem.hint.removeprefix("another home closes: ").replace(", ", "\n")
    record = sound(text[: text.index("A = 0")] + values + "\n")
    assert float(closure_error(record, record.home)) < 0.1


def test_an_axis_that_is_not_quite_parallel_is_named() -> None:
    """2 deg between the axes on the coupler, in the coupler's own frame, whatever the angles."""
    slant = [0.0, math.sin(math.radians(2)), math.cos(math.radians(2))]
    text = written(FOUR, [('child_at = ["rocker", 0, 0], axis = "z"', f'child_at = ["rocker", 0, 0], axis = {slant}')])
    (problem,) = faults(read_text(text, Path("m.toml")))
    assert re.fullmatch(
        r"the loop through A, B, C, D does not close from home: a gap of [\d.]+ (mm|deg) remains", problem.given
    )
    assert problem.hint.startswith("the axes of B and C are 2 deg from parallel; another home closes: ")


def test_an_axis_that_leaves_the_others_is_named() -> None:
    text = written(FOUR, [('child_at = ["rocker", 0, 0], axis = "z"', 'child_at = ["rocker", 0, 0], axis = "x"')])
    problem, *_ = faults(read_text(text, Path("m.toml")))
    assert problem.hint.endswith("the axis of C is not parallel to those of A, B, D")


def test_loops_that_close_one_by_one_but_not_together() -> None:
    """Each pair of limbs of a 3-RRR spans its ground, but the platform is too small for all three."""
    text = written(RRR, [("r = { value = 60", "r = { value = 1"), ("l = { value = 100", "l = { value = 60")])
    record = read_text(text, Path("m.toml"))
    (problem,) = faults(record)
    assert problem.path == "limbs.leg.home"
    assert problem.given.startswith("each loop closes by itself, but not all together: a gap of ")


# ---- limits ---------------------------------------------------------------------------------------------------


def test_a_ball_joint_out_of_its_cone_is_told() -> None:
    record = read_text(DELTA, Path("m.toml"))
    values = home_values(record)
    joint, placed = record.joints["leg1.C1"], frames(record, values)
    seen = [placed[link][0] @ joint.cone_axis for link in (joint.parent, joint.child)]
    tilt = math.degrees(math.acos(seen[0] @ seen[1]))
    written_tilt = math.degrees(
        math.acos(1 - (2**2 + 3**2) / (1 + 4 + 9) * (1 - math.cos(math.radians(math.sqrt(14)))))
    )
    text = written(DELTA, [("angle = 75", "angle = 40")])
    assert lines(faults(read_text(text, Path("m.toml")))) == [
        f"24: limbs.leg.joints.C1.cone: home tilts leg1.C1 by {tilt:.6g} deg, out of its cone of 40 deg; {HOME}",
        f"? the file's home has {written_tilt:.6g} deg; from there the loops close at {tilt:.6g} deg",
    ]
    text = text.replace("angle = 40", "angle = 3")
    assert faults(read_text(text, Path("m.toml")))[0].hint == CONE


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ('A = { name = "q"', 'A = { name = "q"', "inputs.A.stroke"),
        ('A = { name = "q"', '"A.rotation" = { name = "q"', 'inputs."A.rotation".stroke'),
        ('A = { name = "q"', 'M = { name = "q"', "inputs.M.stroke"),
    ],
)
def test_a_stroke_is_found_however_its_input_is_written(old: str, new: str, path: str) -> None:
    text = written(FOUR, [('child = "arm", axis = "z"', 'child = "arm", axis = "z", alias = "M"'), (old, new)])
    (problem,) = faults(read_text(text.replace("[0, 180]", "[100, 180]"), Path("m.toml")))
    assert (problem.path, problem.line) == (path, 22)


def test_the_stroke_of_a_limb_is_found_in_its_template() -> None:
    text = DELTA.replace("stroke = [-60, 60]", "stroke = [50, 60]")
    (problem,) = faults(read_text(text, Path("m.toml")))
    assert (problem.path, problem.line) == ("limbs.leg.inputs.M.stroke", 27)


def test_home_may_stand_on_a_bound() -> None:
    sound(written(FOUR, [("stroke = [0, 180]", "stroke = [90, 180]")]))
    sound(written(FOUR, [('axis = "z" }\nD', 'axis = "z", limits = ["90 deg", "2*pi"] }\nD')]))


# ---- notes ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("edits", "expected"),
    [
        ([('"mm"', '"m"')],
         ["3: unit: the longest link measures 125 m, that is 125 m; "
          "allowed: it is unusual, but may be: 0.001 m to 50 m", "? is it mm that is meant?"]),
        ([("value = 30", "value = 0.03"), ("value = 105", "value = 0.105"), ("value = 100", "value = 0.1"),
          ("at = [100, 75, 0], child", "at = [0.1, 0.075, 0], child")],
         ["3: unit: the longest link measures 0.125 mm, that is 0.000125 m; "
          "allowed: it is unusual, but may be: 0.001 m to 50 m", "? is it m that is meant?"]),
        ([("ground = { value = 100 }", "ground = { value = 100 }\nthin = { value = 0.2 }")],
         [f"11: parameters.thin.value: 0.2 mm, where the longest link measures 125 mm; {NOTE}",
          "? is it in another unit than mm?"]),
        ([("D = 90", "D = 1530")], [f"27: home.D: D begins at 4.25 turns; {NOTE}"]),
        ([('"deg"', '"rad"'),
          ("A = 90\nB = -90\nC = 90\nD = 90", 'A = "90 deg"\nB = "-90 deg"\nC = "90 deg"\nD = 14.137'),
          ("stroke = [0, 180]", "stroke = [0, 3]")],
         [f"27: home.D: D begins at 2.25 turns; {NOTE}", "? are the angles in deg?"]),
    ],
)  # fmt: skip
def test_what_is_unusual_is_noted_and_is_no_fault(here, capsys, edits, expected) -> None:
    from assur.cli.main import main

    here.write_text(written(FOUR, edits), encoding="utf-8")
    assert main(["check", "m.toml"]) == 0
    _, _, _, *told, derived, following = capsys.readouterr().out.splitlines()
    assert derived.startswith("next: assur derive m.toml")
    assert following == "next: assur page m.toml"
    assert lines(told) == [line if line[0] == "?" else f"note: m.toml:{line}" for line in expected]


def test_a_home_that_is_far_from_the_assembly_is_noted_with_the_largest_first() -> None:
    """By the other route: what is told are the values of the assembled home and those of the file."""
    text = FOUR.replace("A = 90", "A = 80").replace("\nC = 90", "\nC = 70")
    record = sound(text)
    (note,) = doubts(record)
    stated, closed = np.degrees(record.home), np.degrees(home_values(record))
    order = np.argsort(-np.abs(closed - stated))[:3]
    assert (note.line, note.path, note.allowed) == (23, "home", NEAR)
    assert note.given == "the loops close at " + "; ".join(
        f"{'ABCD'[k]} = {closed[k]:.4g} deg, the file says {stated[k]:.4g} deg" for k in order
    )


@pytest.mark.parametrize(("away", "noted"), [(0.9, False), (360.0, False), (20.0, True)])
def test_whole_turns_and_what_is_rounded_are_no_other_home(away: float, noted: bool) -> None:
    record = sound(FOUR.replace("D = 90", f"D = {90 + away}"))
    moved = np.max(np.abs(np.sin((home_values(record) - record.home) / 2)))
    assert bool(moved > np.sin(np.radians(0.5))) == noted
    assert [item.path for item in doubts(record)] == (["home"] if noted else [])
    assert doubts(with_parameters(record, ground=101)) == ()  # which moves home, as it should


# ---- other dimensions ------------------------------------------------------------------------------------------


def test_dimensions_that_a_user_changes_are_checked_as_well() -> None:
    """As the ground grows home moves on, and out of a narrow stroke."""
    record = sound(FOUR.replace("stroke = [0, 180]", "stroke = [85, 95]"))
    seen = set()
    for ground in (100, 101, 120, 150, 180):
        changed = with_parameters(record, ground=ground)
        angle = float(np.degrees(home_values(changed)[0]))
        paths = [problem.path for problem in faults(changed)]
        assert paths == ([] if 85 <= angle <= 95 else ["inputs.A.stroke"])
        seen.add(bool(paths))
    assert seen == {True, False}

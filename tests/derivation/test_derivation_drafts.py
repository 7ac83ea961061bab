"""Kinds that drafts have: rods oblique to their hinges, several sliders on a platform that turns."""

import json
import re

import numpy as np
import pytest
import sympy

from assur.cli.main import main
from assur.derivation.derivation import derive
from assur.derivation.kept import derived_closed_form
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.printed_derivation import printed_derivation
from assur.derivation.reasons import left_out
from assur.derivation.solution import analytic_solution
from assur.derivation.velocities import velocity_equations
from assur.kinematics.closing_blocks.ball_ends import ball_ended_values, with_ball_ends
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.kept import carried_signs, kept_signs
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.exact import exactness
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.home import home_values
from assur.kinematics.naming import sign_meanings, signs_at
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.kernels.reading import names_of
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chains
from derived_points import derived_inputs, derived_points, inputs_near_home

OBLIQUE = {"tsai": "R[y] R[y] P(4R)[x] R[y]", "3-PRPaR": "P[z] R[y] P(4R)[x] R[y]"}
CRANK = "R[y] P(4R)[x] R[y] R[y]"
CRANKED = {
    "three limbs": (["--limb", CRANK], (10.0, 20.0, 250.0), 64),
    "two drives in a limb": (
        ["--chain", CRANK, "--chain", "C[x] R[x] R[x]", "--actuate", "1.1,1.3,2.1"], (60.0, 100.0, 240.0), 8,
    ),
}  # fmt: skip
SLIDING = {"3-RRP": "R[z] R[z] P[x]", "3-PRP": "P[y] R[z] P[x]"}
LOOPED = "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
ARM = "R[z] R[z] C[z]"
UNLIKE = {
    "a limb with a loop in it": [LOOPED, ARM],
    "a limb with a loop in it, last": [ARM, LOOPED],
    "five-bar with a slider in a limb": ["R[z] R[z]", "R[z] P[x] R[z]"],
    "a slider on the platform of a five-bar": ["R[z] R[z] R[z]", "R[z] P[x]"],
    "five-bar with a driven slider": ["P[x] R[z]", "P[y] R[z] R[z]"],
    "a sign that is a product of roots": ["C[x] R[x] R[x]", "R[y] R[y] C[y]", "P[z] R[z] R[z] R[z]"],
    "parallelograms in another order": [LOOPED, "P[y] P(4R)[x] P(4R)[y]"],
    "parallelograms across each other, sliders along the last": [
        "{P[z] R[y] R[y] | P[z] R[y] R[y]} R[z] R[z]", "P[z] P(4R)[y] P(4R)[z]",
    ],
    "a root that both problems share": ["P[x] P(4R)[y] P(4R)[z]", "C[x] R[x] R[x]", "R[y] R[y] C[y]"],
    "a loop with one slider in it, and a pose that leaves a coordinate open": [
        "{P[y] R[z] R[z] | R[z] R[z]} P[z]", "P[x] P(4R)[y] P(4R)[z]",
    ],
    "an oblique axis": ["C[x] R[x] R[x]", "C[z] R[z] R[z]", "C[1,1,0] R[1,1,0] R[1,1,0]"],
    "a slider after a crank": ["R[y] R[y] P[z]", "P[x] R[x] R[x] R[x]", "P[z] R[z] R[z] R[z]"],
    "limbs at angles that are parameters": ["P[1,0,0] P(4S)[y]", "P[-1,2,0] P(4S)[2,1,0]", "P[-1,-2,0] P(4S)[-2,1,0]"],
    "a four-bar in space": ["R[z] S S", "R[y]"],
    "rods on two rails that are one line": ["P[x] P(2US)[y]", "P[x] P(2US)[y]", "P[x] P(2US)[z]"],
    "rods in parallelograms that stand on edge": ["P[x] P(2US)[z]", "P[x] P(2US)[y]", "P[y] P(2US)[z]"],
    "rails that are oblique": ["P[1,0,1] P(4S)[y]", "P[y] P(4S)[x]", "P[z] P(4S)[y]"],
    "an Orthoglide": ["P[x] R[y] P(4R)[z] R[y]", "P[y] R[z] P(4R)[x] R[z]", "P[z] R[x] P(4R)[y] R[x]"],
    "hinges along short links": ["P[y] R[z] P(4R)[x] R[z]", "C[x] R[x] R[x]", "P[z] R[z] R[z] R[z]"],
    "four limbs and a polynomial": 4 * ["R[z] R[z] R[z] P[z]"],
    "four limbs, one with its slider below": [*3 * ["R[z] R[z] R[z] P[z]"], "P[z] R[z] R[z] R[z]"],
    "parallelograms in one plane": 3 * ["R[z] P(4R)[z] R[z]"],
    "two drives in one limb": ["R[z] R[z] R[z]", "R[z] R[z] P[x]"],
    "a limb with a loop in it across three directions": [
        "R[x] R[x] C[x]", "{P[y] R[z] R[z] | P[y] R[z] R[z]} R[y] R[y]",
    ],
    "a parallelogram on a crank beside slides": [CRANK, "C[x] R[x] R[x]", "C[z] R[z] R[z]"],
    "hinges oblique, and two parallelograms across each other": [
        "C[0,0.6,0.8] R[0,0.6,0.8] R[0,0.6,0.8]", "P[y] P(4R)[z] P(4R)[x]", "R[x] R[x] C[x]",
    ],
    "an inner loop across parallelograms": ["{P[x] R[z] R[z] | P[x] R[z] R[z]} R[x] R[x]", "P[y] P(4R)[x] P(4R)[y]"],
    "slides whose sign names no mode": ["C[x] P[y] R[x]", "C[y] P[x] R[y]", "P[z] R[z] R[z] R[z]"],
    "limbs of another order": ["P[x] R[x] R[x] R[x]", "R[y] R[y] C[y]", "C[z] R[z] R[z]"],
}  # fmt: skip
APART = 1e-6


def draft(limb, folder):
    return draft_of(repeated(limb, 3), folder)


def draft_of(chains, folder, arm=None):
    """A draft, with another length of the `arm` on the base of a limb R R C: by a short one it turns nowhere round."""
    path = folder / "draft.toml"
    text = drafted(chains, path).text
    if arm is not None:
        first = next(joint for joint in re.findall(r"(?m)^(\w) = .*axis = \"z\"", text))
        text, changed = re.subn(rf"value = \d+(, meaning = \"from {first} to )", rf"value = {arm}\1", text)
        assert changed == 1
    path.write_text(text, encoding="utf-8")
    return load_record(path)


@pytest.mark.parametrize("limb", [
    pytest.param(own, marks=() if name in ("tsai", "3-RRP") else pytest.mark.deep, id=name)
    for name, own in (OBLIQUE | SLIDING).items()
])  # fmt: skip
def test_a_draft_has_two_assemblies_which_a_search_finds(limb, tmp_path):
    record = draft(limb, tmp_path)
    solution = analytic_solution(record, "direct")
    assert solution.branches == 2
    assert solution.closes()
    inputs = inputs_near_home(record)
    points, met = derived_points(record, inputs), [own.pose for own in direct(record, inputs, method="search")]
    place = ["xyz".index(name) for name in record.platform.pose if name in "xyz"]
    assert len(met) == len(points)
    for pose in met:
        known = [float(value) for name, value in zip(record.platform.pose, pose, strict=True) if name in "xyz"]
        assert min(np.max(np.abs(own[place] - known)) for own in points) < APART


def test_a_rod_oblique_to_its_hinge_is_said_to_be_real_for_a_part_of_all_directions(tmp_path):
    placed = analytic_solution(draft(OBLIQUE["tsai"], tmp_path), "direct").placed
    said = "is oblique to its hinge, and real only where its direction has at most l2/sqrt(e1**2 + l2**2) along y"
    (text,) = [text for text in left_out(placed) if text.startswith("leg1")]
    assert text.partition(";")[0] == f"leg1.rodC1 {said}"
    assert "may point so on the other side too" in text


@pytest.fixture
def sloped(tmp_path):
    """Hinges along an axis whose slope is a parameter, and links that are oblique to them."""
    chains = ["C[x] R[x] R[x]", "R[0,0.8,0.6] R[0,0.8,0.6] C[0,0.8,0.6]", "P[z] P(4R)[x] P(4R)[y]"]
    record = draft_of(parse_chains(chains), tmp_path)
    text = record.file.read_text("utf-8").replace("axis = [0, 0.8, 0.6]", 'axis = [0, "cos(tau)", "sin(tau)"]')
    slope = f'tau = {{ value = {float(np.degrees(np.arcsin(0.6)))}, meaning = "slope", sign = "any", unit = "deg" }}'
    record.file.write_text(text.replace("[links]", f"{slope}\n\n[links]", 1), "utf-8")
    return load_record(record.file)


@pytest.mark.parametrize("problem", ["direct", "inverse"])
def test_lengths_of_links_oblique_to_their_hinges_are_no_condition(sloped, problem):
    solution = analytic_solution(sloped, problem)
    dimensions = {*solution.symbols.parameters.values()}
    for part in solution.sets:
        names = {own.symbol: own.formula for own in part.definitions}
        for condition in part.conditions:
            while condition.free_symbols & {*names}:
                condition = condition.subs(names)
            assert not condition.free_symbols <= dimensions


def test_a_link_that_lies_along_an_axis_fails_no_condition(tmp_path):
    """Two linear equations of one angle, as a turned pair, have no pivot that is needed: their squares add up."""
    chains = ["P[0,0.8,0.6] P(4R)[x] P(4R)[0,0.8,0.6]", "C[x] R[x] R[x]"]
    solution = analytic_solution(draft_of(parse_chains(chains), tmp_path), "direct")
    cosine, sine = sympy.symbols("cos_q3 sin_q3", real=True)
    conditions = [own for part in solution.sets for own in part.conditions if own.has(sine)]
    assert conditions
    for condition in conditions:
        assert condition.subs({cosine: 0, sine: 1}) != 0


@pytest.mark.deep
def test_hinges_along_a_slope_that_is_a_parameter_have_a_closed_form_that_agrees(sloped):
    derived_closed_form(sloped)


@pytest.mark.deep
@pytest.mark.parametrize("limb", OBLIQUE.values(), ids=[*OBLIQUE])
def test_rods_oblique_to_their_hinges_are_verified(limb, tmp_path, capsys):
    record = draft(limb, tmp_path)
    assert main(["derive", str(record.file), "--prove", "--json"]) == 0
    proof = tmp_path / "d.json"
    proof.write_text(capsys.readouterr().out)
    assert main(["verify", str(proof), "--mechanism", str(record.file)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "direct: derivation verified: 2 branches" in said
    assert "inverse: derivation verified: 8 branches" in said


@pytest.mark.parametrize(("limbs", "pose", "count"), [
    pytest.param(*own, marks=pytest.mark.deep if own[-1] > 8 else (), id=name) for name, own in CRANKED.items()
])  # fmt: skip
def test_rods_oblique_to_hinges_on_driven_cranks_are_on_both_sides_as_in_the_joint_graph(limbs, pose, count, tmp_path):
    file = tmp_path / "own.toml"
    assert main(["new", str(file), *limbs]) == 0
    record = load_record(file)
    solution = analytic_solution(record, "inverse")
    assert solution.closes()
    assert [*left_out(solution.placed, solution.loops.cranks)] == []
    turns = np.array([driven.coordinate.kind == "angle" for driven in record.inputs])
    derived, closed = (
        np.array([[*np.exp(1j * own[turns]), *own[~turns]] for own in map(np.asarray, rows)])
        for rows in (derived_inputs(record, np.array(pose)), inverse(record, pose).inputs)
    )
    assert len(derived) == len(closed) == solution.branches == count
    gaps = np.max(np.abs(derived[:, None] - closed), axis=2)
    assert np.max(np.min(gaps, axis=0)) < APART
    assert np.max(np.min(gaps, axis=1)) < APART


@pytest.mark.deep
def test_a_crank_with_a_rod_oblique_to_its_hinge_has_a_closed_form_and_is_proved(tmp_path, capsys):
    file, proof = tmp_path / "mechanism.toml", tmp_path / "d.json"
    chains = ["--chain", CRANK, "--chain", "R[x] R[x] C[x]", "--actuate", "1.1,1.3,2.1"]
    assert main(["new", str(file), *chains]) == 0
    assert main(["derive", str(tmp_path), "-o", str(tmp_path / "closed_form.py")]) == 0
    assert problems(load_record(tmp_path), IN_FULL)[0] == ()
    capsys.readouterr()
    assert main(["derive", str(file), "--prove", "--json"]) == 0
    proof.write_text(capsys.readouterr().out)
    assert main(["verify", str(proof), "--mechanism", str(file)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "direct: derivation verified: 4 branches" in said
    assert "inverse: derivation verified: 8 branches" in said


@pytest.mark.deep
def test_a_proof_without_the_other_side_of_a_crank_is_refused(tmp_path, capsys):
    """An equation of how a rod leans that is another is none of the mechanism's."""
    file, proof = tmp_path / "own.toml", tmp_path / "d.json"
    assert main(["new", str(file), *CRANKED["two drives in a limb"][0]]) == 0
    capsys.readouterr()
    assert main(["derive", str(file), "--problem", "inverse", "--prove", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    loops, name = document["problems"][0]["proof"]["loops"], "a1_linkA"
    (leaning,) = [own for own, text in loops.items() if f"cos_{name}" in text]
    loops[leaning] = loops[leaning].replace(f"cos_{name}", f"2*cos_{name}")
    proof.write_text(json.dumps(document))
    assert main(["verify", str(proof), "--mechanism", str(file)]) != 0
    assert "refused" in capsys.readouterr().out


def test_a_draft_with_sliders_on_its_platform_has_a_closed_form_that_its_joint_graph_confirms(tmp_path):
    record = draft(SLIDING["3-RRP"], tmp_path)
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "mechanism.toml").write_text(record.file.read_text(encoding="utf-8"), encoding="utf-8")
    assert main(["derive", str(tmp_path / "own"), "-o", str(tmp_path / "own" / "closed_form.py")]) == 0
    assert problems(load_record(tmp_path / "own"), IN_FULL)[0] == ()


@pytest.mark.deep
@pytest.mark.parametrize(("problem", "branches"), [("direct", 2), ("inverse", 4)])
def test_a_platform_that_slides_on_one_limb_and_is_jointed_to_the_other_is_proved(problem, branches, tmp_path, capsys):
    record = draft_of(parse_chains(UNLIKE["a slider on the platform of a five-bar"]), tmp_path)
    assert main(["derive", str(record.file), "--problem", problem, "--prove", "--json"]) == 0
    proof = tmp_path / "d.json"
    proof.write_text(capsys.readouterr().out)
    assert main(["verify", str(proof), "--mechanism", str(record.file)]) == 0
    assert f"{problem}: derivation verified: {branches} branches" in " ".join(capsys.readouterr().out.split())


@pytest.mark.deep
def test_each_limb_beside_a_slider_on_the_platform_follows_its_direction(tmp_path):
    chains = ["R[z] R[z] R[z]", "R[z] R[z] R[z]", "R[z] P[x]"]
    solution = analytic_solution(draft_of(parse_chains(chains), tmp_path), "inverse")
    assert solution.branches == 8
    assert solution.closes()


@pytest.mark.deep
def test_the_vector_of_a_platform_that_slides_ends_at_the_point_that_the_pose_gives(tmp_path, capsys):
    record = draft_of(parse_chains(UNLIKE["a slider on the platform of a five-bar"]), tmp_path)
    assert main(["derive", str(record.file), "--problem", "inverse"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "N1 = 0: b1.D and the platform's point coincide" in said
    assert "M1 < 0: b1.D and the platform's point are nearer than the offset of platform" in said


@pytest.mark.deep
def test_the_inverse_problem_of_a_sliding_draft_is_proved(tmp_path, capsys):
    record = draft(SLIDING["3-RRP"], tmp_path)
    assert main(["derive", str(record.file), "--problem", "inverse", "--prove", "--json"]) == 0
    proof = tmp_path / "d.json"
    proof.write_text(capsys.readouterr().out)
    assert main(["verify", str(proof), "--mechanism", str(record.file)]) == 0
    assert "inverse: derivation verified: 8 branches" in " ".join(capsys.readouterr().out.split())


def test_sliders_oblique_to_the_axis_about_which_they_turn_are_as_long_as_those_of_the_joint_graph(tmp_path):
    """The inverse problem of 3-CPR: by formulas, and limb by limb for all roots."""
    record = draft("C[1,0,1] P[z] R[1,0,1]", tmp_path)
    solution = analytic_solution(record, "inverse")
    assert solution.branches == 8
    assert solution.closes()
    pose = pose_of(record, home_values(record)) + np.array([3.0, -4.0, 5.0])
    derived = np.array([*derived_inputs(record, pose)])
    closed = np.array([own.inputs for own in inverse(record, pose)])
    assert len(derived) == len(closed) == 8
    for own in closed:
        assert np.min(np.max(np.abs(derived - own), axis=1)) < APART
    for own in derived:
        assert np.min(np.max(np.abs(closed - own), axis=1)) < APART


def test_sliders_oblique_to_their_axes_are_no_wrong_direct_solution(tmp_path):
    with pytest.raises(NotDerivedError, match="slides oblique to the axis"):
        analytic_solution(draft("C[1,0,1] P[z] R[1,0,1]", tmp_path), "direct")


@pytest.mark.deep
@pytest.mark.parametrize("chains", UNLIKE.values(), ids=[*UNLIKE])
def test_limbs_that_are_unlike_have_a_closed_form_with_velocities_that_the_joint_graph_confirms(chains, tmp_path):
    record = draft_of(parse_chains(chains), tmp_path)
    assert "parallel" in derived_closed_form(record)  # which is held against the joint graph
    equations = velocity_equations(analytic_solution(record, "inverse"))
    assert equations.jp.shape == equations.jq.shape == (len(record.inputs),) * 2


@pytest.mark.deep
def test_a_root_whose_other_value_is_real_nowhere_is_said_to_need_a_name(tmp_path):
    with pytest.raises(NotDerivedError, match=r"real at no assembly that was met.*\[modes\] of the file can"):
        derived_closed_form(draft_of(parse_chains([LOOPED, ARM]), tmp_path, 50))


@pytest.mark.parametrize(("limb", "actuated", "branches"), [
    pytest.param("R[z] P[x] R[z]", "1.1,1.2", 2, id="a passive slide, which may turn half round"),
    pytest.param("R[z] R[z] R[z]", "1.1,2.3", 2, id="a driven joint on a platform that stands fast"),
])  # fmt: skip
def test_a_limb_beside_one_that_is_straight_has_a_closed_form_that_its_joint_graph_confirms(
    limb, actuated, branches, tmp_path
):
    file = tmp_path / "draft.toml"
    assert main(["new", str(file), "--chain", "P[x] P[y]", "--chain", limb, "--actuate", actuated]) == 0
    record = load_record(file)
    form = names_of(derived_closed_form(record), tmp_path / "closed_form.py")["CLOSED_FORM"]  # held against the graph
    assert 2 ** len(sign_meanings(record, "inverse")) == branches
    assert "negative length" not in form.reduced_because  # both ways of a passive slide are branches
    assert form.factor_list


def tilted(folder):
    """A Delta whose cranks turn about axes that a parameter tilts, along the short sides of the parallelograms."""
    path = folder / "tilted.toml"
    text = drafted(repeated("R[0,0.8,0.6] P(4S)[0,0.8,0.6]", 3), path).text
    head, _, rest = text.partition("[modes]")
    text = head + rest[rest.index("[workspace]") :]
    text = text.replace("[parameters]", "[parameters]\n" + TILT, 1).replace("[0, 0.8, 0.6]", f"[0, {COS}, {SIN}]")
    for number, written in (("0.4*B_w", "cos(tilt)*B_w/2"), ("0.3*B_w", "sin(tilt)*B_w/2")):
        text = text.replace(number, written)
    path.write_text(text, encoding="utf-8")
    return path


TILT = 'tilt = { value = 36.86989764584402, unit = "deg", sign = "any", meaning = "of the cranks\' axes" }'
COS, SIN = '"cos(tilt)"', '"sin(tilt)"'


@pytest.mark.deep
def test_signs_of_blocks_are_carried_to_axes_that_point_elsewhere(tmp_path):
    """With the spaces of the file's own tilt some signs would be others, near where blocks are singular."""
    path = tilted(tmp_path)
    file, other = load_record(path), load_record(path, tilt=33.0)
    joints = assemblies_by_chance(other)
    screws = ScrewColumns(with_ball_ends(other), ball_ended_values(other, joints))
    own, still = (
        np.array([sign.signs(screws) for sign in signs]).T
        for signs in (carried_signs(other, "inverse"), kept_signs(file, "inverse"))
    )
    named = signs_at(other, "inverse", joints)
    sense = own[0] * named[0]
    assert np.array_equal(own * sense, named)
    assert not np.array_equal(still * still[0] * named[0], named)


@pytest.mark.deep
def test_cranks_about_axes_that_a_parameter_tilts_have_a_closed_form(tmp_path):
    assert "tilt" in derived_closed_form(load_record(tilted(tmp_path)))  # which is held against the joint graph


@pytest.mark.deep
def test_a_parallelogram_that_a_crank_turns_is_solved_at_any_angle_of_the_crank(tmp_path, capsys):
    """Of the two equations along the line on which it moves neither is divided by; each root has a name."""
    record = draft_of(parse_chains(UNLIKE["a parallelogram on a crank beside slides"]), tmp_path)
    assert len(sign_meanings(record, "direct")) == len(analytic_solution(record, "direct").roots) == 4
    assert main(["derive", str(record.file), "--prove", "--json"]) == 0
    proof = tmp_path / "d.json"
    proof.write_text(capsys.readouterr().out)
    assert main(["verify", str(proof), "--mechanism", str(record.file)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "direct: derivation verified: 16 branches, complete where N3 != 0 and N4 != 0;" in said


@pytest.mark.deep
def test_of_two_poses_that_nearly_meet_none_is_lost_in_the_digits_of_the_polynomial(tmp_path):
    """Its roots, four near each other, are off by 1e-6 rad by its coefficients, and the last link would not reach."""
    chains = parse_chains(3 * ["R[z] R[z] R[z] P[z]"] + ["P[z] R[z] R[z] R[z]"])
    (tmp_path / "mechanism.toml").write_text(drafted(chains, tmp_path / "mechanism.toml").text, encoding="utf-8")
    own = load_record(tmp_path)
    (tmp_path / "closed_form.py").write_text(derive(own).closed_form(), encoding="utf-8")
    record = load_record(
        tmp_path, rA=200.70929748201542, l1=278.10908167995626, l2=41.982650539346835, e1=226.91896682823463,
        rD=379.30687311246453, betaD=28.332940008307, l3=351.4594490067624, l4=261.6723703049913,
        e2=304.46343189057535, rH=85.82677339729206, betaH=-96.84486089396,
    )  # fmt: skip
    inputs = [5.236464854483192, 4.970126713070832, -1.2488268031126308, -352.4483612694542]
    derived, by_loops = (direct(record, inputs, method=method) for method in ("closed form", "loops"))
    assert derived.complete
    assert by_loops.complete
    assert derived.poses[derived.exists] == pytest.approx(by_loops.poses[by_loops.exists], abs=APART)
    assert len(derived) == 2


@pytest.mark.deep
@pytest.mark.parametrize(("limb", "count", "branches"), [("P[x] P(4S)[y]", 3, 2), ("R[y] P(4S)[y]", 4, 4)])
def test_rods_on_rails_and_a_passive_limb_have_a_closed_form(limb, count, branches, tmp_path):
    """Couples parallel to one plane are a factor; a rod's spin across a joint's axis changes no mode's name."""
    record = draft_of(repeated(limb, count), tmp_path)
    assert '("couples' in derived_closed_form(record).replace("'", '"')
    assert analytic_solution(record, "direct").branches == branches == 2 ** len(sign_meanings(record, "direct"))


@pytest.mark.deep
def test_the_height_of_rods_that_are_equally_high_is_a_factor_of_its_own(tmp_path):
    """On level rails det Jp is zero where the rods are level, and where their ends are collinear seen from above."""
    equations = velocity_equations(analytic_solution(draft("P[x] P(4S)[y]", tmp_path), "inverse"))
    varying = [factor for factor, _ in equations.parallel if factor.free_symbols]
    assert [len(factor.free_symbols) for factor in varying] == [1, 6]


@pytest.mark.deep
@pytest.mark.parametrize("limb", OBLIQUE.values(), ids=[*OBLIQUE])
def test_a_closed_form_says_where_rods_oblique_to_their_hinges_end_branches(limb, tmp_path):
    record = draft(limb, tmp_path)
    text = derived_closed_form(record)  # which is held against the joint graph
    form = names_of(text, tmp_path / "closed_form.py")["CLOSED_FORM"]
    ends = {item.name for item in form.inverse_margins if item.zero == "merge" and not item.signs}
    assert ends == {f"room_leg{number}_rodC1" for number in (1, 2, 3)}
    assert exactness(record.with_closed_form(form, text)).proved


@pytest.mark.deep
def test_in_print_no_root_bears_a_name_that_its_sign_is_a_part_of(tmp_path):
    """The sign of one root of three is that of the platform times those of the others."""
    record = draft_of(parse_chains(UNLIKE["a sign that is a product of roots"]), tmp_path)
    (own,) = printed_derivation(record, {"direct": analytic_solution(record, "direct")}, {}).problems
    assert len(own.written.meanings) == len(own.written.solution.roots) - 1


@pytest.mark.deep
def test_a_closed_form_says_that_links_which_three_directions_hold_stand_as_at_home(tmp_path):
    text = derived_closed_form(draft_of(parse_chains([LOOPED, ARM]), tmp_path))
    form = names_of(text, tmp_path / "closed_form.py")["CLOSED_FORM"]
    assert (form.complete_for, "three directions" in form.reduced_because) == ("reduced", True)


@pytest.mark.deep
def test_what_loops_keep_as_it_is_is_no_factor_that_both_determinants_share(tmp_path):
    """Two sliders on parallel rails: how far their links reach from them differs by what the rails are apart."""
    chains = UNLIKE["parallelograms across each other, sliders along the last"]
    solution = analytic_solution(draft_of(parse_chains(chains), tmp_path), "inverse")
    equations, dimensions = velocity_equations(solution), {*solution.symbols.parameters.values()}
    parallel, serial = (
        {factor for factor, _ in own if factor.free_symbols - dimensions}
        for own in (equations.parallel, equations.serial)
    )
    assert (len(parallel), len(serial), parallel & serial) == (3, 5, set())

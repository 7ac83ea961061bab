"""Derivations held against mechanism files by the small verifier, whole ones and ones that somebody changed."""

import copy
import json
import re

import pytest

from assur.cli.main import main
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.verifier.derivations.check import is_derivation, problems_of, verify_derivation
from assur.verifier.reading import MalformedError, RefusedError
from spherical import OBLIQUE, QUATERNION, spherical

TOWERS = ("fivebar", "zeng2019", "tripteron", "orthoglide", "linear_delta_4r", "delta_4s", "tsai_platform",
          "three_p2us", "linear_delta_4s", "three_crr")  # fmt: skip
QUICK = ("zeng2019", "orthoglide", "three_p2us")
"""One with links that turn about one axis, P(4R) that shift, and rods between universal joints."""
BRANCHES = {"fivebar": (2, 4), "zeng2019": (8, 32), "three_crr": (8, 8), "tripteron": (8, 8)}


def text_of(name):
    return load_record(name).file.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def derived(tmp_path_factory):
    """The data of `assur derive --prove --json`, of a mechanism and a problem."""
    known = {}

    def data(name, problem, capture):
        if (name, problem) not in known:
            assert main(["derive", name, "--problem", problem, "--prove", "--json"]) == 0
            known[name, problem] = capture.readouterr().out
        return json.loads(known[name, problem])

    return data


@pytest.fixture
def fivebar(derived, capsys):
    return copy.deepcopy(derived("fivebar", "direct", capsys))


def verified(document, name):
    return verify_derivation(json.dumps(document).encode(), text_of(name))


@pytest.mark.parametrize("problem", ["direct", pytest.param("inverse", marks=pytest.mark.deep)])
@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.deep) for name in TOWERS]
)
def test_towers_are_verified_exactly(derived, name, problem, capsys):
    (proved,) = verified(derived(name, problem, capsys), name)
    expected = BRANCHES.get(name, (2, 8))[problem == "inverse"]
    assert (proved.problem, proved.branches, proved.closed) == (problem, expected, expected)
    assert proved.assumed == tuple(load_record(name).generalised)


def test_the_condition_of_the_seed_is_the_one_under_which_it_is_complete(derived, capsys):
    (proved,) = verified(derived("zeng2019", "direct", capsys), "zeng2019")
    assert proved.conditions == ("H1 != 0", "N3 != 0")


LEGS = ("S P S", "R[y] S S", "R[y] U[x,z] S")
"""Of platforms on six of them, whose pose has a quaternion."""


@pytest.mark.deep
@pytest.mark.parametrize("limb", LEGS)
def test_legs_that_point_anywhere_are_verified_at_a_pose_with_a_quaternion(limb, tmp_path, capsys):
    path = tmp_path / "draft.toml"
    path.write_text(drafted(repeated(limb, 6), path).text, encoding="utf-8")
    assert main(["derive", str(path), "--problem", "inverse", "--prove", "--json"]) == 0
    (proved,) = verify_derivation(capsys.readouterr().out.encode(), path.read_text(encoding="utf-8"))
    assert (proved.branches, proved.closed) == (64, 64)


def another_rotation(problem):
    problem["proof"]["named"]["R12"] = problem["sets"][0]["formulas"]["R12"] = "2*qw*qz + 2*qx*qy"


def another_formula_of_a_name(problem):
    problem["sets"][0]["formulas"]["R12"] = "2*qw*qz + 2*qx*qy"


def a_name_of_what_is_given(problem):
    problem["proof"]["named"]["qw"] = "1"


def a_rod_along_its_hinge(problem):
    (own,) = (own for own in problem["proof"]["orientations"] if own["link"] == "tube1")
    own["line"] = own["hinge"]


def a_rod_along_an_axis_of_its_universal_joint(problem):
    """Without a hinge it is one that a universal joint holds."""
    (own,) = (own for own in problem["proof"]["orientations"] if own["link"] == "tube1")
    own["line"], own["hinge"] = own["hinge"], None


def a_vector_that_is_another(problem):
    name, text = next(iter(problem["proof"]["vectors"].items()))
    problem["proof"]["vectors"][name] = f"-({text})"


IN_SPACE = (another_rotation, another_formula_of_a_name, a_name_of_what_is_given, a_rod_along_its_hinge,
            a_rod_along_an_axis_of_its_universal_joint, a_vector_that_is_another)  # fmt: skip


@pytest.mark.deep
def test_the_inverse_problem_of_six_legs_is_verified_and_refused_where_it_was_changed(derived, capsys):
    document = derived("gough_stewart", "inverse", capsys)
    (proved,) = verified(document, "gough_stewart")
    assert (proved.branches, proved.closed) == (64, 64)
    for change in IN_SPACE:
        other = copy.deepcopy(document)
        change(other["problems"][0])
        with pytest.raises(RefusedError):
            verified(other, "gough_stewart")


def an_axis_of_another_joint(problem):
    problem["proof"]["axes"]["loop1"]["joint"] = "leg2.B"


def an_axis_along_nothing(problem):
    problem["proof"]["axes"]["loop1"]["along"] = ["0", "0", "0"]


def a_loop_that_is_no_axis(problem):
    del problem["proof"]["axes"]["loop1"]


def no_axis(problem):
    del problem["proof"]["axes"]["loop1"], problem["proof"]["loops"]["loop1"]


def of_platform(problem):
    (own,) = (own for own in problem["proof"]["orientations"] if own["link"] == "platform")
    return own


def carried_by_another(problem):
    of_platform(problem)["circle"] = ["cos_leg2_distal", "sin_leg2_distal"]


def carried_on_another_hinge(problem):
    of_platform(problem)["hinge"] = of_platform(problem)["axis"]


def carried_by_itself(problem):
    of_platform(problem)["second"] = of_platform(problem)["circle"]


def carried_from_elsewhere(problem):
    of_platform(problem)["constant"] = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]


SHARED = (an_axis_of_another_joint, an_axis_along_nothing, a_loop_that_is_no_axis, no_axis)
CARRIED = (carried_by_another, carried_on_another_hinge, carried_by_itself, carried_from_elsewhere)


@pytest.mark.deep
@pytest.mark.parametrize("problem", ["inverse", "direct"])
def test_axes_that_links_share_and_links_that_these_carry_are_verified(problem, tmp_path, capsys):
    path = spherical(tmp_path, QUATERNION, OBLIQUE)
    assert main(["derive", str(path), "--problem", problem, "--prove", "--json"]) == 0
    data, text = capsys.readouterr().out, path.read_text(encoding="utf-8")
    (proved,) = verify_derivation(data.encode(), text)
    assert (proved.branches, proved.closed) == (8, 8)
    for change in (*SHARED, *(CARRIED if problem == "direct" else ())):
        other = json.loads(data)
        change(other["problems"][0])
        with pytest.raises(RefusedError):
            verify_derivation(json.dumps(other).encode(), text)


def changed_formula(problem):
    problem["sets"][0]["formulas"]["cos_rod2"] = "C1/l2 - cos_rod1"


def changed_name(problem):
    formulas = problem["sets"][0]["formulas"]
    formulas["L1"] = f"-({formulas['L1']})"


def changed_radicand(problem):
    problem["sets"][0]["formulas"]["M1"] = "L1**2 + N1"


def fewer_branches(problem):
    problem["branches"] = 1


def a_root_that_is_no_choice(problem):
    problem["branches"], problem["sets"][0]["choices"], problem["sets"][0]["roots"] = 1, [], 1


def a_root_of_one_sign(problem):
    a_root_that_is_no_choice(problem)
    problem["sets"][0]["formulas"]["r1"] = "0*M1"


def no_condition(problem):
    problem["sets"][0]["conditions"] = []


def a_condition_that_never_holds(problem):
    problem["sets"][0]["conditions"].append("cos_theta1**2 + sin_theta1**2 - 1 != 0")


def changed_multiplier(problem):
    problem["proof"]["sets"][0]["lines"][0]["unit rod2"] = "2*l2**2"


def changed_loop(problem):
    problem["proof"]["loops"]["loop1"] += " + g"


def fewer_loops(problem):
    del problem["proof"]["loops"]["loop1"]


def another_square(problem):
    problem["proof"]["units"]["unit rod1"] = "cos_rod1**2 + sin_rod1**2 - 2"


def another_point(problem):
    problem["results"]["x"] += " + l1"


def of_the_pose(problem):
    problem["sets"][0]["formulas"]["H1"] = "x"


def no_unknown(problem):
    del problem["sets"][0]["formulas"]["sin_rod2"]


def a_fixed_link(problem):
    (own,) = (own for own in problem["proof"]["orientations"] if own["link"] == "rod1")
    own["kind"] = "fixed"


def another_axis(problem):
    (own,) = (own for own in problem["proof"]["orientations"] if own["link"] == "rod1")
    own["axis"] = ["0", "1", "0"]


def a_reason_that_is_none(problem):
    turn = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
    reason = {"link": "rod1", "carrier": "base", "first": ["0", "0", "1"], "second": ["0", "1", "0"], "constant": turn}
    problem["proof"]["reasons"].append(reason)


TAMPERED = (
    changed_formula, changed_name, changed_radicand, fewer_branches, a_root_that_is_no_choice, a_root_of_one_sign,
    no_condition, a_condition_that_never_holds, changed_multiplier, changed_loop, fewer_loops, another_square,
    another_point, of_the_pose, no_unknown, a_fixed_link, another_axis, a_reason_that_is_none,
)  # fmt: skip


@pytest.mark.parametrize("change", TAMPERED, ids=lambda change: change.__name__)
def test_what_was_changed_is_refused(fivebar, change):
    change(fivebar["problems"][0])
    with pytest.raises(RefusedError):
        verified(fivebar, "fivebar")


def test_what_was_not_changed_is_not(fivebar):
    assert [own.branches for own in verified(fivebar, "fivebar")] == [2]


def test_the_file_of_another_mechanism_is_refused(fivebar):
    with pytest.raises(RefusedError, match="is not known"):
        verified(fivebar, "planar_3rrr")
    other = text_of("fivebar").replace('at = ["g", "0", "0"]', 'at = ["2*g", "0", "0"]', 1)
    assert other != text_of("fivebar")
    with pytest.raises(RefusedError, match="another mechanism"):
        verify_derivation(json.dumps(fivebar).encode(), other)


def test_other_dimensions_are_no_other_mechanism(fivebar):
    other = re.sub(r"l1( *)= \{ value = \d+", r"l1\1= { value = 17", text_of("fivebar"))
    assert other != text_of("fivebar")
    assert verify_derivation(json.dumps(fivebar).encode(), other)[0].branches == 2


@pytest.mark.parametrize("data", [b"{}", b"[]", b"{", b'{"format": "assur derivation"}', b"\xff"])
def test_what_is_no_derivation_is_malformed(data):
    assert not is_derivation(data) or data.startswith(b'{"format"')
    with pytest.raises(MalformedError):
        problems_of(data)

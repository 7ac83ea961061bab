import pytest

import assur
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.result import answer
from assur.results.json_text import plain
from spherical import QUATERNION, spherical

INPUTS = ["162.6907", "-143.3209", "-24.6776"]
POSE = ["-15.4714", "9.6849", "456.3315"]


def floats(texts):
    return [float(text) for text in texts]


def test_direct_prints_what_the_library_proves(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS, "--certify", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json == plain(answer(certified_direct(assur.load("zeng2019"), floats(INPUTS))))
    assert run.json["proved"]


def test_inverse_prints_what_the_library_proves(assur_cli):
    run = assur_cli("inverse", "zeng2019", *POSE, "--certify", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json == plain(answer(certified_inverse(assur.load("zeng2019"), floats(POSE))))


def test_a_person_reads_bounds_and_proofs(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS, "--certify")
    assert run.code == 0
    text = " ".join(run.out.split())
    assert "proved, 4 solutions and no other" in text
    assert "proof 1: closed form over intervals, and Krawczyk on the legs" in text
    assert "Complete for the reduced model" in text
    assert "456.3315" in text


def test_what_is_printed_is_no_more_than_what_is_proved(assur_cli):
    """A middle with four decimals is no bound: beside it stands the width of the bounds, rounded up."""
    run = assur_cli("direct", "zeng2019", *INPUTS, "--certify")
    found = certified_direct(assur.load("zeng2019"), floats(INPUTS))
    row = next(line.split() for line in run.out.splitlines() if line.split()[:1] == ["+++"])
    assert "width" in run.out
    width = float(row[4])
    assert float(max(found.solutions[0].pose.width)) <= width <= 1.2 * float(max(found.solutions[0].pose.width))


def test_where_dependent_equations_are_not_proved_the_headline_says_so(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS, "--certify", "--method", "loops")
    assert run.code == 5
    text = " ".join(run.out.split())
    assert "4 solutions of the independent equations proved (the dependent ones hold to" in text
    assert ": a zero of the independent equations is proved on the joint graph" in text


def test_a_search_is_box_by_box(assur_cli):
    run = assur_cli("direct", "zeng2019", *INPUTS, "--certify", "--method", "search")
    assert run.code == 0
    assert "branch and prune" in " ".join(run.out.split())


def test_proved_that_there_is_none_exits_4_and_undecided_5(assur_cli):
    none = assur_cli("direct", "zeng2019", "900", *INPUTS[1:], "--certify")
    assert none.code == 4
    assert "proved, no solution" in none.out
    unsure = assur_cli("direct", "zeng2019", "70", "-70", "0", "--certify")
    assert unsure.code == 5
    assert "undecided in 1 place" in unsure.out
    assert "B1B2 less C1C2" in unsure.out


def test_on_the_joint_graph_others_are_not_excluded(assur_cli):
    run = assur_cli("direct", "fivebar", "127", "53", "--certify", "--method", "loops")
    assert run.code == 5
    assert "2 solutions proved, whether there are others is not" in run.out


def test_angles_are_in_degrees(assur_cli):
    run = assur_cli("direct", "planar_3rrr", "80", "85", "90", "--certify", "--json").json
    assert all(abs(item["pose"]["low"][2]) <= 180.1 for item in run["solutions"])
    assert (
        run["inputs"] == [80.0, 85.0, 90.0]
        or max(abs(a - b) for a, b in zip(run["inputs"], [80, 85, 90], strict=True)) < 1e-9
    )


def test_what_cannot_be_certified_is_refused(assur_cli):
    for words in (["--mode", "+++"], ["--crossed"]):
        run = assur_cli("direct", "zeng2019", *INPUTS, "--certify", *words)
        assert run.code == 2
        assert "--certify" in run.err
    run = assur_cli("inverse", "zeng2019", *POSE, "--certify", "--method", "search")
    assert run.code == 2


def test_where_phi_and_psi_turn_about_one_axis_the_answer_says_so(assur_cli, tmp_path):
    """Four of the eight poses of an Agile Eye have theta = 90 or -90 deg, whatever its inputs are."""
    path = str(spherical(tmp_path))
    run = assur_cli("direct", path, "10", "20", "-15", "--certify")
    assert (run.code, run.err) == (5, "")
    assert run.out.count("-180.0000 .. 180.0000") == 8
    assert "phi and psi: any, where theta may be 90.0000 deg or its negative" in " ".join(run.out.split())
    found = assur_cli("direct", path, "10", "20", "-15", "--certify", "--json").json["solutions"]
    assert [item["undetermined"] for item in found].count(["phi", "psi"]) == 4
    assert all(None not in item["pose"][end] for item in found for end in ("low", "high"))


def test_at_a_half_turn_the_parts_of_a_quaternion_have_either_sign(assur_cli, tmp_path):
    run = assur_cli("direct", str(spherical(tmp_path, QUATERNION)), "0", "0", "0", "--certify")
    assert run.code == 5
    assert run.out.count("-1.000000 .. 1.000000") == 3
    assert "of either sign where qw may be 0" in " ".join(run.out.split())


def test_proved_solutions_say_which_limits_they_exceed(assur_cli):
    data = assur_cli("direct", "three_rps", "400", "400", "400", "--certify", "--json").json
    assert (data["limits_stated"], len(data["solutions"])) == (True, 16)
    for item in data["solutions"]:
        assert [(each["joint"], each["by"]) for each in item["limits"]["outside"]] == [
            (f"rho{k}", pytest.approx(80.0)) for k in (1, 2, 3)
        ]

import pytest

import assur
from catalogue import each

POSE = ("-15.4714", "9.6849", "456.3315")
SHAPE = {"kind", "factors", "det_jp", "det_jq", "condition"}


def test_the_verdict_is_that_of_the_library(assur_cli):
    run = assur_cli("singularity", "zeng2019", "--pose", *POSE, "--mode", "++-++", "--json")
    assert run.code == 0
    verdict = assur.load("zeng2019").singularity([float(text) for text in POSE], "++-++")
    assert run.json.keys() >= {*SHAPE, "mechanism", "pose", "mode"}
    assert run.json["kind"] == "regular"
    assert run.json["factors"] == dict(verdict.factors)
    assert (run.json["det_jp"], run.json["det_jq"]) == (verdict.det_jp, verdict.det_jq)
    assert run.json["condition"] == verdict.condition
    assert run.json == assur_cli("singularity", "zeng2019", "--pose", *POSE, "--json").json  # the default mode


def test_where_it_is_singular_the_condition_number_is_null(assur_cli):
    run = assur_cli("singularity", "zeng2019", "--pose", *POSE, "--mode", "+++++", "--json")
    assert (run.code, run.json["kind"], run.json["condition"]) == (0, "self_motion", None)
    text = assur_cli("singularity", "zeng2019", "--pose", *POSE, "--mode", "+++++").out
    assert "singularity: self_motion" in text
    assert "condition number of J = Jp^-1 Jq: none, singular" in text


def test_a_pose_out_of_reach_exits_4_and_names_the_quantity(assur_cli):
    run = assur_cli("singularity", "zeng2019", "--pose", "900", "0", "300", "--json")
    assert (run.code, run.json["kind"]) == (4, "unreachable")
    assert run.json["failures"][0]["quantity"] == "n_alpha"
    assert [run.json[name] for name in ("det_jp", "det_jq", "condition")] == [None, None, None]
    assert "n_alpha < 0" in assur_cli("singularity", "zeng2019", "--pose", "900", "0", "300").out


@pytest.mark.parametrize("name", each())
def test_without_a_pose_it_lists_factors_loci_and_examples(assur_cli, name):
    run = assur_cli("singularity", name, "--json")
    assert run.code == 0
    factors = {item["name"] for item in run.json["factors"]}
    assert factors == {item.name for item in assur.load(name).closed_form.factor_list}
    assert run.json["loci"]
    for example in run.json["examples"]:
        words = ("--pose", *map(repr, example["pose"]), "--mode", example["mode"])
        verdict = assur_cli("singularity", name, *words, "--json").json
        assert verdict["kind"] == example["kind"]
        assert abs(verdict["relative"][example["factor"]]) < 1e-6


def test_a_person_sees_them_too(assur_cli):
    out = assur_cli("singularity", "fivebar").out
    assert "parallel loci inside the workspace box, working mode -+" in out
    assert "sin_rods" in out
    assert "self_motion: gap_x = gap_y = 0" in out


def test_a_mechanism_with_one_working_mode_says_so(assur_cli):
    words = ("singularity", "three_upu", "--pose", "1", "2", "200")
    assert "z = 200.0000 mm, its only working mode\n" in assur_cli(*words).out
    run = assur_cli(*words, "--mode", "+")
    assert (run.code, run.out) == (2, "")
    assert "three_upu has only one working mode, which has no signs; found '+'" in run.err

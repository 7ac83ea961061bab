import numpy as np
import pytest

import assur
from assur.performance.indices import INDICES, indices
from assur.performance.overall import overall
from assur.results.json_text import plain
from assur.singularity.distance import distance
from assur.workspace.region import workspace

POSE = ("-15.4714", "9.6849", "456.3315")
SMALL = ("--resolution", "8", "--points", "256")


def test_at_a_pose_it_says_what_the_library_says(assur_cli):
    run = assur_cli("indices", "zeng2019", "--pose", *POSE, "--json")
    assert run.code == 0
    found = indices(assur.load("zeng2019"), [float(text) for text in POSE])
    for name in INDICES:
        assert run.json[name] == pytest.approx(float(found[name]), rel=1e-12)
    assert run.json["velocity_factors"] == found.velocity_factors.tolist()
    assert run.json["input_transmission_indices"] == found.transmission.inputs.tolist()
    assert run.json["output_transmission_indices"] == found.transmission.outputs.tolist()
    assert (run.json["characteristic_length"], run.json["mode"], run.json["status"]) == (None, "++-++", "regular")


def test_a_person_sees_every_index_and_input(assur_cli):
    out = assur_cli("indices", "zeng2019", "--pose", *POSE).out
    for word in (*INDICES, "yA1", "yA2", "yA3", "units do not mix"):
        assert word in out


def test_at_a_pose_the_distance_stands_beside_the_indices(assur_cli):
    run = assur_cli("indices", "zeng2019", "--pose", *POSE, "--json")
    found = distance(assur.load("zeng2019"), [float(text) for text in POSE])
    assert run.json["distance"] == pytest.approx(float(found.value), rel=1e-12)
    assert run.json["nearest_factor"] == str(found.factor)
    assert run.json["nearest"] == pytest.approx(found.nearest.tolist())
    assert "the nearest parallel singularity found" in " ".join(
        assur_cli("indices", "zeng2019", "--pose", *POSE).out.split()
    )
    far = assur_cli("indices", "fivebar", "--pose", "0", "250")
    assert "no parallel singularity was found within 194 mm" in " ".join(far.out.split())
    far = assur_cli("indices", "fivebar", "--pose", "0", "250", "--json").json
    assert (far["distance"], far["nearest"], far["distance_reach"]) == (None, None, 194.0)


def test_angles_are_in_the_unit_of_the_file_and_the_length_is_stated(assur_cli):
    run = assur_cli("indices", "planar_3rrr", "--pose", "10", "-5", "12", "--length", "80", "--json")
    found = indices(assur.load("planar_3rrr"), [10.0, -5.0, np.radians(12.0)], None, 80.0)
    assert run.json["condition"] == pytest.approx(float(found["condition"]), rel=1e-9)
    assert run.json["pose"] == pytest.approx([10.0, -5.0, 12.0])
    assert run.json["characteristic_length"] == 80.0
    own = assur_cli("indices", "planar_3rrr", "--pose", "10", "-5", "12", "--json").json
    best = assur_cli("indices", "planar_3rrr", "--pose", "10", "-5", "12", "--length", "isotropic", "--json").json
    assert best["condition"] >= max(own["condition"], run.json["condition"])
    assert own["transmission"] == best["transmission"]
    assert (
        "characteristic length 80 mm"
        in assur_cli("indices", "planar_3rrr", "--pose", "0", "0", "0", "--length", "80").out
    )


def test_a_pose_out_of_reach_exits_4_and_says_why(assur_cli):
    run = assur_cli("indices", "fivebar", "--pose", "900", "0", "--json")
    assert (run.code, run.json["status"], run.json["transmission"]) == (4, "unreachable", None)
    assert run.json["failures"][0]["quantity"].startswith("reach")
    assert assur_cli("indices", "planar_3rrr", "--pose", "900", "0", "0", "--length", "isotropic").code == 4
    assert "reach" in assur_cli("indices", "fivebar", "--pose", "900", "0").out


def test_over_the_workspace_it_says_what_the_library_says(assur_cli):
    run = assur_cli("indices", "fivebar", "--box", "x=-50:50", *SMALL, "--json")
    record = assur.load("fivebar")
    region = workspace(record, box={"x": (-50, 50)}, resolution=8, sections=())
    expected, data = overall(record, region, 256), run.json
    assert run.code == 0
    assert (data["points"], data["singular"], data["good_from"]) == (expected.points, expected.singular, 0.7)
    assert data["good_transmission"] == plain(expected.good)
    assert data["indices"].keys() == expected.values.keys()
    for name, item in expected.values.items():
        assert data["indices"][name]["mean"] == item.mean
        assert data["indices"][name]["least_at"] == list(item.least_at)
    assert run.json["volume"] == region.volume
    out = assur_cli("indices", "fivebar", "--box", "x=-50:50", *SMALL).out
    assert "good transmission (local index at least 0.7)" in out
    assert "mm/rad" in out


def test_a_slice_and_its_worst_pose_in_degrees(assur_cli):
    run = assur_cli("indices", "planar_3rrr", "--at", "phi=10", *SMALL, "--json")
    assert run.json["held"] == pytest.approx({"phi": 10.0})
    worst = run.json["indices"]["transmission"]["least_at"]
    assert worst[2] == pytest.approx(10.0)
    again = assur_cli("indices", "planar_3rrr", "--pose", *map(repr, worst), "--json").json
    assert again["transmission"] == pytest.approx(run.json["indices"]["transmission"]["least"], rel=1e-9)
    assert "held: phi = 10" in assur_cli("indices", "planar_3rrr", "--at", "phi=10", *SMALL).out


def test_an_empty_workspace_says_so(assur_cli):
    run = assur_cli("indices", "fivebar", "--box", "x=800:900", *SMALL)
    assert run.code == 0
    assert "nothing is reached" in run.out
    assert assur_cli("indices", "fivebar", "--box", "x=800:900", *SMALL, "--json").json["good_transmission"] is None


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("fivebar --length -5", "--length: -5 is not a positive length"),
        ("fivebar --length long", "--length: 'long' is not a number"),
        ("fivebar --length isotropic", "no length makes its Jacobian more isotropic"),
        ("fivebar --points 5", "--points: 5 is not a whole number of at least 128"),
        ("fivebar --pose 1 2 3", "3 values, 2 wanted"),
        ("fivebar --mode +++", "mode"),
    ],
)
def test_bad_words_are_refused(assur_cli, words, message):
    run = assur_cli("indices", *words.split(), *(() if "--p" in words else ("--resolution", "8")))
    assert run.code == 2
    assert message in run.err


def test_the_condition_number_is_the_one_that_singularity_prints(assur_cli):
    """Lengths and angles mix in this pose: both divide lengths by the characteristic length, and say so."""
    words = ["planar_3rrr", "--pose", "0.1", "0.05", "3", "--mode", "+++"]
    index = assur_cli("indices", *words, "--json").json
    verdict = assur_cli("singularity", *words, "--json").json
    assert index["condition_number"] == pytest.approx(verdict["condition"], rel=1e-9)
    assert index["condition_number"] == pytest.approx(1 / index["condition"], rel=1e-12)
    assert index["characteristic_length"] == verdict["characteristic_length"] > 1
    said = " ".join(assur_cli("singularity", *words).out.split())
    assert "condition number of J = Jp^-1 Jq, lengths over the characteristic length" in said

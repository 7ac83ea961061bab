import json

import numpy as np
import pytest

from assur.kinematics.closure import closure_error
from assur.kinematics.pose import pose_of
from assur.kinematics.status import relative_factors
from assur.mechanism import load
from assur.page.content import DIGITS, content
from assur.results.json_text import json_text
from assur.scene.companion import companion
from assur.scene.parts import parts
from assur.scene.skeleton import skeleton
from catalogue import each
from pages import content_of


@pytest.mark.parametrize("name", each())
def test_it_is_json_and_loses_no_bit_of_what_is_computed_from(name):
    record = load(name)
    found = json.loads(json_text(content_of(name)))
    assert found["home"] == record.home_values.tolist()
    assert float(closure_error(record, np.array(found["home"]))) < 1e-11 * found["characteristicLength"]
    for joint in found["graph"]["joints"]:
        assert np.array_equal(joint["at"], record.joints[joint["name"]].at)
    assert found["platform"]["point"] == record.platform.point.tolist()


@pytest.mark.parametrize("name", each())
def test_printed_inputs_follow_from_joint_values_as_it_says(name):
    record = load(name)
    found = content_of(name)
    printed = [item["sign"] * found["home"][item["index"]] + item["offset"] for item in found["inputs"]]
    answer = record.inverse(pose_of(record, record.home_values))
    assert np.min(np.max(np.abs(np.sin((answer.inputs[answer.exists] - printed) / 2)), axis=1)) < 1e-6


@pytest.mark.parametrize("name", ["zeng2019", "gough_stewart", "h4_robot"])
def test_parts_are_those_of_the_scene_rounded(name):
    record = load(name)
    drawn = companion(record)
    body = skeleton(record, drawn, record.home_values)
    found = content_of(name)
    whole = parts(body, drawn)
    assert [item["name"] for item in found["parts"]] == [item.name for item in whole]
    for ours, theirs in zip(found["parts"], whole, strict=True):
        for key, value in theirs.shape.to_json().items():
            if key != "kind":
                assert np.allclose(ours["shape"][key], value, rtol=0, atol=10.0 ** (1 - DIGITS) * max(body.size, 1e-9))
    assert {item["link"] for item in found["parts"]} <= set(record.links)


def test_factors_come_with_the_scale_that_python_divides_by():
    record = load("zeng2019")
    answer = record.inverse([-15.4714, 9.6849, 456.3315], "++-++")
    relative = relative_factors(record, {name: value[0] for name, value in answer.factors.items()})
    for item in content_of("zeng2019")["factors"]:
        assert item["kind"] in ("serial", "parallel")
        assert float(answer.factors[item["name"]][0] / item["scale"]) == pytest.approx(float(relative[item["name"]]))


def test_parameters_are_shown_in_the_files_unit_and_computed_with_in_rad():
    record = load("linear_delta_4r")
    found = content_of("linear_delta_4r")
    assert {item["name"]: item["value"] for item in found["parameters"]} == {
        name: item.value for name, item in record.parameters.items()
    }
    assert found["kernelParameters"] == {name: item.inside for name, item in record.parameters.items()}


def test_a_users_own_file_has_no_kernel_and_no_factors(drafted):
    found = content(load(drafted), [])
    assert found["kernel"] is None
    assert found["factors"] == []
    assert len(found["branches"]["working"]) == 4

"""Errata E1 to E17 of Zeng et al. 2019: the evidence of each holds, and would not if the matter were otherwise."""

import dataclasses
import shutil

import numpy as np
import pytest

from assur.audit.errata import erratum
from assur.errors import UsageError
from assur.model.consent import leave
from assur.model.dimensions import with_parameters
from assur.model.registry import load_record

IDS = [f"E{k}" for k in range(1, 18)]


def test_every_finding_is_an_erratum(found):
    assert [item.id for item in found.errata] == IDS


@pytest.mark.parametrize("name", IDS)
def test_evidence_holds(found, name):
    item = next(item for item in found.errata if item.id == name)
    assert item.evidence.holds, item.evidence.text
    assert len(item.evidence.text) > 40


@pytest.mark.parametrize("name", ["E12", "E15"])
def test_what_is_read_only_is_said(found, name):
    assert next(item for item in found.errata if item.id == name).not_computed


# ---- every piece of evidence can fail --------------------------------------------------------------------------


@pytest.fixture(autouse=True)
def leave_to_run():
    """Evidence of a copy is a stranger's Python."""
    with leave(given=True):
        yield


@pytest.fixture
def record():
    return load_record("zeng2019")


@pytest.fixture
def misprint(record, tmp_path):
    """The mechanism with a text of its reference data replaced by another."""

    def change(file, old, new):
        folder = tmp_path / "zeng2019"
        shutil.copytree(record.folder, folder)
        path = folder / "reference" / file
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_text(text.replace(old, new, 1), encoding="utf-8")
        return dataclasses.replace(record, folder=folder)

    return change


def with_form(record, **kernels):
    return dataclasses.replace(record, closed_form=dataclasses.replace(record.closed_form, **kernels))


def with_joints(record, **changes):
    joints = {name: dataclasses.replace(joint, **changes.get(name, {})) for name, joint in record.joints.items()}
    return dataclasses.replace(record, joints=joints)


def shifted_direct(form):
    def direct(ns, p, inputs, sign):
        branch = form.direct(ns, p, inputs, sign)
        x, y, z = branch.pose
        return dataclasses.replace(branch, pose=(x, y + inputs[0] / 1000, z))

    return direct


def other_print(form):
    def as_printed(ns, p, core):
        jp, jq = form.as_printed(ns, p, core)
        return (jp[0], (jp[1][0], jp[1][1], 2 * jp[1][2]), jp[2]), jq

    return as_printed


def fails(record, name):
    return not erratum(record, name).evidence.holds


def test_e1_fails_if_b_were_another(record):
    """B with another l3 than that of the joint graph."""
    stated = {**record.parameters, "l3": dataclasses.replace(record.parameters["l3"], value=150.0)}
    with pytest.raises(UsageError, match="no 60 regular configurations"):  # no loop closes with it
        fails(dataclasses.replace(record, parameters=stated), "E1")


def test_e2_fails_if_row_1_were_a_solution(misprint):
    solution = '"-15.4714", "9.6849", "-396.3315"'
    assert fails(misprint("tables.toml", '"64.6353", "175.6965", "370.1818"', solution), "E2")


def test_e3_fails_if_x_were_right(misprint):
    assert fails(misprint("tables.toml", '"-128.8290", "9.6849"', '"-83.0873", "9.6849"'), "E3")


def test_e3_fails_if_z_were_wrong_too(misprint):
    assert fails(misprint("tables.toml", '"118.2099"', '"119.2099"'), "E3")


def test_e4_fails_if_the_closed_form_were_wrong(record):
    assert fails(with_form(record, direct=shifted_direct(record.closed_form)), "E4")


def test_e5_fails_if_y_were_not_the_mean(record):
    assert fails(with_form(record, direct=shifted_direct(record.closed_form)), "E5")


def test_e6_fails_if_row_1_were_row_3(misprint):
    old, new = '"162.6909", "22.6909", "44.0476"', '"162.6909", "-143.3211", "44.0476"'
    assert fails(misprint("tables.toml", old, new), "E6")


def test_e7_fails_for_another_jacobian(record):
    assert fails(with_form(record, as_printed=other_print(record.closed_form)), "E7")


def test_e7_fails_if_the_box_did_not_meet_the_surfaces(record):
    assert fails(dataclasses.replace(record, box={**record.box, "z": (440.0, 480.0)}), "E7")


def test_e8_fails_where_the_links_can_be_parallel(record):
    assert fails(with_parameters(record, b=60, d=50), "E8")


def test_e9_fails_for_another_jacobian(record):
    assert fails(with_form(record, as_printed=other_print(record.closed_form)), "E9")


def test_e10_fails_with_too_few_inputs(record):
    assert fails(dataclasses.replace(record, inputs=record.inputs[:2]), "E10")


def test_e11_fails_if_the_box_held_all_x(misprint):
    assert fails(misprint("workspace.toml", 'low  = "-110"', 'low  = "-140"'), "E11")


def test_e12_fails_if_the_closed_form_did_not_close(record):
    turned = dataclasses.replace(record.inputs[1], sign=-1.0)
    assert fails(dataclasses.replace(record, inputs=(record.inputs[0], turned, record.inputs[2])), "E12")


def test_e13_fails_if_nothing_were_collapsed(record):
    assert fails(dataclasses.replace(record, generalised={"Pa1": record.generalised["Pa1"]}), "E13")


def test_e14_fails_if_the_short_links_of_the_second_parallelogram_stood_upright(record):
    """The same closed form, but parallelogram 2 is then flat at cos(beta) = 0, not at sin(beta) = 0."""
    d, half = record.values.d, record.values.l5 / 2
    upright = with_joints(
        record,
        D3a={"at": np.array([0.0, 0.0, -half])},
        D3b={"at": np.array([0.0, 0.0, half])},
        E3a={"child_at": np.array([d, 0.0, -half])},
        E3b={"child_at": np.array([d, 0.0, half])},
    )
    assert fails(upright, "E14")


def test_e15_fails_for_another_number(misprint):
    assert fails(misprint("tables.toml", 'printed = "24"', 'printed = "23"'), "E15")


def test_one_collinear_set_would_fail_if_the_two_could_part(record):
    form = record.closed_form

    def factors(ns, p, core):
        return {**form.factors(ns, p, core), "u2": core.u2 + 1.0}

    assert fails(with_form(record, factors=factors), "E16")


def test_stroke_would_fail_on_a_longer_base(record):
    assert fails(with_parameters(record, a=400.0), "E17")

import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics.closure import mobility
from assur.kinematics.pose import pose_of
from assur.kinematics.status import FACTOR_TOLERANCE, Status, scale
from assur.singularity.examples import brought_to, singular_examples


def test_every_factor_of_the_paper_has_an_example_at_its_zero():
    paper = assur.load("zeng2019")
    examples = {example.factor.name: example for example in singular_examples(paper)}
    assert set(examples) == {factor.name for factor in paper.closed_form.factor_list}
    for name, example in examples.items():
        verdict = paper.singularity(example.pose, example.mode)
        assert abs(verdict.relative[name]) <= FACTOR_TOLERANCE
        assert example.status.name == verdict.kind


@pytest.mark.parametrize("name", ["zeng2019", "fivebar", "planar_3rrr"])
def test_what_is_brought_to_a_pose_stays_what_it_is_and_knows_its_box(name):
    """Far away in one coordinate, so that what can follow leaves the box."""
    record = assur.load(name)
    away = pose_of(record, record.home_values) + 1e3 * np.eye(len(record.platform.pose))[1]
    for example in singular_examples(record):
        moved = brought_to(record, away, example)
        verdict = record.singularity(moved.pose, moved.mode)
        assert abs(verdict.relative[example.factor.name]) <= FACTOR_TOLERANCE
        assert verdict.kind == example.status.name
        low, high = np.array([record.box[item] for item in record.platform.pose]).T
        assert moved.in_box == np.all((low <= moved.pose) & (moved.pose <= high))
    if name == "zeng2019":  # nothing depends on its y
        assert moved.pose[1] == away[1]


def test_examples_are_the_same_every_time():
    paper = assur.load("zeng2019")
    for first, second in zip(singular_examples(paper), singular_examples(paper), strict=True):
        np.testing.assert_array_equal(first.pose, second.pose)


def test_what_the_paper_s_box_holds_and_what_lies_outside():
    """A flat parallelogram 2 and parallel D1D2, D3E3 lie outside the paper's search box, the rest inside."""
    outside = {example.factor.name for example in singular_examples(assur.load("zeng2019")) if not example.in_box}
    assert outside == {"sin_beta", "sin_alpha_minus_beta"}


def test_an_example_shows_as_few_other_zeros_as_it_can():
    paper = assur.load("zeng2019")
    w3 = next(example for example in singular_examples(paper) if example.factor.name == "u3")
    others = paper.singularity(w3.pose, w3.mode).relative
    assert [name for name, value in others.items() if abs(value) <= FACTOR_TOLERANCE] == ["u3"]


@pytest.mark.parametrize(("name", "factor"), [("delta_4s", "couples"), ("three_upu", "cylinder")])
def test_a_factor_that_alone_makes_a_constraint_singularity_has_an_example(name, factor):
    mechanism = assur.load(name)
    found = {example.factor.name: example for example in singular_examples(mechanism)}
    assert found[factor].factor.kind == "other"
    assert found[factor].status == Status.constraint
    ranks = [int(mobility(mechanism, joints, threshold=1e-5).rank) for joints in (found[factor].joints, _home(name))]
    assert ranks[0] < ranks[1]


def _home(name):
    return assur.load(name).home_values


def test_other_factors_that_need_company_have_no_example():
    mechanism = assur.load("delta_4s")
    alone = {group[0] for group in mechanism.closed_form.constraint_singular if len(group) == 1}
    others = {example.factor.name for example in singular_examples(mechanism) if example.factor.kind == "other"}
    assert others <= alone
    assert len(alone) < sum(item.kind == "other" for item in mechanism.closed_form.factor_list)


def test_without_a_closed_form_examples_are_met_on_paths_from_home():
    mechanism = dataclasses.replace(assur.load("planar_3rrr"), closed_form=None)
    found = {example.factor.kind: example for example in singular_examples(mechanism, seed=0)}
    assert set(found) == {"serial", "parallel"}
    known = assur.load("planar_3rrr")
    for kind, example in found.items():
        assert example.status.name in (kind, "self_motion")
        relative = known.inverse(example.pose, "+++").factors
        names = [item.name for item in known.closed_form.factor_list if item.kind == kind]
        scales = {item.name: scale(known, item.scale) for item in known.closed_form.factor_list}
        assert min(abs(float(relative[name][0])) / scales[name] for name in names) < 1e-5


def test_a_file_without_a_box_is_refused():
    paper = assur.load("zeng2019")
    with pytest.raises(assur.UsageError, match="no box to look for singular configurations in"):
        singular_examples(dataclasses.replace(paper, box={}))

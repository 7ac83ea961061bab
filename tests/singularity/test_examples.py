from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics.status import FACTOR_TOLERANCE
from assur.singularity.examples import singular_examples


def test_every_factor_of_the_paper_has_an_example_at_its_zero():
    paper = assur.load("zeng2019")
    examples = {example.factor.name: example for example in singular_examples(paper)}
    assert set(examples) == {factor.name for factor in paper.closed_form.factor_list}
    for name, example in examples.items():
        verdict = paper.singularity(example.pose, example.mode)
        assert abs(verdict.relative[name]) <= FACTOR_TOLERANCE
        assert example.status.name == verdict.kind


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


def test_a_file_without_a_box_is_refused():
    paper = assur.load("zeng2019")
    with pytest.raises(assur.UsageError, match="no box to look for singular configurations in"):
        singular_examples(dataclasses.replace(paper, box={}))

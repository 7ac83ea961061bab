"""Folds: what need not be sought, and what is found where it is."""

import numpy as np

from assur.kinematics.closing_blocks.by_name import sorted_by_name
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.folds import differing_at_folds
from assur.kinematics.closing_blocks.signs import factor_signs, factors
from assur.model.registry import load_record
from assur.numerics.modulo_two import independent


def test_signs_that_are_products_of_others_differ_as_these_at_every_fold():
    record = sorted_by_name(load_record("fivebar"))
    known, near = factors(record, "inverse"), ScrewColumns(record, assemblies_by_chance(record))
    signs = factor_signs(known, near)
    telling = independent((signs[np.all(signs != 0, axis=1)] < 0).T)
    sought = differing_at_folds("inverse", known, near)
    assert len(sought) > 0
    assert {*independent(sought.T)} <= {*telling}
    assert len(telling) < len(known)
    assert len(differing_at_folds("inverse", known, near, telling)) == 0


def test_folds_are_sought_where_a_sign_is_no_product_of_those_that_tell():
    record = sorted_by_name(load_record("fivebar"))
    known, near = factors(record, "inverse"), ScrewColumns(record, assemblies_by_chance(record))
    sought = differing_at_folds("inverse", known, near)
    assert np.array_equal(differing_at_folds("inverse", known, near, [0]), sought)

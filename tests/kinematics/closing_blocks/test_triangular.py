"""Factors of a block's determinant that no part of the joint graph has, as it does not close by itself."""

import numpy as np
import pytest

from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.signs import factors
from assur.kinematics.closing_blocks.triangular import _factors, triangular_factors
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains


@pytest.mark.parametrize("name", ["tripteron", pytest.param("zeng2019", marks=pytest.mark.deep)])
def test_the_factors_of_a_determinant_multiply_to_it(name):
    """As shares of what each is at home: in other units, and in another basis, a determinant has another size."""
    record = load_record(name)
    screws = ScrewColumns(record, assemblies_by_chance(record)[:24])
    several = 0
    for sign in factors(record, "direct"):
        if sign.block.spins:
            continue
        parts = [*_factors(sign, screws)]
        several += len(parts) > 1
        product = np.prod([part.shares(screws) / part.shares(screws)[0] for part in parts], axis=0)
        assert product == pytest.approx(sign.shares(screws) / sign.shares(screws)[0], rel=1e-6, abs=1e-9)
    assert several


@pytest.mark.deep
def test_a_factor_along_a_line_that_an_input_turns_is_seen_from_the_link_that_it_moves(tmp_path):
    """The parallelogram moves the platform along one line of its crank: its part of the determinant, and the rest."""
    file = tmp_path / "own.toml"
    file.write_text(drafted(parse_chains(["R[y] P(4R)[x] R[y] R[y]", "C[x] R[x] R[x]", "C[z] R[z] R[z]"]), file).text)
    record = load_record(file)
    screws = ScrewColumns(record, assemblies_by_chance(record))
    whole, *parts = triangular_factors(factors(record, "direct"), screws, "direct")
    assert [{*part.joints} <= {*whole.joints} for part in parts] == [True, True]
    assert {link for part in parts for link in part.links} == {"a1.linkA"}
    product = np.prod([part.shares(screws) / part.shares(screws)[0] for part in parts], axis=0)
    assert product == pytest.approx(whole.shares(screws) / whole.shares(screws)[0], rel=1e-6, abs=1e-9)

"""Where the closure of a derived form loses rank: what is only small at a place says nothing against it."""

import pytest

from assur.derivation.derivation import derive
from assur.derivation.rank_losses import rank_losses
from assur.kinematics.contract.check import problems
from assur.model.kernels.reading import names_of
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated


def test_where_nothing_is_known_before_groups_are_those_of_the_written_form():
    record = load_record("zeng2019")
    told = rank_losses(record, (record.file.parent / "closed_form.py").read_text(encoding="utf-8"))
    assert {("v",), ("sin_beta",)} <= {*told} & {*record.closed_form.constraint_singular}


@pytest.mark.deep
@pytest.mark.parametrize("kind", ["4S", "2US"])
@pytest.mark.parametrize("count", [3, 4])
def test_couples_parallel_to_one_plane_are_a_constraint_singularity_of_limbs_that_slide(kind, count, tmp_path):
    """Rods in parallelograms: where the couples that these bear are coplanar they hold one rotation less. Of four limbs
    whole modes are so."""
    path = tmp_path / "own.toml"
    path.write_text(drafted(repeated(f"P[x] P({kind})[y]", count), path).text, encoding="utf-8")
    record, text = load_record(path), derive(load_record(path)).closed_form()
    own = record.with_closed_form(names_of(text, path)["CLOSED_FORM"], text)
    couples = tuple(own.name for own in own.closed_form.factor_list if own.name.startswith("couples"))
    assert len(couples) == {3: 1, 4: 4}[count]
    assert couples in own.closed_form.constraint_singular
    assert problems(own)[0] == ()

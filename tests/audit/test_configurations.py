"""Random configurations: closed, moving on the loops, regular."""

from assur.audit.configurations import configurations, freedoms_with_inputs_locked
from assur.kinematics.closure import closure_error
from assur.model.registry import load_record

RECORD = load_record("zeng2019")


def test_inputs_lock_every_random_configuration():
    here = configurations(RECORD)
    assert {freedoms_with_inputs_locked(RECORD, values) for values in here.values[:10]} == {0}


def test_configurations_close_and_so_do_their_motions():
    here = configurations(RECORD)
    assert len(here.values) == len(here.rates) == len(here.modes) > 50
    assert closure_error(RECORD, here.values).max() < 1e-8
    step = 1e-5
    assert closure_error(RECORD, here.values + step * here.rates).max() < 1e4 * step**2 * 280

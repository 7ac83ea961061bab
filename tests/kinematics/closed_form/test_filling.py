"""Which engine is chosen, and that filling in place and by blocks is the same."""

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closed_form import filling
from assur.kinematics.closed_form.filling import REPAID, REPAID_LOADED, chosen, finished
from assur.kinematics.closed_form.recorded import AnswerRow, recording
from assur.kinematics.closed_form.sweep import inverse_sweep


class Stub:
    """A recording whose loop is loaded, or not."""

    def __init__(self, loaded):
        self.loop = self
        self.loaded = loaded


@pytest.mark.parametrize(
    ("engine", "count", "loaded", "compiled"),
    [
        ("numpy", 10 * REPAID, True, False),
        ("compiled", 1, False, True),
        ("auto", REPAID_LOADED - 1, True, False),
        ("auto", REPAID_LOADED, True, True),
        ("auto", REPAID - 1, False, False),
        ("auto", REPAID, False, True),
    ],
)
def test_auto_compiles_where_that_is_repaid(engine, count, loaded, compiled):
    stub = Stub(loaded)
    assert chosen(engine, count, lambda: stub) is (stub if compiled else None)


def test_auto_does_without_numba_and_compiled_does_not(monkeypatch):
    monkeypatch.setattr(filling.importlib.util, "find_spec", lambda _: None)
    assert chosen("auto", 10 * REPAID, lambda: pytest.fail("recorded")) is None
    zeng = assur.load("zeng2019")
    recording.cache_clear()
    with pytest.raises(UsageError, match="numba"):
        inverse_sweep(zeng, np.zeros((3, 5)), engine="compiled")


def test_refuses_an_unknown_engine_and_threads_below_zero():
    zeng = assur.load("zeng2019")
    with pytest.raises(UnknownNameError, match="compiled"):
        inverse_sweep(zeng, np.zeros((3, 5)), engine="fast")
    with pytest.raises(UsageError, match="threads"):
        inverse_sweep(zeng, np.zeros((3, 5)), threads=-1)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@pytest.mark.parametrize("name", ["zeng2019", "planar_3rpr"])
@pytest.mark.parametrize("listed", [True, False])
def test_refuses_what_is_not_finite(bad, name, listed):
    mechanism = assur.load(name)
    poses = np.zeros((3, 2000))
    poses[2, 1234] = bad
    with pytest.raises(UsageError, match="finite"):
        inverse_sweep(mechanism, list(poses) if listed else poses, want=("exists",), engine="compiled", block=100)


def test_components_in_any_form_have_the_same_bits():
    zeng = assur.load("zeng2019")
    rng = np.random.default_rng(3)
    poses = np.array([rng.uniform(*zeng.box[name], 3000) for name in zeng.platform.pose])
    forms = (poses, list(poses), np.asfortranarray(poses), poses.astype(np.float32), poses[:, ::-1])
    for form in forms:
        found = inverse_sweep(zeng, form, want=("inputs", "exists"), engine="compiled", block=512)
        wanted = inverse_sweep(zeng, form, want=("inputs", "exists"), engine="numpy")
        np.testing.assert_array_equal(found["inputs"], wanted["inputs"])
        np.testing.assert_array_equal(found["exists"], wanted["exists"])


def test_rows_that_numpy_finishes():
    numbers = {"c": np.array([0.0]), "s": np.array([1.0]), **{f"m{k}": np.array([float(k)]) for k in range(16)}}
    assert finished(AnswerRow(("c",)), numbers)[0] == 0
    assert finished(AnswerRow(("c", "s"), "angle"), numbers)[0] == np.pi / 2
    assert finished(AnswerRow(("c", "s"), "angle", -1.0, 0.5), numbers)[0] == 0.5 - np.pi / 2
    numbers |= {f"m{k}": np.array([2.0 if k % 5 == 0 else 0.0]) for k in range(16)}
    square = tuple(f"m{k}" for k in range(16))
    assert round(float(finished(AnswerRow(square, "determinant", -1.0), numbers)[0]), 12) == -16
    assert finished(AnswerRow((*square, *square), "condition_index"), numbers)[0] == 1
    assert finished(AnswerRow((*square, *square), "smallest"), numbers)[0] == 1

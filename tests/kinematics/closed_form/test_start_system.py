"""Start systems: what stands in a file is what monodromy finds from nothing, and one start leads to another."""

import tomllib

import numpy as np
import pytest

from assur.errors import UsageError
from assur.kinematics.closed_form.start_system import FILE, dimensions, family, start_of, start_system
from assur.model.closed_form import PolynomialSystem
from assur.model.registry import load_record, names
from assur.numerics.homotopy import PathEnd, distinct, solve
from assur.numerics.number_types import Floats


def with_systems():
    forms = {name: load_record(name).closed_form for name in names()}
    return [name for name, form in forms.items() if form and isinstance(form.direct, PolynomialSystem)]


@pytest.fixture(params=with_systems())
def record(request):
    return load_record(request.param)


def test_the_stored_start_solves_its_own_system(record):
    system = record.closed_form.direct
    parameters, solutions = start_system(record, system)
    here = family(record, system, parameters, parameters[None])
    gap, _, _ = here.evaluate(solutions, np.ones(len(solutions)), np.zeros(len(solutions), dtype=int))
    assert len(distinct(solutions)) == len(solutions) == system.degree
    assert np.max(np.abs(gap)) < 1e-10 * np.max(np.abs(here.coefficients))


def test_a_start_from_nothing_leads_to_the_solutions_of_the_stored_one(record):
    """Two starts chosen by chance, of which one stands in the file: each of its solutions is reached, and no other."""
    system = record.closed_form.direct
    stored, solutions = start_system(record, system)
    parameters, found = start_of(record, system, seed=3)
    assert len(found) == system.degree
    ends = solve(family(record, system, parameters, stored[None]), found)
    assert np.all(ends.end == PathEnd.regular)
    overlap = np.abs(ends.x.conj() @ solutions.T)
    assert sorted(np.argmax(overlap, axis=1)) == list(range(system.degree))
    np.testing.assert_allclose(np.max(overlap, axis=1), 1.0, atol=1e-9)


def test_the_file_is_what_its_first_line_says(record):
    text = (record.folder / FILE).read_text(encoding="utf-8")
    seed = int(text.split("seed ")[1].split(":")[0])
    data = tomllib.loads(text)
    parameters, solutions = start_of(record, record.closed_form.direct, seed)
    stored = np.array(list(data["start"].values())) @ [1, 1j]
    np.testing.assert_allclose(stored, parameters, rtol=0, atol=2**0.5 * 0.51e-5)
    rough = np.array(data["solutions"]).reshape(*solutions.shape, 2) @ [1, 1j]
    np.testing.assert_allclose(rough, solutions, rtol=0, atol=2**0.5 * 0.51e-5)


def test_equations_hold_at_lifted_poses(record):
    system, p = record.closed_form.direct, record.values
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    for pose in np.random.default_rng(0).uniform(low, high, size=(10, len(low))):
        pose[3:] /= np.linalg.norm(pose[3:])
        inputs = record.closed_form.inverse(Floats(), p, tuple(pose), None).inputs
        x = system.lift(Floats(), p, tuple(pose))
        assert np.max(np.abs(system.equations(Floats(), p, inputs, x))) < 1e-13
        assert abs(system.finite(x)) > 0.5
        back = system.back(Floats(), p, inputs, tuple(-3 * part for part in x))
        np.testing.assert_allclose(np.array(back.pose[:3], dtype=float), pose[:3], rtol=0, atol=1e-14)


def test_angles_are_refused():
    with pytest.raises(UsageError, match="no angles"):
        dimensions(load_record("fivebar"))

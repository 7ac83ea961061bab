"""Poses of platforms that turn in space, counted modulo primes, are as many as the homotopy in floats follows."""

import numpy as np
import pytest

from assur.derivation import residue_systems
from assur.derivation.pose_system import pose_system
from assur.derivation.solution_count import solution_count
from assur.derivation.symbols import GivenSymbols
from assur.derivation.witness import ModularWitness
from assur.kinematics.home import home_values
from assur.kinematics.limbs.networks import limbs_of
from assur.kinematics.platforms.conditions import joined
from assur.kinematics.platforms.limbs import held_limb, limb_conditions
from assur.kinematics.platforms.poses import poses_under
from assur.model.registry import load_record
from assur.numerics.prime_field import SMALL
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains

COUNTED = {"gough_stewart": 40, "three_upu": 78, "three_ups_up": 24, "three_spr": 16, "six_rus": 40}
"""The first and the second as published: F. Ronga and T. Vust 1995; D. Walter and M. L. Husty 2009."""
CHAINS = {
    "spherical": (["U[x,y] P[z] S", "U[x,y] P[z] S", "U[x,y] P[z] S", "S"], None),
    "three_ups_up": (["U P S", "U P S", "U P S", "U[x,y] P[z]"], ["1.2", "2.2", "3.2"]),
    "three_spr": (["S P[z] R[x]", "S P[z] R[y]", "S P[z] R[x]"], None),
    "six_rus": (["R[x] U S", "R[y] U S"] * 3, None),
    "parallelogram": (["R[x] P(4R)[y] P[z] S", *["U P S"] * 5], None),
}


def record_of(name, tmp_path):
    if name not in CHAINS:
        return load_record(name)
    chains, actuate = CHAINS[name]
    path = tmp_path / f"{name}.toml"
    path.write_text(drafted(parse_chains(chains), path, actuate=actuate).text, encoding="utf-8")
    return load_record(path)


def numbers(record):
    """What limbs hold the platform to in floats, at inputs by chance: linear forms, quadrics, complex poses."""
    values = home_values(record) + np.random.default_rng(1).uniform(0.05, 0.3, len(record.coordinates))
    held = {own.coordinate.index: float(values[own.coordinate.index]) for own in record.inputs}
    conditions = joined(limb_conditions(held_limb(limb, held), 100.0) for limb in limbs_of(record))
    return len(conditions.linear), len(conditions.quadrics), poses_under(conditions, 100.0).complex


@pytest.mark.parametrize("name", ["spherical"])
def test_as_many_forms_and_poses_as_in_floats(name, tmp_path, monkeypatch):
    monkeypatch.setattr(residue_systems.shutil, "which", lambda _: None)
    record = record_of(name, tmp_path)
    system = pose_system(GivenSymbols(record, "direct", ModularWitness(3, SMALL)))
    linear = sum(max(map(sum, own)) == 1 for own in system.polynomials)
    count, program = system.count(60.0)
    assert (linear, len(system.polynomials) - linear - 2, count) == numbers(record)
    assert program == "linear algebra"


@pytest.mark.deep
@pytest.mark.parametrize("name", [*COUNTED, "parallelogram"])
def test_platforms_in_space_are_counted(name, tmp_path, monkeypatch):
    monkeypatch.setattr(residue_systems.shutil, "which", lambda _: None)
    own = solution_count(record_of(name, tmp_path), "direct")
    assert (own.solutions, own.of, own.why) == (COUNTED.get(name, 40), "poses", "")

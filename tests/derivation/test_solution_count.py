"""Solutions counted modulo primes, without the elimination, are as many as the derived branches."""

import itertools
import math
import os
import stat
import subprocess
import sys

import numpy as np
import pytest

from assur.derivation import residue_systems
from assur.derivation.residue_systems import ResidueSystem, staircase
from assur.derivation.solution import analytic_solution
from assur.derivation.solution_count import solution_count
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chains

QUICK = ("fivebar",)
OTHERS = ("zeng2019", "planar_3rpr", "planar_3rrr", "three_rrc", "delta_4s", "linear_delta_4s", "linear_delta_4r",
          "orthoglide", "tsai_platform", "three_p2us", "three_crr", "tripteron")  # fmt: skip


@pytest.fixture
def no_msolve(monkeypatch):
    monkeypatch.setattr(residue_systems.shutil, "which", lambda _: None)


@pytest.mark.parametrize("name", [*QUICK, *(pytest.param(name, marks=pytest.mark.deep) for name in OTHERS)])
def test_the_count_is_that_of_the_branches(name, no_msolve):
    record = load_record(name)
    own = solution_count(record, "direct")
    assert (own.solutions, own.why, own.program) == (analytic_solution(record, "direct").branches, "", "linear algebra")
    assert len({*own.primes}) == 2


@pytest.mark.deep
def test_rods_on_hinges_that_a_turning_link_carries_are_counted(no_msolve, tmp_path):
    path = tmp_path / "draft.toml"
    chains = ["C[x] P(4R)[y] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"]
    path.write_text(drafted(parse_chains(chains), path).text, encoding="utf-8")
    # The first limb has two cranks, each with two rods; the others have two elbows each.
    assert solution_count(load_record(path), "inverse").solutions == 4 * 2 * 2


CIRCLES = ResidueSystem(101, 2, ({(2, 0): 1, (0, 2): 1, (0, 0): 100}, {(1, 1): 1, (0, 0): 98}))
"""x^2 + y^2 = 1 and x y = 3."""


def test_a_count_over_the_time_is_none(no_msolve):
    with pytest.raises(TimeoutError, match="not counted"):
        CIRCLES.count(0.01)


@pytest.mark.parametrize(
    ("polynomials", "expected"),
    [
        (({(1, 0): 1, (0, 1): 1}, {(1, 0): 2, (0, 1): 2, (0, 0): 1}), 0),
        (({(1, 0): 1, (0, 1): 1}, {(1, 0): 1, (0, 1): 100}), 1),
        (({(2, 0): 1, (0, 1): 1},), None),
        (({(2, 0): 1, (0, 0): 1}, {(0, 2): 1, (0, 0): 100}), 4),
        (({(2, 0): 1, (0, 0): 1}, {(2, 0): 1, (0, 0): 3}), 0),
    ],
)
def test_none_and_infinitely_many_are_told(polynomials, expected, no_msolve):
    assert ResidueSystem(101, 2, polynomials).count(60.0)[0] == expected


@pytest.mark.parametrize(("degrees", "shared"), [((2, 2, 2), 0), ((2, 2, 2), 1), ((2, 3, 2), 2), ((2, 2, 2, 2), 2)])
def test_linear_algebra_and_a_groebner_basis_count_alike(degrees, shared):
    """Solutions at infinity are left out by both: highest parts of some polynomials are multiples of one another's."""
    random, p, unknowns = np.random.default_rng(shared), 10007, 3
    monomials = list(itertools.product(range(4), repeat=unknowns))
    drawn = [{own: int(random.integers(1, p)) for own in monomials if sum(own) <= degree} for degree in degrees]
    for own in drawn[1 : 1 + shared]:
        own |= {powers: part for powers, part in drawn[0].items() if sum(powers) == max(map(sum, own)) == 2}
    answer = residue_systems._count(p, unknowns, [[*own.items()] for own in drawn])
    basis = residue_systems._leading(p, unknowns, [[*own.items()] for own in drawn])
    assert answer == (staircase(basis, unknowns), "linear algebra")
    assert answer[0] < math.prod(degrees) or not shared


@pytest.mark.deep
def test_three_limbs_of_two_circles_each_are_counted(no_msolve, tmp_path):
    """Six quadrics in six unknowns, which have no solution at infinity."""
    path = tmp_path / "draft.toml"
    path.write_text(drafted(repeated("R[y] P(4R)[x] R[y] R[y]", 3), path).text, encoding="utf-8")
    own = solution_count(load_record(path), "direct")
    assert (own.solutions, own.program) == (2**6, "linear algebra")


@pytest.mark.skipif(os.name != "posix", reason="no limit of the processor's time")
def test_time_is_that_of_the_processor():
    """So an answer does not depend on what else runs: who waits takes no time, who works is stopped."""
    waits, works = ([sys.executable, "-c", own] for own in ("import time; time.sleep(2.0)", "while True: pass"))
    assert residue_systems._run(waits, 1.0).returncode == 0
    with pytest.raises(subprocess.TimeoutExpired):
        residue_systems._run(works, 1.0)


def test_a_program_on_the_path_is_asked_first(tmp_path, monkeypatch):
    """What it is given and what it answers are as msolve 0.9 has them."""
    program = tmp_path / "msolve"
    head = "#Leading ideal data\\n#---\\n#field characteristic: 101\\n#---\\n"
    lines = ["#!/bin/sh", f'cp "$6" {tmp_path}/given', f"printf '{head}[x1^1*x2^1,\\nx1^2,\\nx2^3]:\\n' > \"$8\""]
    program.write_text("\n".join(lines) + "\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setattr(residue_systems.shutil, "which", lambda _: str(program))
    assert CIRCLES.count(60.0) == (4, "msolve")
    assert (tmp_path / "given").read_text() == "x1,x2\n101\n1*x1^2+1*x2^2+100,\n1*x1^1*x2^1+98\n"

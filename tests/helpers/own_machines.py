"""Mechanisms of one's own that are in no catalogue: what somebody might draft, each here for what it has."""

from functools import lru_cache
from pathlib import Path
from tempfile import mkdtemp

import pytest

import assur
from assur.cli.main import main
from screw_mechanisms import FIVEBAR, loaded

PAR4 = Path(__file__).parents[1] / "kinematics" / "following" / "par4.toml"
HYBRID = ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]")
DRAFTS = {
    "six_ups": ["6-UPS"],
    "two_upr_two_rpu": ["2UPR-2RPU"],
    "hybrid": ["--chain", HYBRID[0], "--chain", HYBRID[1]],
    "three_prr": ["--limb", "P[x] R[z] R[z]", "--count", "3"],
}
"""Ball joints and a quaternion; more drives than freedoms; a loop in a limb, a cylindrical joint; an angle alone."""
OWN = ("screws", "par4", *DRAFTS)
ELASTIC = {
    "parallelograms": ["--chain", HYBRID[0], "--chain", "R[y] P(4R)[x] R[y] R[y]"],
    "six_rus": ["6-RUS"],
    "three_rrrp": ["--limb", "R[z] R[z] R[z] P[z]", "--count", "3"],
}
"""A hybrid with a parallelogram, rods that spin between balls, and limbs that hold the platform twice."""


@lru_cache
def own_machine(name):
    """The mechanism: two sliders on ball screws, a platform that folds, or a draft."""
    if name == "screws":
        return loaded(mkdtemp(), FIVEBAR)
    if name == "par4":
        return assur.load(PAR4)
    path = Path(mkdtemp()) / f"{name}.toml"
    assert main(["new", str(path), *{**DRAFTS, **ELASTIC}[name]]) == 0
    return assur.load(path)


def every_mechanism():
    """A fixture of all built-in mechanisms, and of drafts that are elastic in ways of their own."""

    @pytest.fixture(params=[*assur.names(), *(pytest.param(name, marks=pytest.mark.deep) for name in ELASTIC)])
    def mechanism(request):
        return own_machine(request.param) if request.param in ELASTIC else assur.load(request.param)

    return mechanism

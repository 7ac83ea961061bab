"""A knee's formula tells the branches of a limb apart, and home is the branch that is meant."""

import itertools
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics.pose import pose_of
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.knees import knee
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chain, parse_chains

WITH = ["R[z] R[z] R[z]", "P[x] R[x] R[x] R[x]", "R[y] R[y] C[y]", "R[y] P(4S)[y]", "P[z] P(2US)[y]", "R[x] R[x] S"]
WITHOUT = ["U P S", "R[y] R[x] S", "R[y] P(4S)[x]", "R[y] P(4R)[y]", "R[z]@A R[z]@A R[z]", "{R[z] | R[z]} R[z]", "S"]


def of(text):
    chain = parse_chain(text)
    return knee(chain, "ABCDE"[: len(chain.joints)])


@pytest.mark.parametrize("text", WITH)
def test_a_limb_with_a_knee(text):
    assert of(text) is not None


@pytest.mark.parametrize("text", WITHOUT)
def test_a_limb_without(text):
    assert of(text) is None


@pytest.mark.parametrize("text", ["R[z] R[z] R[z]", "R[y] P(4S)[y]", "P[z] P(4S)[y]"])
def test_all_branches_for_one_pose_have_names_of_their_own(tmp_path, text):
    path = tmp_path / "my.toml"
    path.write_text(drafted(repeated(text, 3), path).text, encoding="utf-8")
    mechanism = assur.load(path)
    home = mechanism.home_values
    found = mechanism.inverse(pose_of(mechanism, home))
    names = sorted(str(label) for label in found.labels[found.exists])
    assert names == sorted("".join(signs) for signs in itertools.product("+-", repeat=3))
    meant = found.inputs[found.exists & (found.labels == "+++")]
    driven = [mechanism.coordinates.index(item.coordinate) for item in mechanism.inputs]
    assert np.max(np.abs(meant - home[driven])) < 1e-6


def test_a_limb_without_a_knee_leaves_the_modes_without_names():
    assert "[modes]" in drafted(parse_chains(["R[z] R[z] R[z]"] * 2), Path("my.toml")).text
    assert "[modes]" not in drafted(parse_chains(["R[z] R[z] R[z]", "R[z] R[z]"]), Path("my.toml")).text

"""Architectural singularity: the dimensions alone let the platform move while every input stands still.

Of a mechanism whose inputs depend on one another at every configuration the joints' places are moved by chance, their
directions kept. Where the inputs are independent then, and there are as many freedoms as before, the choice of the
inputs is not to blame but the dimensions are (O. Ma, J. Angeles, Architecture singularities of platform
manipulators, ICRA 1991).
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import RANK_GAP
from assur.kinematics.home import home_values
from assur.kinematics.rates.motions import Ranks, general, motions
from assur.model.mechanism import MechanismRecord
from assur.results.plain_text import count

MOVED = 0.1
"""By how much, in characteristic lengths, places are moved: what depends on them alone is then far from singular."""


@lru_cache(maxsize=64)
def self_motion_dimension(record: MechanismRecord) -> int:
    """In how many ways the platform still moves with all inputs held, at every configuration; 0 of usual dimensions.

    0, too, where other inputs than the file's are wanted.

    >>> from assur.model.registry import load_record
    >>> self_motion_dimension(load_record("gough_stewart"))
    0
    """
    usual, driven = general(record), len(record.inputs)
    lost = driven - int(usual.inputs)
    if not lost or driven != int(usual.freedoms - usual.internal):
        return 0
    other = _with_other_places(record)
    ranks = motions(other, home_values(record), RANK_GAP).ranks
    alike = int(ranks.closure) == int(usual.closure) and int(ranks.internal) == int(usual.internal)
    return lost if alike and int(ranks.inputs) == driven else 0


def architecture_text(record: MechanismRecord) -> str:
    """That a mechanism is architecturally singular, and in how many ways it moves; "" where it is not."""
    ways = self_motion_dimension(record)
    moves = f"with every input held the platform still moves in {count(ways, 'way')}, at every configuration"
    return f"architecturally singular: {moves}" if ways else ""


def usual_ranks(record: MechanismRecord) -> Ranks:
    """Ranks in general by which a configuration is judged: the inputs count as with other dimensions.

    So an architecturally singular mechanism is singular everywhere.

    >>> from assur.model.registry import load_record
    >>> int(usual_ranks(load_record("gough_stewart")).inputs)
    6
    """
    usual = general(record)
    return replace(usual, inputs=usual.inputs + self_motion_dimension(record))


def _with_other_places(record: MechanismRecord) -> MechanismRecord:
    """The mechanism with its joints moved by chance; its loops need not close."""
    rng, size = np.random.default_rng(0), MOVED * characteristic_length(record)
    moved = {
        name: replace(
            joint,
            at=joint.at + size * rng.normal(size=3),
            child_at=joint.child_at + size * rng.normal(size=3),
        )
        for name, joint in record.joints.items()
    }
    return replace(record, joints=moved)

"""Where the closure of a derived form loses rank: which factors vanish there."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import pose
from assur.kinematics.contract.borders import ends
from assur.kinematics.contract.kernel import recorded
from assur.kinematics.contract.solutions import Solutions, solutions
from assur.kinematics.contract.zeros import SAME, zeros_of
from assur.kinematics.home import home_values
from assur.kinematics.rates.motions import general, motions
from assur.kinematics.status import closed_form_of, relative_factors
from assur.model.closed_form import ClosedForm
from assur.model.kernels.reading import names_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

Group = tuple[str, ...]
PLACES = 256
"""Poses that are looked at, about home."""
ZERO = 1e-12
"""Share of its size up to which a factor vanishes beyond doubt: one within `SAME` may be small only, as where another
one vanishes; the rank says nothing there of both.
"""
FAR = 1.0
"""Half the range of the poses, in characteristic lengths and rad."""


def rank_losses(record: MechanismRecord, text: str, known: Group = ()) -> tuple[Group, ...]:
    """Groups of factors where the closure loses rank: the smallest sets that vanish at such places and at no other.

    Args:
        record: of the mechanism.
        text: its closed form, whose groups are not looked at.
        known: factors that are known to vanish together there and nowhere else, if there are any: a mode in which they
            do so everywhere has no place where another factor shows it.
    """
    form: ClosedForm = names_of(text, Path("closed_form.py"))["CLOSED_FORM"]
    own = record.with_closed_form(form, text)
    lost, kept = {frozenset(known)} if known else set[frozenset[str]](), set[frozenset[str]]()
    for places in _singular_places(own):
        shares = {name: np.abs(value) for name, value in relative_factors(own, places.factors).items()}
        vanishing = {name: share <= SAME for name, share in shares.items()}
        beyond_doubt = np.all([(share <= ZERO) | (share > SAME) for share in shares.values()], axis=0)
        usual = motions(own, places.joints).ranks.closure == int(general(own).closure)
        for row in range(len(places)):
            group = frozenset(name for name, zero in vanishing.items() if zero[row])
            if not usual[row]:
                lost.add(group)
            elif beyond_doubt[row]:
                kept.add(group)
    smallest = [group for group in lost if not any(other < group for other in lost)]
    return tuple(
        sorted(tuple(sorted(group)) for group in smallest if group and not any(group <= other for other in kept))
    )


def _singular_places(record: MechanismRecord) -> Iterator[Solutions]:
    """Solutions at which factors vanish: between places, and where branches end."""
    home = pose.pose_of(record, home_values(record))
    length = characteristic_length(record)
    scales = np.array([length if name in LENGTHS else 1.0 for name in record.platform.pose])
    random = np.random.default_rng(0)
    poses = home + FAR * scales * random.uniform(-1.0, 1.0, (PLACES, len(home)))
    answer, kernel = solutions(record, "inverse", poses), recorded(record, "inverse")
    for factor in closed_form_of(record).factor_list:
        if not kernel.outputs["factor"][factor.name]:  # of dimensions alone
            continue
        yield zeros_of(kernel, answer, factor.name)
    border = ends(record, "inverse", poses, random)
    if len(border.given):
        yield solutions(record, "inverse", border.given)

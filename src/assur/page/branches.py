"""The branches of a page: every set of inputs at home's pose, every pose at each of these, the current one first."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem, all_modes, mode_signs, sign_names
from assur.kinematics.naming import described_signs, mode_names
from assur.kinematics.postures import Posture, postures, unwound
from assur.kinematics.rates.finite_motion import classify_at
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
WITH_ASSEMBLIES = 16
"""Of how many working modes the other assembly modes are looked for: each takes 0.1 to 0.3 s, and six limbs have 64."""


def branches(record: MechanismRecord) -> dict[str, list[dict[str, Any]]]:
    """Assembly modes at home's inputs and working modes at home's pose: label, joint values and status of each.

    Home itself stands first in both, with its joint values as they are, and is marked: its "home" is true. It is called
    "home" where no solution is it (an arc of a self-motion, a crossed parallelogram), and has its own status. Every
    other working mode has "assembly" too: the assembly modes at its own inputs, itself first; it is alone there where
    the inputs do not hold the platform, and beyond the first `WITH_ASSEMBLIES`, which are marked "lone": of these no
    other one was looked for. Angles are those nearest to home's.

    >>> from assur.model.registry import load_record
    >>> found = branches(load_record("fivebar"))
    >>> [len(found["assembly"]), len(found["working"])]
    [2, 4]
    >>> {item["label"]: [pose["label"] for pose in item["assembly"]] for item in found["working"][1:]}
    {'++': ['+', '-'], '+-': ['-', '+'], '--': ['+', '-']}
    """
    home = home_values(record)
    first, *others = _listed(record, home, "inverse", "home")
    own, *poses = _listed(record, home, "direct", "home")
    return {
        "assembly": [{**_plain(own), "home": True}, *map(_plain, poses)],
        "working": [
            {**_plain(first), "home": True},
            *(
                {**_plain(item), "assembly": _assembly(record, home, item)}
                if k < WITH_ASSEMBLIES
                else {**_plain(item), "assembly": [_alone(record, item)], "lone": True}
                for k, item in enumerate(others, start=1)
            ),
        ],
    }


def modes(record: MechanismRecord) -> dict[str, Any]:
    """Names of the signs of working and assembly modes, what + means of each, every row of signs of a working mode."""
    rows = [list(mode_signs(record, "inverse", text)) for text in all_modes(record, "inverse")]
    return {
        "working": {
            "names": list(sign_names(record, "inverse")),
            "all": rows if sign_names(record, "inverse") else [[]],
            "default": record.modes.default_working,
            "said": [sign.said for sign in described_signs(record, "inverse")],
        },
        "assembly": {
            "names": list(sign_names(record, "direct")),
            "said": [sign.said for sign in described_signs(record, "direct")],
        },
    }


def _assembly(record: MechanismRecord, home: FloatArray, posture: Posture) -> list[dict[str, Any]]:
    """Assembly modes at the inputs of another working mode, itself first."""
    alone = _alone(record, posture)
    if posture.status is not Status.regular:  # the platform moves by itself there, or as good as
        return [alone]
    first, *others = _listed(record, posture.values, "direct", alone["label"])
    return [_plain(first), *({**_plain(row), "values": unwound(record, row.values, home).tolist()} for row in others)]


def _alone(record: MechanismRecord, posture: Posture) -> dict[str, Any]:
    """A working mode as the assembly mode that it is."""
    return {**_plain(posture), "label": mode_names(record, posture.values)[1] or "this one"}


def _listed(record: MechanismRecord, values: FloatArray, problem: Problem, name: str) -> list[Posture]:
    """Postures at an assembly (n,), itself first; where none is it, it has the given name and its own status."""
    found = postures(record, values, problem)
    own = found.current or Posture(name, values, Status(int(classify_at(record, values))), None)
    return [own, *found.others]


def _plain(posture: Posture) -> dict[str, Any]:
    return {"label": posture.label, "values": posture.values.tolist(), "status": posture.status.name}

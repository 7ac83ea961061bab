"""Signs of modes, kept in the user's cache: plain data, by the mechanism's file, its dimensions and assur's version.

Whole lines of comments do not count, as they may say what was found; nor what the mechanism is called.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.cache import code_digest, keep, own_content
from assur.kinematics.closing_blocks.ball_ends import ball_ended_values, with_ball_ends
from assur.kinematics.closing_blocks.blocks import ClosingBlock, Spin
from assur.kinematics.closing_blocks.carried import carried
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.kinematics.closing_blocks.distinguishing import ModeSign, distinguishing_signs
from assur.kinematics.closing_blocks.platform_signs import FacingSign, OperationSign, ReachSign
from assur.kinematics.closing_blocks.sentences import sentence
from assur.kinematics.closing_blocks.signs import BlockSign, Factor
from assur.kinematics.closing_blocks.strokes import StrokeSign
from assur.kinematics.modes import Problem
from assur.model.dimensions import of_file
from assur.model.mechanism import MechanismRecord
from assur.version import VERSION

KIND = "modes"
ALIKE = ("configurations", "related", "starts", "still")
CODE = (Path(__file__).parent, *(Path(__file__).parents[1] / f"{name}.py" for name in ALIKE))
"""The code that finds them: another way to choose signs, or assemblies, makes other names."""
LARGEST = 10_000_000
"""Bytes of an entry; a larger one is none of ours."""
CALLED = re.compile(r"(name|title)\s*=")
"""Lines before the first table that decide no sign."""


@lru_cache(maxsize=64)
def kept_signs(record: MechanismRecord, problem: Problem) -> tuple[ModeSign, ...]:
    """The signs that name the modes of a problem, and what each means: `distinguishing_signs`, once for each file.

    >>> from assur.model.registry import load_record
    >>> [sign.joints for sign in kept_signs(load_record("planar_3rpr"), "direct")]
    [('A1', 'A2', 'A3', 'B1', 'B2', 'B3')]
    """
    if record.modes.of_file != record.modes:  # the closed form has the names that there are with the file's dimensions
        own = of_file(record).without_closed_form
        return kept_signs(own, problem) if _directions(own) == _directions(record) else carried_signs(record, problem)
    if record.description is None:
        return distinguishing_signs(record, problem)
    name = _name(record, problem)
    content = own_content(KIND, name, LARGEST)
    digest, _, body = (content or b"").partition(b"\n")
    if body and digest.decode("ascii", "replace") == hashlib.sha256(body).hexdigest():
        with suppress(ValueError, TypeError, KeyError, RecursionError):
            return tuple(ModeSign(tuple(map(_factor, parts)), meaning) for meaning, parts in json.loads(body))
    signs = tuple(replace(sign, meaning=sentence(record, sign)) for sign in distinguishing_signs(record, problem))
    body = json.dumps([[sign.meaning, [_data(factor) for factor in sign.factors]] for sign in signs]).encode()
    with suppress(OSError):
        keep(KIND, name, hashlib.sha256(body).hexdigest().encode() + b"\n" + body)
    return signs


@lru_cache(maxsize=16)
def carried_signs(record: MechanismRecord, problem: Problem) -> tuple[ModeSign, ...]:
    """The signs of the file's dimensions in the spaces that screws span with others, by which axes point elsewhere.

    >>> from assur.model.registry import load_record
    >>> [sign.joints for sign in carried_signs(load_record("fivebar", l1=130), "direct")]
    [('B1', 'B2', 'P')]
    """
    signs = kept_signs(of_file(record).without_closed_form, problem)
    own = {sign.joints: sign for sign in distinguishing_signs(record.without_closed_form, problem)}
    return tuple(carried(sign, own.get(sign.joints)) for sign in signs)


def _directions(record: MechanismRecord) -> list[list[float]]:
    """Axes of all joints, in the frames of their links."""
    parts = [(joint.axes, joint.turn) for joint in record.joints.values()]
    return [np.concatenate([np.ravel(own) for own in part]).tolist() for part in parts]


def kept_signs_at(record: MechanismRecord, problem: Problem, joints: NDArray[np.float64]) -> NDArray[np.int8]:
    """These signs (..., s) at joint values (..., n); 0 where a block is singular."""
    own, ball_ended = kept_signs(record, problem), with_ball_ends(record)
    values = ball_ended_values(record, np.reshape(joints, (-1, joints.shape[-1])))
    platform = any(sign.needs_platform(ball_ended) for sign in own)
    screws = ScrewColumns(ball_ended, values, platform)
    signs = [sign.signs(screws) for sign in own] if len(screws.values) else []
    columns = np.array(signs, dtype=np.int8).reshape(len(own), len(screws.values)).T
    return columns.reshape(*joints.shape[:-1], len(own))


def _name(record: MechanismRecord, problem: Problem) -> str:
    head, *tables = re.split(r"(?m)^(?=\[)", record.description.text if record.description else "")
    lines = [*(line for line in head.splitlines() if not CALLED.match(line)), *"".join(tables).splitlines()]
    text = "\n".join(line for line in lines if line.strip() and not line.startswith("#"))
    own = {name: float(value).hex() for name, value in sorted(record.overrides.items())}
    parts = (VERSION, code_digest(*CODE), problem, json.dumps(own), text)
    return hashlib.sha256("\0".join(parts).encode()).hexdigest() + ".json"


def _data(factor: Factor) -> dict[str, Any]:
    if isinstance(factor, OperationSign):
        return {"home": factor.home.tolist(), "form": factor.form.tolist(), "axes": factor.axes.tolist()}
    if isinstance(factor, ReachSign):
        return {"hinge": factor.hinge, "direction": factor.direction.tolist(), "length": factor.length}
    if isinstance(factor, FacingSign):
        return {"row": factor.row, "column": factor.column, "home": factor.home}
    if isinstance(factor, StrokeSign):
        return {"slide": factor.slide, "near": factor.near, "far": factor.far, "size": factor.size}
    block = factor.block
    return {
        "joints": block.joints,
        "loops": [dict(loop) for loop in block.loops],
        "columns": block.columns,
        "owners": block.owners,
        "spins": [[spin.first, spin.second, list(spin.senses)] for spin in block.spins],
        "links": factor.links,
        "rates": factor.rates.tolist(),
        "basis": factor.basis.tolist(),
        "size": factor.size,
    }


def _factor(data: Mapping[str, Any]) -> Factor:
    if "form" in data:
        return OperationSign(np.array(data["home"]), np.array(data["form"]), np.array(data["axes"]))
    if "hinge" in data:
        return ReachSign(data["hinge"], np.array(data["direction"]), float(data["length"]))
    if "row" in data:
        return FacingSign(data["row"], data["column"], float(data["home"]))
    if "slide" in data:
        return StrokeSign(data["slide"], data["near"], data["far"], float(data["size"]))
    block = ClosingBlock(
        tuple(data["joints"]),
        tuple(data["loops"]),
        tuple(data["columns"]),
        tuple(data["owners"]),
        tuple(Spin(first, second, (senses[0], senses[1])) for first, second, senses in data["spins"]),
    )
    return BlockSign(block, tuple(data["links"]), np.array(data["rates"]), np.array(data["basis"]), float(data["size"]))

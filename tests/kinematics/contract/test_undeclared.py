"""Divisors and radicands that nothing declares are found where they do harm, with the line; else they are noted."""

from __future__ import annotations

import pytest

from assur.kinematics.contract.check import problems, unproved
from assur.kinematics.contract.extent import AT_LOAD, IN_FULL
from assur.model.registry import CLOSED_FORM, load_record

ARM = "arm1 = sign.s1 * ns.sqrt(height1)"
WRONG = {
    "a divisor that vanishes on a line": (
        "biglide", ((ARM, f"{ARM} * ((y - 77) / (y - 77))"),), "divisor", "(y - 77)"),
    "a divisor that vanishes at a point": (
        "biglide",
        ((ARM, f"far = (x - 7) * (x - 7) + (y - 99) * (y - 99)\n    {ARM} * (far / far)"),), "divisor", "far / far"),
    "a radicand that is no margin": (
        "biglide", ((ARM, f"{ARM} + ns.sqrt(x + 100) - ns.sqrt(x + 100)"),), "radicand", "x + 100"),
    "a row of both Jacobians that vanishes": (
        "biglide",
        (("jp = ((core.arm1, core.y)", "jp = ((core.arm1 * (core.x - 30), core.y * (core.x - 30))"),
         ("jq = ((core.arm1, 0)", "jq = ((core.arm1 * (core.x - 30), 0)"),
         ('"gap": core.arm1 - core.arm2', '"gap": (core.arm1 - core.arm2) * (core.x - 30)'),
         ('"arm1": core.arm1,', '"arm1": core.arm1 * (core.x - 30),')),
        "factor gap", '"gap"'),
    "a divisor of a joint value": (
        "biglide", (('"S2": core.q2,', '"S2": core.q2 / (core.x - 11) * (core.x - 11),'),), "divisor", "return {"),
}  # fmt: skip


@pytest.mark.parametrize("what", WRONG)
def test_what_is_not_declared_and_does_harm_is_refused(copied, what):
    name, changes, told, line = WRONG[what]
    record = load_record(copied(name, *changes))
    found, _ = problems(record, IN_FULL)
    assert found
    assert found[0].path.startswith(told)
    text = (record.file.parent / CLOSED_FORM).read_text(encoding="utf-8").splitlines()
    assert line in text[found[0].line - 1]


def test_what_does_no_harm_is_noted(copied):
    """(x + 5 y)^2 + (x - 5 y)^2 + 1, written out: never zero, but no sum of squares as it stands."""
    written = "26 * x * x + 26 * y * y - 20 * x * y + 20 * x * y + 24 * (x * x + y * y) + 1"
    folder = copied("biglide", (ARM, f"one = {written}\n    {ARM} * (one / one)"))
    record = load_record(folder)
    assert problems(record, AT_LOAD) == ((), True)
    assert problems(record, IN_FULL) == ((), True)
    assert len(unproved(record)) == 1

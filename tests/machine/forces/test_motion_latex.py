"""The equation of motion as LaTeX, read again by a reader of its own and worked out in numbers."""

import re

import numpy as np
import pytest

import assur
from assur.machine.forces.motion_formulas import motion_formulas
from assur.machine.forces.motion_latex import document
from latex_numbers import Reader


@pytest.mark.parametrize(("name", "pose"), [("zeng2019", [-15.0, 10.0, 440.0]), ("fivebar", [30.0, 200.0])])
def test_what_is_written_has_the_numbers_of_the_forces(name, pose):
    mechanism = assur.load(name)
    text = document(motion_formulas(mechanism))
    (dimensions,) = re.findall(r"dimensions are\n\$(.*)\$\.", text)
    letters = dict(zip(mechanism.platform.pose, pose, strict=True))
    letters |= {own: float(value) for own, value in re.findall(r"(\S+) = ([-\d.]+)", dimensions)}
    for left, right in re.findall(r"^(\S+) &= (.*?)(?: \\\\)?$", text, re.MULTILINE):
        letters[left] = Reader(letters).value(right)
    answer = mechanism.forces(pose)
    size = range(1, len(pose) + 1)
    mass = [[letters.get(rf"\mathbf{{M}}_{{{min(i, j)}{max(i, j)}}}", 0.0) for j in size] for i in size]
    np.testing.assert_allclose(mass, answer.mass_matrix[0], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(
        [letters.get(rf"\mathbf{{g}}_{{{i}}}", 0.0) for i in size], answer.gravity[0], rtol=1e-9, atol=1e-9
    )
    driven = np.array([[letters.get(rf"\mathbf{{D}}_{{{k}{i}}}", 0.0) for i in size] for k in size])
    unit = 1.0 if mechanism.inputs[0].coordinate.kind == "length" else 1e3
    np.testing.assert_allclose(driven.T @ answer.forces[0] * unit, answer.gravity[0], rtol=1e-9, atol=1e-9)

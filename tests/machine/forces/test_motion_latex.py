"""The equation of motion as LaTeX, read again by a reader of its own and worked out in numbers."""

import re
from itertools import product

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
    random, size = np.random.default_rng(0), range(1, len(pose) + 1)
    velocity, acceleration = random.normal(size=(2, len(pose))) * np.array([[200.0], [3000.0]])
    load = random.normal(size=len(pose))
    given = zip(mechanism.platform.pose, pose, velocity, acceleration, load, strict=True)
    letters = {}
    for own, *numbers in given:
        letters |= zip((own, rf"\dot{{{own}}}", rf"\ddot{{{own}}}", rf"f_{{{own}}}"), numbers, strict=True)
    letters |= {own: float(value) for own, value in re.findall(r"(\S+) = ([-\d.]+)", dimensions)}
    for left, right in re.findall(r"^(\S+) &= (.*?)(?: \\\\)?$", text, re.MULTILINE):
        assert left not in letters
        letters[left] = Reader(letters).value(right)
    answer = mechanism.forces(pose, velocity, acceleration, [*load, *[0.0] * (3 - len(load))])

    def close(form, *numbers):
        told = [letters.get(form % places, 0.0) for places in product(size, repeat=numbers[0].ndim)]
        np.testing.assert_allclose(told, numbers[0].ravel(), rtol=1e-9, atol=1e-9)

    close(r"\mathbf{M}_{%d%d}", np.triu(answer.mass_matrix[0]))
    close(r"\mathbf{c}_{%d}", answer.bias[0] * 1e3)
    close(r"\mathbf{g}_{%d}", answer.gravity[0])
    close(
        r"\boldsymbol{\tau}_{%d}", answer.forces[0] * (1.0 if mechanism.inputs[0].coordinate.kind == "length" else 1e3)
    )

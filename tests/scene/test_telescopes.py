"""Telescopes: tubes and rods as long as a stroke asks for."""

import numpy as np

import assur
from assur.scene.bodies import home_skeleton
from assur.scene.parts import machine, unit
from assur.scene.strokes import strokes


def test_a_legs_rod_is_held_in_its_tube_up_to_the_end_of_the_stroke():
    record = assur.load("three_rps")
    made = {part.name: part.shape for part in machine(record)}
    drawn = home_skeleton(record)
    for mark in drawn.marks:
        if mark.telescopes:
            low, high = strokes(record)[mark.joint.name]
            shapes = [made[f"{mark.joint.name} {role}"] for role in ("tube", "rod")]
            tube, rod = (np.linalg.norm(shape.end - shape.start) for shape in shapes)
            assert tube < low
            assert rod < np.linalg.norm(mark.at - mark.rail)
            assert high - rod < tube - unit(drawn)

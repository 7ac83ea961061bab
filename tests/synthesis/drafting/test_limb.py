"""A limb's joints: at home both its links put each joint in the same place, with the axes of the notation."""

from pathlib import Path

import numpy as np
import pytest

from assur.joint_graph.frames import frames
from assur.kinematics.closure import closure_error
from assur.model.file.reader import read_text
from assur.synthesis.drafting.document import Chosen, DrivenJoint, document
from assur.synthesis.drafting.layout import LAYOUTS, own_stations
from assur.synthesis.drafting.templates import draft
from assur.topology.notation import parse_chain, parse_chains

PATH = Path("my.toml")
LIMBS = [
    ("R[y] P(4S)[y]", "P[z] P(2US)[y]", "R[y] P(4U)[y] R[y]", "P[x] R[y] P(4R)[z] R[y]"),
    ("U P S", "S P S", "R P[z] C[x] H[y]", "P[x] P[y] P[z]"),
    ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "{R[y] P(4S)[y] | R[y] S | S} R[z] P", "P {R[x] S | S} P[z] S"),
    ("R[x]@O R[1,1,1]@O R[z]@O", "R[y]@O R[-1,1,1]@O R[z]@O", "R[x]@B U[y,z]@B S@C R@C"),
]


@pytest.mark.parametrize("layout", [layout for group in LAYOUTS for layout in group])
@pytest.mark.parametrize("texts", LIMBS)
def test_what_is_drawn_closes_and_has_the_axes_that_were_written(texts, layout):
    chains = parse_chains(texts)
    found = draft(chains, layout)
    driven = DrivenJoint(found.joint_of(0, 0), "first" if texts[0].startswith("U") else "")
    chosen = Chosen("my", (), ("x", "y", "z"), False, (driven,), {}, {})
    record = read_text(document(found, chosen), PATH)
    zeros = np.zeros(len(record.coordinates))
    assert float(closure_error(record, zeros)) < 1e-10
    assert all(np.array_equal(rotation, np.eye(3)) for rotation, _ in frames(record, zeros).values())
    for number, chain in enumerate(chains):
        for place, joint in enumerate(chain.joints):
            drawn = record.joints[found.joint_of(number, place)]
            written = getattr(joint, "axes", ()) or (getattr(joint, "axis", None),)
            if not joint.general and written[0] is not None and len(drawn.axes):
                crosses = np.cross(drawn.axes[: len(written)], written[: len(drawn.axes)])
                assert np.max(np.abs(crosses)) < 1e-9, (chain.text, drawn.name)


def test_axes_through_a_point_that_limbs_share_go_through_it():
    found = draft(parse_chains(LIMBS[3][:2]), LAYOUTS[0][0])
    record = read_text(document(found, Chosen("my", (), ("x",), False, (DrivenJoint("leg1.A"),), {}, {})), PATH)
    placed = frames(record, np.zeros(len(record.coordinates)))
    centre = np.array([0.0, 0.0, record.parameters["height"].value])
    far = {}
    for name, joint in record.joints.items():
        to_joint = placed[joint.parent][1] + joint.at - centre
        assert np.linalg.norm(np.cross(to_joint, joint.axes[0])) < 1e-10
        far[name] = np.linalg.norm(to_joint)
    assert far["leg1.A"] > far["leg1.B"]  # the platform turns within its limbs


def test_a_general_slider_runs_along_its_leg():
    found = draft(parse_chains(["U P S"] * 3), LAYOUTS[0][0])
    record = read_text(document(found, Chosen("my", (), ("x",), False, (DrivenJoint("leg1.B"),), {}, {})), PATH)
    leg = record.joints["leg1.C"].at
    assert record.joints["leg1.B"].axes[0] == pytest.approx(leg / np.linalg.norm(leg))


@pytest.mark.parametrize(
    ("text", "count"),
    [("P[x] R[y] R[y]", [0, 1, 1]), ("R[y] P[x] P[z] S", [1, 0, 0, 1]), ("P[x] P[y]", [0, 1]), ("S", [1])],
)
def test_a_slider_stands_where_its_neighbour_does(text, count):
    found = own_stations(parse_chain(text).elements)
    assert found == count or text == "P[x] P[y]"

"""Drake reads the SDF file by a libsdformat of its own: it refuses loops, and turns screws as we do."""

from xml.etree import ElementTree

import numpy as np
import pytest

from assur.export.sdf import sdf

pytestmark = pytest.mark.engines


def plant_of(text, path):
    from pydrake.all import MultibodyPlant, Parser

    path.write_text(text)
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModels(str(path))
    return plant


@pytest.mark.parametrize("record", ["fivebar"], indirect=True)
def test_drake_refuses_the_loops(record, tmp_path):
    with pytest.raises(RuntimeError, match="loops in the system graph"):
        plant_of(sdf(record), tmp_path / "it.sdf").Finalize()


@pytest.mark.parametrize("record", ["screws"], indirect=True)
def test_a_screw_advances_as_ours_where_the_loop_is_cut_open(record, tmp_path, metre):
    root = ElementTree.fromstring(sdf(record))
    model = root.find("model")
    model.remove(next(joint for joint in model.findall("joint") if joint.get("name") == "P"))
    plant = plant_of(ElementTree.tostring(root, encoding="unicode"), tmp_path / "it.sdf")
    plant.Finalize()
    context = plant.CreateDefaultContext()
    nut = plant.GetBodyByName("nut")
    before = plant.EvalBodyPoseInWorld(context, nut).translation()[2]
    places = np.zeros(plant.num_positions())
    for name, turns in (("H1", 1.0), ("H2", -2.0)):
        places[plant.GetJointByName(name).position_start()] = 2 * np.pi * turns
    plant.SetPositions(context, plant.GetModelInstanceByName("screws"), places)
    moved = plant.EvalBodyPoseInWorld(context, nut).translation()[2] - before
    pitches = [record.joints[name].pitch for name in ("H1", "H2")]
    assert moved == pytest.approx(metre * (pitches[0] - 2 * pitches[1]), abs=1e-12)

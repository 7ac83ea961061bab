"""STEP files read back by Open CASCADE: names, places, valid solids, and volumes against those of the meshes."""

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import frames
from assur.scene import mesh
from assur.scene.bodies import bodies, fused, home_skeleton
from tight_box import bounds

pytestmark = pytest.mark.cad
SOME = ("zeng2019", "fivebar", "three_rps")


def read(data, path):
    """Per link of a STEP file, name -> shape of its pieces, where the assembly has them."""
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFApp import XCAFApp_Application
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    path.write_bytes(data)
    document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    assert reader.ReadFile(str(path)) == IFSelect_ReturnStatus.IFSelect_RetDone
    assert reader.Transfer(document)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    (whole,) = labels(tool.GetFreeShapes)
    return text(whole), {
        text(link): {text(item): placed(tool, item, link) for item in components(tool, link)}
        for link in components(tool, whole)
    }


def labels(fill):
    from OCP.collections import Sequence_TDF_Label

    found = Sequence_TDF_Label()
    fill(found)
    return [found.Value(k) for k in range(1, found.Length() + 1)]


def referred(tool, label):
    from OCP.TDF import TDF_Label

    found = TDF_Label()
    return found if tool.GetReferredShape_s(label, found) else label


def components(tool, label):
    return labels(lambda found: tool.GetComponents_s(referred(tool, label), found))


def placed(tool, item, link):
    return tool.GetShape_s(item).Moved(tool.GetLocation_s(link))


def text(label):
    from OCP.TDataStd import TDataStd_Name

    found = TDataStd_Name()
    assert label.FindAttribute(TDataStd_Name.GetID_s(), found)
    return found.Get().ToExtString()


@pytest.mark.parametrize("name", SOME)
def test_a_file_read_back_is_the_mechanism(name, tmp_path):
    from assur.export.cad import kernel
    from assur.export.cad.step import step

    record = assur.load(name)
    title, links = read(step(record, record.home_values), tmp_path / "it.step")
    made = {body.link: body for body in bodies(record)}
    assert title == name
    assert set(links) == set(made)
    for link, body in made.items():
        pieces = links[link]
        assert all(kernel.valid(shape) and kernel.volume(shape) > 0 for shape in pieces.values())
        own = [shape for piece, shape in pieces.items() if piece.startswith(link)]
        assert len(pieces) - len(own) == len({item.name for item in body.pins})
        if body.fused:
            solid = fused(body)
            rotation, origin = frames(record, record.home_values)[link]
            box = np.array(solid.transform(np.column_stack([rotation, origin])).bounding_box()).reshape(2, 3)
            found = np.array([bounds(shape) for shape in own])
            size = home_skeleton(record).size
            np.testing.assert_allclose(found[:, 0].min(axis=0), box[0], atol=2e-4 * size)
            np.testing.assert_allclose(found[:, 1].max(axis=0), box[1], atol=2e-4 * size)


@pytest.mark.parametrize("name", ["zeng2019", "delta_4s"])
def test_volumes_of_meshes_tend_to_those_of_the_exact_solids(name, monkeypatch):
    """Triangles and exact surfaces are two kernels: their difference falls with the square of the sides of a circle."""
    from assur.export.cad import kernel
    from assur.export.cad.step import link_solids
    from assur.kinematics.validation.check import METRES

    record = assur.load(name)
    scale = 1e3 * METRES[record.unit]
    for body in [item for item in bodies(record) if item.fused][:6]:
        pieces = link_solids(body, scale)
        exact = sum(kernel.volume(shape) for _, shape, _ in pieces[: len(pieces) - len(body.pins)])
        gaps = []
        for sides in (36, 144):
            monkeypatch.setattr(mesh, "ROUND", sides)
            gaps.append(abs(fused(body).volume() * scale**3 / exact - 1))
        assert gaps[0] < 0.015
        assert gaps[1] < max(gaps[0] / 8, 1e-6)


def test_a_length_unit_is_turned_into_mm(tmp_path):
    from assur.export.cad.step import step

    record = assur.load("delta_4s")
    assert record.unit == "m"
    _, links = read(step(record, record.home_values), tmp_path / "it.step")
    low, high = bounds(links["leg1.rod1"]["leg1.rod1"])
    assert 1000 < np.linalg.norm(high - low) < 2000

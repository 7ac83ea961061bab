"""STEP (ISO 10303-214): an assembly with one named part per link and per pin, in colour, in mm, standing at home."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError
from assur.export.cad import kernel
from assur.joint_graph.frames import frames
from assur.kinematics.validation.check import METRES
from assur.model.mechanism import MechanismRecord
from assur.scene.bodies import CHIP, LinkBody, bodies
from assur.scene.mesh import rgb

FloatArray = NDArray[np.float64]


def step(record: MechanismRecord, values: FloatArray) -> bytes:
    """The mechanism as a STEP file, its links placed at joint values (n,).

    The assembly has one sub-assembly per link, in it the link's solid (or solids, where its parts do not touch) and
    every pin; names are those of the links and parts.

    Errors: `UsageError` where Open CASCADE is not installed.
    """
    kernel.needed()
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.STEPControl import STEPControl_StepModelType
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFApp import XCAFApp_Application
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    kernel.quiet()
    document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    XCAFDoc_DocumentTool.SetLengthUnit_s(document, 1.0, _millimetre())
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    whole = _named(shapes.NewShape(), record.name)
    placed = frames(record, values)
    metre = 1e3 * METRES[record.unit]
    for body in bodies(record):
        link = _named(shapes.NewShape(), body.link)
        for name, solid, colour in link_solids(body, metre):
            own = _named(shapes.AddShape(solid, False), name)
            _coloured(colours, own, colour)
            _named(shapes.AddComponent(link, own, _location()), name)
        rotation, origin = placed[body.link]
        _named(shapes.AddComponent(whole, link, _location(rotation, metre * origin)), body.link)
    shapes.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    stream = io.BytesIO()
    if not writer.Transfer(document, STEPControl_StepModelType.STEPControl_AsIs):
        raise AssurError(f"{record.name}: Open CASCADE could not translate the assembly into STEP")
    writer.WriteStream(stream)
    return stream.getvalue()


def link_solids(body: LinkBody, scale: float) -> list[tuple[str, Any, str]]:
    """Name, solid and colour of the pieces of a link, in its frame, lengths times `scale`: the body, then its pins."""
    found = []
    if body.fused:
        made = [kernel.solid(item.shape.scaled(scale)) for item in body.fused]
        whole = kernel.fused(made, [kernel.solid(item.scaled(scale)) for item in body.bores])
        pieces = kernel.solids_of(whole)
        most = max((kernel.volume(piece) for piece in pieces), default=0.0)
        pieces = [piece for piece in pieces if kernel.volume(piece) > CHIP * most]
        for k, piece in enumerate(pieces, 1):
            name = body.link if len(pieces) == 1 else f"{body.link} {k}"
            found.append((name, piece, body.fused[0].colour))
    found += [(item.name, kernel.solid(item.shape.scaled(scale)), item.colour) for item in body.pins]
    return found


def _millimetre() -> Any:
    from OCP.UnitsMethods import UnitsMethods_LengthUnit

    return UnitsMethods_LengthUnit.UnitsMethods_LengthUnit_Millimeter


def _named(label: Any, name: str) -> Any:
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name

    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name, True))
    return label


def _coloured(tool: Any, label: Any, colour: str) -> None:
    from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
    from OCP.XCAFDoc import XCAFDoc_ColorType

    made = Quantity_Color(*map(float, rgb(colour)), Quantity_TypeOfColor.Quantity_TOC_sRGB)
    tool.SetColor(label, made, XCAFDoc_ColorType.XCAFDoc_ColorGen)


def _location(rotation: FloatArray | None = None, origin: FloatArray | None = None) -> Any:
    from OCP.gp import gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    if rotation is None or origin is None:
        return TopLoc_Location()
    move = gp_Trsf()
    rows = np.column_stack([rotation, origin])
    move.SetValues(*map(float, rows.ravel()))
    return TopLoc_Location(move)

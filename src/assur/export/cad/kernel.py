"""Shapes as exact solids of Open CASCADE: fused, bored, checked and measured. Needs the extra `cad`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError, UsageError, extra_hint
from assur.scene.shapes import Ball, Bar, Cuboid, Cylinder, Shape, Slab

FloatArray = NDArray[np.float64]


def needed() -> None:
    """Raise `UsageError` with what to install where Open CASCADE is not there."""
    try:
        import OCP  # noqa: F401
    except ImportError as error:
        raise UsageError(
            "STEP files are made by Open CASCADE, which is not installed", hint=extra_hint("cad")
        ) from error


def quiet() -> None:
    """Let Open CASCADE print nothing but failures."""
    from OCP.Message import Message, Message_Gravity

    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)


def solid(shape: Shape) -> Any:
    """A shape as a `TopoDS_Shape`, its numbers as they are (STEP takes them for mm)."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder, BRepPrimAPI_MakeSphere

    if isinstance(shape, Ball):
        return BRepPrimAPI_MakeSphere(_point(shape.centre), shape.radius).Shape()
    if isinstance(shape, Cylinder):
        way = shape.end - shape.start
        length = float(np.linalg.norm(way))
        if length <= 1e-9 * shape.radius:
            return BRepPrimAPI_MakeSphere(_point(shape.start), shape.radius).Shape()
        return BRepPrimAPI_MakeCylinder(_axes(shape.start, way), shape.radius, length).Shape()
    if isinstance(shape, Cuboid):
        a, b, c = shape.sides
        corners = shape.centre + np.array([-a - b - c, a - b - c, a + b - c, -a + b - c])
        return _extruded(_outline(corners), 2 * c)
    if isinstance(shape, Slab):
        return _extruded(_outline(shape.outline), shape.along)
    return _bar(shape)


def fused(shapes: Sequence[Any], bores: Sequence[Any]) -> Any:
    """The union of solids less those of the bores; faces that continue one another are one."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
    from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain

    found = shapes[0] if len(shapes) == 1 else _combined(BRepAlgoAPI_Fuse(), shapes[:1], shapes[1:])
    if bores:
        found = _combined(BRepAlgoAPI_Cut(), [found], bores)
    unified = ShapeUpgrade_UnifySameDomain(found, True, True, False)
    unified.Build()
    return unified.Shape() if valid(unified.Shape()) else found


def solids_of(shape: Any) -> list[Any]:
    """The separate solids of a shape."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    found, explorer = [], TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def volume(shape: Any) -> float:
    """Volume, by integrals over its faces."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    measured = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, measured)
    return float(measured.Mass())


def valid(shape: Any) -> bool:
    """Whether its faces and edges close it without gaps or crossings."""
    from OCP.BRepCheck import BRepCheck_Analyzer

    return bool(BRepCheck_Analyzer(shape).IsValid())


def _combined(tool: Any, first: Sequence[Any], others: Sequence[Any]) -> Any:
    tool.SetArguments(_list(first))
    tool.SetTools(_list(others))
    tool.Build()
    if not tool.IsDone():
        raise AssurError("Open CASCADE could not combine the parts of a link")
    return tool.Shape()


def _list(shapes: Sequence[Any]) -> Any:
    from OCP.collections import List_TopoDS_Shape

    found = List_TopoDS_Shape()
    for shape in shapes:
        found.Append(shape)
    return found


def _point(place: FloatArray) -> Any:
    from OCP.gp import gp_Pnt

    return gp_Pnt(*map(float, place))


def _axes(place: FloatArray, way: FloatArray) -> Any:
    from OCP.gp import gp_Ax2, gp_Dir

    return gp_Ax2(_point(place), gp_Dir(*map(float, way)))


def _outline(corners: FloatArray) -> Any:
    """A closed wire of straight edges."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakePolygon

    made = BRepBuilderAPI_MakePolygon()
    for corner in corners:
        made.Add(_point(corner))
    made.Close()
    return made.Wire()


def _extruded(wire: Any, way: FloatArray) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Vec

    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire).Face(), gp_Vec(*map(float, way))).Shape()


def _bar(bar: Bar) -> Any:
    """Two straight and two round edges, extruded across the flat sides."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeWire
    from OCP.GC import GC_MakeArcOfCircle

    along = (bar.end - bar.start) / np.linalg.norm(bar.end - bar.start)
    across = bar.radius * np.cross(bar.normal, along)
    foot = -0.5 * bar.thickness * bar.normal
    a, b, c, d = (
        bar.start - across + foot,
        bar.end - across + foot,
        bar.end + across + foot,
        bar.start + across + foot,
    )
    far, near = bar.end + bar.radius * along + foot, bar.start - bar.radius * along + foot
    wire = BRepBuilderAPI_MakeWire()
    for edge in (
        BRepBuilderAPI_MakeEdge(_point(a), _point(b)),
        BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(_point(b), _point(far), _point(c)).Value()),
        BRepBuilderAPI_MakeEdge(_point(c), _point(d)),
        BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(_point(d), _point(near), _point(a)).Value()),
    ):
        wire.Add(edge.Edge())
    return _extruded(wire.Wire(), bar.thickness * bar.normal)

"""Index maps: every index on one grid through a workspace, with its mean and its extremes, and why a value is missing.

The distance from the nearest parallel singularity (`assur.singularity.distance`) stands beside the indices of
`assur.performance.indices` where the mechanism has a closed form and its pose has lengths.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.performance.indices import INDICES, Indices, indices_at, indices_where
from assur.performance.scaling import Length
from assur.results.answers.indices import MapAnswer, MapExtreme, MapsAnswer
from assur.results.json_text import plain
from assur.singularity.distance import distance
from assur.work import stage
from assur.workspace.fields import inside_at, none_negative
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
NODES = 60
MOST_NODES = 2_000_000
DISTANCE = "distance"
MEANING = "distance from the nearest parallel singularity inside the reach that was found, the orientation held"


@dataclass(frozen=True, eq=False)
class IndexMaps:
    """Every index over one grid through a workspace.

    Attributes:
        mechanism, mode, how: of the workspace.
        unit, angle: those of lengths and angles in `axes`, `held` and where the extremes are.
        coordinates: those of the workspace, in the order in which the extremes tell where they are.
        axes: (name, nodes) of each coordinate that varies here.
        held: the other coordinates of the pose.
        status: why a number is missing, `Status` per node; unreachable too where a stroke or a limit forbids the pose.
        length: the characteristic length of `Indices`, None where none is.
        reach: how far the distance was looked for; None where it is not among the maps.
        factor: name of the parallel factor that vanishes nearest, "" where none was found; None without the distance.
        maps: by the name of the index.
    """

    mechanism: str
    mode: str
    how: str
    unit: str
    angle: Literal["rad", "deg"]
    coordinates: tuple[str, ...]
    axes: tuple[tuple[str, FloatArray], ...]
    held: Mapping[str, float]
    status: NDArray[np.int8]
    length: float | None
    reach: float | None
    factor: NDArray[np.str_] | None
    maps: Mapping[str, MapAnswer]

    def __getitem__(self, name: str) -> FloatArray:
        """The values of one index, or a clear refusal."""
        if name not in self.maps:
            raise UnknownNameError("index map", name, self.maps)
        return np.asarray(self.maps[name].values)

    def in_degrees(self) -> IndexMaps:
        """The same with every angle in degrees; indices keep their units."""
        if self.angle == "deg":
            return self
        turn = {name: 1.0 if name in LENGTHS else 180 / np.pi for name in (*self.coordinates, *self.held)}

        def there(extreme: MapExtreme | None) -> MapExtreme | None:
            at = zip(self.coordinates, extreme.at if extreme else (), strict=False)
            return extreme and MapExtreme(extreme.value, tuple(value * turn[name] for name, value in at))

        return replace(
            self,
            angle="deg",
            axes=tuple((name, nodes * turn[name]) for name, nodes in self.axes),
            held={name: value * turn[name] for name, value in self.held.items()},
            maps={k: replace(item, least=there(item.least), most=there(item.most)) for k, item in self.maps.items()},
        )

    def answer(self) -> MapsAnswer:
        """The maps as nested lists, which have nothing where a number does not exist."""
        return MapsAnswer(
            mechanism=self.mechanism,
            mode=self.mode,
            how=self.how,
            unit=self.unit,
            angle=self.angle,
            coordinates=self.coordinates,
            axes={name: nodes.tolist() for name, nodes in self.axes},
            held=self.held,
            characteristic_length=self.length,
            reach=self.reach,
            status=_names(self.status).tolist(),
            nearest_factor=None if self.factor is None else self.factor.tolist(),
            maps={name: replace(item, values=plain(item.values)) for name, item in self.maps.items()},
        )

    def arrays(self) -> dict[str, NDArray[Any]]:
        """What an .npz file holds: the nodes by coordinate, status names, and the values by index; nothing pickled.

        A coordinate and an index never share a name.
        """
        held = {f"held_{name}": np.array(value) for name, value in self.held.items()}
        units = {f"unit_{name}": np.array(item.unit) for name, item in self.maps.items()}
        values = {name: item.values for name, item in self.maps.items()}
        return {**dict(self.axes), **held, "status": _names(self.status), **values, **units}

    def csv(self) -> str:
        """One line per node: its coordinates, its status, every index; empty where a number does not exist."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        units = [f"{name} [{item.unit}]" if item.unit else name for name, item in self.maps.items()]
        where = [f"{name} [{self.unit if name in LENGTHS else self.angle}]" for name, _ in self.axes]
        writer.writerow([*where, "status", *units])
        writer.writerows(self._rows())
        return text.getvalue()

    def _rows(self) -> Iterator[list[Any]]:
        nodes = np.stack(np.meshgrid(*(nodes for _, nodes in self.axes), indexing="ij"), axis=-1)
        values = np.stack([item.values for item in self.maps.values()], axis=-1)
        for point, status, row in zip(
            nodes.reshape(-1, nodes.shape[-1]).tolist(),
            _names(self.status).ravel().tolist(),
            values.reshape(-1, values.shape[-1]).tolist(),
            strict=True,
        ):
            yield [*point, status, *("" if np.isnan(value) else value for value in row)]


@stage("maps of indices")
def index_maps(
    record: MechanismRecord,
    region: Workspace,
    plane: Sequence[str] | None = None,
    held: Mapping[str, float] | None = None,
    nodes: int = NODES,
    characteristic_length: Length = None,
    reach: float | None = None,
) -> IndexMaps:
    """Every index on a grid over the box of a workspace; NaN where a node lies outside the workspace.

    Args:
        record: the mechanism.
        region: its workspace (`assur.workspace.region.workspace`), by closed form or followed.
        plane: which of its coordinates vary, in the order of the axes; all of them by default.
        held: values of the others, in lengths and rad; the middle of the box by default.
        nodes: along each axis.
        characteristic_length: as of `assur.performance.indices.indices`.
        reach: how far the distance is looked for; the characteristic length of the mechanism by default.

    Errors:
        UsageError: fewer than 2 nodes along an axis or more than two million in all, a coordinate that is named twice
            or both varies and is held, a length or a reach that is none.
        UnknownNameError: a coordinate that the workspace does not have.

    Example: the tripteron is isotropic wherever it gets, and nowhere singular.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("tripteron")
    >>> found = index_maps(record, workspace(record, resolution=8), ["x", "z"], nodes=5)
    >>> found["condition"].shape, found.maps["condition"].least.value.__round__(9), sorted(found.held)
    ((5, 5), 1.0, ['y'])
    """
    grid = map_grid(region, plane, held, nodes)
    inside, of_nodes = _inside(record, region, grid.points, characteristic_length)

    def spread(part: NDArray[Any]) -> NDArray[Any]:
        return grid.spread(inside, part, np.nan)

    maps = {
        name: grid.map(index.symbol, index.meaning, index.unit(of_nodes), spread(of_nodes[name]))
        for name, index in INDICES.items()
    }
    away = None
    if record.closed_form is not None and set(record.platform.pose) & set(LENGTHS):
        away = distance(record, region.slice.poses(grid.points[inside]), region.mode, reach)
        maps[DISTANCE] = grid.map(r"\delta", MEANING, record.unit, spread(away.value))
    return IndexMaps(
        **grid.header(record, region),
        status=grid.spread(inside, of_nodes.status, Status.unreachable).reshape(grid.shape),
        length=of_nodes.length,
        reach=None if away is None else away.reach,
        factor=None if away is None else grid.spread(inside, away.factor, "").reshape(grid.shape),
        maps=maps,
    )


@dataclass(frozen=True, eq=False)
class MapGrid:
    """Nodes over the box of a workspace: those of the coordinates that vary, and all as points of the workspace.

    Attributes:
        axes: (name, nodes) of each coordinate that varies.
        held: the other coordinates that the workspace leaves free.
        points: (N, free coordinates).
    """

    axes: tuple[tuple[str, FloatArray], ...]
    held: Mapping[str, float]
    points: FloatArray

    @property
    def shape(self) -> tuple[int, ...]:
        """Nodes along each axis."""
        return tuple(len(values) for _, values in self.axes)

    def spread(self, inside: NDArray[np.bool_], part: NDArray[Any], elsewhere: Any) -> NDArray[Any]:
        """Numbers at the nodes (N,), of those at the nodes that are inside."""
        whole = np.full(len(self.points), elsewhere, dtype=part.dtype)
        whole[inside] = part
        return whole

    def map(self, symbol: str, meaning: str, unit: str, values: FloatArray) -> MapAnswer:
        """The map of values (N,), NaN where there are none, with its mean and its extremes."""
        known = np.flatnonzero(np.isfinite(values))
        mean, least, most = None, None, None
        if len(known):
            low, high = known[np.argmin(values[known])], known[np.argmax(values[known])]
            mean = float(np.mean(values[known]))
            least = MapExtreme(float(values[low]), tuple(self.points[low].tolist()))
            most = MapExtreme(float(values[high]), tuple(self.points[high].tolist()))
        return MapAnswer(symbol, meaning, unit, values.reshape(self.shape), mean, least, most)

    def header(self, record: MechanismRecord, region: Workspace) -> dict[str, Any]:
        """What maps over it say of their mechanism and of their coordinates."""
        return {
            "mechanism": record.name,
            "mode": region.mode,
            "how": region.how,
            "unit": record.unit,
            "angle": "rad",
            "coordinates": region.box.names,
            "axes": self.axes,
            "held": {**region.slice.held, **self.held},
        }


def map_grid(
    region: Workspace, plane: Sequence[str] | None = None, held: Mapping[str, float] | None = None, nodes: int = NODES
) -> MapGrid:
    """The nodes of maps; arguments and errors are those of `index_maps`."""
    names, fixed = _plane(region, plane, held)
    if isinstance(nodes, bool) or not isinstance(nodes, (int, np.integer)) or nodes < 2:
        raise UsageError(f"nodes: {nodes!r} is not a whole number of at least 2")
    if nodes ** len(names) > MOST_NODES:
        raise UsageError(
            f"nodes: {nodes} along {len(names)} coordinates are {nodes ** len(names)}, {MOST_NODES} are allowed",
            hint="hold a coordinate, or take fewer",
        )
    box = region.box
    axes = tuple((name, np.linspace(box.low[box.axis(name)], box.high[box.axis(name)], int(nodes))) for name in names)
    wide = dict(zip(names, np.meshgrid(*(values for _, values in axes), indexing="ij"), strict=True))
    points = np.stack([wide[name].ravel() if name in wide else np.full(nodes ** len(names), fixed[name])
                       for name in box.names], axis=-1)  # fmt: skip
    return MapGrid(axes, fixed, points)


def _plane(
    region: Workspace, plane: Sequence[str] | None, held: Mapping[str, float] | None
) -> tuple[tuple[str, ...], dict[str, float]]:
    """Which coordinates vary, and the values of the others that the workspace leaves free."""
    box, given = region.box, dict(held or {})
    names = tuple(plane) if plane is not None else tuple(name for name in box.names if name not in given)
    for name in (*names, *given):
        box.axis(name)
    if not names or len(set(names)) < len(names):
        raise UsageError(f"map: {','.join(names) or 'nothing'} is not a choice of different coordinates")
    both = [name for name in names if name in given]
    if both:
        raise UsageError(f"map: {both[0]} cannot vary and be held at {given[both[0]]:g}")
    for name, value in given.items():
        low, high = box.low[box.axis(name)], box.high[box.axis(name)]
        if not low <= value <= high:
            raise UsageError(f"map: {name} = {value:g} lies outside the box, {low:g} to {high:g}")
    middle = {name: (low + high) / 2 for name, low, high in zip(box.names, box.low, box.high, strict=True)}
    return names, {name: float(given.get(name, middle[name])) for name in box.names if name not in names}


def _inside(
    record: MechanismRecord, region: Workspace, points: FloatArray, length: Length
) -> tuple[NDArray[np.bool_], Indices]:
    """Which points (N, free coordinates) lie in the workspace, and every index there."""
    if record.closed_form is not None:
        return indices_where(
            record, region.slice.poses(points), region.mode, partial(none_negative, region.margins), length
        )
    inside = inside_at(region.margins, points)
    return inside, indices_at(record, region.joints(points[inside]), length)


def _names(status: NDArray[np.int8]) -> NDArray[np.str_]:
    return np.array([item.name for item in Status])[status]

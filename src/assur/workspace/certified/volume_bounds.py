"""Proved bounds beside the estimates of a workspace: of its volume and of its sections, as near as takes seconds."""

from __future__ import annotations

from assur.model.mechanism import MechanismRecord
from assur.workspace.certified.region import CertifiedWorkspace, certified_workspace
from assur.workspace.region import Workspace
from assur.workspace.slices import MOST

GAPS = {1: 1e-4, 2: 1e-4, 3: 1e-2}
"""How near the bounds of a volume shall be, by the number of coordinates on which the region depends."""

SECTION = 1e-3
"""How near those of a section shall be at least: it has one coordinate less."""


def volume_bounds(record: MechanismRecord, region: Workspace) -> CertifiedWorkspace:
    """Proved bounds of the volume and the sections of a workspace: of the same mode, box, strokes and cuts.

    Errors:
        UsageError: the mechanism has no closed form.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("zeng2019")
    >>> proved = volume_bounds(record, workspace(record, resolution=16))
    >>> proved.paving.names, proved.gap
    (('x', 'z'), 0.0001)
    """

    def bounds(gap: float) -> CertifiedWorkspace:
        return certified_workspace(
            record,
            region.mode,
            dict(zip(region.box.names, region.box.intervals, strict=True)),
            region.strokes,
            region.slice.held,
            gap,
            [item.value for item in region.sections],
            section_gap=min(gap, SECTION),
        )

    coarse = bounds(GAPS[MOST])
    gap = GAPS[len(coarse.paving.names)] if coarse.paving.names else GAPS[1]
    return coarse if gap == coarse.gap else bounds(gap)

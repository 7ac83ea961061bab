"""The fields of a mode: which there are with a closed form and without, and the progress of both."""

from dataclasses import replace

import assur
from assur.workspace.domain import box_of
from assur.workspace.grid import grid_over
from assur.workspace.mode_fields import mode_fields
from assur.workspace.slices import slice_at


def test_without_closed_form_the_reach_is_one_field_and_strokes_are_the_same():
    record = assur.load("zeng2019")
    grid, strokes = grid_over(box_of(record, None), 4), {"yA1": (-200.0, 150.0)}
    for some, first in ((record, "n_alpha"), (replace(record, closed_form=None), "reach")):
        seen = []
        found = mode_fields(
            some, "++-++", strokes, slice_at(record), grid, lambda done, total, seen=seen: seen.append((done, total))
        )
        assert next(iter(found.margins)) == first
        assert [name for name in found.margins if "yA1" in name] == ["yA1 >= -200", "yA1 <= 150"]
        ticked = len(seen)
        found.tick()
        assert seen[-1] == (ticked + 1, seen[-1][1])

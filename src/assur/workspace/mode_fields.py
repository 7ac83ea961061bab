"""The fields of a working mode, wherever they come from: its closed form, or following it over a grid."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from assur.model.mechanism import MechanismRecord
from assur.work import Progress, ticker
from assur.workspace.bounds import Stroke, bounds
from assur.workspace.fields import Field, closed_form_fields
from assur.workspace.followed import followed_factors, followed_margins, over_grid
from assur.workspace.grid import UniformGrid
from assur.workspace.slices import Slice

FOLLOWING, LAST = 40, 3
"""Steps of progress: of following a mode, and of what comes after the margins."""

CLOSED_FORM = "closed form"


@dataclass(frozen=True, eq=False)
class ModeFields:
    """The fields of a mode, where they come from, and a function that reports one more step done."""

    margins: Mapping[str, Field]
    factors: Mapping[str, Field]
    how: str
    tick: Callable[[], None]


def mode_fields(
    record: MechanismRecord,
    mode: str,
    strokes: Mapping[str, Stroke | None] | None,
    poses: Slice,
    grid: UniformGrid,
    progress: Progress | None = None,
) -> ModeFields:
    """The fields of a working mode over a slice, from the closed form where there is one, else by following the mode.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.domain import box_of
    >>> from assur.workspace.grid import grid_over
    >>> from assur.workspace.slices import slice_at
    >>> record = load_record("fivebar")
    >>> found = mode_fields(record, "-+", None, slice_at(record), grid_over(box_of(record, None), 8))
    >>> found.how, list(found.margins)
    ('closed form', ['reach1', 'reach2'])
    """
    if record.closed_form is not None:
        margins, factors = closed_form_fields(record, mode, strokes, poses)
        return ModeFields(margins, factors, CLOSED_FORM, ticker(2 * len(margins) + LAST, progress))
    tick = ticker(FOLLOWING + 2 * (1 + len(bounds(record, strokes))) + LAST, progress)
    done = 0

    def following(share: float) -> None:
        nonlocal done
        while done < int(share * FOLLOWING):
            done += 1
            tick()

    over, how = over_grid(record, mode, poses, grid, following)
    following(1.0)
    return ModeFields(followed_margins(over, strokes), followed_factors(over), how, tick)

"""Coordinates and modes of a mechanism in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from assur.model.mechanism import MechanismRecord


def is_length(name: str) -> bool:
    """Whether a pose coordinate is a length; every other is an angle."""
    from assur.model.pose import is_angle

    return not is_angle(name)


def mode_words(record: MechanismRecord, mode: str) -> str:
    """A working mode in words, also where it has no signs.

    >>> from assur.model.registry import load_record
    >>> mode_words(load_record("fivebar"), "-+"), mode_words(load_record("three_upu"), "")
    ('working mode -+', 'its only working mode')
    """
    if mode:
        return f"working mode {mode}"
    only = record.closed_form is not None and not record.modes.working
    return "its only working mode" if only else "the working mode of home"

"""The operation modes of a mechanism wherever it can be assembled: met by chance, with what each of them moves like."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from string import ascii_lowercase

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError, UsageError
from assur.results.answers.topology import MetMode, ModeMeeting
from assur.topology.agreement import by_twists
from assur.topology.analysis import held_in
from assur.topology.answers import written_poc
from assur.topology.counting.coupling import coupling
from assur.topology.counting.mobility import motions
from assur.topology.counting.solution_plan import solution_plan
from assur.topology.poc import motion_name
from assur.topology.screws.assembly_equations import Hold
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.mode_kinds import ModeKind, kind_around, kinds_met
from assur.topology.screws.mode_meetings import meetings_met
from assur.topology.screws.modes import operation_modes
from assur.topology.screws.twists import edges, motion_space
from assur.work import stage

FloatArray = NDArray[np.float64]
DRAWS = 2
"""A kind is one of the mechanism where so many draws have met it: else a singular surface could pass for a mode."""

NOT_ALL = "modes: met by chance among assemblies, not proved to be all"


@stage("operation modes")
def met_modes(linkages: Sequence[Linkage], *, meeting: bool = False) -> tuple[MetMode, ...]:
    """Kinds of operation modes, those of home first.

    Args:
        linkages: of other dimensions each; or one linkage several times, whose assemblies are then drawn as often.
        meeting: whether to look where they meet.

    Example: a planar 3-RRR moves in one way wherever it is assembled.

    >>> from assur.topology.notation import parse_chains
    >>> from assur.topology.screws.placing import place
    >>> chains = parse_chains(["R[z] R[z] R[z]"] * 3)
    >>> [str(mode) for mode in met_modes([place(chains, seed=seed) for seed in range(2)])]
    ['2T1R: F = 3, t²(⊥[0, 0, 1]) r¹(∥[0, 0, 1]) with dim 3']
    """
    hold = held_in(linkages[0], "home")
    draws = [kinds_met(linkage, seed, hold) for seed, linkage in enumerate(linkages)]
    count = Counter(kind for draw in draws for kind in draw)
    at_home = _of_home(linkages[0])
    own = {kind: values for kind, values in draws[0].items() if count[kind] >= min(DRAWS, len(draws))}
    own = {**at_home, **own}
    kinds = sorted(own, key=lambda kind: (kind not in at_home, bool(kind.crossed)))
    names = dict(zip(kinds, _names(kinds), strict=True))
    modes = [_mode(linkages[0], kind, own[kind], name, at_home=kind in at_home) for kind, name in names.items()]
    if not meeting or len(modes) == 1:
        return tuple(modes)
    met = {
        mode.name: list(_meetings(linkages[0], mode, own[kind], names, at_home, hold))
        for kind, mode in zip(kinds, modes, strict=True)
    }
    return tuple(replace(mode, meets=tuple(_seen_from(mode.name, met))) for mode in modes)


def _seen_from(name: str, met: Mapping[str, Sequence[ModeMeeting]]) -> Iterator[ModeMeeting]:
    """Meetings of a mode, and those that were seen from the other one alone."""
    yield from met[name]
    seen = {meeting.mode for meeting in met[name]}
    yield from (
        replace(meeting, mode=other)
        for other, meetings in met.items()
        for meeting in meetings
        if meeting.mode == name and other not in seen
    )


def _meetings(
    linkage: Linkage,
    mode: MetMode,
    values: FloatArray,
    names: Mapping[ModeKind, str],
    at_home: Collection[ModeKind],
    hold: Hold | None,
) -> Iterator[ModeMeeting]:
    """Where a mode meets others of those that are named: all of home do so there, the others on random paths."""
    there = [name for kind, name in names.items() if mode.at_home and kind in at_home and name != mode.name]
    still = {joint: (0.0,) * len(place) for joint, place in mode.example.items()}
    yield from (ModeMeeting(name, True, still) for name in there)
    if len(there) + 1 == len(names):
        return
    for kind, place in meetings_met(linkage, values[0], hold):
        if names.get(kind, mode.name) not in (mode.name, *there):
            yield ModeMeeting(names[kind], False, _example(linkage, place))


def _example(linkage: Linkage, value: FloatArray) -> dict[str, tuple[float, ...]]:
    """Joint values (n,) by joints."""
    return {joint: tuple(map(float, value[place])) for joint, place in linkage.slices.items()}


def _of_home(linkage: Linkage) -> dict[ModeKind, FloatArray]:
    """Kinds of the modes that meet at home."""
    hold = held_in(linkage, "home")
    try:
        modes = operation_modes(linkage, hold=hold)
    except AssurError:  # shaky or immobile at home, which the analysis says
        return {}
    around = (kind_around(linkage, mode.values[0], hold=hold) for mode in modes)
    return dict(own for own in around if own is not None)


def _names(kinds: Sequence[ModeKind]) -> list[str]:
    """Independent translations and rotations, and a letter where several kinds have the same."""
    plain = [motion_name(kind.dim, kind.r) for kind in kinds]
    several = {name for name, times in Counter(plain).items() if times > 1}
    letters = {name: iter(ascii_lowercase) for name in several}
    return [f"{name}{next(letters[name])}" if name in several else name for name in plain]


def _mode(linkage: Linkage, kind: ModeKind, values: FloatArray, name: str, *, at_home: bool) -> MetMode:
    poc = by_twists(motion_space(edges(linkage, values), linkage.base, linkage.platform))
    degree = _coupling_degree(linkage, values)
    return MetMode(name, written_poc(poc), kind.freedoms, degree, at_home, kind.crossed, _example(linkage, values[0]))


def _coupling_degree(linkage: Linkage, values: FloatArray) -> int | None:
    """None where the drives do not fix it."""
    collapsed = edges(linkage, values)
    try:
        order = coupling(collapsed, motions(collapsed, linkage.base, linkage.platform).internal)
        plan = solution_plan(order, collapsed, linkage.base, linkage.platform)
    except UsageError:  # too many orders, or drives inside a parallelogram that crossed over
        return None
    return None if plan.free else order.coupling_degree

"""The topology of a mechanism, of a file, or of chains: derived by rules and by twists."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TypeGuard, get_args

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.contract.admission import admitted_record
from assur.kinematics.structure import linkage, values_from_home
from assur.model.mechanism import MechanismRecord
from assur.model.topologies import load_topology, means_topology
from assur.model.topology_description import TopologyDescription
from assur.results.answers.topology import MetMode
from assur.topology.analysis import Mode, analyse
from assur.topology.chains import BASE, PLATFORM, Chain
from assur.topology.counting.inputs import default_inputs, numbered_inputs
from assur.topology.facts import InputsBy, Topology
from assur.topology.met_modes import DRAWS, met_modes
from assur.topology.notation import parse_chains
from assur.topology.routes import told_point
from assur.topology.screws.assembled import assembled_at
from assur.topology.screws.configurations import ImmobileError
from assur.topology.screws.limb_linkage import seen_at_end
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.placing import place
from assur.topology.screws.recognition import recognised
from assur.topology.screws.twists import ShakyError
from assur.topology.shaky import analyse_shaky

FloatArray = NDArray[np.float64]
PLACINGS = 3
"""Random dimensions that are tried for chains that do not move, or are shaky."""

SOME_DIMENSIONS = "not all dimensions move: this is said of some that do, and with others it does not move or is shaky"


def topology(
    what: str | Path | MechanismRecord | Sequence[str],
    /,
    *,
    actuate: Sequence[str] | str | None = None,
    mode: Mode | str | None = None,
) -> Topology:
    """The topology of a mechanism, derived by symbolic rules and by the rank of twists.

    Args:
        what: the name or file of a mechanism or of a topology, a mechanism, one chain, or several chains from base
            to platform, in the plain form ("P[x] R[x] R[x] R[x]") or the literature's.
        actuate: actuated joints as "limb.joint" (a list, or a text with commas), counted from 1, the branches of inner
            loops one after the other. By default those of the mechanism, and for chains the first P, R, H or C of each
            branch from the base, or an admissible set near it where these do not determine the mechanism.
        mode: "home" for the motion that is reached from the configuration as written; "translation" where the
            platform keeps its orientation; or a name that `operation_modes` gives, for the motion around that mode's
            example. By default what a topology's file says, else "home".

    Returns:
        The facts as attributes; `print` shows the derivation.

    Errors:
        NotationError: a chain that cannot be read. UnknownNameError, MechanismFileError: as `load`.
        UsageError: actuated joints of what does not move, links that nothing connects, an unknown mode.
        RoutesDisagreeError: the two routes give different answers; the message names the chain.
        ShakyError, ImmobileError: instantaneous freedoms that lead nowhere, where the second order does not prove it.

    Example:
        >>> found = topology("zeng2019")
        >>> print(found.poc, found.dof, found.xi, found.coupling_degree)
        t³ r⁰ 3 (3, 5) 1
        >>> topology("R[x] R[x] R[x] R[y] R[y]").limbs[0].poc.dim
        5
    """
    if isinstance(actuate, str):
        actuate = actuate.split(",")
    if mode is not None and not _at_home(mode):
        return _of_met_mode(what, actuate, mode)
    if isinstance(what, MechanismRecord):
        return _named(_of_record(what, actuate, mode), what)
    if not isinstance(what, str | Path | Sequence):
        raise UsageError(f"a topology is given by a name, a file or chains of joints, not by {what!r}")
    if isinstance(what, str) and not _is_name(what):
        what = [what]
    if isinstance(what, str | Path):
        if not means_topology(what):
            record = admitted_record(what)
            return _named(_of_record(record, actuate, mode), record)
        described = load_topology(what)
        numbers = actuate or [f"{limb}.{joint}" for limb, joint in described.actuate]
        found = _named(_of_chains(described.chains, numbers, mode or described.mode), described)
        differences = () if actuate or mode else described.declared.differences(found)
        return dataclasses.replace(found, notes=(*found.notes, *differences))
    return _of_chains(parse_chains(what), actuate, mode or "home")


def _at_home(mode: str) -> TypeGuard[Mode]:
    """Whether a mode is one that the configuration as written has."""
    return mode in get_args(Mode)


def _of_met_mode(
    what: str | Path | MechanismRecord | Sequence[str], actuate: Sequence[str] | None, name: str
) -> Topology:
    """Around the example of an operation mode that is met somewhere, which takes the place of home."""
    linkages, described = _linkages(what, actuate)
    met = {mode.name: mode for mode in met_modes(linkages)}
    if name not in met:
        known = [*get_args(Mode), *met]
        raise UnknownNameError("mode", name, known, hint="those met by chance among assemblies; --modes lists them")
    mode = met[name]
    values = np.concatenate([mode.example[joint] for joint in linkages[0].joints])
    built = assembled_at(linkages[0], values, mode.crossed)
    found = analyse(built, inputs_by="given")
    note = f"mode {name}: all this is said around an example of it, met by chance among assemblies"
    found = dataclasses.replace(found, mode=name, notes=(note, *found.notes))
    return found if described is None else _named(found, described)


def _named(topology: Topology, described: MechanismRecord | TopologyDescription) -> Topology:
    """With the words of what it is of."""
    return dataclasses.replace(topology, name=described.name, title=described.title, source=described.source)


def _is_name(text: str) -> bool:
    """Whether a text is a name or a path rather than a chain: chains have capital letters and brackets."""
    return text.endswith(".toml") or "/" in text.strip("-") or re.fullmatch(r"[a-z0-9][a-z0-9_.-]*", text) is not None


def operation_modes(what: str | Path | MechanismRecord | Sequence[str], /) -> tuple[MetMode, ...]:
    """The operation modes of a mechanism wherever it can be assembled: kinds that are met, not proved to be all.

    Assemblies are drawn by chance, of chains with several dimensions; of files with theirs. Modes that meet at home
    come first. Each says which others it `meets`: at home, or at assemblies on random paths.

    Args:
        what: as `topology` takes it.

    Errors:
        NotationError, UnknownNameError, MechanismFileError: as `topology`.

    Example: a 3-UPU moves in more ways than the one for which it is built; with equal limbs in one more.

    >>> from assur.model.registry import load_record
    >>> sorted(mode.name for mode in operation_modes("three_upu"))
    ['3R', '3T']
    >>> sorted(mode.name for mode in operation_modes(load_record("three_upu")))
    ['2T1R', '3R', '3T']
    """
    return met_modes(_linkages(what, None)[0], meeting=True)


def mode_values(record: MechanismRecord, name: str) -> FloatArray:
    """Joint values (n,) of an assembly in an operation mode that `operation_modes` names, in rad and lengths.

    Errors:
        UnknownNameError: no such mode is met.

    >>> from assur.model.registry import load_record
    >>> mode_values(load_record("three_upu"), "3R").shape
    (15,)
    """
    built = linkage(record)
    met = {mode.name: mode for mode in met_modes([built] * DRAWS)}
    if name not in met:
        raise UnknownNameError("operation mode", name, met, hint="assur topology --modes lists those met by chance")
    return values_from_home(record, np.concatenate([met[name].example[joint] for joint in built.joints]))


def _linkages(
    what: str | Path | MechanismRecord | Sequence[str], actuate: Sequence[str] | None
) -> tuple[list[Linkage], MechanismRecord | TopologyDescription | None]:
    """Linkages in which operation modes are met, of chains with several dimensions; and what says its name."""
    if isinstance(what, str) and not _is_name(what):
        what = [what]
    if isinstance(what, str | Path) and not means_topology(what):
        what = admitted_record(what)
    if isinstance(what, MechanismRecord):
        return [_driven(what, linkage(what), actuate)] * DRAWS, what
    described = load_topology(what) if isinstance(what, str | Path) else None
    chains = parse_chains(what) if described is None else described.chains  # type: ignore[arg-type]
    names = numbered_inputs(chains, actuate) if actuate else default_inputs(chains)
    return [place(chains, seed=seed, actuated=names) for seed in range(PLACINGS)], described


def _of_record(record: MechanismRecord, actuate: Sequence[str] | None, mode: Mode | None) -> Topology:
    built = _driven(record, linkage(record), actuate)
    chains = recognised(built)
    try:
        return analyse(built, chains, mode=mode or "home")
    except (ShakyError, ImmobileError):
        proved = analyse_shaky(built, chains) if mode in (None, "home") else None
        if proved is None:
            raise
        return proved


def _driven(record: MechanismRecord, built: Linkage, actuate: Sequence[str] | None) -> Linkage:
    """A file's linkage with other joints actuated, where they are numbered."""
    if not actuate:
        return built
    chains = recognised(built)
    if chains is None:
        raise UsageError(f"{record.name} has no limbs by which joints could be numbered; name inputs in its file")
    hinges = {name: group.joints[0] for name, group in built.groups.items()}
    inputs = tuple((hinges.get(name, name), 0) for name in numbered_inputs(chains, actuate))
    return dataclasses.replace(built, inputs=inputs)


def _of_chains(chains: Sequence[Chain], actuate: Sequence[str] | None, mode: Mode) -> Topology:
    """Of some dimensions with which the chains move as others do; else of some with which their motion is proved."""
    names = numbered_inputs(chains, actuate) if actuate else default_inputs(chains)
    inputs_by: InputsBy = "given" if actuate else "first joints"
    for link in (BASE, PLATFORM):
        if not any(link in (chain.start, chain.end) for chain in chains):
            hint = "a chain that names no link begins at <base> and ends at <platform>"
            raise UsageError(f"no chain begins or ends at <{link}>", hint=hint)
    limbs = chains if all(chain.is_limb for chain in chains) else None
    at = told_point(limbs, held=mode == "translation") if limbs else ""
    placed = [place(chains, seed=seed, actuated=names, at=at) for seed in range(PLACINGS)]
    if limbs is None:  # a graph may be one limb
        placed = [seen_at_end(built, recognised(built)) for built in placed]
    for seed, built in enumerate(placed):
        try:
            found = analyse(built, limbs, mode=mode, inputs_by=inputs_by)
        except (ShakyError, ImmobileError) as error:
            refused = error
            continue
        return dataclasses.replace(found, notes=(*found.notes, SOME_DIMENSIONS)) if seed else found
    shaky = (analyse_shaky(built, limbs, inputs_by=inputs_by) for built in placed)
    proved = next(filter(None, shaky), None) if mode == "home" else None
    if proved is None:
        raise refused
    return proved

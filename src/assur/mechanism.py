"""`Mechanism`: a record with its analyses as methods, each one line to the function that does the work.

Analyses that need slow libraries are imported where they are called.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.frames import Frame, frames
from assur.joint_graph.points import point
from assur.kinematics import closure, position
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import Named, checked_joints, joint_array
from assur.kinematics.contract.check import check_closed_form
from assur.kinematics.home import home_values
from assur.kinematics.position import Method
from assur.kinematics.rates import velocity
from assur.kinematics.rates.instantaneous import Instant, instantaneous
from assur.kinematics.structure import linkage
from assur.model import registry
from assur.model.mechanism import MechanismRecord
from assur.singularity.verdict import Verdict, verdict, verdict_at
from assur.topology.analysis import Mode, analyse
from assur.topology.chains import Chain
from assur.topology.counting.inputs import default_inputs, numbered_inputs
from assur.topology.facts import Topology
from assur.topology.linkages.configurations import ImmobileError
from assur.topology.linkages.placing import place
from assur.topology.linkages.recognition import recognised
from assur.topology.linkages.twists import ShakyError
from assur.topology.notation import parse_chains

if TYPE_CHECKING:
    from assur.kinematics.certified.certify import Way as ProofWay
    from assur.kinematics.certified.result import CertifiedSolutions
    from assur.kinematics.paths.path import Path as Way
    from assur.performance.dexterity import Dexterity
    from assur.performance.indices import Indices
    from assur.performance.scaling import Length
    from assur.workspace.aspects.aspects import Aspects
    from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]

PLACINGS = 3
"""Random dimensions that are tried for chains that do not move, or are shaky."""

SOME_DIMENSIONS = "not all dimensions move: this is said of some that do, and with others it does not move or is shaky"


class Mechanism(MechanismRecord):
    """A mechanism, from `assur.load`. Poses are (..., m), inputs (..., n), lengths in its unit, angles in rad.

    Values of joints, inputs and poses may be given by name as well, as `Solution.joints` has them.
    """

    def with_parameters(self, /, **values: float) -> Self:
        """The same mechanism with other dimensions, checked as those of the file are."""
        changed = registry.with_parameters(self, **values)
        check_closed_form(changed)
        return changed

    def direct(
        self, inputs: ArrayLike, mode: str | None = None, method: Method = "auto", *, crossed: bool = False
    ) -> SolutionSet:
        """Every pose at inputs (..., n): see `assur.kinematics.position.direct`."""
        return position.direct(self, inputs, mode, method, crossed=crossed)

    def inverse(
        self, poses: ArrayLike, mode: str | None = None, method: Method = "auto", *, crossed: bool = False
    ) -> SolutionSet:
        """All inputs at poses (..., m): see `assur.kinematics.position.inverse`."""
        return position.inverse(self, poses, mode, method, crossed=crossed)

    def velocity_map(self, poses: ArrayLike, mode: str | None = None) -> velocity.VelocityMap:
        """Jp and Jq at poses (..., m): see `assur.kinematics.rates.velocity.velocity_map`."""
        return velocity.velocity_map(self, poses, mode)

    def velocity_map_at(self, joint_values: Named) -> velocity.VelocityMap:
        """Jp and Jq from the joint graph at joint values (..., n): see `assur.kinematics.rates.velocity`."""
        return velocity.velocity_map_at(self, joint_values)

    def acceleration(
        self,
        poses: ArrayLike,
        input_rates: ArrayLike,
        input_accelerations: ArrayLike,
        mode: str | None = None,
    ) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration of the pose: see `assur.kinematics.rates.velocity.acceleration`."""
        return velocity.acceleration(self, poses, input_rates, input_accelerations, mode)

    def singularity(self, pose: ArrayLike, mode: str | None = None) -> Verdict:
        """The verdict on one pose (m,): see `assur.singularity.verdict`."""
        return verdict(self, pose, mode)

    def singularity_at(self, joint_values: Named) -> Verdict:
        """The verdict on one configuration of the joint graph (n,): see `assur.singularity.verdict.verdict_at`."""
        return verdict_at(self, joint_values)

    def instantaneous(self, joint_values: Named) -> Instant:
        """First-order motion at joint values (..., n): see `assur.kinematics.rates.instantaneous.instantaneous`."""
        return instantaneous(self, joint_values)

    def certified_direct(self, inputs: ArrayLike, way: ProofWay = "auto") -> CertifiedSolutions:
        """The poses at inputs (n,), proved by intervals: see `assur.kinematics.certified.certify`."""
        from assur.kinematics.certified.certify import certified_direct

        return certified_direct(self, inputs, way)

    def certified_inverse(self, pose: ArrayLike, way: ProofWay = "auto") -> CertifiedSolutions:
        """The inputs at a pose (m,), proved by intervals: see `assur.kinematics.certified.certify`."""
        from assur.kinematics.certified.certify import certified_inverse

        return certified_inverse(self, pose, way)

    def workspace(self, mode: str | None = None, **options: Any) -> Workspace:
        """The workspace of a working mode: see `assur.workspace.region.workspace` for the options."""
        from assur.workspace.region import workspace

        return workspace(self, mode, **options)

    def aspects(self, mode: str | None = None, **options: Any) -> Aspects:
        """The aspects of a working mode, proved: see `assur.workspace.aspects.aspects.aspects` for the options."""
        from assur.workspace.aspects.aspects import aspects

        return aspects(self, mode, **options)

    def dexterity(self, poses: ArrayLike, mode: str | None = None) -> Dexterity:
        """Condition index and velocity factors at poses (..., m): see `assur.performance.dexterity`."""
        from assur.performance.dexterity import dexterity

        return dexterity(self, poses, mode)

    def indices(self, poses: ArrayLike, mode: str | None = None, characteristic_length: Length = None) -> Indices:
        """Condition, manipulability, transmission at poses (..., m): see `assur.performance.indices.indices`."""
        from assur.performance.indices import indices

        return indices(self, poses, mode, characteristic_length)

    def follow(self, joint_values: Named, **options: Any) -> Way:
        """The way from an assembly to inputs or to a pose, the mode kept: see `assur.kinematics.paths.following`."""
        from assur.kinematics.paths.following import follow

        return follow(self, checked_joints(self, joint_values), **options)

    def topology(self, actuate: Sequence[str] | None = None, mode: Mode | None = None) -> Topology:
        """POC sets, DOF, coupling degree and what follows from them: see `assur.topology`."""
        return topology(self, actuate=actuate, mode=mode)

    def point(self, name: str, joint_values: Named) -> FloatArray:
        """Position (..., 3) of a lettered point or of a joint: see `assur.joint_graph.points.point`."""
        return point(self, name, joint_array(self, joint_values))

    @property
    def home_values(self) -> FloatArray:
        """Joint values (n,) of the assembled home."""
        return home_values(self)

    def frames(self, joint_values: Named) -> dict[str, Frame]:
        """Frame of every link, (..., 3, 3) and (..., 3) in the base frame, at joint values (..., n)."""
        return frames(self, joint_array(self, joint_values))

    def closure_error(self, joint_values: Named) -> FloatArray:
        """Largest gap (...) over the cut joints, in length units."""
        return closure.closure_error(self, joint_array(self, joint_values))

    def mobility(self, joint_values: Named) -> closure.Mobility:
        """Rank, freedoms and redundant constraints of the joint graph at joint values (..., n)."""
        return closure.mobility(self, joint_array(self, joint_values))


def load(name: str | Path, /, **parameters: Any) -> Mechanism:
    """A built-in mechanism by name, or one from a file, with some of its parameters changed.

    A closed form beside a file of one's own is held against the joint graph first (`assur.kinematics.contract`): where
    it does not agree, that is a `MechanismFileError`.

    >>> load("zeng2019", l2=300).parameters["l2"].value
    300.0
    """
    record = registry.load_record(name, **parameters)
    check_closed_form(record)
    return Mechanism(**vars(record))


def names() -> tuple[str, ...]:
    """Names of the built-in mechanisms."""
    return registry.names()


def topology(
    what: str | Path | MechanismRecord | Sequence[str],
    /,
    *,
    actuate: Sequence[str] | str | None = None,
    mode: Mode | None = None,
) -> Topology:
    """The topology of a mechanism, derived by symbolic rules and by the rank of twists.

    Args:
        what: the name or file of a mechanism or of a topology, a mechanism, one chain, or several chains from base
            to platform, in the plain form ("P[x] R[x] R[x] R[x]") or the literature's.
        actuate: actuated joints as "limb.joint" (a list, or a text with commas), counted from 1, the branches of inner
            loops one after the other. By default those of the mechanism, and for chains the first P, R, H or C of each
            branch from the base, or an admissible set near it where these do not determine the mechanism.
        mode: "home" for the motion that is reached from the configuration as written; "translation" where the
            platform keeps its orientation. By default what a topology's file says, else "home".

    Returns:
        The facts as attributes; `print` shows the derivation.

    Errors:
        NotationError: a chain that cannot be read. UnknownNameError, MechanismFileError: as `load`.
        UsageError: more actuated joints than degrees of freedom, links that nothing connects, an unknown mode.
        RoutesDisagreeError: the two routes give different answers; the message names the chain.
        ShakyError: loops that close only where they are singular. ImmobileError: freedoms at home that lead nowhere.

    Example:
        >>> found = topology("zeng2019")
        >>> print(found.poc, found.dof, found.xi, found.coupling_degree)
        t³ r⁰ 3 (3, 5) 1
        >>> topology("R[x] R[x] R[x] R[y] R[y]").limbs[0].poc.dim
        5
    """
    if isinstance(actuate, str):
        actuate = actuate.split(",")
    if mode not in (None, *get_args(Mode)):
        raise UnknownNameError("mode", str(mode), get_args(Mode))
    if isinstance(what, MechanismRecord):
        return _of_record(what, actuate, mode)
    if not isinstance(what, str | Path | Sequence):
        raise UsageError(f"a topology is given by a name, a file or chains of joints, not by {what!r}")
    if isinstance(what, str) and not _is_name(what):
        what = [what]
    if isinstance(what, str | Path):
        if not registry.means_topology(what):
            return _of_record(load(what), actuate, mode)
        described = registry.load_topology(what)
        numbers = actuate or [f"{limb}.{joint}" for limb, joint in described.actuate]
        found = _of_chains(
            described.chains, numbers, mode or described.mode, described.name, described.title, described.source
        )
        differences = () if actuate or mode else described.declared.differences(found)
        return dataclasses.replace(found, notes=(*found.notes, *differences))
    return _of_chains(parse_chains(what), actuate, mode or "home")


def _is_name(text: str) -> bool:
    """Whether a text is a name or a path rather than a chain: chains have capital letters and brackets."""
    return text.endswith(".toml") or "/" in text.strip("-") or re.fullmatch(r"[a-z0-9][a-z0-9_.-]*", text) is not None


def _of_record(record: MechanismRecord, actuate: Sequence[str] | None, mode: Mode | None) -> Topology:
    built = linkage(record)
    chains = recognised(built)
    if actuate:
        if chains is None:
            raise UsageError(f"{record.name} has no limbs by which joints could be numbered; name inputs in its file")
        names = numbered_inputs(chains, actuate)
        hinges = {name: group.joints[0] for name, group in built.groups.items()}
        built = dataclasses.replace(built, inputs=tuple((hinges.get(name, name), 0) for name in names))
    return analyse(built, chains, name=record.name, title=record.title, source=record.source, mode=mode or "home")


def _of_chains(
    chains: Sequence[Chain],
    actuate: Sequence[str] | None,
    mode: Mode,
    name: str = "",
    title: str = "",
    source: str = "",
) -> Topology:
    names = numbered_inputs(chains, actuate) if actuate else default_inputs(chains)
    answers = partial(
        analyse,
        chains=chains,
        name=name,
        title=title,
        source=source,
        mode=mode,
        inputs_by="given" if actuate else "first joints",
    )
    for seed in range(PLACINGS - 1):
        try:
            found = answers(place(chains, seed=seed, actuated=names))
        except (ShakyError, ImmobileError):
            continue
        return dataclasses.replace(found, notes=(*found.notes, SOME_DIMENSIONS)) if seed else found
    last = answers(place(chains, seed=PLACINGS - 1, actuated=names))
    return dataclasses.replace(last, notes=(*last.notes, SOME_DIMENSIONS))

"""Parasitic mechanisms: the motion that is asked is that at home, and others come with it as soon as home is left.

No motion of a limb says so. The constraints of the limbs at home do, forces and couples that depend on directions of
axes; and a finite motion of each mechanism confirms it, that its freedom lasts.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assur.synthesis.arrangements import TURNS, ArrangedClasses
from assur.synthesis.assembly import MechanismFamily, Rejected, Sought, known_members, mechanism
from assur.synthesis.classes import Class, simplicity
from assur.synthesis.confirmed import Confirmed, counted_by
from assur.synthesis.designs import Design
from assur.synthesis.home_constraints import constraints_of, home_twists
from assur.synthesis.limb_motions import CandidateLimb, limb_by_itself
from assur.synthesis.limbs import FREE, Actuators, LimbType, short_types
from assur.synthesis.positions import SWAP, turned
from assur.synthesis.required import RequiredMotion
from assur.synthesis.tally import Tally
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.analysis import analyse
from assur.topology.counting.inputs import numbered_inputs
from assur.topology.counting.mobility import mobility
from assur.topology.facts import Topology
from assur.topology.screws.configurations import ImmobileError, configurations
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.placing import place
from assur.topology.screws.screws import screw_tree
from assur.topology.screws.second_order import second_order
from assur.topology.screws.twists import UnclearRankError, dimensions, edges, motion_space

SEEDS = (1, 2)
"""Two places of a limb: the directions of its constraints must not depend on where it stands."""

TRIES, BARREN = 40, 12
"""So many mechanisms of different limbs are moved to find those that are listed, fewer if there is none among them."""


def limb_classes(motion: RequiredMotion, actuators: Actuators, *, passive: bool) -> tuple[Class, ...]:
    """Limbs whose constraints leave the motion its freedoms, those with constraints along the same directions together.

    Args:
        motion: at home.
        actuators: where the driven joint of a limb stands.
        passive: whether one limb has no drive and alone constrains the platform, while the others constrain nothing.
    """
    types = short_types(motion, actuators)
    if passive:
        types = (*(limb for limb in types if limb.freedoms == FREE), *short_types(motion, actuators, passive=True))
    classes: dict[object, list[CandidateLimb]] = {}
    for limb in types:
        stood = limb_with_directions(limb, motion)
        if stood is not None:
            classes.setdefault((limb.driven == (), stood[0]), []).append(stood[1])
    ordered = (sorted(limbs, key=lambda limb: simplicity([limb])) for limbs in classes.values())
    return tuple(sorted(map(tuple, ordered), key=lambda limbs: (limbs[0].type.freedoms, simplicity(limbs[:1]))))


def limb_with_directions(limb: LimbType, motion: RequiredMotion) -> tuple[tuple[object, ...], CandidateLimb] | None:
    """The directions of its constraints, and the limb turned into them; none if it resists the motion.

    Errors:
        RoutesDisagreeError: rules and twists differ on its POC set.
    """
    first, second = (constraints_of(home_twists(limb.chain, TURNS[0], seed)) for seed in SEEDS)
    alone = limb.driven or first.leave(motion)  # what nothing drives must constrain the platform by itself
    if first.key != second.key or not alone or not first.allows(motion):
        return None
    swapped = LimbType(turned(limb.chain, SWAP), limb.driven, limb.key)
    other = constraints_of(home_twists(swapped.chain, TURNS[0], SEEDS[0]))
    key, stood = (other.key, swapped) if other.key > first.key else (first.key, limb)
    return key, limb_by_itself(stood, TURNS)


def moved(arranged: ArrangedClasses, sought: Sought) -> MechanismFamily:
    """The simplest mechanisms of some classes of which a finite motion confirms that their freedom lasts, best first.

    Args:
        arranged: of whose constraints at home the motion is known.
        sought: what is asked of them; its placements do not matter.
    """
    equal = arranged.equal
    others = [] if sought.symmetric else [limbs for limbs in arranged.simplest()[:TRIES] if limbs not in equal]
    known = [limbs for limbs in equal if mechanism(limbs) in sought.known]
    named = [*known, *known_members(arranged.chosen, sought.known)]
    rest = [limbs for limbs in [*equal, *others] if limbs not in named]
    outcomes = [_outcome(limbs, arranged, sought) for limbs in named]
    most = len(equal) if sought.symmetric else sought.members
    for tried, limbs in enumerate(rest):
        listed = sum(isinstance(outcome, Design) for outcome in outcomes[len(named) :])
        if listed >= most or tried >= (TRIES if listed or sought.symmetric else BARREN):
            break
        outcomes.append(_outcome(limbs, arranged, sought))
    designs = sorted((outcome for outcome in outcomes if isinstance(outcome, Design)), key=lambda design: design.order)
    rejected = [outcome for outcome in outcomes if isinstance(outcome, Rejected)]
    members = len(equal) if sought.symmetric else arranged.members
    tally = Tally(
        classes=1,
        combinations=members,
        with_motion=members if designs else 0,
        tried=len(outcomes),
        unfixed=sum(rejection.unfixed for rejection in rejected),
        disagreements=tuple(rejection.disagreement for rejection in rejected if rejection.disagreement),
    )
    return MechanismFamily(tuple(designs), tally)


def _outcome(limbs: Sequence[CandidateLimb], arranged: ArrangedClasses, sought: Sought) -> Design | Rejected:
    """The mechanism of these limbs, if it moves as is sought: by ranks first, which are known much faster than all."""
    if _is_blocked(place(arranged.unnamed(limbs))):
        return Rejected()
    chains = arranged.chains(limbs)
    driven = [f"{number}.{place + 1}" for number, limb in enumerate(limbs, 1) for place in limb.type.driven]
    linkage = place(chains, actuated=numbered_inputs(chains, driven))
    try:
        counted = _counted(linkage, sought.motion)
        if counted is None:
            return Rejected()
        if counted.left or (counted.decoupling is None and not counted.determining):
            return Rejected(unfixed=True)
        degree = counted.loops.coupling_degree
        if degree is None or degree not in sought.degrees:
            return Rejected()
        topology = analyse(linkage, chains)
    except (UnclearRankError, ImmobileError):  # modes meet at home, or its freedom does not last
        return Rejected()
    except RoutesDisagreeError as error:
        return Rejected(disagreement=error.message)
    if not _is_parasitic(topology, sought.motion):
        return Rejected()
    decoupling = None if counted.determining else counted.decoupling
    return Design(
        limbs=tuple(limbs),
        places=arranged.places,
        chains=chains,
        known=topology.known,
        loops=counted.loops,
        decoupling=decoupling,
        dof=topology.dof,
        mode="home",
        determining=counted.determining,
    )


def _is_blocked(linkage: Linkage) -> bool:
    """Whether it loses freedoms to the second order: most that lose some do, and it needs no displacement."""
    home = second_order(linkage, np.zeros(len(screw_tree(linkage).scales)))
    return home.freedoms < home.instantaneous


def _counted(linkage: Linkage, motion: RequiredMotion) -> Confirmed | None:
    """The ranks where it is displaced; none where it has not the freedoms of a motion there, or a joint rests."""
    displaced = edges(linkage, configurations(linkage, len(SEEDS)))
    t, r, dim = dimensions(motion_space(displaced, linkage.base, linkage.platform))
    resting = mobility(displaced, linkage.base, linkage.platform).idle
    counted = counted_by(displaced)
    return counted if counted.dof == dim == motion.dim < t + r and not resting else None


def _is_parasitic(topology: Topology, motion: RequiredMotion) -> bool:
    """Whether a mechanism has the freedoms of a motion, all of its joints move, and others come with them."""
    poc = topology.poc
    whole = not topology.internal_freedoms and not topology.idle_joints
    return whole and topology.dof == poc.dim == motion.dim < poc.t + poc.r

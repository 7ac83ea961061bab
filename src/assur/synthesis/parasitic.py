"""Parasitic mechanisms: the motion that is asked is that at home, and others come with it as soon as home is left.

No motion of a limb says so. The constraints of the limbs at home do, forces and couples that depend on directions of
axes; and a finite motion of each mechanism confirms it, that its freedom lasts.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import chain as joined
from itertools import combinations_with_replacement, product

import numpy as np
from numpy.typing import NDArray

from assur.numerics.rotations import about_axis
from assur.synthesis.assembly import MechanismFamily, Rejected, Sought, known_members, mechanism
from assur.synthesis.classes import AMONG, Class, simplicity
from assur.synthesis.designs import Design, DeterminingSet, least
from assur.synthesis.home_constraints import constraints_of, home_twists, together
from assur.synthesis.limb_motions import CandidateLimb, limb_by_itself
from assur.synthesis.limbs import FREE, Actuators, LimbType, short_types
from assur.synthesis.positions import DIGITS, SWAP, turned
from assur.synthesis.required import RequiredMotion
from assur.synthesis.shared_axes import End, Lines, common_lines, on_lines, with_common_lines
from assur.synthesis.tally import Tally
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.analysis import analyse
from assur.topology.chains import Chain
from assur.topology.counting.coupling import Decomposition
from assur.topology.counting.inputs import numbered_inputs
from assur.topology.facts import Topology
from assur.topology.screws.configurations import ImmobileError, configurations
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.placing import place
from assur.topology.screws.twists import UnclearRankError, dimensions, edges, motion_space

FloatArray = NDArray[np.float64]

_THIRDS = (about_axis(np.array([0.0, 0.0, 1.0]), np.radians(np.array(angle))) for angle in (120.0, 240.0))

TURNS = (np.eye(3), SWAP, *(np.round(turn, DIGITS) for turn in _THIRDS))
"""Positions of a limb: as written, with x and y exchanged, turned about z by a third and by two thirds of a turn."""

EVENLY = (0, 2, 3)
"""Positions of three limbs evenly about z."""

SEEDS = (1, 2)
"""Two places of a limb: the directions of its constraints must not depend on where it stands."""

TRIES, BARREN = 40, 12
"""So many mechanisms of different limbs are moved to find those that are listed, fewer if there is none among them."""


@dataclass(frozen=True, eq=False)
class ArrangedClasses:
    """Limbs by the class of each, in an arrangement in which their constraints leave the motion at home.

    Attributes:
        chosen: the class of each limb.
        places: the position of each.
        lines: about which some of them turn, of the base or the platform.
    """

    chosen: tuple[Class, ...]
    places: tuple[int, ...]
    lines: Lines

    def chains(self, limbs: Sequence[CandidateLimb]) -> tuple[Chain, ...]:
        """How limbs, one of each class, stand in it."""
        placed = [limb.chains[place] for limb, place in zip(limbs, self.places, strict=True)]
        return with_common_lines(placed, self.lines)

    @property
    def members(self) -> int:
        """Mechanisms that it stands for; limbs of one class that stand alike change places."""
        return math.prod(math.comb(len(limbs) + count - 1, count) for limbs, count in self._slots())

    def simplest(self) -> list[tuple[CandidateLimb, ...]]:
        """One limb of each class, the simplest first, among the simplest of each class."""
        few = int(AMONG ** (1 / len(self.chosen)))
        choices = [combinations_with_replacement(limbs[:few], count) for limbs, count in self._slots()]
        return sorted((tuple(joined.from_iterable(parts)) for parts in product(*choices)), key=simplicity)

    def _slots(self) -> list[tuple[Class, int]]:
        """Limbs of one class that stand alike, and how many; those evenly about z do."""
        places = (0,) * len(self.places) if self.places == EVENLY else self.places
        counts = Counter((id(limbs), place) for limbs, place in zip(self.chosen, places, strict=True))
        by_id = {id(limbs): limbs for limbs in self.chosen}
        return [(by_id[number], count) for (number, _), count in counts.items()]


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


def arranged_classes(sets: Iterable[tuple[Class, ...]], motion: RequiredMotion) -> Iterator[ArrangedClasses]:
    """Those of the sets, one class for each limb, that leave just the motion at home, in each such arrangement."""

    @cache
    def wrenches(limb: CandidateLimb, slot: int, place: int, line: End) -> FloatArray:
        return constraints_of(home_twists(limb.type.chain, TURNS[place], slot, line)).wrenches

    for chosen in sets:
        simplest = [members[0] for members in chosen]
        for places in _placements(chosen):
            chains = [limb.chains[place] for limb, place in zip(simplest, places, strict=True)]
            for lines in common_lines(chains):
                on = {number: end for end, numbers in on_lines(chains, lines).items() for number in numbers}
                ends: list[End] = [on.get(slot, "") for slot in range(len(chosen))]
                if together(list(map(wrenches, simplest, range(len(chosen)), places, ends))).leave(motion):
                    yield ArrangedClasses(chosen, places, lines)
                    break


def _placements(chosen: Sequence[Class]) -> list[tuple[int, ...]]:
    """Positions of limbs, each set once: at right angles, evenly about z; free ones as written."""
    free = [limbs[0].type.freedoms == FREE for limbs in chosen]

    def stood(places: Sequence[int]) -> list[tuple[int, int]]:
        return sorted((id(limbs), place) for limbs, place in zip(chosen, places, strict=True))

    kept: dict[str, tuple[int, ...]] = {}
    for places in product((0, 1), repeat=len(chosen)):
        across = [0 if none else 1 - place for none, place in zip(free, places, strict=True)]  # x and y exchanged
        if not any(none and place for none, place in zip(free, places, strict=True)):
            kept.setdefault(repr(min(stood(places), stood(across))), places)
    several = len(chosen) == len(EVENLY) and sum(free) < len(chosen) - 1
    return [*kept.values(), EVENLY] if several else list(kept.values())


def moved(arranged: ArrangedClasses, sought: Sought) -> MechanismFamily:
    """The simplest mechanisms of some classes of which a finite motion confirms that their freedom lasts, best first.

    Args:
        arranged: of whose constraints at home the motion is known.
        sought: what is asked of them; its placements do not matter.
    """
    equal = [limbs for limbs in arranged.simplest() if all(limb is limbs[0] for limb in limbs)]
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
    chains = arranged.chains(limbs)
    driven = [f"{number}.{place + 1}" for number, limb in enumerate(limbs, 1) for place in limb.type.driven]
    linkage = _driven(chains, driven)
    try:
        if not _keeps_its_freedoms(linkage, sought.motion):
            return Rejected()
        topology = analyse(linkage, chains)
        determining = _determining(topology)
        if determining:
            topology = analyse(_driven(chains, [driven[index] for index in min(determining, key=least).drives]), chains)
    except (UnclearRankError, ImmobileError):  # modes meet at home, or its freedom does not last
        return Rejected()
    except RoutesDisagreeError as error:
        return Rejected(disagreement=error.message)
    if not _is_parasitic(topology, sought.motion):
        return Rejected()
    if topology.coupling_degree is None or topology.decoupling is None:
        return Rejected(unfixed=True)
    if topology.coupling_degree not in sought.degrees:
        return Rejected()
    known = topology.known
    loops = Decomposition(topology.loops, topology.assur_chains)
    decoupling = None if determining else topology.decoupling
    return Design(
        tuple(limbs), arranged.places, chains, known, loops, decoupling, topology.dof, "home", determining=determining
    )


def _driven(chains: Sequence[Chain], numbers: Sequence[str]) -> Linkage:
    return place(chains, actuated=numbered_inputs(chains, numbers))


def _determining(topology: Topology) -> tuple[DeterminingSet, ...]:
    """The sets of redundant drives that determine a mechanism."""
    names = topology.inputs
    return tuple(
        DeterminingSet(tuple(map(names.index, one.drives)), one.coupling_degree)
        for one in topology.determining
        if one.coupling_degree is not None
    )


def _keeps_its_freedoms(linkage: Linkage, motion: RequiredMotion) -> bool:
    """Whether a displaced platform has as many freedoms as a motion; known much faster than its topology."""
    displaced = edges(linkage, configurations(linkage, len(SEEDS)))
    t, r, dim = dimensions(motion_space(displaced, linkage.base, linkage.platform))
    return dim == motion.dim < t + r


def _is_parasitic(topology: Topology, motion: RequiredMotion) -> bool:
    """Whether a mechanism has the freedoms of a motion, all of its joints move, and others come with them."""
    poc = topology.poc
    whole = not topology.internal_freedoms and not topology.idle_joints
    return whole and topology.dof == poc.dim == motion.dim < poc.t + poc.r

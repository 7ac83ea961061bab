"""One layout of some chains tried: its file, whether that is sound, and whether it has the topology of the chains."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from assur.errors import AssurError
from assur.joint_graph.points import quantity
from assur.kinematics.closure import RANK_GAP
from assur.kinematics.home import home_values
from assur.kinematics.modes import written_quantities
from assur.kinematics.parasitic import moving
from assur.kinematics.rates.motions import motions
from assur.kinematics.rates.restraint import WELL
from assur.kinematics.structure import linkage
from assur.kinematics.validation.check import closes_far_off, faults
from assur.model.file.reader import read_text
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION
from assur.results.plain_text import count as plural
from assur.synthesis.drafting.copying import next_steps
from assur.synthesis.drafting.document import Chosen, DrivenJoint, document
from assur.synthesis.drafting.facts import differences
from assur.synthesis.drafting.homes import CLEAR, away, clearance, holding, home_table, travel
from assur.synthesis.drafting.knees import knee_formula, turned_round
from assur.synthesis.drafting.layout import HEIGHT, DraftLayout, looped
from assur.synthesis.drafting.lengths import by_lengths
from assur.synthesis.drafting.limb import HEIGHT_NAME
from assur.synthesis.drafting.pose import pose_for
from assur.synthesis.drafting.tables import Knee
from assur.synthesis.drafting.templates import Draft, draft
from assur.synthesis.drafting.ties import Tie, joints_of, tied, ties
from assur.topology.analysis import Mode, analyse
from assur.topology.chains import Chain
from assur.topology.facts import Topology
from assur.topology.notation import plain_text
from assur.topology.poc import PocSet, motion_name
from assur.work import stage

BY_LENGTHS = (
    "The parameters are lengths l and offsets e of links, radii a, b or r from the Z axis, heights h, and angles. At",
    "joint values zero all link frames are parallel to the base's; the loops are closed from the values below.",
)
BY_COORDINATES = (
    "As drawn, all joint values are zero and all link frames are parallel to the base's. The parameters say where",
    "joints are there, so that the loops close whatever their values are.",
)
AWAY = "Home is a little away from where it was drawn, which is singular."

STRAIGHT = 1.0
"""A knee whose formula is smaller, in mm^2, is stretched."""

ROOM, TILT = 100, 30
"""Half the sizes of the box: mm, deg."""


@dataclass(frozen=True)
class Attempt:
    """One layout as a file: what is wrong with it, or how far its home is from singular; `unreadable`: none closes.

    `held` is the condition number of what holds its platform; `travel`, asked where limbs have inner loops, the share
    of what inputs and platform should move that they do; `moved`: home is not as `drawn`. Of an `unchecked` one it is
    not known whether the file has faults.
    """

    text: str
    record: MechanismRecord | None
    fault: str = ""
    clearance: float = 0.0
    held: float = 1.0
    travel: float = 1.0
    unreadable: bool = False
    unchecked: bool = False
    drawn: Draft | None = None
    moved: bool = False


@dataclass(frozen=True)
class DraftQuestion:
    """What a draft must be: the chains, the file, what is driven, and the topology that it must have."""

    chains: Sequence[Chain]
    path: Path
    inputs: Sequence[str]
    topology: Topology
    mode: Mode
    coordinates: bool = False

    @stage("draft of one layout")
    def attempt(self, layout: DraftLayout, *, moved: bool, unchecked: bool = False) -> Attempt:
        """A layout as a file; `moved`: its home is not as drawn, but the platform a little away from there."""
        drawn = draft(self.chains, layout)
        return dataclasses.replace(self._formed(drawn, moved, unchecked=unchecked), drawn=drawn, moved=moved)

    def _formed(self, drawn: Draft, moved: bool, *, unchecked: bool) -> Attempt:
        if self.coordinates:
            return self._written(drawn, moved=moved, unchecked=unchecked)
        # where loops close for special dimensions alone, rounded ones may not do
        for rounded, polar in ((True, True), (True, False), (False, False)):
            made = self._written(by_lengths(drawn, rounded=rounded, polar=polar), moved=moved, unchecked=unchecked)
            if not made.unreadable:
                break
        return made

    def _written(self, drawn: Draft, *, moved: bool, unchecked: bool) -> Attempt:
        driven = _inputs(self.chains, drawn, self.inputs)
        first = Chosen(self.path.stem, (), (*LENGTHS, *ANGLES), False, driven, {}, {})
        still, turns = self.topology.poc.r == 0, turns_alone(self.topology.poc)
        try:
            record = self._read(drawn, first)
            values = away(record, still=still) if moved else home_values(record)
            if values is None:
                return Attempt("", None, "the platform cannot be moved away from home")
            freedoms = self.topology.actuation.needed
            pose = pose_for(motions(record, values, RANK_GAP).twists, freedoms, still=still, turns=turns)
            if pose is None:
                return Attempt("", None, f"no {freedoms} coordinates say where the platform is")
            chosen = dataclasses.replace(
                first,
                pose=pose,
                constant=still,
                box=_box(pose, drawn),
                header=self._header(drawn, moved=moved),
                home=home_table(record, values) if moved or closes_far_off(record) else {},
                motion=motion_name(self.topology.poc.dim, self.topology.poc.r),
            )
            chosen = self._with_modes(drawn, chosen)
            record = self._read(drawn, chosen)
            wrong = "" if unchecked else _fault(record)
            if wrong:
                return Attempt("", None, wrong)
            far, held = clearance(record), holding(record)
            free = travel(record) if looped(self.chains) and far >= CLEAR and held <= WELL else 1.0
            return Attempt(document(drawn, chosen), record, "", far, held, free, unchecked=unchecked)
        except AssurError as error:
            return Attempt("", None, error.message, unreadable=True)

    def tied(self, made: Attempt) -> Attempt:
        """The same with formulas for dimensions that loops close for only if others change with them."""
        drawn = made.drawn
        if drawn is None or made.record is None or not ties(made.record):
            return made
        if self.coordinates:
            return self._with_ties(drawn, ties(made.record), made) or made
        straight: frozenset[str] = frozenset()
        for _ in ("as they are", "by x and y where angles are tied"):
            form = by_lengths(drawn, rounded=False, straight=straight)
            exact = self._written(form, moved=made.moved, unchecked=True)
            own = () if exact.record is None else ties(exact.record)
            straight |= joints_of(form, [name for tie in own if not tie.linear for name in tie.names])
        forms = (by_lengths(drawn, rounded=rounded, straight=straight) for rounded in (True, False))
        return next(filter(None, (self._with_ties(form, own, made) for form in forms)), made)

    def _with_ties(self, form: Draft, own: Sequence[Tie], made: Attempt) -> Attempt | None:
        again = self._written(tied(form, own), moved=made.moved, unchecked=False)
        return again if self.agrees(again, {}) else None

    def agrees(self, made: Attempt, reasons: dict[str, None]) -> bool:
        """Whether a file is sound and has the topology of the chains; if not, why."""
        if made.record is None:
            return False
        if made.unchecked and (fault := _fault(made.record)):
            reasons[fault] = None
            return False
        try:
            wrong = differences(self.topology, analyse(linkage(made.record), mode=self.mode))
        except AssurError as error:
            wrong = (error.message,)
        reasons.update(dict.fromkeys(wrong))
        return not wrong

    def _read(self, drawn: Draft, chosen: Chosen) -> MechanismRecord:
        return read_text(document(drawn, chosen), self.path)

    def _header(self, drawn: Draft, *, moved: bool) -> tuple[str, ...]:
        """What the file is, and what to do with it."""
        steps = [line.removeprefix("# ") for line in next_steps(self.path)]
        topology = self.topology
        freedoms = plural(topology.dof - topology.internal_freedoms, "degree")
        return (
            f"{self.path.stem}: drafted from chains in notation. All dimensions are defaults, none is from a source.",
            *self._limbs(drawn),
            f"Their topology: {topology.poc}, {freedoms} of freedom, {topology.coupling_words}.",
            "",
            *(BY_COORDINATES if self.coordinates else BY_LENGTHS),
            *((AWAY,) if moved else ()),
            "Next:",
            *steps,
        )

    def _limbs(self, drawn: Draft) -> Iterator[str]:
        """The limbs in notation; of turns of one limb the first, as the axes of the others are long numbers."""
        for template in drawn.templates:
            chain = self.chains[template.members[0]]
            text = " ".join((chain.text or plain_text(chain)).split())
            numbers = [str(member + 1) for member in template.members]
            turned = ", turned about z" if any(template.angles) and len(numbers) > 1 else ""
            yield f"    {'limbs' if len(numbers) > 1 else 'limb'} {', '.join(numbers)}: {text}{turned}"

    def _with_modes(self, drawn: Draft, chosen: Chosen) -> Chosen:
        """The same with working modes by the senses of the knees, where every limb has one that is bent."""
        knees = [template.knee for template in drawn.templates if template.knee is not None]
        if len(knees) < len(drawn.templates):
            return chosen
        record = self._read(drawn, dataclasses.replace(chosen, working=_working(drawn, knees)))
        if {*moving(record)} & {*ANGLES}:  # at one pose the platform stands in two ways, which no knee tells
            return chosen
        values = home_values(record)
        sizes = iter(
            [float(quantity(record, formula, values)) for formula in written_quantities(record, "inverse").values()]
        )
        counted = []
        for template, knee in zip(drawn.templates, knees, strict=True):
            bends = [next(sizes) for _ in template.angles]
            if min(bends) < STRAIGHT and max(bends) > -STRAIGHT:
                return chosen
            counted.append(turned_round(knee) if max(bends) < 0 else knee)
        return dataclasses.replace(chosen, working=_working(drawn, counted))


def turns_alone(poc: PocSet) -> bool:
    """Whether the platform turns in several ways, and its translations come with these: as about a point."""
    return poc.dim == poc.r > 1


def _fault(record: MechanismRecord) -> str:
    """The first fault of a file, empty where there is none."""
    wrong = faults(record)
    return f"{wrong[0].path}: {wrong[0].given}" if wrong else ""


def _working(drawn: Draft, knees: Sequence[Knee]) -> dict[str, str]:
    limbs = [
        (knee, f"{template.name}{number}", angle, turn)
        for template, knee in zip(drawn.templates, knees, strict=True)
        for number, (angle, turn) in enumerate(zip(template.angles, template.turns, strict=True), 1)
    ]
    return {f"k{number}": knee_formula(*limb) for number, limb in enumerate(limbs, 1)}


def _inputs(chains: Sequence[Chain], drawn: Draft, inputs: Sequence[str]) -> tuple[DrivenJoint, ...]:
    """The actuated joints of the chains as the file calls them; of a C or U the first component."""
    places = {
        joint.name: (number, place) for number, chain in enumerate(chains) for place, joint in enumerate(chain.joints)
    }
    kinds = {
        f"{template.name}{number}.{joint.name}": joint.type
        for template in drawn.templates
        for number, _ in enumerate(template.members, 1)
        for joint in template.joints
    }
    names = [drawn.joint_of(*places[name]) for name in inputs]
    return tuple(DrivenJoint(name, kinds[name].components[0] if kinds[name].freedoms > 1 else "") for name in names)


def _box(pose: Sequence[str], drawn: Draft) -> dict[str, tuple[str, str]]:
    """Where to look for the workspace: around home."""
    box = dict.fromkeys(LENGTHS, (f"-{ROOM}", f"{ROOM}"))
    if any(size.name == HEIGHT_NAME for size in drawn.dimensions):
        box["z"] = (f'"{HEIGHT_NAME} - {ROOM}"', f'"{HEIGHT_NAME} + {ROOM}"')
    elif not drawn.flat:
        box["z"] = (f"{HEIGHT - ROOM:g}", f"{HEIGHT + ROOM:g}")
    box |= dict.fromkeys(ANGLES, (f"-{TILT}", f"{TILT}"))
    box |= dict.fromkeys(QUATERNION, ("-0.2", "0.2")) | {"qw": ("0.9", "1")}
    return {name: box[name] for name in pose}

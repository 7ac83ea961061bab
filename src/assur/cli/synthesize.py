"""`assur synthesize`: every mechanism of bounded size that has a wanted motion, ranked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from assur.cli.numbers import whole_number
from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.output import heading, table
from assur.cli.progress import progress
from assur.errors import UnknownNameError, UsageError
from assur.results.answers.answer import ABSENT

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.results.answers.topology import ExplanationAnswer, SynthesisAnswer
    from assur.synthesis.designs import Design
    from assur.synthesis.limbs import Actuators
    from assur.synthesis.synthesis import Synthesis, SynthesisQuestion

MILLION = 1_000_000
"""Combinations that are looked at without a word; some take seconds, a hundred times as many hours."""

SHOWN = 20
"""Mechanisms in the table, and files, if nothing else is asked for."""

FILTERS = {
    "limbs": "the number of limbs",
    "drives": "the number of drives",
    "words": "the limbs that are written",
    "limb": "the limbs' own motion",
    "motion": "the platform's motion",
    "actuation": "the drives that are to determine it",
    "coupling": "the coupling degree",
    "symmetry": "equal limbs",
}
"""What drops a mechanism, in the order in which it is asked."""

Numbered = tuple[int, "Design"]
"""A mechanism with its rank."""


def synthesize(
    *,
    motion: Annotated[
        str,
        Parameter(metavar="3T|2T1R|3T1R|3T3R", help="T counts translations, R rotations, one about z; 3T if left out."),
    ] = "3T",
    limbs: Annotated[
        str | None,
        Parameter(
            metavar="N",
            help="As many as the motion has freedoms if left out, one actuator in each; with fewer, limbs that begin"
            " with an inner loop have two.",
        ),
    ] = None,
    max_joints: Annotated[
        str,
        Parameter(
            metavar="N", help="Joints of a limb; U and P(4R) count as one, and one branch of a loop. 5 if left out."
        ),
    ] = "5",
    coupling: Annotated[
        str, Parameter(metavar="LOW..HIGH", help="Coupling degrees that are wanted, as 0..1 or 1; any if left out.")
    ] = "",
    symmetric: Annotated[bool, Parameter(help="Only mechanisms of equal limbs.")] = False,
    actuators: Annotated[
        str, Parameter(metavar="base|leg", help="Drive the first joint of each limb, or a P inside it, as in U-P-U.")
    ] = "base",
    top: Annotated[
        str, Parameter(metavar="N", help="How many to show and write; 20 if left out, with --json all.")
    ] = "",
    max_members: Annotated[
        str, Parameter(metavar="N", help="How many of a family of different limbs to list; 20 if left out.")
    ] = "",
    explain: Annotated[
        tuple[str, ...],
        Parameter(
            consume_multiple=1,
            metavar="CHAIN ...",
            help="Say instead which filter drops the mechanism with these limbs, or a mechanism by name, or where it is"
            " listed.",
        ),
    ] = (),
    actuate: Annotated[
        str, Parameter(metavar="LIMB.JOINT,..", help="What is driven in the chains of --explain, as 1.1,2.1,3.1.")
    ] = "",
    yes: Annotated[bool, Parameter(help="Look at more than a million combinations, however long it takes.")] = False,
    toml: Annotated[
        str, Parameter(metavar="FOLDER", help="Write each as a topology file that `assur topology` reads.")
    ] = "",
    shared: Plain = PLAIN,
) -> Outcome:
    """Find mechanisms with a wanted motion: type synthesis.

    Limbs are series of R, P, C, U and parallelograms, axes parallel or
    perpendicular to each other; S stands in limbs that constrain nothing. With
    fewer limbs than freedoms some begin with an inner loop of a catalogue. A
    family has limbs of the same motions. Every mechanism that is listed is
    confirmed by the rules of POC sets and by the rank of twists.
    The best come first: smallest coupling degree, then fewest redundant
    constraints, fewest joints, fewest parallelograms, fewest kinds of limbs.
    Before it begins it says how many combinations there are, where these are
    more than a million, and wants --yes. Ctrl-C prints what was found so far.

    For example:
        assur synthesize --motion 3T --limbs 3 --max-joints 5 --symmetric
        assur synthesize --coupling 0..1 --top 40
        assur synthesize --motion 3T --limbs 2 --coupling 0..1
        assur synthesize --actuators leg --symmetric --toml found
        assur synthesize --motion 2T1R --max-joints 3 --json
        assur synthesize --limbs 2 --explain tripteron
        assur synthesize --motion 2T1R --explain "R[z] R[z] R[z]" "P[x] S" S
    """
    from assur.cli.interruption import handing_over
    from assur.cli.paths import planned_folder
    from assur.synthesis.synthesis import Synthesis, TooManyError, question, synthesis

    members = _members(max_members)
    number = None if limbs is None else whole_number(limbs, "--limbs")
    joints, degrees, place = whole_number(max_joints, "--max-joints"), _range(coupling), _place(actuators)
    count = _count(top)
    folder = planned_folder(toml) if toml else None
    if explain:
        asked = question(motion, number, joints, degrees, symmetric=symmetric, actuators=place, members=members)
        return _explained(explain, actuate, asked, shared)
    if actuate:
        raise UsageError("--actuate without --explain; a synthesis chooses the drives itself", hint="see --actuators")
    most = None if yes else MILLION
    with (
        handing_over(Synthesis, lambda synthesis: _outcome(synthesis, count, None)),
        progress("synthesis", shared) as step,
    ):
        try:
            found = synthesis(
                motion,
                number,
                joints,
                degrees,
                symmetric=symmetric,
                actuators=place,
                members=members,
                step=step,
                most=most,
            )
        except TooManyError as error:
            hint = "ask for fewer joints or for --symmetric ones, or look at all of them with --yes"
            raise UsageError(error.message, hint=hint) from None
    return _outcome(found, count, folder)


def _explained(explain: Sequence[str], actuate: str, asked: SynthesisQuestion, shared: Plain) -> Outcome:
    from assur.synthesis.answers import explanation_answer
    from assur.synthesis.explanation import explanation
    from assur.synthesis.known_mechanisms import limbs_driven_by, limbs_of
    from assur.topology.notation import parse_chains

    if len(explain) == 1 and not set("[ {") & set(explain[0].strip()):
        if actuate:
            raise UsageError(f"--actuate beside the name {explain[0]}; it says itself what is driven")
        limbs = limbs_of(explain[0])
    else:
        numbers = [part.strip() for part in actuate.split(",")] if actuate else []
        limbs = limbs_driven_by(parse_chains(explain), numbers)
    with progress("synthesis", shared) as step:
        found = explanation(limbs, asked, step)
    data = explanation_answer(found, asked, limbs)
    return Outcome(data, lambda: _explanation_shown(data))


def _explanation_shown(data: ExplanationAnswer) -> Iterable[RenderableType]:
    yield from data.chains
    yield ""
    if data.dropped_by is None:
        names = f" ({', '.join(data.names)})" if data.names else ""
        yield f"listed{names}: {data.reason}."
        yield f"as it stands there: {' | '.join(data.listed_as)}"
    else:
        yield f"not listed, by the filter of {FILTERS[data.dropped_by]}: {data.reason}."


def _range(text: str) -> tuple[int, int]:
    """Coupling degrees from LOW..HIGH or one number.

    >>> _range("0..1"), _range("2")
    ((0, 1), (2, 2))
    """
    from assur.synthesis.synthesis import ANY

    if not text.strip():
        return ANY
    low, dots, high = text.partition("..")
    first = whole_number(low, "--coupling")
    last = whole_number(high, "--coupling") if dots else first
    if not 0 <= first <= last:
        raise UsageError(f"--coupling {text.strip()} is empty or negative", hint="give it as 0..1, or as one number")
    return (first, last)


def _place(text: str) -> Actuators:
    if text == "base":
        return "base"
    if text == "leg":
        return "leg"
    raise UnknownNameError("place of the actuators", text, ("base", "leg"))


def _count(text: str) -> int | None:
    if not text:
        return None
    count = whole_number(text, "--top")
    if count < 1:
        raise UsageError(f"--top {count}: one at least")
    return count


def _members(text: str) -> int:
    from assur.synthesis.assembly import MEMBERS

    count = whole_number(text, "--max-members") if text else MEMBERS
    if count < 1:
        raise UsageError(f"--max-members {count}: one at least")
    return count


def _outcome(synthesis: Synthesis, top: int | None, folder: Path | None) -> Outcome:
    from assur.synthesis.answers import answers

    data = answers(synthesis, top)
    if folder is not None:
        data = replace(data, written=_write(synthesis, folder, top or SHOWN))
    return Outcome(data, lambda: _shown(synthesis, data, top or SHOWN, folder))


def _write(synthesis: Synthesis, folder: Path, top: int) -> tuple[str, ...]:
    from assur.cli.paths import made
    from assur.results.files import write_whole
    from assur.synthesis.answers import skeletons

    made(folder)
    return tuple(str(write_whole(folder / name, text)) for name, text in skeletons(synthesis, top).items())


def _shown(synthesis: Synthesis, data: SynthesisAnswer, top: int, folder: Path | None) -> Iterable[RenderableType]:
    numbered = list(enumerate(synthesis.designs, 1))
    number = len(synthesis.families)
    yield heading(f"{synthesis.asked.motion.name}: {len(numbered)} mechanisms of {synthesis.asked.limbs} limbs")
    yield from _counts(synthesis, data)
    if synthesis.asked.hybrid and number:
        yield ""
        yield heading(f"the best {top} of {number} families" if top < number else f"{number} families")
        yield _families(synthesis, data, top)
        yield from _reasons([(rank, family.designs[0]) for rank, family in enumerate(synthesis.families[:top], 1)])
    elif numbered:
        yield ""
        yield heading(f"the best {top}" if top < len(numbered) else "ranked")
        yield _table(numbered[:top])
        yield from _reasons(numbered[:top])
    known = [(f"{rank}", design) for rank, design in numbered if design.names]
    if synthesis.asked.hybrid:
        known = [
            (f"{rank}", design)
            for rank, family in enumerate(synthesis.families, 1)
            for design in family.designs
            if design.names
        ]
    if known:
        yield ""
        yield heading("known mechanisms with these limbs")
        yield _known(known, "family" if synthesis.asked.hybrid else "rank")
    if data.written is not ABSENT:
        yield ""
        yield f"written: {len(data.written)} files in {folder}"


def _families(synthesis: Synthesis, data: SynthesisAnswer, top: int) -> RenderableType:
    """One row for each family, with the limbs of its best mechanism."""
    rows = []
    for shown, family in list(zip(data.families, synthesis.families, strict=True))[:top]:
        best = family.designs[0]
        limbs = "\n".join([_limbs(best), *(f"({name})" for name in shown.names)])
        numbers = (shown.rank, shown.members, shown.coupling_degree, shown.redundant_constraints, best.joints)
        rows.append((*map(str, numbers), " ".join(map(str, best.xi)), limbs))
    columns = ("rank", "members", "κ", "red.", "joints", "ξ", "simplest")
    return table(columns, rows, left=("simplest",), wrap=("simplest",))


def _counts(synthesis: Synthesis, data: SynthesisAnswer) -> Iterator[str]:
    """How large the search was."""
    types, tally = data.limb_types, synthesis.tally
    kinds = ", ".join(f"{count} with {poc}" for poc, count in types.by_poc.items())
    yield f"positions    {data.positions}"
    yield f"limb types   {types.with_motion} with the motion: {kinds or 'none'}"
    yield f"combinations {tally.combinations}, {tally.with_motion} of them with the motion by the rules"
    if synthesis.asked.hybrid:
        coupled = Counter(family.coupling_degree for family in data.families)
        yield f"families     {_degrees(coupled) or 'none'}, of the mechanisms that are listed"
    else:
        unknown = tally.with_motion - sum(tally.coupling_degrees.values())
        rest = f", {unknown} on which only twists can tell" if unknown else ""
        yield f"coupling     {_degrees(tally.coupling_degrees) or 'none'}{rest}"
    yield f"one by one   {tally.tried} by twists; the actuators of {tally.unfixed} do not fix the platform"
    if any(not design.symmetric for design in synthesis.designs):
        listed = data.combinations.listed_of_each_class_of_different_limbs
        yield f"Of different limbs the {listed} simplest are listed for each combination of limb motions."


def _degrees(counts: Counter[int]) -> str:
    return ", ".join(f"{count} with κ = {degree}" for degree, count in sorted(counts.items()))


def _table(numbered: Sequence[Numbered]) -> RenderableType:
    rows = [
        (
            str(rank),
            str(design.coupling_degree),
            str(design.redundant.collapsed),
            str(design.joints),
            str(design.dof),
            " ".join(map(str, design.xi)),
            _limbs(design),
            "\n".join(str(poc) for poc in _pocs(design)),
        )
        for rank, design in numbered
    ]
    columns = ("rank", "κ", "red.", "joints", "F", "ξ", "limbs", "t r")
    return table(columns, rows, left=("limbs", "t r"), wrap=("limbs",))


def _limbs(design: Design) -> str:
    """Limbs as they stand; equal ones once, in the first position."""
    from assur.cli.topology_answer import shortened

    if design.symmetric:
        name = f" ({', '.join(design.names)})" if design.names else ""
        return f"{len(design.limbs)} x {shortened(design.chains[0].text)}{name}"
    return "\n".join(shortened(chain.text) for chain in design.chains)


def _pocs(design: Design) -> list[str]:
    """Numbers of the POC set of each limb that is printed."""
    from assur.topology.poc import PocSet

    limbs = design.limbs[:1] if design.symmetric else design.limbs
    return [str(PocSet(limb.known.poc.t, limb.known.poc.r, limb.known.poc.dim)) for limb in limbs]


def _reasons(numbered: Sequence[Numbered]) -> Iterator[str]:
    """One sentence for each run of mechanisms that it is true of."""
    for reason, run in groupby(numbered, key=lambda refused: refused[1].reason):
        ranks = [rank for rank, _ in run]
        yield f"{ranks[0]}{f'-{ranks[-1]}' if len(ranks) > 1 else ''}: {reason}."


def _known(known: Sequence[tuple[str, Design]], column: str) -> RenderableType:
    rows = [(rank, ", ".join(design.names), _limbs_alone(design)) for rank, design in known]
    return table((column, "name", "limbs"), rows, left=("name", "limbs"))


def _limbs_alone(design: Design) -> str:
    from assur.cli.topology_answer import shortened

    return shortened(design.chains[0].text) if design.symmetric else _limbs(design)

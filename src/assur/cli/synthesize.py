"""`assur synthesize`: every mechanism of bounded size that has a wanted motion, ranked."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from assur.cli.numbers import whole_number
from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.progress import progress
from assur.errors import UnknownNameError, UsageError

if TYPE_CHECKING:
    from assur.results.answers.synthesis import DesignDraft
    from assur.synthesis.limbs import Actuators
    from assur.synthesis.question import SynthesisQuestion
    from assur.synthesis.synthesis import Synthesis

MILLION = 1_000_000
"""Combinations that are looked at without a word; some take seconds, a hundred times as many hours."""

SHOWN, DRAFTED = 20, 3
"""Mechanisms in the table and topology files, and drafts, if nothing else is asked for."""


def synthesize(
    *,
    motion: Annotated[
        str,
        Parameter(
            metavar="3T|1T2R|2T1R:PPR|..",
            help="T counts translations, R rotations; 3T if left out. 3T, 2T1R (in a plane), 3T1R and 3T3R have limbs"
            " with parallelograms and inner loops; 2T, 2R, 3R, 1T1R, 1T2R, 2T2R, 3T2R, 1T3R, 2T3R limbs of R, P, U, S"
            " that may share a point. A name means all virtual chains with it, NAME:ROW one of them, as 1T2R:UP.",
        ),
    ] = "3T",
    limbs: Annotated[
        str | None,
        Parameter(
            metavar="N",
            help="As many as there are drives if left out, one in each; with fewer, limbs that begin with an inner loop"
            " have two.",
        ),
    ] = None,
    redundant: Annotated[
        str,
        Parameter(
            metavar="K",
            help="So many drives more than freedoms, and as many limbs more; 0 if left out. κ is then the least that"
            " some of the drives need.",
        ),
    ] = "0",
    max_joints: Annotated[
        str,
        Parameter(
            metavar="N", help="Joints of a limb; U and P(4R) count as one, and one branch of a loop. 5 if left out."
        ),
    ] = "5",
    coupling: Annotated[
        str, Parameter(metavar="LOW..HIGH", help="Coupling degrees that are wanted, as 0..1 or 1; any if left out.")
    ] = "",
    parasitic: Annotated[
        bool,
        Parameter(
            help="The motion is that at home, 1T2R, 2R, 1T3R or 2T3R, and others come with it, as in 3-RPS; limbs have"
            " three joints at most. With one limb more than freedoms, a passive one alone constrains the platform."
        ),
    ] = False,
    idle: Annotated[
        bool,
        Parameter(
            help="Limbs may have one R that stays at rest and takes a redundant constraint away; for motions by virtual"
            " chains, 3T:PPP and 3T1R:PPPR among them."
        ),
    ] = False,
    passive_p: Annotated[
        bool,
        Parameter(
            name="--passive-p",
            negative="--no-passive-p",
            help="Limbs may have P, or C along its axis, that nothing drives; they may if left out. A parallelogram is"
            " none.",
        ),
    ] = True,
    joints: Annotated[
        str,
        Parameter(
            metavar="LETTERS",
            help="Kinds of joints that limbs are made of, of R, P, C, U, S, P(4R), P(4S), P(2US), as RPUS; all if left"
            " out. A P along an R that nothing drives is written C.",
        ),
    ] = "",
    known: Annotated[
        bool | None,
        Parameter(
            name="--known",
            negative="--new",
            help="List only mechanisms of the catalogue, or only others; all if left out.",
        ),
    ] = None,
    symmetric: Annotated[bool, Parameter(help="Only mechanisms of equal limbs.")] = False,
    actuators: Annotated[
        str,
        Parameter(
            metavar="base|leg|any",
            help="Drive the first joint of each limb, or a P inside it, as in U-P-U, or any one R, P or C of it.",
        ),
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
    draft: Annotated[
        str,
        Parameter(
            metavar="FOLDER",
            help="Write the best, one of each family, as mechanism files with dimensions and home, 3 without --top;"
            " and say what solves them by formulas.",
        ),
    ] = "",
    shared: Plain = PLAIN,
) -> Outcome:
    """Find mechanisms with a wanted motion: type synthesis.

    Limbs are series of R, P, C, U and parallelograms, axes parallel or
    perpendicular to each other; S stands in limbs that constrain nothing. With
    fewer limbs than freedoms some begin with an inner loop of a catalogue. A
    family has limbs of the same motions. Every mechanism of 3T, 2T1R, 3T1R and
    3T3R that is listed is confirmed by the rules of POC sets and by the rank of
    twists. Of other motions, limbs close with a virtual chain at finite
    displacements, and ranks of twists there count what is listed. Parasitic
    ones are moved by a finite amount; rules and twists agree where rules answer.
    The best come first: smallest coupling degree, then fewest redundant
    constraints, fewest joints, fewest parallelograms, fewest kinds of limbs.
    The front before them is what no other beats in κ, redundant constraints,
    joints and zeros, pairs of an output and a drive that do not touch.
    Before it begins it says how many combinations there are, where these are
    more than a million, how many families, minutes and megabytes, and wants
    --yes. Ctrl-C prints what was found so far. What was found is kept in the
    cache (assur cache), so that the same command goes on where it was ended.

    For example:
        assur synthesize --motion 3T --limbs 3 --max-joints 5 --symmetric
        assur synthesize --coupling 0..1 --top 40
        assur synthesize --motion 3T --limbs 2 --coupling 0..1
        assur synthesize --actuators leg --symmetric --toml found
        assur synthesize --motion 2T1R --max-joints 3 --json
        assur synthesize --motion 1T2R --parasitic --actuators leg --symmetric
        assur synthesize --motion 3R --symmetric
        assur synthesize --motion 1T2R:UP --top 5
        assur synthesize --motion 2T1R --redundant 1 --symmetric --max-joints 3
        assur synthesize --limbs 2 --coupling 0..1 --no-passive-p --draft found
        assur synthesize --limbs 2 --explain tripteron
        assur synthesize --symmetric --joints RPU --new
        assur synthesize --motion 2T1R --explain "R[z] R[z] R[z]" "P[x] S" S
    """
    from assur.cli.interruption import handing_over
    from assur.cli.paths import planned_folder
    from assur.synthesis.question import question
    from assur.synthesis.synthesis import Synthesis, synthesis

    members = _members(max_members)
    number = None if limbs is None else whole_number(limbs, "--limbs")
    longest, degrees, place = whole_number(max_joints, "--max-joints"), _range(coupling), _place(actuators)
    count = _count(top)
    folder = planned_folder(toml) if toml else None
    drafts = planned_folder(draft) if draft else None
    asked = question(
        motion,
        number,
        longest,
        degrees,
        symmetric=symmetric,
        actuators=place,
        members=members,
        parasitic=parasitic,
        idle=idle,
        passive_slides=passive_p,
        joints=_kinds(joints),
        novelty="" if known is None else "known" if known else "new",
        redundant=whole_number(redundant, "--redundant"),
    )
    if explain:
        return _explained(explain, actuate, asked, shared)
    if actuate:
        raise UsageError("--actuate without --explain; a synthesis chooses the drives itself", hint="see --actuators")
    with (
        handing_over(Synthesis, lambda synthesis: _outcome(synthesis, count, None)),
        progress("synthesis", shared) as step,
    ):
        found = synthesis(asked, step=step, most=None if yes else MILLION)
    return _outcome(found, count, folder, drafts)


def _explained(explain: Sequence[str], actuate: str, asked: SynthesisQuestion, shared: Plain) -> Outcome:
    from assur.cli.synthesis_answer import explanation_shown
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
    return Outcome(data, lambda: explanation_shown(data))


def _range(text: str) -> tuple[int, int]:
    """Coupling degrees from LOW..HIGH or one number.

    >>> _range("0..1"), _range("2")
    ((0, 1), (2, 2))
    """
    from assur.synthesis.question import ANY

    if not text.strip():
        return ANY
    low, dots, high = text.partition("..")
    first = whole_number(low, "--coupling")
    last = whole_number(high, "--coupling") if dots else first
    if not 0 <= first <= last:
        raise UsageError(f"--coupling {text.strip()} is empty or negative", hint="give it as 0..1, or as one number")
    return (first, last)


def _kinds(text: str) -> tuple[str, ...]:
    """Kinds of joints, with or without commas between.

    >>> _kinds("RPS"), _kinds("r, P(4R)")
    (('R', 'P', 'S'), ('R', 'P(4R)'))
    """
    return tuple(re.findall(r"[A-Z0-9](?:\([^)]*\))?|[^\s,A-Z0-9]", text.upper()))


def _place(text: str) -> Actuators:
    if text == "base":
        return "base"
    if text == "leg":
        return "leg"
    if text == "any":
        return "any"
    raise UnknownNameError("place of the actuators", text, ("base", "leg", "any"))


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


def _outcome(synthesis: Synthesis, top: int | None, folder: Path | None, drafts: Path | None = None) -> Outcome:
    from assur.cli.synthesis_answer import shown
    from assur.synthesis.answers import answers

    data = answers(synthesis, top)
    if folder is not None:
        data = replace(data, written=_write(synthesis, folder, top or SHOWN))
    if drafts is not None:
        data = replace(data, drafts=tuple(_drafted(synthesis, drafts, top or DRAFTED)))
    return Outcome(data, lambda: shown(synthesis, data, top or SHOWN, folder))


def _drafted(synthesis: Synthesis, folder: Path, number: int) -> Iterator[DesignDraft]:
    from assur.cli.paths import made
    from assur.errors import AssurError
    from assur.model.registry import load_record
    from assur.results.answers.synthesis import DesignDraft
    from assur.results.files import write_whole
    from assur.synthesis.drafts import chosen, drafted_text, solved_by

    made(folder)
    for rank, design in chosen(synthesis, number):
        path = folder / f"m{synthesis.asked.motion.name.lower()}_{rank}.toml"
        try:
            write_whole(path, drafted_text(design, path))
        except AssurError as error:
            yield DesignDraft(rank, None, error.message)
            continue
        record = load_record(path)
        yield DesignDraft(rank, str(path), "", solved_by(record, "direct"), solved_by(record, "inverse"))


def _write(synthesis: Synthesis, folder: Path, top: int) -> tuple[str, ...]:
    from assur.cli.paths import made
    from assur.results.files import write_whole
    from assur.synthesis.answers import skeletons

    made(folder)
    return tuple(str(write_whole(folder / name, text)) for name, text in skeletons(synthesis, top).items())

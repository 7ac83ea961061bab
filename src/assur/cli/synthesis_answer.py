"""What `assur synthesize` says: how large the search was, a ranked table, reasons, known names."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from pathlib import Path

from rich.console import RenderableType

from assur.cli.output import heading, table
from assur.cli.topology_answer import shortened
from assur.results.answers.answer import ABSENT
from assur.results.answers.synthesis import DesignDraft, ExplanationAnswer, SynthesisAnswer
from assur.synthesis.designs import Design
from assur.synthesis.question import SynthesisQuestion
from assur.synthesis.synthesis import Synthesis
from assur.topology.poc import PocSet

FILTERS = {
    "limbs": "the number of limbs",
    "drives": "the number of drives",
    "words": "the limbs that are written",
    "limb": "the limbs' own motion",
    "motion": "the platform's motion",
    "arrangement": "how the limbs stand to each other",
    "actuation": "the drives that are to determine it",
    "coupling": "the coupling degree",
    "symmetry": "equal limbs",
    "novelty": "known or new ones",
}
"""What drops a mechanism, in the order in which it is asked."""

Numbered = tuple[int, "Design"]
"""A mechanism with its rank."""


def explanation_shown(data: ExplanationAnswer) -> Iterable[RenderableType]:
    """Which filter drops a mechanism, or where it is listed."""
    yield from data.chains
    yield ""
    if data.dropped_by is None:
        names = f" ({', '.join(data.names)})" if data.names else ""
        yield f"listed{names}: {data.reason}."
        yield f"as it stands there: {' | '.join(data.listed_as)}"
    else:
        yield f"not listed, by the filter of {FILTERS[data.dropped_by]}: {data.reason}."


def shown(synthesis: Synthesis, data: SynthesisAnswer, top: int, folder: Path | None) -> Iterable[RenderableType]:
    """The best mechanisms, or families, as many as asked for; known ones wherever they stand."""
    numbered = list(enumerate(synthesis.designs, 1))
    number = len(synthesis.families)
    yield heading(f"{synthesis.asked.motion.name}: {len(numbered)} mechanisms of {synthesis.asked.limbs} limbs")
    yield from _counts(synthesis, data)
    yield from _front(synthesis, data)
    if synthesis.asked.by_families and number:
        yield ""
        yield heading(f"the best {top} of {number} families" if top < number else f"{number} families")
        yield _families(synthesis, data, top)
        yield from _reasons([(rank, family.designs[0]) for rank, family in enumerate(synthesis.families[:top], 1)])
    elif numbered:
        yield ""
        yield heading(f"the best {top}" if top < len(numbered) else "ranked")
        yield _table(numbered[:top], synthesis.asked)
        yield from _reasons(numbered[:top])
    known = [(f"{rank}", design) for rank, design in numbered if design.names]
    if synthesis.asked.by_families:
        known = [
            (f"{rank}", design)
            for rank, family in enumerate(synthesis.families, 1)
            for design in family.designs
            if design.names
        ]
    if known:
        yield ""
        yield heading("known mechanisms with these limbs")
        yield _known(known, "family" if synthesis.asked.by_families else "rank")
    if data.drafts is not ABSENT:
        yield ""
        yield heading("drafted")
        yield from (line for draft in data.drafts for line in _draft(draft))
    if data.written is not ABSENT:
        yield ""
        yield f"written: {len(data.written)} files in {folder}"


def _draft(draft: DesignDraft) -> Iterator[str]:
    if draft.file is None:
        yield f"rank {draft.rank}: no draft; {draft.refusal}"
        return
    yield f"rank {draft.rank}: {draft.file}"
    yield f"  direct problem: {draft.direct}"
    yield f"  inverse problem: {draft.inverse}"


def _front(synthesis: Synthesis, data: SynthesisAnswer) -> Iterable[RenderableType]:
    """What no other mechanism beats, and why."""
    if len(synthesis.designs) < 2:
        return
    yield ""
    asked, rows = synthesis.asked, []
    respects = "redundant constraints and joints" if asked.redundant else "redundant constraints, joints and zeros"
    yield heading(f"the front, beaten by none in κ, {respects}")
    for point in data.front:
        design = replace(synthesis.designs[point.ranks[0] - 1], names=())
        limbs = "\n".join([_limbs(design), *(f"({name})" for name in point.names)])
        family = (str(point.family),) if asked.by_families else ()
        rows.append((str(point.ranks[0]), *family, str(len(point.ranks)), *_values(design, asked), limbs))
    columns = ("rank", *(("family",) if asked.by_families else ()), "alike", *_measures(asked), "limbs")
    yield table(columns, rows, left=("limbs",), wrap=("limbs",))
    yield from (f"{point.ranks[0]}: {point.reason}." for point in data.front)


def _measures(asked: SynthesisQuestion) -> tuple[str, ...]:
    """What mechanisms are compared by; what is the same for all of them, as asked for, is left out."""
    base = () if asked.actuators == "base" else ("on base",)
    zeros = () if asked.redundant else ("zeros",)
    return ("κ", "red.", "joints", *zeros, *base, *(("P",) if asked.passive_slides else ()))


def _values(design: Design, asked: SynthesisQuestion) -> tuple[str, ...]:
    """Its values, as `_measures` names them."""
    values = {
        "κ": design.coupling_degree,
        "red.": design.redundant.collapsed,
        "joints": design.joints,
        "zeros": design.zeros,
        "on base": design.drives_on_base,
        "P": design.passive_slides,
    }
    return tuple(str(values[name]) for name in _measures(asked))


def _families(synthesis: Synthesis, data: SynthesisAnswer, top: int) -> RenderableType:
    """One row for each family, with the limbs of its best mechanism."""
    rows = []
    for shown, family in list(zip(data.families, synthesis.families, strict=True))[:top]:
        best = family.designs[0]
        limbs = "\n".join([_limbs(best), *(f"({name})" for name in shown.names)])
        limbs += f"\n(as {best.row})" if len(synthesis.asked.rows) > 1 else ""
        values = _values(best, synthesis.asked)
        rows.append((str(shown.rank), str(shown.members), *values, " ".join(map(str, best.xi)), limbs))
    columns = ("family", "members", *_measures(synthesis.asked), "ξ", "simplest")
    return table(columns, rows, left=("simplest",), wrap=("simplest",))


def _counts(synthesis: Synthesis, data: SynthesisAnswer) -> Iterator[str]:
    """How large the search was."""
    types, tally = data.limb_types, synthesis.tally
    kinds = ", ".join(f"{count} with {poc}" for poc, count in types.by_poc.items())
    yield f"positions    {data.positions}"
    that = "whose constraints leave the motion" if synthesis.asked.parasitic else "with the motion"
    yield f"limb types   {types.with_motion} {that}: {kinds or 'none'}"
    route = "by the rules"
    if synthesis.asked.parasitic or synthesis.asked.rows:
        route = "by their constraints at home" if synthesis.asked.parasitic else "by their constraints"
    yield f"combinations {tally.combinations}, {tally.with_motion} of them with the motion {route}"
    if synthesis.asked.by_families:
        coupled = Counter(family.coupling_degree for family in data.families)
        yield f"families     {_degrees(coupled) or 'none'}, of the mechanisms that are listed"
    else:
        unknown = tally.with_motion - sum(tally.coupling_degrees.values())
        rest = f", {unknown} on which only twists can tell" if unknown else ""
        yield f"coupling     {_degrees(tally.coupling_degrees) or 'none'}{rest}"
    yield f"one by one   {tally.tried} by twists; the actuators of {tally.unfixed} do not fix the platform"
    if synthesis.kept:
        yield f"kept         {synthesis.kept} families are as an earlier run left them"
    if any(not design.symmetric for design in synthesis.designs):
        listed = data.combinations.listed_of_each_class_of_different_limbs
        simplest = "simplest is" if listed == 1 else f"{listed} simplest are"
        yield f"Of different limbs the {simplest} listed for each combination of limb motions."


def _degrees(counts: Counter[int]) -> str:
    return ", ".join(f"{count} with κ = {degree}" for degree, count in sorted(counts.items()))


def _table(numbered: Sequence[Numbered], asked: SynthesisQuestion) -> RenderableType:
    rows = [
        (
            str(rank),
            *_values(design, asked),
            " ".join(map(str, design.xi)),
            _limbs(design),
            "\n".join(str(poc) for poc in _pocs(design)),
        )
        for rank, design in numbered
    ]
    columns = ("rank", *_measures(asked), "ξ", "limbs", "t r")
    return table(columns, rows, left=("limbs", "t r"), wrap=("limbs",))


def _limbs(design: Design) -> str:
    """Limbs as they stand; equal ones once, in the first position, if they stand as the head of the table says."""
    if design.symmetric and design.places == tuple(range(len(design.limbs))):
        name = f" ({', '.join(design.names)})" if design.names else ""
        return f"{len(design.limbs)} x {shortened(design.chains[0].text)}{name}"
    return "\n".join(shortened(chain.text) for chain in design.chains)


def _pocs(design: Design) -> list[str]:
    """Numbers of the POC set of each limb that is printed."""
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
    return shortened(design.chains[0].text) if design.symmetric else _limbs(design)

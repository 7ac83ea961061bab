"""Aspects: the connected parts of the workspace without a singularity, with proved volumes."""

from __future__ import annotations

from collections.abc import Sequence

from assur.errors import UsageError
from assur.figures.aspects import no_aspects, shown
from assur.report.findings import Findings
from assur.report.sections.reach import size_name
from assur.report.sections.singularities import plain
from assur.report.units import extent_unit
from assur.results.kinds import PROVED, Cell, Result, Scalar, Section, Table
from assur.results.plain_text import count
from assur.results.typeset_text import bounds
from assur.workspace.aspects.aspects import Aspects

LISTED = 12
"""Aspects in the table, the largest first."""

UNTOLD = "; not proved: that aspects that the last column names beside each other are different ones"


def aspects(findings: Findings) -> Section:
    """The aspects of the default working mode in the file's box, as the figure of them has them."""
    if why := no_aspects(findings):
        raise UsageError(why)
    answer = findings.aspects
    mode = f"the working mode {answer.mode}" if answer.mode else "the mechanism"
    said = (
        f"An aspect is a connected part of what {mode} reaches in the file’s box in which no factor of det Jp and none "
        "of det Jq is zero: within one the platform goes from any pose to any other without a singularity and keeps "
        "its modes. Boxes are proved by interval arithmetic to be reached and free of singularities; those that share "
        "a face lie in one aspect. Undecided boxes may hold further, small aspects, and two aspects may be one through "
        f"poses outside the box. {_naming(findings, answer)}"
    )
    results: list[Result] = [*_counts(answer), *findings.picture("aspects"), *_table(findings, answer)]
    return Section("Aspects", said, results)


def _counts(answer: Aspects) -> list[Scalar]:
    different = len(set(answer.search.links.group.tolist()))
    untold = "" if answer.told_apart else f"; {count(len(answer), 'part')} found, not all told apart"
    size = ", ".join(answer.names)
    return [
        Scalar(
            "different aspects, at least", float(different), "", PROVED, low=float(different), note=_of(answer) + untold
        ),
        Scalar(
            "undecided, at most",
            float(shown(100 * answer.undecided_share)),
            "% of the workspace",
            PROVED,
            note=f"{count(len(answer.search.undecided), 'box')} over {size}; --finest of assur aspects cuts smaller",
        ),
    ]


def _of(answer: Aspects) -> str:
    return f"mode {answer.mode}, file's box" if answer.mode else "file's box"


def _naming(findings: Findings, answer: Aspects) -> str:
    """What a label says, and which factors keep one sign in all of them."""
    if not answer.aspects:
        return "No box of the size that is looked at is proved."
    rest = {name: sign for name, sign in answer.aspects[0].signs.items() if name not in answer.naming}
    named = ", ".join(_words(findings, answer.naming))
    label = f"A label is the signs of {named}, and a number where several share them." if answer.naming else ""
    kept = _signs(findings, rest)
    return f"{label} In all of them {kept}." if kept else label


def _words(findings: Findings, names: Sequence[str]) -> list[str]:
    factors = {factor.name: factor for factor in findings.form.factor_list}
    return [plain(factors[name]) for name in names]


def _signs(findings: Findings, signs: dict[str, int]) -> str:
    words = _words(findings, tuple(signs))
    return ", ".join(f"{word} {'>' if sign > 0 else '<'} 0" for word, sign in zip(words, signs.values(), strict=True))


def _table(findings: Findings, answer: Aspects) -> list[Table]:
    if not answer.aspects:
        return []
    unit = extent_unit(findings.record, answer.box.names)
    rows: list[tuple[Cell, ...]] = [
        (
            aspect.label,
            _signs(findings, {name: aspect.signs[name] for name in answer.naming}),
            bounds(*aspect.volume),
            ", ".join(aspect.perhaps[:4]) + (", …" if len(aspect.perhaps) > 4 else ""),
        )
        for aspect in answer.aspects[:LISTED]
    ]
    more = len(answer) - LISTED
    caption = f"And {more} smaller." if more > 0 else ""
    columns = ("aspect", "signs of the factors", f"{size_name(findings.workspace)} [{unit}]", "not told apart from")
    known = PROVED if answer.told_apart else f"{PROVED}{UNTOLD}"
    return [Table("Aspects of the default working mode", columns, tuple(rows), caption, known_by=known)]

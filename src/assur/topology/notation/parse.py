"""Chains from texts: the plain form, and the forms of the literature in Unicode, ASCII and LaTeX."""

from __future__ import annotations

from collections.abc import Sequence

from assur.errors import UsageError
from assur.topology.chains import Chain
from assur.topology.labelled_points import merged
from assur.topology.notation.building import build
from assur.topology.notation.errors import Source
from assur.topology.notation.placing import place
from assur.topology.notation.reader import read
from assur.topology.notation.sketching import sketch_of


def parse_chain(text: str) -> Chain:
    """A chain that stands alone, from the base to the platform.

    The plain form places every axis in the base frame, by x, y, z or by three numbers: `P[x] R[0.5,0.866,0]`,
    `U[x,y]`, `S`, `P(4R)[y]` (y the direction of its hinges; of the short links for 4S, 4U, 2US), `{... | ...}`
    an inner loop, `R[x]@A R[y]@A` axes through one point, `R[x]@A@B` one axis through two, `U[x@A,y]` a point on the
    first axis of a U beside its centre. Axes without brackets are general: fixed directions in
    no special position, the two of a U perpendicular. Equal axes are distinct parallel lines unless they share a point.

    The literature's form says how neighbours lie: `-R1 ∥ R2 ⊥ R3-`, `HSOC{-P-P(4R)-}`, with ∥ (also || // |),
    ⊥ (also _|_), / for one line, ⌢ (also ^) for axes that meet in a point, ◇(P1, P2) for the plane of two, -
    for nothing said; a sign beside a U speaks of the nearer axis. Then the first axis is z unless it is placed, in
    brackets, and what the signs leave open is arbitrary but fixed, and in no special position. A tag stands for a
    real inner loop, see `inner`.

    Errors:
        NotationError: a syntax error, with its place; directions nearly parallel or perpendicular; contradictions.

    Example:
        >>> chain = parse_chain("-R1 ∥ R2 ⊥ R3-")
        >>> chain.elements[1].axes, chain.elements[2].name
        (((0.0, 0.0, 1.0),), 'R3')
    """
    return _chains([text], numbered=False)[0]


def parse_chains(texts: Sequence[str]) -> tuple[Chain, ...]:
    """The limbs of a mechanism, each as in `parse_chain`; names and labels are the mechanism's.

    Names that are not written are counted over all limbs: R1, R2, P1, Pa1. A written name that an earlier limb has
    too is counted on. One label is one point, in all limbs. General axes differ from limb to limb.

    Errors:
        NotationError: as `parse_chain`; with several limbs also a limb in the literature's form whose first axis is
            not placed, because its signs say nothing about the other limbs.
        UsageError: no limb.

    Example:
        >>> [joint.name for limb in parse_chains(["P[x] R[x]", "P[y] R[y]"]) for joint in limb.joints]
        ['P1', 'R1', 'P2', 'R2']
    """
    if isinstance(texts, str):
        raise UsageError(
            f"one text, {texts!r}; expected a list of texts, one for each limb", hint="parse_chain reads one"
        )
    if not texts:
        raise UsageError("no limbs; expected a text for each limb", hint='parse_chains(["P[x] R[x]", "P[y] R[y]"])')
    return _chains(texts, numbered=len(texts) > 1)


def _chains(texts: Sequence[str], *, numbered: bool) -> tuple[Chain, ...]:
    sources = [Source(text, number if numbered else 0) for number, text in enumerate(texts, start=1)]
    sketches = [sketch_of(read(source)) for source in sources]
    chains = build(sketches, place(sketches))
    for number in range(1, len(chains) + 1):
        _refuse_merged(chains[:number], sources[number - 1])
    return chains


def _refuse_merged(chains: Sequence[Chain], source: Source) -> None:
    """That no two labels of some limbs are one point by their axes; the last limb's text makes them so."""
    names = [joint.name for chain in chains for joint in chain.joints]
    pair = merged(chains, names)
    if pair:
        at = max(source.text.rfind(f"@{label}") for label in pair)
        hint = "an axis that runs through two points lies along their line: R[x]@A@B and R[y]@A@B leave none"
        raise source.error(max(at, 0), f"one point with the labels {' and '.join(pair)}", "two points", hint)

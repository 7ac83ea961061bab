"""The steps of Eq. (2) as the papers print them: a platform's limbs, one after the other, with the reason of each."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from assur.topology.poc import PocSet
from assur.topology.symbolic.derivation import DerivationStep, PocDerivation, counted, in_words, under
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal

Carried = Callable[[Sequence[Motion]], Motion | Refusal]
"""The platform's motion on some limbs."""


def limb_derivation(limbs: Sequence[Motion], carried: Carried, name: str, at: str = "") -> PocDerivation:
    """How the set of the platform follows from those of its limbs, at one common point O' of the platform."""
    motions = [carried(limbs[: count + 1]) for count in range(len(limbs))]
    steps = []
    for index in range(1, len(limbs)):
        before, after = motions[index - 1], motions[index]
        if isinstance(before, Motion) and isinstance(after, Motion):
            steps.append(_step(before, limbs[index], after, index, at))
    result = motions[-1].poc if isinstance(motions[-1], Motion) else PocSet(0, 0, 0)
    names = tuple(_name(limb, index) for index, limb in enumerate(limbs))
    whole = DerivationStep("intersection", tuple(limb.seen_at(at) for limb in limbs), names, result, "", "")
    parts = tuple(limb.derivation for limb in limbs)
    conditions = motions[-1].conditions if isinstance(motions[-1], Motion) else ()
    said = f"so the platform has {in_words(result)}{under(conditions)}"
    origin = "where the last axes of the limbs meet" if at else "at a general point of the platform"
    return PocDerivation(name, origin, parts, whole, tuple(steps), said)


def _name(limb: Motion, index: int) -> str:
    return limb.limb.name if limb.limb and limb.limb.name else f"limb {index + 1}"


def _step(before: Motion, limb: Motion, after: Motion, index: int, at: str) -> DerivationStep:
    """One more limb, and by which rule it was decided what it leaves."""
    names = (f"limbs 1 to {index}" if index > 1 else "limb 1", f"limb {index + 1}")
    rule, reason = _reason(before, limb, after, names)
    return DerivationStep(
        "intersection", (before.seen_at(at), limb.seen_at(at)), names, after.seen_at(at), rule, reason
    )


def _reason(before: Motion, limb: Motion, after: Motion, names: tuple[str, str]) -> tuple[str, str]:
    if after.dim == before.dim:
        return "containment", f"all motions of {names[0]} are motions of {names[1]} too"
    if after.dim == limb.dim:
        return "containment", f"all motions of {names[1]} are motions of {names[0]} too"
    lost = PocSet(before.translations.dim - after.translations.dim, before.rotations.dim - after.rotations.dim, 0)
    parts = [counted(lost.t, "translation")] * bool(lost.t) + [counted(lost.r, "rotation")] * bool(lost.r)
    taken = f"{names[1]} takes away {' and '.join(parts)}"
    common = before.rotations.meet(limb.rotations).dim
    if after.rotations.dim == common:
        return "linear rule", f"{taken}; what is left lies in both sets"
    more = counted(common - after.rotations.dim, "rotation")
    return "location", f"{taken}; forces on different lines resist {more} that the linear rule would leave"

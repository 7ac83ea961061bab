"""Sets of directions in the order of solution, each by the linear equations in which nothing else is unknown.

Such a set is what the theory calls an Assur chain: the smallest that has as many equations as it needs.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import sympy

from assur.derivation.linear import Form, combined, divided, never_zero, rank, solved, sparse
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.trigonometric import shorter
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness


def next_set(
    forms: Sequence[Form],
    left: Sequence[UnknownDirection],
    witness: ModularWitness,
    more: int = 0,
    after: Sequence[UnknownDirection] = (),
) -> tuple[tuple[UnknownDirection, ...], list[Form]]:
    """The smallest set among the directions that are left, and the equations in which these alone are unknown.

    With `more` equations than it needs, that many of what is taken as known are determined too. Directions `after`
    follow of some that are left: equations with them wait until these are known.

    Errors:
        NotDerivedError: the equations determine none, or none before directions `after` are known.
    """
    waiting = [unknown for direction in after for unknown in direction.unknowns]
    all_unknowns = [*(unknown for direction in left for unknown in direction.unknowns), *waiting]
    whole = rank(forms, all_unknowns, witness)
    for size in range(1, len(left) + 1):
        for chosen in combinations(left, size):
            others = [unknown for direction in left if direction not in chosen for unknown in direction.unknowns]
            others += waiting
            if whole - rank(forms, others, witness) >= more + sum(direction.freedoms for direction in chosen):
                _, own = solved(forms, others, witness)
                inside = [unknown for direction in chosen for unknown in direction.unknowns]
                kept = [_steady(form, own, inside, witness) for form in _independent(own, inside, witness)]
                return chosen, kept if more else sparse([*map(_whole, kept)], witness, everywhere=True)
    names = ", ".join(direction.name for direction in left)
    if blocked := [own.name for own in after if any({*own.unknowns} & form.keys() for form in forms)]:
        raise NotDerivedError(
            f"{' and '.join(blocked)}: turns, carries a slider, and no vector with it is solved alone"
        )
    raise NotDerivedError(f"no set among {names} has as many linear equations as it needs")


def equations_alone(
    forms: Sequence[Form],
    chosen: Sequence[UnknownDirection],
    others: Sequence[UnknownDirection],
    witness: ModularWitness,
) -> list[Form]:
    """Equations that determine a set whether the others are known or not; none where there are none.

    Of three limbs whose platform stands where its inputs say, each is solved alone so, whatever the others do.
    """
    inside, outside = ([own for direction in part for own in direction.unknowns] for part in (chosen, others))
    left = rank(forms, [*outside, *inside], witness) - rank(forms, outside, witness)
    if left < sum(direction.freedoms for direction in chosen):
        return []
    _, own = solved(forms, outside, witness)
    return sparse([divided(form) for form in _independent(own, inside, witness)], witness, everywhere=True)


def _independent(forms: Sequence[Form], unknowns: Sequence[sympy.Symbol], witness: ModularWitness) -> list[Form]:
    """Short equations first, and none that follows from those before it."""
    kept: list[Form] = []
    for form in sorted(forms, key=_length):
        if rank([*kept, form], unknowns, witness) > len(kept):
            kept.append(form)
    return kept


def _steady(form: Form, forms: Sequence[Form], unknowns: Sequence[sympy.Symbol], witness: ModularWitness) -> Form:
    """An equation of one unknown whose coefficient turns with what is given, by the sum of squares of all that say it.

    A coefficient that is one component of a direction vanishes somewhere; of the whole direction the length does not.
    """
    inside = [key for key in unknowns if key in form]
    if len(inside) > 1 or never_zero(form[inside[0]]):
        return form
    total: Form = {}
    for other in (other for other in forms if [key for key in unknowns if key in other] == inside):
        total = combined(total, other[inside[0]], other, witness)
    total = shorter(total, witness.circles, witness)
    return divided(total) if never_zero(total[inside[0]]) else form


def _whole(form: Form) -> Form:
    """A form without denominators that may vanish: elimination divides by what is given, as the sine of an input."""
    below = [sympy.fraction(part)[1] for part in form.values()]
    return form if all(map(never_zero, below)) else divided(form)


def _length(form: Form) -> tuple[int, int]:
    return len(form), sum(int(sympy.count_ops(coefficient)) for coefficient in form.values())

"""Sets of items in the order in which they are solved, each by the linear equations in which nothing else is unknown.

Such a set is what the theory calls an Assur chain: the smallest that has as many equations as it needs.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import sympy

from assur.derivation.linear import Form, rank, solved
from assur.derivation.loop_equations import Item
from assur.derivation.orientations import NotDerivedError
from assur.derivation.witness import ModularWitness


def next_set(
    forms: Sequence[Form], left: Sequence[Item], witness: ModularWitness
) -> tuple[tuple[Item, ...], list[Form]]:
    """The smallest set among the items that are left, and the equations in which these alone are unknown.

    Errors:
        NotDerivedError: the equations determine none.
    """
    all_unknowns = [unknown for item in left for unknown in item.unknowns]
    whole = rank(forms, all_unknowns, witness)
    for size in range(1, len(left) + 1):
        for chosen in combinations(left, size):
            others = [unknown for item in left if item not in chosen for unknown in item.unknowns]
            if whole - rank(forms, others, witness) >= sum(item.freedoms for item in chosen):
                _, own = solved(forms, others, witness)
                return chosen, _independent(own, [unknown for item in chosen for unknown in item.unknowns], witness)
    names = ", ".join(item.name for item in left)
    raise NotDerivedError(f"what is given does not determine {names}")


def _independent(forms: Sequence[Form], unknowns: Sequence[sympy.Symbol], witness: ModularWitness) -> list[Form]:
    """Short equations first, and none that follows from those before it."""
    kept: list[Form] = []
    for form in sorted(forms, key=_length):
        if rank([*kept, form], unknowns, witness) > len(kept):
            kept.append(form)
    return kept


def _length(form: Form) -> tuple[int, int]:
    return len(form), sum(int(sympy.count_ops(coefficient)) for coefficient in form.values())

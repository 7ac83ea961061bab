"""The straight-line program of a certificate: what the margins and factors of a pose are, by + - * / and roots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from flint import arb

from assur.verifier import bounds
from assur.verifier.bounds import Bounds
from assur.verifier.reading import names, number

TWO = {"+": bounds.add, "-": bounds.subtract, "*": bounds.multiply, "/": bounds.divide}
ONE = {
    **{"negative": bounds.negative, "magnitude": bounds.magnitude, "root": bounds.root},
    **{"cosine": bounds.cosine, "sine": bounds.sine},
}


class Program:
    """Operations on earlier entries; `margins`, `nonzero` and `factors` are (name, entry) of what is wanted."""

    def __init__(self, data: Mapping[str, Any], coordinates: list[str]) -> None:
        self.operations: list[tuple[str, list[int]]] = []
        self.given: dict[int, int] = {}
        self.fixed: dict[int, Bounds] = {}
        for k, (name, *arguments) in enumerate(data["operations"]):
            if name == "number":
                low, high, _ = arguments
                self.fixed[k] = arb(number(low)), arb(number(high))
                if not number(low) <= number(high):
                    raise ValueError(f"operation {k}: bounds that are reversed")
                arguments = []
            elif name == "coordinate":
                self.given[k] = coordinates.index(*arguments)
                arguments = []
            elif len(arguments) != (2 if name in TWO else 1 if name in ONE else -1):
                raise ValueError(f"operation {k}: no {str(name)[:40]!r} of {len(arguments)} arguments in this format")
            elif any(type(a) is not int or not 0 <= a < k for a in arguments):
                raise ValueError(f"operation {k} uses what is no earlier one")
            self.operations.append((name, arguments))
        self.margins, self.nonzero, self.factors = (
            self._outputs(data[group]) for group in ("margins", "nonzero", "factors")
        )
        self._orders: dict[tuple[int, ...], list[int]] = {}

    def over(self, box: Sequence[Bounds], outputs: Sequence[int], strict: bool) -> list[Bounds]:
        """Bounds of outputs over a box; `strict` where no radicand may be negative anywhere in it.

        Errors:
            UndefinedError: somewhere in the box there may be no value.
        """
        values = {**self.fixed, **{k: box[axis] for k, axis in self.given.items()}}
        for k in self._order(tuple(outputs)):
            name, arguments = self.operations[k]
            first = values[arguments[0]]
            if strict and name == "root" and not first[0] >= 0:
                raise bounds.UndefinedError("the root of what may be negative")
            values[k] = TWO[name](first, values[arguments[1]]) if name in TWO else ONE[name](first)
        return [values[k] for k in outputs]

    def _outputs(self, pairs: list[tuple[str, int]]) -> list[tuple[str, int]]:
        names([name for name, _ in pairs])
        if any(type(k) is not int or not 0 <= k < len(self.operations) for _, k in pairs):
            raise ValueError("an output that is no entry of the program")
        return [(name, k) for name, k in pairs]

    def _order(self, outputs: tuple[int, ...]) -> list[int]:
        """The entries that some outputs need, in their order."""
        if outputs not in self._orders:
            needed = set(outputs)
            for k in range(len(self.operations) - 1, -1, -1):
                if k in needed:
                    needed.update(self.operations[k][1])
            self._orders[outputs] = sorted(needed - set(self.fixed) - set(self.given))
        return self._orders[outputs]

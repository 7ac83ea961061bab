"""The straight-line program of a certificate: what the margins and factors of a pose are, by + - * / and roots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from flint import arb

from assur.verifier import bounds
from assur.verifier.bounds import Bounds, nonzero
from assur.verifier.reading import names, number, printable

Box = tuple[list[float], list[float]]
TWO = {"+": bounds.add, "-": bounds.subtract, "*": bounds.multiply, "/": bounds.divide}
ONE = {name: getattr(bounds, name) for name in ("negative", "magnitude", "root", "cosine", "sine")}


class Program:
    """Operations on earlier entries; `margins`, `nonzero`, `factors` and `joints` are the entries that are wanted."""

    def __init__(self, data: Mapping[str, Any], coordinates: list[str]) -> None:
        self.operations: list[tuple[str, list[int]]] = []
        self.given: dict[int, int] = {}
        self.fixed: dict[int, Bounds] = {}
        for k, operation in enumerate(data["operations"]):
            if type(operation) is not list:
                raise ValueError(f"operation {k}: no list")
            name, *arguments = operation
            if name == "number":
                low, high, label = arguments
                printable(label)
                self.fixed[k] = arb(number(low)), arb(number(high))
                if not number(low) <= number(high):
                    raise ValueError(f"operation {k}: bounds that are reversed")
                arguments = []
            elif name == "coordinate":
                (axis,) = arguments
                self.given[k] = coordinates.index(axis)
                arguments = []
            elif len(arguments) != (2 if name in TWO else 1 if name in ONE else -1):
                raise ValueError(f"operation {k}: no {str(name)[:40]!r} of {len(arguments)} arguments in this format")
            elif any(type(a) is not int or not 0 <= a < k for a in arguments):
                raise ValueError(f"operation {k} uses what is no earlier one")
            self.operations.append((name, arguments))
        self.margins, self.nonzero, self.factors, self.joints, *_ = (
            self._outputs(data[group]) for group in ("margins", "nonzero", "factors", "joints", "jp", "jq")
        )
        self._orders: dict[tuple[int, ...], list[int]] = {}

    def over(self, box: Box, outputs: Sequence[int], strict: bool = True) -> list[Bounds] | None:
        """Bounds of outputs over a box, None where they may have no value; with `strict` roots only of what has one."""
        values = {**self.fixed, **{k: (arb(box[0][axis]), arb(box[1][axis])) for k, axis in self.given.items()}}
        for k in self._order(tuple(outputs)):
            name, arguments = self.operations[k]
            operands = [values[a] for a in arguments]
            if (strict and name == "root" and not operands[0][0] >= 0) or (name == "/" and not nonzero(operands[1])):
                return None
            values[k] = (TWO if name in TWO else ONE)[name](*operands)
        return [values[k] for k in outputs]

    def _outputs(self, pairs: list[tuple[str, int]]) -> list[int]:
        names([name for name, _ in pairs])
        if any(type(k) is not int or not 0 <= k < len(self.operations) for _, k in pairs):
            raise ValueError("an output that is no entry of the program")
        return [k for _, k in pairs]

    def _order(self, outputs: tuple[int, ...]) -> list[int]:
        """The entries that some outputs need, in their order."""
        if outputs not in self._orders:
            needed = set(outputs)
            for k in range(len(self.operations) - 1, -1, -1):
                if k in needed:
                    needed.update(self.operations[k][1])
            self._orders[outputs] = sorted(needed - set(self.fixed) - set(self.given))
        return self._orders[outputs]

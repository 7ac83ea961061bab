"""What a written solution is made of: formulas, paragraphs, subsections, and steps of its flow."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class WrittenFormula:
    r"""A formula in LaTeX: left side with its relation, rows of the right side.

    >>> WrittenFormula("B_{1}", ("l_{3} - y_{1}", "+ y_{2}")).latex
    'B_{1} = l_{3} - y_{1} + y_{2}'
    """

    left: str
    rows: tuple[str, ...]
    relation: str = "="

    @property
    def latex(self) -> str:
        """On one line."""
        return f"{self.left} {self.relation} {' '.join(self.rows)}"


Block = str | tuple[WrittenFormula, ...]
"""A paragraph, whose mathematics stands between dollar signs, or formulas."""


@dataclass(frozen=True)
class WrittenPart:
    """A subsection: its title, paragraphs and formulas."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class FlowNode:
    """A step of a solution: its name, what it gives, what is given of it, and the places of the steps before it."""

    name: str
    gives: str
    given: tuple[str, ...]
    before: tuple[int, ...]

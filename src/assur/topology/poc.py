"""POC sets: how many translations and rotations a link has, along which directions, and how they print.

M = [t^p(directions); r^q(directions)], seen at a base point O' of the link. dim M is the number of
independent elements; the p + q - dim M others are non-independent, and `dependent` counts them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.topology.directions import Vector

Relation = Literal["none", "parallel", "perpendicular", "plane", "arm", "moving", "located", "fixed"]
FloatArray = NDArray[np.float64]
Style = Literal["unicode", "ascii", "latex"]


@dataclass(frozen=True)
class Mark:
    """The direction mark of the t or of the r part.

    Attributes:
        relation: "none" (0 or 3 elements, nothing to say); "parallel" to the one axis named; "perpendicular"
            to it (a plane); "plane" spanned by the axes named, the paper's diamond; "arm": one element
            perpendicular to the axis named and to the arm rho from it to O'; "moving": the direction turns as the
            mechanism moves and no axis of the base names it; "located": fixed in the base by where joints are,
            such as the line that joins two centres; "fixed": a direction (or plane) of the base that the twists
            found, which `axes` gives and no joint names.
        names: the joints that the mark names.
        axes: orthonormal basis of the part's directions where they stay fixed in the base, else empty.
    """

    relation: Relation = "none"
    names: tuple[str, ...] = ()
    axes: tuple[Vector, ...] = ()


@dataclass(frozen=True)
class PocSet:
    """A POC set with `t` translations and `r` rotations, `dim` of them independent.

    >>> print(PocSet(3, 2, 5, r_mark=Mark("plane", ("R12", "R3"))))
    t³ r²(∥◇(R12, R3))
    """

    t: int
    r: int
    dim: int
    t_mark: Mark = Mark()
    r_mark: Mark = Mark()

    @property
    def dependent(self) -> int:
        """Number of non-independent elements, p + q - dim M."""
        return self.t + self.r - self.dim

    def __str__(self) -> str:
        return self.text()

    def text(self, style: Style = "unicode") -> str:
        """The set on one line; in LaTeX the matrix of the papers."""
        t, r = _part("t", self.t, self.t_mark, style), _part("r", self.r, self.r_mark, style)
        if style == "latex":
            return rf"\begin{{bmatrix}} {t} \\ {r} \end{{bmatrix}}"
        return f"{t} {r}"


def motion_name(dim: int, rotations: int) -> str:
    """Independent translations and rotations as titles have them; what stands still is 0.

    >>> motion_name(4, 1)
    '3T1R'
    """
    parts = ((dim - rotations, "T"), (rotations, "R"))
    return "".join(f"{number}{letter}" for number, letter in parts if number) or "0"


_SUPERSCRIPT = "⁰¹²³"
_SIGNS = {
    "unicode": {"parallel": "∥", "perpendicular": "⊥", "plane": "∥◇", "rho": "ρ"},
    "ascii": {"parallel": "||", "perpendicular": "_|_", "plane": "||<>", "rho": "rho"},
    "latex": {"parallel": r"\parallel ", "perpendicular": r"\perp ", "plane": r"\parallel\Diamond", "rho": r"\rho"},
}


def _part(letter: str, count: int, mark: Mark, style: Style) -> str:
    power = _SUPERSCRIPT[count] if style == "unicode" else f"^{count}"
    return f"{letter}{power}{_mark(mark, style)}"


def _mark(mark: Mark, style: Style) -> str:
    signs = _SIGNS[style]
    if mark.relation == "none":
        return ""
    if mark.relation in ("moving", "located"):
        return f"({mark.relation})" if style != "latex" else rf"(\text{{{mark.relation}}})"
    if mark.relation == "fixed":
        plane = len(mark.axes) == 2
        vector = np.cross(mark.axes[0], mark.axes[1]) if plane else np.array(mark.axes[0])
        return f"({signs['perpendicular' if plane else 'parallel']}[{_rounded(vector)}])"
    if mark.relation == "arm":
        return f"({signs['perpendicular']}({', '.join((*mark.names, signs['rho']))}))"
    names = ", ".join(mark.names)
    return f"({signs['plane']}({names}))" if mark.relation == "plane" else f"({signs[mark.relation]}{names})"


def _rounded(vector: FloatArray) -> str:
    """A direction to three digits, the first of its larger parts positive."""
    turned = vector * np.sign(vector[np.flatnonzero(np.abs(vector) > 1e-6)[0]])
    return ", ".join(f"{part + 0.0:.3g}" for part in np.where(np.abs(turned) < 1e-6, 0.0, turned))

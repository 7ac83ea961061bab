"""A mechanism as topology alone: its chains of joints, without dimensions, and what is declared about it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from assur.topology.chains import Chain, Element, InnerLoop, Parallelogram

if TYPE_CHECKING:
    from assur.topology.facts import Topology

Mode = Literal["home", "translation"]
Counts = tuple[int, int]
"""Elements (t, r) of a POC set."""


@dataclass(frozen=True)
class Declared:
    """Facts that a file states about its mechanism: tested, never believed. None where it is silent.

    Attributes:
        poc: (t, r) of the platform.
        dim: independent elements of that set.
        dof: F of Eq. (3).
        xi: independent equations of each loop, Eq. (4), in the order that attains the coupling degree.
        coupling_degree: kappa of Eq. (6).
        limbs: (t, r) of each limb.
        limb_dims: independent elements of each limb.
        redundant_constraints: (collapsed, joint_graph): with parallelograms as generalised joints, and with all joints.
        internal_freedoms: (collapsed, joint_graph): freedoms that leave platform and inputs at rest.
        source: how all this is known.
    """

    poc: Counts | None = None
    dim: int | None = None
    dof: int | None = None
    xi: tuple[int, ...] | None = None
    coupling_degree: int | None = None
    limbs: tuple[Counts, ...] | None = None
    limb_dims: tuple[int, ...] | None = None
    redundant_constraints: tuple[int, int] | None = None
    internal_freedoms: tuple[int, int] | None = None
    source: str = ""

    def differences(self, topology: Topology) -> tuple[str, ...]:
        """What the file declares and the engine does not find, one sentence each."""
        computed = {
            "poc": (topology.poc.t, topology.poc.r),
            "dim": topology.poc.dim,
            "dof": topology.dof,
            "xi": topology.xi,
            "coupling_degree": topology.coupling_degree,
            "limbs": tuple((limb.poc.t, limb.poc.r) for limb in topology.limbs),
            "limb_dims": tuple(limb.poc.dim for limb in topology.limbs),
            "redundant_constraints": (
                topology.redundant_constraints.collapsed,
                topology.redundant_constraints.joint_graph,
            ),
        }
        return tuple(
            f"declared {name} = {_plain(getattr(self, name))}, computed {_plain(value)}"
            for name, value in computed.items()
            if getattr(self, name) not in (None, value)
        )


@dataclass(frozen=True)
class TopologyDescription:
    """What a topology file says.

    Attributes:
        name: short name.
        chains: limbs from base to platform; the text of each is in its `text`.
        actuate: (limb, joint) counted from 1, branches flattened; empty for the first P, R or C of each branch.
        mode: "home", or "translation": the platform keeps its orientation.
        declared: facts to be tested.
        file: where it was read from.
    """

    name: str
    chains: tuple[Chain, ...]
    title: str = ""
    source: str = ""
    note: str = ""
    actuate: tuple[tuple[int, int], ...] = ()
    mode: Mode = "home"
    declared: Declared = Declared()
    file: Path | None = None

    @property
    def limb_types(self) -> str:
        """The types of its limbs as they are spoken of: "3-RP(4S)", "3-UPS, 1-UP"."""
        counted = Counter(_letters(chain.elements) for chain in self.chains)
        return ", ".join(f"{count}-{letters}" for letters, count in counted.items())


def _plain(value: object) -> str:
    """A number, or numbers without brackets."""
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)


def _letters(elements: tuple[Element, ...]) -> str:
    return "".join(map(_letter, elements))


def _letter(element: Element) -> str:
    if isinstance(element, InnerLoop):
        return f"{{{'|'.join(map(_letters, element.branches))}}}"
    return f"P({element.kind})" if isinstance(element, Parallelogram) else element.type.letter

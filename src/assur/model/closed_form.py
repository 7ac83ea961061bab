"""What a mechanism's `closed_form.py` declares: kernels written once over any number type, and what they claim.

A kernel is straight-line algebra (+ - * / and `ns.sqrt`). It never decides anything: it returns the
numbers of one branch (or, with arrays of signs, of all branches) together with *margins*, the quantities
that must not be negative (or not zero) for the branch to exist. Everything that a kernel claims about the
joint graph is checked against it: on its first use (`assur.kinematics.contract`), for the catalogue by the
contract tests.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any, Literal

Number = Any
"""A float array, an interval, a SymPy expression, a dual number: whatever has + - * / ."""


@dataclass(frozen=True)
class Branch:
    """One branch, or all of them at once by broadcasting.

    Attributes:
        pose: the coordinates of the platform, in the file's order; an angle is a pair (cosine, sine).
        inputs: the inputs in the file's order; a revolute input is a pair (cosine, sine), but a
            number in rad where its turns count, as those of a screw do (`assur.joint_graph.turns`).
        margins: name -> value; the branch exists where every one of them allows it.
        core: every quantity that factors, Jacobians and joint values are made of.
    """

    pose: tuple[Number, ...]
    inputs: tuple[Number, ...]
    margins: Mapping[str, Number]
    core: SimpleNamespace


@dataclass(frozen=True)
class Margin:
    """A quantity on which the existence of a branch depends.

    Attributes:
        name: its key in `Branch.margins`.
        scale: a formula of the parameters: the size against which zero is judged.
        meaning: what it means geometrically, in one phrase.
        unit: power of the length unit (2 for a radicand in mm^2, 0 for a number).
        signs: the mode signs whose square root this is the radicand of, if any.
        zero: what happens where it is zero: the two branches "merge", or the formulas "degenerate".
    """

    name: str
    scale: str
    meaning: str
    unit: int
    signs: tuple[str, ...] = ()
    zero: Literal["merge", "degenerate"] = "merge"
    latex: str = ""


@dataclass(frozen=True)
class Sign:
    """What a mode sign is the sign of: an attribute of core, zero being judged against `scale`."""

    attribute: str
    scale: str


@dataclass(frozen=True)
class Factor:
    """A factor of det Jp ("parallel") or of det Jq ("serial"), with its geometric meaning.

    det Jp is the product of the parallel factors and det Jq that of the serial ones. A quantity of kind
    "other" divides neither; it is listed because a group of `ClosedForm.self_motion_singular` needs it.
    """

    name: str
    kind: Literal["parallel", "serial", "other"]
    scale: str
    meaning: str
    latex: str = ""
    equation: str = ""
    unit: int = 1


@dataclass(frozen=True)
class Quantity:
    """A quantity that the source names: its letter, equation and what it is computed from.

    `kind` "angle" means that the kernel returns a pair (cosine, sine); the angle is derived outside.
    `problem` says where it occurs: in the direct or the inverse problem, or both.
    """

    name: str
    kind: Literal["length", "angle", "number", "area", "volume"]
    equation: str
    needs: tuple[str, ...] = ()
    latex: str = ""
    problem: Literal["direct", "inverse", "both"] = "both"
    meaning: str = ""


@dataclass(frozen=True)
class SelfMotion:
    """The curve on which the platform moves while every input stands still.

    Attributes:
        margin: the "degenerate" margin of the direct problem at whose zero it occurs.
        parameter: name of the angle that runs along the curve.
        signs: the mode signs that remain.
        kernel: (ns, p, inputs, (cos, sin) of the parameter, sign) -> Branch.
    """

    margin: str
    parameter: str
    signs: tuple[str, ...]
    kernel: Callable[..., Branch]
    latex: str = ""


@dataclass(frozen=True)
class Eliminant:
    """A direct problem reduced to one polynomial: the second kind of closed form, its branches are the roots.

    The root finder stands outside the kernels. All complex roots are found, so the real ones are all there are.
    With `signs` there is a polynomial for every choice of them, and both kernels take the signs as a last argument.
    Choose an unknown in which poses that a symmetry exchanges differ: where they share a root, it is a multiple one.

    Attributes:
        unknown: the name of what is found, a quantity of the mechanism ("phi").
        kind: "angle", where the polynomial is in the tangent of half of it, or "plain".
        degree: how many poses there are at most: the degree of the polynomial, or the sum of the degrees of all.
        coefficients: (ns, p, inputs[, sign]) -> the coefficients of one polynomial, the constant term first.
        back: (ns, p, inputs, root[, sign]) -> Branch; the root is a pair (cosine, sine) where it is an angle.
        signs: names of the signs; a pose and its mirror image may share a root and differ in one that only `back` uses.
        left_over: (ns, p, inputs, (cosine, sine, 1)[, sign]) -> a number that vanishes at the roots of an angle and is
            homogeneous in the last three. Coefficients lose digits where roots lie together, which this one keeps.
    """

    unknown: str
    kind: Literal["angle", "plain"]
    degree: int
    coefficients: Callable[..., Sequence[Number]]
    back: Callable[..., Branch]
    signs: tuple[str, ...] = ()
    left_over: Callable[..., Number] | None = None

    @property
    def roots(self) -> int:
        """How many roots one polynomial has."""
        return int(self.degree // 2 ** len(self.signs))


@dataclass(frozen=True)
class PolynomialSystem:
    """A direct problem that is a system of polynomials with a known number of solutions: the third kind of closed form.

    All solutions are followed from those of a start mechanism, the same one with generic complex dimensions and inputs
    (coefficient-parameter homotopy); as many distinct regular ends as `degree` are all solutions there are. Dimensions
    and inputs are lengths or numbers, no angles.

    Attributes:
        unknowns: names of the homogeneous unknowns, one more than equations.
        units: power of the length unit of each unknown; it is solved with lengths over the characteristic length.
        degree: how many solutions generic dimensions have, over complex numbers.
        because: who proved that.
        equations: (ns, p, inputs, unknowns) -> homogeneous polynomials; + - * only, in p and inputs too.
        finite: (unknowns) -> a number that is zero at a solution at infinity, to which no pose belongs.
        lift: (ns, p, pose) -> the unknowns at a pose, up to a factor.
        back: (ns, p, inputs, unknowns) -> Branch, at a real solution.
    """

    unknowns: tuple[str, ...]
    units: tuple[int, ...]
    degree: int
    because: str
    equations: Callable[..., Sequence[Number]]
    finite: Callable[..., Number]
    lift: Callable[..., Sequence[Number]]
    back: Callable[..., Branch]


@dataclass(frozen=True)
class ClosedForm:
    """The closed form of a mechanism: a claim about its joint graph, made of kernels and their names.

    Attributes:
        complete_for: for which model the branches are all there are: "joint_graph", or "reduced" (the
            source's model, which leaves assemblies of the joint graph out; `reduced_because` says which).
        direct: (ns, p, inputs, sign) -> Branch; or an `Eliminant`; or a `PolynomialSystem`; or None: only a search.
        inverse: (ns, p, pose, sign) -> Branch.
        joints: (ns, p, core) -> {joint: value}, a pair (cosine, sine) for a revolute, rad for a screw; a joint
            of several components has one entry for each ("leg1.U.first"), but a spherical joint one entry, the
            rotation of the child against the parent as three rows. Freedoms that move nothing else may have any value.
        factors: (ns, p, core) -> {factor: value}.
        jacobians: (ns, p, core) -> (rows of Jp, rows of Jq) with Jp v = Jq qdot; a plain 0 where an entry
            vanishes everywhere. v are the rates of the pose coordinates; those of a quaternion are the angular
            velocity in the base frame (`assur.model.pose.rate_names`).
        quantities: (ns, p, core) -> {quantity: value}; a pair (cosine, sine) for an angle.
        constraints: (ns, p, core, inputs) -> {name: (found, wanted)}: the lengths that given inputs
            and a given pose would need, beside the lengths that the parameters say.
        signs: mode sign -> what it is the sign of.
        direct_margins, inverse_margins: in the order in which they are met.
        constraint_singular: groups of factors; where all of one group vanish, the rank of the whole
            closure of the joint graph drops.
        self_motion_singular: groups of factors; where all of one group vanish, the platform moves with
            every input locked.
        relations: of dimensions for which alone all of it is so, as "e2 = e1": with other numbers no loop closes.
        sources: name of a coordinate, an input or a factor -> the equation that gives it.
        working, assembly: names of modes where the file's [modes] has none for a problem: those by which the joint
            graph names them, in its order.
        as_printed: (ns, p, core) -> (Jp, Jq) as the source prints them, where that differs.
    """

    complete_for: Literal["joint_graph", "reduced"]
    direct: Callable[..., Branch] | Eliminant | PolynomialSystem | None
    inverse: Callable[..., Branch]
    joints: Callable[..., Mapping[str, Any]]
    factors: Callable[..., Mapping[str, Number]]
    jacobians: Callable[..., tuple[Sequence[Sequence[Number]], Sequence[Sequence[Number]]]]
    signs: Mapping[str, Sign]
    direct_margins: tuple[Margin, ...]
    inverse_margins: tuple[Margin, ...]
    factor_list: tuple[Factor, ...]
    constraint_singular: tuple[tuple[str, ...], ...] = ()
    self_motion_singular: tuple[tuple[str, ...], ...] = ()
    quantities: Callable[..., Mapping[str, Number]] | None = None
    quantity_list: tuple[Quantity, ...] = ()
    constraints: Callable[..., Mapping[str, tuple[Number, Number]]] | None = None
    self_motion: SelfMotion | None = None
    as_printed: Callable[..., tuple[Sequence[Sequence[Number]], Sequence[Sequence[Number]]]] | None = None
    reduced_because: str = ""
    relations: tuple[str, ...] = ()
    working: tuple[str, ...] = ()
    assembly: tuple[str, ...] = ()
    sources: Mapping[str, str] = field(default_factory=dict)

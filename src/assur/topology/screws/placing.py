"""Chains put into space: axes as written, everything that topology leaves open at random.

What holds for chains must hold for almost every placing, so one placing per seed is enough to try it on. Equal axes are
distinct parallel lines, equal labels are one point, in all limbs, parallelograms have their real joints.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joints.joint_type import JointType
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.topology.chains import BASE, PLATFORM, Chain, ChainJoint, Element, InnerLoop, Parallelogram
from assur.topology.labelled_points import centre_of, tied_points
from assur.topology.screws.linkage import Group, Linkage, LinkageJoint
from assur.topology.screws.shared_points import common_end

FloatArray = NDArray[np.float64]

LENGTHS = (0.6, 1.2)
"""Of rods and short links; pitches of helices are half of it per rad."""

LEAN = (0.9, 2.2)
"""Angles (rad) between the rods of a parallelogram and its short links: far from flat."""

_AT_NEAR = {"4R": REVOLUTE, "4S": SPHERICAL, "4U": UNIVERSAL, "2US": UNIVERSAL}
_AT_FAR = {"4R": REVOLUTE, "4S": SPHERICAL, "4U": UNIVERSAL, "2US": SPHERICAL}


def place(
    chains: Sequence[Chain], *, seed: int = 0, actuated: Sequence[str] | None = None, at: str | None = None
) -> Linkage:
    """A linkage of one chain, or of all limbs side by side between base and platform.

    Joints stand in a box of size 2 at random; the same seed gives the same linkage. Joints keep their names if these
    are unique, else they are called by limb and place in it, as "R1.2" (of one chain alone "R2"). The joints of a
    parallelogram Pa are Pa.a, Pa.b, Pa.c, Pa.d around it, from one end of the first rod to that of the second. One to
    whose bar another chain leads is no generalised joint: its joints count each by itself.

    O' of a chain alone is fixed in its end link, on its last R axis or joint centre at home (a general point where
    that is an inner loop's output link); that of several limbs is the labelled point of the platform in which all of
    them end that resist anything, or else a general point of it.

    Args:
        chains: from base to platform.
        seed: of the random positions.
        actuated: names of actuated joints and parallelograms; of a C its translation is meant, of a U its first
            rotation, of a parallelogram its first hinge.
        at: label of the point of the platform where O' of several limbs is, empty for a general one; default as above.

    Errors:
        UnknownNameError: an actuated joint that does not exist. UsageError: no chain, an empty one, or an actuated S.

    >>> from assur.topology.chains import ChainJoint
    >>> x = ((1.0, 0.0, 0.0),)
    >>> arm = place([Chain(tuple(ChainJoint(REVOLUTE, x) for _ in range(3)))])
    >>> list(arm.joints), arm.links
    (['R1', 'R2', 'R3'], ('base', 'link 1', 'link 2', 'platform'))
    """
    if not chains:
        raise UsageError("there is no chain to place; at least one is needed")
    rng, names = np.random.default_rng(seed), joint_names(chains)
    building = _Building(rng, iter(names), len(chains) == 1, labels=tied_points(chains, names, rng))
    building.ends = frozenset(link for chain in chains for link in (chain.start, chain.end))
    tips = [building.limb(number, chain) for number, chain in enumerate(chains, 1)]
    somewhere = building.somewhere()
    point = tips[0] if len(chains) == 1 else building.labels.get(common_end(chains) if at is None else at)
    inputs = tuple(_input(name, building) for name in actuated or ())
    point = somewhere if point is None else point
    parted = tuple(building.parted)
    return Linkage(building.joints, BASE, PLATFORM, point, building.groups, inputs, parted=parted)


@dataclass
class _Building:
    """A linkage that grows; `names` gives each joint's in the order of the text."""

    rng: np.random.Generator
    names: Iterator[str]
    alone: bool
    joints: dict[str, LinkageJoint] = field(default_factory=dict)
    groups: dict[str, Group] = field(default_factory=dict)
    labels: dict[str, FloatArray] = field(default_factory=dict)
    ends: frozenset[str] = frozenset()
    parted: list[str] = field(default_factory=list)
    limb_number: int = 0
    links: int = 0

    def somewhere(self) -> FloatArray:
        return self.rng.uniform(-1.0, 1.0, 3)

    def limb(self, number: int, chain: Chain) -> FloatArray | None:
        """Place a chain; where its last R axis or joint centre is, None if nothing in it turns."""
        self.limb_number, self.links = number, 0
        return self.series(chain.elements, chain.start, chain.end)

    def series(self, elements: Sequence[Element], start: str, end: str) -> FloatArray | None:
        if not elements:
            raise UsageError("a chain (or a branch of an inner loop) has no joints; it needs at least one")
        tip = None
        for index, element in enumerate(elements):
            following = end if index == len(elements) - 1 else self._new_link()
            point = self._element(element, start, following)
            tip = tip if point is None else point
            start = following
        return tip

    def _new_link(self) -> str:
        self.links += 1
        return f"link {self.links}" if self.alone else f"link {self.limb_number}.{self.links}"

    def _element(self, element: Element, start: str, end: str) -> FloatArray | None:
        if isinstance(element, InnerLoop):
            tips = [self.series(branch, start, end) for branch in element.branches]
            return None if any(tip is None for tip in tips) else self.somewhere()
        if isinstance(element, Parallelogram):
            return self._parallelogram(element, start, end)
        name = next(self.names)
        point = self.labels.setdefault(centre_of(element, name), self.somewhere())
        pitch = self.rng.uniform(*LENGTHS) / 2 * self.rng.choice([-1.0, 1.0])
        self._add(name, element.type, start, end, element.axes, point, pitch)
        return None if not element.type.turning else point

    def _add(
        self,
        name: str,
        joint_type: JointType,
        parent: str,
        child: str,
        axes: ArrayLike,
        point: FloatArray,
        pitch: float = 0.0,
    ) -> None:
        screws = _screws(joint_type, np.asarray(axes, dtype=float), point, pitch)
        self.joints[name] = LinkageJoint(name, joint_type, parent, child, screws, point)

    def _parallelogram(self, element: Parallelogram, near: str, far: str) -> FloatArray | None:
        name = next(self.names)
        short, rod, axes = self._sides(element)
        corner = self.somewhere()
        at_near, at_far = _AT_NEAR[element.kind], _AT_FAR[element.kind]
        first, second = element.bar or f"{name} rod 1", f"{name} rod 2"
        names = tuple(f"{name}.{letter}" for letter in "abcd")
        self._add(names[0], at_near, near, first, axes, corner)
        self._add(names[1], at_far, first, far, axes[::-1], corner + rod)
        self._add(names[2], at_far, second, far, axes[::-1], corner + rod + short)
        self._add(names[3], at_near, near, second, axes, corner + short)
        if first in self.ends:
            self.parted.append(name)
        else:
            self.groups[name] = Group(name, f"P({element.kind})", names, near, far)
        return None if element.kind == "4R" else corner + rod

    def _sides(self, element: Parallelogram) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Short link (3,), rod (3,), and the axes (1 or 2, 3) of the joints at the near end of a rod."""
        axis = np.array(element.axis)
        across = np.cross(axis, self.somewhere())
        across /= np.linalg.norm(across)
        lean, (width, length) = self.rng.uniform(*LEAN), self.rng.uniform(*LENGTHS, 2)
        if element.kind == "4R":
            return width * across, length * (np.cos(lean) * across + np.sin(lean) * np.cross(axis, across)), axis[None]
        rod = length * (np.cos(lean) * axis + np.sin(lean) * across)
        return width * axis, rod, np.stack([axis, np.cross(axis, across)])


def _screws(joint_type: JointType, axes: FloatArray, point: FloatArray, pitch: float) -> FloatArray:
    """Screws (f, 6) of a joint, v at the base's origin."""
    if joint_type.ball:
        return np.concatenate([np.eye(3), np.cross(point, np.eye(3))], axis=-1)
    screws = []
    directions: FloatArray = np.array(joint_type.directions([tuple(axis) for axis in axes.tolist()]))
    for step in joint_type.steps:
        axis = directions[step.direction]
        turning, sliding = np.concatenate([axis, np.cross(point, axis)]), np.concatenate([np.zeros(3), axis])
        screws.append({"slide": sliding, "screw": turning + pitch * sliding}.get(step.kind, turning))
    return np.array(screws)


def joint_names(chains: Sequence[Chain]) -> list[str]:
    """Names of all joints in order: their own if these are unique, else by limb and place."""
    declared = [joint.name for chain in chains for joint in chain.joints]
    if all(declared) and max(Counter(declared).values(), default=1) == 1:
        return declared
    return [
        f"{_letter(joint)}{index}" if len(chains) == 1 else f"{_letter(joint)}{number}.{index}"
        for number, chain in enumerate(chains, 1)
        for index, joint in enumerate(chain.joints, 1)
    ]


def _letter(joint: ChainJoint | Parallelogram) -> str:
    return "Pa" if isinstance(joint, Parallelogram) else joint.type.letter


def _input(name: str, building: _Building) -> tuple[str, int]:
    """The actuated component of a joint; of a parallelogram the first hinge."""
    name = name if name in building.joints else f"{name}.a"  # of a parallelogram
    if name not in building.joints:
        raise UnknownNameError("joint", name.removesuffix(".a"), [*building.joints, *building.groups])
    if building.joints[name].type.ball:
        raise UsageError(f"the spherical joint '{name}' cannot be actuated; any other joint can")
    return name, 0

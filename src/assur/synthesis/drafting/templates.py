"""From chains to the templates of a file: families of limbs, each drawn once, in one layout."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import count, islice

from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.synthesis.drafting.families import Family, apart, families, shared_labels
from assur.synthesis.drafting.knees import knee
from assur.synthesis.drafting.layout import BASE, HEIGHT, PLATFORM, DraftLayout, Stand
from assur.synthesis.drafting.limb import HEIGHT_NAME, LimbDrawing
from assur.synthesis.drafting.tables import Dimension, DraftChain, Template
from assur.topology.chains import Chain, ChainJoint, InnerLoop, flattened
from assur.topology.directions import NAMED, parallel, perpendicular
from assur.topology.notation import plain_text
from assur.topology.screws.shared_points import common_end

SCALES = (1.0, 1.1, 0.9, 1.2, 0.8)
PRIME = "'"
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True)
class Draft:
    """Everything of a file that follows from chains and a layout.

    Attributes:
        dimensions: those that belong to no limb.
        flat: whether all motion is in planes perpendicular to z, so that nothing has a height.
        chains: the limbs in notation, each as it stands, in their order.
        together: dimensions that change together, or else no loops close, where no formula says how.
    """

    dimensions: tuple[Dimension, ...]
    templates: tuple[Template, ...]
    flat: bool
    chains: tuple[str, ...] = ()
    together: tuple[tuple[str, ...], ...] = ()

    def joint_of(self, chain: int, place: int) -> str:
        """The full name in the file of a joint of a chain, both counted from 0, branches flattened."""
        for template in self.templates:
            if chain in template.members:
                return f"{template.name}{template.members.index(chain) + 1}.{template.order[place]}"
        raise IndexError(chain)


def draft(chains: Sequence[Chain], layout: DraftLayout) -> Draft:
    """Chains drawn in a layout.

    >>> from assur.topology.notation import parse_chains
    >>> found = draft(parse_chains(["R[z] R[z] R[z]"] * 3), DraftLayout())
    >>> found.templates[0].name, found.templates[0].even, found.flat, found.joint_of(2, 0)
    ('leg', True, True, 'leg3.A')
    """
    flat = all(_is_flat(joint) for chain in chains for joint in flattened(chain.elements))
    end = common_end(chains)
    centres = {
        label: "" if flat else HEIGHT_NAME if label == end else _centre(label)
        for label in sorted(shared_labels(chains) | ({end} - {""}))
    }
    groups = [part for family in families(chains) for part in _parts(family, layout.parts)]
    letters = map(_letter, count())
    named = [tuple(islice(letters, len(chains[group.pattern].joints))) for group in groups]
    templates = tuple(
        _template(chains[group.pattern], group, letters_of_group, centres, name, layout, stand)
        for group, letters_of_group, name, stand in zip(
            groups, named, _names(groups), _stands(groups, len(chains), flat), strict=True
        )
    )
    shared = [] if flat else [Dimension(HEIGHT_NAME, HEIGHT, "the platform's origin over that of the base, at home")]
    shared += [
        Dimension(name, round(0.4 * HEIGHT * (number + 1)), f"height of the point {label}, which limbs share")
        for number, (label, name) in enumerate(centres.items())
        if name not in ("", HEIGHT_NAME)
    ]
    return Draft(tuple(shared), templates, flat, tuple(map(plain_text, chains)))


def _centre(label: str) -> str:
    """The parameter for the height of a point that limbs share.

    >>> _centre("O'")
    'centreOprime_z'
    """
    return f"centre{label.replace(PRIME, 'prime')}_z"


def _parts(family: Family, parts: int) -> tuple[Family, ...]:
    size = len(family.members)
    if parts == 1 or size == 1:
        return (family,)
    return apart(family, 2 if parts == 2 and size % 2 == 0 and size > 2 else size)


def _names(groups: Sequence[Family]) -> list[str]:
    """Names of templates: leg, or a, b, c where there are several; not e and l, as e1 and l1 are dimensions."""
    letters = (letter for letter in map(_letter, count()) if letter not in "EL")
    return ["leg"] if len(groups) == 1 else [letter.lower() for letter in islice(letters, len(groups))]


def _template(
    chain: Chain,
    family: Family,
    letters: Sequence[str],
    centres: Mapping[str, str],
    name: str,
    layout: DraftLayout,
    stand: Stand,
) -> Template:
    drawing = LimbDrawing(layout, stand, family.angles != (0.0,), centres, iter(letters))
    drawing.draw(chain)
    return Template(
        name=name,
        angles=family.angles,
        even=family.even,
        members=family.members,
        text=plain_text(chain),
        dimensions=tuple(size for listed in drawing.dimensions.values() for size in listed),
        links=tuple(drawing.links),
        joints=tuple(drawing.joints),
        groups=tuple(drawing.groups),
        chain=_chain(chain, letters),
        order=tuple(_driven(drawing, letter) for letter in letters),
        knee=knee(chain, letters),
    )


def _stands(groups: Sequence[Family], limbs: int, flat: bool) -> list[Stand]:
    """Where the first limb of each family stands; one limb alone beside a family of three or more, in the middle."""
    single = [group for group in groups if group.angles == (0.0,)]
    middle = len(single) == 1 and any(len(group.angles) > 2 for group in groups)
    stands = []
    for number, group in enumerate(groups):
        sense = -1.0 if number % 2 else 1.0
        scale = SCALES[number % len(SCALES)]
        angle = 0.0 if group.angles[0] else 2 * math.pi * group.members[0] / limbs
        if middle and group is single[0]:
            scale, angle = 0.0, 0.0
        stands.append(Stand(angle, BASE * scale, PLATFORM * scale, number, flat, sense))
    return stands


def _is_flat(joint: object) -> bool:
    """Whether a joint moves in planes perpendicular to z alone."""
    if not isinstance(joint, ChainJoint) or joint.general:
        return False
    if joint.type is REVOLUTE:
        return parallel(joint.axes[0], NAMED["z"])
    return joint.type is PRISMATIC and perpendicular(joint.axes[0], NAMED["z"])


def _letter(number: int) -> str:
    return LETTERS[number] if number < len(LETTERS) else f"J{number + 1}"


def _driven(drawing: LimbDrawing, letter: str) -> str:
    """The joint by which an element is driven: of a parallelogram its first."""
    return next((group.joints[0] for group in drawing.groups if group.name == letter), letter)


def _chain(chain: Chain, letters: Sequence[str]) -> DraftChain | None:
    """The chain as a file writes it: joints in series, or two branches from the base and what follows; else none."""
    if not any(isinstance(element, InnerLoop) for element in chain.elements):
        return DraftChain(serial=tuple(letters))
    head, *rest = chain.elements
    if (
        not isinstance(head, InnerLoop)
        or len(head.branches) != 2
        or not rest
        or any(isinstance(element, InnerLoop) for element in (*rest, *head.branches[0], *head.branches[1]))
    ):
        return None
    first, second = (len(branch) for branch in head.branches)
    loop = (*letters[:first], *reversed(letters[first : first + second]))
    return DraftChain(loop=loop, output=f"output{letters[0]}", tail=tuple(letters[first + second :]))

"""Random chains, built as data and not by the reader."""

import pytest
from hypothesis import strategies as st

from assur.joints.catalogue import JOINT_TYPES
from assur.topology.chains import Chain, ChainJoint, InnerLoop, Parallelogram
from assur.topology.directions import parallel, unit
from assur.topology.notation.reader import MAX_JOINTS

# Whole numbers up to 3 give right angles and parallels exactly, and no angle within 2 degrees of either.
whole = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)
simple = st.sampled_from([(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, -1, 0), (1, 1, 0)])
axes = st.one_of(simple, simple, whole).map(unit)
labels = st.sampled_from(["", "", "A", "B", "C1"])


@st.composite
def joints(draw, labelled=True):
    joint_type = draw(st.sampled_from(sorted(JOINT_TYPES.values(), key=lambda item: item.letter)))
    own = [draw(axes) for _ in range(joint_type.axes)]
    if len(own) == 2 and parallel(*own):
        own[1] = unit((own[0][1] - own[0][2], own[0][2] - own[0][0], own[0][0] - own[0][1] + 1))
    label = draw(labels) if labelled and joint_type.letter != "P" else ""
    return ChainJoint(joint_type, tuple(own), label, general=bool(own) and draw(st.integers(0, 5)) == 0)


parallelograms = st.builds(Parallelogram, st.sampled_from(["4R", "4S", "4U", "2US"]), axes, general=st.booleans())


def elements(labelled):
    single = st.one_of(joints(labelled), joints(labelled), joints(labelled), parallelograms)
    inside = st.one_of(joints(False), joints(False), parallelograms)

    def loops(parts):
        branch = st.lists(parts, min_size=1, max_size=3).map(tuple)
        return st.lists(branch, min_size=2, max_size=3).map(lambda found: InnerLoop(tuple(found)))

    nested = loops(st.one_of(inside, inside, inside, loops(inside)))
    return st.one_of(single, single, single, nested, planar_loops())


@st.composite
def planar_loops(draw):
    """Loops of six joints in one plane, such as 2P4R."""
    normal, one, other = draw(st.permutations([(1, 0, 0), (0, 1, 0), (0, 0, 1)]))
    hinge = ChainJoint(JOINT_TYPES["revolute"], (unit(normal),))
    sliders = [ChainJoint(JOINT_TYPES["prismatic"], (unit(axis),)) for axis in (one, other)]
    branches = [[hinge, hinge, hinge], [sliders[0], hinge, hinge], [*sliders, hinge]]
    return InnerLoop(tuple(tuple(draw(st.sampled_from(branches))) for _ in range(2)))


@pytest.fixture(scope="session")
def random_chains():
    """Strategy of chains of one to eight elements; `labelled`: with points that joints share."""

    def strategy(*, labelled=True):
        lists = st.lists(elements(labelled), min_size=1, max_size=8)
        return lists.map(lambda found: Chain(tuple(found))).filter(lambda chain: len(chain.joints) <= MAX_JOINTS)

    return strategy


def bare(element):
    """An element without names, and without the axes that nobody chose."""
    if isinstance(element, InnerLoop):
        return tuple(tuple(map(bare, branch)) for branch in element.branches)
    if isinstance(element, Parallelogram):
        return element.kind, None if element.general else element.axis
    return element.type.letter, None if element.general else element.axes, element.point


@pytest.fixture(scope="session")
def same_up_to_names():
    return lambda one, other: tuple(map(bare, one.elements)) == tuple(map(bare, other.elements))

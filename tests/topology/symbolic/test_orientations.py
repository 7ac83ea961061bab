import pytest

from assur.topology.notation import parse_chain
from assur.topology.symbolic.blocks import structure
from assur.topology.symbolic.elementary import elementary
from assur.topology.symbolic.orientations import EVERY, UNTURNED, Orientations, held, orientations
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import rotations, translations

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def _structure(text):
    return structure(elementary(parse_chain(text).elements, None))


def _about(*axes):
    return Orientations(len(axes), axes)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("P[x] P[y]", UNTURNED),
        ("R[x] P[y] R[x]", _about(X)),
        ("R[x] R[x] R[y]", _about(X, Y)),
        ("R[x] R[y] R[x]", EVERY),
        ("S", EVERY),
        ("P(4S)[x]", _about(X)),
    ],
)
def test_orientations_of_a_chain(text, found):
    assert orientations(_structure(text)) == found


@pytest.mark.parametrize(
    ("first", "second", "common"),
    [
        (EVERY, _about(X, Y), _about(X, Y)),
        (UNTURNED, _about(X, Y), UNTURNED),
        (_about(X), _about(X), _about(X)),
        (_about(X), _about(Y), UNTURNED),
        (_about(Y), _about(X, Y), _about(Y)),
        (_about(Z), _about(X, Y), UNTURNED),
        (_about(X, Y), _about(X, Y), _about(X, Y)),
        (_about(X, Y), _about(X, Z), _about(X)),
        (_about(X, Z), _about(Y, Z), _about(Z)),
        (_about(X, Y), _about(Z, X), _about(X)),
        (_about(X, Y), _about(Z, (0.6, 0.0, 0.8)), Orientations(1)),
        (Orientations(1), _about(X, Y), UNTURNED),
    ],
)
def test_what_two_limbs_have_in_common(first, second, common):
    assert first.meet(second) == common
    assert second.meet(first).dim == common.dim


def test_the_same_axes_in_opposite_orders_are_refused():
    assert isinstance(_about(X, Y).meet(_about(Y, X)), Refusal)


@pytest.mark.parametrize(
    ("text", "to", "t", "r"),
    [
        # an idle R turns nothing
        ("R[z] P[x] P[z]", UNTURNED, 2, 1),
        ("R[z] P[x] R[z]", UNTURNED, 2, 1),
        # z, x, z turned about x: the outer blocks are idle
        ("R[z] R[x] R[z] P[x]", _about(X), 1, 3),
        # as written, first and last stay parallel while the end link does not turn
        ("U[x,y] P[z] U[y,x]", UNTURNED, 3, 2),
        ("U[x,y] P[z] U[y,x]", _about(X), 3, 2),
        ("U[x,y] P[z] U[y,x]", EVERY, 2, 3),
        ("R[y]@A R[z]@A R[y]@A", UNTURNED, 0, 2),
        # what stands behind a spherical joint turns as the end link does
        ("P[x] S P[x]", UNTURNED, 1, 3),
        ("P[x] S P[x]", _about(X), 1, 3),
        ("P[x] S P[x]", _about(Y), 2, 3),
        ("R[x] S R[x] R[x]", _about(X), 2, 3),
        ("R[x] S R[x] R[x]", EVERY, 3, 3),
    ],
)
def test_a_chain_held_to_some_orientations(text, to, t, r):
    found = held(_structure(text), to)
    assert (translations(found).dim, rotations(found).dim) == (t, r)


@pytest.mark.parametrize("text", ["R[x] R[y] R[1,1,0]", "R[x] R[y] R[z] R[x]"])
def test_what_cannot_be_held_by_rules_is_refused(text):
    chain = parse_chain(text.replace("1,1,0", "0.6,0.8,0"))
    assert isinstance(held(structure(elementary(chain.elements, None)), UNTURNED), Refusal)

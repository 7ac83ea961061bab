"""The plain form reads back as the same chain."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.joints.revolute import REVOLUTE
from assur.topology.chains import Chain, ChainJoint
from assur.topology.notation import parse_chain, plain_text
from examples import examples


@examples(300)
@given(st.data())
def test_round_trip(random_chains, same_up_to_names, data):
    chain = data.draw(random_chains())
    text = plain_text(chain)
    again = parse_chain(text)
    assert same_up_to_names(again, chain)
    assert plain_text(again) == text
    names = [joint.name for joint in again.joints]
    assert len(set(names)) == len(names)


def test_what_round_trips_can_tell_apart(same_up_to_names):
    texts = ["R[x]", "R[-x]", "R", "P[x]", "R[x]@A", "R[1,1e-12,0]", "R[x] S", "{R[x] | S}", "{S | R[x]}", "P(4R)[x]"]
    chains = [parse_chain(text) for text in texts]
    assert [[same_up_to_names(one, other) for other in chains] for one in chains] == [
        [i == j for j in range(len(chains))] for i in range(len(chains))
    ]


@pytest.mark.parametrize(
    "text",
    ["R[0.5,0.866,0]", "R[1,2,-3]", "U[x; 0,1,1]", "P(2US)[0,0.6,0.8]", "{{S | S} R[x] | U P} C", "H[-z]@B2 S@B2"],
)
def test_short_texts_stay(text):
    assert plain_text(parse_chain(text)) == text


def test_a_chain_made_by_hand():
    axis = (0.6 + 1e-16, 0.8, 0.0)
    assert parse_chain(plain_text(Chain((ChainJoint(REVOLUTE, (axis,)),)))).elements[0].axes == (axis,)

"""Groups against a search for connected numbers."""

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.notation.groups import Groups


@given(st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9))))
def test_groups_are_connected_components(pairs):
    groups = Groups(10)
    graph = nx.Graph(pairs)
    graph.add_nodes_from(range(10))
    for pair in pairs:
        groups.join(*pair)
    for component in nx.connected_components(graph):
        assert {groups.of(item) for item in component} == {min(component)}

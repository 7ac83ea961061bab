"""Which loops are planar with three freedoms."""

import pytest

from assur.topology.notation import parse_chain
from assur.topology.notation.planar import planar_loop


@pytest.mark.parametrize(
    ("text", "tag"),
    [
        ("{P[y] R[x] R[x] | P[y] R[x] R[x]}", "2P4R"),
        ("{R[x] P[y] R[x] | R[x] R[x] P[z]}", "2P4R"),
        ("{R[x] R[x] R[-x] | R[x] R[x] R[x]}", "6R"),
        ("{P[0,1,1] R[x] R[x] | R[x] R[x] R[x]}", "P5R"),
        ("{P[y] P[0,1,1] R[x] | P[z] R[x] P[y]}", "4P2R"),
        ("{P[y] P[y] R[x] | P[z] R[x] P[y]}", None),
        ("{P[y] R[x] R[x] | P[x] R[x] R[x]}", None),
        ("{P[y] R[x] R[x] | P[y] R[x] R[y]}", None),
        ("{P[y] R[x] R[x] | P[y] R[x]}", None),
        ("{P[y] R[x] R[x] | P[y] R[x] R[x] | P[y] R[x] R[x]}", None),
        ("{P[y] R[x] C[x] | P[y] R[x] R[x]}", None),
        ("{P[y] R[x] P(4R)[x] | P[y] R[x] R[x]}", None),
        ("{P[y] R[x]@A R[x]@A | P[y] R[x] R[x]}", None),
        ("{P R[x] R[x] | P[y] R[x] R[x]}", None),
        ("{P[x] P[y] P[z] | P[x] P[y] P[z]}", None),
        ("{P[y] P[z] P[0,1,1] | R[x] R[x] R[x]}", None),
    ],
)
def test_planar(text, tag):
    found = planar_loop(parse_chain(text).elements[0])
    assert (found and found.tag) == tag

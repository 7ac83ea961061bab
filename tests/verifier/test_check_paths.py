"""A path that is edited, cut short, put in another order or torn is refused, claims and checksum put right or not."""

from fractions import Fraction

import pytest

from assur.verifier.check import verify
from assur.verifier.reading import MalformedError, RefusedError

PATHS = ("path", "path in one box", "path, angle held")
FAR = [(-1e4).hex(), (1e4).hex()]


def recount(document):
    """Put the claims right for a path of which each box is one leaf."""
    count = len(document["statement"]["boxes"])
    document["proof"] = "r" * count
    document["claims"]["leaves"]["regular"] = count


def moved(text, by=1.0):
    return (float.fromhex(text) + by).hex()


def cut_short(document):
    statement = document["statement"]
    statement["points"].pop()
    statement["boxes"].pop()
    recount(document)


def begun_late(document):
    del document["statement"]["points"][0], document["statement"]["boxes"][0]
    recount(document)


def boxes_swapped(document):
    boxes = document["statement"]["boxes"]
    boxes[3], boxes[4] = boxes[4], boxes[3]


def vertices_swapped(document):
    points = document["statement"]["points"]
    points[3], points[5] = points[5], points[3]


def turned_round(document):
    document["statement"]["points"].reverse()
    document["statement"]["boxes"].reverse()


def a_piece_left_out(document):
    del document["statement"]["points"][4], document["statement"]["boxes"][4]
    recount(document)


def a_vertex_beside_its_box(document):
    point = document["statement"]["points"][4]
    point[0] = moved(document["statement"]["boxes"][4][0][1], 1e-6)


def a_box_that_ends_before_the_vertex(document):
    """A gap: the box no longer reaches the vertex that it shared with the next one."""
    point, box = document["statement"]["points"][4], document["statement"]["boxes"][3]
    k = next(k for k, (low, high) in enumerate(box) if point[k] in (low, high))
    low, high = map(float.fromhex, box[k])
    inner = (low + (high - low) / 64, high - (high - low) / 64)
    box[k] = [inner[0].hex(), box[k][1]] if point[k] == box[k][0] else [box[k][0], inner[1].hex()]


def another_start(document):
    document["statement"]["from"][0] = moved(document["statement"]["from"][0], 1e-9)


def another_end(document):
    document["statement"]["to"][-1] = moved(document["statement"]["to"][-1], 1e-9)


def a_box_over_everything(document):
    document["statement"]["boxes"][2] = [FAR] * 3


def a_leaf_left_open(document):
    document["proof"] = document["proof"][:-1] + "b"
    document["claims"] |= {"reached": "open", "regular": "open"}
    document["claims"]["leaves"] |= {"regular": len(document["proof"]) - 1, "open": 1}


def a_leaf_only_reached(document):
    document["proof"] = "i" + document["proof"][1:]
    document["claims"] |= {"regular": "open"}
    document["claims"]["leaves"] |= {"regular": len(document["proof"]) - 1, "inside": 1}


REFUSED = {
    cut_short: "does not lead",
    begun_late: "does not lead",
    turned_round: "does not lead",
    another_start: "does not lead",
    another_end: "does not lead",
    boxes_swapped: "piece 4 of the path, of 12, does not lie in its box",
    vertices_swapped: "does not lie in its box",
    a_piece_left_out: "does not lie in its box",
    a_vertex_beside_its_box: "does not lie in its box",
    a_box_that_ends_before_the_vertex: "piece 4 of the path, of 12, does not lie in its box",
    a_box_over_everything: "part 3 of 12 does not hold: regular",
    a_leaf_left_open: "not every box of the path",
    a_leaf_only_reached: "not every box of the path",
}


@pytest.mark.parametrize("change", REFUSED, ids=lambda change: change.__name__)
def test_every_change_is_refused_for_its_own_reason(change, made_of, forged):
    assert made_of("path").proof == "r" * 12
    with pytest.raises(RefusedError, match=REFUSED[change]):
        verify(forged("path", change))


def without_vertices(document):
    document["statement"] |= {"points": [], "boxes": []}
    recount(document)


def a_lone_pose(document):
    statement = document["statement"]
    statement |= {"points": [statement["from"]], "boxes": [], "to": statement["from"]}
    recount(document)


MALFORMED = {
    "a vertex less": lambda document: document["statement"]["points"].pop(),
    "a box more": lambda document: document["statement"]["boxes"].append(document["statement"]["boxes"][-1]),
    "no vertex": without_vertices,
    "a lone pose": a_lone_pose,
    "a vertex of other coordinates": lambda document: document["statement"]["points"][3].pop(),
    "a box of other coordinates": lambda document: document["statement"]["boxes"][3].pop(),
    "a box reversed": lambda document: document["statement"]["boxes"][3][0].reverse(),
    "no end": lambda document: document["statement"].pop("to"),
    "a box to look in": lambda document: document["statement"].update(box=[FAR] * 3),
    "another kind": lambda document: document.update(kind="box"),
    "a tree less": lambda document: document.update(proof=document["proof"][1:]),
    "a tree more": lambda document: document.update(proof=document["proof"] + "r"),
}


@pytest.mark.parametrize("change", MALFORMED)
def test_what_is_no_path_is_refused(change, forged):
    with pytest.raises(MalformedError):
        verify(forged("path", MALFORMED[change]))


def the_other_way(document):
    statement = document["statement"]
    turned_round(document)
    statement["from"], statement["to"] = statement["to"], statement["from"]


def ended_earlier(document):
    cut_short(document)
    document["statement"]["to"] = document["statement"]["points"][-1]


@pytest.mark.parametrize("change", [the_other_way, ended_earlier])
def test_another_path_that_is_proved_verifies(change, forged):
    """So the refusals above are not about the checksum or the claims."""
    verify(forged("path", change))


@pytest.mark.parametrize("case", PATHS)
def test_vertices_lie_in_both_their_boxes_by_exact_fractions(case, made_of, forged):
    """A vertex moved along a coordinate: refused exactly where it is outside one of its two boxes."""
    statement = made_of(case).statement
    tried = set()
    for place in range(1, len(statement["points"]) - 1):
        for axis, text in enumerate(statement["points"][place]):
            for by in (-40.0, -0.5, 1e-12, 0.5, 40.0):
                value = moved(text, by)
                pairs = [statement["boxes"][k][axis] for k in (place - 1, place)]
                inside = all(exact(low) <= exact(value) <= exact(high) for low, high in pairs)
                tried.add(inside)
                assert accepted(forged(case, lambda d, at=(place, axis), v=value: put(d, at, v))) == inside
    assert tried == ({True, False} if len(statement["boxes"]) > 1 else set())


def exact(text):
    return Fraction(float.fromhex(text))


def put(document, at, value):
    document["statement"]["points"][at[0]][at[1]] = value


def accepted(content):
    try:
        verify(content)
    except RefusedError:
        return False
    return True

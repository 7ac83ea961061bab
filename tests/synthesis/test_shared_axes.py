import pytest

from assur.synthesis.shared_axes import common_lines, sharing, sharing_ends, with_common_lines, without_labels
from assur.topology.notation import parse_chain, parse_chains, plain_text

EXECHON = ["U[x,y] P[z] R[y]", "U[x,y] P[z] R[y]", "S P[z] R[x]"]


@pytest.mark.parametrize(
    ("texts", "end", "limbs"),
    [
        (EXECHON, "base", (0, 1)),
        (EXECHON, "platform", (0, 1)),
        (["R[x] P[z] S", "R[y] P[z] S", "R[z] P[x] S"], "base", ()),
        (["R[x] P[z] S", "R[x] P[z] S", "R[y] P[z] S", "R[y] P[z] S"], "base", ()),
        (["P[z] R[x] S", "P[z] R[x] S"], "base", ()),
    ],
    ids=["first axes", "last axes", "none parallel", "two lines", "slides"],
)
def test_limbs_share_a_line_where_just_one_set_of_them_can(texts, end, limbs):
    assert sharing(parse_chains(texts), end) == limbs


def test_equal_limbs_may_share_a_line_of_the_base_and_others_one_of_the_platform():
    """As those of 2UPR-2RPU, whose axes next to the base are all parallel, and next to the platform too."""
    lines = list(common_lines(parse_chains(["U[x,y] P[z] R[y]"] * 2 + ["R[x] P[z] U[x,y]"] * 2)))
    first, last = (0, 1), (2, 3)
    assert lines[:3] == [{}, {"base": None}, {"platform": None}]
    assert lines[3:7] == [{"base": first}, {"base": last}, {"platform": first}, {"platform": last}]
    assert lines[7:] == [{"base": first, "platform": last}, {"base": last, "platform": first}]


def test_a_label_says_which_axis_is_on_the_line():
    assert [chain.text for chain in with_common_lines(parse_chains(EXECHON), {"base": None})] == [
        "U[x@O,y] P[z] R[y]",
        "U[x@O,y] P[z] R[y]",
        "S P[z] R[x]",
    ]
    last = with_common_lines(parse_chains(EXECHON), {"platform": None})
    assert [sharing_ends(chain) for chain in last] == [(False, True), (False, True), (False, False)]


def test_labels_are_taken_off_again():
    labelled = parse_chain("U[x@O,y] P[z] R[y]@Q")
    assert sharing_ends(labelled) == (True, True)
    assert plain_text(without_labels(labelled)) == "U[x,y] P[z] R[y]"

from assur.synthesis.shared_axes import axes_at, sharing_ends, with_common_lines, without_labels
from assur.topology.notation import parse_chain, parse_chains, plain_text

EXECHON = ["U[x,y] P[z] R[y]", "U[x,y] P[z] R[y]", "S P[z] R[x]"]


def test_a_label_says_which_axis_is_on_the_line():
    assert [chain.text for chain in with_common_lines(parse_chains(EXECHON), {"base": (0, 1)})] == [
        "U[x@O,y] P[z] R[y]",
        "U[x@O,y] P[z] R[y]",
        "S P[z] R[x]",
    ]
    last = with_common_lines(parse_chains(EXECHON), {"platform": (0, 1)})
    assert [sharing_ends(chain) for chain in last] == [(False, True), (False, True), (False, False)]


def test_labels_are_taken_off_again():
    labelled = parse_chain("U[x@O,y] P[z] R[y]@Q")
    assert sharing_ends(labelled) == (True, True)
    assert plain_text(without_labels(labelled)) == "U[x,y] P[z] R[y]"


def test_limbs_turn_about_axes_next_to_links_alone_not_about_slides_or_balls():
    assert [
        len(axes_at(chain, "base")) for chain in parse_chains(["U[x,y] P[z] R[y]", "P[z] R[x] S", "S P[z] R[x]"])
    ] == [2, 0, 0]
    assert axes_at(parse_chain("R[x] P[z] U[x,y]"), "platform")[0] == (0.0, 1.0, 0.0)

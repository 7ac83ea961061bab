"""The grammar: what is read, and what is said about the first sign that does not fit."""

import pytest

from assur.topology.notation import NotationError, parse_chain, plain_text
from assur.topology.notation.errors import Source
from assur.topology.notation.reader import MAX_DEPTH, MAX_JOINTS, MAX_LENGTH, read


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("P[x] R[x] R[x] R[x]", None),
        ("P[x]R[x]R[x]R[x]", "P[x] R[x] R[x] R[x]"),
        ("P [ x ]  R[ 0.5 , 0.866 , 0 ]", "P[x] R[0.5,0.866,0]"),
        ("U[x,y] P[z] S", None),
        ("UPS", "U P S"),
        ("RRC", "R R C"),
        ("H[x] C[-y]", None),
        ("P(4R)[y] P(4S)[x] P(4U)[z] P(2US)[1,1,0]", None),
        ("Pa[y] PaR", "P(4R)[y] P(4R) R"),
        ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", None),
        ("{P[y]R[x]R[x]|P[y]R[x]R[x]}R[y]R[y]", "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"),
        ("{{R[x] | R[y]} P[z] | R[x] | S} C[z]", None),
        ("R[x]@A R[y]@A", None),
        ("R@A[x]R@AR", "R[x]@A R@A R"),
        ("S@O' U[x,y]@B2", None),
        ("R[x]-P[y].R[z]", "R[x] P[y] R[z]"),
        ("{R[x] || R | R[x]-S}", "{R[x] R[x] | R[x] S}"),
        ("HSOC{-{R[x] ∥ R | S}-S-}", "{R[x] R[x] | S} S"),
        ("HSOC{-R[x] | R-}", "R[x] R[x]"),
    ],
)
def test_what_is_read(text, expected):
    chain = parse_chain(text)
    assert plain_text(chain) == (expected or text)
    assert chain.text == text


@pytest.mark.parametrize(
    ("text", "column", "words"),
    [
        ("", 0, "from the base to the platform"),
        ("   ", 3, "from the base to the platform"),
        ("Q", 0, "Q is not a joint; the joints are R, P, H, C, U, S"),
        ("R[x] r[y]", 5, "joints are capital letters: R"),
        ("Rx", 1, "R[x]"),
        ("R_x", 1, "R[x]"),
        ("R_{x}", 1, "R[x]"),
        ("R1x", 2, "R[x]"),
        ("R(x)", 1, "square brackets: R[x]"),
        ("3-RRC", 0, "each limb as a chain of its own"),
        ("2P4R", 0, "write every joint"),
        ("R,R", 1, "side by side"),
        ("R[x", 1, "']'"),
        ("R[x[y]]", 1, "']'"),
        ("R x]", 2, "R[x]"),
        ("R[x]]", 4, "no square bracket"),
        ("P(4R", 1, "closes"),
        ("P^{(4R)", 1, "closes"),
        ("P(5R)[x]", 1, "planar loop"),
        ("P(4R)(4S)", 5, "a second kind"),
        ("Pa(4S)(4S)", 6, "a second kind"),
        ("R(2P4R)(6R)", 7, "a second kind"),
        ("P(4X)[x]", 1, "4R, 4S, 4U, 2US"),
        ("U(4R)", 1, "at an R or a P"),
        ("(R R)", 0, "in braces"),
        ("{R R}", 0, "SOC{-R-R-}"),
        ("{R | R", 0, "'}'"),
        ("{R | }", 5, "a joint"),
        ("{ | R}", 2, "a joint"),
        ("{R ∥ | R}", 5, "behind the sign"),
        ("R}", 1, "no brace"),
        ("SOC{-R-R", 3, "'}'"),
        ("SOC{-R-} R", 9, "the end"),
        ("SOC -R-R-", 1, "'O'"),
        ("R ∥", 3, "behind the sign"),
        ("∥ R", 0, "a joint"),
        ("-", 1, "a joint"),
        ("R ∥⊥ R", 3, "one sign"),
        ("R ||| R", 4, "one sign"),
        ("R@a", 2, "capital letter"),
        ("R@", 2, "capital letter"),
        ("R@A@A", 0, "the label A twice"),
        ("U[x,y]@A@B", 0, "U[x@B,y]@A"),
        ("U[x@A,y]@A", 0, "the label A twice"),
        ("S@A@B", 0, "the centres A and B"),
        ("R[0@A,1,0]", 2, "a label behind 1 of three numbers"),
        ("R[x@a]", 2, "'x@a'"),
        ("P[x]@A", 4, "a translation has no place"),
        ("P[x@A]", 2, "a translation has no place"),
        ("P(4R)[x@A]", 6, "a translation has no place"),
        ("P(4R)[x]@A", 8, "a translation has no place"),
        ("◇P", 1, "'('"),
        ("◇(P1)", 4, "','"),
        ("◇(P1, P2", 8, "')'"),
        ("◇(P1, S)", 6, "R, P, H, C"),
        (r"R \para R", 2, r"\parallel"),
        ("R1 R1", 3, "every joint of a chain has its own"),
    ],
)
def test_what_is_no_chain(text, column, words):
    with pytest.raises(NotationError) as error:
        parse_chain(text)
    assert error.value.position == column
    assert words in str(error.value)


def test_limits():
    with pytest.raises(NotationError, match=f"at most {MAX_LENGTH}"):
        parse_chain(" " * (MAX_LENGTH + 1))
    with pytest.raises(NotationError, match=f"at most {MAX_JOINTS}"):
        parse_chain("S" * (MAX_JOINTS + 1))
    with pytest.raises(NotationError, match=f"at most {MAX_DEPTH}"):
        parse_chain("{" * (MAX_DEPTH + 1))
    text = "S"
    for _ in range(MAX_DEPTH):
        text = f"{{{text}|S}}"
    assert len(parse_chain(text).joints) == MAX_DEPTH + 1


@pytest.mark.parametrize(
    ("text", "literature"),
    [("U P S", False), ("R[x].R[y]", False), ("-R-", True), ("R|R", True), ("SOC{R R}", True), ("{R|R} R", False)],
)
def test_which_form_it_is(text, literature):
    assert read(Source(text)).literature == literature

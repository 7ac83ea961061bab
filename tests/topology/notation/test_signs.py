"""What is read as which sign: keyboard, Unicode and LaTeX, and the look-alikes of each."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.directions import parallel, perpendicular
from assur.topology.notation import parse_chain
from assur.topology.notation.signs import plain_letters


@given(st.text())
def test_places_stay_what_they_are(text):
    assert len(plain_letters(text)) == len(text)


@pytest.mark.parametrize("sign", ["|", "||", "//", "∥", "‖", "║", "ǁ", r"\parallel", r"\|", "∣", "｜", "｜｜"])
def test_parallel(sign):
    one, other = parse_chain(f"R {sign} R").elements
    assert parallel(one.axes[0], other.axes[0])
    assert (one.general, other.general, one.point, other.point) == (False, False, "", "")


@pytest.mark.parametrize("sign", ["⊥", "⟂", "_|_", r"\perp", r"\bot", "-⊥-"])
def test_perpendicular(sign):
    one, other = parse_chain(f"R {sign} R").elements
    assert perpendicular(one.axes[0], other.axes[0])


@pytest.mark.parametrize("sign", ["/", "∕"])
def test_coaxial(sign):
    one, other = parse_chain(f"R{sign}R").elements
    assert one.axes == other.axes
    assert one.point == other.point != ""


@pytest.mark.parametrize("sign", ["^", "⌢", r"\frown", r"\smallfrown", "⁀"])
def test_meeting_in_a_point(sign):
    one, other = parse_chain(f"R {sign} R").elements
    assert not parallel(one.axes[0], other.axes[0])
    assert not perpendicular(one.axes[0], other.axes[0])
    assert one.point == other.point != ""


@pytest.mark.parametrize("sign", ["⌢⊥", "⊥⌢", "^_|_", r"\frown\perp"])
def test_meeting_at_a_right_angle(sign):
    one, other = parse_chain(f"R {sign} R").elements
    assert perpendicular(one.axes[0], other.axes[0])
    assert one.point == other.point != ""


@pytest.mark.parametrize("sign", ["-", "--", "–", "—", "−", "‐", "‑", " ", "", ".", " · "])
def test_nothing_said(sign):
    one, other = parse_chain(f"R{sign}R").elements
    assert one.general
    assert other.general
    assert not parallel(one.axes[0], other.axes[0])
    assert not perpendicular(one.axes[0], other.axes[0])


@pytest.mark.parametrize("letter", ["Р", "Ρ", "Ｐ", "𝑃", "𝐏", "ᴾ"])
def test_letters_that_look_like_it(letter):
    assert parse_chain(f"{letter}[x]").elements[0].type.letter == "P"


@pytest.mark.parametrize(
    "text",
    ["R_3", "R3", "R₃", "R_{3}", "R_3^{(2P4R)}", "R^{(2P4R)}_3", "R3(2P4R)", "R₃⁽²ᴾ⁴ᴿ⁾", "R3^(2P4R)", "R_{3}^{2P4R}"],
)
def test_numbers_and_tags(text):
    if "P" in text or "ᴾ" in text:
        assert parse_chain(rf"◇(P(2P4R), P(2P4R)) ⊥ {text}").elements[0].name == "R3"
    else:
        assert parse_chain(text).elements[0].name == "R3"


@pytest.mark.parametrize("text", ["P(4R)[y]", "P[y](4R)", "Pa[y]", "P_a[y]", "P_{a}[y]", "P^{(4R)}[y]", "P^(4R) [y]"])
def test_parallelograms(text):
    found = parse_chain(text).elements[0]
    assert (found.kind, found.axis, found.name, found.general) == ("4R", (0, 1, 0), "Pa1", False)


@pytest.mark.parametrize(
    "text", ["SOC{-R-R-}", "HSOC{-R-R-}", "SOC_1{R-R}", r"$SOC_{12}\left\{-R \, - R-\right\}$", "-R-R-"]
)
def test_wrappers_say_nothing(text):
    assert [joint.name for joint in parse_chain(text).joints] == ["R1", "R2"]

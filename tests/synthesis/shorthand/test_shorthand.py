"""Reading shorthand: limbs, joints, what is underlined; and what is none."""

import pytest

from assur.errors import UsageError
from assur.synthesis.shorthand.shorthand import read_shorthand


def read(text):
    return [(limb.count, " ".join(limb.joints), limb.driven) for limb in read_shorthand(text)]


@pytest.mark.parametrize(
    ("text", "limbs"),
    [
        ("3-RPS", [(3, "R P S", ())]),
        ("3RPS", [(3, "R P S", ())]),
        ("3-rps", [(3, "R P S", ())]),
        ("3-_r_pa(4s)", [(3, "R P(4S)", (0,))]),
        ("3-R_P_S", [(3, "R P S", (1,))]),
        ("3-RP\N{COMBINING LOW LINE}S", [(3, "R P S", (1,))]),
        (r"3-R\underline{P}S", [(3, "R P S", (1,))]),
        ("_PR_S", [(1, "P R S", (0, 1))]),
        ("3UPS&UP", [(3, "U P S", ()), (1, "U P", ())]),
        ("3-UPS/UP", [(3, "U P S", ()), (1, "U P", ())]),
        ("2UPR-RPU", [(2, "U P R", ()), (1, "R P U", ())]),
        ("UPR-UPR-SPR", [(2, "U P R", ()), (1, "S P R", ())]),
        ("3-RPa(4S)", [(3, "R P(4S)", ())]),
        ("3-RP(4S)", [(3, "R P(4S)", ())]),
        ("3-_R_(2-SS)", [(3, "R P(4S)", (0,))]),
        ("3-PRPaR", [(3, "P R P(4R) R", ())]),
        ("3-P R Pa(4R) R", None),
    ],
)
def test_a_shorthand_is_limbs_and_what_is_underlined(text, limbs):
    if limbs is None:
        limbs = [(3, "P", ()), (2, "R", ()), (1, "P(4R)", ())]
        assert sorted(read(text)) == sorted(limbs)
        return
    assert read(text) == limbs


@pytest.mark.parametrize(
    "text", ["", "3", "3-", "3-RQS", "3-R_PS", "-3-RPS", "0-RPS", "61-RPS", "3-RPS&", "3-RPS)", "rPS", "rqs"]
)
def test_what_is_no_shorthand_is_refused_with_its_place(text):
    with pytest.raises(UsageError, match=r"character|allowed"):
        read_shorthand(text)


@pytest.mark.parametrize("text", ["3-RPS", "3-RPa(4S)", "2-UPR", "PRPaR"])
def test_a_limb_is_written_as_it_was_read(text):
    assert read_shorthand(text)[0].text == text

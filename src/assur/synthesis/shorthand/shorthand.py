"""Reading shorthand: how many limbs of which joints, and which of these are underlined."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

from assur.errors import UsageError, cut
from assur.joints.catalogue import BY_LETTER

PARALLELOGRAMS = {"2SS": "P(4S)", "2US": "P(2US)", "2UU": "P(4U)", "SS": "P(4S)", "US": "P(2US)", "UU": "P(4U)"}
"""Two rods side by side, as some papers write them, R(2-SS), and the parallelogram that they are."""

MOST = 60

_JOINT = re.compile(
    rf"(?P<name>P(?:a|_a)?\((?P<kind>4R|4S|4U|2US)\)|\(2?-?(?P<rods>SS|US|UU)\)(?:2|²)?|P(?:a|_a)"
    rf"|[{''.join(letter for letter in BY_LETTER)}])"
)
_COUNT = re.compile(r"(\d+)\s*[-–×x·]?\s*")
_BETWEEN = re.compile(r"\s*[-–&/+,]\s*|\s+")
_UNDERLINED = re.compile(r"\\underline\{([^{}]*)\}")
LOW_LINE = "\N{COMBINING LOW LINE}"


@dataclass(frozen=True)
class ShortLimb:
    """So many equal limbs, their joints from base to platform, and the places of those that are underlined."""

    count: int
    joints: tuple[str, ...]
    driven: tuple[int, ...] = ()

    @property
    def text(self) -> str:
        """As a title has it, without underlines."""
        joints = "".join("Pa" if joint == "P(4R)" else joint.replace("P(", "Pa(") for joint in self.joints)
        return f"{self.count}-{joints}" if self.count > 1 else joints

    @property
    def freedoms(self) -> int:
        """The sum of those of the joints."""
        return sum(_FREEDOMS.get(joint) or BY_LETTER[joint].freedoms for joint in self.joints)


_FREEDOMS = {"P(4R)": 1, "P(4S)": 4, "P(4U)": 3, "P(2US)": 4}


def read_shorthand(text: str) -> tuple[ShortLimb, ...]:
    """The limbs of a shorthand.

    Joints are letters of the notation, Pa or P(4R), Pa(4S) or R(2-SS) parallelograms; an underlined letter, or one
    between low lines, is driven. A number stands before its limb, signs - & / + between limbs.

    Errors:
        UsageError: what is no such text, with the place.

    >>> [(limb.count, " ".join(limb.joints), limb.driven) for limb in read_shorthand("2U_P_R-SPR")]
    [(2, 'U P R', (1,)), (1, 'S P R', ())]
    >>> [limb.text for limb in read_shorthand("3UPS&UP")], read_shorthand("3-RPa(4S)")[0].joints
    (['3-UPS', 'UP'], ('R', 'P(4S)'))
    """
    plain = _capital(_UNDERLINED.sub(lambda match: f"_{match[1]}_", text.strip()))
    limbs: list[ShortLimb] = []
    at = 0
    while at < len(plain) or not limbs:
        if limbs:
            between = _BETWEEN.match(plain, at)
            if between is None:
                raise _unexpected(plain, at)
            at = between.end()
        count = _COUNT.match(plain, at)
        at = count.end() if count else at
        limb, at = _limb(plain, at, int(count[1]) if count else 1)
        limbs.append(limb)
    if not 1 <= sum(limb.count for limb in limbs) <= MOST or not all(limb.count for limb in limbs):
        raise UsageError(f"'{cut(text)}': the number of limbs; allowed: 1 to {MOST}")
    return _gathered(limbs)


def _capital(text: str) -> str:
    """Letters without a capital among them as capitals: 3-rps, 3-rpa(4s).

    >>> _capital("3-_r_pa(4s)"), _capital("3xups&up")
    ('3-_R_Pa(4S)', '3xUPS&UP')
    """
    return text.upper().replace("PA", "Pa").replace("X", "x") if text == text.lower() else text


def _limb(text: str, at: int, count: int) -> tuple[ShortLimb, int]:
    joints: list[str] = []
    driven: list[int] = []
    lined = False
    while at < len(text):
        if text[at] == "_":
            lined = not lined
            at += 1
        elif text[at] == LOW_LINE and joints:
            driven.append(len(joints) - 1)
            at += 1
        elif match := _JOINT.match(text, at):
            if lined:
                driven.append(len(joints))
            joints.append(_joint(match))
            at = match.end()
        else:
            break
    if lined or not joints:
        raise _unexpected(text, at)
    return ShortLimb(count, tuple(joints), tuple(driven)), at


def _joint(match: re.Match[str]) -> str:
    if match["kind"] or match["rods"]:
        return f"P({match['kind']})" if match["kind"] else PARALLELOGRAMS[match["rods"]]
    return "P(4R)" if len(match["name"]) > 1 else match["name"]


def _gathered(limbs: list[ShortLimb]) -> tuple[ShortLimb, ...]:
    """Equal limbs that are written one after the other, UPR-UPR-SPR, counted: 2UPR-SPR."""
    counts: Counter[tuple[tuple[str, ...], tuple[int, ...]]] = Counter()
    for limb in limbs:
        counts[limb.joints, limb.driven] += limb.count
    return tuple(ShortLimb(count, *which) for which, count in counts.items())


def _unexpected(text: str, at: int) -> UsageError:
    shown = f"'{cut(text[at:], 20)}'" if at < len(text) else "the end"
    return UsageError(
        f"'{cut(text)}': {shown} at character {at + 1}; expected a joint ({', '.join(BY_LETTER)}, Pa, Pa(4S))",
        hint="limbs as papers name them: 3-RPS, 2UPR-RPU, 3UPS&UP, 3-_R_Pa(4S); axes go with --limb or --chain",
    )

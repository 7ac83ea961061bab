"""Reading the text of a chain, plain or as the literature writes it, into what it says.

    chain   = ["<" link ">"] serial ["<" link ">"] | ("SOC" | "HSOC") [number] "{" serial "}"
    serial  = ["-"] element { [sign] element } ["-"]
    element = joint | "◇" "(" joint "," joint ")" | "{" serial "|" serial { "|" serial } "}"
    joint   = letter [number] { "(" kind or tag ")" | "[" directions "]" | "@" label }
    sign    = "-" | "∥" | "⊥" | "/" | "⌢" | "⌢⊥"

A single bar between the branches of a loop separates them; elsewhere it means parallel.
"""

from __future__ import annotations

import re

from assur.joints.catalogue import BY_LETTER
from assur.topology.chains import BASE, PLATFORM
from assur.topology.notation import signs
from assur.topology.notation.cursor import LETTERS, Cursor
from assur.topology.notation.errors import Source
from assur.topology.notation.joint_reader import read_joint
from assur.topology.notation.signs import Relation
from assur.topology.notation.syntax import Diamond, Serial, WrittenJoint, WrittenLimb, WrittenLoop, WrittenSign

MAX_LENGTH = 4000
MAX_DEPTH = 10
MAX_JOINTS = 60

_WRAPPER = re.compile(r"H?SOC(?:_?\d+|_\{\d+\})?(?=\s*(?:\\left)?\s*\\?\{)", re.ASCII)
_LINK = re.compile(r"<\s*([a-z][a-z0-9_ ]*?)\s*>", re.ASCII)
_UNDERLINE = re.compile(r"_[A-Z]|\\underline")
DRIVEN = "what is driven is said beside the chains, as limb.joint counted from the base: --actuate 1.1,2.1"
_ROUND_OPEN, _ROUND_CLOSE, _COMMA = re.compile(r"\("), re.compile(r"\)"), re.compile(",")


def read(source: Source) -> WrittenLimb:
    """What a chain's text says.

    Errors:
        NotationError: a syntax error; more than 4000 characters, 60 joints or braces 10 deep.
    """
    if len(source.text) > MAX_LENGTH:
        raise source.error(0, f"{len(source.text)} characters", f"at most {MAX_LENGTH}")
    return _Reader(source).limb()


class _Reader:
    """Recursive descent; the depth counts braces, so that no text can exhaust the stack."""

    def __init__(self, source: Source) -> None:
        self.cursor = Cursor(source)
        self.depth = 0
        self.joints = 0
        self.literature = False

    def limb(self) -> WrittenLimb:
        cursor = self.cursor
        cursor.skip()
        wrapped = cursor.take(_WRAPPER) is not None
        if wrapped:
            self.literature = True
            cursor.skip()
            opened = cursor.at
            cursor.take(signs.OPEN)
        start = self._link(BASE)
        serial = self._serial()
        if wrapped:
            self._close(opened)
        behind = cursor.at
        end = self._link(PLATFORM)
        if start == end:
            hint = "a chain leads from one link to another: <a> R[z] R[z] <b>"
            raise cursor.error(behind, f"a chain from {start} to itself", "two links", hint)
        if not cursor.ended:
            raise cursor.unexpected("the end" if wrapped else "a joint, a sign or the end")
        return WrittenLimb(cursor.source, serial, self.literature, (start, end))

    def _link(self, default: str) -> str:
        """A named link, where there is one."""
        self.cursor.skip()
        match = self.cursor.take(_LINK)
        return match.group(1) if match else default

    def _serial(self) -> Serial:
        self._sign(leading=True)
        items, signs = [self._element()], list[WrittenSign]()
        while True:
            sign = self._sign()
            if self._serial_ends():
                if sign.relations:
                    raise self.cursor.unexpected("a joint behind the sign")
                return Serial(tuple(items), tuple(signs))
            items.append(self._element())
            signs.append(sign)

    def _serial_ends(self) -> bool:
        cursor = self.cursor
        if self.depth == 0 and cursor.sees(_LINK):
            return True
        return cursor.ended or cursor.sees(signs.CLOSE) or (self.depth > 0 and cursor.sees(signs.BRANCH))

    def _sign(self, *, leading: bool = False) -> WrittenSign:
        """Every sign up to the next element: hyphens say nothing, and only two relations go together."""
        cursor = self.cursor
        cursor.skip()
        start, relations = cursor.at, list[Relation]()
        while True:
            cursor.skip()
            at = cursor.at
            if cursor.take(signs.NOTHING):
                self.literature = True
                continue
            relation = None if leading else self._relation()
            if relation is None:
                return WrittenSign(tuple(relations), start)
            if relations and {*relations, relation} != {"meeting", "perpendicular"}:
                raise cursor.error(at, "a second sign", "a joint", "one sign between two joints, or ⌢⊥")
            relations.append(relation)
            self.literature = True

    def _relation(self) -> Relation | None:
        for relation, pattern in signs.RELATIONS.items():
            if self.cursor.take(pattern):
                return relation
        return "parallel" if self.depth == 0 and self.cursor.take(signs.BRANCH) else None

    def _element(self) -> WrittenJoint | Diamond | WrittenLoop:
        cursor = self.cursor
        cursor.skip()
        start = cursor.at
        if cursor.take(signs.DIAMOND):
            return self._diamond(start)
        if cursor.take(signs.OPEN):
            return self._loop(start)
        return self._joint()

    def _joint(self) -> WrittenJoint:
        self.cursor.skip()
        joint = read_joint(self.cursor)
        if joint is None:
            raise self.cursor.unexpected(f"a joint ({LETTERS})", DRIVEN if self.cursor.sees(_UNDERLINE) else "")
        self.literature = self.literature or joint.tag is not None
        self.joints += 1
        if self.joints > MAX_JOINTS:
            raise self.cursor.error(joint.at, f"joint {self.joints}", f"at most {MAX_JOINTS} in a chain")
        return joint

    def _loop(self, start: int) -> WrittenLoop:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.cursor.error(start, "too deep a nesting", f"at most {MAX_DEPTH} braces")
        branches = [self._serial()]
        while self.cursor.take(signs.BRANCH):
            branches.append(self._serial())
        self._close(start)
        self.depth -= 1
        if len(branches) == 1:
            hint = "a limb needs no braces; as the literature writes it, SOC{-R-R-}"
            raise self.cursor.error(start, "a loop with one branch", "two or more, with | between them", hint)
        return WrittenLoop(tuple(branches), start)

    def _close(self, opened: int) -> None:
        if self.cursor.take(signs.CLOSE):
            return
        if self.cursor.ended:
            raise self.cursor.error(opened, "a brace that is not closed", "'}' before the end")
        raise self.cursor.unexpected("a joint, a sign, '|' or '}'")

    def _diamond(self, start: int) -> Diamond:
        self.literature = True
        first = self._member(_ROUND_OPEN, "'('")
        second = self._member(_COMMA, "',' and the second joint")
        if not self.cursor.sees(_ROUND_CLOSE):
            raise self.cursor.unexpected("')'", "◇(P1, P2) is the plane of two joints")
        self.cursor.take(_ROUND_CLOSE)
        return Diamond((first, second), start)

    def _member(self, before: re.Pattern[str], shown: str) -> WrittenJoint:
        if not self.cursor.sees(before):
            raise self.cursor.unexpected(shown, "◇(P1, P2) is the plane of two joints")
        self.cursor.take(before)
        joint = self._joint()
        if not BY_LETTER[joint.letter].axial or joint.kind:
            what = "a parallelogram" if joint.kind else joint.letter
            raise self.cursor.error(joint.at, f"{what} in a diamond", "joints with one axis: R, P, H, C")
        return joint

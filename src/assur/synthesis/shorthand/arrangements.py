"""Standard arrangements: the chains that a shorthand means, and what is driven, from a table with its facts."""

from __future__ import annotations

import dataclasses
import difflib
import re
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from assur.errors import UnknownNameError, UsageError
from assur.synthesis.drafting.repeating import repeated
from assur.synthesis.shorthand.shorthand import ShortLimb, read_shorthand
from assur.topology.analysis import Mode
from assur.topology.chains import Chain
from assur.topology.counting.drives import FREE
from assur.topology.notation import parse_chain, parse_chains, plain_text

_JOINT = re.compile(r"[^\s{}|]+")


@dataclass(frozen=True)
class ArrangedLimb:
    """So many limbs evenly about z, the first of them in notation; `driven`: places of its driven joints."""

    count: int
    text: str
    driven: tuple[int, ...]


@dataclass(frozen=True)
class Arrangement:
    """One way to place the axes of a shorthand.

    Attributes:
        of: the shorthand, "" for a mechanism that has none; `name` tells its arrangements apart.
        motion: POC set of the platform, as "t3 r2"; `dof` its degree of freedom without internal ones.
        says: one phrase for people.
        also: names that mean it without a shorthand.
    """

    of: str
    name: str
    limbs: tuple[ArrangedLimb, ...]
    motion: str = ""
    dof: int = 0
    says: str = ""
    mode: Mode = "home"
    also: tuple[str, ...] = ()

    @property
    def chains(self) -> tuple[Chain, ...]:
        """The limbs, each in the base frame."""
        placed = (
            repeated(limb.text, limb.count) if limb.count > 1 else [parse_chain(limb.text)] for limb in self.limbs
        )
        return parse_chains([plain_text(chain) for chains in placed for chain in chains])

    @property
    def actuate(self) -> tuple[str, ...]:
        """What is driven, as "limb.joint"."""
        places = [limb.driven for limb in self.limbs for _ in range(limb.count)]
        return tuple(f"{number}.{place + 1}" for number, driven in enumerate(places, 1) for place in driven)

    @property
    def options(self) -> str:
        """The options of `assur new` that say the same in full."""
        if len(self.limbs) == 1 and self.limbs[0].count > 1:
            said = f'--limb "{self.limbs[0].text}" --count {self.limbs[0].count}'
        else:
            texts = (self.limbs[0].text,) if len(self.limbs) == 1 else map(plain_text, self.chains)
            said = " ".join(f'--chain "{text}"' for text in texts)
        said += f" --actuate {','.join(self.actuate)}" if self.actuate else ""
        return said + (f" --mode {self.mode}" if self.mode != "home" else "")

    @property
    def shown(self) -> str:
        """Shorthand and name."""
        return f"{self.of} '{self.name}'" if self.of else self.also[0]


@cache
def arrangements() -> tuple[Arrangement, ...]:
    """All standard arrangements, in the order of the table.

    >>> [entry.name for entry in arrangements() if entry.of == "3-RRR"]
    ['planar', 'spherical']
    """
    return tuple(
        Arrangement(
            **{"of": ""} | entry | {"limbs": tuple(map(_limb, entry["limbs"])), "also": tuple(entry.get("also", ()))}
        )
        for entry in _table()["arrangement"]
    )


def arranged(text: str, name: str = "") -> Arrangement:
    """The arrangement that a shorthand means, or a name such as Delta; underlined joints are driven.

    Limbs of six freedoms or more, which hold the platform back in nothing, are taken with axes left general.

    Args:
        text: a shorthand, or the name of an arrangement.
        name: which arrangement, or how its name begins, where the shorthand has several.

    Errors:
        UsageError: no shorthand; none or several arrangements, which are listed; an arrangement that it has not.

    >>> arranged("3-RRR", "planar").options
    '--limb "R[z] R[z] R[z]" --count 3 --actuate 1.1,2.1,3.1'
    >>> arranged("3-U_P_S&UP").actuate, arranged("5-UPS").options
    (('1.2', '2.2', '3.2'), '--limb "U P S" --count 5')
    """
    titled = [entry for entry in arrangements() if _plain(text) in map(_plain, entry.also)]
    if titled:
        return _only(text, titled, name)
    for entry in _table()["unwritable"]:
        if _plain(entry["name"]) == _plain(text):
            raise UsageError(f"{entry['name']} is not made of chains in notation: {entry['says']}", hint=entry["hint"])
    limbs = _limbs(text)
    known = [entry for entry in arrangements() if entry.of and _key(read_shorthand(entry.of)) == _key(limbs)]
    if not known and not name and all(limb.freedoms >= FREE for limb in limbs):
        return _general(limbs)
    if not known:
        raise _unknown("-".join(limb.text for limb in limbs))
    return _redriven(_only(text, known, name), limbs)


def _limbs(text: str) -> tuple[ShortLimb, ...]:
    """The limbs of a shorthand; a text that is none may be nearly a name."""
    try:
        return read_shorthand(text)
    except UsageError:
        if _near(text, (title for entry in arrangements() for title in entry.also)):
            raise _unknown(text) from None
        raise


def _unknown(text: str) -> UnknownNameError:
    known = {name for entry in arrangements() for name in (entry.of, *entry.also) if name}
    near = _near(text, known)
    guess = f"did you mean {' or '.join(near)}? Else say" if near else "say"
    hint = f'{guess} how its axes lie, as --limb "R[y] P[z] S" --count 3; the notation: assur topology --help'
    return UnknownNameError("standard arrangement", text, known, hint=hint)


def _near(text: str, names: Iterable[str]) -> list[str]:
    return difflib.get_close_matches(text, sorted(names), n=3, cutoff=0.7)


def _only(text: str, known: Sequence[Arrangement], name: str) -> Arrangement:
    """The arrangement that is meant by its name, or the only one."""
    meant = [entry for entry in known if not name or _plain(entry.name).startswith(_plain(name))]
    if name and not meant:
        raise UnknownNameError(f"arrangement of {text}", name, [entry.name for entry in known])
    if len(meant) == 1:
        return meant[0]
    listed = "\n".join(f"  {entry.shown}: {entry.says}\n      {entry.options}" for entry in meant)
    raise UsageError(
        f"{text} has several standard arrangements:\n{listed}", hint=f"add the name of one, as {meant[0].shown}"
    )


def _redriven(entry: Arrangement, limbs: Sequence[ShortLimb]) -> Arrangement:
    """The arrangement with what is underlined driven, where something is."""
    if not any(limb.driven for limb in limbs):
        return entry
    marked = {limb.joints: limb.driven for limb in limbs}
    of = iter([limb for limb in read_shorthand(entry.of) for _ in range(limb.count)])
    chosen = []
    for limb in entry.limbs:
        joints, *_ = [next(of).joints for _ in range(limb.count)]
        places = _places(joints, limb.text)
        chosen.append(dataclasses.replace(limb, driven=tuple(places[letter] for letter in marked[joints])))
    return dataclasses.replace(entry, limbs=tuple(chosen))


def _places(joints: Sequence[str], text: str) -> list[int]:
    """Where each letter of a shorthand is in a limb, where a U may be written as two R."""
    written = _JOINT.findall(text)
    places: list[int] = []
    at = 0
    for letter in joints:
        places.append(at)
        at += 2 if letter == "U" and written[at].startswith("R") else 1
    return places


def _general(limbs: Sequence[ShortLimb]) -> Arrangement:
    """Limbs with their axes left general, driven by what is underlined, else by their P, else as they come."""
    underlined = any(limb.driven for limb in limbs)
    chosen = tuple(
        ArrangedLimb(
            limb.count,
            " ".join(limb.joints),
            limb.driven if underlined else tuple(place for place, joint in enumerate(limb.joints) if joint == "P")[:1],
        )
        for limb in limbs
    )
    each = all(limb.driven for limb in chosen) and sum(limb.count for limb in chosen) == FREE
    if not underlined and not each:
        chosen = tuple(dataclasses.replace(limb, driven=()) for limb in chosen)
    of = "-".join(limb.text for limb in limbs)
    return Arrangement(
        of, "general", chosen, says="axes left general, since a limb of six freedoms or more holds nothing back"
    )


def _limb(text: str) -> ArrangedLimb:
    """A limb of the table: how often it is there, its notation, and between low lines what is driven."""
    count, _, limb = text.rpartition(" x ")
    driven = tuple(place for place, joint in enumerate(_JOINT.findall(limb)) if joint.startswith("_"))
    return ArrangedLimb(int(count or 1), limb.replace("_", ""), driven)


def _key(limbs: Sequence[ShortLimb]) -> list[tuple[int, tuple[str, ...]]]:
    return sorted((limb.count, limb.joints) for limb in limbs)


def _plain(text: str) -> str:
    """A name without what people write in several ways."""
    return re.sub(r"[\s_-]+", "", text).casefold()


@cache
def _table() -> dict[str, Any]:
    return tomllib.loads(Path(__file__).with_name("arrangements.toml").read_text(encoding="utf-8"))

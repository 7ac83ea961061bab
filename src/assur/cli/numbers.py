"""Numbers as a user types them: a decimal point, finite, nothing else; and pairs such as l2=300 and x=-110:90."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from assur.errors import UsageError

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
COMMA = re.compile(r"[+-]?\d*,\d*", re.ASCII)
NEXT = re.compile(r",(?=[^,=]*=)")
"""In front of an assignment; the comma of a number is none."""
EMPTY = re.compile(r"^\s*,|,\s*(,|$)")
"""A comma with nothing on one side."""
NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.IGNORECASE)
LARGEST = 1e60
"""No dimension is larger; up to here the fourth power of a number is finite."""
HOLDABLE = ("--box", "--along")
"""Options whose interval is that of a coordinate which --at can hold."""
VALUE = re.compile(r"-(\d|[.,]\d|inf|nan)", re.IGNORECASE)
"""How a value begins that could be taken for an option."""
END = "--"
"""No word after it is an option."""
TIED = {"--mode": re.compile(r"[+0-]+\Z"), "--chain": re.compile(r"-[^-]")}
"""Options whose value may begin with a hyphen, and how it then looks: signs, or a chain of the literature."""


def number(text: str, what: str) -> float:
    """A finite number, or a refusal that says what is wrong with it.

    >>> number("-143.3209", "yA2")
    -143.3209
    """
    text = text.strip()
    if NUMBER.fullmatch(text):
        value = float(text)
        if abs(value) <= LARGEST:
            return value
        raise UsageError(f"{what}: {text} is too large")
    if NOT_FINITE.fullmatch(text):
        raise UsageError(f"{what}: {text} is not a finite number")
    raise UsageError(f"{what}: '{text}' is not a number", hint=_hint(text))


def _hint(text: str) -> str:
    if COMMA.fullmatch(text) and text != ",":
        alone = text.endswith(",")
        return f"leave out the comma: {text[:-1]}" if alone else f"write a decimal point: {text.replace(',', '.')}"
    if text.startswith("\N{MINUS SIGN}"):
        return f"write the minus as a hyphen: -{text[1:]}"
    return "give it like -143.3209 or 1.5e3, without a unit"


def numbers(texts: Sequence[str], names: Sequence[str], what: str) -> list[float]:
    """One number per name, in words of their own or with commas in one, or a refusal that names the one that is wrong.

    >>> numbers(["1", "2", "-3"], ("x", "y", "z"), "pose"), numbers(["1,2,-3"], ("x", "y", "z"), "pose")
    ([1.0, 2.0, -3.0], [1.0, 2.0, -3.0])
    """
    if len(texts) == 1 and texts[0].count(",") == len(names) - 1 > 0:
        texts = texts[0].split(",")
    if len(texts) != len(names):
        count = f"{len(texts)} value" if len(texts) == 1 else f"{len(texts)} values"
        raise UsageError(f"{what}: {count}, {len(names)} wanted", hint=f"give {', '.join(names)}")
    return [number(text, name) for name, text in zip(names, texts, strict=True)]


def wrench(text: str | None) -> list[float]:
    """Force and moment of `--load`, in N and N m; none where nothing is given.

    >>> wrench("0,0,-100")
    [0.0, 0.0, -100.0]
    """
    texts = text.split(",") if text is not None else ["0"] * 3
    given = [number(part, "--load") for part in texts]
    if len(given) not in (3, 6):
        count = f"{len(given)} value" if len(given) == 1 else f"{len(given)} values"
        raise UsageError(f"--load: {count}", hint="give FX,FY,FZ or FX,FY,FZ,MX,MY,MZ, in N and N m")
    return given


def parts(texts: Iterable[str], option: str) -> list[str]:
    """What stands between commas, of texts that each are NAME=VALUE, or several, or begin with what has no name.

    >>> parts(["-300:300, yA1=-1,5:1,5", "yA2=0:9"], "--stroke")
    ['-300:300', 'yA1=-1,5:1,5', 'yA2=0:9']
    """
    found: list[str] = []
    for text in texts:
        if EMPTY.search(text):
            raise UsageError(
                f"{option}: '{text.strip()}' has a comma too many", hint="put one between two parts, none at the end"
            )
        found += (part.strip() for part in NEXT.split(text))
    return found


def assignments(texts: Iterable[str], option: str, example: str) -> dict[str, str]:
    """{name: text} from NAME=VALUE texts, each one or several with commas between; a name that comes twice is refused.

    >>> assignments(["x=-20:0,y=-50:50", "z=400:420"], "--box", "x=-110:90")
    {'x': '-20:0', 'y': '-50:50', 'z': '400:420'}
    """
    found: dict[str, str] = {}
    for text in parts(texts, option):
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise UsageError(f"{option}: '{text}' is not NAME=VALUE", hint=f"for example {option} {example}")
        if name in found:
            raise UsageError(f"{option}: {name} is given twice")
        found[name] = value
    return found


def interval(text: str, what: str, example: str) -> tuple[float, float]:
    """(low, high) from LOW:HIGH with low < high.

    >>> interval("-110:90", "--box x", "x=-110:90")
    (-110.0, 90.0)
    """
    low, colon, high = text.partition(":")
    if not colon:
        raise UsageError(f"{what}: '{text.strip()}' is not LOW:HIGH", hint=f"for example {what.split()[0]} {example}")
    pair = number(low, what), number(high, what)
    if not pair[0] < pair[1]:
        option, _, name = what.partition(" ")
        hold = f"; to hold it: --at {name}={low.strip()}" if pair[0] == pair[1] and option in HOLDABLE else ""
        raise UsageError(
            f"{what} = {low.strip()}:{high.strip()} is turned round or empty", hint=f"give LOW < HIGH{hold}"
        )
    return pair


def shielded(tokens: Sequence[str]) -> list[str]:
    """Command-line words in which no value can be taken for an option.

    A word that begins like a negative number gets a space in front; a mode and a chain are tied to their options. So
    `--` in front of values says nothing new, and is left out.

    >>> shielded(["--mode", "--+", "-1,5", "--json"])
    ['--mode=--+', ' -1,5', '--json']
    >>> shielded(["fivebar", "--", "-1.5", "2"])
    ['fivebar', ' -1.5', '2']
    >>> shielded(["--chain", "-R|R-"])
    ['--chain=-R|R-']
    """
    kept: list[str] = []
    words = iter(tokens)
    for word in words:
        if word in TIED:
            value = next(words, None)
            known = value is not None and TIED[word].match(value)
            kept += [f"{word}={value}"] if known else [word] if value is None else [word, value]
        elif word == END:
            rest = shielded([*words])
            kept += [word, *rest] if any(value.startswith("-") for value in rest) else rest
        else:
            kept.append(f" {word}" if VALUE.match(word) else word)
    return kept


def whole_number(text: str, what: str) -> int:
    """A whole number, or a refusal."""
    text = text.strip()
    if re.fullmatch(r"[+-]?\d{1,9}", text, re.ASCII):
        return int(text)
    raise UsageError(f"{what}: '{text}' is not a whole number")


def centre_of(text: str | None) -> tuple[float, float, float]:
    """A point written as X,Y,Z, in the file's unit; the origin without."""
    x, y, z = numbers(text.split(",") if text else ("0", "0", "0"), ("x", "y", "z"), "--centre")
    return x, y, z

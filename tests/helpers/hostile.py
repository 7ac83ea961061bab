"""What nobody should send: files, command lines and certificates that are wrong in as many ways as chance finds.

Each is made from a seed, so that one that fails can be made again.
"""

import copy
import hashlib
import json
import math
import random
import re
from collections.abc import Iterator
from typing import Any

TOKEN = re.compile(r"\"[^\"\n]*\"|[A-Za-z_][\w.']*|-?\d+(?:\.\d+)?|[^\w\s]|\n")
ODD = (
    *("nan", "inf", "-inf", "-1", "0", "1e308", "1e-320", "9" * 400, "0x1F", "1_000", "1.0", "true", "false"),
    *('""', '"x"', '"-z"', '"a.b"', '"leg1.A"', '"l1*(2"', '"1/0"', '"sqrt(0-1)"', '"pi"', '"62 deg"', '"$"'),
    *("[]", "{}", "[[]]", "[[", "]]", "[0, 0, 0]", "[nan, 0, 0]", "{ a = 1, a = 2 }", "1979-05-27", "'''", '"""'),
    *("\n[x]\n", "\n[[x]]\n", "\n[joints]\n", "\nname = 1\n", "#", "=", ",", ".", "\\", "\x00", "\x1b[2J", "\u202e"),
    *(
        "\ufeff",
        "\r",
        "\x9b",
        "é",
        "\U0001f916",
        "a" * 101,
        "a." * 30,
        "[" * 60,
        '"\\u001b]0;x\\u0007"',
        '"\\theta_{1"',
    ),
)
"""What is put in the place of a piece of a file."""


def mutated(text: str, seed: int) -> str:
    """A file with one to four of its pieces replaced, removed, doubled, exchanged or cut off."""
    rng = random.Random(seed)
    for _ in range(rng.randint(1, 4)):
        spans = [match.span() for match in TOKEN.finditer(text)] or [(0, 0)]
        (start, end), (other, last) = rng.choice(spans), rng.choice(spans)
        match rng.randrange(7):
            case 0 | 1 | 2:
                text = text[:start] + rng.choice(ODD) + text[end:]
            case 3:
                text = text[:start] + text[end:]
            case 4:
                text = text[:end] + " " + text[start:]
            case 5:
                text = text[:start] + text[other:last] + text[end:]
            case _:
                rows = text.split("\n")
                row = rng.randrange(len(rows))
                rows[row : row + 1] = rng.choice(([], [rows[row]] * 2, [rows[row][: len(rows[row]) // 2]], rows[:row]))
                text = "\n".join(rows)
    return text


VALUES = (
    *("", " ", "0", "-1", "1e400", "nan", "inf", "-inf", "1,5", "3mm", "--", "-", "=", "x=", "=1", "x=1:", "x=1:0"),
    *("x=0:1,x=0:2", "all", "+", "++-++", "0", "+++++/0", "~Pa1", "../x", "/dev/zero", "/dev/stdin", ".", "\x1b[2J"),
    *("\u202ex", "a" * 5000, "9" * 400, "1e-320", "zeng2019", "fivebar", "nowhere.toml", "R[x]", "{R[x] | ", "P[q]"),
)
LINES = (
    *("direct fivebar 127 53 --mode + --method loops", "direct zeng2019 162.7 -143.3 -24.7 --set l2=300 --json"),
    *("direct fivebar 127 53 --certify --json", "direct planar_3rrr 10 20 30 --crossed"),
    *("inverse fivebar 0 200 --mode=-+ --json", "inverse zeng2019 -15.5 9.7 456.3 --mode ++-++ --certify"),
    *("inverse planar_3rpr 10 20 5 --set r=20", "follow fivebar --to 20,200 --from 0,200 --mode=-+"),
    *("singularity fivebar --pose 0 200 --mode=-+", "singularity zeng2019 --pose 0 0 400 --mode ++-++ --json"),
    *("indices fivebar --pose 0 200 --mode=-+ --json", "topology tripteron --actuate 1.1,2.1,3.1 --json"),
    *("topology --chain R[z]R[z]R[z] --chain R[z]R[z]R[z] --latex", "topology --chain C[x]R[x]R[x] --mode home"),
    *(
        "show zeng2019 --set l2=300 --json",
        "check fivebar --set l1=110 --json",
        "list --json",
        "schema",
        "cache --json",
    ),
    *(
        "verify c.json --mechanism fivebar --json",
        "export fivebar --format mjcf -o m.xml",
        "new my.toml --from fivebar",
    ),
    *("new my.toml --chain R[z]R[z]R[z] --chain R[z]R[z]R[z] --force", "audit fivebar --json"),
    *("workspace fivebar --mode=-+ --resolution 8 --box x=-10:10 --stroke 0:180 --section 200 --near 5 --json",),
    *("workspace fivebar --mode=-+ --prove x=-10:10,y=200:210 --boxes 500", "workspace fivebar --certify --gap 0.1"),
    *("workspace fivebar --mode=-+ --largest cylinder --around x=0,y=200 --ratio 1", "aspects fivebar --finest 60"),
    *(
        "aspects fivebar --mode=-+ --finest 60 --from 0,200 --to 10,210 --box x=-50:50",
        "certify fivebar -o c.json --most 9",
    ),
    *("certify fivebar -o c.json --kind box --box x=-10:10 --most 9 --gap 0.1 --finest 0.1 --resume",),
    *("sweep fivebar --along x=3 --along y=3 -o out --keep status --threads 1", "synthesize --max-joints 2 --top 3"),
    *("synthesize --motion 3T --limbs 3 --coupling 0..1 --actuators leg --max-joints 2 --symmetric --toml out",),
    *("figures fivebar --only structure --format svg -o out",),
)
"""Command lines that are done in a moment and mean something."""


def command_line(seed: int) -> list[str]:
    """Words of a command line, one or two of them by chance another value, cut short, left out or doubled."""
    rng = random.Random(seed)
    words = rng.choice(LINES).split()
    for _ in range(rng.randint(1, 2)):
        at = rng.randrange(1, len(words)) if len(words) > 1 else 0
        word, value = words[at], rng.choice(VALUES)
        cut = rng.randrange(len(word) + 1)
        match rng.randrange(6):
            case 0 | 1:
                words[at] = value
            case 2:
                words[at] = word[:cut] + value + word[cut:]
            case 3:
                words[at] = re.sub(r"-?[0-9]+(?:[.][0-9]+)?", lambda _, value=value: value, word, count=1)
            case 4:
                del words[at]
            case _:
                words.insert(at, word)
    return words


def forged(document: dict[str, Any], seed: int) -> tuple[bytes, bool]:
    """A certificate with one to three of its parts changed and signed anew, and whether it then says another thing."""
    rng = random.Random(seed)
    changed = copy.deepcopy(document)
    for _ in range(rng.randint(1, 3)):
        _forge(changed, rng)
    changed.pop("sha256", None)
    text = json.dumps(changed, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    other = {key: value for key, value in changed.items() if key != "made_by"}
    same = other == {key: value for key, value in document.items() if key not in ("made_by", "sha256")}
    signed = {**changed, "sha256": hashlib.sha256(text.encode()).hexdigest()}
    return json.dumps(signed).encode(), not same


def _forge(changed: dict[str, Any], rng: random.Random) -> None:
    """Change one place of a certificate: a leaf of its data, or a token of its proof."""
    place, key = rng.choice([found for found in _places(changed) if found[1] != "sha256"])
    value = place[key]
    match value:
        case bool():
            place[key] = not value
        case int():
            place[key] = value + rng.choice((-1, 1, 2, 10**6))
        case str() if value.startswith(("0x", "-0x")):
            number = float.fromhex(value)
            place[key] = rng.choice((math.nextafter(number, math.inf), -number, 2 * number, number + 1.0)).hex()
        case str() if len(value) > 40:
            at = rng.randrange(len(value))
            place[key] = value[:at] + rng.choice(("i", "r", "b", "0", "1", "o00", "")) + value[at + 1 :]
        case str():
            place[key] = rng.choice(("", "zeng2019", "x", "\x1b[2J", "inf", "i", "yes", "0x1p+0", value + "x"))
        case list() if value:
            rng.choice((value.pop, lambda: value.append(copy.deepcopy(value[0])), value.reverse))()
        case _:
            place[key] = rng.choice((None, 0, "", [], {}, 1.5, True, [[]], {"a": 1}))


def _places(part: Any) -> Iterator[tuple[Any, Any]]:
    keys = list(part) if isinstance(part, dict) else range(len(part)) if isinstance(part, list) else ()
    for key in keys:
        yield part, key
        yield from _places(part[key])

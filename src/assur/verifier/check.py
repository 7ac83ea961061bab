"""The check: walk through the tree of boxes, prove every leaf anew, and compare what follows with what is claimed.

Where the mechanism's folder is given, the formulas are held against its joint graph as well (`assur.verifier.closure`).

The proof is the tree, depth first: a digit halves the box across that coordinate, at the float 0.5 low + 0.5 high, the
lower half first; a path has a tree for each of its boxes in turn. Leaves: i inside, every margin >= 0 in all of the
box; r the same and no factor zero; oNN outside, margin NN (hex) < 0 in all of it; b left open. So the leaves cover the
box and do not overlap, whatever is written.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections import Counter
from fractions import Fraction
from pathlib import Path
from typing import Any

from flint import ctx, fmpq

from assur.verifier.bounds import nonzero
from assur.verifier.closure import closes
from assur.verifier.program import Box, Program
from assur.verifier.reading import CLOSED_FORM, MalformedError, RefusedError, names, numbers, read

BITS = 128
LEAVES = {"i": "inside", "r": "regular", "o": "outside", "b": "open"}
CLAIMS = {
    "workspace": ("leaves", "volume", "regular_volume"),
    "box": ("leaves", "reached", "regular"),
    "path": ("leaves", "reached", "regular"),
}
TOKEN = re.compile(r"[0-9]|[irb]|o[0-9a-f]{2}")


def verify(data: bytes, folder: Path | None = None) -> dict[str, Any]:
    """Check a certificate, and the hashes of the mechanism's files where their folder is given: the certificate read.

    Errors:
        MalformedError: it is no whole certificate.
        RefusedError: a leaf or a claim does not hold, or it is that of another mechanism.
    """
    document = read(data)
    precision, ctx.prec = ctx.prec, BITS
    try:
        _check(document, folder)
    except (TypeError, ValueError, KeyError, IndexError, AttributeError, OverflowError, RecursionError) as error:
        raise MalformedError(f"not in this format: {type(error).__name__}: {error}") from error
    finally:
        ctx.prec = precision
    return document


def _check(document: dict[str, Any], folder: Path | None) -> None:
    statement, claims = document["statement"], document["claims"]
    for name, expected in statement["files"].items() if folder else ():
        if Path(name).name != name or not (folder / name).is_file():
            raise RefusedError(f"another mechanism: {folder} has no file {name}")
        if hashlib.sha256((folder / name).read_bytes()).hexdigest() != expected:
            raise RefusedError(f"another mechanism or version: {folder / name} is not the file it was made for")
        if folder and name != CLOSED_FORM:
            closes(document, (folder / name).read_text(encoding="utf-8"))
    coordinates, is_path = names(statement["coordinates"]), document["kind"] == "path"
    boxes = [_box(pairs, len(coordinates)) for pairs in (statement["boxes"] if is_path else [statement["box"]])]
    if is_path:
        _covered(statement, boxes)
    proved = _proved(Program(document["program"], coordinates), coordinates, boxes, document["proof"])
    stated = {name: proved[name] for name in CLAIMS[document["kind"]]}
    if json.dumps(claims, sort_keys=True) != json.dumps(stated, sort_keys=True):  # where true is not 1
        raise RefusedError(f"{claims} is claimed, {stated} is proved")
    if is_path and proved["regular"] != "yes":
        raise RefusedError("not every box of the path is reached and free of singularities")


def _box(pairs: list[list[str]], count: int) -> Box:
    ends = [numbers(pair) for pair in pairs]
    low, high = [a for a, _ in ends], [b for _, b in ends]
    if not all(a < b for a, b in ends) or not len(ends) == count > 0:
        raise ValueError("a box that is empty or reversed, or one of other coordinates")
    return low, high


def _covered(statement: dict[str, Any], boxes: list[Box]) -> None:
    """Both ends of every piece lie in its box, which is convex: so all of the piece does. Floats compare exactly."""
    points = [numbers(point) for point in statement["points"]]
    if not len(points) == len(boxes) + 1 > 1:
        raise ValueError(f"a path of {len(points)} vertices in {len(boxes)} boxes")
    if (statement["points"][0], statement["points"][-1]) != (statement["from"], statement["to"]):
        raise RefusedError("the path does not lead from the one pose to the other")
    for k, (low, high) in enumerate(boxes):
        ends = (value for point in points[k : k + 2] for value in zip(low, point, high, strict=True))
        if not all(a <= value <= b for a, value, b in ends):
            raise RefusedError(f"piece {k + 1} of the path, of {len(boxes)}, does not lie in its box")


def _proved(program: Program, coordinates: list[str], boxes: list[Box], proof: str) -> dict[str, Any]:
    """Everything that the leaves prove together."""
    tokens = TOKEN.findall(proof)
    if sum(map(len, tokens)) != len(proof):
        raise ValueError("the proof has signs that no proof has")
    stack, count, signs = boxes[::-1], Counter[str](), set[tuple[int, bool]]()
    inner: list[Box] = []
    volume = dict.fromkeys(LEAVES, fmpq(0))
    for place, token in enumerate(tokens, 1):
        if not stack:
            raise ValueError(f"the proof goes on after its end, with part {place} of {len(tokens)}")
        low, high = box = stack.pop()
        if token.isdigit():
            stack.extend(_halves(low, high, int(token)))
            continue
        if not _holds(program, box, token, signs):
            where = ", ".join(f"{n} {a:.9g} .. {b:.9g}" for n, a, b in zip(coordinates, low, high, strict=True))
            raise RefusedError(f"part {place} of {len(tokens)} does not hold: {LEAVES[token[0]]} for {where}")
        count[token[0]] += 1
        inner.extend([box] if token == "i" else [])
        sides = (fmpq(*b.as_integer_ratio()) - fmpq(*a.as_integer_ratio()) for a, b in zip(low, high, strict=True))
        volume[token[0]] += math.prod(sides, start=fmpq(1))
    if stack:
        raise ValueError(f"the proof is cut short: {len(stack)} boxes are without an answer")
    inside = volume["i"] + volume["r"]
    reached = "no" if count["o"] else "open" if count["b"] else "yes"
    both = [k for k, positive in sorted(signs) if positive and (k, False) in signs and reached == "yes"]
    vanishes = any(all(program.over(box, [k]) for box in inner) for k in both)  # continuous, so zero somewhere
    return {
        "leaves": {name: count[key] for key, name in LEAVES.items()},
        "volume": [_below(inside).hex(), (-_below(-inside - volume["b"])).hex()],
        "regular_volume": _below(volume["r"]).hex(),
        "reached": reached,
        "regular": "no" if vanishes else "yes" if reached == "yes" and not count["i"] else "open",
    }


def _halves(low: list[float], high: list[float], axis: int) -> tuple[Box, Box]:
    """The upper half, and the lower one, which comes off the stack first."""
    middle = 0.5 * low[axis] + 0.5 * high[axis]
    if not low[axis] < middle < high[axis]:
        raise ValueError("the proof halves a box that has no float inside")
    after = slice(axis + 1, None)
    return ([*low[:axis], middle, *low[after]], high), (low, [*high[:axis], middle, *high[after]])


def _holds(program: Program, box: Box, token: str, signs: set[tuple[int, bool]]) -> bool:
    """Whether a leaf is proved; signs of the factors of a regular one are noted."""
    if token == "b":
        return True
    if token[0] == "o":
        values = program.over(box, [program.margins[int(token[1:], 16)]], strict=False)
        return values is not None and bool(values[0][1] < 0)
    factors = program.factors if token == "r" else []
    wanted = [*program.margins, *factors, *program.nonzero]
    values = program.over(box, [*wanted, *program.joints])  # the joints, too, have values: the graph is assembled
    if values is None:
        return False
    margins, others = values[: len(program.margins)], values[len(program.margins) : len(wanted)]
    signs.update((k, bool(value[0] > 0)) for k, value in zip(factors, others, strict=False))
    return all(margin[0] >= 0 for margin in margins) and all(map(nonzero, others))


def _below(value: fmpq) -> float:
    """The largest float that is not above an exact number."""
    exact = Fraction(int(value.p), int(value.q))
    rounded = float(exact)
    return rounded if Fraction(rounded) <= exact else math.nextafter(rounded, -math.inf)

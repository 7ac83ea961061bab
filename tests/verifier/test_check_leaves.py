"""Certificates of one leaf, written by hand, whose claims fit what the leaf says: it holds or is refused for itself."""

import hashlib
import json

import pytest

from assur.verifier.check import verify
from assur.verifier.reading import RefusedError
from hand_certificates import NO_JOINTS, UNPROVED

X, ONE, LAST = 0, 1, 2
"""Entries of the program: the coordinate, the number 1, and an operation on them."""


def by_hand(box, leaf, operation, *, margin=ONE, nonzero=None, factor=ONE):
    """A certificate of one box of x and one leaf; its margin, what must not be zero and its factor are entries."""
    one = (1.0).hex()
    files = dict.fromkeys(("hand.toml", "closed_form.py"), "0" * 64)
    statement = {"mechanism": "hand", "files": files, "parameters": {}, "mode": "", "strokes": {}, "held": {}}
    leaves = {name: int(name[0] == leaf[0]) for name in ("inside", "regular", "outside")}
    document = {
        **{"format": "assur certificate", "version": 3, "kind": "box", "made_by": "hand", "exact": UNPROVED},
        "statement": {**statement, "coordinates": ["x"], "box": [[float(end).hex() for end in box]]},
        "program": {
            "operations": [["coordinate", "x"], ["number", one, one, "one"], operation],
            "margins": [["m", margin]],
            "nonzero": [] if nonzero is None else [["n", nonzero]],
            "factors": [["f", factor]],
            **NO_JOINTS,
        },
        "claims": {
            "leaves": {**leaves, "open": int(leaf == "b")},
            "reached": {"o": "no", "b": "open"}.get(leaf[0], "yes"),
            "regular": "yes" if leaf == "r" else "open",
        },
        "proof": leaf,
    }
    text = json.dumps(document, sort_keys=True, separators=(",", ":"))
    return json.dumps({**document, "sha256": hashlib.sha256(text.encode()).hexdigest()}).encode()


KEPT = ["+", X, X]
"""An operation that changes nothing of what is asked: twice x."""

CASES = {
    "a margin that is nowhere negative": ((0, 1), "i", KEPT, {"margin": LAST}, True),
    "a margin that may be negative": ((-1, 1), "i", KEPT, {"margin": LAST}, False),
    "a margin that is a little negative": ((-1e-300, 1), "i", KEPT, {"margin": LAST}, False),
    "a margin that is negative everywhere": ((-2, -1), "o00", KEPT, {"margin": LAST}, True),
    "a margin that is zero at an end": ((-1, 0), "o00", KEPT, {"margin": LAST}, False),
    "a margin that may be positive": ((-1, 1), "o00", KEPT, {"margin": LAST}, False),
    "a margin that divides by what may be zero": ((-1, 1), "o00", ["/", ONE, X], {"margin": LAST}, False),
    "a margin that divides by what is negative": ((-2, -1), "o00", ["/", ONE, X], {"margin": LAST}, True),
    "a root that may have no value": ((-1, 1), "i", ["root", X], {"margin": LAST}, False),
    "a root that has one": ((0, 1), "i", ["root", X], {"margin": LAST}, True),
    "a divisor that is away from zero": ((1, 2), "i", KEPT, {"nonzero": LAST}, True),
    "a divisor that may be zero": ((-1, 1), "i", KEPT, {"nonzero": LAST}, False),
    "a divisor that is zero at an end": ((0, 1), "i", KEPT, {"nonzero": LAST}, False),
    "a factor that is positive": ((1, 2), "r", KEPT, {"factor": LAST}, True),
    "a factor that is negative": ((-2, -1), "r", KEPT, {"factor": LAST}, True),
    "a factor that may be zero": ((-1, 1), "r", KEPT, {"factor": LAST}, False),
    "a factor that is zero at an end": ((-1, 0), "r", KEPT, {"factor": LAST}, False),
    "a factor that is not asked for": ((-1, 1), "i", KEPT, {"factor": LAST}, True),
    "a difference that may be negative": ((0.5, 1.5), "i", ["-", X, ONE], {"margin": LAST}, False),
    "a difference that is not": ((1, 1.5), "i", ["-", X, ONE], {"margin": LAST}, True),
    "a box that is left open": ((-1, 1), "b", KEPT, {"margin": LAST}, True),
}


@pytest.mark.parametrize("name", CASES)
def test_a_leaf_holds_or_is_refused_for_itself(name):
    box, leaf, operation, wanted, holds = CASES[name]
    content = by_hand(box, leaf, operation, **wanted)
    if holds:
        assert verify(content)["proof"] == leaf
    else:
        with pytest.raises(RefusedError, match="part 1 of 1 does not hold"):
            verify(content)

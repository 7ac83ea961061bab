"""Drafts of one's own, each drawn in another way: what a reader might draft, in no catalogue."""

from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import assur
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chains

DRAFTS = {
    "a hybrid": parse_chains(["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]"]),
    "a hybrid with parallelograms": parse_chains(
        ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[y] P(4R)[x]"]
    ),
    "a SCARA of four limbs": parse_chains(["R[z] R[z] R[z] P[z]"] * 4),
    "ball joints on upright rails": parse_chains(["P[z] U S"] * 6),
    "legs that grow longer": parse_chains(["U P S"] * 6),
    "a passive leg": parse_chains(["U P S", "U P S", "U P S", "U P"]),
    "cranks in a plane": parse_chains(["R[z] R[z] R[z]"] * 3),
    "rails along three axes": parse_chains(["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"]),
    "planar joints": parse_chains(["P[x] E[x]", "P[y] E[y]", "P[z] E[z]"]),
    "cranks and universal joints": parse_chains(["R[y] U S"] * 6),
    "parallelograms along upright rails": repeated("P[z] P(4R)[x] R[z]", 2),
    "parallelograms along the pins of cranks": repeated("R[y] P(4R)[x] R[y] R[y]", 3),
    "a wrist driven about one axis": repeated("R[z]@O R[0.8,0,0.6]@O R[0,0.8,0.6]@O", 3),
    "legs with cylindrical joints": repeated("U C U", 6),
}


@cache
def draft(what):
    """The draft, loaded; made once in a process."""
    path = Path(mkdtemp()) / "own.toml"
    path.write_text(drafted(DRAFTS[what], path).text, encoding="utf-8")
    return assur.load(path)

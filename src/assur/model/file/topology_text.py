"""Writes a topology file: the text from which the reader reads the same description."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from assur.model.file.kind import KIND
from assur.model.topology_description import Counts, Declared, TopologyDescription
from assur.topology.notation import plain_text


def topology_text(description: TopologyDescription) -> str:
    r"""The text of a topology file.

    Each chain is written as it was read, or in the plain form if it was not read from a text.

    Example:
        >>> from assur.topology.notation import parse_chains
        >>> print(topology_text(TopologyDescription("arm", parse_chains(["R[z] P[z]"]), actuate=((1, 2),))))
        format = 1
        kind = "topology"
        name = "arm"
        chains = [
          "R[z] P[z]",
        ]
        actuate = ["1.2"]
        <BLANKLINE>
    """
    lines = ["format = 1", f"kind = {_quoted(KIND)}", f"name = {_quoted(description.name)}"]
    texts = {"title": description.title, "source": description.source, "note": description.note}
    lines += [f"{key} = {_quoted(text)}" for key, text in texts.items() if text]
    lines += ["chains = [", *(f"  {_quoted(chain.text or plain_text(chain))}," for chain in description.chains), "]"]
    if description.actuate:
        lines.append(f"actuate = {_list(_quoted(f'{limb}.{joint}') for limb, joint in description.actuate)}")
    if description.mode != "home":
        lines.append(f"mode = {_quoted(description.mode)}")
    facts = list(_declared(description.declared))
    return "\n".join([*lines, *(["", "[declared]", *facts] if facts else []), ""])


def _declared(facts: Declared) -> Iterator[str]:
    """The lines of the table of declared facts."""
    values = {
        "poc": None if facts.poc is None else _poc(facts.poc),
        "dim": facts.dim,
        "dof": facts.dof,
        "xi": None if facts.xi is None else list(facts.xi),
        "coupling_degree": facts.coupling_degree,
        "limbs": None if facts.limbs is None else _list(map(_poc, facts.limbs)),
        "limb_dims": None if facts.limb_dims is None else list(facts.limb_dims),
        "redundant_constraints": facts.redundant_constraints and _both(facts.redundant_constraints),
        "internal_freedoms": facts.internal_freedoms and _both(facts.internal_freedoms),
        "source": _quoted(facts.source) if facts.source else None,
    }
    return (f"{key} = {value}" for key, value in values.items() if value is not None)


def _poc(counts: Counts) -> str:
    return _quoted(f"t{counts[0]} r{counts[1]}")


def _both(counts: tuple[int, int]) -> str:
    return f"{{ collapsed = {counts[0]}, joint_graph = {counts[1]} }}"


def _list(items: Iterable[str]) -> str:
    return f"[{', '.join(items)}]"


def _quoted(text: str) -> str:
    """A basic string of TOML: that of JSON, but for one character."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")

"""What `assur topology` says: the characteristics, the derivation, then part by part what these do not say yet."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from textwrap import wrap

from rich.console import RenderableType
from rich.padding import Padding

from assur.cli.ascii_text import ascii_rule, ascii_text
from assur.cli.options import Outcome
from assur.cli.output import Verbatim, console, heading, table
from assur.improved_topology import zeros
from assur.results.answers.topology import Improvement, MetMode
from assur.results.plain_text import count, signed
from assur.topology.answers import answers, replacements_by_kind
from assur.topology.characteristics import characteristics
from assur.topology.facts import Known, Topology
from assur.topology.met_modes import NOT_ALL

Said = Callable[[str], str]
"""A text as it is printed: as it is, or in plain letters."""

_LONG = re.compile(r"-?\d+\.\d{5,}")

LISTED = 20
"""Neighbours that are printed."""

WIDEST = 12
"""Letters of the longest name of a characteristic."""

KNOWN = {"both": "rules and twists", "twists": "twists alone"}


def shortened(text: str) -> str:
    """A chain with four digits of its directions, for reading.

    >>> shortened("R[0.8660254037844386,-0.5,0]")
    'R[0.866,-0.5,0]'
    """
    return _LONG.sub(lambda number: f"{float(number[0]):.4g}", text)


@dataclass(frozen=True)
class BesideFacts:
    """What was asked for beside the facts: drawings of graph and limbs, operation modes, neighbours; None where not."""

    graph: Path | None = None
    sketch: Path | None = None
    modes: tuple[MetMode, ...] | None = None
    improvements: tuple[Improvement, ...] | None = None


def outcome(topology: Topology, also: BesideFacts, *, latex: bool, ascii_only: bool) -> Outcome:
    """The answer, with what else was asked for; drawings are written where a path is given."""
    data = answers(topology)
    if also.modes is not None:
        data = replace(data, modes=also.modes, notes=(*data.notes, NOT_ALL))
    if also.improvements is not None:
        data = replace(data, improvements=also.improvements)
    wrong = 1 if any(note.startswith("declared ") for note in topology.notes) else 0  # a claim of the file fails
    if also.graph is not None:
        _draw(topology, "graph", also.graph)
        data = replace(data, graph=str(also.graph))
    if also.sketch is not None:
        _draw(topology, "sketch", also.sketch)
        data = replace(data, sketch=str(also.sketch))
    if latex:
        from assur.topology.latex import fragment

        text = fragment(topology)
        return Outcome(replace(data, latex=text), lambda: [Verbatim(text)], wrong)
    return Outcome(data, lambda: _shown(topology, also, ascii_only=ascii_only), wrong)


def _draw(topology: Topology, name: str, path: Path) -> None:
    from assur.figures.encode import encoded
    from assur.figures.graph import graph_drawing
    from assur.figures.spatial_sketch import sketch_drawing
    from assur.figures.style import styled
    from assur.results.files import write_whole

    with styled():
        if name == "graph":
            drawing = graph_drawing(topology.linkage, topology.loops, topology.assur_chains)
        else:
            drawing = sketch_drawing(topology.linkage)
    write_whole(path, encoded(drawing.figure, path.suffix.lower()[1:]))


def _shown(topology: Topology, also: BesideFacts, *, ascii_only: bool) -> Iterable[RenderableType]:
    say: Said = ascii_text if ascii_only else str
    yield heading(say(_title(topology)))
    yield from _characteristics(topology, say)
    parts = {title: part(topology, say) for title, part in PARTS.items()}
    if also.modes is not None:
        parts["operation modes"] = _modes(also.modes, say)
    if also.improvements is not None:
        parts["neighbours with the same motion"] = _improvements(topology, also.improvements, say)
    for title, part in parts.items():
        lines = list(part)
        if lines:
            yield ""
            yield heading(title)
            yield from map(ascii_rule, lines) if ascii_only else lines
    yield from (f"written: {path}" for path in (also.graph, also.sketch) if path is not None)


def _improvements(topology: Topology, better: tuple[Improvement, ...], say: Said) -> Iterator[RenderableType]:
    if not better:
        yield "no single change that was tried makes it better"
        return
    rows = [
        (say(item.change), str(item.coupling_degree), str(item.redundant_constraints.joint_graph), str(item.zeros))
        for item in better[:LISTED]
    ]
    yield table(("change", say("κ"), "redundant", "zeros"), rows, left=("change",), wrap=("change",))
    more = f"; {len(better) - LISTED} more in --json" if len(better) > LISTED else ""
    own = (topology.coupling_degree, topology.redundant_constraints.joint_graph, zeros(topology))
    degree, redundant, unused = ("-" if number is None else str(number) for number in own)
    yield say(f"as it is: κ {degree}, redundant {redundant} of all joints, zeros {unused} of the decoupling{more}")
    yield Verbatim(f"the first: assur topology {_written(better[0])}")


def _written(improvement: Improvement) -> str:
    """The options that ask for a neighbour."""
    chains = " ".join(f'--chain "{text}"' for text in improvement.chains)
    return f"{chains} --actuate {','.join(improvement.actuate)}"


def _modes(modes: tuple[MetMode, ...], say: Said) -> Iterator[RenderableType]:
    names = ("mode", say("POC set"), "dim", "F", say("κ"), "at home", "meets", "crossed")
    rows = [
        (
            mode.name,
            say(mode.poc.text),
            str(mode.poc.dim),
            str(mode.dof),
            "-" if mode.coupling_degree is None else str(mode.coupling_degree),
            "yes" if mode.at_home else "",
            ", ".join(f"{other.mode} at home" if other.at_home else other.mode for other in mode.meets),
            ", ".join(mode.crossed),
        )
        for mode in modes
    ]
    yield table(names, rows)
    yield say(f"{NOT_ALL}.")
    if any(mode.coupling_degree is None for mode in modes):
        yield say("κ -: the drives do not fix that mode.")


def _title(topology: Topology) -> str:
    """The name and the title; of chains that have none, how many they are."""
    parts = [part for part in (topology.name, topology.title) if part]
    count_of_limbs = {0: "a joint graph without limbs", 1: "one chain"}.get(len(topology.limbs))
    return ": ".join(parts) or count_of_limbs or f"{len(topology.limbs)} limbs"


def _characteristics(topology: Topology, say: Said) -> Iterator[str]:
    """What a reader came for, one row each."""
    room = console().width - WIDEST - 1
    for row in characteristics(topology):
        names = (say(row.name), *[""] * len(row.text))
        for name, line in zip(names, wrap(say(row.text), room, break_on_hyphens=False), strict=False):
            yield f"{name:<{WIDEST}} {line}"


def _derivation(topology: Topology, say: Said) -> Iterator[RenderableType]:
    """Lines as far in as they are, also where they are broken."""
    for derivation in topology.derivations:
        for line in derivation.text("unicode").splitlines():
            text = line.lstrip()
            yield Padding(say(text), (0, 0, 0, len(line) - len(text)), expand=False)
    if len(topology.limbs) != 1:  # of one chain alone it stands below the table of limbs
        yield from map(say, _refused("the platform", topology.known))


def _limbs(topology: Topology, say: Said) -> Iterator[RenderableType]:
    if topology.limbs:
        yield table(
            ("limb", "chain", "POC set", "dim", "dep.", "known by"),
            [
                (
                    str(number),
                    say(shortened(limb.text)),
                    say(str(limb.poc)),
                    str(limb.poc.dim),
                    str(limb.poc.dependent),
                    KNOWN[limb.known.route],
                )
                for number, limb in enumerate(topology.limbs, 1)
            ],
            left=("limb", "chain", "POC set", "known by"),
            wrap=("chain", "known by"),
        )
    else:
        yield "The graph has no limbs in the sense of POC theory: it does not reduce in series and in parallel."
    for number, limb in enumerate(topology.limbs, 1):
        yield from map(say, _refused(f"limb {number}", limb.known))


def _refused(name: str, known: Known) -> Iterator[str]:
    if known.refusal:
        yield f"{name}: the rules give no answer, because {known.refusal}; the twists say {known.poc}."


def _loops(topology: Topology, say: Said) -> Iterator[RenderableType]:
    if not topology.loops:
        return
    internal = ["internal"] if any(loop.internal for loop in topology.loops) else []
    yield table(
        ("loop", "joints that it adds", say("Σf"), *internal, "I", say("ξ"), say("Δ"), "redundant"),
        [
            (
                str(number),
                " ".join(loop.joints),
                str(loop.freedoms),
                *([str(loop.internal)] if internal else []),
                str(loop.inputs),
                str(loop.xi),
                signed(loop.delta),
                str(loop.redundant_constraints),
            )
            for number, loop in enumerate(topology.loops, 1)
        ],
        left=("joints that it adds",),
    )
    inside = topology.redundant_by_loop[len(topology.loops) :]
    if inside:
        yield "redundant inside parallelograms: " + ", ".join(f"{name} {count}" for name, count in inside)


def _plan(topology: Topology, say: Said) -> Iterator[RenderableType]:
    yield from map(say, topology.plan.words)


def _decoupling(topology: Topology, say: Said) -> Iterator[RenderableType]:
    matrix = topology.decoupling
    if matrix is None and not topology.loops:
        return
    if matrix is None and topology.decoupling_refusal:
        yield say(f"No answer: {topology.decoupling_refusal}.")
        return
    if matrix is None:
        yield say(f"The inputs do not determine the platform: {topology.actuation}.")
        return
    if all(map(all, matrix.depends)):  # coupled throughout, as the characteristics say
        return
    yield table(
        ("output", *matrix.inputs),
        [
            (name, *(say("×") if used else say("·") for used in row))
            for name, row in zip(matrix.outputs, matrix.depends, strict=True)
        ],
        left=("output",),
    )
    yield say("× depends on the input, · does not.")


def _actuation(topology: Topology, say: Said) -> Iterator[RenderableType]:
    if not topology.loops and topology.decoupling is None:
        return
    asked = topology.actuation
    if asked.verdict != "valid":
        yield say(f"{asked}.")
    for part in topology.determining:
        follows = f"; {', '.join(part.following)} {'follows' if len(part.following) == 1 else 'follow'}"
        yield say(f"determined by {part}{follows}")
    if asked.verdict == "redundant":
        yield say(f"preload: {count(asked.redundancy, 'dimension')} in {', '.join(asked.superfluous)}")
    yield f"may be actuated: {', '.join(asked.in_some) or 'none'}"
    if asked.in_every:
        yield f"in every admissible set: {', '.join(asked.in_every)}"


def _joints(topology: Topology, say: Said) -> Iterator[RenderableType]:
    if topology.internal_joints:
        moved = "; ".join(" ".join(joints) for joints in topology.internal_joints)
        yield say(f"joints that move with platform and inputs at rest: {moved}")


def _relaxation(topology: Topology, say: Said) -> Iterator[RenderableType]:
    if topology.is_shaky:
        yield say(f"No answer: {topology.plan.shaky}.")
        return
    asked = topology.relaxation
    if not asked.redundant:
        return
    if not asked.single:
        yield f"no joint can be relaxed to remove any of the {asked.redundant} without changing the motion"
        return
    yield table(
        ("a joint", "removes", "spins", "any one of"),
        [
            (f"{item.old} to {item.new}", str(item.removed), str(item.internal), " ".join(names))
            for item, names in replacements_by_kind(topology)
        ],
        left=("a joint", "any one of"),
    )


def _notes(topology: Topology, say: Said) -> Iterator[RenderableType]:
    yield from map(say, topology.notes)


PARTS: dict[str, Callable[[Topology, Said], Iterator[RenderableType]]] = {
    "derivation": _derivation,
    "limbs": _limbs,
    "loops in the order that attains the coupling degree": _loops,
    "what that means for the direct problem": _plan,
    "decoupling": _decoupling,
    "actuators": _actuation,
    "joints": _joints,
    "joints that could be relaxed, against redundant constraints": _relaxation,
    "notes": _notes,
}
"""In the order of the theory."""

"""How the answer to a direct or an inverse problem reads, and what exit code it gives."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from math import prod
from typing import TYPE_CHECKING

from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.kinematics.answers.answer import answer
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.answers.style import Style, given_words, style_of, texts_of, titles_of
from assur.kinematics.modes import TURNED
from assur.kinematics.naming import described_signs
from assur.mechanism import Mechanism
from assur.results.answers.position import (
    DirectAnswer,
    InputsSolution,
    InverseAnswer,
    ListedSolution,
    NegativeQuantity,
    PoseSolution,
)
from assur.results.plain_text import count, short, tiny

if TYPE_CHECKING:
    from assur.results.answers.certified import BoundedSolution, CertifiedDirect, CertifiedInverse

    CertifiedPositions = CertifiedDirect | CertifiedInverse

Positions = DirectAnswer | InverseAnswer

ROWS = 16
"""Solutions that are listed; more are shown by limbs where these are known."""

MOST_ROWS = 64
"""Solutions that are listed where these are not; Dietmaier's platform has 40, a limb of a screw hundreds."""

LETTERS = "a letter for each solution, which is not kept along paths"
"""How modes read where no sign tells them apart."""


def outcome(record: Mechanism, solutions: SolutionSet, *, whole: bool = False) -> Outcome:
    """The outcome of one problem; `whole` lists every row where limbs could be listed in their place.

    Exit code 4 where it is proved that no solution exists, 5 where that is undecided, 3 where one is not closed.
    """
    data = answer(solutions)
    return Outcome(
        data, lambda: _shown(record, data, solutions.candidates, whole=whole), exit_codes.of_status(data.status)
    )


def lines(record: Mechanism, solutions: SolutionSet) -> Iterable[RenderableType]:
    """An answer as a person reads it."""
    return _shown(record, answer(solutions), solutions.candidates, whole=True)


def _shown(record: Mechanism, data: Positions, branches: int, *, whole: bool) -> Iterable[RenderableType]:
    style = style_of(record)
    yield heading(f"{data.mechanism}, {data.problem}: {_headline(record, data, branches)}")
    yield f"at {given_words(record, style, data.given, direct=data.problem == 'direct')}"
    yield ""
    if isinstance(data, InverseAnswer) and data.limbs and len(data.solutions) > ROWS and not whole:
        yield from _by_limbs(record, data, style)
    elif data.solutions:
        listed = data.solutions if whole else data.solutions[:MOST_ROWS]
        yield _solutions(record, data, listed, style)
        if len(listed) < len(data.solutions):
            yield f"These are the {len(listed)} nearest to home of {len(data.solutions)}; --json lists them all."
        yield from exceeded(data)
        yield from _open_loops(data)
        yield from _remarks(data)
        yield from _parasitic(style, data.solutions)
        if isinstance(data, DirectAnswer):
            yield from _following(record, data.solutions, style)
    if data.curves:
        yield from _curves(data, style)
    if data.failures:
        yield failures(data.failures)
    if data.of_one_mode and data.status == "unreachable":
        yield other_modes(data.known_modes)
    yield _completeness(record, data)
    if data.architecture:
        yield f"It is {data.architecture}."
    if data.solutions and not data.limits_stated:
        yield "No limits are stated."
    yield from _modes(record, data)


def _by_limbs(record: Mechanism, data: InverseAnswer, style: Style) -> Iterable[RenderableType]:
    """The ways of each limb in place of their product, and the row of home."""
    own = _own_row(record, data)
    if own is not None:
        yield _solutions(record, data, [own], style)
    many = _many(data)
    listed = "them" if many == len(data.solutions) else f"{len(data.solutions)} of them near home"
    yield f"All {many} are one way of each limb; --all lists {listed}:"
    driven = zip(data.input_names, record.drives, strict=True)
    units = {name: record.angle if one.coordinate.kind == "angle" else record.unit for name, one in driven}
    rows = []
    for limb in data.limbs:
        texts = [
            ", ".join(f"{name} = {short(value)} {units[name]}" for name, value in way.items()) for way in limb.ways
        ]
        rows.append((", ".join(limb.joints), str(len(limb.ways)), "\n".join(dict.fromkeys(filter(None, texts)))))
    yield table(("limb", "ways", "inputs"), rows, left=("limb", "inputs"))


def _many(data: InverseAnswer) -> int:
    """How many choices of one way of each limb there are."""
    return prod(len(limb.ways) for limb in data.limbs)


def _headline(record: Mechanism, data: Positions, branches: int) -> str:
    """What the rows that answer say, that of home or of the file's own mode first."""
    among = f" among {count(branches, 'branch')}" if branches > 1 else " in this mode" if data.of_one_mode else ""
    found = count(len(data.solutions), "solution")
    if isinstance(data, InverseAnswer) and data.right.startswith("not all"):
        found, among = f"{_many(data)} solutions", " by each limb alone"
    if data.right.startswith("not proved") and not data.solutions and not data.curves:
        return "nothing was found, not proved"
    if data.status == "unreachable":
        return f"unreachable, no solution{among}"
    if data.curves:
        return f"self_motion, {count(len(data.curves), 'curve')} of poses{among}"
    if data.status == "not_closed" and all(item.status == "not_closed" for item in data.solutions):
        return f"not_closed, {count(len(data.solutions), 'row')}, none of them a solution"
    status, listed = data.status, Counter(item.status for item in data.solutions)
    if len(listed) == 1 or not listed:
        return f"{status}, {found}{among}"
    each = ", ".join(f"{number} {name}" for name, number in listed.most_common())
    own = _own_row(record, data)
    first = f"{own.status} in mode {own.mode}, " if own and own.status != status else ""
    return f"{first}{status} at worst, {found} ({each}){among}"


def _own_row(record: Mechanism, data: Positions) -> PoseSolution | InputsSolution | None:
    """The solution that is home, else that of the file's own mode; None where there is neither."""
    modes = record.modes
    default = modes.default_assembly if data.problem == "direct" else modes.default_working
    listed: Sequence[PoseSolution | InputsSolution] = data.solutions
    home = [item for item in listed if item.home]
    return next(iter(home + [item for item in listed if item.mode == default]), None)


def _solutions(
    record: Mechanism, data: Positions, listed: Sequence[PoseSolution | InputsSolution], style: Style
) -> RenderableType:
    direct = data.problem == "direct"
    rows = [
        (
            item.mode,
            *texts_of(record, style, item.numbers, direct=direct),
            item.other_mode,
            "yes" if item.home else "",
            item.status,
            tiny(item.residual),
            limits_cell(item),
        )
        for item in listed
    ]
    usual = [item.status == "regular" and not item.limits.outside for item in listed]
    other = "working" if direct else "assembly"
    columns = (
        "mode",
        *titles_of(record, style, direct=direct),
        other,
        "home",
        "status",
        f"gap [{style.unit}]",
        "limits",
    )
    told = [any(row[k] for row in rows) for k in range(len(columns))]
    told[-1] = data.limits_stated
    kept = [k for k in range(len(columns)) if told[k] or columns[k] not in ("working", "assembly", "home", "limits")]
    return table(
        [columns[k] for k in kept],
        [[row[k] for k in kept] for row in rows],
        left=("home", "status", "limits"),
        styles=["" if same else "yellow" for same in usual],
    )


def limits_cell(solution: ListedSolution | BoundedSolution) -> str:
    """The first limit that a solution exceeds, by how much, and how many more."""
    outside = solution.limits.outside
    if solution.limits.within is None:
        return ""
    if not outside:
        return "within"
    first = f"{outside[0].joint} {short(outside[0].by)} {outside[0].unit}"
    return f"{first} +{len(outside) - 1}" if len(outside) > 1 else first


def other_modes(known: Sequence[str]) -> str:
    """Where one mode has no solution, those that have."""
    if not known:
        return "there is no solution in any mode"
    more = f" and {len(known) - ROWS} more" if len(known) > ROWS else ""
    return f"there are solutions in the modes {', '.join(known[:ROWS])}{more}"


def exceeded(data: Positions | CertifiedPositions) -> Iterable[str | RenderableType]:
    """Which limits the solutions exceed, and by how much; once for all that do so alike."""
    modes: dict[tuple[str, ...], list[str]] = {}
    for item in data.solutions:
        for each in item.limits.outside:
            allowed = f"{short(each.low)} .. {short(each.high)}"
            by = f"{short(each.by)} {each.unit}"
            modes.setdefault((each.limit, short(each.value), allowed, by), []).append(item.mode)
    if modes:
        yield "Outside the limits of the file, which the equations do not know:"
        rows = [(*row, _listed(names, data)) for row, names in modes.items()]
        yield table(("limit", "value", "allowed", "outside by", "modes"), rows, left=("limit", "modes"))


def _open_loops(data: Positions) -> Iterable[str]:
    """Which loop solutions leave open, and by how much; once for all that do so alike."""
    modes: dict[str, list[str]] = {}
    for item in data.solutions:
        if item.status == "not_closed":
            loop = item.open_loop
            where = f"{loop.loop} stays open at {loop.joint}" if loop else "they answer another question"
            gap = loop.gap if loop else item.residual
            modes.setdefault(f"{where}, by {short(gap)} {data.unit}", []).append(item.mode)
    for text, names in modes.items():
        yield f"Not closed, so no solutions: {_listed(names, data)}: {text}"


def _remarks(data: Positions) -> Iterable[str]:
    """Rows that are one double solution, and angles of which only a sum or a difference counts."""
    for pair in data.doubles:
        first, second = pair.modes
        yield f"double: {first} and {second} are {tiny(pair.apart)} apart, one solution or two too near to tell"
    texts = list(dict.fromkeys(item.angles for item in data.solutions if item.angles))
    for text in texts:
        modes = [item.mode for item in data.solutions if item.angles == text]
        yield f"{_listed(modes, data)}: {text}; phi and psi are one choice of many"


def _listed(modes: list[str], data: Positions | CertifiedPositions) -> str:
    return "all" if len(modes) == len(data.solutions) else ", ".join(modes)


def _parasitic(style: Style, solutions: Iterable[PoseSolution | InputsSolution]) -> Iterable[RenderableType]:
    """Of every solution the platform's coordinates that the pose leaves out; nothing where none of them moves."""
    listed = [item for item in solutions if item.parasitic]
    if not listed:
        return
    names = tuple(listed[0].parasitic)
    yield "the platform's coordinates that the pose leaves out:"
    yield table(
        ("mode", *map(style.coordinate_title, names)),
        [(item.mode, *(style.coordinate(name, item.parasitic[name]) for name in names)) for item in listed],
    )


def _following(record: Mechanism, solutions: Iterable[PoseSolution], style: Style) -> Iterable[RenderableType]:
    """The redundant inputs at every pose; nothing where there are none."""
    if drives := record.redundant_inputs:
        yield "the inputs that follow:"
        yield table(
            ("mode", *(style.kind_title(item.name, item.coordinate.kind) for item in drives)),
            [
                (each.mode, *(style.kind(item.coordinate.kind, each.following[item.name]) for item in drives))
                for each in solutions
            ],
        )


def _curves(data: Positions, style: Style) -> Iterable[RenderableType]:
    yield "The platform moves while every input stands still, on"
    rows = []
    for curve in data.curves:
        low, high = curve.interval
        poses = curve.poses
        picked = (poses[0], poses[len(poses) // 2], poses[-1])
        points = "\n".join(style.point(data.coordinates, pose) for pose in picked)
        arc = f"{curve.parameter} = {style.number(low, angle=True)}\n.. {style.number(high, angle=True)}"
        rows.append((curve.mode, arc, points))
    yield table(
        ("mode", f"arc [{style.angle}]", f"start, middle, end {style.point_title(data.coordinates)}"),
        rows,
        left=("mode",),
    )


def failures(items: Sequence[NegativeQuantity]) -> RenderableType:
    """Why no solution exists: which quantity is negative and by how much, where it comes nearest to zero."""
    rows = [
        (
            f"{item.quantity} < 0",
            f"{short(item.value)} {item.unit}".strip(),
            item.meaning,
            str(item.branches),
        )
        for item in items
    ]
    return table(("negative", "at best", "which is", "branches"), rows, left=("negative", "which is"))


def _completeness(record: Mechanism, data: Positions) -> str:
    form = record.closed_form
    left_out = "crossed parallelograms are left out; --crossed adds them"
    if form is not None and "loops in turn" not in data.right:
        left_out = form.reduced_because
    because = f" ({left_out})" if left_out else ""
    reduced = data.complete_for == "reduced"
    model = f"the reduced model{because}" if reduced else "the joint graph"
    if data.status == "not_closed":
        return f"The formulas of {model} are wrong here: they give what the loops of the file do not allow."
    if data.status == "undecided" and form is not None and data.right.startswith("closed form"):
        return f"Undecided: the closed form of {model} degenerates here, and no curve of poses is known to it."
    right = data.right
    how = f": {right}" if right.startswith("all ") else f", by {right}"
    if data.complete:
        return f"Complete for {model}{how}."
    if right.startswith("not all"):
        return f"These are {right}."
    if right.startswith("not proved"):
        return f"Whether these are all is {right}."
    return f"Only this mode was asked for, of {model}{how}."


def _modes(record: Mechanism, data: Positions) -> Iterable[str]:
    """How the modes read: their signs, the letters after them, their crossed parallelograms."""
    texts = [item.mode for item in data.solutions]
    parts = [f"the signs of {', '.join(data.signs)}"] if data.signs else []
    if any(text.partition("~")[0].strip("+-0") for text in texts):
        parts.append("a letter where several share them, which is not kept along paths" if parts else LETTERS)
    after = {name for text in texts for name in text.split("~")[1:]}
    if after - {TURNED}:
        parts.append("after ~ a crossed parallelogram")
    if TURNED in after:
        parts.append(f"~{TURNED} where the platform has another orientation than about home, in another operation mode")
    yield f"mode: {', '.join(parts) or 'there is one'}"
    signs = described_signs(record, "direct" if data.problem == "direct" else "inverse") if data.signs else ()
    yield from (f"  {sign.said}" for sign in signs if not sign.written)
    if data.home_by:
        yield data.home_by

"""Whether kernels answer in the shape that their mechanism asks for: every input, joint, margin and factor by its name.

Each kernel is worked out once over recorded numbers, which have no values. So a slip of the pen is told with the line
of its function, before any analysis trips over it; whether the numbers are right is for the joint graph to say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from assur.errors import MechanismFileError, Problem
from assur.model.closed_form import Branch, ClosedForm, Eliminant, Margin, PolynomialSystem
from assur.model.file.faults import listed
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.kernels.values import TABLES, is_number, kind_of
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.recording.tape import Recorded, Recorder

OPERATIONS = 8_000
"""Of all kernels together: the longest closed form of the catalogue has 5,638. What is asked of each operation, as on
which others it depends, takes memory by the square of their number."""
Told = Iterator[tuple[str, str]]
"""What a kernel answers where it should answer otherwise, and what is allowed."""


@dataclass(frozen=True, eq=False)
class _Dry:
    """Recorded numbers in the place of everything that a kernel is given."""

    record: MechanismRecord
    ns: Recorder

    def number(self) -> Recorded:
        return self.ns.varying("")

    def pair(self) -> tuple[Recorded, Recorded]:
        return self.number(), self.number()

    @property
    def p(self) -> SimpleNamespace:
        return kernel_dimensions(self.record, lambda _: self.number())

    @property
    def pose(self) -> tuple[Any, ...]:
        return tuple(self.pair() if is_angle(name) else self.number() for name in self.record.platform.pose)

    @property
    def inputs(self) -> tuple[Any, ...]:
        return tuple(self.pair() if item.coordinate.kind == "angle" else self.number() for item in self.record.inputs)

    def signs(self, names: Iterable[str]) -> SimpleNamespace:
        return SimpleNamespace(**{name: self.number() for name in names})


def answer_faults(record: MechanismRecord, form: ClosedForm, path: Path) -> tuple[Problem, ...]:
    """What kernels answer in another shape than the mechanism asks for; nothing where all is well.

    Args:
        record: the mechanism.
        form: its closed form.
        path: the closed form's file.
    """
    record = record.with_closed_form(form, "")
    dry = _Dry(record, Recorder())
    ns, p = dry.ns, dry.p
    faults: list[Problem] = []

    def tried(kernel: Callable[..., Any], judge: Callable[[Any], Told], *given: Any) -> Any:
        """A kernel's answer, or None where it is not as it should be."""
        try:
            answer = kernel(*given)
        except MechanismFileError as error:
            faults.extend(error.problems)
            return None
        name = getattr(kernel, "name", None) or getattr(kernel, "__name__", "a kernel")
        line = getattr(kernel, "line", None)
        told = [
            Problem(str(path), line, "", f"{name} returns {what}", f"allowed: {allowed}")
            for what, allowed in judge(answer)
        ]
        faults.extend(told)
        return None if told else answer

    working = dry.signs(record.modes.working)
    branch = tried(form.inverse, partial(_branch, record, form, form.inverse_margins), ns, p, dry.pose, working)
    if branch is not None:
        tried(form.joints, partial(_joints, record), ns, p, branch.core)
        tried(form.factors, partial(_named, [item.name for item in form.factor_list], "factor"), ns, p, branch.core)
        for kernel in (form.jacobians, form.as_printed):
            if kernel is not None:
                tried(kernel, partial(_jacobians, record), ns, p, branch.core)
        if form.quantities is not None:
            tried(form.quantities, partial(_quantities, form), ns, p, branch.core)
        if form.constraints is not None:
            tried(form.constraints, _constraints, ns, p, branch.core, dry.inputs)
    _direct(dry, form, tried)
    if len(ns) > OPERATIONS:
        many = f"{len(ns)} different operations on numbers in all kernels"
        faults.append(Problem(str(path), None, "", many, f"allowed: {OPERATIONS}"))
    return tuple(dict.fromkeys(faults))


def _direct(dry: _Dry, form: ClosedForm, tried: Callable[..., Any]) -> None:
    """The kernels of the direct problem, of whichever kind."""
    judge, ns, p = partial(_branch, dry.record, form, form.direct_margins), dry.ns, dry.p
    if isinstance(form.direct, Eliminant):
        extra = [dry.signs(form.direct.signs)] if form.direct.signs else []
        tried(form.direct.coefficients, partial(_row, form.direct.roots + 1, "coefficients"), ns, p, dry.inputs, *extra)
        root = dry.pair() if form.direct.kind == "angle" else dry.number()
        tried(form.direct.back, judge, ns, p, dry.inputs, root, *extra)
        if form.direct.left_over is not None:
            tried(form.direct.left_over, _number, ns, p, dry.inputs, (*dry.pair(), 1), *extra)
    elif isinstance(form.direct, PolynomialSystem):
        unknowns = tuple(dry.number() for _ in form.direct.unknowns)
        count = len(unknowns)
        tried(form.direct.equations, partial(_row, count - 1, "equations"), ns, p, dry.inputs, unknowns)
        tried(form.direct.lift, partial(_row, count, "unknowns"), ns, p, dry.pose)
        tried(form.direct.finite, _number, unknowns)
        tried(form.direct.back, judge, ns, p, dry.inputs, unknowns)
    elif form.direct is not None:
        tried(form.direct, judge, ns, p, dry.inputs, dry.signs(dry.record.modes.assembly))
    if form.self_motion is not None:
        judge = partial(_branch, dry.record, form, ())
        signs = dry.signs(form.self_motion.signs)
        tried(form.self_motion.kernel, judge, ns, p, dry.inputs, dry.pair(), signs)


def _branch(record: MechanismRecord, form: ClosedForm, margins: Sequence[Margin], answer: Any) -> Told:
    if not isinstance(answer, Branch):
        yield kind_of(answer), "a Branch(pose, inputs, margins, core)"
        return
    yield from _components("pose", record.platform.pose, [is_angle(name) for name in record.platform.pose], answer.pose)
    angles = [item.coordinate.kind == "angle" for item in record.inputs]
    yield from _components("inputs", [item.name for item in record.inputs], angles, answer.inputs)
    yield from _named([item.name for item in margins], "margin", answer.margins)
    core: Any = answer.core  # whatever a kernel put there
    if not isinstance(core, SimpleNamespace):
        yield f"a core that is {kind_of(core)}", "a SimpleNamespace"
        return
    for name, sign in form.signs.items():
        value = getattr(core, sign.attribute, None)
        if value is None or not is_number(value):
            what = f"a core without '{sign.attribute}', of which '{name}' is the sign"
            yield what, f"one of {listed(vars(core))}"


def _components(what: str, names: Sequence[str], angles: Sequence[bool], values: Any) -> Told:
    if not isinstance(values, tuple | list) or len(values) != len(names):
        count = f"{len(values)} entries" if isinstance(values, tuple | list) else kind_of(values)
        yield f"{what} of {count}", f"one for each of {', '.join(names)}"
        return
    for name, angle, value in zip(names, angles, values, strict=True):
        if angle and not _is_pair(value):
            yield f"{what} in which {name} is {kind_of(value)}", "a pair (cosine, sine) for an angle"
        elif not angle and not is_number(value):
            yield f"{what} in which {name} is {kind_of(value)}", "a number for a length"


def _named(names: Sequence[str], what: str, values: Any) -> Told:
    if not isinstance(values, TABLES):
        yield f"{kind_of(values)} of {what}s", f"a table of {', '.join(names)}"
        return
    for name in names:
        if name not in values:
            yield f"no {what} '{name}'", f"each of {', '.join(names)}"
        elif not is_number(values[name]):
            yield f"a {what} '{name}' that is {kind_of(values[name])}", "a number"


def _joints(record: MechanismRecord, values: Any) -> Told:
    if not isinstance(values, TABLES):
        yield kind_of(values), "a table of joint values"
        return
    for name, joint in record.joints.items():
        if joint.type.ball:
            if not _is_rotation(values.get(name)):
                yield f"no rotation of joint '{name}'", "three rows of three numbers, the child against the parent"
        else:
            yield from _joint(name, joint, values)
    known = set(record.joints) | {
        f"{name}.{component}" for name, joint in record.joints.items() for component in joint.type.components
    }
    for name in values:
        if name not in known:
            yield f"a value of '{name}', which is no joint", f"a value for each joint: {listed(record.joints)}"


def _joint(name: str, joint: Joint, values: Mapping[str, Any]) -> Told:
    for component, kind in zip(joint.type.components, joint.type.kinds, strict=True):
        key = name if len(joint.type.components) == 1 and name in values else f"{name}.{component}"
        if key not in values:
            wanted = name if len(joint.type.components) == 1 else key
            yield f"no value of '{wanted}'", f"a value for each joint: {listed(values)} are there"
        elif kind == "angle" and not (_is_pair(values[key]) or (joint.type.screw and is_number(values[key]))):
            yield f"'{key}' as {kind_of(values[key])}", "a pair (cosine, sine) for an angle"
        elif kind == "length" and not is_number(values[key]):
            yield f"'{key}' as {kind_of(values[key])}", "a number for a length"


def _jacobians(record: MechanismRecord, answer: Any) -> Told:
    n = len(record.inputs)
    if not isinstance(answer, tuple | list) or len(answer) != 2:
        yield kind_of(answer), "a pair: rows of Jp, rows of Jq"
        return
    for name, rows in zip(("Jp", "Jq"), answer, strict=True):
        square = isinstance(rows, tuple | list) and all(isinstance(row, tuple | list) for row in rows)
        if not square or len(rows) != n or any(len(row) != n or not all(map(is_number, row)) for row in rows):
            yield f"{name} of another shape", f"{n} rows of {n} numbers"


def _quantities(form: ClosedForm, values: Any) -> Told:
    if not isinstance(values, TABLES):
        yield kind_of(values), "a table of quantities"
        return
    named = {item.name: item for item in form.quantity_list}
    for name in named.keys() ^ values.keys():
        yield f"{'no' if name in named else 'a'} quantity '{name}'", f"those of quantity_list: {listed(named)}"
    for name in named.keys() & values.keys():
        if not (_is_pair(values[name]) if named[name].kind == "angle" else is_number(values[name])):
            yield f"'{name}' as {kind_of(values[name])}", f"what its kind, {named[name].kind}, says"


def _constraints(values: Any) -> Told:
    if not isinstance(values, TABLES) or not all(_is_pair(value) for value in values.values()):
        yield "constraints of another shape", "a table of pairs (length that is needed, length that is there)"


def _row(count: int, what: str, values: Any) -> Told:
    if not isinstance(values, tuple | list) or len(values) != count or not all(map(is_number, values)):
        yield f"{what} of another shape", f"{count} numbers"


def _number(value: Any) -> Told:
    if not is_number(value):
        yield kind_of(value), "a number"


def _is_pair(value: Any) -> bool:
    return isinstance(value, tuple | list) and len(value) == 2 and all(map(is_number, value))


def _is_rotation(value: Any) -> bool:
    rows = isinstance(value, tuple | list) and len(value) == 3 and all(isinstance(row, tuple | list) for row in value)
    return rows and all(len(row) == 3 and all(map(is_number, row)) for row in value)

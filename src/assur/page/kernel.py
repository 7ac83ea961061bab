"""The kernel in the page: the recorded inverse problem of a closed form as JavaScript, with Python's bits.

A tape rounds after each of its operations, and IEEE 754 defines each of them; so the text that is written here gives
the same bits in a browser. Angles come in by `Math.cos` and `Math.sin`, which may differ from Python's in the last one.
"""

from __future__ import annotations

from assur.kinematics.closed_form.recorded import Recording, Row, recording
from assur.kinematics.modes import sign_names
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.recording.tape import Operation

WANTED = ("inputs", "factors")

_TEXT = {
    "+": "{0} + {1}",
    "-": "{0} - {1}",
    "*": "{0} * {1}",
    "/": "{0} / {1}",
    "negative": "-{0}",
    "magnitude": "Math.abs({0})",
    "root": "Math.sqrt({0} < 0 ? 0 : {0})",
    ">=": "{0} >= {1}",
    ">": "{0} > {1}",
    "and": "{0} && {1}",
    "not": "!{0}",
}


def kernel(record: MechanismRecord) -> str | None:
    """JavaScript source of a function that gives the factors and the printed inputs of one working mode at a pose.

    `function (pose, parameters, signs)`: pose (m,) in lengths and rad, parameters by name as kernels take them, signs
    (+1, -1) in the order of the working mode. It returns `{factors: {name: number}, inputs: [n numbers]}`, angles in
    rad; NaN where the mode does not reach the pose. None of a mechanism without closed form.

    >>> from assur.model.registry import load_record
    >>> text = kernel(load_record("fivebar"))
    >>> text.splitlines()[0]
    'function (pose, parameters, signs) {'
    """
    if record.closed_form is None:
        return None
    found = recording(record, "inverse", WANTED)
    lines = [*_statements(found), *_answer(found)]
    body = "\n".join(f"  {line}" for line in lines)
    return f"function (pose, parameters, signs) {{\n{body}\n}}"


def parameters(record: MechanismRecord) -> dict[str, float]:
    """The numbers that the kernel takes: dimensions by name, angles in rad."""
    return {name: float(value) for name, value in vars(record.values).items()}


def _statements(found: Recording) -> list[str]:
    varying, uniform = iter(_components(found.record)), iter(_uniform(found))
    lines = []
    for k, item in enumerate(found.tape.operations):
        if item.name == "varying":
            text = next(varying)
        elif item.name == "uniform":
            text = next(uniform)
        else:
            text = _operation(item)
        lines.append(f"const v{k} = {text};")
    return lines


def _operation(item: Operation) -> str:
    if item.name == "number":
        return repr(item.number).replace("inf", "Infinity").replace("nan", "NaN")
    return _TEXT[item.name].format(*(f"v{k}" for k in item.arguments))


def _components(record: MechanismRecord) -> list[str]:
    """What the tape is given of a pose, in its order: an angle as cosine and sine."""
    texts = []
    for k, name in enumerate(record.platform.pose):
        texts += [f"Math.cos(pose[{k}])", f"Math.sin(pose[{k}])"] if is_angle(name) else [f"pose[{k}]"]
    return texts


def _uniform(found: Recording) -> list[str]:
    signs = sign_names(found.record, "inverse")
    texts = []
    for name in found.tape.uniform:
        kind, _, own = name.partition(".")
        if kind == "p":
            texts.append(f'parameters["{own}"]')
        elif kind == "sign":
            texts.append(f"signs[{signs.index(own)}]")
        else:  # a tolerance of what decides whether a branch exists, which is not asked here
            texts.append("0")
    return texts


def _answer(found: Recording) -> list[str]:
    form = found.record.closed_form
    names = [item.name for item in form.factor_list] if form else []
    factors = ", ".join(
        f'"{name}": {_value(found, row)}' for name, row in zip(names, found.rows["factors"], strict=True)
    )
    inputs = ", ".join(_value(found, row) for row in found.rows["inputs"])
    return [f"return {{factors: {{{factors}}}, inputs: [{inputs}]}};"]


def _value(found: Recording, row: Row) -> str:
    places = [f"v{found.tape.outputs[name]}" for name in row.take]
    if row.finish != "angle":
        return places[0]
    cosine, sine = places
    plain = f"Math.atan2({sine}, {cosine})"
    return plain if (row.sign, row.offset) == (1.0, 0.0) else f"{row.sign!r} * {plain} + {row.offset!r}"

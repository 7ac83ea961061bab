"""The kernel in the page: the recorded inverse problem of a closed form as JavaScript, with Python's bits.

A tape rounds after each of its operations, and IEEE 754 defines each of them; so the text that is written here gives
the same bits in a browser. Angles come in by `Math.cos` and `Math.sin`, which may differ from Python's in the last one.
"""

from __future__ import annotations

from assur.kinematics.closed_form.recorded import AnswerRow, Recording, recording
from assur.kinematics.modes import sign_names
from assur.model.kernel_dimensions import dimension_numbers
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.recording.javascript import javascript

WANTED = ("inputs", "factors")


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
    targets = {name: [f"n[{k}]"] for k, name in enumerate(found.tape.outputs)}
    statements = javascript(found.tape, _components(record), _uniform(found), targets)
    body = "\n".join(["const n = [];", *statements, _answer(found)])
    return f"function (pose, parameters, signs) {{\n{body}\n}}"


def parameters(record: MechanismRecord) -> dict[str, float]:
    """The numbers that the kernel takes: dimensions by name, angles in rad."""
    return {name: float(value) for name, value in dimension_numbers(record).items()}


def _components(record: MechanismRecord) -> list[str]:
    """What the tape is given of a pose, in its order: an angle as cosine and sine."""
    texts = []
    for k, name in enumerate(record.platform.pose):
        texts += [f"Math.cos(pose[{k}])", f"Math.sin(pose[{k}])"] if is_angle(name) else [f"pose[{k}]"]
    return texts


def _uniform(recording: Recording) -> list[str]:
    signs = sign_names(recording.record, "inverse")
    texts = []
    for name in recording.tape.uniform:
        kind, _, own = name.partition(".")
        if kind == "p":
            texts.append(f'parameters["{own}"]')
        elif kind == "sign":
            texts.append(f"signs[{signs.index(own)}]")
        else:  # a tolerance of what decides whether a branch exists, which is not asked here
            texts.append("0")
    return texts


def _answer(recording: Recording) -> str:
    form = recording.record.closed_form
    names = [item.name for item in form.factor_list] if form else []
    factors = ", ".join(
        f'"{name}": {_value(recording, row)}' for name, row in zip(names, recording.rows["factors"], strict=True)
    )
    inputs = ", ".join(_value(recording, row) for row in recording.rows["inputs"])
    return f"return {{factors: {{{factors}}}, inputs: [{inputs}]}};"


def _value(recording: Recording, row: AnswerRow) -> str:
    order = list(recording.tape.outputs)
    places = [f"n[{order.index(name)}]" for name in row.take]
    if row.finish != "angle":
        return places[0]
    cosine, sine = places
    plain = f"Math.atan2({sine}, {cosine})"
    return plain if (row.sign, row.offset) == (1.0, 0.0) else f"{row.sign!r} * {plain} + {row.offset!r}"

"""A calibration as data, as a file and as a person reads it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.paths import output_file
from assur.errors import UsageError
from assur.kinematics.answers.at_border import mechanism_header
from assur.machine.calibration.fit import calibration
from assur.machine.calibration.measured import FRAME, Measured
from assur.mechanism import Mechanism
from assur.model.mechanism import Input
from assur.results.answers.calibration import CalibrationAnswer
from assur.results.files import write_whole
from assur.results.plain_text import short


def outcome(
    record: Mechanism,
    inputs: NDArray[np.float64],
    measured: Measured,
    readings: NDArray[np.float64],
    hold: Sequence[str],
    output: str | None,
    *,
    frame: bool,
) -> Outcome:
    """The best fit of readings (N, k) at inputs (N, n), in lengths and rad."""
    written = None if output is None else output_file(output, (".toml",))
    own = calibration(record, inputs, measured, readings, hold, frame=frame)
    if written is not None:
        text = record.file.read_text(encoding="utf-8")
        write_whole(written, changed(record, text, own.parameters))
    answer = CalibrationAnswer(
        **mechanism_header(record),
        measurements=len(readings),
        measured=measured.names,
        parameters=own.parameters,
        sigma=own.sigma,
        covariance=tuple(tuple(row) for row in own.covariance.tolist()),
        held=own.held,
        residual_before=own.before,
        residual_after=own.after,
        outliers=own.outliers,
        file=None if written is None else str(written),
        units={
            "parameters": f"dimensions in their units; added to inputs, and of the frame, in {record.unit} or rad",
            "sigma": "as parameters",
            "covariance": "products of those of parameters",
            "residual_before": f"{record.unit}, angles by the characteristic length",
            "residual_after": f"{record.unit}, angles by the characteristic length",
        },
    )
    return Outcome(answer, lambda: _shown(record, answer))


def changed(record: Mechanism, text: str, parameters: Mapping[str, float]) -> str:
    """The text of a mechanism's file with other numbers of dimensions, and offsets of inputs.

    A dimension that was a formula becomes the number that it is found to be; inputs of a template of limbs get a list.

    Errors:
        UsageError: a number that does not stand on a line of its own table.
    """
    for name, value in parameters.items():
        if name in record.parameters:
            text = _replaced(text, "parameters", name, "value", repr(value))
    moved = [item for item in record.inputs if parameters.get(item.name)]
    templates = re.findall(r"^\[limbs\.([\w-]+)\.inputs\]", text, re.MULTILINE)
    for item in moved:
        label = record.coordinate_label(item.coordinate)
        limb, _, local = label.rpartition(".")
        own = [name for name in templates if re.fullmatch(rf"{re.escape(name)}\d+", limb)]
        if own:
            alike = re.compile(rf"{re.escape(own[0])}\d+\.{re.escape(local)}")
            every = [part for part in record.inputs if alike.fullmatch(record.coordinate_label(part.coordinate))]
            offsets = ", ".join(repr(_offset(record, part, parameters.get(part.name, 0.0))) for part in every)
            text = _replaced(text, f"limbs.{own[0]}.inputs", local, "offsets", f"[{offsets}]")
        else:
            offset = _offset(record, item, parameters[item.name])
            text = _replaced(text, "inputs", label, "offset", repr(offset))
    return text


def _offset(record: Mechanism, own: Input, added: float) -> float:
    """The offset of an input to whose readings something is to be added, as the file writes it."""
    unit = record.angle_unit if own.coordinate.kind == "angle" else 1.0
    return (own.offset - added) / unit


def _replaced(text: str, title: str, name: str, key: str, value: str) -> str:
    """The text with another number, or list of them, of a key in an entry that stands on one line of a table."""
    start = re.search(rf"^\[{re.escape(title)}\]", text, re.MULTILINE)
    first = start.end() if start else len(text)
    end = re.search(r"^\[", text[first:], re.MULTILINE)
    table_text = text[first : first + end.start()] if end else text[first:]
    line = re.search(rf"^\s*[\"']?{re.escape(name)}[\"']?\s*=\s*\{{.*$", table_text, re.MULTILINE)
    if line is None:
        hint = f"add --hold {name}, or leave -o out"
        raise UsageError(f"{name} is not on a line of [{title}]: no file is written", hint=hint)
    old = line.group()
    written = re.search(rf"\b{key.removesuffix('s')}s?\s*=\s*(\[[^\]]*\]|\"[^\"]*\"|'[^']*'|[-+.\w]+)", old)
    if written is not None:
        new = f"{old[: written.start()]}{key} = {value}{old[written.end() :]}"
    else:
        brace = old.rindex("}", 0, old.index("#") if "#" in old else len(old))
        new = f"{old[:brace].rstrip()}, {key} = {value} {old[brace:]}"
    return text[: first + line.start()] + new + text[first + line.end() :]


def _shown(record: Mechanism, answer: CalibrationAnswer) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, calibration")
    yield f"{answer.measurements} measurements of {', '.join(answer.measured)}"
    yield ""
    turned = {item.name for item in record.inputs if item.coordinate.kind == "angle"}
    rows = []
    for name, value in answer.parameters.items():
        known = record.parameters.get(name)
        other = "measuring frame" if name in FRAME else "added to the input"
        was = short(known.value) if known else other
        turns = name.startswith("frame.r") or name in turned
        one = record.angle_unit if turns and not known else 1.0
        unit = known.unit if known else record.angle if turns else record.unit
        rows.append((name, unit, was, f"{value / one:.9g}", short(answer.sigma[name] / one)))
    yield table(("parameter", "in", "was", "is", "sigma"), rows, left=("parameter", "in"))
    if answer.held:
        yield f"held: {', '.join(answer.held)}"
    before, after = short(answer.residual_before), short(answer.residual_after)
    yield f"root of the mean square: {before} before, {after} {answer.unit} after"
    if answer.outliers:
        yield f"left out, far beside the others: measurements {', '.join(map(str, answer.outliers))}"
    if answer.file is not None:
        yield f"written: {Path(answer.file)}"

"""Labels that neither the figures nor the report can set: each is a fault of the file that gives it.

They are drawn with the plain name instead, so that nothing fails; `assur check` tells them with their lines.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from assur.errors import KeyPath, MechanismFileError, Problem, cut, path_text
from assur.figures.labels import LONGEST, is_settable
from assur.model.file.place import input_place, problem
from assur.model.file.toml_source import read_toml
from assur.model.mechanism import MechanismRecord
from assur.model.registry import CLOSED_FORM
from assur.report.formulas.latex import is_understood
from assur.results.reading import file_text
from assur.scene.companion import FILE, Companion, companion

ALLOWED = f"LaTeX of letters and indices without dollar signs, as \\theta_1, of {LONGEST} characters at most"


def label_faults(record: MechanismRecord) -> tuple[Problem, ...]:
    """Every label of a mechanism's file, its closed form and its `figures.toml` that cannot be set; faults of the last.

    >>> from assur.model.registry import load_record
    >>> label_faults(load_record("zeng2019"))
    ()
    """
    try:
        drawn = companion(record)
    except MechanismFileError as error:
        return (*dict.fromkeys(_of_inputs(record)), *_of_closed_form(record), *error.problems)
    return (*dict.fromkeys(_of_inputs(record)), *_of_closed_form(record), *_of_companion(record, drawn))


def is_label(latex: str) -> bool:
    r"""Whether figures and report can both set a label.

    >>> is_label(r"\theta_1"), is_label(r"\theta_{1")
    (True, False)
    """
    return is_settable(latex) and is_understood(latex)


def _of_inputs(record: MechanismRecord) -> Iterator[Problem]:
    """Of an input without a label of its own its name is one; it is set as words where need be."""
    for actuated in record.drives:
        path: KeyPath = (*input_place(record, actuated.coordinate), "latex")
        if actuated.latex != actuated.name and not is_label(actuated.latex) and _stands(record, path):
            yield problem(record, path, _found(_written(record, path)), ALLOWED)


def _of_closed_form(record: MechanismRecord) -> Iterator[Problem]:
    form = record.closed_form
    if form is None:
        return
    texts = [margin.latex for margin in (*form.direct_margins, *form.inverse_margins)]
    texts += [entry.latex for entry in form.factor_list] + [entry.latex for entry in form.quantity_list]
    texts += [form.self_motion.latex] if form.self_motion else []
    wrong = [latex for latex in dict.fromkeys(texts) if latex and not is_label(latex)]
    if wrong:
        path = record.file.parent / CLOSED_FORM
        lines = _lines_of_texts(path)
        yield from (
            Problem(str(path), lines.get(latex), "latex", _found(latex), f"allowed: {ALLOWED}") for latex in wrong
        )


def _of_companion(record: MechanismRecord, drawn: Companion) -> Iterator[Problem]:
    labels: dict[KeyPath, str] = {("measures", k, "latex"): measure.latex for k, measure in enumerate(drawn.measures)}
    labels |= {("flow", "steps", name, "latex"): step.latex for name, step in drawn.flow.steps.items() if step.latex}
    wrong = {path: latex for path, latex in labels.items() if not is_label(latex)}
    if wrong and record.folder is not None:
        file = record.folder / FILE
        source = read_toml(file_text(file), str(file))
        for path, latex in wrong.items():
            yield Problem(str(file), source.line(path), path_text(path), _found(latex), f"allowed: {ALLOWED}")


def _found(latex: str) -> str:
    return f"the label '{cut(latex)}' cannot be set"


def _stands(record: MechanismRecord, path: KeyPath) -> bool:
    """Whether the file itself gives a label there; one that was changed in Python is no fault of it."""
    return record.description is not None and path in record.description.source.lines


def _written(record: MechanismRecord, path: KeyPath) -> str:
    """A text of the file."""
    part = record.description.source.data if record.description else {}
    for key in path[:-1]:
        part = part[str(key)]
    return str(part[str(path[-1])])


def _lines_of_texts(path: Path) -> dict[str, int]:
    """Text -> the first line of a Python file on which it stands."""
    lines: dict[str, int] = {}
    for node in ast.walk(ast.parse(file_text(path))):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            lines[node.value] = min(node.lineno, lines.get(node.value, node.lineno))
    return lines

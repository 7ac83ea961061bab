"""The Python file beside a mechanism's file: it is run, and what it claims is compared with what the mechanism says."""

from __future__ import annotations

import contextlib
import importlib.util
import sys
import traceback
from collections.abc import Iterator
from pathlib import Path

from assur.errors import MechanismFileError, Problem, UsageError
from assur.model.closed_form import ClosedForm
from assur.model.file.faults import listed
from assur.model.formula import parse
from assur.model.mechanism import MechanismRecord


def read_closed_form(path: Path, name: str) -> ClosedForm:
    """CLOSED_FORM of a Python file, which is run.

    Args:
        path: the file.
        name: the mechanism, after which the module is called.

    Errors:
        MechanismFileError: it does not run, or defines no CLOSED_FORM.
    """
    module_name = f"assur_closed_form_of_{name}"
    spec = importlib.util.spec_from_file_location(module_name, path)
    if spec is None or spec.loader is None:
        raise MechanismFileError([_problem(path, "no Python file", "allowed: a Python file")])
    module = importlib.util.module_from_spec(spec)
    sys.modules[module_name] = module
    try:
        with contextlib.redirect_stdout(sys.stderr):  # what it prints must not mix with an answer
            spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        found = f"{type(error).__name__}: {error}"
        raise MechanismFileError([_problem(path, found, "it must run", line=_line(error, path))]) from error
    form = getattr(module, "CLOSED_FORM", None)
    if not isinstance(form, ClosedForm):
        raise MechanismFileError([_problem(path, "no CLOSED_FORM", "it must define CLOSED_FORM = ClosedForm(...)")])
    return form


def disagreements(
    record: MechanismRecord, form: ClosedForm, path: Path, *, signs: bool = True, scales: bool = True
) -> tuple[Problem, ...]:
    """Where the signs, names and scales that a closed form states are not those of the mechanism; all of them at once.

    Args:
        record: the mechanism.
        form: what its closed form declares.
        path: the closed form's file.
        signs: whether the mechanism's signs are known, so that they can be compared.
        scales: whether its parameters are.
    """
    other = list(_signs(record, form, path)) if signs else []
    named = (*other, *_names(form, path))
    # that of another mechanism has other parameters as well, which says nothing more
    return tuple(dict.fromkeys([*named, *(_scales(record, form, path) if scales and not other else ())]))


def _signs(record: MechanismRecord, form: ClosedForm, path: Path) -> Iterator[Problem]:
    own = {*record.modes.working, *record.modes.assembly}
    if own != set(form.signs):
        found = f"signs {listed(form.signs)}"
        hint = (
            "it is read with every file of its folder; where it is another file's, "
            "move it, with its file, to a folder of its own"
        )
        yield _problem(path, found, f"those of [modes] in {record.file.name}: {listed(own)}", hint)


def _names(form: ClosedForm, path: Path) -> Iterator[Problem]:
    """Groups name factors, a self-motion a margin."""
    factors = {item.name for item in form.factor_list}
    for group in (*form.constraint_singular, *form.self_motion_singular):
        if not set(group) <= factors:
            yield _problem(path, f"the group {group}", f"names of factor_list: {listed(factors)}")
    margins = {item.name for item in form.direct_margins}
    if form.self_motion and form.self_motion.margin not in margins:
        found = f"self_motion.margin = '{form.self_motion.margin}'"
        yield _problem(path, found, f"a name of direct_margins: {listed(margins)}")


def _scales(record: MechanismRecord, form: ClosedForm, path: Path) -> Iterator[Problem]:
    """Every scale is a formula of the parameters, and positive."""
    margins, factors = (*form.direct_margins, *form.inverse_margins), form.factor_list
    scales = (*(m.scale for m in margins), *(f.scale for f in factors), *(s.scale for s in form.signs.values()))
    for formula in scales:
        try:
            size = float(parse(formula).evaluate(vars(record.values)))
        except (KeyError, UsageError) as error:
            yield _problem(path, f"the scale '{formula}': {error}", f"a formula of {listed(record.parameters)}")
            continue
        if not size > 0:
            yield _problem(path, f"the scale '{formula}' is {size:g}", "it must be positive")


def _problem(path: Path, found: str, allowed: str, hint: str = "", line: int | None = None) -> Problem:
    return Problem(str(path), line, "", found, allowed, hint)


def _line(error: BaseException, path: Path) -> int | None:
    """The last line of the file that was reached before an error."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno
    frames = traceback.extract_tb(error.__traceback__)
    return next((frame.lineno for frame in reversed(frames) if frame.filename == str(path)), None)

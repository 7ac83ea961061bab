"""The kernels beside a mechanism's file: they are read, and what they claim is compared with the mechanism's words."""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

from assur.errors import AssurError, MechanismFileError, Problem, UsageError, hidden, visible
from assur.model.closed_form import ClosedForm, Eliminant, PolynomialSystem, SelfMotion
from assur.model.consent import may_run
from assur.model.file.faults import listed
from assur.model.file.texts import MAX_NAME
from assur.model.formula import parse
from assur.model.mechanism import MechanismRecord


def read_closed_form(path: Path, name: str, text: str) -> ClosedForm | None:
    """CLOSED_FORM of a file of kernels, which is read and not run (`assur.model.kernels`).

    Args:
        path: the file.
        name: the mechanism, after which a module that has to run is called.
        text: what stands in the file.

    Returns:
        None where the file is Python beyond that form, and nobody gave leave to run it (`assur.model.consent`).

    Errors:
        MechanismFileError: it cannot be worked out, or defines no CLOSED_FORM.
    """
    from assur.model.kernels.faults import FormFault  # what reads kernels, for files that have one beside them
    from assur.model.kernels.reading import names_of

    _seen_as_read(text, path)
    try:
        names = names_of(text, path)
    except FormFault as fault:
        reason = f"{fault.reason} (allowed: {fault.allowed})" if fault.allowed else fault.reason
        if not may_run(path, text.encode(), reason, "the joint graph answers alone", fault.line):
            return None
        names = _run(text, path, name)
        guarded: ClosedForm = _guarded(_form(names, path), path)
        return guarded
    return _form(names, path)


def _seen_as_read(text: str, path: Path) -> None:
    """Refuse a text of which a reader does not see what it says, in comments too: who gives leave must have seen it."""
    for number, line in enumerate(text.removeprefix("\ufeff").split("\n"), start=1):
        unseen = hidden(line, kept="\t\r\f")
        if unseen:
            found = f"{visible(unseen[0])}, a character that nobody sees"
            raise MechanismFileError([_problem(path, found, "allowed: text that is seen as it is read", line=number)])


def _form(names: Mapping[str, Any], path: Path) -> ClosedForm:
    form = names.get("CLOSED_FORM")
    if not isinstance(form, ClosedForm):
        raise MechanismFileError([_problem(path, "no CLOSED_FORM", "it must define CLOSED_FORM = ClosedForm(...)")])
    return form


def _run(text: str, path: Path, name: str) -> Mapping[str, Any]:
    """Names of a file that is run."""
    module = ModuleType(f"assur_closed_form_of_{name}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module
    try:
        with contextlib.redirect_stdout(sys.stderr):  # what it prints must not mix with an answer
            exec(compile(text, str(path), "exec"), vars(module))  # with leave
    except (Exception, SystemExit) as error:
        what = f"{type(error).__name__}: {error}"
        raise MechanismFileError([_problem(path, what, "it must run", line=_line(error, path))]) from error
    return vars(module)


def _guarded(declared: Any, path: Path) -> Any:
    """A declaration whose functions were run from a file: what goes wrong in them is a fault of the file."""
    parts = {item.name: getattr(declared, item.name) for item in dataclasses.fields(declared)}
    guarded: dict[str, Any] = {}
    for name, part in parts.items():
        if isinstance(part, Eliminant | PolynomialSystem | SelfMotion):
            guarded[name] = _guarded(part, path)
        elif callable(part):
            guarded[name] = _told(part, path)
    return dataclasses.replace(declared, **guarded)


def _told(kernel: Callable[..., Any], path: Path) -> Callable[..., Any]:
    @functools.wraps(kernel)
    def called(*arguments: Any, **named: Any) -> Any:
        try:
            return kernel(*arguments, **named)
        except AssurError:
            raise
        except Exception as error:
            what = f"{type(error).__name__}: {error}"[:300]
            allowed = "allowed: straight-line algebra that works over every number type"
            raise MechanismFileError([_problem(path, what, allowed, line=_line(error, path))]) from error

    return called


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
    named = (*other, *_names(record, form, path, signs=signs))
    # that of another mechanism has other parameters as well, which says nothing more
    return tuple(dict.fromkeys([*named, *(_scales(record, form, path) if scales and not other else ())]))


def _signs(record: MechanismRecord, form: ClosedForm, path: Path) -> Iterator[Problem]:
    modes = record.modes.completed(form.working, form.assembly)
    own = {*modes.working, *modes.assembly}
    if own != set(form.signs):
        found = f"signs {listed(form.signs)}"
        hint = (
            "it is read with every file of its folder; where it is another file's, "
            "move it, with its file, to a folder of its own"
        )
        yield _problem(path, found, f"those of [modes] in {record.file.name}: {listed(own)}", hint)


def _names(record: MechanismRecord, form: ClosedForm, path: Path, *, signs: bool) -> Iterator[Problem]:
    """Groups name factors, a self-motion a margin, a margin signs of its own problem; and no name stands twice."""
    factors = {item.name for item in form.factor_list}
    for group in (*form.constraint_singular, *form.self_motion_singular):
        if not set(group) <= factors:
            yield _problem(path, f"the group {group}", f"names of factor_list: {listed(factors)}")
    margins = {item.name for item in form.direct_margins}
    if form.self_motion and form.self_motion.margin not in margins:
        found = f"self_motion.margin = '{form.self_motion.margin}'"
        yield _problem(path, found, f"a name of direct_margins: {listed(margins)}")
    if signs:
        yield from _margin_signs(record, form, path)
    for where in ("direct_margins", "inverse_margins", "factor_list", "quantity_list"):
        own = [item.name for item in getattr(form, where)]
        for name in dict.fromkeys(own):
            if own.count(name) > 1:
                yield _problem(path, f"{where}: '{name}' {own.count(name)} times", "each name once")
            if not 0 < len(name) <= MAX_NAME:
                cut_name = f"'{name[:20]}...' has {len(name)} characters" if name else "an empty name"
                yield _problem(path, f"{where}: {cut_name}", f"1 to {MAX_NAME}")


def _margin_signs(record: MechanismRecord, form: ClosedForm, path: Path) -> Iterator[Problem]:
    """Margins name assembly signs, or those of polynomials, in the direct problem, working signs in the inverse one."""
    named = record.modes.completed(form.working, form.assembly)
    of_polynomials = form.direct.signs if isinstance(form.direct, Eliminant) else ()
    for problem, margins, modes, own in (
        ("direct", form.direct_margins, "assembly", [*named.assembly, *of_polynomials]),
        ("inverse", form.inverse_margins, "working", named.working),
    ):
        for margin in margins:
            for sign in margin.signs:
                if sign not in own:
                    found = f"the sign '{sign}' of {problem} margin {margin.name}"
                    yield _problem(path, found, f"signs of modes.{modes} in {record.file.name}: {listed(own)}")


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


def _problem(path: Path, given: str, allowed: str, hint: str = "", line: int | None = None) -> Problem:
    return Problem(str(path), line, "", given, allowed, hint)


def _line(error: BaseException, path: Path) -> int | None:
    """The last line of the file that was reached before an error."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return error.lineno
    frames = traceback.extract_tb(error.__traceback__)
    return next((frame.lineno for frame in reversed(frames) if frame.filename == str(path)), None)

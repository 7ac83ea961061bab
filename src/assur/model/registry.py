"""Mechanisms by name: each is a folder of package data, and a user's own file is no different.

A folder has a mechanism (`mechanism.toml`, with dimensions) or a topology alone (`topology.toml`), or both.
"""

from __future__ import annotations

import dataclasses
import os
import tomllib
from importlib.resources import files
from pathlib import Path
from typing import Any, TypeVar

from assur.errors import MechanismFileError, Problem, UnknownNameError, UsageError
from assur.model.closed_form import ClosedForm
from assur.model.closed_form_answers import answer_faults
from assur.model.closed_form_file import disagreements, read_closed_form
from assur.model.consent import built_in
from assur.model.file.build import build
from assur.model.file.faults import Faults
from assur.model.file.parameters import checked_overrides
from assur.model.file.reader import description_text, examined, read_mechanism, with_ending
from assur.model.file.toml_source import read_toml
from assur.model.file.topology_file import read_topology
from assur.model.file.topology_schema import is_topology
from assur.model.mechanism import MechanismRecord
from assur.model.topology_description import TopologyDescription
from assur.results.reading import file_text

FILE = "mechanism.toml"
TOPOLOGY = "topology.toml"
LEFT_OUT = "left_out.toml"
CLOSED_FORM = "closed_form.py"
_TABLES = ("base", "platform", "links", "joints", "parameters", "inputs", "home", "unit", "angle", "repeat")
_LOOPS = tuple((table,) for table in (*_TABLES, "generalised"))
"""What loops are made of: where a fault leaves unknown whether they close and move."""
_NOT_OF_FILE = ("closed_form", "closed_form_text", "closed_form_not_run", "thickness")
"""What a record has from elsewhere than the mechanism's file."""
Record = TypeVar("Record", bound=MechanismRecord)


def names() -> tuple[str, ...]:
    """Names of the built-in mechanisms, those with dimensions, in alphabetical order.

    >>> "zeng2019" in names()
    True
    """
    return _with(FILE)


def topology_names() -> tuple[str, ...]:
    """Names of the built-in topologies, mechanisms without dimensions, in alphabetical order.

    >>> "tripteron" in topology_names()
    True
    """
    return _with(TOPOLOGY)


def is_built_in(record: MechanismRecord) -> bool:
    """Whether a record is of a file that is part of assur.

    >>> is_built_in(load_record("fivebar"))
    True
    """
    return built_in(record.file)


@dataclasses.dataclass(frozen=True)
class LeftOut:
    """A mechanism of the literature that is not built in, and the reason."""

    name: str
    title: str
    source: str
    reason: str


def left_out() -> tuple[LeftOut, ...]:
    """What the catalogue does not have, in alphabetical order.

    >>> [item.title for item in left_out()]
    ['Tri-pyramid robot']
    """
    entries = tomllib.loads((_folder() / LEFT_OUT).read_text(encoding="utf-8"))
    return tuple(LeftOut(name, **entry) for name, entry in sorted(entries.items()))


def means_topology(name_or_path: str | Path, /) -> bool:
    """Whether a name or a file means a topology, by what stands in the file; else it means a mechanism.

    Errors:
        UnknownNameError: neither a mechanism nor a topology has that name.
        UsageError, MechanismFileError: as `load_record`.

    >>> means_topology("tripteron"), means_topology("zeng2019")
    (True, False)
    """
    path = _find(name_or_path, (TOPOLOGY, FILE))
    return is_topology(read_toml(description_text(path), str(path)).data)


def load_topology(name_or_path: str | Path, /) -> TopologyDescription:
    """A built-in topology, or that of a file.

    Args:
        name_or_path: a name, or the path of a `.toml` file or of a folder with a `topology.toml`.

    Errors:
        UnknownNameError: neither a topology nor a mechanism has that name.
        UsageError: a file that cannot be read, or that of a mechanism, which has a joint graph instead.
        MechanismFileError: the file has faults.

    Example:
        >>> [chain.text for chain in load_topology("tripteron").chains]
        ['P[x] R[x] R[x] R[x]', 'P[y] R[y] R[y] R[y]', 'P[z] R[z] R[z] R[z]']
    """
    return read_topology(_find(name_or_path, (TOPOLOGY, FILE)))


def load_record(name_or_path: str | Path, /, **overrides: Any) -> MechanismRecord:
    """The record of a built-in mechanism or of a file, with its closed form, if there is one beside it.

    Args:
        name_or_path: a name, or the path of a `.toml` file or of a folder with a `mechanism.toml`.
        overrides: other values for parameters, in the units of the file.

    Errors:
        UnknownNameError: no mechanism or no parameter of that name.
        UsageError: a value that a parameter may not have, a file that cannot be read, or a topology, which has
            no dimensions.
        MechanismFileError: the file has faults.

    Example:
        >>> load_record("zeng2019", l2=300).values.l2
        300.0
    """
    path = _find(name_or_path, (FILE, TOPOLOGY))
    record = read_mechanism(path)
    beside = path.parent / CLOSED_FORM
    text = file_text(beside) if os.path.lexists(beside) else None  # what is there and no file is told
    form = None if text is None else _closed_form(record, beside, text)
    not_run = text is not None and form is None
    record = dataclasses.replace(record, closed_form=form, closed_form_text=text or "", closed_form_not_run=not_run)
    return with_parameters(record, **overrides) if overrides else record


def with_parameters(record: Record, /, **overrides: Any) -> Record:
    """The same mechanism with other values of some parameters; those changed before stay changed.

    Errors:
        UnknownNameError: no parameter of that name.
        UsageError: a value that the parameter may not have, or with which the file has a fault.

    Example:
        >>> with_parameters(load_record("zeng2019"), l2=300, l7=20).values.l7
        20.0
    """
    checked = checked_overrides(record.name, record.parameters, overrides)
    description = record.description
    if description is None:
        raise UsageError(f"{record.name} was not read from a file, so its parameters cannot be changed")
    faults = Faults(str(record.file), description.source)
    try:
        changed = build(description, {**record.overrides, **checked}, faults)
    except MechanismFileError as error:
        given = ", ".join(f"{name} = {value:g}" for name, value in checked.items())
        problem = error.problems[0]
        place = f"{problem.path}: {problem.found}; {problem.allowed}"
        raise UsageError(f"{record.name} cannot be with {given}: {place}", hint=problem.hint) from None
    parts = {item.name: getattr(changed, item.name) for item in dataclasses.fields(MechanismRecord)}
    kept = {name: getattr(record, name) for name in _NOT_OF_FILE}
    return dataclasses.replace(record, **{**parts, **kept})


def _folder() -> Path:
    return Path(str(files("assur"))) / "mechanisms"


def _with(file: str) -> tuple[str, ...]:
    return tuple(sorted(folder.name for folder in _folder().iterdir() if (folder / file).is_file()))


def _find(name_or_path: str | Path, files_of_folder: tuple[str, str]) -> Path:
    """The file that is meant; of a folder the first that is there."""
    if not isinstance(name_or_path, str | Path):
        raise UsageError(f"a mechanism is given by its name or the path of its file, not by {name_or_path!r}")
    text = str(name_or_path)
    path = Path(name_or_path)
    built_in = {*names(), *topology_names()}
    for folder in [_folder() / text] if text in built_in else [path]:
        for file in files_of_folder:
            if os.path.isfile(folder / file):  # noqa: PTH113  # which a name that is too long does not upset
                return folder / file
    if path.suffix == ".toml" or isinstance(name_or_path, Path) or len(path.parts) > 1:
        return path
    own = with_ending(text)
    if text.strip() and os.path.exists(path):  # noqa: PTH110  # as above
        what = f"a folder without {files_of_folder[0]}" if path.is_dir() else "a file that does not end in .toml"
        raise UsageError(f"'{text}' is {what}", hint=own or "name a mechanism (`assur list` has them) or a .toml file")
    reasons = {item.name: f"{item.title} is left out: {item.reason}" for item in left_out()}
    choices = names() if files_of_folder[0] == FILE else built_in
    raise UnknownNameError("mechanism", text, choices, hint=own or reasons.get(text, ""))


def examine(name_or_path: str | Path, /) -> tuple[MechanismRecord | None, tuple[Problem, ...]]:
    """Every fault of a mechanism's file and of the closed form beside it, and the record where its loops are known.

    Loops are known where no fault touches what they are made of, so that the joint graph can be looked at as well.

    Errors:
        UnknownNameError, UsageError: as `load_record`.

    Example:
        >>> record, problems = examine("fivebar")
        >>> record.name, problems
        ('fivebar', ())
    """
    path = _find(name_or_path, (FILE, TOPOLOGY))
    beside = path.parent / CLOSED_FORM
    try:
        record, faults = examined(description_text(path), path)
    except MechanismFileError as error:
        return None, (*error.problems, *_faults_beside(beside, None, None))
    problems = (*faults.told(), *_faults_beside(beside, record, faults))
    return (record if faults.spares(*_LOOPS) and not faults.more else None), problems


def _faults_beside(path: Path, record: MechanismRecord | None, faults: Faults | None) -> tuple[Problem, ...]:
    """Faults of a closed form; what it claims of a mechanism where that is known."""
    try:
        name = record.name if record else path.parent.name
        form = read_closed_form(path, name, file_text(path)) if os.path.lexists(path) else None
    except MechanismFileError as error:
        return error.problems
    if form is None or record is None or faults is None:
        return ()
    known = {"signs": faults.spares(("modes",)), "scales": faults.spares(("parameters",), ("unit",))}
    told = disagreements(record, form, path, **known)
    return told if told or faults.told() else answer_faults(record, form, path)


def _disagreements(record: MechanismRecord, form: ClosedForm, path: Path) -> tuple[Problem, ...]:
    """Where a closed form is not of its mechanism; what its kernels answer is not looked at of those built in."""
    return disagreements(record, form, path) or (() if built_in(path) else answer_faults(record, form, path))


def _closed_form(record: MechanismRecord, path: Path, text: str) -> ClosedForm | None:
    """CLOSED_FORM of the Python file beside a mechanism file, None where it was not run."""
    form = read_closed_form(path, record.name, text)
    problems = _disagreements(record, form, path) if form else ()
    if problems:
        raise MechanismFileError(problems)
    return form

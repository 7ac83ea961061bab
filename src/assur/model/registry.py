"""Mechanisms by name: each is a folder of package data, and a user's own file is no different.

A folder has a mechanism (`mechanism.toml`, with dimensions) or a topology alone (`topology.toml`), or both.
"""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur.errors import MechanismFileError, Problem, UnknownNameError, UsageError
from assur.model.closed_form import ClosedForm
from assur.model.closed_form_file import disagreements, read_closed_form
from assur.model.consent import built_in
from assur.model.file.description import description_text, named_nearly
from assur.model.kept_readings import keep_reading, kept_reading
from assur.model.mechanism import MechanismRecord
from assur.results.reading import file_text
from assur.work import stage

if TYPE_CHECKING:
    from assur.results.answers.catalogue import LeftOutMechanism

FILE = "mechanism.toml"
TOPOLOGY = "topology.toml"
LEFT_OUT = "left_out.toml"
CLOSED_FORM = "closed_form.py"


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


def left_out() -> tuple[LeftOutMechanism, ...]:
    """What the catalogue does not have, in alphabetical order.

    >>> [item.title for item in left_out()]
    ['Tri-pyramid robot']
    """
    import tomllib  # which, as the answer, nothing else here needs

    from assur.results.answers.catalogue import LeftOutMechanism

    entries = tomllib.loads((_folder() / LEFT_OUT).read_text(encoding="utf-8"))
    return tuple(LeftOutMechanism(name, **entry) for name, entry in sorted(entries.items()))


@stage("reading the file")
def load_record(name_or_path: str | Path, /, **overrides: Any) -> MechanismRecord:
    """The record of a built-in mechanism or of a file, with its closed form, if there is one beside it.

    A built-in mechanism is one object for as long as its files say the same, so that what was found out of it is there.

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
    record = record_alone(name_or_path)
    beside = record.file.parent / CLOSED_FORM
    text = file_text(beside) if os.path.lexists(beside) else None  # what is there and no file is told
    record = _whole(record, text)
    if not overrides:
        return record
    from assur.model.dimensions import with_parameters  # which reads the file again, whatever was kept

    return with_parameters(record, **overrides)


def record_alone(name_or_path: str | Path, /) -> MechanismRecord:
    """The record of a mechanism's file as `load_record` has it, but for its closed form, which is not looked at.

    >>> record_alone("zeng2019").closed_form is None
    True
    """
    path = file_of(name_or_path)
    text = description_text(path)
    return _built_in_alone(text, path) if built_in(path) else _alone(text, path)


def _alone(text: str, path: Path) -> MechanismRecord:
    """The record of a text, read anew or as it was kept."""
    kept = kept_reading(text, path)
    if kept is not None:
        return kept
    from assur.model.file.reader import read_text  # with all the schemas of a file

    record = read_text(text, path)
    keep_reading(record)
    return record


_built_in_alone = lru_cache(maxsize=64)(_alone)


@lru_cache(maxsize=64)
def _whole(record: MechanismRecord, text: str | None) -> MechanismRecord:
    """A record with the closed form of a text."""
    form = None if text is None else _closed_form(record, record.file.parent / CLOSED_FORM, text)
    return record.with_closed_form(form, text or "", not_run=text is not None and form is None)


def _folder() -> Path:
    return Path(__file__).parents[1] / "mechanisms"


def _with(file: str) -> tuple[str, ...]:
    return tuple(sorted(folder.name for folder in _folder().iterdir() if (folder / file).is_file()))


def file_of(name_or_path: str | Path, files_of_folder: tuple[str, str] = (FILE, TOPOLOGY)) -> Path:
    """The file that is meant; of a folder the first that is there.

    Errors:
        UnknownNameError: nothing built in has that name. UsageError: a path that cannot mean a file.

    >>> file_of("fivebar").name
    'mechanism.toml'
    """
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
    own = named_nearly(text)
    if text.strip() and os.path.exists(path):  # noqa: PTH110  # as above
        what = f"a folder without {files_of_folder[0]}" if path.is_dir() else "a file that does not end in .toml"
        raise UsageError(f"'{text}' is {what}", hint=own or "name a mechanism (`assur list` has them) or a .toml file")
    reasons = {item.name: f"{item.title} is left out: {item.reason}" for item in left_out()}
    choices = names() if files_of_folder[0] == FILE else built_in
    raise UnknownNameError("mechanism", text, choices, hint=own or reasons.get(text, ""))


def _disagreements(record: MechanismRecord, form: ClosedForm, path: Path) -> tuple[Problem, ...]:
    """Where a closed form is not of its mechanism; what its kernels answer is not looked at of those built in."""
    problems = disagreements(record, form, path)
    if problems or built_in(path):
        return problems
    from assur.model.closed_form_answers import answer_faults  # recorders, which what is built in does not need

    return answer_faults(record, form, path)


def _closed_form(record: MechanismRecord, path: Path, text: str) -> ClosedForm | None:
    """CLOSED_FORM of the Python file beside a mechanism file, None where it was not run."""
    if record.redundant_inputs:
        names = ", ".join(item.name for item in record.redundant_inputs)
        raise UsageError(
            f"{path}: a closed form has as many inputs as the mechanism has freedoms, and {names} would be redundant",
            hint="leave them out of [inputs], or put the closed form elsewhere",
        )
    form = read_closed_form(path, record.name, text)
    problems = _disagreements(record, form, path) if form else ()
    if problems:
        raise MechanismFileError(problems)
    return form

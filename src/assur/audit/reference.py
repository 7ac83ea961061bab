"""Reference data: what a source prints about a mechanism, its digits kept as text, read from `reference/*.toml`.

The folder holds any number of files. One of them has `[about]` and `[parameters]`, the dimensions for which
the numbers were printed. The rest are arrays of tables, each of one kind; a kind may stand in several files.
`errata.toml` is read by `assur.audit.errata`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, BeforeValidator, Field, PlainValidator, ValidationError, create_model

from assur.audit.printed import Printed
from assur.errors import MechanismFileError, Problem, UsageError, path_text
from assur.model.file.schema import Entry
from assur.model.file.toml_source import TomlSource, read_toml
from assur.model.file.values import Value, refuse, shown
from assur.model.formula import Formula
from assur.model.mechanism import MechanismRecord
from assur.results.reading import file_text

FOLDER = "reference"
ERRATA = "errata.toml"
EntryType = TypeVar("EntryType", bound=BaseModel)


def _digits(value: object) -> Printed:
    """Digits in quotes: a float would have lost those that were printed."""
    try:
        return Printed(value if isinstance(value, str) else "")
    except UsageError:
        raise refuse(shown(value), 'allowed: the printed digits in quotes: "-15.4714"') from None


Digits = Annotated[Printed, PlainValidator(_digits)]
Components = Annotated[tuple[Value, ...], BeforeValidator(lambda value: value if isinstance(value, list) else [value])]
"""A formula, or a list of formulas: the components of an equation."""


class About(Entry):
    """Where the numbers come from: printed in a source, or derived by us; and what the folder holds."""

    origin: Literal["printed", "derived"]
    text: str


@dataclass(frozen=True, eq=False)
class Reference:
    """The reference data of one mechanism.

    Attributes:
        definitions: letters of the source, each a formula of the joint graph and of letters before it.
        entries: kind -> its entries, in the order of the files.
    """

    about: About
    definitions: Mapping[str, Formula]
    entries: Mapping[str, tuple[Any, ...]]


def reference_folder(record: MechanismRecord) -> Path:
    """The folder of a mechanism's reference data.

    Errors:
        UsageError: the mechanism has none.
    """
    folder = None if record.folder is None else record.folder / FOLDER
    if folder is None or not folder.is_dir():
        raise UsageError(
            f"{record.name} has no reference data to audit",
            hint=f"put what its source prints into a folder '{FOLDER}' beside its file",
        )
    return folder


def read_reference(record: MechanismRecord, kinds: Mapping[str, type[Entry]]) -> Reference:
    """Read the reference data of a mechanism.

    `kinds` is the name of an array of tables -> the form of its entries.

    Errors:
        UsageError: there are none, or the mechanism does not have the dimensions that they were printed for.
        MechanismFileError: a file has faults.
    """
    folder = reference_folder(record)
    files = [read_form(path, kinds) for path in sorted(folder.glob("*.toml")) if path.name != ERRATA]
    abouts = [file.about for file in files if file.about]
    if len(abouts) != 1:
        raise MechanismFileError([Problem(str(folder), None, "about", f"{len(abouts)} tables [about]", "allowed: one")])
    _check_parameters(record, {name: digits for file in files for name, digits in file.parameters.items()})
    definitions = {name: formula for file in files for name, formula in file.definitions.items()}
    _check_definitions(definitions, folder)
    entries = {kind: tuple(entry for file in files for entry in getattr(file, kind)) for kind in kinds}
    return Reference(abouts[0], definitions, entries)


def read_form(path: Path, kinds: Mapping[str, type[Entry]]) -> Any:
    """One file of reference data, in form; every fault of the form at once."""
    fields: dict[str, Any] = {kind: (tuple[entry, ...], ()) for kind, entry in kinds.items()}  # type: ignore[valid-type]  # built here
    form = create_model(
        "ReferenceFile",
        __base__=Entry,
        about=(About | None, None),
        parameters=(dict[str, Digits], Field(default_factory=dict)),
        definitions=(dict[str, Value], Field(default_factory=dict)),
        **fields,
    )
    source = read_toml(file_text(path), str(path))
    return checked(form, source, path)


def checked(form: type[EntryType], source: TomlSource, path: Path) -> EntryType:
    """A document in a form, or a `MechanismFileError` with every fault."""
    try:
        return form.model_validate(source.data)
    except ValidationError as error:
        problems = [_problem(details, source, path) for details in error.errors(include_url=False)]
        raise MechanismFileError(problems) from None


def _problem(details: Any, source: TomlSource, path: Path) -> Problem:
    place = tuple(details["loc"])
    context = details.get("ctx", {})
    offending = context.get("found") or (
        "unknown key" if details["type"] == "extra_forbidden" else shown(details["input"])
    )
    allowed = context.get("allowed") or f"allowed: {details['msg'].removeprefix('Input should be ')}"
    return Problem(str(path), source.line(place), path_text(place), offending, allowed, context.get("hint", ""))


def _check_definitions(definitions: Mapping[str, Formula], folder: Path) -> None:
    """A letter may need those before it only, so that none needs itself."""
    later = set(definitions)
    for name, formula in definitions.items():
        needed = sorted(later & formula.names)
        if needed:
            offending = f"needs {', '.join(needed)}, which stands after it or is itself"
            raise MechanismFileError(
                [Problem(str(folder), None, f"definitions.{name}", offending, "allowed: letters before it")]
            )
        later.remove(name)


def _check_parameters(record: MechanismRecord, printed: Mapping[str, Printed]) -> None:
    """An audit is of the mechanism that the source describes, not of one with other dimensions."""
    if set(printed) != set(record.parameters):
        differ = ", ".join(sorted(set(printed) ^ set(record.parameters)))
        raise UsageError(f"the reference data of {record.name} and its file differ in the parameters: {differ}")
    for name, digits in printed.items():
        value = record.parameters[name].value
        if abs(value - digits.value) > digits.half_unit:
            raise UsageError(
                f"{name} = {value:g}, and the reference data of {record.name} are for {name} = {digits.text}",
                hint="audit the mechanism with the dimensions of its file",
            )

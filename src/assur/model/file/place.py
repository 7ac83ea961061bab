"""Where in its file a part of a record stands: names such as leg1.B lead back to the template of their limb."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.errors import KeyPath, Problem, cut, path_text
from assur.model.mechanism import Coordinate, MechanismRecord

if TYPE_CHECKING:
    from assur.model.file.schema import FileEntry

_LONG = 600


def problem(record: MechanismRecord, path: KeyPath, given: str, allowed: str, hint: str = "") -> Problem:
    """A problem with the line at which its path, or the nearest part of it, stands in the record's file."""
    line = record.description.source.line(path) if record.description else None
    return Problem(str(record.file), line, path_text(path), cut(given, _LONG), f"allowed: {allowed}", cut(hint, _LONG))


def table_place(record: MechanismRecord, table: str) -> KeyPath:
    """A table of the file; that of a template where the file itself has none.

    >>> from assur.model.registry import load_record
    >>> table_place(load_record("fivebar"), "home"), table_place(load_record("orthoglide"), "home")
    (('home',), ('limbs', 'leg', 'home'))
    """
    file = _file(record)
    limbs = [name for name, limb in file.limbs.items() if getattr(limb, table, None)] if file else []
    own = file is None or (file.inputs.entries if table == "inputs" else getattr(file, table))
    return (table,) if own or not limbs else ("limbs", limbs[0], table)


def place(record: MechanismRecord, table: str, name: str) -> KeyPath:
    """The entry of a link, joint or another named part.

    >>> from assur.model.registry import load_record
    >>> place(load_record("orthoglide"), "joints", "leg2.A")
    ('limbs', 'leg', 'joints', 'A')
    """
    file, (head, _, local) = _file(record), name.partition(".")
    for limb in file.limbs if file and local else ():
        if head.startswith(limb) and head[len(limb) :].isdigit():
            return ("limbs", limb, table, local)
    return (table, name)


def input_place(record: MechanismRecord, coordinate: Coordinate) -> KeyPath:
    """The entry of an input, which may stand under its joint's alias or with its component.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> input_place(record, record.inputs[0].coordinate)
    ('inputs', 'P1')
    """
    *table, local = place(record, "inputs", coordinate.joint)
    alias = record.joints[coordinate.joint].alias.rpartition(".")[2]
    file = _file(record)
    if file is None:
        return (*table, local)
    entries = file.limbs[str(table[1])].inputs if table[0] == "limbs" else file.inputs.entries
    names = [str(local), *([alias] if alias else [])]
    written = [text for name in names for text in (name, f"{name}.{coordinate.component}") if text in entries]
    if not written and table[0] == "limbs":  # outside its template
        full = (coordinate.joint, f"{coordinate.joint}.{coordinate.component}")
        return ("inputs", next((text for text in full if text in file.inputs.entries), coordinate.joint))
    return (*table, written[0] if written else local)


def entry_hint(record: MechanismRecord, table: str, name: str, keys: str) -> str:
    """What to write, and where: keys that the entry of a link or an actuator lacks, for all limbs of a template.

    >>> from assur.model.registry import load_record
    >>> entry_hint(load_record("orthoglide"), "actuators", "leg2.A", "force = 60").partition("[")[2]
    'actuators]: A = { ..., force = 60 }'
    """
    path = place(record, table, name)
    if table == "actuators":  # of the file, also for a template's joints
        path = (table, path[-1])
    lines = record.description.source.lines if record.description else {}
    line = next((f", line {lines[part]}" for part in (path, path[:-1]) if part in lines), "")
    more = "..., " if path in lines else ""
    key = path_text(path[-1:])
    return f"say it in {record.file.name}{line}, [{path_text(path[:-1])}]: {key} = {{ {more}{keys} }}"


def _file(record: MechanismRecord) -> FileEntry | None:
    return record.description.form.entry if record.description else None

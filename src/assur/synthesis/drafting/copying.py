"""A new file from one of the catalogue: its text under another name, with a word on where it came from."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from assur.errors import UnknownNameError, UsageError
from assur.model.file.description import description_text
from assur.model.registry import CLOSED_FORM, left_out, load_record, names, topology_names

_NAME = re.compile(r"^name(\s*)=.*?$", re.MULTILINE)
_COMMENTS = re.compile(r"(?:#.*\n)*")


@dataclass(frozen=True)
class Copied:
    """The text of a new file, and the closed form that its model has, None where it has none."""

    model: str
    text: str
    closed_form: Path | None


def in_catalogue(name: str) -> str:
    """The name of the catalogue that is meant: the name itself, or the only one that begins with it.

    Errors:
        UnknownNameError: none is meant, or several are; the nearest are in the hint.

    >>> in_catalogue("zeng"), in_catalogue("tripteron")
    ('zeng2019', 'tripteron')
    """
    known = sorted({*names(), *topology_names()})
    meant = [name] if name in known else [entry for entry in known if name and entry.startswith(name)]
    if len(meant) == 1:
        return meant[0]
    reasons = {mechanism.name: f"{mechanism.title} is left out: {mechanism.reason}" for mechanism in left_out()}
    several = f"did you mean {' or '.join(meant)}?" if meant else reasons.get(name, "")
    raise UnknownNameError("mechanism", name, known, hint=several)


def has_dimensions(name: str) -> bool:
    """Whether a name of the catalogue has a mechanism's file; else there is its topology alone.

    >>> has_dimensions("zeng2019")
    True
    """
    return name in names()


def copied(model: str, path: Path) -> Copied:
    r"""The file of a mechanism of the catalogue under the name of a new file.

    Args:
        model: a name of the catalogue that has dimensions.
        path: of the new file; its stem is the mechanism's name.

    Errors:
        UsageError: the stem is no name for a mechanism.

    Example:
        >>> found = copied("fivebar", Path("my.toml"))
        >>> found.text.splitlines()[0]
        '# my: a copy of fivebar from the catalogue. Change dimensions, links and joints as you like; then'
        >>> 'name   = "my"' in found.text, found.closed_form.name
        (True, 'closed_form.py')
    """
    name = mechanism_name(path)
    record = load_record(model)
    text = description_text(record.file)
    beside = record.file.parent / CLOSED_FORM
    renamed = _NAME.sub(lambda match: f'name{match[1]}= "{name}"', text, count=1)
    comments = _COMMENTS.match(renamed)
    end = comments.end() if comments else 0
    said = f"#\n# The comment of {model}:\n#\n{renamed[:end]}" if end else ""
    head = [
        f"# {name}: a copy of {model} from the catalogue. Change dimensions, links and joints as you like; then",
        *next_steps(path),
    ]
    return Copied(model, "\n".join(head) + f"\n{said}{renamed[end:]}", beside if beside.is_file() else None)


def next_steps(path: Path) -> list[str]:
    """Lines of a header that say what to do with a new file.

    >>> next_steps(Path("my.toml"))[0]
    '#     assur check my.toml      every fault at once, each with its line'
    """
    width = len(f"figures {path.name}")
    said = {
        "check": "every fault at once, each with its line",
        "show": "dimensions, joints, home, mobility",
        "figures": "what it looks like",
        "page": "moved by sliders in a browser, from one file",
    }
    return [f"#     assur {f'{word} {path.name}':{width}}    {what}" for word, what in said.items()]


def mechanism_name(path: Path) -> str:
    """The name that a file gives its mechanism, its stem.

    Errors:
        UsageError: another ending than .toml, or a stem that is no name.

    >>> mechanism_name(Path("folder/my-delta.toml"))
    'my-delta'
    """
    if path.suffix != ".toml":
        raise UsageError(f"cannot write {path}: a mechanism's file ends in .toml", hint=f"assur new {path.stem}.toml")
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_-]*", path.stem):
        raise UsageError(
            f"'{path.stem}' is no name for a mechanism; allowed: letters, digits, _ and -",
            hint="the name of the file is the name of the mechanism",
        )
    return path.stem

"""`assur schema`: the form of a mechanism's file, or of the answers of commands, as a JSON Schema."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from assur.cli.options import PLAIN, Outcome, Plain
from assur.errors import UnknownNameError, UsageError

if TYPE_CHECKING:
    from rich.console import RenderableType


def schema(
    command: Annotated[
        str | None, Parameter(name="COMMAND", help="With --answers: of this command alone, as direct.")
    ] = None,
    /,
    *,
    answers: Annotated[bool, Parameter(help="The schema of what commands print with --json.")] = False,
    shared: Plain = PLAIN,  # noqa: ARG001  # read by main
) -> Outcome:
    """Print the JSON Schema of a mechanism's file: an editor then completes and checks keys while you type.

    It describes the form alone; `assur check` finds the rest. With --answers:
    the schema (draft 2020-12) of what commands print with --json, an error too.

    For example:
        assur schema > mechanism.schema.json
        assur schema --answers direct > direct.schema.json
    """
    if answers:
        return _printed(_of_answers(command))
    if command is not None:
        raise UsageError(f"schema {command}: a mechanism's file is of no command", hint="add --answers")
    from assur.cli.output import Verbatim
    from assur.model.file.json_schema import json_schema, schema_text

    return Outcome(json_schema(), lambda: [Verbatim(schema_text().rstrip("\n"))])


def _of_answers(command: str | None) -> dict[str, Any]:
    from assur.cli.answers import ANSWERS
    from assur.results.answers.schema import schema_of

    if command is not None and command not in ANSWERS:
        raise UnknownNameError("command", command, ANSWERS)
    return schema_of(ANSWERS if command is None else {command: ANSWERS[command]})


def _printed(found: dict[str, Any]) -> Outcome:
    def shown() -> list[RenderableType]:
        import json

        from assur.cli.output import Verbatim

        return [Verbatim(json.dumps(found, indent=2, ensure_ascii=False))]

    return Outcome(found, shown)

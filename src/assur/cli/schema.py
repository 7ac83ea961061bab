"""`assur schema`: the form of a mechanism's file, or of the answers of commands, as a JSON Schema."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from assur.cli.options import PLAIN, Outcome, Plain
from assur.errors import UnknownNameError, UsageError

if TYPE_CHECKING:
    from assur.results.answers.schema import Schema


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
    if command is not None and not answers:
        raise UsageError(f"schema {command}: a mechanism's file is of no command", hint="add --answers")
    from assur.cli.output import Verbatim
    from assur.model.file.json_schema import json_schema
    from assur.results.answers.catalogue import SchemaAnswer
    from assur.results.json_text import indented

    answer = SchemaAnswer(_of_answers(command) if answers else json_schema())
    return Outcome(answer, lambda: [Verbatim(indented(answer.schema))])


def _of_answers(command: str | None) -> Schema:
    from assur.cli.answers import ANSWERS
    from assur.results.answers.schema import schema_of

    if command is not None and command not in ANSWERS:
        raise UnknownNameError("command", command, ANSWERS)
    return schema_of(ANSWERS if command is None else {command: ANSWERS[command]})

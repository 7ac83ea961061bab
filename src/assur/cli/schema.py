"""`assur schema`: the form of a mechanism's file as a JSON Schema, for editors."""

from __future__ import annotations

from assur.cli.options import PLAIN, Outcome, Plain


def schema(*, shared: Plain = PLAIN) -> Outcome:  # noqa: ARG001  # read by main
    """Print the JSON Schema of a mechanism's file: an editor then completes and checks keys while you type.

    It describes the form alone; `assur check` finds the rest.

    For example:
        assur schema > mechanism.schema.json
    """
    from assur.cli.output import Verbatim
    from assur.model.file.json_schema import json_schema, schema_text

    return Outcome(json_schema(), lambda: [Verbatim(schema_text().rstrip("\n"))])

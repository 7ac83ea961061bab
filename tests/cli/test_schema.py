import json
from pathlib import Path

from assur.model.file.json_schema import json_schema

PAGE = Path(__file__).parents[2] / "docs" / "mechanism.schema.json"


def test_the_schema_is_printed_as_it_is_committed(assur_cli):
    run = assur_cli("schema")
    assert (run.code, run.err) == (0, "")
    assert run.out == PAGE.read_text(encoding="utf-8")


def test_it_is_one_object_with_json(assur_cli):
    assert assur_cli("schema", "--json").json == json_schema() == json.loads(assur_cli("schema").out)

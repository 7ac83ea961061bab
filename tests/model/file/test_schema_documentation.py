"""The page on the file form: its example is read, and it names every key there is."""

import math
import re
from pathlib import Path

import pytest

from assur.model.file import schema
from assur.model.file.reader import read_text

PAGE = (Path(__file__).parents[3] / "docs" / "mechanism-file.md").read_text(encoding="utf-8")


def test_the_example_is_a_mechanism() -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    record = read_text(text, Path("example.toml"))
    assert (len(record.links), len(record.joints), len(record.inputs)) == (8, 9, 3)
    assert [item.name for item in record.inputs] == ["q1", "q2", "q3"]
    # one limb, by hand: base point, crank and rod lead to the platform's point
    home = record.home[:3]
    directions = [home[0], home[0] + home[1]]
    x = 200 + sum(length * math.cos(angle) for length, angle in zip((100, 120), directions, strict=True))
    y = sum(length * math.sin(angle) for length, angle in zip((100, 120), directions, strict=True))
    assert (x, y) == (pytest.approx(60, abs=0.5), pytest.approx(0, abs=0.5))
    assert sum(home) == pytest.approx(2 * math.pi)


MODELS = [
    schema.FileEntry, schema.ParameterEntry, schema.PlatformEntry, schema.LimbEntry, schema.Repeat, schema.InputEntry,
    schema.InputTable, schema.GeneralisedEntry, schema.ChainEntry, schema.WorkspaceEntry, schema.ModesEntry,
    schema.Cone, schema.MaterialEntry, schema.ProfileEntry, schema.GravityEntry, schema.LinkEntry,
    schema.ActuatorEntry, schema.GearEntry, schema.FrictionEntry, schema.ToleranceEntry, *schema.JOINT_ENTRIES.values(),
]  # fmt: skip


@pytest.mark.parametrize("model", MODELS)
def test_every_key_is_documented(model: type[schema.Entry]) -> None:
    for key in model.model_fields:
        assert re.search(rf"`(\[(limbs\.)?)?{key}(\]|\.name\])?( = .*?)?`", PAGE), key


@pytest.mark.parametrize("kind", [*schema.JOINT_ENTRIES, "P(4R)", "P(4U)", "P(4S)"])
def test_every_kind_of_joint_is_documented(kind: str) -> None:
    assert f"`{kind}`" in PAGE

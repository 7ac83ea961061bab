"""A Delta without closed form whose rods have ball joints at both ends, and therefore spin."""

from pathlib import Path

import pytest

import assur

DELTA = Path(__file__).parents[1] / "model" / "file" / "delta.toml"


@pytest.fixture(scope="session")
def balls(tmp_path_factory):
    text = DELTA.read_text()
    for old, new in (
        ('type = "universal"', 'type = "spherical"'),
        (', axes = ["y", [1, 0, 2]]', ""),
        ("[5, 6]", "[6, 5, 0]"),
        ("B1.second", "B1.rx"),
    ):
        assert old in text
        text = text.replace(old, new)
    path = tmp_path_factory.mktemp("delta") / "balls.toml"
    path.write_text(text)
    return assur.load(path)

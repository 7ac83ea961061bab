"""The recipes of docs/ lead to what they say: each is followed to the letter in a copy of the checkout."""

from pathlib import Path

import pytest

from catalogue import each
from recipes import Checkout, followed

DOCS = Path(__file__).parents[1] / "docs"
TOUCHED = {"adding-a-joint-type": 8, "adding-an-index": 1, "adding-a-mechanism": 1}
"""How many files that were there before a recipe may touch."""


@pytest.mark.slow
@pytest.mark.parametrize("name", each(TOUCHED, ["adding-a-mechanism"]))
def test_a_recipe_is_followed_to_the_letter(name, tmp_path):
    steps = followed(DOCS / f"{name}.md", Checkout.at(tmp_path))
    assert len(steps.existing) <= TOUCHED[name]
    assert any(line.startswith("assur ") for line in steps.typed)
    assert any(line.startswith("python -m pytest ") for line in steps.typed)


def test_what_does_not_stand_in_a_file_is_not_changed(tmp_path):
    (tmp_path / "a").write_text("one\ntwo\n")
    checkout = Checkout(tmp_path)
    checkout.changed("a", " one\n-two\n+three\n")
    assert (tmp_path / "a").read_text() == "one\nthree\n"
    with pytest.raises(AssertionError):
        checkout.changed("a", "-two\n+three\n")

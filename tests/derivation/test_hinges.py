"""What joints say of orientations, where home's frames are not parallel."""

import pytest

from assur.cli.main import main
from assur.derivation.derivation import derive
from assur.kinematics.naming import described_signs
from assur.model.registry import load_record


@pytest.mark.parametrize("shorthand", ["Delta", "linear Delta"])
def test_rods_between_balls_may_stand_turned_about_their_short_links_at_home(shorthand, tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), shorthand]) == 0
    assert len(derive(load_record(str(path))).direct.roots) == 1


@pytest.mark.deep
def test_the_root_of_a_delta_has_the_sign_of_its_translations(tmp_path, capsys):
    """Whether its platform could turn as well is another factor of the closure, and no sign of the two assemblies."""
    path, form = tmp_path / "mine.toml", tmp_path / "formulas.py"
    assert main(["new", str(path), "Delta"]) == 0
    (sign,) = described_signs(load_record(str(path)), "direct")
    assert main(["derive", str(path), "-o", str(form)]) == 0
    assert f'"{sign.name}"' in form.read_text()

"""A workspace box without home in it: no fault, but a note with its place."""

from assur.kinematics.validation.check import doubts
from assur.model.registry import load_record


def test_home_beyond_a_side_of_the_box_is_noted_with_its_line(tmp_path) -> None:
    text = load_record("fivebar").file.read_text(encoding="utf-8")
    path = tmp_path / "mine.toml"
    path.write_text(text.replace("y = [100, 260]", "y = [230, 260]"), encoding="utf-8")
    (note,) = doubts(load_record(path))
    line = next(k for k, row in enumerate(text.splitlines(), 1) if row.startswith("box"))
    assert (note.line, note.path) == (line, "workspace.box.y")
    assert note.given.startswith("home has y = 223.9")
    assert note.given.endswith("mm, outside 230 mm to 260 mm")

import pytest

from assur.errors import OutputError
from assur.results.files import write_whole


def test_a_file_is_written_whole(tmp_path):
    path = write_whole(tmp_path / "a.txt", "new")
    assert path.read_text() == "new"
    assert [item.name for item in tmp_path.iterdir()] == ["a.txt"]


def test_the_old_file_stays_where_the_new_one_cannot_be_written(tmp_path, monkeypatch):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def fail(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", fail)
    with pytest.raises(OutputError, match="No space left on device"):
        write_whole(path, b"new")
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == ["a.txt"]


def test_a_missing_folder_and_a_folder_for_a_file_are_refused(tmp_path):
    with pytest.raises(OutputError, match="does not exist"):
        write_whole(tmp_path / "nowhere" / "a.txt", "x")
    with pytest.raises(OutputError, match="is a folder"):
        write_whole(tmp_path, "x")

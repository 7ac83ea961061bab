import pytest

from assur.cli.called import called


@pytest.mark.parametrize(
    ("typed", "found", "said"),
    [
        ("assur", "/usr/bin/assur", "assur"),
        (".venv/bin/assur", "/usr/bin/assur", "assur"),
        (".venv/bin/assur", None, ".venv/bin/assur"),
        ("pytest", None, "assur"),
    ],
)
def test_a_line_that_is_printed_can_be_typed(monkeypatch, typed, found, said):
    monkeypatch.setattr("sys.argv", [typed])
    monkeypatch.setattr("shutil.which", lambda _: found)
    assert called() == said

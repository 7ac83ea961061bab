"""The pages of docs/ say what is so: their Python runs, their printed output is real, their links lead somewhere."""

import doctest
import re
from pathlib import Path

import pytest

from shown import OUTPUT, printed, rounded

DOCS = Path(__file__).parents[1] / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
NAMES = [path.relative_to(DOCS).as_posix() for path in PAGES]
STEP = re.compile(
    r"<!-- edit: (\S+) -> (\S+): (.*?) -->|<!-- file: (\S+) -->\n```toml\n(.*?)```|" + OUTPUT.pattern, re.DOTALL
)
"""What a page does, in its order: a file that is copied with words replaced, or that is shown; and a command with what
it prints."""


def text_of(path):
    return path.read_text(encoding="utf-8")


def edit(source, target, changes):
    text = text_of(Path(source))
    for change in changes.split(": "):
        old, new = change.split(" -> ")
        assert old in text, old
        text = text.replace(old, new)
    Path(target).write_text(text, encoding="utf-8")


SAYING = [path for path in PAGES if OUTPUT.search(text_of(path)) or "\n>>> " in text_of(path)]


@pytest.mark.parametrize("path", SAYING, ids=[path.stem for path in SAYING])
def test_what_it_shows_is_what_comes_out(path, capsys, tmp_path, monkeypatch):
    """Its commands one after the other in one folder, as a reader would take them, then its Python there."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(DOCS.parent / "examples")
    for source, target, changes, file, content, command, shown in STEP.findall(text_of(path)):
        if source:
            edit(source, target, changes)
        elif file:
            Path(file).write_text(content, encoding="utf-8")
        else:
            assert rounded(printed(command, capsys)) == rounded(shown), command
    assert doctest.testfile(str(path), module_relative=False, encoding="utf-8").failed == 0


def test_those_that_show_something_are_found():
    saying = {"index", "first-steps", "theory", "adding-an-analysis", "indices", "kinematics", "certificates"}
    assert saying <= {path.stem for path in SAYING}
    assert len(OUTPUT.findall(text_of(DOCS / "theory.md"))) == text_of(DOCS / "theory.md").count("<!-- output:") > 5


@pytest.mark.parametrize("path", PAGES, ids=NAMES)
def test_pictures_and_links_exist(path):
    for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text_of(path)):
        assert (path.parent / target).is_file(), target


def test_every_page_is_in_a_table_of_contents():
    named = set()
    for path in PAGES:
        for tree in re.findall(r"```\{toctree\}\n(.*?)```", text_of(path), re.DOTALL):
            lines = [line for line in tree.splitlines() if line and not line.startswith(":")]
            named |= {(path.parent / f"{line}.md").relative_to(DOCS).as_posix() for line in lines}
    assert named == set(NAMES) - {"index.md"}


def test_commands_that_are_shown_exist():
    from assur.cli.application import application

    known = set(application())
    form = re.compile(r"(?:^|^    |`)assur ([a-z]+)", re.MULTILINE)
    named = {(path.name, word) for path in PAGES for word in form.findall(text_of(path))}
    assert len(named) > 20
    assert {pair for pair in named if pair[1] not in known} == set()


def test_the_gallery_has_every_kind_of_figure():
    import assur
    from assur.figures.catalogue import ENTRIES, names

    marks = re.findall(r"<!-- made: gallery (\w+) ?(.*?) -->", text_of(DOCS / "gallery.md"))
    shown = {figure for name, chosen in marks for figure in chosen.split() or names(assur.load(name))}
    assert {entry.name for entry in ENTRIES} == shown


def test_what_a_method_refers_to_is_described():
    from assur.mechanism import Mechanism

    described = re.findall(r"\.\. auto\w+:: (\S+)", text_of(DOCS / "api" / "analyses.md"))
    methods = [getattr(Mechanism, name).__doc__ or "" for name in dir(Mechanism) if not name.startswith("_")]
    named = [name for text in methods for name in re.findall(r"`(assur\.[\w.]+)`", text)]
    assert len(named) > 12
    for name in set(named) - {"assur.topology"}:  # the function; it stands on the page before
        assert [item for item in described if item == name or item.startswith(f"{name}.")], name

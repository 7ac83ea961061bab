import contextlib
import json
from collections.abc import Iterator
from importlib.resources import files
from typing import Any

import pytest

from assur.errors import KeyPath, MechanismFileError
from assur.model.file.toml_source import read_toml

DOCUMENT = r'''
top = 1                       # a comment with "quotes" and = signs
"quoted key" . b = [1, [2,
   3], { c = 4 } ]            # line 3 and 4

[table.'a.b']                 # line 6
text = """
[no.table]
key = "no key"
\""""
after = "x]}#"                # line 11
literal = \'\'\'
# no comment\'\'\'
inline = { x = 1, "y z" = { w = [] }, v = "}" }
[table.more]
dotted.name = true            # line 16
[[array]]
n = 1979-05-27T07:32:00Z
[[array]]
n = -inf
'''.replace("\\'", "'")


def paths(data: Any, path: KeyPath = ()) -> Iterator[KeyPath]:
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield (*path, key)
        yield from paths(value, (*path, key))


def test_lines_of_keys_and_elements() -> None:
    source = read_toml(DOCUMENT, "f.toml")
    expected: dict[KeyPath, int] = {
        ("top",): 2,
        ("quoted key", "b"): 3,
        ("quoted key", "b", 0): 3,
        ("quoted key", "b", 1, 0): 3,
        ("quoted key", "b", 1, 1): 4,
        ("quoted key", "b", 2, "c"): 4,
        ("table", "a.b"): 6,
        ("table", "a.b", "text"): 7,
        ("table", "a.b", "after"): 11,
        ("table", "a.b", "literal"): 12,
        ("table", "a.b", "inline", "y z", "w"): 14,
        ("table", "a.b", "inline", "v"): 14,
        ("table", "more", "dotted", "name"): 16,
        ("array",): 17,
    }
    assert {path: source.lines[path] for path in expected} == expected
    assert source.line(("top", "nothing", 3)) == 2
    assert source.line(("nothing",)) == 1  # the document


def test_windows_line_ends_change_no_line() -> None:
    assert read_toml(DOCUMENT.replace("\n", "\r\n"), "f").lines == read_toml(DOCUMENT, "f").lines


def test_every_key_and_element_has_a_line(fourbar: str) -> None:
    built_in = files("assur").joinpath("mechanisms/zeng2019/mechanism.toml").read_text(encoding="utf-8")
    for text in (fourbar, built_in):
        source = read_toml(text, "f.toml")
        assert set(paths(source.data)) == set(source.lines)
        rows = text.splitlines()
        for path, line in source.lines.items():
            if isinstance(path[-1], str):
                assert path[-1] in rows[line - 1]


COMMA = "write decimals with a point: 0.5, not 0,5"
ONCE = "each name may be given once"
WRONG = [
    ("a = 1\nb = 3,5", 2, "b = 3,5", COMMA, 0),
    ("a = { v = 3,5, m = 1 }", 1, "a = { v = 3,5, m = 1 }", COMMA, 0),
    ("a = 1\n\na = 2", 3, "a = 2", ONCE, 1),
    ("b = 1\n[a]\n[a]", 3, "[a]", ONCE, 2),
    ("\na = {b=1,b=2}", 2, "a = {b=1,b=2}", ONCE, 2),
    ("[t]\na = [\n1,\n2]\nb = 1\n[u]\n[t.a]\nc = 1", 7, "[t.a]", ONCE, 2),
    ("\na = {b=1}\n[a.c]\nd = 1", 3, "[a.c]", ONCE, 2),
    ("\na = {b=1}\na.c = 2", 3, "a.c = 2", ONCE, 2),
    ("\na.b = 1\n[a]", 3, "[a]", ONCE, 2),
    ("[[a]]\n[a]", 2, "[a]", ONCE, 1),
    ("[x]\n[a.b]\n[a]\nb.c=2", 4, "b.c=2", ONCE, 2),
    ("a = ", 1, "a =", "", 0),
    ("a = 'x\n", 1, "a = 'x", "", 0),
]


@pytest.mark.parametrize(("text", "line", "row", "hint", "first"), WRONG)
def test_what_is_not_toml_is_refused_with_its_line(text: str, line: int, row: str, hint: str, first: int) -> None:
    with pytest.raises(MechanismFileError) as caught:
        read_toml(text, "f.toml")
    (problem,) = caught.value.problems
    assert (problem.file, problem.line, problem.hint) == ("f.toml", line, hint)
    assert problem.given.startswith("not TOML: ")
    again = f"; the first one is in line {first}" if first else ""
    assert problem.given.endswith(f" in `{row}`{again}")


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("unit = mm\nx = 1\nangle = deg\n[t]\ny = on # [", [1, 3, 5]),
        ("unit mm\nangle = 3 4", [1, 2]),
        ("a = [1, 2\nb = mm", [2]),
        ("a = { b = 1, c = [1,\n2}\nd = mm", [2]),
        ('a = "x\nb = mm', [1]),
        ("[links\nground = mm", [1]),
        ("\n".join(f"a{k} = mm" for k in range(50)), list(range(1, 21))),
    ],
)
def test_what_does_not_follow_from_one_error_is_told_with_it(text: str, lines: list[int]) -> None:
    """A value in a line of its own is left out; after anything that may reach into other lines reading stops."""
    with pytest.raises(MechanismFileError) as caught:
        read_toml(text, "f.toml")
    assert [problem.line for problem in caught.value.problems] == lines


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a = " + "[" * 5000 + "]" * 5000, "brackets nested too deeply"),
        ("a = " + "1" * 5000, "not TOML"),
        ("#" * 200_001, "200001 characters"),
        ("a = 0x" + "f" * 5000, "a whole number of thousands of digits"),
        ("a" + ".a" * 20 + " = 1", "brackets nested too deeply; at most 20 levels"),
        ("a" + ".a" * 50_000 + " = 1", "brackets nested too deeply; at most 20 levels"),
        ("a = [" + "1," * 5001 + "]", "5001 elements in one list; at most 5000"),
        ("\n".join(f"a{n} = 1" for n in range(5001)), "5001 keys in one table; at most 5000"),
    ],
)
def test_what_is_too_large_is_refused(text: str, found: str) -> None:
    with pytest.raises(MechanismFileError, match=found):
        read_toml(text, "f.toml")


def test_depth_is_told_with_its_line_and_is_none_in_a_text_or_a_comment() -> None:
    deep = "a" + ".a" * 25
    source = read_toml(f'# {deep}\nx = "{deep}"\ny = """\n{deep}"""\nz = \'{deep}\'\n', "f.toml")
    assert source.data == dict.fromkeys("xyz", deep)
    with pytest.raises(MechanismFileError) as caught:
        read_toml(f"x = 1\n\n[{deep}]", "f.toml")
    assert caught.value.problems[0].line == 3


def test_brackets_as_deep_as_the_toml_reader_goes_are_no_crash() -> None:
    for depth in range(50, 500, 25):
        with contextlib.suppress(MechanismFileError):
            read_toml("a = " + "[" * depth + "]" * depth, "f.toml")


def test_every_name_that_is_given_again_is_told_with_its_first_line() -> None:
    with pytest.raises(MechanismFileError) as caught:
        read_toml("a = 1\nb = 1\na = 2\nc = 3,5\nb = 2\n", "f.toml")
    told = [(problem.line, problem.given.partition("; ")[2]) for problem in caught.value.problems]
    assert told == [(3, "the first one is in line 1"), (4, ""), (5, "the first one is in line 2")]


UNSEEN = [
    "\x1b[2J",
    "\x1b]0;title\x07",
    "\x00",
    "\r",
    "\x7f",
    "\x9b2J",
    "\u202e",
    "\u2066",
    "\u200b",
    "\u2028",
    "\ufeff",
]


@pytest.mark.parametrize("sign", UNSEEN)
def test_what_a_terminal_obeys_and_nobody_sees_is_refused_in_every_text(sign: str) -> None:
    written = json.dumps(f"a{sign}b").replace("\x7f", "\\u007f")
    for text in (f"\n{written} = 1", f"\nt = {written}", f"[a]\nt = [{{ b = [0, {written}] }}]"):
        with pytest.raises(MechanismFileError, match=rf"f.toml:2: .*U\+{ord(sign[0]):04X}") as caught:
            read_toml(text, "f.toml")
        assert str(caught.value).replace("\n", "").isprintable()


def test_texts_of_any_script_and_of_several_lines_are_read() -> None:
    text = "Größe\tβ\nПлатформа \u05d0\u05d1 \u754c \U0001f916 \u00a0."
    assert read_toml(f"t = {json.dumps(text, ensure_ascii=False)}", "f.toml").data["t"] == text


def test_a_name_has_100_characters_at_most() -> None:
    read_toml(f"[{'a' * 100}]", "f.toml")
    with pytest.raises(MechanismFileError, match=r"f.toml:1: .*a name of 101 characters; allowed: at most 100"):
        read_toml(f"[{'a' * 101}]", "f.toml")

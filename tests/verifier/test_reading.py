import hashlib
import json

import pytest

from assur.verifier.check import verify
from assur.verifier.reading import MalformedError, RefusedError, names, number, numbers, read


def test_a_certificate_is_read_as_it_is(case, made_of):
    assert read(made_of(case).text.encode()) == made_of(case).to_json()


@pytest.mark.parametrize(
    "content", [b"", b"{", b"[]", b"null", b"{}", b"\xff\xfe", b"[" * 100_000, b'{"format": "other"}']
)
def test_what_is_no_certificate_is_refused(content):
    with pytest.raises(MalformedError):
        read(content)


def test_truncated_anywhere(made_of):
    content = made_of("paper").text.encode().rstrip()
    for end in range(0, len(content) - 1, 97):
        with pytest.raises(MalformedError):
            read(content[:end])
    with pytest.raises(MalformedError):
        read(content + b"}")


def test_one_byte_changed_anywhere(made_of):
    content = made_of("box in part").text.encode().rstrip()
    for place in range(0, len(content), 13):
        changed = content[:place] + (b"7" if content[place : place + 1] != b"7" else b"8") + content[place + 1 :]
        with pytest.raises(MalformedError):
            read(changed)


@pytest.mark.parametrize("key", ["kind", "statement", "program", "claims", "proof", "made_by"])
def test_a_missing_or_an_added_key_is_refused(forged, key):
    with pytest.raises(MalformedError, match="keys"):
        read(forged("box", lambda document: document.pop(key)))
    with pytest.raises(MalformedError, match="keys"):
        read(forged("box", lambda document: document.update({f"{key}2": 1})))


def test_true_is_no_version(forged):
    with pytest.raises(MalformedError, match="version True of the format"):
        read(forged("box", lambda document: document.update(version=True)))


def test_another_version_of_the_format_is_refused(forged):
    with pytest.raises(MalformedError, match="version 4 of the format; this verifier knows 3"):
        read(forged("box", lambda document: document.update(version=4)))


ZERO, DIGEST = (0.0).hex(), "0" * 64
BOTH = {"mechanism.toml": DIGEST, "closed_form.py": DIGEST}
UNREADABLE = {
    "mechanism": [["zeng2019"], None, True, 5, {}, "zeng\x1b[2J2019", "zeng2019\n", "zeng\u202e2019", "\ud800"],
    "mode": [None, 5, [], "+\x1b[31m", "+\r-"],
    "coordinates": [None, "xyz", ["x", "x", "y"], ["x", "y", 5], ["x", "y", True], ["x", "y", "z\x1b[2J"]],
    "parameters": [[], None, "l2", *({"l2": value} for value in (300, "300", "0x1p5000", None)), {"l\x1b[2J": ZERO}],
    "held": [[1], None, *({"a": value} for value in ("0x1p5000", True, [ZERO], "inf")), {"\x07": ZERO}],
    "strokes": [
        *([], None, {"\n": None}),
        *({"yA1": pair} for pair in (ZERO, [ZERO], [ZERO] * 3, {ZERO: 1, "-inf": 2})),
        *({"yA1": [ZERO, end]} for end in ("nan", "0x1p5000", None, 1, True, "Infinity", ["inf"])),
    ],
    "files": [
        *([], {}, None, {"mechanism.toml": DIGEST}, {"closed_form.py": DIGEST}, {**BOTH, "a": DIGEST}),
        *({"mechanism.toml": DIGEST, "a": DIGEST}, {"closed_form.py": DIGEST, "\x1b": DIGEST}),
        *({**BOTH, "mechanism.toml": digest} for digest in (5, None, "", DIGEST[:-1], DIGEST + "\n", "F" * 64)),
    ],
}


@pytest.mark.parametrize("key", UNREADABLE)
def test_a_statement_of_other_types_is_refused(forged, key):
    for value in UNREADABLE[key]:
        with pytest.raises(MalformedError) as caught:
            verify(forged("box", lambda document, value=value: document["statement"].update({key: value})))
        assert str(caught.value).isprintable()


def test_strokes_without_an_end_are_read(forged):
    strokes = {"yA1": ["-inf", ZERO], "yA2": [ZERO, "inf"], "yA3": None}
    document = read(forged("box", lambda document: document["statement"].update(strokes=strokes)))
    assert document["statement"]["strokes"] == strokes


@pytest.mark.parametrize("value", [{"x": 1}, None, True, "assur \x1b[2J"])
def test_who_made_it_is_a_printable_text(forged, value):
    with pytest.raises(MalformedError, match="no printable text"):
        read(forged("box", lambda document: document.update(made_by=value)))


@pytest.mark.parametrize("group", ["margins", "nonzero", "factors"])
def test_names_in_the_program_are_printable(forged, group):
    with pytest.raises(MalformedError, match="no printable text"):
        verify(forged("box", lambda document: document["program"][group].append(["a\x1b[2J", 0])))


def test_numbers_that_are_none_are_refused(made_of):
    text = made_of("box").text
    for bad in ("NaN", "Infinity", "1e999", "1.5", "1e" + "9" * 500, "9" * 5000, '{"a": 1, "a": 2}'):
        with pytest.raises(MalformedError, match="not JSON"):
            read(text.replace('"version": 3', f'"version": {bad}').encode())


def test_the_checksum_is_that_of_sorted_json(made_of):
    document = made_of("box").to_json()
    rest = {key: document[key] for key in document if key != "sha256"}
    text = json.dumps(rest, sort_keys=True, separators=(",", ":"))
    assert hashlib.sha256(text.encode()).hexdigest() == document["sha256"]


def test_only_the_usual_hex_spelling_is_a_number():
    assert number("-0x1.8000000000000p+1") == -3.0
    texts = ("0x1.8p+1", "3.0", "inf", "nan", " 0x1.8000000000000p+1", "", "0X1.8000000000000P+1", "0x1p5000")
    for text in (*texts, True, None, [], 1):
        with pytest.raises(ValueError, match="no finite float"):
            number(text)
    assert numbers(["0x1.8000000000000p+1"]) == [3.0]
    for wrong in ({"0x1.8000000000000p+1": 0}, "0", None, ("0x1.8000000000000p+1",)):
        with pytest.raises(ValueError, match="no list of numbers"):
            numbers(wrong)


def test_names_differ():
    assert names(["a", "b"]) == ["a", "b"]
    for wrong in (["a", "a"], "ab", ("a", "b"), [1], None):
        with pytest.raises((ValueError, TypeError)):
            names(wrong)


def test_what_is_malformed_is_refused():
    assert issubclass(MalformedError, RefusedError)

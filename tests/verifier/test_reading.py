from __future__ import annotations

import hashlib
import json

import pytest

from assur.verifier.reading import MalformedError, RefusedError, names, number, read


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


def test_another_version_of_the_format_is_refused(forged):
    with pytest.raises(MalformedError, match="version 2 of the format; this verifier knows 1"):
        read(forged("box", lambda document: document.update(version=2)))


def test_numbers_that_are_none_are_refused(made_of):
    text = made_of("box").text
    for bad in ("NaN", "Infinity", "1e999", "1.5", "9" * 5000, '{"a": 1, "a": 2}'):
        with pytest.raises(MalformedError, match="not JSON"):
            read(text.replace('"version": 1', f'"version": {bad}').encode())


def test_the_checksum_is_that_of_sorted_json(made_of):
    document = made_of("box").to_json()
    rest = {key: document[key] for key in document if key != "sha256"}
    text = json.dumps(rest, sort_keys=True, separators=(",", ":"))
    assert hashlib.sha256(text.encode()).hexdigest() == document["sha256"]


def test_only_the_usual_hex_spelling_is_a_number():
    assert number("-0x1.8000000000000p+1") == -3.0
    for text in ("0x1.8p+1", "3.0", "inf", "nan", " 0x1.8000000000000p+1", "", "0X1.8000000000000P+1"):
        with pytest.raises(ValueError):
            number(text)


def test_names_differ():
    assert names(["a", "b"]) == ["a", "b"]
    for wrong in (["a", "a"], "ab", ("a", "b"), [1], None):
        with pytest.raises((ValueError, TypeError)):
            names(wrong)


def test_what_is_malformed_is_refused():
    assert issubclass(MalformedError, RefusedError)

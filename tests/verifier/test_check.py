"""Valid certificates verify; whatever is changed in one is refused, a checksum put right by the forger included."""

import ast
import hashlib
import json
import re
import shutil
from pathlib import Path

import pytest
from flint import ctx

import assur.verifier
from assur.certificates.recorded import differences
from assur.model.registry import load_record
from assur.verifier.check import TOKEN, verify
from assur.verifier.reading import MalformedError, RefusedError
from hand_certificates import NO_JOINTS, UNPROVED

SOURCES = sorted(Path(assur.verifier.__file__).parent.glob("*.py"))


def tokens_of(document):
    return TOKEN.findall(document["proof"])


def test_valid_ones_verify_with_the_files_at_hand(case, made_of):
    certificate = made_of(case)
    folder = load_record(certificate.statement["mechanism"]).file.parent
    assert verify(certificate.text.encode(), folder) == json.loads(certificate.text)


def test_the_precision_is_put_back(made_of):
    ctx.prec = 77
    verify(made_of("box").text.encode())
    assert ctx.prec == 77
    ctx.prec = 53


def changed_tokens(case, made_of, change):
    """Documents with one leaf or cut changed, at up to eight places."""
    tokens = tokens_of(made_of(case).to_json())
    places = [k for k, token in enumerate(tokens) if change(token) is not None]
    for k in places[:: max(1, len(places) // 7)]:
        yield "".join([*tokens[:k], change(tokens[k]), *tokens[k + 1 :]])


CHANGES = {
    "open taken for inside": lambda token: "i" if token == "b" else None,
    "open taken for regular": lambda token: "r" if token == "b" else None,
    "open taken for outside": lambda token: "o00" if token == "b" else None,
    "outside taken for inside": lambda token: "i" if token[0] == "o" else None,
    "outside taken for regular": lambda token: "r" if token[0] == "o" else None,
    "inside taken for outside": lambda token: "o01" if token in "ir" else None,
    "inside taken for regular": lambda token: "r" if token == "i" else None,
    "inside left open": lambda token: "b" if token in "ir" else None,
    "outside left open": lambda token: "b" if token[0] == "o" else None,
    "regular taken for inside": lambda token: "i" if token == "r" else None,
    "outside by a margin that is none": lambda token: "off" if token[0] == "o" else None,
    "a leaf halved": lambda token: "0" if not token.isdigit() else None,
    "a cut left out": lambda token: "b" if token.isdigit() else None,
    "a cut across what is none": lambda token: "9" if token.isdigit() else None,
    "a leaf left out": lambda token: "" if not token.isdigit() else None,
    "a leaf twice": lambda token: token * 2 if not token.isdigit() else None,
    "a sign that is none": lambda token: "?" if not token.isdigit() else None,
}


@pytest.mark.parametrize("change", CHANGES)
def test_one_part_of_the_proof_changed_is_refused(case, change, made_of, forged):
    for proof in changed_tokens(case, made_of, CHANGES[change]):
        with pytest.raises(RefusedError):
            verify(forged(case, lambda document, proof=proof: document.update(proof=proof)))


def test_every_change_was_tried(made_of):
    for change in CHANGES.values():
        assert any(list(changed_tokens(case, made_of, change)) for case in ("paper", "box in part"))


def test_leaves_before_or_after_the_end_are_refused(forged):
    for extra in ("b", "0bb", "i", "o00"):
        with pytest.raises(MalformedError, match="goes on after its end"):
            verify(forged("paper", lambda document, extra=extra: document.update(proof=document["proof"] + extra)))
    with pytest.raises(MalformedError, match="cut short"):
        verify(forged("paper", lambda document: document.update(proof="".join(tokens_of(document)[:-1]))))
    for proof in ("", None, 5, ["b"], "0" * 200 + "b" * 201):
        with pytest.raises(MalformedError):
            verify(forged("paper", lambda document, proof=proof: document.update(proof=proof)))


def edits(value, path=()):
    """(path, another value) for every leaf of plain data."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from edits(item, (*path, key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from edits(item, (*path, index))
    elif isinstance(value, str) and re.fullmatch(r"-?0x.*", value):
        number = float.fromhex(value)
        for other in (number * 1.01 + 1e-3, number * 0.99 - 1e-3, -number - 1.0, 1e300):
            yield path, other.hex()
        for other in ("inf", "nan", "0x1p+2000", str(number), None, number):
            yield path, other
    elif isinstance(value, int):
        for other in (value + 1, value - 1, -1, 10**30, None, str(value), value + 0.5):
            yield path, other
    else:
        for other in ("no", "yes", "open", None, 3, [], {}):
            if other != value:
                yield path, other


def put(document, path, value):
    for key in path[:-1]:
        document = document[key]
    document[path[-1]] = value


@pytest.mark.parametrize("part", ["claims", ("statement", "box"), ("statement", "coordinates")])
def test_every_edit_of_claims_and_bounds_is_refused(case, part, made_of, forged):
    path = (part,) if isinstance(part, str) else part
    if case.startswith("path") and part[-1] == "box":
        path = ("statement", "from")
    value = made_of(case).to_json()
    for key in path:
        value = value[key]
    tried = list(edits(value, path))
    assert len(tried) > 4
    for where, other in tried:
        if case.startswith("box") and where[1] == "box" and is_number(other):
            continue  # another box of which the same may be true; that of a volume is pinned by the volume
        with pytest.raises(RefusedError):
            verify(forged(case, lambda document, w=where, o=other: put(document, w, o)))


def is_number(text):
    return isinstance(text, str) and text.startswith(("0x1.", "-0x1."))


def test_true_is_no_count(forged):
    """In Python true equals 1; a reader of the file would see another claim than the one that is proved."""

    def with_count(document, value):
        assert document["claims"]["leaves"]["regular"] == 1
        document["claims"]["leaves"]["regular"] = value

    verify(forged("box", lambda document: with_count(document, 1)))
    for value in (True, 1.0):
        with pytest.raises(RefusedError):
            verify(forged("box", lambda document, value=value: with_count(document, value)))


def nested(depth):
    value = []
    for _ in range(depth):
        value = [value]
    return value


@pytest.mark.parametrize("key", ["claims", "proof", "made_by", "statement", "program"])
def test_what_is_nested_very_deep_is_refused(forged, key):
    for depth in (10, 100, 400, 800, 900):
        with pytest.raises(RefusedError):
            verify(forged("box", lambda document, depth=depth: document.update({key: nested(depth)})))
    text = forged("box", lambda document: document.update({key: "HERE"}))
    for depth in (*range(900, 1000, 2), 100_000):  # what still can be read may be too deep to be written
        with pytest.raises(MalformedError):
            verify(text.replace(b'"HERE"', b"[" * depth + b"]" * depth))


def test_what_stands_for_a_list_is_refused(forged):
    """An object whose keys are the numbers, or a number more than a pair has."""
    zero, one = (0.0).hex(), (1.0).hex()
    for pair in ({zero: 0, one: 0}, [zero, one, one], zero + one, [zero], [zero, None], None):
        with pytest.raises(MalformedError):
            verify(forged("box", lambda document, pair=pair: document["statement"].update(box=[pair] * 3)))
    for operation in ({"coordinate": 0, "x": 0}, ["coordinate", "x", 0], ["number", zero, one, 5], "ab", []):
        with pytest.raises(MalformedError):
            verify(forged("box", lambda document, o=operation: document["program"]["operations"].append(o)))
    label = ["number", zero, one, "a\x1b[2J"]
    with pytest.raises(MalformedError, match="no printable text"):
        verify(forged("box", lambda document: document["program"]["operations"].append(label)))
    for place in ("from", "to"):
        with pytest.raises(MalformedError):
            verify(forged("path", lambda document, place=place: objects_for_points(document["statement"], place)))


def objects_for_points(statement, place):
    point = dict.fromkeys(statement[place], 0)
    statement[place] = statement["points"][0 if place == "from" else -1] = point


def test_boxes_that_are_none_are_refused(forged):
    for box in (
        [],
        None,
        "box",
        [[(1.0).hex(), (0.0).hex()]] * 3,
        [[(1.0).hex()] * 2] * 3,
        [[(0.0).hex(), (1.0).hex()]] * 2,
    ):
        with pytest.raises(MalformedError):
            verify(forged("paper", lambda document, box=box: document["statement"].update(box=box)))


def test_claims_of_another_kind_are_refused(forged):
    with pytest.raises(RefusedError):
        verify(forged("paper", lambda document: document.update(kind="box")))
    for kind in ("path", None, ["box"], "Workspace"):
        with pytest.raises(MalformedError):
            verify(forged("paper", lambda document, kind=kind: document.update(kind=kind)))


@pytest.mark.parametrize(
    "case", ["paper", "held angle", "angular strokes", pytest.param("half angles", marks=pytest.mark.deep)]
)
def test_formulas_that_change_a_leaf_are_refused(case, made_of, forged):
    """Operations and dimensions changed: refused, or else the formulas are not those of the mechanism."""
    operations = made_of(case).program["operations"]
    needed = needed_by_margins(made_of(case).program)
    record, refused, tried = load_record(made_of(case).statement["mechanism"]), 0, 0
    for k in sorted(needed):
        name, *arguments = operations[k]
        if name == "number":
            low, high = (float.fromhex(text) * 1.5 + 0.7 for text in arguments[:2])
            other = ["number", low.hex(), high.hex(), arguments[2]]
        elif name in "+-*/":
            other = [{"+": "-", "-": "+", "*": "+", "/": "*"}[name], *arguments]
        elif name == "coordinate":
            continue
        else:
            other = ["negative", *arguments]
        tried += 1
        content = forged(case, lambda document, k=k, other=other: put(document, ("program", "operations", k), other))
        try:
            assert differences(verify(content), record)
        except RefusedError:
            refused += 1
    assert tried > 10
    assert refused >= 0.3 * tried


def needed_by_margins(program):
    needed = {k for _, k in program["margins"]}
    for k in range(len(program["operations"]) - 1, -1, -1):
        if k in needed:
            needed.update(a for a in program["operations"][k][1:] if isinstance(a, int))
    return needed


def sign_change(factor, regular):
    """A certificate about x in [-1, 1], all of it reached, whose factor is negative on the left, positive on the right.

    Entries: 0 is x, 1 the number 1, which is the only margin, and 2 the factor.
    """
    one = (1.0).hex()
    leaves = {"inside": 2, "regular": 2, "outside": 0, "open": 0}
    files = dict.fromkeys(("hand.toml", "closed_form.py"), "0" * 64)
    statement = {"mechanism": "hand", "files": files, "parameters": {}, "mode": "", "strokes": {}, "held": {}}
    document = {
        **{"format": "assur certificate", "version": 3, "kind": "box", "made_by": "hand", "exact": UNPROVED},
        "statement": {**statement, "coordinates": ["x"], "box": [[(-1.0).hex(), one]]},
        "program": {
            "operations": [["coordinate", "x"], ["number", one, one, "one"], factor],
            **{"margins": [["m", 1]], "nonzero": [], "factors": [["f", 2]]},
            **NO_JOINTS,
        },
        "claims": {"leaves": leaves, "reached": "yes", "regular": regular},
        "proof": "00ri0ir",
    }
    text = json.dumps(document, sort_keys=True, separators=(",", ":"))
    return json.dumps({**document, "sha256": hashlib.sha256(text.encode()).hexdigest()}).encode()


def test_a_sign_change_is_a_zero_only_where_the_factor_has_a_value():
    """x vanishes between -1 and 1. 1/x does not, though it changes its sign: it has a pole."""
    verify(sign_change(["+", 0, 0], "no"))
    with pytest.raises(RefusedError, match="is proved"):
        verify(sign_change(["+", 0, 0], "open"))
    verify(sign_change(["/", 1, 0], "open"))
    with pytest.raises(RefusedError, match="is proved"):
        verify(sign_change(["/", 1, 0], "no"))


def test_huge_numbers_end_in_a_refusal(forged):
    def squares(document):
        operations = document["program"]["operations"]
        start = document["program"]["margins"][0][1]
        operations += [["*", k, k] for k in [start, *range(len(operations), len(operations) + 60)]]
        operations.append(["cosine", len(operations) - 1])
        document["program"]["margins"][0][1] = len(operations) - 1

    with pytest.raises(RefusedError):
        verify(forged("paper", squares))
    huge = [[(-1.7e308).hex(), (1.7e308).hex()]] * 3
    with pytest.raises(RefusedError):
        verify(forged("paper", lambda document: document["statement"].update(box=huge)))
    with pytest.raises(MalformedError, match="OverflowError"):
        verify(forged("paper", lambda document: (document["statement"].update(box=huge), document.update(proof="b"))))


def test_the_files_must_be_those_it_was_made_for(made_of, forged, tmp_path):
    content = made_of("box").text.encode()
    folder = load_record("zeng2019").file.parent
    with pytest.raises(RefusedError, match="has no file mechanism"):
        verify(content, tmp_path)
    for name in ("mechanism.toml", "closed_form.py"):
        shutil.copy(folder / name, tmp_path)
    verify(content, tmp_path)
    with (tmp_path / "closed_form.py").open("a") as stream:
        stream.write("\n")
    with pytest.raises(RefusedError, match="another mechanism or version"):
        verify(content, tmp_path)
    with pytest.raises(RefusedError):
        verify(forged("box", lambda document: document["statement"].update(files={})), folder)
    with pytest.raises(RefusedError):
        verify(
            forged("box", lambda document: document["statement"].update(files={"../zeng2019/mechanism.toml": ""})),
            folder,
        )


def test_the_verifier_is_small_and_imports_nothing_of_the_project():
    allowed = {
        "__future__",
        "collections",
        "dataclasses",
        "fractions",
        "hashlib",
        "json",
        "math",
        "pathlib",
        "re",
        "tomllib",
    }
    allowed |= {"copy", "itertools", "secrets", "typing", "flint"}
    lines = 0
    for path in SOURCES:
        text = path.read_text(encoding="utf-8")
        lines += sum(bool(line.strip()) for line in text.splitlines())
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.ImportFrom):
                assert node.module.split(".")[0] in allowed or node.module.startswith("assur.verifier")
            if isinstance(node, ast.Import):
                assert {item.name.split(".")[0] for item in node.names} <= allowed
    assert lines <= 1900


def test_the_check_of_derivations_is_small_too():
    texts = (path.read_text(encoding="utf-8") for path in (SOURCES[0].parent / "derivations").glob("*.py"))
    assert sum(bool(line.strip()) for text in texts for line in text.splitlines()) <= 1550

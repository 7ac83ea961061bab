"""The topology file: what is read, every kind of fault in it, and that what is written is read the same."""

import dataclasses
import re
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import MechanismFileError, UsageError
from assur.model.file.reader import read_text
from assur.model.file.topology_file import read_topology, read_topology_text
from assur.model.file.topology_schema import DeclaredEntry, TopologyEntry
from assur.model.file.topology_text import topology_text
from assur.model.registry import topology_names
from assur.model.topologies import load_topology
from assur.model.topology_description import Declared, TopologyDescription
from assur.topology.chains import ChainJoint
from assur.topology.notation import parse_chains

FILE = Path("t.toml")
PAGE = (Path(__file__).parents[3] / "docs" / "topology-file.md").read_text(encoding="utf-8")
TEXT = """format = 1
kind = "topology"
name = "mix"
title = "A mixture"
source = "here"
note = "three limbs"
chains = [
  "C[x] R[x] R[x]",
  "R[y] P(4S)[y]",
  "{P[z] R[z] | P[z] R[z]} U[z,x] S",
]
actuate = ["1.1", "2.1", "3.3"]
mode = "translation"

[declared]
poc = "t3 r0"
dim = 3
dof = 3
xi = [6, 6]
coupling_degree = 2
limbs = ["t3 r1", "t3 r2", "t3 r3"]
limb_dims = [4, 5, 6]
redundant_constraints = { collapsed = 3, joint_graph = 4 }
internal_freedoms = { collapsed = 0, joint_graph = 2 }
source = "nowhere"
"""
TOP = "allowed here: actuate, chains, declared, format, kind, mode, name, note, source, title"
FACTS = (
    "allowed here: coupling_degree, dim, dof, internal_freedoms, limb_dims, limbs, poc, "
    "redundant_constraints, source, xi"
)
POC = 'allowed: numbers of translations and rotations, each 0 to 3: "t3 r0"'
NUMBER = "allowed: a whole number, 0 or more"
ACTUATOR = 'allowed: limb and joint, counted from 1: "2.1"'


def read(text: str) -> TopologyDescription:
    return read_topology_text(text, FILE)


def faults(text: str) -> list[str]:
    with pytest.raises(MechanismFileError) as caught:
        read(text)
    return [
        line.removeprefix("t.toml:").replace("    hint: ", "? ")
        for problem in caught.value.problems
        for line in str(problem).splitlines()
    ]


def test_everything_that_stands_in_a_file_is_read() -> None:
    found = read(TEXT)
    assert (found.name, found.title, found.source, found.note) == ("mix", "A mixture", "here", "three limbs")
    assert found.actuate == ((1, 1), (2, 1), (3, 3))
    assert (found.mode, found.file) == ("translation", FILE)
    assert [chain.text for chain in found.chains] == tomllib.loads(TEXT)["chains"]
    letters = [[item.type.letter for item in chain.joints if isinstance(item, ChainJoint)] for chain in found.chains]
    assert letters == [["C", "R", "R"], ["R"], ["P", "R", "P", "R", "U", "S"]]
    assert found.limb_types == "1-CRR, 1-RP(4S), 1-{PR|PR}US"
    assert found.declared == Declared(
        poc=(3, 0),
        dim=3,
        dof=3,
        xi=(6, 6),
        coupling_degree=2,
        limbs=((3, 1), (3, 2), (3, 3)),
        limb_dims=(4, 5, 6),
        redundant_constraints=(3, 4),
        internal_freedoms=(0, 2),
        source="nowhere",
    )


def test_what_may_be_left_out() -> None:
    found = read('format = 1\nkind = "topology"\nname = "arm"\nchains = ["R[z] R[z]"]')
    assert (found.title, found.source, found.note, found.actuate, found.mode) == ("arm", "", "", (), "home")
    assert found.declared == Declared()


CASES: list[tuple[str, str, list[str]]] = [
    ("format = 1", "format = 2", ["1: format: 2; allowed: 1, the format that this version reads"]),
    ("format = 1\n", "", ["1: format: missing; this must be there: 1, the format that this version reads"]),
    ('"topology"', '"topologie"', ['2: kind: "topologie"; allowed: "topology"']),
    ('kind = "topology"\n', "", ['1: kind: missing; this must be there: "topology"']),
    ('"mix"', '"a mix"', ['3: name: "a mix" is no name; allowed: letters, digits, _ and -']),
    ('"mix"', "3", ["3: name: 3; allowed: a text in quotes"]),
    ('"here"', "[1]", ["5: source: a list of 1; allowed: a text in quotes"]),
    ("note =", "notes =", [f"6: notes: unknown key; {TOP}", "? did you mean 'note'?"]),
    ('mode = "translation"', 'mode = "rotation"', ['13: mode: "rotation"; allowed: home or translation']),
    # chains
    ('"R[y] P(4S)[y]"', "4", ["9: chains[1]: 4; allowed: a text in quotes"]),
    # actuators
    ('"1.1"', "1.1", [f"12: actuate[0]: 1.1; {ACTUATOR}", '? write it in quotes: "1.1"']),
    ('"1.1"', '"1"', [f'12: actuate[0]: "1"; {ACTUATOR}']),
    ('"1.1"', '"0.1"', [f'12: actuate[0]: "0.1"; {ACTUATOR}']),
    ('"1.1"', '"4.1"', ['12: actuate[0]: "4.1"; there are 3 chains']),
    ('"1.1"', '"1.4"',
     ['12: actuate[0]: "1.4": limb 1 has 3 joints; in this limb may be actuated: 1.1 (C), 1.2 (R), 1.3 (R)']),
    ('"2.1"', '"2.2"', ['12: actuate[1]: "2.2" is a joint P(4S); in this limb may be actuated: 2.1 (R)']),
    ('"3.3"', '"3.6"',
     ['12: actuate[2]: "3.6" is a joint S; in this limb may be actuated: 3.1 (P), 3.2 (R), 3.3 (P), 3.4 (R)']),
    ('"2.1"', '"1.1"', ['12: actuate[1]: "1.1" again; the first one is in line 12; allowed: each joint once']),
    ('["1.1", "2.1", "3.3"]', "[]", ["12: actuate: an empty list; allowed: at least one element"]),
    # declared facts
    ("[declared]\n", "declared = 3\n[x]\n",
     ["15: declared: 3; allowed: a table [declared]", f"16: x: unknown key; {TOP}"]),
    ("poc =", "pocs =", [f"16: declared.pocs: unknown key; {FACTS}", "? did you mean 'poc'?"]),
    ('poc = "t3 r0"', 'poc = "t4 r0"', [f'16: declared.poc: "t4 r0"; {POC}']),
    ('poc = "t3 r0"', "poc = 3", [f"16: declared.poc: 3; {POC}"]),
    ("dim = 3", "dim = -3", [f"17: declared.dim: -3; {NUMBER}"]),
    ("dof = 3", "dof = 3.0", [f"18: declared.dof: 3.0; {NUMBER}"]),
    ("xi = [6, 6]", "xi = [6, true]", [f"19: declared.xi[1]: true; {NUMBER}"]),
    ("xi = [6, 6]", "xi = 6", ["19: declared.xi: 6; allowed: a list [ ... ]"]),
    ('["t3 r1", "t3 r2", "t3 r3"]', '["t3 r1"]', ["21: declared.limbs: 1 of them; one for each of the 3 chains"]),
    ("[4, 5, 6]", "[4, 5, 6, 6]", ["22: declared.limb_dims: 4 of them; one for each of the 3 chains"]),
    (", joint_graph = 4", "",
     ["23: declared.redundant_constraints: a table; allowed: { collapsed = 0, joint_graph = 0 }, both of them"]),
    ("{ collapsed = 0, joint_graph = 2 }", "2",
     ["24: declared.internal_freedoms: 2; allowed: { collapsed = 0, joint_graph = 0 }, both of them"]),
    ("joint_graph = 4", "joint_graph = -4", [f"23: declared.redundant_constraints: -4; {NUMBER}"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), CASES)
def test_each_kind_of_fault(old: str, new: str, expected: list[str]) -> None:
    assert TEXT.count(old) == 1
    assert faults(TEXT.replace(old, new)) == expected


def test_a_slip_in_a_chain_is_told_at_its_line_and_character() -> None:
    fault, hint = faults(TEXT.replace("C[x] R[x] R[x]", "C[x] Q[x] R[x]"))
    assert fault.startswith("8: chains[0]: 'Q' at character 6 of \"C[x] Q[x] R[x]\"; expected ")
    assert hint.startswith("? ")


def test_limbs_that_nearly_fit_are_a_fault_of_the_later_one() -> None:
    fault, _ = faults(TEXT.replace("R[y] P(4S)[y]", "R[0.0005,1,0] P(4S)[y]").replace("C[x] R[x] R[x]", "C[y]"))
    assert fault.startswith("9: chains[1]: ")
    assert "nearly but not exactly parallel" in fault


def test_all_faults_of_a_file_are_told_at_once() -> None:
    wrong = [
        ('"mix"', '""'),
        ("C[x] R[x]", "C[x] R[x"),
        ("R[y] P", "R[y P"),
        ("3.3", "3.9"),
        ('"t3 r0"', "3"),
        ("dim", "dmi"),
    ]
    text = TEXT
    for old, new in wrong:
        text = text.replace(old, new, 1)
    places = [line.split(": ")[1] for line in faults(text) if not line.startswith("?")]
    assert places == ["name", "chains[0]", "chains[1]", "actuate[2]", "declared.poc", "declared.dmi"]


def test_a_mechanism_and_a_topology_are_not_taken_for_each_other(fourbar: str) -> None:
    with pytest.raises(UsageError, match=r"t\.toml is a mechanism with dimensions, not a topology"):
        read(fourbar)
    with pytest.raises(UsageError, match=r"t\.toml is a topology without dimensions"):
        read_text(TEXT, FILE)


def test_an_empty_file_misses_everything() -> None:
    assert [line.split(":")[:2] for line in faults("")] == [
        ["1", f" {key}"] for key in ("format", "kind", "name", "chains")
    ]


@given(st.data())
def test_a_broken_file_is_a_fault_and_never_a_crash(data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(TEXT)))
    end = start + data.draw(st.integers(0, 12))
    pieces = st.sampled_from(
        ['"', "[", "]", "{", "}", "=", "\n", ",", "3", "-1.5", "true", "chains", "R[x]", "@A", "|", "[["]
    )
    text = TEXT[:start] + data.draw(pieces | st.text(max_size=3)) + TEXT[end:]
    try:
        found = read(text)
    except (MechanismFileError, UsageError):
        return
    assert dataclasses.replace(read(topology_text(found)), title=found.title) == found


# ---- writing -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", topology_names())
def test_what_is_written_of_a_built_in_topology_is_read_the_same(name: str) -> None:
    found = load_topology(name)
    assert dataclasses.replace(read(topology_text(found)), file=found.file) == found


COUNT = st.integers(0, 9)
SEEN = st.text(st.characters(exclude_categories=("Cc", "Cf", "Cs", "Zl", "Zp")))
POCS = st.tuples(st.integers(0, 3), st.integers(0, 3))
FACTS_OF_ONE_LIMB = st.builds(
    Declared,
    poc=st.none() | POCS,
    dim=st.none() | COUNT,
    dof=st.none() | COUNT,
    xi=st.none() | st.lists(COUNT, min_size=1).map(tuple),
    coupling_degree=st.none() | COUNT,
    limbs=st.none() | st.tuples(POCS),
    limb_dims=st.none() | st.tuples(COUNT),
    redundant_constraints=st.none() | st.tuples(COUNT, COUNT),
    internal_freedoms=st.none() | st.tuples(COUNT, COUNT),
    source=SEEN,
)


@given(
    texts=st.tuples(SEEN.filter(bool), SEEN, SEEN),
    actuate=st.sampled_from([(), ((1, 1),), ((1, 3), (1, 2))]),
    mode=st.sampled_from(["home", "translation"]),
    declared=FACTS_OF_ONE_LIMB,
)
def test_what_is_written_is_read_the_same(texts, actuate, mode, declared) -> None:  # type: ignore[no-untyped-def]  # hypothesis
    title, source, note = texts
    chains = parse_chains(["P[x] R[x] R[x]"])
    given = TopologyDescription("a", chains, title, source, note, actuate, mode, declared, FILE)
    assert read(topology_text(given)) == given


def test_nothing_is_written_of_what_is_not_said() -> None:
    text = topology_text(TopologyDescription("a", parse_chains(["P[x]"])))
    assert text == 'format = 1\nkind = "topology"\nname = "a"\nchains = [\n  "P[x]",\n]\n'


# ---- the page on the form ------------------------------------------------------------------------------------


def test_the_example_of_the_page_is_a_topology() -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    assert read(text).limb_types == "3-CRR"


@pytest.mark.parametrize("key", [*TopologyEntry.model_fields, *DeclaredEntry.model_fields])
def test_every_key_is_documented(key: str) -> None:
    assert re.search(rf"`\[?{key}\]?`", PAGE)


def test_a_file_on_the_disk(tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_text(TEXT, encoding="utf-8")
    assert read_topology(path) == dataclasses.replace(read(TEXT), file=path)
    with pytest.raises(UsageError, match="cannot read"):
        read_topology(tmp_path / "none.toml")

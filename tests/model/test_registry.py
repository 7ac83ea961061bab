import re
import shutil
from pathlib import Path

import pytest

from assur.errors import MechanismFileError, UnknownNameError, UsageError
from assur.model.closed_form import Sign
from assur.model.consent import leave
from assur.model.dimensions import with_parameters
from assur.model.registry import left_out, load_record, names, topology_names
from assur.model.topologies import load_topology, means_topology

FORM = """
from assur.model.closed_form import ClosedForm, Sign

def nothing(ns, p, given, sign):
    return {}

CLOSED_FORM = ClosedForm(
    complete_for="joint_graph", direct=nothing, inverse=nothing, joints=nothing, factors=nothing, jacobians=nothing,
    signs={"s": Sign("sine", "1")}, direct_margins=(), inverse_margins=(), factor_list=(),
)
"""


@pytest.fixture
def folder(tmp_path: Path, fourbar: str) -> Path:
    (tmp_path / "mechanism.toml").write_text(fourbar, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("name", names())
def test_every_built_in_mechanism_is_a_folder_with_its_name(name: str) -> None:
    record = load_record(name)
    assert record.name == name
    assert record.folder is not None
    assert record.folder.name == name
    assert record.source
    assert all(parameter.meaning for parameter in record.parameters.values())
    same = load_record(record.file)
    assert (same.name, same.home.tolist()) == (record.name, record.home.tolist())


def test_a_file_a_folder_and_its_name_in_text_are_the_same(folder: Path) -> None:
    for path in (folder, folder / "mechanism.toml", str(folder), str(folder / "mechanism.toml")):
        record = load_record(path, l1=41)
        assert (record.name, record.values.l1, record.folder) == ("fourbar", 41.0, folder)
        assert record.closed_form is None


def test_the_closed_form_beside_a_file_belongs_to_it(folder: Path) -> None:
    home = load_record("fivebar").folder
    assert home is not None
    for name in ("mechanism.toml", "closed_form.py"):
        shutil.copy(home / name, folder)
    record = load_record(folder)
    assert record.closed_form is not None
    assert record.closed_form.signs["e"] == Sign("sin_rods", "1")
    assert with_parameters(record, l1=61).closed_form is record.closed_form


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x = 1\ny = x +", ":2: SyntaxError: invalid syntax; allowed: Python"),
        ("x = 1\n\ny = 1 / 0", ":3: ZeroDivisionError: division by zero; allowed: see docs/closed-form.md"),
        (
            FORM.replace("inverse=nothing", "inverse=3"),
            ":7: inverse of ClosedForm is a number; allowed: inverse: a function of this file",
        ),
        ("x = 1", ": no CLOSED_FORM; it must define CLOSED_FORM = ClosedForm(...)"),
        ("CLOSED_FORM = 3", ": no CLOSED_FORM; it must define CLOSED_FORM = ClosedForm(...)"),
        (
            FORM.replace('{"s"', '{"t": Sign("sine", "1"), "s"'),
            ": signs s, t; those of [modes] in mechanism.toml: s\n"
            "    hint: it is read with every file of its folder; where it is another file's, "
            "move it, with its file, to a folder of its own",
        ),
        (FORM.replace('"1")', '"2*lx")'), ": the scale '2*lx': 'lx'; a formula of g, l1, l2, l3, tilt"),
        (FORM.replace('"1")', '"-1")'), ": the scale '-1' is -1; it must be positive"),
        (
            FORM.replace("factor_list=()", 'factor_list=(), constraint_singular=(("v",),)'),
            ": the group ('v',); names of factor_list: none",
        ),
    ],
)
def test_a_broken_closed_form_is_a_fault_of_its_file(folder: Path, text: str, expected: str) -> None:
    assert faults(folder, text) == [f"{folder / 'closed_form.py'}{expected}"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("import assur.nothing", ":1: ModuleNotFoundError: No module named 'assur.nothing'; it must run"),
        ("raise SystemExit(0)", ":1: SystemExit: 0; it must run"),
        ("import math\n\ny = 1 / 0", ":3: ZeroDivisionError: division by zero; it must run"),
    ],
)
def test_what_goes_wrong_where_a_closed_form_has_to_run_is_its_fault_too(
    folder: Path, text: str, expected: str
) -> None:
    with leave(given=True):
        assert faults(folder, text) == [f"{folder / 'closed_form.py'}{expected}"]


def faults(folder: Path, text: str) -> list[str]:
    """What is said of a closed form."""
    (folder / "closed_form.py").write_text(text, encoding="utf-8")
    with pytest.raises(MechanismFileError) as caught:
        load_record(folder)
    return [str(problem) for problem in caught.value.problems]


def test_an_unknown_name_is_answered_with_the_near_ones() -> None:
    name = names()[-1]
    for text in (name[:-1], name.upper()[:0] + name + "x", "", "no such mechanism"):
        with pytest.raises(UnknownNameError) as caught:
            load_record(text)
        assert caught.value.choices == names()
    with pytest.raises(UnknownNameError, match=f"did you mean .*{name}"):
        load_record(name + "x")


@pytest.mark.parametrize("name", ["my.toml", "./my.toml", "a/b", Path("nothing"), "\0.toml"])
def test_a_path_without_a_file_is_said(name: str | Path) -> None:
    with pytest.raises(UsageError, match=r"cannot read '") as caught:
        load_record(name)
    assert not isinstance(caught.value, UnknownNameError | MechanismFileError)


@pytest.mark.parametrize("name", [None, 3, b"zeng2019", ["zeng2019"]])
def test_what_is_no_name_is_refused(name: object) -> None:
    with pytest.raises(UsageError, match="a mechanism is given by its name or the path of its file"):
        load_record(name)  # type: ignore[arg-type]  # that is the point


def test_a_file_that_is_not_text_is_a_fault_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_bytes(b'format = 1\nname = "\xff"\n')
    with pytest.raises(MechanismFileError) as caught:
        load_record(path)
    assert [str(problem) for problem in caught.value.problems] == [f"{path}:2: byte 0xff; allowed: UTF-8 text"]


def test_a_file_with_a_byte_order_mark_is_read(folder: Path, fourbar: str) -> None:
    (folder / "mechanism.toml").write_text("\ufeff" + fourbar, encoding="utf-8")
    assert load_record(folder).name == "fourbar"


def test_the_faults_of_a_file_come_before_those_of_a_call(folder: Path, fourbar: str) -> None:
    (folder / "mechanism.toml").write_text(re.sub("value = 80", "value = -80", fourbar), encoding="utf-8")
    with pytest.raises(MechanismFileError):
        load_record(folder, nothing=3)


# ---- topologies --------------------------------------------------------------------------------------------

TOPOLOGY = 'format = 1\nkind = "topology"\nname = "arm"\nchains = ["R[z] R[z]"]\n'


@pytest.mark.parametrize("name", topology_names())
def test_every_built_in_topology_is_a_folder_with_its_name_and_a_source(name: str) -> None:
    found = load_topology(name)
    assert found.name == name
    assert found.file is not None
    assert found.file.parent.name == name
    assert found.title != name
    assert found.source
    assert means_topology(name)
    assert load_topology(found.file) == load_topology(found.file.parent) == found


def test_mechanisms_are_no_topologies() -> None:
    for name in set(names()) - set(topology_names()):
        assert not means_topology(name)
        with pytest.raises(UsageError, match="is a mechanism with dimensions, not a topology"):
            load_topology(name)
    for name in set(topology_names()) - set(names()):
        with pytest.raises(UsageError, match="is a topology without dimensions"):
            load_record(name)


def test_what_stands_in_a_file_says_whether_it_is_a_topology(tmp_path: Path, fourbar: str) -> None:
    topology, mechanism = tmp_path / "a.toml", tmp_path / "b.toml"
    topology.write_text(TOPOLOGY, encoding="utf-8")
    mechanism.write_text(fourbar, encoding="utf-8")
    assert (means_topology(topology), means_topology(str(mechanism))) == (True, False)
    assert load_topology(str(topology)).name == "arm"
    assert load_record(mechanism).name == "fourbar"


def test_a_folder_with_both_files_gives_each_to_who_asks(folder: Path) -> None:
    (folder / "topology.toml").write_text(TOPOLOGY, encoding="utf-8")
    assert load_record(folder).name == "fourbar"
    assert load_topology(folder).name == "arm"
    assert means_topology(folder)


def test_an_unknown_topology_is_answered_with_every_name() -> None:
    for ask in (load_topology, means_topology):
        with pytest.raises(UnknownNameError, match="did you mean tripteron") as caught:
            ask("tripterom")
        assert caught.value.choices == tuple(sorted({*names(), *topology_names()}))


def test_what_is_left_out_says_why() -> None:
    for item in left_out():
        assert item.source
        with pytest.raises(UnknownNameError, match=re.escape(item.reason)):
            load_topology(item.name)


@pytest.mark.parametrize("slip", ["my.tml", "mi.toml", "my"])
def test_a_file_beside_is_named_where_its_name_was_mistyped(tmp_path, monkeypatch, slip):
    (tmp_path / "my.toml").write_text("", encoding="utf-8")
    (tmp_path / "other.toml").write_text("", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for folder in ("", f"{tmp_path}/"):
        with pytest.raises(UsageError) as caught:
            load_record(f"{folder}{slip}")
        assert caught.value.hint == f"did you mean {folder}my.toml?"
    with pytest.raises(UsageError) as caught:
        load_record("nothing.tml")
    assert "did you mean" not in caught.value.hint

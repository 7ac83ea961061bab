"""`assur topology`: the same facts as text, as JSON, as LaTeX and as a graph, and a clear answer to bad input."""

import json
import re
import shlex

import pytest

import assur
from assur.cli.application import application
from assur.derived_topology import topology as derive
from assur.model.registry import topology_names
from assur.topology.answers import answers
from assur.topology.latex import fragment
from catalogue import each

TRIPTERON = ["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"]
PARTS = ("derivation", "limbs", "actuators")


def chains(*texts):
    return [word for text in texts for word in ("--chain", text)]


# ---- what is said ------------------------------------------------------------------------------------------


def test_the_result_stands_in_the_first_lines(assur_cli):
    run = assur_cli("topology", "zeng2019")
    assert (run.code, run.err) == (0, "")
    head = run.out.splitlines()[:9]
    assert head[0].startswith("zeng2019: ")
    assert head[1].split() == ["POC", "set", "t³", "r⁰:", "dim", "3"]
    assert head[2].split() == ["motion", "3T"]
    assert head[3].split() == ["parasitic", "none"]
    assert head[4].split(" = ")[:2] == ["DOF          F", "3"]
    assert "2: ξ1 = 3, Δ1 = +1; ξ2 = 5, Δ2 = -1" in head[5]
    assert head[6].rstrip().endswith("κ = 1; full freedom: one Assur chain has all drives")
    assert head[8].split()[:2] == ["redundant", "4"]
    assert " 10 of all joints" in head[8]


@pytest.mark.parametrize(
    "limbs", [TRIPTERON, ["U[x@O,y] P[z] R[y]"] * 2 + ["R[x] P[z] U[x,y]"]], ids=["3T", "2UPR-RPU"]
)
def test_what_the_characteristics_say_is_not_said_again(assur_cli, limbs):
    head, _, parts = assur_cli("topology", *chains(*limbs)).out.partition("\n\n")
    for name in ("idle", "relaxed", "Assur chains", "decoupling"):
        assert re.search(rf"^{name} +\S", head, re.MULTILINE), name
    for again in ("idle", "leaves", "Assur chain 1: loop", "coupled", "valid", "admissible"):
        assert again not in parts


def test_a_planar_five_bar_has_two_readings(assur_cli):
    five_bar = chains("R[z] R[z] R[z]", "R[z] R[z]")
    assert assur_cli("topology", *five_bar).out.splitlines()[2].split("  ", 1)[1].strip() == (
        "1T1R; 2T by the translations of a general point"
    )
    data = assur_cli("topology", *five_bar, "--json").json
    assert (data["motion_type"], data["freedom_type"]) == ("1T1R", "full")


def test_json_of_the_papers_mechanism_has_the_papers_numbers(assur_cli):
    found = assur_cli("topology", "zeng2019", "--json").json
    assert {key: found["poc"][key] for key in ("t", "r", "dim", "text")} == {"t": 3, "r": 0, "dim": 3, "text": "t³ r⁰"}
    assert [(item["t"], item["r"], item["dim"], item["dependent"]) for item in found["limbs"]] == [
        (3, 2, 5, 0),
        (3, 0, 3, 0),
    ]
    assert found["dof"] == 3
    assert [(item["xi"], item["delta"]) for item in found["loops"]] == [(3, 1), (5, -1)]
    assert found["assur_chains"] == [{"loops": [0, 1], "coupling_degree": 1}]
    assert found["coupling_degree"] == 1
    assert found["redundant_constraints"] == {"collapsed": 4, "joint_graph": 10}
    y = found["decoupling"][found["outputs"].index("y")]
    assert dict(zip(found["inputs"], y, strict=True)) == {"P1": True, "P2": True, "P3": False}
    assert found["routes_agree"] is True


@pytest.mark.parametrize(
    "name", each(sorted({*assur.names(), *topology_names()}), ("zeng2019", "planar_3rrr", "three_rps"))
)
def test_every_mechanism_of_the_catalogue_can_be_asked_for(assur_cli, name):
    run = assur_cli("topology", name)
    assert (run.code, run.err) == (0, "")
    assert all(f"\n{part}\n" in run.out for part in PARTS)
    found = derive(name)
    words = " ".join(run.out.split())
    assert str(found.poc) in words
    for limb in found.limbs:
        assert str(limb.poc) in words
        if limb.known.refusal:
            assert " ".join(limb.known.refusal.split()) in words
    assert assur_cli("topology", name, "--json").json == _plain(answers(found))


def _plain(data):
    import json

    from assur.results.json_text import json_text

    return json.loads(json_text(data))


def test_a_file_is_as_good_as_a_name(assur_cli):
    path = str(assur.load("zeng2019").file)
    by_path, by_name = (assur_cli("topology", what, "--json").json for what in (path, "zeng2019"))
    assert by_path == by_name


def test_chains_are_as_good_as_the_catalogue(assur_cli):
    found = assur_cli("topology", *chains(*TRIPTERON), "--json").json
    named = assur_cli("topology", "tripteron", "--json").json
    for key in ("poc", "dof", "loops", "coupling_degree", "redundant_constraints", "decoupling"):
        assert found[key] == named[key], key


def test_one_chain_alone_gives_its_own_set(assur_cli):
    found = assur_cli("topology", "--chain", "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "--json").json
    (limb,) = found["limbs"]
    assert (limb["t"], limb["r"], limb["dim"], limb["dependent"]) == (3, 2, 5, 0)


@pytest.mark.parametrize("spelt", [["--chain", "-R|R|R_|_R|R-"], ["--chain=-R|R|R_|_R|R-"]])
def test_a_chain_may_begin_with_a_hyphen(assur_cli, spelt):
    (limb,) = assur_cli("topology", *spelt, "--json").json["limbs"]
    assert (limb["t"], limb["r"], limb["dim"]) == (3, 2, 5)


def test_actuated_joints_are_those_that_are_named(assur_cli):
    found = assur_cli("topology", *chains(*TRIPTERON), "--actuate", "1.2, 2.2,3.2", "--json").json
    assert found["inputs"] == ["R1", "R4", "R7"]
    default = assur_cli("topology", *chains(*TRIPTERON), "--json").json
    assert default["inputs"] == ["P1", "P2", "P3"]
    assert default["decoupling"] == [[True, False, False], [False, True, False], [False, False, True]]


def test_the_mode_is_passed_on(assur_cli):
    upu = chains("U[y,x] P[z] U[x,y]")
    free, kept = (
        assur_cli("topology", *upu, *words, "--json").json["limbs"][0] for words in ([], ["--mode", "translation"])
    )
    assert (free["t"], free["r"], free["dim"]) == (3, 3, 5)
    assert (kept["t"], kept["r"], kept["dim"]) == (3, 2, 5)


def test_plain_letters_only(assur_cli):
    for words in (["zeng2019"], ["three_upu"], chains("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]")):
        run = assur_cli("topology", *words, "--ascii")
        assert run.code == 0
        assert run.out.isascii()
        assert "?" not in run.out
        assert "t^3" in run.out


def test_latex_is_the_fragment(assur_cli):
    assert assur_cli("topology", "zeng2019", "--latex").out == fragment(derive("zeng2019")) + "\n"


def test_examples_of_the_help_run(assur_cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = application()["topology"].help.split("For example:")[1].replace("\\\n", " ")
    examples = [shlex.split(line) for line in text.splitlines() if line.strip()]
    assert len(examples) >= 5
    for words in examples:
        assert words[0] == "assur"
        run = assur_cli(*words[1:])
        assert (run.code, run.err) == (0, ""), words


# ---- the graph ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ending", "magic", "what"),
    [(".svg", b"<?xml", "graph"), (".png", b"\x89PNG", "sketch"), (".PDF", b"%PDF", "graph")],
)
def test_a_drawing_is_written(assur_cli, tmp_path, ending, magic, what):
    path = tmp_path / f"drawn{ending}"
    run = assur_cli("topology", "zeng2019", f"--{what}", str(path))
    assert (run.code, run.err) == (0, "")
    assert run.out.endswith(f"written: {path}\n") or str(path) in run.out.replace("\n", "")
    assert path.read_bytes().startswith(magic)


# ---- bad input ---------------------------------------------------------------------------------------------

BAD = {
    "no mechanism is named and no --chain given": [],
    "a mechanism (zeng2019) and --chain at once": ["zeng2019", "--chain", "R[x] R[x]"],
    "'R[x] R[x]' looks like a chain, not like a name": ["R[x] R[x]"],
    "unknown mechanism 'zeng'; there is: ": ["zeng"],
    "cannot read limb 1:": chains("P[x] Q[x]", "R[x]"),
    "cannot read this chain:": chains("{R[x] | R[y] R[z]"),
    "cannot read limb 2:": chains("P[x] R[x] R[x]", "-R|R-"),
    "'1.9': limb 1 has joints 1 to 4": [*chains(*TRIPTERON), "--actuate", "1.9"],
    "'4.1': there is no limb 4; limbs run from 1 to 3": [*chains(*TRIPTERON), "--actuate", "4.1"],
    "'one' names no joint to actuate; write limb.joint, both counted from 1": [
        *chains(*TRIPTERON),
        *("--actuate", "one"),
    ],
    "--actuate names the joint 1.1 twice; each once": [*chains(*TRIPTERON), "--actuate", "1.1,1.1"],
    "cannot write graph.gif: its ending is none of .svg, .pdf, .png": ["zeng2019", "--graph", "graph.gif"],
    "cannot write limbs.gif: its ending is none of .svg, .pdf, .png": ["zeng2019", "--sketch", "limbs.gif"],
    "--chain needs a value": ["--chain"],
}


@pytest.mark.parametrize("message", BAD)
@pytest.mark.parametrize("json", [False, True])
def test_a_clear_error(assur_cli, message, json):
    run = assur_cli("topology", *BAD[message], *["--json"] * json)
    assert run.code == 2
    assert run.err.startswith(f"error: {message}")
    assert "Traceback" not in run.err
    assert bool(run.out) == json
    if json:
        assert run.json["error"]["message"].startswith(message)


@pytest.mark.parametrize(
    ("chain", "place", "found"),
    [
        ("P[x] Q[x]", 5, "'Q'"),
        ("{R[x] | R[y] R[z]", 0, "a brace that is not closed"),
        ("-R1 ∥ R2[x] ⊥ R3[x]-", 0, ""),
        ("R[x,y,z,x]", 0, ""),
        ("R[0,0,0]", 2, "the zero vector"),
    ],
)
def test_a_caret_stands_under_the_place(assur_cli, chain, place, found):
    run = assur_cli("topology", "--chain", chain)
    assert run.code == 2
    _, text, caret = run.err.splitlines()[:3]
    assert text == f"  {chain}"
    assert re.match(r" +\^ ", caret)
    if found:
        assert caret.startswith("  " + " " * place + "^ " + found)


def test_redundant_actuators(assur_cli):
    given = ("topology", *chains(*TRIPTERON), "--actuate", "1.1,2.1,3.1,1.2")
    said = json.loads(assur_cli(*given, "--json").out)
    asked = said["actuation"]
    assert (said["coupling_degree"], asked["verdict"], asked["redundancy"]) == (None, "redundant", 1)
    assert asked["admissible"] == [["P1", "R1", "P2"], ["P1", "R1", "P3"], ["P1", "P2", "P3"]]
    assert asked["coupling_degrees"] == [0, 0, 1]
    assert asked["preload"] == {"dimension": 1, "inputs": ["R1", "P2", "P3"]}
    text = assur_cli(*given).out
    assert "determined by P1, P2, P3: κ = 1; R1 follows" in text
    assert "preload: 1 dimension in R1, P2, P3" in text


def test_an_unknown_mode_lists_the_modes(assur_cli):
    run = assur_cli("topology", "fivebar", "--mode", "flying")
    assert (run.code, run.out) == (2, "")
    assert "flying" in run.err
    assert "translation" in run.err


SLIDER = """
format = 1
name = "slider"
unit = "mm"
angle = "deg"
base = "ground"
platform = { link = "block", pose = ["x"], orientation = "constant" }
[links]
ground = {}
crank = {}
rod = {}
block = {}
[joints]
A = { type = "revolute", parent = "ground", child = "crank", axis = "z" }
B = { type = "revolute", parent = "crank", child = "rod", at = [40, 0, 0], axis = "z" }
C = { type = "revolute", parent = "rod", child = "block", at = [80, 0, 0], axis = "z" }
S = { type = "prismatic", parent = "ground", child = "block", axis = "x" }
[inputs]
order = ["A"]
A = { name = "q" }
[home]
A = 50
B = -75
C = 25
S = 100
"""


def test_a_mechanism_of_ones_own(assur_cli, tmp_path):
    path = tmp_path / "slider.toml"
    path.write_text(SLIDER)
    found = assur_cli("topology", str(path), "--json").json
    assert (found["dof"], found["loops"][0]["xi"], found["coupling_degree"]) == (1, 3, 0)
    assert found["redundant_constraints"] == {"collapsed": 3, "joint_graph": 3}


def without(*joints):
    return "\n".join(line for line in SLIDER.splitlines() if line[:1] not in joints or line[1:4] != " = ")


@pytest.mark.parametrize(("cut", "links"), [("CS", ["block"]), ("BS", ["rod", "block"])])
def test_a_platform_that_nothing_reaches_is_refused(assur_cli, tmp_path, cut, links):
    path = tmp_path / "slider.toml"
    path.write_text(without(*cut))
    run = assur_cli("topology", str(path))
    assert (run.code, run.out) == (3, "")
    assert "is not connected to the base" in run.err
    assert "allowed: one connected graph" in run.err
    assert all(link in run.err for link in links)


def test_an_arm_with_a_free_end_has_no_loops(assur_cli, tmp_path):
    path = tmp_path / "slider.toml"
    path.write_text(without("S"))
    found = assur_cli("topology", str(path), "--json").json
    assert (found["dof"], found["loops"]) == (3, [])
    (limb,) = found["limbs"]
    assert (limb["t"], limb["r"], limb["dim"]) == (2, 1, 3)


def test_faults_of_a_topology_file_are_listed_with_their_lines(assur_cli, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('format = 1\nkind = "topology"\nname = "x"\nchains = ["P[x] Q", "R[x] R[x"]\n')
    run = assur_cli("topology", str(path))
    assert (run.code, run.out) == (3, "")
    assert run.err.startswith("error: 2 problems:\n")
    assert f"{path}:4: chains[0]: 'Q' at character 6" in run.err
    assert f"{path}:4: chains[1]: a bracket that is not closed" in run.err


def test_a_mechanism_with_one_mode_has_one(assur_cli):
    answer = assur_cli("topology", "tripteron", "--modes", "--json").json
    (mode,) = answer["modes"]
    assert (mode["name"], mode["at_home"], mode["coupling_degree"]) == ("3T", True, 1)
    assert [mode["poc"][part] for part in ("t", "r", "dim")] == [3, 0, 3]
    assert mode["meets"] == []
    assert any("not proved to be all" in note for note in answer["notes"])


def test_neighbours_are_listed_with_the_command_that_asks_for_the_first(assur_cli):
    five_bar = chains("R[z] R[z] R[z]", "R[z] R[z]")
    run = assur_cli("topology", *five_bar, "--improve")
    assert "neighbours with the same motion" in run.out
    command = next(line for line in run.out.splitlines() if line.startswith("the first: assur "))
    again = assur_cli(*shlex.split(command.removeprefix("the first: assur ")), "--json")
    first = assur_cli("topology", *five_bar, "--improve", "--json").json["improvements"][0]
    assert again.json["redundant_constraints"] == first["redundant_constraints"]
    assert "improvements" not in again.json

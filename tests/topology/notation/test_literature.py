"""The literature's form: as the paper prints it, and stable under reading and writing."""

import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import assur
from assur.joints.catalogue import JOINT_TYPES
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.topology.chains import Chain, ChainJoint, InnerLoop, Parallelogram
from assur.topology.notation import parse_chain, parse_chains, plain_text, symbolic_text
from examples import examples

STYLES = ["unicode", "ascii", "latex"]

# Zeng, Yang, Shen, Chablat 2019, "Analysis of topology characteristics", the two unnumbered displays.
HSOC1 = r"HSOC_1\{-\Diamond(P_1^{(2P4R)}, P_2^{(2P4R)}) \perp R^{(2P4R)} \perp R_3 \parallel R_4 -\}"
HSOC2 = r"HSOC_2\{-P_3 - P^{(4R)} - P^{(4R)} -\}"
PLAIN = ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[-y] R[-y]", "P[y] P(4R)[x] P(4R)[-y]"]


@pytest.mark.parametrize(("number", "printed"), [(1, HSOC1), (2, HSOC2)])
def test_analysis_of_topology_characteristics_chains_read_and_print(number, printed):
    assert symbolic_text(parse_chain(printed), "latex", number=number) == printed


def joint_graph():
    """The two chains with the axes of the mechanism's file, where all frames are parallel to the base's."""
    path = Path(assur.__file__).parent / "mechanisms" / "zeng2019" / "mechanism.toml"
    text = tomllib.loads(path.read_text(encoding="utf-8"))
    axes = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "-y": (0.0, -1.0, 0.0)}

    def joint(name):
        entry = text["joints"][name]
        return ChainJoint(JOINT_TYPES[entry["type"]], (axes[entry["axis"]],), name=entry.get("alias", name))

    def parallelogram(name):
        first = text["generalised"][name]["joints"][0]
        return Parallelogram("4R", axes[text["joints"][first]["axis"]], name)

    one, two = text["chains"]["HSOC1"], text["chains"]["HSOC2"]
    branches = (one["loop"][:3], one["loop"][:2:-1])
    loop = InnerLoop(tuple(tuple(map(joint, branch)) for branch in branches))
    chains = [
        Chain((loop, *map(joint, one["tail"]))),
        Chain(tuple(joint(name) if name in text["joints"] else parallelogram(name) for name in two["serial"])),
    ]
    return chains, [one["printed"], two["printed"]]


@pytest.mark.parametrize(("number", "printed"), [(1, HSOC1), (2, HSOC2)])
def test_analysis_of_topology_characteristics_chains_from_the_joint_graph(number, printed):
    assert symbolic_text(joint_graph()[0][number - 1], "latex", number=number) == printed


def test_the_chains_as_the_mechanisms_file_prints_them():
    chains, printed = joint_graph()
    assert [symbolic_text(chain) for chain in chains] == printed
    assert [symbolic_text(parse_chain(text)) for text in printed] == printed


def test_the_papers_first_chain_is_its_real_joints():
    """Six joints of the loop and two behind it, with the relations of the joint graph's axes."""
    joints = parse_chain(HSOC1).joints
    assert [joint.name for joint in joints] == ["P1", "R1", "R2", "P2", "R5", "R6", "R3", "R4"]
    own = joint_graph()[0][0].joints

    def table(found):
        axes = [item.axes[0] for item in found]
        products = [[abs(sum(a * b for a, b in zip(one, two, strict=True))) for two in axes] for one in axes]
        return [[1 if value > 1 - 1e-9 else 0 if value < 1e-9 else None for value in row] for row in products]

    ours, theirs = table(joints), table(own)
    # The text leaves open how R3 lies to P1 and P2: in the joint graph they are parallel.
    assert [[theirs[i][j] for j in range(6)] for i in range(6)] == [[ours[i][j] for j in range(6)] for i in range(6)]
    assert all(ours[i][j] == theirs[i][j] for i in (1, 2, 4, 5, 6, 7) for j in (6, 7))
    assert ours[0][6] is None


def test_from_the_plain_form():
    found = [symbolic_text(chain) for chain in parse_chains(PLAIN)]
    assert found == ["HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R(2P4R) ⊥ R5 ∥ R6-}", "HSOC{-P3-P(4R)-P(4R)-}"]


@pytest.mark.parametrize(
    ("text", "unicode", "ascii_text", "latex"),
    [
        ("-R|R|R_|_R|R-", "R1 ∥ R2 ∥ R3 ⊥ R4 ∥ R5", "R1 || R2 || R3 _|_ R4 || R5", None),
        ("U P S", "U1-P1-S1", "U1-P1-S1", r"U_1 - P_1 - S_1"),
        ("U[x,y] P[z] U[y,x]", "U1 ⊥ P1 ⊥ U2", "U1 _|_ P1 _|_ U2", r"U_1 \perp P_1 \perp U_2"),
        ("R[x]@A R[x]@A R[y]@A R[1,1,0]@A S@A", "R1 / R2 ⌢⊥ R3 ⌢ R4 ⌢ S1", "R1 / R2 ^_|_ R3 ^ R4 ^ S1", None),
        ("R_{12} R_a", "R12-R_{a}", "R12-R_{a}", r"R_{12} - R_a"),
        ("P[x] P[x] C[x]", "P1 ∥ P2 ∥ C1", "P1 || P2 || C1", r"P_1 \parallel P_2 \parallel C_1"),
    ],
)
def test_signs(text, unicode, ascii_text, latex):
    chain = parse_chain(text)
    assert symbolic_text(chain) == f"SOC{{-{unicode}-}}"
    assert symbolic_text(chain, "ascii") == f"SOC{{-{ascii_text}-}}"
    if latex:
        assert symbolic_text(chain, "latex") == rf"SOC\{{-{latex} -\}}"


def test_loops_that_no_tag_can_say_stand_in_braces():
    chain = parse_chain("{R[x] P(4S)[x] | R[y] S} R[z]")
    assert symbolic_text(chain) == "HSOC{-{R1-P(4S) | R2-S1}-R3-}"
    assert symbolic_text(chain, "latex") == r"HSOC\{-\{R_1 - P^{(4S)} \mid R_2 - S_1\}-R_3 -\}".replace("}-R", "} - R")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("P[y] {P[y] R[x] R[x] | P[y] R[x] R[x]}", "P1 ∥ ◇(P2(2P4R), P3(2P4R)) ⊥ R(2P4R)"),
        ("R[x] {P[y] R[x] R[x] | R[x] R[x] R[x]}", "R1 ⊥ ◇(P1(P5R), P(P5R)) ⊥ R(P5R)"),
        ("R[1,1,0] {R[x] R[x] R[x] | R[x] R[x] R[x]} R[x]", "R1-◇(P(6R), P(6R)) ⊥ R(6R) ∥ R8"),
    ],
)
def test_planar_loops_beside_other_joints(text, expected):
    chain = parse_chain(text)
    assert symbolic_text(chain) == f"HSOC{{-{expected}-}}"
    assert symbolic_text(parse_chain(expected)) == f"HSOC{{-{expected}-}}"


def test_names_of_others_are_not_written():
    joints = [ChainJoint(REVOLUTE, ((0.0, 0.0, 1.0),), name=name) for name in ("B1", "", "R_1", "Rx", "R7")]
    joints.append(ChainJoint(PRISMATIC, ((0.0, 0.0, 1.0),), name="Pa1"))
    assert symbolic_text(Chain(tuple(joints))) == "SOC{-R ∥ R ∥ R ∥ R ∥ R7 ∥ P-}"


@examples(100)
@given(st.data())
@pytest.mark.parametrize("style", STYLES)
def test_what_is_written_reads_back_to_the_same_text(style, random_chains, data):
    chain = parse_chain(plain_text(data.draw(random_chains(labelled=False))))
    text = symbolic_text(chain, style)
    again = parse_chain(text)
    assert symbolic_text(again, style) == text
    assert kinds(again.elements) == kinds(chain.elements)
    assert [symbolic_text(again, other) for other in STYLES] == [symbolic_text(chain, other) for other in STYLES]


@examples(100)
@given(st.data())
def test_shared_points_read_back_too(random_chains, data):
    drawn = [element for element in data.draw(random_chains()).elements if not isinstance(element, InnerLoop)]
    if drawn:
        text = symbolic_text(parse_chain(plain_text(Chain(tuple(drawn)))))
        assert symbolic_text(parse_chain(text)) == text


def kinds(elements):
    """Letters of the joints; in a loop sorted, since a tag does not say the order of its joints."""
    found = []
    for element in elements:
        if isinstance(element, InnerLoop):
            found.append(
                sorted(str(kinds(branch)) for branch in element.branches) if nested(element) else flat(element)
            )
        else:
            found.append(element.type.letter if isinstance(element, ChainJoint) else element.kind)
    return found


def nested(loop):
    return len(loop.branches) != 2 or any(
        not isinstance(part, ChainJoint) or part.type not in (REVOLUTE, PRISMATIC)
        for branch in loop.branches
        for part in branch
    )


def flat(loop):
    return sorted(part.type.letter for branch in loop.branches for part in branch)

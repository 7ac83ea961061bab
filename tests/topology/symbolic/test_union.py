import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import UsageError
from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.topology.chains import Chain, ChainJoint, Parallelogram
from assur.topology.directions import unit
from assur.topology.notation import parse_chain
from assur.topology.poc import Mark
from assur.topology.screws.placing import place
from assur.topology.screws.twists import poc_dimensions
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import serial
from examples import examples
from twist_chains import generic_edges
from work import calls

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def _motion(text, mode="free"):
    motion = serial(parse_chain(text), mode)
    assert isinstance(motion, Motion), motion
    return motion


def _by_rules(motion):
    return motion.poc.t, motion.poc.r, motion.poc.dim


def _by_twists(chain, hold=None):
    linkage = place([chain])
    return poc_dimensions(generic_edges(linkage, hold=hold), linkage.base, linkage.platform)


# poc-theory.md, section 2: text, what is printed, dim
ROWS = {
    "P": ("P[x]", "t¹(∥P1) r⁰", 1),
    "R on its axis": ("R[x]", "t⁰ r¹(∥R1)", 1),
    "H": ("H[x]", "t¹(∥H1) r¹(∥H1)", 1),
    "C on its axis": ("C[x]", "t¹(∥C1) r¹(∥C1)", 2),
    "U": ("U[x,y]", "t⁰ r²(∥◇(U1))", 2),
    "S": ("S", "t⁰ r³", 3),
    "P,P": ("P[x] P[y]", "t²(∥◇(P1, P2)) r⁰", 2),
    "P,P,P": ("P[x] P[y] P[z]", "t³ r⁰", 3),
    "P,P,P coplanar": ("P[x] P[y] P[0.6,0.8,0]", "t²(∥◇(P1, P2)) r⁰", 2),
    "R parallel R": ("R[x] R[x]", "t¹(⊥(R1, ρ)) r¹(∥R1)", 2),
    "planar group, R R R": ("R[x] R[x] R[x]", "t²(⊥R1) r¹(∥R1)", 3),
    "planar group, R R P": ("R[z] R[z] P[x]", "t²(⊥R1) r¹(∥R1)", 3),
    "planar group, P P R": ("P[x] P[y] R[z]", "t²(⊥R1) r¹(∥R1)", 3),
    "R parallel R then P parallel R": ("R[z] R[z] P[z]", "t²(moving) r¹(∥R1)", 3),
    "R parallel R with oblique P": ("R[z] R[z] P[0.6,0,0.8]", "t³ r¹(∥R1)", 3),
    "Schoenflies group, R R C": ("R[z] R[z] C[z]", "t³ r¹(∥R1)", 4),
    "Schoenflies group, P R R R": ("P[z] R[z] R[z] R[z]", "t³ r¹(∥R1)", 4),
    "Schoenflies group, R R P P": ("R[z] R[z] P[z] P[x]", "t³ r¹(∥R1)", 4),
    "Schoenflies group, P R Pa R": ("P[x] R[y] P(4R)[x] R[y]", "t³ r¹(∥R1)", 4),
    "R,R through a point": ("R[x]@A R[y]@A", "t⁰ r²(∥◇(R1, R2))", 2),
    "R,R,R through a point": ("R[x]@A R[y]@A R[z]@A", "t⁰ r³", 3),
    "R perpendicular R skew": ("R[x] R[y]", "t¹(⊥(R1, ρ)) r²(∥◇(R1, R2))", 2),
    "R parallel R perpendicular R": ("R[x] R[x] R[y]", "t²(⊥R1) r²(∥◇(R1, R3))", 3),
    "the paper's HSOC1": ("R[x] R[x] R[x] R[y] R[y]", "t³ r²(∥◇(R1, R4))", 5),
    "G(u) G(v)": ("R[x] R[x] R[x] R[y] R[y] R[y]", "t³ r²(∥◇(R1, R4))", 5),
    "RPS": ("R[x] P[z] S", "t²(⊥R1) r³", 5),
    "S-S": ("S S", "t²(moving) r³", 5),
    "UPS": ("U[x,y] P[z] S", "t³ r³", 6),
    "UPU freely displaced": ("U[x,y] P[z] U[y,x]", "t³ r³", 5),
    "4R parallelogram": ("P(4R)[y]", "t¹(∥◇(Pa1)) r⁰", 1),
    "4S parallelogram": ("P(4S)[y]", "t²(moving) r²(∥◇(Pa1))", 4),
    "4U parallelogram": ("P(4U)[y]", "t²(moving) r¹(∥Pa1)", 3),
    "2P4R": ("{P[y] R[x] R[x] | P[y] R[x] R[x]}", "t²(⊥R12) r¹(∥R12)", 3),
}


@pytest.mark.parametrize("row", ROWS)
def test_table_of_section_2(row):
    text, printed, dim = ROWS[row]
    motion = _motion(text)
    assert (str(motion.poc), motion.dim) == (printed, dim)


@pytest.mark.parametrize("row", ROWS)
def test_table_of_section_2_by_twists(row):
    text, *_ = ROWS[row]
    assert _by_rules(_motion(text)) == _by_twists(parse_chain(text))


def test_row_upu_in_translation_mode():
    motion = _motion("U[x,y] P[z] U[y,x]", "translation")
    assert (motion.poc.t, motion.poc.r, motion.dim) == (3, 2, 5)
    assert _by_rules(motion) == _by_twists(parse_chain("U[x,y] P[z] U[y,x]"), hold="orientation")
    assert motion.conditions == ("the orientation is kept",)


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("R[x]", "t¹(⊥(R1, ρ)) r¹(∥R1)"),
        ("C[x]", "t²(moving) r¹(∥C1)"),
        ("R[x] R[x]", "t²(⊥R1) r¹(∥R1)"),
        ("S", "t²(moving) r³"),
        ("R[x] P[z] S", "t³ r³"),
    ],
)
def test_off_the_last_axis_there_is_more(text, printed):
    """The braces of the table, one element more at a general point."""
    assert str(_motion(text).restated) == printed


# poc-theory.md, section 3: the pitfalls
PITFALLS = {
    "z,x,z is not two families": ("R[z] R[x] R[z]", 3, 3),
    "z,z,x,z,z": ("R[z] R[z] R[x] R[z] R[z]", 3, 5),
    "a P after a non-parallel R turns": ("R[z] P[x]", 1, 2),
    "as many P turn": ("P[x] R[y] P[x]", 1, 3),
    "but not about a parallel R": ("P[z] R[z] P[z]", 1, 2),
    "two parallelograms turn independently": ("P(4R)[y] P(4R)[y]", 0, 2),
    "four planar R": ("R[x] R[x] R[x] R[x]", 1, 3),
    "four R through a point": ("R[x]@A R[y]@A R[z]@A R[x]@A", 3, 3),
    "RRR parallel then S": ("R[x] R[x] R[x] S", 3, 5),
    "UPUR": ("U[x,y] P[z] U[y,x] R[z]", 3, 6),
    "coaxial R": ("R[x]@A R[x]@A", 1, 1),
    "coaxial R, then not": ("R[x]@A P[z] R[x]@A", 1, 3),
}


@pytest.mark.parametrize("name", PITFALLS)
def test_pitfall(name):
    text, r, dim = PITFALLS[name]
    motion = _motion(text)
    assert (motion.poc.r, motion.dim) == (r, dim)
    assert _by_rules(motion) == _by_twists(parse_chain(text))


DIRECTIONS = (X, Y, Z, X, Y, unit((0.3, 0.5, 0.8)), unit((1, 1, 0)))
axes = st.sampled_from(DIRECTIONS)
labels = st.sampled_from(["", "", "A", "A", "B"])
revolute = st.builds(lambda axis, point: ChainJoint(REVOLUTE, (axis,), point), axes, labels)
joints = st.one_of(
    revolute,
    revolute,
    revolute,
    st.builds(lambda axis: ChainJoint(PRISMATIC, (axis,)), axes),
    st.builds(lambda axis, point: ChainJoint(CYLINDRICAL, (axis,), point), axes, labels),
    st.builds(
        lambda pair, point: ChainJoint(UNIVERSAL, pair, point),
        st.sampled_from([(X, Y), (Y, X), (Z, X), (X, Z)]),
        labels,
    ),
    st.builds(lambda point: ChainJoint(SPHERICAL, (), point), labels),
    st.builds(lambda axis: Parallelogram("4R", axis), axes),
    st.builds(lambda axis, kind: Parallelogram(kind, axis), axes, st.sampled_from(["4R", "4R", "4S", "4U"])),
)
chains = st.lists(joints, min_size=1, max_size=8).map(lambda items: Chain(tuple(items)))


@pytest.mark.slow
@examples(200)
@given(chains)
def test_rules_and_twists_agree_on_random_chains(chain):
    assert _by_rules(serial(chain)) == _by_twists(chain)


@examples(150)
@given(chains)
def test_fixed_directions_are_not_more_than_there_are_elements(chain):
    motion = serial(chain)
    assert len(motion.poc.t_mark.axes) in (0, motion.poc.t)
    assert len(motion.poc.r_mark.axes) in (0, motion.poc.r)
    assert motion.passive >= 0
    assert motion.restated.t >= motion.poc.t
    assert motion.poc.dependent >= 0


@examples(150)
@given(chains, chains)
def test_a_longer_chain_does_no_less(first, second):
    """Eq. (1) is a union."""
    whole = serial([*first.elements, *second.elements])
    parts = serial(first), serial(second)
    assert whole.dim <= min(6, parts[0].dim + parts[1].dim)
    assert all(whole.dim >= part.dim and whole.poc.r >= part.poc.r for part in parts)


def test_marks_name_joints_and_give_fixed_axes():
    poc = _motion("P[x] P[y] R[z]").poc
    assert (poc.t_mark.relation, poc.t_mark.names, set(poc.t_mark.axes)) == ("perpendicular", ("R1",), {X, Y})
    assert poc.r_mark == Mark("parallel", ("R1",), (Z,))


def test_a_direction_that_turns_is_not_called_fixed():
    assert _motion("R[z] P[x]").translations.fixed == ()
    assert _motion("R[z] P[x]").translations.plane == Z


# ---- inner loops -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]",
        "{R[x] R[x] | R[x] R[x]} R[y]",
        "P[x] {R[x] R[x] | R[x] R[x] R[x]} R[y] R[y]",
        "{{R[x] R[x] | R[x] R[x]} R[x] | P[y] R[x] R[x]} R[y]",
        "{P[x] P(4R)[y] | R[y] R[y] R[y]} P[y]",
        "{S P[x] S | P[x] P[y] R[z]} R[x]",
        "{R[z] P[x] | R[z] R[z] P[x]} R[x]",
        "{S R[y] P[y] | R[x] R[x] P[y]} R[z] R[z]",
    ],
)
def test_a_chain_with_inner_loops_by_both_routes(text):
    assert _by_rules(_motion(text)) == _by_twists(parse_chain(text))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("{S | S} R[x]", "a rotation whose axis turns"),
        ("{S P[x] P[y] P[z] | U[x,y]} R[x]", "several rotations"),
        ("{H[x] | C[x]} R[y]", "pitch"),
        ("{R[z] P[1,0,1] P[0,1,1] | R[z] P[1,0,2] P[0,1,3] | R[z] P[1,0,4] P[0,1,5]} R[x]", "coupled"),
        ("H[z] R[x]", "pitch of H1"),
        ("R[x] R[x] H[x]", "pitch of H1"),
    ],
)
def test_what_the_rules_refuse(text, reason):
    motion = serial(parse_chain(text))
    assert isinstance(motion, Refusal)
    assert reason in motion.reason


# ---- helical joints ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", ["R[z] R[z] R[z] H[z] P[z]", "P[z] H[z]", "R[x] R[x] R[x] R[z] R[z] H[z]"])
def test_a_pitch_along_a_translation_makes_no_difference(text):
    assert _by_rules(_motion(text)) == _by_twists(parse_chain(text))


# ---- use ---------------------------------------------------------------------------------------------------


def test_an_empty_chain_does_not_move():
    assert str(serial([]).poc) == "t⁰ r⁰"


def test_another_mode_is_an_error():
    with pytest.raises(UsageError, match="unknown mode 'fast'"):
        serial([], mode="fast")


def test_the_work_grows_in_proportion_to_the_length_of_a_chain():
    short, long = (parse_chain(" ".join(["R[x] R[y] P[z] R[z] R[x] P[y] R[y] R[x]"] * times)) for times in (3, 6))
    assert serial(short).poc.dim == 6
    assert calls(lambda: serial(long)) <= 2 * calls(lambda: serial(short))


def test_the_derivation_of_the_papers_first_hybrid_chain():
    motion = _motion("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]")
    whole = motion.derivation.whole
    assert whole.text() == "[t²(⊥R12); r¹(∥R12)] ∪ [t²(⊥R5); r¹(∥R5)] = [t³; r²(∥◇(R12, R5))]"
    assert motion.derivation.conclusion == "so the end link has three translations and two rotations"
    assert motion.derivation.steps[-1].rule == "linear rule"
    assert len(motion.derivation.parts) == 1


def test_the_derivation_of_the_papers_second_hybrid_chain():
    whole = _motion("P[y] P(4R)[x] P(4R)[y]").derivation.whole
    assert whole.text() == "[t¹(∥P1); r⁰] ∪ [t¹(∥◇(Pa1)); r⁰] ∪ [t¹(∥◇(Pa2)); r⁰] = [t³; r⁰]"

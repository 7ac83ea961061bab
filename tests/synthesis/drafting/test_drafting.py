"""Chains to files: sound, with the topology of the chains, closed at home whatever the dimensions are."""

import random
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import assur
from assur.errors import AssurError, UsageError
from assur.kinematics.closure import closure_error
from assur.kinematics.home import home_values
from assur.kinematics.rates.finite_motion import classify_at
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.status import Status
from assur.kinematics.validation.check import doubts, faults
from assur.model.dimensions import with_parameters
from assur.model.file.reader import read_text
from assur.model.mechanism import MechanismRecord
from assur.model.registry import topology_names
from assur.model.topologies import load_topology
from assur.performance.indices import indices_at
from assur.synthesis.drafting.drafting import Drafted, drafted
from assur.synthesis.drafting.facts import facts
from assur.synthesis.drafting.homes import remarks
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chains
from catalogue import each
from examples import examples

PATH = Path("my.toml")
HYBRID = ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[y] P(4R)[x]"]


def read(found: Drafted) -> MechanismRecord:
    return read_text(found.text, PATH)


def test_a_home_that_rounded_dimensions_move_is_written_as_the_loops_close():
    """With rounded lengths a short offset in the loop turns its crank by four degrees."""
    record = read(drafted(parse_chains(["P[x] P(2US)[y]", "{P[x] R[z] | P[x] R[z] R[z]} C[z]"]), PATH))
    assert doubts(record) == ()
    assert np.any(record.home)


def of(*chains: str, **options: object) -> Drafted:
    return drafted(parse_chains(chains), PATH, **options)


@pytest.mark.parametrize("name", each(topology_names(), ("planar_3rrr", "delta_4s", "three_ups_up")))
def test_every_topology_of_the_catalogue_becomes_a_sound_file_with_its_declared_facts(name):
    described = load_topology(name)
    numbers = [f"{limb}.{joint}" for limb, joint in described.actuate]
    found = drafted(described.chains, PATH, actuate=numbers or None, mode=described.mode)
    record = read(found)
    assert faults(record) == ()
    topology = assur.topology(record, mode=described.mode)
    assert described.declared.differences(topology) == ()
    assert facts(topology) == facts(assur.topology(name))
    internal = (topology.internal_freedoms, len(topology.internal_joints))
    assert described.declared.internal_freedoms in (None, internal)
    assert len(record.inputs) == topology.dof - topology.internal_freedoms
    assert Status(int(classify_at(record, home_values(record)))) is Status.regular


@pytest.mark.parametrize(
    "name", each(["delta_4s", "planar_3rrr", "orthoglide", "three_ups_up"], ["delta_4s", "planar_3rrr"])
)
def test_as_drawn_the_loops_close_whatever_the_parameters_are(name):
    record = read(drafted(load_topology(name).chains, PATH, coordinates=True))
    zeros = np.zeros(len(record.coordinates))
    assert not np.any(record.home)
    rng = random.Random(1)
    values = {key: item.value + rng.uniform(5.0, 40.0) for key, item in record.parameters.items()}
    for changed in (record, with_parameters(record, **values)):
        assert float(closure_error(changed, zeros)) < 1e-10
    # not because there is nothing to close: without one of the two places of a joint it does not
    joint = next(item for item in record.joints.values() if item.child == record.platform.link)
    assert np.linalg.norm(joint.child_at) > 1.0


def test_a_symmetric_mechanism_is_one_template():
    text = drafted(repeated("R[z] R[z] R[z]", 3), PATH).text
    assert text.count("[limbs.") == text.count("[limbs.leg")
    assert 'repeat = { about = "z", count = 3 }' in text
    assert 'pose = ["x", "y", "phi"]' in text
    assert [item.name for item in read_text(text, PATH).inputs] == ["q1", "q2", "q3"]


def test_no_limb_bears_the_name_of_a_dimension():
    """e1 and l1 are dimensions: a fifth kind of limb, named e, was refused for it."""
    record = read(of("P[x] R[z] R[z]", "R[z] P[x] R[z]", "R[z] R[z] P[x]", "R[z] R[z] R[z]", "P[x] P[y] R[z]"))
    assert {name.partition(".")[0] for name in record.joints} == {"a1", "b1", "c1", "d1", "f1"}


def test_chains_that_are_turns_of_one_another_are_seen_to_be():
    together = drafted(repeated("R[y] P(4S)[y]", 3), PATH).text
    apart = drafted(load_topology("delta_4s").chains, PATH).text
    assert together.partition("format = 1")[2] == apart.partition("format = 1")[2]


def test_a_hybrid_chain_needs_no_more_than_its_text():
    found = of(*HYBRID)
    record = read(found)
    assert faults(record) == ()
    assert facts(assur.topology(record)) == facts(assur.topology(HYBRID))
    assert [item.coordinate.joint for item in record.inputs] == ["a1.A", "a1.D", "b1.I"]
    assert record.platform.orientation == "constant"
    assert record.chains["a1"].loop == ("a1.A", "a1.B", "a1.C", "a1.F", "a1.E", "a1.D")


def test_its_pose_follows_from_what_it_does():
    poses = {
        ("x", "y"): ("R[z] R[z] R[z]", "R[z] R[z]"),
        ("z", "theta", "psi"): load_topology("three_rps").chains,
        ("x", "y", "z", "qw", "qx", "qy", "qz"): load_topology("gough_stewart").chains,
    }
    for pose, chains in poses.items():
        chains = parse_chains(chains) if isinstance(chains[0], str) else chains
        assert read(drafted(chains, PATH)).platform.pose == pose


def test_what_is_driven_may_be_named():
    found = of("R[z] P[x] R[z]", "R[z] R[z]", actuate=["1.2", "2.1"])
    assert [item.coordinate.joint for item in read(found).inputs] == ["a1.B", "b1.D"]


def test_where_the_first_joints_are_too_few_others_are_driven_too():
    record = read(of("P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]"))
    limbs = [item.coordinate.joint.partition(".")[0] for item in record.inputs]
    assert len(limbs) == 3
    assert len(set(limbs)) == 2
    assert faults(record) == ()


def test_a_home_that_would_be_singular_is_moved():
    """The 3-UPU with upright legs can turn as it stands; a little away it keeps its orientation."""
    described = load_topology("three_upu")
    found = drafted(described.chains, PATH, mode="translation", coordinates=True)
    record = read(found)
    assert np.any(record.home)
    drawn = classify_at(record, np.zeros(len(record.coordinates)))
    assert Status(int(drawn)) is Status.constraint
    assert Status(int(classify_at(record, home_values(record)))) is Status.regular
    assert "a little away from where it was drawn" in found.text


@pytest.mark.parametrize(
    ("chains", "options", "message"),
    [
        (("R[z] R[z] R[z]",), {}, "one open chain"),
        (("R[z]", "R[z]"), {}, "a structure that does not move"),
        (("R[z] R[z] R[z] R[z]", "R[z] R[z]", "R[z]"), {}, "platform does not move; by themselves move R1, R2, R3, R4"),
        (("R[x] R[y] R[z] S", "S S"), {"actuate": ["1.1", "1.2", "1.1"]}, "twice"),
        (("R[z] R[z] R[z]", "R[z] R[z]"), {"actuate": ["1.1"]}, "do not determine the mechanism: too few"),
        (("P[x] P[x] P[y] R[z]", "P[y] R[z] R[z]"), {}, "P1 can move while it stands still"),
    ],
)
def test_what_cannot_be_is_refused_with_a_reason(chains, options, message):
    with pytest.raises(UsageError, match=message):
        of(*chains, **options)


AXES = st.sampled_from(["x", "y", "z", "x", "y", "z", "1,1,0", "0.6,0,0.8"])
JOINTS = st.one_of(
    st.builds(lambda letter, axis: f"{letter}[{axis}]", st.sampled_from("RRRPCH"), AXES),
    st.builds(lambda kind, axis: f"P({kind})[{axis}]", st.sampled_from(["4R", "4S", "4U", "2US"]), AXES),
    st.sampled_from(["S", "S", "R", "P", "U", "U[x,y]", "U[y,z]"]),
)
CHAINS = st.lists(JOINTS, min_size=2, max_size=4).map(" ".join)
LIMBS = st.lists(JOINTS, min_size=2, max_size=3).map(" ".join)


@examples(15)
@given(st.lists(CHAINS, min_size=2, max_size=3))
def test_random_chains_become_a_sound_file_or_a_clear_refusal(texts):
    check_or_refuse(lambda: parse_chains(texts))


@examples(8)
@given(LIMBS, st.integers(2, 3))
def test_random_limbs_become_a_sound_file_or_a_clear_refusal(text, count):
    check_or_refuse(lambda: repeated(text, count))


def check_or_refuse(chains):
    try:
        found = drafted(chains(), PATH)
    except AssurError as error:
        said = error.message
        found = None
    if found is None:
        assert len(said) > 20
        return
    record = read(found)
    assert faults(record) == ()
    assert facts(assur.topology(record)) == facts(found.topology)


@pytest.mark.parametrize(
    ("chains", "title"),
    [
        (["H[x] R[x] R[x] R[x]", "H[y] R[y] R[y] R[y]", "H[z] R[z] R[z] R[z]"], "3-HRRR mechanism, 3T"),
        pytest.param(
            ["R[z] R[z] R[z]", "R[z] R[z] R[z]", "P[x] R[z]"], "2RRR-PR mechanism, 1T1R", marks=pytest.mark.deep
        ),
    ],
)
def test_the_title_has_the_limbs_by_letters_and_the_motion(chains, title):
    assert f'title  = "{title}"' in drafted(parse_chains(chains), PATH).text


@pytest.mark.parametrize(
    "chains",
    [["R[z]@A H[z]@A", "P[z]"], ["R[z]@A H[z]@A R[x]", "P[z] R[x]"], ["R[x]@A H[x]@A R[z] R[z]", "R[z] R[z] R[z]"]],
)
def test_screws_are_drafted_without_a_word_about_singularities(chains):
    """Their leads are short against the links, which makes them slow, J badly conditioned, and nothing singular."""
    assert not [
        note for note in drafted(parse_chains(chains), PATH).notes if not note.startswith("the condition number")
    ]


@pytest.mark.parametrize(
    "chains",
    [
        ["{P[z] R[y] R[y] | P[z] R[y] R[y]} R[z]", "P[x] R[y] R[y] R[z]"],
        [chain.text for chain in repeated("P[x] R[y] S", 3)],
        pytest.param(
            ["P[x] R[y] P(4R)[z] R[y]", "P[y] R[z] P(4R)[x] R[z]", "P[z] R[x] P(4R)[y] R[x]"], marks=pytest.mark.deep
        ),
    ],
)
def test_home_is_not_at_the_end_of_a_leg_s_reach(chains):
    record = read(drafted(parse_chains(chains), PATH))
    motion = instantaneous(record, home_values(record))
    assert float(motion.measures["input"]) > 0.25


def test_a_large_condition_number_at_home_is_said():
    record = read(drafted(repeated("R[z] R[z] R[z]", 3), PATH))
    assert remarks(record) == ()
    turned = with_parameters(record, beta=20.0)
    condition = float(indices_at(turned, home_values(turned)).condition_number)
    assert condition > 50
    assert [f"is {condition:.0f}," in said for said in remarks(turned)] == [True]


def test_a_home_near_the_end_of_a_leg_s_reach_is_said():
    """Rods of a linear Delta that lie almost level, across their rails."""
    record = read(drafted(repeated("P[z] P(4S)[y]", 3), PATH))
    assert remarks(record) == ()
    assert "the end of a leg's reach" in remarks(with_parameters(record, l1=100.3))[0]


@pytest.mark.deep
def test_lengths_that_would_have_to_be_special_give_way_to_coordinates():
    """Whole lengths close too, but the centres of base and platform come apart, and the platform translates."""
    made = drafted(parse_chains(["R[x]@O S R[y]@O", "R[y]@O S R[z]@O", "R[z]@O S R[x]@O"]), PATH)
    assert (made.topology.poc.t, made.topology.poc.r) == (0, 3)
    assert "the loops close whatever their values are" in " ".join(made.text.replace("#", "").split())


def test_axes_through_several_points_are_not_drafted():
    with pytest.raises(UsageError, match="limb 1: the axis of U1 runs through further points"):
        drafted(parse_chains(["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "S P[z] R[x]"]), Path("my.toml"))

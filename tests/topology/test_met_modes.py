"""Operation modes that are met, held against the joint graph: the assembly closes there, and so does the motion."""

import numpy as np
import pytest

import assur
from assur.derived_topology import operation_modes
from assur.joint_graph.frames import frames
from assur.kinematics.closure import assemble, closure_error, closure_jacobian, mobility
from assur.kinematics.home import home_values
from assur.kinematics.structure import linkage, values_from_home
from assur.model.registry import load_record
from assur.numerics import rotations
from assur.synthesis.drafting.drafting import drafted
from assur.topology.met_modes import met_modes
from assur.topology.notation import parse_chains
from assur.topology.screws.assembled import assembled_at
from assur.topology.screws.placing import place


def assembly(record, mode):
    """Joint values of the example, which says how far each joint is from home."""
    return home_values(record) + np.concatenate([mode.example[name] for name in record.joints])


def turned(record, start):
    """Rotation vectors (N, 3) of the platform, close to an assembly, against the first."""
    near = start + 0.05 * np.random.default_rng(3).normal(size=(40, len(start)))
    near = assemble(record, near, near=True)
    rotation = frames(record, near.values[near.closed])[record.platform.link][0]
    assert len(rotation) > 20
    return rotations.to_vector(np.swapaxes(rotation[:1], -1, -2) @ rotation)


def singular_values(record, value):
    """Of the closure at joint values (n,), as shares of the largest."""
    singular = np.linalg.svd(closure_jacobian(record, value[None])[0], compute_uv=False)
    return singular / singular[0]


@pytest.fixture(scope="module")
def upu():
    record = assur.load("three_upu")
    return record, {mode.name: mode for mode in operation_modes(record)}


def test_a_3_upu_translates_moves_in_a_plane_and_turns(upu):
    record, modes = upu
    assert set(modes) == {"3T", "2T1R", "3R"}
    for name, axes in {"3T": 0, "2T1R": 1, "3R": 3}.items():
        value = assembly(record, modes[name])
        assert closure_error(record, value[None])[0] < 1e-9
        assert mobility(record, value).freedoms == modes[name].dof == 3
        assert np.sum(np.linalg.svd(turned(record, value), compute_uv=False) > 1e-6) == axes


def test_limbs_with_planar_joints_have_two_modes_and_drives_that_do_not_fix_them_give_no_coupling_degree():
    chains = ["R[z] E[x] R[z]", "R[z] E[y] R[z]", "R[z] E[0.6,0.8,0] R[z]"]
    modes = operation_modes(chains)
    assert [(mode.name, mode.dof, mode.coupling_degree) for mode in modes] == [("3T1R", 4, None), ("2T1R", 3, None)]


def test_where_two_modes_meet_the_loops_are_closed_and_singular(upu):
    """By the joint graph: a freedom more than in any of them."""
    record, modes = upu
    assert {other.mode for mode in modes.values() for other in mode.meets} == set(modes)
    for mode in modes.values():
        for other in mode.meets:
            value = assembly(record, other)
            assert closure_error(record, value[None])[0] < 1e-8
            inside, there = (singular_values(record, place) for place in (assembly(record, mode), value))
            rank = np.sum(inside > 1e-6)
            assert inside[rank - 1] > 1e-3 > 1e-4 > there[rank - 1]
            assert mode.name in {back.mode for back in modes[other.mode].meets}


def test_a_parallelogram_folds_over_where_it_is_flat_and_what_has_crossed_is_named():
    built = place(parse_chains(["P(4R)[z] R[z]", "R[z] R[z] R[z]"]))
    (first, second) = met_modes([built] * 2, meeting=True)
    assert [(mode.crossed, mode.at_home) for mode in (first, second)] == [((), True), (("Pa1",), False)]
    assert [[(other.mode, other.at_home) for other in mode.meets] for mode in (first, second)] == [
        [(second.name, False)],
        [(first.name, False)],
    ]
    value = np.concatenate([first.meets[0].example[name] for name in built.joints])
    flat = assembled_at(built, value)
    points = np.array([flat.joints[name].point for name in ("Pa1.a", "Pa1.b", "Pa1.c", "Pa1.d")])
    assert np.linalg.matrix_rank(points[1:] - points[0], tol=1e-4) == 1


def test_a_3_rer_translates_and_moves_in_a_plane_from_one_home():
    """Hinges along three directions of a plane, and planar joints in it."""
    axes = [(1, 0), (-0.5, 0.75**0.5), (-0.5, -(0.75**0.5))]
    modes = {mode.name: mode for mode in operation_modes([f"R[{x},{y},0] E[z] R[{x},{y},0]" for x, y in axes])}
    at_home = {name: [other.mode for other in mode.meets if other.at_home] for name, mode in modes.items()}
    assert (at_home["2T1R"], at_home["3T"]) == (["3T"], ["2T1R"])
    assert {value for values in modes["3T"].meets[0].example.values() for value in values} == {0.0}


@pytest.mark.deep
def test_a_3_uru_whose_base_and_platform_axes_meet_changes_among_the_modes_of_dymo(tmp_path):
    """Zlatanov, Bonev and Gosselin 2002: it translates, turns about the common point, or moves in its plane."""
    limb = [("x", "y"), *((f"-0.5,{s * 0.75**0.5},0", f"{-s * 0.75**0.5},-0.5,0") for s in (1, -1))]
    chains = parse_chains([f"R[{out}]@O R[{on}] R[{on}] R[{on}] R[{out}]@Q" for out, on in limb])
    file = tmp_path / "dymo.toml"
    file.write_text(drafted(chains, file, actuate=["1.2", "2.2", "3.2"], mode="translation").text, encoding="utf-8")
    modes = {mode.name: mode.poc for mode in operation_modes(assur.load(file))}
    assert {name: (poc.t, poc.r) for name, poc in modes.items() if name in ("3T", "3R", "2T1R")} == {
        "3T": (3, 0),
        "3R": (0, 3),
        "2T1R": (2, 1),
    }


@pytest.mark.parametrize("name", ["three_rps", pytest.param("zeng2019", marks=pytest.mark.deep)])
def test_an_assembly_of_a_mode_is_one_of_the_file(name):
    """Ball joints, aliases and parallelograms that crossed over among them."""
    record = load_record(name)
    built = linkage(record)
    for mode in met_modes([built] * 2):
        values = values_from_home(record, np.concatenate([mode.example[joint] for joint in built.joints]))
        assert closure_error(record, values[None])[0] < 1e-9
        assert mobility(record, values).freedoms == mode.dof

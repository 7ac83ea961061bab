"""Jp v = Jq qdot of the joint graph: against closed forms, differences and formulas for a 3-UPU made here."""

import re
from pathlib import Path

import numpy as np
import pytest
import sympy

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import held_inputs, inputs_of
from assur.kinematics.closure import assemble, closure_jacobian
from assur.kinematics.pose import pose_of, pose_rates
from assur.kinematics.rates.instantaneous import SINGULAR, instantaneous
from assur.kinematics.rates.velocity import velocity_map
from assur.singularity.examples import singular_examples

HERE = Path(__file__).parent
DELTA = HERE.parents[1] / "model" / "file" / "delta.toml"
DOCS = HERE.parents[2] / "docs" / "mechanism-file.md"
CLOSED = ["fivebar", "zeng2019"]


@pytest.fixture(scope="module")
def upu():
    return assur.load(HERE / "upu.toml")


@pytest.fixture(scope="module")
def planar(tmp_path_factory):
    """The 3-RRR of the page on mechanism files: a pose with an angle."""
    path = tmp_path_factory.mktemp("docs") / "planar3rrr.toml"
    path.write_text(re.search(r"```toml\n(format.*?)```", DOCS.read_text(), re.DOTALL)[1])
    return assur.load(path)


def _regular(mechanism, mode, count=80):
    low, high = np.array([mechanism.box[name] for name in mechanism.platform.pose]).T
    poses = np.random.default_rng(1).uniform(low, high, (count, len(low)))
    found = mechanism.inverse(poses, mode)
    regular = (found.exists & (found.status == 0))[:, 0]
    assert np.sum(regular) > 10
    return poses[regular], found.joints[regular, 0]


def types_of(instant):
    return [name for name, holds in instant.types.items() if holds]


@pytest.mark.parametrize("name", CLOSED)
def test_the_relation_is_that_of_the_closed_form(name):
    mechanism = assur.load(name)
    poses, joints = _regular(mechanism, mechanism.modes.default_working)
    here, form = instantaneous(mechanism, joints), velocity_map(mechanism, poses)
    # same null relation: every row is a combination of the closed form's rows, the same one for Jp and Jq
    rows, printed = (np.concatenate([item.jp, item.jq], axis=-1) for item in (here, form))
    combined = rows @ np.linalg.pinv(printed) @ printed
    np.testing.assert_allclose(combined, rows, atol=1e-8 * np.abs(rows).max())
    product = np.linalg.det(here.jp) * np.linalg.det(here.jq)
    np.testing.assert_array_equal(np.sign(product), np.sign(form.det_jp * form.det_jq))
    assert np.all(np.linalg.det(here.jq) > 0.0)
    assert not np.any(here.singular_output | here.singular_input)
    assert not np.any(list(here.types.values()))


@pytest.mark.parametrize("name", CLOSED)
def test_singular_sides_are_those_of_the_closed_form_where_the_closure_keeps_its_rank(name):
    mechanism = assur.load(name)
    compared = 0
    for example in singular_examples(mechanism):
        here = instantaneous(mechanism, example.joints)
        form = velocity_map(mechanism, example.pose, example.mode)
        if here.types["IIM"]:
            assert bool(here.singular_output & here.singular_input)
            continue
        compared += 1
        assert bool(here.singular_output) == bool(form.singular_output), example.factor.name
        assert bool(here.singular_input) == bool(form.singular_input), example.factor.name
        expected = {"RO", "II"} if form.singular_output else {"RI", "IO"}
        assert set(types_of(here)) == expected, example.factor.name
        assert float(here.gap) > 1e8
    assert compared >= 3


@pytest.mark.parametrize("name", CLOSED)
def test_the_relation_holds_at_singularities_too(name):
    """For every motion that keeps the loops closed, by another null space."""
    mechanism = assur.load(name)
    for example in singular_examples(mechanism):
        here = instantaneous(mechanism, example.joints)
        _, sizes, rows = np.linalg.svd(closure_jacobian(mechanism, example.joints))
        null = rows[np.sum(sizes > 1e-9 * sizes[0]) :].T
        signs = np.array([item.sign for item in mechanism.inputs])
        left = here.jp @ pose_rates(mechanism, example.joints) @ null
        right = here.jq @ (signs[:, None] * null[list(mechanism.input_indices)])
        length = characteristic_length(mechanism)
        np.testing.assert_allclose(left, right, atol=1e-9 * length)
        complete = np.linalg.matrix_rank(np.concatenate([here.jp, here.jq], axis=-1), tol=1e-6)
        assert complete == len(here.jp) - bool(here.types["IIM"]) * (
            int(here.ranks.related) - int(here.general.related)
        )


def _differences(mechanism, home, step):
    """Poses' change per change of each input, by assembling again."""
    columns = []
    for index, item in enumerate(mechanism.inputs):
        change = np.zeros(len(mechanism.inputs))
        change[index] = step * (characteristic_length(mechanism) if item.coordinate.kind == "length" else 1.0)
        inputs = inputs_of(mechanism, home) + np.array([change, -change])
        start = held_inputs(mechanism, home, inputs)
        found = assemble(mechanism, start, held=mechanism.input_indices, tolerance=1e-15)
        ahead, behind = pose_of(mechanism, found.values)
        columns.append((ahead - behind) / (2 * change[index]))
    return np.array(columns).T


@pytest.mark.parametrize("which", ["delta", "planar", "upu"])
def test_it_agrees_with_central_differences(which, request):
    mechanism = assur.load(DELTA) if which == "delta" else request.getfixturevalue(which)
    home = mechanism.home_values
    here = instantaneous(mechanism, home)
    matrix = np.linalg.solve(here.jp, here.jq)
    np.testing.assert_allclose(matrix, _differences(mechanism, home, 1e-5), atol=1e-7 * np.abs(matrix).max())


def test_rods_that_spin_change_nothing(balls):
    here = instantaneous(balls, balls.home_values)
    assert (int(here.ranks.internal), types_of(here)) == (6, [])
    expected = _differences(balls, balls.home_values, 1e-5)
    np.testing.assert_allclose(np.linalg.solve(here.jp, here.jq), expected, atol=1e-6 * np.abs(expected).max())


def test_measures_do_not_depend_on_the_unit():
    paper = assur.load("zeng2019")
    metres = assur.load("zeng2019", **{name: item.value / 1000 for name, item in paper.parameters.items()})
    lengths = np.array([item.kind == "length" for item in paper.coordinates])
    large = instantaneous(paper, paper.home_values)
    found = assemble(metres, np.where(lengths, paper.home_values / 1000, paper.home_values), tolerance=1e-15)
    small = instantaneous(metres, found.values)
    for name in ("output", "input"):
        assert 0.0 < float(large.measures[name]) <= 1.0
        assert float(small.measures[name]) == pytest.approx(float(large.measures[name]), rel=1e-6)


def test_measures_are_sines_of_one_set_of_angles(upu):
    """The rows of (Jp, Jq) are orthonormal, lengths in characteristic lengths: Jp Jp' + Jq Jq' = 1."""
    here = instantaneous(upu, upu.home_values)
    total = here.jp @ here.jp.T + here.jq @ here.jq.T
    np.testing.assert_allclose(total, np.eye(3), atol=1e-12)  # every coordinate here is a length


@pytest.mark.parametrize("shape", [(), (1,), (3, 1, 2), (0,)])
def test_every_batch_shape(shape):
    fivebar = assur.load("fivebar")
    values = np.broadcast_to(fivebar.home_values, (*shape, 5))
    here = instantaneous(fivebar, values)
    assert here.jp.shape == here.jq.shape == (*shape, 2, 2)
    for found in (here.closed, here.gap, here.singular_output, here.platform_gains, *here.measures.values()):
        assert found.shape == shape
    assert all(found.shape == shape for found in here.types.values())


def test_a_pose_with_fewer_coordinates_than_inputs(tmp_path):
    """Where only the place of a hexapod counts, six inputs determine it and it does not determine them."""
    text = (HERE / "hexapod.toml").read_text()
    whole = assur.load(HERE / "hexapod.toml")
    (tmp_path / "place.toml").write_text(text.replace(', "qw", "qx", "qy", "qz"]', "]"))
    here = instantaneous(assur.load(tmp_path / "place.toml"), whole.home_values)
    full = instantaneous(whole, whole.home_values)
    assert (here.jp.shape, here.jq.shape) == ((3, 3), (3, 6))
    assert (bool(here.singular_output), bool(here.singular_input), types_of(here)) == (False, True, [])
    expected = np.linalg.solve(full.jp, full.jq)[:3]
    np.testing.assert_allclose(np.linalg.solve(here.jp, here.jq), expected, atol=1e-10 * np.abs(expected).max())


def test_what_is_not_assembled_has_no_numbers():
    fivebar = assur.load("fivebar")
    values = np.array([fivebar.home_values, fivebar.home_values + 0.1])
    here = instantaneous(fivebar, values)
    assert here.closed.tolist() == [True, False]
    assert np.all(np.isnan([here.jp[1], here.jq[1]]))
    assert all(np.isnan(measure[1]) and np.isfinite(measure[0]) for measure in here.measures.values())
    assert not np.any(here.singular_output)
    with pytest.raises(assur.UsageError, match="joint values of fivebar: 2 values, 5 wanted"):
        instantaneous(fivebar, [0.0, 1.0])


# The 3-UPU: R1 and R4 tangential, R2 and R3 across the leg. A leg d = p + (r - R) e lets the platform feel no force
# but one couple, along the normal of its axes, n = (d.e) e + d.z z. With a = d.e, the three n are in one plane where
# a1 a2 + a2 a3 + a3 a1 = 0 or d.z = 0: on the cylinder of radius 2 |r - R| about z, and at z = 0.
RADIUS = 200.0


def upu_joints(point):
    """Joint values of the 3-UPU with its platform at a point, not turned."""
    values = []
    for angle in 2 * np.pi / 3 * np.arange(3):
        outwards, along = np.array([[np.cos(angle), np.sin(angle), 0.0], [-np.sin(angle), np.cos(angle), 0.0]])
        leg = np.asarray(point) - 100.0 * outwards
        length = np.linalg.norm(leg)
        second, first = -np.arcsin(leg @ along / length), np.arctan2(leg @ outwards, leg[2])
        values += [first, second, length, -second, -first]
    return np.array(values)


def test_the_cylinder_of_the_3_upu_is_where_its_couples_are_in_one_plane():
    """docs/derivations/instantaneous.md: det(n1, n2, n3) = sqrt(3)/2 z (3 (r - R)^2 - 3/4 (x^2 + y^2))."""
    x, y, z, gap = sympy.symbols("x y z gap")
    couples = []
    for angle in (0, 2 * sympy.pi / 3, 4 * sympy.pi / 3):
        outwards = sympy.Matrix([sympy.cos(angle), sympy.sin(angle), 0])
        leg = sympy.Matrix([x, y, z]) + gap * outwards
        couples.append((leg.dot(outwards) * outwards + leg[2] * sympy.Matrix([0, 0, 1])).T)
    claimed = sympy.sqrt(3) / 2 * z * (3 * gap**2 - sympy.Rational(3, 4) * (x**2 + y**2))
    assert sympy.expand(sympy.Matrix.vstack(*couples).det() - claimed) == 0


@pytest.mark.parametrize("angle", [0.0, 0.3, 2.0])
def test_constraint_singularity_of_a_3_upu(upu, angle):
    point = [RADIUS * np.cos(angle), RADIUS * np.sin(angle), 300.0]
    here = instantaneous(upu, upu_joints(point))
    assert bool(here.closed)
    assert (int(here.ranks.closure), int(here.ranks.twists), int(here.general.twists)) == (11, 4, 3)
    assert bool(here.platform_gains)
    assert {"IIM", "RO"} <= set(types_of(here))
    assert float(here.measures["closure"]) < SINGULAR
    motion = here.motion
    turns = motion.twists[:3]
    assert np.linalg.matrix_rank(turns, tol=1e-6) == 1, "the platform may turn about one direction"


def test_a_3_upu_next_to_it_is_regular(upu):
    for radius in (0.0, 190.0, 210.0):
        here = instantaneous(upu, upu_joints([radius, 0.0, 300.0]))
        assert types_of(here) == []
        assert not here.platform_gains
    near, far = (instantaneous(upu, upu_joints([radius, 0.0, 300.0])).measures["closure"] for radius in (199.9, 199.0))
    assert float(far / near) == pytest.approx(10.0, rel=0.05), "the measure goes to zero in proportion"


def test_a_loss_inside_a_limb_is_no_gain_of_the_platform():
    """sin(beta) = 0: parallelogram 2 of the paper's mechanism is flat, which lets its rods cross."""
    paper = assur.load("zeng2019")
    example = next(item for item in singular_examples(paper) if item.factor.name == "sin_beta")
    here = instantaneous(paper, example.joints)
    assert bool(here.types["IIM"])
    assert not here.platform_gains

import numpy as np
import pytest

from assur.errors import UsageError
from assur.numerics.rotations import about_axis
from assur.synthesis.poses import edges_at_poses, is_special, twists_at_poses
from assur.topology.analysis import sample
from assur.topology.notation import parse_chain
from assur.topology.screws.edges import closure, null_basis
from assur.topology.screws.placing import place
from assur.topology.screws.twists import motion_space

UNTURNED = np.broadcast_to(np.eye(3), (3, 3, 3))
ABOUT_Z = about_axis(np.array([0.0, 0.0, 1.0]), np.array([0.3, -0.5, 0.7]))

KEPT = [
    "R[x] R[x] P(4R)[y] R[x]",
    "U[x,y] P[x] U[y,x]",
    "R[x] R[x] R[x] R[y] R[y]",
    "R[x] C[y] U[y,x]",
    "P[x] P(4R)[y] P(4R)[z]",
    "C[x] C[x] R[x]",
    "R[x] U[x,y] S",
    "C[x] S P[y]",
    "P[x] S C[x]",
    "R[x] P(4S)[x]",
    "P[x] P(2US)[y]",
]


@pytest.mark.parametrize("text", KEPT)
def test_ranks_are_those_of_the_placed_limb_in_translation(text):
    """Against the linkage of the same chain, moved along its own freedom with its platform's orientation held."""
    chain = parse_chain(text)
    found = twists_at_poses(chain, UNTURNED, np.random.default_rng(1))
    other = sample(place([chain]), "translation").space
    assert set(np.linalg.matrix_rank(found, tol=1e-7)) == {other.shape[-1]}
    assert set(np.linalg.matrix_rank(found[:, :3], tol=1e-7)) == {np.linalg.matrix_rank(other[0, :3], tol=1e-7)}


def test_the_platform_has_the_orientation_asked_for():
    """Rz Ry Ry P turned about z: the two R along y undo each other, so the last stays along the turned y."""
    found = twists_at_poses(parse_chain("R[z] R[y] R[y] P[x]"), ABOUT_Z, np.random.default_rng(1))
    assert found[:, 3:, 3] == pytest.approx(ABOUT_Z[:, :, 0])
    assert found[:, :3, 2] == pytest.approx(ABOUT_Z[:, :, 1])


def test_an_orientation_out_of_reach():
    assert twists_at_poses(parse_chain("R[x] R[x] R[x]"), ABOUT_Z, np.random.default_rng(1)) is None
    assert twists_at_poses(parse_chain("P[x] P[y] P[z]"), ABOUT_Z, np.random.default_rng(1)) is None


def test_columns_stand_in_the_order_of_the_freedoms():
    found = twists_at_poses(parse_chain("C[x] P(4R)[z] R[x]"), UNTURNED, np.random.default_rng(1))
    assert found[:, :, 0] == pytest.approx(np.tile([0, 0, 0, 1, 0, 0], (3, 1)))
    assert found[:, :3, 1] == pytest.approx(np.tile([1, 0, 0], (3, 1)))
    assert found[:, :3, 2] == pytest.approx(np.zeros((3, 3)))


@pytest.mark.parametrize("text", ["H[x] R[x]", "R[x] {P[y] | P[y]}", "R[x]@A R[y]@A"])
def test_what_cannot_be_placed_is_refused(text):
    with pytest.raises(UsageError, match="can be placed"):
        twists_at_poses(parse_chain(text), UNTURNED, np.random.default_rng(1))


def test_configurations_as_written_may_be_special():
    assert is_special(parse_chain("P[x] P[y] R[x] P[y]"))
    assert not is_special(parse_chain("P[x] P[y] R[x] P[z]"))


@pytest.mark.parametrize(
    ("text", "freedoms"),
    [
        ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", 5),
        ("{P[y] R[x] | P[y] R[x] R[x]} R[x] R[y] R[y]", 5),
        ("{P[y] P(4R)[x] | P[y] P(4R)[x]} P[x]", 3),
    ],
)
def test_a_limb_with_an_inner_loop_moves_as_the_placed_one_does(text, freedoms):
    """Against the linkage of the same chain, by what each leaves of the platform's twists."""
    chain = parse_chain(text)
    edges = edges_at_poses(chain, UNTURNED, np.random.default_rng(1))
    assert [(edge.parent, edge.child) for edge in edges] == [("base", "output link")] * 2 + [
        ("output link", "platform")
    ]
    assert null_basis(closure(edges)).shape[-1] == freedoms
    other = sample(place([chain]), "translation").space
    found = motion_space(edges, "base", "platform")
    assert found.shape[-1] == other.shape[-1] == freedoms
    assert set(np.linalg.matrix_rank(found[:, :3], tol=1e-7)) == {np.linalg.matrix_rank(other[0, :3], tol=1e-7)}

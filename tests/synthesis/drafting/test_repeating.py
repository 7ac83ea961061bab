import numpy as np
import pytest

from assur.errors import UsageError
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chain, plain_text


def test_every_axis_is_turned_and_general_ones_stay_general():
    limbs = repeated("P R[x] U[y,1,0,1] {R[y] S | C[y]} P(4S)[y]".replace("y,1,0,1", "y; 1,0,1"), 3)
    first = parse_chain("P R[x] U[y; 1,0,1] {R[y] S | C[y]} P(4S)[y]")
    cosine, sine = np.cos(2 * np.pi / 3), np.sin(2 * np.pi / 3)
    turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    for before, after in zip(first.joints, limbs[1].joints, strict=True):
        axes = [getattr(joint, "axes", None) or getattr(joint, "axis", ()) for joint in (before, after)]
        assert before.general == after.general
        if not before.general and len(axes[0]):
            assert np.reshape(axes[1], (-1, 3)) == pytest.approx(np.reshape(axes[0], (-1, 3)) @ turn.T)


def test_a_point_is_each_limb_s_own():
    labels = [{joint.point for joint in limb.joints} for limb in repeated("R[x]@O' R[y]@O' S@A", 2)]
    assert labels == [{"O1'", "A1"}, {"O2'", "A2"}]


@pytest.mark.parametrize(
    ("text", "shared"),
    [
        ("R[x]@O R[y]@O R[z]@O", True),
        ("U[x,y]@O R[z]@O", True),
        ("R[x]@O R[y]@O R[z]", False),
        ("R[x]@O P[y] R[z]@O", False),
        ("R[x] R[y]", False),
    ],
)
def test_limbs_that_turn_about_one_point_share_it(text, shared):
    limbs = repeated(text, 3)
    labels = [{getattr(joint, "point", "") for joint in limb.joints} - {""} for limb in limbs]
    assert (labels == [{"O"}] * 3) is shared


@pytest.mark.parametrize("count", [-3, 0, 1, 61, 10**8])
def test_a_count_has_bounds(count):
    with pytest.raises(UsageError, match="allowed: 2 to 60"):
        repeated("R[z] R[z] R[z]", count)


def test_the_first_limb_is_as_it_was_written():
    """To the last digit, so that a file says [0.3, 0.1, 1] where its author did."""
    text = "R[1,0,0.3]@O R[0.2,1,0]@O R[0.3,0.1,1]@O"
    assert plain_text(repeated(text, 3)[0]) == text

import pytest


@pytest.fixture(scope="module")
def known(in_space):
    return {name: design for design in in_space.designs for name in design.names}


def test_what_a_design_says_of_itself(known):
    delta = known["tsai_platform"]
    assert delta.symmetric
    assert (delta.kinds, delta.joints, delta.parallelograms) == (1, 12, 3)
    assert (delta.redundant.collapsed, delta.redundant.joint_graph) == (3, 12)
    assert delta.actuated == ((1, 1), (2, 1), (3, 1))
    assert delta.reason == (
        "one virtual variable, for limbs 1 and 2 close a loop with Δ = +1; ξ = 5, 4, so 3 constraints are redundant; "
        "12 joints in three equal limbs"
    )


def test_reasons_count_in_words(in_space, in_legs):
    mixed = next(design for design in in_space.designs if design.redundant.collapsed == 1)
    assert "so 1 constraint is redundant" in mixed.reason
    upu = next(design for design in in_legs.designs if design.names == ("three_upu",))
    assert upu.reason.startswith("two virtual variables, for limbs 1 and 2 close a loop with Δ = +2; ξ = 6, 6, so no")
    assert upu.reason.endswith("the platform keeps its orientation in one operation mode, and may turn in others")


def test_freedoms_are_what_the_loops_leave(in_space):
    """Eq. (3)."""
    for design in in_space.designs:
        assert sum(limb.type.freedoms for limb in design.limbs) - sum(design.xi) == design.dof == 3
        assert sum(loop.delta for loop in design.loops.loops) == 0


def test_the_rank_begins_with_coupling_then_redundancy_then_joints(in_space):
    orders = [design.order[:3] for design in in_space.designs]
    assert orders == sorted(orders)
    assert len(set(orders)) > 5

"""What a synthesis looks at."""

import pytest

from assur.synthesis.plans import ASSEMBLED, plans
from assur.synthesis.question import question
from assur.synthesis.synthesis import ignored


@pytest.mark.parametrize("members", [1, 3])
def test_what_a_search_takes_is_told_by_how_many_members_are_looked_at(members):
    plan = next(plans(question("2T1R", max_joints=3, actuators="leg", members=members), [ignored]))
    looked_at = sum(min(some.members, members) for some in plan.sets)
    assert len(plan.sets) <= looked_at < plan.combinations
    assert plan.duration == pytest.approx(looked_at * ASSEMBLED)

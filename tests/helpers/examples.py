"""How many examples a property is tried with, in proportion to what the profile draws: half as many in `quick`."""

from hypothesis import settings


def examples(count: int) -> settings:
    """Settings of a test that draws `count` examples in a profile of a hundred."""
    return settings(max_examples=max(1, count * settings().max_examples // 100))

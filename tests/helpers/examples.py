"""How many examples a property is tried with: a number of its own in the profile `quick`, in proportion in `deep`."""

from hypothesis import settings

QUICK = settings.get_profile("quick").max_examples


def examples(quick: int) -> settings:
    """Settings of a test that draws `quick` examples in the profile of that name, and as many times more in another
    as that profile asks for."""
    return settings(max_examples=quick * settings().max_examples // QUICK)

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared


def demo(mechanism: MechanismName, /, *, shared: Shared = SHARED_DEFAULTS) -> Outcome:
    """demo."""
    raise NotImplementedError

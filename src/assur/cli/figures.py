from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared


def figures(mechanism: MechanismName, /, *, shared: Shared = SHARED_DEFAULTS) -> Outcome:
    """figures."""
    raise NotImplementedError

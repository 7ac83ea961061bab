from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared


def report(mechanism: MechanismName, /, *, shared: Shared = SHARED_DEFAULTS) -> Outcome:
    """report."""
    raise NotImplementedError

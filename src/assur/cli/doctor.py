from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared
def doctor(mechanism: MechanismName, /, *, shared: Shared = SHARED_DEFAULTS) -> Outcome:
    """doctor."""
    raise NotImplementedError

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared
def audit(mechanism: MechanismName, /, *, shared: Shared = SHARED_DEFAULTS) -> Outcome:
    """audit."""
    raise NotImplementedError

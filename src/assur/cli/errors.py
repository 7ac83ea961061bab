"""`assur errors`: how errors of dimensions and inputs move the platform at a pose."""

from __future__ import annotations

from assur.cli.options import POSE, SHARED_DEFAULTS, MechanismName, Outcome, PoseOptions, Shared


def errors(
    mechanism: MechanismName,
    /,
    *,
    at: PoseOptions = POSE,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """How errors of dimensions and of inputs move the platform, to first order.

    The inputs are held. A dimension counts wherever it is written, in one limb
    (leg1.L) and in one link (leg1.rod.L); the platform's rotation counts too,
    also where it should have none. An error that does not assemble alone is so
    called, with the joints that bear it, and with the pose at which links that
    bend settle. Tolerances of the file add to a worst case, a root sum of
    squares and a covariance, clearances of joints to their largest errors.
    Exit code 4: the mode does not reach the pose.

    For example:
        assur errors zeng2019 --pose -15.4714 9.6849 456.3315
        assur errors orthoglide --pose 0 0 0 --json
    """
    record = shared.mechanism(mechanism)
    from assur.cli import errors_answer

    return errors_answer.outcome(record, at.pose_of(record), at.mode_of(record))

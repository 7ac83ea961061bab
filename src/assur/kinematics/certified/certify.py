"""Certified answers to the direct and the inverse problem: by the closed form over intervals, or box by box.

Without a closed form each assembly that was found is proved on the joint graph; whether there are others is not.
"""

from __future__ import annotations

from typing import Literal, get_args

from numpy.typing import ArrayLike

from assur.errors import UnknownNameError, UsageError
from assur.kinematics import border
from assur.kinematics.certified.assemblies import certified_assemblies
from assur.kinematics.certified.boxes import direct_by_boxes
from assur.kinematics.certified.result import CertifiedSolutions
from assur.kinematics.certified.roots import direct_by_roots
from assur.kinematics.certified.signs import direct_by_signs, inverse_by_signs
from assur.kinematics.certified.systems import direct_by_system
from assur.kinematics.contract.admission import checked_form
from assur.kinematics.modes import Method
from assur.model.closed_form import Eliminant, PolynomialSystem
from assur.model.mechanism import MechanismRecord

Way = Literal["auto", "closed form", "boxes", "joint graph"]


def certified_direct(record: MechanismRecord, inputs: ArrayLike, way: Way = "auto") -> CertifiedSolutions:
    """Every pose at inputs (n,), in lengths and rad, each proved, and proved to be all; or where that is undecided.

    Args:
        record: the mechanism.
        inputs: as printed; a length counts as the exact number that its float is, an angle of a mechanism with angles
            in degrees as all numbers within 2^-51 of it, so that the proof holds of the degrees it came from.
        way: "closed form": its branches, its polynomial's roots or its system's solutions over intervals, each pose
            proved from the legs too where they have signs. "boxes": branch and prune over all poses that the links
            allow, which needs no closed form of the direct problem, but one of the inverse. "joint graph": each
            assembly that is found, not that there are no others. By default the first of them that is possible.

    Errors:
        UsageError: a way that is not possible; inputs that are not n finite numbers; no box of poses to search.
        UnknownNameError: a way that there is not.
        MechanismFileError: the closed form does not agree with the joint graph.

    Example: the four poses of Table 1 of Zeng et al. 2019, and an input beside which none is proved.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> certified_direct(record, [162.6907, -143.3209, -24.6776]).headline
    'proved, 4 solutions and no other'
    >>> certified_direct(record, [70.0, -70.0, 0.0]).undecided[0].name
    'B'
    """
    given = _one(border.checked(inputs, border.input_names(record), f"inputs of {record.name}"))
    _check_way(way)
    if way == "joint graph" or (way == "auto" and record.closed_form is None):
        return certified_assemblies(record, "direct", given, _method(record))
    kernel = checked_form(record).direct
    if way == "boxes" or (way == "auto" and kernel is None):
        return direct_by_boxes(record, given)
    if kernel is None:
        raise UsageError(f"{record.name} has no closed form of the direct problem", hint="leave the method out")
    if isinstance(kernel, Eliminant):
        return direct_by_roots(record, kernel, given)
    if isinstance(kernel, PolynomialSystem):
        return direct_by_system(record, kernel, given)
    return direct_by_signs(record, given)


def certified_inverse(record: MechanismRecord, pose: ArrayLike, way: Way = "auto") -> CertifiedSolutions:
    """All inputs at a pose (m,), in lengths and rad, each proved, and proved to be all; or where that is undecided.

    Args:
        record: the mechanism.
        pose: lengths and angles count as those of `certified_direct` do.
        way: as for `certified_direct`; "boxes" there are none.

    Errors:
        UsageError: a way that is not possible; a pose that is not m finite numbers.

    Example: the eight of Table 2 of Zeng et al. 2019.

    >>> from assur.model.registry import load_record
    >>> found = certified_inverse(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315])
    >>> found.headline, bool(found.solutions[0].width < 1e-11)
    ('proved, 8 solutions and no other', True)
    """
    given = _one(border.checked_poses(record, pose))
    _check_way(way)
    if way == "boxes":
        raise UsageError("only the direct problem is searched box by box", hint="leave the method out")
    if way == "joint graph" or (way == "auto" and record.closed_form is None):
        return certified_assemblies(record, "inverse", given, _method(record))
    checked_form(record)
    return inverse_by_signs(record, given)


def _check_way(way: str) -> None:
    if way not in get_args(Way):
        raise UnknownNameError("way to certify", way, get_args(Way))


def _method(record: MechanismRecord) -> Method:
    """How assemblies are found in floats: loops in turn where the closed form is not wanted."""
    return "auto" if record.closed_form is None else "loops"


def _one(given: border.FloatArray) -> border.FloatArray:
    if given.ndim != 1:
        raise UsageError(f"a certificate is about one problem; found a batch of shape {given.shape[:-1]}")
    return given

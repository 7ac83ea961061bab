"""`Mechanism`: a record with its analyses as methods, each one line to the function that does the work.

An analysis is imported where it is called, but for the position problem: a command loads what it prints and no more.
What draws and writes stands above this module, and is looked up by its name when it is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from numpy.typing import ArrayLike

from assur.errors import called
from assur.kinematics.border import Named
from assur.kinematics.contract.admission import admitted_record, check_closed_form
from assur.machine.mechanics import Mechanics
from assur.model import registry
from assur.model.mechanism import MechanismRecord
from assur.model.pose import kind_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from assur.performance.indices import Indices
    from assur.performance.scaling import Length
    from assur.singularity.verdict import Verdict
    from assur.topology.analysis import Mode
    from assur.topology.facts import Topology
    from assur.workspace.aspects.aspects import Aspects
    from assur.workspace.region import Workspace


class Mechanism(Mechanics):
    """A mechanism, from `assur.load`. Poses are (..., m), inputs (..., n), lengths in its unit, angles in rad.

    Values of joints, inputs and poses may be given by name as well, as `Solution.joints` has them.
    """

    def with_parameters(self, /, **values: float) -> Self:
        """The same mechanism with other dimensions, checked as those of the file are.

        Lengths in its unit, angles as the file has them. Errors: UnknownNameError, with the nearest name; UsageError
        for a value that the parameter may not have; MechanismFileError where a closed form does not agree with it.

        >>> longer = load("zeng2019").with_parameters(l2=300)
        >>> longer.values.l2, load("zeng2019").values.l2
        (300.0, 280.0)
        """
        from assur.model.dimensions import with_parameters  # which reads the file again

        changed = with_parameters(self, **values)
        check_closed_form(changed)
        return changed

    def singularity(self, pose: ArrayLike, mode: str | None = None) -> Verdict:
        """The verdict on one pose (m,), in its unit and rad: `assur.singularity.verdict`.

        In a working mode, the file's default without one. `kind` is a status by name, the most severe of what the
        factors of det Jp and det Jq say and of what the rank of the joint graph says.

        >>> mechanism, pose = load("zeng2019"), [-15.4714, 9.6849, 456.3315]
        >>> mechanism.singularity(pose, "++-++").kind, mechanism.singularity(pose, "+++++").kind
        ('regular', 'self_motion')
        """
        from assur.singularity.verdict import verdict

        return verdict(self, pose, mode)

    def singularity_at(self, joint_values: Named) -> Verdict:
        """The verdict on one configuration of the joint graph, joint values (c,) or by name.

        >>> fivebar = load("fivebar")
        >>> verdict = fivebar.singularity_at(fivebar.home_values)
        >>> verdict.kind, verdict.freedoms
        ('regular', 2)
        """
        from assur.singularity.verdict import verdict_at

        return verdict_at(self, joint_values)

    def workspace(self, mode: str | None = None, **options: Any) -> Workspace:
        """The workspace of a working mode in a box, with the error of its volume: `assur.workspace.region.workspace`.

        Options (`box`, `strokes`, `resolution`, `sections`, ...) and errors are as there; lengths in its unit, angles
        in rad. A region that is empty has the volume 0.

        The rods of 194 mm carry the paper's point through 45629.17 mm2, for 500 mm along Y:

        >>> region = load("zeng2019").workspace(resolution=32)
        >>> abs(region.volume - 500 * 45629.17) < region.volume_error < 0.001 * region.volume
        True
        """
        from assur.workspace.region import workspace

        return called(workspace, self, mode, **options)

    def aspects(self, mode: str | None = None, **options: Any) -> Aspects:
        """The aspects of a working mode: parts of its workspace without a parallel singularity, proved.

        Options and errors are those of `assur.workspace.aspects.aspects.aspects`; it needs a closed form.

        >>> [aspect.label for aspect in load("fivebar").aspects("-+").aspects]
        ['+']
        """
        from assur.workspace.aspects.aspects import aspects

        return called(aspects, self, mode, **options)

    def indices(self, poses: ArrayLike, mode: str | None = None, characteristic_length: Length = None) -> Indices:
        """Condition, manipulability, transmission (...) at poses (..., m), by name: `assur.performance.indices`.

        In a working mode, the file's default without one. The characteristic length is in the mechanism's unit, or
        "isotropic". Errors: UsageError for a length that is none, poses of a wrong shape.

        >>> indices = load("orthoglide").indices([[0.0, 0.0, 0.0], [73.2050807568877] * 3])
        >>> indices["condition"].round(6).tolist()  # isotropic at the origin; velocity factors 2 and 4/5 at a corner
        [1.0, 0.4]
        """
        from assur.performance.indices import indices

        return indices(self, poses, mode, characteristic_length)

    def topology(self, actuate: Sequence[str] | None = None, mode: Mode | None = None) -> Topology:
        """POC set, degrees of freedom, coupling degree and what follows from them, Eqs. (1) to (6): `assur.topology`.

        Args:
            actuate: actuated joints as "limb.joint", from 1; its inputs without.
            mode: "home", "translation" or the name of an operation mode.

        Errors: UsageError for inputs that there are not; RoutesDisagreeError where rules and twists differ.

        >>> topology = load("zeng2019").topology()
        >>> str(topology.poc), topology.dof, topology.xi, topology.coupling_degree
        ('t³ r⁰', 3, (3, 5), 1)
        """
        from assur.derived_topology import topology

        return topology(self, actuate=actuate, mode=mode)

    def plot(self, figure: str = "solid", *, width: str = "") -> Figure:
        """A figure of `assur figures` as matplotlib's, at the width of a page; see `assur.figures.catalogue`.

        >>> (25.4 * load("fivebar").plot("flow", width="ieee").get_size_inches()).round().tolist()
        [44.0, 91.0]
        """
        page = import_module("assur.figures.page").page_width(width)
        context = import_module("assur.figures.context").Context(self, page=page)
        drawn: Figure = import_module("assur.figures.catalogue").draw(self, figure, context)
        return drawn

    def page(self, path: str | Path) -> Path:
        """Write the page in which the mechanism can be moved, one HTML file, and return its path.

        >>> import tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     load("fivebar").page(Path(folder) / "fivebar.html").name
        'fivebar.html'
        """
        from assur.results.files import file_to_write, write_whole

        target, pages = file_to_write(path), import_module("assur.page")
        return write_whole(target, pages.page_html(pages.scene(self)))

    def report(self, path: str | Path, *, figures: bool = True) -> Path:
        """Write everything about the mechanism as one HTML file and return its path.

        Errors: OutputError for a path that cannot be written; what was there before is kept.

        >>> load("fivebar").report("no_such_folder/fivebar.html")
        Traceback (most recent call last):
        ...
        assur.errors.OutputError: cannot write no_such_folder/fivebar.html: the folder no_such_folder does not exist
        hint: mkdir -p no_such_folder
        """
        import_module("assur.report.report").write_report(self, path, figures=figures)
        return Path(path)

    if not TYPE_CHECKING:  # a type checker knows what there is

        def __getattr__(self, name: str) -> Any:
            """Of what there is not, the names that are near: notebooks show no suggestions of Python's own."""
            near = [] if name.startswith("_") else get_close_matches(name, [*dir(type(self)), *vars(self)])
            hint = f"; did you mean {' or '.join(near)}?" if near else ""
            raise AttributeError(f"a mechanism has no attribute {name!r}{hint}")

    def __str__(self) -> str:
        """Its inputs, pose and dimensions as a table."""
        from assur.results.notebook import text_table

        return text_table(f"{self.name}: {self.title}", *self._table())

    def _repr_html_(self) -> str:
        """The same for a notebook, with its structure as a picture."""
        from assur.results.notebook import html_table, pictured

        return html_table(f"{self.name}: {self.title}", *self._table(), pictured(self.plot("structure")))

    def _table(self) -> tuple[tuple[str, ...], list[tuple[object, ...]]]:
        """Columns and rows of what is given and asked of it."""
        units = {"length": self.unit, "angle": self.angle}
        driven = {item.name: item.coordinate for item in self.inputs}
        rows: list[tuple[object, ...]] = [
            ("input", name, "", units[at.kind], f"{at.kind} of joint {at.joint}") for name, at in driven.items()
        ]
        rows += [("pose", name, "", units.get(kind_of(name), ""), "") for name in self.platform.pose]
        rows += [
            ("dimension", name, f"{item.value:g}", "" if item.unit == "1" else item.unit, item.meaning)
            for name, item in self.parameters.items()
        ]
        return ("what", "name", "value", "unit", "meaning"), rows


def load(name: str | Path, /, **parameters: Any) -> Mechanism:
    """A built-in mechanism by name, or one from a file, with some of its parameters changed.

    A closed form beside a file of one's own is held against the joint graph first (`assur.kinematics.contract`): where
    it does not agree, that is a `MechanismFileError`.

    >>> load("zeng2019", l2=300).parameters["l2"].value
    300.0
    """
    return _of_record(admitted_record(name, **parameters))


@lru_cache(maxsize=64)
def _of_record(record: MechanismRecord) -> Mechanism:
    return Mechanism(**vars(record))


def names() -> tuple[str, ...]:
    """Names of the built-in mechanisms."""
    return registry.names()

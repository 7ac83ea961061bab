"""assur: from the topology of a parallel mechanism to its numbers, each with its proof.

>>> import assur
>>> mechanism = assur.load("zeng2019")
>>> len(mechanism.direct([162.6907, -143.3209, -24.6776]))
4

Names are looked up where they live when they are first used, so that `assur --help` need not load NumPy.
"""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

from assur.version import VERSION

if TYPE_CHECKING:
    from assur.derivation.derivation import derive
    from assur.errors import AssurError, MechanismFileError, UnknownNameError, UsageError
    from assur.mechanism import Mechanism, load, names

__version__ = VERSION
__all__ = [
    "AssurError",
    "Mechanism",
    "MechanismFileError",
    "UnknownNameError",
    "UsageError",
    "derive",
    "load",
    "names",
]

_HOMES = {name: "assur.errors" if name.endswith("Error") else "assur.mechanism" for name in __all__}
_HOMES["derive"] = "assur.derivation.derivation"

if not TYPE_CHECKING:  # so that a type checker still refuses an unknown name

    def __getattr__(name: str) -> object:
        """A public name, from the module where it lives (PEP 562)."""
        if name not in _HOMES:
            raise AttributeError(f"module 'assur' has no attribute '{name}'")
        value = getattr(import_module(_HOMES[name]), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    """Names that tab completion offers: what is public, with the function and package `topology`."""
    return sorted({*__all__, "topology", "__version__", "__doc__", "__all__"})


class _CallablePackage(ModuleType):
    """The package `assur.topology`, which is also the function: `assur.topology("zeng2019")`."""

    def __call__(self, *what: Any, **options: Any) -> Any:
        return import_module("assur.derived_topology").topology(*what, **options)


import_module("assur.topology").__class__ = _CallablePackage

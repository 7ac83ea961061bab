"""Topologies by name: mechanisms without dimensions, built in or from a file."""

from __future__ import annotations

from pathlib import Path

from assur.model.file.description import description_text
from assur.model.file.kind import is_topology
from assur.model.file.toml_source import read_toml
from assur.model.file.topology_file import read_topology
from assur.model.registry import FILE, TOPOLOGY, file_of
from assur.model.topology_description import TopologyDescription


def means_topology(name_or_path: str | Path, /) -> bool:
    """Whether a name or a file means a topology, by what stands in the file; else it means a mechanism.

    Errors:
        UnknownNameError: neither a mechanism nor a topology has that name.
        UsageError, MechanismFileError: as `load_record`.

    >>> means_topology("tripteron"), means_topology("zeng2019")
    (True, False)
    """
    path = file_of(name_or_path, (TOPOLOGY, FILE))
    return is_topology(read_toml(description_text(path), str(path)).data)


def load_topology(name_or_path: str | Path, /) -> TopologyDescription:
    """A built-in topology, or that of a file.

    Args:
        name_or_path: a name, or the path of a `.toml` file or of a folder with a `topology.toml`.

    Errors:
        UnknownNameError: neither a topology nor a mechanism has that name.
        UsageError: a file that cannot be read, or that of a mechanism, which has a joint graph instead.
        MechanismFileError: the file has faults.

    Example:
        >>> [chain.text for chain in load_topology("tripteron").chains]
        ['P[x] R[x] R[x] R[x]', 'P[y] R[y] R[y] R[y]', 'P[z] R[z] R[z] R[z]']
    """
    return read_topology(file_of(name_or_path, (TOPOLOGY, FILE)))

"""A mechanism whose joints and links stand in another order, which must decide nothing."""

from dataclasses import replace

import numpy as np

from assur.model.mechanism import MechanismRecord


def reordered(record: MechanismRecord, seed: int) -> MechanismRecord:
    """The same with joints and links in an order by chance; joint values follow the joints, inputs stay."""
    rng = np.random.default_rng(seed)
    joints = [str(name) for name in rng.permutation(list(record.joints))]
    links = [str(name) for name in rng.permutation(list(record.links))]
    listed = sorted(record.coordinates, key=lambda own: (joints.index(own.joint), own.index))
    moved = {item.index: replace(item, index=place) for place, item in enumerate(listed)}
    return replace(
        record,
        links={name: record.links[name] for name in links},
        joints={name: record.joints[name] for name in joints},
        inputs=tuple(replace(item, coordinate=moved[item.coordinate.index]) for item in record.inputs),
        coordinates=tuple(moved[item.index] for item in listed),
        angles={name: moved[item.index] for name, item in record.angles.items()},
        home=np.array([record.home[item.index] for item in listed]),
    )

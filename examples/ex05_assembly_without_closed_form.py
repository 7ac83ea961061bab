"""The joint graph alone: assemble it from random starts, inputs held, and find what the paper's model leaves out."""

import numpy as np

import assur
from assur.kinematics.closure import assemble

mechanism = assur.load("zeng2019")
rng = np.random.default_rng(0)
starts = rng.uniform(-3, 3, size=(400, len(mechanism.coordinates)))
starts[:, mechanism.input_indices] = [162.6907, -143.3209, -24.6776]

found = assemble(mechanism, starts, held=mechanism.input_indices, max_steps=200)
rotation, position = mechanism.frames(found.values[found.closed])[mechanism.platform.link]
straight = np.abs(rotation - np.eye(3)).max(axis=(-1, -2)) < 1e-6
print(len(np.unique(position.round(3), axis=0)), "assemblies, of them")
print(len(np.unique(position[straight].round(3), axis=0)), "keep the platform parallel to the base")

"""One call for a batch of any shape: which of the poses on a grid does a working mode reach?"""

import numpy as np

import assur

mechanism = assur.load("zeng2019")
x, z = np.meshgrid(np.linspace(-130, 80, 211), np.linspace(-500, 560, 531), indexing="ij")
poses = np.stack([x, np.zeros_like(x), z], axis=-1)  # (211, 531, 3)

found = mechanism.inverse(poses, mode="++-++")
reached = found.exists[..., 0]  # (211, 531)
print(f"{reached.mean():.1%} of {reached.size} poses are reached")
print(f"z from {z[reached].min():.0f} to {z[reached].max():.0f} {mechanism.unit}")
assert found.residuals[found.exists].max() < 1e-9

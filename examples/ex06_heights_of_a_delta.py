"""Heights that a gauge reads over two plates, of a Delta whose arms are longer than its file says, and what they tell.

`delta_heights.csv` is this table; `assur calibrate delta_4s examples/delta_heights.csv` reads it.
"""

from pathlib import Path

import numpy as np

import assur
from assur.machine.calibration.fit import calibration
from assur.machine.calibration.measured import measured_of

TABLE = Path(__file__).with_name("delta_heights.csv")
places = [(x, y) for x in (-0.3, 0.0, 0.3) for y in (-0.3, 0.0, 0.3)]
poses = np.array([(x, y, z) for z in (-0.9, -1.15) for x, y in places])

longer = assur.load("delta_4s", L=0.5244)  # arms longer by 0.4 mm; the first motor stands 0.05 deg beside its reading
inputs = np.degrees(longer.inverse(poses, "+++").inputs[:, 0]) - [0.05, 0.0, 0.0]
heights = poses[:, 2] + 2e-5 * np.random.default_rng(1).normal(size=18)
heights[12] += 0.0005  # a chip lay under the gauge
lines = [f"{a:.4f},{b:.4f},{c:.4f},{height:.6f}" for (a, b, c), height in zip(inputs, heights, strict=True)]
text = "\n".join(["theta1,theta2,theta3,z", *lines, ""])
if not TABLE.exists():
    TABLE.write_text(text, encoding="utf-8")
assert TABLE.read_text(encoding="utf-8") == text, "the table is not the one that is made here"

delta = assur.load("delta_4s")
rows = np.loadtxt(TABLE, delimiter=",", skiprows=1)
own = calibration(delta, np.radians(rows[:, :3]), measured_of(delta, ["z"]), rows[:, 3:])
print(f"arms {1e3 * own.parameters['L']:.2f} mm, to be added to theta1 {np.degrees(own.parameters['theta1']):.3f} deg")
print(f"left out: measurement {own.outliers[0]}; {1e3 * own.before:.3f} mm before, {1e3 * own.after:.3f} mm after")
assert own.outliers == (13,)
assert abs(own.parameters["L"] - 0.5244) < 4 * own.sigma["L"]
assert abs(own.parameters["theta1"] - np.radians(0.05)) < 4 * own.sigma["theta1"]

"""Every pose at given inputs, every input at a pose, and how far each is from closing the joint graph."""

import assur

mechanism = assur.load("zeng2019")

for solution in mechanism.direct([162.6907, -143.3209, -24.6776]):
    print(solution.mode, solution.pose.round(4), f"residual {solution.residual:.1e} {mechanism.unit}")

for solution in mechanism.inverse([-15.4714, 9.6849, 456.3315]):
    print(solution.mode, solution.inputs.round(4), solution.status.name)

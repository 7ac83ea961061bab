"""Change dimensions: the joint graph, home and every answer follow; what cannot be is refused."""

import assur

mechanism = assur.load("zeng2019")
longer = mechanism.with_parameters(l2=300, l7=12, l8=8)
print("home closes to", f"{longer.closure_error(longer.home_values):.1e}", longer.unit)
print(len(longer.direct([162.6907, -143.3209, -24.6776])), "direct solutions")

try:
    mechanism.with_parameters(l2=-1)
except assur.UsageError as error:
    print(error)

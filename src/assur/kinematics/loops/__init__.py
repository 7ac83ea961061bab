"""Direct and inverse problems loop by loop: every assembly, where the loops are systems of circles."""

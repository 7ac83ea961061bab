"""Topology: what a mechanism can do, from the joints of its limbs and the directions of their axes.

Chains (`chains`, read and printed by `notation`) give POC sets (`poc`) by two routes, `rules` and `linkages`. `routes`
and `agreement` bring them together, `counting` does the rest, and `analysis` makes of it the `facts`.
"""

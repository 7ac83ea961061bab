"""A configuration for each factor of the determinants, with its geometric meaning and the rank of the joint graph."""

import assur
from assur.singularity.examples import singular_examples

mechanism = assur.load("zeng2019")
for example in singular_examples(mechanism):
    verdict = mechanism.singularity(example.pose, example.mode)
    print(f"{example.factor.name:22} {verdict.kind:12} rank {verdict.rank}  {example.factor.meaning}")
    assert abs(verdict.relative[example.factor.name]) < 1e-6

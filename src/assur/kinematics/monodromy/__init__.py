"""All assemblies by complex inputs: those that are known are followed round loops until no other comes back."""

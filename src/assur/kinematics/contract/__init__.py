"""The contract between a closed form and its joint graph: what a kernel claims, held against the loops themselves."""

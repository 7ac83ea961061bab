"""The notation of chains: text to chains, in the plain form or the literature's, and chains to text."""

from assur.topology.notation.errors import NotationError
from assur.topology.notation.literature import symbolic_text
from assur.topology.notation.parse import parse_chain, parse_chains
from assur.topology.notation.plain import plain_text

__all__ = ["NotationError", "parse_chain", "parse_chains", "plain_text", "symbolic_text"]

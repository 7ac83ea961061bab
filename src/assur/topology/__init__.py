"""The theory's first words: joints, and later chains, POC sets, mobility, coupling degree."""

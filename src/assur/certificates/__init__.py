"""Certificates: statements about workspaces as files, with a proof that the separate verifier checks leaf by leaf."""

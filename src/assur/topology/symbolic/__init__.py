"""The first route: POC sets by the symbolic rules of the theory, with the reason for every step."""

"""What follows from ranks and POC sets: mobility, Assur chains, coupling degree, inputs, decoupling, the plan."""

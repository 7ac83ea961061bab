"""How joints and links move where the platform moves as given: rates, accelerations, and the inertia that resists."""

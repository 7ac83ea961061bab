"""How errors of dimensions and inputs move the platform, and where it certainly is within its tolerances."""

"""Direct problems that are known systems: what limbs leave of the platform is said by points and distances."""

"""What limbs hold the platform to: quadrics in soma coordinates, and all poses that lie on them."""

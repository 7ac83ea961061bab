"""What measured poses tell of the dimensions, and the dimensions that they tell."""

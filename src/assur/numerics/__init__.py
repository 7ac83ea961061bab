"""Numbers and their algebra, without a word of the field: number types, rotations, least squares."""

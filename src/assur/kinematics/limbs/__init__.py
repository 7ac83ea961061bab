"""The inverse problem limb by limb: with the platform held, each limb closes alone."""

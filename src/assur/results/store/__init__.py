"""Stores: arrays in files, written block by block, whole after a kill at any instant, checked when they are read."""

"""Figures: drawn from the joint graph and from the analyses, each also as data.

In `assur.figures.catalogue`, `catalogue(record)` lists them, `draw(record, name)` makes one, `write(record, folder)`
makes files.
"""

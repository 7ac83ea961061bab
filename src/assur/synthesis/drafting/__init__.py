"""Drafting: a new mechanism's file, copied from the catalogue or drawn from chains in notation."""

"""Workspaces: region = domain x criterion x method; volume, sections, projections, what is singular inside."""

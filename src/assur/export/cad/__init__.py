"""Prototype files: STEP for CAD, STL for printers, GLB for viewers and slides, and the bill of materials."""

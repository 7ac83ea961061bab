"""The mechanism as a body in space: its skeleton, and every link as named solids in the link's own frame.

Figures, pages, the live view and CAD files all draw this one scene.
"""

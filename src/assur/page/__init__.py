"""One offline HTML file in which the mechanism moves: no server, no network."""

from assur.page.page import LARGEST, page, page_html, scene

__all__ = ["LARGEST", "page", "page_html", "scene"]

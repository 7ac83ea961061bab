"""The site: Sphinx reads these pages and writes build/site. `make docs` builds it; nothing comes from a network."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "extensions"))

project = "assur"
version = release = __import__("assur").__version__
author = "the authors of assur"

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "docstrings", "formulas", "made"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["extensions"]
templates_path = ["_templates"]
highlight_language = "text"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
autodoc_type_aliases = {name: name for name in ("ArrayLike", "Method", "Length", "Mode")}
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 100
toc_object_entries = False
napoleon_numpy_docstring = False
napoleon_custom_sections = ["Errors"]
napoleon_use_rtype = False
napoleon_use_ivar = True

html_theme = "alabaster"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_title = "assur"
html_copy_source = html_show_sourcelink = False
html_show_copyright = html_show_sphinx = False
html_sidebars = {"**": ["about.html", "searchfield.html", "navigation.html"]}
html_theme_options = {
    "description": "From the topology of a parallel mechanism to its numbers, each with its proof.",
    "page_width": "1120px",
    "sidebar_width": "230px",
    "fixed_sidebar": True,
    "show_powered_by": False,
    "show_related": False,
    "sidebar_collapse": True,
    "font_family": "system-ui, 'Helvetica Neue', Helvetica, Arial, sans-serif",
    "head_font_family": "system-ui, 'Helvetica Neue', Helvetica, Arial, sans-serif",
    "code_font_family": "'DejaVu Sans Mono', Menlo, Consolas, monospace",
}

r"""A figure in LaTeX: what puts it into a paper, with its caption and a label."""

from __future__ import annotations

from matplotlib.figure import Figure

from assur.figures.spec import FigureSpec
from assur.figures.style import MILLIMETRE
from assur.results.latex_text import prose

COLUMN = 92.0
"""A figure that is wider, in mm, spans both columns of a page that has two."""


def snippet(mechanism: str, spec: FigureSpec, figure: Figure) -> str:
    r"""LaTeX that includes a figure at the size at which it is drawn; it needs graphicx and amsmath.

    >>> from assur.figures.style import new_figure
    >>> print(snippet("fivebar", FigureSpec("solid", "", "3-D model", "At 30°."), new_figure(80, 60)))
    \begin{figure}[htbp]
      \centering
      \includegraphics[width=80.0mm]{solid}
      \caption{3-D model. At 30$^\circ $.}
      \label{fig:fivebar-solid}
    \end{figure}
    <BLANKLINE>
    """
    width = float(figure.get_size_inches()[0]) / MILLIMETRE
    environment = "figure*" if width > COLUMN else "figure"
    return (
        f"\\begin{{{environment}}}[htbp]\n  \\centering\n  \\includegraphics[width={width:.1f}mm]{{{spec.name}}}\n"
        f"  \\caption{{{prose(f'{spec.title}. {spec.caption}')}}}\n  \\label{{fig:{mechanism}-{spec.name}}}\n"
        f"\\end{{{environment}}}\n"
    )

"""Notebooks: run cell by cell without Jupyter, and shown as a page with the outputs that are stored in them.

`python docs/extensions/notebook.py NOTEBOOK` runs one and stores its outputs anew; a test compares them.
"""

from __future__ import annotations

import ast
import base64
import contextlib
import io
import json
import sys
from pathlib import Path
from types import ModuleType
from typing import Any
from unittest.mock import patch

Output = dict[str, Any]


class Image:
    """What stands in for IPython's picture while a notebook is run."""

    def __init__(self, data: bytes) -> None:
        self.data = data


def run(notebook: dict[str, Any]) -> list[list[Output]]:
    """Outputs of each code cell, all run in order in one namespace, in the form in which notebooks store them."""
    shell, display = ModuleType("IPython"), ModuleType("IPython.display")
    vars(shell)["version_info"], vars(display)["Image"] = (9, 0), Image  # matplotlib asks a shell for its version
    names: dict[str, Any] = {"__name__": "__main__"}
    with patch.dict(sys.modules, {"IPython": shell, "IPython.display": display}):
        return [_outputs("".join(cell["source"]), names, count) for count, cell in enumerate(code(notebook), 1)]


def code(notebook: dict[str, Any]) -> list[dict[str, Any]]:
    """The cells that are code."""
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def _outputs(source: str, names: dict[str, Any], count: int) -> list[Output]:
    """What a cell prints, then the value of its last line if that is an expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed, value = io.StringIO(), None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "<cell>", "exec"), names)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names)  # noqa: S307 - our own notebook
    found: list[Output] = []
    if text := printed.getvalue():
        found.append({"name": "stdout", "output_type": "stream", "text": text.splitlines(True)})
    if value is not None:
        data = {"execution_count": count, "metadata": {}, "output_type": "execute_result"}
        found.append({"data": _data(value), **data})
    return found


def _data(value: Any) -> dict[str, Any]:
    if isinstance(value, Image):
        picture = base64.b64encode(value.data).decode()
        return {"image/png": picture, "text/plain": ["<IPython.core.display.Image object>"]}
    if hasattr(value, "_repr_html_"):
        return {"text/html": value._repr_html_(), "text/plain": str(value).splitlines(True)}
    return {"text/plain": repr(value).splitlines(True)}


def markdown(root: Path, path: str) -> str:
    """The cells of the notebook at a path from the root of the checkout."""
    return "\n\n".join(_cell(cell) for cell in read(root / path)["cells"])


def read(path: Path) -> dict[str, Any]:
    """The notebook in a file."""
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


def _cell(cell: dict[str, Any]) -> str:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        return source
    return "\n\n".join([f"```python\n{source}\n```", *(_shown(output) for output in cell["outputs"])])


def _shown(output: Output) -> str:
    data = output.get("data", {})
    if "image/png" in data:
        return f"![What the cell shows](data:image/png;base64,{data['image/png']})"
    if "text/html" in data:
        return "".join(data["text/html"])
    text = "".join(output.get("text", data.get("text/plain", ""))).rstrip("\n")
    return f"```text\n{text}\n```"


def store(path: Path) -> None:
    """Run the notebook in a file and write it with what comes out."""
    notebook = read(path)
    for count, (cell, outputs) in enumerate(zip(code(notebook), run(notebook), strict=True), 1):
        cell["outputs"], cell["execution_count"] = outputs, count
    path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        store(Path(name))

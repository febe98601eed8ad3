"""The gallery: each program of examples/gallery is run, and shown with the picture that it makes."""

from __future__ import annotations

import ast
import runpy
from pathlib import Path

PROGRAMS = sorted((Path(__file__).parents[2] / "examples" / "gallery").glob("*.py"))


def write_gallery(place: Path) -> None:
    """Run the programs, and write their pictures and the page into a directory."""
    pieces = ["# Gallery", "", "Every picture is made by the program below it when these pages are built.", ""]
    for program in PROGRAMS:
        text = program.read_text(encoding="utf-8")
        tree = ast.parse(text)
        title, _, description = (ast.get_docstring(tree) or "").partition("\n")
        picture = f"gallery-{program.stem}.png"
        figure = runpy.run_path(str(program))["picture"]()
        figure.savefig(place / picture, dpi=110)
        code = "\n".join(text.splitlines()[tree.body[0].end_lineno or 0 :]).strip()
        pieces += [
            f"## {title.rstrip('.')}",
            "",
            " ".join(description.split()),
            "",
            f"![{title.rstrip('.')}]({picture})",
            "",
        ]
        pieces += [f"`examples/gallery/{program.name}`", "", "```python", code, "```", ""]
    (place / "gallery.md").write_text("\n".join(pieces), encoding="utf-8")

"""``python -m validation.book FOLDER [NAME...]`` makes the book, or the pages of some cases and the matrix."""

from __future__ import annotations

import sys
import time
from pathlib import Path

from heeltoe.views.figures.histories import response_figure
from heeltoe.views.figures.write import save
from validation.book import pages, store
from validation.cases import CASES, run_case, wanted
from validation.row import Skipped


def make(folder: Path, names: list[str]) -> None:
    """Compute cases again, and write their pages and the matrix; what cannot be computed here stays as it is."""
    folder.mkdir(parents=True, exist_ok=True)
    book = store.read(folder)
    for name in names:
        start = time.perf_counter()
        try:
            rows = run_case(name)
        except Skipped as reason:
            sys.stdout.write(f"{name}: as it was; {reason}\n")
            continue
        if chart := CASES[name].chart:
            save(chart.draw(rows), folder / f"{pages.file_of(name)}.png", dpi=90)
        if history := CASES[name].history:
            save(response_figure(history()), folder / f"{pages.file_of(name)}-history.png", dpi=90)
        book[name] = [store.row_texts(row) for row in rows]
        sys.stdout.write(f"{name}: {len(rows)} rows, {time.perf_counter() - start:.0f} s\n")
        sys.stdout.flush()
    write(folder, {name: book[name] for name in CASES if name in book})


def write(folder: Path, book: dict[str, store.Rows]) -> None:
    """Write all pages."""
    store.write(folder, book)
    for name, rows in book.items():
        (folder / f"{pages.file_of(name)}.md").write_text(pages.page(name, rows), encoding="utf-8")
    (folder / "index.md").write_text(pages.index(book), encoding="utf-8")


if __name__ == "__main__":
    place, *names = sys.argv[1:]
    make(Path(place), wanted(names) or list(CASES))

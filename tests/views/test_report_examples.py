"""Reports of the examples, whole: their pages are full and in order."""

from __future__ import annotations

import io

import pytest

import heeltoe
from heeltoe import decoupled, flexible, read_case, rigid
from heeltoe.views.report.typst_pdf import pages
from heeltoe.views.report.write import build_report, write_report
from shared.dams import BASE, FAST, ROOT, example
from shared.report_reader import check_numbers


@pytest.fixture(scope="module")
def document(typical_both):
    """The report of both."""
    return build_report(read_case(BASE, FAST), typical_both)


EXAMPLES = [("typical-base", rigid), ("typical-base", flexible), ("typical-height", flexible), ("triangular", flexible)]
EXAMPLES += [("koyna", decoupled), ("anchored", rigid), ("slender", rigid), ("typical-base", heeltoe.run)]


@pytest.mark.product
@pytest.mark.parametrize(("name", "run"), EXAMPLES)
def test_reports_of_the_examples_at_full_length(name, run, tmp_path):
    case = example(name)
    result = run(case)
    check_numbers(build_report(case, result), result)
    write_report(case, result, directory := ROOT / "out" / "reports" / f"{name}-{run.__name__}")
    for number, data in enumerate(pages(build_report(case, result)), start=1):
        (directory / f"page-{number}.png").write_bytes(data)


# Those of the typical dam are written by other tests.
@pytest.mark.slow
@pytest.mark.parametrize(("name", "run"), [("typical-height", flexible), ("koyna", decoupled), ("anchored", rigid)])
def test_reports_of_the_examples(name, run, tmp_path):
    case = example(name, *FAST)
    for path in write_report(case, run(case), tmp_path):
        assert path.stat().st_size > 100_000


def pages_of(document):
    """The room for text and figures of every page of a PDF, as shades of grey."""
    import numpy as np
    from PIL import Image

    for data in pages(document, 30.0):
        page = np.asarray(Image.open(io.BytesIO(data)).convert("L")).astype(int)
        one = len(page) / 297.0
        yield page[int(20 * one) : int(275 * one) - 2]


@pytest.mark.slow
def test_pages_are_full(document):
    import numpy as np

    blank = []
    for page in pages_of(document):
        inked = np.flatnonzero((page < 250).any(axis=1))
        # Bands of less than 10 mm part what belongs apart.
        bands = np.diff(inked) - 1
        inner = bands[bands > 10.0 * len(page) / 255.0].sum()
        blank.append(1.0 - (inked[-1] + 1 - inner) / len(page))
    # The last page ends where the report does; a figure or a table that is kept whole, up to a third of
    # a page, may need the next one.
    assert np.mean(blank[:-1]) < 0.12
    assert max(blank[:-1]) < 1.0 / 3.0

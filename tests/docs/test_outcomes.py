"""The page of outcomes and the docstring have the rows of the table."""

from heeltoe.result.outcome import Outcome
from shared.dams import ROOT


def test_the_page_has_every_outcome_as_the_table_has_it():
    page = (ROOT / "docs" / "outcomes.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in page.splitlines() if "| `" in line]
    yes = {True: "yes", False: "no"}
    assert rows == [
        [f"`{end}`", end.sentence, yes[end.has_result], yes[end.failed], str(end.exit_code), end.remedy or "-"]
        for end in Outcome
    ]


def test_the_docstring_has_them_in_the_order_of_precedence():
    lines = (Outcome.__doc__ or "").splitlines()
    table = [line.strip() for line in lines if "  yes " in line or " no  " in line]
    assert [row[:14].strip() for row in table] == [*map(str, Outcome)]
    assert [(row[15:18].strip(), row[22:25].strip()) for row in table] == [
        ("yes" if end.has_result else "no", "yes" if end.failed else "no") for end in Outcome
    ]

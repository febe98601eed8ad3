"""The options of ``heeltoe run``, as they were typed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from heeltoe.cli.common import check_units, check_written, refuse
from heeltoe.errors.error import InputError

if TYPE_CHECKING:
    from heeltoe.case.model import Case


@dataclass(frozen=True)
class RunOptions:
    """Options of a command beside the case, as typed."""

    model: str
    spread: str | None
    json: str | None
    out: Path | None
    units: str | None
    csv: bool
    vtk: bool
    vary: list[str] | None
    report: bool
    details: bool
    xlsx: bool

    @property
    def suffix(self) -> str:
        """Units of tables."""
        return ".csv" if self.csv else ".parquet"

    def check(self) -> None:
        """Refuse what cannot be, or does not go together, before anything is read."""
        from heeltoe.models.run import check_model

        check_model(self.model, "--model")
        check_units(self.units)
        check_written(self.out, report=self.report, xlsx=self.xlsx, others={})
        if self.vtk and self.out is None and not self.report:
            raise InputError("needs-other", "--vtk", other="--out DIR")
        if self.vary:
            refuse(
                {"--vtk": self.vtk, "--spread": self.spread is not None, "--report": self.report},
                "a table of runs",
                " or --vary",
            )

    def check_elastic(self, case: Case) -> None:
        """Refuse what shows elastic parts where there are none."""
        from heeltoe.models.run import models_of

        if self.vtk and "flexible" not in models_of(case, self.model)[0]:
            raise InputError(
                "option-foreign",
                "--vtk",
                owner="a rigid block, which has no elastic parts",
                remedy=", or use --model flexible or both",
            )

    def runs(self) -> int | Literal["cheap"] | None:
        """Return the requested number of runs with the shaking varied; a report has the cheap ones by default."""
        if self.spread is None:
            return "cheap" if self.report else None
        if self.spread == "none":
            return None
        from heeltoe.study.small.spread import RUNS, check_runs

        return check_runs(self.spread or RUNS, "--spread")

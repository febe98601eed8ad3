"""A suite of records on the command line: ``heeltoe run CASE`` of a case with `[[motions]]`, or with ``--motions``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from heeltoe.cli.common import LONGEST_PATH, as_given, check_json, units_of
from heeltoe.cli.many import Output, run_many
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain

if TYPE_CHECKING:
    from heeltoe.case.model import Case
    from heeltoe.cli.run import Asked


@dataclass(frozen=True)
class Suite:
    """The options of a suite, as they were typed."""

    motions: Sequence[str]
    sa: str | None
    match: str | None
    target: str | None
    judge: str | None
    vertical: bool
    resume: bool

    def options(self) -> dict[str, Any]:
        """Return what needs a suite."""
        return {
            "--sa": self.sa,
            "--match": self.match,
            "--target": self.target,
            "--judge": self.judge,
            "--vertical": self.vertical,
            "--resume": self.resume,
        }

    def fields(self, pga: str | None) -> dict[str, Any]:
        """Return the fields of the block `[suite]` that are given."""
        sa, _, period = (self.sa or "").partition("@")
        return {
            "pga": pga,
            "sa": sa or None,
            "period": period or None,
            "match": self.match,
            "target": self.target,
            "judge": self.judge,
            "vertical": self.vertical or None,
        }


def run_suite_command(path: str, case: Case, pga: str | None, suite: Suite, request: Asked) -> None:
    """Run a suite, write and show it."""
    from heeltoe.study.run.suite import run_suite

    check_json(request.json)
    place = request.out or (Path(f"{Path(path).stem}-suite") if request.report else None)
    if suite.resume and place is None:
        raise InputError("suite-resume", "--resume")
    motions = [as_given(name) for name in suite.motions] or None
    runner = partial(run_suite, case, motions, model=request.model, out=place, resume=suite.resume, **suite.fields(pga))
    output = Output(
        place,
        Path(path).parent,
        units_of(case, request.units),
        f"heeltoe run {plain(path, LONGEST_PATH)}{' ... --motions ...' if motions else ''}",
        request.json,
        request.details,
        request.report,
        request.xlsx,
    )
    run_many(runner, output)

"""The words that do elsewhere what the app does: for a command line, and for Python."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from heeltoe.app.actions import Asked, BadRequestError
from heeltoe.app.bundle import CASE
from heeltoe.models.run import AUTO, MODELS

OUT = "result"
#: What can be run, by what it is called on the page.
RUNS = (AUTO, *MODELS)


@dataclass(frozen=True)
class Wanted:
    """What is to be taken away.

    Attributes
    ----------
    model
        To run.
    report, csv, animation
        Whether there is a report, tables are CSV in the place of Parquet, and there is an animation.
    units
        ``"si"`` or ``"us"``.
    own
        Those of the case itself.
    """

    model: str
    report: bool
    csv: bool
    animation: bool
    units: str
    own: str = "si"

    @property
    def suffix(self) -> str:
        """Of tables."""
        return ".csv" if self.csv else ".parquet"


def wanted_of(asked: Asked, units: str, own: str) -> Wanted:
    """Return what a tab asks for.

    Raises
    ------
    BadRequestError
        Where no page asks so.
    """
    model = asked.get("model", "")
    ticks: Mapping[str, object] = {name: asked.get(name, False) for name in ("report", "csv", "animation")}
    if model not in RUNS or not all(isinstance(each, bool) for each in ticks.values()):
        raise BadRequestError("model is one there is; report, csv and animation are true or false")
    return Wanted(str(model), bool(ticks["report"]), bool(ticks["csv"]), bool(ticks["animation"]), units, own)


def command(wanted: Wanted) -> str:
    """Return what is typed to get the same files."""
    words = [f"heeltoe run {CASE} --model {wanted.model} --out {OUT}"]
    words += ["--report"] if wanted.report else []
    words += ["--csv"] if wanted.csv else []
    units = [] if wanted.units == wanted.own else [f"--units {wanted.units}"]
    lines = [" ".join([*words, *units])]
    if wanted.animation:
        lines.append(" ".join([f"heeltoe animate {CASE} --model {wanted.model} --to {OUT}/animation.html", *units]))
    return "\n".join(lines)


def program(wanted: Wanted) -> str:
    """Return the program in Python that does the same."""
    own = "" if wanted.units == wanted.own else f', "units={wanted.units}"'
    lines = [
        "import json",
        "from pathlib import Path",
        "",
        "import heeltoe",
        "",
        f'case = heeltoe.read_case("{CASE}"{own})',
        f'result = heeltoe.run(case, "{wanted.model}")',
    ]
    if wanted.report:
        lines += [
            "# What the result of a block hangs on: the shaking varied by 1 %.",
            "result = result.with_responses(",
            "    lambda each: each if each.elastic or not each.ok else heeltoe.with_spread(each, case)",
            ")",
        ]
    lines += [f'Path("{OUT}").mkdir(exist_ok=True)']
    if wanted.report:
        lines += [f'heeltoe.write_report(case, result, "{OUT}")']
    if wanted.animation:
        lines += [f'heeltoe.animate(case, result, "{OUT}/animation.html")']
    lines += [f'Path("{OUT}/result.json").write_text(json.dumps(result.to_json(), indent=2))']
    return "\n".join(lines) + "\n"

"""Exported files, made in a process of their own, and the words that make them elsewhere: for a command line, and for
Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from heeltoe.app.case.files import CASE, zipped
from heeltoe.app.desk import BadRequestError, Request
from heeltoe.base.payload import Json
from heeltoe.models.run import AUTO, MODELS

OUT = "result"
#: What can be run, by what it is called on the page.
RUNS = (AUTO, *MODELS)


@dataclass(frozen=True)
class Wanted:
    """Options of an export.

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
        """File suffix of the tables."""
        return ".csv" if self.csv else ".parquet"


def wanted_of(request: Request, units: str, own: str) -> Wanted:
    """Return what a tab asks for.

    Raises
    ------
    BadRequestError
        Where no page asks so.
    """
    model = request.get("model", "")
    ticks: Mapping[str, object] = {name: request.get(name, False) for name in ("report", "csv", "animation")}
    if model not in RUNS or not all(isinstance(tick, bool) for tick in ticks.values()):
        raise BadRequestError("model must be the name of a model; report, csv and animation must be true or false")
    return Wanted(str(model), bool(ticks["report"]), bool(ticks["csv"]), bool(ticks["animation"]), units, own)


def command(options: Wanted) -> str:
    """Return what is typed to get the same files."""
    words = [f"heeltoe run {CASE} --model {options.model} --out {OUT}"]
    words += ["--report"] if options.report else []
    words += ["--csv"] if options.csv else []
    units = [] if options.units == options.own else [f"--units {options.units}"]
    lines = [" ".join([*words, *units])]
    if options.animation:
        lines.append(" ".join([f"heeltoe animate {CASE} --model {options.model} --to {OUT}/animation.html", *units]))
    return "\n".join(lines)


def program(options: Wanted) -> str:
    """Return the program in Python that does the same."""
    own = "" if options.units == options.own else f', "units={options.units}"'
    lines = [
        "import json",
        "from pathlib import Path",
        "",
        "import heeltoe",
        "",
        f'case = heeltoe.read_case("{CASE}"{own})',
        f'result = heeltoe.run(case, "{options.model}")',
    ]
    if options.report:
        lines += [
            "# The shaking varied by 1 %, on which the result of a block depends.",
            "result = result.with_responses(",
            "    lambda run: run if run.elastic or not run.ok else heeltoe.with_spread(run, case)",
            ")",
        ]
    lines += [f'Path("{OUT}").mkdir(exist_ok=True)']
    if options.report:
        lines += [f'heeltoe.write_report(case, result, "{OUT}")']
    if options.animation:
        lines += [f'heeltoe.animate(case, result, "{OUT}/animation.html")']
    lines += [f'Path("{OUT}/result.json").write_text(json.dumps(result.to_json(), indent=2))']
    return "\n".join(lines) + "\n"


#: All of it as one file.
ZIP = "heeltoe.zip"


def make(say: Callable[..., None], folder: Path, options: Wanted) -> Json:
    """Run the case of a folder, write the requested files into it, and return them."""
    from heeltoe.case.read import read_case
    from heeltoe.models.run import cost_of
    from heeltoe.study.small.analysis import analyse
    from heeltoe.views.animation.write import animate
    from heeltoe.views.files.write import figures_of, write_all
    from heeltoe.views.report.write import build_report, check_packages, draw_ahead, write_kinds

    if options.report:
        check_packages(field="report")
    case = read_case(folder / CASE)
    cost = cost_of(case, options.model)
    say("running" if cost is None else f"running, about {max(1.0, cost.seconds):.0f} s")
    result = analyse(case, options.model, spread="cheap" if options.report else None, say=say)
    say("drawing")
    ahead = draw_ahead(case, result, options.units) if options.report else None
    figures = figures_of(result, case, options.units) if ahead is None else ahead.figures

    def report(fresh: Path) -> None:
        if options.report:
            say("writing the report")
            words = command(options)
            built = build_report(case, result, units=options.units, command=words, figures=figures, ahead=ahead)
            write_kinds(built, fresh)

    finish = None if ahead is None else ahead.finish
    write_all(result, folder / OUT, figures=figures, finish=finish, suffix=options.suffix, report=report)
    if options.animation and result.histories:
        say("drawing the animation")
        animate(case.with_({"units": options.units}), result, folder / OUT / "animation.html")
    say("packing")
    zipped(folder, folder / ZIP, without=(".heeltoe-files",))
    return {"files": listed(folder), "verdict": _verdict(result, options.units)}


def _verdict(result: Any, units: str) -> str:
    from heeltoe.result.verdict import verdict

    return verdict(result, units)


def listed(folder: Path) -> list[Json]:
    """Return the files that were made, by their names below the folder."""
    paths = sorted(path for path in (folder / OUT).rglob("*") if path.is_file() and not path.name.startswith("."))
    return [{"name": path.relative_to(folder / OUT).as_posix(), "bytes": path.stat().st_size} for path in paths]

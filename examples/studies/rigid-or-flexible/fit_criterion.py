"""Fit how much farther elastic dams slide than their blocks, to runs.parquet; see docs/rigid-or-flexible.md.

    python examples/studies/rigid-or-flexible/fit_criterion.py OUT

writes the numbers of the fit, criterion.json, and the figure of the documentation, rigid-or-flexible.png, into the
directory OUT, and prints how the fit does on the dams and earthquakes that were held back. To ship new numbers, copy
criterion.json to python/heeltoe/models/rigid and the figure to docs.
"""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pyarrow.parquet as pq

from heeltoe.models.rigid.criterion import FAR_M, LEAST_MISSED, SHARE, Fit, Likeness, Regime, fit_of, regressor
from heeltoe.views.figures.write import save

HERE = Path(__file__).parent
#: What each line has on its axes.
TERMS: dict[Regime, tuple[str, ...]] = {
    "slides": ("slip", "amplification", "period"),
    "holds": ("margin", "spectrum", "amplification", "period"),
}
#: What else was tried.
TRIED = (
    ("slip",),
    ("slip", "amplification"),
    TERMS["slides"],
    (*TERMS["slides"], "margin"),
    (*TERMS["slides"], "spectrum"),
    ("margin",),
    ("period", "amplification"),
    ("margin", "spectrum", "amplification", "period"),
)
#: A slip that no one measures [m].
LEAST = 1e-5
#: Shares at which the quantiles of what a line misses are kept.
SHARES = np.linspace(0.0, 1.0, 41)


@dataclass(frozen=True)
class Row:
    """A dam in its motion, and how far it slides over what the fit measures it by."""

    told: Mapping[str, Any]
    like: Likeness
    ratio: float

    @property
    def held_back(self) -> bool:
        """Whether it is of the half that no fit has seen."""
        return bool(self.told["half"] == "check")


def rows(model: str, regime: Regime) -> list[Row]:
    """Return the studied cases with a result of the block and of a model."""
    result = []
    for answer in pq.read_table(HERE / "runs.parquet").to_pylist():
        if answer["rigid_outcome"] != "ok" or answer[f"{model}_outcome"] != "ok":
            continue
        like = likeness(answer)
        if like.regime == regime:
            by = like.slip if regime == "slides" else like.displacement
            result.append(Row(answer, like, max(abs(answer[f"{model}_slip_m"]), LEAST) / by))
    return result


def likeness(told: Mapping[str, Any]) -> Likeness:
    """Return what a dam of the table and its motion are like."""
    return Likeness(
        slip=abs(told["rigid_slip_m"]),
        rotation=told["rigid_rotation_rad"],
        first_period=told["first_period_s"],
        mean_period=told["mean_period_s"],
        peak=told["pga_m_s2"],
        spectral=told["spectral_acceleration_m_s2"],
        crack=told["crack_acceleration_m_s2"],
        critical=told["critical_sliding_m_s2"],
        level=told["crack_elevation_m"] / told["height_m"],
        water=told["reservoir_depth_m"] / told["height_m"],
        damping=told["damping"],
        friction=told["friction"],
    )


def fitted(seen: list[Row], terms: tuple[str, ...]) -> dict[str, Any]:
    """Fit a line by least squares."""
    numbers = [row.like.numbers() for row in seen]
    regressors = np.array([[1.0, *(regressor(name, item[name]) for name in terms)] for item in numbers])
    result = np.log([row.ratio for row in seen])
    line = np.linalg.lstsq(regressors, result, rcond=None)[0]
    missed = result - regressors @ line
    wide = np.linalg.lstsq(regressors[:, :2], np.abs(missed), rcond=None)[0]
    missed /= np.maximum(regressors[:, :2] @ wide, LEAST_MISSED)
    # The slip of a block that holds is no number of the line.
    named = [name for name in numbers[0] if name != "slip" or name in terms]
    return {
        "constant": round(float(line[0]), 4),
        "slopes": {name: round(float(each), 4) for name, each in zip(terms, line[1:], strict=True)},
        "spread": round(float(wide[0]), 4),
        "widening": round(float(wide[1]), 4),
        "quantiles": [round(float(item), 4) for item in np.quantile(missed, SHARES)],
        "ranges": {
            name: [
                _cut(min(item[name] for item in numbers), math.floor),
                _cut(max(item[name] for item in numbers), math.ceil),
            ]
            for name in named
        },
        "cases": len(seen),
    }


def _cut(value: float, way: Callable[[float], int]) -> float:
    """Return a number of two digits, below or above."""
    if value == 0.0:
        return 0.0
    digits = 1 - math.floor(math.log10(abs(value)))
    return round(way(value * 10.0**digits) / 10.0**digits, digits)


def all_fits() -> dict[str, Any]:
    """Return the numbers of criterion.json."""
    return {model: {regime: _fit(model, regime) for regime in TERMS} for model in ("flexible", "decoupled")}


def _fit(model: str, regime: Regime) -> dict[str, Any]:
    lines = rows(model, regime)
    answer = fitted([row for row in lines if not row.held_back], TERMS[regime])
    fit = fit_of({**answer, "held_back": {}})
    held = inside_ranges(fit, [row for row in lines if row.held_back])
    places = {place: [row for row in held if row.told["crack"] == place] for place in ("base", "height")}
    answer["held_back"] = {place: [round(covered(fit, some), 3), len(some)] for place, some in places.items() if some}
    return answer


def covered(fit: Fit, some: list[Row]) -> float:
    """Return the share of cases within what the fit says."""
    inside = 0
    for row in some:
        low, high = fit.band(row.like.numbers())
        inside += low <= row.ratio <= high
    return inside / len(some)


def inside_ranges(fit: Fit, some: list[Row]) -> list[Row]:
    """Return the cases that the fit speaks of."""
    return [row for row in some if fit.outside(row.like.numbers()) is None]


def compare() -> None:
    """Print what other numbers would foretell of blocks that slide."""
    lines = rows("flexible", "slides")
    print("numbers                              factor of scatter: fitted  held back")
    for terms in TRIED:
        answer = fitted([row for row in lines if not row.held_back], terms)
        fit = fit_of({**answer, "held_back": {}})
        off = [
            [np.log(row.ratio) - fit.at(row.like.numbers()) for row in lines if row.held_back == held]
            for held in (0, 1)
        ]
        seen, held = (np.exp(np.sqrt(np.mean(np.square(item)))) for item in off)
        print(f"{', '.join(terms):45} {seen:16.2f} {held:10.2f}")


def groups(fit: Fit) -> None:
    """Print how the band holds on parts of what was held back."""
    held = inside_ranges(fit, [row for row in rows("flexible", "slides") if row.held_back])
    by: dict[str, tuple[Callable[[Row], float], tuple[float, ...]]] = {
        "slip of the block [mm]": (lambda row: 1e3 * row.like.slip, (1.0, 3.0, 10.0, 100.0, 1e6)),
        "first period [s]": (lambda row: row.like.first_period, (0.0, 0.1, 0.2, 0.3, 2.0)),
        "height of the crack": (lambda row: row.like.level, (0.0, 1e-9, 0.4, 0.65, 1.0)),
    }
    for name, (number, ends) in by.items():
        for low, high in pairwise(ends):
            some = [row for row in held if low <= number(row) < high]
            off = np.array([np.log(row.ratio) - fit.at(row.like.numbers()) for row in some])
            times = np.quantile([row.ratio for row in some], [0.15, 0.5, 0.85])
            of = f"{name:23} {low:7g} to {high:7g}: {len(some):4d} cases, {covered(fit, some):4.0%} within"
            far = ", ".join(f"{time:.2g}" for time in times)
            print(f"{of}, bias {np.exp(off.mean()):.2f}, times as far {far}")


def report(fits: Mapping[str, Mapping[str, Any]]) -> None:
    """Print how the fits do on what was held back."""
    print("model      block   crack    cases  within  factor of scatter  bias")
    for model, by in fits.items():
        for regime, answer in by.items():
            fit = fit_of(answer)
            held = inside_ranges(fit, [row for row in rows(model, regime) if row.held_back])
            for place in ("both", "base", "height"):
                some = [row for row in held if place in ("both", row.told["crack"])]
                if len(some) > 20:
                    off = np.array([np.log(row.ratio) - fit.at(row.like.numbers()) for row in some])
                    scatter, bias = np.exp(off.std()), np.exp(off.mean())
                    line = f"{len(some):5d}  {covered(fit, some):6.0%}  {scatter:17.2f}  {bias:4.2f}"
                    print(f"{model:10} {regime:7} {place:7}  {line}")
    print("said that more than 10 mm slide, and how many of those held back do")
    for low, high, chance, did, count in foretold(fit_of(fits["flexible"]["holds"])):
        print(f"{low:4.0%} to {high:4.0%}: {chance:4.0%}  {did:4.0%}  of {count}")


def foretold(fit: Fit) -> list[tuple[float, float, float, float, int]]:
    """Return, for stretches of what is said of blocks that hold, the mean said and the share of those held back."""
    held = inside_ranges(fit, [row for row in rows("flexible", "holds") if row.held_back])
    chance = np.array([fit.beyond(row.like.numbers(), FAR_M / row.like.displacement) for row in held])
    did = np.array([row.ratio * row.like.displacement > FAR_M for row in held])
    ends = (0.0, 0.1, 0.3, 0.6, 0.85, 1.0 + 1e-9)
    parts = [(low, high, (chance >= low) & (chance < high)) for low, high in pairwise(ends)]
    return [
        (low, min(high, 1.0), chance[at].mean(), did[at].mean(), int(at.sum())) for low, high, at in parts if at.any()
    ]


def draw(fits: Mapping[str, Mapping[str, Any]]) -> Any:
    """Draw what was held back beside what the fit says."""
    figure, axes = plt.subplots(1, 3, figsize=(11.0, 3.9), layout="constrained")
    slides, holds = (fit_of(fits["flexible"][regime]) for regime in TERMS)
    held = inside_ranges(slides, [row for row in rows("flexible", "slides") if row.held_back])
    numbers = [row.like.numbers() for row in held]
    kinds = (("base", "o", "#0072B2", "at the base"), ("height", "^", "#D55E00", "at a height"))
    for place, marker, colour, label in kinds:
        at = [k for k, row in enumerate(held) if row.told["crack"] == place]
        foreseen = np.array([[np.exp(slides.at(numbers[k])), *slides.band(numbers[k])] for k in at])
        ratio = np.array([held[k].ratio for k in at])
        axes[0].vlines(foreseen[:, 0], foreseen[:, 1], foreseen[:, 2], color="#cccccc", lw=0.6, zorder=0)
        axes[0].plot(foreseen[:, 0], ratio, marker, ms=3, mfc="none", color=colour, label=label)
        slips = [1e3 * held[k].like.slip for k in at]
        axes[1].plot(slips, [held[k].ratio for k in at], marker, ms=3, mfc="none", color=colour, label=label)
    axes[0].vlines([], [], [], color="#cccccc", label=f"{SHARE:.0%} of the cases fitted")
    axes[0].set(xscale="log", yscale="log", xlabel="times as far, foretold", ylabel="times as far, elastic dam")
    axes[1].set(xscale="log", yscale="log", xlabel="slip of the block [mm]", ylabel="times as far, elastic dam")
    axes[0].legend(fontsize=7, loc="upper left")
    chances = [(item[2], item[3], item[4]) for item in foretold(holds)]
    axes[2].plot([0, 100], [0, 100], color="#888888", lw=0.8)
    axes[2].plot([100 * item[0] for item in chances], [100 * item[1] for item in chances], "s-", color="#009E73", ms=5)
    for foreseen, did, count in chances:
        axes[2].annotate(f" {count}", (100 * foreseen, 100 * did), fontsize=7, va="top")
    axes[2].set(xlabel="slide more than 10 mm, foretold [%]", ylabel="of those held back [%]")
    for each, title in zip(axes, ("the block slides", "the same, by its slip", "the block holds"), strict=True):
        each.set_title(title, fontsize=9, loc="left")
        each.grid(color="#dddddd", lw=0.5)
    return figure


def main(out: Path) -> None:
    """Fit, write numbers and figure into a directory, and print how well the fit does."""
    out.mkdir(parents=True, exist_ok=True)
    fits = all_fits()
    # Each list stands on one line.
    text = re.sub(r"\[[^\[\]{]*\]", lambda found: " ".join(found[0].split()), json.dumps(fits, indent=2))
    (out / "criterion.json").write_text(text + "\n", encoding="utf-8")
    save(draw(fits), out / "rigid-or-flexible.png", dpi=110)
    report(fits)
    groups(fit_of(fits["flexible"]["slides"]))
    compare()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: fit_criterion.py OUT")
    main(Path(sys.argv[1]))

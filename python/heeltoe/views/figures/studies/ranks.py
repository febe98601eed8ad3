"""The worst dams of a portfolio: how far they slip over the motions, and how often they exceed the first limit."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from heeltoe.errors.sanitize import plain
from heeltoe.result.contract import JOINT_METER_M
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.views.figures.studies.common import headed, slip_scale
from heeltoe.views.figures.style import COLOURS, WIDTH, styled
from heeltoe.views.words.studies import limit_of

#: Dams that are drawn, and the letters of a name.
_SHOWN, _LONGEST = 25, 28


@styled
def ranks_figure(study: StudyResults, units: str = "si") -> Figure | None:
    """Draw the worst dams of the last model from above: slips on the left, on the right the share of the motions in
    which the first limit is exceeded, where there are several; None without a table of dams."""
    if not study.portfolio:
        return None
    row = study.portfolio[-1]
    dams = row.dams[:_SHOWN]
    scale, unit = slip_scale(units)
    rows = np.arange(len(dams))[::-1]
    layout = ConstrainedLayoutEngine(w_pad=0.12)
    figure = Figure(figsize=(WIDTH, 1.5 + 0.22 * max(len(dams), 5)), layout=layout)
    limits, one = row.limits, row.motions == 1
    # One motion has no share, and no median.
    count = 2 if limits and not one else 1
    panels = figure.subplots(1, count, sharey=True, squeeze=False, width_ratios=[1.6, 1][:count])[0]
    slips = panels[0]
    for at, dam in zip(rows.tolist(), dams, strict=True):
        middle, high, most = (dam.residual_slip_m[name] for name in ("median", "84%", "largest"))
        if middle is not None and high is not None:
            low = max(middle, JOINT_METER_M)
            slips.barh(at, scale * max(high - low, 0.0), 0.6, left=scale * low, color=COLOURS["slip"])
        if most is not None:
            slips.plot(scale * max(most, JOINT_METER_M), at, "|", color="#000000", markersize=8, markeredgewidth=1.6)
        else:
            slips.annotate(
                "fails" if one else "fails in some",
                (0.01, at),
                xycoords=("axes fraction", "data"),
                fontsize=7,
                va="center",
            )
    slips.set_yticks(rows, [f"{dam.rank}  {plain(dam.name)[:_LONGEST]}" for dam in dams], fontsize=8)
    slips.set_ylim(-0.7, len(dams) - 0.3)
    slips.set_xscale("log")
    slips.set_xlim(scale * JOINT_METER_M, None)
    what = "residual slip in the one motion" if one else "residual slip: half to 84 % (bar), largest (mark)"
    slips.set_xlabel(f"{what} [{unit}]")
    slips.grid(visible=False, axis="y")
    if len(panels) > 1:
        shares = panels[1]
        shares.barh(rows, [100.0 * dam.exceeds[0] for dam in dams], 0.6, color=COLOURS["rotation"])
        shares.set_xlim(0.0, 100.0)
        shares.set_xlabel(f"motions that exceed the\n{limit_of(limits[0].limit, limits[0].value, units)} [%]")
        shares.grid(visible=False, axis="y")
    many = f"the {len(dams)} worst of {len(row.dams):,} dams" if len(row.dams) > len(dams) else f"{len(dams)} dams"
    return headed(figure, study, f"{row.model} model, {many}, with their ranks")

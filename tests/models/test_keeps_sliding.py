"""A dam that does not slow down on still ground has no residual slip, by run and by study."""

from __future__ import annotations

import numpy as np

import heeltoe
from heeltoe import read_case
from heeltoe.case.toml_writer import case_text
from heeltoe.models.runner import keeps_sliding, slides_on
from shared.dams import BASE

WEAK = [
    "crack.static_friction=1.0",
    "crack.kinetic_friction=0.6",
    "motion.duration=5s",
    "motion.pga=0.5g",
    "limits.residual_slip=100 m",
]
STUDY = """
case = "case.toml"
method = "grid"
[vary]
"crack.kinetic_friction" = [0.95, 0.6]
"""


# Steady; slower; steady at last, after a swing the other way.
SLIPS = [[0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 2.5], [3.0, 1.0, 2.0, 3.0]]


def test_slips_by_closed_forms():
    """A steady slide, one that friction stops after twice the time (both by hand), and a dam at rest."""
    t = np.linspace(0.0, 10.0, 1001)
    assert slides_on(t, 0.05 * t, 8.0)
    assert not slides_on(t, 0.05 * (t - t**2 / 40.0), 8.0)
    assert not slides_on(t, np.minimum(0.05 * t, 0.1), 8.0)
    assert keeps_sliding(np.array(SLIPS), 8.0).tolist() == [True, False, False]
    assert not slides_on(t, 0.05 * t, 1.0)


def test_a_study_has_the_outcomes_of_the_single_runs(tmp_path):
    case = read_case(BASE, WEAK)
    fields = case.model_dump(mode="json", exclude_unset=True)
    (tmp_path / "case.toml").write_text(case_text(fields), encoding="utf-8")
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")
    results = heeltoe.run_study(tmp_path / "study.toml", tmp_path / "out")
    single = [heeltoe.rigid(case.with_({"crack.kinetic_friction": friction})).outcome for friction in (0.95, 0.6)]
    assert single == ["ok", "keeps sliding"]
    (row,) = results.summary  # both signs of two dams
    assert row["outcomes"] == {"keeps sliding": 2, "ok": 2}
    assert row["limits_not_met"] == {"residual_slip": 2}
    table = results.to_pandas()
    assert table["residual_slip_m"].isna().tolist() == (table["outcome"] != "ok").tolist()

"""A part that slides farther than its crack is wide has left what it stood on: all models say so, studies count it."""

from __future__ import annotations

import pytest

from heeltoe import read_case, run, run_study
from shared.dams import TYPICAL_SECTION
from shared.studies import study_file

PUSH = [["0 s", "-1 g"], ["3 s", "-1 g"], ["3 s", "0 g"], ["3.5 s", "0 g"]]
DAM = {
    "section": TYPICAL_SECTION,
    "concrete": {"modulus": "20 GPa"},
    "crack": {"elevation": "50 m", "friction": 0.3},
    "reservoir": {"depth": "60 m"},
    "motion": {"points": PUSH},
    "analysis": {"silence": "0 s"},
    "flexible": {"elements_across": 2, "evidence": "none"},
}


@pytest.mark.parametrize("model", ["rigid", "decoupled", "flexible"])
def test_every_model_says_so(model):
    case = read_case(DAM)
    response = run(case, model)
    # What it stood on is behind it: its slip means failure.
    assert (response.outcome, response.ok) == ("lost", False)
    assert "leave" in str(response.advice).replace("left", "leaves")
    slid = response.peak_slip_downstream_m > case.cut.crack_width
    assert slid
    (message,) = [warning for warning in response.warnings if warning.code == "slid-off"]
    assert message.severity == "grave"
    assert all(check.failed for check in response.limits)
    weaker = run(read_case(DAM, ["motion.pga=0.3 g"]), model)
    assert weaker.outcome == "ok"
    assert not any(warning.code == "slid-off" for warning in weaker.warnings)


def test_a_study_counts_them(tmp_path):
    text = (
        'case = "case.toml"\n[vary]\n"crack.friction" = [0.02, 0.5]\n[motions]\nboth_signs = false\nfolder = "quakes"\n'
    )
    file = study_file(tmp_path, text + 'scale = { measure = "pga", values = ["0.3 g", "9 g"] }\n')
    study = run_study(file, tmp_path / "out")
    table = study.to_table(["slid_off", "peak_slip_downstream_m", "peak_slip_upstream_m", "outcome"]).to_pylist()
    known = [run for run in table if run["outcome"] == "ok"]
    assert known
    assert all(max(run["peak_slip_downstream_m"], -run["peak_slip_upstream_m"]) <= 4.0 for run in known)
    assert not any(run["slid_off"] for run in known)
    lost = [run for run in table if run["outcome"] == "lost"]
    assert lost
    assert all(run["slid_off"] for run in lost)
    assert study.summary[0]["slid_off"] == sum(run["slid_off"] for run in table)

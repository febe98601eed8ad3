"""Studies of dams with several cracks: each run the one by hand at every crack, the same bits whoever runs it, and what
has no such study refused by name."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import InputError, flexible, read_case, read_study, rigid, run_study
from heeltoe.motion.records.read import read_record
from heeltoe.result.contract import HEADLINES
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run import batches as parts
from shared.dams import TYPICAL_SECTION
from shared.studies import rows, study_file

SECTION = "\n".join(f'{name} = "{value}"' for name, value in TYPICAL_SECTION.items())
DAM = f"""
title = "Cracked at its base and at its neck"
[section]
{SECTION}
[concrete]
modulus = "20 GPa"
[crack]
friction = 0.7
[[further_cracks]]
elevation = "90 m"
friction = 0.4
[reservoir]
depth = "80 m"
[flexible]
elements_across = 2
evidence = "none"
"""

STUDY = """
case = "case.toml"
model = {model}
[vary]
"crack.friction" = [0.6, 0.8]
"further_cracks[0].friction" = {neck}
[motions]
both_signs = false
files = ["quakes/quake-a-000.txt", "quakes/quake-b-090.txt"]
scale = {{ measure = "pga", values = ["0.4 g", "0.9 g"] }}
[fragility]
limits = {{ residual_slip = ["3 mm"] }}
"""

VARIED = ("crack.friction", "further_cracks[0].friction")


def study(folder, model, case=DAM, neck="[0.4]"):
    return study_file(folder, STUDY.format(model=model, neck=neck), case=case)


# Silence that ends elsewhere makes the steps of an elastic dam a ten-thousandth longer or shorter.
@pytest.mark.slow
@pytest.mark.parametrize(("model", "more"), [(rigid, ""), (flexible, '[analysis]\nsilence = "0 s"\n')])
def test_each_run_is_the_one_by_hand_at_every_crack(tmp_path, model, more):
    plan = plan_of(read_study(study(tmp_path, f'"{model.__name__}"', DAM + more)))
    table = parts.run_part(plan, 0, plan.count).to_pylist()
    assert len(table) == 8
    for run in table[1::4]:
        case = read_case(tmp_path / "case.toml", {name: run[name] for name in VARIED})
        response = model(case, read_record(tmp_path / "quakes" / f"{run['motion']}.txt").scaled(run["factor"]))
        assert run["outcome"] == response.outcome == "ok"
        assert run["residual_slip_m"] == run["cracks[1].residual_slip_m"]
        for place, each in enumerate(response.to_json()["cracks"]):
            for key in (quantity.key for quantity in HEADLINES):
                assert run[f"cracks[{place}].{key}"] == pytest.approx(each[key], rel=1e-9, abs=1e-12), (place, key)
    slips = np.abs([[run[f"cracks[{place}].residual_slip_m"] for place in (0, 1)] for run in table])
    assert slips.max(axis=0).min() > 2e-3


def test_the_same_bits_whatever_the_parts_and_the_threads(tmp_path):
    brief = DAM + '[analysis]\nsilence = "0 s"\n'
    text = STUDY.replace('"quakes/quake-a-000.txt", ', "").format(model='["rigid", "flexible"]', neck="[0.4]")
    plan = plan_of(read_study(study_file(tmp_path, text, case=brief)))
    whole = parts.run_part(plan, 0, plan.count, threads=0).to_pylist()
    pieces = [run for start in range(0, plan.count, 3) for run in parts.run_part(plan, start, start + 3).to_pylist()]
    assert pieces == whole


def test_the_crack_that_exceeds_a_limit_is_the_one_that_counts(tmp_path):
    answer = run_study(
        study(tmp_path, '"rigid"', DAM.replace("80 m", "70 m"), neck="{ from = 0.2, to = 0.25, count = 2 }"),
        tmp_path / "out",
    )
    slips = np.abs([[run[f"cracks[{place}].residual_slip_m"] for place in (0, 1)] for run in rows(answer)])
    exceeds = slips > 3e-3
    assert answer.fragility[0]["exceeding"] == exceeds.any(axis=1).sum() > exceeds.sum(axis=0).max()
    both = answer.summary[0]["cracks"]
    assert both[1]["residual_slip_m"] != both[0]["residual_slip_m"]
    leads = [run["residual_slip_m"] for run in rows(answer)]
    assert np.abs(leads) == pytest.approx(slips.max(axis=1), abs=1e-4)


@pytest.mark.parametrize(
    ("model", "more", "code"),
    [
        ('["flexible", "decoupled"]', "", "unsupported"),
        ('"rigid"', '[[further_cracks]]\nelevation = "60 m"', "unsupported"),
        ('["rigid", "flexible"]', '[analysis]\nrotation = "finite"', "unsupported"),
    ],
)
def test_what_a_model_does_not_know_is_refused_before_anything_runs(tmp_path, model, more, code):
    with pytest.raises(InputError) as result:
        plan_of(read_study(study(tmp_path, model, f"{DAM}{more}\n")))
    assert result.value.code == code

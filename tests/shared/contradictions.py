"""What cannot be true of a result at once: read from its JSON, as a user's own program would read it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

Answer = dict[str, Any]
#: Energy that may be unaccounted for, of what came in.
LOST = {"rigid": 1e-6, "decoupled": 1e-3, "flexible": 1e-3}


def contradictions(answer: Answer) -> list[str]:
    """Return what contradicts itself in the JSON of a run or of static checks."""
    sentences = list(_numbers(answer))
    if "sections" in answer:
        return [
            *sentences,
            *(f"{sentence}" for section in answer["sections"] for sentence in _statics(section["statics"])),
        ]
    if answer["model"] == "statics":
        return [*sentences, *_statics(answer)]
    sentences += _run(answer)
    for beside in ("beside", "sequence"):
        if isinstance(answer.get(beside), dict) and "outcome" in answer[beside]:
            sentences += [f"beside: {sentence}" for sentence in _run(answer[beside])]
    return sentences


def _numbers(value: Any, path: str = "") -> Iterator[str]:
    if isinstance(value, dict):
        for name, inner in value.items():
            yield from _numbers(inner, f"{path}.{name}")
    elif isinstance(value, list):
        for place, inner in enumerate(value):
            yield from _numbers(inner, f"{path}[{place}]")
    elif isinstance(value, float) and not math.isfinite(value):
        yield f"{path} is {value}"


def _run(answer: Answer) -> Iterator[str]:
    outcome, verdict = answer["outcome"], answer["verdict"]
    known = outcome in ("ok", "overturned")
    if known is verdict.startswith("No result to trust"):
        yield f"outcome {outcome}, verdict {verdict!r}"
    if (outcome == "overturned") is not ("overturns" in verdict.partition(" This is for")[0]) and known:
        yield f"outcome {outcome}, verdict {verdict!r}"
    if not known:
        return
    cracks = answer.get("cracks") or [answer]
    for crack in cracks:
        yield from _crack(crack if "residual_slip_m" in crack else answer)
    yield from _limits(answer, verdict, outcome)
    energy = answer.get("energy")
    if energy and abs(energy["residual"]) > LOST.get(answer["model"], 1e-3):
        codes = [notice["code"] for notice in answer["warnings"]]
        if not any("energy" in code for code in codes):
            yield f"energy: {energy['residual']:.2g} is lost, and no warning says so ({', '.join(codes)})"
    if "does not slide." in verdict and answer["model"] == "rigid" and len(cracks) == 1 and answer["residual_slip_m"]:
        yield f"slides {answer['residual_slip_m']} m, verdict {verdict!r}"


def _crack(numbers: Answer) -> Iterator[str]:
    slip, down, up = (numbers[f"{name}_m"] for name in ("residual_slip", "peak_slip_downstream", "peak_slip_upstream"))
    slack = 1e-9 + 1e-9 * abs(slip)
    if not up - slack <= slip <= down + slack:
        yield f"a slip of {slip} m lies outside its extremes, {up} to {down} m"
    for name in ("opening_upstream_m", "opening_downstream_m", "rocking_downstream_rad", "rocking_upstream_rad"):
        if numbers[name] < 0.0:
            yield f"{name} is {numbers[name]}"
    joint = numbers.get("joint")
    if joint and not 0.0 <= joint["cracked_length_m"] <= numbers["crack_width_m"] * (1.0 + 1e-9):
        yield f"cracked length {joint['cracked_length_m']} m of {numbers['crack_width_m']} m"
    times = numbers.get("time_by_mode_s")
    if times and any(value < -1e-9 for value in times.values()):
        yield f"times by mode {times}"


def _limits(answer: Answer, verdict: str, outcome: str) -> Iterator[str]:
    limits = answer["limits"]
    for check in limits:
        met = outcome == "ok" and check["value"] <= check["allowed"]
        if check["met"] is not met:
            yield f"limit {check}"
        used = check["utilisation"]
        sure = used is not None and outcome == "ok" and not math.isclose(used, 1.0, rel_tol=1e-12)
        if sure and (used <= 1.0) is not met:
            yield f"limit {check}"
    reported = "not met" in verdict or "No limit is met" in verdict
    if reported is not any(not check["met"] for check in limits):
        yield f"limits {limits}, verdict {verdict!r}"
    if len(answer.get("cracks") or ()) > 1:
        return
    for check in limits:
        if check["name"] == "residual_slip" and check["value"] != abs(answer["residual_slip_m"]):
            yield f"limit on {check['value']} m, residual slip {answer['residual_slip_m']} m"


def _statics(answer: Answer) -> Iterator[str]:
    if answer["ok"] is not all(check["met"] for check in answer["checks"]):
        yield "ok is not that all checks are met"
    cases = {case["name"]: case for case in answer["cases"]}
    for check in answer["checks"]:
        value, required = check["value"], check["required"]
        if value is not None and required is not None:
            met = value >= required if check["at_least"] else value <= required
            if met is not check["met"] and not math.isclose(value, required, rel_tol=1e-9):
                yield f"check {check['load_case']} {check['name']}: {value} of {required}, met {check['met']}"
        case = cases.get(check["load_case"])
        if case and check["name"] == "equilibrium" and check["met"] is not (case["outcome"] == "stands"):
            yield f"{check['load_case']}: {case['outcome']}, equilibrium {check['met']}"
    for case in answer["cases"]:
        forces = sum(force["vertical_n"] for force in case["forces"])
        scale = max((abs(force["vertical_n"]) for force in case["forces"]), default=1.0)
        if case["outcome"] != "stands":
            continue
        if not -1e-6 <= case["cracked_length_m"] <= case["contact_width_m"] * (1 + 1e-9):
            yield f"{case['name']}: cracked {case['cracked_length_m']} m of {case['contact_width_m']} m"
        # A bond in tension may hold what would float.
        if case["normal_force_n"] <= 0.0 and min(case["heel_stress_pa"], case["toe_stress_pa"]) >= 0.0:
            yield f"{case['name']}: stands on {case['normal_force_n']} N"
        if not case["steepest_rise_rad"] and case.get("tilt") is None and not math.isfinite(forces / scale):
            yield f"{case['name']}: forces {forces}"

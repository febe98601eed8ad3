"""A suite of records: what one dam does in each earthquake, both ways round, and which number over them is judged.

The number of a record is that of its worse sign. Codes judge a suite by a number over its records: EN 1998-1:2004,
4.3.3.4.3(3), by the mean of seven or more and by the largest of fewer; ASCE/SEI 7-16, 16.4, by the mean of eleven.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from heeltoe.base.arrays import Floats, finite
from heeltoe.result.contract import CRACKED
from heeltoe.result.judge import CREST_LIMITS, LIMITS, Judged
from heeltoe.study.plan.crack_columns import column_of
from heeltoe.study.run.aggregate import Walk
from heeltoe.units.parse import STANDARD_GRAVITY

#: What is told of each record, and of all of them: the name in the JSON, and the limit that is held against it; the
#: crest where the runs say how it moves.
DEMANDS = {f"{name}_{limit.unit}": name for name, limit in LIMITS.items() if name != "opening"}
#: Shares of the runs that a number over them stays below, by name.
SHARES = {"median": 0.50, "84%": 0.84}
_SIGNS = ("recorded", "reversed")


class _Way(NamedTuple):
    """What a record does to the dam one way round: its judgement, the demands, SI, not a number where the run does not
    say, and how far each bonded joint has cracked [m]."""

    judged: Judged
    factor: float
    demands: Mapping[str, float]
    joints: tuple[float, ...]


def suite_of(walk: Walk) -> dict[str, Any] | None:
    """Return the answer of a suite, model by model; None of a study that is none.

    Parameters
    ----------
    walk
        Through the runs of the study, all of which are there.

    Returns
    -------
    dict
        ``judge``, the number over the records that is held against the limits; ``models`` with the ``records``, the
        ``statistics`` over them, the record that governs and the ``limits``, all SI and without signs.
    """
    rule = walk.manifest["study"].get("suite")
    if rule is None:
        return None
    judge = str(rule["judge"])
    return {"judge": judge, "models": [_of_model(walk, name, judge) for name in walk.models]}


def _demands(walk: Walk) -> dict[str, str]:
    absent = {*(() if walk.crest else CREST_LIMITS), *(() if walk.joints else ("cracked_length",))}
    return {key: limit for key, limit in DEMANDS.items() if limit not in absent}


def _of_model(walk: Walk, model: str, judge: str) -> dict[str, Any]:
    ways = _ways(walk, model)
    records: list[dict[str, Any]] = []
    judged: list[Judged] = []
    for motion in walk.manifest["motions"]:
        name = motion["name"]
        if motion["reversed"] and any(record["motion"] == name for record in records):
            continue
        signs = {sign: ways[name, sign] for sign in _SIGNS if (name, sign) in ways}
        if signs:
            sign = max(signs, key=lambda name: signs[name].judged.badness)
            records.append(_record(motion, sign, signs))
            judged.append(signs[sign].judged)
    demands = _demands(walk)
    values = {key: np.array([_counted(*row, key) for row in zip(records, judged, strict=True)]) for key in demands}
    statistics = {key: _statistics(column) for key, column in values.items()}
    worth = (walk.manifest["pilot"] or {}).get("evidence")
    governs = max(range(len(records)), key=lambda place: judged[place].badness)
    for place, record in enumerate(records):
        record["governs"] = place == governs
    joints = []
    for place, joint in enumerate(walk.joints):
        cracked = np.array([_of_joint(*row, place) for row in zip(records, judged, strict=True)])
        joints.append(
            {
                "elevation_m": joint["elevation_m"],
                "statistics": _statistics(cracked),
                "records_cracked": int(((cracked > 0.0) & np.isfinite(cracked)).sum()),
            }
        )
    known = worth if model == "flexible" else None
    limits = []
    for key, name in demands.items():
        if (allowed := walk.limits.get(name)) is None:
            continue
        if name != "cracked_length":
            limits.append(_limit(name, allowed, statistics[key][judge], known))
            continue
        # Each bonded joint is judged by itself.
        for joint in joints:
            at = joint["elevation_m"] if walk.cracks > 1 else None
            limits.append(_limit(name, allowed, joint["statistics"][judge], known, at))
    return {
        "model": model,
        "records": records,
        "statistics": statistics,
        "governing": {"motion": records[governs]["motion"], "sign": records[governs]["sign"]},
        "joints": joints,
        "limits": limits,
    }


def _ways(walk: Walk, model: str) -> dict[tuple[str, str], _Way]:
    """Return what each motion does either way round, by its name and its sign."""
    wanted = _demands(walk)
    of_joints = [column_of(joint["place"], CRACKED) if walk.cracks > 1 else CRACKED for joint in walk.joints]
    ways = {}
    for runs in walk("model", "motion", "reversed", "factor", *walk.judging(wanted.values())):
        judgement = runs.judged(walk, dict.fromkeys(wanted.values(), math.inf))
        demands = {key: judgement.size(limit).max(axis=1) for key, limit in wanted.items()}
        joints = [runs.numbers(name) for name in of_joints]
        judgement = replace(judgement, limits=walk.limits)
        motions, place = runs.words("motion")
        turned, factors = runs.table["reversed"].to_pylist(), runs.numbers("factor").tolist()
        for row in np.flatnonzero(runs.model == walk.models.index(model)).tolist():
            ways[motions[place[row]], _SIGNS[turned[row]]] = _Way(
                judgement[row],
                factors[row],
                {key: float(column[row]) for key, column in demands.items()},
                tuple(float(column[row]) for column in joints),
            )
    return ways


def _record(motion: Mapping[str, Any], sign: str, signs: Mapping[str, _Way]) -> dict[str, Any]:
    """Return what a record does, by its worse sign."""
    way = signs[sign]
    other = next((signs[name] for name in signs if name != sign), None)
    return {
        "motion": motion["name"],
        "event": motion["event"],
        "factor": way.factor,
        "pga_g": motion["measures"]["pga"] * way.factor / STANDARD_GRAVITY,
        "sign": sign,
        "outcome": str(way.judged.outcome),
        **{key: finite(value) for key, value in way.demands.items()},
        "joints_cracked_m": [finite(value) for value in way.joints],
        "other_sign_residual_slip_m": None if other is None else finite(other.demands["residual_slip_m"]),
        "magnitude": motion["traits"]["magnitude"],
        "distance_m": motion["traits"]["distance_m"],
        "vs30_m_s": motion.get("vs30_m_s"),
        "pulse_period_s": motion.get("pulse_period_s"),
    }


def _counted(record: Mapping[str, Any], judged: Judged, key: str) -> float:
    """Return a demand of a record, SI; a dam that fails and a run without a result count as infinitely much."""
    value = record[key]
    return math.inf if value is None or judged.failed else float(value)


def _of_joint(record: Mapping[str, Any], judged: Judged, place: int) -> float:
    """Return how far a bonded joint has cracked in a record; a dam that fails and a run without a result count as
    infinitely far."""
    value = record["joints_cracked_m"][place]
    return math.inf if value is None or judged.failed else float(value)


def _statistics(values: Floats) -> dict[str, float | None]:
    """Return mean, median, 84 % and largest of a demand over the records; None where it is not finite.

    The share of 84 % lies between records by a straight line, so that of few records it is near the largest."""
    numbers = {
        "mean": float(values.mean()),
        **{name: float(below(np.sort(values), share)) for name, share in SHARES.items()},
    }
    return {name: finite(number) for name, number in {**numbers, "largest": float(values.max())}.items()}


def below(ordered: Floats, share: float) -> Floats:
    """Return what a share of numbers in ascending order (..., n) stays below, (...,): straight between neighbours,
    infinite where one of the two is."""
    place = share * (ordered.shape[-1] - 1)
    low, part = int(place), place - int(place)
    first = ordered[..., low]
    if part == 0.0:
        return np.asarray(first)
    second = ordered[..., low + 1]
    finite = np.isfinite(first) & np.isfinite(second)
    return np.where(finite, first + part * (np.where(finite, second, 0.0) - np.where(finite, first, 0.0)), np.inf)


def _limit(
    name: str,
    allowed: float,
    value: float | None,
    worth: Mapping[str, Any] | None,
    elevation_m: float | None = None,
) -> dict[str, Any]:
    """Return how a number over the records stands to a limit; `worth` is the evidence of the record that has some, and
    the elevation that of the one of several cracks that is judged."""
    uncertainty = 0.0 if value is None or worth is None else _uncertainty(name, value, worth)
    return {
        "name": name,
        "elevation_m": elevation_m,
        "unit": LIMITS[name].unit,
        "value": value,
        "allowed": allowed,
        "uncertainty": uncertainty,
        "utilisation": None if value is None or not allowed else value / allowed,
        "met": value is not None and value <= allowed,
        "certain": value is None or not uncertainty or abs(value - allowed) > uncertainty,
    }


def _uncertainty(name: str, value: float, worth: Mapping[str, Any]) -> float:
    """Return how far a number over the records may be off: in proportion as in the record whose evidence is known, and
    by no less than there."""
    known = [worth[column] for column in LIMITS[name].keys if worth.get(column) is not None]
    if not known:
        return 0.0
    # Of the ways that one limit limits, the larger is the one that counts.
    own = max(known, key=lambda limit: abs(limit["value"]))
    size, uncertainty = abs(own["value"]), own["uncertainty"]
    # Without a bound the error may be as large as the value.
    return float((size if uncertainty is None else uncertainty) * max(1.0, value / size if size else 1.0))


def suite_spectra(walk: Walk, records: Sequence[Mapping[str, Any]]) -> dict[str, Any] | None:
    """Return the response spectra of the records as they shake the dam [m/s2], (records, periods), with their mean, and
    the target; None where the study keeps none."""
    spectra = walk.manifest.get("spectra")
    if spectra is None:
        return None
    scaled = np.array([np.multiply(record["factor"], spectra["motions"][record["motion"]]) for record in records])
    return {
        "damping": spectra["damping"],
        "period_s": np.array(spectra["period_s"]),
        "records": scaled,
        "mean": scaled.mean(axis=0),
        "target": spectra["target"],
    }

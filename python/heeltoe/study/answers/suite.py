"""A suite of records: what one dam does in each earthquake, both ways round, and which number over them is judged.

The number of a record is that of its worse sign. Codes judge a suite by a number over its records: EN 1998-1:2004,
4.3.3.4.3(3), by the mean of seven or more and by the largest of fewer; ASCE/SEI 7-16, 16.4, by the mean of eleven.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, NamedTuple

import numpy as np

from heeltoe.base.arrays import Floats, finite
from heeltoe.base.blocks import Block, Number
from heeltoe.result.contract import CRACKED, JOINT_METER_M, RESIDUAL_SLIP
from heeltoe.result.judge import CREST_LIMITS, LIMITS, Judged, LimitCheck
from heeltoe.study.plan.crack_columns import column_of
from heeltoe.study.plan.motion_names import alone
from heeltoe.study.run.aggregate import Walk
from heeltoe.units.parse import STANDARD_GRAVITY

#: What is told of each record, and of all of them: the name in the JSON, and the limit that is held against it; the
#: crest where the runs say how it moves.
DEMANDS = {f"{name}_{limit.unit}": name for name, limit in LIMITS.items() if name != "opening"}
#: Shares of the runs that a number over them stays below, by name.
SHARES = {"median": 0.50, "84%": 0.84}
_SIGNS = ("recorded", "reversed")


class SuiteLimit(LimitCheck):
    """Comparison of a number over the records of a suite with its limit."""

    elevation_m: Annotated[
        float | None, Number("Elevation of the bonded joint that is judged, where there are several cracks.", "m")
    ] = None


class SuiteJoint(Block):
    """A bonded joint over the records."""

    elevation_m: Annotated[float, Number("Elevation of the joint.", "m")]
    statistics: Annotated[Mapping[str, float | None], Number("Cracked length of the joint over the records.", "m")]
    records_cracked: Annotated[int, Number("In how many records the joint cracks.")]


class GoverningRun(Block):
    """The run of a suite that governs."""

    motion: Annotated[str, Number("Record of that run.")]
    sign: Annotated[str, Number("The sign that is the worse one.")]


class SuiteRecord(Block):
    """Results of a dam in a record, by its worse sign; numbers without sign."""

    motion: Annotated[str, Number("Which record.")]
    event: Annotated[str, Number("The event of the record.")]
    factor: Annotated[float, Number("Factor on the record as it is in its file.")]
    pga_g: Annotated[float, Number("Peak of the record as it shakes the dam.", "g")]
    sign: Annotated[str, Number("Its worse sign: recorded or reversed.")]
    outcome: Annotated[str, Number("How that run ends.")]
    residual_slip_m: Annotated[float | None, Number("Residual slip; null without a result.", "m")]
    peak_slip_m: Annotated[float | None, Number("Largest slip either way.", "m")]
    opening_upstream_m: Annotated[float | None, Number("Largest opening at the upstream face.", "m")]
    opening_downstream_m: Annotated[float | None, Number("Largest opening at the downstream face.", "m")]
    rotation_rad: Annotated[float | None, Number("Largest rotation either way.", "rad")]
    cracked_length_m: Annotated[
        float | None,
        Number("Length of a bonded joint that is cracked in the end: the largest of all joints; null without.", "m"),
    ] = None
    crest_displacement_m: Annotated[
        float | None, Number("Largest displacement of the crest; null where no limit is on it.", "m")
    ] = None
    crest_acceleration_g: Annotated[float | None, Number("Largest acceleration of the crest, likewise.", "g")] = None
    joints_cracked_m: Annotated[
        list[float | None],
        Number("Length of each bonded joint that is cracked in the end, from the crest down.", "m"),
    ]
    other_sign_residual_slip_m: Annotated[
        float | None, Number("Residual slip with the other sign; null without it.", "m")
    ]
    without_cross_valley_slip_m: Annotated[
        float | None,
        Number("Residual slip without the shaking across the valley, by this sign; null where none is.", "m"),
    ] = None
    cross_valley_factor: Annotated[
        float | None, Number("Residual slip over that; null where there is none, or it is too small to tell.")
    ] = None
    azimuth_deg: Annotated[
        float | None,
        Number("Direction of the stream that is the worst, clockwise from north; null where one is given.", "deg"),
    ] = None
    magnitude: Annotated[float | None, Number("Magnitude by the list of records or the event; null without one.")]
    distance_m: Annotated[float | None, Number("From the fault to where it was recorded, likewise.", "m")]
    vs30_m_s: Annotated[float | None, Number("Velocity of shear waves in the upper 30 m there, likewise.", "m/s")]
    pulse_period_s: Annotated[float | None, Number("Period of the pulse in its velocity, likewise.", "s")]
    hazard_share: Annotated[
        float | None, Number("Share of the hazard from earthquakes like its own; null without a disaggregation.")
    ] = None
    governs: Annotated[bool, Number("Whether it is the worst of all records.")] = False


class SuiteModel(Block):
    """Results of a suite by one model."""

    model: Annotated[str, Number("Which model.")]
    records: Annotated[list[SuiteRecord], Number("Results in each record, by its worse sign; numbers without sign.")]
    statistics: Annotated[
        Mapping[str, Mapping[str, float | None]], Number("Numbers over the records, each by its worse sign.")
    ]
    governing: Annotated[GoverningRun, Number("The run that governs.")]
    joints: Annotated[list[SuiteJoint], Number("The bonded joints, from the crest down.")]
    limits: Annotated[list[SuiteLimit], Number("The limits of the case.")]


class SuiteAnswer(Block):
    """Results of a suite of records."""

    judge: Annotated[str, Number("Statistic over the records that the limits judge.")]
    models: Annotated[list[SuiteModel], Number("The same by each model.")]


class _Way(NamedTuple):
    """Result of a record with one sign: its judgement, the demands, SI, not a number where the run has no value, and
    how far each bonded joint has cracked [m]."""

    judged: Judged
    factor: float
    demands: Mapping[str, float]
    joints: tuple[float, ...]


def suite_of(walk: Walk) -> SuiteAnswer | None:
    """Return the answer of a suite, model by model, all SI and without signs; None of a study that is none. All runs of
    the study are there."""
    rule = walk.manifest["study"].get("suite")
    if rule is None:
        return None
    judge = str(rule["judge"])
    return SuiteAnswer(judge=judge, models=[_of_model(walk, name, judge) for name in walk.models])


def _demands(walk: Walk) -> dict[str, str]:
    absent = {*(() if walk.crest else CREST_LIMITS), *(() if walk.joints else ("cracked_length",))}
    return {key: limit for key, limit in DEMANDS.items() if limit not in absent}


def _of_model(walk: Walk, model: str, judge: str) -> SuiteModel:
    ways = _ways(walk, model)
    records: list[SuiteRecord] = []
    judged: list[Judged] = []
    motions = walk.manifest["motions"]
    apart = {alone(motion["name"]) for motion in motions}
    for motion in motions:
        name = motion["name"]
        if name in apart:
            continue
        if motion["reversed"] and any(record.motion == name for record in records):
            continue
        signs = {sign: ways[name, sign] for sign in _SIGNS if (name, sign) in ways}
        if signs:
            sign = max(signs, key=lambda name: signs[name].judged.badness)
            record, badness = _record(motion, sign, signs, ways.get((alone(name), sign))), signs[sign].judged
            # Streams of several azimuths are one record, by the worst of them.
            if record.azimuth_deg is not None and records and records[-1].event == record.event:
                if badness.badness > judged[-1].badness:
                    records[-1], judged[-1] = record, badness
                continue
            records.append(record)
            judged.append(badness)
    demands = _demands(walk)
    values = {key: np.array([_counted(*row, key) for row in zip(records, judged, strict=True)]) for key in demands}
    statistics = {key: _statistics(column) for key, column in values.items()}
    worth = (walk.manifest["pilot"] or {}).get("evidence")
    governs = max(range(len(records)), key=lambda place: judged[place].badness)
    records[governs] = replace(records[governs], governs=True)
    joints = []
    for place, joint in enumerate(walk.joints):
        cracked = np.array([_of_joint(*row, place) for row in zip(records, judged, strict=True)])
        joints.append(
            SuiteJoint(
                elevation_m=joint["elevation_m"],
                statistics=_statistics(cracked),
                records_cracked=int(((cracked > 0.0) & np.isfinite(cracked)).sum()),
            )
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
        for bonded in joints:
            at = bonded.elevation_m if walk.cracks > 1 else None
            limits.append(_limit(name, allowed, bonded.statistics[judge], known, at))
    return SuiteModel(
        model=model,
        records=records,
        statistics=statistics,
        governing=GoverningRun(motion=records[governs].motion, sign=records[governs].sign),
        joints=joints,
        limits=limits,
    )


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


def _record(motion: Mapping[str, Any], sign: str, signs: Mapping[str, _Way], without: _Way | None) -> SuiteRecord:
    """Return what a record does, by its worse sign, beside the run without the shaking across the valley."""
    way = signs[sign]
    other = next((signs[name] for name in signs if name != sign), None)
    demands: dict[str, Any] = {key: finite(value) for key, value in way.demands.items()}
    along = None if without is None else finite(without.demands[RESIDUAL_SLIP.key])
    slip = demands[RESIDUAL_SLIP.key]
    factor = None if along is None or slip is None or along < JOINT_METER_M else slip / along
    return SuiteRecord(
        motion=motion["name"],
        event=motion["event"],
        factor=way.factor,
        pga_g=motion["measures"]["pga"] * way.factor / STANDARD_GRAVITY,
        sign=sign,
        outcome=str(way.judged.outcome),
        **demands,
        joints_cracked_m=[finite(value) for value in way.joints],
        other_sign_residual_slip_m=None if other is None else finite(other.demands[RESIDUAL_SLIP.key]),
        without_cross_valley_slip_m=along,
        cross_valley_factor=factor,
        azimuth_deg=motion.get("azimuth_deg"),
        magnitude=motion["traits"]["magnitude"],
        distance_m=motion["traits"]["distance_m"],
        vs30_m_s=motion.get("vs30_m_s"),
        pulse_period_s=motion.get("pulse_period_s"),
        hazard_share=motion.get("hazard_share"),
    )


def _counted(record: SuiteRecord, judged: Judged, key: str) -> float:
    """Return a demand of a record, SI; a dam that fails and a run without a result count as infinitely much."""
    value = record[key]
    return math.inf if value is None or judged.failed else float(value)


def _of_joint(record: SuiteRecord, judged: Judged, place: int) -> float:
    """Return how far a bonded joint has cracked in a record; a dam that fails and a run without a result count as
    infinitely far."""
    value = record.joints_cracked_m[place]
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
) -> SuiteLimit:
    """Return how a number over the records stands to a limit; `worth` is the evidence of the record that has some, and
    the elevation that of the one of several cracks that is judged."""
    uncertainty = 0.0 if value is None or worth is None else _uncertainty(name, value, worth)
    return SuiteLimit(
        name=name, value=value, allowed=allowed, failed=False, uncertainty=uncertainty, elevation_m=elevation_m
    )


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


def suite_spectra(walk: Walk, records: Sequence[SuiteRecord]) -> dict[str, Any] | None:
    """Return the response spectra of the records as they shake the dam [m/s2], (records, periods), with their mean, and
    the target; None where the study stores no spectra."""
    spectra = walk.manifest.get("spectra")
    if spectra is None:
        return None
    scaled = np.array([np.multiply(record.factor, spectra["motions"][record.motion]) for record in records])
    return {
        "damping": spectra["damping"],
        "period_s": np.array(spectra["period_s"]),
        "records": scaled,
        "mean": scaled.mean(axis=0),
        "target": spectra["target"],
    }

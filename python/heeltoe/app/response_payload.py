"""A response as the page draws it: texts in the units of the reader, curves with as many points as a screen has, and
the dam in motion at the moments that matter."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from heeltoe.app.wording import meant
from heeltoe.base.arrays import Floats
from heeltoe.base.payload import Json
from heeltoe.case.model import Case
from heeltoe.result.contract import HEADLINES, JOINT_METER_M, LEAST_M, LEAST_RAD, RESIDUAL_SLIP
from heeltoe.result.histories import GAPS, ROTATION, SLIP
from heeltoe.result.judge import LimitCheck
from heeltoe.result.response import Response
from heeltoe.result.verdict import band_sentence, effect_sentence, limited, verdict
from heeltoe.units.sentences import written
from heeltoe.units.systems import unit_system
from heeltoe.units.write import angle, length, measured
from heeltoe.views.animation.page import packed
from heeltoe.views.figures.panels import SLIP_KINDS, pieces
from heeltoe.views.figures.style import shaken_by
from heeltoe.views.words.response import CRACK_COLUMNS, SEQUENCE_COLUMNS, crack_rows, law_lines, sequence_rows

# Stretches of a history of which each has its peaks drawn: as many as a large screen has room for.
_BINS = 400
# What is less all along is drawn as nothing.
_LEAST = {"slip": JOINT_METER_M, "rotation": LEAST_RAD}


def drawn(response: Response, units: str) -> Json:
    """Return what the page shows of a response."""
    payload = {
        "model": response.model,
        "title": response.title,
        "ok": response.ok,
        "headline": _headline(response, units),
        # The numbers below have the openings.
        "verdict": verdict(response, units, brief=True),
        "warnings": [{"text": meant(warning, units), "severity": warning.severity} for warning in response.warnings],
        "shaking": shaken_by(response),
        "seconds": response.seconds,
    }
    if not response.summary:
        return payload
    return payload | {
        "numbers": _numbers(response, units),
        "curves": _curves(response, units),
        "ribbon": _ribbon(response),
        "slips": _slips(response, units),
        "facts": [*_frictions(response, units), *law_lines(response, units)],
        "tables": [
            {"label": label, "columns": columns, "rows": rows} for label, columns, rows in _tables(response, units)
        ],
    }


def _headline(response: Response, units: str) -> Json:
    """Return the number that a reader looks for first: of the limits that which is nearest, or farthest beyond; without
    limits the residual slip. Its state is ``"met"``, ``"doubted"``, ``"failed"``, or ``"free"`` without a limit."""
    outcome = response.outcome
    if not outcome.has_result or outcome.failed:
        return {
            "value": outcome.capitalize() if outcome.failed else "No result",
            "label": outcome.sentence,
            "limit": "",
            "state": "failed",
            "limits": [{"text": _limit_text(check, units), "state": "failed"} for check in response.limits],
        }
    slip = RESIDUAL_SLIP.of(response)
    way = "" if abs(slip) < LEAST_M else " downstream" if slip > 0.0 else " upstream"
    return judged(response.limits, abs(slip), f"residual slip{way}", units)


def judged(limits: Sequence[LimitCheck], slip: float, label: str, units: str, by: str = "") -> Json:
    """Return the headline of some limits, or of a slip [m], not negative, where there are none; `by` says which number
    over several runs it is."""
    checks = sorted(limits, key=_share, reverse=True)
    if not checks:
        value = length(slip, units) if slip >= LEAST_M else "0"
        return {"value": value, "label": label + by, "limit": "no limit set", "state": "free", "limits": []}
    first, *others = checks
    return {
        "value": "" if first.value is None else measured(first.value, first.unit, units),
        "label": limited(first, units) + by,
        "limit": _within(first, units),
        "state": _state(first),
        "limits": [{"text": _limit_text(check, units), "state": _state(check)} for check in others],
    }


def _share(check: LimitCheck) -> float:
    """Return how much of a limit is used; where nothing is allowed, all of it or none."""
    used = check.utilisation
    return used if used is not None else 0.0 if check.met else float("inf")


def _state(check: LimitCheck) -> str:
    return "doubted" if not check.certain else "met" if check.met else "failed"


def _limit_text(check: LimitCheck, units: str) -> str:
    value = "" if check.value is None else f" {measured(check.value, check.unit, units)}"
    return f"{limited(check, units)}{value}: {_within(check, units)}"


def _within(check: LimitCheck, units: str) -> str:
    if check.failed:
        return f"the {measured(check.allowed, check.unit, units)} allowed are not met"
    says = {"met": "within", "doubted": "not for certain within", "failed": "more than"}[_state(check)]
    return f"{says} the {measured(check.allowed, check.unit, units)} allowed"


def _numbers(response: Response, units: str) -> list[dict[str, str]]:
    numbers = []
    for headline in HEADLINES:
        value = headline.way * response.summary[headline.key]
        text = angle(value) if headline.kind == "rotation" else length(value, units)
        numbers.append(
            {"key": headline.key, "label": headline.full, "text": text if abs(value) >= headline.least else "0"}
        )
    return numbers


def _frictions(response: Response, units: str) -> Iterator[tuple[str, str]]:
    """Walk what other frictions do: those of a band, or a little less, which the brief verdict leaves out."""
    if band := band_sentence(response, units):
        yield "other frictions", band
    if response.friction_effect is not None:
        yield "less friction", effect_sentence(response.friction_effect, units)


def _tables(response: Response, units: str) -> Iterator[tuple[str, Sequence[str], list[list[str]]]]:
    """Walk what a response tells row by row: of several cracks, of several motions."""
    if response.several:
        yield "Each crack, from the crest down", CRACK_COLUMNS, crack_rows(response, units)
    if response.sequence:
        yield "Motion by motion", SEQUENCE_COLUMNS, sequence_rows(response, units)


def _curves(response: Response, units: str) -> Json:
    h = response.histories
    ground = h.ground_acceleration_m_s2 / response.gravity
    others = response.others
    cracks = [response, *others.values()]
    moving = [crack.histories[name] for crack in cracks for name in (SLIP, ROTATION)]
    kept = thinned([*moving, ground], _BINS)
    system = unit_system(units)
    # The smallest units, whatever the size: the curves of two models share an axis.
    scales = {"slip": system.scale("displacement", 0.0), "rotation": system.scale("rotation", 0.0)}

    def rows(crack: Response) -> Json:
        values = {"slip": crack.histories.slip_m, "rotation": crack.histories.rotation_rad}
        return {
            name: {
                "unit": scale.unit,
                "values": packed(scale(values[name][kept]), "float32"),
                "least": float(scale(_LEAST[name])),
            }
            for name, scale in scales.items()
        }

    return {
        "time": packed(h.time_s[kept], "float32"),
        "end": float(h.time_s[-1]),
        "ground": {"unit": "g", "values": packed(ground[kept], "float32")},
        "cracks": [{"name": name, **rows(crack)} for name, crack in _named(response, others, units)],
        **rows(response),
    }


def _named(response: Response, others: Mapping[str, Response], units: str) -> Iterator[tuple[str, Response]]:
    """Walk the cracks beside that of ``[crack]``, by where they are."""
    for name, other in others.items():
        place = int(name.rpartition("-")[2]) - 1
        yield written("crack at {at_m:g m}", units, at_m=response.cracks[place].elevation), other


def _ribbon(response: Response) -> list[Json]:
    """Return kind, start and end of each stretch of one kind of motion; neighbours of one kind are joined."""
    spans: list[dict[str, object]] = []
    for kind, start, end in pieces(response):
        if spans and spans[-1]["kind"] == kind:
            spans[-1]["end"] = end
        elif end > start:
            spans.append({"kind": kind, "start": start, "end": end})
    return spans


def _slips(response: Response, units: str) -> list[Json]:
    slips = {kind: response.slip_by_mode_m[key] for key, kind in SLIP_KINDS.items()}
    largest = max(float(np.max(np.abs(list(slips.values())))), 1e-12)
    return [
        {"kind": kind, "text": length(value, units), "share": abs(value) / largest, "upstream": value < 0.0}
        for kind, value in slips.items()
    ]


def thinned(rows: Sequence[Floats], bins: int) -> NDArray[np.int64]:
    """Return which moments of some histories to draw, so that no peak of any of them is lost.

    Parameters
    ----------
    rows
        Of equal length, on the same moments.
    bins
        Into how many stretches the moments are divided: of each the first is kept, and where every row is largest and
        least; the last of all, too.
    """
    count = len(rows[0])
    width = -(-count // bins)
    if width <= 2:
        return np.arange(count)
    whole = count - count % width
    starts = np.arange(0, count, width)
    places = [starts, np.array([count - 1])]
    for row in rows:
        table = row[:whole].reshape(-1, width)
        places += [starts[: len(table)] + table.argmax(axis=1), starts[: len(table)] + table.argmin(axis=1)]
        if whole < count:
            places.append(whole + np.array([row[whole:].argmax(), row[whole:].argmin()]))
    return np.unique(np.concatenate(places))


_DAM_BINS = 200
_COLUMNS = (SLIP, ROTATION, *GAPS)
# An elastic dam swings between the moments that matter of its cracks: of its run so many are shown.
_MOST_FRAMES = 1500


def dam(case: Case, response: Response, units: str) -> Json | None:
    """Return what the player of the moving dam draws; None for a response without results."""
    from heeltoe.views.animation.frames import build_scene
    from heeltoe.views.animation.page import scene_data

    if not response.summary or not response.histories:
        return None
    samples = response.histories.time_s
    if response.elastic:
        times = samples[:: -(-samples.size // _MOST_FRAMES)]
    else:
        times = samples[thinned([crack.histories[name] for crack in response.cracks for name in _COLUMNS], _DAM_BINS)]
    return scene_data(build_scene(case, response, times, None, units))

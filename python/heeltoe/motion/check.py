"""Checks of a ground motion for suspicious features before a dam is shaken with it."""

from __future__ import annotations

import re
from typing import Literal

import numpy as np

from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import UNCORRECTED, GroundMotion
from heeltoe.motion.measures import level_of
from heeltoe.motion.start import lag_of
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

# More than any ground has been seen to do [g].
_STRONGEST = 10.0
# The fastest and farthest that ground has been seen to move are some 4 m/s and 10 m [m/s, m].
_FASTEST, _FARTHEST = 10.0, 50.0
# Fewer samples than this are a pulse that somebody drew.
_DRAWN = 20
# How far the peak reaches beyond all but its next neighbours: of some seventy records of strong motion Landers 1992 has
# the most, 1.5, but for Cape Mendocino 1992, whose spikes are doubted: 2.1 and 3.0 beyond three samples on each side.
_LONE, _DOUBTED = 3.0, 2.0
# A record that starts or ends at more than this part of its peak jumps there from rest, or to it.
_JUMP = 0.1
# A level of 1 g within so much is gravity; one of this share of how far a record shakes from it is an offset. Of some
# seventy records of strong motion none rests at more than half a hundredth.
_ONE_G, _OFFSET = 0.1, 0.05
# Shorter than this [s] is no earthquake.
_SHORTEST = 1e-3
# A record is seldom trusted to stand for one that is stronger by more than this.
_MOST_SCALED = 5.0
# Longest step [s] with which a record tells what any dam feels: with 0.05 s a rigid block slides 12 % less far. For an
# elastic dam see heeltoe.mechanics.beam.
_COARSE = 0.04
_UP = re.compile(r"\b(?:up|ud|u-d|vert(?:ical)?|ver|down|dwn|dn|[behl][hnl]z)\b|^\s*[vz]\d?\s*$", re.IGNORECASE)
_YEAR = re.compile(r"\b(?:18|19|20)\d\d\b")
_LEVEL = re.compile(
    r"\b(?:[ns]\s*\d{0,2}(?:\.\d*)?\s*[ew]|[ns]-[ns]|[ew]-[ew]|ns|sn|ew|we|north|south|east|west|[behl][hnl][ne12])\b"
    r"|^\s*\d{1,3}\s*(?:deg\w*|°)?\s*(?:\(|$)",
    re.IGNORECASE,
)


#: Direction of a component: vertical, horizontal, or not known.
Way = Literal["up", "level", ""]


def way_of(component: str) -> Way:
    """Return the direction of a component from the name in its record."""
    if _UP.search(component):
        return "up"
    return "level" if _LEVEL.search(component) else ""


def check_record(
    motion: GroundMotion, gravity: float, *, field: str = "motion", upward: bool | None = None
) -> tuple[Notice, ...]:
    """Return what is suspicious about a record as it was read: scaled or filtered, damage no longer shows.

    Parameters
    ----------
    motion
        The record.
    gravity
        One g [m/s2].
    field
        Where it stands in the case, for errors.
    upward
        Whether it is to shake the dam vertically; None where it is only looked at.

    Raises
    ------
    InputError
        Where it peaks beyond anything an earthquake does, or one value stands alone far above all others.
    """
    peak = motion.pga / gravity
    if peak > _STRONGEST:
        raise InputError("motion-peak", field, f"{peak:.4g} g", name=motion.name)
    notices = []

    def say(code: str, kind: str = "", /, time_s: float | None = None, **quantities: float | str) -> None:
        notices.append(Notice(code, kind, field=field, time_s=time_s, name=motion.name, **quantities))

    # A file without a header may tell by its name.
    component = motion.component or motion.name.replace("_", " ")
    way = way_of(component)
    if way == "up" and upward is False:
        say("component-other", component=component, kind="vertical", way="horizontally")
    if upward and way == "level":
        say("component-other", component=component, kind="horizontal", way="vertically")
    steps = np.diff(motion.time)
    if motion.time.size <= _DRAWN:
        return tuple(notices)
    if motion.format != "points":
        moment, value = motion.peak
        lone, doubted = _reach(motion, 1), _reach(motion, 3)
        if lone > _LONE:
            quantities = {"name": motion.name, "moment": f"{moment:.4g} s", "ratio": f"{lone:.3g}"}
            raise InputError("motion-spike", field, f"{value / gravity:.4g} g", **quantities)
        if doubted > _DOUBTED:
            say("motion-flaw", "spike", moment, peak_g=value / gravity, ratio=doubted)
        if motion.dt > _COARSE:
            say("motion-flaw", "coarse", step_s=motion.dt)
    if (steps > 5.0 * motion.dt).any():
        gap = int(steps.argmax())
        say("motion-flaw", "gap", float(motion.time[gap]), gap_s=float(steps[gap]))
    level, _ = level_of(motion)
    shaken = float(np.abs(motion.acceleration - level).max())
    if _has_gravity(level, gravity):
        say("motion-gravity", level_g=level / gravity)
    # An offset shows in the mean too, a wave that is cut off does not.
    elif shaken > 0.0 and min(abs(level), abs(float(motion.acceleration.mean()))) > _OFFSET * shaken:
        say("motion-flaw", "offset", level_g=level / gravity, share=abs(level) / shaken)
    top = np.abs(motion.acceleration) >= motion.pga * (1.0 - 1e-12)
    if motion.pga > 0.0 and (top[:-3] & top[1:-2] & top[2:-1] & top[3:]).any():
        say("motion-flaw", "clipped")
    for place, value in (("starts", motion.acceleration[0]), ("ends", motion.acceleration[-1])):
        if motion.format != "points" and abs(value) > _JUMP * motion.pga:
            say(
                "motion-flaw", "jumps", place=place, jump_g=float(value) / gravity, share=float(abs(value)) / motion.pga
            )
    return tuple(notices)


def _has_gravity(level: float, gravity: float) -> bool:
    return abs(abs(level) - gravity) <= _ONE_G * gravity


def _reach(motion: GroundMotion, width: int) -> float:
    """Return the peak over the largest value more than `width` samples away from it."""
    size = np.abs(motion.acceleration)
    place = int(size.argmax())
    others = np.concatenate([size[: max(0, place - width)], size[place + width + 1 :]])
    largest = float(others.max(initial=0.0))
    return float(size[place]) / largest if largest else 1.0 if size[place] == 0.0 else np.inf


def check_moved(motion: GroundMotion, gravity: float, field: str, block: str = "motion") -> None:
    """Refuse a record, as it was processed and before it is scaled, that is uncorrected, has gravity in it, or goes
    where no ground goes.

    Raises
    ------
    InputError
        With the value, its limit, and the processing in `block` that helps; a motion drawn by points may go anywhere.
    """
    helps = f"{block}.processing"
    for notice in motion.warnings:
        if notice.code == UNCORRECTED:
            raise InputError(
                UNCORRECTED, field, name=motion.name, why=dict(notice.quantities)["why"], processing_field=helps
            )
    level, _ = level_of(motion)
    if _has_gravity(level, gravity):
        raise InputError("motion-gravity", field, f"{level / gravity:.3g} g", name=motion.name, processing_field=helps)
    if motion.format != "points" and (motion.pgv > _FASTEST or motion.pgd > _FARTHEST):
        quantities = {
            "displacement": f"{motion.pgd:.3g} m",
            "limit": f"{_FASTEST:g} m/s",
            "farthest": f"{_FARTHEST:g} m",
            "processing_field": helps,
        }
        raise InputError("motion-fast", field, f"{motion.pgv:.3g} m/s", name=motion.name, **quantities)


def check_pair(horizontal: GroundMotion, vertical: GroundMotion, field: str | None = None) -> tuple[Notice, ...]:
    """Return a warning where the files of two components are of different earthquakes or stations, or where they do not
    tell and the lengths or steps differ. `field` is that of the second, where it is not the vertical one."""
    if not {horizontal.format, vertical.format}.isdisjoint({"points", "synthetic"}):
        return ()
    texts = {name: (getattr(horizontal, name), getattr(vertical, name)) for name in ("date", "event", "station")}
    years = [_YEAR.findall(f"{motion.date} {motion.event}") for motion in (horizontal, vertical)]
    if all(years) and set(years[0]).isdisjoint(years[1]):
        one, other = (f"{motion.event} {motion.date}".strip() for motion in (horizontal, vertical))
        return (Notice("components-differ", horizontal=one, vertical=other, field=field),)
    compared = 0
    for one, other in texts.values():
        # Formats differ in their words.
        if one and other and horizontal.format == vertical.format:
            if _bare(one) != _bare(other):
                return (Notice("components-differ", horizontal=one, vertical=other, field=field),)
            compared += 1
    if compared or all(years) or _alike(horizontal, vertical):
        return ()
    missing = [name for name, pair in texts.items() if not all(pair)] or ["words of two formats"]
    return (
        Notice(
            "components-unsure",
            why=Sentence.of(
                "{missing} could not be compared; they last {lengths_s:.4g s|and}, with steps of {steps_s:.3g s|and}",
                missing=", ".join(missing),
                lengths_s=(horizontal.duration, vertical.duration),
                steps_s=(horizontal.dt, vertical.dt),
            ),
            field=field,
        ),
    )


def check_lag(along: GroundMotion, cross: GroundMotion, field: str) -> tuple[Notice, ...]:
    """Return a warning where two horizontal components of records are one, or one shakes clearly later than the other,
    though both are to shake the dam together; `field` is that of the second."""
    if not {along.format, cross.format}.isdisjoint({"points", "synthetic"}):
        return ()
    if np.array_equal(along.acceleration, cross.acceleration):
        why = Sentence.of("it has the values of that: one component both ways shakes the dam along one line")
        return (Notice("components-unsure", why=why, field=field),)
    lag = lag_of(along, cross)
    if lag is None:
        return ()
    way = "after" if lag > 0.0 else "before"
    why = Sentence.of(
        "it shakes {lag_s:.3g s} {way} that, by the correlation of their sizes; cut the one that begins earlier",
        lag_s=abs(lag),
        way=way,
    )
    return (Notice("components-unsure", why=why, field=field),)


def _bare(text: str) -> str:
    return re.sub(r"\W", "", text).casefold()


def _alike(one: GroundMotion, other: GroundMotion) -> bool:
    """Whether two motions are as long as each other, but for a tenth, and have the same time step."""
    same_step = abs(one.dt - other.dt) <= 1e-6 * one.dt
    return same_step and abs(one.duration - other.duration) <= 0.1 * max(one.duration, other.duration)


def check_scaling(motion: GroundMotion, factor: float, field: str = "motion") -> tuple[Notice, ...]:
    """Return a warning where a record is made much stronger than it was; whatever was drawn or made may be."""
    if motion.format in ("points", "synthetic") or not factor > _MOST_SCALED:
        return ()
    return (Notice("motion-unlike-records", "scaled", field=field, name=motion.name, factor=factor, most=_MOST_SCALED),)


def check(
    motion: GroundMotion, gravity: float, *, allow_zero: bool = False, field: str = "motion"
) -> tuple[Notice, ...]:
    """Return what is suspicious about a motion that goes into an analysis.

    Parameters
    ----------
    motion
        The motion, processed, scaled and cut.
    gravity
        One g [m/s2].
    allow_zero
        Accept a motion that is zero throughout.
    field
        Where it stands in the case, for errors.

    Raises
    ------
    InputError
        Where it is zero or has hardly begun, or peaks beyond anything an earthquake does.
    """
    if motion.duration < _SHORTEST:
        raise InputError("motion-brief", field, f"{motion.duration:g} s", least=f"{_SHORTEST:g} s")
    peak = motion.pga / gravity
    if peak == 0.0:
        if allow_zero:
            return (Notice("motion-still", field=field, name=motion.name),)
        raise InputError("motion-zero", field, motion.name)
    if peak > _STRONGEST:
        raise InputError("motion-peak", field, f"{peak:.4g} g", name=motion.name)
    notices = []

    def say(code: str, kind: str = "", /, **quantities: float | Sentence) -> None:
        notices.append(Notice(code, kind, field=field, name=motion.name, **quantities))  # type: ignore[arg-type]

    if peak > 3.0:
        say(
            "motion-peak-unusual", peak=Sentence.of("{peak_g:.3g g}, more than any recorded ground motion", peak_g=peak)
        )
    if peak < 1e-3:
        say("motion-peak-unusual", peak=Sentence.of("{peak_g:.2g g} only", peak_g=peak))
    if motion.format != "points" and motion.pgv > 0.0 and abs(motion.end_velocity) > 0.2 * motion.pgv:
        say("motion-flaw", "drifts", share=abs(motion.end_velocity) / motion.pgv)
    return tuple(notices)

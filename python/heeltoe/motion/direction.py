"""Directions of horizontal components, and both of them rotated into along the stream and across the valley."""

from __future__ import annotations

import math
import re
from dataclasses import replace

from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import on_same_moments

# Directions are written in whole degrees: two that are this far from a right angle are not those of one instrument.
_OFF = math.radians(0.5)
# Fewer than three digits that end other words, as in "Channel 2", count something else.
_DEGREES = re.compile(
    r"(?:(?<![\w.])\d{3}(?:\.0*)?|^\s*\d{1,2}(?:\.0*)?|(?<![\w.])\d{1,2}(?:\.0*)?(?=\s*(?:deg|°)))"
    r"(?=\s*(?:deg\w*|°)?\s*(?:$|\())",
    re.IGNORECASE,
)
_BEARING = re.compile(r"\b([NS])\s*(\d{1,2}(?:\.\d+)?)\s*([EW])\b", re.IGNORECASE)
_WORDS = {
    **dict.fromkeys(("n", "ns", "n-s", "north", "north-south"), 0.0),
    **dict.fromkeys(("e", "ew", "e-w", "east", "east-west"), 90.0),
    **dict.fromkeys(("s", "sn", "s-n", "south", "south-north"), 180.0),
    **dict.fromkeys(("w", "we", "w-e", "west", "west-east"), 270.0),
}
_WORD = re.compile(r"\b(" + "|".join(sorted(_WORDS, key=len, reverse=True)) + r")\b", re.IGNORECASE)
_CODE = re.compile(r"\b[behl][hnl]([ne])\b", re.IGNORECASE)
# RSN6_IMPVALL-ELC180: three digits that end a name.
_ENDS = re.compile(r"(?<!\d)(\d{3})$")


def direction_of(motion: GroundMotion) -> float | None:
    """Return the direction in which a component counts positive, clockwise from north [rad]; None where neither its
    record nor its name states it."""
    of_record = _direction(motion.component)
    if of_record is not None:
        return of_record
    ends = _ENDS.search(motion.name)
    if ends is None or int(ends[1]) > 360:
        return None
    return math.radians(int(ends[1]))


def _direction(text: str) -> float | None:
    """Return the direction that the component of a record is called by: 180, S16E, N-S, HNE."""
    if match := _DEGREES.search(text):
        degrees = float(match[0])
        return math.radians(degrees) if degrees <= 360.0 else None
    if match := _BEARING.search(text):
        from_north = float(match[2]) * (1.0 if match[3].upper() == "E" else -1.0)
        return math.radians(from_north if match[1].upper() == "N" else 180.0 - from_north)
    if match := _WORD.search(text):
        return math.radians(_WORDS[match[1].lower()])
    if match := _CODE.search(text):
        return math.radians(_WORDS[match[1].lower()])
    return None


def rotated(
    one: GroundMotion, other: GroundMotion, directions: tuple[float, float], azimuth: float
) -> tuple[GroundMotion, GroundMotion]:
    """Return the motion along the stream and that across the valley, of two horizontal components.

    Parameters
    ----------
    one, other
        The components [m/s2], which begin together; where one has ended the ground stands still in its direction.
    directions
        Where each counts positive, clockwise from north, a right angle apart [rad].
    azimuth
        Where the stream goes, likewise [rad].

    Returns
    -------
    along, across
        Positive downstream and to the left bank, on the moments of both components.
    """
    end = max(one.duration, other.duration)
    time, first, second = on_same_moments([one, other], end)
    if time[-1] == time[-2]:
        # After its last value each record says nothing.
        time, first, second = time[:-1], first[:-1], second[:-1]
    turns = [direction - azimuth for direction in directions]
    along, across = (
        [_exact(function(turn)) for turn in turns] for function in (math.cos, lambda turn: -math.sin(turn))
    )
    step = f"rotated with the other component, of {{}}, to the stream at {math.degrees(azimuth):g} deg"
    return (
        replace(
            one,
            time=time,
            acceleration=along[0] * first + along[1] * second,
            processing=(*one.processing, step.format(other.name)),
        ),
        replace(
            other,
            time=time,
            acceleration=across[0] * first + across[1] * second,
            processing=(*other.processing, step.format(one.name)),
        ),
    )


def _exact(number: float) -> float:
    """Return a sine or cosine that is 0, 1 or -1 but for rounding as that, so that a right angle moves no digit."""
    return float(round(number)) if abs(number - round(number)) < 1e-14 else number


def check_right_angle(one: GroundMotion, directions: tuple[float, float], field: str) -> None:
    """Refuse the other component of `one` where the directions [rad] of both are not a right angle apart.

    Raises
    ------
    InputError
        For `field`, which is about that other component.
    """
    if abs(math.cos(directions[1] - directions[0])) > math.sin(_OFF):
        first, second = (f"{math.degrees(direction) % 360.0:.4g} deg" for direction in directions)
        raise InputError(
            "another-kind",
            field,
            second,
            wanted=f"90 deg from {first}, the direction of {one.name}",
            remedy="give the other horizontal component of the same instrument, or correct the direction",
        )

"""Exact slip of a sliding block, worked out without the kernel, to judge every competitor by.

A block that only slides has one velocity, which changes at a known rate: the drive (whatever pulls the block along
the plane, per mass) less friction. Between the moments at which slip starts, stops or turns round, velocity and slip
are antiderivatives of that rate. Two drives are needed: one that is linear between samples, and a constant with a
sine on it. Everything is done in the widest floating-point numbers the machine has, so that a competitor that is
exact to double precision can be seen to be so.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Wide = np.longdouble


def slip_one_way(drive: Floats, step: float, resistance: float) -> Floats:
    """Slip at every sample of a block that can slide only one way (Newmark's sliding block).

    Parameters
    ----------
    drive
        (n,) drive per mass at samples `step` apart, linear in between [m/s2].
    step
        Time between samples [s].
    resistance
        Drive at which the block yields, and deceleration by friction [m/s2].

    Returns
    -------
    ndarray
        (n,) slip [m].
    """
    excess = drive.astype(Wide) - Wide(resistance)
    length = Wide(step)
    slip = np.zeros(drive.size, dtype=Wide)
    velocity = distance = Wide(0)
    for k in range(drive.size - 1):
        rate = (excess[k + 1] - excess[k]) / length
        at, value = Wide(0), excess[k]
        # At rest until the excess turns positive, sliding until the velocity comes back to zero.
        while True:
            if velocity == 0 and value <= 0:
                if excess[k + 1] <= 0 or rate <= 0:
                    break
                at, value = at - value / rate, Wide(0)
            stop = _first_root(velocity, value, rate / 2)
            stops = stop is not None and stop < length - at
            time = stop if stops else length - at
            distance += time * (velocity + time * (value / 2 + time * rate / 6))
            velocity = Wide(0) if stops else velocity + time * (value + time * rate / 2)
            at, value = at + time, value + time * rate
            if not stops:
                break
        slip[k + 1] = distance
    return slip.astype(np.float64)


def _first_root(c0: Wide, c1: Wide, c2: Wide) -> Wide | None:
    """First root above zero of ``c0 + c1 t + c2 t^2``, which is positive right after zero."""
    if c0 == 0:
        return -c1 / c2 if c1 > 0 > c2 else None
    discriminant = c1 * c1 - 4 * c0 * c2
    if discriminant < 0:
        return None
    q = -(c1 + np.copysign(np.sqrt(discriminant), c1)) / 2
    roots = [r for r in (c0 / q, q / c2 if c2 != 0 else Wide(-1)) if r > 0]
    return min(roots, default=None)


def slip_push_and_sine(push: float, amplitude: float, frequency: float, friction: float, times: Floats) -> Floats:
    """Slip of a block under a constant push and a sine of the base, which can slide both ways.

    Parameters
    ----------
    push, amplitude
        Push per mass, amplitude of the ground acceleration ``amplitude sin(2 pi frequency t)`` [m/s2].
    frequency
        Of the sine [Hz].
    friction
        Friction force per mass [m/s2].
    times
        Ascending moments from zero on at which the slip is wanted [s].

    Returns
    -------
    ndarray
        Slip at the moments [m].
    """
    p, a, f = Wide(push), Wide(amplitude), Wide(friction)
    omega = 8 * np.arctan(Wide(1)) * Wide(frequency)

    def drive(t: Wide) -> Wide:
        return p - a * np.sin(omega * t)

    # A hundredth of a period is far shorter than the time between two events of these problems.
    stride = 1 / Wide(frequency) / 100
    start, sign = Wide(0), 0
    velocity_0 = slip_0 = Wide(0)

    def velocity(t: Wide) -> Wide:
        swing = a / omega * (np.cos(omega * t) - np.cos(omega * start))
        return velocity_0 + (p - sign * f) * (t - start) + swing

    def slip(t: Wide) -> Wide:
        past = t - start
        lean = velocity_0 - a / omega * np.cos(omega * start)
        swing = a / omega**2 * (np.sin(omega * t) - np.sin(omega * start))
        return slip_0 + past * (lean + (p - sign * f) * past / 2) + swing

    def holds(t: Wide) -> Wide:
        """Negative once the block no longer rests, or no longer slips the way it does."""
        return sign * velocity(t) if sign else f - abs(drive(t))

    result = np.empty(times.size, dtype=Wide)
    done, now = 0, Wide(0)
    while done < times.size:
        ahead = now + stride
        end = _fall(holds, now, ahead) if holds(ahead) < 0 else None
        reach = ahead if end is None else end
        while done < times.size and times[done] <= reach:
            t = Wide(times[done])
            result[done] = slip_0 if sign == 0 else slip(t)
            done += 1
        now = reach
        if end is None:
            continue
        slip_0 = slip_0 if sign == 0 else slip(end)
        velocity_0, start = Wide(0), end
        pull = drive(end)
        # A slip that stops under a drive beyond friction turns round at once; a start has the drive at its limit.
        sign = int(np.sign(pull)) if sign == 0 or abs(pull) > f else 0
    return result.astype(np.float64)


def _fall(function: Callable[[Wide], Wide], above: Wide, below: Wide) -> Wide:
    """Bisect for the moment at which the function falls below zero, to the last bit."""
    while True:
        middle = (above + below) / 2
        if middle in (above, below):
            return below
        if function(middle) < 0:
            below = middle
        else:
            above = middle

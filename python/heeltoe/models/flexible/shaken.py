"""A dam with its earthquake, run until the time step is small enough."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.models.flexible.modes import part_periods
from heeltoe.models.flexible.reduced import FlexibleDam
from heeltoe.models.flexible.step import longest_step
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground, step_ends, step_means

Floats = NDArray[np.float64]

#: A blow lasts about as long as the part above the crack takes for one vibration; the step is this part of it.
_STEPS_PER_PERIOD = 100.0


_SHORTEST_STEP, _LONGEST_STEP = 5e-5, 2e-4


#: What acts in the crack may ask for a shorter one, down to this.
_SHORTEST_OF_ALL = 1e-5


#: So closely the program's own step follows it, as from a sixteenth on the contact problem is next to singular; and so
#: closely at least a given one must.
_ENOUGH_STEPS, _FEWEST_STEPS = 30.0, 8.0


_HALVINGS = 2


#: By how much half the step may change the slip: more at a height, where the dam strikes and bounces.
_CHANGE_AT_BASE, _CHANGE_AT_HEIGHT = 0.03, 0.10


#: Slips that differ by less than this differ by nothing anyone could measure [m].
NOTHING = 1e-4


@dataclass(frozen=True)
class Convergence:
    """Evidence that the time step is small enough.

    Attributes
    ----------
    time_step
        Of the result [s].
    coarser_step
        That of the run it is compared with, twice as long [s].
    slip, coarser_slip
        Residual slips of both [m].
    allowed
        By how much of the slip they may differ.
    """

    time_step: float
    coarser_step: float
    slip: float
    coarser_slip: float
    allowed: float

    @property
    def change(self) -> float:
        """Difference over the slip, or over 0.1 mm where the slip is less than that says anything."""
        return abs(self.slip - self.coarser_slip) / max(abs(self.slip), NOTHING / self.allowed)

    @property
    def reached(self) -> bool:
        """Whether the difference is small enough."""
        return self.change <= self.allowed


# The tables that the kernel returns beside the summary: frames, positions above and below, forces, status, modes.
Frames = tuple[Floats, Floats, Floats, Floats, NDArray[np.uint8], Floats, Floats]


class Shaken:
    """A dam with its earthquake, ready to run at any step."""

    def __init__(
        self, case: Case, dam: FlexibleDam, motion: GroundMotion, vertical: GroundMotion | None, end: float
    ) -> None:
        self.case, self.dam, self.end = case, dam, end
        self.time, self.horizontal, self.up = ground(motion, vertical, end)

    def first_step(self) -> float:
        """Return the step of the case, or one that follows the vibration of the part above the crack [s].

        Raises
        ------
        InputError
            Where the step of the case is too long to follow it, or what acts in the crack is too stiff for any step.
        """
        period = float(part_periods(self.dam.modes[0], 1)[0])
        given = self.case.flexible.time_step
        shortest = max(_SHORTEST_OF_ALL, min(_SHORTEST_STEP, period / _ENOUGH_STEPS))
        wanted = given or float(np.clip(period / _STEPS_PER_PERIOD, shortest, _LONGEST_STEP))
        dam = self.dam
        step, field = longest_step(dam.parts, dam.water, dam.anchors, self.case.flexible.theta, wanted)
        if step < (wanted if given else _SHORTEST_OF_ALL):
            raise InputError("step-stiff", field, step=f"{step:.2g} s")
        if given is None:
            return step
        if given > period / _FEWEST_STEPS:
            raise InputError(
                "time-step-long", "flexible.time_step", f"{given:g} s", longest=f"{period / _FEWEST_STEPS:.2g} s"
            )
        return given

    def run(self, step: float, frame_step: float | None = None) -> tuple[Floats, Frames]:
        """Run at about this step, which is made to fit the duration [s]; with frames about every `frame_step`."""
        count = max(1, round(self.end / step))
        step = self.end / count
        options = self.case.flexible
        stride = 0 if frame_step is None else max(1, min(count, round(frame_step / step)))
        result = self.dam.kernel.run(
            self._ground(count), step, options.theta, stride, stride > 0, (1.0, 1.0), self._penalty()
        )
        return result[0], result[1:]

    def run_scaled(self, step: float, scales: Floats) -> dict[str, Floats]:
        """Run once for each factor on the ground motion, side by side; (n,) arrays by name."""
        count = max(1, round(self.end / step))
        pairs = [(float(scale), float(scale)) for scale in scales]
        rows = self.dam.kernel.run_many(
            self._ground(count), self.end / count, self.case.flexible.theta, pairs, 0, self._penalty()
        )
        return {name: rows[:, k] for k, name in enumerate(_kernel.CRACK_SUMMARY_FIELDS)}

    def _ground(self, count: int) -> Floats:
        """Return what the kernel needs to know of the ground in `count` steps."""
        series = step_ends if self.case.flexible.contact == "idce" else step_means
        return series(self.time, self.horizontal, self.up, count, self.end)

    def _penalty(self) -> tuple[float, float, float] | None:
        """Return stiffness, gamma and beta of the penalty method; None for exact contact."""
        options = self.case.flexible
        if options.contact != "idce":
            return None
        stiffest = max(float(body.stiffness.diagonal().max()) for body in self.dam.bodies)
        gamma, beta = options.newmark_gamma, options.newmark_beta
        return options.penalty_factor * stiffest, gamma, (gamma + 0.5) ** 2 / 4.0 if beta is None else beta


def converged(shaken: Shaken, frame_step: float) -> tuple[dict[str, float], Frames, Convergence | None]:
    """Run until half the step changes little, or once where no evidence is wanted."""
    case = shaken.case
    step = shaken.first_step()
    if not case.flexible.convergence_check:
        row, frames = shaken.run(step, frame_step)
        return _named(row), frames, None
    allowed = _CHANGE_AT_BASE if shaken.dam.dam.lower is None else _CHANGE_AT_HEIGHT
    # The kernel lets go of the interpreter: the longer run takes one core, the shorter the other.
    with ThreadPoolExecutor(2) as pool:
        coarse = pool.submit(shaken.run, step)
        row, frames = shaken.run(step / 2.0, frame_step)
        coarser = _named(coarse.result()[0])
    for halving in range(_HALVINGS + 1):
        raw = _named(row)
        evidence = Convergence(step / 2.0, step, raw["slip"], coarser["slip"], allowed)
        if evidence.reached or case.flexible.time_step is not None or halving == _HALVINGS:
            break
        step /= 2.0
        coarser = raw
        row, frames = shaken.run(step / 2.0, frame_step)
    return raw, frames, evidence


def _named(row: Floats) -> dict[str, float]:
    """Return the summary by name; the tensions of anchors with stiffness are counted from 0."""
    names = [*_kernel.CRACK_SUMMARY_FIELDS, *(f"tension_{k}" for k in range(len(row)))]
    return dict(zip(names, row.tolist(), strict=False))

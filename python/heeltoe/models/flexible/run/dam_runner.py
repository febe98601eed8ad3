"""A dam with its earthquake, ready to run at any step."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.kernel.dam import CrackedDam, DamRun, Ending
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.flexible.body.across import AcrossDam, across_dam
from heeltoe.models.flexible.body.cost import wave_bodies
from heeltoe.models.flexible.body.modes import part_periods
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.models.flexible.body.step import longest_step
from heeltoe.models.flexible.body.stress_places import StressRows
from heeltoe.models.flexible.body.uplift_and_anchors import rising_water
from heeltoe.models.runner import STEP
from heeltoe.motion.moments import cross_means, step_ends, step_means
from heeltoe.result.contract import JOINT_METER_M
from heeltoe.result.rest import LAST_S

#: Spacing of the frames of a run [s], where no other is wanted: enough for an animation, few enough for memory. Longer
#: steps make half of it, so that histories keep round moments.
FRAME_STEP = 0.01
_PART = FRAME_STEP / 2.0
#: A blow lasts about as long as the part above the crack takes for one vibration; the step is this part of it.
_STEPS_PER_PERIOD = 100.0
_SHORTEST_STEP, _LONGEST_STEP = 5e-5, 2e-4
#: The longest steps [s] of one crack on a rigid plane where single runs do not scatter (docs/flexible.md): at the base,
#: where a dam slides; above it, where it strikes, at this part of that vibration. By these laws of friction they are at
#: most so many times those of runs that scatter.
_LONGEST_AT_BASE, _LONGEST_ABOVE_BASE, _STEPS_ABOVE_BASE = _PART / 6, _PART / 12, 50.0
_SMOOTH_LAWS, _TIMES_BY_LAW = ("slip weakening", "speed weakening"), 2.0
#: Where waves surround the dam the step goes with the dam, and is this part of that vibration, at most the longest step
#: times the first of them over it: a small dam swings as fast as its waves, and similar dams have similar answers.
#: Where waves leave through damped rock, the second is enough; bonds, laws, penalties, and all where a vibration feeds
#: itself more, keep the first.
_STEPS_AMONG_WAVES = (400.0, 100.0)
#: What acts in the crack may ask for a shorter one, down to this.
_SHORTEST_OF_ALL = 1e-5
#: So closely the program's own step follows it, as from a sixteenth on the contact problem is next to singular; and so
#: closely at least a given one must.
_ENOUGH_STEPS, _FEWEST_STEPS = 30.0, 8.0
_TOO_FEW_STEPS = 16.0
#: Stresses are looked at about so often [s]; twice as often finds 1.3 % more at most (docs/flexible.md).
_STRESS_STEP = 2e-3
#: Pressures of water with sound are looked at about so often [s]: the pulse of a strike lasts a millisecond or two.
_PRESSURE_STEP = 5e-4
# A step need not be halved once more where it is longer by less than this part of two.
_ABOUT = 0.1
# A silence is a multiple of its parts where so little of one is left.
_FITS = 1e-9


def usual_step(case: Case, period: float) -> float:
    """Return a step [s] that follows a part above the crack of a case, of this longest period [s]."""
    step = short_step(case, period)
    # A neighbour is passed by the way of a step, and the lowest pressure of water with sound needs short ones.
    several = case.further_cracks or case.crack.kinks or case.crack.side_gap
    if several or wave_bodies(case) or not _is_plain(case, _SMOOTH_LAWS):
        return step
    steps, longest = _STEPS_PER_PERIOD, _LONGEST_AT_BASE
    if case.crack.elevation > 0.0:
        steps, longest = _STEPS_ABOVE_BASE, _LONGEST_ABOVE_BASE
    wanted = min(period / steps, longest)
    if case.crack.law is not None:
        wanted = min(wanted, _TIMES_BY_LAW * step)
    return _PART / math.ceil(_PART / max(step, wanted) - _FITS)


def short_step(case: Case, period: float) -> float:
    """Return the step [s] where single runs scatter, or a longer one moves them."""
    if wave_bodies(case):
        steps = _STEPS_AMONG_WAVES[_is_smooth(case)]
        longest = _LONGEST_STEP * _STEPS_AMONG_WAVES[0] / steps
        return float(np.clip(period / steps, _SHORTEST_OF_ALL, longest))
    shortest = max(_SHORTEST_OF_ALL, min(_SHORTEST_STEP, period / _ENOUGH_STEPS))
    return float(np.clip(period / _STEPS_PER_PERIOD, shortest, _LONGEST_STEP))


def _is_smooth(case: Case) -> bool:
    """Return whether waves leave through damped rock, and nothing in the cracks of a case asks for shorter steps."""
    rock = case.foundation
    if rock is None or not rock.radiation or rock.massless or not rock.damping:
        return False
    return _is_plain(case)


def _is_plain(case: Case, laws: tuple[str, ...] = ()) -> bool:
    """Whether nothing but friction acts in the cracks of a case, which does not change but by these laws."""
    plain = case.flexible.contact == "coulomb" and case.uplift.during_shaking == "constant"
    cracks = (case.crack, *case.further_cracks)
    return plain and all(crack.bond is None and (crack.law is None or crack.law.name in laws) for crack in cracks)


class Pauses(NamedTuple):
    """Silence after a motion: `steps` between two checks whether the dam is at rest, `times` over."""

    steps: int
    times: int


@dataclass(frozen=True, eq=False)
class ShakenDam:
    """A dam with its earthquake, ready to run at any step."""

    case: Case
    dam: FlexibleDam
    shaking: Shaking

    def first_step(self) -> float:
        """Return the step of the case, or one that follows the vibration of the part above the crack [s].

        Raises
        ------
        InputError
            Where the step of the case is too long to follow it, or what acts in the crack is too stiff for any step.
        """
        period = self._period()
        stated = self.case.flexible.time_step
        wanted = stated or usual_step(self.case, period)
        step, field = self._followed(wanted)
        if step < (wanted if stated else _SHORTEST_OF_ALL):
            raise InputError("step-stiff", field, step=f"{step:.2g} s")
        if stated is None:
            return step
        if stated > period / _FEWEST_STEPS:
            raise InputError(
                "time-step-long", "flexible.time_step", f"{stated:g} s", longest=f"{period / _FEWEST_STEPS:.2g} s"
            )
        return stated

    @cached_property
    def halvings(self) -> int:
        """How often the first step is halved where single runs scatter, or a longer step moves them."""
        if self.case.flexible.time_step is not None:
            return 0
        longer = self.first_step() / short_step(self.case, self._period())
        return max(0, math.ceil(math.log2(longer) - _ABOUT))

    def _period(self) -> float:
        """Return the longest period of the part above a crack that vibrates fastest [s]."""
        return min(float(part_periods(modes, 1)[0]) for modes in self.dam.modes[: self.dam.free])

    def may_step(self, step: float) -> bool:
        """Whether a step [s] still follows the dam and what acts in its crack, so that a run can be compared."""
        period = self._period()
        followed, _ = self._followed(step)
        return step <= min(followed, period / _TOO_FEW_STEPS, self.shaking.end / 2.0)

    def step_beside(self, step: float) -> float:
        """Return the step [s] of a run that is compared with one at `step`, and has no uncertainty of its own: twice of
        it where that moves slips little (docs/flexible.md)."""
        smooth = self.case.flexible.time_step is None and _is_smooth(self.case)
        return 2.0 * step if smooth and self.may_step(2.0 * step) else step

    def run(
        self,
        step: float,
        frame_step: float | None = None,
        ending: Ending | None = None,
        factor: float = 1.0,
        *,
        stresses: bool = True,
        pauses: Pauses | None = None,
    ) -> DamRun:
        """Run at about this step, made to fit the duration [s], with the ground motion multiplied by `factor`; with
        frames about every `frame_step`, and with them the extremes of the `stresses` and of the pressures of the water;
        with `pauses`, on through silence until the dam is at rest."""
        count, step, ground = self._ground(step)
        across = self._across_means(step, ground)
        if pauses is not None:
            silence = pauses.times * pauses.steps
            ground = np.vstack([ground, np.zeros((silence, 2))])
            across = None if across is None else np.append(across, np.zeros(silence))
        stride, rows, wet, crest = 0, None, None, None
        if frame_step is not None:
            stride = max(1, min(count, round(frame_step / step)))
            crest = self._crest_row
        if frame_step is not None and stresses:
            often = [max(1, round(min(spacing, frame_step) / step)) for spacing in (_STRESS_STEP, _PRESSURE_STEP)]
            rows = StressRows(tuple(item.rows for item in self.dam.stress_places), often[0])
            water = self.dam.reservoir
            wet = None if water is None else StressRows((water.wet_rows,), often[1])
        return self._shaken_dam.run(
            factor * ground,
            step,
            self.case.flexible.theta,
            stride=stride,
            stresses=rows,
            pressures=wet,
            crest=crest,
            penalty=self._penalty(),
            ending=ending,
            until_rest=None if pauses is None else (count, pauses.steps, LAST_S, JOINT_METER_M),
            across=None if across is None else factor * across,
            crest_across=None if self.across is None else self.across.crest,
        )

    def pauses(self, step: float, seconds: float, longest: float) -> Pauses | None:
        """Return how a run at about this step goes on through up to `longest` [s] of silence, `seconds` at a time, in
        whole steps; None where it is no multiple of them, or the motion is taken at the ends of steps."""
        _, step = _steps(self.shaking, step)
        count = longest / seconds
        if abs(count - round(count)) > _FITS or self.case.flexible.contact == "idce":
            return None
        return Pauses(round(seconds / step), round(count))

    def run_scaled(
        self, step: float, scales: Floats, ending: Ending | None = None, threads: int = 0
    ) -> dict[str, Floats]:
        """Run once for each factor on the ground motion, side by side; (n,) arrays by name, of the crack asked of."""
        return self.run_scaled_cracks(step, scales, ending, threads)[self.dam.asked]

    def run_scaled_cracks(
        self, step: float, scales: Floats, ending: Ending | None = None, threads: int = 0
    ) -> tuple[dict[str, Floats], ...]:
        """Return the same for each crack."""
        _, step, ground = self._ground(step)
        pairs = np.column_stack([scales, scales])
        theta = self.case.flexible.theta
        return self._shaken_dam.run_many(
            ground,
            step,
            theta,
            pairs,
            threads=threads,
            penalty=self._penalty(),
            ending=ending,
            across=self._across_means(step, ground),
        )

    @cached_property
    def _crest_row(self) -> Floats:
        """How far each mode of the part at the crest moves its upstream edge downstream."""
        row = 2 * int(self.dam.bodies[0].mesh.upstream[-1])
        return np.ascontiguousarray(self.dam.modes[0].shapes[row])

    @cached_property
    def _shaken_dam(self) -> CrackedDam:
        dam, drainage = self.dam, self.shaking.drainage
        # The drainage follows the slip of the only crack.
        under = dam.kernel.under(rising_water(self.case, 0, dam.faces(0), dam.rock, drainage))
        if self.across is None:
            return under
        return under.crossed(self.across.parts, self.case.crack.side_gap or (math.inf, math.inf))

    @cached_property
    def across(self) -> AcrossDam | None:
        """The dam across the valley; None where the ground does not shake that way."""
        cross = self.shaking.cross
        return None if cross is None or not cross.any() else across_dam(self.case, self.dam)

    def _followed(self, step: float) -> tuple[float, str]:
        """Return a step [s], this or a shorter one, that follows what acts in the cracks, and the field that asks for
        it."""
        across = () if self.across is None else self.across.parts
        return longest_step(self.dam, self.case.flexible.theta, step, across)

    def _across_means(self, step: float, ground: Floats) -> Floats | None:
        """Return the ground's mean acceleration across the valley in each step [m/s2], silence at the end included."""
        if self.across is None:
            return None
        shaking = self.shaking.before or self.shaking
        means = np.zeros(len(ground))
        count = round(shaking.end / step)
        means[:count] = cross_means(shaking, count)
        return means

    def _ground(self, step: float) -> tuple[int, float, Floats]:
        """Return the number of steps of about this length in the whole run, their length [s], and the kernel's input
        for the ground in them. Silence after a motion leaves the steps before it unchanged: it lasts whole steps, each
        of its parts of :data:`~heeltoe.models.runner.STEP` as many."""
        shaking, before = self.shaking, self.shaking.before
        if self.case.flexible.contact == "idce":
            count, step = _steps(shaking, step)
            return count, step, step_ends(shaking, count)
        if before is not None:
            count, short = _steps(before, step)
            parts = (shaking.end - before.end) / STEP
            whole = abs(parts - round(parts)) < _FITS
            silent = round(parts) * round(STEP / short) if whole else round((shaking.end - before.end) / short)
            return count + silent, short, np.vstack([step_means(before, count), np.zeros((silent, 2))])
        count, step = _steps(shaking, step)
        return count, step, step_means(shaking, count)

    def _penalty(self) -> tuple[float, float, float] | None:
        """Return stiffness, gamma and beta of the penalty method; None for exact contact."""
        options = self.case.flexible
        if options.contact != "idce":
            return None
        stiffest = max(float(body.stiffness.diagonal().max()) for body in self.dam.bodies)
        gamma, beta = options.newmark_gamma, options.newmark_beta
        return options.penalty_factor * stiffest, gamma, (gamma + 0.5) ** 2 / 4.0 if beta is None else beta


def _steps(shaking: Shaking, step: float) -> tuple[int, float]:
    """Return how many steps of about this length make a motion, and their length [s]."""
    count = max(1, round(shaking.end / step))
    return count, shaking.end / count

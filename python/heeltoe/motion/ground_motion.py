"""Ground motion: acceleration that is linear between moments, with where it comes from and what was done to it."""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from heeltoe.base.arrays import Floats, median
from heeltoe.base.display import Shown
from heeltoe.base.frozen import ReadOnlyArrays
from heeltoe.base.pandas import dataframe
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.warnings.notice import Notice

#: The warning of a record that stands as its instrument gave it; what corrects it takes it away.
UNCORRECTED = "record-uncorrected"
# How the step of processing that ends a motion early begins.
_CUT = "cut to "
# Of a refined motion: days of shaking at a thousandth of a second, and still within memory.
_MOST_SAMPLES = 5e7
# Kinds of arrays without numbers, by NumPy's letters.
_KINDS = {"M": "dates", "m": "NumPy's durations", "c": "complex numbers", "b": "truth values", "U": "words"}
#: No acceleration of a record is larger [m/s2], nor any time [s]; numbers of several runs multiply them.
LARGEST_VALUE = 1e12


def integrals(time: Floats, acceleration: Floats) -> tuple[Floats, Floats]:
    """Return velocity and displacement from rest under an acceleration that is straight between moments, exactly."""
    h = np.diff(time)
    a0, a1 = acceleration[:-1], acceleration[1:]
    v = np.concatenate([[0.0], np.cumsum(h * (a0 + a1) / 2.0)])
    d = np.concatenate([[0.0], np.cumsum(h * v[:-1] + h**2 * (2.0 * a0 + a1) / 6.0)])
    return v, d


@dataclass(frozen=True)
class Part:
    """One motion of a sequence.

    Attributes
    ----------
    name
        What it is called by itself.
    begins, ends
        From when to when it shakes the dam [s].
    pga
        Its peak, without sign [m/s2].
    processing
        What was done to it.
    """

    name: str
    begins: float
    ends: float
    pga: float
    processing: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class GroundMotion(Shown, ReadOnlyArrays):
    """An immutable ground acceleration.

    Attributes
    ----------
    name
        What it is called in every output: file stem or catalogue name.
    time
        (n,) moments [s], from zero, not decreasing; a repeated moment is a jump. Steps may differ.
    acceleration
        (n,) acceleration [m/s2]; horizontal is positive downstream, vertical positive upward.
    event, station, component, date, channel, format, units_as_read, source
        What the file says about itself; empty where it does not.
    processing
        What the file says was done, and all that was done here.
    warnings
        What a reader of any result with this motion must know.
    lead
        What a filter has put before the first value of the record [s]; components of one earthquake go together by it.
    parts
        The motions that it is made of, one after the other; none of a single one.
    begins
        When the first value of the record was taken, by the clock of its file [s since 1970]; None where it does not
        state it.
    """

    name: str
    time: Floats
    acceleration: Floats
    event: str = ""
    station: str = ""
    component: str = ""
    date: str = ""
    channel: str = ""
    format: str = ""
    units_as_read: str = ""
    source: str = ""
    processing: tuple[str, ...] = ()
    warnings: tuple[Notice, ...] = ()
    lead: float = 0.0
    parts: tuple[Part, ...] = ()
    begins: float | None = None

    def __post_init__(self) -> None:
        for name in ("time", "acceleration"):
            values = self._numbers(name)
            if values.flags.writeable:
                values = values.copy()
                values.flags.writeable = False
            object.__setattr__(self, name, values)
        t, a = self.time, self.acceleration
        if t.ndim != 1 or t.shape != a.shape or t.size < 2:
            raise InputError("too-few", self.name, f"{min(t.size, a.size)} samples", least="two")
        if not (np.isfinite(t).all() and np.isfinite(a).all()):
            bad = int(np.flatnonzero(~(np.isfinite(t) & np.isfinite(a)))[0])
            value = t[bad] if np.isfinite(a[bad]) else a[bad]
            raise InputError("motion-not-finite", self.name, str(value), number=bad + 1)
        if (np.diff(t) < 0.0).any():
            bad = int(np.flatnonzero(np.diff(t) < 0.0)[0])
            raise InputError("motion-order", self.name, f"{t[bad + 1]:g} s", before=f"{t[bad]:g} s")
        if t[-1] == t[0]:
            raise InputError("too-few", self.name, "1 sample", least="two")
        if t[0] != 0.0:
            shifted = t - t[0]
            shifted.flags.writeable = False
            object.__setattr__(self, "time", shifted)
            object.__setattr__(self, "processing", (*self.processing, f"time counted from {t[0]:g} s"))

    def _numbers(self, name: str) -> Floats:
        """Return times or accelerations as an array of numbers.

        Raises
        ------
        InputError
            Where they are none, some are masked, or one is beyond all motions of the ground.
        """
        given = getattr(self, name)
        # Where nothing has loaded masked arrays, which takes a while, there is none.
        if "numpy.ma" in sys.modules and np.ma.is_masked(given):
            bad = int(np.flatnonzero(np.ma.getmaskarray(given))[0])
            raise InputError("motion-not-finite", self.name, f"{name}, masked", number=bad + 1)
        values = np.asarray(given)
        if values.dtype.kind == "O":
            values = np.asarray(values.tolist())
        if values.dtype.kind not in "iuf":
            kind = _KINDS.get(values.dtype.kind, "no numbers")
            raise InputError("motion-no-numbers", self.name, name, kind=kind)
        values = np.ascontiguousarray(values, dtype=np.float64)
        beyond = np.flatnonzero(np.isfinite(values) & (np.abs(values) > LARGEST_VALUE))
        if beyond.size:
            raise InputError("motion-peak", self.name, f"{values.flat[beyond[0]]:.4g}", name=f"its {name}")
        return values

    def __repr__(self) -> str:
        ways = "".join(f", {plain(text)}" for text in (self.event, self.component) if text)
        return (
            f"<GroundMotion {plain(self.name)}{ways}: peak {self.pga:.4g} m/s2, "
            f"{self.duration:.4g} s in {self.time.size} samples>"
        )

    def to_pandas(self) -> Any:
        """Return time [s] and acceleration [m/s2] as a ``pandas.DataFrame``."""
        return dataframe({"time_s": self.time, "acceleration_m_s2": self.acceleration})

    @classmethod
    def from_points(cls, time: ArrayLike, acceleration: ArrayLike, *, name: str = "points") -> GroundMotion:
        """Make a motion of moments [s] and accelerations [m/s2], straight in between."""
        return cls(name, time, acceleration)  # type: ignore[arg-type]

    @cached_property
    def duration(self) -> float:
        """Length [s]."""
        return float(self.time[-1])

    @cached_property
    def dt(self) -> float:
        """Median step [s], jumps left out."""
        steps = np.diff(self.time)
        # The mean of equal steps has less rounding than any one of them.
        return self.duration / steps.size if self.is_uniform else median(steps[steps > 0.0])

    @cached_property
    def is_uniform(self) -> bool:
        """Whether all steps are equal, to a millionth."""
        steps = np.diff(self.time)
        return bool(np.allclose(steps, self.duration / steps.size, rtol=1e-6, atol=0.0))

    @cached_property
    def pga(self) -> float:
        """Peak ground acceleration, without sign [m/s2]."""
        return float(np.abs(self.acceleration).max())

    @property
    def peak(self) -> tuple[float, float]:
        """Time [s] and value [m/s2] of the largest acceleration, with its sign."""
        k = int(np.abs(self.acceleration).argmax())
        return float(self.time[k]), float(self.acceleration[k])

    @property
    def pgv(self) -> float:
        """Peak ground velocity from rest [m/s], exact for straight pieces."""
        return self._integrals[0]

    @property
    def pgd(self) -> float:
        """Peak ground displacement from rest [m], exact for straight pieces."""
        return self._integrals[1]

    @property
    def end_velocity(self) -> float:
        """Velocity at the end, from rest [m/s]; a record that is not corrected for its baseline keeps some."""
        return self._integrals[2]

    @cached_property
    def _integrals(self) -> tuple[float, float, float]:
        """PGV, PGD and end velocity; extremes lie at samples or where their derivative changes sign inside a piece.

        Of a sequence they are the largest of any of its motions, each from rest: the ground does not drift on between
        two earthquakes.
        """
        if self.parts:
            of_parts = [self._of(part)._integrals for part in self.parts]
            return max(peaks[0] for peaks in of_parts), max(peaks[1] for peaks in of_parts), of_parts[-1][2]
        v, d = integrals(self.time, self.acceleration)
        h = np.diff(self.time)
        a0, a1 = self.acceleration[:-1], self.acceleration[1:]
        crosses = a0 * a1 < 0.0
        s = h[crosses] * a0[crosses] / (a0[crosses] - a1[crosses])
        between = v[:-1][crosses] + s * a0[crosses] / 2.0
        pgv = max(np.abs(v).max(), np.abs(between).max(initial=0.0))
        # Inside a piece v(s) = v0 + a0 s + (a1 - a0) s^2 / (2 h); its roots are the turning points of d.
        moving = h > 0.0
        h, a0, a1, v0, d0 = h[moving], a0[moving], a1[moving], v[:-1][moving], d[:-1][moving]
        c = (a1 - a0) / (2.0 * h)
        root = np.sqrt(np.maximum(a0**2 - 4.0 * c * v0, 0.0))
        q = -0.5 * (a0 + np.copysign(root, a0))
        pgd = float(np.abs(d).max())
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            candidates = (q / c, v0 / q)
        for candidate in candidates:
            inside = np.isfinite(candidate) & (candidate > 0.0) & (candidate < h)
            s = candidate[inside]
            at = d0[inside] + s * (v0[inside] + s * (a0[inside] / 2.0 + s * c[inside] / 3.0))
            pgd = max(pgd, float(np.abs(at).max(initial=0.0)))
        return float(pgv), pgd, float(v[-1])

    def _of(self, part: Part) -> GroundMotion:
        """Return one of the motions of a sequence by itself."""
        here = self.part_slice(part)
        return GroundMotion(part.name, self.time[here], self.acceleration[here])

    def part_slice(self, part: Part) -> slice:
        """Return which moments are those of one of the motions of a sequence."""
        first, last = np.searchsorted(self.time, part.begins), np.searchsorted(self.time, part.ends, side="right")
        return slice(int(first), int(last))

    @property
    def all_processing(self) -> str:
        """Processing of the motion in words; for a sequence, of each of its motions, one after the other."""
        done = "; ".join(self.processing)
        of_parts = ["; ".join(part.processing) for part in self.parts]
        if any(of_parts):
            done = "; then ".join([*([done] if done else []), *(text or "none" for text in of_parts)])
        return done

    def scaled(self, factor: float, note: str = "") -> GroundMotion:
        """Return the motion times `factor`."""
        step = note or f"scaled by {factor:.6g}"
        with np.errstate(over="ignore", invalid="ignore"):  # what is beyond all numbers is refused as none
            acceleration = self.acceleration * factor
        return replace(self, acceleration=acceleration, processing=(*self.processing, step))

    def scaled_to(self, pga: float, note: str = "") -> GroundMotion:
        """Return the motion scaled to a peak of `pga` [m/s2]."""
        if self.pga == 0.0:
            raise InputError("motion-zero", self.name)
        factor = pga / self.pga
        return self.scaled(factor, note or f"scaled by {factor:.6g} to a peak of {pga:.6g} m/s2")

    def reversed(self) -> GroundMotion:
        """Return the motion with the other sign."""
        return replace(self, acceleration=-self.acceleration, processing=(*self.processing, "sign reversed"))

    def cut(self, duration: float) -> GroundMotion:
        """Return the first `duration` [s], with a last sample right there; a shorter motion is returned unchanged."""
        if duration >= self.duration:
            return self
        keep = self.time < duration
        # Up to the first sample not before the cut: at a jump the record ends with the value before it.
        until = int(np.searchsorted(self.time, duration)) + 1
        last = np.interp(duration, self.time[:until], self.acceleration[:until])
        result = replace(
            self,
            time=np.append(self.time[keep], duration),
            acceleration=np.append(self.acceleration[keep], last),
            processing=(*self.processing, f"{_CUT}{duration:g} s"),
        )
        if result.pga < 0.999 * self.pga:
            lost = Notice("motion-cut", duration_s=duration, time_s=self.peak[0])
            result = replace(result, warnings=(*result.warnings, lost))
        return result

    def corrected(self) -> GroundMotion:
        """Return the motion without the warning that its record is uncorrected."""
        return replace(self, warnings=tuple(notice for notice in self.warnings if notice.code != UNCORRECTED))

    def led_by(self, lead: float) -> GroundMotion:
        """Return the motion with the ground at rest before it, so that its record begins `lead` [s] after its start."""
        return replace(self.after_rest(lead - self.lead, "to go with the other component"), lead=max(lead, self.lead))

    def after_rest(self, more: float, why: str) -> GroundMotion:
        """Return the motion with the ground at rest for `more` [s] before it, for a reason in words; unchanged where
        that is not positive."""
        if more <= 0.0:
            return self
        at_rest = [0.0] if self.acceleration[0] == 0.0 else [0.0, 0.0]
        time = np.concatenate([[0.0] if len(at_rest) == 1 else [0.0, more], self.time + more])
        step = f"{more:.4g} s of rest before it, {why}"
        return replace(
            self,
            time=time,
            acceleration=np.concatenate([at_rest, self.acceleration]),
            processing=(*self.processing, step),
            begins=None if self.begins is None else self.begins - more,
        )

    @property
    def is_cut(self) -> bool:
        """Whether the record goes on where the motion ends."""
        return bool(self.processing) and self.processing[-1].startswith(_CUT)

    def resampled(self, step: float) -> GroundMotion:
        """Return the motion at a finer step [s].

        Refining is exact, since the motion is straight between its moments: `step` must divide every step of the
        record; jumps stay. Coarsening would change the motion and is refused; no analysis here needs it.

        Raises
        ------
        InputError
            Where `step` would lie about the motion.
        """
        steps = np.diff(self.time)
        ratio = np.where(steps > 0.0, steps / step, 1.0) if step > 0.0 else np.zeros(1)
        whole = np.rint(ratio)
        if (whole < 1.0).any() or (np.abs(ratio - whole) > 1e-6 * whole).any():
            raise InputError("motion-resample", self.name, f"{step:g} s", step=f"{self.dt:g} s")
        if whole.sum() > _MOST_SAMPLES:
            raise InputError(
                "too-many",
                self.name,
                f"{whole.sum():.3g} samples, by a step of {step:g} s,",
                most=f"{_MOST_SAMPLES:.3g}",
            )
        count = whole.astype(int)
        share = np.concatenate([np.arange(n) / n for n in count])
        start = np.repeat(np.arange(count.size), count)
        time = self.time[start] + share * steps[start]
        values = self.acceleration[start] + share * np.diff(self.acceleration)[start]
        return replace(
            self,
            time=np.append(time, self.time[-1]),
            acceleration=np.append(values, self.acceleration[-1]),
            processing=(*self.processing, f"refined to a step of {step:g} s"),
        )

    def with_warnings(self, *warnings: Notice) -> GroundMotion:
        """Return the motion with more warnings."""
        return replace(self, warnings=(*self.warnings, *warnings)) if warnings else self

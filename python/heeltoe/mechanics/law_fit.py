"""Friction laws from shear tests: parameters with their intervals, and which law the tests bear out.

Least squares by SciPy, of the shear stress (the strength) or of its ratio to the normal stress (a fall with slip or
speed). Laws of the strength compete by the corrected information criterion of Akaike. A fall must be significant by
itself: its test does not need the way or speed of the fall, which no data hold where there is none.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated

import numpy as np
from scipy.optimize import curve_fit
from scipy.stats import spearmanr, t, ttest_1samp

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number
from heeltoe.case.crack.law import Law
from heeltoe.errors.error import InputError
from heeltoe.kernel.friction import shear_stress
from heeltoe.mechanics.friction import law_of
from heeltoe.mechanics.shear_tests import Curve, ShearTest
from heeltoe.units.sentences import Sentence

#: Probability that an interval or band covers what it is of.
COVERED = 0.95
#: A fall that is not there is found with this probability.
FALSE_FALL = 0.05
# Between laws whose criteria differ by less, the one with fewer parameters is taken (Burnham and Anderson 2002).
_ALIKE = 2.0
_MPA = 1e6
_FEW_SPEEDS, _FEW_PAIRS = 3, 3
_BAND_POINTS = 61
# Places at which two lines may meet.
_BREAKS = 200
_SMOOTHEST, _ROUGHEST = 0.01, 20.0
# From peak, fall and way to peak, residual and way.
_TURN = np.array([[1.0, 0.0, 0.0], [1.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
_FALL = (("peak_friction", "", False), ("residual_friction", "", False))

_Strength = Callable[..., Floats]


class Parameter(Block):
    """A number of a law."""

    name: Annotated[str, Number("Name of the number, as `[crack.law]` has it where it has one.")]
    value: Annotated[float, Number("Best estimate, SI.")]
    low: Annotated[float, Number("Lower end of its interval of 95 %.")]
    high: Annotated[float, Number("Upper end of its interval of 95 %.")]
    unit: Annotated[str, Number("Its unit; empty of coefficients.")]


class Band(Block):
    """The law with the band in which the next test lies."""

    at: Annotated[list[float], Number("Normal stress [Pa], slip [m] or speed [m/s].")]
    best: Annotated[list[float], Number("Apparent friction there: shear stress over normal stress.")]
    low: Annotated[list[float], Number("Lower end of the band in which 95 % of further tests lie.")]
    high: Annotated[list[float], Number("Upper end of it.")]


class LawFit(Block):
    """A law with the numbers that fit the tests best."""

    law: Annotated[str, Number("Name of the law.")]
    over: Annotated[str, Number('Its argument: "normal stress", "slip path" or "slip speed".')]
    points: Annotated[int, Number("Tests, or points of curves, that it was fitted to.")] = 0
    parameters: Annotated[list[Parameter], Number("Its numbers.")] = field(default_factory=list)
    covariance: Annotated[
        list[list[float]],
        Number("Covariance of its numbers, stresses in MPa, of `jcs`, `slip` and `speed` of their natural logarithms."),
    ] = field(default_factory=list)
    residuals: Annotated[list[float], Number("Measured less fitted apparent friction of each test.")] = field(
        default_factory=list
    )
    scatter: Annotated[float, Number("Standard deviation about the law: shear stress [Pa], or apparent friction.")] = (
        0.0
    )
    criterion: Annotated[
        float | None, Number("Corrected information criterion of Akaike; null where the tests are too few for it.")
    ] = None
    chosen: Annotated[bool, Number("Whether the tests bear this law out best.")] = False
    why: Annotated[str, Number("Why it was or was not chosen.")] = ""
    band: Annotated[Band | None, Number("The law and the band of further tests; null where it was not fitted.")] = None


class Fall(Block):
    """Whether the friction falls."""

    by: Annotated[str, Number('By what: "slip" or "speed".')]
    tests: Annotated[int, Number("Tests that say so.")]
    found: Annotated[bool, Number("Whether it falls.")]
    probability: Annotated[float, Number("Probability of such a fall among tests of a friction that does not fall.")]
    friction: Annotated[float, Number("Mean fall of the apparent friction between the first and the last.")]


class LawFits(Block):
    """Friction of a joint by shear tests."""

    tests: Annotated[int, Number("Tests.")]
    used: Annotated[int, Number("Tests that were fitted: of specimens with several stages the first stages alone.")]
    specimens: Annotated[int, Number("Specimens.")]
    normal_stress_pa: Annotated[float, Number("Median normal stress of the tests.", "Pa")]
    friction: Annotated[float, Number("Apparent friction of the chosen law of the strength at that stress.")]
    low: Annotated[float, Number("Lower end of the band of further tests there.")]
    high: Annotated[float, Number("Upper end of it.")]
    fits: Annotated[list[LawFit], Number("The laws.")]
    falls: Annotated[list[Fall], Number("Whether the friction falls by slip or speed, where the tests can say.")]
    notes: Annotated[list[Sentence], Number("Remarks on the tests.")]
    crack: Annotated[str, Number("The friction as a block of a case file.")]

    @property
    def strength(self) -> LawFit:
        """The chosen law of the strength."""
        return next(fit for fit in self.fits if fit.chosen and fit.over == "normal stress")


def fit_laws(tests: Sequence[ShearTest]) -> LawFits:
    """Fit every law to shear tests, and choose.

    Parameters
    ----------
    tests
        Of one joint.

    Raises
    ------
    InputError
        Where too few of the tests have a strength.
    """
    notes = list(_stage_notes(tests))
    used = [test for test in tests if test.stage == 1] if notes else list(tests)
    strength = _strength_fits(used)
    chosen = next(fit for fit in strength if fit.chosen)
    falls, fits = _falls(used)
    residual = _residual_friction(used)
    fallen = any(fall.by == "slip" and fall.found for fall in falls)
    if fallen and residual is not None:
        notes.append(Sentence.of(_RESIDUAL, friction=f"{residual:.3f}"))
    notes += _size_notes(used, chosen)
    sigma = float(np.median([test.normal_pa for test in used]))
    assert chosen.band is not None
    best, low, high = (
        float(np.interp(sigma, chosen.band.at, values))
        for values in (chosen.band.best, chosen.band.low, chosen.band.high)
    )
    every = [*strength, *fits]
    return LawFits(
        tests=len(tests),
        used=len(used),
        specimens=len({test.specimen for test in tests}),
        normal_stress_pa=sigma,
        friction=best,
        low=max(low, 0.0),
        high=high,
        fits=every,
        falls=falls,
        notes=notes,
        crack=_crack_block(every, residual if fallen else None, (best, max(low, 0.0), high), sigma),
    )


# --- strength over the normal stress


@dataclass(frozen=True)
class _Rows:
    """Strengths [MPa] over normal stresses [MPa]: peaks, behind them residual strengths that a law may use."""

    normal: Floats
    shear: Floats
    peaks: int


def _strength_fits(tests: Sequence[ShearTest]) -> list[LawFit]:
    """Return the laws of the peak strength, of the residual one where the tests have no peak."""
    has_peak = [test for test in tests if not math.isnan(test.peak_pa)]
    strongest = has_peak or list(tests)
    normal = np.array([test.normal_pa for test in strongest]) / _MPA
    shear = np.array([test.peak_pa if has_peak else test.residual_pa for test in strongest]) / _MPA
    if shear.size < 3:
        raise InputError("too-few", "tests", f"{shear.size} tests with a strength", least=3)
    rows = _Rows(normal, shear, shear.size)
    fits = [_constant(rows), _coulomb(rows), _patton(rows), _barton(rows, tests if has_peak else ())]
    able = [fit for fit in fits if fit.criterion is not None]
    if not able:
        return [replace(fits[0], chosen=True, why="chosen: the tests are too few to compare laws"), *fits[1:]]
    least = min(fit.criterion for fit in able if fit.criterion is not None)
    near = [fit for fit in able if fit.criterion is not None and fit.criterion <= least + _ALIKE]
    best = min(near, key=lambda fit: (len(fit.parameters), fit.criterion))
    return [_judged(fit, best, least) for fit in fits]


def _judged(fit: LawFit, best: LawFit, least: float) -> LawFit:
    """Return a fit with why it was or was not chosen."""
    if fit.criterion is None:
        return fit
    above = fit.criterion - least
    if fit is best:
        simplest = "" if above == 0.0 else f", the simplest of those within {_ALIKE:g} of the least"
        return replace(fit, chosen=True, why=f"chosen: criterion {fit.criterion:.1f}{simplest}")
    if above <= _ALIKE:
        return replace(fit, why=f"not chosen: it has more parameters, and its criterion gains less than {_ALIKE:g}")
    return replace(fit, why=f"not chosen: its criterion is {above:.1f} above the least")


def _constant(rows: _Rows) -> LawFit:
    names = [("friction", "", False)]
    return _fit("constant", rows, lambda s, mu: mu * s, [1.0], ([0.0], [10.0]), names)


def _coulomb(rows: _Rows) -> LawFit:
    if np.unique(rows.normal).size < 2:
        return _unfitted("cohesion", "normal stress", "all tests have the same normal stress")
    names = [("residual_friction", "", False), ("cohesion", "Pa", False)]
    slope, intercept = np.polyfit(rows.normal, rows.shear, 1)
    # Cohesion may be negative here: a bound would bend its interval.
    start, bounds = [float(slope), float(intercept)], ([-np.inf, -np.inf], [np.inf, np.inf])
    fit = _fit("cohesion", rows, lambda s, mu, c: mu * s + c, start, bounds, names)
    if fit.parameters and fit.parameters[1].value <= 0.0:
        return replace(fit, criterion=None, why="not chosen: the line through the tests has no cohesion")
    if fit.parameters and fit.parameters[0].value < 0.0:
        return replace(fit, criterion=None, why="not chosen: the strength falls with the normal stress")
    return fit


def _patton(rows: _Rows) -> LawFit:
    """Patton (1966): steep up the asperities, flatter where they shear off; the two lines meet at a normal stress."""

    def strength(s: Floats, steep: float, flat: float, at: float) -> Floats:
        return np.where(s <= at, steep * s, steep * at + flat * (s - at))

    stresses = np.unique(rows.normal)
    if stresses.size < 5:
        return _unfitted("bilinear", "normal stress", "fewer than five normal stresses")
    low, high = stresses[1], stresses[-2]
    names = [("steep_friction", "", False), ("flat_friction", "", False), ("break_stress", "Pa", False)]
    bounds = ([0.0, 0.0, low], [50.0, 10.0, high])
    breaks = _breaks(rows, float(low), float(high))
    best = min(breaks, key=lambda one: one.misfit)
    fit = _fit("bilinear", rows, strength, [*best.slopes, best.at], bounds, names)
    if fit.criterion is None:
        return fit
    steep, flat, at = (parameter.value for parameter in fit.parameters)
    if steep <= flat or not low * 1.001 < at / _MPA < high * 0.999:
        return replace(fit, criterion=None, why="not chosen: the tests show no break to a flatter line")
    return replace(fit, parameters=_profiled(fit.parameters, breaks, best.misfit, rows.shear.size - 3))


@dataclass(frozen=True)
class _Break:
    """The best two lines that meet at a normal stress [MPa]: sum of squares, slopes, and variances of the slopes by
    that of one test."""

    at: float
    misfit: float
    slopes: tuple[float, float]
    variances: tuple[float, float]


def _breaks(rows: _Rows, low: float, high: float) -> list[_Break]:
    """Return the best lines for each of many stresses at which they may meet: given that, they are linear."""
    breaks = []
    for at in np.linspace(low, high, _BREAKS):
        lines = np.stack([np.minimum(rows.normal, at), np.maximum(rows.normal - at, 0.0)], axis=1)
        inverse = np.linalg.pinv(lines.T @ lines)
        slopes = inverse @ (lines.T @ rows.shear)
        misfit = rows.shear - lines @ slopes
        breaks.append(
            _Break(
                at=float(at),
                misfit=float(misfit @ misfit),
                slopes=(float(slopes[0]), float(slopes[1])),
                variances=(float(inverse[0, 0]), float(inverse[1, 1])),
            )
        )
    return breaks


def _profiled(numbers: Sequence[Parameter], breaks: Sequence[_Break], least: float, freedom: int) -> list[Parameter]:
    """Return the numbers of two lines with the ends of their profiles: where they meet is not normal, so that the
    covariance gives intervals that are too short."""
    most = least * (1.0 + _student(freedom) ** 2 / freedom)
    able = [one for one in breaks if one.misfit <= most] or [min(breaks, key=lambda one: one.misfit)]
    step = breaks[1].at - breaks[0].at
    ends = [
        [one.slopes[place] + sign * math.sqrt(max(most - one.misfit, 0.0) * one.variances[place]) for one in able]
        for place in (0, 1)
        for sign in (-1.0, 1.0)
    ]
    spans = [
        (min(ends[0]), max(ends[1])),
        (min(ends[2]), max(ends[3])),
        (_MPA * (able[0].at - step), _MPA * (able[-1].at + step)),
    ]
    return [
        replace(number, low=min(low, number.value), high=max(high, number.value))
        for number, (low, high) in zip(numbers, spans, strict=True)
    ]


def _barton(rows: _Rows, tests: Sequence[ShearTest]) -> LawFit:
    """Barton and Choubey (1977). Peaks alone leave one of its three numbers open: residual strengths give the angle, or
    the table the strength of the walls."""
    name, over = "barton-bandis", "normal stress"
    if not tests:
        return _unfitted(name, over, "the tests have no peak strength")
    if np.unique(rows.normal).size < 3:
        return _unfitted(name, over, "fewer than three normal stresses")
    left = [test for test in tests if not math.isnan(test.residual_pa)]
    walls = [test.wall_strength_pa for test in tests if not math.isnan(test.wall_strength_pa)]
    jrc, jcs, angle = ("jrc", "", False), ("jcs", "Pa", True), ("residual_angle", "rad", False)
    if walls:
        known = float(np.mean(walls))

        def with_walls(s: Floats, roughness: float, residual: float) -> Floats:
            return _barton_strength(s, roughness, known / _MPA, residual)

        fit = _fit(name, rows, with_walls, [8.0, 0.5], ([0.0, 0.0], [40.0, 1.2]), [jrc, angle])
        return _within_range(_with_measured(fit, Parameter(name="jcs", value=known, low=known, high=known, unit="Pa")))
    if len(left) < 3:
        return _unfitted(name, over, "without residual strengths or a wall strength one of its numbers stays open")
    normal = np.concatenate([rows.normal, np.array([test.normal_pa for test in left]) / _MPA])
    shear = np.concatenate([rows.shear, np.array([test.residual_pa for test in left]) / _MPA])

    def strength(s: Floats, roughness: float, walls: float, residual: float) -> Floats:
        peaks = _barton_strength(s[: rows.peaks], roughness, math.exp(walls), residual)
        return np.concatenate([peaks, s[rows.peaks :] * math.tan(residual)])

    most = float(rows.normal.max())
    bounds = ([0.0, math.log(most / 100.0), 0.0], [40.0, math.log(1e4 * most), 1.2])
    start = [8.0, math.log(20.0 * most), float(np.arctan(np.mean(shear[rows.peaks :] / normal[rows.peaks :])))]
    return _within_range(_fit(name, _Rows(normal, shear, rows.peaks), strength, start, bounds, [jrc, jcs, angle]))


def _with_measured(fit: LawFit, number: Parameter) -> LawFit:
    """Return a fit with a number that was measured, behind the others; its variance is taken as zero."""
    if not fit.parameters:
        return fit
    count = len(fit.parameters)
    covariance = [[*row, 0.0] for row in fit.covariance] + [[0.0] * (count + 1)]
    return replace(fit, parameters=[*fit.parameters, number], covariance=covariance)


def _within_range(fit: LawFit) -> LawFit:
    """Refuse to choose a roughness outside the range of Barton and Choubey, 0 to 20."""
    if fit.parameters and not _SMOOTHEST < fit.parameters[0].value <= _ROUGHEST:
        return replace(fit, criterion=None, why="not chosen: its jrc is not between 0 and 20")
    return fit


def _barton_strength(s: Floats, jrc: float, jcs: float, angle: float) -> Floats:
    law = Law.model_construct(name="barton-bandis", jrc=jrc, jcs=jcs * _MPA, residual_angle=angle)
    strength: Floats = shear_stress(law_of(law), s * _MPA)[1] / _MPA
    return strength


def _fit(
    name: str,
    rows: _Rows,
    strength: _Strength,
    start: Sequence[float],
    bounds: tuple[list[float], list[float]],
    names: Sequence[tuple[str, str, bool]],
) -> LawFit:
    """Fit a strength; the band and the criterion are those of the peaks."""
    over = "normal stress"
    freedom = rows.shear.size - len(start)
    if freedom < 1:
        return _unfitted(name, over, "the tests are fewer than its numbers")
    solved = _solve(strength, rows.normal, rows.shear, start, bounds)
    if solved is None:
        return _unfitted(name, over, "no numbers fit the tests")
    values, covariance = solved
    misfit = rows.shear - strength(rows.normal, *values)
    peaks = misfit[: rows.peaks]
    scatter = math.sqrt(float(misfit @ misfit) / freedom)
    pad = rows.normal[rows.peaks :]
    ends = rows.normal[: rows.peaks].min(), rows.normal[: rows.peaks].max()
    at = np.linspace(*ends, _BAND_POINTS) if ends[0] < ends[1] else np.array(ends)

    def along(*numbers: float) -> Floats:
        if pad.size == 0:
            return strength(at, *numbers)
        # Residual strengths stand behind as many peaks as there are: the band is taken in pieces of them.
        pieces = [at[first : first + rows.peaks] for first in range(0, at.size, rows.peaks)]
        filled = [np.concatenate([np.resize(piece, rows.peaks), pad]) for piece in pieces]
        return np.concatenate(
            [strength(row, *numbers)[: piece.size] for row, piece in zip(filled, pieces, strict=True)]
        )

    best, half = _band(along, values, covariance, scatter, freedom)
    return _fitted(
        LawFit(
            law=name,
            over=over,
            points=int(rows.peaks),
            scatter=scatter * _MPA,
            criterion=_criterion(peaks, len(start)),
            why="not chosen: the tests are too few for its criterion",
        ),
        (values, covariance, names, freedom),
        peaks / rows.normal[: rows.peaks],
        (at * _MPA, best / at, (best - half) / at, (best + half) / at),
    )


# --- a fall with slip or speed


def _falls(tests: Sequence[ShearTest]) -> tuple[list[Fall], list[LawFit]]:
    """Return whether the friction falls by slip and by speed, and the laws of these falls."""
    falls: list[Fall] = []
    by_slip, slip_fit = _by_slip(tests)
    by_speed, speed_fit = _by_speed(tests)
    falls += [fall for fall in (by_slip, by_speed) if fall is not None]
    return falls, [slip_fit, speed_fit]


def _by_slip(tests: Sequence[ShearTest]) -> tuple[Fall | None, LawFit]:
    """Each specimen counts once: points of one curve are not independent."""
    name, over = "slip weakening", "slip path"
    curves = [test.curve for test in tests if test.curve is not None]
    drops = [curve.fall for curve in curves] or [
        (test.peak_pa - test.residual_pa) / test.normal_pa
        for test in tests
        if not math.isnan(test.peak_pa + test.residual_pa)
    ]
    if len(drops) < _FEW_PAIRS:
        return None, _unfitted(name, over, "fewer than three tests have both ends of a slip")
    fall = _mean_fall(np.array(drops))
    if not fall.found:
        return fall, _unfitted(name, over, f"no fall is found (probability {fall.probability:.2g} without one)")
    if not curves:
        return fall, _unfitted(name, over, "the table has no slips: the fall is found, the way that it takes is not")
    forms = [_curves_fit(curves, form) for form in ("linear", "exponential")]
    able = [fit for fit in forms if fit.criterion is not None]
    if not able:
        return fall, forms[0]
    best = min(able, key=lambda fit: math.inf if fit.criterion is None else fit.criterion)
    return fall, replace(best, chosen=True, why=f"chosen: the fall is found (probability {fall.probability:.2g})")


def _mean_fall(drops: Floats) -> Fall:
    """Student's test of one side, whether the mean of falls is above zero."""
    level = float(drops.mean())
    if float(np.ptp(drops)) <= 1e-12 * max(abs(level), 1e-300):
        probability = 0.0 if level > 0.0 else 1.0
    else:
        probability = float(ttest_1samp(drops, 0.0, alternative="greater").pvalue)
    found = probability < FALSE_FALL
    return Fall(by="slip", tests=drops.size, found=found, probability=probability, friction=level)


def _curves_fit(curves: Sequence[Curve], form: str) -> LawFit:
    """Fit every curve by itself; numbers and intervals are those of the mean over the specimens."""
    name, over = f"slip weakening, {form}", "slip path"

    def ratio(d: Floats, peak: float, fall: float, way: float) -> Floats:
        law = Law.model_construct(
            name="slip weakening", form=form, peak_friction=peak, residual_friction=peak - fall, slip=math.exp(way)
        )
        friction: Floats = shear_stress(law_of(law), _MPA, d)[1] / _MPA
        return friction

    rows, misfits = [], []
    for curve in curves:
        whole = float(curve.slip_m[-1])
        step = whole / curve.slip_m.size
        bounds = ([0.0, -1.0, math.log(0.5 * step)], [10.0, 10.0, math.log(10.0 * whole)])
        peak, last = float(curve.ratio[:3].mean()), float(curve.ratio[-3:].mean())
        tries = (
            _solve(ratio, curve.slip_m, curve.ratio, [peak, max(peak - last, 0.01), math.log(part * whole)], bounds)
            for part in (0.1, 0.3, 0.7)
        )
        able = [(values, curve.ratio - ratio(curve.slip_m, *values)) for values, _ in filter(None, tries)]
        if able:
            values, misfit = min(able, key=lambda one: float(one[1] @ one[1]))
            rows.append(values)
            misfits.append(misfit)
    if len(rows) < _FEW_PAIRS:
        return _unfitted(name, over, "fewer than three curves have a fall that can be fitted")
    table = np.array(rows)
    mean, freedom = table.mean(axis=0), len(rows) - 1
    spread = np.atleast_2d(np.cov(table.T))
    covariance = _TURN @ spread @ _TURN.T / len(rows)
    misfit = np.concatenate(misfits)
    longest = max(float(curve.slip_m[-1]) for curve in curves)
    at = np.linspace(0.0, longest, _BAND_POINTS)
    each = np.array([ratio(at, *row) for row in table])
    best = ratio(at, *mean)
    # Another specimen has its own curve, and points about it.
    noise = float(misfit @ misfit) / misfit.size
    half = _student(freedom) * np.sqrt(each.var(axis=0, ddof=1) * (1.0 + 1.0 / len(rows)) + noise)
    criterion = _criterion(misfit, 3 * len(rows))
    return _fitted(
        LawFit(law=name, over=over, points=int(misfit.size), scatter=math.sqrt(noise), criterion=criterion),
        (_TURN @ mean, covariance, [*_FALL, ("slip", "m", True)], freedom),
        misfit,
        (at, best, best - half, best + half),
    )


def _by_speed(tests: Sequence[ShearTest]) -> tuple[Fall | None, LawFit]:
    """The rank correlation of friction and speed says whether there is a fall, least squares how far it goes."""
    name, over = "speed weakening", "slip speed"
    ready = [test for test in tests if not math.isnan(test.speed_m_s)]
    speed = np.array([test.speed_m_s for test in ready])
    if np.unique(speed).size < _FEW_SPEEDS or len(ready) < 5:
        return None, _unfitted(name, over, "the tests do not have three speeds")
    sliding = [test.peak_pa if math.isnan(test.residual_pa) else test.residual_pa for test in ready]
    friction = np.array(sliding) / np.array([test.normal_pa for test in ready])
    order = np.argsort(speed)
    third = max(len(ready) // 3, 1)
    level = float(friction[order[:third]].mean() - friction[order[-third:]].mean())
    level_everywhere = float(np.ptp(friction)) == 0.0
    probability = 1.0 if level_everywhere else float(spearmanr(speed, friction, alternative="less").pvalue)
    found = probability < FALSE_FALL
    fall = Fall(by="speed", tests=len(ready), found=found, probability=probability, friction=level)
    if not found:
        return fall, _unfitted(name, over, f"no fall is found (probability {probability:.2g} without one)")

    def ratio(v: Floats, peak: float, drop: float, scale: float) -> Floats:
        law = Law.model_construct(
            name="speed weakening", peak_friction=peak, residual_friction=peak - drop, speed=math.exp(scale)
        )
        borne: Floats = shear_stress(law_of(law), _MPA, speed=v)[1] / _MPA
        return borne

    least, most = float(speed[speed > 0.0].min()), float(speed.max())
    bounds = ([0.0, 0.0, math.log(least / 10.0)], [10.0, 10.0, math.log(10.0 * most)])
    starts = [[float(friction.max()), max(level, 0.02), math.log(least) + part * math.log(most / least)]
              for part in (0.2, 0.5, 0.8)]  # fmt: skip
    tries = [_solve(ratio, speed, friction, start, bounds) for start in starts]
    able = [one for one in tries if one is not None]
    if not able or len(ready) < 6:
        return fall, _unfitted(name, over, "a fall is found, the speed that it takes is not")
    values, spread = min(able, key=lambda one: float(np.sum((friction - ratio(speed, *one[0])) ** 2)))
    misfit, freedom = friction - ratio(speed, *values), len(ready) - 3
    covariance = _TURN @ spread @ _TURN.T
    scatter = math.sqrt(float(misfit @ misfit) / freedom)
    at = np.linspace(0.0, most, _BAND_POINTS)
    best, half = _band(lambda *numbers: ratio(at, *numbers), values, spread, scatter, freedom)
    fit = LawFit(law=name, over=over, points=len(ready), scatter=scatter, criterion=_criterion(misfit, 3))
    numbers = (_TURN @ values, covariance, [*_FALL, ("speed", "m/s", True)], freedom)
    why = f"chosen: the fall is found (probability {probability:.2g})"
    return fall, _fitted(replace(fit, chosen=True, why=why), numbers, misfit, (at, best, best - half, best + half))


# --- what all fits have in common


def _solve(
    model: _Strength, x: Floats, y: Floats, start: Sequence[float], bounds: tuple[list[float], list[float]]
) -> tuple[Floats, Floats] | None:
    """Return the best numbers and their covariance; None where there are none, or the tests do not hold them."""
    inside = np.clip(start, np.nextafter(bounds[0], np.inf), np.nextafter(bounds[1], -np.inf))
    try:
        with np.errstate(all="ignore"):
            values, covariance = curve_fit(
                model, x, y, inside, bounds=bounds, method="trf", x_scale="jac", max_nfev=2000
            )
    except (RuntimeError, ValueError):
        return None
    return (values, covariance) if np.isfinite(covariance).all() else None


def _parameters(
    values: Floats, covariance: Floats, names: Sequence[tuple[str, str, bool]], freedom: int
) -> list[Parameter]:
    """Return numbers with their intervals, back from logarithms and megapascals."""
    rows = []
    halves = _student(freedom) * np.sqrt(np.clip(np.diag(covariance), 0.0, None))
    for value, half, (name, unit, logarithm) in zip(values, halves, names, strict=True):
        one = _MPA if unit == "Pa" else 1.0
        ends = [value, value - half, value + half]
        with np.errstate(over="ignore"):
            best, low, high = (float(one * (np.exp(min(end, 700.0)) if logarithm else end)) for end in ends)
        rows.append(Parameter(name=name, value=best, low=low, high=high, unit=unit))
    return rows


def _band(
    along: Callable[..., Floats], values: Floats, covariance: Floats, scatter: float, freedom: int
) -> tuple[Floats, Floats]:
    """Return a law along its places, and half the width of the band of further tests."""
    best = along(*values)
    slopes = []
    for place, value in enumerate(values):
        step = np.zeros(values.size)
        step[place] = 1e-6 * max(abs(float(value)), 1e-3)
        slopes.append((along(*(values + step)) - along(*(values - step))) / (2.0 * step[place]))
    slope = np.array(slopes)
    variance = np.einsum("in,ij,jn->n", slope, covariance, slope)
    return best, _student(freedom) * np.sqrt(scatter**2 + np.clip(variance, 0.0, None))


def _student(freedom: int) -> float:
    return float(t.ppf(0.5 + COVERED / 2.0, freedom))


def _criterion(misfit: Floats, count: int) -> float | None:
    """Return the corrected criterion of Akaike (Hurvich and Tsai 1989) of normal errors; their spread counts as one."""
    points, numbers = misfit.size, count + 1
    if points - numbers - 1 < 1:
        return None
    mean = max(float(misfit @ misfit) / points, 1e-24)
    return points * math.log(mean) + 2.0 * numbers + 2.0 * numbers * (numbers + 1) / (points - numbers - 1)


def _fitted(
    fit: LawFit,
    numbers: tuple[Floats, Floats, Sequence[tuple[str, str, bool]], int],
    residuals: Floats,
    band: tuple[Floats, Floats, Floats, Floats],
) -> LawFit:
    """Return a fit with its numbers (values, covariance, names, freedom), its residuals and its band (places, best, low
    and high)."""
    values, covariance, names, freedom = numbers
    at, best, low, high = (values.tolist() for values in band)
    return replace(
        fit,
        parameters=_parameters(values, covariance, names, freedom),
        covariance=covariance.tolist(),
        residuals=residuals.tolist(),
        band=Band(at=at, best=best, low=low, high=high),
    )


def _unfitted(name: str, over: str, why: str) -> LawFit:
    return LawFit(law=name, over=over, why=f"not fitted: {why}")


# --- what a reader must know of the tests

_RESIDUAL = "The residual strengths have a friction of {friction}: it decides how far a dam slides that slides at all."


def _residual_friction(tests: Sequence[ShearTest]) -> float | None:
    """Return the slope of a line from zero through the residual strengths; None without any."""
    left = [(test.normal_pa, test.residual_pa) for test in tests if not math.isnan(test.residual_pa)]
    if not left:
        return None
    normal, shear = (np.array(values) for values in zip(*left, strict=True))
    return float(normal @ shear / (normal @ normal))


def _stage_notes(tests: Sequence[ShearTest]) -> Iterator[Sentence]:
    """Say what the stages of specimens that were sheared several times would have done; first stages are fitted."""
    later = [test for test in tests if test.stage > 1 and not math.isnan(test.peak_pa)]
    if not later:
        return
    template = (
        "{later} of {tests} tests are later stages of specimens that had been sheared before. A worn face has too "
        "little friction and too much cohesion (Bureau of Reclamation 2023): only the first stages are fitted."
    )
    first = [test for test in tests if test.stage == 1 and not math.isnan(test.peak_pa)]
    lines = [_line(rows) for rows in (first, [test for test in tests if not math.isnan(test.peak_pa)])]
    if None not in lines:
        template += (
            " The line through the first stages has a friction of {friction} and a cohesion of {cohesion_pa:.2f MPa}, "
            "the line through all stages {all_friction} and {all_cohesion_pa:.2f MPa}."
        )
    (friction, cohesion), (all_friction, all_cohesion) = (line or (0.0, 0.0) for line in lines)
    yield Sentence.of(
        template,
        later=str(len(later)),
        tests=str(len(tests)),
        friction=f"{friction:.2f}",
        cohesion_pa=cohesion,
        all_friction=f"{all_friction:.2f}",
        all_cohesion_pa=all_cohesion,
    )


def _line(tests: Sequence[ShearTest]) -> tuple[float, float] | None:
    """Return friction and cohesion [Pa] of the line through peaks; None under a single normal stress."""
    normal, shear = (np.array(values) for values in zip(*((one.normal_pa, one.peak_pa) for one in tests), strict=True))
    if np.unique(normal).size < 2:
        return None
    slope, intercept = np.polyfit(normal, shear, 1)
    return float(slope), float(intercept)


def _size_notes(tests: Sequence[ShearTest], chosen: LawFit) -> Iterator[Sentence]:
    """Say whether the strength goes with the size of the specimens, and that a crack is longer than they are."""
    sized = [(test.size_m, test) for test in tests if not math.isnan(test.size_m)]
    if not sized:
        yield Sentence.of("The table does not say how long the specimens are: an effect of size cannot be seen.")
        return
    sizes = np.array([size for size, _ in sized])
    longer = "Roughness counts for less on a crack, which is longer."
    if np.unique(sizes).size < 2 or len(chosen.residuals) != len(sized):
        yield Sentence.of("All specimens are {size_m:.2f m} long. " + longer, size_m=float(sizes.max()))
        return
    result = spearmanr(sizes, np.array(chosen.residuals))
    probability = float(result.pvalue) if np.ptp(chosen.residuals) > 0.0 else 1.0
    way = "falls" if float(result.statistic) < 0.0 else "rises"
    goes = way if probability < FALSE_FALL else "does not go"
    yield Sentence.of(
        f"The strength {goes} with the size of the specimens (probability {probability:.2g} without an effect)"
        ", {least_m:.2f m} to {most_m:.2f m}. " + longer,
        least_m=float(sizes.min()),
        most_m=float(sizes.max()),
    )


# --- the block of a case file


def _crack_block(fits: Sequence[LawFit], residual: float | None, band: tuple[float, float, float], sigma: float) -> str:
    """Return the friction as a case file has it: a fall where one was found, else the law of the strength; the band has
    the best friction and its ends at a normal stress [Pa], and is written with a constant friction alone."""
    friction, low, high = band
    chosen = {fit.law.partition(",")[0]: fit for fit in fits if fit.chosen}
    strength = next(fit for fit in fits if fit.chosen and fit.over == "normal stress")
    values = {name: {one.name: one.value for one in fit.parameters} for name, fit in chosen.items()}
    name = next((name for name in ("slip weakening", "speed weakening") if name in chosen), strength.law)
    if name == "constant" and residual is not None and residual < friction:
        lines = ["[crack]", f"static_friction = {friction:.3f}", f"kinetic_friction = {residual:.3f}"]
    elif name == "constant":
        lines = ["[crack]", f"friction = {friction:.3f}"]
    elif name == "bilinear":
        lines = _bilinear_lines(values[name])
    else:
        written = {"slip": "{:.3g} mm", "speed": "{:.3g} m/s", "cohesion": "{:.4g} MPa", "jcs": "{:.4g} MPa"}
        scale = {"slip": 1e3, "cohesion": 1e-6, "jcs": 1e-6}
        lines = ["[crack.law]", f'name = "{name}"']
        if name == "slip weakening":
            lines.append(f'form = "{chosen[name].law.partition(", ")[2]}"')
        for key, value in values[name].items():
            if key == "residual_angle":
                lines.append(f'{key} = "{math.degrees(value):.2f} deg"')
            elif key in written:
                lines.append(f'{key} = "{written[key].format(value * scale.get(key, 1.0))}"')
            else:
                lines.append(f"{key} = {max(value, 0.0):.3f}")
    # The strength of further tests bounds the friction of a slide only where it is not lost with the slip.
    if lines[-1] != f"friction = {friction:.3f}":
        ends = ["# no [crack.band]: the scatter of the strength does not bound the friction that a slide leaves"]
        return "\n".join([*lines, *ends]) + "\n"
    ends = [
        "",
        f"[crack.band]  # 95 % of further tests, at a normal stress of {sigma / _MPA:.3g} MPa",
        f"low = {low:.3f}",
        f"high = {high:.3f}",
    ]
    return "\n".join([*lines, *ends]) + "\n"


def _bilinear_lines(values: dict[str, float]) -> list[str]:
    """Return two lines as points of a lift joint: beyond the break the added friction falls with the stress."""
    steep, flat, at = (values[name] for name in ("steep_friction", "flat_friction", "break_stress"))
    points = [(at * factor, (steep - flat) / factor) for factor in (1.0, 1.25, 1.5, 2.0, 3.0, 5.0, 10.0)]
    rows = ", ".join(f'["{stress / _MPA:.4g} MPa", {added:.4f}]' for stress, added in points)
    return [
        "[crack.law]",
        'name = "lift joint"',
        'surface = "untreated"  # or as it was prepared',
        f"basic_friction = {flat:.3f}",
        f"roughness_friction = [{rows}]",
    ]

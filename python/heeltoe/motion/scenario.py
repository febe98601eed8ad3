"""From an earthquake and a site to a generated motion: ``synthetic:M6.5,20km,seed=3``.

Predictive relations of Rezaeian and Der Kiureghian (2010), Earthquake Engineering and Structural Dynamics 39,
1155-1180, fitted to records of the NGA database with M 6.0 to 7.6, 10 km to 100 km from the rupture, on ground with
Vs30 of 600 m/s and more, of strike-slip (F = 0) and reverse (F = 1) faults.

Coefficients, distributions, scatter and correlations are those of the public code of the SCEC Broadband Platform
(module rzz2015_gmpe), whose terms in M / 7, R / 25 km and Vs30 / 750 m/s are multiplied out there. They were not
compared with the printed tables of the paper. The intensity of that code is the integral of a^2 with a in g, without
the factor pi / 2; the constant of its relation for the intensity, -2.2962, goes with that definition.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.records.catalog import PREFIX
from heeltoe.motion.stochastic import Parameters, Source, stochastic_motion
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.warnings.notice import Notice

# Rows: intensity, D5-95, t_mid, frequency, its rate, bandwidth. Columns: 1, M, F, distance, Vs30, of which the last two
# are ln(R / 25 km) and ln(Vs30 / 750 m/s) in the first row, and R [km] and Vs30 [m/s] in the others.
_BETA = np.array(
    [
        [-2.2962, 2.9440 / 7.0, -0.0707, -1.3564, -0.2654],
        [-6.1946, 0.9703, -0.7034, 0.0087, -0.0007],
        [-5.0105, 0.6625, -0.3450, 0.0139, -0.0002],
        [2.2525, -0.2586, -0.0808, -0.0084, 0.0000],
        [-2.4886, 0.3440, 0.0441, 0.0026, -0.0001],
        [-0.2583, 0.1293, -0.4772, -0.0115, 0.0004],
    ]
)
# Within and between earthquakes.
_SIGMA = np.array([0.5937, 0.5688, 0.4145, 0.7228, 0.9529, 0.7601])
_TAU = np.array([0.2738, 0.4574, 0.5114, 0.6918, 0.1286, 0.6815])
# Correlations of the total errors, above the diagonal.
_RHO = (
    (-0.3555, 0.0066, -0.1545, 0.1341, -0.0078),
    (0.6729, -0.1303, -0.1576, -0.1958),
    (-0.2761, -0.1977, -0.2188),
    (-0.2034, 0.2814),
    (-0.0137,),
)
_OPTION = re.compile(r"(seed|vs30|fault|step|scatter|corner)=(.+)")


def normal_scores(magnitude: float, distance: float, vs30: float, reverse: bool) -> Floats:
    """Return the means of the six parameters after their transformation to standard normal ones."""
    linear = np.array([1.0, magnitude, float(reverse), distance, vs30])
    logarithmic = np.array([1.0, magnitude, float(reverse), np.log(distance / 25.0), np.log(vs30 / 750.0)])
    return np.concatenate([_BETA[:1] @ logarithmic, _BETA[1:] @ linear])


def parameters_of(scores: Floats, gravity: float = STANDARD_GRAVITY) -> Parameters:
    """Return the parameters whose probabilities, in their fitted distributions, are those of the normal `scores`.

    ln of the intensity is normal; duration, middle and bandwidth are beta distributed over 5 s to 45 s, 0.5 s to
    40 s and 0.02 to 1; the frequency [Hz] is gamma distributed; its rate is a two-sided exponential over -2 Hz/s to
    0.5 Hz/s.
    """
    from scipy.stats import beta, gamma, norm

    share = norm.cdf(scores)
    squared = np.exp(-4.8255 + 1.4318 * scores[0])
    return Parameters(
        arias=float(np.pi / 2.0 * gravity * squared),
        duration=float(5.0 + 40.0 * beta.ppf(share[1], 1.1314, 2.4474)),
        middle=float(0.5 + 39.5 * beta.ppf(share[2], 1.5792, 3.6405)),
        frequency=float(gamma.ppf(share[3], 4.0982, scale=1.4330)),
        frequency_rate=_two_sided(float(share[4])),
        bandwidth=float(0.02 + 0.98 * beta.ppf(share[5], 1.4250, 5.7208)),
    )


def _two_sided(share: float) -> float:
    """Invert the distribution of the rate: density 4.8512 exp(6.7729 x) below zero, 4.8512 exp(-17.095 x) above."""
    above, below, top = 17.095, 6.7729, 4.8512
    start = np.exp(-2.0 * below)
    at_zero = top / below * (1.0 - start)
    if share < at_zero:
        return float(np.log(share * below / top + start) / below)
    # The printed constants leave the whole a little off one.
    return float(min(0.5, -np.log(max(1.0 - (share - at_zero) * above / top, 1e-300)) / above))


def source_of(magnitude: float) -> Source:
    """Return the source of an earthquake after Atkinson and Silva (2000), with two corners.

    Bulletin of the Seismological Society of America 90, 255-274: log fa = 2.181 - 0.496 M, log fb = 2.41 - 0.408 M,
    log share = 0.605 - 0.255 M. At long periods the acceleration of a fault of some size falls earlier and less steeply
    than with the one corner of Brune (1970), whose motions come out up to twice too strong at 3 s to 10 s.
    """
    return Source(
        10.0 ** (2.181 - 0.496 * magnitude), 10.0 ** (2.41 - 0.408 * magnitude), 10.0 ** (0.605 - 0.255 * magnitude)
    )


def scenario_parameters(
    magnitude: float, distance: float, vs30: float = 760.0, *, reverse: bool = False, seed: int | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> Parameters:  # fmt: skip
    """Return the median parameters of an earthquake, or with a `seed` parameters drawn with their scatter.

    Parameters
    ----------
    magnitude
        Moment magnitude.
    distance
        Closest distance to the rupture [km].
    vs30
        Shear-wave velocity of the upper 30 m [m/s].
    reverse
        Reverse fault; otherwise strike-slip.
    seed
        Draw the parameters with it, as the scatter between and within earthquakes; a draw that no modulation can
        have is drawn again.
    gravity
        One g [m/s2].
    """
    for name, value, low, high, unit in (
        ("magnitude", magnitude, 5.0, 8.5, ""),
        ("distance", distance, 5.0, 200.0, " km"),
        ("vs30", vs30, 300.0, 2500.0, " m/s"),
    ):
        if not low <= value <= high:
            raise InputError("out-of-range", name, f"{value:g}{unit}", bound=f"from {low:g} to {high:g}{unit}")
    scores = normal_scores(magnitude, distance, vs30, reverse)
    source = source_of(magnitude)
    if seed is None:
        return replace(parameters_of(scores, gravity), source=source)
    correlation = np.eye(6)
    for i, row in enumerate(_RHO):
        correlation[i, i + 1 :] = correlation[i + 1 :, i] = row
    spread = np.linalg.cholesky(correlation) * np.hypot(_SIGMA, _TAU)[:, None]
    # Another stream than that of the noise, which takes the seed itself.
    generator = np.random.Generator(np.random.PCG64([seed, 1]))
    while True:
        try:
            drawn = parameters_of(scores + spread @ generator.standard_normal(6), gravity)
        except InputError:
            continue
        if 0.2 <= drawn.duration / drawn.middle <= 4.9:
            return replace(drawn, source=source)


def synthetic(name: str, *, gravity: float = STANDARD_GRAVITY, field: str = "motion.file") -> GroundMotion:
    """Return the motion that a name such as ``synthetic:M6.5,20km,seed=3,vs30=760,fault=reverse`` orders.

    Without ``scatter=yes`` the parameters are the medians, and only the noise differs between seeds. A ``step`` [s]
    refines the motion, exactly; it divides 0.01 s. A high-pass of one ``corner`` [Hz] takes the place of the source.

    Raises
    ------
    InputError
        Where the name is not of this form, or asks for what the relations cannot say.
    """
    order = order_of(name, field=field)
    try:
        magnitude, distance, vs30 = order["magnitude"], order["distance"], order.get("vs30", 760.0)
        seed = int(order["seed"])
        parameters = scenario_parameters(
            magnitude,
            distance,
            vs30,
            reverse=bool(order.get("reverse", 0.0)),
            seed=seed if order.get("scatter") else None,
            gravity=gravity,
        )
        if "corner" in order:
            parameters = replace(parameters, corner=order["corner"], source=None)
    except InputError as error:
        error.field = field
        raise
    plain = name.removeprefix(PREFIX).replace(" ", "").replace(",", "-").replace("=", "")
    motion = stochastic_motion(parameters, seed, gravity=gravity, name=f"synthetic-{plain}")
    motion = replace(motion, event=f"made to order: M {magnitude:g} at {distance:g} km", source=name)
    if "step" in order:
        motion = motion.resampled(order["step"])
    notices = [Notice("motion-generated", field=field, name=motion.name)]
    if not (6.0 <= magnitude <= 7.6 and 10.0 <= distance <= 100.0 and vs30 >= 600.0):
        notices.append(Notice("motion-unlike-records", "beyond-relations", field=field, name=motion.name))
    return motion.with_warnings(*notices)


def order_of(name: str, *, field: str = "motion.file") -> dict[str, float]:
    """Return what a name orders: magnitude, distance [km], seed and what else it says; truths are 0 and 1.

    Raises
    ------
    InputError
        Where it is not of the form of :func:`synthetic`.
    """
    try:
        return _read(name)
    except _Form as reason:
        raise InputError(
            "wrong-quantity",
            field,
            name,
            kind=f"a valid synthetic motion ({reason})",
            example='"synthetic:M6.5,20km,seed=3,vs30=760,fault=reverse"',
        ) from None


class _Form(ValueError):
    """Error in a name."""


def _read(name: str) -> dict[str, float]:
    """Take a name apart; truths are 0 and 1."""
    parts = [part.strip() for part in name.removeprefix(PREFIX).split(",")]
    order: dict[str, float] = {}
    for part in parts:
        option = _OPTION.fullmatch(part)
        if match := re.fullmatch(r"M(\d+\.?\d*)", part):
            key, value = "magnitude", float(match[1])
        elif match := re.fullmatch(r"(\d+\.?\d*) ?km", part):
            key, value = "distance", float(match[1])
        elif option is None:
            raise _Form(f'"{part}" says nothing')
        else:
            key, value = _option(option[1], option[2])
        if key in order:
            raise _Form(f"{key} is there twice")
        order[key] = value
    for needed in ("magnitude", "distance", "seed"):
        if needed not in order:
            raise _Form(f"{needed} is not there")
    return order


def _option(name: str, text: str) -> tuple[str, float]:
    words = {"fault": ("strike-slip", "reverse"), "scatter": ("no", "yes")}.get(name)
    if words:
        if text not in words:
            raise _Form(f"{name} is {words[0]} or {words[1]}")
        return ("reverse" if name == "fault" else name), float(words.index(text))
    pattern = r"\d{1,15}" if name == "seed" else r"\d+\.?\d*|\.\d+"
    if not re.fullmatch(pattern, text):
        raise _Form(f"{name} is no number")
    return name, float(text)

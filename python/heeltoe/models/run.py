"""The one way to run any model: what every result must have is put there once, whoever asks for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve
from heeltoe.case.warnings import case_warnings
from heeltoe.errors import InputError
from heeltoe.models.statics.standing import standing_warnings
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.limits import check_limits
from heeltoe.result.response import Response
from heeltoe.warnings import Notice

# Not at run time: what another model needs is not loaded.
if TYPE_CHECKING:
    from heeltoe.models.decoupled.response import DecoupledResponse
    from heeltoe.models.flexible.response import FlexibleResponse

R = TypeVar("R", bound=Response)


def run(
    case: Case,
    model: str = "rigid",
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> Response:
    """Run a model on a case.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    model
        ``"rigid"``, ``"decoupled"`` or ``"flexible"``.
    motion, vertical
        Ground motions to use, as they are, instead of the case's [m/s2, downstream and upward].
    output_step
        Spacing of the histories [s]; each model has its own where it is not given. It does not change the motion that
        is computed.

    Returns
    -------
    Response
        Of the class of the model; with all that case, motion and model warn of, what the usual loads do to the crack,
        and the limits of the case.

    Raises
    ------
    InputError
        Where there is no such model or no motion, or something in them or in the case cannot be used.
    """
    if model not in MODELS:
        raise InputError("unknown-model", "model", model, models=", ".join(MODELS))
    return _completed(MODELS[model](case, earthquake(case, motion, vertical), output_step), case)


def rigid(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    rotation: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> Response:
    """Run the rigid model: the part above the crack is a block.

    Parameters, result and errors are those of :func:`run`. Histories come at the record's samples where no spacing is
    given; `rotation` is that of the ground about the middle of the crack, counter-clockwise [rad/s2].
    """
    return _completed(_rigid(case, earthquake(case, motion, vertical, rotation), output_step), case)


def decoupled(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> DecoupledResponse:
    """Run the decoupled chain: the part below the crack is elastic, and its motion shakes the block above.

    Parameters, result and errors are those of :func:`run`. Histories come at an even part of the record's step, up to
    5 ms, where no spacing is given.
    """
    return _completed(_decoupled(case, earthquake(case, motion, vertical), output_step), case)


def flexible(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> FlexibleResponse:
    """Run the flexible model: the parts above and below the crack are elastic.

    Parameters, result and errors are those of :func:`run`. Histories come every 0.01 s where no spacing is given.
    """
    return _completed(_flexible(case, earthquake(case, motion, vertical), output_step), case)


def earthquake(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    rotation: GroundMotion | None = None,
) -> Earthquake:
    """Return what shakes a case: the motions given, or its own, until the end that it asks for.

    Raises
    ------
    InputError
        Where there is no motion, or one that cannot be used.
    """
    if motion is None:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, vertical = resolve(case.motion, case.gravity, case.base_directory)
    elif vertical is None and case.motion is not None and case.motion.vertical is not None:
        left_out = Notice("vertical-left-out")
        motion = motion if left_out in motion.warnings else motion.with_warnings(left_out)
    end = case.motion.duration if case.motion and case.motion.duration else motion.duration
    return Earthquake(motion, vertical, end, rotation)


def _completed(response: R, case: Case) -> R:
    """Add what does not depend on the model. A run that never started says why by itself."""
    warnings = (*case_warnings(case), *response.motion.warnings, *response.warnings)
    if not response.summary:
        return replace(response, warnings=warnings)
    return replace(
        response,
        warnings=(*warnings, *standing_warnings(case, response.static)),
        limits=check_limits(case.limits, response.summary),
    )


def _rigid(case: Case, earthquake: Earthquake, output_step: float | None) -> Response:
    from heeltoe.models.rigid.model import run_rigid

    return run_rigid(case, earthquake, output_step)


def _decoupled(case: Case, earthquake: Earthquake, output_step: float | None) -> DecoupledResponse:
    from heeltoe.models.decoupled.model import run_decoupled

    return run_decoupled(case, earthquake, output_step)


def _flexible(case: Case, earthquake: Earthquake, output_step: float | None) -> FlexibleResponse:
    from heeltoe.models.flexible.model import run_flexible

    return run_flexible(case, earthquake, output_step)


#: The models by name.
MODELS: dict[str, Callable[[Case, Earthquake, float | None], Response]] = {
    "rigid": _rigid,
    "decoupled": _decoupled,
    "flexible": _flexible,
}

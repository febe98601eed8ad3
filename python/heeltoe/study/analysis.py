"""Any analysis of a case by its name: one model or two side by side, with a spread where it is wanted."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeVar

from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.models.run import MODELS, run
from heeltoe.result.response import Response
from heeltoe.study.comparison import Comparison, compare

R = TypeVar("R", bound=Response)
Say = Callable[[str], None]

#: Names of two models side by side, and what the block of the two is.
BOTH: dict[str, Literal["rigid", "decoupled"]] = {
    "both": "rigid",
    "rigid,flexible": "rigid",
    "decoupled,flexible": "decoupled",
}


def check_model(name: str, field: str) -> None:
    """Refuse a name of no model.

    Raises
    ------
    InputError
        Then.
    """
    if name not in (*MODELS, *BOTH):
        models = f"{', '.join(MODELS)}, both or decoupled,flexible"
        raise InputError("unknown-model", field, name, models=models)


def analyse(
    case: Case,
    model: str = "rigid",
    *,
    output_step: float | None = None,
    spread: int | Literal["cheap"] | None = None,
    say: Say = lambda text: None,
) -> Response | Comparison:
    """Run what is asked for.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    model
        ``"rigid"``, ``"decoupled"``, ``"flexible"``, ``"both"`` or ``"decoupled,flexible"``.
    output_step
        Spacing of the histories [s]; each model has its own where it is not given.
    spread
        How many runs with the shaking varied there are beside; ``"cheap"`` for those that cost milliseconds: of a rigid
        block that stands, whatever shakes it.
    say
        Told what goes on.

    Raises
    ------
    InputError
        Where there is no such model, or something in the case cannot be used.
    """
    check_model(model, "model")
    result: Response | Comparison
    if model in BOTH:
        say("running both models")
        result = compare(case, output_step=output_step, block=BOTH[model])
    else:
        say(f"running the {model} model")
        result = run(case, model, output_step=output_step)
    if spread is None:
        return result
    # Here, as only then its many runs are needed.
    from heeltoe.study.spread import RUNS, with_spread

    def vary(response: R) -> R:
        if spread == "cheap" and (response.elastic or not response.ok):
            return response

        def progress(done: int, of: int) -> None:
            say(f"varying the shaking of the {response.model} model, {done} of {of} runs done")

        return with_spread(response, case, RUNS if spread == "cheap" else spread, progress=progress)

    return result.with_responses(vary)

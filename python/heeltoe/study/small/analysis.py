"""Any analysis of a case by its name: one model or two side by side, with a spread where it is wanted."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeVar

from heeltoe.case.model import Case
from heeltoe.models.run import AUTO, check_model, cost_of, run
from heeltoe.result.response import Response

R = TypeVar("R", bound=Response)
Say = Callable[[str], None]


def analyse(
    case: Case,
    model: str = AUTO,
    *,
    output_step: float | None = None,
    spread: int | Literal["cheap"] | None = None,
    say: Say = lambda text: None,
) -> Response:
    """Run a case with the options of a command.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    model
        As :func:`heeltoe.run` takes it.
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
    if isinstance(spread, int):
        _check_spread(case, model, output_step, spread)
    say("running" if model == AUTO else f"running {model}")
    result = run(case, model, output_step=output_step)
    if spread is None:
        return result
    # Here, as only then its many runs are needed.
    from heeltoe.study.small.spread import RUNS, with_spread

    def vary(response: R) -> R:
        if spread == "cheap" and (response.elastic or not response.ok):
            return response

        def progress(done: int, of: int) -> None:
            say(f"varying the shaking of the {response.model} model, {done} of {of} runs done")

        return with_spread(response, case, RUNS if spread == "cheap" else spread, progress=progress)

    return result.with_responses(vary)


def _check_spread(case: Case, model: str, output_step: float | None, runs: int) -> None:
    """Refuse a spread that takes what a run by itself would not."""
    check_model(model, "model")
    alone, together = (cost_of(case, model, output_step, spread) for spread in (0, runs))
    if alone is None or together is None or not alone.within(case):
        return
    from heeltoe.models.flexible.body.cost import check_cost

    check_cost(case, together, "--spread")

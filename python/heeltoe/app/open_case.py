"""Actions of a tab as it comes: its case, an example to start from, its units."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TypedDict

from heeltoe.app.desk import BadRequestError, Desk, Entry, Request, text
from heeltoe.app.sessions import Session
from heeltoe.base.payload import Json
from heeltoe.case.examples import examples_folder
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError

#: What the app opens with.
FIRST = "typical-base"


def examples() -> list[str]:
    """Return the names of the cases to start from, that which the app opens with first."""
    names = sorted(path.stem for path in examples_folder().glob("*.toml"))
    return sorted(names, key=lambda name: name != FIRST)


def example_path(name: str) -> Path | None:
    """Return the file of an example, None for an unknown name."""
    return examples_folder() / f"{name}.toml" if name in examples() else None


def state(session: Session) -> Json:
    """Return what all pages of a tab stand on: its case and where its sliders are, as far as they were heard."""
    from heeltoe.app.sliders import sliders

    case = session.case
    if case is None:
        session.stated += 1
        numbers = {"state": session.stated, "heard": session.heard}
        return {"of": "state", **numbers, "case": None, "examples": examples(), "units": session.units}
    slider_list = sliders(case.with_numbers(session.changes) if session.changes else case, session.units)
    models = models_for(case)
    # Only where it can be said: the page answers by this number.
    session.stated += 1
    return {
        "of": "state",
        "state": session.stated,
        "heard": session.heard,
        "case": {"title": case.title, "example": session.example},
        "examples": examples(),
        "units": session.units,
        "sliders": [asdict(slider) for slider in slider_list],
        "moved": {slider.path: slider.value for slider in slider_list if slider.path in session.moved},
        "drained": case.uplift.pattern == "drained",
        **models,
    }


class Models(TypedDict):
    """Which models can be run on a case, and why not the elastic dam where it cannot."""

    models: list[str]
    inelastic: str


def models_for(case: Case) -> Models:
    """Return which models can be run on a case, and why not the elastic dam where it cannot."""
    from heeltoe.models.run import models_of

    usual, why = models_of(case)
    elastic = "flexible" in usual
    try:
        models_of(case, "rigid")
        models = ["rigid"]
    except InputError:
        models = []
    if models and case.concrete.modulus is not None and case.crack.elevation > 0.0:
        models.append("decoupled")
    if elastic:
        models.append("flexible")
    return {"models": models, "inelastic": "" if elastic else f"The elastic dam cannot be run: {why}."}


def begin(session: Session) -> Json:
    """Return the state of a tab that comes; a new one has the first example."""
    if session.case is None:
        _open(session, examples()[0])
    return state(session)


def _open(session: Session, name: str) -> None:
    from heeltoe.app.case.draft import start
    from heeltoe.case.fields_file import read_fields

    path = example_path(name)
    if path is None:
        raise BadRequestError(f"no example is called {name}; the first example is {FIRST}")
    start(session, read_fields(path))
    session.example = name
    session.kept.clear()


async def open_example(desk: Desk, request: Request) -> Json:
    """Open an example in the place of the case that the tab has."""

    def opened() -> Json:
        _open(desk.session, text(request, "name"))
        return state(desk.session)

    async with desk.session.turn:
        payload: Json = await desk.workers.quick(opened)
    return payload


async def set_units(desk: Desk, request: Request) -> Json:
    """Show everything in SI or in units of the United States."""
    name = text(request, "units")
    if name not in ("si", "us"):
        raise BadRequestError("units are si or us")
    async with desk.session.turn:
        desk.session.units = name
        payload: Json = await desk.workers.quick(state, desk.session)
    return payload


ACTIONS = {"open example": Entry(open_example), "units": Entry(set_units)}

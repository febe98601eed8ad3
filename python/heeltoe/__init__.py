"""Earthquake response of cracked concrete gravity dams: sliding, rocking, uplift and stresses."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from heeltoe.base.display import hand_in
from heeltoe.errors.sanitize import near

# Where each public name is at home; type checkers read the same below, and tests/test_names.py compares.
_HOME = {
    "Block": "mechanics.block",
    "Case": "case.model",
    "DamPeriods": "models.flexible.body.periods",
    "FlexibleDam": "models.flexible.body.reduced",
    "GroundMotion": "motion.ground_motion",
    "HeeltoeError": "errors.error",
    "InputError": "errors.error",
    "Response": "result.response",
    "Statics": "models.statics.model",
    "animate": "views.animation.write",
    "asce_7": "motion.targets",
    "build_block": "mechanics.block",
    "build_flexible_dam": "models.flexible.body.reduced",
    "dam_periods": "models.flexible.body.periods",
    "decoupled": "models.run",
    "en_1998": "motion.targets",
    "fit_laws": "mechanics.law_fit",
    "flexible": "models.run",
    "match": "motion.matching",
    "open_study": "study.answers.study_results",
    "overturning_map": "study.small.overturning",
    "read_case": "case.read",
    "read_channels": "motion.records.read",
    "read_levels": "study.plan.levels",
    "read_record": "motion.records.read",
    "read_shear_tests": "mechanics.shear_tests",
    "read_study": "study.plan.file",
    "response_spectrum": "motion.spectrum",
    "rigid": "models.run",
    "rigid_many": "models.rigid.many",
    "run": "models.run",
    "run_levels": "study.run.levels",
    "run_study": "study.run.run",
    "run_suite": "study.run.suite",
    "solve": "study.small.solve",
    "statics": "models.statics.model",
    "statics_of_sections": "models.statics.joints",
    "stochastic_motion": "motion.stochastic",
    "synthetic": "motion.scenario",
    "verdict": "result.verdict",
    "with_response_spectrum": "study.small.response_spectrum",
    "with_spread": "study.small.spread",
    "write_report": "views.report.write",
    "write_workbook": "views.files.workbook",
}

__all__ = sorted(_HOME)

if TYPE_CHECKING:
    from heeltoe.case.model import Case as Case
    from heeltoe.case.read import read_case as read_case
    from heeltoe.errors.error import HeeltoeError as HeeltoeError
    from heeltoe.errors.error import InputError as InputError
    from heeltoe.mechanics.block import Block as Block
    from heeltoe.mechanics.block import build_block as build_block
    from heeltoe.mechanics.law_fit import fit_laws as fit_laws
    from heeltoe.mechanics.shear_tests import read_shear_tests as read_shear_tests
    from heeltoe.models.flexible.body.periods import DamPeriods as DamPeriods
    from heeltoe.models.flexible.body.periods import dam_periods as dam_periods
    from heeltoe.models.flexible.body.reduced import FlexibleDam as FlexibleDam
    from heeltoe.models.flexible.body.reduced import build_flexible_dam as build_flexible_dam
    from heeltoe.models.rigid.many import rigid_many as rigid_many
    from heeltoe.models.run import decoupled as decoupled
    from heeltoe.models.run import flexible as flexible
    from heeltoe.models.run import rigid as rigid
    from heeltoe.models.run import run as run
    from heeltoe.models.statics.joints import statics_of_sections as statics_of_sections
    from heeltoe.models.statics.model import Statics as Statics
    from heeltoe.models.statics.model import statics as statics
    from heeltoe.motion.ground_motion import GroundMotion as GroundMotion
    from heeltoe.motion.matching import match as match
    from heeltoe.motion.records.read import read_channels as read_channels
    from heeltoe.motion.records.read import read_record as read_record
    from heeltoe.motion.scenario import synthetic as synthetic
    from heeltoe.motion.spectrum import response_spectrum as response_spectrum
    from heeltoe.motion.stochastic import stochastic_motion as stochastic_motion
    from heeltoe.motion.targets import asce_7 as asce_7
    from heeltoe.motion.targets import en_1998 as en_1998
    from heeltoe.result.response import Response as Response
    from heeltoe.result.verdict import verdict as verdict
    from heeltoe.study.answers.study_results import open_study as open_study
    from heeltoe.study.plan.file import read_study as read_study
    from heeltoe.study.plan.levels import read_levels as read_levels
    from heeltoe.study.run.levels import run_levels as run_levels
    from heeltoe.study.run.run import run_study as run_study
    from heeltoe.study.run.suite import run_suite as run_suite
    from heeltoe.study.small.overturning import overturning_map as overturning_map
    from heeltoe.study.small.response_spectrum import with_response_spectrum as with_response_spectrum
    from heeltoe.study.small.solve import solve as solve
    from heeltoe.study.small.spread import with_spread as with_spread
    from heeltoe.views.animation.write import animate as animate
    from heeltoe.views.files.workbook import write_workbook as write_workbook
    from heeltoe.views.report.write import write_report as write_report


def _html(thing: object) -> str:
    from heeltoe.views.notebook import html

    return html(thing)


def _plot(thing: object, name: str | None, path: Any, units: str | None) -> Any:
    from heeltoe.views.plot import plot

    return plot(thing, name, path, units)


hand_in(html=_html, plot=_plot)


def __getattr__(name: str) -> Any:
    """Import on first use, so that ``heeltoe --help`` does not wait for the plots."""
    if name not in _HOME:
        hint = "" if name.startswith("_") else near(name, _HOME)
        raise AttributeError(f"module 'heeltoe' has no attribute {name!r}{hint}", name=name, obj=None)
    value = getattr(import_module(f"heeltoe.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Return the public names, used already or not."""
    return list(__all__)

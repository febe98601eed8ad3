"""Stability before, during (pseudo-static) and after the earthquake, judged by the criteria of the case."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from heeltoe.base.display import Shown
from heeltoe.base.pandas import dataframe_of_rows
from heeltoe.case.field_usage import unused_fields
from heeltoe.case.model import Case
from heeltoe.case.warnings import case_warnings, unusual
from heeltoe.errors.error import expect
from heeltoe.kernel.build import build_info
from heeltoe.mechanics.block import build_block, static_state, without_bond
from heeltoe.mechanics.loads import water_above_crack
from heeltoe.mechanics.references import REFERENCES
from heeltoe.models.statics.cases import NO_SLIP, OWN_SLIP, flood, post_seismic, pseudo_static, response_spectrum, usual
from heeltoe.models.statics.checks import Check, check_case, fallen
from heeltoe.models.statics.criteria import unread
from heeltoe.models.statics.levels import critical_water_levels, highest_level
from heeltoe.models.statics.load_case import LoadCase, along_line
from heeltoe.models.statics.own_criteria import Rules, rules_of
from heeltoe.models.statics.spectral import SpectralDemand
from heeltoe.result.contract import SHEARS_M
from heeltoe.result.write import critical_json
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice, by_gravity

# So many checks that are not met are told at once.
_MOST_MISSED = 3


@dataclass(frozen=True)
class Statics(Shown):
    """Result of the static checks.

    Attributes
    ----------
    title
        Title of the case.
    criteria, structure, site_information
        What the checks are judged by.
    cases
        The load cases, one by one.
    checks
        Every requirement with its value.
    critical_acceleration_g
        Ground accelerations in g at which the block at rest starts to slide and to rock, each way by itself; infinite
        where no acceleration does it, negative where the static loads do. Cohesion does not count.
    critical_water_level_m
        Depth of the reservoir, from the lowest point of the section, at which the usual loads bring the factor of
        sliding downstream to 1 ("sliding") and to the required factor ("sliding_required"), open the crack through
        ("overturning") and leave no normal force ("flotation"); None where no depth up to `highest_water_level_m` does.
        Cohesion counts in the first two.
    highest_water_level_m
        Depth up to which these were looked for: the crest, or the flood where that is above it.
    slip_m, slip_source
        Residual slip of the post-seismic case and where it comes from; None without that case.
    warnings
        What a reader must know before using the numbers.
    references
        Sources of the criteria and methods used.
    response_spectrum
        What an earthquake asks of the section by its response spectrum; None without one.
    """

    title: str
    criteria: str
    structure: str
    site_information: str
    cases: tuple[LoadCase, ...]
    checks: tuple[Check, ...]
    critical_acceleration_g: Mapping[str, float]
    critical_water_level_m: Mapping[str, float | None]
    highest_water_level_m: float
    slip_m: float | None
    slip_source: str | None
    warnings: tuple[Notice, ...]
    references: tuple[str, ...]
    response_spectrum: SpectralDemand | None = None

    def __repr__(self) -> str:
        missed = [check for check in self.checks if not check.met]
        lines = [
            f"<Statics: {self.title or 'untitled case'!r}, {', '.join(load_case.name for load_case in self.cases)}"
        ]
        lines.append(f"  {len(self.checks) - len(missed)} of {len(self.checks)} checks are met ({self.criteria})")
        lines += [f"  not met: {check.sentence}" for check in missed[:_MOST_MISSED]]
        if len(missed) > _MOST_MISSED:
            lines.append(f"  and {len(missed) - _MOST_MISSED} more in .checks")
        return "\n".join(lines) + ">"

    def to_pandas(self) -> Any:
        """Return the checks, one in each row, as a ``pandas.DataFrame``."""
        return dataframe_of_rows([check.to_json() for check in self.checks])

    @property
    def ok(self) -> bool:
        """Whether every check is met."""
        return all(check.met for check in self.checks)

    def to_json(self) -> dict[str, Any]:
        """Return a dictionary of plain numbers, strings and lists."""
        critical, left_out = critical_json(self.critical_acceleration_g)
        return {
            "model": "statics",
            "title": self.title,
            "criteria": self.criteria,
            "structure": self.structure,
            "site_information": self.site_information,
            "ok": self.ok,
            "cases": [load_case.to_json() for load_case in self.cases],
            "checks": [check.to_json() for check in self.checks],
            "critical_acceleration_g": critical,
            "left_out": left_out,
            "critical_water_level_m": dict(self.critical_water_level_m),
            "highest_water_level_m": self.highest_water_level_m,
            "slip_m": self.slip_m,
            "slip_source": self.slip_source,
            "warnings": [warning.to_json() for warning in self.warnings],
            "references": list(self.references),
            "response_spectrum": None if self.response_spectrum is None else self.response_spectrum.to_json(),
            "build": build_info(),
        }


def statics(
    case: Case,
    slip_m: float | None = None,
    *,
    slip_source: str = "given",
    overturned_about: str | None = None,
    ligament: tuple[float, float] | None = None,
    beside: tuple[str, ...] = (),
) -> Statics:
    """Judge the stability of the block above the crack.

    Load cases: usual; flood where ``statics.flood_depth`` is given; pseudo-static both ways where
    ``statics.seismic_coefficient`` or ``statics.earthquakes`` are; post-seismic where a slip or a residual friction is
    given or the case has a motion. Docs/statics.md has the equations.

    Parameters
    ----------
    case
        Dam, crack, water and the choices of ``[statics]``.
    slip_m
        Residual slip that the earthquake leaves, positive downstream [m]; that of ``statics.residual_slip`` where it is
        not given. Without either it is zero, and a warning says so: this function runs no earthquake.
    slip_source
        Where `slip_m` comes from, for the result.
    overturned_about
        "toe" or "heel" where the earthquake has overturned the block: the check after it fails then.
    ligament
        From where to where the earthquake has left a bonded joint whole [m from the heel]; there its bond counts after
        the earthquake.
    beside
        Models whose runs stand beside these checks: of fields that they read it is not said that they change nothing.

    Returns
    -------
    Statics

    Raises
    ------
    InputError
        Where the crack does not cut the section in two.
    """
    expect(case, Case, "a case", "case")
    section, choice, rules = case.cut, case.statics, rules_of(case)
    warnings = [*case_warnings(case), *unused_fields(case, ("statics", *beside)), *_unread(case, rules)]
    before = usual(case)
    solved = [before, *([flood(case)] if choice.flood_depth is not None else [])]
    if choice.pseudo_static:
        solved += pseudo_static(case, before)
    cases = [outcome.load_case for outcome in solved]
    checks = [check for load_case in cases for check in check_case(load_case, case)]
    slip, source = _slip(case, slip_m, slip_source)
    if overturned_about is not None:
        slip, source = None, None
        checks.append(
            fallen(f"the earthquake overturns the block about its {overturned_about}: nothing stands after it")
        )
    if slip is not None and source is not None:
        after = post_seismic(case, slip, source, ligament)
        if after is None:
            lost = "a slip of {slip_m:.2f m} leaves nothing of the {width_m:.2f m} that the block stood on"
            checks.append(fallen(lost, slip_m=abs(slip), width_m=section.crack_width))
        else:
            cases.append(after.load_case)
            checks += check_case(after.load_case, case)
            warnings += _about_anchors_after(case, slip, source, after.load_case)
        if source == NO_SLIP:
            warnings.append(Notice("slip-unknown"))
    warnings += _warnings_of_cases(case, cases)
    references = dict.fromkeys(check.source for check in checks if check.required is not None)
    if choice.pseudo_static and water_above_crack(case, case.reservoir):
        references[REFERENCES["water"]] = None
    return Statics(
        title=case.title,
        criteria=rules.name,
        structure=choice.structure,
        site_information=choice.site_information,
        cases=tuple(cases),
        checks=tuple(checks),
        critical_acceleration_g=static_state(without_bond(build_block(case))).critical_acceleration_g,
        critical_water_level_m=critical_water_levels(case),
        highest_water_level_m=highest_level(case),
        slip_m=slip,
        slip_source=source,
        warnings=by_gravity(warnings),
        references=tuple(references),
    )


def with_demand(judged: Statics, case: Case, demand: SpectralDemand) -> Statics:
    """Return the checks of a case with those of an earthquake by its response spectrum, before the post-seismic
    ones."""
    cases = [solved.load_case for solved in response_spectrum(case, usual(case), demand)]
    checks = [check for load_case in cases for check in check_case(load_case, case)]
    during = sum(load_case.loads != "post-earthquake" for load_case in judged.cases)
    names = {load_case.name for load_case in judged.cases[:during]}
    judged_during = sum(check.load_case in names for check in judged.checks)
    # The elastic dam reads more of the case than the block does.
    spoken = [notice for notice in judged.warnings if notice.code != "fields-unused"]
    unread = [notice for notice in unused_fields(case, ("statics", "flexible")) if notice.code == "fields-unused"]
    return replace(
        judged,
        warnings=by_gravity([*spoken, *unread]),
        cases=(*judged.cases[:during], *cases, *judged.cases[during:]),
        checks=(*judged.checks[:judged_during], *checks, *judged.checks[judged_during:]),
        references=(*judged.references, REFERENCES["response spectrum"], REFERENCES["rigid response"]),
        response_spectrum=demand,
    )


def _peak(case: Case, usual: LoadCase) -> float:
    """Return the friction of the crack before any slip; by a law, under the usual loads."""
    return case.crack.apparent_friction if case.crack.law is None else usual.friction


def _warnings_of_cases(case: Case, cases: Sequence[LoadCase]) -> list[Notice]:
    """Return remarks on the choices, the usual load case first."""
    choice, notices, usual = case.statics, list(_of_pieces(cases)), cases[0]
    if usual.cracked_length_m:
        notices.append(Notice("crack-opens-statically", length_m=usual.cracked_length_m))
    usual_depth = case.reservoir.depth if case.reservoir else 0.0
    if choice.flood_depth is not None and choice.flood_depth < usual_depth:
        why = "the flood is lower than the {usual_depth_m:g m} of the usual loads"
        notices.append(unusual("statics.flood_depth", why, usual_depth_m=usual_depth))
    if choice.residual_friction is not None and choice.residual_friction > _peak(case, usual):
        why = "more than the friction of the crack before it has slid"
        notices.append(unusual("statics.residual_friction", why))
    if any(anchor.yields for anchor in case.anchors):
        notices.append(Notice("anchors-as-prestress"))
    if choice.sections:
        notices.append(Notice("sections-apart", count=len(choice.sections)))
    notices.extend(_about_the_drains(case))
    return notices


def _about_the_drains(case: Case) -> Iterator[Notice]:
    """Say where the manual behind the criteria measures the efficiency of drains in another way."""
    uplift = case.uplift_at_crack
    share, position = uplift.drain_efficiency, uplift.drain_position
    if rules_of(case).name == "USACE" and uplift.pattern == "drained" and share is not None and position is not None:
        theirs = 1.0 - (1.0 - share) * (1.0 - position)
        if theirs != share:
            yield Notice("drains-by-manual", efficiency=share, same=theirs)


def _about_anchors_after(case: Case, slip: float, source: str, after: LoadCase) -> Iterator[Notice]:
    """Say what stays of the sliding factor after the earthquake if its slip has broken the anchors."""
    if not any(anchor.prestress for anchor in case.anchors) or abs(slip) < SHEARS_M:
        return
    bare = post_seismic(case.model_copy(update={"anchors": ()}), slip, source)
    factor = None if bare is None else bare.load_case.sliding_factor
    if after.sliding_factor is not None and factor is not None:
        yield Notice("anchors-after-slip", slip_m=abs(slip), factor=after.sliding_factor, bare_factor=factor)


def _of_pieces(cases: Sequence[LoadCase]) -> Iterator[Notice]:
    """Say what the pieces of a crack with kinks would add under the usual loads to the friction that is counted, and
    where they take from it."""
    usual = cases[0]
    along, angle = along_line(usual), math.degrees(usual.steepest_rise_rad)
    if usual.pieces_bear == "any push":
        bear = Sentence("any push until something shears off")
        yield Notice("kinks-beside-line", "add", along=along, angle_deg=angle, bear=bear)
    elif usual.pieces_bear == "more":
        factor = usual.sliding_factor_on_pieces
        bear = Sentence.of("a factor of {factor:.3f} if nothing shears off", factor=factor)
        yield Notice("kinks-beside-line", "add", along=along, angle_deg=angle, bear=bear)
    for load_case in cases:
        if load_case.pieces_bear == "less":
            yield Notice(
                "kinks-beside-line",
                "take",
                name=load_case.name,
                along=along_line(load_case),
                factor=load_case.sliding_factor,
            )


def _unread(case: Case, rules: Rules) -> tuple[Notice, ...]:
    """Name given fields that the criteria do not use."""
    idle = [f"statics.{name}" for name in unread(rules.rows) if name in case.statics.model_fields_set]
    why = f'statics.criteria = "{rules.name}"'
    return (Notice("fields-idle", field=idle[0], fields=", ".join(idle), why=why),) if idle else ()


def _slip(case: Case, slip: float | None, source: str) -> tuple[float | None, str | None]:
    """Return the residual slip and where it comes from; None where nothing asks for a post-seismic case."""
    if slip is not None:
        return slip, source
    if case.statics.residual_slip is not None:
        return case.statics.residual_slip, OWN_SLIP
    if case.statics.residual_friction is not None or case.motion is not None:
        return 0.0, NO_SLIP
    return None, None

"""Required and computed values of each load case, each with a sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from heeltoe.base.blocks import Block, Number
from heeltoe.case.model import Case
from heeltoe.models.statics.criteria import Criterion
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.models.statics.own_criteria import criteria_of
from heeltoe.units.sentences import Sentence

# A value that meets its limit to rounding meets it.
_ROUNDING = 1e-9
_ZONES = {1.0 / 6.0: "the middle third", 1.0 / 4.0: "the middle half", 1.0 / 2.0: "the base"}


class Check(Block):
    """A requirement and what is there."""

    load_case: Annotated[str, Number("Name of the load case.")]
    name: Annotated[
        str,
        Number(
            '"equilibrium", "sliding factor", "flotation factor", "resultant", "compression" or, by a user\'s own '
            'criteria, "overturning factor".'
        ),
    ]
    value: Annotated[
        float | None,
        Number(
            "Value of the check: a factor, the distance of the resultant from the middle of the contact over its "
            "width, or a stress over the strength; null where it does not exist."
        ),
    ]
    required: Annotated[float | None, Number("Required value, in the same measure; null without one.")]
    at_least: Annotated[bool, Number("Whether the value must be at least, not at most, the required one.")]
    met: Annotated[bool, Number("Whether it is.")]
    source: Annotated[str, Number("Document and paragraph.")] = "equilibrium"
    note: Annotated[str, Number("Remark on the required value.")] = ""
    sentence: Annotated[Sentence, Number("All this in words, with by how much.")]

    @property
    def margin(
        self,
    ) -> Annotated[
        float | None,
        Number(
            "Capacity over demand: 1 just meets the requirement, 0 where the block does not stand; null without "
            "a required value."
        ),
    ]:
        """Capacity over demand."""
        if self.value is None or self.required is None:
            return None if self.met else 0.0
        if self.at_least:
            return self.value / self.required
        # What is far inside leaves a margin as large as numbers of a table may be.
        return self.required / max(self.value, self.required * 1e-3)


def check_case(outcome: LoadCase, case: Case) -> tuple[Check, ...]:
    """Return the checks of a load case by the criteria that a case chooses, equilibrium first.

    A sliding factor is judged by the factors for cohesion only where cohesion is in its resistance. Of two signs of a
    vertical seismic coefficient each check counts where it is worse.
    """
    strength = case.statics.compressive_strength
    checks = [_equilibrium(outcome)]
    for row in criteria_of(case, outcome.loads, cohesion=outcome.cohesive_force_n > 0.0):
        if row.check == "compression":
            if strength is not None:
                checks.append(_compression(outcome, row, strength))
        elif row.check == "resultant":
            checks.append(_resultant(outcome, row))
        else:
            checks.append(_factor(outcome, row, _by_friction(outcome, case)))
    return tuple(check for check in checks if outcome.governs is None or check.name in outcome.governs)


def _by_friction(outcome: LoadCase, case: Case) -> str:
    """Say the sliding factor by friction alone where cohesion is counted, and what criteria with a table of their own
    for it ask; nothing elsewhere."""
    if not outcome.cohesive_force_n or outcome.friction_factor is None:
        return ""
    words = f"by friction alone {outcome.friction_factor:.2f}"
    rows = criteria_of(case, outcome.loads, cohesion=False)
    asked = next((row for row in rows if row.check == "sliding" and row.cohesion is False), None)
    return words if asked is None else f"{words}, where {asked.required:.2f} is asked ({asked.paragraph})"


def fallen(words: str, **quantities: float) -> Check:
    """Return the check of a block that the earthquake leaves nowhere to stand, as the words say."""
    text = Sentence.of(f"post-seismic: {words}", **quantities)
    return _stands("post-seismic", text, met=False)


def _stands(load_case: str, sentence: Sentence, *, met: bool) -> Check:
    return Check(
        load_case=load_case, name="equilibrium", value=None, required=None, at_least=True, met=met, sentence=sentence
    )


def _equilibrium(outcome: LoadCase) -> Check:
    quantities = {}
    if outcome.outcome == "stands":
        words = "the block stands"
        if outcome.cracked_length_m:
            words += f" with {{length_m:.2f m}} of its crack open from the {outcome.cracked_from}"
            quantities["length_m"] = outcome.cracked_length_m
    elif outcome.outcome == "floats":
        words = "the water lifts the block with {lift_n:.4g kN/m} more than holds it down"
        quantities["lift_n"] = -outcome.normal_force_n
    else:
        words = f"the crack opens through from the {outcome.cracked_from}"
        eccentricity = outcome.eccentricity_m
        if eccentricity is not None:
            beyond = abs(eccentricity) - outcome.contact_width_m / 2.0
            end = "toe" if eccentricity > 0.0 else "heel"
            words += f"; the resultant is {{away_m:.2f m}} {'beyond' if beyond > 0.0 else 'inside'} the {end}"
            quantities["away_m"] = abs(beyond)
    sentence = Sentence.of("{load_case}: " + words, load_case=outcome.name, **quantities)
    return _stands(outcome.name, sentence, met=outcome.outcome == "stands")


def _factor(outcome: LoadCase, row: Criterion, by_friction: str) -> Check:
    name = f"{row.check} factor"
    values = {
        "sliding": (outcome.sliding_factor, "nothing pushes along the crack"),
        "overturning": (outcome.overturning_factor, "nothing turns the block over"),
        "flotation": (outcome.flotation_factor, "nothing pushes up"),
    }
    value, nothing = values[row.check]
    if value is None:
        return _check(outcome, name, None, row, True, nothing)
    met = value >= row.required * (1.0 - _ROUNDING)
    digits = _digits(value - row.required)
    words = (
        f"{name} {value:.{digits}f} is {abs(value - row.required):.{digits}f} {'above' if met else 'below'} "
        f"the {row.required:.2f} of {{source}}"
    )
    if row.check == "sliding" and by_friction:
        words += f"; {by_friction}"
        row = replace(row, note=f"{row.note}; {outcome.name}: {by_friction}" if row.note else by_friction)
    return _check(outcome, name, value, row, met, words)


def _resultant(outcome: LoadCase, row: Criterion) -> Check:
    eccentricity = outcome.eccentricity_m
    if eccentricity is None:
        return _check(outcome, "resultant", None, row, False, "no resultant, the block floats; {source} asks for one")
    width = outcome.contact_width_m
    value = abs(eccentricity) / width
    met = value <= row.required * (1.0 + _ROUNDING) and outcome.outcome == "stands"
    away = value * width - row.required * width
    digits = _digits(away)
    side = "downstream" if eccentricity >= 0.0 else "upstream"
    place = f"{{eccentricity_m:.{digits}f m}} {side} of" if round(abs(eccentricity), digits) else "in"
    words = (
        f"resultant {place} the middle is {{away_m:.{digits}f m}} "
        f"{'outside' if away > 0.0 else 'inside'} {_zone(row.required)} of {{source}}"
    )
    if outcome.outcome != "stands":
        words += (
            f", but the block {outcome.outcome}" if outcome.outcome == "floats" else ", but the crack opens through"
        )
    return _check(outcome, "resultant", value, row, met, words, eccentricity_m=abs(eccentricity), away_m=abs(away))


def _compression(outcome: LoadCase, row: Criterion, strength: float) -> Check:
    if outcome.heel_stress_pa is None or outcome.toe_stress_pa is None:
        words = "no stress to compare with {source}: the block does not stand"
        return _check(outcome, "compression", None, row, False, words)
    stress = max(outcome.heel_stress_pa, outcome.toe_stress_pa)
    if row.largest_pa is not None:
        row = replace(row, required=min(row.required, row.largest_pa / strength))
    value, allowed = stress / strength, row.required * strength
    met = value <= row.required * (1.0 + _ROUNDING)
    digits = _digits((stress - allowed) / 1e6)
    words = (
        f"compression {{stress_pa:.{digits}f MPa}} is {{apart_pa:.{digits}f MPa}} "
        f"{'below' if met else 'above'} the {{allowed_pa:.2f MPa}} ({row.required:.3g} of the strength) of "
        "{source}"
    )
    stresses = {"stress_pa": stress, "apart_pa": abs(stress - allowed), "allowed_pa": allowed}
    return _check(outcome, "compression", value, row, met, words, **stresses)


def _zone(share: float) -> str:
    return _ZONES.get(share) or f"the middle {200.0 * share:.3g} %"


def _check(
    outcome: LoadCase, name: str, value: float | None, row: Criterion, met: bool, words: str, **quantities: float
) -> Check:
    sentence = Sentence.of("{load_case}: " + words, load_case=outcome.name, source=row.source, **quantities)
    return Check(
        load_case=outcome.name,
        name=name,
        value=value,
        required=row.required,
        at_least=row.at_least,
        met=met,
        source=row.source,
        note=row.note,
        sentence=sentence,
    )


def _digits(difference: float) -> int:
    """Return how many decimals show a difference: two, or as many as its first figure needs."""
    return next((digits for digits in range(2, 7) if round(abs(difference), digits)), 2)

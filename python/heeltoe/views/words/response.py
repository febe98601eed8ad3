"""Rows and sentences of a response: its cracks, motions, spread, laws, largest tension, warnings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from heeltoe.errors.sanitize import plain
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.contract import HEADLINES, LENGTHS, RESIDUAL_SLIP
from heeltoe.result.numbers import FrictionLawState, Roughness, Tension
from heeltoe.result.response import Response
from heeltoe.result.tension import place_phrase
from heeltoe.units.sentences import written
from heeltoe.views.words.numbers import Amount, Cell, in_one_unit
from heeltoe.warnings.input import Severity

#: Names of the dam of a model, at the head of a column.
NAMES = {"rigid": "rigid block", "flexible": "flexible dam", "decoupled": "decoupled block"}
#: Figures that each of several cracks has.
OF_CRACKS = (
    "response",
    "slip-by-mode",
    "friction",
    "forces",
    "bearing",
    "path",
    "scatter",
    "joint",
    "crack",
    "pressure",
)
# Of a table of several cracks.
CRACK_COLUMNS = ("crack at", *(item.heading for item in LENGTHS), "strikes")


def crack_rows(response: Response, units: str) -> list[list[str]]:
    """Return the rows of :data:`CRACK_COLUMNS`, from the crest down."""
    cells: list[list[Cell]] = []
    for place, crack in enumerate(response.cracks):
        at = written("{at_m:g m}", units, at_m=crack.elevation)
        marks = [*(["leads"] if place == response.asked else []), *(["means"] if crack.scatters else [])]
        mark = f" ({', '.join(marks)})" if marks else ""
        cells.append([f"{at}{mark}", *(Amount(item.way * item.of(crack), item.kind) for item in LENGTHS)])
    rows = in_one_unit(cells, units)
    return [[*row, str(crack.impacts)] for crack, row in zip(response.cracks, rows, strict=True)]


SEQUENCE_COLUMNS = ("motion", "peak", "slip in it", "slip after it", "opens upstream", "at rest", "static checks")


def part_lines(motion: GroundMotion, gravity: float) -> Iterator[str]:
    """Walk the motions of a sequence: name, peak, from when to when, and what was done to each."""
    for number, part in enumerate(motion.parts, 1):
        yield "; ".join(
            (
                f"{number} {plain(part.name)}: {part.pga / gravity:.4g} g, {part.begins:.4g} to {part.ends:.4g} s",
                *map(plain, part.processing),
            )
        )


def sequence_rows(response: Response, units: str) -> list[list[str]]:
    """Return the rows of :data:`SEQUENCE_COLUMNS`; slips are positive downstream."""
    rows: list[tuple[Cell, ...]] = []
    for number, stage in enumerate(response.sequence, 1):
        rows.append(
            (
                f"{number} ({stage.begins_s:.4g} s)",
                f"{stage.pga_g:.3g} g",
                Amount(stage.slip_m),
                Amount(RESIDUAL_SLIP.of(stage)),
                Amount(stage.opening_upstream_m, "opening"),
                "yes" if stage.at_rest else "no",
                "met" if stage.static["ok"] else f"{len(stage.static['missed'])} not met",
            )
        )
    return in_one_unit(rows, units)


#: What stands above the numbers of a row.
SPREAD_COLUMNS = ("this run", "mean", "std. dev.", "least", "most")


def spread_rows(response: Response, units: str) -> list[list[str]]:
    """Return label, value and spread of all numbers that are not negligible, each quantity in one unit."""
    spread = response.spread
    assert spread is not None
    rows: list[list[Cell]] = []
    for headline in HEADLINES:
        statistics = spread[headline.key]
        if statistics is None:
            continue
        values = [
            response.summary[headline.key],
            statistics["mean"],
            statistics["std"],
            statistics["min"],
            statistics["max"],
        ]
        if max(map(abs, values)) < headline.least:
            continue
        if headline.way < 0:
            values = [-values[0], -values[1], values[2], -values[4], -values[3]]
        rows.append([headline.label, *(Amount(value, headline.kind) for value in values)])
    return in_one_unit(rows, units)


def spread_sentence(response: Response, units: str) -> str:
    """Say which runs a spread is of."""
    spread = response.spread
    assert spread is not None
    step = written(", at a step of {time_step_s:.3g ms}", units, **spread) if "time_step_s" in spread else ""
    failed = f", {spread['failed']} of them without a result" if spread["failed"] else ""
    return (
        f"spread over {spread['runs']} runs with the shaking scaled by {spread['scales'][0]:g} to "
        f"{spread['scales'][-1]:g}{step}{failed}"
    )


def law_lines(response: Response, units: str) -> list[tuple[str, str]]:
    """Return the final state of friction laws and a rough crack: labels, which name the crack of several, and words."""
    laws = [(crack.elevation, crack.friction_law) for crack in response.cracks if response.several]
    own, rough = (response.summary.get(name) for name in ("friction_law", "roughness"))
    lines = [
        (written("friction law at {at_m:g m}", units, at_m=elevation), law_line(law, units))
        for elevation, law in laws
        if law is not None
    ]
    if not lines and own is not None:
        lines = [("friction law", law_line(own, units))]
    return lines if rough is None else [*lines, ("rough crack", roughness_line(rough, units))]


def roughness_line(quantities: Roughness, units: str) -> str:
    """Say how far a rough crack has dilated, how worn it is, and what its friction was before and is after."""
    text = (
        "dilated by {peak_dilation_m:.3g mm} at most, {residual_dilation_m:.3g mm} in the end; the flanks wore from "
        f"{math.degrees(quantities.asperity_angle_before_rad):.3g} to "
        f"{math.degrees(quantities.asperity_angle_after_rad):.3g} degrees; the apparent friction is "
        "{apparent_friction_after:.4g}, before {apparent_friction_before:.4g}"
    )
    return written(text, units, **quantities)


def law_line(quantities: FrictionLawState, units: str) -> str:
    """Say how far the crack has slipped, and what its friction was before and is after."""
    text = (
        "{name}; after {slip_path_m:.4g mm} of slip, to and fro, the apparent friction is "
        "{apparent_friction_after:.4g}, before {apparent_friction_before:.4g}, under {normal_stress_pa:.3g MPa}"
    )
    if quantities.cohesion_left_pa is not None:
        text += "; {cohesion_left_pa:.3g MPa} of cohesion is left"
    if "slip_path_range_m" in quantities:
        names = ("slip_path_range_m", "apparent_friction_before_range", "apparent_friction_after_range")
        ends = {f"{name}_{k}": quantities[name][k] for name in names for k in (0, 1)}
        text += (
            "; along the crack {slip_path_range_m_0:.4g mm} to {slip_path_range_m_1:.4g mm} of slip, friction "
            "{apparent_friction_before_range_0:.3g} to {apparent_friction_before_range_1:.3g} before, "
            "{apparent_friction_after_range_0:.3g} to {apparent_friction_after_range_1:.3g} after"
        )
        return written(text, units, **quantities, **ends)
    return written(text, units, **quantities)


def tension_line(tension: Tension, units: str) -> str:
    """Say how large the largest tension is, where and when, and what the concrete bears."""
    text = written(
        "{stress_pa:.3g MPa} at {time_s:.2f s} {where}, {z_m:.3g m} up; ",
        units,
        stress_pa=tension.stress_pa,
        time_s=tension.time_s,
        where=place_phrase(tension),
        z_m=tension.z_m,
    )
    strength = tension.strength
    if strength is None:
        return text + "the case gives no concrete.tensile_strength to judge it by"
    return text + written(
        "{judged} the {dynamic_pa:.3g MPa} that the concrete bears in an earthquake, {static_pa:.3g MPa} without one",
        units,
        judged="MORE than" if strength.exceeds else "within",
        dynamic_pa=strength.dynamic_pa,
        static_pa=strength.static_pa,
    )


def tension_worth(tension: Tension, units: str) -> str:
    """Say how far from the crack it is read, and what another mesh makes of it."""
    text = written(
        "read {apart_m:.2g m} from the crack at least, as it has no bound there",
        units,
        apart_m=tension.read_from_crack_m,
    )
    mesh = tension.mesh
    if mesh is None:
        return f"{text}; compared with no other mesh"
    return text + written(
        "; {stress_pa:.3g MPa} with {across:d} elements along the crack",
        units,
        stress_pa=mesh.stress_pa,
        across=mesh.other_elements_across,
    )


def listed(responses: Sequence[Response], units: str = "si") -> dict[str, Severity]:
    """Return every warning once with how grave it is, in units ``"si"`` or ``"us"``; those of one of two models say
    whose they are."""
    by_model = [(run.model, {warning.text(units): warning.severity for warning in run.warnings}) for run in responses]
    shared = {text: grave for text, grave in by_model[0][1].items() if all(text in texts for _, texts in by_model)}
    own = [(f"{model}: {text}", texts[text]) for model, texts in by_model for text in texts if text not in shared]
    return shared | dict(own)

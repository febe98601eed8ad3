"""How far to trust the numbers: spread, convergence, energy ledger, contact."""

from __future__ import annotations

from heeltoe.models.rigid.varying import varies
from heeltoe.result.contract import HEADLINES
from heeltoe.result.outcome import Outcome
from heeltoe.units.write import NOTHING
from heeltoe.views.content.subject import Labels, Run, Subject
from heeltoe.views.content.tree import Block, Code, Inline, Section, Table, paragraph

_ENERGY = (
    ("Put in", "input_j"),
    ("Friction", "friction_j"),
    ("Impacts", "impact_j"),
    ("Damping of the concrete", "damping_j"),
    ("Fracture of the joint", "fracture_j"),
    ("Left in and through the rock", "rock_j"),
    ("Left through the floor of the reservoir", "floor_j"),
    ("Left along the reservoir", "far_end_j"),
    ("Lost by the time stepping", "numerical_j"),
    ("Left in the dam", "left_j"),
    ("Made by contact, which should be none", "gained_j"),
    ("What the ledger leaves unexplained, over the turnover", "residual"),
)
_RARE = ("fracture_j", "rock_j", "floor_j", "far_end_j")
_FLEXIBLE: Labels = (
    ("Time step", "time_step_s", None),
    ("Steps", "steps", None),
    ("Step of the run beside it", "evidence.other_time_step_s", None),
    ("Elements along the crack", "evidence.elements_across", None),
    ("Those of the mesh beside it", "evidence.other_elements_across", None),
    ("Those of a third mesh, by which two that agree by chance are found out", "evidence.third_elements_across", None),
    ("Residual slip to trust", "evidence.residual_slip_m.value", "displacement"),
    ("How uncertain it is, give or take", "evidence.residual_slip_m.uncertainty", "displacement"),
    ("Of that, by the time step", "evidence.residual_slip_m.step", "displacement"),
    ("Of that, by the mesh", "evidence.residual_slip_m.mesh", "displacement"),
    ("Of that, by the shaking, 0.99 to 1.01 times", "evidence.residual_slip_m.shaking", "displacement"),
    ("Of that, by rock and water that reach 1.5 times as far", "evidence.residual_slip_m.surroundings", "displacement"),
    ("Uncertainty that is allowed", "evidence.allowed_m", None),
    ("Slip under the static loads before the shaking", "before_shaking.slip_m", "displacement"),
    ("Nodes of the crack that open then", "before_shaking.open_contacts", None),
    ("Growth rate of a vibration in steady sliding", "self_excitation.growth_1_s", None),
    ("Time it slides", "self_excitation.sliding_time_s", None),
    ("Residual slip with twice the damping", "self_excitation.twice_damped_slip_m", "displacement"),
    ("Tries per step until contact is found", "contact_iterations_per_step", None),
    ("Worst violation of the contact conditions, over the impulse", "contact_residual", None),
)

_STANDS = {
    True: "The residual slip has converged: {} by less than is allowed.",
    False: "The residual slip has NOT converged: {} by more than is allowed.",
}
_NO_LIMIT = "The residual slip has NOT converged: on rock almost without damping it may grow with each finer mesh."
# By what was tried.
_MOVERS = {
    "full": "step, mesh and 1 % of the shaking move it",
    "step": "the step moves it, mesh and shaking were not tried,",
}
_MEAN = {
    True: " Single runs scatter: the slip to trust is the mean of those with the shaking varied; histories and figures "
    "are those of one of them.",
    False: "",
}

_WALK = {
    False: "The rigid block is computed exactly from event to event: there is no time step to converge in.",
    True: "The rigid block is integrated to a relative error of 10⁻¹² a step: no time step is left to choose.",
}


def evidence(subject: Subject) -> Section:
    """Return the section that says how far to trust the numbers."""
    blocks: list[Block] = []
    for run in subject.runs:
        blocks += _spread(subject, run)
    if any(run.response.energy is not None for run in subject.runs):
        ledgers = [run.response.energy for run in subject.runs if run.response.energy is not None]
        # What only joints and water with sound have.
        flows = {name: any(getattr(ledger, name) for ledger in ledgers) for name in _RARE}
        entries = [(label, name) for label, name in _ENERGY if flows.get(name, True)]
        rows = tuple(_energy_row(subject, label, name) for label, name in entries)
        blocks.append(Table(subject.head(), _seen(rows), f"Energy ledger, {subject.per_width}.", subject.align()))
        blocks += subject.figure("energy")[-1:]
    for run in subject.runs:
        if run.response.elastic and run.response.summary:
            blocks += _convergence(subject, run)
        elif run.response.model == "rigid" and run.response.summary:
            blocks.append(paragraph(_WALK[varies(subject.case)]))
    return Section("How far to trust it", tuple(blocks))


def _energy_row(subject: Subject, label: str, name: str) -> tuple[Inline, ...]:
    return subject.row(label, f"energy.{name}")


def _seen(rows: tuple[tuple[Inline, ...], ...]) -> tuple[tuple[Inline, ...], ...]:
    """Leave out rows in which no run has anything but zero."""

    def counts(cell: Inline) -> bool:
        return not isinstance(cell, str) and getattr(cell, "number", 1) != 0

    return tuple(row for row in rows if any(map(counts, row[1:])))


def _spread(subject: Subject, run: Run) -> list[Block]:
    if not run.response.summary:
        return []
    if run.response.spread is None and not run.response.ok:
        return []
    if run.response.spread is None:
        unasked = [other.name for other in subject.runs if other.response.ok and other.response.spread is None]
        if run.name != unasked[0]:
            return []
        whose = "" if len(subject.runs) == 1 else f" of the {' and of the '.join(unasked)}"
        return [
            paragraph(
                f"How much the result{whose} depends on the exact strength of the shaking was not asked; ",
                Code("--spread"),
                " runs it 11 more times, scaled by 0.99 to 1.01. The slip of a dam that strikes means little without.",
            )
        ]
    n, prefix = subject.numbers, f"{run.prefix}spread."
    rows: list[tuple[Inline, ...]] = []
    for headline in HEADLINES:
        name, sign = headline.key, headline.way
        if not n.raw(prefix + name):
            continue
        low, high = ("min", "max") if sign > 0 else ("max", "min")
        cells = [n(run.prefix + name, sign=sign), n(f"{prefix}{name}.mean", sign=sign), n(f"{prefix}{name}.std")]
        cells += [n(f"{prefix}{name}.{end}", sign=sign) for end in (low, high)]
        if any(cell != NOTHING and getattr(cell, "number", 0) for cell in cells):
            rows.append((headline.label.capitalize(), *cells))
    spread = run.response.spread
    scales = spread["scales"]
    failed = f"; {spread['failed']} of them without a result" if spread["failed"] else ""
    caption = f"Spread over {spread['runs']} runs, the shaking scaled by {scales[0]:g} to {scales[-1]:g}{failed}."
    if len(subject.runs) > 1:
        caption = f"{run.name.capitalize()}. {caption}"
    if not rows:
        return [paragraph(caption.removesuffix("."), ": nothing moves in any of them.")]
    return [Table(("", "this run", "mean", "std. deviation", "least", "most"), tuple(rows), caption, "lrrrrr")]


def _convergence(subject: Subject, run: Run) -> list[Block]:
    summary, known = run.response.summary, subject.known
    result = summary["evidence"]
    if run.response.outcome == Outcome.UNSTABLE:
        said = paragraph("A dam that does not stand has no slip to be certain of: it was run once, at one step.")
    elif result is None:
        said = paragraph("Whether time step and mesh are fine enough was not asked (", Code("flexible.evidence"), ").")
    else:
        stands = _NO_LIMIT if result["no_limit"] else _STANDS[result["converged"]]
        movers = _MOVERS["step" if result["asked"] == "step" else "full"]
        said = paragraph(stands.format(movers) + _MEAN[result["value_is"] == "mean"])
    return [
        said,
        known(_FLEXIBLE, run.prefix, "Evidence, time step and contact of the flexible model."),
        known(_numbers_of_parts(run), run.prefix, "Mesh, modes and damping of the flexible model."),
    ]


def _numbers_of_parts(run: Run) -> Labels:
    """Return the labels of meshes, modes and damping: as many as there are parts, periods and ratios."""
    summary = run.response.summary
    count = len(summary["mesh"]["elements"])
    parts = ["above the crack", "below the crack"][:count]
    if run.response.several:
        parts = [f"of part {place + 1} from the crest down" for place in range(count)]
    return (
        *(
            (f"{label} {where}", f"mesh.{name}.{place}", None)
            for place, where in enumerate(parts)
            for label, name in (("Elements", "elements"), ("Nodes", "nodes"), ("Modes kept", "modes"))
        ),
        ("Nodes along the crack", "mesh.crack_nodes", None),
        ("Error left by modes that are not kept", "mesh.basis_error", "share"),
        *(
            (f"Period {place + 1} of the intact dam, with its water", f"periods_s.{place}", "time")
            for place in range(len(summary["periods_s"]))
        ),
        *(
            (f"Damping that mode {place + 1} of the intact dam gets", f"damping_ratios.{place}", "share")
            for place in range(len(summary["damping_ratios"]))
        ),
        ("Rayleigh damping, mass term a₀", "rayleigh_mass_1_s", None),
        ("Rayleigh damping, stiffness term a₁", "rayleigh_stiffness_s", None),
    )

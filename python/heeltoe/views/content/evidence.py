"""How far to trust the numbers: spread, convergence, energy ledger, contact."""

from __future__ import annotations

from heeltoe.models.rigid.varying import varies
from heeltoe.result.contract import HEADLINES, RESIDUAL_SLIP
from heeltoe.result.numbers import BeforeShaking, ElasticDam, Energy, EvidenceNumbers, HeadlineWorth, SelfExcitation
from heeltoe.result.outcome import Outcome
from heeltoe.units.sentences import listed, written
from heeltoe.units.write import NOTHING
from heeltoe.views.content.subject import Run, Subject, labels_of
from heeltoe.views.content.tree import Block, Code, Inline, Section, Table, paragraph

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
_MEAN = (
    " Single runs scatter{where}: the numbers to trust{there} are means over {runs:d} runs with the shaking "
    "varied, each with its standard error, and limits are judged by the size that 84 % of the runs keep to. Histories "
    "and figures are those of one run."
)

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
        blocks.append(subject.compared(labels_of(Energy, "energy."), f"Energy ledger, {subject.per_width}."))
        blocks += subject.figure("energy")[-1:]
    for run in subject.runs:
        if run.response.elastic and run.response.summary:
            blocks += _convergence(subject, run)
            blocks += subject.figure("scatter")
        elif run.response.model == "rigid" and run.response.summary:
            blocks.append(paragraph(_WALK[varies(subject.case)]))
    return Section("How far to trust it", tuple(blocks))


def _spread(subject: Subject, run: Run) -> list[Block]:
    if not run.response.summary:
        return []
    if run.response.spread is None and not run.response.ok:
        return []
    if run.response.spread is None:
        unasked = [other.name for other in subject.runs if _says_nothing_of_shaking(other)]
        if run.name not in unasked[:1]:
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


def _means(subject: Subject, run: Run) -> str:
    """Say at which cracks single runs scatter, and what is made of that; nothing where they scatter at none."""
    cracks = [crack for crack in run.response.cracks if crack.scatters]
    if not cracks:
        return ""
    levels = [written("the crack at {at_m:g m}", subject.units, at_m=crack.elevation) for crack in cracks]
    return _MEAN.format(
        where=f" at {listed(levels)}" if run.response.several else "",
        there=" there" if run.response.several else "",
        runs=len(run.response.summary["evidence"]["scales"]),
    )


def _says_nothing_of_shaking(run: Run) -> bool:
    evidence = run.response.summary.get("evidence")
    return run.response.ok and run.response.spread is None and not (evidence and evidence["value_is"] == "mean")


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
        said = paragraph(stands.format(movers) + _means(subject, run))
    # Worth of the number that is judged first.
    labels = (
        *labels_of(ElasticDam),
        *labels_of(SelfExcitation, "self_excitation."),
        *labels_of(BeforeShaking, "before_shaking."),
        *(label for label in labels_of(EvidenceNumbers, "evidence.") if label[1].count(".") == 1),
        *(
            (f"{RESIDUAL_SLIP.label.capitalize()}: {label[0].lower()}{label[1:]}", key, "displacement")
            for label, key, _ in labels_of(HeadlineWorth, f"evidence.{RESIDUAL_SLIP.key}.")
        ),
    )
    return [
        said,
        known(labels, run.prefix, "Evidence, mesh, time step, damping and contact of the flexible model."),
    ]

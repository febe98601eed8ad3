"""Everything that a reader of a result is warned of, declared once, with its quantities and how grave it is.

A :class:`Notice` is what a run, a case or a record makes of it: the code, the quantities in SI, where in the case and
when in the run. Its sentence is written when it is shown, in the units of who reads it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from string import Formatter
from typing import Any

from heeltoe.units.sentences import Sentence
from heeltoe.warnings.cracks import OF_CRACKS
from heeltoe.warnings.input import OF_INPUT, Row, Severity
from heeltoe.warnings.statics import OF_STATICS

# What is said of a field, and of no number.
_OF_FIELDS = ("fields-unused", "fields-idle")
#: What a reader of a block's result does for that of the dam.
AS_ELASTIC = "run it with --model auto"
# Code -> (how grave, field of the case, sentence, or the sentences by kind). Quantities are called as in the JSON, with
# their unit at the end; how they are written stands in the braces, see heeltoe.units.sentences. {field} is the field,
# {time_s} the moment.
CATALOGUE: dict[str, Row] = {
    **OF_INPUT,
    **OF_CRACKS,
    **OF_STATICS,
    # any run
    "energy-open": (
        "grave",
        "",
        "the energy ledger does not close: residual {residual:.1e} of the turnover",
    ),
    "crack-opens-through": (
        "grave",
        "uplift",
        "under its usual loads the crack opens right through where water follows it, and the dam does not stand "
        "(heeltoe statics); this run keeps the uplift of the case, so that its slip says nothing of such a dam: add "
        "drains or anchors, or lower the water, until heeltoe statics finds that it stands",
    ),
    "crack-opens": (
        "caution",
        "uplift",
        "the usual loads open {length_m:.2f m} of the crack from its {corner}, {share:.2g %} of its width; the water "
        "that follows lifts with {lift_n:.4g kN/m} {more} than the uplift of the case, which this run keeps: {remedy}",
    ),
    "slid-off": (
        "grave",
        "",
        "the part above the crack slides {slip_m:.3g m}, farther than its crack of {width_m:.3g m} is wide: it has "
        "left what it stood on, and the slip means failure, not a length",
    ),
    # rigid model
    "slides-on": (
        "grave",
        "crack.friction",
        "the static loads need a friction of {needed:.3g}, and once the crack slips{where} it has {sliding:.3g}: a "
        "slip that begins does not end by itself",
    ),
    "not-determined": (
        "grave",
        "crack.restitution",
        "not determined: with the motion 1 + 1e-9 times as strong the block {other}, instead of sliding "
        "{slip_m:.4g mm}; bounces with a restitution of {restitution:g} amplify the last digit",
    ),
    "cross-valley-upright": (
        "note",
        "motion.cross_valley",
        "the dam is taken to be kept upright across the valley by its neighbours, which all move alike; a monolith "
        "that stands alone tips that way",
    ),
    "cross-valley-far": (
        "caution",
        "crack.side_gap",
        "the dam slides up to {slip_m:.3g mm} across the valley, farther than the joints of a dam allow: give "
        "crack.side_gap",
    ),
    "slid-far": (
        "caution",
        "",
        "the part above the crack slides {share:.2g %} of the width of its crack: loads, contact and uplift are those "
        "of the place where it began; heeltoe statics --slip judges where it ends",
    ),
    "rigid-block": (
        "caution",
        "concrete.modulus",
        "a rigid block leaves out the vibration of the dam: with {moduli_pa:g GPa|to} it swings in about "
        "{periods_s:.2g s|to}, where this motion shakes it with {accelerations_g:.2g g|to}, {times:.2g|to} times its "
        "peak{level}",
    ),
    "rigid-unlike-dam": (
        "caution",
        "concrete.modulus",
        {
            "slides": (
                "a dam of this stiffness slides {times:g|to} times as far as its block{chain} (as did {share:.2g %}"
                " of {cases:d} studied cases): {remedy}, and the dam is elastic"
            ),
            "holds": (
                "its block slides less than {least_m:.2g mm}, but {shares:.2g %|to} of the dams like it slide more "
                "than {far_m:.2g mm} ({cases:d} studied cases): {remedy}, and the dam is elastic"
            ),
            "unknown": (
                "a dam may slide and rock several times as far as its block, and none like this one was studied "
                "({why}): {remedy}, and the dam is elastic"
            ),
        },
    ),
    "study-vertical-left-out": (
        "caution",
        "motion.vertical",
        "the motions of the study replace that of the case and have no vertical component; add vertical = true under "
        "[motions] and the vertical records",
    ),
    "study-part-damaged": (
        "note",
        "",
        "{count} of the files in runs/ were damaged, as by a disk that was full or a machine that lost its power; "
        "their runs were computed anew",
    ),
    "study-rigid": (
        "caution",
        "model",
        "all runs are of rigid blocks, which leave out the vibration of the dam: it may slide and rock several times "
        'as far; model = ["rigid", "flexible"] shows both',
    ),
    "study-single-runs": (
        "caution",
        "flexible.evidence",
        {
            "scatter": (
                "single runs of the base case scatter: the mean of five is {value_m:.4g mm}, the run itself "
                "{run_m:.4g mm}; each run of the study is a single one, so read their distribution, not one of them"
            ),
            "uncertain": (
                "the residual slip of the base case has not converged: {value_m:.4g mm} ± {uncertainty_m:.4g mm}; "
                "the runs of the study have the same mesh and step"
            ),
        },
    ),
    "rigid-top": (
        "caution",
        "decoupled",
        "the decoupled chain leaves out the vibration of the part above the crack, and what its sliding and rocking "
        f"spare the part below: {AS_ELASTIC}, and the dam is elastic",
    ),
    "restitution-lowered": (
        "note",
        "crack.restitution",
        "{impacts:d} impact(s) would have created energy with the restitution given; theirs was lowered to the "
        "largest that does not",
    ),
    "paradox-jammed": (
        "caution",
        "analysis.paradox",
        "{jams:d} Painlevé paradox(es) were resolved by a tangential impact, as analysis.paradox asks",
    ),
    "slip-in-the-air": (
        "caution",
        "crack.restitution",
        "most of the slip, {slip_m:.4g mm}, happens in the air after rebounds with crack.restitution = "
        "{restitution:g}: compare with 0, which may leave a small part of it",
    ),
    "restitution-decides": (
        "grave",
        "crack.restitution",
        "the slip depends on {field}: {slip_m:.4g mm} with {restitution:g}, {dead_slip_m:.4g mm} with 0",
    ),
    "anchor-fails": (
        "grave",
        "anchors",
        {
            "overloaded": (
                "anchor {number:d} bears {force_n:.4g MN/m}, tension and resistance to slip together, more than its"
                " capacity of {capacity_n:.4g MN/m}, for the first time at {time_s:.3f s}: it would yield or break,"
                " and this result, which takes it to hold, is too favourable"
            ),
            "slack": (
                "anchor {number:d} goes slack at {time_s:.3f s}, as the motion of the crack shortens it, and "
                "{then}: from then on its prestress holds nothing, and static checks that count it do not apply to "
                "the dam after the earthquake"
            ),
        },
    ),
    "anchor-unlimited": (
        "caution",
        "anchors.capacity",
        "an anchor without a capacity bears any force, here up to {force_n:.4g MN/m}: give {field} to have it judged",
    ),
    "anchors-cross-slip": (
        "caution",
        "anchors",
        "a slip of {slip_m:.3g mm} crosses anchors{where} {how}, and few tendons bear that: a run without {field} "
        "bounds what the dam does if they break",
    ),
    "rotation-large": (
        "caution",
        "analysis.rotation",
        "it rotates by {rotation_rad:.3g rad} about its {corner}, {share:.2g %} of the {slenderness_rad:.3g rad} at "
        'which it would overturn: set analysis.rotation = "finite", because the small-rotation model cannot '
        "represent overturning",
    ),
    "still-moves": (
        "caution",
        "analysis.silence",
        "the {body} still moves {when}{how}; the residual slip is that of this moment, and a longer analysis.silence "
        "may let it come to rest",
    ),
    # flexible model
    "evidence-none": (
        "note",
        "flexible.evidence",
        "{field} is none: nothing shows that time step and mesh are fine enough, and what 1 % of the shaking does",
    ),
    "evidence-failures": (
        "grave",
        "flexible.evidence",
        "{failed} of the {runs} runs with the shaking varied by 1 % end without a result",
    ),
    "runs-scatter": (
        "caution",
        "flexible.evidence",
        {
            "crack": (
                "single runs scatter: {runs} of them, the shaking varied by 1 %, slide {slip_m:.4g mm} in the mean "
                "with a standard deviation of {scatter_m:.3g mm}; slips, openings and rotations are means, histories "
                "and most figures those of one run"
            ),
            "one-crack": (
                "single runs scatter at the crack at {elevation_m:.4g m}: {runs} of them, the shaking varied by 1 %, "
                "slide {slip_m:.4g mm} there in the mean with a standard deviation of {scatter_m:.3g mm}; slips, "
                "openings and rotations of this crack are means, histories and most figures those of one run"
            ),
        },
    ),
    "not-converged": (
        "grave",
        "flexible.evidence",
        {
            "crack": (
                "the residual slip has not converged: {slip_m:.4g mm} ± {uncertainty_m:.3g mm}, where "
                "{allowed_m:.3g mm} are allowed; {most} moves it most, and {stopped}"
            ),
            "further-crack": (
                "the slip of the crack at {elevation_m:.4g m} has not converged: {slip_m:.4g mm} ± {uncertainty_m:.3g "
                "mm}"
            ),
        },
    ),
    "friction-not-enough": (
        "caution",
        "crack.friction",
        {
            "anchors": (
                "friction, weight and prestress alone do not hold the dam before the earthquake: {why}; it moves at"
                " first until its anchors hold it"
            ),
            "steps": (
                "friction on the straight line from heel to toe alone does not hold the dam before the earthquake "
                "(sliding safety factor {factor:.3f}): the steps of its crack do, as long as none shears off"
            ),
        },
    ),
    "slides-by-itself": (
        "grave",
        "",
        "the dam slides under its static loads alone (sliding safety factor {factor:.3f}): its slip grows as long as "
        "the run lasts",
    ),
    "no-rest": (
        "grave",
        "",
        "{why}; the run starts from the dam with its crack bonded",
    ),
    "rock-keeps-waves": (
        "grave",
        "rock",
        "no waves leave the rock ({path} = {value}): vibrations of the dam hardly die out, and slips come out too "
        "large, for massless rock several times; set {path} = {other}",
    ),
    "rock-undamped": (
        "grave",
        "rock.damping",
        "the crack is on rock almost without damping (rock.damping = {damping:g}): sliding feeds the shortest waves "
        "along it, so that the slip may grow with each finer mesh and is not converged; set rock.damping = {usual:g}",
    ),
    "rock-coarse": (
        "caution",
        "rock.modulus",
        "the rock is so soft, and its waves so short, that it answers with an error of up to {error:.2g %} below "
        "{highest_hz:g Hz}; the uncertainty of the slip does not count that: look at a stiffer rock, too",
    ),
    "rock-assumed": (
        "note",
        "rock",
        "the case gives no rock: rock as stiff as the concrete ({modulus_pa:.3g GPa}) is assumed below the elastic "
        "dam; a block [rock] has that of the site",
    ),
    "surroundings-not-assumed": (
        "grave",
        "rock",
        {
            "rock": (
                "the case gives no rock, and none could be assumed ({why}): on a rigid plane nothing carries away "
                "the vibration that sliding feeds, so that the slip may be far off either way; give a block [rock],"
                ' or say rock = "rigid" if that is meant'
            ),
            "sound": (
                "the water is a mass that moves with the dam, as no sound could be assumed in it ({why}), and "
                "carries away nothing of the vibration that sliding feeds; say {field} = false if that is meant"
            ),
        },
    ),
    "surroundings-left-out": (
        "note",
        "rock",
        {
            "studied": (
                "{share:.2g %} of {cases:d} computed dams like this one slide less far on elastic rock with sound "
                "in the water, half of all {times:.2g|to} times as far; here the rock is rigid and the water a "
                'mass, as the case has it: without rock = "rigid" and reservoir.compressible = false both carry '
                "waves"
            ),
            "unknown": (
                "the rock is rigid and the water a mass here, and the dams studied with elastic rock and sound are "
                'not like this one ({why}): its slip may be off either way; a run without rock = "rigid" and '
                "reservoir.compressible = false shows which"
            ),
        },
    ),
    "outline-simplified": (
        "note",
        "section.polygon",
        "corners of the section are finer than the mesh, which misses some of them by {missed_m:.3g m}; loads of the "
        "flexible model are those of its mesh, and more flexible.elements_across follow closer",
    ),
    "self-excited": (
        "grave",
        "concrete.damping",
        "self-excited sliding: a vibration of the sliding dam grows by {growth_1_s:.3g 1/s}, for {sliding_s:.3g s} of "
        "sliding, so that the slip depends on damping: {slip_m:.4g mm}, with twice the damping {damped_slip_m:.4g mm}",
    ),
    "damping-hardly": (
        "grave",
        "concrete.damping",
        "{field}: with hardly any damping under a full reservoir the dam creeps downstream for as long as it "
        "vibrates; the slip says little",
    ),
    "modes-few": (
        "caution",
        "flexible.modes",
        "the modes kept leave an error of {error:.2g %} in the flexibility of the crack; raise {field}",
    ),
    "cavitation": (
        "caution",
        "reservoir.compressible",
        "{field}: {z_m:.3g m} up on the face the pressure falls {tension_pa:.3g kPa} below that of water vapour at "
        "{time_s:.2f s}: the water would tear off there, and the shock when it closes is not modelled",
    ),
    "tension-unjudged": (
        "caution",
        "concrete.tensile_strength",
        "a tension of {stress_pa:.3g MPa} in the concrete is compared with no strength: give {field}",
    ),
    "tension-exceeds": (
        "grave",
        "concrete.tensile_strength",
        {
            "before": (
                "a tension of {stress_pa:.3g MPa} before the earthquake exceeds the {strength_pa:.3g MPa} that the "
                "concrete bears: the dam is cracked elsewhere, too, or its loads are not these"
            ),
            "shaken": (
                "a tension of {stress_pa:.3g MPa} {where}, {z_m:.3g m} up, at {time_s:.2f s} exceeds the "
                "{strength_pa:.3g MPa} that the concrete bears in an earthquake, over {share:.2g %} of the section:"
                " the assumption that nothing cracks further does not hold"
            ),
        },
    ),
    "off-the-dam": (
        "caution",
        "anchors",
        {
            "anchor": "{field}: anchor {number:d} does not cross the crack, and holds nothing there",
            "anchor-head": "{field}: the head of anchor {number:d} is {distance_m:.3g m} outside the dam",
            "drains": "{field}: the drains do not cross the crack, whose water they leave as it is without drains",
        },
    ),
    "anchor-head-wet": (
        "note",
        "anchors",
        "{field}: the head of anchor {number:d} is on the {side} face {depth_m:.3g m} below the water, at an elevation "
        "of {elevation_m:.4g m}",
    ),
    "faces-penetrate": (
        "caution",
        "flexible.contactors",
        "the crack faces penetrate each other by up to {depth_m:.3g mm} where no node is watched (contactors of type "
        "{contactors:d}); types 3 to 5 prevent it",
    ),
    "contact-loose": (
        "caution",
        "flexible.time_step",
        "contact holds only to {residual:.1e} of the impulse: give a shorter {field}",
    ),
    "energy-made": (
        "grave",
        "flexible.contact",
        "contact has created energy, {gained_j:.3g J} in a turnover of {turnover_j:.3g J}{why}",
    ),
    # decoupled chain, spread
    "slip-sensitive": (
        "caution",
        "",
        {
            "sampling": (
                "the slip depends on details: it is {coarser_slip_m:.4g mm} where the motion of the crack is "
                "sampled every {coarser_step_s:.3g ms} instead of {step_s:.3g ms}"
            ),
            "failures": "{failed:d} of the {runs:d} runs with slightly different shaking ended without a result",
            "shaking": (
                "the residual slip depends on details: it is {slips_m:.4g mm|to} when the shaking is scaled by "
                "{scales:g|to}"
            ),
        },
    ),
}


@dataclass(frozen=True, init=False)
class Notice:
    """A warning that a reader needs before using the numbers of a result.

    Attributes
    ----------
    code
        Key of :data:`CATALOGUE`.
    kind
        Which of the sentences of the code; empty where it has one.
    quantities
        Names with numbers in SI, or words.
    field
        Which field of the case it is about; empty where it is about none.
    time_s
        When in the motion or in the run [s]; None where it is about no moment.
    """

    code: str
    kind: str
    quantities: tuple[tuple[str, Any], ...]
    field: str
    time_s: float | None

    def __init__(
        self,
        code: str,
        kind: str = "",
        /,
        *,
        field: str | None = None,
        time_s: float | None = None,
        **quantities: Any,
    ) -> None:
        usual, template = CATALOGUE[code][1], templates(code)[kind]
        names = _names(template) - {"field", "time_s"}
        if names != set(quantities):
            raise TypeError(f"{code} takes {', '.join(sorted(names)) or 'nothing'}, not {', '.join(quantities)}")
        object.__setattr__(self, "code", code)
        object.__setattr__(self, "kind", kind)
        object.__setattr__(self, "quantities", tuple(quantities.items()))
        object.__setattr__(self, "field", usual if field is None else field)
        object.__setattr__(self, "time_s", time_s)

    @property
    def severity(self) -> Severity:
        """How grave it is."""
        return CATALOGUE[self.code][0]

    @property
    def name(self) -> str:
        """Its code, and behind it its kind, if it has one."""
        return f"{self.code} {self.kind}".rstrip()

    def text(self, units: str = "si") -> str:
        """Return its sentence in units ``"si"`` or ``"us"``."""
        places = {"field": self.field, "time_s": self.time_s}
        return Sentence.of(templates(self.code)[self.kind], **places, **dict(self.quantities)).text(units)

    def __str__(self) -> str:
        return self.text()

    def to_json(self) -> dict[str, Any]:
        """Return it as the contract has it: sentence and quantities in SI; words stand in the sentence alone."""
        inner = [pair for _, value in self.quantities if isinstance(value, Sentence) for pair in value.quantities]
        # A number of the sentence itself counts where a clause has one of the same name.
        pairs = (*inner, *self.quantities)
        numbers = {name: value for name, value in pairs if not isinstance(value, str | Sentence)}
        return {
            "code": self.code,
            "kind": self.kind or None,
            "text": self.text(),
            "severity": self.severity,
            "field": self.field or None,
            "time_s": self.time_s,
            "quantities": {name: list(value) if isinstance(value, tuple) else value for name, value in numbers.items()},
        }


@cache
def templates(code: str) -> dict[str, str]:
    """Return the sentences of a code by their kind, which is ``""`` for the only one."""
    sentences = CATALOGUE[code][2]
    return {"": sentences} if isinstance(sentences, str) else sentences


def by_gravity(notices: Iterable[Notice]) -> tuple[Notice, ...]:
    """Return notices, the grave ones first and those of fields without an effect last."""
    ranks = {"grave": 0, "caution": 1, "note": 2}
    return tuple(sorted(notices, key=lambda notice: 3 if notice.code in _OF_FIELDS else ranks[notice.severity]))


@cache
def _names(template: str) -> frozenset[str]:
    return frozenset(name for _, name, _, _ in Formatter().parse(template) if name)

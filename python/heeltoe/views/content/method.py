"""The method in words, with numbered equations for exactly the options of this case."""

from __future__ import annotations

from collections.abc import Sequence

from heeltoe.case.crack.crack import Crack
from heeltoe.case.model import Case
from heeltoe.mechanics.block import build_block
from heeltoe.models.rigid.varying import varies
from heeltoe.units.sentences import listed
from heeltoe.views.content.drawings import in_rows
from heeltoe.views.content.equations import EQUATIONS
from heeltoe.views.content.subject import Subject
from heeltoe.views.content.tree import Block, Equation, Section, Symbol, paragraph

_PATTERNS = {
    "none": "There is no water pressure in the crack.",
    "uniform": "The pressure in the crack is that of the heel over its whole width",
    "triangular": "The pressure in the crack falls in a straight line from that of the reservoir at the heel to "
    "that of the tailwater at the toe",
    "cut-off": "The pressure in the crack falls in a straight line from that of the reservoir at the heel to that "
    "of the tailwater at a part of its width, and stays there",
    "drained": "The pressure in the crack falls in straight lines from that of the reservoir at the heel to that at "
    "the drains, and on to that of the tailwater at the toe",
    "profile": "The pressure in the crack is the profile of the case",
}
_SHAKING = {
    "zero while open": ("opening zero", "Where the crack opens by $g$, it falls and vanishes at the opening $w$:"),
    "full while open": (
        "opening full",
        "Where the crack opens by $g$, it rises to the reservoir’s at the opening $w$:",
    ),
    "follows opening": (
        "opening follows",
        "Where the crack opens by $g$, the water that is there fills the wider crack, and the pressure falls; it is "
        "halved at the opening $w$:",
    ),
}
_ROTATION = {
    "small": "Rotations are small: the moment of the weight about a corner does not change with the rotation.",
    "p-delta": "Rotations are small, but the moment of the weight that changes with the rotation counts (P-Delta), "
    "so that the block can overturn.",
}
_CARRIED = {
    "rigid body": "the part above as a rigid body that does not slip",
    "mass on the crack": "the mass of the concrete above, spread evenly along the crack, as in Zhu (2004)",
}
_DAMPING = {
    "relative": "on the motion relative to a rigid slide of the part above along the crack, so that a dam that slides "
    "or rocks as a whole is not held back",
    "stiffness": "with its stiffness term alone",
    "deformation": "on the deformation of the parts by themselves; rigid-body motion of the part above is not damped, "
    "though it makes up much of the intact dam’s modes",
    "thesis": "on all motion while any node of the crack sticks, and below the crack alone while none does, as in Zhu "
    "(2004)",
}


def _symbol(text: str) -> Symbol:
    letter, _, index = text.partition("_")
    return Symbol(letter, index)


class _Writer:
    """Collects paragraphs, and equations with their numbers."""

    def __init__(self) -> None:
        self.blocks: list[Block] = []
        self.count = 0

    def say(self, *sentences: str) -> None:
        text = " ".join(sentence for sentence in sentences if sentence)
        # Letters of the equations stand between dollars.
        parts = [_symbol(part) if place % 2 else part for place, part in enumerate(text.split("$"))]
        self.blocks.append(paragraph(*(part for part in parts if part)))

    def show(self, name: str) -> None:
        self.count += 1
        self.blocks.append(Equation(self.count, *EQUATIONS[name]))

    def section(self, title: str, start: int) -> Section:
        """Put all blocks from `start` on under a heading of their own."""
        blocks = tuple(self.blocks[start:])
        del self.blocks[start:]
        return Section(title, blocks)


def integrated(subject: Subject) -> bool:
    """Whether a block of this report is integrated between events; rotations of the ground reach it through a crack."""
    return varies(subject.case) or (subject.ran("decoupled") and subject.case.decoupled.rotation)


def method(subject: Subject) -> Section:
    """Return the section that says how the numbers came about."""
    writer = _Writer()
    parts: list[Block] = []
    _loads(writer, subject)
    parts.append(writer.section("Loads", 0))
    if subject.ran("decoupled"):
        _decoupled(writer, subject)
        parts.append(writer.section("Motion of the crack", 0))
    if subject.ran("rigid") or subject.ran("decoupled"):
        _rigid(writer, subject)
        parts.append(writer.section("Rigid block", 0))
    if subject.ran("flexible"):
        _flexible(writer, subject)
        parts.append(writer.section("Flexible dam", 0))
    return Section("Method", (*in_rows(subject.figure("mesh", "modes")), *parts))


def _loads(writer: _Writer, subject: Subject) -> None:
    case = subject.case
    loads = ["the weight of the concrete"]
    loads += ["the reservoir"] if case.reservoir else []
    loads += ["the tailwater"] if case.tailwater else []
    loads += ["ice"] if case.ice else []
    loads += ["silt"] if case.silt else []
    loads += ["anchors"] if case.anchors else []
    uplift = case.uplift
    pattern = _PATTERNS[uplift.pattern]
    if uplift.pattern != "none":
        pattern += "." if uplift.intensity == 1.0 else f", all of it times {uplift.intensity:g}."
        if case.reservoir is None and case.tailwater is None and uplift.pattern != "profile":
            pattern = "There is no water, and hence no pressure in the crack."
    changes = uplift.during_shaking == "constant" and uplift.pattern != "none" and bool(case.reservoir)
    writer.say(
        f"Static loads are {listed(loads)}.",
        pattern,
        "It does not change while the crack opens and closes." if changes else "",
    )
    if uplift.during_shaking in _SHAKING:
        name, words = _SHAKING[uplift.during_shaking]
        writer.say(words)
        writer.show(name)
    if case.anchors:
        writer.say(
            "An anchor with prestress $F_0$ and axis $a$ pulls the block as its upper end moves by $u$, never with "
            "compression, and resists slip as a dowel:"
        )
        writer.show("anchors")
    if subject.numbers.raw(subject.first.prefix + "static.virtual_mass_kg"):
        if not all(run.response.elastic for run in subject.runs):
            _virtual_mass_of_block(writer, subject)
        if subject.ran("flexible") and _moves_with_face(subject.case):
            _virtual_mass_along_face(writer, subject)


def _virtual_mass_of_block(writer: _Writer, subject: Subject) -> None:
    water = build_block(subject.case).water
    if water.sloped:
        writer.say(
            "Water moves with both faces as Westergaard’s virtual mass times $r$, horizontally, with $η$ from "
            "the bottom of water of depth $D$ before a face that leans back from it by $ψ$ (after Zangar 1952):"
        )
        writer.show("virtual mass along face")
        writer.show("sloped water")
    else:
        writer.say(
            "Water moves with the upstream face as Westergaard’s virtual mass, horizontally; $D$ is the "
            "depth of the reservoir, $h$ that above the crack:"
        )
        writer.show("virtual mass")
    if any(side and not side.virtual_mass_rotates for side in (subject.case.reservoir, subject.case.tailwater)):
        writer.say("Where the case says so, it has no rotational inertia about its own centre, as in Zhu (2004).")
    elif water.sloped:
        writer.say("It turns with the block as it is spread over the face.")
    else:
        writer.say("It turns with the block as it is spread over the face, with $J_w$ about its own centre:")
        writer.show("turning water")


def _moves_with_face(case: Case) -> bool:
    """Whether the water on a side of the elastic dam is a mass that moves with its face."""
    sides = {"reservoir": case.reservoir, "tailwater": case.tailwater}
    return any(water is not None and not case.has_sound(side) for side, water in sides.items())


def _virtual_mass_along_face(writer: _Writer, subject: Subject) -> None:
    where = {
        "complete": "with $η$ from the bottom of water of depth $D$, on both parts of the dam",
        "thesis": "above the crack alone, with $η$ and the depth $D$ counted from the crack, as in Zhu (2004)",
    }[subject.case.flexible.virtual_mass]
    writer.say(f"On the elastic dam the virtual mass is spread along the upstream face, {where}:")
    writer.show("virtual mass along face")
    if subject.case.flexible.virtual_mass == "complete":
        writer.say(
            "It moves along the normal of the face, and before one that leans back from the water by $ψ$, as on the "
            "downstream face before tailwater, it is times $r$ (after Zangar 1952):"
        )
        writer.show("sloped water")


def _rigid(writer: _Writer, subject: Subject) -> None:
    case = subject.case
    finite, inclined = case.analysis.rotation == "finite", bool(case.crack.inclination)
    writer.say(
        "The part above the crack is one rigid block on a plane. With $y$, $z$ and $θ$ the motion of its reference "
        "point downstream, upward and counter-clockwise, $s$ its slip and $g_h$ and $g_t$ the gaps at heel and toe:"
        if not inclined
        else "The part above the crack is one rigid block on an inclined plane. With $y$ and $z$ its motion along "
        "and across the crack, $θ$ its rotation counter-clockwise, $s$ its slip and $g_h$ and $g_t$ the gaps at "
        "heel and toe:"
    )
    writer.show("contact")
    forces = (
        "$T$ is the friction, $N_h$ and $N_t$ the normal forces at heel and toe, $P$ the horizontal load, $N_0$ "
        "what weight, uplift and vertical motion press on the crack, $M_0$ the moment of the static loads, $B_h$ "
        "and $B_t$ the distances of the centroid from heel and toe:"
    )
    if finite:
        writer.say(
            "Rotations may be of any size. $M$ is the mass about one corner, $p$ the lever of the centroid as the "
            "block has turned by $θ$, $r$ that of the virtual water, $R$ the rotation, $Q$ the loads; $G$ leads to "
            "slip and gaps:"
        )
        writer.show("finite")
    elif inclined:
        writer.say(
            "Virtual water moves horizontally with the block and so couples its motion along and across the crack; "
            "$M$ is the mass, $f$ the loads and the ground’s inertia forces, $G$ leads to slip and gaps:"
        )
        writer.show("inclined")
    else:
        writer.say(forces)
        writer.show("block")
    _friction(writer, subject)
    writer.say(
        "A corner $i$ that strikes leaves with Newton’s restitution $e$; $j$ is the other corner, which stays down "
        "if it can. Where that would create energy, $e$ is lowered for this one impact to the largest value that "
        "does not:"
    )
    writer.show("impact")
    writer.say(
        "Between events the motion is "
        + ("exact while the law is a straight line over the way slipped, else " if case.crack.law is not None else "")
        + "integrated with a method of order 8, to a relative error of 10⁻¹² a step, and the next event is found on it."
        if integrated(subject)
        else "The ground acceleration is linear between samples, so that every motion is a cubic in time and the "
        "response is computed exactly from event to event, without a time step.",
        "The energy $E$ is checked by a ledger of the work done:",
    )
    writer.show("rigid energy")


def _friction(writer: _Writer, subject: Subject) -> None:
    case = subject.case
    writer.say(_ROTATION.get(case.analysis.rotation, ""), "Friction is Coulomb’s:")
    writer.show("friction")
    if case.further_cracks:
        writer.say(
            "Each crack has a block of its own above it. The upper block moves on the lower one: slip and gaps of the "
            "upper crack are their motion against each other, and its forces act on the lower block, too, reversed."
        )
    if case.crack.law is not None:
        writer.say(
            f"$μ_s$ and $μ_k$ are those of the law {case.crack.law.name} at the mean normal stress, the way slipped "
            "and the speed of the moment; a bond adds its cohesion."
        )
    if subject.first.response.cross is not None:
        writer.say(
            "The ground shakes the block across the valley, too. Friction is one circle: at rest it bears the "
            "resultant of the forces along the stream and across it up to $μ_s N$; while the block slides it resists "
            "the velocity with $μ_k N$. No water moves with the block across the valley. It is kept upright by its "
            "neighbours, which all move alike."
        )
    if case.crack.roughness is not None:
        writer.say(
            "The faces of the crack are a sawtooth (Patton 1966), whose flanks rise by the angle $i$; $φ$ is the angle "
            "of friction along them. What the crack bears along its mean plane, climbing and coming down, and how $i$ "
            "wears with the work $W$ of friction per area (Plesha 1987):"
        )
        writer.show("rough crack")


def _decoupled(writer: _Writer, subject: Subject) -> None:
    case = subject.case
    more = [
        name for name, on in (("vertical motion", case.decoupled.vertical), ("rotation", case.decoupled.rotation)) if on
    ]
    felt = f"The block feels the {' and the '.join(more)} of the crack too." if more else ""
    writer.say(
        f"The part below the crack is elastic and carries {_CARRIED[case.decoupled.upper_part]}. Its motion at the "
        "crack, summed over the modes $k$, shakes the block; what the block does does not act back.",
        felt,
    )
    writer.show("crack motion")


def _nodes(writer: _Writer, cracks: Sequence[Crack]) -> None:
    writer.say("At every node of the crack, with $b$ what the gap leaves:")
    writer.show("signorini")
    laws = sorted({crack.law.name for crack in cracks if crack.law is not None})
    if laws:
        which = f"the law {laws[0]}" if len(laws) == 1 else f"the crack’s law, {' or '.join(laws)},"
        writer.say(f"$μ$ is that of {which} at the node’s own stress, way and speed.")
    if any(crack.kinks for crack in cracks):
        writer.say("Normal and tangent of a node are those of its piece of the crack, which is not straight.")


def _surroundings(writer: _Writer, case: Case) -> None:
    """Describe the rock and the water with sound, which move as the dam does and take energy from it."""
    if case.foundation is not None:
        waves = "$C_waves$ takes the waves that leave" if case.foundation.radiation else "no wave leaves"
        lowest = case.single_crack_cases[-1].crack
        joined = (
            "the part below the lowest crack is bonded to it" if lowest.elevation else "the lowest crack lies on it"
        )
        writer.say(
            f"The rock is a linear elastic half-plane in plane strain; {joined}. All motion is counted from the free "
            "field, which is the record, so that the dam alone moves the rock: it presses on it with $p$, and the "
            f"water in the crack with $f_r$. $ξ_r$ is the damping of the material at $ω_r$, and {waves}:"
        )
        writer.show("rock")
    if case.has_compressible_water:
        writer.say(
            "Sound travels in the water. Its velocity potential is $φ$; the face pushes it with the velocity of dam "
            "and ground, and $p_w$ is its pressure on the face, added to that at rest. A part of each wave is lost at "
            "the floor, and the rest leaves along the reservoir, both by $C_w$; there are no waves on the surface:"
        )
        writer.show("sound")
    if case.foundation is not None or case.has_compressible_water:
        writer.say("The run keeps the shapes of rock and water that matter up to a highest frequency.")


def _flexible(writer: _Writer, subject: Subject) -> None:
    options, concrete = subject.case.flexible, subject.case.concrete
    ground = "rock" if subject.case.foundation is not None else "a rigid plane"
    bodies = (
        "parts of the dam between its cracks are linear elastic bodies"
        if subject.case.further_cracks
        else "parts above and below the crack are linear elastic bodies"
        if subject.case.crack.elevation
        else f"dam is a linear elastic body, standing with its crack on {ground},"
    )
    writer.say(
        f"The {bodies} in plane {options.plane}, made of eight-node quadrilaterals with consistent mass. Before the "
        "earthquake the dam is in static equilibrium with its crack bonded; at time zero the crack is let go. In "
        "the modes of each part, with $p$ the forces on the nodes of the crack:"
    )
    writer.show("modes")
    _surroundings(writer, subject.case)
    if options.damping == "modal":
        writer.say(
            f"The lowest modes of the intact dam have the same damping ratio, $ξ$ = {100 * concrete.damping:g} %, "
            "those above more in proportion to their frequency; sliding as a whole is not damped:"
        )
        writer.show("modal")
    else:
        where = "first period" if options.damping == "stiffness" else "first and third period"
        writer.say(
            f"Damping is Rayleigh’s, {100 * concrete.damping:g} % at the {where} of the intact dam, and acts "
            f"{_DAMPING[options.damping]}:"
        )
        writer.show("rayleigh")
    if options.contact == "coulomb":
        writer.say(
            f"Velocities are stepped with exact contact (Moreau-Jean) and $θ$ = {options.theta:g}; $h$ is the step, "
            "Δ$V$ the exact change of the ground’s velocity in it:"
        )
        writer.show("step")
        _nodes(writer, [alone.crack for alone in subject.case.single_crack_cases])
    else:
        writer.say(
            f"Contact is by penalties, as in Zhu (2004): Newmark’s scheme with $γ$ = {options.newmark_gamma:g}, and "
            f"a spring of {options.penalty_factor:g} times the largest diagonal term of the stiffness at every "
            "closed contact. This is meant for comparison; penalties can create energy."
        )
        writer.show("penalty")
    watched = {
        1: "those of the upper face",
        2: "those of the lower face",
        3: "those of the upper face and the two ends of the lower",
        4: "those of the lower face and the two ends of the upper",
        5: "those of both faces",
    }[options.contactors]
    writer.say(
        "The part above the crack rocks where all that touches lies within a quarter of the crack from heel or toe and "
        "the rotation of its face is beyond what elastic deformation accounts for; it drifts where nothing touches and "
        "the nearest node is farther off than that, and slides where more than half of what touches slips."
    )
    writer.say(
        f"Nodes that are watched for contact are {watched}. The energy $E$ is checked by a ledger of the work done:"
    )
    writer.show("flexible energy")

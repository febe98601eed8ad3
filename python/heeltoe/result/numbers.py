"""The numbers of a result, block by block: what the JSON of ``heeltoe run`` has, with units and meanings.

Signs: slip is positive downstream, rotation positive counter-clockwise (upstream). Forces, energies and masses are
those of a metre of dam.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from typing import TYPE_CHECKING, Annotated, Any

from heeltoe.base.blocks import Block, Number
from heeltoe.result.quantity import Quantity, peak_time
from heeltoe.units.sentences import Sentence

# Not at run time: the numbers of a result need no case.
if TYPE_CHECKING:
    from heeltoe.case.at_crack import AnchorAtCrack

_JOULE, _NEWTON = "J per metre of dam", "N per metre of dam"


class SlipByMode(Block):
    """Slip by the mode of motion that makes it."""

    sliding: Annotated[float, Number("Slip made while sliding, positive downstream.", "m")]
    slide_rocking: Annotated[float, Number("Slip made while slide-rocking, positive downstream.", "m")]
    drifting: Annotated[float, Number("Slip made in the air, positive downstream.", "m")]


class TimeByMode(Block):
    """Time by the mode of motion."""

    rest: Annotated[float, Number("Time at rest.", "s")]
    sliding: Annotated[float, Number("Time sliding.", "s")]
    rocking: Annotated[float, Number("Time rocking.", "s")]
    slide_rocking: Annotated[float, Number("Time sliding while rocking.", "s")]
    drifting: Annotated[float, Number("Time in the air.", "s")]


class AnchorForce(Block):
    """Force of an anchor."""

    distance_m: Annotated[
        float | None, Number("Where the anchor crosses the crack, from the heel; null where it misses it.", "m")
    ]
    peak_tension_n: Annotated[float, Number("Its largest tension.", _NEWTON)]
    peak_force_n: Annotated[
        float, Number("The largest force that it bears, tension and resistance to slip together.", _NEWTON)
    ]
    capacity_n: Annotated[float | None, Number("Capacity that the case gives; null without one.", _NEWTON)]
    final_tension_n: Annotated[float, Number("Its tension at the end of the run.", _NEWTON)]
    slack_s: Annotated[
        float | None,
        Number(
            "Time at which the anchor first goes slack and its prestress is lost; null where it keeps some, or "
            "has no prestress.",
            "s",
        ),
    ]
    yields_s: Annotated[
        float | None,
        Number(
            "When the force that it bears is more than its capacity for the first time: it would yield, which is not "
            "computed. Null where it never is, or the case gives no capacity.",
            "s",
        ),
    ]

    @classmethod
    def of(cls, anchor: AnchorAtCrack, borne: Sequence[float] | None = None) -> AnchorForce:
        """Return what an anchor bears, `borne` in the order of a kernel; its prestress is all where that is nothing."""
        constant = anchor.prestress
        # It would be below zero before the run, too.
        over = 0.0 if anchor.capacity is not None and constant > anchor.capacity else -1.0
        tension, force, slack, yields, last = borne or (constant, constant, -1.0, over, constant)
        return cls(
            distance_m=anchor.distance,
            peak_tension_n=tension,
            peak_force_n=force,
            capacity_n=anchor.capacity,
            final_tension_n=last,
            slack_s=slack if slack >= 0.0 else None,
            yields_s=yields if yields >= 0.0 else None,
        )


class CrackEnergy(Block):
    """Energy that one of several cracks takes from the dam."""

    friction_j: Annotated[float, Number("Energy lost in its friction.", _JOULE)]
    impact_j: Annotated[float, Number("Energy lost in its impacts.", _JOULE)]


class FrictionLawState(Block):
    """State of the friction law of a crack at the end."""

    name: Annotated[str, Number("Name of the friction law.")]
    slip_path_m: Annotated[float, Number("How far the crack has slipped, to and fro.", "m")]
    normal_stress_pa: Annotated[float, Number("Mean normal stress on the crack under the static loads.", "Pa")]
    apparent_friction_before: Annotated[
        float, Number("Shear strength over normal stress under the static loads, before the earthquake.")
    ]
    apparent_friction_after: Annotated[float, Number("The same after the earthquake.")]
    cohesion_left_pa: Annotated[float | None, Number("Cohesion that is left; null of a law without.", "Pa")]
    surface: Annotated[str | None, Number("The surface that the law describes.")]


class BlockFrictionLaw(FrictionLawState):
    """The same under a rigid block."""

    integrated_time_s: Annotated[float, Number("Time that had to be integrated, for want of a closed form.", "s")]
    integration_error_m: Annotated[float, Number("Error of the slip by that.", "m")]


class ElasticFrictionLaw(FrictionLawState):
    """The same along the crack of an elastic dam."""

    slip_path_range_m: Annotated[list[float], Number("Least and largest slip, to and fro, along the crack.", "m")]
    normal_stress_range_pa: Annotated[list[float], Number("Least and largest normal stress along the crack.", "Pa")]
    apparent_friction_before_range: Annotated[
        list[float], Number("Least and largest friction along the crack before the earthquake.")
    ]
    apparent_friction_after_range: Annotated[
        list[float], Number("Least and largest friction along the crack after the earthquake.")
    ]
    bond_energy_j: Annotated[float | None, Number("Energy that broke the bond; null without cohesion.", _JOULE)]


class BondState(Block):
    """State of the bond of a joint at the end."""

    first_cracking_s: Annotated[
        float | None, Number("When the bond of the joint first breaks; null where it holds.", "s")
    ]
    first_cracking_at_m: Annotated[
        float | None, Number("Where it breaks first, from the upstream face; null where it holds.", "m")
    ]
    cracked_through_s: Annotated[
        float | None, Number("When it is cracked from face to face; null where a ligament is left.", "s")
    ]
    cracked_upstream_m: Annotated[float, Number("Length cracked from the upstream face in the end.", "m")]
    cracked_downstream_m: Annotated[float, Number("Length cracked from the downstream face in the end.", "m")]
    cracked_length_m: Annotated[float, Number("Length cracked in all.", "m")]
    softening_length_m: Annotated[float, Number("Length that has begun to crack and still holds in part.", "m")]
    fracture_energy_j: Annotated[float, Number("Energy that the bond took.", _JOULE)]
    process_zone_m: Annotated[float, Number("Length over which the concrete softens at the tip of a crack.", "m")]
    element_m: Annotated[float, Number("Longest element along the joint.", "m")]
    tensile_strength_pa: Annotated[
        float, Number("Tensile strength that the model takes: lower than given where elements are long.", "Pa")
    ]


class BlockBond(Block):
    """How the bond of the joint below a rigid block fares, by equilibrium and linear stresses."""

    breaks_s: Annotated[
        float | None, Number("When the bond below a rigid block breaks, all at once; null where it holds.", "s")
    ]
    breaks_by: Annotated[
        str | None,
        Number(
            "Cause of its failure: tension at the heel or toe, shear downstream or upstream; null where the bond holds."
        ),
    ]
    tensile_strength_used: Annotated[
        float, Number("Largest tension at heel or toe while it holds, as a share of the tensile strength.")
    ]
    shear_strength_used: Annotated[
        float, Number("Largest shear on the joint while it holds, as a share of the shear strength.")
    ]


class Roughness(Block):
    """State of the asperities of a rough crack at the end."""

    asperity_height_m: Annotated[float, Number("Height of the asperities.", "m")]
    wave_length_m: Annotated[float, Number("Their wave length.", "m")]
    asperity_angle_before_rad: Annotated[float, Number("Angle of their flanks before the earthquake.", "rad")]
    asperity_angle_after_rad: Annotated[float, Number("Angle of their worn flanks at the end.", "rad")]
    apparent_friction_before: Annotated[float, Number("Friction along the mean plane before the earthquake.")]
    apparent_friction_after: Annotated[float, Number("Friction along the mean plane after it.")]
    residual_dilation_m: Annotated[float, Number("How far the crack is dilated in the end.", "m")]
    peak_dilation_m: Annotated[float, Number("How far it was dilated at most.", "m")]
    plastic_work_j_m2: Annotated[float, Number("Work of friction on the asperities, per area.", "J/m²")]
    slip_path_m: Annotated[float, Number("How far the crack has slipped, to and fro.", "m")]
    asperities_passed: Annotated[int, Number("How many crests were passed.")]
    integration_error_m: Annotated[float, Number("Error of the slip by integration.", "m")]


class ElasticGive(Block):
    """From when on an elastic dam rocks and drifts."""

    rotation_rad: Annotated[float, Number("Rotation from which on an elastic dam counts as rocking.", "rad")]
    gap_m: Annotated[float, Number("Gap from which on an elastic dam counts as lifted off.", "m")]


class BeforeShaking(Block):
    """How a crack stands before the earthquake."""

    stands: Annotated[bool, Number("Whether the dam stands with its crack let go.")]
    slip_m: Annotated[float, Number("Slip under the static loads before the earthquake.", "m")]
    open_contacts: Annotated[int, Number("Nodes of the crack that are open under the static loads.")]


class Penetration(Block):
    """How deep the faces of a crack are in each other at most."""

    watched: Annotated[float, Number("Deepest of a watched node into the other face.", "m")]
    any_in_frames: Annotated[float, Number("Deepest of any node, in the frames that are kept.", "m")]


class Mesh(Block):
    """The meshes of the elastic parts."""

    elements: Annotated[list[int], Number("Elements of each part: the upper one first.")]
    nodes: Annotated[list[int], Number("Nodes of each part.")]
    modes: Annotated[list[int], Number("Modes kept of each part: those of static shapes of the crack included.")]
    crack_nodes: Annotated[int, Number("Nodes along the crack.")]
    basis_error: Annotated[
        float, Number("Error of the kept modes: the share of the crack's flexibility that they miss.")
    ]


class WithoutCrossValley(Block):
    """The same dam without the shaking across the valley."""

    outcome: Annotated[str, Number("How it ends.")]
    residual_slip_m: Annotated[
        float | None,
        Number(
            "Its residual slip, the mean of as many runs where single runs of the dam scatter; null without a result.",
            "m",
        ),
    ]
    factor: Annotated[
        float | None,
        Number("Residual slip over that without the shaking across the valley; null where that is next to nothing."),
    ]


class CrossValley(Block):
    """Motion of the part above a crack across the valley, positive to the left bank."""

    residual_slip_cross_m: Annotated[
        float,
        Number(
            "Slip across the valley at the end, positive to the left bank; the mean where single runs scatter.", "m"
        ),
    ]
    peak_slip_cross_left_m: Annotated[float, Number("Largest slip to the left bank on the way.", "m")]
    peak_slip_cross_right_m: Annotated[
        float, Number("Least slip across the valley on the way: negative where it is to the right bank.", "m")
    ]
    slip_path_m: Annotated[
        float,
        Number(
            "Length of the path of the slip on the crack, along and across the valley together; none in the air.", "m"
        ),
    ]
    side_contacts: Annotated[int, Number("How often it comes to rest against a neighbour.")]
    time_at_side_s: Annotated[
        float, Number("How long a neighbour holds it across the valley, or a node of an elastic one.", "s")
    ]
    side_contact_impulse_n_s: Annotated[
        float, Number("Impulse that the neighbours take across the valley.", "N s per metre of dam")
    ]
    without_cross_valley: Annotated[
        WithoutCrossValley | None,
        Number("The same dam without that shaking; null where that was not run."),
    ] = None


class CrackNumbers(Block):
    """Numbers of a crack that every model has."""

    elevation_m: Annotated[
        float | None,
        Number(
            "Elevation of the upstream end of the crack above the lowest point of the section.",
            "m",
            optional=True,
        ),
    ] = None
    residual_slip_m: Annotated[
        float,
        Quantity(
            "Slip at the end, positive downstream.",
            "m",
            label="residual slip",
            short="residual\nslip",
            signed=True,
            column="slip",
        ),
    ]
    peak_slip_downstream_m: Annotated[
        float,
        Quantity("Largest slip on the way.", "m", label="peak slip downstream", short="peak\ndown", column="slip_max"),
    ]
    peak_slip_upstream_m: Annotated[
        float,
        Quantity(
            "Least slip on the way: negative where it is upstream of the start.",
            "m",
            label="peak slip upstream",
            short="peak\nup",
            way=-1,
            column="slip_min",
        ),
    ]
    time_of_peak_slip_s: Annotated[
        float,
        Quantity(
            "When the slip is largest either way, by the histories.",
            "s",
            label="time of the largest slip",
            compute=peak_time,
        ),
    ]
    rocking_downstream_rad: Annotated[
        float,
        Quantity(
            "Largest rotation about the toe.",
            "rad",
            label="rotation downstream",
            short="rotation\ndown",
            kind="rotation",
            column="rotation_min",
            sense=-1,
        ),
    ]
    rocking_upstream_rad: Annotated[
        float,
        Quantity(
            "Largest rotation about the heel.",
            "rad",
            label="rotation upstream",
            short="rotation\nup",
            kind="rotation",
            column="rotation_max",
        ),
    ]
    opening_upstream_m: Annotated[
        float,
        Quantity(
            "Largest opening of the crack at the upstream face.",
            "m",
            label="opening at the upstream face",
            short="opening\nup",
            kind="opening",
            column="opening_upstream",
        ),
    ]
    opening_downstream_m: Annotated[
        float,
        Quantity(
            "Largest opening of the crack at the downstream face.",
            "m",
            label="opening at the downstream face",
            short="opening\ndown",
            kind="opening",
            column="opening_downstream",
        ),
    ]
    largest_gap_heel_m: Annotated[float, Number("Largest gap at the heel, in the air included.", "m")]
    largest_gap_toe_m: Annotated[float, Number("Largest gap at the toe, in the air included.", "m")]
    slip_by_mode_m: Annotated[SlipByMode, Number("Slip while sliding, in slide-rocking and in the air.", "m")]
    time_by_mode_s: Annotated[TimeByMode, Number("How long each mode of motion lasts in all.", "s")]
    impacts: Annotated[int, Number("Blows; of an elastic dam those of the nodes of its crack.")]
    largest_impact_velocity_m_s: Annotated[float, Number("Largest velocity of approach at a blow.", "m/s")]
    final_mode: Annotated[str, Number("Mode of motion at the end.")]
    final_slip_velocity_m_s: Annotated[float, Number("Slip velocity at the end, positive downstream.", "m/s")]
    crack_width_m: Annotated[float, Number("Width of the crack.", "m")]
    friction: Annotated[float | None, Number("Coefficient of friction of the crack while it slips.", optional=True)] = (
        None
    )
    crack_energy: Annotated[
        CrackEnergy | None,
        Number("Energy that is lost in this crack.", optional=True),
    ] = None
    anchors: Annotated[
        list[AnchorForce] | None,
        Number("Place, largest tension and capacity of each anchor.", optional=True),
    ] = None
    cross_valley: Annotated[
        CrossValley | None,
        Number("Motion across the valley; null where the ground does not shake that way."),
    ] = None


#: What a crack has where it is one of several.
OF_SEVERAL = ("elevation_m", "friction", "crack_energy")


class BlockNumbers(CrackNumbers):
    """Numbers of a crack below a rigid block."""

    events: Annotated[int, Number("Changes of mode and impacts of a block.")]
    end_time_s: Annotated[float, Number("When the run ended.", "s")]
    rotation: Annotated[str, Number("Geometry of a block: small, p-delta or finite.")]
    uplift_during_shaking: Annotated[str, Number("Rule for uplift during the earthquake, from the case.")]
    drainage_by_motion: Annotated[
        list[float] | None,
        Number("Part of the drainage that each motion of a sequence meets; null where slip closes none."),
    ]
    friction_law: Annotated[
        BlockFrictionLaw | None, Number("State of the friction law at the end; null for constant coefficients.")
    ]
    roughness: Annotated[
        Roughness | None, Number("State of the asperities of a rough crack at the end; null for a flat one.")
    ]
    bond: Annotated[BlockBond | None, Number("How the bond of the joint below a rigid block fares; null of a crack.")]
    overturned_about: Annotated[str | None, Number("Corner about which a block has overturned; null where it has not.")]


class CrackSpectrum(Block):
    """Response spectra of ground and crack."""

    damping_ratio: Annotated[float, Number("Damping ratio of the spectra.")]
    periods_s: Annotated[list[float], Number("Their periods.", "s")]
    ground_g: Annotated[list[float], Number("Spectral acceleration of the ground.", "g")]
    crack_g: Annotated[list[float], Number("Spectral acceleration of the crack.", "g")]
    transfer: Annotated[list[float], Number("Motion of the crack over that of the ground, at these periods.")]
    bonded_transfer: Annotated[list[float], Number("Transfer function of the intact dam.")]


class BondedMotion(Block):
    """The motion of the same place of the intact dam."""

    periods_s: Annotated[list[float], Number("Period of the intact dam: the longest ones first.", "s")]
    peak_horizontal_g: Annotated[float, Number("Peak horizontal acceleration of the same place of it.", "g")]
    amplification: Annotated[
        float | None, Number("How many times as strong that shakes as the ground; null without a motion.")
    ]


class CrackMotionConvergence(Block):
    """How well the motion of the crack is known."""

    step_s: Annotated[float, Number("Step to which the motion of the crack was refined.", "s")]
    straightness: Annotated[float, Number("How far it is from straight lines between the steps, over its peak.")]
    half_the_modes: Annotated[float, Number("Error with the slower half of the modes, over the peak.")]
    coarser_step_s: Annotated[float, Number("Twice that step.", "s")]
    coarser_residual_slip_m: Annotated[float, Number("Residual slip with it.", "m")]
    change: Annotated[float, Number("By how much that changes the residual slip, as a share.")]


class CrackLevel(Block):
    """How the crack moves that shakes the block of the decoupled chain."""

    peak_horizontal_g: Annotated[float, Number("Peak horizontal acceleration of the crack.", "g")]
    peak_vertical_g: Annotated[float, Number("Peak vertical acceleration of the crack.", "g")]
    peak_rotation_rad_s2: Annotated[float, Number("Peak angular acceleration of the crack.", "rad/s²")]
    ground_peak_g: Annotated[float, Number("Peak acceleration of the ground.", "g")]
    amplification: Annotated[
        float | None, Number("How many times as strong the crack shakes as the ground; null without a motion.")
    ]
    felt: Annotated[list[str], Number("Which of these the block feels.")]
    upper_part: Annotated[str, Number("How the part above is attached to the part below, as the case says.")]
    periods_s: Annotated[
        list[float], Number("Period of the part below with the block on it: the longest ones first.", "s")
    ]
    damping_ratio: Annotated[float, Number("Damping ratio of its modes.")]
    modes: Annotated[int, Number("How many modes.")]
    spectrum: Annotated[CrackSpectrum, Number("Response spectra of ground and crack, and how one follows the other.")]
    bonded: Annotated[BondedMotion, Number("The motion of the same place of the intact dam.")]
    convergence: Annotated[CrackMotionConvergence, Number("How well the motion of the crack is known.")]


class Chain(Block):
    """Numbers of the decoupled chain besides those of its block."""

    crack_level: Annotated[
        CrackLevel | None,
        Number("How the crack moves that shakes the block, and how well that is known.", optional=True),
    ] = None


class SelfExcitation(Block):
    """Whether a vibration of the dam grows as it slides."""

    growth_1_s: Annotated[float, Number("How fast a vibration grows while the dam slides.", "1/s")]
    period_s: Annotated[float | None, Number("Period of that vibration; null where nothing swings.", "s")]
    sliding_time_s: Annotated[float, Number("How long the dam slides.", "s")]
    twice_damped_slip_m: Annotated[
        float | None, Number("Residual slip with twice the damping, where damping matters; else null.", "m")
    ]


class RockTrial(Block):
    """A run on other rock than is assumed."""

    modulus_pa: Annotated[
        float | None, Number("Modulus of the rock; null on a rigid plane, before water without sound.", "Pa")
    ]
    outcome: Annotated[str, Number("How that run ended.")]
    residual_slip_m: Annotated[float | None, Number("Residual slip there; null where that run has no result.", "m")]


class AssumedRock(Block):
    """The rock that is assumed where the case says nothing of it, and what other rock would do."""

    modulus_pa: Annotated[float, Number("Modulus of the assumed rock, that of the concrete.", "Pa")]
    trials: Annotated[
        list[RockTrial],
        Number(
            "The same dam on rock with half and twice this modulus, and on a rigid plane before water without sound; "
            "none where the run has no evidence."
        ),
    ]


class StressPlace(Block):
    """A stress, and when and where it was."""

    stress_pa: Annotated[float, Number("The largest principal stress of the run, without its sign.", "Pa")]
    time_s: Annotated[float, Number("When it was.", "s")]
    part: Annotated[str, Number("In which part: above or below the crack; of several cracks which part.")]
    place: Annotated[str, Number("On which face of it, or inside.")]
    x_m: Annotated[float, Number("Where: downstream in the axes of the section.", "m")]
    z_m: Annotated[float, Number("Where: height in the axes of the section.", "m")]


class TensileStrength(Block):
    """The strength of the concrete beside its largest tension."""

    dynamic_pa: Annotated[float, Number("Strength in an earthquake.", "Pa")]
    static_pa: Annotated[float, Number("Static strength.", "Pa")]
    exceeds: Annotated[bool, Number("Whether the largest tension is beyond the dynamic strength.")]
    exceeds_before_shaking: Annotated[
        bool, Number("Whether the tension before the earthquake is beyond the static one.")
    ]
    share_beyond: Annotated[float, Number("Part of the section in which the tension is beyond.")]


class TensionByMesh(Block):
    """Largest tension on another mesh."""

    other_elements_across: Annotated[int, Number("Elements along the crack of that mesh.")]
    stress_pa: Annotated[float, Number("The largest tension with it.", "Pa")]
    difference_pa: Annotated[float, Number("By how much the two differ.", "Pa")]


class Tension(StressPlace):
    """The largest tension of a run."""

    direction_rad: Annotated[float, Number("Direction of the tension, from the horizontal.", "rad")]
    before_shaking_pa: Annotated[float, Number("The largest tension before the earthquake.", "Pa")]
    strength: Annotated[
        TensileStrength | None, Number("The strength of the concrete beside it; null where the case gives none.")
    ]
    read_from_crack_m: Annotated[
        float, Number("Nearer to the crack than this, and to other places without a bound, it is not read.", "m")
    ]
    mesh: Annotated[TensionByMesh | None, Number("The same tension with another mesh; null without one.")]
    compression: Annotated[StressPlace, Number("The largest principal compression, where and when.")]


class Distribution(Block):
    """A number over many runs with the shaking varied by up to 1 %, where single runs scatter. Runs without a result
    count as farther than all others."""

    numbers: Annotated[list[float | None], Number("The number of each run, by `scales`; null where it has no result.")]
    fractile_16: Annotated[
        float | None, Number("The number that 16 % of the runs keep to, the way the mean goes; null without a result.")
    ]
    fractile_50: Annotated[float | None, Number("The number that half of the runs keep to; null without a result.")]
    fractile_84: Annotated[
        float | None, Number("The number that 84 % of the runs keep to, which limits judge; null without a result.")
    ]


class RotationWorth(Block):
    """Worth of a headline number, in its unit; of a rotation [rad] with a bound only where there is one."""

    value: Annotated[float, Number("The number to trust: that of the run, or the mean where single runs scatter.")]
    run: Annotated[float, Number("The number of the run itself.")]
    uncertainty: Annotated[
        float | None,
        Number(
            "How far it may be off: what step, mesh, shaking and surroundings move it by, together. Null on elastic "
            "rock, into which heel and toe sink farther with every finer mesh: no two meshes bound it."
        ),
    ]
    step: Annotated[float, Number("By how much another time step moves it.")]
    mesh: Annotated[
        float | None,
        Number(
            "By how much another mesh moves it: more where the mesh lowers the strength of a joint, and null without "
            "another mesh."
        ),
    ]
    shaking: Annotated[
        float | None,
        Number(
            "By how much the shaking, varied by up to 1 %, moves the number to trust: the standard deviation of a run, "
            "the standard error of a mean; null without such runs."
        ),
    ]
    surroundings: Annotated[
        float | None,
        Number(
            "By how much rock and water that reach farther move it: 1.5 times as far, and up to 1.5 times the "
            "frequency; null where there are none."
        ),
    ] = None
    spread: Annotated[
        float | None,
        Number("Standard deviation of single runs with the shaking varied by up to 1 %; null where there are none."),
    ] = None
    distribution: Annotated[
        Distribution | None,
        Number("Its distribution where single runs scatter; left out of numbers of one run.", optional=True),
    ] = None


class HeadlineWorth(RotationWorth):
    """Worth of any other headline number: there is always a bound."""

    uncertainty: Annotated[
        float, Number("How far it may be off: what step, mesh, shaking and surroundings move it by, together.")
    ]


class EvidenceNumbers(Block):
    """How far step, mesh and 1 % of the shaking move a result."""

    asked: Annotated[str, Number("Evidence that the case requests.")]
    converged: Annotated[bool, Number("Whether the residual slip is certain enough.")]
    no_limit: Annotated[
        bool,
        Number("Whether slips may grow with each finer mesh, as on rock without damping: no mesh is enough."),
    ] = False
    value_is: Annotated[
        str, Number("Whether the numbers to trust are those of the run, or means over runs that scatter.")
    ]
    moved_most_by: Annotated[
        str, Number("Largest cause of uncertainty of the residual slip: step, mesh, shaking or surroundings.")
    ]
    allowed_m: Annotated[float, Number("Uncertainty that is allowed of a converged slip.", "m")]
    time_step_s: Annotated[float, Number("Time step of the run.", "s")]
    other_time_step_s: Annotated[float, Number("Time step of the run beside it.", "s")]
    elements_across: Annotated[int, Number("Elements along the crack of the run.")]
    other_elements_across: Annotated[
        int | None, Number("Elements along the crack with another mesh; null where there is none.")
    ]
    third_elements_across: Annotated[
        int | None, Number("Elements along the crack of a third, coarser mesh; null where there is none.")
    ]
    scales: Annotated[list[float], Number("Factors on the ground motion of the runs with the shaking varied.")]
    residual_slips_m: Annotated[
        list[float | None],
        Number("Residual slips of the runs with the shaking varied; null of one without a result.", "m"),
    ]
    varied_time_step_s: Annotated[
        float | None, Number("Time step of the runs with the shaking varied; null where there are none.", "s")
    ] = None
    varied_elements_across: Annotated[
        int | None,
        Number("Elements along the crack of the runs with the shaking varied; null where there are none."),
    ] = None
    failed: Annotated[int, Number("Runs with the shaking varied that end without a result.")]
    runs: Annotated[int, Number("Runs in all.")]
    work: Annotated[float, Number("Cost of all runs, in runs of the first mesh at the step of runs that scatter.")]
    budget: Annotated[float, Number("Cost that is allowed.")]
    budget_spent: Annotated[bool, Number("Whether that ended the refinement.")]
    residual_slip_m: Annotated[HeadlineWorth, Number("Uncertainty of the residual slip.", "m")]
    peak_slip_downstream_m: Annotated[HeadlineWorth, Number("Uncertainty of the peak slip downstream.", "m")]
    peak_slip_upstream_m: Annotated[HeadlineWorth, Number("Uncertainty of the peak slip upstream.", "m")]
    rocking_downstream_rad: Annotated[RotationWorth, Number("Uncertainty of the rotation downstream.", "rad")]
    rocking_upstream_rad: Annotated[RotationWorth, Number("Uncertainty of the rotation upstream.", "rad")]
    opening_upstream_m: Annotated[HeadlineWorth, Number("Uncertainty of the opening at the upstream face.", "m")]
    opening_downstream_m: Annotated[HeadlineWorth, Number("Uncertainty of the opening at the downstream face.", "m")]
    cracked_length_m: Annotated[
        HeadlineWorth | None, Number("Uncertainty of the cracked length of a joint; null for a crack.", "m")
    ] = None
    residual_slip_cross_m: Annotated[
        HeadlineWorth | None,
        Number("Uncertainty of the slip across the valley; null where the ground does not shake that way.", "m"),
    ] = None

    @property
    def scatters(self) -> bool:
        """Whether single runs scatter, so that the numbers to trust are means of distributions."""
        return self.value_is == "mean"


class ElasticCrack(CrackNumbers):
    """Numbers of a crack of an elastic dam."""

    elastic_give: Annotated[ElasticGive, Number("Rotation and gap from which on it rocks and drifts.")]
    peak_normal_force_n: Annotated[float, Number("Largest force across the crack.", _NEWTON)]
    before_shaking: Annotated[
        BeforeShaking | None,
        Number("Whether the dam stands with its crack let go, what slips and opens then; null with penalties."),
    ]
    penetration_m: Annotated[
        Penetration, Number("Deepest into the other face: of watched nodes, of any in a frame.", "m")
    ]
    evidence: Annotated[
        EvidenceNumbers | None,
        Number("How far step, mesh and 1 % of the shaking move it; null where none was wanted."),
    ]
    friction_law: Annotated[
        ElasticFrictionLaw | None,
        Number("State of the friction law at the end; null for constant coefficients."),
    ]
    joint: Annotated[BondState | None, Number("State of the bond of a joint at the end; null for a crack.")]


class FacePressure(Block):
    """The pressure of compressible water on a face over a run, by a state every half millisecond or longer step."""

    side: Annotated[str, Number("Which water: reservoir or tailwater.")]
    largest_pa: Annotated[float, Number("Largest pressure beyond that at rest.", "Pa")]
    largest_time_s: Annotated[float, Number("When that is.", "s")]
    largest_z_m: Annotated[float, Number("At which height of the section.", "m")]
    lowest_absolute_pa: Annotated[
        float, Number("Lowest pressure, that at rest and that of the air at sea level included.", "Pa")
    ]
    lowest_time_s: Annotated[float, Number("When that is.", "s")]
    lowest_z_m: Annotated[float, Number("At which height of the section.", "m")]
    cavitates: Annotated[
        bool, Number("Whether that is below the pressure of water vapour: the water would tear off, which no run has.")
    ]


class ElasticDam(Block):
    """Numbers of an elastic dam as a whole."""

    end_time_s: Annotated[float, Number("When the run ended.", "s")]
    periods_s: Annotated[list[float], Number("Period of the intact dam with its water: the longest ones first.", "s")]
    mesh: Annotated[Mesh, Number("Elements, nodes and modes of each part, nodes along the crack, error of the basis.")]
    damping: Annotated[str, Number("How the concrete is damped, as the case says.")]
    damping_ratio: Annotated[float, Number("Damping ratio of the concrete.")]
    damping_ratios: Annotated[list[float], Number("Damping of a mode of the intact dam: the ratios of modes 1 to 5.")]
    rayleigh_mass_1_s: Annotated[float | None, Number("Rayleigh coefficient of mass.", "1/s")]
    rayleigh_stiffness_s: Annotated[float | None, Number("Rayleigh coefficient of stiffness.", "s")]
    contact: Annotated[str, Number("How contact is solved, as the case says.")]
    steps: Annotated[int, Number("Number of time steps.")]
    time_step_s: Annotated[float, Number("Time step.", "s")]
    contact_iterations_per_step: Annotated[float, Number("Tries per step until the contact forces are found.")]
    contact_residual: Annotated[float, Number("Worst violation of the contact conditions, over the impulse.")]
    uplift_during_shaking: Annotated[str, Number("Rule for uplift during the earthquake, from the case.")]
    drainage_by_motion: Annotated[
        list[float] | None,
        Number("Part of the drainage that each motion of a sequence meets; null where slip closes none."),
    ]
    self_excitation: Annotated[
        SelfExcitation | None,
        Number("How fast a vibration grows as the dam slides; null where it does not slide."),
    ]
    assumed_rock: Annotated[
        AssumedRock | None,
        Number("The rock that is assumed below the dam; null where the case says which rock it is."),
    ]
    tension: Annotated[
        Tension | None,
        Number(
            "The largest tension over the run, where and when, and whether the concrete bears it; null where it has "
            "no bound anywhere."
        ),
    ]
    water_pressure: Annotated[
        list[FacePressure] | None,
        Number(
            "Extremes of the pressure of compressible water on each face; left out without such water.", optional=True
        ),
    ] = None


class Statistics(Block):
    """How a headline number is distributed."""

    mean: Annotated[float, Number("Mean of this headline number.")]
    std: Annotated[float, Number("Its standard deviation, that of a sample.")]
    min: Annotated[float, Number("Its smallest value.")]
    max: Annotated[float, Number("Its largest value.")]


class SignNumbers(Block):
    """Numbers of a run with one sign of the motion."""

    sign: Annotated[str, Number("Which way round the motion shakes the dam: recorded or reversed.")]
    governs: Annotated[bool, Number("Whether it is the worse way, whose numbers lead the result.")]
    outcome: Annotated[str, Number("How the run ended.")]
    elevation_m: Annotated[
        float | None,
        Number("Elevation of the crack that slips most; null where the run has no result.", "m", optional=True),
    ]
    residual_slip_m: Annotated[
        float | None, Number("Its residual slip, positive downstream; null without a result.", "m", optional=True)
    ]
    opening_m: Annotated[
        float | None, Number("Largest opening of a crack at either face; null without a result.", "m", optional=True)
    ]
    limits_not_met: Annotated[int, Number("How many of the limits of the case it does not meet.")]


#: Name of the friction that the crack states, in a band of others.
BEST = "best"


class FrictionTrial(Block):
    """A run with one of the frictions that the crack may have."""

    name: Annotated[str, Number("Which friction: best, or the field of `[crack.band]`.")]
    friction: Annotated[Sentence, Number("The friction, in words.")]
    outcome: Annotated[str, Number("How the run ended; of two signs of the motion the worse one.")]
    residual_slip_m: Annotated[float | None, Number("Residual slip, positive downstream; null without a result.", "m")]
    opening_m: Annotated[float | None, Number("Largest opening of a crack at either face; null without a result.", "m")]
    limits_not_met: Annotated[int, Number("How many of the limits of the case it does not meet.")]
    judged: Annotated[bool, Number("Whether it is the friction that the limits judge.")]


class FrictionBand(Block):
    """The same run with every friction that the crack may have."""

    trials: Annotated[
        list[FrictionTrial],
        Number("The best estimate, which leads the result, and the others; of an elastic dam without evidence."),
    ]

    @property
    def judged(self) -> FrictionTrial:
        """The friction that the limits judge."""
        return next(trial for trial in self.trials if trial.judged)


class FrictionEffect(Block):
    """The same run with a little less friction, where the crack has no band."""

    friction_change: Annotated[float, Number("By how much the coefficient of friction differs.")]
    outcome: Annotated[str, Number("How the run ended.")]
    residual_slip_m: Annotated[
        float | None,
        Number(
            "Its residual slip, positive downstream, of an elastic dam without evidence; null without a result.", "m"
        ),
    ]
    slip_change_m: Annotated[
        float | None,
        Number("How much farther it slides than the same run with the friction of the crack; null without both.", "m"),
    ]


class Spread(Block):
    """The same run with slightly weaker and stronger shaking."""

    runs: Annotated[int, Number("How many.")]
    failed: Annotated[int, Number("How many of them ended without a result; they count nowhere else.")]
    scales: Annotated[list[float], Number("The factors on the ground motion.")]
    time_step_s: Annotated[float | None, Number("Time step of the runs of the flexible model.", "s", optional=True)] = (
        None
    )
    residual_slips_m: Annotated[list[float | None], Number("Residual slip of each; null where it failed.", "m")]
    residual_slip_m: Annotated[
        Statistics | None, Number("Distribution of the residual slip; null of fewer than two runs.", "m")
    ]
    peak_slip_downstream_m: Annotated[
        Statistics | None, Number("Distribution of the peak slip downstream; null of fewer than two runs.", "m")
    ]
    peak_slip_upstream_m: Annotated[
        Statistics | None, Number("Distribution of the peak slip upstream; null of fewer than two runs.", "m")
    ]
    rocking_downstream_rad: Annotated[
        Statistics | None, Number("Distribution of the rotation downstream; null of fewer than two runs.", "rad")
    ]
    rocking_upstream_rad: Annotated[
        Statistics | None, Number("Distribution of the rotation upstream; null of fewer than two runs.", "rad")
    ]
    opening_upstream_m: Annotated[
        Statistics | None, Number("Distribution of the opening upstream; null of fewer than two runs.", "m")
    ]
    opening_downstream_m: Annotated[
        Statistics | None, Number("Distribution of the opening downstream; null of fewer than two runs.", "m")
    ]


class Energy(Block):
    """The energy ledger of a run, per metre of dam."""

    input_j: Annotated[
        float,
        Number(
            "Energy put in: work of water, weight, uplift and the ground's inertia force on the motion relative to the "
            "ground.",
            _JOULE,
        ),
    ]
    friction_j: Annotated[float, Number("Energy lost in friction.", _JOULE)]
    impact_j: Annotated[float, Number("Energy lost in impacts.", _JOULE)]
    left_j: Annotated[
        float,
        Number(
            "Energy left in the dam at the end, less that at the start: kinetic, and of elastic parts with that of "
            "strain and anchors; below zero where the dam has let go of some.",
            _JOULE,
        ),
    ]
    residual: Annotated[
        float, Number("Error of the balance of all others, over the turnover; rounding if the run is sound.")
    ]
    damping_j: Annotated[float, Number("Energy lost in the concrete's damping; zero for a block.", _JOULE)] = 0.0
    fracture_j: Annotated[float, Number("Energy that the bonds of joints have taken; zero without one.", _JOULE)] = 0.0
    rock_j: Annotated[
        float, Number("Energy that left as waves in the rock, or was lost in it; zero on a rigid plane.", _JOULE)
    ] = 0.0
    floor_j: Annotated[
        float, Number("Energy that left through the floor of the reservoir; zero without compressible water.", _JOULE)
    ] = 0.0
    far_end_j: Annotated[
        float, Number("Energy that left along the reservoir; zero without compressible water.", _JOULE)
    ] = 0.0
    numerical_j: Annotated[float, Number("Energy lost by the time stepping itself; zero for a block.", _JOULE)] = 0.0
    gained_j: Annotated[
        float,
        Number(
            "Energy that contact added, which should be nothing: in steps of positive work, and by bonds beyond their "
            "own.",
            _JOULE,
        ),
    ] = 0.0


class Chosen(Block):
    """How a model came to be the one that the numbers are from."""

    asked: Annotated[str, Number("Model that was requested: one, two of them, or auto.")]
    why: Annotated[str, Number("Why it is this model.")]


class Stage(Block):
    """A motion of a sequence, as the histories of its run have it."""

    name: Annotated[str, Number("Name of the record.")]
    pga_g: Annotated[float, Number("Peak acceleration of the motion.", "g")]
    begins_s: Annotated[float, Number("When the motion begins, in the time of the whole run.", "s")]
    ends_s: Annotated[float, Number("When it ends.", "s")]
    slip_m: Annotated[float, Number("Slip that it adds, positive downstream.", "m")]
    residual_slip_m: Annotated[float, Number("Where it leaves the dam, since before the first motion.", "m")]
    peak_slip_downstream_m: Annotated[float, Number("Largest slip on its way, since before the first motion.", "m")]
    peak_slip_upstream_m: Annotated[float, Number("Largest slip upstream on its way, since then; never positive.", "m")]
    opening_upstream_m: Annotated[float, Number("Largest opening of the crack at the upstream face.", "m")]
    opening_downstream_m: Annotated[float, Number("Largest opening of the crack at the downstream face.", "m")]
    rotation_downstream_rad: Annotated[float, Number("Largest rotation about the toe.", "rad")]
    rotation_upstream_rad: Annotated[float, Number("Largest rotation about the heel.", "rad")]
    at_rest: Annotated[
        bool, Number("Whether the dam has come to rest before the next motion begins, or before the run ends.")
    ]
    static: Annotated[
        Mapping[str, Any],
        Number("Static checks of the dam that it leaves: ok, the checks that are missed, drainage that is left."),
    ] = field(default_factory=dict)

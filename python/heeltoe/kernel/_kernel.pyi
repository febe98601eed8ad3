"""Types of the compiled kernels. SI units, per metre of dam."""

from collections.abc import Sequence
from typing import Final, Protocol, final

import numpy as np
from numpy.typing import NDArray

VERSION: Final[str]
PROFILE: Final[str]
BLOCK_FIELDS: Final[list[str]]
PLACE_FIELDS: Final[list[str]]
VARYING_FIELDS: Final[list[str]]
ASPERITY_FIELDS: Final[list[str]]
LAW_FIELDS: Final[list[str]]
LAWS: Final[list[str]]
SUMMARY_FIELDS: Final[list[str]]
MODES: Final[list[str]]
EVENT_KINDS: Final[list[str]]
OUTCOMES: Final[list[str]]

Floats = NDArray[np.float64]

class InternalError(RuntimeError):
    """A bug of the kernels: it says what and where."""

class Ending:
    """Ends runs that wait on other threads than the main one, which alone hears of signals."""

    def __init__(self) -> None: ...
    def ask(self) -> None:
        """Let all runs that have been given this one raise KeyboardInterrupt, with a note on how far they have come."""

class FrictionLaw:
    """How much shear a closed crack bears."""

    def __init__(self, shape: str, numbers: Floats, points: Floats) -> None:
        """Of one of ``LAWS``, with its numbers in the order of ``LAW_FIELDS``, and of a lift joint (k, 2) normal stress
        [Pa] and what roughness adds to the coefficient."""

    def shear_stress(self, stress: Floats, speed: Floats, path: Floats, bonded: Floats) -> Floats:
        """Return the (n, 2) shear stresses borne at rest and sliding [Pa].

        Parameters
        ----------
        stress, speed, path, bonded
            (n,) normal stress [Pa], speed of the slip [m/s], path slipped so far [m], and 1 while the bond is whole.
        """

@final
class BlockSummary:
    """End, peaks and sums of a block's run, SI; ``outcome`` and ``final_mode`` count ``OUTCOMES`` and ``MODES``."""

    outcome: Final[float]
    end_time: Final[float]
    final_mode: Final[float]
    slip: Final[float]
    gap_heel: Final[float]
    gap_toe: Final[float]
    slip_velocity: Final[float]
    gap_velocity_heel: Final[float]
    gap_velocity_toe: Final[float]
    slip_min: Final[float]
    slip_max: Final[float]
    rotation_min: Final[float]
    rotation_max: Final[float]
    largest_gap_heel: Final[float]
    largest_gap_toe: Final[float]
    slip_sliding: Final[float]
    slip_slide_rocking: Final[float]
    slip_drifting: Final[float]
    time_rest: Final[float]
    time_sliding: Final[float]
    time_rocking: Final[float]
    time_slide_rocking: Final[float]
    time_drifting: Final[float]
    impacts: Final[float]
    events: Final[float]
    largest_impact_velocity: Final[float]
    energy_limited_impacts: Final[float]
    jams: Final[float]
    slip_stops: Final[float]
    energy_input: Final[float]
    energy_friction: Final[float]
    energy_impact: Final[float]
    energy_kinetic: Final[float]
    energy_residual: Final[float]

    def by_name(self) -> dict[str, float]:
        """Return the numbers by their names, for tables."""

@final
class BlockHistories:
    """A block at the moments that were asked for, (k,) each, fewer where the run stopped early."""

    slip: Final[Floats]
    gap_heel: Final[Floats]
    gap_toe: Final[Floats]
    slip_velocity: Final[Floats]
    gap_velocity_heel: Final[Floats]
    gap_velocity_toe: Final[Floats]
    slip_acceleration: Final[Floats]
    gap_acceleration_heel: Final[Floats]
    gap_acceleration_toe: Final[Floats]
    friction_force: Final[Floats]
    normal_force_heel: Final[Floats]
    normal_force_toe: Final[Floats]

    def by_name(self) -> dict[str, Floats]:
        """Return the columns by their names, for tables."""

@final
class BlockEvents:
    """The events of a block, (m,) each; kinds and modes count ``EVENT_KINDS`` and ``MODES``."""

    time: Final[Floats]
    kind: Final[Floats]
    mode_before: Final[Floats]
    mode_after: Final[Floats]
    slip: Final[Floats]
    gap_heel: Final[Floats]
    gap_toe: Final[Floats]
    slip_velocity: Final[Floats]
    gap_velocity_heel: Final[Floats]
    gap_velocity_toe: Final[Floats]
    approach_slip_velocity: Final[Floats]
    approach_velocity_heel: Final[Floats]
    approach_velocity_toe: Final[Floats]
    friction_impulse: Final[Floats]
    heel_impulse: Final[Floats]
    toe_impulse: Final[Floats]
    energy_lost: Final[Floats]

    def by_name(self) -> dict[str, Floats]:
        """Return the columns by their names, for tables."""

@final
class Worn:
    """What a crack whose friction goes by a law has been through.

    Attributes
    ----------
    path, bonded
        At the moments that were asked for: how far it has slipped, to and fro [m], and 1 while its bond is whole.
    end, bonded_at_end
        The same when the run ended.
    error
        Sum of the errors estimated of all steps of the integration, and of what those in the velocity come to [m].
    integrated
        Time that these steps took; all else of the run is exact [s].
    """

    path: Final[Floats]
    bonded: Final[Floats]
    end: Final[float]
    bonded_at_end: Final[bool]
    error: Final[float]
    integrated: Final[float]

@final
class Roughness:
    """What the asperities of a rough crack have been through.

    Attributes
    ----------
    kept
        (k, 3) at the moments that were asked for: how high the flank is on which the block is, or above which it flies,
        over the valley in which it stood at first [m], angle of the flanks [rad], plastic work per area [J/m2].
    end
        The same three when the run ended.
    highest
        Largest dilation with a corner in contact [m].
    """

    kept: Final[Floats]
    end: Final[tuple[float, float, float]]
    highest: Final[float]

@final
class CrossingSummary:
    """End, peaks and sums of a block across the valley, SI, per metre of dam; positive to the left bank.

    ``path`` is the length of the slip's path, along and across together; ``side_impulse`` what the neighbours have
    taken, ``time_at_side`` how long one of them held the block.
    """

    slip: Final[float]
    slip_velocity: Final[float]
    slip_min: Final[float]
    slip_max: Final[float]
    path: Final[float]
    side_impulse: Final[float]
    time_at_side: Final[float]
    side_strikes: Final[float]

    def by_name(self) -> dict[str, float]:
        """Return the numbers by their names."""

@final
class Crossing:
    """Motion of a block across the valley.

    Attributes
    ----------
    kept
        (k, 3) at the moments that were asked for: place [m], velocity [m/s] and friction [N/m], to the left bank.
    """

    kept: Final[Floats]
    summary: Final[CrossingSummary]

@final
class BlockRun:
    """What a block did.

    Attributes
    ----------
    mode
        At the moments of the histories, counting ``MODES``.
    anchors
        (n, 5) of each anchor of what varies: largest tension, and largest force with the resistance to slip [N/m]; when
        its prestress was gone and when its force was more than its capacity for the first time [s], below zero where
        never; tension at the end. None where the walk was exact and nothing varies.
    worn
        What the crack has been through, where its friction goes by a law.
    rough
        What its asperities have been through, where it is rough.
    crossing
        Motion across the valley, where the ground shakes that way.
    places
        (k, 3) slip and gaps at heel and toe at all moments, where not all are wanted whole [m].
    exact
        Whether closed forms carry it from event to event, or the walk was integrated.
    outcome, final_mode
        By name.
    """

    summary: Final[BlockSummary]
    histories: Final[BlockHistories]
    mode: Final[NDArray[np.uint8]]
    events: Final[BlockEvents]
    anchors: Final[Floats | None]
    worn: Final[Worn | None]
    rough: Final[Roughness | None]
    crossing: Final[Crossing | None]
    places: Final[Floats]

    @property
    def exact(self) -> bool: ...
    @property
    def outcome(self) -> str: ...
    @property
    def final_mode(self) -> str: ...
    def times_of(self, *kinds: str) -> list[float]:
        """Return the moments of all events of some kinds [s]."""

    def then(self, later: BlockRun) -> BlockRun:
        """Return this run and one that goes on from its end as one."""

@final
class StackRun:
    """What two blocks did.

    Attributes
    ----------
    cracks
        At the lower and at the upper crack, where the upper block moves relative to the lower one; energies are
        those of both together.
    tilts
        (2, 2) least and largest rotation of the lower and of the upper block from the ground [rad].
    lost
        (2, 2) lost to friction and to impacts in the lower and in the upper crack [J/m].
    """

    cracks: Final[tuple[BlockRun, BlockRun]]
    tilts: Final[Floats]
    lost: Final[Floats]

def run_rigid(
    block: Floats,
    time: Floats,
    horizontal: Floats,
    vertical: Floats | None,
    output_times: Floats,
    start: Sequence[Sequence[float]] | None,
    settle: float,
    event_limit: int,
    jam: bool,
    whole: NDArray[np.bool_] | None = None,
) -> BlockRun:
    """Run one block through one motion.

    Parameters
    ----------
    block
        (22,) numbers in the order of ``BLOCK_FIELDS``.
    time, horizontal, vertical
        (n,) moments in s, not decreasing, and ground accelerations in m/s2 (downstream, upward); linear between the
        moments, a repeated moment is a jump.
    output_times
        (k,) ascending moments at which the state is wanted; at an event the state after it.
    start
        (slip, heel gap, toe gap) in m and their velocities in m/s at the first moment. Without it the block stands
        still, and must be able to under its static loads.
    settle
        Bounces slower than ``settle * sqrt(g' B)`` end the bouncing, g' the effective weight per mass, B the width.
    event_limit
        Most events before the run stops with that outcome.
    jam
        Resolve a Painlevé paradox by a tangential impact instead of stopping there.
    whole
        (k,) at which of these moments all of the state is wanted; at the others the place alone. Without it, all of it
        at all of them, and no places.
    """

def run_rigid_plane(
    block: Floats,
    across: Sequence[float],
    time: Floats,
    horizontal: Floats,
    vertical: Floats | None,
    cross: Floats,
    output_times: Floats,
    start: Sequence[Sequence[float]] | None,
    settle: float,
    event_limit: int,
    jam: bool,
    whole: NDArray[np.bool_] | None = None,
) -> BlockRun:
    """Run one block on a ground that shakes across the valley, too; friction is one circle.

    Parameters
    ----------
    across
        (5,) mass across the valley [kg/m], the distances of the neighbours to the left and to the right [m], infinite
        where there are none, and place and velocity across the valley at the start [m, m/s].
    cross
        (n,) acceleration of the ground to the left bank [m/s2].

    The others are those of :func:`run_rigid`.
    """

def run_rigid_stack(
    lower: Floats,
    upper: Floats,
    place: Floats,
    time: Floats,
    horizontal: Floats,
    vertical: Floats | None,
    output_times: Floats,
    settle: float,
    event_limit: int,
    jam: bool,
    whole: NDArray[np.bool_] | None = None,
) -> StackRun:
    """Run two blocks, one on the other, exactly from event to event.

    Parameters
    ----------
    lower, upper
        (22,) numbers in the order of ``BLOCK_FIELDS``: of all above the lower crack as one block, and of what is above
        the upper one.
    place
        (3,) numbers in the order of ``PLACE_FIELDS``.
    time, horizontal, vertical, output_times, settle, event_limit, jam
        As of :func:`run_rigid`.
    """

def run_rigid_varying(
    block: Floats,
    varying: Floats,
    rotation: str,
    law: str,
    pressure: Floats,
    anchors: Floats,
    friction: FrictionLaw | None,
    asperities: Floats | None,
    time: Floats,
    horizontal: Floats,
    vertical: Floats | None,
    turning: Floats | None,
    output_times: Floats,
    start: Sequence[Sequence[float]] | None,
    worn: tuple[float, bool] | None,
    rough: tuple[float, float] | None,
    settle: float,
    event_limit: int,
    jam: bool,
    across: Sequence[float] | None = None,
    cross: Floats | None = None,
    whole: NDArray[np.bool_] | None = None,
) -> BlockRun:
    """Run one block whose loads or geometry change as it moves, by integration between events.

    Parameters
    ----------
    block
        As of :func:`run_rigid`, with all static loads as they are while the crack is closed.
    varying
        (21,) numbers in the order of ``VARYING_FIELDS``.
    rotation
        ``small``, ``p-delta`` or ``finite``.
    law
        What the pressure in the crack does as it opens: ``constant``, ``zero while open``, ``full while open``,
        ``follows opening``.
    pressure
        (k, 2) distance from the heel [m] and pressure while the crack is closed [Pa]; straight in between.
    anchors
        (n, 7) distance from the heel [m], axis along and across, prestress [N/m], axial and shear stiffness [N/m2],
        capacity [N/m], infinite where there is none.
    friction
        Along the crack, or along the flanks of its asperities.
    asperities
        Their numbers in the order of ``ASPERITY_FIELDS``, where the crack is rough and has a law.
    turning
        (n,) rotational acceleration of the ground about the middle of the crack, counter-clockwise [rad/s2].
    worn
        Where the crack is not new: how far it has slipped, to and fro [m], and whether its bond is whole.
    rough
        Where a rough crack is not new: how far it has dilated [m], and the plastic work that has worn it [J/m2].

    The others are those of :func:`run_rigid`.
    """

def run_rigid_many(
    blocks: Floats,
    motions: Sequence[tuple[Floats, Floats, Floats | None]],
    motion_of: NDArray[np.int64],
    scales: Floats,
    settle: float,
    event_limit: int,
    jam: bool,
    threads: int,
    crest: tuple[Floats, Sequence[Floats], Floats] | None = None,
) -> dict[str, Floats]:
    """Run (n, 22) blocks, each through the motion ``motion_of`` names with the accelerations times ``scales`` (n, 2).

    ``threads`` of 0 means all cores. Returns (n,) arrays by the names of ``SUMMARY_FIELDS``, the same bits for
    any number of threads. ``crest`` says how far slip and gaps of each block move its crest (n, 3), at which moments of
    each motion that is looked at, and the weights of the filter of its acceleration for the distances 0, 1, 2, ...
    between them; then ``crest_displacement`` and ``crest_acceleration`` are among them.
    """

def end_if_deaf(descriptor: int, seconds: float) -> None:
    """End this process, with exit code 130, where Python does not hear of an interruption for so long: it may be deep
    in a library. Not on Windows.

    Parameters
    ----------
    descriptor
        Of a pipe from which signals are read, see `signal.set_wakeup_fd`.
    seconds
        How long Python has.
    """

def hear_interruption() -> None:
    """Say that Python has heard. Not on Windows."""

def spectrum(time: Floats, ground: Floats, periods: Floats, damping: float) -> Floats:
    """Return (k, 2): largest relative displacement [m] and total acceleration [m/s2] of oscillators.

    ``periods`` (k,) in s, zero for the ground itself; ``damping`` in [0, 1). Exact for ground accelerations (n,) that
    are linear between the moments ``time`` (n,).
    """

CRACK_OUTCOMES: Final[list[str]]
CRACK_STATES: Final[list[str]]
CONTACT_STATUSES: Final[list[str]]

class ReducedBody(Protocol):
    """An elastic body: m modes, k nodes on the crack; see :class:`heeltoe.models.flexible.body.reduced.ReducedBody`."""

    @property
    def omega_squared(self) -> Floats: ...
    @property
    def damping_sticking(self) -> Floats: ...
    @property
    def damping_free(self) -> Floats: ...
    @property
    def load(self) -> Floats: ...
    @property
    def participation_horizontal(self) -> Floats: ...
    @property
    def participation_vertical(self) -> Floats: ...
    @property
    def start(self) -> Floats: ...
    @property
    def shapes(self) -> Floats: ...
    @property
    def position(self) -> Floats: ...
    @property
    def dampers(self) -> Floats: ...
    @property
    def damper_signs(self) -> Floats: ...
    @property
    def wet(self) -> Floats: ...
    @property
    def boundary(self) -> Floats: ...

class Reservoir(Protocol):
    """Water with sound; see :class:`heeltoe.models.flexible.surroundings.water.ReducedWater`."""

    @property
    def omega_squared(self) -> Floats: ...
    @property
    def damping_floor(self) -> Floats: ...
    @property
    def damping_far(self) -> Floats: ...
    @property
    def ground(self) -> Floats: ...

class FollowingWater(Protocol):
    """Water in the crack; see :class:`heeltoe.kernel.dam.FollowingWater`."""

    @property
    def law(self) -> str: ...
    @property
    def opening(self) -> float: ...
    @property
    def still(self) -> Sequence[Floats]: ...
    @property
    def full(self) -> Sequence[Floats]: ...

class RisingWater(Protocol):
    """Water whose pressure changes with time; see :class:`heeltoe.kernel.dam.RisingWater`."""

    @property
    def crack(self) -> int: ...
    @property
    def span(self) -> tuple[float, float]: ...
    @property
    def change(self) -> Sequence[Floats]: ...

class CrackAnchor(Protocol):
    """An anchor; see :class:`heeltoe.kernel.dam.CrackAnchor`."""

    @property
    def anchor(self) -> int: ...
    @property
    def points(self) -> Sequence[Sequence[tuple[int, float]]]: ...
    @property
    def axis(self) -> tuple[float, float]: ...
    @property
    def prestress(self) -> float: ...
    @property
    def axial_stiffness(self) -> float: ...
    @property
    def shear_stiffness(self) -> float: ...
    @property
    def capacity(self) -> float: ...

class CrackLine(Protocol):
    """A crack; see :class:`heeltoe.kernel.dam.CrackLine`."""

    @property
    def upper(self) -> tuple[int, int]: ...
    @property
    def lower(self) -> tuple[int, int]: ...
    @property
    def friction(self) -> tuple[float, float]: ...
    @property
    def law(self) -> FrictionLaw | None: ...
    @property
    def give(self) -> tuple[float, float]: ...
    @property
    def angles(self) -> tuple[list[float], list[float]]: ...
    @property
    def bond(self) -> tuple[float, float, float, float, float, float] | None: ...
    @property
    def water(self) -> FollowingWater | None: ...
    @property
    def anchors(self) -> Sequence[CrackAnchor]: ...

class StressRows(Protocol):
    """Stresses by the modes; see :class:`heeltoe.models.flexible.body.stress_places.StressRows`."""

    @property
    def parts(self) -> Sequence[Floats]: ...
    @property
    def stride(self) -> int: ...

@final
class DamSummary:
    """End, peaks and sums at one crack, SI; ``outcome`` and ``final_state`` count ``CRACK_OUTCOMES`` and
    ``CRACK_STATES``."""

    outcome: Final[float]
    end_time: Final[float]
    slip: Final[float]
    slip_max: Final[float]
    slip_min: Final[float]
    slip_velocity: Final[float]
    rotation_max: Final[float]
    rotation_min: Final[float]
    opening_upstream: Final[float]
    opening_downstream: Final[float]
    penetration: Final[float]
    slip_sliding: Final[float]
    slip_slide_rocking: Final[float]
    slip_drifting: Final[float]
    time_rest: Final[float]
    time_sliding: Final[float]
    time_rocking: Final[float]
    time_slide_rocking: Final[float]
    time_drifting: Final[float]
    impacts: Final[float]
    largest_impact_velocity: Final[float]
    peak_normal_force: Final[float]
    energy_start: Final[float]
    energy_stored: Final[float]
    energy_penalty: Final[float]
    energy_input: Final[float]
    energy_damping: Final[float]
    energy_numerical: Final[float]
    energy_impact: Final[float]
    energy_friction: Final[float]
    energy_gained: Final[float]
    energy_turnover: Final[float]
    energy_residual: Final[float]
    steps: Final[float]
    iterations: Final[float]
    most_iterations: Final[float]
    sweeps: Final[float]
    contact_residual: Final[float]
    final_state: Final[float]
    crack_friction: Final[float]
    crack_impact: Final[float]
    slip_path: Final[float]
    bond_energy: Final[float]
    energy_fracture: Final[float]
    energy_boundary: Final[float]
    energy_floor: Final[float]
    energy_far_end: Final[float]
    crack_fracture: Final[float]
    first_cracking: Final[float]
    first_cracking_place: Final[float]
    cracked_through: Final[float]
    cracked_from_heel: Final[float]
    cracked_from_toe: Final[float]
    cracked_length: Final[float]
    softening_length: Final[float]
    cross_slip: Final[float]
    cross_slip_max: Final[float]
    cross_slip_min: Final[float]
    cross_slip_path: Final[float]
    side_contacts: Final[float]
    time_at_side: Final[float]
    side_impulse: Final[float]

    def by_name(self) -> dict[str, float]:
        """Return the numbers by their names, for tables."""

@final
class DamFrames:
    """A crack frame by frame, (f,) each."""

    time: Final[Floats]
    slip: Final[Floats]
    slip_velocity: Final[Floats]
    rotation: Final[Floats]
    gap_heel: Final[Floats]
    gap_toe: Final[Floats]
    normal_force: Final[Floats]
    friction_force: Final[Floats]
    touching: Final[Floats]
    state: Final[Floats]
    stored_energy: Final[Floats]
    input_energy: Final[Floats]
    damping_energy: Final[Floats]
    impact_energy: Final[Floats]
    friction_energy: Final[Floats]
    numerical_energy: Final[Floats]
    slip_path: Final[Floats]
    friction_strength: Final[Floats]
    fracture_energy: Final[Floats]
    boundary_energy: Final[Floats]
    floor_energy: Final[Floats]
    far_end_energy: Final[Floats]
    cracked_upstream: Final[Floats]
    cracked_downstream: Final[Floats]
    cracked_length: Final[Floats]
    softening_length: Final[Floats]
    slip_cross: Final[Floats]
    friction_cross: Final[Floats]

    def by_name(self) -> dict[str, Floats]:
        """Return the columns by their names, for tables."""

@final
class StressExtremes:
    """Stresses at the places of a part, (p,) each [Pa].

    The largest principal stress, when, and the stress then; the least principal stress, and when.
    """

    tension: Final[Floats]
    tension_time: Final[Floats]
    xx: Final[Floats]
    zz: Final[Floats]
    xz: Final[Floats]
    compression: Final[Floats]
    compression_time: Final[Floats]

    def by_name(self) -> dict[str, Floats]:
        """Return the columns by their names, for tables."""

@final
class WornContacts:
    """What the watched nodes of cracks with a law have been through, (n,) each.

    Number of the crack, the length of it that is theirs [m], whether they come in the place of the other face's end,
    path slipped [m] and whether the bond is whole, both before the earthquake, and the normal force then [N].
    """

    crack: Final[Floats]
    length: Final[Floats]
    double: Final[Floats]
    path: Final[Floats]
    bonded: Final[Floats]
    path_before: Final[Floats]
    bonded_before: Final[Floats]
    normal_force_before: Final[Floats]

    def by_name(self) -> dict[str, Floats]:
        """Return the columns by their names, for tables."""

@final
class DamRun:
    """What an elastic dam did; f frames, k nodes on cracks, m modes.

    Attributes
    ----------
    summary, frames
        Of the crack asked of.
    summaries, all_frames
        Of all cracks, from the crest down.
    anchors
        (n, 5) of each anchor with stiffness, crack by crack: largest tension, and largest force with the resistance to
        slip [N]; when its prestress was gone and when its force was more than its capacity for the first time [s],
        below zero where never; tension at the end [N].
    upper, lower
        (f, 2 k) where the nodes of either face are, all along the crack, then all across it [m], crack by crack; (f, 0)
        for a rigid plane.
    force
        (f, 2 k) mean forces on the nodes of the upper face since the frame before [N], crack by crack.
    status
        (f, c) of each watched node, counting ``CONTACT_STATUSES``.
    damage
        (f, c) of the bond of each: 0 intact, 1 broken or without a bond; (f, 0) without a bonded joint.
    modes
        (f, m) amplitudes of the modes of each part, from the crest down, with those of the rock last.
    water
        (f, w) velocities of the modes of the water with sound; its pressure comes of them.
    extremes
        Of the stresses of each part, from the crest down. Empty where none are wanted.
    pressures
        Of the pressures of water with sound, as stresses. Empty where none are wanted.
    worked
        Empty without a law.
    crest
        (s + 1,) where the point of the first part is that was wanted, at the start and after each step, from anywhere
        [m]; empty where none was.
    crest_cross
        The same across the valley [m].
    outcome, final_state
        By name.
    """

    summary: Final[DamSummary]
    anchors: Final[tuple[Floats, ...]]
    frames: Final[DamFrames]
    summaries: Final[tuple[DamSummary, ...]]
    all_frames: Final[tuple[DamFrames, ...]]
    upper: Final[tuple[Floats, ...]]
    lower: Final[tuple[Floats, ...]]
    force: Final[tuple[Floats, ...]]
    status: Final[NDArray[np.uint8]]
    damage: Final[Floats]
    modes: Final[tuple[Floats, ...]]
    water: Final[Floats]
    extremes: Final[tuple[StressExtremes, ...]]
    pressures: Final[StressExtremes]
    worked: Final[WornContacts]
    crest: Final[Floats]
    crest_cross: Final[Floats]

    @property
    def outcome(self) -> str: ...
    @property
    def final_state(self) -> str: ...

@final
class AtRest:
    """An elastic dam before the earthquake, its cracks let go; k nodes on cracks, m modes.

    Attributes
    ----------
    slips
        Of each crack since it was bonded [m].
    open_contacts
        How many of the watched nodes of each are open.
    modes
        (m,) amplitudes of each part, from the crest down.
    forces
        (2, k) forces on the nodes of the upper face of each crack, along and across it [N].
    """

    slips: Final[tuple[float, ...]]
    open_contacts: Final[tuple[int, ...]]
    modes: Final[tuple[Floats, ...]]
    forces: Final[tuple[Floats, ...]]

@final
class CrackedDam:
    """Elastic parts with frictional cracks between them; immutable, so that many runs may share one.

    Parameters
    ----------
    parts
        From the crest down; elastic rock is the last one.
    cracks
        From the crest down, below each part; below the last one there is a crack on a rigid plane or none. The penalty
        method knows one crack in which nothing but contact acts.
    contactors
        Which nodes are watched, 1 to 5.
    reservoir
        Water with sound, tied to the parts by their rows `wet`; the penalty method knows none.
    asked
        Which crack is told of first.
    """

    def __init__(
        self,
        parts: Sequence[ReducedBody],
        cracks: Sequence[CrackLine],
        contactors: int,
        reservoir: Reservoir | None = None,
        *,
        asked: int = 0,
    ) -> None: ...
    def under(self, rising: Sequence[RisingWater]) -> CrackedDam:
        """Return the same dam with water that changes in its runs; springs know none."""

    def crossed(self, parts: Sequence[ReducedBody], gap: tuple[float, float]) -> CrackedDam:
        """Return the same dam with its parts across the valley, whose shapes (m, k) and positions (k,) have one
        component for each crack node, and how far it may slip to the left and to the right bank until a neighbour stops
        it [m]."""

    def still(self) -> AtRest | None:
        """Return the state before the earthquake with the crack let go; None where friction does not hold the dam."""

    def unrest(self) -> str | None:
        """Return why there is no such state: "not sought" where a part starts off the plane below it, "moves away"
        where nothing holds a part, "not found" where the search ended before; None where there is one."""

    def run(
        self,
        ground: Floats,
        step: float,
        theta: float,
        *,
        stride: int = 0,
        stresses: StressRows | None = None,
        pressures: StressRows | None = None,
        crest: Floats | None = None,
        penalty: tuple[float, float, float] | None = None,
        ending: Ending | None = None,
        until_rest: tuple[int, int, float, float] | None = None,
        across: Floats | None = None,
        crest_across: Floats | None = None,
    ) -> DamRun:
        """Shake it, with exact contact or with springs at the contacts.

        Parameters
        ----------
        ground
            (n, 2) mean horizontal and vertical acceleration of each step [m/s2]; for springs that at both ends of all
            steps, (n + 1, 2).
        step
            Time step [s].
        theta
            Weight of the new state within a step, 0.5 to 1; springs know none.
        stride
            Steps from frame to frame; 0 for no frames.
        stresses
            Those whose extremes are wanted.
        pressures
            The same of water with sound, one part: the pressure p as the stresses p, p and 0 by the velocities of its
            modes.
        crest
            (m,) how far each mode of the first part moves the point of it whose way is wanted.
        penalty
            Stiffness of the springs [N/m] and Newmark's gamma and beta.
        ending
            What may end the run from another thread.
        until_rest
            After how many steps the run looks for the first time whether the dam is at rest, every how many steps it
            does from then on, over which last seconds, and how far [m] slip and openings change less in them: there it
            ends. It needs frames.
        across
            (n,) mean acceleration to the left bank of each step [m/s2], of a dam that has its parts that way; springs
            know none.
        crest_across
            As `crest`, of the first of these parts.
        """

    def run_many(
        self,
        ground: Floats,
        step: float,
        theta: float,
        scales: Floats,
        *,
        threads: int = 0,
        penalty: tuple[float, float, float] | None = None,
        ending: Ending | None = None,
        across: Floats | None = None,
    ) -> tuple[dict[str, Floats], ...]:
        """Shake it once for each pair of factors, (n, 2), on `threads` cores (0 for all); the numbers of each crack,
        (n,) by the names of :class:`DamSummary`. The first factor of a pair is that across the valley, too."""

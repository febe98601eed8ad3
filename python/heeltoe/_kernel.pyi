"""Types of the compiled kernels. SI units, per metre of dam."""

from collections.abc import Sequence
from typing import Final, Protocol

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
HISTORY_FIELDS: Final[list[str]]
EVENT_FIELDS: Final[list[str]]
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
) -> tuple[Floats, Floats, NDArray[np.uint8], Floats]:
    """Run one block through one motion.

    Parameters
    ----------
    block
        (21,) numbers in the order of ``BLOCK_FIELDS``.
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

    Returns
    -------
    summary, histories, modes, events
        (len(SUMMARY_FIELDS),); (k', len(HISTORY_FIELDS)) and (k',), where k' < k if the run stopped early;
        (m, len(EVENT_FIELDS)).
    """

_Walked = tuple[Floats, Floats, NDArray[np.uint8], Floats]

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
) -> tuple[_Walked, _Walked, Floats, Floats]:
    """Run two blocks, one on the other, exactly from event to event.

    Parameters
    ----------
    lower, upper
        (21,) numbers in the order of ``BLOCK_FIELDS``: of all above the lower crack as one block, and of what is above
        the upper one.
    place
        (3,) numbers in the order of ``PLACE_FIELDS``.
    time, horizontal, vertical, output_times, settle, event_limit, jam
        As of :func:`run_rigid`.

    Returns
    -------
    tuple
        For the lower and for the upper crack what :func:`run_rigid` returns; (2, 2) least and largest rotation of both
        blocks; (2, 2) energy lost to friction and to impacts in both cracks.
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
) -> tuple[
    Floats,
    Floats,
    NDArray[np.uint8],
    Floats,
    Floats,
    tuple[Floats, float, bool, float, float] | None,
    tuple[Floats, list[float], float] | None,
]:
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
        (n, 6) distance from the heel [m], axis along and across, prestress [N/m], axial and shear stiffness [N/m2].
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

    Returns
    -------
    summary, histories, modes, events, tension
        As of :func:`run_rigid`, and the largest tension (n,) of each anchor [N/m].
    worn
        With a law: (k, 2) path slipped [m] and 1 while the bond is whole, both at the end, error of the steps [m].
    rough
        With asperities: (k, 3) dilation [m], angle [rad] and plastic work [J/m2], the same at the end, and the largest
        dilation in contact [m].
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
) -> Floats:
    """Run (n, 21) blocks, each through the motion ``motion_of`` names with the accelerations times ``scales`` (n, 2).

    ``threads`` of 0 means all cores. Returns (n, len(SUMMARY_FIELDS)), the same bits for any number of threads.
    """

def spectrum(time: Floats, ground: Floats, periods: Floats, damping: float) -> Floats:
    """Return (k, 2): largest relative displacement [m] and total acceleration [m/s2] of oscillators.

    ``periods`` (k,) in s, zero for the ground itself; ``damping`` in [0, 1). Exact for ground accelerations (n,) that
    are linear between the moments ``time`` (n,).
    """

CRACK_SUMMARY_FIELDS: Final[list[str]]
FRAME_FIELDS: Final[list[str]]
EXTREME_FIELDS: Final[list[str]]
WORKED_FIELDS: Final[list[str]]
CRACK_OUTCOMES: Final[list[str]]
CRACK_STATES: Final[list[str]]
CONTACT_STATUSES: Final[list[str]]

class ReducedBody(Protocol):
    """An elastic body: m modes, k nodes on the crack; see :class:`heeltoe.models.flexible.reduced.ReducedBody`."""

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

class FollowingWater(Protocol):
    """Water in the crack; see :class:`heeltoe.models.flexible.inside.FollowingWater`."""

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
    def span(self) -> tuple[float, float]: ...
    @property
    def change(self) -> Sequence[Floats]: ...

class CrackAnchor(Protocol):
    """An anchor; see :class:`heeltoe.models.flexible.inside.CrackAnchor`."""

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

class StressRows(Protocol):
    """Stresses by the modes; see :class:`heeltoe.models.flexible.stress.places.StressRows`."""

    @property
    def bodies(self) -> Sequence[Floats]: ...
    @property
    def stride(self) -> int: ...

class CrackedDam:
    """Elastic parts with frictional cracks between them; immutable, so that many runs may share one.

    Parameters
    ----------
    upper, lower
        The parts; without a lower one the only crack is on a rigid plane. Of several cracks `upper` has the first,
        third, ... part from the crest down side by side, and `lower` the others.
    cracks
        From the crest down.
    contactors
        Which nodes are watched, 1 to 5.
    water
        Where its pressure follows the opening.
    anchors
        Those with stiffness. Neither goes with the penalty method, nor do they or that go with several cracks.
    """

    def __init__(
        self,
        upper: ReducedBody,
        lower: ReducedBody | None,
        cracks: Sequence[CrackLine],
        contactors: int,
        water: FollowingWater | None = None,
        anchors: Sequence[CrackAnchor] = (),
    ) -> None: ...
    def still(self) -> tuple[list[float], list[int], Floats, Floats, Floats, Floats] | None:
        """Return the state before the earthquake with the crack let go; None where friction does not hold the dam.

        Returns
        -------
        slip, open contacts, amplitudes of the upper and of the lower part, forces on both
            Slip of each crack since it was bonded [m]; forces on the nodes of cracks, all along them, then all across
            them [N].
        """
    def run(
        self,
        ground: Floats,
        dt: float,
        theta: float,
        stride: int,
        keep_modes: bool,
        stresses: StressRows | None = None,
        penalty: tuple[float, float, float] | None = None,
        ending: Ending | None = None,
        rising: Sequence[RisingWater] = (),
    ) -> tuple[Floats, Floats, Floats, Floats, Floats, NDArray[np.uint8], Floats, Floats, Floats, Floats]:
        """Shake it, with exact contact or with springs at the contacts.

        Parameters
        ----------
        ground
            (n, 2) mean horizontal and vertical acceleration of each step [m/s2].
        dt
            Step [s].
        theta
            Weight of the new state within a step, 0.5 to 1.
        stride
            Steps from frame to frame; 0 for no frames.
        keep_modes
            Whether frames keep the amplitudes of all modes.
        stresses
            Those whose extremes are wanted.
        penalty
            Stiffness of the springs [N/m] and Newmark's gamma and beta, for the penalty method; `ground` then has the
            accelerations at both ends of all steps, (n + 1, 2), and theta plays no part.
        ending
            What may end it.
        rising
            Water that changes meanwhile, in the only crack; the penalty method knows none.

        Returns
        -------
        summary, frames, upper, lower, force, status, modes of the upper and the lower part, extremes of both, worked
            For each crack ``CRACK_SUMMARY_FIELDS`` and the largest tension [N] of each anchor; for each crack of each
            frame ``FRAME_FIELDS``. Then tables with one row for each frame: positions of the crack nodes of either
            part (all along their cracks, then all across them) [m], mean forces on those of the upper part, and with
            several cracks of the lower one, since the frame before [N], statuses of the watched nodes, amplitudes.
            Extremes are tables of ``EXTREME_FIELDS`` with one row for each place. `worked` has ``WORKED_FIELDS`` of
            each watched node of a crack with a law.
        """

    def run_many(
        self,
        ground: Floats,
        dt: float,
        theta: float,
        scales: Sequence[tuple[float, float]],
        threads: int,
        penalty: tuple[float, float, float] | None = None,
        ending: Ending | None = None,
        rising: Sequence[RisingWater] = (),
    ) -> Floats:
        """Shake it once for each pair of factors, on `threads` cores (0 for all); rows of summaries, crack by crack."""

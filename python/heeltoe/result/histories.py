"""Histories and events of a crack: one row a column, with its unit and what it means."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Number, ending_of
from heeltoe.base.frozen import FrozenDict


class Columns(FrozenDict):
    """Columns of equal length by their names, each an attribute, too."""

    __slots__ = ()

    # The type checker knows the columns below by their names.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_") or name not in self:
                raise AttributeError(f"there is no column {name!r}")
            return self[name]


class Histories(Columns):
    """Columns of the histories, of a block and of an elastic dam."""

    time_s: Annotated[Floats, Number("The moment.", "s")]
    ground_acceleration_m_s2: Annotated[Floats, Number("Acceleration of the ground, positive downstream.", "m/s²")]
    vertical_ground_acceleration_m_s2: Annotated[Floats, Number("The same upwards.", "m/s²")]
    cross_ground_acceleration_m_s2: Annotated[
        Floats, Number("Acceleration of the ground across the valley, positive to the left bank.", "m/s²")
    ]
    ground_rotation_rad_s2: Annotated[
        Floats, Number("Angular acceleration of the ground under a block, where it turns.", "rad/s²")
    ]
    crack_acceleration_m_s2: Annotated[
        Floats, Number("Acceleration of the crack under the block of the chain, positive downstream.", "m/s²")
    ]
    vertical_crack_acceleration_m_s2: Annotated[Floats, Number("The same upwards.", "m/s²")]
    crack_rotation_acceleration_rad_s2: Annotated[
        Floats, Number("Angular acceleration of that crack, positive counter-clockwise.", "rad/s²")
    ]
    slip_m: Annotated[Floats, Number("Slip of the part above the crack, positive downstream.", "m")]
    slip_velocity_m_s: Annotated[Floats, Number("Its velocity.", "m/s")]
    slip_acceleration_m_s2: Annotated[Floats, Number("Its acceleration.", "m/s²")]
    slip_cross_m: Annotated[Floats, Number("Slip across the valley, positive to the left bank.", "m")]
    slip_cross_velocity_m_s: Annotated[Floats, Number("Velocity of that slip.", "m/s")]
    friction_cross_n: Annotated[
        Floats,
        Number(
            "Force across the valley on the part above the crack: friction, and on an elastic one the push of "
            "neighbours.",
            "N per metre of dam",
        ),
    ]
    gap_heel_m: Annotated[Floats, Number("Opening of the crack at the upstream face.", "m")]
    gap_toe_m: Annotated[Floats, Number("Opening of the crack at the downstream face.", "m")]
    rotation_rad: Annotated[Floats, Number("Rotation, positive counter-clockwise: upstream, about the heel.", "rad")]
    rotation_velocity_rad_s: Annotated[Floats, Number("Its velocity.", "rad/s")]
    crest_displacement_m: Annotated[
        Floats,
        Number(
            "Horizontal displacement of the crest's upstream edge from its first place, relative to the ground, "
            "positive downstream.",
            "m",
        ),
    ]
    crest_cross_m: Annotated[
        Floats,
        Number("Displacement of the crest across the valley relative to the ground, positive to the left bank.", "m"),
    ]
    crest_acceleration_m_s2: Annotated[
        Floats, Number("Its horizontal acceleration with that of the ground, the mean over two steps.", "m/s²")
    ]
    friction_strength_n: Annotated[
        Floats,
        Number("Friction that a crack with a law could bear at the moment, per metre of dam.", "N per metre of dam"),
    ]
    dilation_m: Annotated[
        Floats,
        Number(
            "How high the flank of a rough crack is under the block, over the valley in which it stood at first.", "m"
        ),
    ]
    asperity_angle_rad: Annotated[Floats, Number("Angle of the worn flanks of a rough crack.", "rad")]
    plastic_work_j_m2: Annotated[
        Floats, Number("Work of friction on the asperities of a rough crack, per area.", "J/m²")
    ]
    cracked_upstream_m: Annotated[Floats, Number("Length that a joint has cracked from the upstream face.", "m")]
    cracked_downstream_m: Annotated[Floats, Number("Length that a joint has cracked from the downstream face.", "m")]
    cracked_length_m: Annotated[Floats, Number("Length of a joint that has cracked in all.", "m")]
    softening_length_m: Annotated[
        Floats, Number("Length of a joint that has begun to crack and still holds in part.", "m")
    ]
    fracture_energy_j: Annotated[
        Floats, Number("Energy that the bond of a joint has taken up to here.", "J per metre of dam")
    ]
    slip_path_m: Annotated[Floats, Number("How far a crack with a friction law has slipped, to and fro.", "m")]
    friction_force_n: Annotated[
        Floats, Number("Friction on the part above, positive downstream, per metre of dam.", "N per metre of dam")
    ]
    normal_force_heel_n: Annotated[Floats, Number("Force across the crack at the heel.", "N per metre of dam")]
    normal_force_toe_n: Annotated[Floats, Number("Force across the crack at the toe.", "N per metre of dam")]
    normal_force_n: Annotated[Floats, Number("Force across the whole crack.", "N per metre of dam")]
    touching: Annotated[Floats, Number("Number of contacts along the crack that touch.")]
    stored_energy_j: Annotated[Floats, Number("Kinetic and strain energy.", "J per metre of dam")]
    input_energy_j: Annotated[Floats, Number("Work of the earthquake and the loads up to here.", "J per metre of dam")]
    damping_energy_j: Annotated[Floats, Number("Lost in the concrete's damping up to here.", "J per metre of dam")]
    friction_energy_j: Annotated[Floats, Number("Lost in friction up to here.", "J per metre of dam")]
    impact_energy_j: Annotated[Floats, Number("Lost in impacts up to here.", "J per metre of dam")]
    mode: Annotated[tuple[str, ...], Number("Mode of motion: rest, sliding, rocking, slide-rocking, drifting.")]


#: Columns that others draw, limit or compare: of the crack, of the ground, and of the crack below a block of the chain.
SLIP, ROTATION = "slip_m", "rotation_rad"
GROUND, GROUND_UP = "ground_acceleration_m_s2", "vertical_ground_acceleration_m_s2"
AT_CRACK, AT_CRACK_UP = "crack_acceleration_m_s2", "vertical_crack_acceleration_m_s2"
#: Columns of the openings, at the upstream face before the downstream one.
GAPS = tuple(name for name in Histories.__annotations__ if name.startswith("gap_"))


class EventLog(Columns):
    """Columns of the events of a block."""

    time_s: Annotated[Floats, Number("Moment of the event.", "s")]
    kind: Annotated[tuple[str, ...], Number("Kind of event.")]
    mode_before: Annotated[tuple[str, ...], Number("Mode of motion until then.")]
    mode_after: Annotated[tuple[str, ...], Number("Mode of motion from then on.")]
    slip_m: Annotated[Floats, Number("Slip, positive downstream.", "m")]
    gap_heel_m: Annotated[Floats, Number("Gap at the heel.", "m")]
    gap_toe_m: Annotated[Floats, Number("Gap at the toe.", "m")]
    slip_velocity_m_s: Annotated[Floats, Number("Slip velocity after the event.", "m/s")]
    gap_velocity_heel_m_s: Annotated[Floats, Number("Velocity of the gap at the heel after the event.", "m/s")]
    gap_velocity_toe_m_s: Annotated[Floats, Number("Velocity of the gap at the toe after the event.", "m/s")]
    approach_slip_velocity_m_s: Annotated[Floats, Number("Slip velocity before a blow.", "m/s")]
    approach_velocity_heel_m_s: Annotated[Floats, Number("Velocity of the gap at the heel before a blow.", "m/s")]
    approach_velocity_toe_m_s: Annotated[Floats, Number("Velocity of the gap at the toe before a blow.", "m/s")]
    friction_impulse_n_s: Annotated[Floats, Number("Impulse of friction of a blow.", "N s per metre of dam")]
    heel_impulse_n_s: Annotated[Floats, Number("Impulse at the heel.", "N s per metre of dam")]
    toe_impulse_n_s: Annotated[Floats, Number("Impulse at the toe.", "N s per metre of dam")]
    energy_lost_j: Annotated[Floats, Number("Energy lost in the event.", "J per metre of dam")]


def computed_columns(kind: type[Columns], table: object) -> dict[str, Any]:
    """Return the columns that a table of a kernel has: it has their names without units."""
    own = {name: name.removesuffix(ending_of(number.unit)) for name, number in columns_of(kind).items()}
    return {name: getattr(table, bare) for name, bare in own.items() if hasattr(table, bare)}


@cache
def columns_of(kind: type[Columns]) -> Mapping[str, Number]:
    """Return what the columns of a table mean, by their names."""
    return {name: hint.__metadata__[0] for name, hint in get_type_hints(kind, include_extras=True).items()}

"""The scene of an animation: what is drawn at every moment, whatever draws it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.at_crack import anchor_line
from heeltoe.case.dam import Anchor, Water
from heeltoe.case.model import Case
from heeltoe.errors.sanitize import plain
from heeltoe.geometry.section import CutSection
from heeltoe.models.flexible.result.history import LEAST_DAMAGE, CrackHistory, node_lengths
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.result.histories import AT_CRACK, GAPS, GROUND, GROUND_UP, SLIP, Histories
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from heeltoe.units.systems import Units, unit_system
from heeltoe.views.animation.bodies import Moments, Part, elastic_parts, rigid_parts

#: What a point of the crack does, as `Scene.status` counts it; -1 where nothing is known or opposite.
STATUSES = ("open", "stick", "slip downstream", "slip upstream")
#: What a node of a bonded joint is before it is broken, counted after them.
BONDED = ("intact", "softening")
#: The largest displacement is drawn at most this long, as a part of the dam's height and of the crack's width.
_OF_HEIGHT, _OF_CRACK = 0.08, 0.35
#: A part above the crack lower than this part of the dam's height is shown in a picture of its own, too.
_SMALL = 0.45
#: How long an arrow of `Scene.force_scale` is, as a part of the height of the picture of the crack.
ARROW = 0.1
#: Longer arrows are cut at so many times that.
CUT = 2.5
#: Openings below a hundredth of a millimetre are not worth a trace.
_NO_OPENING = 1e-5


@dataclass(frozen=True, eq=False)
class Trace:
    """A history beside the picture.

    Attributes
    ----------
    role
        "ground", "vertical", "crack" (what shakes it), "slip", "heel" or "toe".
    chart, label
        Name of the chart, which it may share; what tells it apart there, empty where it is alone.
    unit, values
        By the samples of the response.
    """

    role: str
    chart: str
    label: str
    unit: str
    values: Floats


@dataclass(frozen=True)
class AnchorLine:
    """An anchor: its foot, which stays, and its head (x, z) [m], which moves with a point of a part.

    Attributes
    ----------
    foot, head
        Where they are before the earthquake.
    part, point
        Which point of which of `Scene.parts` is nearest to the head.
    """

    foot: tuple[float, float]
    head: tuple[float, float]
    part: int
    point: int

    def drawn(self, points: Sequence[Floats], rest: Sequence[Floats]) -> Floats:
        """Return foot and head (2, 2) where the points of the parts are drawn so, and rest so."""
        moved = points[self.part][self.point] - rest[self.part][self.point]
        return np.array([self.foot, np.array(self.head) + moved])


@dataclass(frozen=True, eq=False)
class Scene:
    """All that an animation shows.

    Attributes
    ----------
    title, subtitle
        Of the case; the motion, its peak, the model, and the outcome where it is not ok.
    times
        (f,) moments [s].
    exaggeration
        How many times as far as they are all displacements are drawn.
    relative_to
        To what displacements are relative.
    parts
        The part above the crack and, if there is one, the part below.
    forces
        (f, k, 2) forces (x, z) from below on the points of the upper part's crack.
    force_unit, force_scale
        Unit of the forces, and the force whose arrow has the length :data:`ARROW`.
    status
        (f, k) what the points of the crack do, counting `statuses`.
    statuses
        :data:`STATUSES`, and of a bonded joint :data:`BONDED` after them.
    mode, modes
        (f,) the mode of motion, counting `modes`, as the response names them.
    history_times
        (h,) samples of the traces and of `history_mode` [s].
    history_mode
        (h,) the mode at these.
    traces
        What shakes the dam, the ground first; slip, openings.
    anchors
        Those that cross the crack.
    base, water, tailwater
        z of the base, and of the surfaces of the water; None where there is none [m].
    views
        (x from, x to, z from, z to) of the pictures: of the whole dam and, if that is too small to see anything, of the
        part above the crack [m].
    """

    title: str
    subtitle: str
    times: Floats
    exaggeration: float
    relative_to: str
    parts: tuple[Part, ...]
    forces: Floats
    force_unit: str
    force_scale: float
    status: NDArray[np.int8]
    statuses: tuple[str, ...]
    mode: Integers
    modes: tuple[str, ...]
    history_times: Floats
    history_mode: Integers
    traces: tuple[Trace, ...]
    base: float
    water: float | None
    tailwater: float | None
    views: tuple[tuple[float, float, float, float], ...]
    above: int = 0
    anchors: tuple[AnchorLine, ...] = ()


def build_scene(case: Case, response: Response, times: Floats, exaggeration: float | None, units: str = "si") -> Scene:
    """Gather what an animation of a response shows at some moments [s], which are among its histories.

    Without an `exaggeration` it is chosen so that the largest displacement is drawn 3 to 8 % of the dam's height long,
    and no longer than a third of the crack: 1, 2, 5, 10, 20, ... An overturned dam is drawn as it is.
    """
    section, system = case.cut, unit_system(units)
    histories = response.histories
    moments = Moments.of(histories.time_s, times)
    statuses: tuple[str, ...] = STATUSES
    if not isinstance(response, FlexibleResponse):
        cracks = [crack.histories for crack in response.cracks] if response.several else [histories]
        parts = rigid_parts(case, cracks, moments)
        forces, status = _corners(section, histories, response.mode, moments)
        scale = system.scale("force")
    else:
        moved = Moments.of(response.crack.time, times)
        parts = elastic_parts(response.crack, moved)
        forces, status = _nodes(section, response.crack, moved)
        statuses += BONDED if response.crack.damage is not None else ()
        scale = system.scale("pressure")
    forces = scale(forces)
    above = response.asked
    if exaggeration is None:
        exaggeration = chosen_exaggeration(response, parts, section)
    modes = tuple(dict.fromkeys(response.mode))
    number = {name: place for place, name in enumerate(modes)}
    moving = [part for part in parts if len(part.shapes)]
    mode = np.array([number[name] for name in response.mode])
    within = (histories.time_s >= times[0]) & (histories.time_s <= times[-1])
    return Scene(
        title=plain(response.title) or "Untitled case",
        subtitle=_subtitle(response),
        times=times,
        exaggeration=exaggeration,
        relative_to="the part below the crack" if len(moving) == 1 < len(parts) else "the ground",
        parts=parts,
        forces=forces,
        force_unit=scale.unit,
        force_scale=_usual(forces),
        status=status,
        statuses=statuses,
        mode=mode[moments.nearest],
        modes=modes,
        history_times=histories.time_s[within],
        history_mode=mode[within],
        traces=_traces(response, within, system),
        base=section.base_elevation,
        water=water_level(section, case.reservoir),
        tailwater=water_level(section, case.tailwater),
        views=_views(case, parts[above:], exaggeration),
        above=above,
        anchors=tuple(_anchor_line(anchor, case, parts) for anchor in case.anchors),
    )


def _anchor_line(anchor: Anchor, case: Case, parts: tuple[Part, ...]) -> AnchorLine:
    """Return an anchor for the drawing; its head goes with the nearest point of the outline of a part."""
    head, foot = anchor_line(anchor, case.cut, 0.22 * (case.cut.crest_elevation - case.cut.base_elevation))
    far = [np.hypot(*(part.points[part.outline] - np.array(head)).T) for part in parts]
    place = int(np.argmin([distance.min() for distance in far]))
    point = int(parts[place].outline[int(far[place].argmin())])
    return AnchorLine((float(foot[0]), float(foot[1])), (float(head[0]), float(head[1])), place, point)


def chosen_exaggeration(response: Response, parts: tuple[Part, ...], section: CutSection) -> float:
    """Return the exaggeration that shows the motion of the parts well; an overturned dam is drawn to scale."""
    largest = max(float(np.abs(part.displacements(part.outline)).max()) for part in parts)
    return 1.0 if response.outcome == Outcome.OVERTURNED else automatic(largest, section)


def automatic(largest: float, section: CutSection) -> float:
    """Return the exaggeration that shows a largest displacement [m] well."""
    room = min(_OF_HEIGHT * (section.crest_elevation - section.base_elevation), _OF_CRACK * section.crack_width)
    return 1.0 if largest <= 0.0 else max(1.0, round_below(min(room / largest, 1e6)))


def round_below(value: float) -> float:
    """Return the largest of 1, 2, 5, 10, 20, ... (and 0.5, 0.2, ...) that is not above a value."""
    power = 10.0 ** math.floor(math.log10(value) + 1e-12)
    return next(step * power for step in (5.0, 2.0, 1.0) if step * power <= value * (1.0 + 1e-12))


def _corners(
    section: CutSection, histories: Histories, modes: tuple[str, ...], moments: Moments
) -> tuple[Floats, NDArray[np.int8]]:
    """Return forces [N/m] and status of heel and toe of a rigid block, which share the friction as the normal force."""
    at = moments.nearest
    normal = np.column_stack([histories[f"normal_force_{corner}_n"][at] for corner in ("heel", "toe")])
    whole = np.abs(normal).sum(axis=1, keepdims=True)
    share = np.abs(normal) / np.where(whole > 0.0, whole, 1.0)
    friction = share * histories.friction_force_n[at][:, None]
    forces = _turned(section, friction, normal)
    gaps = np.column_stack([histories[f"gap_{corner}_m"][at] for corner in ("heel", "toe")])
    doing = np.array([_slips(modes[sample]) for sample in at], dtype=np.int8)
    status = np.where(gaps > 1e-9 * section.crack_width, np.int8(0), doing[:, None])
    return forces, status.astype(np.int8)


def _slips(mode: str) -> int:
    """Return what a corner in contact does in a mode: "slide-rock on toe upstream" slips upstream."""
    if not mode.startswith("slid"):
        return STATUSES.index("stick")
    return STATUSES.index("slip upstream" if mode.endswith("upstream") else "slip downstream")


def _nodes(section: CutSection, history: CrackHistory, moments: Moments) -> tuple[Floats, NDArray[np.int8]]:
    """Return contact stresses [Pa] and status of the nodes of the upper face."""
    points = history.drawn[0]
    force = history.forces()[moments.nearest] / node_lengths(np.hypot(*(points - points[0]).T))
    names = history.status_names()
    known = np.array([STATUSES.index(name) if name in STATUSES else -1 for name in names] + [-1], dtype=np.int8)
    # -1, of nodes that are not watched, finds the last.
    status = known[history.node_status()[0][moments.nearest]]
    if history.damage is not None:
        damage = history.node_damage()[0][moments.nearest]
        bonded = np.where(damage > LEAST_DAMAGE, len(STATUSES) + 1, len(STATUSES))
        status = np.where(damage < 1.0, bonded, status).astype(np.int8)
    return _turned(section, force[:, 0], force[:, 1]), status


def _turned(section: CutSection, along: Floats, across: Floats) -> Floats:
    """Return vectors (..., 2) along x and z by their components along and across the crack."""
    down, up = np.array(section.from_crack_frame(1.0, 0.0)), np.array(section.from_crack_frame(0.0, 1.0))
    offsets: Floats = along[..., None] * down + across[..., None] * up
    return offsets


def _usual(forces: Floats) -> float:
    """Return a round force that half of the moments reach, so that blows do not make the usual arrows vanish."""
    usual = float(np.median(np.hypot(forces[..., 0], forces[..., 1]).max(axis=1)))
    return round_below(usual) if usual > 0.0 else 1.0


def shaken_sign(response: Response) -> str:
    """Say which way round the motion shakes the dam that is shown."""
    worse = ", the worse of both signs" if len(response.signs) > 1 else ""
    return f"the motion {_sign(response)}{worse}"


def _sign(response: Response) -> str:
    governing = next((sign.sign for sign in response.signs if sign.governs), None)
    turned = governing == "reversed" if governing else "sign reversed" in response.motion.processing
    return "reversed" if turned else "as written" if response.motion.format == "points" else "as recorded"


def _subtitle(response: Response) -> str:
    peak = response.motion.pga / response.gravity
    ending = "" if response.outcome == Outcome.OK else f"; {response.outcome}"
    shaken = ", in which the motion of the crack shakes the part above" if response.model == "decoupled" else ""
    curves = "; curves of the crack that leads" if response.several else ""
    motion = f"{plain(response.motion.name)} {_sign(response)}"
    return f"{motion}, peak {peak:.3g} g; {response.model} model{shaken}{ending}{curves}"


def _traces(response: Response, within: NDArray[np.bool_], units: Units) -> tuple[Trace, ...]:
    histories = response.histories

    def accelerations(chart: str, *named: tuple[str, str, str]) -> tuple[Trace, ...]:
        return tuple(
            Trace(role, chart, label, "g", histories[key][within] / response.gravity) for role, label, key in named
        )

    def metres(chart: str, *named: tuple[str, str, str]) -> tuple[Trace, ...]:
        """Return lengths in one unit that gives them readable numbers."""
        values = [histories[key][within] for *_, key in named]
        largest = max(float(np.abs(column).max()) for column in values)
        scale = units.scale("displacement", largest)
        return tuple(
            Trace(role, chart, label, scale.unit, scale(column))
            for (role, label, _), column in zip(named, values, strict=True)
        )

    if AT_CRACK in histories:
        shaken = accelerations("acceleration", ("ground", "ground", GROUND), ("crack", "crack", AT_CRACK))
    elif GROUND_UP in histories:
        ways = (("ground", "horizontal", GROUND), ("vertical", "vertical", GROUND_UP))
        shaken = accelerations("ground acceleration", *ways)
    else:
        shaken = accelerations("ground acceleration", ("ground", "", GROUND))
    shaken += metres("slip", ("slip", "", SLIP))
    if max(float(histories[key][within].max()) for key in GAPS) > _NO_OPENING:
        shaken += metres("opening", *((end, end, key) for end, key in zip(("heel", "toe"), GAPS, strict=True)))
    return shaken


def water_level(section: CutSection, water: Water | None) -> float | None:
    """Return the z of the surface of water; None where there is none."""
    return None if water is None else section.base_elevation + water.depth


def _views(case: Case, parts: tuple[Part, ...], exaggeration: float) -> tuple[tuple[float, float, float, float], ...]:
    section, upper = case.cut, parts[0]
    drawn = upper.points[upper.outline] + exaggeration * upper.displacements(upper.outline)
    low = np.minimum(drawn.min(axis=(0, 1)), upper.points.min(axis=0))
    high = np.maximum(drawn.max(axis=(0, 1)), upper.points.max(axis=0))
    points = np.vstack([part.points for part in parts])
    left, right = min(points[:, 0].min(), low[0]), max(points[:, 0].max(), high[0])
    base, height = section.base_elevation, section.crest_elevation - section.base_elevation
    # Water above the crest is seen, its surface too.
    levels = [water_level(section, water) for water in (case.reservoir, case.tailwater)]
    high[1] = max(high[1], *(level for level in levels if level is not None), high[1])
    top = max(section.crest_elevation, high[1])
    near_crack = section.height <= _SMALL * height
    # Below a crack that has no picture of its own there must be room for its forces.
    bottom = min(base - 0.14 * height, section.heel[1] - (0.0 if near_crack else 0.2 * height), low[1])
    whole = (float(left - 0.35 * height), float(right + 0.12 * height), float(bottom), float(top + 0.05 * height))
    if not near_crack:
        return (whole,)
    size = max(section.height, section.crack_width)
    sides = (float(low[0] - 0.3 * size), float(high[0] + 0.3 * size))
    return whole, (*sides, float(section.heel[1] - 0.45 * size), float(high[1] + 0.12 * size))

"""Warnings of allowed but unlikely values in a case."""

from __future__ import annotations

import math
from collections.abc import Iterator

import shapely

from heeltoe.case.at_crack import anchor_line, crosses, drains
from heeltoe.case.model import Case
from heeltoe.case.plausible import PLAUSIBLE
from heeltoe.case.section_drawing import TOLERANCE
from heeltoe.errors.error import shown
from heeltoe.geometry.crossing import on_face
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

# What is so near a face, as a part of the height of the dam, is on it.
_ON_FACE = 1e-3
# Steeper flanks [rad] and higher asperities, as a part of the width of the crack, than a block climbs.
_STEEPEST_FLANK = math.radians(45.0)
_TALL = 0.03
_NO_PRESSURE = "so that no water presses on the part above or in the crack"
_NO_FORCE = "so that it does not act on the part above"


def case_warnings(case: Case) -> tuple[Notice, ...]:
    """Return what is allowed in a case but seldom meant."""
    notices = list(drawing_notice(case))
    if case.crack.mu_static > 2.0:
        why = "a coefficient of friction of {friction:g} is higher than tests of concrete show"
        notices.append(unusual("crack", why, friction=case.crack.mu_static))
    if case.uplift.intensity > 1.0:
        why = "{intensity:g} means more pressure than the pattern gives"
        notices.append(unusual("uplift.intensity", why, intensity=case.uplift.intensity))
    upstream = case.reservoir.depth if case.reservoir else 0.0
    if case.reservoir and 0.0 < upstream <= case.crack.elevation:
        notices.append(Notice("below-crack", field="reservoir", ends="ends", effect=_NO_PRESSURE))
    over = upstream - (case.cut.crest_elevation - case.cut.base_elevation)
    if case.reservoir and over > 0.0:
        notices.append(Notice("water-over-crest", over_m=over, nappe=case.reservoir.nappe))
    if case.ice and upstream - case.ice.depth < case.crack.elevation:
        notices.append(Notice("below-crack", field="ice", ends="acts", effect=_NO_FORCE))
    if case.silt and case.silt.depth <= case.crack.elevation:
        notices.append(Notice("below-crack", field="silt", ends="ends", effect=_NO_FORCE))
    if case.silt and case.silt.depth > upstream:
        why = "the silt is higher than the water, though its densities are of silt under water"
        notices.append(unusual("silt.depth", why))
    if case.silt and (case.silt.horizontal_density > 1000.0 or case.silt.vertical_density > 1300.0):
        why = "{densities_kg_m3:g kg/m^3} seem to include the water, which is counted separately"
        densities = (case.silt.horizontal_density, case.silt.vertical_density)
        notices.append(unusual("silt", why, densities_kg_m3=densities))
    toe = case.cut.toe[1] - case.cut.base_elevation
    if case.tailwater and 0.0 < case.tailwater.depth <= toe:
        notices.append(Notice("below-crack", field="tailwater", ends="ends", effect=_NO_PRESSURE))
    if case.tailwater and case.tailwater.depth > upstream:
        notices.append(Notice("tailwater-deeper"))
    return (*notices, *_about_the_anchors(case), *_about_the_asperities(case), *_implausible(case))


def unusual(field: str, why: str, **quantities: object) -> Notice:
    """Return the warning that a value is allowed and seldom meant; `why` is a template of the quantities."""
    return Notice("value-unusual", field=field, value=Sentence.of(why, **quantities))


def _implausible(case: Case) -> Iterator[Notice]:
    """Walk the numbers that are outside of their range."""
    peak = case.motion.pga if case.motion else None
    values = {
        "gravity": case.gravity,
        "section.height": case.cut.crest_elevation - case.cut.base_elevation if case.reservoir else None,
        "concrete.density": case.concrete.density,
        "concrete.modulus": case.concrete.modulus,
        "concrete.damping": case.concrete.damping,
        "reservoir.density": case.reservoir.density if case.reservoir else None,
        "tailwater.density": case.tailwater.density if case.tailwater else None,
        "motion.pga": None if peak is None else peak.si(case.gravity) / STANDARD_GRAVITY,
    }
    for path, (low, high, _, sentence, quantity) in PLAUSIBLE.items():
        value = values[path]
        if value is not None and not low <= value <= high:
            yield unusual(path, sentence, **{quantity: value})


def drawing_notice(case: Case) -> Iterator[Notice]:
    """Yield which outline of a drawing is the dam, if it is drawn."""
    if case.section.layer is None:
        return
    left, base, right, crest = case.outline.bounds
    near = TOLERANCE * max(right - left, crest - base)
    at_base = [x for x, z in case.section.vertices() if z <= base + near]
    yield Notice(
        "section-drawn",
        layer=shown(case.section.layer),
        height_m=crest - base,
        base_m=max(at_base) - min(at_base),
        area_m2=float(case.outline.area),
        within_m=near,
    )


def drawing_text(case: Case) -> str:
    """Return which outline of a drawing is the dam, in SI units; empty where it is not drawn."""
    return "".join(notice.text() for notice in drawing_notice(case))


def _about_the_asperities(case: Case) -> Iterator[Notice]:
    """Walk what is out of the range in which a crack is a sawtooth that a block climbs."""
    rough, width = case.crack.roughness, case.cut.crack_width
    if rough is None:
        return
    if rough.angle > _STEEPEST_FLANK:
        why = "flanks of {angle_deg:.3g} degrees shear off rather than being climbed; no model here represents that"
        yield unusual("crack.roughness", why, angle_deg=math.degrees(rough.angle))
    if rough.asperity_height > _TALL * width:
        why = (
            "asperities of {height_m:.3g m} are {share:.2g %} of the crack's width, {width_m:.4g m}; the geometry of "
            "the block leaves them out"
        )
        height = rough.asperity_height
        yield unusual("crack.roughness.asperity_height", why, height_m=height, share=height / width, width_m=width)
    if rough.wave_length > width:
        why = "{wave_m:.3g m} is more than the crack is wide, {width_m:.4g m}: heel and toe stand on unlike flanks"
        yield unusual("crack.roughness.wave_length", why, wave_m=rough.wave_length, width_m=width)


def _about_the_anchors(case: Case) -> Iterator[Notice]:
    """Walk the notices on the places of anchors and drains."""
    section, whole = case.cut, case.outline
    inside = case.uplift.drain_x is None or drains(case.uplift.drain_x, section)[0]
    at = case.uplift_at_crack
    if not inside:
        yield Notice("off-the-dam", "drains", field="uplift.drain_x")
    elif at.pattern == "drained" and (at.drain_efficiency or 0.0) < (at.drain_position or 0.0):
        why = (
            "with {efficiency:g} the head at the drains is higher than without drains: drains without effect are "
            'uplift.pattern = "triangular"'
        )
        yield unusual("uplift.drain_efficiency", why, efficiency=at.drain_efficiency)
    near = _ON_FACE * (section.crest_elevation - section.base_elevation)
    faces = {
        "upstream": (section.upstream_face, case.reservoir),
        "downstream": (section.downstream_face, case.tailwater),
    }
    for place, anchor in enumerate(case.anchors):
        field, number = f"anchors[{place}]", place + 1
        crossings = [crosses(anchor, alone.cut) for alone in case.single_crack_cases]
        if all(crossing is not None and not crossing.crossed for crossing in crossings):
            yield Notice("off-the-dam", "anchor", field=field, number=number)
            continue
        head, _ = anchor_line(anchor, section, 0.0)
        away = float(shapely.distance(whole, shapely.Point(head)))
        if away > near:
            yield Notice("off-the-dam", "anchor-head", field=field, number=number, distance_m=away)
        for side, (face, water) in faces.items():
            below = section.base_elevation + water.depth - head[1] if water else 0.0
            if below > near and on_face(face, head, near):
                up = head[1] - section.base_elevation
                yield Notice("anchor-head-wet", field=field, number=number, side=side, depth_m=below, elevation_m=up)


def rock_warnings(case: Case) -> tuple[Notice, ...]:
    """Return which rock is assumed below an elastic dam, for results whose verdict does not say it."""
    rock = case.foundation
    return (Notice("rock-assumed", modulus_pa=rock.modulus),) if rock and case.surroundings.assumed else ()


def concrete_warnings(case: Case) -> tuple[Notice, ...]:
    """Return what elastic concrete seldom is; models of a rigid dam do not ask."""
    poisson = case.concrete.poisson
    return (
        (unusual("concrete.poisson", "{poisson:g} is unusual for concrete", poisson=poisson),) if poisson > 0.35 else ()
    )

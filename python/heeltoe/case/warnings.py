"""What is allowed in a case but seldom meant."""

from __future__ import annotations

from heeltoe.case.model import Case
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.warnings import Notice


def case_warnings(case: Case) -> tuple[Notice, ...]:
    """Return what is allowed in a case but seldom meant."""
    said = []
    if case.crack.mu_static > 2.0:
        said.append(Notice("friction-high", friction=case.crack.mu_static))
    if case.uplift.intensity > 1.0:
        said.append(Notice("uplift-intensity", intensity=case.uplift.intensity))
    if not 9.7 <= case.gravity <= 10.0:
        said.append(Notice("gravity-unusual", gravity_m_s2=case.gravity, earth_m_s2=STANDARD_GRAVITY))
    for side, water in (("reservoir", case.reservoir), ("tailwater", case.tailwater)):
        # From fresh water to a flood full of silt.
        if water and not 950.0 <= water.density <= 1300.0:
            said.append(Notice("water-density-unusual", field=f"{side}.density", density_kg_m3=water.density))
    if not 1800.0 <= case.concrete.density <= 3200.0:
        said.append(Notice("density-unusual", density_kg_m3=case.concrete.density))
    upstream = case.reservoir.depth if case.reservoir else 0.0
    if case.reservoir and 0.0 < upstream <= case.crack.elevation:
        said.append(Notice("reservoir-below-crack"))
    over = upstream - (case.cut.crest_elevation - case.cut.base_elevation)
    if case.reservoir and over > 0.0:
        said.append(Notice("water-over-crest", over_m=over, nappe=case.reservoir.nappe))
    if case.ice and upstream - case.ice.depth < case.crack.elevation:
        said.append(Notice("ice-below-crack"))
    if case.silt and case.silt.depth <= case.crack.elevation:
        said.append(Notice("silt-below-crack"))
    if case.silt and case.silt.depth > upstream:
        said.append(Notice("silt-above-water"))
    if case.silt and (case.silt.horizontal_density > 1000.0 or case.silt.vertical_density > 1300.0):
        said.append(
            Notice("silt-with-water", densities_kg_m3=(case.silt.horizontal_density, case.silt.vertical_density))
        )
    toe = case.cut.toe[1] - case.cut.base_elevation
    if case.tailwater and 0.0 < case.tailwater.depth <= toe:
        said.append(Notice("tailwater-below-crack"))
    if case.tailwater and case.tailwater.depth > upstream:
        said.append(Notice("tailwater-deeper"))
    return tuple(said)


def concrete_warnings(case: Case) -> tuple[Notice, ...]:
    """Return what elastic concrete seldom is; models of a rigid dam do not ask."""
    said = []
    if case.concrete.poisson > 0.35:
        said.append(Notice("poisson-unusual", poisson=case.concrete.poisson))
    modulus = case.concrete.modulus or 0.0
    if not 5e9 <= modulus <= 1e11:
        said.append(Notice("modulus-unusual", modulus_pa=modulus))
    return tuple(said)

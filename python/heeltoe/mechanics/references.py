"""Where equations and methods come from: every source once; results cite by key."""

from __future__ import annotations

_THESIS = (
    'X. Zhu, "Seismic Behavior of Cracked Concrete Gravity Dams", PhD thesis, Concordia University, Montréal, 2004'
)

#: Sources by what they are the source of; what water in a crack does while it is open goes by its name in the case.
REFERENCES = {
    "rigid": f"{_THESIS}, chapters IV and V",
    "flexible": f"{_THESIS}, chapters VI and VII",
    "decoupled": f"{_THESIS}, section 5.5 (the motion at the crack drives the rigid part above it)",
    "water": (
        'H. M. Westergaard, "Water pressures on dams during earthquakes", Transactions of the ASCE 98 (1933), 418-433'
    ),
    "sloped water": (
        'C. N. Zangar, "Hydrodynamic pressures on dams due to horizontal earthquake effects", Engineering Monograph '
        "11, US Bureau of Reclamation, 1952"
    ),
    "rocking": (
        'G. W. Housner, "The behavior of inverted pendulum structures during earthquakes", Bulletin of the '
        "Seismological Society of America 53 (1963), 403-417"
    ),
    "two components": (
        "U.S. Army Corps of Engineers, EM 1110-2-6053, Earthquake design and evaluation of concrete hydraulic "
        "structures (2007), on components of the ground motion that act together"
    ),
    "overturning": (
        'J. Zhang and N. Makris, "Rocking response of free-standing blocks under cycloidal pulses", Journal of '
        "Engineering Mechanics, ASCE 127 (2001), 473-483"
    ),
    "integration": (
        "E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd edition, Springer, "
        "1993 (DOP853)"
    ),
    "rough crack": (
        'F. D. Patton, "Multiple Modes of Shear Failure in Rock", 1st Congress of the International Society of Rock '
        "Mechanics, Lisbon, 1966, vol. 1, pp. 509-513"
    ),
    "wear": (
        'M. E. Plesha, "Constitutive Models for Rock Discontinuities with Dilatancy and Surface Degradation", '
        "International Journal for Numerical and Analytical Methods in Geomechanics, vol. 11, 1987, pp. 345-362"
    ),
    "law: slip weakening": (
        'A. C. Palmer and J. R. Rice, "The growth of slip surfaces in the progressive failure of over-consolidated '
        'clay", Proceedings of the Royal Society A 332 (1973), 527-548'
    ),
    "law: speed weakening": (
        'L. C. Bo and D. Pavelescu, "The friction-speed relation and its influence on the critical velocity of '
        'stick-slip motion", Wear 82 (1982), 277-289'
    ),
    "law: cohesion": 'USACE, "Gravity Dam Design", EM 1110-2-2200, 1995, chapter 4 (Mohr and Coulomb)',
    "law: barton-bandis": (
        'N. Barton and V. Choubey, "The shear strength of rock joints in theory and practice", Rock Mechanics 10 '
        "(1977), 1-54"
    ),
    "law: lift joint": (
        'L. Fronteddu, P. Léger and R. Tinawi, "Static and dynamic behavior of concrete lift joint interfaces", '
        "Journal of Structural Engineering, ASCE 124 (1998), 1418-1430 (its form; the coefficients are the case's)"
    ),
    "piecewise exact": (
        'N. C. Nigam and P. C. Jennings, "Calculation of response spectra from strong-motion earthquake records", '
        "Bulletin of the Seismological Society of America 59 (1969), 909-922"
    ),
    "dynamic tension": 'J. M. Raphael, "Tensile strength of concrete", ACI Journal 81 (1984), 158-165',
    "coulomb": (
        'J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", in Nonsmooth Mechanics and '
        "Applications, CISM 302, Springer, 1988, 1-82; M. Jean, "
        '"The non-smooth contact dynamics method", Computer Methods in Applied Mechanics and Engineering 177 (1999), '
        "235-257"
    ),
    "idce": (
        f"{_THESIS}, chapter VI (incremental displacement constraint equations); N. M. Newmark, "
        '"A method of computation for structural dynamics", Journal of the Engineering Mechanics Division, ASCE 85 '
        "(1959), 67-94"
    ),
    "zero while open": (
        "US Bureau of Reclamation, Design of Small Dams, 3rd edition, 1987, chapter 8 (no uplift in a crack that opens "
        "in the earthquake)"
    ),
    # The bulletin says so, the program made it an option beside the other two.
    "full while open": (
        "International Commission on Large Dams, Bulletin 52, Earthquake analysis procedures for dams, 1986 (the "
        "reservoir's head in cracks at once); M. Leclerc, P. Léger and R. Tinawi, \"Computer aided stability analysis "
        'of gravity dams: CADAM", Advances in Engineering Software 34 (2003), 403-420'
    ),
    "fragility": (
        'M. Shinozuka, M. Q. Feng, J. Lee and T. Naganuma, "Statistical analysis of fragility curves", Journal of '
        "Engineering Mechanics, ASCE 126 (2000), 1224-1231"
    ),
    "likelihood": (
        'J. W. Baker, "Efficient analytical fragility function fitting using dynamic structural analysis", Earthquake '
        "Spectra 31 (2015), 579-599"
    ),
    "bounds": (
        'C. J. Clopper and E. S. Pearson, "The use of confidence or fiducial limits illustrated in the case of the '
        'binomial", Biometrika 26 (1934), 404-413'
    ),
    "clusters": (
        'R. E. Chandler and S. Bate, "Inference for clustered data using the independence loglikelihood", Biometrika '
        "94 (2007), 167-183"
    ),
    "measures": (
        'N. Luco and C. A. Cornell, "Structure-specific scalar intensity measures for near-source and ordinary '
        'earthquake ground motions", Earthquake Spectra 23 (2007), 357-392'
    ),
    "sobol": (
        'A. Saltelli, P. Annoni, I. Azzini, F. Campolongo, M. Ratto and S. Tarantola, "Variance based sensitivity '
        'analysis of model output", Computer Physics Communications 181 (2010), 259-270; M. J. W. Jansen, "Analysis of '
        'variance designs for model output", Computer Physics Communications 117 (1999), 35-43'
    ),
    "response spectrum": (
        'G. Fenves and A. K. Chopra, "Simplified earthquake analysis of concrete gravity dams", Journal of Structural '
        "Engineering, ASCE 113 (1987), 1688-1708"
    ),
    "rigid response": "A. K. Gupta, Response Spectrum Method in Seismic Analysis and Design of Structures (1990)",
    "follows opening": (
        'F. Javanmardi, P. Léger and R. Tinawi, "Seismic structural stability of concrete gravity dams considering '
        'transient uplift pressures in cracks", Engineering Structures 27 (2005), 616-628'
    ),
}


def cited(*keys: str) -> tuple[str, ...]:
    """Return the sources of these keys."""
    return tuple(REFERENCES[key] for key in keys)

"""Where the equations of the flexible model come from, by what a case uses of them."""

from heeltoe.models.rigid.model import REFERENCES as RIGID_REFERENCES

REFERENCES = {
    "model": RIGID_REFERENCES["model"].replace("chapters IV and V", "chapters VI and VII"),
    "coulomb": (
        'J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", in Nonsmooth Mechanics and '
        "Applications, CISM 302, Springer, 1988, 1-82; M. Jean, "
        '"The non-smooth contact dynamics method", Computer Methods in Applied Mechanics and Engineering 177 (1999), '
        "235-257"
    ),
    "idce": (
        'X. Zhu, "Seismic Behavior of Cracked Concrete Gravity Dams", PhD thesis, 2004, chapter VI (incremental '
        'displacement constraint equations); N. M. Newmark, "A method of computation for structural dynamics", '
        "Journal of the Engineering Mechanics Division, ASCE 85 (1959), 67-94"
    ),
    "water": RIGID_REFERENCES["water"],
    "zero while open": (
        "U.S. Bureau of Reclamation, Design of Small Dams, 3rd edition, 1987 (no uplift in a crack that an earthquake "
        "opens)"
    ),
    "full while open": (
        "International Commission on Large Dams, Bulletin 52, Earthquake analysis procedures for dams, 1986 (the "
        "reservoir's head in cracks at once)"
    ),
    "follows opening": (
        'F. Javanmardi, P. Léger, R. Tinawi, "Seismic structural stability of concrete gravity dams considering '
        'transient uplift pressures in cracks", Engineering Structures 27 (2005), 616-628'
    ),
}

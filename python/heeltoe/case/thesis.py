"""Fields that only a comparison with Zhu (2004) needs; docs/thesis.md describes them.

They are read, checked and run like all others. `heeltoe explain`, `heeltoe new` and the form of the app leave them out
until a user names them.
"""

from __future__ import annotations

#: Their paths.
THESIS_FIELDS = frozenset(
    {
        "flexible.damping",
        "flexible.damping_on_water",
        "flexible.virtual_mass",
        "flexible.contact",
        "flexible.contactors",
        "flexible.penalty_factor",
        "flexible.newmark_gamma",
        "flexible.newmark_beta",
        "reservoir.virtual_mass_rotates",
        "tailwater.virtual_mass_rotates",
        "decoupled.upper_part",
    }
)

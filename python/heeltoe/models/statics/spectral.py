"""Forces of an earthquake on a section by its response spectrum: two modes of the dam with water and rock,
and a static correction for all higher ones (Fenves and Chopra 1987 have it for one)."""

from __future__ import annotations

import math
from typing import Annotated

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number
from heeltoe.mechanics.loads import Resultant

_NEWTON = "N per metre of dam"


class Push(Block):
    """Forces on the part above a section."""

    horizontal_n: Annotated[float, Number("Push downstream.", _NEWTON)]
    vertical_n: Annotated[float, Number("Push upward.", _NEWTON)]
    moment_about_heel_nm: Annotated[
        float, Number("Moment about the heel of the crack, positive counter-clockwise.", "N m per metre of dam")
    ]
    #: What the upward push adds to the moment.
    lift_moment_nm: float

    @classmethod
    def of(cls, forces: Floats) -> Push:
        """Return a push of its four numbers (4,)."""
        across, up, moment, lift = forces.tolist()
        return cls(horizontal_n=across, vertical_n=up, moment_about_heel_nm=moment, lift_moment_nm=lift)


class SpectralMode(Block):
    """A mode of the dam without a crack, with its water and its rock, in an earthquake."""

    period_s: Annotated[float, Number("Its period.", "s")]
    damping_ratio: Annotated[float, Number("Its effective damping ratio.")]
    pseudo_acceleration_m_s2: Annotated[float, Number("Ordinate of the spectrum at that period and damping.", "m/s²")]
    rigid_share: Annotated[
        float, Number("Part of its push that goes with the ground: 0 of a slow mode, 1 of one that follows at once.")
    ]
    push: Annotated[Push, Number("Push of its inertia and moving water on the part above the crack.")]


class SpectralDemand(Block):
    """Forces of an earthquake on the part above a section, at the first mode's largest push downstream."""

    spectrum: Annotated[str, Number("Name of the motion or of the design spectrum.")]
    peak_ground_acceleration_m_s2: Annotated[float, Number("Ordinate of the spectrum at period zero.", "m/s²")]
    first_mode: Annotated[SpectralMode, Number("The mode of the crest's first resonance.")]
    second_mode: Annotated[
        SpectralMode | None,
        Number("The next one; null where waves leave no second resonance, and it counts with the higher ones."),
    ]
    static_correction: Annotated[
        Push, Number("Push of inertia and moving water of all higher modes, which follow the ground at once.")
    ]

    @property
    def together(
        self,
    ) -> Annotated[
        Push,
        Number(
            "All together, with the signs of the first mode: what goes with the ground is summed, the rest of each "
            "mode joins it by the root of the sum of squares."
        ),
    ]:
        """All together (Gupta 1990)."""
        modes = [mode for mode in (self.first_mode, self.second_mode) if mode is not None]

        def combined(name: str, correction: float) -> float:
            pushes = [(float(getattr(mode.push, name)), mode.rigid_share) for mode in modes]
            ground = correction + sum(push * share for push, share in pushes)
            swinging = (push * math.sqrt(1.0 - share**2) for push, share in pushes)
            return math.copysign(math.hypot(ground, *swinging), pushes[0][0])

        return Push(**{name: combined(name, value) for name, value in vars(self.static_correction).items()})

    def push(self) -> Resultant:
        """Return all together as a force."""
        push = self.together
        return Resultant(
            "response spectrum",
            push.horizontal_n,
            push.vertical_n,
            push.moment_about_heel_nm,
            lift_moment=push.lift_moment_nm,
        )

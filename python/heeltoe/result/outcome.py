"""How a run ends: every outcome once, with whether it is a result, whether the dam has failed, and what to do."""

from __future__ import annotations

from enum import StrEnum
from typing import Self

#: Small rotations are told from large ones here [rad]: the cosine of more is no longer one within half a per cent, and
#: the models that take rotations for small have no result beyond.
LARGEST_ROTATION = 0.1
#: Exit code of a command whose run has no result.
NO_RESULT = 3

_STAND = "give the dam more friction, less uplift or less water until it stands before the earthquake"


class Outcome(StrEnum):
    """How a run ends. The first line that applies is the outcome:

    ============== ====== ====== =====================================================================
    outcome        result failed when
    ============== ====== ====== =====================================================================
    refused        no     no     the case of a row of a study cannot be used
    unstable       no     yes    the static loads alone move the dam
    paradox        no     no     no motion agrees with Coulomb friction
    event limit    no     no     a block has more events than ``analysis.event_limit``
    cycling        no     no     events follow each other without time passing
    lifts across   no     no     a corner of a block of a friction law or of changing uplift lifts, shaken across
    blown up       no     no     the time stepping makes energy
    overturned     yes    yes    a block whose rotation may be of any size lies on its side
    lost           no     yes    the part above slides or lifts farther than its crack is wide
    large rotation no     yes    a rotation that the model takes for small exceeds 0.1 rad
    keeps sliding  no     yes    the free motion after the record does not slow down
    ok             yes    no     none of these
    ============== ====== ====== =====================================================================

    Attributes
    ----------
    has_result
        Whether the numbers of the run are those of a dam.
    failed
        Whether the dam has failed: it meets no limit and exceeds every limit.
    sentence
        The dam or the run as its subject, without a full stop.
    remedy
        How to get a result; empty where there is one.
    """

    has_result: bool
    failed: bool
    sentence: str
    remedy: str

    def __new__(
        cls, word: str, has_result: bool = False, failed: bool = False, sentence: str = "", remedy: str = ""
    ) -> Self:
        """Return a row of the table."""
        outcome = str.__new__(cls, word)
        outcome._value_ = word
        outcome.has_result, outcome.failed = has_result, failed
        outcome.sentence, outcome.remedy = sentence, remedy
        return outcome

    REFUSED = "refused", False, False, "the case cannot be used", "correct the fields that the study varies"
    UNSTABLE = "unstable", False, True, "the dam does not stand under its static loads", _STAND
    PARADOX = (
        *("paradox", False, False, "no motion agrees with Coulomb friction (Painlevé)"),
        'set analysis.paradox = "tangential impact" to let the sliding corner jam, or use the flexible model',
    )
    EVENT_LIMIT = (
        *("event limit", False, False, "the block has more events than analysis.event_limit"),
        "lower crack.restitution, shorten motion.duration or raise analysis.event_limit",
    )
    CYCLING = (
        *("cycling", False, False, "events followed each other without time passing"),
        "report this case: it should not happen",
    )
    LIFTS_ACROSS = (
        *("lifts across", False, False),
        "a corner lifts while the ground shakes across the valley and friction or uplift goes by a law",
        'set motion.cross_valley = "none", or leave out crack.law and uplift.during_shaking',
    )
    BLOWN_UP = (
        *("blown up", False, False, "energy came from nothing, as penalties can make it"),
        'use flexible.contact = "coulomb" or a smaller time_step',
    )
    OVERTURNED = "overturned", True, True, "the dam overturns", ""
    LOST = (
        *("lost", False, True),
        "the part above slides or lifts farther than its crack is wide and leaves what it stood on",
        "the dam has failed: see its static safety",
    )
    LARGE_ROTATION = (
        *("large rotation", False, True, f"the dam rotates by more than {LARGEST_ROTATION:g} rad, which is not small"),
        'the rigid model with analysis.rotation = "finite" says whether one block overturns',
    )
    KEEPS_SLIDING = (
        *("keeps sliding", False, True, "the dam does not slow down on still ground"),
        f"no residual slip exists; {_STAND.replace('stands before the earthquake', 'slows down')}",
    )
    OK = "ok", True, False, "the run has a result", ""

    @property
    def exit_code(self) -> int:
        """Exit code of a command that runs one case."""
        return 0 if self.has_result else NO_RESULT

    @property
    def severity(self) -> int:
        """How bad it is: 2 of a dam that has failed, 1 where the run does not say, 0 of a result."""
        return 2 if self.failed else 0 if self.has_result else 1


def decide(
    word: str,
    *,
    rotation: float = 0.0,
    finite: bool = False,
    stands: bool = True,
    off: bool = False,
    slows: bool = True,
) -> Outcome:
    """Return the outcome of a run.

    Parameters
    ----------
    word
        How the kernel ended.
    rotation
        Largest rotation, either way [rad].
    finite
        Whether the model follows rotations of any size.
    stands
        Whether the dam stands under its static loads.
    off
        Whether a part slides farther than its crack is wide.
    slows
        Whether the free motion after the record slows down.
    """
    if word in (Outcome.OK, Outcome.LOST) and not stands:
        return Outcome.UNSTABLE
    if word != Outcome.OK:
        return Outcome(word)
    if off:
        return Outcome.LOST
    if rotation > LARGEST_ROTATION and not finite:
        return Outcome.LARGE_ROTATION
    return Outcome.OK if slows else Outcome.KEEPS_SLIDING

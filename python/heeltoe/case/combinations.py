"""Which features of a case go together, and which models and tables support them: one table.

:data:`RULES` is read by the checks of a case (:func:`conflicts`), by the models before they run (:func:`check`), by
`heeltoe explain` (:func:`rules_of`), by the app and by the page of the documentation. What no rule names is supported.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any, Literal, Protocol

from heeltoe.case.crack.crack import Crack, FurtherCrack
from heeltoe.case.crack.kinks import climbs
from heeltoe.case.dam import Anchor
from heeltoe.case.options import StaticsChoice
from heeltoe.errors.error import InputError, shown

# Fields of a case that have a feature, with their values.
FeatureFields = Iterator[tuple[str, object]]


class Featured(Protocol):
    """Fields of a case that rules read; blocks of options are read by their names."""

    @property
    def crack(self) -> Crack: ...
    @property
    def further_cracks(self) -> tuple[FurtherCrack, ...]: ...
    @property
    def anchors(self) -> tuple[Anchor, ...]: ...
    @property
    def aftershocks(self) -> tuple[Any, ...]: ...
    @property
    def statics(self) -> StaticsChoice: ...
    @property
    def motion(self) -> Any: ...
    def path_as_written(self, path: str) -> str:
        """Return the path of a field as the file of the case has it."""


Finder = Callable[[Featured], FeatureFields]


@dataclass(frozen=True)
class Feature:
    """Something that a case may have.

    Attributes
    ----------
    name
        As messages and the documentation call it.
    fields
        Paths of its fields, or of the first of them.
    removal
        How a case does without it.
    find
        Walks the fields of a case that have it, with their values; a value of None goes without saying.
    """

    name: str
    fields: tuple[str, ...]
    removal: str
    find: Finder


@dataclass(frozen=True)
class Rule:
    """A feature that does not go with another one, or that a model does not support.

    Attributes
    ----------
    feature
        Name of the feature, in :data:`FEATURES`.
    other
        Name of another feature; empty where the feature alone is not supported.
    users
        Which models and tables the rule is about, by their keys in :data:`USERS`; empty for all.
    reason
        Why.
    verdict
        ``"refused"``, or ``"warned"`` where the case runs and a warning says what the feature leaves out.
    one_crack
        Whether only a crack that has both breaks it.
    """

    feature: str
    other: str
    users: tuple[str, ...]
    reason: str
    verdict: Literal["refused", "warned"] = "refused"
    one_crack: bool = False

    def without(self, path: str) -> str:
        """Return in a few words what a field does not go with by this rule."""
        # What a field may have beside its first feature is a part of that, and has to be named.
        own = _features_of(path)
        narrow = not self.other and self.feature not in own[:1]
        features = [name for name in (self.feature, self.other) if name and (narrow or name not in own)]
        users = [USERS[user] for user in self.users]
        what = f"{features[0]} in {', '.join(users)}" if features and users else ", ".join(features or users)
        return f"{what} (a warning says what is left out)" if self.verdict == "warned" else what


#: What uses a case, by its key.
USERS = {
    "rigid": "the rigid model",
    "decoupled": "the decoupled chain",
    "flexible": "the flexible model",
    "beside": "the block beside the flexible model",
    "study": "a study of blocks",
    "table": "a table of blocks",
    "map": "a map of overturning",
    "rotation": "a ground that rotates",
    "motions": "a study with motions of its own",
}
#: Code of the error that a model or table does not support a case.
UNSUPPORTED = "unsupported"
# Models that a remedy may name, the best one first.
_MODELS = ("flexible", "rigid", "decoupled")


def _cracks(case: Featured, fewest: int = 2) -> FeatureFields:
    if len(case.further_cracks) + 1 >= fewest:
        yield case.path_as_written("further_cracks"), len(case.further_cracks) + 1


def _of_cracks(name: str) -> Finder:
    def find(case: Featured) -> FeatureFields:
        for place, crack in enumerate((case.crack, *case.further_cracks)):
            value = getattr(crack, name, None)
            if value:
                path = f"further_cracks[{place - 1}]" if place else "crack"
                yield case.path_as_written(f"{path}.{name}"), getattr(value, "name", None)

    return find


def _options(*fields: str, unlike: tuple[object, ...] = (None,), among: tuple[object, ...] = ()) -> Finder:
    """Return what finds fields whose values are unlike some, or among others."""

    def find(case: Featured) -> FeatureFields:
        for path in fields:
            block, _, name = path.partition(".")
            owner = getattr(case, block)
            # A word stands for rock that has no fields.
            if owner is None or isinstance(owner, str):
                continue
            value = getattr(owner, name)
            if value in among if among else value not in unlike:
                yield path, value if isinstance(value, str) and not name.startswith("mesh") else None

    return find


def _anchors(*names: str) -> Finder:
    def find(case: Featured) -> FeatureFields:
        for place, anchor in enumerate(case.anchors):
            for name in names:
                # A place at the heel is one, no stiffness is none.
                if getattr(anchor, name) is not None and (name == "distance" or getattr(anchor, name)):
                    yield f"anchors[{place}].{name}", None

    return find


def _aftershocks(case: Featured) -> FeatureFields:
    if case.aftershocks:
        yield "aftershocks", None


def _cross_valley(case: Featured) -> FeatureFields:
    if case.motion is not None and case.motion.cross_valley is not None:
        yield "motion.cross_valley", None
    for place, motion in enumerate(case.aftershocks):
        if motion.cross_valley is not None:
            yield f"aftershocks[{place}].cross_valley", None


def _closing_drains(case: Featured) -> FeatureFields:
    if case.statics.drain_diameter is not None:
        yield "statics.drain_diameter", None


def _cohesive_law(case: Featured) -> FeatureFields:
    if case.crack.law is not None and case.crack.law.cohesion is not None:
        yield "crack.law.cohesion", None


def _law_by_stress(case: Featured) -> FeatureFields:
    if case.crack.law is not None and case.crack.law.name in ("barton-bandis", "lift joint"):
        yield "crack.law.name", case.crack.law.name


def _cohesion_of_checks(case: Featured) -> FeatureFields:
    if case.statics.cohesion:
        yield "statics.cohesion", None


#: All features, by their names.
FEATURES = {
    feature.name: feature
    for feature in (
        Feature("several cracks", ("further_cracks", "cracks"), "keep one crack", _cracks),
        Feature("three cracks", ("further_cracks", "cracks"), "keep two cracks", lambda case: _cracks(case, 3)),
        Feature("kinks", ("crack.kinks", "further_cracks.kinks"), "remove the kinks", _of_cracks("kinks")),
        Feature(
            "kinks off the straight line",
            ("crack.kinks", "further_cracks.kinks"),
            "remove the kinks",
            lambda case: (place for place in _of_cracks("kinks")(case) if climbs(case.crack.kinks)),
        ),
        Feature(
            "a measured loss of rocking", ("crack.rocking_loss",), "set rocking_loss = 0", _of_cracks("rocking_loss")
        ),
        Feature("roughness", ("crack.roughness",), "remove roughness", _of_cracks("roughness")),
        Feature(
            "a friction law", ("crack.law", "further_cracks.law"), "give coefficients of friction", _of_cracks("law")
        ),
        Feature(
            "a friction law by the normal stress",
            ("crack.law.name",),
            "give a law that goes by slip or speed",
            _law_by_stress,
        ),
        Feature("a bonded joint", ("crack.bond", "further_cracks.bond"), "remove bond", _of_cracks("bond")),
        Feature(
            "a law with cohesion", ("crack.law.cohesion",), "give the cohesion in statics.cohesion alone", _cohesive_law
        ),
        Feature("cohesion of the static checks", ("statics.cohesion",), "remove statics.cohesion", _cohesion_of_checks),
        Feature(
            "uplift that changes during shaking",
            ("uplift.during_shaking", "uplift.opening"),
            'set uplift.during_shaking = "constant"',
            _options("uplift.during_shaking", unlike=("constant",)),
        ),
        Feature(
            "an anchor placed on one crack",
            ("anchors.distance", "anchors.inclination"),
            "give head_x, head_elevation, foot_x and foot_elevation",
            _anchors("distance"),
        ),
        Feature(
            "an anchor with stiffness",
            ("anchors.axial_stiffness", "anchors.shear_stiffness"),
            "give prestress alone",
            _anchors("axial_stiffness", "shear_stiffness"),
        ),
        Feature("aftershocks", ("aftershocks",), "remove the aftershocks", _aftershocks),
        Feature(
            "drains that slip closes",
            ("statics.drain_diameter",),
            "remove statics.drain_diameter",
            _closing_drains,
        ),
        Feature(
            "finite rotation",
            ("analysis.rotation",),
            'set analysis.rotation = "small"',
            _options("analysis.rotation", among=("finite",)),
        ),
        Feature(
            "rotation beyond small angles",
            ("analysis.rotation",),
            'set analysis.rotation = "small"',
            _options("analysis.rotation", unlike=("small",)),
        ),
        Feature(
            "penalty contact",
            ("flexible.contact",),
            'set flexible.contact = "coulomb"',
            _options("flexible.contact", among=("idce",)),
        ),
        Feature(
            "damping of free parts",
            ("flexible.damping",),
            'set flexible.damping = "stiffness"',
            _options("flexible.damping", among=("relative", "modal")),
        ),
        Feature(
            "options of the thesis",
            ("flexible.damping", "flexible.virtual_mass"),
            "leave flexible.damping and flexible.virtual_mass out",
            _options("flexible.damping", "flexible.virtual_mass", among=("thesis",)),
        ),
        Feature(
            "all nodes watched twice",
            ("flexible.contactors",),
            "leave flexible.contactors out",
            _options("flexible.contactors", among=(5,)),
        ),
        Feature(
            "meshes from files",
            ("flexible.mesh_above", "flexible.mesh_below"),
            "remove the meshes",
            _options("flexible.mesh_above", "flexible.mesh_below"),
        ),
        Feature(
            "another number of elements below",
            ("flexible.elements_across_below",),
            "remove flexible.elements_across_below",
            _options("flexible.elements_across_below"),
        ),
        Feature(
            "virtual water that does not rotate",
            ("reservoir.virtual_mass_rotates", "tailwater.virtual_mass_rotates"),
            "set virtual_mass_rotates = true",
            _options("reservoir.virtual_mass_rotates", "tailwater.virtual_mass_rotates", unlike=(True,)),
        ),
        Feature(
            "Zangar's water pressure",
            ("reservoir.hydrodynamic", "tailwater.hydrodynamic"),
            'set hydrodynamic = "westergaard"',
            _options("reservoir.hydrodynamic", "tailwater.hydrodynamic", unlike=("westergaard",)),
        ),
        Feature(
            "compressible water",
            tuple(
                f"{side}.{name}"
                for side in ("reservoir", "tailwater")
                for name in ("compressible", "wave_speed", "floor_reflection")
            ),
            "set compressible = false",
            _options("reservoir.compressible", "tailwater.compressible", among=(True,)),
        ),
        Feature(
            "shaking across the valley",
            ("motion.cross_valley", "aftershocks.cross_valley"),
            "remove motion.cross_valley",
            _cross_valley,
        ),
        Feature("neighbours", ("crack.side_gap",), 'set crack.side_gap = "free"', _options("crack.side_gap")),
        Feature("an inclined crack", ("crack.inclination",), "set crack.inclination = 0", _of_cracks("inclination")),
        Feature("elastic rock", ("rock",), 'set rock = "rigid"', _options("rock.modulus")),
        Feature(
            "water that follows the vertical motion",
            ("reservoir.follows_vertical_motion", "tailwater.follows_vertical_motion"),
            "set follows_vertical_motion = false",
            _options("reservoir.follows_vertical_motion", "tailwater.follows_vertical_motion", among=(True,)),
        ),
    )
}

_ONE_CRACK = "it is implemented for one crack"
_STRAIGHT = "it is implemented for a straight crack"
_NO_PENALTY = "the penalty method does not support it"
_OF_BLOCKS = ("rigid", "decoupled", "beside", "study", "table", "map", "rotation")
#: The table. The first rule that a case breaks is told first.
RULES = (
    Rule(
        "an anchor placed on one crack", "several cracks", (), "the place is on one crack, and the anchor may cross all"
    ),
    Rule("roughness", "several cracks", (), _ONE_CRACK),
    Rule("penalty contact", "several cracks", (), _ONE_CRACK),
    Rule("options of the thesis", "several cracks", (), _ONE_CRACK),
    Rule("meshes from files", "several cracks", (), _ONE_CRACK),
    Rule("finite rotation", "roughness", (), "rough blocks rotate by small angles"),
    Rule("uplift that changes during shaking", "roughness", (), "no model combines them"),
    Rule("an anchor with stiffness", "roughness", (), "no model combines them"),
    Rule("roughness", "a friction law", (), "coefficients of a law are those of plane flanks"),
    Rule("roughness", "kinks", (), _STRAIGHT),
    Rule("a bonded joint", "kinks", (), _STRAIGHT),
    Rule("a bonded joint", "a friction law", (), "below the bond there is constant friction", one_crack=True),
    Rule("a bonded joint", "roughness", (), "below the bond the faces are plane"),
    Rule("a bonded joint", "penalty contact", (), _NO_PENALTY),
    Rule("a bonded joint", "all nodes watched twice", (), "each node would have its bond twice"),
    Rule("uplift that changes during shaking", "kinks", (), _STRAIGHT),
    Rule("penalty contact", "kinks", (), _STRAIGHT),
    Rule("meshes from files", "kinks", (), _STRAIGHT),
    Rule("another number of elements below", "kinks", (), "both faces share the corners of the crack"),
    Rule("cohesion of the static checks", "a law with cohesion", (), "cohesion would be stated twice"),
    Rule("damping of free parts", "penalty contact", (), _NO_PENALTY),
    Rule("compressible water", "penalty contact", (), _NO_PENALTY),
    Rule("compressible water", "options of the thesis", (), "the water of the thesis is a mass"),
    Rule(
        "compressible water",
        "water that follows the vertical motion",
        (),
        "compressible water feels the vertical motion by itself",
    ),
    Rule("elastic rock", "penalty contact", (), _NO_PENALTY),
    Rule("elastic rock", "options of the thesis", (), "the dam of the thesis stands on a rigid plane"),
    Rule("three cracks", "", ("rigid",), "its blocks are two at most, one on the other"),
    Rule(
        "several cracks",
        "",
        ("decoupled", "beside", "table", "map", "rotation"),
        "what is above one of several cracks is not a single block",
    ),
    Rule("kinks", "", _OF_BLOCKS, "a block slides on a straight line"),
    Rule(
        "a bonded joint",
        "",
        ("study", "table", "map", "rotation"),
        "the bond of a block is judged in single runs of one dam",
    ),
    Rule("a bonded joint", "several cracks", ("rigid",), "two blocks have no bond between them"),
    Rule("aftershocks", "several cracks", ("rigid",), "two blocks run through one motion"),
    Rule("a friction law", "several cracks", ("rigid",), "two blocks have constant coefficients of friction"),
    Rule("a measured loss of rocking", "several cracks", ("rigid",), "impacts of two blocks lose what theory says"),
    Rule("rotation beyond small angles", "several cracks", ("rigid",), "two blocks rotate by small angles"),
    Rule("virtual water that does not rotate", "several cracks", ("rigid",), "the virtual water of two blocks rotates"),
    Rule(
        "an anchor with stiffness", "several cracks", ("rigid",), "the anchors of two blocks pull with constant forces"
    ),
    Rule("uplift that changes during shaking", "several cracks", ("rigid",), "the uplift of two blocks is constant"),
    Rule("Zangar's water pressure", "several cracks", ("rigid",), "the virtual water of two blocks is Westergaard's"),
    *(
        Rule("shaking across the valley", other, ("rigid",), why)
        for other, why in (
            ("an inclined crack", "its block slides on a level crack"),
            ("several cracks", "two blocks slide along the stream alone"),
            ("roughness", "asperities rise along the stream alone"),
            ("a friction law by the normal stress", "what it bears at rest bends with the normal force"),
            ("a bonded joint", "the bond of a block is judged along the stream alone"),
            ("an anchor with stiffness", "its loads are constant"),
            ("rotation beyond small angles", "its block rotates by small angles"),
        )
    ),
    *(
        Rule("shaking across the valley", other, ("flexible",), why)
        for other, why in (
            ("penalty contact", _NO_PENALTY),
            ("all nodes watched twice", "nodes that meet would share their friction"),
        )
    ),
    Rule("neighbours", "several cracks", ("flexible",), "a neighbour stops each part by the sum of the slips below it"),
    Rule(
        "shaking across the valley",
        "",
        ("decoupled", "table", "map", "rotation"),
        "the rigid and the flexible model alone follow it, in runs and studies",
    ),
    Rule("shaking across the valley", "", ("motions",), "the motions of the study replace that of the case"),
    Rule("roughness", "", ("flexible",), "the faces of its cracks are smooth"),
    Rule("a friction law", "penalty contact", ("flexible",), _NO_PENALTY),
    Rule("uplift that changes during shaking", "penalty contact", ("flexible",), _NO_PENALTY),
    Rule("an anchor with stiffness", "penalty contact", ("flexible",), _NO_PENALTY),
    Rule("aftershocks", "", ("motions",), "the motions of the study replace all motions of the case"),
    *(
        Rule(
            "drains that slip closes",
            other,
            ("flexible",),
            "the later motions are computed with all of the drainage",
            "warned",
        )
        for other in (
            "several cracks",
            "kinks off the straight line",
            "uplift that changes during shaking",
            "penalty contact",
        )
    ),
    Rule("rotation beyond small angles", "", ("flexible",), "elastic parts rotate by small angles", "warned"),
    Rule("Zangar's water pressure", "", ("flexible",), "the water of an elastic dam is Westergaard's", "warned"),
)


def conflicts(case: Featured) -> Iterator[InputError]:
    """Walk the features of a case that do not go together, whatever is done with it."""
    found = _Found(case)
    for rule in RULES:
        if not rule.users and rule.verdict == "refused" and (broken := _broken(found, rule)):
            yield from _errors(case, rule, broken, "")


def check(case: Featured, user: str) -> None:
    """Refuse a case that has what a model or table does not support; `user` is a key of :data:`USERS`.

    Raises
    ------
    InputError
        The first feature that is not supported, with the others.
    """
    errors = list(_unsupported(case, user))
    if errors:
        raise errors[0].with_others(errors[1:])


def supports(case: Featured, user: str) -> bool:
    """Whether a model or table supports all features of a case."""
    return not _any_broken(case, _rules_for(user))


def misfit(case: Featured, feature: str) -> str:
    """Return in a few words what of a case does not go with a feature that it does not have; nothing where all does."""
    for rule in RULES:
        if not rule.users and rule.verdict == "refused" and feature in (rule.feature, rule.other):
            other = rule.feature if rule.other == feature else rule.other
            if any(True for _ in FEATURES[other].find(case)):
                return f"{other}: {rule.reason}"
    return ""


def warned(case: Featured, feature: str, user: str) -> bool:
    """Whether a feature of a case has less effect in a model than its field says, which a warning tells."""
    rules = [rule for rule in RULES if rule.verdict == "warned" and rule.feature == feature and user in rule.users]
    return _any_broken(case, rules)


def unsupported_features(user: str) -> tuple[str, ...]:
    """Return the features that a model supports in no case, in the words of messages."""
    return tuple(dict.fromkeys(rule.feature for rule in _rules_for(user) if rule.users and not rule.other))


def rules_of(path: str) -> tuple[Rule, ...]:
    """Return the rules about a field, or about the block that it is in; its path has no places in lists."""
    named = set(_features_of(path))
    return tuple(rule for rule in RULES if named & {rule.feature, rule.other})


@lru_cache(maxsize=1)
def _features_of(path: str) -> tuple[str, ...]:
    """Return the names of the features of a field, or of the block that it is in; each rule about a field asks."""
    own = re.sub(r"^(cracks|joints)\.", "crack.", path).split(".")
    blocks = {".".join(own[:count]) for count in range(1, len(own) + 1)}
    return tuple(name for name, feature in FEATURES.items() if not blocks.isdisjoint(feature.fields))


@cache
def _rules_for(user: str) -> tuple[Rule, ...]:
    """Return the features that a model or table refuses, with those that no model supports: a case may be changed after
    it was checked."""
    return tuple(rule for rule in RULES if (user in rule.users or not rule.users) and rule.verdict == "refused")


def _unsupported(case: Featured, user: str) -> Iterator[InputError]:
    found = _Found(case)
    for rule in _rules_for(user):
        if broken := _broken(found, rule):
            yield from _errors(case, rule, broken, user if rule.users else "")


class _Found(dict[str, list[tuple[str, object]]]):
    """The fields of a case with a feature, each looked up once: many rules are of the same ones."""

    def __init__(self, case: Featured) -> None:
        self._case = case

    def __missing__(self, feature: str) -> list[tuple[str, object]]:
        self[feature] = list(FEATURES[feature].find(self._case))
        return self[feature]


def _any_broken(case: Featured, rules: Sequence[Rule]) -> bool:
    found = _Found(case)
    return any(_broken(found, rule) for rule in rules)


def _broken(features: _Found, rule: Rule) -> list[tuple[str, object]]:
    """Return the fields with the feature of a rule, where the case has the other one, too."""
    found = features[rule.feature]
    if not found or not rule.other:
        return found
    others = {path.rpartition(".")[0] for path, _ in features[rule.other]}
    return [
        (path, value) for path, value in found if others and (not rule.one_crack or path.rpartition(".")[0] in others)
    ]


def _at_another_crack(case: Featured, rule: Rule, path: str) -> float | None:
    """Return the elevation of the crack that has the other feature of a rule, if both are of cracks and no crack has
    both [m]."""
    paths = [
        case.path_as_written(place)
        for place in ("crack", *map("further_cracks[{}]".format, range(len(case.further_cracks))))
    ]
    cracks = dict(zip(paths, (case.crack, *case.further_cracks), strict=True))
    crack, others = path.rpartition(".")[0], [place for place, _ in FEATURES[rule.other].find(case)]
    owners = [place.rpartition(".")[0] for place in others]
    if crack not in cracks or crack in owners or not owners or owners[0] not in cracks:
        return None
    return cracks[owners[0]].elevation


def _errors(case: Featured, rule: Rule, broken: Sequence[tuple[str, object]], user: str) -> Iterator[InputError]:
    for path, value in broken:
        name = rule.feature if value is None else f"{rule.feature} ({shown(value)})"
        remedy = FEATURES[rule.feature].removal
        if rule.other:
            remedy = f"{remedy}, or {FEATURES[rule.other].removal}"
        if not user:
            of_another = _at_another_crack(case, rule, path) if rule.other else None
            other = rule.other if of_another is None else f"{rule.other} of another crack, at {of_another:g} m"
            apart = "" if of_another is None else ", and the cracks of a dam are solved together"
            yield InputError("combination", path, name, other=other, reason=f"{rule.reason}{apart}", remedy=remedy)
            continue
        model = next((candidate for candidate in _MODELS if candidate != user and supports(case, candidate)), None)
        run = "" if model is None else f"run {USERS[model]}, or "
        if user == "motions":
            run = "leave [motions] out, or "
        combined = f"{name} with {rule.other}" if rule.other else name
        yield InputError(UNSUPPORTED, path, combined, model=USERS[user], reason=rule.reason, remedy=f"{run}{remedy}")

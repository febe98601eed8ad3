"""What is wrong with a case, in which words: every error, and no other exception whatever the input."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from heeltoe.case.model import Case
from heeltoe.case.read import read_case
from heeltoe.errors.error import InputError
from shared.cases import DAM, dam, refusal, write
from shared.dams import PULSE, polygon

CRACK, SECTION, FILE = DAM["crack"], DAM["section"], DAM["motion"]
# One case and its whole message for each way to go wrong.
REFUSED = [
    (dam(crack={"fricton": 1}), 'crack.fricton: no such field; did you mean "friction"?'),
    (dam(friction=1), 'friction: no such field; did you mean "crack.friction"?'),
    (
        dam(crack=CRACK | {"colour": "red"}),
        "crack.colour: no such field; "
        "the fields here are elevation, inclination, kinks, friction, static_friction, kinetic_friction, law, bond, "
        "restitution, uplift, uplift_intensity, side_gap, rocking_loss, roughness, band, fit",
    ),
    (
        dam(motion=FILE | {"vertical": {"file": "a", "revers": True}}),
        'motion.vertical.revers: no such field; did you mean "reverse"?',
    ),
    (
        dam(anchors=[{"prestress": "1 MN/m"}]),
        "anchors[0].distance: is required but missing; "
        "give distance, or head_x, head_elevation, foot_x and foot_elevation",
    ),
    (
        dam(anchors=[{"distance": "5 m", "prestres": "1 MN/m"}]),
        'anchors[0].prestres: no such field; did you mean "prestress"?',
    ),
    (
        dam(anchors=[{"distance": "5 m"}]),
        "anchors[0].distance: has no meaning without prestress, axial_stiffness or shear_stiffness; give that, or "
        "remove this",
    ),
    (
        dam(anchors=[{"distance": "85 m", "prestress": "1 MN/m"}]),
        "anchors[0].distance: 85 m is out of range; give a value from 0 m to 80 m, the width of the crack",
    ),
    (
        dam(statics={"cohesion": "1 MPa"}),
        "statics.cohesion: has no meaning without a part of the crack that is bonded (statics.bonded); give that, or "
        "remove this",
    ),
    (
        dam(statics={"flood_tailwater": "1 m"}),
        "statics.flood_tailwater: has no meaning without flood_depth; give that, or remove this",
    ),
    (
        dam(statics={"vertical_seismic_coefficient": 0.1}),
        "statics.vertical_seismic_coefficient: has no meaning without seismic_coefficient; give that, or remove this",
    ),
    (
        dam(statics={"flood_rarity": "extreme"}),
        "statics.flood_rarity: has no meaning without flood_depth; give that, or remove this",
    ),
    (
        dam(statics={"site_information": "limited"}),
        'statics.site_information: "limited" contradicts structure = "critical" under USACE; keep one of them',
    ),
    (
        dam(statics={"drain_diameter": "75 mm"}),
        'statics.drain_diameter: has no meaning without uplift.pattern = "drained"; give that, or remove this',
    ),
    (
        dam(motion={"points": [["0 s", "0 g"], ["1 s", "1 g"]], "sign": "recorded", "reverse": True}),
        'motion.sign: "recorded" contradicts reverse = true; keep one of them',
    ),
    (
        dam(statics={"closed_drains": "linear"}),
        "statics.closed_drains: has no meaning without drain_diameter; give that, or remove this",
    ),
    (
        dam(statics={"flood_depth": "201 m"}),
        "statics.flood_depth: 201 m is above twice the height of the dam, 200 m; give at most 200 m",
    ),
    (
        dam(uplift={"opening": "1 mm"}),
        "uplift.opening: has no meaning without a during_shaking that changes the pressure; give that, or remove this",
    ),
    (
        dam(uplift={"pattern": "none", "during_shaking": "follows opening"}),
        'uplift.during_shaking: "follows opening" contradicts pattern = "none"; keep one of them',
    ),
    (
        dam(uplift={"during_shaking": "full while open"}, reservoir=None),
        "uplift.during_shaking: has no meaning without a reservoir; give that, or remove this",
    ),
    (
        dam(ice={"force": "150 kN/m"}, reservoir=None),
        "ice: has no meaning without a reservoir; give that, or remove this",
    ),
    (
        dam(ice={"force": "150 kN/m", "depth": "95 m"}),
        "ice.depth: 95 m is out of range; give a value from 0 m to 95 m, within the water",
    ),
    (
        dam(silt={"depth": "101 m"}),
        "silt.depth: 101 m is above the crest, 100 m; give at most 100 m",
    ),
    (
        dam(reservoir={"depth": "95 m", "follows_vertical_motion": True}),
        "reservoir.follows_vertical_motion: has no meaning without motion.vertical; give that, or remove this",
    ),
    (
        dam(crack={"friction": 1.0, "inclination": "5 %"}),
        'crack.inclination: "5 %" is not an angle; write for example "5 deg"',
    ),
    (dam(crack=None), "crack: is required but missing; add for example [crack]"),
    (dam(reservoir={}), 'reservoir.depth: is required but missing; add for example depth = "100 m"'),
    (dam(crack=5), "crack: 5 is of the wrong type; give a block of fields"),
    (dam(title=5), "title: 5 is of the wrong type; give a text in quotes"),
    (dam(motion=FILE | {"reverse": "yes"}), 'motion.reverse: "yes" is of the wrong type; give true or false'),
    (
        dam(analysis={"event_limit": 1.5}),
        "analysis.event_limit: 1.5 is of the wrong type; give a whole number",
    ),
    (dam(section={"polygon": "square"}), 'section.polygon: "square" is of the wrong type; give a list'),
    (
        dam(section={"polygon": [["0 m", "0 m"], ["1 m"], ["0 m", "1 m"]]}),
        'section.polygon[1]: ["1 m"] has the wrong length; give 2 values',
    ),
    (
        dam(section={"polygon": [["0 m", "0 m"], ["1 m", "1 m", "2 m"], ["0 m", "1 m"]]}),
        'section.polygon[1]: ["1 m", "1 m", "2 m"] has the wrong length; give 2 values',
    ),
    (
        dam(section={"polygon": [["0 m", "0 m"], ["1 m", 0], ["0 m", "1 m"]]}),
        'section.polygon[1][1]: 0 has no unit; write for example "0 m"',
    ),
    (dam(reservoir={"depth": 95}), 'reservoir.depth: 95 has no unit; write for example "95 m"'),
    (
        dam(reservoir={"depth": "95 furlings"}),
        'reservoir.depth: "95 furlings" has the unknown unit "furlings"; write for example "100 m"',
    ),
    (
        dam(concrete={"density": "24 kN/m^3"}),
        'concrete.density: "24 kN/m^3" is a weight for each volume, not a density; '
        'divide it by one g, 9.80665 m/s^2: "2447.3 kg/m^3"',
    ),
    (
        dam(crack={"friction": float("inf")}),
        "crack.friction: Infinity is not a finite number; write for example 1.0",
    ),
    (dam(crack={"friction": 11}), "crack.friction: 11 is out of range; give a value of at most 10"),
    (dam(crack={"friction": -0.1}), "crack.friction: -0.1 is out of range; give a value of at least 0"),
    (
        dam(crack=CRACK | {"restitution": 1.1}),
        "crack.restitution: 1.1 is out of range; give a value of at most 1",
    ),
    (dam(concrete={"poisson": 0.5}), "concrete.poisson: 0.5 is out of range; give a value below 0.5"),
    (dam(reservoir={"depth": "-1 m"}), 'reservoir.depth: "-1 m" is out of range; give a value of at least 0'),
    (dam(concrete={"modulus": "0 GPa"}), 'concrete.modulus: "0 GPa" is out of range; give a value above 0'),
    (
        dam(concrete={"density": "2.4 kg/m^3"}),
        'concrete.density: "2.4 kg/m^3" is out of range; give a value of at least 100 kg/m^3',
    ),
    (
        dam(crack={"side_gap": "2000 cm"}),
        'crack.side_gap[0]: "2000 cm" is out of range; give a value of at most 1000 cm',
    ),
    (
        dam(flexible={"damping": "thesys"}),
        'flexible.damping: "thesys" is not a choice; choose "relative", "stiffness", "modal", "thesis" or '
        '"deformation"',
    ),
    (dam(motion={"file": ""}), 'motion.file: "" is of the wrong type; give a text that is not empty'),
    (
        dam(section=SECTION | polygon([(0, 0), (1, 0), (0, 1)])),
        'section.height: cannot stand beside "polygon"; keep one of them',
    ),
    (
        dam(section={"height": "100 m", "crest_width": "8 m"}),
        "section.base_width: is required but missing; "
        "give height, crest_width, base_width; or slopes, a polygon or a file",
    ),
    (
        dam(section={"height": "1 m", "crest_width": "1 m", "base_width": "1 m", "neck_width": "1 m"}),
        "section.neck_height: is required but missing; "
        "give height, crest_width, base_width, neck_height, neck_width; or slopes, a polygon or a file",
    ),
    (
        dam(section=SECTION | {"neck_height": "101 m"}),
        "section.neck_height: 101 m is above the crest, 100 m; give at most 100 m",
    ),
    (
        dam(section=polygon([(0, 0), (1, 0), (0, 0)]), reservoir=None),
        "section.polygon: has 2 different corners; give at least 3",
    ),
    (
        dam(section=polygon([(0, 0), (1, 1), (1, 0), (0, 1)]), reservoir=None),
        "section.polygon: the outline [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]] "
        "crosses or touches itself; give the corners in order around the section",
    ),
    (
        dam(section=polygon([(0, 0), (1, 0), (0, "1e300")])),
        "section.polygon: 1e+300 m is out of range; give a value from 1 mm to 10 km, the size of a dam",
    ),
    (
        dam(crack=CRACK | {"elevation": "100 m"}),
        "crack.elevation: 100 m is out of range; give a value from 0 m to below the crest at 100 m",
    ),
    (
        dam(
            section=polygon([(0, 0), (2, 0), (5, 4), (8, 0), (10, 0), (10, 100), (0, 100)]),
            crack=CRACK | {"elevation": "2 m"},
        ),
        "crack.elevation: the line at 2 m meets the section in several pieces; "
        "give an elevation with one piece of concrete",
    ),
    (
        dam(section=polygon([(0, 0), (9, 5), (9, 100), (0, 100)])),
        "crack.elevation: the section has no width at 0 m; give an elevation where it has one",
    ),
    (
        dam(crack=CRACK | {"inclination": "-5 deg"}),
        "crack.elevation: the crack starts at the base and falls downstream by 5 degrees, out of the section; "
        "an inclined crack that falls needs an elevation above the base, because its toe lies below its heel; "
        "or give crack.inclination of 0 deg or more",
    ),
    (
        dam(crack={}),
        "crack.friction: is required but missing; give friction, or both static_friction and kinetic_friction",
    ),
    (
        dam(crack={"kinetic_friction": 1.0}),
        "crack.static_friction: is required but missing; give friction, or both static_friction and kinetic_friction",
    ),
    (
        dam(crack={"friction": 1.0, "static_friction": 1.0}),
        'crack.friction: cannot stand beside "static_friction"; keep one of them',
    ),
    (
        dam(crack={"static_friction": 0.9, "kinetic_friction": 1.0}),
        "crack.static_friction: 0.9 is below kinetic_friction, 1; give at least 1",
    ),
    (
        dam(reservoir={"depth": "220 m"}),
        "reservoir.depth: 220 m is above twice the height of the dam, 200 m; give at most 200 m",
    ),
    (
        dam(tailwater={"depth": "201 m"}),
        "tailwater.depth: 201 m is above twice the height of the dam, 200 m; give at most 200 m",
    ),
    (
        dam(uplift={"extent": 0.5}),
        'uplift.extent: does not belong to the pattern "triangular"; remove it or choose the pattern "cut-off"',
    ),
    (
        dam(uplift={"pattern": "drained", "drain_position": 0.1}),
        'uplift.drain_efficiency: is required by the pattern "drained"; give it, or make another choice',
    ),
    (
        dam(uplift={"pattern": "profile", "points": [[0, "9 m"], [0.9, "0 m"]]}),
        "uplift.points: the distances [0.0, 0.9] do not ascend; give them from the heel at 0 to the toe at 1",
    ),
    (dam(motion={"pga": "1 g"}), "motion: has no source; give file or points"),
    (dam(motion=FILE | PULSE), 'motion.file: cannot stand beside "points"; keep one of them'),
    (
        dam(motion={"points": [["0 s", "1 g"], ["2 s", "1 g"], ["1 s", "0 g"]]}),
        "motion.points: the times [0.0, 2.0, 1.0] do not ascend; give at least two points in order of time",
    ),
    (
        dam(motion=PULSE | {"unit": "g"}),
        "motion.unit: does not belong to a motion given by points; remove it, or give file instead of points",
    ),
    (
        dam(motion=FILE | {"unit": "m"}),
        'motion.unit: "1 m" is not an acceleration; write for example "0.4 g"',
    ),
    (
        dam(motion={"points": [["0 s", "1 g"], ["1 s", "-11 g"]]}),
        "motion.points[1][1]: -11 g is out of range; give a value from -10 g to 10 g",
    ),
    (
        dam(motion={"points": [["1 s", "1 g"], ["1 s", "2 g"]]}),
        "motion.points: the times [1.0, 1.0] do not ascend; give at least two points in order of time",
    ),
    (
        dam(motion={"points": [["-1 s", "1 g"], ["1 s", "2 g"]]}),
        'motion.points[0][0]: "-1 s" is out of range; give a value of at least 0',
    ),
    (
        dam(motion=FILE | {"at": "rock"}),
        'motion.at: "rock": the models take the motion of the free surface, not one within the rock; '
        "give the record as it was before any deconvolution",
    ),
    (
        dam(motion=FILE | {"pga": "11 g"}),
        "motion.pga: 11 g is out of range; give a value above 0 g and up to 10 g",
    ),
    (
        dam(motion=FILE | {"pga": "0 cm/s^2"}),
        "motion.pga: 0 m/s^2 is out of range; give a value above 0 g and up to 10 g",
    ),
    (
        dam(crack={"friction": 11, "restitution": 2}, reservoir={"depth": "1"}),
        "crack.friction: 11 is out of range; give a value of at most 10",
    ),
    (
        dam(crack={"friction": 10**5000}),
        "crack.friction: what is there is not a finite number; write for example 1.0",
    ),
    ({1: 2} | DAM, "[1]: 1 cannot be used (Keys should be strings); see the documentation of the case file"),
    (
        {"crack": {"friction": 1, "elevation": 1}},
        "section: is required but missing; add for example [section]",
    ),
]


@pytest.mark.parametrize(("fields", "message"), REFUSED)
def test_refused(fields, message):
    with pytest.raises(InputError) as caught:
        read_case(fields)
    assert str(caught.value) == message


FILES = [
    (b"title = ", "case-file-syntax", "is not valid TOML: "),
    (b"a" + b".a" * 20_000 + b" = 1", "case-file-syntax", "a key of more than 50 parts (at line 1)"),
    (b'title = "..."\nx = {' + b'"a" . ' * 50 + b"a = 1}", "case-file-syntax", "more than 50 parts (at line 2)"),
    (b'{"title": }', "case-file-syntax", "is not valid JSON: "),
    (b'{"a":' * 100_000, "case-file-syntax", "is not valid JSON: "),
    ('title = "x"'.encode("utf-16"), "source-unreadable", "(it is not UTF-8 text); give a file in UTF-8"),
    ('title = "Zürich"'.encode("latin-1"), "source-unreadable", "(it is not UTF-8 text); give a file in UTF-8"),
    (b"", "missing-field", "section: is required but missing; "),
    (b"0.1 0.2 0.3\n", "case-file-syntax", "is not valid TOML: "),
]


@pytest.mark.parametrize(("content", "code", "words"), FILES)
def test_refused_files(tmp_path, content, code, words):
    with pytest.raises(InputError) as caught:
        read_case(write(tmp_path / "case.toml", content))
    assert caught.value.code == code
    assert words in str(caught.value)


def test_refused_paths(tmp_path):
    with pytest.raises(InputError, match=r"nowhere\.toml: there is no such file; give the path of a case file"):
        read_case(tmp_path / "nowhere.toml")
    with pytest.raises(InputError, match=r"cannot be read \(Is a directory\)"):
        read_case(tmp_path)
    with pytest.raises(InputError, match="cannot be read"):
        read_case("a\0b")


@pytest.mark.parametrize("override", ["crack.friction", "=1", "crack..friction=1", ".=", ""])
def test_refused_overrides(override):
    with pytest.raises(
        InputError, match=r"^--set: .* is not a change of a field, PATH=VALUE; write for example crack\.friction=1\.0$"
    ):
        read_case(DAM, [override])


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("crack.fricton=1", 'crack.fricton: no such field; did you mean "friction"?'),
        ("title.x=1", 'title.x: no such field; "title" has no fields'),
        ("motion.pga=35", 'motion.pga: 35 has no unit; write for example "0.35 g" or "35 %g"'),
        ("motion.pga=0.35", 'motion.pga: 0.35 has no unit; write for example "0.35 g"'),
        ("motion.pga=3500", 'motion.pga: 3500 has no unit; write for example "0.4 g"'),
        ("reservoir.depth=95", 'reservoir.depth: 95 has no unit; write for example "95 m"'),
        ("crack.friction=nan", "crack.friction: NaN is not a finite number; write for example 1.0"),
        (
            "crack.friction=" + "9" * 5000,
            'crack.friction: "' + "9" * 56 + "... is not a finite number; write for example 1.0",
        ),
        ("crack.friction=2020-01-01", 'crack.friction: "2020-01-01" is not a number; write for example 1.0'),
        ("crack.friction=1\ntitle=2", 'crack.friction: "1\\ntitle=2" is not a number; write for example 1.0'),
    ],
)
def test_override_that_is_wrong(override, message):
    with pytest.raises(InputError) as caught:
        read_case(dam(title="T"), [override])
    assert str(caught.value) == message


anything = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(max_size=8),
        st.sampled_from(["1 m", "0.1 g", "2 s", "1e300 m", "1e-300 m", "-1e308 m"]),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.dictionaries(st.sampled_from(["depth", "file", "points", "friction", "polygon", "x"]), inner, max_size=3),
    ),
    max_leaves=8,
)


@pytest.mark.slow
@given(st.dictionaries(st.sampled_from(list(Case.model_fields)), anything, max_size=3))
def test_any_fields_are_read_or_refused_in_words(changes):
    assert "\n" not in str(refusal(DAM | changes))


@given(st.binary(max_size=60))
def test_any_file_is_refused_in_words(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "any.toml"
    with pytest.raises(InputError):
        read_case(write(path, content))


@given(st.text(max_size=20), st.text(max_size=20))
def test_any_override_is_refused_in_words(name, value):
    for override in (f"{name}={value}", f"crack.{name}={value}", f"crack.friction={value}", name):
        assert str(refusal(DAM, [override]))

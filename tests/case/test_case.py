"""The case: what is read, defaults, overrides, warnings, examples, schema."""

import copy
import json
import math
import pickle
import re
from pathlib import Path

import pytest

from heeltoe.case.fields_file import read_fields
from heeltoe.case.paths import quantity_of
from heeltoe.case.plausible import PLAUSIBLE
from heeltoe.case.read import case_schema, read_case
from heeltoe.case.warnings import case_warnings
from heeltoe.errors.error import InputError
from heeltoe.units.parse import STANDARD_GRAVITY, Acceleration, parse
from heeltoe.views.explain.fields import fields_of_a_case
from heeltoe.warnings.notice import CATALOGUE
from shared.cases import DAM, dam, write
from shared.dams import EXAMPLES as DIRECTORY
from shared.dams import PULSE, TYPICAL

NAMES = ["anchored", "block", "koyna", "koyna-top", "slender", "triangular", "typical-base", "typical-height"]
EXAMPLES = [DIRECTORY / f"{name}.toml" for name in NAMES]


def test_fields_arrive_in_si():
    case = read_case(
        dam(
            title="T",
            gravity="32.174 ft/s^2",
            concrete={"density": "2.65 t/m^3", "modulus": "20 GPa", "poisson": 0.143, "damping": "5 %"},
            motion={
                "file": "taft.txt",
                "pga": "0.4 g",
                "duration": "30s",
                "unit": "cm/s^2",
                "time_step": "20 ms",
            },
        )
    )
    assert case.gravity == pytest.approx(9.80665, rel=1e-5)
    assert (case.concrete.density, case.concrete.modulus, case.concrete.damping) == (2650.0, 20e9, 0.05)
    assert case.reservoir.depth == 95.0
    assert case.motion.pga == Acceleration(0.4, in_g=True)
    assert (case.motion.duration, case.motion.time_step, case.motion.unit) == (30.0, 0.02, "cm/s^2")
    assert case.section.vertices() == tuple(TYPICAL)


def test_defaults():
    case = read_case({"section": DAM["section"], "crack": {"friction": 1}})
    assert (case.title, case.gravity, case.concrete.density) == ("", 9.80665, 2400.0)
    assert (case.reservoir, case.tailwater, case.motion) == (None, None, None)
    assert (case.uplift.pattern, case.uplift.intensity) == ("triangular", 1.0)
    assert (case.crack.elevation, case.crack.restitution) == (0.0, 0.5)
    assert (case.analysis.paradox, case.analysis.event_limit) == ("stop", 1_000_000)
    flexible = case.flexible
    assert (flexible.plane, flexible.damping, flexible.virtual_mass, flexible.contact) == (
        "stress",
        "relative",
        "complete",
        "coulomb",
    )


def test_friction_in_either_form():
    one = read_case(dam(crack={"friction": 0.8})).crack
    assert (one.mu_static, one.mu_kinetic) == (0.8, 0.8)
    two = read_case(dam(crack={"static_friction": 0.9, "kinetic_friction": 0})).crack
    assert (two.mu_static, two.mu_kinetic) == (0.9, 0.0)


def test_section_without_neck_is_a_trapezoid():
    section = read_case(dam(section={"height": "100 m", "crest_width": "8 m", "base_width": "80 m"})).section
    assert section.vertices() == ((0, 0), (80, 0), (8, 100), (0, 100))


def test_motion_by_points_with_a_vertical_one():
    motion = read_case(dam(motion=PULSE | {"vertical": {"file": "up.txt", "reverse": True}})).motion
    assert motion.points[2] == (0.1, Acceleration(0.0, in_g=True))
    assert (motion.vertical.file, motion.vertical.reverse) == ("up.txt", True)


def test_overrides():
    overrides = [
        "crack.friction = 0.8",
        "reservoir.depth=90m",
        "tailwater.depth=5 m",
        "title=Other dam",
        "motion.reverse=true",
        'motion.vertical={file = "up.txt"}',
        "analysis.event_limit=10",
    ]
    fields = dam()
    before = copy.deepcopy(fields)
    case = read_case(fields, overrides)
    assert (case.crack.friction, case.reservoir.depth, case.tailwater.depth) == (0.8, 90.0, 5.0)
    assert (case.title, case.motion.reverse, case.motion.vertical.file) == ("Other dam", True, "up.txt")
    assert case.analysis.event_limit == 10
    assert fields == before


def test_override_displaces_the_other_form():
    points = 'motion.points=[["0 s", "0 g"], ["1 s", "1 g"]]'
    record = dam(motion={"file": "a.txt", "unit": "g", "time_step": "0.01 s", "pga": "1 g"})
    drawn = read_case(record, [points]).motion
    other = read_case(record, ["motion.file=b.txt"]).motion
    assert (other.file, other.unit, other.time_step) == ("b.txt", None, None)
    assert read_case(record, ["motion.unit=m/s^2", "motion.file=b.txt"]).motion.unit == "m/s^2"
    assert (drawn.file, drawn.unit, drawn.time_step, drawn.pga) == (
        None,
        None,
        None,
        Acceleration(1.0, in_g=True),
    )
    assert read_case(dam(motion=PULSE), ["motion.file=a.txt"]).motion.points is None
    pair = dam(crack={"static_friction": 1, "kinetic_friction": 1})
    assert read_case(pair, ["crack.friction=0.5"]).crack.mu_static == 0.5
    cut_off = dam(uplift={"pattern": "cut-off", "extent": 0.5})
    assert read_case(cut_off, ["uplift.pattern=uniform"]).uplift.extent is None
    # Two overrides do not displace one another, in whatever order.
    drained = ["uplift.extent=0.4", "uplift.pattern=cut-off"]
    assert read_case(cut_off, drained).uplift.extent == 0.4
    with pytest.raises(InputError, match="cannot stand beside"):
        read_case(DAM, [points, "motion.file=a.txt"])


def test_json_and_toml_and_byte_order_mark(tmp_path):
    expected = read_case(DAM)
    as_json = write(tmp_path / "case.txt", "\ufeff  " + json.dumps(DAM))
    assert read_case(as_json).model_dump() == expected.model_dump()
    text = '\ufefftitle = "x"\r\n[crack]\r\nfriction = 1.0\r\n[section]\r\nheight = "9 m"\r\n'
    text += 'crest_width = "1 m"\r\nbase_width = "5 m"'
    assert read_case(str(write(tmp_path / "case", text))).title == "x"


def test_case_knows_its_directory(tmp_path):
    case = read_case(write(tmp_path / "case.json", json.dumps(DAM)))
    assert case.base_directory == tmp_path
    assert read_case(DAM).base_directory == Path()
    assert pickle.loads(pickle.dumps(case)).base_directory == tmp_path
    assert case.based_in(Path("x")).base_directory == Path("x")
    assert case.base_directory == tmp_path


def test_case_cannot_be_changed():
    case = read_case(DAM)
    with pytest.raises(ValueError, match="frozen"):
        case.crack.friction = 2.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"crack": {"friction": 2.5}}, "coefficient of friction of 2.5"),
        ({"uplift": {"intensity": 1.5}}, "uplift.intensity: 1.5"),
        ({"concrete": {"density": "150 kg/m^3"}}, "150 kg/m^3 is unusual"),
        ({"gravity": "32.2 m/s^2"}, "gravity: 32.2 m/s^2 is not that of the earth, 9.807 m/s^2: check its unit"),
        ({"concrete": {"modulus": "100 GPa"}}, "concrete.modulus: 100 GPa is not that of concrete"),
        ({"concrete": {"modulus": "20 MPa"}}, "concrete.modulus: 0.02 GPa is not that of concrete"),
        ({"concrete": {"damping": 0.2}}, "concrete.damping: 20 % is more than a dam has"),
        ({"concrete": {"damping": 0.99}}, "concrete.damping: 99 % is more than a dam has"),
        ({"motion": {"file": "taft.txt", "pga": "0.4 m/s^2"}}, "motion.pga: 0.041 g is hardly felt"),
        ({"motion": {"file": "taft.txt", "pga": "0.4 ft/s^2"}}, "motion.pga: 0.012 g is hardly felt"),
        ({"gravity": "9.81 ft/s^2"}, "gravity: 2.99 m/s^2 is not that of the earth"),
        (
            {"reservoir": {"depth": "95 m", "density": "700 kg/m^3"}},
            "reservoir.density: 700 kg/m^3 is unusual for water",
        ),
        (
            {"tailwater": {"depth": "9 m", "density": "1.5 t/m^3"}},
            "tailwater.density: 1500 kg/m^3 is unusual for water",
        ),
        ({"tailwater": {"depth": "9 m"}, "crack": {"friction": 1.0, "elevation": "9 m"}}, "tailwater: it ends below"),
        ({"tailwater": {"depth": "96 m"}}, "deeper downstream"),
        ({"crack": {"friction": 1.0, "elevation": "96 m"}}, "reservoir: it ends below the crack"),
        ({"silt": {"depth": "96 m"}}, "silt is higher than the water"),
        # 85 and 120 lb/ft^3, the fluids of USBR for silt and water together.
        ({"silt": {"depth": "20 m", "horizontal_density": "85 lb/ft^3"}}, "seem to include the water"),
        ({"silt": {"depth": "20 m", "vertical_density": "120 lb/ft^3"}}, "seem to include the water"),
    ],
)
def test_warnings(changes, words):
    assert case_warnings(read_case(DAM)) == ()
    (warning,) = map(str, case_warnings(read_case(dam(**changes))))
    assert words in warning


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_sound_and_survive_json(path):
    case = read_case(path)
    # Its tailwater presses on the elastic part below the crack.
    assert {case_warning.code for case_warning in case_warnings(case)} <= (
        {"below-crack"} if path.stem == "anchored" else set()
    )
    assert case.title
    again = read_case(json.loads(case.model_dump_json(exclude_none=True)))
    assert again.model_dump() == case.model_dump()


def test_examples_hold_the_dams_of_the_thesis():
    cases = {path.stem: read_case(path) for path in (*EXAMPLES, *sorted((DIRECTORY / "thesis").glob("*.toml")))}
    base, top = cases["typical-base"], cases["typical-height"]
    assert base.section == top.section
    assert (base.concrete.density, base.concrete.modulus, base.reservoir.depth) == (2650.0, 20e9, 100.0)
    assert (base.flexible.damping, top.flexible.virtual_mass, top.crack.elevation) == (
        "thesis",
        "thesis",
        90.0,
    )
    triangle = cases["triangular"]
    assert triangle.section.vertices()[1][0] == pytest.approx(0.8 * triangle.reservoir.depth)
    assert triangle.uplift.intensity == 0.5
    assert cases["koyna-top"].crack.elevation == cases["koyna-top"].section.neck_height
    assert cases["block"].reservoir is None


def test_schema_describes_every_field():
    schema = case_schema()
    json.dumps(schema)
    for block in [schema, *schema["$defs"].values()]:
        assert block["additionalProperties"] is False
        for name, field in block["properties"].items():
            assert field.get("description"), name
    assert schema["$defs"]["Concrete"]["properties"]["density"]["default"] == "2400 kg/m^3"
    assert schema["required"] == ["section"]
    assert schema["oneOf"] == [{"required": [name]} for name in ("cracks", "crack", "joints")]
    assert schema["properties"]["cracks"]["items"]["$ref"] == schema["properties"]["crack"]["$ref"]


def test_a_dam_of_a_metre_is_warned_of():
    """A block without water may be one in a laboratory."""
    small = {"section": {"polygon": [["0 m", "0 m"], ["0.8 m", "0 m"], ["0 m", "1 m"]]}}
    wet = dam(**small, reservoir={"depth": "0.9 m"})
    assert [notice.code for notice in case_warnings(read_case(wet))] == ["value-unusual"]
    assert not case_warnings(read_case({**small, "crack": {"friction": 0.7}}))


@pytest.mark.parametrize(("path", "rule"), PLAUSIBLE.items())
def test_each_range_is_explained(path, rule):
    """`heeltoe explain` shows the ends by which the warning is made."""
    (meaning,) = [field for field in fields_of_a_case() if field.name == path]
    assert "warned of" in meaning.limits
    ends = re.findall(r"[\d.]+(?: [A-Za-z/³²]+)?", meaning.limits.partition("warned of")[2].replace(" to", ","))
    dimension = quantity_of(path) or "number"
    scale = STANDARD_GRAVITY if rule.unit == "g" else 1.0
    expected = [end * scale for end in (rule.low, rule.high) if math.isfinite(end)]
    numbers = [parse(end.translate({179: "^3", 178: "^2"}), dimension, path) for end in ends]
    assert numbers == pytest.approx(expected)
    assert CATALOGUE["value-unusual"][0] == "caution"
    assert f"{{{rule.quantity}:" in rule.sentence


@pytest.mark.parametrize(
    ("line", "wrong"),
    [
        ("friction = 1_0", "1_0"),
        ("friction = 1_00 # text", "1_00"),
        ('x = ["1_0", 10_00]', "10_00"),
        ("a = {b=1_0}", "1_0"),
    ],
)
def test_underscores_part_thousands_alone(tmp_path, line, wrong):
    (tmp_path / "case.toml").write_text(line)
    with pytest.raises(InputError, match=f"{wrong} is no number") as refused:
        read_fields(tmp_path / "case.toml")
    assert refused.value.code == "case-file-syntax"


def test_underscores_where_they_mean_something(tmp_path):
    text = 'a = 1_000\nb = "1_0" # 1_0\nc_1_0 = \'1_0\'\nd = """\n1_0\n"""\ne = -12_345_678\n'
    (tmp_path / "case.toml").write_text(text)
    assert read_fields(tmp_path / "case.toml") == {"a": 1000, "b": "1_0", "c_1_0": "1_0", "d": "1_0\n", "e": -12345678}
    with pytest.raises(InputError, match='"1_0" is not a number'):
        read_case(DAM, ["crack.friction=1_0"])


@pytest.mark.parametrize(
    "text", ['title = "a\\u0000b"', '{"title": "a\\u0000b"}', '{"a\\u0000": 1}', 'a = ["\\u0000"]']
)
def test_a_text_holds_no_nul(tmp_path, text):
    (tmp_path / "case").write_text(text)
    with pytest.raises(InputError, match="U\\+0000"):
        read_fields(tmp_path / "case")

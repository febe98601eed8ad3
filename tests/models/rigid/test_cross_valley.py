"""Shaking across the valley: slips of independent programs, what goes with it, and what says that it is left out."""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe import InputError, read_case, run
from heeltoe.case.combinations import check
from heeltoe.case.shaking import resolve_all
from heeltoe.kernel.block import block, run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.run import rigid
from heeltoe.motion.records.read import read_record
from heeltoe.study.plan.file import Study
from heeltoe.study.run.run import run_study
from heeltoe.study.run.suite import run_suite
from heeltoe.study.small.spread import with_spread
from models.rigid.test_varying import rectangle

G = 9.80665
MASS = 10_706_000.0
WITH_WATER = 16_539_333.0 + 1.0 / 3.0


def typical(friction: float, kinetic: float | None = None) -> np.ndarray:
    """Return the typical dam with a full reservoir and full uplift as a block that only slides."""
    return block(
        {
            "mass_horizontal": WITH_WATER,
            "mass_vertical": MASS,
            "inertia": 1e12,
            "heel_distance": 1e4,
            "toe_distance": 1e4,
            "static_horizontal": 49_033_250.0,
            "static_vertical": -65_763_394.9,
            "per_horizontal_horizontal": -WITH_WATER,
            "per_vertical_vertical": -MASS,
            "friction_static": friction,
            "friction_kinetic": friction if kinetic is None else kinetic,
        }
    )


def el_centro(records, along: int, across: int, sign: int, peak: float, seconds: float | None = 30.0) -> Shaking:
    """Return both components scaled by one factor, straight between the samples, with 2 s of rest after them."""
    pair = [
        read_record(records / "ensemble" / f"imperial-valley-1940-elc-{name}.txt").acceleration
        for name in (along, across)
    ]
    factor = peak * G / np.abs(pair[0]).max()
    count = min(map(len, pair)) if seconds is None else round(seconds / 0.01) + 1
    time = np.arange(count) * 0.01
    x, y = (np.append(values[:count] * factor, [0.0, 0.0]) for values in pair)
    return Shaking(np.append(time, [time[-1], time[-1] + 2.0]), sign * x, cross=y)


def slips(numbers, shaking, gap: float = math.inf) -> tuple[float, float]:
    """Return the slips along and across at the end [mm]."""
    ran = run_block(numbers, shaking, np.empty(0), across=(MASS, gap, gap, 0.0, 0.0))
    assert ran.outcome == "ok"
    assert ran.summary.energy_residual < 1e-12
    return 1e3 * ran.summary.slip, 1e3 * ran.crossing.summary.slip


# Along, across, sign, peak [g], friction; slips along and across of an independent program [mm].
REFERENCE = [
    (180, 270, 1, 0.4, 1.0, 144.6053, -0.1729),
    (270, 180, 1, 0.4, 1.0, 481.4710, -29.2676),
    (180, 270, -1, 0.4, 1.0, 225.3276, 6.4145),
    (270, 180, -1, 0.4, 1.0, 394.3203, 33.4039),
    (180, 270, 1, 0.4, 1.2, 33.3761, 0.4206),
    (270, 180, 1, 0.4, 1.2, 83.9169, -5.2801),
    (180, 270, -1, 0.4, 1.2, 18.4118, 0.1397),
    (270, 180, -1, 0.4, 1.2, 61.2356, 18.1996),
    (180, 270, 1, 0.3, 1.0, 55.5199, 0.6076),
    (270, 180, 1, 0.3, 1.0, 161.8445, -9.8827),
    (180, 270, 1, 0.3, 1.2, 8.7803, -0.0240),
    (270, 180, 1, 0.3, 1.2, 21.3017, -1.4114),
    (180, 270, 1, 0.2, 1.0, 11.3368, 0.1091),
    (270, 180, 1, 0.2, 1.0, 27.0244, -0.8990),
    (180, 270, 1, 0.2, 1.2, 0.1612, -0.0039),
    (270, 180, 1, 0.2, 1.2, 0.2677, -0.0284),
]


@pytest.mark.parametrize(("along", "across", "sign", "peak", "friction", "x", "y"), REFERENCE)
def test_slips_of_el_centro_are_those_of_independent_programs(records, along, across, sign, peak, friction, x, y):
    ran = slips(typical(friction), el_centro(records, along, across, sign, peak))
    assert ran == pytest.approx((x, y), abs=6e-5)


def test_static_and_kinetic_friction_and_neighbours_are_those_of_independent_programs(records):
    whole = el_centro(records, 180, 270, 1, 0.4, None)
    assert slips(typical(1.0, 0.8), whole) == pytest.approx((933.997572, -9.728947), abs=1e-6)
    other = el_centro(records, 270, 180, 1, 0.4, None)
    for gap, slip in ((0.0, 356.378933), (0.001, 413.404277), (0.003, 427.988195), (0.01, 442.273203)):
        assert slips(typical(1.0), other, gap)[0] == pytest.approx(slip, abs=1e-6)


def test_the_vertical_motion_goes_with_it(records):
    # El Centro, up, from its fourth sample on, by the factor of the motion along the stream.
    up = read_record(records / "elcentro-1940-up-nga2.txt").acceleration
    shaking = el_centro(records, 180, 270, 1, 0.4)
    factor = 0.4 * G / np.abs(shaking_peak(records)).max()
    series = np.append(up[3 : 3 + 3001] * factor, [0.0, 0.0])
    for sign, slip in ((1, 134.6978), (-1, 173.2265)):
        moved = Shaking(shaking.time, shaking.horizontal, sign * series, cross=shaking.cross)
        assert slips(typical(1.0), moved)[0] == pytest.approx(slip, abs=6e-5)


def shaking_peak(records) -> np.ndarray:
    return read_record(records / "ensemble" / "imperial-valley-1940-elc-180.txt").acceleration


POINTS = [["0 s", "0 g"], ["0.2 s", "-0.9 g"], ["0.6 s", "0.9 g"], ["0.9 s", "-0.7 g"], ["1.2 s", "0 g"]]
ACROSS = [["0 s", "0 g"], ["0.3 s", "0.8 g"], ["0.5 s", "-0.9 g"], ["1 s", "0.6 g"], ["1.2 s", "0 g"]]


def slab(**more):
    """Return a slab that slides both ways."""
    motion = {"points": POINTS, "cross_valley": {"points": ACROSS}} | more.pop("motion", {})
    return rectangle(20.0, 1.0, 0.4, motion=motion, **more)


def test_a_run_says_what_the_shaking_across_the_valley_adds():
    response = rigid(read_case(slab()))
    across, alone = response.cross_valley, rigid(read_case(slab(motion={"cross_valley": "none"})))
    without = across.without_cross_valley
    assert without.residual_slip_m == alone.residual_slip_m
    assert without.factor == pytest.approx(response.residual_slip_m / alone.residual_slip_m, rel=1e-14)
    assert f"without it the dam slides {1e3 * abs(alone.residual_slip_m):.1f} mm" in response.to_json()["verdict"]
    assert response.to_json()["cross_valley"]["without_cross_valley"]["factor"] == without.factor
    histories = response.histories
    assert histories.slip_cross_m[-1] == across.residual_slip_cross_m
    assert histories.slip_cross_m.max() <= across.peak_slip_cross_left_m
    assert histories.slip_cross_m.min() >= across.peak_slip_cross_right_m
    assert across.slip_path_m >= np.hypot(np.diff(histories.slip_m), np.diff(histories.slip_cross_m)).sum() * (
        1 - 1e-12
    )
    friction = np.hypot(histories.friction_force_n, histories.friction_cross_n)
    normal = histories.normal_force_heel_n + histories.normal_force_toe_n
    assert (friction <= 0.4 * normal * (1.0 + 1e-9)).all()
    assert {"cross-valley-upright", "cross-valley-far"} <= {notice.code for notice in response.warnings}
    assert alone.to_json()["cross_valley"] is None
    assert "cross_valley_motion" not in alone.to_json()


def test_neighbours_stop_it():
    response = rigid(read_case(slab(crack={"side_gap": ["3 mm", "5 mm"]})))
    across = response.cross_valley
    assert across.peak_slip_cross_left_m <= 0.003
    assert across.peak_slip_cross_right_m >= -0.005
    assert across.side_contacts > 0
    assert across.time_at_side_s > 0.0
    assert across.side_contact_impulse_n_s > 0.0
    assert read_case(slab(crack={"side_gap": "3 mm"})).crack.side_gap == (0.003, 0.003)
    assert read_case(slab(crack={"side_gap": "free"})).crack.side_gap is None
    held = rigid(read_case(slab(crack={"side_gap": "0 mm"})))
    assert held.residual_slip_m == held.cross_valley.without_cross_valley.residual_slip_m
    with pytest.raises(InputError, match="side_gap"):
        read_case(slab(crack={"side_gap": "-3 mm"}))


def test_a_still_ground_across_gives_the_same_bits():
    still = {"cross_valley": {"points": [["0 s", "0 g"], ["1.2 s", "0 g"]]}}
    one, two = rigid(read_case(slab(motion={"cross_valley": "none"}))), rigid(read_case(slab(motion=still)))
    assert two.residual_slip_m == one.residual_slip_m
    assert all(np.array_equal(two.histories[name], values) for name, values in one.histories.items())


WEAKENING = {"name": "slip weakening", "peak_friction": 0.45, "residual_friction": 0.3, "slip": "60 mm"}
LAWS = [
    WEAKENING,
    WEAKENING | {"form": "exponential"},
    {"name": "speed weakening", "peak_friction": 0.45, "residual_friction": 0.3, "speed": "0.2 m/s"},
    {"name": "cohesion", "cohesion": "2 kPa", "residual_friction": 0.35, "slip": "50 mm"},
]


@pytest.mark.parametrize("law", LAWS)
def test_a_law_goes_by_path_and_speed_of_the_vector(law):
    case = read_case(slab()).with_({"crack.law": law})
    response = rigid(case)
    assert response.ok
    across, histories = response.cross_valley, response.histories
    assert response.friction_law.slip_path_m == pytest.approx(across.slip_path_m, rel=1e-12)
    assert across.slip_path_m > math.hypot(response.residual_slip_m, across.residual_slip_cross_m)
    assert response.energy.residual < 1e-10
    friction = np.hypot(histories.friction_force_n, histories.friction_cross_n)
    slides = np.hypot(histories.slip_velocity_m_s, histories.slip_cross_velocity_m_s) > 1e-6
    assert slides.sum() > 50
    assert friction[slides] == pytest.approx(histories.friction_strength_n[slides], rel=1e-9)
    assert (friction <= histories.friction_strength_n * (1.0 + 1e-9)).all()
    still = {"motion.cross_valley": {"points": [["0 s", "0 g"], ["1.2 s", "0 g"]]}}
    one, two = rigid(case.with_({"motion.cross_valley": "none"})), rigid(case.with_(still))
    assert two.residual_slip_m == one.residual_slip_m
    assert two.friction_law == one.friction_law
    assert all(np.array_equal(two.histories[name], values) for name, values in one.histories.items())


def test_uplift_changes_where_the_crack_opens_and_it_does_not_as_the_block_slides():
    dam = {
        "section": {"height": "40 m", "crest_width": "5 m", "base_width": "38 m"},
        "crack": {"friction": 0.6},
        "reservoir": {"depth": "25 m"},
        "motion": {"points": POINTS, "pga": "0.5 g", "cross_valley": {"points": ACROSS}},
    }
    constant = rigid(read_case(dam))
    assert constant.ok
    assert constant.residual_slip_m > 1e-3
    for rule in ("zero while open", "full while open", "follows opening"):
        changing = rigid(read_case(dam | {"uplift": {"during_shaking": rule}}))
        assert changing.residual_slip_m == constant.residual_slip_m
        assert changing.cross_valley.slip_path_m == constant.cross_valley.slip_path_m


def test_drains_that_slip_closes_go_on_where_the_motion_before_ends():
    dam = {
        "section": {"height": "40 m", "crest_width": "5 m", "base_width": "38 m"},
        "crack": {"friction": 0.6},
        "reservoir": {"depth": "30 m"},
        "uplift": {"pattern": "drained", "drain_x": "4 m", "drain_efficiency": 0.6},
        "statics": {"drain_diameter": "75 mm"},
        "motion": {"points": POINTS, "pga": "0.5 g", "cross_valley": {"points": ACROSS}},
        "aftershocks": [{"points": POINTS, "pga": "0.5 g", "pause": "2 s", "cross_valley": {"points": ACROSS}}],
    }
    response = rigid(read_case(dam))
    assert response.ok
    first, second = response.drainage_by_motion
    assert first == 1.0
    assert second < 1.0
    across, histories = response.cross_valley, response.histories
    assert histories.slip_cross_m[-1] == across.residual_slip_cross_m
    assert np.abs(np.diff(histories.slip_cross_m)).max() < 0.02
    stays = rigid(read_case({name: block for name, block in dam.items() if name != "statics"}))
    assert across.residual_slip_cross_m != stays.cross_valley.residual_slip_cross_m
    begins = response.motion.parts[1].begins
    before = histories.time_s <= begins
    assert histories.slip_cross_m[before] == pytest.approx(
        np.interp(histories.time_s[before], stays.histories.time_s, stays.histories.slip_cross_m), abs=1e-12
    )
    assert across.slip_path_m > abs(response.residual_slip_m)


def test_it_is_scaled_as_the_motion_along_the_stream_or_by_itself():
    case = read_case(slab(motion={"pga": "0.45 g"}))
    assert rigid(case).cross.pga == pytest.approx(0.45 * G)
    own = read_case(slab(motion={"pga": "0.45 g", "cross_valley": {"points": ACROSS, "pga": "0.2 g"}}))
    assert rigid(own).cross.pga == pytest.approx(0.2 * G)


def sines(strength: float) -> Shaking:
    """Return a sine along and another one across for a second, the latter so strong."""
    time = np.arange(401) * 0.005
    along = G * np.sin(4.0 * math.pi * time)
    across = strength * G * np.sin(6.0 * math.pi * time + 0.5)
    across[0] = 0.0
    along[201:] = across[201:] = 0.0
    return Shaking(time, along, cross=across)


def test_a_block_that_rocks_slides_as_independent_programs_say():
    mass = 15_000.0
    numbers = {
        "mass_horizontal": mass,
        "mass_vertical": mass,
        "inertia": mass * 13.0 / 12.0,
        "height": 1.5,
        "heel_distance": 1.0,
        "toe_distance": 1.0,
        "static_vertical": -mass * G,
        "per_horizontal_horizontal": -mass,
        "per_vertical_vertical": -mass,
    }
    for friction, strength, x, y, up, down in (
        (0.6, 0.8, -23.136558856, 6.672569229, 0.0, 0.0),
        (0.8, 0.5, 4.92780, 3.0468, 0.0359852, 0.0411941),
    ):
        rough = block(numbers | {"friction_static": friction, "friction_kinetic": friction})
        ran = run_block(rough, sines(strength), np.empty(0), across=(mass, math.inf, math.inf, 0.0, 0.0))
        assert (1e3 * ran.summary.slip, 1e3 * ran.crossing.summary.slip) == pytest.approx((x, y), abs=2e-5)
        assert (ran.summary.rotation_max, -ran.summary.rotation_min) == pytest.approx((up, down), abs=1e-7)
        assert ran.summary.energy_residual < 1e-13


def test_a_block_that_rocks_has_all_numbers_and_histories():
    slender = rectangle(1.0, 4.0, 0.9, motion={"points": POINTS, "cross_valley": {"points": ACROSS}})
    response = rigid(read_case(slender))
    assert response.outcome == "ok"
    assert response.rocking_downstream_rad > 0.0
    histories = response.histories
    friction = np.hypot(histories.friction_force_n, histories.friction_cross_n)
    normal = histories.normal_force_heel_n + histories.normal_force_toe_n
    assert (friction <= 0.9 * normal * (1.0 + 1e-9) + 1e-6).all()
    by_mode = response.slip_by_mode_m
    moved = by_mode.sliding + by_mode.slide_rocking + by_mode.drifting
    assert moved == pytest.approx(response.residual_slip_m, abs=1e-12)
    assert response.energy.residual < 1e-12


@pytest.mark.parametrize(
    "changes",
    [
        {"crack": {"inclination": "5 deg"}},
        {"crack": {"law": {"name": "barton-bandis", "jrc": 8, "jcs": "10 MPa", "residual_angle": "28 deg"}}},
        {"crack": {"roughness": {"asperity_height": "5 mm", "wave_length": "200 mm"}}},
        {"analysis": {"rotation": "finite"}},
    ],
)
def test_what_a_block_does_not_do_with_it_is_refused(changes):
    fields = slab(**changes)
    if "law" in fields["crack"]:
        del fields["crack"]["friction"]
    case = read_case(fields)
    with pytest.raises(InputError, match="shaking across the valley"):
        check(case, "rigid")


def test_aftershocks_bring_their_own_motion_across_the_valley():
    alone = rigid(read_case(slab()))
    second = {"points": [[time, value.replace("-", "") if "-" in value else f"-{value}"] for time, value in POINTS]}
    case = read_case(slab(aftershocks=[second | {"pause": "2 s", "cross_valley": {"points": ACROSS}}]))
    response = rigid(case)
    assert len(response.sequence) == 2
    assert response.sequence[0].residual_slip_m == pytest.approx(alone.residual_slip_m, rel=1e-12)

    def twice(one, other):
        later = [[f"{float(time.split()[0]) + 3.2!r} s", value] for time, value in other]
        return [*one, *later]

    joined = {"points": twice(POINTS, second["points"]), "cross_valley": {"points": twice(ACROSS, ACROSS)}}
    whole = rigid(read_case(slab(motion=joined)))
    assert response.residual_slip_m == pytest.approx(whole.residual_slip_m, rel=1e-9)
    assert response.cross_valley.residual_slip_cross_m == pytest.approx(
        whole.cross_valley.residual_slip_cross_m, rel=1e-9
    )
    # An aftershock along the stream alone leaves the place across the valley as it is.
    along = rigid(read_case(slab(aftershocks=[second | {"pause": "2 s"}])))
    assert along.cross_valley.residual_slip_cross_m == pytest.approx(
        alone.cross_valley.residual_slip_cross_m, rel=1e-12
    )
    assert along.cross.parts[0].name == alone.cross.name


def test_tables_and_maps_refuse_it():
    for user in ("decoupled", "table", "map", "rotation", "motions"):
        with pytest.raises(InputError, match="shaking across the valley"):
            check(read_case(slab()), user)


def test_another_motion_beside_it_is_refused_or_comes_without_it():
    case = read_case(slab())
    with pytest.raises(InputError) as refused:
        case.with_({"motion.points": [["0 s", "0 g"], ["0.2 s", "0.5 g"], ["0.4 s", "0 g"]]})
    assert refused.value.code == "vertical-of-another"
    alone = rigid(case, rigid(case).motion)
    assert alone.cross is None
    assert "motion.cross_valley" in {notice.field for notice in alone.warnings}


def test_an_elastic_dam_follows_it_beside_its_block():
    elastic = slab(
        concrete={"modulus": "20 GPa"}, rock="rigid", flexible={"elements_across": 2, "evidence": "none", "modes": 4}
    )
    response = run(read_case(elastic), "rigid,flexible")
    for part in (response, response.beside):
        assert part.cross_valley.without_cross_valley.factor > 1.0
        assert "The shaking across the valley adds" in part.to_json()["verdict"]


def write_pair(directory, event: str = "quake", seed: int = 3) -> list[str]:
    """Write the two components of a made earthquake and return their files."""
    rng = np.random.default_rng(seed)
    envelope = np.sin(np.linspace(0.0, np.pi, 400))
    files = [directory / f"{event}-{name}.txt" for name in ("000", "090")]
    for file in files:
        values = "\n".join(f"{value:.6f}" for value in 0.8 * envelope * rng.normal(size=400))
        file.write_text(f"# time step: 0.01 s\n# units: [g]\n{values}\n")
    return [str(file) for file in files]


def test_a_suite_of_pairs_answers_in_both_assignments_with_the_factor_of_each_record(tmp_path):
    pairs = [write_pair(tmp_path, f"quake{number}", number) for number in range(2)]
    plain = rectangle(20.0, 1.0, 0.4)
    suite = {"suite": {"cross_valley": True, "pga": "0.9 g"}, "motions": [{"file": str(tmp_path)}]}
    (answer,) = run_suite(read_case(plain | suite), model="rigid").suite.models
    assert [record.motion for record in answer.records] == ["quake0-000", "quake0-090", "quake1-000", "quake1-090"]
    for record, (along, across) in zip(
        answer.records, (files for pair in pairs for files in (pair, pair[::-1])), strict=True
    ):
        motion = {"file": along, "sign": record.sign, "pga": "0.9 g"}
        alone = rigid(read_case(plain | {"motion": motion}))
        both = rigid(read_case(plain | {"motion": motion | {"cross_valley": {"file": across}}}))
        assert record.residual_slip_m == abs(both.residual_slip_m)
        assert record.without_cross_valley_slip_m == abs(alone.residual_slip_m)
        factor = record.residual_slip_m / record.without_cross_valley_slip_m
        assert record.cross_valley_factor == pytest.approx(factor, rel=1e-14)
    (tmp_path / "quake1-090.txt").unlink()
    with pytest.raises(InputError) as refused:
        run_suite(read_case(plain | suite), model="rigid")
    assert refused.value.code == "study-pair"


def test_a_suite_finds_the_worst_direction_of_each_pair(tmp_path):
    pairs = [write_pair(tmp_path, f"quake{number}", number) for number in range(2)]
    plain = rectangle(20.0, 1.0, 0.4)
    suite = {"suite": {"cross_valley": "45 deg", "pga": "0.9 g"}, "motions": [{"file": str(tmp_path)}]}
    results = run_suite(read_case(plain | suite), model="rigid")
    assert results.to_table().num_rows == 2 * 4 * 2 * 2
    (answer,) = results.suite.models
    assert [record.event for record in answer.records] == ["quake0", "quake1"]
    for record, (along, across) in zip(answer.records, pairs, strict=True):
        # One factor for all streams: the strongest of them has the peak.
        motion = {"file": along, "cross_valley": {"file": across}}
        cases = [
            read_case(plain | {"motion": motion | {"azimuth": f"{azimuth} deg", "sign": sign}})
            for azimuth in (0, 45, 90, 135)
            for sign in ("recorded", "reversed")
        ]
        peaks = [resolve_all(case)[0].pga for case in cases]
        slips = [
            abs(rigid(case.with_({"motion.pga": f"{0.9 * G * peak / max(peaks)!r} m/s^2"})).residual_slip_m)
            for case, peak in zip(cases, peaks, strict=True)
        ]
        assert record.residual_slip_m == pytest.approx(max(slips), rel=1e-9)
        assert record.azimuth_deg == 45.0 * (slips.index(max(slips)) // 2)
        assert record.motion == f"{record.event} at {record.azimuth_deg:g} deg"
        ratio = record.residual_slip_m / record.without_cross_valley_slip_m
        assert record.cross_valley_factor == pytest.approx(ratio, rel=1e-14)
    assert answer.statistics["residual_slip_m"]["largest"] == max(r.residual_slip_m for r in answer.records)


def test_a_suite_takes_a_share_of_the_peak_across_the_valley(tmp_path):
    along, across = write_pair(tmp_path)
    plain = rectangle(20.0, 1.0, 0.4)
    suite = {"suite": {"cross_valley": "30 %", "pga": "0.9 g"}, "motions": [{"file": str(tmp_path)}]}
    (answer,) = run_suite(read_case(plain | suite), model="rigid").suite.models
    for record, (one, other) in zip(answer.records, ((along, across), (across, along)), strict=True):
        cross = {"file": other, "pga": "30 %"}
        motion = {"file": one, "sign": record.sign, "pga": "0.9 g", "cross_valley": cross}
        assert record.residual_slip_m == pytest.approx(
            abs(rigid(read_case(plain | {"motion": motion})).residual_slip_m), rel=1e-9
        )
        assert record.azimuth_deg is None


def test_a_suite_that_a_block_cannot_follow_across_the_valley_is_refused_by_its_own_field(tmp_path):
    write_pair(tmp_path)
    asked = {"suite": {"cross_valley": True, "pga": "0.9 g"}, "motions": [{"file": str(tmp_path)}]}
    tilted = rectangle(20.0, 1.0, 0.4) | asked
    tilted["crack"] = tilted["crack"] | {"inclination": "5 deg"}
    with pytest.raises(InputError, match=r"suite\.cross_valley") as refused:
        run_suite(read_case(tilted), model="rigid")
    assert "motion.cross_valley" not in str(refused.value)


@pytest.mark.parametrize("value", ["35 deg", "0 deg", "-15 deg", "0.5 deg", "0 %", "-30 %", "15", "both"])
def test_how_components_go_together_is_a_share_or_a_step_of_the_half_circle(value):
    with pytest.raises(InputError) as refused:
        read_case(rectangle(20.0, 1.0, 0.4) | {"suite": {"cross_valley": value}})
    assert refused.value.field == "suite.cross_valley"


@pytest.mark.parametrize("count", [6, pytest.param(60, marks=pytest.mark.slow)])
def test_random_dams_under_all_three_components_close_their_books(count):
    rng = np.random.default_rng(29)
    ended = []
    for number in range(count):
        height, width = rng.uniform(20.0, 120.0), rng.uniform(0.5, 1.1)
        motion = {
            "pga": f"{rng.uniform(0.2, 0.6):.3f} g",
            "file": f"synthetic:M6,10km,seed={3 * number + 1}",
            "duration": "6 s",
            "sign": "recorded",
            "cross_valley": {"file": f"synthetic:M6,10km,seed={3 * number + 2}"},
            "vertical": {"file": f"synthetic:M6,10km,seed={3 * number + 3}", "pga": "0.2 g"},
        }
        dam = {
            "section": {
                "height": f"{height:.3f} m",
                "crest_width": f"{0.1 * height:.3f} m",
                "base_width": f"{width * height:.3f} m",
            },
            "crack": {"friction": float(rng.uniform(0.5, 1.6)), "side_gap": ("free", "3 mm")[number % 2]},
            "reservoir": {"depth": f"{rng.uniform(0.3, 0.9) * height:.3f} m"},
            "motion": motion,
        }
        if number % 3 == 2:
            # Weakens by its path or its speed from the same friction on.
            law, friction = LAWS[number // 3 % 3], dam["crack"].pop("friction")
            dam["crack"]["law"] = law | {"peak_friction": friction, "residual_friction": 0.8 * friction}
        response = rigid(read_case(dam))
        ended.append(response.outcome)
        if not response.ok:
            # A block is followed off a corner where its friction goes by no law.
            assert response.outcome != "lifts across" or number % 3 == 2, number
            continue
        across = response.cross_valley
        # A step errs by 1e-14 m in where the block stops: that is much where it slides a nanometre.
        assert response.energy.residual * across.slip_path_m < 1e-11 * across.slip_path_m + 1e-13, number
        assert all(np.isfinite(values).all() for values in response.histories.values()), number
        if response.time_by_mode_s.drifting == 0.0:
            slip = math.hypot(response.residual_slip_m, across.residual_slip_cross_m)
            assert across.slip_path_m >= slip * (1 - 1e-9)
        motion["cross_valley"] = motion["cross_valley"] | {"reverse": True}
        mirrored = rigid(read_case(dam))
        assert mirrored.residual_slip_m == response.residual_slip_m
        assert mirrored.cross_valley.residual_slip_cross_m == -across.residual_slip_cross_m
    assert set(ended) <= {"ok", "unstable", "lost", "keeps sliding", "large rotation", "lifts across"}
    assert ended.count("ok") > 0.3 * count, ended


def test_rows_of_a_study_are_runs_in_both_assignments(tmp_path):
    pair = write_pair(tmp_path)
    plain = rectangle(20.0, 1.0, 0.4)
    study = {
        "case": "slab",
        "model": "rigid",
        "method": "grid",
        "motions": {"events": [{"name": "quake", "horizontal": pair}], "cross_valley": True, "both_signs": False},
    }
    rows = run_study(Study.of(study, tmp_path), tmp_path / "out", case=read_case(plain)).to_table().to_pylist()
    assert len(rows) == 2
    for row, (along, across) in zip(rows, (pair, pair[::-1]), strict=True):
        motion = {"file": along, "sign": "recorded", "cross_valley": {"file": across}}
        response = run(read_case(plain | {"motion": motion}), "rigid")
        assert row["residual_slip_m"] == response.residual_slip_m
        assert row["outcome"] == response.outcome
    study["motions"]["events"][0]["horizontal"] = pair[:1]
    with pytest.raises(InputError) as refused:
        run_study(Study.of(study, tmp_path), tmp_path / "one", case=read_case(plain))
    assert refused.value.code == "study-pair"


def test_a_spread_keeps_it():
    case = read_case(slab())
    response = rigid(case)
    spread = with_spread(response, case, 3).spread
    assert spread.residual_slips_m[1] == response.residual_slip_m


@pytest.mark.parametrize("model", ["rigid", "both"])
@pytest.mark.parametrize("change", ["crack.inclination='2 deg'", "analysis.rotation='finite'"])
def test_a_run_refuses_a_block_that_is_not_followed_across(model, change):
    across = {"motion": {"points": POINTS, "cross_valley": {"points": ACROSS}}}
    case = read_case(rectangle(20.0, 4.0, 0.4) | across | {"concrete": {"modulus": "20 GPa"}}, [change])
    with pytest.raises(InputError) as refused:
        run(case, model)
    assert refused.value.field == "motion.cross_valley"

"""Disaggregations of OpenQuake: rates of bins, and the share of the hazard that a record stands for."""

from __future__ import annotations

from itertools import product

import pytest

import heeltoe
from heeltoe import InputError
from heeltoe.motion.disaggregation import read_disaggregation
from shared.command import command
from shared.dams import ROOT
from shared.downloads import peer, write

EXAMPLE = ROOT / "examples" / "block.toml"

#: Probabilities in 50 years of two branches of a logic tree, by magnitude and distance.
BRANCHES = (
    ((9.11901e-3, 2.1e-4, 0.0), (7.73248e-3, 2.43152e-5, 0.0), (3.50963e-3, 2.70884e-5, 1.5e-6)),
    ((1.2e-2, 4e-4, 1e-6), (6.1e-3, 9.3e-5, 0.0), (2.2e-3, 8.8e-5, 7e-6)),
)
EDGES = "mag_bin_edges=[5.0, 6.0, 7.0, 8.0], dist_bin_edges=[0.0, 25.0, 50.0, 100.0]"
#: Numbers of the mean rates of both branches, weights 0.6 and 0.4: the sum, shares, mean magnitude and distance, made
#: of to_rates of openquake.hazardlib.calc.mean_rates, OpenQuake 3.26.2.
RATE, MEAN = 0.00041628742630473765, (6.136483030542213, 12.979886105293508)
SHARES = (
    (0.4960773470366579, 0.013742679807917083, 1.9217500925373656e-05),
    (0.3413502467243329, 0.002488234042452904, 0.0),
    (0.14367243172555652, 0.0024720808642240554, 0.00017776229793316586),
)
#: Numbers of the first branch alone.
FIRST_RATE, FIRST_SHARE = 0.00041404205662814173, 0.3749633888665657


def table(columns=(0, 1), levels=(("PGA", 0.02),), years=50.0, comment=EDGES):
    """Return the file as OpenQuake 3.20 writes it."""
    weights = {1: "[1.0]", 2: "[0.6, 0.4]"}[len(columns)]
    about = f"generated_by='OpenQuake engine 3.20.0', investigation_time={years}, {comment}, weights={weights}"
    rows = [f'#,,,,,"{about}"', ",".join(["imt", "iml", "poe", "mag", "dist", *(f"rlz{k}" for k in columns)])]
    for (measure, poe), (m, mag), (d, dist) in product(
        levels, enumerate((5.5, 6.5, 7.5)), enumerate((12.5, 37.5, 75.0))
    ):
        cells = [f"{BRANCHES[k][m][d]:.5E}" for k in columns]
        rows.append(",".join([measure, "5.28951E-01", f"{poe:.5E}", f"{mag:.5E}", f"{dist:.5E}", *cells]))
    return "\n".join(rows) + "\n"


@pytest.fixture
def file(tmp_path):
    def written(text):
        (tmp_path / "Mag_Dist-0.csv").write_text(text, encoding="utf-8")
        return tmp_path

    return written


def test_rates_and_shares_are_those_of_openquake(file):
    found = read_disaggregation("Mag_Dist-0.csv", file(table()), "suite.disaggregation")
    assert found.rate == pytest.approx(RATE, rel=1e-6)
    for (m, mag), (d, dist) in product(enumerate((5.5, 6.5, 7.5)), enumerate((12.5, 37.5, 75.0))):
        assert found.share_of(mag, 1e3 * dist) == pytest.approx(SHARES[m][d], rel=1e-6)
    assert found.mean() == pytest.approx((MEAN[0], 1e3 * MEAN[1]), rel=1e-6)
    assert found.share_of(8.5, 10e3) == found.share_of(6.5, 200e3) == 0.0
    alone = read_disaggregation("Mag_Dist-0.csv", file(table((0,))), "suite.disaggregation")
    assert alone.rate == pytest.approx(FIRST_RATE, rel=1e-6)
    assert alone.share_of(6.5, 10e3) == pytest.approx(FIRST_SHARE, rel=1e-6)


def test_axes_beside_magnitude_and_distance_are_summed(file):
    head, names, *rows = table((0,)).splitlines()
    twice = [f"{row.rpartition(',')[0]},{eps},{row.rpartition(',')[2]}" for row in rows for eps in ("-1.5", "1.5")]
    text = "\n".join([head, names.replace(",rlz0", ",eps,rlz0"), *twice]) + "\n"
    found = read_disaggregation("Mag_Dist-0.csv", file(text), "suite.disaggregation")
    assert found.rate == pytest.approx(2.0 * FIRST_RATE, rel=1e-6)
    assert found.share_of(6.5, 10e3) == pytest.approx(FIRST_SHARE, rel=1e-6)


def test_one_of_several_levels_is_named(file):
    place = file(table(levels=(("PGA", 0.02), ("SA(0.2)", 0.02), ("PGA", 0.1))))
    found = read_disaggregation("Mag_Dist-0.csv#SA(0.2),0.02", place, "suite.disaggregation")
    assert found.rate == pytest.approx(RATE, rel=1e-6)
    for text in ("Mag_Dist-0.csv", "Mag_Dist-0.csv#PGA", "Mag_Dist-0.csv#PGV,0.02"):
        with pytest.raises(InputError, match=r"several of PGA,0\.02, SA\(0\.2\),0\.02, PGA,0\.1"):
            read_disaggregation(text, place, "suite.disaggregation")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "imt,poe,mag,dist,rlz0\nPGA,0.02,5.5,12.5,0.01\n",
        table(comment="mag_bin_edges=[5.0, 6.0]"),
        table().replace("9.11901E-03", "none"),
        table().replace("9.11901E-03", "1.0"),
        table().replace("weights=[0.6, 0.4]", "weights=[0.6]"),
        table().replace("mag,dist", "lon,lat"),
    ],
)
def test_a_file_that_is_none_is_refused(file, text):
    with pytest.raises(InputError, match=r"suite\.disaggregation: .*no disaggregation by magnitude and distance"):
        read_disaggregation("Mag_Dist-0.csv", file(text), "suite.disaggregation")


def test_records_of_a_suite_are_labelled(file):
    """The records of PEER's made-up download have magnitude 6.7 at 12.5 km."""
    place = file(table())
    write(place / "records", peer())
    case = heeltoe.read_case(EXAMPLE).with_({"suite.judge": "mean"}).based_in(place)
    with pytest.raises(InputError, match=r"suite\.disaggregation: there is no such file"):
        heeltoe.run_suite(case, place / "records", model="rigid", disaggregation="none.csv")
    suite = heeltoe.run_suite(case, place / "records", model="rigid", disaggregation=str(place / "Mag_Dist-0.csv"))
    shares = {record["hazard_share"] for record in suite.suite["models"][0]["records"]}
    assert list(shares) == pytest.approx([SHARES[1][0]], rel=1e-6)
    reply = command(
        *("run", EXAMPLE, "--motions", "records", "--model", "rigid"),
        *("--set", f"suite.disaggregation={place / 'Mag_Dist-0.csv'}"),
        cwd=place,
    )
    assert "of the hazard" in reply.stdout
    assert "0.34" in reply.stdout

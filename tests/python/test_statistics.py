"""Distributions of sigma: laws with known parameters are found again, sectors hold the rows they should, files say what is printed."""
import csv
import json

import numpy as np
import pytest

import raytube as rt
from raytube._statistics_command import main

stats = pytest.importorskip("scipy.stats")
DRAWS = 2000
SHARES = (np.arange(DRAWS) + 0.5) / DRAWS


def table(folder, levels, name="a.csv", **keys):
    """A result whose rows have these levels [dBsm]; azimuths 0, 1, 2 ... unless other keys are given."""
    keys = keys or {"phi_deg": np.arange(len(levels))}
    rows = zip(*keys.values(), levels)
    (folder / name).write_text("\n".join([",".join([*keys, "sigma_vv_dbsm"]), *(",".join(repr(float(x)) for x in row) for row in rows)]) + "\n")
    return folder / name


def quantiles(law):
    """Levels below which 1/2, 3/2, ... of n draws of a law of sigma lie."""
    return 10.0 * np.log10(law.ppf(SHARES))


def laws(result):
    return result.fits.set_index("law")


def test_exponential_draws_are_swerling_1(tmp_path):
    found = rt.statistics(table(tmp_path, quantiles(stats.expon(scale=3.0))))
    assert found.nearest_law("vv") == "Swerling I"
    fits = laws(found)
    assert fits.mean_m2["swerling_1"] == pytest.approx(3.0, abs=0.01)  # the tail above the last of the draws is missing
    assert fits.ks_distance["swerling_1"] < 2.0 / DRAWS  # half a step, and what the mean lacks
    assert fits.degrees_of_freedom["chi_square"] == pytest.approx(2.0, abs=0.01)
    # With x = sigma / mean the shares are 1 - e^-x and 1 - e^-2x (1 + 2 x),.
    x = np.linspace(0, 5, 100001)
    assert fits.ks_distance["swerling_3"] == pytest.approx(np.max(np.abs(np.exp(-2 * x) * (1 + 2 * x) - np.exp(-x))), abs=0.002)


@pytest.mark.parametrize(("freedom", "nearest"), [(4.0, "Swerling III"), (0.8, "chi-square"), (15.0, "chi-square")])
def test_degrees_of_freedom_are_found_again(tmp_path, freedom, nearest):
    found = rt.statistics(table(tmp_path, quantiles(stats.chi2(freedom, scale=0.01 / freedom))))
    assert found.nearest_law("vv") == nearest
    assert laws(found).degrees_of_freedom["chi_square"] == pytest.approx(freedom, rel=0.006)


def test_the_shape_is_the_likeliest(tmp_path):
    from scipy.special import digamma

    levels = quantiles(stats.gamma(1.7))
    shape, sigma = 0.5 * laws(rt.statistics(table(tmp_path, levels))).degrees_of_freedom["chi_square"], 10.0 ** (levels / 10.0)
    assert np.log(shape) - digamma(shape) == pytest.approx(np.log(sigma.mean()) - np.log(sigma).mean(), rel=1e-9)


def test_normal_decibels_are_log_normal(tmp_path):
    found = rt.statistics(table(tmp_path, stats.norm(-7.0, 6.0).ppf(SHARES)))
    fit = laws(found).loc["log_normal"]
    assert found.nearest_law("vv") == "log-normal"
    assert (fit.mean_of_db, fit.std_of_db) == pytest.approx((-7.0, 6.0), abs=0.02)
    assert 10.0 * np.log10(fit.mean_m2) == pytest.approx(-7.0 + 36.0 * np.log(10.0) / 20.0, abs=0.03)


def test_too_few_or_all_alike_have_no_law(tmp_path):
    assert rt.statistics(table(tmp_path, np.arange(9.0))).fits.empty
    assert rt.statistics(table(tmp_path, np.full(100, 3.0))).fits.empty
    levels = quantiles(stats.expon())
    whole = rt.statistics(table(tmp_path, levels)).fits
    assert rt.statistics(table(tmp_path, [*levels, -np.inf])).fits.equals(whole)  # a zero is left out


def test_summary_of_known_levels(tmp_path):
    row = rt.statistics(table(tmp_path, [10.0, 0.0, 20.0, -np.inf]), percentiles=(0, 50, 100)).table.iloc[0]
    assert (row.rows, row.mean_m2, row.median_dbsm, row.std_db) == (4, 111.0 / 4.0, 5.0, 10.0)
    assert (row.p0_dbsm, row.p50_dbsm, row.p100_dbsm) == (-np.inf, 5.0, 20.0)


def test_summary_of_an_exponential_law(tmp_path):
    row = rt.statistics(table(tmp_path, quantiles(stats.expon())), percentiles=[10]).table.iloc[0]
    assert row.median_dbsm == pytest.approx(10.0 * np.log10(np.log(2.0)), abs=1e-3)
    assert row.p10_dbsm == pytest.approx(10.0 * np.log10(-np.log(0.9)), abs=0.01)
    assert row.std_db == pytest.approx(10.0 / np.log(10.0) * np.pi / np.sqrt(6.0), abs=0.02)


def sectors(found):
    return found.table[found.table.from_deg.notna()]


def test_sectors_lie_within_a_sweep(tmp_path):
    found = sectors(rt.statistics(table(tmp_path, [0, 10, 20, 30, 40], theta_deg=[0, 1, 2, 3, 4]), sector_deg=2))
    assert list(found.median_dbsm) == [10, 20, 30] and list(found.rows) == [3, 3, 3]
    assert list(found.from_deg) == [0, 1, 2] and found.to_deg.iloc[-1] == 4


@pytest.mark.parametrize("last", [350, 360])
def test_sectors_run_on_over_the_ends_of_a_turn(tmp_path, last):
    phi = np.arange(0, last + 1, 10)  # the direction at 360 is that at 0, and counts once
    file = table(tmp_path, phi % 360 / 10.0, phi_deg=phi)
    first = sectors(rt.statistics(file, percentiles=(0, 100), sector_deg=20)).iloc[0]
    assert (first.rows, first.p0_dbsm, first.median_dbsm, first.p100_dbsm) == (3, 0.0, 1.0, 35.0)
    assert set(sectors(rt.statistics(file, sector_deg=360)).rows) == {36}


def test_each_cut_has_sectors_of_its_own(tmp_path):
    theta, phi = np.repeat([80, 90], 11), np.tile(np.arange(11), 2)
    found = sectors(rt.statistics(table(tmp_path, theta + 0.1 * phi, theta_deg=theta, phi_deg=phi), sector_deg=4))
    assert list(found.theta_deg.unique()) == [80, 90] and len(found) == 14 and found.phi_deg.isna().all()
    assert np.allclose(found.median_dbsm, found.theta_deg + 0.1 * (found.from_deg + 2))


def test_a_histogram_holds_every_row_once(tmp_path):
    histogram = rt.statistics(table(tmp_path, [*quantiles(stats.expon()), -np.inf])).histogram
    assert histogram.from_dbsm[0] == -np.inf and histogram.rows.sum() == DRAWS + 1
    edges = 10.0 ** (histogram[["from_dbsm", "to_dbsm"]].to_numpy() / 10.0)
    closed = np.exp(-edges[:, 0]) - np.exp(-edges[:, 1])
    assert np.abs(histogram.share - closed).max() < 2.0 / DRAWS and np.abs(histogram.swerling_1 - closed).max() < 2.0 / DRAWS
    assert rt.statistics(table(tmp_path, np.full(20, -np.inf))).histogram.empty


@pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")
def test_results_files_and_columns_of_others_agree(plate, tmp_path):
    result = rt.solve(plate, 10.0, rt.monostatic(theta_deg=90, phi_deg=np.arange(0, 60, 2)))
    result.save(tmp_path / "rcs.nc")
    whole = rt.statistics(result, only={"phi_deg": (10, 40)})
    assert rt.statistics(tmp_path / "rcs.nc", only={"phi_deg": (10, 40)}).table.equals(whole.table)
    assert whole.table.rows.iloc[0] == 16
    table(tmp_path, np.arange(12.0), "other.csv", az=np.arange(12))
    assert rt.statistics(tmp_path / "other.csv", columns={"phi_deg": "az*30"}, only={"phi_deg": (330, 390)}).table.rows.iloc[0] == 3


def test_files_and_json_say_the_same(tmp_path, capsys):
    file, out = table(tmp_path, quantiles(stats.expon())[::7][:286]), tmp_path / "out"
    assert main([str(file), "-o", str(out), "--window", "20", "--percentiles", "5,95"]) == 0
    assert "Swerling III" in capsys.readouterr().out
    assert sorted(path.name for path in out.iterdir()) == ["fits.csv", "histogram.csv", "statistics.csv", "statistics.png", "statistics.svg"]
    rows = {name: list(csv.DictReader(line for line in (out / f"{name}.csv").read_text().splitlines() if line[0] != "#")) for name in
            ("statistics", "fits", "histogram")}
    assert list(rows["statistics"][0]) == ["freq_hz", "theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg", "from_deg", "to_deg", "channel", "rows", "mean_m2",
                                           "mean_dbsm", "median_dbsm", "p5_dbsm", "p95_dbsm", "std_db"]
    assert main([str(file), "--json", "--percentiles", "5,95"]) == 0
    printed = json.loads(capsys.readouterr().out)["channels"]["vv"]
    assert rows["statistics"][0]["from_deg"] == "" and float(rows["statistics"][0]["p95_dbsm"]) == printed["p95_dbsm"]
    assert [fit["law"] for fit in rows["fits"]] == list(printed["laws"]) and float(rows["fits"][2]["ks_distance"]) == printed["laws"]["chi_square"]["ks_distance"]


@pytest.mark.parametrize(("arguments", "key"), [
    ("--only phi_deg=90:99 -o out", "widen --only"), ("--only phi=90", "--only phi=90"), ("--only theta_deg=90", "--only theta_deg"),
    ("--window 50 -o out", "39 degrees"), ("--window 5", "-o DIR"), ("--window 0 -o out", "--window"), ("--window -1 -o out", "--window"),
    ("--window 361 -o out", "--window"), ("--window nan -o out", "--window"), ("--percentiles 50,10", "--percentiles"), ("--percentiles=-1", "--percentiles"),
    ("--percentiles 101", "--percentiles"), ("--percentiles ten", "--percentiles"), ("--percentiles 10,,50", "--percentiles"),
    ("--widow 3", "did you mean --window"), ("--columns phi_deg=az", "--columns"), ("-o a.csv", "-o a.csv")])
def test_bad_input_is_one_sentence(tmp_path, monkeypatch, arguments, key):
    monkeypatch.chdir(tmp_path)
    table(tmp_path, np.sin(np.arange(40.0)))
    with pytest.raises(rt.InputError, match=key):
        main(["a.csv", *arguments.split()])
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_sectors_over_a_frequency_are_refused(tmp_path):
    with pytest.raises(rt.InputError, match="frequency"):
        rt.statistics(table(tmp_path, np.arange(20.0), freq_ghz=np.arange(1, 21)), sector_deg=5)


def test_a_picture_is_left_out_where_all_is_zero(tmp_path, capsys):
    assert main([str(table(tmp_path, np.full(20, -np.inf))), "-o", str(tmp_path / "out")]) == 0
    assert not list((tmp_path / "out").glob("*.png")) and "zero in every row" in capsys.readouterr().err

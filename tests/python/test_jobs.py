"""check, converge, image, trace, compare: what the program says of the same case."""
import re
from time import perf_counter

import numpy as np
import pytest
from conftest import CASES

import raytube as rt

pytestmark = pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")
CASE = CASES / "trihedral/case.toml"


def without_times(text):
    """Neither what was measured nor what memory is free at the moment."""
    text = re.sub(r"\ntime\n.*", "", text, flags=re.DOTALL)
    return re.sub(r"at most about .*?, .* with --parts", "", re.sub(r"; \S+ \S+ available", "", text))


def test_check_is_what_the_program_prints(program):
    report = rt.check(CASE, {"tubes.max_bounces": 2})
    assert without_times(repr(report)) == without_times(program("check", CASE, "--set", "tubes.max_bounces=2"))
    assert report["case"]["tubes"]["max_bounces"] == 2 and report["looks_computed"] > 0 and report["time"]["solve_s"] >= 0


def test_check_of_a_target(dihedral):
    report = rt.check(dihedral, 10.0, rt.monostatic(90, [0, 10]), edges={"order": 1})
    assert report["case"]["edges"]["order"] == 1 and report["looks_computed"] == 2
    assert report == rt.check(dihedral, ghz=10.0, looks=rt.monostatic(90, [0, 10]), edges={"order": 1}) | {"time": report["time"], "memory_bytes": report["memory_bytes"], "memory": report["memory"]}


def test_converge_is_the_table_of_the_program(program, tmp_path):
    case = CASES / "convergence/case.toml"
    study = rt.converge(case, densities=[2, 4, 8])
    printed = program("converge", case, "--densities", "2,4,8", "-o", tmp_path, "--set", "output.plots=false")
    table = np.genfromtxt([line for line in (tmp_path / "converge.csv").read_text().splitlines() if not line.startswith("#")],
                          delimiter=",", names=True)
    assert [entry["per_wavelength"] for entry in study["densities"]] == [2, 4, 8]
    assert [entry["tubes"] for entry in study["densities"]] == table["tubes"].tolist()
    for entry, row in zip(study["densities"], table):
        assert entry["S"].shape[2:] == (2, 2) and np.linalg.norm(entry["S"]) == pytest.approx(row["norm_m"], rel=1e-14)
        for ours, theirs in (("relative_change", "relative_change_to_next"), ("order", "observed_order"),
                             ("relative_error", "estimated_relative_error"), ("rms_db", "estimated_rms_db")):
            assert np.array_equal(entry[ours], row[theirs], equal_nan=True)
    assert re.search(r"^order .*\Z", repr(study), re.DOTALL | re.MULTILINE)[0].strip() in printed


def test_the_share_of_a_study_never_falls(dihedral):
    told = []
    study = rt.converge(dihedral, 94.0, rt.monostatic(90, np.arange(0, 8, 1.0)), densities=[4, 8, 16], edges={"method": "none"},
                        progress=told.append)
    assert told == sorted(told) and told[-1] == 1.0 and study["warnings"] == []


def test_cells_of_an_image_add_up(dihedral):
    looks = rt.monostatic(90, [10, 30])
    image = rt.image(dihedral, 10.0, looks, look=1)
    total = rt.solve(dihedral, 10.0, looks).S.values[1, 0]
    assert np.abs(image.S.sum(("u", "v")).values - total).max() <= 1e-12 * np.abs(total).max()  # as many roundings as cells
    assert image.u.attrs["units"] == "m" and image.attrs["frequency_hz"] == 10e9 and image.attrs["look"] == 1


def test_trace_is_what_the_program_prints(program):
    case = CASES / "dihedral/case.toml"
    found = rt.trace(case, look=0, u=0.01, v=0.02)
    printed = program("trace", case, "--look", "0", "--u", "0.01", "--v", "0.02")
    assert len(found["bounces"]) == len(re.findall(r"^ *bounce", printed, re.MULTILINE)) > 0
    printed_points = [[float(x) for x in point.split(",")] for point in re.findall(r"^ *point +\((.*)\) m$", printed, re.MULTILINE)]
    assert np.allclose([bounce["point_m"] for bounce in found["bounces"]], printed_points, rtol=1e-8, atol=1e-15)  # nine digits
    assert re.findall(r"triangle (\d+)", printed) == [str(bounce["triangle"]) for bounce in found["bounces"]]
    assert printed.rstrip().endswith(f"end: {found['end']}")


def test_compare_is_the_table_of_the_program(program, tmp_path):
    coarse, fine = (rt.run(CASE, {"edges.method": method, "look.phi_deg": {"start": 0, "stop": 90, "step": 5}}) for method in ("none", "fringe"))
    coarse.save(tmp_path / "a.csv")
    fine.save(tmp_path / "b.nc")
    comparison = rt.compare(tmp_path / "a.csv", tmp_path / "b.nc", within_db=30)
    assert repr(comparison) == program("compare", tmp_path / "a.csv", tmp_path / "b.nc", "--within-db", "30")
    direct = rt.compare(coarse, fine, within_db=30)
    assert direct.channels == comparison.channels and direct.relative_error == comparison.relative_error > 0
    copolar = rt.compare(tmp_path / "a.csv", fine, only={"phi_deg": 45})
    rms = max(channel["rms_db"] for channel in copolar.channels.values())
    assert not copolar.within(rms / 2) and (np.isinf(rms) or copolar.within(rms + 0.01))


def test_compare_of_some_rows(sweep):
    comparison = rt.compare(sweep, sweep, only={"freq_hz": 10e9, "phi_deg": (0, 20)})
    assert comparison.rows == 4 and comparison.relative_error == 0.0


def test_compare_with_columns_of_other_names(tmp_path):
    result = rt.run(CASE)
    table = result.to_dataframe()
    table["bearing"], table["RCS [dBsm]"] = -table.phi_deg, table.sigma_hh_dbsm
    table[["theta_deg", "bearing", "RCS [dBsm]"]].to_csv(tmp_path / "measured.csv", index=False)
    columns = {"phi_deg": "bearing*-1", "sigma_hh_dbsm": '"RCS [dBsm]"'}
    comparison = rt.compare(result, tmp_path / "measured.csv", reference_columns=columns)
    assert comparison.rows == len(table) and list(comparison.channels) == ["hh"] and comparison.channels["hh"]["largest_abs_db"] < 1e-9
    as_text = ",".join(f"{ours}={theirs}" for ours, theirs in columns.items())
    assert rt.compare(tmp_path / "measured.csv", result, result_columns=as_text).channels.keys() == {"hh"}
    with pytest.raises(rt.InputError, match="as in reference_columns sigma_vv_dbsm=NAME"):
        rt.compare(result, tmp_path / "measured.csv")


def test_compare_of_images(program, tmp_path):
    pixels = [(u, v, 2.0 * np.exp(-((u - 9.0)**2 + (v - 8.0)**2) / 12.5)) for v in range(18) for u in range(20)]
    for name, shift in (("a.csv", 2), ("b.csv", 0)):
        rows = [f"{u + shift},{v},{s},{0.1 * u}" for u, v, s in pixels]
        (tmp_path / name).write_text("\n".join(["u_m,v_m,mag,phase_vv_rad", *rows]) + "\n")
    names = {"magnitude_vv": "mag"}
    comparison = rt.compare(tmp_path / "a.csv", tmp_path / "b.csv", result_columns=names, reference_columns=names, within_db=15)
    assert repr(comparison) == program("compare", tmp_path / "a.csv", tmp_path / "b.csv", "--within-db", "15", "--result-columns",
                                       "magnitude_vv=mag", "--reference-columns", "magnitude_vv=mag", with_python=True)
    assert comparison.shift == pytest.approx((2.0, 0.0), abs=0.02) and comparison.rows >= 18 * 18
    unregistered = rt.compare(tmp_path / "a.csv", tmp_path / "b.csv", result_columns=names, reference_columns=names, register=False)
    assert unregistered.shift == (0.0, 0.0) and unregistered.channels["vv"]["ssim"] < comparison.channels["vv"]["ssim"]
    assert not unregistered.within(0.1)
    with pytest.raises(rt.InputError, match="only: images have no rows of looks"):
        rt.compare(tmp_path / "a.csv", tmp_path / "b.csv", result_columns=names, reference_columns=names, only={"phi_deg": 0})


def least(call, times):
    """The time of a call when nothing else wanted the processor [s]."""
    def once():
        start = perf_counter()
        call()
        return perf_counter() - start

    return min(once() for _ in range(times))


def test_a_call_costs_little(plate):
    """Two milliseconds are promised beside the solve itself, which takes a tenth of one here; 0.3 ms in all are usual."""
    assert least(lambda: rt.solve(plate, 10.0, rt.monostatic(10, 0), edges={"method": "none"}, threads=1), 200) < 0.002


def test_a_target_is_built_once(sphere):
    """Another crease angle is another target; the same one costs next to nothing to find again."""
    looks = rt.monostatic(90, 0)
    start = perf_counter()
    rt.trace(sphere, 1.0, looks, edges={"min_wedge_deg": 17.0})
    first = perf_counter() - start
    assert least(lambda: rt.trace(sphere, 1.0, looks, edges={"min_wedge_deg": 17.0}), 5) < first / 2  # a thousandth is usual

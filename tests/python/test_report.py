"""Reports: their data against the tables they are made from, numbers made small, pages, and bad input."""
import base64
import json
import re
import shutil
import struct

import numpy as np
import pytest

import raytube as rt
from raytube import InputError, Result, _core, _report, _report_command, _rows
from raytube.__main__ import main

from conftest import CASES

SWEEP = ["--parts", "--quiet", "--set", "output.plots=false", "--set", "frequency.ghz={start=2.5,stop=3.5,count=21}",
         "--set", "look.phi_deg={start=0,stop=90,step=1}", "--set", "output.image_look=3", "--set", "output.image_per_wavelength=2"]


@pytest.fixture(scope="module")
def folder(program, tmp_path_factory):
    out = tmp_path_factory.mktemp("run") / "out"
    program("run", CASES / "trihedral/case.toml", "-o", out, *SWEEP)
    return out


@pytest.fixture(scope="module")
def data(folder):
    return _report.data_of(folder / "rcs.csv", [])


def unpacked(text, kind):
    return np.frombuffer(base64.b64decode(text), kind)


def table(file):
    lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
    return dict(zip(lines[0].split(","), np.array([line.split(",") for line in lines[1:]]).T))


def rows_of(phi_deg, level_db, theta_deg=90.0):
    """One frequency, looks over phi, VV of these levels."""
    s = np.zeros((len(phi_deg), 1, 2, 2), complex)
    s[:, 0, 0, 0] = 10.0 ** (np.asarray(level_db) / 20.0) / np.sqrt(4.0 * np.pi)
    theta = np.broadcast_to(theta_deg, len(phi_deg))
    looks = np.column_stack([theta, phi_deg, theta, phi_deg])
    return _rows.rows_of_result(Result(_core.Stored.from_arrays(np.array([1e10]), looks, False, s, [])))


def test_numbers_are_packed_as_others_unpack_them():
    assert base64.b64decode(_report.packed_levels(np.array([-np.inf, 0.0, 1.5]))) == struct.pack("<3h", -32768, 0, 150)
    assert list(unpacked(_report.packed_levels(np.array([-327.69, -327.67, 400.0, np.nan])), "<i2")) == [-32768, -32767, 32767, -32768]
    assert base64.b64decode(_report.packed([1.0, -2.5])) == struct.pack("<2f", 1.0, -2.5)
    assert base64.b64decode(_report.packed([7, 1 << 31], "<u4")) == struct.pack("<2I", 7, 1 << 31)


def test_a_block_has_the_largest_value():
    blocks, size = _report.largest_of_blocks(np.array([0.0, 7.0, 1.0, 2.0, np.nan]), 0, 3)
    assert size == 2 and list(blocks[:2]) == [7.0, 2.0]


def test_curves_have_the_numbers_of_the_table(data, folder):
    rows, parts, sweep = table(folder / "rcs.csv"), table(folder / "parts.csv"), data["sweep"]
    assert list(unpacked(sweep["rows"], "<u4")) == list(range(len(rows["freq_hz"])))
    for i, channel in enumerate(("vv", "vh", "hv", "hh")):
        for name, column in (("sigma", f"sigma_{channel}_dbsm"), ("error", f"err_{channel}_db"), ("model", f"model_{channel}_db")):
            expected = np.maximum(rows[column].astype(float), -327.68)
            np.testing.assert_allclose(unpacked(sweep[name][i], "<i2") / 100.0, expected, atol=0.0051)
    amplitude = np.hypot(parts["re_hh_bounce_2"].astype(float), parts["im_hh_bounce_2"].astype(float))
    second = next(each for each in sweep["mechanisms"] if each["label"] == "bounce 2")
    with np.errstate(divide="ignore"):
        expected = np.maximum(10.0 * np.log10(4.0 * np.pi * amplitude**2), -327.68)
    np.testing.assert_allclose(unpacked(second["sigma"][3], "<i2") / 100.0, expected, atol=0.0051)


def test_the_map_has_each_row_at_its_place(data, folder):
    rows, shown = table(folder / "rcs.csv"), data["map"]
    assert {shown["x"]["quantity"], shown["y"]["quantity"]} == {"phi", "ghz"}
    levels = unpacked(shown["sigma"][0], "<i2").reshape(shown["y"]["count"], shown["x"]["count"]) / 100.0
    axes = {shown[name]["quantity"]: np.linspace(shown[name]["first"], shown[name]["last"], shown[name]["count"]) for name in "xy"}
    for hertz, phi, sigma in zip(rows["freq_hz"].astype(float), rows["phi_deg"].astype(float), rows["sigma_vv_dbsm"].astype(float)):
        at = {"ghz": np.argmin(np.abs(axes["ghz"] - hertz / 1e9)), "phi": np.argmin(np.abs(axes["phi"] - phi))}
        assert levels[at[shown["y"]["quantity"]], at[shown["x"]["quantity"]]] == pytest.approx(max(sigma, -327.68), abs=0.0051)


def test_every_view_is_there_and_its_page_can_be_parsed(data):
    assert data["title"] == "1.5 m triangular trihedral at 3 GHz" and data["profiles"]["resolution"] == pytest.approx(0.15, rel=0.3)
    assert data["isar"]["range"]["count"] > 10 and [look["look"] for look in data["scene"]["looks"]] == [3]
    page = _report.page(data | {"title": "</script> a < b & c"}, "THREE_IS_HERE")
    assert "<title>&lt;/script&gt; a &lt; b &amp; c</title>" in page and "THREE_IS_HERE" in page and "buildPage();" in page and "@data@" not in page
    packed = re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1]
    assert json.loads(packed)["title"] == "</script> a < b & c" and json.loads(packed)["sweep"] == data["sweep"]


@pytest.mark.parametrize("ghz, up, across", [([10.0], "velocity_m_per_s", "time_s"), ([9.8, 9.9, 10.0, 10.1], "range_m", "velocity_m_per_s")])
def test_a_scene_that_moves_has_its_doppler(ghz, up, across, tmp_path):
    plate = rt.Target([[0, 0, 0], [0, .3, 0], [0, .3, .3], [0, 0, .3]], [[0, 1, 2, 3]], unit="m")
    motion = rt.Motion(interval=1e-3, count=64).body("plate", velocity=(2.0, 0.0, 0.0))
    rt.solve(plate, ghz, rt.monostatic(90, 0), motion=motion).save(tmp_path / "moving.nc")
    shown = _report.data_of(tmp_path / "moving.nc", [])["doppler"]
    assert (shown["y"]["quantity"], shown["x"]["quantity"], shown["look"]) == (up, across, None)
    levels = unpacked(shown["sigma"][0], "<i2").reshape(shown["y"]["count"], shown["x"]["count"]) / 100.0
    peak = dict(zip("yx", np.unravel_index(np.argmax(levels), levels.shape)))
    axis = next(name for name in "xy" if shown[name]["quantity"] == "velocity_m_per_s")
    velocities = np.linspace(shown[axis]["first"], shown[axis]["last"], shown[axis]["count"])
    assert velocities[peak[axis]] == pytest.approx(2.0, abs=0.51 * (velocities[1] - velocities[0]))
    assert levels.max() == pytest.approx(10 * np.log10(4 * np.pi * 0.09**2 / 0.03**2), abs=0.2)


def test_kept_images_are_those_of_a_new_solve(data, folder):
    """Facets and edges as read from the files of the run, and as `--looks` solves them."""
    solved = _report.data_of(folder / "rcs.csv", [3])["scene"]["looks"][0]
    kept = data["scene"]["looks"][0]
    for i in (0, 3):
        np.testing.assert_allclose(unpacked(kept["sigma"][i], "<i2"), unpacked(solved["sigma"][i], "<i2"), atol=1)
    assert kept["tubes"] == solved["tubes"] and kept["tubes"]["paths"] > 0 and kept["cells"]["u"] == pytest.approx(solved["cells"]["u"])


def test_a_table_alone_has_curves_and_says_what_is_missing(folder, tmp_path):
    shutil.copy(folder / "rcs.csv", tmp_path)
    data = _report.data_of(tmp_path / "rcs.csv", [])
    assert data["scene"] is None and data["record"] is None and data["sweep"]["mechanisms"] == [] and data["isar"] is not None
    assert {note.split(":")[0] for note in data["notes"]} == {"Curves by mechanism", "Scattering centres", "The target in space"}


def test_a_long_sweep_keeps_its_peaks_and_nulls():
    level = np.sin(0.1 * np.arange(120_000))
    level[77_777], level[33_333] = 40.0, -90.0
    rows = _report.shown_rows(rows_of(0.001 * np.arange(120_000), level), 12)
    assert 30_000 < len(rows) <= 50_000 and {77_777, 33_333} <= set(rows.tolist()) and np.all(np.diff(rows) > 0)


def test_steps_that_grow_towards_the_poles_make_a_map():
    looks = [(theta, phi) for theta in (30.0, 60.0, 90.0, 120.0) for phi in np.linspace(0.0, 357.0, round(120 * np.sin(np.radians(theta))))]
    theta, phi = np.array(looks).T
    rows = rows_of(phi, np.where(theta == 90.0, 10.0, 0.0), theta)
    grid = _rows.grid_of(rows, rows.peak_row([0]), 2)
    x, y, at = grid.x, grid.y, grid.rows
    assert (grid.across, grid.up) == (_rows.PHI, _rows.THETA) and list(y) == [30.0, 60.0, 90.0, 120.0] and len(x) == 120
    assert np.all(theta[at] == y[:, None]) and np.all(np.abs((phi[at] - x + 180.0) % 360.0 - 180.0) <= 3.1)


def test_a_large_mesh_keeps_its_shape():
    """A flat sheet loses half a cell at its rim, and each of its triangles has one that stands for it nearby."""
    n = 100
    x, y = np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n, indexing="ij")
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.concatenate([np.column_stack([a, a + n + 1, a + n + 2]), np.column_stack([a, a + n + 2, a + 1])])
    vertices = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 0.3)])
    points, corners, shown_as = _report.shown_mesh(vertices, triangles, 2000)
    assert 1000 < len(corners) <= 2000 and len(shown_as) == len(triangles)
    cell = np.sqrt(2.0 / len(corners))
    area = 0.5 * np.linalg.norm(np.cross(points[corners[:, 1]] - points[corners[:, 0]], points[corners[:, 2]] - points[corners[:, 0]]), axis=1).sum()
    assert area == pytest.approx(1.0, abs=2.5 * cell)
    assert np.all(np.linalg.norm(points[corners[shown_as, 0]] - vertices[triangles[:, 0]], axis=1) < 4.0 * cell)
    assert np.array_equal(_report.shown_mesh(vertices, triangles, len(triangles))[1], triangles)


def test_the_command_writes_one_file(folder, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("RAYTUBE_THREE_JS", str(tmp_path))
    page = tmp_path / "new" / "page.html"
    assert main(["report", str(folder), "-o", str(page), "-q"]) == 0 and capsys.readouterr().out == ""
    assert [file.name for file in page.parent.iterdir()] == ["page.html"] and page.read_text().startswith("<!DOCTYPE html>")


def test_without_three_js_the_page_has_no_view_in_space(monkeypatch, capsys):
    monkeypatch.setattr(_report_command.Path, "is_file", lambda path: False)
    assert _report_command._libraries() == "" and capsys.readouterr().err.count("libjs-three") == 1


@pytest.mark.parametrize("arguments, words", [
    ([], "required"), (["nowhere"], "nowhere"), (["@/empty"], "rcs.nc"), (["@/case.toml"], "case"), (["@", "-o", "report.pdf"], ".html"),
    (["@", "-o", "@/folder.html"], "folder"), (["@", "--looks", "a"], "--looks"), (["@", "--looks", "0,1,2,3"], "3"), (["@", "--looks", "99"], "91"),
    (["@", "--lookss", "1"], "--looks"), (["@/broken"], "run.json"), (["@/alone", "--looks", "1"], "target"), (["@/other_rows"], "parts.csv")])
def test_bad_input_is_one_sentence_and_nothing_is_written(arguments, words, folder, tmp_path, capsys):
    for name in ("empty", "folder.html", "broken", "alone", "other_rows"):
        (tmp_path / name).mkdir()
    for name in ("broken", "alone", "other_rows", "."):
        shutil.copy(folder / "rcs.csv", tmp_path / name)
    (tmp_path / "case.toml").write_text("")
    (tmp_path / "broken/run.json").write_text("{")
    (tmp_path / "other_rows/parts.csv").write_text("".join(line for line in open(folder / "parts.csv") if not line.startswith("3000000000,")))
    assert main(["report", *(word.replace("@", str(tmp_path)) for word in arguments)]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1 and words in error and not list(tmp_path.rglob("report.html"))
    with pytest.raises(InputError):
        _report_command.main([word.replace("@", str(tmp_path)) for word in arguments])

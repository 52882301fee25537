"""Range profiles and images: the program's numbers with labels, levels of points, sentences, pictures."""
import base64
import csv
import multiprocessing
import pickle
import re

import numpy as np
import pytest
import xarray as xr

import raytube as rt
from raytube import _core
from raytube._result import Result

from conftest import CASES

C = 299792458.0
FREQUENCIES = np.linspace(9e9, 11e9, 41)
PLACES = np.array([[0.3, 0.1, 0.2], [-0.6, 0.4, -0.1]])  # of points of amplitudes 1 and 1/2, in metres


def of_points(theta_deg, phi_deg, places=PLACES):
    """A result of points that all looks see alike: S = sum of A exp(2 j k s . r)."""
    theta, phi = (a.ravel() for a in np.meshgrid(theta_deg, phi_deg, indexing="ij"))
    t, p = np.radians(theta), np.radians(phi)
    towards_radar = np.column_stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)])
    s = np.zeros((theta.size, FREQUENCIES.size, 2, 2), complex)
    for amplitude, place in zip((1.0, 0.5), places):
        s[:, :, 0, 0] += amplitude * np.exp(2j * np.outer(towards_radar @ place, 2 * np.pi * FREQUENCIES / C))
    s[:, :, 1, 1] = 0.1 * s[:, :, 0, 0]
    s[:, :, 0, 1] = s[:, :, 1, 0] = complex(np.nan, np.nan)
    return Result(_core.Stored.from_arrays(FREQUENCIES, np.column_stack([theta, phi, theta, phi]), False, s, [("title", "points")]))


@pytest.fixture(scope="module")
def plane():
    return of_points([90], np.linspace(-4, 4, 33), PLACES * [1, 1, 0])


@pytest.fixture(scope="module")
def space():
    return of_points(np.linspace(86, 94, 17), np.linspace(-4, 4, 17))


@pytest.fixture(scope="module")
def solved(dihedral):
    looks = rt.monostatic(theta_deg=90, phi_deg=np.linspace(43, 47, 9))
    return rt.solve(dihedral, np.linspace(9, 11, 9), looks, edges={"method": "none"}, title="dihedral")


def test_a_point_reads_its_level_at_its_range(plane):
    profile = plane.range_profile(look=16, padding=32)
    assert profile.S.dims == ("range_m", "channel") and float(profile.phi_deg) == 0.0
    strongest = profile.sigma_dbsm.sel(channel="vv").idxmax()
    assert float(strongest) == pytest.approx(-0.3, abs=C / 4e9 / 32)  # half a cell c/2B over the padding; x towards the radar is nearer
    assert float(profile.sigma_dbsm.sel(channel="vv").max()) == pytest.approx(10 * np.log10(4 * np.pi), abs=0.05)  # side lobes of the other
    assert np.isnan(profile.sigma_dbsm.sel(channel="vh")).all() and np.isnan(profile.error_dbsm).all()
    assert profile.attrs["range_unambiguous_m"] == pytest.approx(C / 2 / 50e6) and profile.attrs["window"] == "taylor, 35 dB"


def test_a_waterfall_is_the_profiles_of_all_looks(plane):
    waterfall = plane.waterfall(window="hann")
    assert waterfall.S.dims == ("look", "range_m", "channel") and waterfall.phi_deg.dims == ("look",)
    for look in (0, 20):
        assert waterfall.isel(look=look).identical(plane.range_profile(look, window="hann"))


def test_points_lie_where_they_are_in_a_plane(plane):
    image = plane.isar(size=(2.0, 2.0), pixels=8)
    assert image.S.dims == ("range_m", "cross_range_m", "channel")
    peak = image.sigma_dbsm.sel(channel="vv").argmax(["range_m", "cross_range_m"])
    place = sum(float(image[axis][peak[axis]]) * np.array(image.attrs[axis.removesuffix("_m") + "_direction"]) for axis in peak)
    assert place == pytest.approx([0.3, 0.1, 0.0], abs=C / 4e9 / 8)  # half of a pixel
    assert float(image.sigma_dbsm.sel(channel="vv").max()) == pytest.approx(10 * np.log10(4 * np.pi), abs=0.1)
    assert "outline" not in image


def test_points_lie_where_they_are_in_space(space):
    image = space.isar_3d(size=1.6, pixels=4)
    assert image.S.dims == ("range_m", "cross_range_m", "height_m", "channel")
    peak = image.sigma_dbsm.sel(channel="vv").argmax(["range_m", "cross_range_m", "height_m"])
    place = [float(image[axis][peak[axis]]) for axis in ("range_m", "cross_range_m", "height_m")]
    assert place == pytest.approx([-0.3, 0.1, 0.2], abs=0.5 * max(float(image[axis].diff(axis)[0]) for axis in peak) + 1e-9)


def rows_of(file):
    return list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))


def test_numbers_are_those_of_the_program(solved, program, tmp_path):
    solved.save(tmp_path / "rcs.nc")
    loaded = rt.load(tmp_path / "rcs.nc")  # of which nobody knows the target, as of the file alone
    program("profile", tmp_path / "rcs.nc", "-o", tmp_path, "--window", "kaiser", "--sidelobes", "50", "--quiet")
    program("isar", tmp_path / "rcs.nc", "-o", tmp_path, "--size", "0.4", "0.5", "--pixels", "3", "--quiet")
    waterfall, image = loaded.waterfall(window="kaiser", sidelobe_db=50), loaded.isar((0.4, 0.5), pixels=3)
    rows, values = rows_of(tmp_path / "profile.csv"), waterfall.S.sel(channel="hh").values.ravel()
    assert [float(row["re_hh"]) for row in rows] == pytest.approx(values.real, rel=1e-8, abs=1e-15)  # nine digits are written
    assert [float(row["error_vv_dbsm"]) for row in rows[:: waterfall.sizes["range_m"]]] == pytest.approx(waterfall.error_dbsm.sel(channel="vv").values, abs=0.006)
    assert [float(row["range_m"]) for row in rows[: waterfall.sizes["range_m"]]] == pytest.approx(waterfall.range_m.values, rel=1e-8)
    rows = rows_of(tmp_path / "isar.csv")
    assert [float(row["im_vv"]) for row in rows] == pytest.approx(image.S.sel(channel="vv").values.imag.ravel(), rel=1e-8, abs=1e-15)
    assert [float(row["cross_range_m"]) for row in rows[: image.sizes["cross_range_m"]]] == pytest.approx(image.cross_range_m.values, rel=1e-8)


def test_netcdf_files_hold_the_same(solved, program, tmp_path):
    solved.save(tmp_path / "rcs.nc")
    loaded = rt.load(tmp_path / "rcs.nc")
    program("profile", tmp_path / "rcs.nc", "-o", tmp_path / "profile.nc", "--quiet")
    program("isar", tmp_path / "rcs.nc", "-o", tmp_path / "isar.nc", "--size", "0.4", "0.5", "--quiet")
    for name, made in (("profile", loaded.waterfall()), ("isar", loaded.isar((0.4, 0.5)))):
        with xr.open_dataset(tmp_path / f"{name}.nc") as file:
            for channel in ("vv", "vh", "hv", "hh"):
                one, other = file.sel(receive=channel[0], transmit=channel[1]), made.sel(channel=channel)
                assert np.array_equal(one.S_re + 1j * one.S_im, other.S), channel  # every bit
                for level in set(other) - {"S", "outline"}:
                    np.testing.assert_allclose(one[level], other[level], rtol=1e-13)  # two libraries' logarithms
            for axis in set(made.coords) - {"channel"}:
                assert np.array_equal(file[axis], made[axis]) and file[axis].attrs["units"] == made[axis].attrs["units"], axis
            for key in set(made.attrs) - {"frequency_hz", "theta_deg", "phi_deg"}:  # of the sweep, for headings of pictures
                assert np.array_equal(file.attrs[key], made.attrs[key]), key
            assert file.attrs["geometry"] == "monostatic" and "4 pi |S|^2" in file.attrs["amplitude_convention"]


def test_centres_in_netcdf_are_those_of_the_table(program, tmp_path):
    program("centres", CASES / "trihedral/case.toml", "-o", tmp_path, "--quiet", "--set", "output.netcdf=true", "-n", "5")
    rows = rows_of(tmp_path / "centres.csv")
    with xr.open_dataset(tmp_path / "centres.nc") as file:
        assert len(rows) == file.sizes["centre"] + 1
        for row, i in zip(rows, range(file.sizes["centre"])):
            centre = file.isel(centre=i)
            assert float(row["re_hh"]) == centre.S_re.sel(receive="h", transmit="h") and float(row["x_m"]) == pytest.approx(float(centre.place.sel(xyz="x")), rel=1e-8)
            assert row["mechanism"] == str(file.mechanism.values[int(centre.share.argmax())]) and row["part"] == str(centre.part.values)
        assert float(rows[-1]["im_vv"]) == file.rest_im.sel(receive="v", transmit="v")


def test_two_spheres_are_where_their_highlights_are(program, tmp_path):
    """Each is seen at the point of its surface that faces the radar, with pi a^2."""
    spheres = ((0.2, [-1.0, 0.6, 0.0]), (0.1, [0.9, -0.7, 0.0]))
    case = CASES / "two_spheres/case.toml"
    centres = rt.centres(case, look=20, resolution=0.15)
    program("isar", case, "-o", tmp_path / "isar.nc", "--quiet", "--set", "look.phi_deg={start=-4.4,stop=4.4,count=23}")  # 2.1 m of cross-range
    image = xr.open_dataset(tmp_path / "isar.nc").sel(receive="h", transmit="h").sigma_dbsm
    program("profile", case, "-o", tmp_path / "profile.nc", "--quiet", "--set", "look.phi_deg=0")
    profile = xr.open_dataset(tmp_path / "profile.nc").isel(look=0).sel(receive="v", transmit="v").sigma_dbsm
    for i, (radius, (x, y, z)) in enumerate(spheres):
        level = 10 * np.log10(np.pi * radius**2)
        found = centres.isel(centre=i)
        assert found.place.values == pytest.approx([x + radius, y, z], abs=0.005)  # where four cubes of pieces meet
        assert float(found.sigma_dbsm.sel(receive="v", transmit="v")) == pytest.approx(level, abs=0.2)  # the cube is no wider than the highlight
        near = profile.sel(range_m=slice(-x - radius - 0.2, -x - radius + 0.2))
        assert float(near.idxmax()) == pytest.approx(-x - radius, abs=0.012)  # half of a step
        assert float(near.max()) == pytest.approx(level, abs=0.2)  # scalloping, side lobes
        spot = image.sel(range_m=slice(-x - radius - 0.2, -x - radius + 0.2), cross_range_m=slice(y - 0.2, y + 0.2))
        peak = spot.argmax(...)
        assert float(spot.range_m[peak["range_m"]]) == pytest.approx(-x - radius, abs=0.013)
        assert float(spot.cross_range_m[peak["cross_range_m"]]) == pytest.approx(y, abs=0.012)
        assert float(spot.max()) == pytest.approx(level, abs=0.4)  # the highlight moves over the sphere as it turns
    assert float(centres.sigma_dbsm.sel(receive="v", transmit="v")[2]) < -34  # from one sphere to the other, and side lobes: -34.8


def test_the_file_for_paraview_holds_the_image(solved, program, tmp_path):
    solved.save(tmp_path / "rcs.nc")
    program("isar", tmp_path / "rcs.nc", "-o", tmp_path, "--size", "0.4", "0.5", "--quiet")
    text = (tmp_path / "isar.vti").read_text()
    assert 'byte_order="LittleEndian" header_type="UInt64"' in text
    image = rt.load(tmp_path / "rcs.nc").isar((0.4, 0.5))
    for name, values in (("re_vv", image.S.sel(channel="vv").values.real), ("sigma_hh_dbsm", image.sigma_dbsm.sel(channel="hh").values)):
        found = base64.b64decode(re.search(rf'Name="{name}" format="binary">\s*(\S+)', text)[1], validate=True)
        assert int.from_bytes(found[:8], "little") == len(found) - 8
        assert np.array_equal(np.frombuffer(found[8:], "<f4"), np.maximum(values.ravel().astype("<f4"), -400) if "sigma" in name else values.ravel().astype("<f4"))


def test_a_solved_target_is_shown_whole_and_outlined(solved, dihedral, tmp_path):
    image, profile = solved.isar(), solved.range_profile()
    assert float(image.range_m[0]) < -0.15 and image.attrs["range_unambiguous_m"] > float(image.range_m[-1] - image.range_m[0])
    assert image.outline.dims == ("edge", "end", "xyz") and np.abs(image.outline).max() == pytest.approx(0.15, rel=0.01)
    assert np.isfinite(profile.error_dbsm).all() and np.isfinite(profile.model_dbsm.sel(channel=["vv", "hh"])).all()
    again = pickle.loads(pickle.dumps(solved)).isar()
    assert again.identical(image) and type(again) is type(image)
    solved.save(tmp_path / "rcs.nc")
    assert "outline" not in rt.load(tmp_path / "rcs.nc").isar(0.4)
    coarse = rt.solve(dihedral, [9.0, 11.0], rt.monostatic(90, [45, 46]), edges={"method": "none"})
    with pytest.raises(rt.InputError, match="the target lies within .* compute frequencies in steps of"):
        coarse.range_profile()
    with pytest.raises(rt.InputError, match="the target is .* m wide along range, but steps of 2000 MHz"):
        coarse.isar()


def test_results_of_the_radar_explorer(plane, tmp_path):
    pytest.importorskip("tables")
    first = plane.to_radar_explorer(tmp_path, "points", channels=("vv", "hh"))[0]
    read = rt.read_radar_explorer(first)
    assert np.allclose(read.isar(2.0).S.sel(channel="vv"), plane.isar(2.0).S.sel(channel="vv"), rtol=0, atol=1e-12)
    assert np.allclose(read.range_profile(3).S.sel(channel="hh"), plane.range_profile(3).S.sel(channel="hh"), rtol=0, atol=1e-12)


def test_other_processes(solved):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.apply(Result.range_profile, (solved, 2))
    assert there.identical(solved.range_profile(2))


@pytest.mark.parametrize("call, sentence", [
    (lambda plane, space: plane.range_profile(33), r"look 33: there are 33 direction pair\(s\)"),
    (lambda plane, space: plane.range_profile(window="blackman"), "window: choose among rectangular, hann"),
    (lambda plane, space: plane.waterfall(window=3), "window: give a text"),
    (lambda plane, space: plane.waterfall(window="hann", sidelobe_db=40), "a hann window has side lobes of its own"),
    (lambda plane, space: plane.waterfall(sidelobe_db=5), "sidelobe_db: give a number from 15 to 100"),
    (lambda plane, space: plane.waterfall(padding=0), "padding: give a whole number from 1 to 64"),
    (lambda plane, space: plane.isar(size=(1, 2, 3)), "size: give a positive length in metres, or 2 of them along range, cross-range"),
    (lambda plane, space: plane.isar(size=-1), "size: give a positive length"),
    (lambda plane, space: plane.isar(size=1e5), r"the result: the image asked for is 1e\+05 m wide along range"),
    (lambda plane, space: plane.isar(pixels=0.5), "pixels: give a number from 1 to 32"),
    (lambda plane, space: plane.isar_3d(), "isar_3d: an image in space needs looks over theta and phi both"),
    (lambda plane, space: space.isar(), "isar: the looks vary in theta and in phi"),
    (lambda plane, space: plane.isar().plot(channel="rl"), "channels are vv, vh, hv, hh"),
])
def test_sentences(plane, space, call, sentence):
    with pytest.raises(rt.InputError, match=sentence):
        call(plane, space)


def test_sentences_about_sweeps(plate):
    with pytest.raises(rt.InputError, match="^the result has one frequency; a range profile needs"):
        rt.solve(plate, 10.0, rt.monostatic(0, 0)).range_profile()
    with pytest.raises(rt.InputError, match="^the result has one look; an image needs"):
        rt.solve(plate, [9.9, 10.0], rt.monostatic(0, 0)).isar()
    with pytest.raises(rt.InputError, match="^the result: frequencies are not in even steps"):
        rt.solve(plate, [9.0, 9.1, 9.3], rt.monostatic(0, 0)).range_profile()
    with pytest.raises(rt.InputError, match="^the result: its looks are bistatic"):
        rt.solve(plate, [9.9, 10.0], rt.bistatic(0, 0, 10, [0, 1])).isar()


def test_pictures(plane, space, solved, dihedral):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.collections import LineCollection

    axes = [solved.range_profile().plot(), plane.waterfall().plot("hh"), solved.isar().plot(), plane.isar(1.0).plot("hh", target=dihedral),
            space.isar_3d(1.0, pixels=1).plot(), pyplot.subplots()[1]]
    assert [line.get_label() for line in axes[0].lines] == ["VV", "HH"] and axes[0].get_xlabel() == "range (m)"
    assert "azimuth" in axes[1].get_ylabel() and axes[4].get_ylabel() == "height (m)"
    outlined = [any(isinstance(c, LineCollection) for c in ax.collections) for ax in axes]
    assert outlined == [False, False, True, True, False, False]
    assert plane.isar(1.0).isel(range_m=slice(0, 5)).plot(ax=axes[5]) is axes[5]
    pyplot.close("all")


def test_centres_of_a_trihedral_are_its_apex():
    import raytube as rt

    corners = np.array([[0, 0, 0], [0.4, 0, 0], [0, 0.4, 0], [0, 0, 0.4]])
    target = rt.Target(corners, [[0, 1, 2], [0, 2, 3], [0, 3, 1]], unit="m")
    looks = rt.monostatic(float(np.degrees(np.arccos(1 / np.sqrt(3)))), 45.0)
    found = rt.centres(target, ghz=10.0, looks=looks, count=5, resolution=0.06)
    assert np.linalg.norm(found.place[0]) < 0.006 and str(found.mechanism[0].values) == "bounce_3_on"
    whole = rt.solve(target, ghz=10.0, looks=looks).S.values.reshape(2, 2)
    assert np.allclose(found.S.sum("centre").values + found.rest.values, whole, rtol=0.0, atol=1e-9 * np.abs(whole).max())
    with pytest.raises(rt.InputError, match="counted from 0"):
        rt.centres(target, ghz=10.0, looks=looks, look=1)


PULSES, INTERVAL = 96, 50e-6
BAND = 76.8e9 + 12.5e6 * np.arange(24)
MOVING = ((-2.0, -12.0, 1.0), (2.5, 7.5, 0.5))  # range in the middle of the pulses [m], velocity [m/s], amplitude


def of_pulses(frequencies=BAND, points=MOVING, looks=1):
    """A result of points that move evenly: S = sum of A exp(-2 j k (R - v t)); each look of a pulse half of the one before."""
    times = 1.0 + INTERVAL * np.arange(PULSES)
    t, k = (times - times.mean())[:, None], 2 * np.pi * frequencies / C
    s = sum(amplitude * np.exp(-2j * k * (place - velocity * t)) for place, velocity, amplitude in points)
    cube = np.zeros((PULSES, looks, len(frequencies), 2, 2), complex)
    cube[..., 0, 0] = s[:, None] * 0.5 ** np.arange(looks)[:, None]
    rows = np.column_stack([np.repeat([[90.0, 0.0, 90.0, 0.0]], PULSES * looks, axis=0), np.repeat(times, looks)])
    return Result(_core.Stored.from_arrays(frequencies, rows, False, cube.reshape(-1, len(frequencies), 2, 2), [("title", "pulses")]))


def test_rows_have_their_times(tmp_path):
    result = of_pulses(looks=2)
    assert result.S.time_s.dims == ("look",) and result.to_dataframe().columns[5] == "time_s"
    for name in ("a.nc", "a.csv"):
        result.save(tmp_path / name)
        loaded = rt.load(tmp_path / name)
        assert np.array_equal(loaded.S.time_s, result.S.time_s) and np.array_equal(loaded.S.values, result.S.values)
    assert "time_s" not in of_points([90], [0, 1]).S.coords
    assert rt.compare(tmp_path / "a.csv", result).rows == 2 * PULSES * len(BAND)


def test_moving_points_are_where_they_are():
    result = of_pulses()
    doppler = result.doppler(padding=16)
    assert doppler.S.dims == ("range_m", "velocity_m_per_s", "channel")
    assert doppler.attrs["time_s"] == pytest.approx(1.0 + INTERVAL * (PULSES - 1) / 2)
    for place, velocity, amplitude in MOVING:
        level = doppler.sigma_dbsm.sel(channel="vv").sel(range_m=place, velocity_m_per_s=velocity, method="nearest")
        assert float(level) == pytest.approx(10 * np.log10(4 * np.pi * amplitude**2), abs=0.1)
    peak = doppler.sigma_dbsm.sel(channel="vv").argmax(...)
    at = doppler.isel({name: int(index) for name, index in peak.items()})
    assert float(at.velocity_m_per_s) == pytest.approx(-12.0, abs=doppler.attrs["velocity_unambiguous_m_per_s"] / PULSES / 20)
    assert float(at.doppler_hz) == pytest.approx(2 * float(at.velocity_m_per_s) * doppler.attrs["doppler_frequency_hz"] / C)


def test_a_spectrogram_holds_velocities_over_time():
    made = of_pulses(BAND[:1], MOVING[:1]).spectrogram(length=32, overlap=0.5, padding=8)
    assert made.sigma_dbsm.dims == ("time_s", "velocity_m_per_s", "channel") and len(made.time_s) == 5
    ridge = made.sigma_dbsm.sel(channel="vv").idxmax("velocity_m_per_s")
    assert np.allclose(ridge, -12.0, atol=made.attrs["velocity_unambiguous_m_per_s"] / 32 / 8)
    assert np.allclose(made.sigma_dbsm.sel(channel="vv").max("velocity_m_per_s"), 10 * np.log10(4 * np.pi), atol=0.1)
    assert float(made.time_s[0]) == pytest.approx(1.0 + INTERVAL * 15.5)


def test_raw_data_are_the_rows(program, tmp_path):
    result = of_pulses(looks=3)
    raw = result.raw()
    assert dict(raw.S.sizes) == {"pulse": PULSES, "frequency": 24, "receiver": 3, "receive": 2, "transmit": 2}
    assert np.array_equal(raw.S.values[7, :, 2], result.S.values[7 * 3 + 2])
    result.save(tmp_path / "rcs.nc")
    program("doppler", tmp_path / "rcs.nc", "--raw", "-o", tmp_path / "raw.nc", "--quiet")
    with xr.open_dataset(tmp_path / "raw.nc") as file:
        assert np.array_equal(file.S_re + 1j * file.S_im, raw.S)
        assert np.array_equal(file.time_s, raw.time_s)
        for name in ("transmitter_direction", "receiver_direction"):
            assert np.allclose(file[name], raw[name], rtol=0, atol=1e-15)


def test_doppler_of_the_program_is_the_same(program, tmp_path):
    result = of_pulses(looks=2)
    result.save(tmp_path / "rcs.csv")
    program("doppler", tmp_path / "rcs.csv", "--look", "1", "--quiet", with_python=True)
    program("doppler", tmp_path / "rcs.csv", "--look", "1", "-o", tmp_path / "doppler.nc", "--quiet")
    doppler, table = result.doppler(look=1), rows_of(tmp_path / "doppler.csv")
    s = doppler.S.sel(channel="vv").values.ravel()
    assert np.allclose([float(row["re_vv"]) + 1j * float(row["im_vv"]) for row in table], s, rtol=0, atol=1e-8)
    assert {row["look"] for row in table} == {"1"}
    with xr.open_dataset(tmp_path / "doppler.nc") as file:
        assert np.array_equal((file.S_re + 1j * file.S_im).isel(look=0, receive=0, transmit=0).values.ravel(), s)
        assert float(file.attrs["peak_velocity_m_per_s"]) == pytest.approx(-12.0, abs=0.02)
    program("doppler", tmp_path / "rcs.csv", "--spectrogram", "--quiet", with_python=True)
    assert (tmp_path / "doppler.png").exists() and (tmp_path / "spectrogram.png").exists()


@pytest.mark.parametrize("call, sentence", [
    (lambda r: of_points([90], [0, 1]).doppler(), "nothing moves"),
    (lambda r: r.doppler(look=1), "a pulse has no look 1"),
    (lambda r: r.doppler(angle=True), "an angle takes antennas at places"),
    (lambda r: r.doppler(mechanism="bounce_1"), "holds no mechanism bounce_1"),
    (lambda r: r.spectrogram(length=1), "a window has 2 pulses or more"),
    (lambda r: r.spectrogram(length=97), "from 2 to 96"),
    (lambda r: r.spectrogram(overlap=1.0), "overlap: give a number from 0 to 0.999"),
])
def test_sentences_about_pulses(call, sentence):
    with pytest.raises(rt.InputError, match=re.escape(sentence)):
        call(of_pulses())


def test_pictures_of_pulses():
    result = of_pulses()
    ax = result.doppler().plot()
    assert "velocity" in of_pulses(BAND[:1]).doppler().plot().get_xlabel()
    assert "velocity" in ax.get_xlabel() and ax.get_ylabel() == "range (m)"
    assert result.spectrogram().plot().get_xlabel() == "time (s)"
    assert result.raw().plot().get_xlabel() == "time (s)"
    assert result.plot("vv").get_xlabel() == "time (s)"

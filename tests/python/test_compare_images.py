"""Images beside each other: what is read, how they are registered and measured."""
import json

import numpy as np
import pytest

import raytube as rt
from raytube._compare_images_command import main
from raytube._image_comparison import Image, ImageComparison, are_images, best_shift, read_image, similarity

pytest.importorskip("scipy")
COLUMNS, ROWS = 40, 36
UNIT = 1.0 / np.sqrt(4.0 * np.pi)  # |S| of a root of sigma of 1 m


def spots(x, y):
    """Three Gaussian spots, 2.5 pixels wide, with a phase of their own."""
    places = ((14.0, 11.0, 1.0), (24.0, 18.0, 0.6), (18.0, 26.0, 0.3))
    return sum(size * np.exp(-((x - px)**2 + (y - py)**2) / 12.5 + 1j * px) for px, py, size in places)


def values(right=0.0, up=0.0, columns=COLUMNS, rows=ROWS, step=1.0):
    return spots(*np.meshgrid(step * np.arange(columns) + right, step * np.arange(rows) + up))


def image(S, step=None, right=0.0, up=0.0, phase=True, **others):
    """VV and other channels; with a step [m] placed."""
    axes = [(first, step or 1.0, count) for first, count in zip((up, right), S.shape)]
    channels = {"vv": S, **others}
    return Image("image", step is not None, *axes, channels, frozenset(channels) if phase else frozenset())


def compare(result, reference, within_db=20.0, free_scale=False, register=True):
    return ImageComparison(result, reference, within_db, free_scale, register)


@pytest.mark.parametrize("shift", [(0.0, 0.0), (1.37, -0.62), (-4.5, 3.25), (0.03, 0.0), (7.0, -4.0)])
def test_shifts_between_pixels_are_found(shift):
    rows, columns = best_shift(np.abs(values(-shift[0], -shift[1])), np.abs(values()))
    assert (columns, rows) == pytest.approx(shift, abs=0.005)


def test_pictures_that_fill_their_frames_are_registered():
    def window(right, up):  # of one picture: nothing but what both show decides
        x, y = np.meshgrid(np.arange(40) + right, np.arange(40) + up)
        return 2.0 + np.sin(1.31 * x + 0.02 * x * x) * np.cos(0.83 * y) + np.sin(0.017 * x * y)

    assert best_shift(window(-3.0, 2.0), window(0.0, 0.0)) == pytest.approx((-2.0, 3.0), abs=0.002)


def test_a_line_is_shifted_along_itself():
    x = np.arange(50.0)
    a, b = np.exp(-0.1 * (x - 22.4)**2), np.exp(-0.1 * (x - 20.0)**2)
    assert best_shift(a[None], b[None]) == pytest.approx((0.0, 2.4), abs=0.005)
    assert best_shift(a[:, None], b[:, None]) == pytest.approx((2.4, 0.0), abs=0.005)
    assert best_shift(np.ones((4, 4)), np.ones((4, 4))) == (0.0, 0.0)


def test_similarity_is_that_of_wang():
    # Two pixels by hand, with w = exp(-1 / 4.5) and p = 1 / (1 + w): means 14.44672 and 15.55328, covariance -24.6939.
    a, b = np.array([[10.0, 20.0]]), np.array([[20.0, 10.0]])
    assert similarity(a, b, 40.0) == pytest.approx(-0.94078, abs=1e-5) == similarity(a.T, b.T, 40.0)
    # Without variance luminance is left: (2 x y + C1) / (x^2 + y^2 + C1).
    even = np.full((10, 20), 30.0)
    assert similarity(even, even - 10.0, 40.0) == pytest.approx((1200.0 + 0.16) / (1300.0 + 0.16), abs=1e-12)
    assert similarity(0 * even, 0 * even, 40.0) == 1.0


def test_similarity_is_that_of_scikit_image():
    metrics = pytest.importorskip("skimage.metrics")
    a, b = np.random.default_rng(3).uniform(1.0, 20.0, (2, 30, 34))
    a[:5] = a[-5:] = b[:5] = b[-5:] = a[:, :5] = a[:, -5:] = b[:, :5] = b[:, -5:] = 0.0  # neither counts what is dark in both
    theirs = metrics.structural_similarity(a, b, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=20.0)  # without 5 pixels of border
    assert similarity(a, b, 20.0) == pytest.approx(theirs, abs=1e-12)


def test_an_image_is_at_no_distance_from_itself():
    found = compare(image(values()), image(values()))
    measures = found.channels["vv"]
    assert found.shift == (0.0, 0.0) and found.relative_error == 0.0
    assert all(measures[name] == 0.0 for name in ("rms_db", "largest_abs_db", "relative_error", "magnitude_error", "power_ratio_db"))
    assert (measures["ssim"], measures["correlation"]) == pytest.approx((1.0, 1.0), abs=1e-12)


def test_a_factor_is_measured():
    found = compare(image(2.0 * values()), image(values()))
    measures, six = found.channels["vv"], 20.0 * np.log10(2.0)
    for name in ("rms_db", "bias_db", "median_abs_db", "power_ratio_db"):
        assert measures[name] == pytest.approx(six, abs=1e-12)
    assert (measures["relative_error"], measures["magnitude_error"], measures["correlation"]) == pytest.approx((1.0, 1.0, 1.0), abs=1e-12)
    assert measures["ssim"] < 0.99 and found.above_tolerance(6.0) == "vv 6.021 dB" and found.above_tolerance(6.1) == ""


def test_a_free_scale_takes_a_factor_away():
    turned = 3.0 * np.exp(0.7j) * values()
    found = compare(image(turned), image(values()), free_scale=True)
    assert found.factor == pytest.approx(np.exp(-0.7j) / 3.0, abs=1e-14)
    assert found.channels["vv"]["relative_error"] < 1e-14 and found.channels["vv"]["rms_db"] < 1e-12
    found = compare(image(turned, phase=False), image(values()), free_scale=True)  # of magnitudes the factor is positive
    assert found.factor == pytest.approx(1.0 / 3.0, abs=1e-14) and found.channels["vv"]["magnitude_error"] < 1e-14
    assert np.isnan(found.channels["vv"]["relative_error"]) and np.isinf(found.relative_error)


def test_a_shift_is_taken_back():
    whole = compare(image(values(-3.0, 2.0)), image(values()))
    assert whole.shift == (3.0, -2.0) and whole.rows == (COLUMNS - 3) * (ROWS - 2) and whole.channels["vv"]["relative_error"] == 0.0
    between = compare(image(values(-1.4)), image(values()))
    assert between.shift == pytest.approx((1.4, 0.0), abs=0.005)
    assert between.channels["vv"]["relative_error"] < 0.005 and between.channels["vv"]["ssim"] > 0.99
    assert compare(image(values(-3.0, 2.0)), image(values()), register=False).channels["vv"]["relative_error"] > 0.5


def test_a_shift_is_taken_back_whatever_phases_run():
    """Images of a radar turn their phase by a whole wave or more from pixel to pixel."""
    x, y = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    result, reference = (values(-shift) * np.exp(1j * (-2.2 * (x - shift) + 1.9 * y)) for shift in (1.4, 0.0))
    assert compare(image(result), image(reference)).channels["vv"]["relative_error"] < 0.01


def test_placed_images_are_compared_where_they_overlap():
    found = compare(image(values(4, 1, 30, 34), 0.1, 0.4, 0.1), image(values(), 0.1))
    assert found.rows == 30 * 34 and found.shift == (0.0, 0.0) and found.channels["vv"]["relative_error"] == 0.0
    fine = image(values(columns=2 * COLUMNS, rows=2 * ROWS, step=0.5), 0.5)
    assert compare(fine, image(values(), 1.0)).channels["vv"]["relative_error"] < 1e-12
    back = compare(image(values(), 1.0), fine)
    assert back.rows == (2 * COLUMNS - 1) * (2 * ROWS - 1) and back.channels["vv"]["relative_error"] < 0.005


def test_a_pixel_without_samples_stays_finite():
    result = values()
    result[11, 14] = 0.0  # the brightest one
    measures = compare(image(result), image(values()), register=False).channels["vv"]
    assert measures["largest_abs_db"] == pytest.approx(80.0, abs=1e-9) and (measures["largest_column"], measures["largest_row"]) == (14, 11)


def test_channels_that_one_image_lacks_are_named():
    S = values()
    found = compare(image(S, vh=S, hh=S), image(S, vh=0.0 * S))
    assert "hh: in the result alone" in found.text and "vh: no signal" in found.text and found.above_tolerance(1.0) == "vh inf dB"


def read(folder, text, columns="", name="a.csv"):
    (folder / name).write_text(text)
    return read_image(str(folder / name), columns, "--reference-columns")


def test_tables_of_pixels_in_any_order(tmp_path):
    found = read(tmp_path, "col,row,re_vv,im_vv\n1,0,3,4\n0,0,1,2\n0,1,5,6\n1,1,7,8\n")
    assert not found.placed and found.S["vv"].tolist() == [[1 + 2j, 3 + 4j], [5 + 6j, 7 + 8j]] and found.phase == {"vv"} == set(found.S)


def test_tables_of_a_renderer(tmp_path):
    """Rows from the top, magnitudes and phases by transmit polarisation, names of their own."""
    found = read(tmp_path, "px;py;pol;mag_v;ph_v;mag_h;ph_h\n0;0;v;2;0;0;0\n0;1;v;1;0;3;90\n0;0;h;0;0;4;0\n0;1;h;0;0;5;180\n",
                 'x=px,y=py*-1+1,tx_pol=pol,v_magnitude=mag_v,v_phase_rad=ph_v*0.017453292519943295,h_magnitude="mag_h",h_phase_rad=ph_h*0.017453292519943295')
    S = {name: channel[:, 0] / UNIT for name, channel in found.S.items()}
    assert S["vv"] == pytest.approx([1.0, 2.0]) and S["hv"][0] == pytest.approx(3.0j) and S["hh"][0] == pytest.approx(-5.0)


@pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")
def test_isar_is_the_same_from_both_forms(dihedral, program, tmp_path):
    pytest.importorskip("netCDF4")
    rt.solve(dihedral, [9.0, 10.0, 11.0], rt.monostatic(theta_deg=90, phi_deg=[40, 45, 50])).save(tmp_path / "rcs.nc")
    for output in (tmp_path, tmp_path / "isar.nc"):
        program("isar", tmp_path / "rcs.nc", "-o", output, "--size", "0.07", "0.07", "--quiet")
    assert are_images((str(tmp_path / "isar.csv"), ""), (str(tmp_path / "isar.nc"), ""))
    with pytest.raises(rt.InputError, match="is an image"):
        are_images((str(tmp_path / "isar.csv"), ""), (str(tmp_path / "rcs.nc"), ""))
    found = rt.compare(tmp_path / "isar.csv", tmp_path / "isar.nc")
    assert found.shift == (0.0, 0.0) and found.relative_error < 1e-8  # nine digits are written


def write_exr(file, names, pixels, **attributes):
    oiio = pytest.importorskip("OpenImageIO")
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], oiio.HALF if attributes.pop("half", False) else oiio.FLOAT)
    spec.channelnames = names
    for name, value in attributes.items():
        spec.attribute(name, value)
    tile = attributes.get("tile", 0)
    spec.tile_width = spec.tile_height = tile
    out = oiio.ImageOutput.create(str(file))
    assert out.open(str(file), spec) and out.write_image(np.ascontiguousarray(pixels, np.float32)), out.geterror()
    out.close()


RENDERED = "magnitude_vv=VV.mag,phase_vv_rad=VV.phase"


def test_openexr_of_a_renderer(tmp_path):
    """Lines of the file run downwards, those of the image upwards."""
    pixels = np.moveaxis(np.array([[[1, 2], [3, 4]], [[0, 0], [0.5, 0]], [[9, 9], [9, np.nan]]]), 0, -1)
    write_exr(tmp_path / "a.exr", ("VV.mag", "VV.phase", "R"), pixels)
    found = read_image(str(tmp_path / "a.exr"), RENDERED, "--result-columns")
    assert found.S["vv"] / UNIT == pytest.approx(np.array([[3.0 * np.exp(0.5j), 4.0], [1.0, 2.0]])) and found.phase == {"vv"} and not found.placed
    for columns, key in (("", "no channel"), ("magnitude_vv=HH", "no column is named hh"), ("magnitude_vv=R", 'a.exr, column R: "nan"')):
        with pytest.raises(rt.InputError, match=key):
            read_image(str(tmp_path / "a.exr"), columns, "--result-columns")


@pytest.mark.parametrize("form", [{"compression": name} for name in ("none", "rle", "zips", "zip", "piz", "pxr24")] + [{"half": True}, {"tile": 16}])
def test_openexr_is_the_same_in_all_forms(tmp_path, form):
    i = np.arange(67 * 41)  # numbers that halves hold, too
    pixels = np.stack([i % 2039 / 8.0, -(i // 67 % 5.0)], -1).reshape(41, 67, 2)
    write_exr(tmp_path / "a.exr", ("VV.mag", "VV.phase"), pixels, **form)
    found = read_image(str(tmp_path / "a.exr"), RENDERED, "--result-columns").S["vv"]
    assert np.allclose(found, UNIT * (pixels[..., 0] * np.exp(1j * pixels[..., 1]))[::-1], rtol=1e-12)


def test_damaged_openexr_is_refused(tmp_path):
    write_exr(tmp_path / "a.exr", ("VV.mag", "VV.phase"), np.random.default_rng(1).uniform(size=(41, 67, 2)))
    whole = (tmp_path / "a.exr").read_bytes()
    for part in (0.0, 0.1, 0.4, 0.9):
        (tmp_path / "torn.exr").write_bytes(whole[:int(part * len(whole))])
        with pytest.raises(rt.InputError, match="torn.exr: cannot be read as OpenEXR"):
            read_image(str(tmp_path / "torn.exr"), RENDERED, "--result-columns")


WHOLE = "col,row,magnitude_vv\n0,0,1\n1,0,2\n0,1,1\n1,1,0\n"
HEADER = "col,row,magnitude_vv\n"


@pytest.mark.parametrize(("text", "key"), [
    ("phi_deg,sigma_vv_dbsm\n0,1\n", "is an image and"), (HEADER, "no rows"), ("col,row,brightness\n0,0,1\n", "line 1: no channel"),
    ("col,row,magnitude_hh\n0,0,1\n1,0,2\n0,1,1\n1,1,0\n", "no channel in common"), (HEADER + "0,0,1\n1,0,2\n0,1,1\n", "3 rows for 2 x 2"),
    (HEADER + "0,0,1\n1,0,2\n0,1,1\n0,0,1\n", "twice"), (HEADER + "0,0,1\n1,0,2\n3,0,2\n", "col are not in even steps"),
    (HEADER + "0,0,1\n1,0,2\n", "2 x 1 pixels"), (HEADER + "0,0,nan\n", "line 2, column magnitude_vv"), (HEADER + "0,x,1\n", "where the pixel is"),
    ("range_m,cross_range_m,height_m,magnitude_vv\n0,0,0,1\n", "image in space"), ("", "is an image and"), (WHOLE.replace("1,0,2", "1,0"), "line 3")])
def test_bad_images_are_refused(tmp_path, monkeypatch, text, key):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "image.csv").write_text(WHOLE), (tmp_path / "bad.csv").write_text(text)
    with pytest.raises(rt.InputError, match=key):
        main(["bad.csv", "image.csv", "-o", "out"])
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("arguments", "key"), [
    ("dark.csv", "dark.csv: zero in every pixel"), ("image.csv --only phi_deg=0", "--only phi_deg=0"), ("image.csv --tolerance-db -1", "--tolerance-db"),
    ("image.csv --within-db nan", "--within-db"), ("image.csv --free-skale", "did you mean --free-scale"), ("nowhere.csv", "nowhere.csv"),
    ("image.csv --result-columns col=nix", "no column is named nix"), ("dark.csv --free-scale", "--free-scale")])
def test_bad_options_are_refused(tmp_path, monkeypatch, arguments, key):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "image.csv").write_text(WHOLE), (tmp_path / "dark.csv").write_text(HEADER + "0,0,0\n1,0,0\n0,1,0\n1,1,0\n")
    with pytest.raises(rt.InputError, match=key):
        main(["image.csv", *arguments.split()])


def test_images_elsewhere_are_refused():
    with pytest.raises(rt.InputError, match="do not overlap"):
        compare(image(values(), 0.1), image(values(), 0.1, right=10.0))


def test_the_command_judges_and_writes(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    x, y = np.meshgrid(np.arange(20), np.arange(18))
    for name, factor in (("image.csv", 1.0), ("brighter.csv", 2.0)):
        (tmp_path / name).write_text("line,col,mag\n" + "".join(f"{j},{i},{factor * size!r}\n" for i, j, size in zip(x.flat, y.flat, np.abs(spots(x, y)).flat)))
    command = ["brighter.csv", "image.csv", "-o", "out", "--result-columns", "magnitude_vv=mag,row=line*-1+17",
               "--reference-columns", "magnitude_vv=mag,row=line*-1+17"]
    assert main([*command, "--tolerance-db", "6"]) == 1 and "FAIL" in capsys.readouterr().out
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["compare.csv", "compare.png"]
    rows = [line for line in (tmp_path / "out/compare.csv").read_text().splitlines() if line[0] != "#"]
    assert len(rows) == 2 and float(dict(zip(rows[0].split(","), rows[1].split(",")))["rms_db"]) == pytest.approx(20.0 * np.log10(2.0))
    assert main([*command, "--tolerance-db", "6.1", "--free-scale"]) == 0 and capsys.readouterr().out.endswith("PASS\n")
    assert main([*command, "--tolerance-relative", "10"]) == 1  # magnitudes have no complex error
    capsys.readouterr()
    assert main([*command, "--json", "--tolerance-db", "7"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["pass"] is True and printed["channels"]["vv"]["magnitude_error"] == pytest.approx(1.0) and printed["channels"]["vv"]["relative_error"] is None

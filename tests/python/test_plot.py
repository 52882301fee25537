"""What `raytube plot` draws: asserted on matplotlib's own objects, against levels that the tests compute themselves."""
import io
import json
from contextlib import redirect_stderr, redirect_stdout
from hashlib import sha256

import numpy as np
import pytest

import raytube as rt
from conftest import CASES

matplotlib = pytest.importorskip("matplotlib")
pytest.importorskip("pandas")
from matplotlib.collections import LineCollection, QuadMesh  # noqa: E402
from matplotlib.image import imread  # noqa: E402

from raytube import _figures, _plots, _product_figures, _products, _rows  # noqa: E402
from raytube.__main__ import main  # noqa: E402

SHAPES = {"peak": lambda theta, phi: 10.0 - 0.05 * np.abs(phi) - 0.2 * np.abs(theta - 90.0)}


def table(file, theta, phi, ghz, level=SHAPES["peak"], more=""):
    """A table of any program: levels of VV, and of HH 3 dB below; returns those of VV."""
    rows = [(f, t, p) for t in np.atleast_1d(theta) for p in np.atleast_1d(phi) for f in np.atleast_1d(ghz)]
    vv = [level(t, p) - f for f, t, p in rows]
    file.write_text(f"freq_hz,theta_deg,phi_deg,sigma_vv_dbsm,sigma_hh_dbsm{more}\n" +
                    "".join(f"{f * 1e9:.17g},{t},{p},{v:.17g},{v - 3.0:.17g}\n" for (f, t, p), v in zip(rows, vv)))
    return np.array(vv)


def run(*arguments):
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        code = main(["plot", *map(str, arguments)])
    return code, out.getvalue(), err.getvalue()


def draw(*files, **options):
    with matplotlib.rc_context():
        return _figures.figure_of_results([_rows.read_rows(str(file)) for file in files], _figures.Options(**options))


def test_curves_hold_the_levels(tmp_path):
    phi = np.arange(0.0, 91.0)
    vv = table(tmp_path / "a.csv", 90.0, phi, 1.0)
    ax = draw(tmp_path / "a.csv").axes[0]
    assert [line.get_label() for line in ax.lines] == ["VV", "HH"]
    assert np.allclose(ax.lines[0].get_ydata(), vv) and np.array_equal(ax.lines[0].get_xdata(), phi)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["VV", "HH"]  # none of channels that are not there
    assert np.all(np.diff(ax.get_xticks()) == 10.0) or np.all(np.diff(ax.get_xticks()) == 15.0)
    assert "1 GHz" in ax.get_title() and "θ = 90°" in ax.get_title() and ax.get_xlabel().startswith("azimuth")
    relative = draw(tmp_path / "a.csv", style=_plots.Style(unit="db-peak", range_db=30.0)).axes[0]
    assert np.allclose(relative.lines[0].get_ydata(), vv - vv.max()) and relative.get_ylim()[0] == -30.0
    assert np.allclose(draw(tmp_path / "a.csv", style=_plots.Style(unit="m2")).axes[0].lines[0].get_ydata(), 10 ** (vv / 10))


def test_ticks_divide_a_circle(tmp_path):
    for last, step in ((360.0, 45.0), (180.0, 30.0), (90.0, 10.0), (120.0, 15.0)):
        table(tmp_path / "a.csv", 90.0, np.arange(0.0, last + 1), 1.0)
        assert set(np.diff(draw(tmp_path / "a.csv").axes[0].get_xticks())) == {step}


def test_several_results_go_by_their_names(tmp_path):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        table(tmp_path / name / "rcs.csv", 90.0, [0.0, 1.0, 2.0], 1.0)
    figure = draw(tmp_path / "one/rcs.csv", tmp_path / "two/rcs.csv")
    assert [line.get_label() for line in figure.axes[0].lines] == ["one VV", "one HH", "two VV", "two HH"]
    table(tmp_path / "other.csv", [80.0, 85.0, 90.0], 0.0, 1.0)
    code, _, err = run(tmp_path / "one/rcs.csv", tmp_path / "other.csv")
    assert code == 2 and "one by one" in err


def test_maps_are_the_right_way_up_and_share_a_bar(tmp_path):
    theta, phi = np.arange(60.0, 121.0, 10.0), np.arange(0.0, 91.0, 15.0)
    vv = table(tmp_path / "a.csv", theta, phi, 1.0)
    figure = draw(tmp_path / "a.csv")
    meshes = [c for ax in figure.axes for c in ax.collections if isinstance(c, QuadMesh) and ax.get_label() != "<colorbar>"]
    assert len(meshes) == 2 and {mesh.get_clim() for mesh in meshes} == {meshes[0].get_clim()}
    assert np.allclose(np.asarray(meshes[0].get_array()).reshape(7, 7), vv.reshape(7, 7))
    assert figure.axes[0].yaxis_inverted() and meshes[0].get_clim()[1] == pytest.approx(vv.max())
    boxes = [ax.get_position() for ax in figure.axes[:2]]
    assert figure._suptitle.get_position()[0] == pytest.approx(0.5 * (boxes[0].x0 + boxes[1].x1))  # over the panels, not bar and panels
    bar = figure.axes[-1]
    renderer = figure._get_renderer()
    assert not any(tick.get_window_extent(renderer).overlaps(bar.yaxis.label.get_window_extent(renderer)) for tick in bar.get_yticklabels())


def test_the_whole_sphere_is_a_hammer_projection(tmp_path):
    table(tmp_path / "a.csv", np.arange(0.0, 181.0, 10.0), np.arange(0.0, 360.0, 10.0), 1.0, lambda t, p: 20.0 if (t, p) == (60.0, 270.0) else 0.0)
    ax = draw(tmp_path / "a.csv").axes[0]
    assert ax.name == "hammer"
    mesh = ax.collections[0]
    values = np.asarray(mesh.get_array()).reshape(19, 37)
    row, column = np.unravel_index(np.argmax(values), values.shape)
    corners = np.degrees(mesh.get_coordinates())[row:row + 2, column:column + 2].reshape(-1, 2)
    assert np.allclose(corners.mean(axis=0), [-90.0, 30.0])  # azimuth 270, 30 degrees above the horizon


def test_polar_curves_close(tmp_path):
    vv = table(tmp_path / "a.csv", 90.0, np.arange(0.0, 360.0), 1.0)
    ax = draw(tmp_path / "a.csv", kind="polar").axes[0]
    x, y = ax.lines[0].get_data()
    assert ax.name == "polar" and x[-1] == pytest.approx(2 * np.pi) and y[-1] == y[0] == pytest.approx(vv[0])
    table(tmp_path / "f.csv", 90.0, 0.0, [1.0, 2.0, 3.0])
    assert run(tmp_path / "f.csv", "--kind", "polar")[0] == 2


@pytest.fixture(scope="module")
def made(tmp_path_factory, dihedral, program):
    """A run of a dihedral over frequency and azimuth with products beside it, by the program."""
    folder = tmp_path_factory.mktemp("made")
    program("run", CASES / "dihedral/case.toml", "-o", folder, "--quiet", "--parts", "--set", "output.plots=false",
            "--set", "frequency.ghz={start=9,stop=11,count=21}", "--set", "look={theta_deg=90,phi_deg={start=35,stop=55,step=1}}",
            "--set", "output.image_look=3", "--set", "output.image_per_wavelength=3", "--set", "output.netcdf=true")
    for command in ("profile", "isar"):
        program(command, folder / "rcs.csv", "-o", folder, "--quiet")
    return folder


def test_a_folder_is_drawn_whole(made):
    code, out, err = run(made, "--size", "320x240")
    assert code == 0, err
    names = {"plot.png", "plot.svg", "parts.png", "parts.svg", "image.png", "image_phase.png", "image_window.png", "profile.png", "profile.svg",
             "waterfall.png", "waterfall.svg", "isar.png", "isar_pauli.png"}
    assert {file.name for file in made.iterdir() if file.suffix in (".png", ".svg")} == names and all(name in out for name in names)
    assert not [file for file in made.iterdir() if file.name.startswith(".raytube-")]


def test_bands_are_the_model_uncertainty(made, tmp_path):
    result = rt.load(made / "rcs.nc")
    rows = _rows.rows_of_result(result)
    cut = _rows.Cut("", np.arange(0, len(rows.keys), 21), rows.keys[::21, 2])
    for model in (True, False):
        ax = matplotlib.figure.Figure().add_subplot()
        style = _plots.Style(model=model)
        _plots.draw_cut(ax, rows, cut, _rows.PHI, [0], _plots.scale_of(rows.sigma, style, 80.0), style)
        assert len(ax.collections) == model
        if model:
            highest = ax.collections[0].get_paths()[0].vertices[:, 1].max()
            assert highest == pytest.approx(np.max(result.sigma_dbsm.values[:, 0, 0] + result.model_db.values[:, 0, 0]))


def test_images_show_levels_outline_and_radar(made):
    figure = _product_figures.isar_pictures(str(made / "isar.csv"), _figures.Options())["isar.png"]()
    ax = figure.axes[0]
    image = rt.load(made / "rcs.nc").isar(size=None)
    assert [a.get_title() for a in figure.axes[:2]] == ["VV", "HH"] and "φ = 45° ± 10°" in figure._suptitle.get_text()
    assert "f₀ = 10 GHz" in figure._suptitle.get_text() and "B = 2 GHz" in figure._suptitle.get_text()
    mesh = next(c for c in ax.collections if isinstance(c, QuadMesh))
    assert mesh.get_clim()[1] == pytest.approx(float(image.sigma_dbsm.max()), abs=0.5)
    assert any(isinstance(c, LineCollection) and c.get_segments() for c in ax.collections)
    assert "radar" in [text.get_text() for text in ax.texts]


def test_a_mesh_that_has_changed_is_not_drawn(made, tmp_path):
    mesh = tmp_path / "square.off"
    mesh.write_text("OFF\n4 1 0\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n4 0 1 2 3\n")
    (tmp_path / "case.toml").write_text("[target]\nmesh = \"square.off\"\nunit = \"m\"\n[frequency]\nghz = 1\n[look]\ntheta_deg = 0\nphi_deg = 0\n")
    described = {"case_file": str(tmp_path / "case.toml"), "case": {"target": {"mesh": "square.off", "unit": "m"}},
                 "mesh": {"sha256": sha256(mesh.read_bytes()).hexdigest()}}
    target = _products.target_of_run(described)
    lines, last = _products.drawn_lines(target, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    border = lines[len(lines) - last:].reshape(-1, 3)
    assert border.min(axis=0)[:2] == pytest.approx([0.0, 0.0], abs=0.01) and border.max(axis=0)[:2] == pytest.approx([2.0, 1.0], abs=0.01)
    assert np.sum(np.linalg.norm(np.diff(lines[len(lines) - last:], axis=1), axis=-1)) == pytest.approx(6.0, rel=0.01)  # once round
    mesh.write_text(mesh.read_text() + "\n")
    assert _products.target_of_run(described) is None


def test_profiles_of_csv_and_netcdf_are_the_same(made, tmp_path, program):
    (tmp_path / "p").mkdir()
    program("profile", made / "rcs.nc", "-o", tmp_path / "p/profile.nc", "--quiet")
    lines = [_product_figures.profile_pictures(str(file), _figures.Options())["profile.png"]().axes[0].lines
             for file in (made / "profile.csv", tmp_path / "p/profile.nc")]
    assert [line.get_label() for line in lines[0]] == [line.get_label() for line in lines[1]]
    for ours, theirs in zip(*lines):
        assert np.allclose(ours.get_ydata(), theirs.get_ydata(), atol=0.02)


def test_pauli_images_are_bright_and_known_by_a_key():
    amplitudes = np.zeros((40, 40, 3))
    amplitudes[:20, :, 2], amplitudes[0, 0, 0] = 1.0, 100.0
    colours, _ = _product_figures.pauli_colours(amplitudes)
    assert np.all(colours[:20, 1:, 2] == 1.0) and np.all(colours[20:] == 0.0) and colours[0, 0, 0] == 1.0


def test_parts_add_up(made):
    figure = _product_figures.parts_pictures(str(made / "parts.csv"), _figures.Options())["parts.png"]()
    together = figure.axes[0].lines[0]
    sigma = rt.load(made / "rcs.nc").sigma_dbsm.sel(channel="vv").values
    assert together.get_label() == "all together"
    assert min(np.abs(np.asarray(together.get_ydata()) - cut).max() for cut in [*sigma, *sigma.T] if len(cut) == len(together.get_ydata())) < 1e-6


def test_comparisons_of_two_quantities_are_maps_of_the_difference(tmp_path, program):
    theta, phi = np.arange(60.0, 121.0, 10.0), np.arange(0.0, 91.0, 15.0)
    ours = table(tmp_path / "a.csv", theta, phi, 1.0)
    theirs = table(tmp_path / "b.csv", theta, phi, 1.0, lambda t, p: SHAPES["peak"](t, p) + 0.01 * p)
    program("compare", tmp_path / "a.csv", tmp_path / "b.csv", "-o", tmp_path / "c")
    figure = _product_figures.comparison_pictures(str(tmp_path / "c/compare.csv"), _figures.Options())["compare.png"]()
    assert [ax.get_title() for ax in figure.axes[:3]] == ["VV result", "VV reference", "VV result − reference"]
    assert np.allclose(np.asarray(figure.axes[2].collections[0].get_array()).ravel(), ours - theirs)
    low, high = figure.axes[2].collections[0].get_clim()
    assert low == -high
    line = _product_figures.comparison_pictures(str(tmp_path / "c/compare.csv"), _figures.Options(kind="curves"))["compare.png"]()
    assert line.axes[0].lines


def test_convergence(tmp_path):
    (tmp_path / "converge.csv").write_text(
        "# order           2.00, from 2, 4 and 8 tubes per wavelength; 1.50 on average over all\n"
        "# recommendation  tubes.per_wavelength = 4, the coarsest\n"
        "per_wavelength,tubes,rays,solve_s,estimated_relative_error\n2,1,10,0.1,0.08\n4,2,20,0.2,0.02\n8,3,40,0.4,0.005\n")
    figure = _product_figures.convergence_pictures(str(tmp_path / "converge.csv"), _figures.Options())["converge.svg"]()
    labels = [line.get_label() for line in figure.axes[0].lines]
    assert "order 1.50, the mean" in labels and "recommended: 4" in labels
    assert list(figure.axes[1].lines[0].get_xdata()) == [0.1, 0.2, 0.4]


def test_sizes_and_old_pictures(tmp_path):
    table(tmp_path / "a.csv", 90.0, np.arange(0.0, 91.0), 1.0)
    (tmp_path / "plot.png").write_text("old")
    assert run(tmp_path / "a.csv", "--size", "333x251", "--quiet") == (0, "", "")
    assert imread(tmp_path / "plot.png").shape[:2] == (251, 333) and (tmp_path / "plot.svg").exists()
    assert run(tmp_path / "a.csv", "-o", tmp_path / "x/b.pdf", "-q")[0] == 0 and (tmp_path / "x/b.pdf").read_bytes()[:4] == b"%PDF"


def test_same_input_same_bytes(tmp_path):
    table(tmp_path / "a.csv", 90.0, np.arange(0.0, 91.0), 1.0)
    for name in ("1.svg", "2.svg", "1.pdf", "2.pdf"):
        assert run(tmp_path / "a.csv", "-o", tmp_path / name)[0] == 0
    assert (tmp_path / "1.svg").read_bytes() == (tmp_path / "2.svg").read_bytes()
    assert (tmp_path / "1.pdf").read_bytes() == (tmp_path / "2.pdf").read_bytes()


def test_a_single_look_is_printed(tmp_path):
    table(tmp_path / "a.csv", 90.0, 30.0, 1.0)
    code, out, _ = run(tmp_path / "a.csv")
    assert code == 0 and "VV" in out and "HH" in out and "VH" not in out and f"{SHAPES['peak'](90, 30) - 1:.2f}" in out
    assert [file.name for file in tmp_path.iterdir()] == ["a.csv"]
    table(tmp_path / "b.csv", 90.0, [0.0, 1.0, 2.0], 1.0)
    code, _, err = run(tmp_path / "a.csv", tmp_path / "b.csv")
    assert code == 2 and "single look" in err


@pytest.mark.parametrize("options, word", [
    (["--size", "50x50"], "--size"), (["--size", "1600"], "--size"), (["--size", "4000x500"], "--size"), (["--channels", "vv,xx"], "--channels"),
    (["--channels", "vv,vv"], "--channels"), (["--channels", "vh"], "--channels vh"), (["--kind", "pie"], "--kind"), (["--unit", "dB"], "--unit"),
    (["--style", "grey"], "--style"), (["--range", "0"], "--range"), (["--range", "301"], "--range"), (["--range", "x"], "--range"),
    (["--range", "20", "--unit", "m2"], "--range"), (["-o", "a.jpg"], "a.jpg"), (["-o", "a.PNG"], "a.PNG"), (["-o", ""], "-o"),
    (["--kind", "map"], "--kind map"), (["--kind", "sphere"], "--kind sphere"), (["--knd", "map"], "--kind"), (["--columns", "x"], "--columns")])
def test_refusals(tmp_path, monkeypatch, options, word):
    monkeypatch.chdir(tmp_path)
    table(tmp_path / "a.csv", 90.0, [0.0, 1.0, 2.0], 1.0)
    code, out, err = run("a.csv", *options)
    assert (code, out) == (2, "") and word in err and err.count("\n") == 1 and err.startswith("raytube: ")
    assert [file.name for file in tmp_path.iterdir()] == ["a.csv"]


def test_what_cannot_be_drawn(tmp_path):
    assert run(tmp_path / "none.csv")[0] == 2 and run(tmp_path)[0] == 2
    (tmp_path / "compare.csv").write_text("# image\nchannel,result_peak_dbsm,reference_peak_dbsm\n")
    assert run(tmp_path / "compare.csv")[0] == 2
    for name in "abcdefghi":
        table(tmp_path / f"{name}.csv", 90.0, [0.0, 1.0, 2.0], 1.0)
    assert run(*(tmp_path / f"{name}.csv" for name in "abcdefghi"))[0] == 2


def test_titles_come_from_the_run(tmp_path):
    table(tmp_path / "rcs.csv", 90.0, [0.0, 1.0, 2.0], 1.0)
    described = {"case": {"title": "Cube"}, "rcs_csv_sha256": sha256((tmp_path / "rcs.csv").read_bytes()).hexdigest()}
    (tmp_path / "run.json").write_text(json.dumps(described))
    assert draw(tmp_path / "rcs.csv").axes[0].get_title().startswith("Cube\n")
    table(tmp_path / "rcs.csv", 90.0, [0.0, 1.0, 3.0], 1.0)
    assert "Cube" not in draw(tmp_path / "rcs.csv").axes[0].get_title()


def test_points_of_sources_share_their_axes(tmp_path, program):
    program("sources", CASES / "double_slit/case.toml", "-o", tmp_path / "s", "--set", "source.rays=2000")
    pictures = _product_figures.sources_pictures(str(tmp_path / "s/sources.csv"), _figures.Options())
    points = {}
    for line in (tmp_path / "s/hits.ply").read_text().split("end_header\n")[1].splitlines():
        x, y, z, model, bounce = map(float, line.split())
        points.setdefault(model, []).append((y, z, bounce))
    with matplotlib.rc_context():
        panels = [ax for ax in pictures["hits.png"]().axes if ax.get_label() != "<colorbar>"]
        launch = pictures["launch.png"]()
    assert len({ax.get_xlim() for ax in panels}) == 1 and panels[0].get_xlabel() + panels[0].get_ylabel() in ("z (m)", "y (m)z (m)")
    for ax, of in zip(panels, points.values()):
        assert np.allclose(np.column_stack([ax.collections[0].get_offsets(), ax.collections[0].get_array()]), of)
    assert len(panels) == len(points) and all(ax.name == "3d" for ax in launch.axes)


def test_steps_too_wide_for_the_lobes_are_points(tmp_path):
    table(tmp_path / "rcs.csv", 90.0, np.arange(0.0, 91.0), 1.0)
    for warnings, joined in (([], True), (["sampling: steps of 1 deg in phi are too wide for the lobes of this target"], False)):
        (tmp_path / "run.json").write_text(json.dumps({"rcs_csv_sha256": sha256((tmp_path / "rcs.csv").read_bytes()).hexdigest(), "warnings": warnings}))
        line = draw(tmp_path / "rcs.csv").axes[0].lines[0]
        assert (line.get_linestyle() == "-") == joined and (line.get_marker() in ("", "None")) == joined

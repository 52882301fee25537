"""What comes out: arrays without a copy, tables, files, pictures."""
import os
import subprocess
import sys
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import CASES

import raytube as rt

pytestmark = pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")


def test_S_is_the_memory_of_the_result(sweep):
    values = sweep.S.values
    assert values.shape == (8, 3, 2, 2) and values.dtype == np.complex128 and values.flags.c_contiguous
    assert np.shares_memory(values, sweep._stored.S) and np.shares_memory(values, sweep.S.sel(receive="v").values)
    assert np.shares_memory(sweep.sigma_dbsm.values, sweep._stored.sigma_dbsm)
    assert not values.flags.owndata


def test_arrays_are_read_only_and_outlive_the_result(plate):
    result = rt.solve(plate, 10.0, rt.monostatic(10, 0))
    values = result.S.values
    for name in ("S", "sigma_dbsm", "error_db", "model_db"):
        with pytest.raises(ValueError):
            getattr(result, name).values[0] = 0
    with pytest.raises(ValueError):
        values.flags.writeable = True
    kept = values.copy()
    del result
    assert np.array_equal(values, kept)


def test_sigma_is_that_of_S(sweep):
    with np.errstate(divide="ignore"):
        sigma = 10 * np.log10(4 * np.pi * np.abs(sweep.S.values.reshape(8, 3, 4)) ** 2)
    assert np.allclose(sigma, sweep.sigma_dbsm.values, rtol=0, atol=1e-9)  # two logarithms that round apart
    assert sweep.sigma_dbsm.sel(channel="vh").values[1, 2] == pytest.approx(20 * np.log10(abs(sweep.S.sel(receive="v", transmit="h").values[1, 2])) + 10.99209864, abs=1e-7)


def test_mechanisms_add_up(sweep):
    mechanisms = sweep.mechanisms
    assert {"bounce_1", "bounce_2", "edges_order_1"} <= set(mechanisms)
    total = sum(mechanisms[name].values for name in mechanisms)
    assert np.abs(total - sweep.S.values).max() <= 1e-13 * np.abs(sweep.S.values).max()  # the order of a few sums


def test_incoherent_part_of_rough_surfaces(plate, tmp_path):
    assert rt.solve(plate, 10.0, rt.monostatic(30, 0)).incoherent_m2 is None
    (tmp_path / "rough.toml").write_text(f"""
        [target]
        mesh = "{CASES}/plate/plate.off"
        unit = "m"
        material = "rough"
        [materials.rough]
        kind = "pec"
        roughness_rms_mm = 5.0
        [frequency]
        ghz = 3.0
        [look]
        theta_deg = [30, 40]
        phi_deg = 0
        [output]
        incoherent = true
        """)
    rough = rt.run(tmp_path / "rough.toml").incoherent_m2
    assert rough.dims == ("look", "frequency", "transmit") and rough.attrs["units"] == "m2" and np.all(rough.values > 0)


def test_dataset_and_table_say_the_same(sweep):
    data, table = sweep.to_xarray(), sweep.to_dataframe()
    assert list(data) == ["S", "sigma_dbsm", "error_db", "model_db"] and len(table) == 24
    assert data.frequency.attrs["units"] == "Hz" and data.phi_deg.attrs["units"] == "degree"
    row = table[(table.freq_hz == 10e9) & (table.theta_deg == 90) & (table.phi_deg == 30)].iloc[0]
    look = int(np.flatnonzero((data.theta_deg.values == 90) & (data.phi_deg.values == 30))[0])
    cell = data.sel(frequency=10e9).isel(look=look)
    for p in "vh":
        for q in "vh":
            assert row[f"S_{p}{q}"] == cell.S.sel(receive=p, transmit=q).item()
            assert row[f"sigma_{p}{q}_dbsm"] == cell.sigma_dbsm.sel(channel=p + q).item()
            assert row[f"err_{p}{q}_db"] == cell.error_db.sel(channel=p + q).item()
            assert row[f"model_{p}{q}_db"] == cell.model_db.sel(channel=p + q).item()
    assert table.freq_hz.tolist()[:4] == [9e9, 10e9, 11e9, 9e9]  # frequency fastest


def test_netcdf_keeps_everything(sweep, tmp_path):
    sweep.save(tmp_path / "a.nc")
    again = rt.load(tmp_path / "a.nc")
    assert again.to_xarray().identical(sweep.to_xarray()) and again.mechanisms.identical(sweep.mechanisms)
    assert again.case == sweep.case and again.counts == sweep.counts and again.skipped == sweep.skipped
    assert again.warnings == sweep.warnings and again.model_parts == sweep.model_parts
    again.save(tmp_path / "b.nc")
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


def test_csv_keeps_the_rows(sweep, tmp_path):
    sweep.save(tmp_path / "a.csv")
    again = rt.load(tmp_path / "a.csv")
    for name in ("S", "sigma_dbsm", "error_db", "model_db"):
        assert np.array_equal(getattr(again, name).values, getattr(sweep, name).values)
    assert again.case == {} and again.counts == {} and again.warnings == []
    again.save(tmp_path / "b.csv")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_files_in_threads_say_nothing(sweep, tmp_path, capfd):
    """HDF5 tells of attributes that netCDF looks for in vain, thread by thread, until it is told not to."""
    def there_and_back(file):
        sweep.save(file)
        return rt.load(file).S.values

    with ThreadPoolExecutor(2) as pool:
        for S in pool.map(there_and_back, [tmp_path / f"{i}.nc" for i in range(4)]):
            assert np.array_equal(S, sweep.S.values)
    assert capfd.readouterr().err == ""


def test_files_here_and_by_others_say_nothing(sweep, tmp_path):
    """netCDF4 of Python relies on the silence of the thread in which netCDF opened its first file."""
    pytest.importorskip("netCDF4")
    sweep.save(tmp_path / "a.nc")
    script = "import sys, xarray, raytube; raytube.load(sys.argv[1]); print(xarray.open_dataset(sys.argv[1], engine='netcdf4').S_re.dims[0])"
    done = subprocess.run([sys.executable, "-c", script, tmp_path / "a.nc"], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("look\n", "")


def test_a_save_that_fails_leaves_nothing(sweep, tmp_path):
    (tmp_path / "a.nc").mkdir()
    with pytest.raises(rt.InputError):
        sweep.save(tmp_path / "a.nc")
    assert os.listdir(tmp_path) == ["a.nc"]


def test_threads_may_save_to_one_place(sweep, tmp_path):
    failed = []

    def save():
        try:
            sweep.save(tmp_path / "a.nc")
        except Exception as error:
            failed.append(error)

    threads = [threading.Thread(target=save) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failed == [] and os.listdir(tmp_path) == ["a.nc"]
    assert np.array_equal(rt.load(tmp_path / "a.nc").S.values, sweep.S.values)


def test_what_is_said_of_a_result(sweep, plate):
    assert repr(sweep).startswith("Result: dihedral\n  8 monostatic looks, 3 frequencies from 9 to 11 GHz\n  peak ")
    assert ">Result: dihedral" in sweep._repr_html_()
    assert sweep.counts["rays"] > 0 and all({"what", "why"} <= set(entry) for entry in sweep.skipped)
    assert "1 monostatic look, 10 GHz" in repr(rt.solve(plate, 10.0, rt.monostatic(0, 0)))


def test_warnings_are_of_the_line_that_solves(dihedral):
    with pytest.warns(rt.RaytubeWarning) as caught:
        result = rt.solve(dihedral, 94.0, rt.monostatic(90, np.arange(0, 45, 5.0)), edges={"method": "none"})
    assert [str(warning.message) for warning in caught] == result.warnings and caught[0].filename == __file__


@pytest.fixture
def pictures():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", rt.RaytubeWarning)
        yield plt
        plt.gcf().canvas.draw()  # a picture that cannot be drawn, or lacks a letter, warns now
        plt.close("all")


def test_plot_against_an_angle(dihedral, pictures):
    ax = rt.solve(dihedral, 10.0, rt.monostatic(90, np.arange(0, 46, 1.0)), title="dihedral").plot()
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_title()) == ("azimuth φ (degrees)", "σ (dBsm)", "dihedral, 10 GHz, θ = 90°")
    assert [line.get_label() for line in ax.lines] == ["VV", "HH"]


def test_plot_against_frequency(dihedral, pictures):
    ax = rt.solve(dihedral, np.linspace(9, 11, 21), rt.monostatic(90, 10)).plot(("vv", "vh"))
    assert ax.get_xlabel() == "frequency (GHz)" and len(ax.lines) == 2 and "φ = 10°" in ax.get_title()


def test_plot_of_one_row(plate, pictures):
    assert len(rt.solve(plate, 10.0, rt.monostatic(0, 0)).plot("hh").lines) == 1


def test_map_over_looks_and_frequencies(sweep, pictures):
    ax = sweep.plot()
    assert ax.get_ylabel() == "frequency (GHz)" and ax.figure.axes[-1].get_ylabel() == "σ, VV (dBsm)"
    sigma = sweep.sigma_dbsm.sel(channel="vv").values
    lowest, highest = ax.collections[0].get_clim()
    assert highest == sigma.max() and lowest == max(sigma[np.isfinite(sigma)].min(), highest - 50)


def test_map_over_two_angles(dihedral, pictures):
    theta, phi = [80.0, 85, 90], [10.0, 20, 30, 40]
    by_phi = rt.solve(dihedral, 10.0, rt.monostatic(theta, phi))
    by_theta = rt.solve(dihedral, 10.0, rt.looks(np.tile(theta, 4), np.repeat(phi, 3)))
    for result, wanted in ((by_phi, lambda sigma: sigma.reshape(3, 4)), (by_theta, lambda sigma: sigma.reshape(4, 3).T)):
        ax = result.plot("hh")
        assert ax.get_xlabel().startswith("azimuth") and ax.get_ylabel().startswith("polar angle")
        colours = np.asarray(ax.collections[0].get_array()).reshape(3, 4)
        assert np.array_equal(colours, wanted(result.sigma_dbsm.sel(channel="hh").values[:, 0]))
    assert by_phi.sigma_dbsm.shape == by_theta.sigma_dbsm.shape
    ragged = rt.solve(dihedral, 10.0, rt.looks([80, 80, 90], [10, 20, 30])).plot("hh")
    assert ragged.get_xlabel() == "look" and len(ragged.lines) == 1


def test_plot_into_given_axes(dihedral, pictures):
    ax = pictures.subplots()[1]
    assert rt.solve(dihedral, 10.0, rt.monostatic(90, [0, 1])).plot(ax=ax) is ax


def test_polar_plot(dihedral, sweep, pictures):
    ax = rt.solve(dihedral, 10.0, rt.monostatic(90, np.arange(0, 360, 2.0))).plot_polar()
    assert ax.name == "polar" and "dBsm" in ax.get_title()
    with pytest.raises(rt.InputError, match="one azimuth"):
        sweep.plot_polar()


def test_xarray_plots_with_labels(dihedral, pictures):
    result = rt.solve(dihedral, 10.0, rt.monostatic(90, np.arange(0, 46, 1.0)))
    result.sigma_dbsm.sel(channel="vv").plot()
    assert pictures.gca().get_ylabel() == "radar cross-section [dBsm]" or "dBsm" in pictures.gca().get_ylabel()

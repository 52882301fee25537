#!/usr/bin/env python3
"""Opens what raytube writes as netCDF by xarray, netCDF4, h5netcdf, h5py and ncdump, and rcs.csv by NumPy and pandas.

    netcdf_readers.py PROGRAM      exit code 77 where one of these is missing

Numbers are held against rcs.csv bit for bit: its shortest digits and the file say the same doubles.
"""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

MODULES = ("numpy", "pandas", "xarray", "netCDF4", "h5netcdf", "h5py")
# With edges off a plate returns nothing when seen from its edge: zero, -inf dBsm, is among the numbers.
MESH = "OFF\n4 2 0\n0 0 0\n90 0 0\n90 60 0\n0 60 0\n3 0 1 2\n3 0 2 3\n"
CASE = """title = "plate of 90 × 60 mm"
[target]
mesh = "plate.off"
unit = "mm"
[frequency]
ghz = [9.0, 10.0]
[look]
theta_deg = [10.0, 90.0]
phi_deg = [0, 5, 10]
[edges]
method = "none"
[output]
plots = false
netcdf = true
"""
UNITS = {"frequency": "Hz", "theta_deg": "degree", "phi_deg": "degree", "rx_theta_deg": "degree", "rx_phi_deg": "degree",
         "S_re": "m", "S_im": "m", "sigma_dbsm": "dBsm", "err_db": "dB", "model_db": "dB", "error_m": "m", "model_m": "m",
         "S_mechanism_re": "m", "S_mechanism_im": "m", "model_part_m": "m"}
CONVENTIONS = {"time_convention": "exp(+j omega t)", "phase_reference": "origin", "amplitude_convention": "4 pi |S|^2",
               "polarisation_convention": "theta-hat", "direction_convention": "from +z", "conventions": "# Time factor",
               "geometry": "monostatic", "title": "plate of 90 × 60 mm"}
CHANNELS = (("vv", "v", "v"), ("vh", "v", "h"), ("hv", "h", "v"), ("hh", "h", "h"))


def choose_interpreter():
    """Debian's modules are for Debian's own Python, which need not be the first one on the path."""
    test = f"import {', '.join(MODULES)}"
    for python in (sys.executable, "/usr/bin/python3"):
        if Path(python).exists() and subprocess.run([python, "-c", test], capture_output=True).returncode == 0:
            return python
    return None


def same(a, b, what):
    import numpy as np
    a, b = np.ascontiguousarray(a, dtype=np.float64), np.ascontiguousarray(b, dtype=np.float64)
    assert a.shape == b.shape, f"{what}: {a.shape} and {b.shape}"
    # rcs.csv writes both zeros as 0: adding 0 makes a negative one positive, and changes no other number
    assert ((a + 0.0).view(np.uint64) == (b + 0.0).view(np.uint64)).all(), what


def check_xarray(out, rows):
    import numpy as np
    import xarray
    for engine in ("netcdf4", "h5netcdf"):
        with xarray.open_dataset(out / "rcs.nc", engine=engine) as data:
            assert dict(data.S_re.sizes) == {"look": 6, "frequency": 2, "receive": 2, "transmit": 2}, data.S_re.sizes
            assert [str(x) for x in data.receive.values] == ["v", "h"] and [str(x) for x in data.transmit.values] == ["v", "h"]
            assert {"frequency", "theta_deg", "phi_deg"} <= set(data.coords)
            for name, units in UNITS.items():
                assert data[name].attrs["units"] == units and data[name].attrs["long_name"], name
            for name, words in CONVENTIONS.items():
                # netCDF marks its text as ASCII whatever it is, which h5netcdf takes at its word
                assert words in data.attrs[name].encode("utf-8", "surrogateescape").decode(), name
            for channel, p, q in CHANNELS:
                one = data.sel(receive=p, transmit=q)
                for variable, column in (("S_re", f"re_{channel}"), ("S_im", f"im_{channel}"), ("sigma_dbsm", f"sigma_{channel}_dbsm"),
                                         ("err_db", f"err_{channel}_db"), ("model_db", f"model_{channel}_db")):
                    same(one[variable].values.reshape(-1), rows[column], f"{engine} {column}")
            for key in ("theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"):
                same(np.repeat(data[key].values, 2), rows[key], f"{engine} {key}")
            same(np.tile(data.frequency.values, 6), rows["freq_hz"], f"{engine} freq_hz")
            assert np.isneginf(data.sigma_dbsm.values).any(), "a plate seen from its edge returns nothing"
            mechanisms = [str(x) for x in data.mechanism.values]
            assert mechanisms[0] == "bounce_1" and "edges_order_1" in mechanisms, mechanisms
            difference = np.abs(data.S_mechanism_re.sum("mechanism") - data.S_re).max()
            assert difference <= 1e-15 * np.abs(data.S_re).max(), "mechanisms add up to S"  # rounding of a sum


def check_attributes(out):
    import netCDF4
    import numpy as np
    run = json.loads((out / "run.json").read_text())
    with netCDF4.Dataset(out / "rcs.nc") as file:
        assert json.loads(file.case) == run["case"], "the resolved case"
        assert file.raytube_version == run["version"] and file.mesh_sha256 == run["mesh"]["sha256"]
        assert file.rcs_csv_sha256 == run["rcs_csv_sha256"]
        assert json.loads(file.warnings) == run["warnings"] and json.loads(file.counts) == run["counts"]
        assert list(file.variables["receive"][:]) == ["v", "h"]
        assert not np.ma.is_masked(file.variables["sigma_dbsm"][:]), "no number counts as missing"


def check_h5py(out, rows):
    import h5py
    with h5py.File(out / "rcs.nc", "r") as file:
        same(file["S_re"][:, :, 1, 0].reshape(-1), rows["re_hv"], "h5py re_hv")
        same(file["sigma_dbsm"][:, :, 0, 0].reshape(-1), rows["sigma_vv_dbsm"], "h5py sigma_vv_dbsm")
        assert file["receive"][:].tobytes() == b"vh"
        assert file["S_re"].attrs["units"] == b"m"


def check_ncdump(out):
    header = subprocess.run(["ncdump", "-h", str(out / "rcs.nc")], capture_output=True, check=True).stdout.decode()
    for line in ("look = 6 ;", "frequency = 2 ;", "double S_re(look, frequency, receive, transmit) ;", 'S_re:units = "m" ;',
                 'frequency:units = "Hz" ;'):
        assert line in header, line
    values = subprocess.run(["ncdump", "-v", "sigma_dbsm,receive", str(out / "rcs.nc")], capture_output=True, check=True).stdout.decode()
    assert "-Infinity" in values and '"v",' in values


def check_tables(out, rows):
    import numpy as np
    import pandas
    file = out / "rcs.csv"
    with open(file) as lines:
        comments = sum(line.startswith("#") for line in lines)
    table = np.genfromtxt(file, delimiter=",", names=True, skip_header=comments)
    # read_csv rounds as strtod does only when told so
    frame = pandas.read_csv(file, comment="#", float_precision="round_trip")
    for column, values in rows.items():
        same(table[column], values, f"genfromtxt {column}")
        same(frame[column], values, f"read_csv {column}")


def read_rows(file):
    import numpy as np
    with open(file) as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def main():
    program = str(Path(sys.argv[1]).resolve())
    python = choose_interpreter()
    if python is None or not shutil.which("ncdump"):
        print(f"SKIPPED: there is no {'ncdump' if python else ', or no '.join(MODULES)}")
        sys.exit(77)
    if python != sys.executable:
        os.execv(python, [python, *sys.argv])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "plate.off").write_text(MESH)
        (folder / "case.toml").write_text(CASE)
        subprocess.run([program, "run", "case.toml", "--parts", "--quiet"], cwd=folder, check=True)
        out = folder / "out"
        rows = read_rows(out / "rcs.csv")
        check_xarray(out, rows)
        check_attributes(out)
        check_h5py(out, rows)
        check_ncdump(out)
        check_tables(out, rows)


if __name__ == "__main__":
    main()

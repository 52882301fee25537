"""The package computes what the program computes, to the last bit."""
import numpy as np
import pytest
from conftest import CASES

import raytube as rt

pytestmark = pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")

FEW = {"look.phi_deg": {"start": 0, "stop": 20, "step": 20}}
QUICK = {
    "plate/case": {},
    "powercube/case": {},
    "powercube/chamber": {"look.phi_deg": {"start": -10, "stop": 10, "step": 1}},
    "sphere/case": {},
    "sphere/bistatic": {"receive.phi_deg": [0.0, 60.0, 170.0]},
    "trihedral/case": {},
    "radome/case": {},
    "coated_sphere/case": {"frequency.ghz": [2.0, 3.0]},
    "convergence/case": {},
    "convergence/dihedral": {},
    "stochastic/sphere": {},
    "stochastic/dihedral": {},
    "almond/case": FEW,
    "wing/case": FEW,
}


def options(overrides):
    """As the command line wants them."""
    def text(value):
        if isinstance(value, dict):
            return "{" + ",".join(f"{key}={entry}" for key, entry in value.items()) + "}"
        return str(value)

    return [word for key, value in overrides.items() for word in ("--set", f"{key}={text(value)}")]


@pytest.mark.parametrize("name", QUICK)
def test_run_writes_the_bytes_of_the_program(name, program, tmp_path):
    case, overrides = CASES / f"{name}.toml", QUICK[name]
    program("run", case, "-o", tmp_path / "out", "--quiet", "--set", "output.plots=false", *options(overrides))
    rt.run(case, overrides).save(tmp_path / "rcs.csv")
    assert (tmp_path / "rcs.csv").read_bytes() == (tmp_path / "out/rcs.csv").read_bytes()


@pytest.mark.parametrize("name", ["plate/case", "powercube/chamber", "radome/case", "trihedral/case"])
def test_netcdf_has_the_bytes_of_the_program(name, program, tmp_path):
    case, overrides = CASES / f"{name}.toml", QUICK[name]
    program("run", case, "-o", tmp_path / "program.nc", "--parts", "--quiet", *options(overrides))
    rt.run(case, overrides, keep_mechanisms=True).save(tmp_path / "python.nc")
    assert (tmp_path / "python.nc").read_bytes() == (tmp_path / "program.nc").read_bytes()


def test_saving_a_table_as_netcdf_is_convert(program, tmp_path):
    rt.run(CASES / "trihedral/case.toml").save(tmp_path / "a.csv")
    program("convert", tmp_path / "a.csv", tmp_path / "program.nc")
    rt.load(tmp_path / "a.csv").save(tmp_path / "python.nc")
    assert (tmp_path / "python.nc").read_bytes() == (tmp_path / "program.nc").read_bytes()


def test_netcdf_carries_the_warnings_of_the_program(program, tmp_path):
    """Also those of the mesh, which no key is to blame for."""
    (tmp_path / "patch.obj").write_text("v 0 0 0\nv .3 0 0\nv .3 .3 0\nv 0 .3 0\nf 1 2 3 4\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 4 3\nend\n")
    case = tmp_path / "case.toml"
    case.write_text('[target]\nmesh = "patch.obj"\nunit = "m"\n[frequency]\nghz = 10\n[look]\ntheta_deg = 10\nphi_deg = 0\n')
    program("run", case, "-o", tmp_path / "program.nc", "--quiet")
    result = rt.run(case)
    result.save(tmp_path / "python.nc")
    assert any("free-form" in sentence for sentence in result.warnings)
    assert (tmp_path / "python.nc").read_bytes() == (tmp_path / "program.nc").read_bytes()


def same(result, case, overrides):
    assert np.array_equal(result.S.values, rt.run(case, overrides).S.values)
    ours, files = dict(result.case), dict(rt.run(case, overrides).case)
    for entry in (ours, files):  # the names of the case and of its mesh are those of their places
        entry.pop("title"), entry.pop("target"), entry.pop("look")
    assert ours == files


def test_keywords_are_the_keys_of_a_case():
    target = rt.Target.load(CASES / "powercube/powercube.stl", unit="mm")
    looks = rt.monostatic(theta_deg=90.0, phi_deg={"start": 0, "stop": 4, "step": 0.5})
    result = rt.solve(target, ghz=94.0, looks=looks, edges={"order": 1}, tubes={"max_bounces": 3}, accuracy={"tolerance_db": 0.5})
    same(result, CASES / "powercube/case.toml", {"edges.order": 1, "tubes.max_bounces": 3, "accuracy.tolerance_db": 0.5,
                                                "look.phi_deg": {"start": 0, "stop": 4, "step": 0.5}})


def test_materials_of_parts():
    files = [CASES / "dihedral/dihedral.off", CASES / "radome/sheet.off"]
    case = rt.run(CASES / "radome/case.toml", {"look.phi_deg": [0.0, 10.0]})
    asked, look = case.case, case.case["look"]
    target = rt.Target.load(files, unit="mm")
    sections = {name: asked[name] for name in ("materials", "tubes", "edges", "surfaces", "accuracy")}
    result = rt.solve(target, asked["frequency"]["ghz"], rt.monostatic(look["theta_deg"], look["phi_deg"]),
                      parts={str(files[1]): "laminate"}, **sections)
    assert np.array_equal(result.S.values, case.S.values)
    bare = rt.solve(target, asked["frequency"]["ghz"], rt.monostatic(look["theta_deg"], look["phi_deg"]))
    assert not np.allclose(result.S.values, bare.S.values)


def test_the_name_of_a_single_file_names_all_of_it(tmp_path):
    file = CASES / "plate/plate.off"
    target, looks = rt.Target.load(file, unit="m"), rt.monostatic(10, 0)
    by_name = rt.solve(target, 3.0, looks, parts={str(file): "absorber"})
    assert np.array_equal(by_name.S.values, rt.solve(target, 3.0, looks, material="absorber").S.values)


def test_bistatic_looks(sphere):
    result = rt.solve(sphere, 3.0, rt.bistatic(90, 0, 90, [0.0, 60.0, 170.0]))
    same(result, CASES / "sphere/bistatic.toml", {"receive.phi_deg": [0.0, 60.0, 170.0]})


def test_finite_range(dihedral):
    case = CASES / "dihedral/chamber.toml"
    asked = rt.check(case)["case"]["radar"]
    few = rt.looks([90.0, 90.0], [0.0, 30.0])
    result = rt.solve(dihedral, 94.0, few, radar=asked, edges={"method": "none"})
    assert np.all(result.S.range_m == asked["range_m"])
    far = rt.solve(dihedral, 94.0, few, edges={"method": "none"})
    assert not np.allclose(result.S.values, far.S.values)


def test_lists_of_looks_by_file_and_by_arrays(dihedral, tmp_path):
    (tmp_path / "my looks.csv").write_text("theta_deg,phi_deg\n90,0\n80,17.25\n70,-3\n")
    theta, phi = [90, 80, 70], [0, 17.25, -3]
    by_file = rt.solve(dihedral, 10.0, rt.looks(tmp_path / "my looks.csv"))
    by_arrays = rt.solve(dihedral, 10.0, rt.looks(theta, phi))
    by_tables = rt.solve(dihedral, 10.0, rt.looks(np.array(theta, dtype=np.int16), np.array(phi)))
    assert np.array_equal(by_file.S.values, by_arrays.S.values)
    assert np.array_equal(by_arrays.S.values, by_tables.S.values)
    assert by_arrays.S.phi_deg.values.tolist() == phi and len(rt.looks(theta, phi)) == 3
    for number in range(3):  # each look alone
        alone = rt.solve(dihedral, 10.0, rt.monostatic(theta[number], phi[number]))
        assert np.array_equal(alone.S.values[0], by_arrays.S.values[number])


def test_any_number_of_threads_gives_the_same_bits(dihedral):
    looks = rt.monostatic(90, np.arange(0, 46, 5))
    assert np.array_equal(rt.solve(dihedral, 94.0, looks, threads=1).S.values, rt.solve(dihedral, 94.0, looks, threads=3).S.values)


def test_columns_of_pandas_and_xarray_are_numbers():
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    columns = pandas.DataFrame({"theta": [0.0, 10.0], "ghz": [9.0, 10.0]})
    plate = rt.Target(pandas.DataFrame([[0, 0, 0], [0.3, 0, 0], [0, 0.3, 0]]), pandas.DataFrame([[0, 1, 2]]), unit="m")
    wanted = rt.solve(plate, [9.0, 10.0], rt.monostatic([0.0, 10.0], 0.0)).S.values
    for looks in (rt.monostatic(columns.theta, 0.0), rt.looks(columns.theta, xarray.DataArray([0.0, 0.0]))):
        assert np.array_equal(rt.solve(plate, columns.ghz, looks).S.values, wanted)


def test_looks_tell_the_angles_that_a_solve_has(dihedral):
    for looks in (rt.monostatic([80, 90], {"start": 0, "stop": 1, "step": 0.1}), rt.bistatic(90, [0, 10], {"start": 80, "stop": 90, "count": 3}, 5)):
        result = rt.solve(dihedral, 10.0, looks, edges={"method": "none"})
        assert len(looks) == result.S.sizes["look"]
        for name in ("theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"):
            if name in result.S.coords:  # a range may differ from the program's in the last bit
                assert np.allclose(getattr(looks, name), result.S[name].values, rtol=0, atol=1e-12)

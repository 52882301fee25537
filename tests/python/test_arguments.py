"""Whatever is given wrongly is told in one sentence, and nothing ends the interpreter."""
import copy
import decimal
import fractions
import os
import pickle
import types

import numpy as np
import pandas
import pytest
import xarray
from conftest import CASES, SQUARE

import raytube as rt

FACE = [[0, 1, 2, 3]]
LOOK = rt.monostatic(10, 0)
itself = []
itself.append(itself)
table_itself = {}
table_itself["a"] = table_itself


def target(vertices=SQUARE, faces=FACE, unit="m", **more):
    return rt.Target(vertices, faces, unit, **more)


def solve(ghz=10.0, looks=LOOK, **keywords):
    return rt.solve(target(), ghz, looks, **keywords)


WRONG = {
    "unknown key": (lambda: solve(edges={"ordr": 2}), 'unknown key "edges.ordr"; did you mean "edges.order"'),
    "wrong type": (lambda: solve(edges={"order": "two"}), "edges.order must be a number"),
    "no section": (lambda: solve(edges="none"), "edges must be a section"),
    "no key": (lambda: solve(edges={3: 2}), 'unknown key "edges.3"'),
    "unknown material": (lambda: solve(material="gold"), '"gold" is no material'),
    "unknown part of a nameless mesh": (lambda: solve(parts={"x": "pec"}), "x is not a name in the mesh; there are no names"),
    "facet beyond": (lambda: solve(facets={"absorber": [7]}), "names facet 7, but the mesh has 1"),
    "complex number": (lambda: solve(material="c", materials={"c": {"kind": "coated", "eps_r": 4 - 1j}}), "materials.c.eps_r: a value of the type complex"),
    "negative frequency": (lambda: solve(-1), "frequency.ghz must be greater than 0"),
    "NaN frequency": (lambda: solve([1, np.nan]), "finite number"),
    "no frequency": (lambda: solve([]), "empty list"),
    "None for a frequency": (lambda: solve(None), "ghz is missing"),
    "table of frequencies": (lambda: solve(np.ones((2, 2))), "must be a number"),
    "text for a frequency": (lambda: solve("10"), "frequency.ghz must be a number"),
    "texts for frequencies": (lambda: solve(np.array(["10"])), "must be a number"),
    "complex frequencies": (lambda: solve(np.array([9 + 1j])), "type complex"),
    "dates for frequencies": (lambda: solve(np.array(["2020-01-01"], dtype="M8[D]")), "type datetime.date"),
    "masked angles": (lambda: rt.monostatic(0, np.ma.array([0.0, 10.0], mask=[0, 1])), "monostatic: phi_deg: give numbers"),
    "masked frequencies": (lambda: solve(np.ma.array([9.0, 10.0], mask=[0, 1])), "type NoneType"),
    "generator": (lambda: solve(ghz for ghz in [9, 10]), "type generator"),
    "set": (lambda: solve({9, 10}), "type set"),
    "huge number": (lambda: solve(10**400), "cannot be held"),
    "list that holds itself": (lambda: solve(itself), "nested too deeply"),
    "table that holds itself": (lambda: solve(materials=table_itself), "nested too deeply"),
    "half a character": (lambda: solve(title="\ud800"), "UTF-8"),
    "half a character in a key": (lambda: solve(edges={"\ud800": 1}), "UTF-8"),
    "huge sweep": (lambda: solve({"start": 1, "stop": 10, "count": 10**9}), "more than the 1000000 allowed"),
    "too much memory": (lambda: solve(threads=10**6), "GB of memory"),
    "negative threads": (lambda: solve(threads=-1), "threads: give a whole number from 0"),
    "text for threads": (lambda: solve(threads="2"), "threads: give a whole number (found str)"),
    "odd flag": (lambda: solve(keep_mechanisms="yes"), "keep_mechanisms: give True or False"),
    "odd progress": (lambda: solve(progress=3), "progress (or a callable)"),
    "no looks": (lambda: solve(looks=None), "looks are missing"),
    "odd looks": (lambda: solve(looks=[1, 2]), "looks are made by raytube.monostatic"),
    "no target": (lambda: rt.solve("car.obj", 10, LOOK), "the first argument is str, no Target"),
    "target for run": (lambda: rt.run(target()), "takes a case file"),
    # check, image, trace, converge
    "unknown keyword": (lambda: rt.check(target(), 10, LOOK, edgs={}), "there is no keyword 'edgs' here; did you mean 'edges'?"),
    "unlike any keyword": (lambda: rt.check(target(), 10, LOOK, qqq={}), "there is no keyword 'qqq' here; choose among ghz, looks"),
    "keyword beside a file": (lambda: rt.image("x.toml", edges={}), "changed by overrides"),
    "too many": (lambda: rt.trace(target(), 10, LOOK, 3), "too many arguments"),
    "twice": (lambda: rt.check(target(), 10, LOOK, ghz=3), "ghz is given twice"),
    "ghz missing": (lambda: rt.converge(target()), "ghz is missing"),
    "looks missing": (lambda: rt.check(target(), 10), "looks are missing"),
    "look beyond": (lambda: rt.image(target(), 10, LOOK, look=5), "there are 1 direction pair(s)"),
    "negative look": (lambda: rt.image(target(), 10, LOOK, look=-1), "look: give a whole number"),
    "no cells": (lambda: rt.image(target(), 10, LOOK, per_wavelength=0), "per_wavelength: give a positive number"),
    "outside": (lambda: rt.trace(target(), 10, LOOK, u=50), "lies outside the launch rectangle"),
    "NaN place": (lambda: rt.trace(target(), 10, LOOK, u=np.nan), "u: give a finite number"),
    "two densities": (lambda: rt.converge(target(), 10, LOOK, densities=[1, 2]), "three different densities"),
    "negative density": (lambda: rt.converge(target(), 10, LOOK, densities=[1, 2, -3]), "densities: give three or more positive"),
    # case files
    "no file": (lambda: rt.run("no.toml"), "no such file"),
    "None for a file": (lambda: rt.run(None), "run: give the path of a file (found None)"),
    "list of overrides": (lambda: rt.run("x.toml", ["a"]), "overrides: give a dictionary"),
    "odd override": (lambda: rt.run("x.toml", {"tubes.max_bounces": object()}), "tubes.max_bounces: object is nothing that a case can hold"),
    "unknown override": (lambda: rt.run(CASES / "plate/case.toml", {"tubes.bounces": 5}), 'unknown key "tubes.bounces"'),
    # directions
    "text for an angle": (lambda: rt.monostatic("a", 0), "monostatic: theta_deg: give numbers"),
    "None for an angle": (lambda: rt.monostatic([None], 0), "monostatic: theta_deg: give numbers"),
    "table of angles": (lambda: rt.monostatic(0, [[1, 2], [3, 4]]), "monostatic: phi_deg: give a number or a list"),
    "half a range": (lambda: rt.bistatic(0, 0, 0, {"start": 0, "stop": 1}), "bistatic: rx_phi_deg: a range has start, stop and step"),
    "endless range": (lambda: rt.monostatic({"start": 0, "stop": 1, "step": 0}, 0), "choose another step"),
    "theta beyond": (lambda: solve(looks=rt.monostatic(200, 0)), "theta_deg must be from 0 to 180"),
    "no angles": (lambda: solve(looks=rt.monostatic([], 0)), "empty list"),
    "lengths": (lambda: rt.looks([1, 2], [1]), "differ in length"),
    "theta alone": (lambda: rt.looks([1, 2]), "give theta_deg and phi_deg"),
    "file and arrays": (lambda: rt.looks("looks.csv", [1]), "give a file or arrays"),
    "no list": (lambda: solve(looks=rt.looks("no.csv")), "no.csv: cannot be read"),
    "empty list": (lambda: solve(looks=rt.looks([], [])), "no looks"),
    "NaN in a list": (lambda: solve(looks=rt.looks([np.nan], [0])), "look 0: nan is not an angle"),
    # meshes
    "NaN vertex": (lambda: target([[0, 0, np.nan], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), "vertex 0 is (0, 0, nan); give finite"),
    "no vertices": (lambda: target([]), "vertices: give an array of the shape (n, 3)"),
    "flat vertices": (lambda: target([[0, 0], [1, 0], [0, 1]]), "shape (n, 3)"),
    "ragged vertices": (lambda: target([[1, 2], [1, 2, 3]]), "vertices: give numbers"),
    "complex vertices": (lambda: target(np.array(SQUARE) * 1j), "vertices: give numbers"),
    "no faces": (lambda: target(faces=[]), "faces: give an array of the shape (n, 3)"),
    "None for faces": (lambda: target(faces=None), "faces: give the corners of each face"),
    "one face flat": (lambda: target(faces=[0, 1, 2]), "faces: give an array of the shape (n, 3)"),
    "float corners": (lambda: target(faces=[[0.0, 1.0, 2.0]]), "corners are whole numbers"),
    "float corners in lists": (lambda: target(faces=[[0, 1.7, 2], [0, 1, 2, 3]]), "whole numbers"),
    "truth for corners": (lambda: target(faces=np.array([[True, False, True]])), "corners are whole numbers"),
    "corner beyond": (lambda: target(faces=[[0, 1, 9]]), "face 0 has the corner 9, but there are 4 vertices"),
    "huge corner": (lambda: target(faces=[[0, 1, 2**70]]), "whole numbers"),
    "huge unsigned corner": (lambda: target(faces=np.array([[0, 1, 2**64 - 1]], dtype=np.uint64)), "whole numbers"),
    "-1 in the middle": (lambda: target(faces=[[0, -1, 2, 3]]), "face 0 has a -1 before its last corner"),
    "-2": (lambda: target(faces=[[0, 1, 2, -2]]), "face 0 has the corner -2"),
    "two corners": (lambda: target(faces=[[0, 1, -1]]), "face 0 has 2 corners; give three or more"),
    "no area": (lambda: rt.solve(target(faces=[[0, 0, 0]]), 10, LOOK), "no facet has an area"),
    "wrong unit": (lambda: target(unit="furlong"), 'unit "furlong" is unknown'),
    "None for a unit": (lambda: target(unit=None), 'unit "None" is unknown; write "m"'),
    "no mesh": (lambda: rt.Target.load("no.obj", "m"), "not found"),
    "empty list of meshes": (lambda: rt.Target.load([], "m"), "name at least one"),
    "zero in a path": (lambda: rt.Target.load("a\0b", "m"), "names no file"),
    "names short": (lambda: target(parts=["a", "b"]), "2 names for 1 faces"),
    "face of a part beyond": (lambda: target(parts={"a": [3]}), "'a' has the face 3"),
    "odd faces of a part": (lambda: target(parts={"a": [0.5]}), "'a' wants the numbers of its faces"),
    "one name for all": (lambda: target(parts="a"), "give the name of each face's part"),
    # results and files
    "odd suffix": (lambda: solve().save("x.txt"), "saved as .nc or .csv"),
    "no folder": (lambda: solve().save("/no folder/x.nc"), "no file can be written there"),
    "no parts": (lambda: solve().mechanisms, "solve with keep_mechanisms=True"),
    "odd channel": (lambda: solve().plot(("vv", "xx")), "channels are vv, vh, hv, hh"),
    "no result": (lambda: rt.load("no.nc"), "cannot be read"),
    "odd result": (lambda: rt.load("x.json"), "read_radar_explorer"),
    "compare with nothing": (lambda: rt.compare(None, solve()), "result: give a Result or the path of a file (found None)"),
    "compare with an array": (lambda: rt.compare(solve(), solve().S), "reference: give a Result or the path of a file (found DataArray)"),
    "columns of a result": (lambda: rt.compare(solve(), solve(), reference_columns="phi_deg=a"), "reference_columns: reference is not a table"),
    "odd columns": (lambda: rt.compare(solve(), "x.csv", reference_columns=[1]), "reference_columns: give a text"),
    "negative decibels": (lambda: rt.compare(solve(), solve(), within_db=-1), "within_db: give 0 or more"),
    "odd column": (lambda: rt.compare(solve(), solve(), only={"x": 3}), "there is no column x"),
    "odd range": (lambda: rt.compare(solve(), solve(), only={"phi_deg": (3, 1)}), "the lowest and the highest"),
    "no row": (lambda: rt.compare(solve(), solve(), only={"phi_deg": 77}), "no row has phi_deg"),
    "no metadata": (lambda: rt.read_radar_explorer(None), "read_radar_explorer: give the path"),
}


@pytest.mark.parametrize("what", WRONG)
def test_wrong(what):
    call, words = WRONG[what]
    with pytest.raises(rt.InputError) as raised:
        call()
    sentence = str(raised.value)
    assert words in sentence and "\n" not in sentence
    assert isinstance(raised.value, ValueError)
    assert solve().S.shape == (1, 1, 2, 2)  # and the next call is right


RIGHT = {
    "numpy scalars": lambda: solve(np.float32(10), edges={"order": np.int8(2)}),
    "arrays of no dimension": lambda: solve(np.array(10.0), edges={"order": np.array(2)}),
    "decimal": lambda: solve(decimal.Decimal(10), edges={"order": fractions.Fraction(2)}),
    "series": lambda: solve(pandas.Series([10.0]), edges={"order": 2}),
    "labelled array": lambda: solve(xarray.DataArray([10.0], dims="x"), edges={"order": 2}),
    "range": lambda: solve(range(10, 11), edges={"order": 2}),
    "objects": lambda: solve(np.array([10], dtype=object), edges={"order": 2}),
    "mapping": lambda: solve(10, edges=types.MappingProxyType({"order": 2})),
    "None is not said": lambda: solve(10, edges={"order": 2, "method": None}, tubes=None),
    "not contiguous": lambda: rt.solve(target(np.array(SQUARE * 2)[::1][:4].copy(order="F"), np.array([[0, 9, 1, 9, 2, 9, 3]])[:, ::2]), 10, LOOK, edges={"order": 2}),
    "lists of lists": lambda: rt.solve(target([tuple(p) for p in SQUARE], [range(4)]), 10, LOOK, edges={"order": 2}),
    "copies": lambda: rt.solve(copy.deepcopy(target()), 10, copy.deepcopy(LOOK), edges={"order": 2}),
}


@pytest.mark.parametrize("what", RIGHT)
def test_right(what):
    assert np.array_equal(RIGHT[what]().S.values, solve(10.0, edges={"order": 2}).S.values)


@pytest.mark.parametrize("title", ["a\nb", 'quo"te\\', "é→𝄞", "\x7f\t", "'''", "{}"])
def test_texts_come_through(title):
    assert solve(title=title).title == title
    assert rt.run(CASES / "trihedral/case.toml", {"title": title}).title == title


def test_polygons_of_different_length():
    faces = [[0, 1, 2, 3], [0, 1, 2]]
    assert target(faces=faces).faces == faces
    assert target(faces=[[0, 1, 2, 3], [0, 1, 2, -1]]).faces == faces


def test_what_a_target_says_of_itself():
    assert repr(target(unit="mm")).endswith("1 facets, " + " x ".join(f"{a:.4g}" for a in np.ptp(SQUARE, axis=0)) + " mm")
    assert copy.copy(t := target()) is t


@pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")
@pytest.mark.parametrize("unit, faces, parts", [("m", [[0, 1, 2, 3]], None), ("mm", [[0, 1, 2], [0, 2, 3]], ["", "fin"])])
def test_a_target_in_another_process_is_the_same(unit, faces, parts):
    one = target(unit=unit, faces=faces, parts=parts)
    other = pickle.loads(pickle.dumps(one))
    assert repr(other) == repr(one) and other.parts == one.parts and other.faces == one.faces
    given = {} if parts is None else {"parts": {"fin": "absorber"}}
    results = [rt.solve(t, 10.0, rt.monostatic(10, 20), **given) for t in (one, other)]
    assert np.array_equal(results[0].S.values, results[1].S.values) and results[0].attributes == results[1].attributes


def test_a_file_with_several_names_a_facet_in_another_process(tmp_path):
    (tmp_path / "two.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\ng hull \xfcber\nf 1 2 3 4\nusemtl glass\nf 1 2 5\n")
    one = rt.Target.load(tmp_path / "two.obj", unit="m")
    other = pickle.loads(pickle.dumps(one))
    assert repr(other) == repr(one) and sorted(other.parts) == sorted(one.parts) and len(one.parts) == 3
    results = [rt.solve(t, 1.0, rt.monostatic(60, 20), parts={"glass": "absorber"}) for t in (one, other)]
    assert np.array_equal(results[0].S.values, results[1].S.values) and results[0].attributes == results[1].attributes


def test_angles_and_corners_from_tables():
    """Whatever makes an array of itself is taken, also where it has a method named mask."""
    table = pandas.DataFrame({"theta_deg": [10.0, 20.0], "phi_deg": [0, 5]})
    wanted = rt.looks([10.0, 20.0], [0, 5])
    for looks in (rt.looks(table.theta_deg, table.phi_deg), rt.looks(*table.to_xarray().data_vars.values())):
        assert np.array_equal(looks.theta_deg, wanted.theta_deg) and np.array_equal(looks.phi_deg, wanted.phi_deg)
    assert np.array_equal(rt.monostatic(90, table.phi_deg).phi_deg, [0, 5])
    assert np.array_equal(target(pandas.DataFrame(SQUARE)).vertices, SQUARE)


def test_files_in_odd_places(tmp_path):
    folder = tmp_path / "a folder, é"
    folder.mkdir()
    (folder / "my mesh.off").write_bytes((CASES / "plate/plate.off").read_bytes())
    result = rt.solve(rt.Target.load(folder / "my mesh.off", "m"), 3.0, LOOK)
    for suffix in (".nc", ".csv"):
        result.save(folder / f"ré sult{suffix}")
        assert np.array_equal(rt.load(folder / f"ré sult{suffix}").S.values, result.S.values)


def test_names_that_are_no_utf8(tmp_path):
    """Names of files are bytes, and so are those of parts in files of other programs."""
    folder = os.fsencode(tmp_path) + b"/\xff"
    os.mkdir(folder)
    with open(folder + b"/latin\xfe.obj", "wb") as mesh:
        mesh.write(b"v 0 0 0\nv .3 0 0\nv .3 .3 0\nv 0 .3 0\ng T\xfcr\nf 1 2 3 4\n")
    latin = rt.Target.load(os.fsdecode(folder + b"/latin\xfe.obj"), "m")
    assert latin.parts == ["T\\xfcr"] and "latin\\xfe.obj" in repr(latin)
    result = rt.solve(latin, 10.0, LOOK)
    assert np.array_equal(result.S.values, solve(10.0).S.values)
    file = os.fsdecode(folder + b"/result.nc")
    result.save(file)
    assert np.array_equal(rt.load(file).S.values, result.S.values)
    with pytest.raises(rt.InputError, match=r"xff/gone\.nc: cannot be read"):
        rt.load(os.fsdecode(folder + b"/gone.nc"))
    with open(folder + b"/case.toml", "w") as case:
        case.write(f'[target]\nmesh = "{CASES}/plate/plate.off"\nunit = "m"\n[frequency]\nghz = 3\n[look]\ntheta_deg = 10\nphi_deg = 0\n')
    assert "xff/case.toml" in repr(rt.check(os.fsdecode(folder + b"/case.toml")))


def test_looks_of_columns_of_tables():
    """A Series has a method `mask`, which says nothing of what is missing."""
    table = pandas.DataFrame({"theta": [10.0, 20.0], "phi": [0.0, 5.0]})
    looks = rt.looks(table.theta, table.phi)
    assert looks.theta_deg.tolist() == [10, 20] and looks.phi_deg.tolist() == [0, 5]
    assert len(rt.monostatic(table.theta, 0)) == 2
    with pytest.raises(rt.InputError, match="looks: give numbers"):
        rt.looks(np.ma.array([1.0, 2.0], mask=[True, False]), [0, 0])


def test_looks_do_not_go_with_positions():
    at = {"position_m": [[0, 0, 3]]}
    for looks in (rt.monostatic(10, 0), rt.looks([10], [0])):
        with pytest.raises(rt.InputError, match="cannot be combined with radar.position_m"):
            solve(10, looks, radar=at, edges={"method": "none"})
    assert solve(10, None, radar=at, edges={"method": "none"}).S.range_m.item() == 3


def test_overrides_may_be_lists_of_lists():
    overrides = {"target.facets.lossy": [0, [1, 2]], "materials.lossy": {"kind": "coated", "eps_r": [4.0, 0.4], "thickness_mm": 2.0}}
    asked = rt.run(CASES / "trihedral/case.toml", overrides | {"look.phi_deg": np.array(45.0), "look.theta_deg": np.array([54.0])}).case
    assert asked["target"]["facets"] == {"lossy": [[0, 2]]} and asked["look"]["phi_deg"] == 45


def test_missing_and_unknown_arguments_of_python():
    for call, word in ((lambda: rt.solve(target()), "ghz"), (lambda: solve(edgs={}), "edgs"), (lambda: rt.Target(SQUARE, FACE), "unit")):
        with pytest.raises(TypeError, match=word):
            call()

"""Time, memory and error of looks at vehicles: the car of bench/car.py, small and full, and meshes [m] of a folder."""
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import car

AZIMUTHS = [10.0, 40.0, 75.0, 110.0, 160.0]  # [deg] five looks in the horizontal plane
MESHES = (".obj", ".stl", ".ply", ".off")
REFERENCE = {"tubes.per_wavelength": 80, "accuracy.tolerance_db": 0.01}  # of the tubes alone
WITHIN_DB = 40.0  # of the strongest look: below, decibels say little


def instruction_sets():
    flags = pathlib.Path("/proc/cpuinfo").read_text().split()
    return ["avx2", "avx512"] if "avx512f" in flags else ["avx2"]


def run(build, folder, mesh, ghz, instruction_set, **settings):
    """run.json and the rows of one run on two threads."""
    case = folder / "case.toml"
    case.write_text(f'[target]\nmesh = {json.dumps(str(mesh))}\nunit = "m"\n[frequency]\nghz = {ghz}\n[look]\ntheta_deg = 90.0\n'
                    f"phi_deg = {AZIMUTHS}\n[output]\nplots = false\n")
    sets = [text for key, value in settings.items() for text in ("--set", f"{key}={json.dumps(value)}")]
    with tempfile.TemporaryDirectory() as output:
        subprocess.run([build / "raytube", "run", case, "-o", output, "--quiet", "--threads", "2", "--instruction-set",
                        instruction_set, *sets], check=True, capture_output=True)
        with open(f"{output}/rcs.csv", encoding="ascii") as table:
            rows = list(csv.DictReader(line for line in table if not line.startswith("#")))
        return json.loads(pathlib.Path(output, "run.json").read_text()), rows


def error_of_tubes(rows, reference):
    """Medians over the looks of the true error of VV and of what the rows tell of it [dB]."""
    top = max(float(row["sigma_vv_dbsm"]) for row in reference)
    pairs = [(a, b) for a, b in zip(rows, reference) if float(b["sigma_vv_dbsm"]) > top - WITHIN_DB]
    return {"error_db": statistics.median(abs(float(a["sigma_vv_dbsm"]) - float(b["sigma_vv_dbsm"])) for a, b in pairs),
            "told_db": statistics.median(float(a["err_vv_db"]) for a, _ in pairs)}


def figures(build, folder, name, mesh, ghz):
    print(f"measuring: {name} at {ghz:g} GHz", file=sys.stderr, flush=True)
    tubes = {"edges.method": "none"}
    found = {"name": name, "ghz": ghz, "looks": len(AZIMUTHS), "seconds_per_look": {}, "tubes_seconds_per_look": {}}
    for instruction_set in instruction_sets():
        told, _ = run(build, folder, mesh, ghz, instruction_set)
        alone, rows = run(build, folder, mesh, ghz, instruction_set, **tubes)
        found["seconds_per_look"][instruction_set] = told["time"]["solve_s"] / len(AZIMUTHS)
        found["tubes_seconds_per_look"][instruction_set] = alone["time"]["solve_s"] / len(AZIMUTHS)
    triangles = told["mesh"]["triangles_read"]
    _, reference = run(build, folder, mesh, ghz, instruction_set, **tubes, **REFERENCE)
    return found | error_of_tubes(rows, reference) | {
        "triangles": triangles, "peak_rss_bytes": told["peak_rss_bytes"],
        "build_us_per_triangle": 1e6 * (told["time"]["read_s"] + told["time"]["build_s"]) / triangles}


def measure(build, quick, meshes):
    """A list of figures, one for each vehicle and frequency."""
    jobs = [("small car", {"facets": 2500}, [10.0])] if quick else [
        ("car", {"facets": car.FACETS}, [10.0, 77.0]), ("full car", {"facets": 360_000, "trim": 1000}, [10.0, 77.0])]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        found = []
        for title, options, frequencies in jobs:
            car.write(car.car(**options), folder / "car.ply")
            found += [figures(build, folder, title, folder / "car.ply", ghz) for ghz in frequencies]
        files = sorted(path for path in meshes.iterdir() if path.suffix.lower() in MESHES) if meshes else []
        return found + [figures(build, folder, path.name, path.resolve(), 10.0) for path in files]


def table_rows(data):
    def each(times):
        return " / ".join(f"{times[kind]:.2g}" for kind in sorted(times))

    for v in data:
        told = v["told_db"] / v["error_db"] if v["error_db"] > 0.0 else math.inf
        yield [v["name"], f"{v['triangles']}", f"{v['ghz']:g}", each(v["seconds_per_look"]), each(v["tubes_seconds_per_look"]),
               f"{v['error_db']:.2g}", f"{told:.2g}", f"{v['build_us_per_triangle']:.2g}", f"{v['peak_rss_bytes'] / 1e6:.0f}"]

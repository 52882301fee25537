#!/usr/bin/env python3
"""Every mesh of a folder, read, mended and solved at a few looks: does each report add up, is every result a number?

    bench/meshes.py FOLDER [--build BUILD] [--unit m] [--ghz 1] [-o TABLE.md]

The looks are some in general position and those exactly along the axes. Exit code 1 if a report does not add up or a result is
not finite."""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ENDINGS = {".stl", ".obj", ".ply", ".off"}
LOOKS = [(80, 0), (80, 33), (75, 120), (60, 211), (0, 0), (90, 0), (90, 90), (180, 0)]
COLUMNS = ["mesh", "facets", "open", "non-manifold", "no area", "twice", "inside", "added", "traced", "adds up", "rays", "lost",
           "finite rows", "seconds"]


def case_text(mesh, options):
    return (f"[target]\nmesh = {json.dumps(str(mesh))}\nunit = \"{options.unit}\"\n[frequency]\nghz = {options.ghz}\n"
            f"[look]\nlooks_csv = \"looks.csv\"\n[output]\nplots = false\n")


def finite_rows(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    good = sum(all(math.isfinite(float(value)) for name, value in row.items() if name.startswith(("re_", "im_", "err_")))
               for row in rows)
    return good, len(rows)


def measure(mesh, options):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "case.toml").write_text(case_text(mesh.resolve(), options))
        (folder / "looks.csv").write_text("theta_deg,phi_deg\n" + "".join(f"{t},{p}\n" for t, p in LOOKS))
        subprocess.run([options.build / "raytube", "run", folder / "case.toml", "-o", folder / "out", "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
        run = json.loads((folder / "out" / "run.json").read_text())
        good, rows = finite_rows(folder / "out" / "rcs.csv")
    m, counts = run["mesh"], run["counts"]
    left_out = m["triangles_degenerate"] + m["triangles_duplicate"] + m["triangles_internal"]
    adds_up = m["triangles_read"] + m["triangles_added"] == m["triangles_traced"] + left_out
    return {"mesh": mesh.name, "facets": m["facets_read"], "open": m["open_edges"], "non-manifold": m["non_manifold_edges"],
            "no area": m["triangles_degenerate"], "twice": m["triangles_duplicate"], "inside": m["triangles_internal"],
            "added": m["triangles_added"], "traced": m["triangles_traced"], "adds up": "yes" if adds_up else "NO",
            "rays": counts["rays"], "lost": counts["lost_rays"], "finite rows": f"{good} of {rows}",
            "seconds": f"{run['time']['total_s']:.1f}"}, adds_up and good == rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build"))
    parser.add_argument("--unit", default="m")
    parser.add_argument("--ghz", type=float, default=1.0)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    options = parser.parse_args()
    meshes = sorted(path for path in options.folder.rglob("*") if path.suffix.lower() in ENDINGS)
    lines, good = ["| " + " | ".join(COLUMNS) + " |", "|" + "---|" * len(COLUMNS)], True
    for mesh in meshes:
        row, fine = measure(mesh, options)
        good = good and fine
        lines.append("| " + " | ".join(str(row[name]) for name in COLUMNS) + " |")
        print(lines[-1], flush=True)
    if options.output:
        options.output.write_text("\n".join(lines) + "\n")
    return 0 if good and meshes else 1


if __name__ == "__main__":
    sys.exit(main())

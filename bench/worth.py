#!/usr/bin/env python3
"""What each mechanism of edges and curved surfaces is worth: S with all of them and with one left out, against full wave.

    bench/worth.py PROGRAM [-o docs/theory/worth.md]

Bodies: tests/data/mom (own method of moments) and tests/data/tips.csv (bodies of revolution). A mechanism claims the bodies of which it
changes S by more than 1e-3 of the peak. Error: root mean square of |S - S_full wave| over all looks, of VV and HH, in wavelengths; dB: of
the looks within 20 dB of the peak of their cut. Time: of all looks of the body, in processor time, with it over without it.
"""
import argparse
import collections
import csv
import math
import pathlib
import resource
import subprocess
import tempfile

import tip_bodies
import worth_bodies

DATA = pathlib.Path(__file__).resolve().parent.parent / "tests" / "data"
WAVELENGTH = worth_bodies.WAVELENGTH
GHZ = 10.0
MECHANISMS = {
    "edges.plate_corners": "waves along edges of plates",
    "edges.solid_corners": "waves along edges of solids",
    "edges.thin_ends": "waves along ends of thin bodies",
    "surfaces.rounded_edges": "rounded edges",
    "surfaces.flat_tips": "flat tips",
    "surfaces.round_tips": "round tips",
}


def table(path):
    """Rows of a file as dictionaries; lines that begin with # are passed over."""
    with open(path) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def amplitudes(row, unit):
    """S_vv and S_hh of a row, in wavelengths."""
    return [complex(float(row["re_" + c]), float(row["im_" + c])) / unit for c in ("vv", "hh")]


def half_leaf(length, half_angle):
    """Width over place along an arc that meets the axis under an angle at both of its ends."""
    radius = length / 2 / math.sin(math.radians(half_angle))
    return lambda z: math.sqrt(max(0.0, radius**2 - z**2)) - radius * math.cos(math.radians(half_angle))


def flat_leaf(length, half_angle, flatness, rows=80):
    """Along x in the plane z = 0, sections are ellipses; [wavelengths]."""
    width = half_leaf(length, half_angle)
    places = [length / 2 * math.cos(math.pi * i / rows) for i in range(rows + 1)]
    return flattened([(width(z) if 0 < i < rows else 0.0, z) for i, z in enumerate(places)], flatness)


def flat_drop(rows=80):
    """A half of a leaf of 30 degrees, 2.5 long, and a half of an ellipse, 1.2 long."""
    width, profile = half_leaf(5.0, 30.0), []
    for i in range(rows + 1):
        turn = math.pi * i / rows
        z = (2.5 if 2 * i < rows else 1.2) * math.cos(turn)
        profile.append((0.0 if i in (0, rows) else width(z) if 2 * i < rows else width(0.0) * math.sin(turn), z))
    return flattened(profile, 1.0 / 4)


def flattened(profile, flatness):
    """A body of revolution along x, made flatter."""
    corners, faces = tip_bodies.revolution(profile, 96)
    return [(z, x, flatness * y) for x, y, z in corners], faces


def tip_body(name, ka):
    """Of tests/data/tips.csv, in wavelengths."""
    kind, angle = name.split()
    make = {"ogive": tip_bodies.ogive, "cone-sphere": tip_bodies.cone_sphere}[kind]
    return make(math.radians(float(angle)), float(ka) / (2 * math.pi))


def bodies():
    """(name, mesh in wavelengths, rows, metres of their S per wavelength), body after body."""
    for name, make in worth_bodies.BODIES.items():
        yield name, make(), [r for r in table(DATA / "mom/bodies.csv") if r["body"] == name], 1.0
    for kind, file, make in (("cube", "cube_sizes", lambda a: worth_bodies.box(a, a, a)), ("plate", "plate_sizes", lambda a: worth_bodies.plate(a, a))):
        rows = table(DATA / "mom" / (file + ".csv"))
        for length in sorted({r["length_lambda"] for r in rows}, key=float):
            yield f"{kind} of {float(length):g}", make(float(length)), [r for r in rows if r["length_lambda"] == length], WAVELENGTH
    monostatic = [r for r in table(DATA / "mom/wing3.csv") if not r["cut"].startswith("bistatic")]
    yield "wing of 3", worth_bodies.lens_wing(3.0, 0.45, 3.0), monostatic, WAVELENGTH
    leaves = {"leaf 25": flat_leaf(4.0, 25.0, 1.0 / 3), "leaf 40": flat_leaf(4.0, 40.0, 1.0 / 3), "drop": flat_drop()}
    for name, mesh in leaves.items():
        yield name, mesh, [r for r in table(DATA / "mom/leaves.csv") if r["body"] == name], 1.0
    tips = [{**r, "phi_deg": "0"} for r in table(DATA / "tips.csv")]
    for name, ka in sorted({(r["body"], r["ka"]) for r in tips}, key=lambda b: (b[0], float(b[1]))):
        yield f"{name}, ka {ka}", tip_body(name, ka), [r for r in tips if (r["body"], r["ka"]) == (name, ka)], 1.0


class Job:
    """One body at its looks."""

    def __init__(self, program, folder, mesh, rows):
        self.program, self.folder, self.rows = program, folder, rows
        worth_bodies.write_off(folder / "body.off", worth_bodies.scaled(mesh, WAVELENGTH))
        with open(folder / "looks.csv", "w") as looks:
            looks.write("theta_deg,phi_deg\n")
            looks.writelines(f"{r['theta_deg']},{r['phi_deg']}\n" for r in rows)
        (folder / "case.toml").write_text(
            f'[target]\nmesh = "body.off"\nunit = "m"\n[frequency]\nghz = {GHZ}\n[look]\nlooks_csv = "looks.csv"\n'
            "[output]\nplots = false\n"
        )

    def run(self, *off):
        """S_vv and S_hh of every look in wavelengths without these mechanisms, and the processor time [s]."""
        switches = [word for key in off for word in ("--set", key + "=false")]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        out = self.folder / "out"
        subprocess.run([self.program, "run", self.folder / "case.toml", "-o", out, "--quiet", *switches],
                       check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        time = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        return [amplitudes(row, WAVELENGTH) for row in table(out / "rcs.csv")], time


def errors(found, expected, cuts):
    """Root mean squares: of |S - S'| in wavelengths and of the dB within 20 dB of the peak of each cut, VV and HH."""
    result = []
    for c in range(2):
        squares = [abs(f[c] - e[c]) ** 2 for f, e in zip(found, expected)]
        peaks = {}
        for e, cut in zip(expected, cuts):
            peaks[cut] = max(peaks.get(cut, 0.0), abs(e[c]))
        db = [20 * math.log10(max(abs(f[c]), 1e-9) / abs(e[c])) for f, e, cut in zip(found, expected, cuts) if abs(e[c]) > 0.1 * peaks[cut]]
        result.append((math.sqrt(sum(squares) / len(squares)), math.sqrt(sum(x * x for x in db) / len(db))))
    return result


def cuts_of(rows):
    """The cut of every row: its own column, or its theta where phi varies there; of all others one in elevation."""
    count = collections.Counter(r["theta_deg"] for r in rows)
    return [r.get("cut") or (r["theta_deg"] if count[r["theta_deg"]] > 2 else "elevation") for r in rows]


def measure(program):
    """Rows (key, body, errors without, errors with, time with over without)."""
    for name, mesh, rows, unit in bodies():
        with tempfile.TemporaryDirectory() as folder:
            job = Job(program, pathlib.Path(folder), mesh, rows)
            expected, cuts = [amplitudes(r, unit) for r in rows], cuts_of(rows)
            peak = max(abs(s) for e in expected for s in e)
            whole, time = job.run()
            yield "", name, errors(whole, expected, cuts), None, 1.0
            for key in MECHANISMS:
                left, time_left = job.run(key)
                if max(abs(a - b) for p, q in zip(whole, left) for a, b in zip(p, q)) > 1e-3 * peak:
                    yield key, name, errors(left, expected, cuts), errors(whole, expected, cuts), time / time_left


def line(name, without, whole, time):
    """A row of the table."""
    pairs = [f"{a[0]:.3f} → {b[0]:.3f} | {a[1]:.1f} → {b[1]:.1f}" for a, b in zip(without, whole)]
    return f"| {name} | {' | '.join(pairs)} | {time:.2f} |"


def better(without, whole):
    """Whether the squares of both channels together fall."""
    return sum(b[0] ** 2 for b in whole) < sum(a[0] ** 2 for a in without)


def report(rows):
    """The tables as Markdown."""
    lines = []
    for key, label in MECHANISMS.items():
        mine = [r for r in rows if r[0] == key]
        gains = sum(better(r[2], r[3]) for r in mine)
        lines += [f"## {label[0].upper()}{label[1:]} (`{key}`)", "", f"Better on {gains} of {len(mine)} bodies.", ""]
        lines += ["| body | S/λ, VV | dB | S/λ, HH | dB | time |", "|---|---|---|---|---|---|"]
        lines += [line(*r[1:]) for r in mine] + [""]
    lines += ["## All bodies", "", "| body | S/λ, VV | dB | S/λ, HH | dB |", "|---|---|---|---|---|"]
    for key, name, found, _, _ in rows:
        if not key:
            lines.append(f"| {name} | " + " | ".join(f"{e[0]:.3f} | {e[1]:.1f}" for e in found) + " |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="raytube")
    parser.add_argument("-o", "--output", help="file of the tables, whose text before them stays; default: the terminal")
    given = parser.parse_args()
    rows = []
    for row in measure(given.program):
        rows.append(row)
        if given.output:
            print(row[1], row[0] or "all", *("%.4f %.2f" % e for e in row[2]), flush=True)
    if not given.output:
        return print(report(rows))
    page = pathlib.Path(given.output)
    before = page.read_text().split("\n## ", 1)[0] + "\n" if page.exists() else ""
    page.write_text(before + report(rows))


if __name__ == "__main__":
    main()

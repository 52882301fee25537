#!/usr/bin/env python3
"""How well the model uncertainty of rcs.csv holds: against full-wave and measured curves, set by set.

    bench/model_uncertainty.py DATA [--program build/raytube] [-o TABLE.md] [--set KEY=VALUE]...

DATA is a folder with `mom` (method of moments: cube2, dihedral3, plate3, prism30, wing3, plate_sizes; as tests/data/mom),
`tips.csv` (ogives and cone-spheres; as tests/data/tips.csv) or `austin` (curves of the Austin RCS Benchmark Suite by their own names, and almond_9.936in.stl), or both; what is not there is left
out. Spheres, against the series of Mie, need no data.

Rows count, channel by channel, whose reference is within 40 dB of the set's co-polar peak. "covered" is the share of them whose
true error in dB is at most sqrt(err^2 + model^2), "ratio" the median of that over the true error. "without it" judges a set by
the one common factor on all constants with which the other sets, each as heavy as any, are covered as well as all sets are."""
import argparse
import collections
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import tip_bodies

LIGHT = 299792458.0
CHANNELS = ("vv", "vh", "hv", "hh")
LEVEL = 10.0 * math.log10(4.0 * math.pi)
RANGE_DB = 40.0

# looks: (theta, phi, rx_theta, rx_phi) [degrees]; reference: [look][channel] in dBsm, None where there is none
Cut = collections.namedtuple("Cut", "group name mesh unit looks reference ghz bistatic materials")


def write_off(path, corners, faces):
    lines = [f"OFF\n{len(corners)} {len(faces)} 0"]
    lines += [" ".join(repr(float(x)) for x in corner) for corner in corners]
    lines += [f"{len(face)} " + " ".join(map(str, face)) for face in faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def rectangle(path, half_a, half_b, axes, offset=0.0):
    """A plate of two triangles' worth, normal to the axis that is not named."""
    corners = []
    for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        corner = [offset] * 3
        corner[axes[0]], corner[axes[1]] = a * half_a, b * half_b
        corners.append(corner)
    return write_off(path, corners, [(0, 1, 2, 3)])


def box_faces(x, half_y, half_z):
    corners = [(a, b, c) for a in x for b in (-half_y, half_y) for c in (-half_z, half_z)]
    return corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def sphere(path, radius, splits):
    golden = (1.0 + math.sqrt(5.0)) / 2.0
    points = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0), (0, -1, golden), (0, 1, golden),
              (0, -1, -golden), (0, 1, -golden), (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
             (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    points = [unit(p) for p in points]
    for _ in range(splits):
        middles, finer = {}, []
        for face in faces:
            ends = [(face[i], face[(i + 1) % 3]) for i in range(3)]
            for end in ends:
                if tuple(sorted(end)) not in middles:
                    middles[tuple(sorted(end))] = len(points)
                    points.append(unit([sum(x) for x in zip(points[end[0]], points[end[1]])]))
            a, b, c = (middles[tuple(sorted(end))] for end in ends)
            finer += [(face[0], a, c), (face[1], b, a), (face[2], c, b), (a, b, c)]
        faces = finer
    return write_off(path, [[radius * x for x in p] for p in points], faces)


def unit(p):
    length = math.sqrt(sum(x * x for x in p))
    return tuple(x / length for x in p)


def dbsm(s):
    return 20.0 * math.log10(abs(s)) + LEVEL if abs(s) > 0.0 else -math.inf


def read_rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def reference_of(row):
    return [dbsm(complex(float(row[f"re_{c}"]), float(row[f"im_{c}"]))) for c in CHANNELS]


def moment_cuts(folder, work):
    for body in ("cube2", "dihedral3", "plate3", "prism30", "wing3"):
        mesh = next((folder / f"{body}{end}" for end in (".stl", ".off") if (folder / f"{body}{end}").exists()), None)
        if not mesh or not (folder / f"{body}.csv").exists():
            continue
        rows = read_rows(folder / f"{body}.csv")
        for name in dict.fromkeys(row["cut"] for row in rows):
            part = [row for row in rows if row["cut"] == name]
            keys = ("theta_i_deg", "phi_i_deg", "theta_deg", "phi_deg")
            looks = [tuple(float(row[key]) for key in keys) for row in part]
            yield Cut(body, f"{body} {name}", [mesh], "m", looks, [reference_of(row) for row in part], 10.0,
                      "bistatic" in name, "")
    yield from plate_sizes(folder / "plate_sizes.csv", work)


def plate_sizes(path, work):
    if not path.exists():
        return
    rows = read_rows(path)
    for size in sorted({float(row["length_lambda"]) for row in rows}):
        half = size * LIGHT / 10e9 / 2.0
        mesh = rectangle(work / f"plate_{size}.off", half, half, (0, 1))
        part = [row for row in rows if float(row["length_lambda"]) == size]
        looks = [2 * (float(row["theta_deg"]), float(row["phi_deg"])) for row in part]
        yield Cut("plate sizes", f"plate {size}", [mesh], "m", looks, [reference_of(row) for row in part], 10.0, False, "")


def tip_cuts(path, work):
    if not path.exists():
        return
    rows = read_rows(path)
    for body, ka in dict.fromkeys((row["body"], row["ka"]) for row in rows):
        kind, angle = body.split()
        make = tip_bodies.ogive if kind == "ogive" else tip_bodies.cone_sphere
        radius = float(ka) / (2 * math.pi)
        mesh = write_off(work / f"{kind}_{angle}_{ka}.off", *make(math.radians(float(angle)), radius))
        part = [row for row in rows if (row["body"], row["ka"]) == (body, ka)]
        looks = [2 * (float(row["theta_deg"]), 0.0) for row in part]
        reference = [[dbsm(complex(float(row[f"re_{p}"]), float(row[f"im_{p}"]))) if p in ("vv", "hh") else None for p in CHANNELS]
                     for row in part]
        yield Cut("tips, ka 3 and 6" if float(ka) < 10 else "tips, ka 12 and 20", f"{body} ka {ka}", [mesh], "m", looks, reference, LIGHT / 1e9, False, "")


def austin_cuts(folder, work):
    if not folder.is_dir():
        return
    y, z = 0.2667 / 2, 0.1524 / 2
    thin = rectangle(work / "thin.off", y, z, (1, 2))
    middle = rectangle(work / "middle.off", y, z, (1, 2), 0.0)
    solid = write_off(work / "solid.off", *box_faces((-0.0016256, 0.0), y, z))
    corners, faces = box_faces((-0.0031256, 0.0), y, z)
    body = write_off(work / "body.off", corners, [face for i, face in enumerate(faces) if i != 1])
    coat = write_off(work / "coat.off", corners, [faces[1]])
    flat = rectangle(work / "flat.off", 0.1778 / 2, 0.1016 / 2, (0, 1))
    absorber = {"f10": "eps_r = [16.9, 0.393]\nmu_r = [2.46, 1.95]", "f11": "eps_r = [16.9, 0.337]\nmu_r = [1.45, 1.73]"}
    plastic = {"f10": "eps_r = [2.61, 0.0354]", "f11": "eps_r = [2.61, 0.0321]"}
    layer = "[materials.m]\nkind = \"{}\"\nthickness_mm = 1.5\n{}\n"
    for group, stem, mesh, materials in (
            ("plate A", "ref_rcs.II.A.sx1.f10", [thin], ""), ("plate A", "ref_rcs.II.A.sx1.f11", [thin], ""),
            ("plate A", "ref_rcs.II.A.s1.f10.theta80", [flat], ""),
            ("plate B", "ref_rcs.II.B.sx1.f9", [solid], ""), ("plate B", "ref_rcs.II.B.sx1.f11", [solid], ""),
            ("dielectric plate", "ref_rcs.II.C.sx1.f10", [middle], layer.format("sheet", plastic["f10"])),
            ("dielectric plate", "ref_rcs.II.C.sx1.f11", [middle], layer.format("sheet", plastic["f11"])),
            ("absorber plate", "ref_rcs.II.D.sx1.f10", [middle], layer.format("sheet", absorber["f10"])),
            ("absorber plate", "ref_rcs.II.D.sx1.f11", [middle], layer.format("sheet", absorber["f11"])),
            ("coated plate, measured", "meas.m1_rcs.II.E.sx1.f10", [body, coat], layer.format("coated", absorber["f10"])),
            ("coated plate, measured", "meas.m1_rcs.II.E.sx1.f11", [body, coat], layer.format("coated", absorber["f11"])),
            ("almond", "ref_rcs.III.A.s1.fx1", [folder / "almond_9.936in.stl"], ""),
            ("almond", "ref_rcs.III.A.s1.fx3", [folder / "almond_9.936in.stl"], ""),
            ("almond", "ref_rcs.III.A.s1.fx4", [folder / "almond_9.936in.stl"], "")):
        if (folder / f"{stem}.V.txt").exists():
            yield austin_cut(group, folder, stem, "", mesh, materials)
    if (folder / "ref_rcs.I.A.s7.f6.V.721.txt").exists():
        yield austin_cut("sphere, bistatic", folder, "ref_rcs.I.A.s7.f6", ".721", [sphere(work / "large.off", 9.6, 5)], "")


def austin_cut(group, folder, stem, end, mesh, materials):
    v, h = ([[float(x) for x in line.split()] for line in (folder / f"{stem}.{p}{end}.txt").read_text().splitlines() if line.strip()]
            for p in "VH")
    bistatic = "bistatic" in group
    looks = [((90.0, 0.0) if bistatic else (row[1], row[2])) + (row[1], row[2]) for row in v]
    reference = [[a[3], None, None, b[3]] for a, b in zip(v, h)]
    return Cut(group, stem, mesh, "m", looks, reference, v[0][0] / 1e9, bistatic, materials)


def mie_backscatter(ka):
    """|S| / a of a conducting sphere (Bowman, Senior & Uslenghi 1987, section 10.3)."""
    most = int(ka + 4.05 * ka ** (1 / 3) + 10)
    start = most + 30
    ratio = [0.0] * (start + 1)
    for n in range(start, 0, -1):  # j_n / j_{n-1}, downwards
        ratio[n - 1] = 1.0 / ((2 * n + 1) / ka - ratio[n])
    j, y, total = [math.sin(ka) / ka], [-math.cos(ka) / ka, -math.cos(ka) / ka**2 - math.sin(ka) / ka], 0.0
    for n in range(1, most + 1):
        j.append(j[-1] * ratio[n - 1])
        if n > 1:
            y.append((2 * n - 1) / ka * y[-1] - y[-2])
        h, before = complex(j[n], -y[n]), complex(j[n - 1], -y[n - 1])
        slope = ka * before - n * h  # (ka h_n)'
        total += (-1) ** n * (n + 0.5) * ((ka * j[n - 1] - n * j[n]) / slope - j[n] / h)
    return abs(total) / ka


def sphere_cuts(work):
    mesh = sphere(work / "unit.off", 1.0, 4)
    for ka in (5, 6, 7, 8, 10, 12, 14, 17, 20, 24, 29, 34, 41, 50):
        level = dbsm(mie_backscatter(ka))
        yield Cut("spheres, ka 5 to 50", f"ka {ka}", [mesh], "m", [(70.0, 20.0, 70.0, 20.0)], [[level, None, None, level]],
                  ka * LIGHT / 2 / math.pi / 1e9, False, "")


def case_text(cut):
    where = ""
    if cut.materials:
        where = "material = \"m\"\n" if len(cut.mesh) == 1 else f"parts.{json.dumps(str(cut.mesh[1]))} = \"m\"\n"
    return (f"[target]\nmesh = {json.dumps([str(m.resolve()) for m in cut.mesh])}\nunit = \"{cut.unit}\"\n{where}{cut.materials}"
            f"[frequency]\nghz = {cut.ghz!r}\n[look]\nlooks_csv = \"looks.csv\"\n[output]\nplots = false\n")


def run(cut, work, options, words=()):
    (work / "case.toml").write_text(case_text(cut))
    columns = 4 if cut.bistatic else 2
    header = "theta_deg,phi_deg" + (",rx_theta_deg,rx_phi_deg" if cut.bistatic else "")
    (work / "looks.csv").write_text(header + "\n" + "".join(",".join(map(repr, look[:columns])) + "\n" for look in cut.looks))
    sets = [word for item in options.set for word in ("--set", item)]
    done = subprocess.run([options.program, "run", str(work / "case.toml"), "-o", str(work / "out"), "--quiet", *sets, *words],
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{cut.name}: {done.stderr}")
    return read_rows(work / "out" / "rcs.csv")


def samples(cut, rows):
    """(true error [dB], numerical error [dB], model uncertainty over what its decibels refer to) of every row that counts."""
    peak = max(level for row in cut.reference for level in (row[0], row[3]) if level is not None)
    found = []
    for row, reference in zip(rows, cut.reference):
        for channel, level in zip(CHANNELS, reference):
            if level is None or level <= peak - RANGE_DB:
                continue
            error = abs(max(float(row[f"sigma_{channel}_dbsm"]), -400.0) - level)
            found.append((error, float(row[f"err_{channel}_db"]), 10 ** (float(row[f"model_{channel}_db"]) / 20.0) - 1.0))
    return found


def estimates(found, factor=1.0):
    return [math.hypot(numerical, 20.0 * math.log10(1.0 + factor * share)) for _, numerical, share in found]


def covered(found, factor=1.0):
    return sum(error <= e for (error, _, _), e in zip(found, estimates(found, factor))) / len(found)


def ratio(found):
    values = sorted(e / max(error, 1e-9) for (error, _, _), e in zip(found, estimates(found)))
    return values[len(values) // 2]


def factor_that_covers(groups, share):
    """The least one with which the groups, each as heavy as any other, are covered by so much."""
    low, high = 0.05, 20.0
    for _ in range(30):
        middle = math.sqrt(low * high)
        mean = sum(covered(found, middle) for found in groups) / len(groups)
        low, high = (low, middle) if mean >= share else (middle, high)
    return high


def table(groups):
    share = sum(covered(found) for found in groups.values()) / len(groups)
    lines = ["| set | rows | covered | ratio | factor without it | covered then |", "|---|---|---|---|---|---|"]
    for name, found in groups.items():
        others = [values for other, values in groups.items() if other != name]
        factor = factor_that_covers(others, share) if others else 1.0
        lines.append(f"| {name} | {len(found)} | {100 * covered(found):.0f} % | {ratio(found):.1f} | {factor:.2f} | "
                     f"{100 * covered(found, factor):.0f} % |")
    everything = [sample for found in groups.values() for sample in found]
    lines.append(f"| all | {len(everything)} | {100 * covered(everything):.0f} % | {ratio(everything):.1f} | | |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--program", default="build/raytube")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    options = parser.parse_args()
    groups = {}
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        cuts = [*moment_cuts(options.data / "mom", work), *tip_cuts(options.data / "tips.csv", work),
                *austin_cuts(options.data / "austin", work), *sphere_cuts(work)]
        for cut in cuts:
            groups.setdefault(cut.group, []).extend(samples(cut, run(cut, work, options)))
            print(cut.name, file=sys.stderr, flush=True)
    text = table(groups)
    if options.output:
        options.output.write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()

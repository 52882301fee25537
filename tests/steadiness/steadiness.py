#!/usr/bin/env python3
"""A row is a row: S hangs on target, look and frequency, not on what else is asked for, nor on how the mesh is written down.

    tests/steadiness/steadiness.py build/raytube [--bodies cube,vehicle]

Ten bodies, two of them irregular ones of a fixed seed, are solved again with other frequencies beside the one looked at, with triangles and
vertices in another order, each triangle with vertices of its own, mirrored, moved, a thousand times as large at a thousandth of the
frequency, and with the receiver a millionth of a degree off the transmitter. A line tells the largest change of S over the strongest |S| of
all looks. Exit code 1 if one exceeds its limit.
"""
import argparse
import cmath
import csv
import math
import pathlib
import random
import subprocess
import sys
import tempfile

C0 = 299792458.0
L = C0 / 1e10  # most bodies are drawn in wavelengths of 10 GHz
CHANNELS, CO = ("vv", "vh", "hv", "hh"), ("vv", "hh")
GENERAL = [(75, 20), (60, 50), (83, 10), (40, 130), (85, 165)]
AXES = [(90, 0), (90, 90)]

# What is exact in exact numbers may differ by rounding, which sums of a thousand currents and quadratures carry to 1e-9. Frequencies share
# interpolation, good to 1e-7 of the sum of amplitudes. Where strips or tubes of curved surfaces begin is found on the mesh to about 1e-9 of
# its size, and some of what they reach is near to a border: 1e-4 of the strongest.
EXACT, SHARED, CURVED = 1e-9, 1e-6, 1e-4


def fans(polygons):
    return [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]


def placed(mesh, function):
    return [function(p) for p in mesh[0]], mesh[1]


def joined(meshes):
    points, triangles = [], []
    for vertices, faces in meshes:
        triangles += [tuple(len(points) + i for i in t) for t in faces]
        points += vertices
    return points, triangles


def box(a, b, c, at=(0, 0, 0)):
    vertices = [(at[0] + x * a / 2, at[1] + y * b / 2, at[2] + z * c / 2) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    return vertices, fans([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])


def revolved(profile, sides):
    """profile: (radius, z) with z rising, radius 0 at both ends."""
    vertices, faces, rings = [], [], []
    for radius, z in profile:
        count = sides if radius else 1
        rings.append([len(vertices) + i % count for i in range(sides + 1)])
        vertices += [(radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides), z) for i in range(count)]
    for below, above in zip(rings, rings[1:]):
        for i in range(sides):
            for t in ((below[i], below[i + 1], above[i + 1]), (below[i], above[i + 1], above[i])):
                if len(set(t)) == 3:
                    faces.append(t)
    return vertices, faces


def spheroid(a, b, rings, sides):
    """Half axes a across z and b along it."""
    return revolved([(a * math.sin(math.pi * i / rings) if 0 < i < rings else 0, -b * math.cos(math.pi * i / rings))
                     for i in range(rings + 1)], sides)


def ogive(half_angle, ka, rings, sides):
    half = math.radians(half_angle)
    radius = ka * L / 2 / math.pi / (1 - math.cos(half))
    turn = [half * (2 * i / rings - 1) for i in range(rings + 1)]
    return revolved([(radius * (math.cos(t) - math.cos(half)) if 0 < i < rings else 0, radius * math.sin(t)) for i, t in enumerate(turn)], sides)


def vehicle():
    wheel = revolved([(0, -.11), (.32, -.11), (.32, .11), (0, .11)], 20)
    wheels = [([(p[0] + x, p[2] + y, p[1] + .32) for p in wheel[0]], [t[::-1] for t in wheel[1]]) for x in (-1.3, 1.3) for y in (-.98, .98)]
    return joined([box(4, 1.7, .6, (0, 0, .75)), box(1.9, 1.5, .5, (-.3, 0, 1.3)), box(.5, .9, .3, (2.3, 0, .7)), *wheels])


def irregular(seed):
    """Boxes of any size at random places, apart from one another."""
    any_of = random.Random(seed)
    return joined([box(*[L * any_of.uniform(.8, 3) for _ in range(3)], at=(4 * L * i, L * any_of.uniform(-2, 2), L * any_of.uniform(-2, 2)))
                   for i in range(3)])


DIHEDRAL = [(0, 0, 0), (3 * L, 0, 0), (3 * L, 0, 3 * L), (0, 0, 3 * L), (0, 3 * L, 0), (0, 3 * L, 3 * L)], fans([(0, 1, 2, 3), (0, 3, 5, 4)])
PLATE = [(-1.5 * L, -L, 0), (1.5 * L, -L, 0), (1.5 * L, L, 0), (-1.5 * L, L, 0)], fans([(0, 1, 2, 3)])
BODIES = {  # mesh, frequency in GHz, looks, limit of what is not exact in a mesh
    "cube": lambda: (box(2 * L, 2 * L, 2 * L), 10, GENERAL + AXES, EXACT),
    "plate": lambda: (PLATE, 10, GENERAL, EXACT),
    "dihedral": lambda: (DIHEDRAL, 10, [(75, 20), (80, 70), (90, 10), (60, 25)], EXACT),
    "cylinder": lambda: (revolved([(0, -1.5 * L), (L, -1.5 * L), (L, 1.5 * L), (0, 1.5 * L)], 48), 10,
                         [(30, 20), (50, 50), (70, 10), (80, 130), (84, 165)], CURVED),
    "sphere": lambda: (spheroid(1.5 * L, 1.5 * L, 30, 40), 10, GENERAL, CURVED),
    "spheroid": lambda: (spheroid(L, 3 * L, 40, 36), 10, GENERAL, CURVED),
    "ogive": lambda: (ogive(22.6, 12, 40, 48), 10, [(30, 20), (60, 50), (80, 10), (150, 130), (165, 0)], CURVED),
    "vehicle": lambda: (vehicle(), .5, [(75, 20), (60, 130), (85, 70), (80, 40), (65, 200)], EXACT),
    "irregular5": lambda: (irregular(5), 10, GENERAL, EXACT),
    "irregular8": lambda: (irregular(8), 10, GENERAL, EXACT),
}


def off(mesh):
    points = "".join("%.17g %.17g %.17g\n" % tuple(p) for p in mesh[0])
    return f"OFF\n{len(mesh[0])} {len(mesh[1])} 0\n{points}" + "".join("3 %d %d %d\n" % tuple(t) for t in mesh[1])


def solved(program, mesh, ghz, looks):
    """S of each look, a list over frequencies of {channel: complex}."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "mesh.off").write_text(off(mesh))
        head = "theta_deg,phi_deg" + (",rx_theta_deg,rx_phi_deg" if len(looks[0]) == 4 else "")
        (folder / "looks.csv").write_text("\n".join([head, *[",".join("%.17g" % x for x in look) for look in looks], ""]))
        (folder / "case.toml").write_text(f'[target]\nmesh = "mesh.off"\nunit = "m"\n[frequency]\nghz = {ghz}\n[look]\nlooks_csv = "looks.csv"\n')
        subprocess.run([program, "run", folder / "case.toml", "-o", folder, "--quiet", "--set", "output.plots=false"], check=True, stderr=subprocess.DEVNULL)
        with open(folder / "rcs.csv") as table:
            rows = [{c: complex(float(row["re_" + c]), float(row["im_" + c])) for c in CHANNELS}
                    for row in csv.DictReader(line for line in table if line[0] != "#")]
    return [rows[i:i + len(ghz)] for i in range(0, len(rows), len(ghz))]


def shuffled(mesh, seed):
    any_of, (vertices, faces) = random.Random(seed), mesh
    order = any_of.sample(range(len(vertices)), len(vertices))
    place = {old: new for new, old in enumerate(order)}
    faces = [t[q:] + t[:q] for t in (tuple(place[i] for i in t) for t in faces) for q in (any_of.randrange(3),)]
    return [vertices[i] for i in order], any_of.sample(faces, len(faces))


def direction(look):
    theta, phi = math.radians(look[0]), math.radians(look[1])
    return math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)


def changes(program, mesh, ghz, looks, of_mesh):
    """(what was changed, largest change of S over the strongest |S|, its limit)."""
    base = [s[0] for s in solved(program, mesh, [ghz], looks)]
    strongest = max(abs(s[c]) for s in base for c in CHANNELS)

    def change(after, channels=CHANNELS):
        return max(abs(a[c] - b[c]) / strongest for a, b in zip(base, after) for c in channels)

    for beside in ((1, 1.0005), (1, 1.1), (1, 2), (.7, .85, 1, 1.15, 1.6)):
        rows = solved(program, mesh, [ghz * x for x in beside], looks)
        yield f"frequencies x{beside}", change([s[beside.index(1)] for s in rows]), max(SHARED, of_mesh)
    yield "shuffled", change([s[0] for s in solved(program, shuffled(mesh, 5), [ghz], looks)]), of_mesh
    unwelded = [mesh[0][i] for t in mesh[1] for i in t], [(i, i + 1, i + 2) for i in range(0, 3 * len(mesh[1]), 3)]
    yield "unwelded", change([s[0] for s in solved(program, unwelded, [ghz], looks)]), of_mesh
    flipped = [(x, -y, z) for x, y, z in mesh[0]], [t[::-1] for t in mesh[1]]
    rows = [s[0] for s in solved(program, flipped, [ghz], [(theta, -phi) for theta, phi in looks])]
    yield "mirrored", change([{c: s[c] if c in CO else -s[c] for c in CHANNELS} for s in rows]), of_mesh
    shift = [46 * C0 / ghz / 1e9 * x for x in (.6, -.64, .48)]
    rows = solved(program, placed(mesh, lambda p: tuple(a + b for a, b in zip(p, shift))), [ghz], looks)
    turns = [cmath.exp(-4j * math.pi * ghz * 1e9 / C0 * sum(a * b for a, b in zip(direction(look), shift))) for look in looks]
    yield "shifted", change([{c: s[0][c] * turn for c in CHANNELS} for s, turn in zip(rows, turns)]), max(SHARED, of_mesh)
    rows = solved(program, placed(mesh, lambda p: tuple(1000 * x for x in p)), [ghz / 1000], looks)
    yield "scaled", change([{c: s[0][c] / 1000 for c in CHANNELS} for s in rows]), of_mesh
    beside = [(theta, phi, theta + 1e-6, phi) for theta, phi in looks]
    yield "receiver 1e-6 degree off", change([s[0] for s in solved(program, mesh, [ghz], beside)], CO), max(SHARED, of_mesh)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--bodies", default=",".join(BODIES))
    options = parser.parse_args()
    failed = 0
    for body in options.bodies.split(","):
        for what, size, limit in changes(options.program.resolve(), *BODIES[body]()):
            failed += size > limit
            print(f"{body:11} {what:40} {size:8.1e} of {limit:.0e}{' EXCEEDED' if size > limit else ''}", flush=True)
    sys.exit(1 if failed else 0)


main()

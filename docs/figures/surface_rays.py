#!/usr/bin/env python3
"""A body and the rays over it as seen from a direction, for gnuplot (standard library only).

    surface_rays.py MESH.ply RAYS.vtp RADAR EYE EVERY NAME

MESH is a binary PLY of cases/make_cases.py in millimetres, RAYS what `raytube trace --surface-rays` writes for a radar at RADAR; RADAR and
EYE are THETA,PHI in degrees. All lines at shadow boundaries are taken, and every EVERYth one of the first order from edges. Writes
NAME_mesh.dat, facets that face the eye, farthest first, as closed outlines `x y colour`; NAME_rays.dat, lines `x y kind hard` where nothing
hides them; and NAME_radar.dat, an arrow along the wave, `x y dx dy`. Metres; x to the right, y up."""
import math
import struct
import sys
import xml.etree.ElementTree as ElementTree

ACROSS = 700  # cells of the depth buffer along the longer side


def read_ply(path):
    data = open(path, "rb").read()
    head, body = data.split(b"end_header\n", 1)
    vertices, faces = (int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element"))
    points = [tuple(1e-3 * x for x in struct.unpack_from("<3d", body, 24 * i)) for i in range(vertices)]
    return points, [struct.unpack_from("<3i", body, 24 * vertices + 13 * i + 1) for i in range(faces)]


def read_rays(path):
    """(kind, order, points) of each line, its points (x, y, z, hard)."""
    arrays = {a.get("Name"): a.text.split() for a in ElementTree.parse(path).iter("DataArray")}
    numbers, hard = [float(x) for x in arrays["points"]], [float(x) for x in arrays["hard"]]
    points = [(*numbers[3 * i:3 * i + 3], hard[i]) for i in range(len(hard))]
    ends = [0, *map(int, arrays["offsets"])]
    return list(zip(map(int, arrays["kind"]), map(int, arrays["order"]), (points[a:b] for a, b in zip(ends, ends[1:]))))


def chosen(rays, every):
    from_edges = [ray for ray in rays if ray[0] == 1 and ray[1] == 1]
    return from_edges[::every] + [ray for ray in rays if ray[0] != 1]


class View:
    """Right, up and towards the eye."""

    def __init__(self, eye):
        theta, phi = (math.radians(float(x)) for x in eye.split(","))
        st, ct, sp, cp = math.sin(theta), math.cos(theta), math.sin(phi), math.cos(phi)
        self.axes = ((-sp, cp, 0.0), (-ct * cp, -ct * sp, st), (st * cp, st * sp, ct))

    def of(self, p):
        return tuple(sum(a * b for a, b in zip(axis, p)) for axis in self.axes)


class Depths:
    """Of the nearest facet behind each cell of a picture."""

    def __init__(self, points):
        xs, ys = [p[0] for p in points], [p[1] for p in points]
        self.corner, size = (min(xs), min(ys)), max(max(xs) - min(xs), max(ys) - min(ys))
        self.cell, self.found = size / ACROSS, {}

    def at(self, p):
        return tuple(int((p[i] - self.corner[i]) / self.cell) for i in (0, 1))

    def add(self, a, b, c):
        area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        low, high = self.at([min(p[i] for p in (a, b, c)) for i in (0, 1)]), self.at([max(p[i] for p in (a, b, c)) for i in (0, 1)])
        for i in range(low[0], high[0] + 1):
            for j in range(low[1], high[1] + 1):
                x, y = self.corner[0] + (i + 0.5) * self.cell, self.corner[1] + (j + 0.5) * self.cell
                v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area
                w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area
                if v > -0.2 and w > -0.2 and v + w < 1.2:
                    depth = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])
                    self.found[i, j] = max(self.found.get((i, j), depth), depth)

    def hides(self, p):
        return self.found.get(self.at(p), -math.inf) > p[2] + 6 * self.cell


def shade(a, b, c):
    """A grey by how squarely a facet faces a lamp over the eye's left shoulder."""
    n = [(b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]) for i, j in ((1, 2), (2, 0), (0, 1))]
    light = sum(x * y for x, y in zip(n, (-0.35, 0.5, 0.79))) / math.sqrt(sum(x * x for x in n))
    grey = round(150 + 95 * max(light, 0.0))
    return grey * 0x10101


def arrow(view, points, radar):
    """Along the wave, towards the middle of the body."""
    middle = [0.5 * (min(p[i] for p in points) + max(p[i] for p in points)) for i in (0, 1)]
    reach = max(math.dist(p[:2], middle) for p in points)
    x, y, _ = view.of(View(radar).axes[2])
    x, y = (part * reach / math.hypot(x, y) for part in (x, y))
    return f"{middle[0] + 1.25 * x:.6g} {middle[1] + 1.25 * y:.6g} {-0.2 * x:.6g} {-0.2 * y:.6g}\n"


def main(mesh, rays, radar, eye, every, name):
    view = View(eye)
    points, triangles = read_ply(mesh)
    points = [view.of(p) for p in points]
    facing = [[points[i] for i in t] for t in triangles]
    facing = [(a, b, c) for a, b, c in facing if (b[0] - a[0]) * (c[1] - a[1]) > (c[0] - a[0]) * (b[1] - a[1]) + 1e-15]
    facing.sort(key=lambda t: sum(p[2] for p in t))
    depths = Depths(points)
    with open(name + "_mesh.dat", "w") as f:
        for t in facing:
            depths.add(*t)
            f.writelines(f"{p[0]:.6g} {p[1]:.6g} {shade(*t)}\n" for p in (*t, t[0]))
            f.write("\n\n")
    with open(name + "_rays.dat", "w") as f:
        for kind, _, line in chosen(read_rays(rays), int(every)):
            for *place, hard in line:
                p = view.of(place)
                f.write("\n" if depths.hides(p) else f"{p[0]:.6g} {p[1]:.6g} {kind} {hard:.4g}\n")
            f.write("\n")
    with open(name + "_radar.dat", "w") as f:
        f.write(arrow(view, points, radar))


main(*sys.argv[1:])

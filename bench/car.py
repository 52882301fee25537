#!/usr/bin/env python3
"""A car of our own as a mesh: a smooth shell with cabin and wheel arches, four wheels, two mirrors, a silencer below the floor.

    bench/car.py CAR.ply|CAR.obj [--facets 8400] [--trim 0]

Eight closed bodies apart from one another, normals outward, in metres: 4.4 long, 1.8 wide without mirrors, 1.4 high, driving
along +x, z up, the road at z = 0. From the usual number of facets on the shell has creases of 15 degrees and more at its wheel
arches alone; with fewer, also at bow and tail. --trim adds so many small blocks with sharp edges just outside the shell, each a closed
body: what handles, lamps, bolts and louvres are to a real one."""
import argparse
import math
import pathlib

HALF_LENGTH, HALF_WIDTH = 2.2, 0.9
MIDDLE, FLOOR, BONNET, BOOT, ROOF = 0.58, 0.2, 0.94, 1.0, 1.4  # heights
AXLES, TRACK = (-1.32, 1.36), 0.7  # x of the axles, y of the middle of the wheels
WHEEL_RADIUS, WHEEL_WIDTH = 0.31, 0.2
TRIM, TRIM_GAP = (0.015, 0.006, 0.005), 0.06  # half the sides of a block, and how far beyond the shell its middle lies
ROUNDNESS = 2.7  # exponent of the shell's superellipsoid
CUTS = (40, 16, 20)  # of the shell along x, y, z at FACETS
FACETS = 8400


def rise(x, start, end):
    """0 at start, 1 at end, smooth."""
    t = min(1.0, max(0.0, (x - start) / (end - start)))
    return t * t * (3.0 - 2.0 * t)


def top(x):
    return BONNET + (ROOF - BONNET) * rise(x, 1.1, 0.1) + (BOOT - ROOF) * rise(x, -0.9, -1.8)


def half_width(x, z):
    """Share of it that is left: the cabin leans inward, the sides are recessed about the wheels."""
    wheel = min(math.hypot(x - axle, z - WHEEL_RADIUS) for axle in AXLES)
    return (1.0 - 0.25 * rise(z, BONNET - 0.1, ROOF + 0.2)) * (1.0 - 0.42 * rise(wheel, 0.5, 0.36))


def shell(u, v, w):
    """Point of the shell for a point of the cube -1..1."""
    w *= 0.7 + 0.3 * abs(w)  # closer where bow and tail bend most
    scale = sum(abs(t) ** ROUNDNESS for t in (u, v, w)) ** (-1.0 / ROUNDNESS)
    x, y = HALF_LENGTH * u * scale, HALF_WIDTH * v * scale
    z = MIDDLE + (top(x) - MIDDLE if w > 0 else MIDDLE - FLOOR) * w * scale
    return x, y * half_width(x, z), z


def ellipsoid(middle, radii):
    def at(*cube):
        length = math.hypot(*cube)
        return tuple(m + r * t / length for m, r, t in zip(middle, radii, cube))
    return at


def block(middle, halves):
    def at(*cube):
        return tuple(m + h * t for m, h, t in zip(middle, halves, cube))
    return at


def trim_places(count):
    """Points just outside the shell, spread evenly over the directions from its middle."""
    for i in range(count):
        up, turn = 1.0 - (2.0 * i + 1.0) / count, i * math.pi * (3.0 - math.sqrt(5.0))
        across = math.sqrt(1.0 - up * up)
        x, y, z = shell(across * math.cos(turn), across * math.sin(turn), up)
        scale = 1.0 + TRIM_GAP / math.dist((x, y, z), (0.0, 0.0, MIDDLE))
        yield x * scale, y * scale, MIDDLE + (z - MIDDLE) * scale


class Mesh:
    def __init__(self):
        self.points, self.triangles = [], []
        self.parts = []  # (name, where its triangles begin)

    def begin(self, part):
        self.parts.append((part, len(self.triangles)))

    def add_point(self, point):
        self.points.append(tuple(round(t, 6) + 0.0 for t in point))
        return len(self.points) - 1

    def add_quad(self, a, b, c, d):
        """Two triangles, cut along the shorter diagonal; the first one where rounding would decide."""
        corner = self.points
        if math.dist(corner[a], corner[c]) <= math.dist(corner[b], corner[d]) + 1e-5:
            self.triangles += [(a, b, c), (a, c, d)]
        else:
            self.triangles += [(a, b, d), (b, c, d)]

    def add_cube(self, cuts, at):
        """A closed body: the surface of a cube, cut into rectangles, its points moved by `at`."""
        index = {}

        def point(place):
            if place not in index:
                index[place] = self.add_point(at(*(2.0 * i / n - 1.0 for i, n in zip(place, cuts))))
            return index[place]

        for axis in range(3):
            first, second = (axis + 1) % 3, (axis + 2) % 3
            for side in (0, cuts[axis]):
                for i in range(cuts[first]):
                    for j in range(cuts[second]):
                        ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                        places = [{axis: side, first: a, second: b} for a, b in (ring if side else ring[::-1])]
                        self.add_quad(*(point((p[0], p[1], p[2])) for p in places))

    def add_wheel(self, middle, outward, cuts):
        """Revolved about y; a recessed disc faces outward (+1: +y). Each end of the profile is one point of the axis."""
        half = WHEEL_WIDTH / 2.0
        profile = [(0.0, half - 0.04), (0.19, half - 0.04), (0.22, half), (WHEEL_RADIUS, half), (WHEEL_RADIUS, -half), (0.0, -half)]

        def ring(radius, y):
            angles = [2.0 * math.pi * outward * i / cuts for i in range(cuts if radius else 1)]
            return [self.add_point((middle[0] + radius * math.cos(a), middle[1] + outward * y, middle[2] - radius * math.sin(a)))
                    for a in angles]

        rings = [ring(*place) for place in profile]
        for i in range(cuts):
            j = (i + 1) % cuts
            self.triangles.append((rings[0][0], rings[1][i], rings[1][j]))
            for inner, outer in zip(rings[1:], rings[2:-1]):
                self.add_quad(inner[i], outer[i], outer[j], inner[j])
            self.triangles.append((rings[-1][0], rings[-2][j], rings[-2][i]))


def car(facets, trim=0):
    fineness = math.sqrt(facets / FACETS)

    def cuts(*usual):
        return [max(2, round(n * fineness / 2.0) * 2) for n in usual]  # even: the mesh has the car's plane of symmetry

    mesh = Mesh()
    mesh.begin("shell")
    mesh.add_cube(cuts(*CUTS), shell)
    for x in AXLES:
        for side in (-1, 1):
            mesh.begin(("front" if x > 0 else "rear") + ("_left" if side > 0 else "_right"))
            mesh.add_wheel((x, side * TRACK, WHEEL_RADIUS), side, 4 * max(2, round(6 * fineness)))
    mesh.begin("trim")
    for side in (-1, 1):
        mesh.add_cube(cuts(4, 4, 4), ellipsoid((0.55, side * 0.98, 1.02), (0.07, 0.1, 0.07)))
    mesh.add_cube(cuts(6, 4, 2), ellipsoid((-1.75, 0.3, 0.12), (0.25, 0.15, 0.06)))
    for place in trim_places(trim):
        mesh.add_cube((2, 2, 2), block(place, TRIM))
    return mesh


def write_obj(mesh, path):
    """Parts as groups."""
    groups = dict((start, f"g {part}") for part, start in mesh.parts)
    lines = ["v " + " ".join(f"{t:.6f}" for t in point) for point in mesh.points]
    for i, corners in enumerate(mesh.triangles):
        lines += [groups[i]] if i in groups else []
        lines.append("f " + " ".join(str(c + 1) for c in corners))
    path.write_text("\n".join(lines) + "\n")


def write(mesh, path):
    if path.suffix == ".obj":
        return write_obj(mesh, path)
    head = ["ply", "format ascii 1.0", f"element vertex {len(mesh.points)}", *(f"property double {axis}" for axis in "xyz"),
            f"element face {len(mesh.triangles)}", "property list uchar int vertex_indices", "end_header"]
    points = (" ".join(f"{t:.6f}" for t in point) for point in mesh.points)
    triangles = ("3 " + " ".join(map(str, corners)) for corners in mesh.triangles)
    path.write_text("\n".join([*head, *points, *triangles]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("--facets", type=int, default=FACETS, help="about how many")
    parser.add_argument("--trim", type=int, default=0, help="blocks on the shell, of 48 facets each")
    options = parser.parse_args()
    write(car(options.facets, options.trim), options.mesh)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Makes truck.ply, a rigid dump truck of about 0.3 m (standard library only).

    python3 cases/haul_truck/make_truck.py

Millimetres; x forward, y left, z up, the ground at z = 0. Every part is a closed body turned outward. Parts stand clear of one
another or run into one another by some tenths of a millimetre, as assemblies do; no two of their planes coincide."""
import math
import os
import struct

HERE = os.path.dirname(os.path.abspath(__file__))
STEP = 3.6  # longest side of a panel's grid
SCALE = 1.1  # all numbers below are a tenth smaller than the truck


class Mesh:
    """Triangles of many parts; points are shared within a part only."""

    def __init__(self):
        self.points, self.triangles = [], []

    def add(self, points, polygons):
        first = len(self.points)
        self.points += points
        for p in polygons:
            self.triangles += [(first + p[0], first + p[i], first + p[i + 1]) for i in range(1, len(p) - 1)]


# ---------------------------------------------------------------- bodies
def divided(places):
    """The same places with equal steps of at most STEP between them."""
    result = [places[0]]
    for a, b in zip(places, places[1:]):
        n = math.ceil((b - a) / STEP - 1e-9)
        result += [a + (b - a) * i / n for i in range(1, n)] + [b]
    return result


def blocks(mesh, planes, filled, place=lambda x, y, z: (x, y, z)):
    """The union of those blocks between three sets of planes for which filled(i, j, k) holds; `place` is affine."""
    axes = [divided(p) for p in planes]
    block = [[max(i for i, low in enumerate(p) if low <= 0.5 * (a + b)) for a, b in zip(axis, axis[1:])]
             for p, axis in zip(planes, axes)]
    size = [len(b) for b in block]

    def inside(cell):
        if any(not 0 <= c < n for c, n in zip(cell, size)):
            return False
        return filled(*(b[c] for b, c in zip(block, cell)))

    numbers, points, polygons = {}, [], []

    def corner(at):
        if at not in numbers:
            numbers[at] = len(points)
            points.append(place(*(axis[i] for axis, i in zip(axes, at))))
        return numbers[at]

    cells = [(i, j, k) for i in range(size[0]) for j in range(size[1]) for k in range(size[2]) if inside((i, j, k))]
    for cell in cells:
        for axis in range(3):
            for side in (0, 1):
                beside = tuple(c + (2 * side - 1) * (a == axis) for a, c in enumerate(cell))
                if inside(beside):
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                around = [(0, 0), (1, 0), (1, 1), (0, 1)] if side else [(0, 0), (0, 1), (1, 1), (1, 0)]
                quad = []
                for a, b in around:
                    at = list(cell)
                    at[axis] += side
                    at[u] += a
                    at[v] += b
                    quad.append(corner(tuple(at)))
                polygons.append(quad)
    mesh.add(points, polygons)


def box(mesh, low, high, place=lambda x, y, z: (x, y, z)):
    blocks(mesh, [(a, b) for a, b in zip(low, high)], lambda i, j, k: True, place)


def circle(sections):
    return [2.0 * math.pi * s / sections for s in range(sections)]


def turned(mesh, profile, angles, place):
    """A profile of (radius, height), turned about its axis, on which it begins and ends; a radius may be a function of the
    section's number."""
    sections = len(angles)
    points, rings = [], []
    for radius, height in profile:
        if radius == 0.0:
            rings.append([len(points)] * sections)
            points.append(place(0.0, 0.0, height))
            continue
        rings.append(list(range(len(points), len(points) + sections)))
        for s, angle in enumerate(angles):
            r = radius(s) if callable(radius) else radius
            points.append(place(r * math.cos(angle), r * math.sin(angle), height))
    polygons = []
    for low, high in zip(rings, rings[1:]):
        for s in range(sections):
            t = (s + 1) % sections
            quad = [low[s], low[t], high[t], high[s]]
            polygons.append([p for n, p in enumerate(quad) if p not in quad[:n]])
    mesh.add(points, polygons)


def rod(mesh, start, end, radius, sections=26, chamfer=0.0):
    """A round bar from one point to another; creases of 26 sections are flatter than 15 degrees."""
    axis = [b - a for a, b in zip(start, end)]
    length = math.sqrt(sum(x * x for x in axis))
    w = [x / length for x in axis]
    u = [0.0, 0.0, 1.0] if abs(w[2]) < 0.9 else [1.0, 0.0, 0.0]
    dot = sum(a * b for a, b in zip(u, w))
    u = [a - dot * b for a, b in zip(u, w)]
    size = math.sqrt(sum(x * x for x in u))
    u = [x / size for x in u]
    v = [w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0]]

    def place(x, y, z):
        return tuple(s + x * a + y * b + z * c for s, a, b, c in zip(start, u, v, w))

    steps = max(1, math.ceil(length / (3.0 * STEP)))
    quarter = [0.5 * math.pi * i / 4 for i in range(5)] if chamfer else [0.5 * math.pi]
    ends = [(radius - chamfer * (1.0 - math.sin(a)), chamfer * (1.0 - math.cos(a))) for a in quarter]
    profile = [(0.0, 0.0)] + ends
    profile += [(radius, chamfer + (length - 2.0 * chamfer) * i / steps) for i in range(1, steps)]
    profile += [(r, length - z) for r, z in reversed(ends)] + [(0.0, length)]
    turned(mesh, profile, circle(sections), place)


# ---------------------------------------------------------------- parts
LUGS, LUG = 16, (0.0, 0.55, 0.60, 0.95)  # blocks round a tyre; sections of one in shares of its pitch, the first two on top


def tyre(mesh, x, y, outward):
    """Tyre and rim, radius 34, width 27; a tread of blocks 2.4 high; `outward` is +1 on the left side."""
    top, groove, shoulder = 34.0, 31.6, 12.0

    def tread(s):
        return top if s % len(LUG) < 2 else groove

    side = [(19.6, 11.0), (21.0, 12.2), (23.0, 13.1), (25.3, 13.5), (27.6, 13.4), (29.4, 12.9), (30.8, shoulder)]
    dish = [(0.0, 8.4), (5.5, 7.8), (8.0, 3.2), (17.6, 3.4)]
    across = [11.0, 5.5, 0.0, -5.5, -11.0]
    back = [(30.8, -shoulder)] + [(r, -h) for r, h in reversed(side[:-1])] + [(18.0, -7.0), (9.0, -6.0), (0.0, -6.0)]
    profile = dish + side + [(tread, h) for h in across] + back
    profile.reverse()
    angles = [2.0 * math.pi / LUGS * (lug + share) for lug in range(LUGS) for share in LUG]
    turned(mesh, profile, angles, lambda a, b, c: (x - outward * a, y + outward * c, 34.0 + b))


LEAN = 20.0 / 62.0  # of the bucket's front wall


def tub(mesh):
    """The bucket's sides, floor and rounded corners: a U of walls 2 thick along x."""
    stations = divided([-146.0, 20.0])
    half, thick, radius = 60.0, 2.0, 14.0

    def outline(floor, top, half, radius):
        corner = [0.5 * math.pi * i / 12 for i in range(13)]
        right = [(-half, top + (floor + radius - top) * i / 14) for i in range(14)]
        right += [(-half + radius * (1.0 - math.cos(a)), floor + radius * (1.0 - math.sin(a))) for a in corner]
        flat = divided([-half + radius, half - radius])[1:-1]
        return right + [(y, floor) for y in flat] + [(-y, z) for y, z in reversed(right)]

    def ring_at(x):
        share = (22.0 - x) / 168.0
        floor, top = 58.0 + 21.0 * share, 118.0 - 6.0 * share
        return outline(floor, top, half, radius) + outline(floor + thick, top, half - thick, radius - thick)[::-1]

    rings, points = [], []
    for x in stations[:-1]:
        ring = [(x, y, z) for y, z in ring_at(x)]
        rings.append(range(len(points), len(points) + len(ring)))
        points += ring
    ring = []  # the last one leans like the front wall
    for i in range(len(rings[0])):
        x = stations[-1]
        for _ in range(60):
            y, z = ring_at(x)[i]
            x = stations[-1] + LEAN * (z - 57.0)
        ring.append((x, y, z))
    rings.append(range(len(points), len(points) + len(ring)))
    points += ring
    n = len(rings[0])
    polygons = [[a[i], a[(i + 1) % n], b[(i + 1) % n], b[i]] for a, b in zip(rings, rings[1:]) for i in range(n)]
    wall = [(i, i + 1, n - 2 - i, n - 1 - i) for i in range(n // 2 - 1)]
    polygons += [[rings[0][i] for i in reversed(w)] for w in wall] + [[rings[-1][i] for i in w] for w in wall]
    mesh.add(points, polygons)


def bucket(mesh):
    tub(mesh)

    def leaning(x, y, z):
        return x + LEAN * (z - 57.0), y, z

    box(mesh, (18.5, -59.3, 57.3), (21.5, 59.3, 118.6), leaning)  # front wall
    canopy = [(37.5, 124.0, 126.0), (-63.0, 63.0), (114.0, 117.6, 120.4, 127.4)]
    blocks(mesh, canopy, lambda i, j, k: k == 1 or i == 1)  # with a lip along its front edge, up and down
    for y in (-45.0, -15.0, 15.0, 45.0):  # beams under the canopy and down the front wall
        box(mesh, (41.6, y - 1.5, 113.8), (120.0, y + 1.5, 117.9), lambda x, y, z: (x + 0.6 * (z - 117.9), y, z))
        box(mesh, (21.2, y - 1.5, 58.0), (25.0, y + 1.5, 116.0), leaning)
    for side in (-1, 1):  # ribs and a rim along the sides
        for x in (-140.0, -108.0, -76.0, -44.0, -12.0):
            y = sorted((side * 59.7, side * 63.7))
            box(mesh, (x - 2.5, y[0], 82.0), (x + 2.5, y[1], 110.6), lambda x, y, z: (x - 0.25 * (abs(y) - 59.7), y, z))
        y = sorted((side * 59.5, side * 64.4))
        box(mesh, (-145.8, y[0], 110.3), (20.7, y[1], 114.2), lambda x, y, z: (x - 0.3 * (z - 112.0), y, z + 0.036 * (x + 30.0)))
    for y in (-22.0, 22.0):  # longitudinal beams under the floor
        box(mesh, (-128.0, y - 2.5, 48.0), (16.0, y + 2.5, 58.7), lambda x, y, z: (x, y, z - 0.125 * (x - 16.0)))


def chassis(mesh):
    for y in (-17.0, 17.0):
        box(mesh, (-122.0, y - 3.0, 36.0), (112.0, y + 3.0, 47.0))
    for x in (-118.0, -30.0, 22.0, 70.0):
        box(mesh, (x, -14.3, 38.0), (x + 6.0, 14.3, 45.5))
    for x, wide in ((82.0, 46.0), (-66.0, 60.0)):  # axles
        rod(mesh, (x, -wide, 34.0), (x, wide, 34.0), 5.2, 40)
    profile = [(0.0, -15.0)] + [(13.0 * math.sin(math.pi * i / 16), -15.0 * math.cos(math.pi * i / 16)) for i in range(1, 16)]
    turned(mesh, profile + [(0.0, 15.0)], circle(40),
           lambda a, b, c: (-66.0 - a, c, 34.3 + b))  # differential
    for side in (-1, 1):
        rod(mesh, (82.0, side * 34.0, 36.0), (78.0, side * 30.0, 77.0), 4.2, 32)  # front struts
        rod(mesh, (-78.0, side * 12.0, 36.0), (-92.0, side * 12.0, 58.0), 3.6, 30)  # rear struts
        rod(mesh, (-4.0, side * 24.5, 43.0), (5.0, side * 30.2, 75.0), 4.6, 36, 0.8)  # hoist: barrel
        rod(mesh, (4.0, side * 29.6, 72.0), (9.5, side * 33.1, 94.0), 2.7, 28)  # and rod
        rod(mesh, (8.3, side * 28.0, 92.5), (9.4, side * 40.0, 93.3), 3.4, 28)  # its pin
    rod(mesh, (-22.0, -38.0, 47.0), (40.0, -38.0, 47.0), 13.5, 72, 2.5)  # fuel tank
    rod(mesh, (24.0, -38.0, 58.0), (24.0, -38.0, 62.5), 3.0, 28, 0.5)  # its cap
    box(mesh, (-8.0, 27.0, 38.0), (36.0, 47.0, 58.5), lambda x, y, z: (x - 0.08 * (z - 38.0), y, z))  # hydraulic tank
    for y in (-37.0, 37.0):
        box(mesh, (0.0, min(y, 0.5 * y) + 1.5, 40.2), (3.0, max(y, 0.5 * y) - 1.5, 43.3))  # brackets


def front(mesh):
    """Bumper, engine housing with its grille, deck, cab, lamps."""

    def raked(rake, foot):
        return lambda x, y, z: (x - rake * (z - foot), y, z)

    box(mesh, (112.5, -56.0, 30.0), (121.0, 56.0, 41.5), raked(-0.16, 30.0))  # bumper, leaning forward
    rows = 7
    levels = [39.7, 46.0] + [46.0 + 28.0 * (n + 0.5 * h) / rows for n in range(rows) for h in (1, 2)] + [78.7]
    blocks(mesh, [(60.0, 113.0, 116.0), (-28.0, -24.5, 24.5, 28.0), levels],
           lambda i, j, k: i == 0 or j != 1 or k == 0 or k % 2 == 0 or k == len(levels) - 2, raked(0.09, 40.0))  # with slots
    box(mesh, (52.0, -66.0, 78.4), (114.5, 66.0, 81.4), raked(0.2, 78.4))  # deck
    for side in (-1, 1):  # its brackets, mudguards of the front tyres
        box(mesh, (60.0, side * 46.0 - 14.0, 75.5), (62.0, side * 46.0 + 14.0, 78.6), raked(0.3, 75.5))
        box(mesh, (46.0, side * 49.0 - 15.0, 55.0), (47.6, side * 49.0 + 15.0, 79.6), raked(-0.35, 80.0))
    cab(mesh)
    for y in (-46.0, -37.0, 37.0, 46.0):  # lamps: domes
        cap = [(3.2 * math.sin(0.5 * math.pi * i / 6), 2.0 * math.cos(0.5 * math.pi * i / 6)) for i in range(1, 7)]
        turned(mesh, [(0.0, -3.0), (3.2, -3.0)] + cap[::-1] + [(0.0, 2.0)], circle(26),
               lambda a, b, c: (122.4 + c, y + a, 36.5 + b))


def cab(mesh):
    """Walls with panes 1.6 deep behind them, leaning back by 0.12; a roof that overhangs."""
    x, y = (72.0, 73.6, 77.0, 88.0, 91.0, 104.0, 106.4, 108.0), (6.0, 7.6, 11.0, 33.0, 36.0, 55.0, 58.4, 60.0)
    z = (81.2, 92.0, 107.0, 110.6)

    def filled(i, j, k):
        if k != 1:
            return True
        side = i in (2, 4) and j in (0, 6)
        ends = i in (0, 6) and j in (2, 4)
        return not (side or ends)

    def leaning(x, y, z):
        return x - 0.12 * (z - 81.0), y, z

    blocks(mesh, [x, y, z], filled, leaning)
    box(mesh, (70.0, 4.5, 110.3), (110.5, 61.5, 112.4), leaning)

    def askew(x, y, z):
        return x - 0.2 * (z - 81.0) + 0.14 * (y + 36.0), y - 0.14 * (x - 83.0), z

    box(mesh, (66.0, -52.0, 81.1), (100.0, -20.0, 99.0), askew)  # electric cabinet, turned away from the bucket's front wall
    for y, z in ((64.5, 96.0), (-63.0, 92.0)):  # mirrors
        box(mesh, (109.0, y - 3.0, z), (110.2, y + 3.0, z + 9.0), lambda a, b, c: (a - 0.3 * (b - y), b, c))
        rod(mesh, (109.0, y * 0.965, z - 14.9), (109.7, y, z + 0.5), 0.6)


def ladders_and_rails(mesh):
    for side in (-1, 1):
        for y in (41.0, 51.0):  # stringers
            box(mesh, (118.4, side * y - 0.8, 40.9), (121.0, side * y + 0.8, 80.0), lambda x, y, z: (x - 0.12 * (z - 41.0), y, z))
        for n in range(7):
            x, z = 119.2 - 0.12 * 5.3 * n, 44.6 + 5.3 * n
            rod(mesh, (x, side * 40.9, z), (x, side * 51.1, z), 0.8)
    for side in (-1, 1):
        y = side * 64.0
        posts = [(112.4, side * 36.0), (112.4, side * 53.5), (112.4, y), (93.0, y), (74.0, y), (55.0, y)]
        for px, py in posts:
            rod(mesh, (px, py, 81.0), (px, py, 95.3), 0.8)
        for z in (88.0, 95.0):
            rod(mesh, (112.5, side * 53.0, z), (112.5, y + side * 0.4, z), 0.7)
            rod(mesh, (112.9, y + side * 0.1, z + 0.2), (54.5, y + side * 0.1, z + 0.2), 0.7)
    for z in (88.0, 95.0):
        rod(mesh, (112.5, -36.5, z), (112.5, 36.5, z), 0.7)


def truck():
    mesh = Mesh()
    for side in (-1, 1):
        tyre(mesh, 82.0, side * 53.0, side)
        tyre(mesh, -66.0, side * 59.0, side)
        tyre(mesh, -66.0, side * 30.5, side)
    bucket(mesh)
    chassis(mesh)
    front(mesh)
    ladders_and_rails(mesh)
    return mesh


def write_ply(path, mesh):
    """Binary little-endian PLY, double coordinates: planes that lean stay planes."""
    header = ("ply\nformat binary_little_endian 1.0\ncomment a dump truck, millimetres\n"
              f"element vertex {len(mesh.points)}\nproperty double x\nproperty double y\nproperty double z\n"
              f"element face {len(mesh.triangles)}\nproperty list uchar ushort vertex_indices\nend_header\n")
    with open(path, "wb") as f:
        f.write(header.encode())
        f.writelines(struct.pack("<3d", *(SCALE * x for x in p)) for p in mesh.points)
        f.writelines(struct.pack("<B3H", 3, *t) for t in mesh.triangles)


if __name__ == "__main__":
    write_ply(os.path.join(HERE, "truck.ply"), truck())

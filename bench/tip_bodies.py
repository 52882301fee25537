"""Ogives and cone-spheres of tests/data/tips.csv as meshes: tip at z > 0, largest radius `a`; angles in radians."""
import math


def ogive(half_angle, a):
    """Corners and faces; rows crowd at the tips."""
    radius, count = a / (1.0 - math.cos(half_angle)), 80
    rows = []
    for i in range(count + 1):
        turn = half_angle * math.cos(math.pi * i / count)
        rows.append((radius * (math.cos(turn) - math.cos(half_angle)), radius * math.sin(turn)))
    return revolution(rows)


def cone_sphere(half_angle, a):
    """The sphere is about the origin."""
    s, c = math.sin(half_angle), math.cos(half_angle)
    rows = [(a * c * x, a * (s + (1.0 - x) * c * c / s)) for x in ((i / 36.0) ** 1.5 for i in range(37))]
    cap = math.pi / 2 + half_angle
    rows += [(a * math.cos(half_angle - cap * i / 24), a * math.sin(half_angle - cap * i / 24)) for i in range(1, 25)]
    return revolution(rows)


def revolution(rows, columns=72):
    """The first and the last of the rows (radius, height) are poles."""
    corners, ring = [(0.0, 0.0, rows[0][1])], [[0] * columns]
    for radius, height in rows[1:-1]:
        ring.append(list(range(len(corners), len(corners) + columns)))
        for j in range(columns):
            angle = 2 * math.pi * j / columns
            corners.append((radius * math.cos(angle), radius * math.sin(angle), height))
    ring.append([len(corners)] * columns)
    corners.append((0.0, 0.0, rows[-1][1]))
    faces = []
    for upper, lower in zip(ring, ring[1:]):
        for j in range(columns):
            k = (j + 1) % columns
            quad = [upper[j], lower[j], lower[k], upper[k]]
            faces += [face for face in ((quad[0], quad[1], quad[3]), (quad[1], quad[2], quad[3])) if len(set(face)) == 3]
    return corners, faces

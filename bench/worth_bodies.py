"""Bodies of bodies.csv as meshes. Sizes in wavelengths, `body` gives metres.

Every function gives corners and faces, outward normals. With `step` (of the order of the edges' length) the mesh is one for a method of
moments, its rows crowd at edges; without it, the mesh is what one gives to raytube: polyhedra of few triangles, curved bodies of fine facets.
"""
import math

WAVELENGTH = 299792458.0 / 10e9


def weld(triangles):
    """Corners and faces of triangles given by their points; those with two equal corners are left out."""
    index, corners, faces = {}, [], []
    for triangle in triangles:
        face = []
        for point in triangle:
            key = tuple(round(x * 1e9) for x in point)
            if key not in index:
                index[key] = len(corners)
                corners.append(point)
            face.append(index[key])
        if len(set(face)) == 3:
            faces.append(tuple(face))
    return corners, faces


def halves(p, q, r, s):
    """The two triangles of a quadrilateral, cut along the shorter diagonal."""
    if math.dist(q, s) < math.dist(p, r) * 1.000001:
        return [(p, q, s), (q, r, s)]
    return [(p, q, r), (p, r, s)]


def strip(a, b):
    """Triangles between two rows of points of any two lengths, by the shorter diagonal; b lies to the left of a, seen from outside."""
    if len(a) == len(b):
        return [triangle for quad in zip(a, a[1:], b[1:], b) for triangle in halves(*quad)]
    i, j, triangles = 0, 0, []
    while i < len(a) - 1 or j < len(b) - 1:
        along_a = j == len(b) - 1 or (i < len(a) - 1 and math.dist(a[i + 1], b[j]) < math.dist(a[i], b[j + 1]) * 1.000001)
        if along_a:
            triangles.append((a[i], a[i + 1], b[j]))
            i += 1
        else:
            triangles.append((a[i], b[j + 1], b[j]))
            j += 1
    return triangles


def sheet(rows):
    """Triangles of all strips between rows."""
    return [triangle for a, b in zip(rows, rows[1:]) for triangle in strip(a, b)]


def turned(triangles):
    """The other side out."""
    return [(a, c, b) for a, b, c in triangles]


def pieces(length, step):
    """Into how many pieces a line is cut."""
    return max(1, round(length / step)) if step else 1


def spread(count, start=0.5, end=0.5):
    """count + 1 numbers from 0 to 1, crowded at an end by `start` and `end`: 0 even, 1 as the cosine."""
    def density(u):
        return 1.0 - start * (1.0 - math.sin(0.5 * math.pi * min(1.0, 2 * u))) - end * (1.0 - math.sin(0.5 * math.pi * min(1.0, 2 - 2 * u)))
    fine = 40
    total = [0.0]
    for i in range(count * fine):
        total.append(total[-1] + density((i + 0.5) / (count * fine)))
    return [x / total[-1] for x in total[::fine]]


def lattice(origin, u, v, step, crowd=0.5):
    """A parallelogram, its normal along u x v."""
    def point(s, t):
        return tuple(o + s * x + t * y for o, x, y in zip(origin, u, v))
    across = spread(pieces(math.hypot(*u), step), crowd, crowd)
    up = spread(pieces(math.hypot(*v), step), crowd, crowd)
    return sheet([[point(s, t) for t in up] for s in across][::-1])


def walls(polygon, height, step):
    """Sides of a prism over a polygon that runs counterclockwise, z from -height / 2 to height / 2."""
    triangles = []
    for (x, y), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]):
        triangles += lattice((x, y, -height / 2), (x1 - x, y1 - y, 0.0), (0.0, 0.0, height), step)
    return triangles


def both_caps(top):
    """A cap and its mirror image in the plane z = 0."""
    return top + turned([tuple((x, y, -z) for x, y, z in triangle) for triangle in top])


def box(a, b, c, step=None):
    """Cuboid of sides a, b, c along x, y, z, centred."""
    x, y = a / 2, b / 2
    top = lattice((-x, -y, c / 2), (a, 0.0, 0.0), (0.0, b, 0.0), step)
    return weld(walls([(-x, -y), (x, -y), (x, y), (-x, y)], c, step) + both_caps(top))


def triangle_cap(polygon, z, step):
    """An equilateral triangle in a lattice of triangles that crowds at its sides like `spread`."""
    count = pieces(math.dist(*polygon[:2]), step)
    share, rows = spread(count), []
    for i in range(count + 1):
        row = []
        for j in range(count - i + 1):
            weights = (share[i], share[j], share[count - i - j])
            row.append(tuple(sum(w * p[k] for w, p in zip(weights, polygon)) / sum(weights) for k in range(2)) + (z,))
        rows.append(row)
    return turned(sheet(rows))


def prism(side, height, step=None):
    """Prism over an equilateral triangle, axis z, a corner at +x; centred."""
    radius = side / math.sqrt(3.0)
    polygon = [(radius * math.cos(2 * math.pi * i / 3), radius * math.sin(2 * math.pi * i / 3)) for i in range(3)]
    return weld(walls(polygon, height, step) + both_caps(triangle_cap(polygon, height / 2, step)))


def l_block(side, height, step=None):
    """Square of `side` without its quarter x > 0, y > 0, extruded along z; the origin is the square's centre, on the concave edge."""
    h = side / 2
    polygon = [(0.0, 0.0), (0.0, h), (-h, h), (-h, 0.0), (-h, -h), (0.0, -h), (h, -h), (h, 0.0)]
    top = []
    for x, y in ((-h, -h), (0.0, -h), (-h, 0.0)):
        top += lattice((x, y, height / 2), (h, 0.0, 0.0), (0.0, h, 0.0), step)
    return weld(walls(polygon, height, step) + both_caps(top))


def plate(a, b, step=None):
    """Rectangle in the plane z = 0, sides a and b along x and y, centred."""
    return weld(lattice((-a / 2, -b / 2, 0.0), (a, 0.0, 0.0), (0.0, b, 0.0), step, 0.7))


def ring(radius, height, count):
    """Points all round, the first one twice."""
    angles = [2 * math.pi * (j % count) / count for j in range(count + 1)]
    return [(radius * math.cos(t), radius * math.sin(t), height) for t in angles] if radius else [(0.0, 0.0, height)]


def revolution(profile, step=None, columns=96):
    """Body of revolution about z; the profile (radius, z) runs from the upper pole to the lower one."""
    def count(radius):
        return max(6, round(2 * math.pi * radius / step)) if step else columns
    return weld(sheet([ring(r, z, count(r))[::-1] for r, z in profile]))


def line(p, q, step, start, end, plain=1):
    """Points from p to q, without q; `plain` pieces if there is no step."""
    count = pieces(math.dist(p, q), step) if step else plain
    return [tuple(a + (b - a) * t for a, b in zip(p, q)) for t in spread(count, start, end)[:-1]]


def arc(centre, radius, first, last, step):
    """Points of a circle about (0, centre) between two angles from the axis, without the last."""
    count = pieces(radius * abs(last - first), step or 0.06)
    angles = [first + (last - first) * i / count for i in range(count)]
    return [(radius * math.sin(t) if t else 0.0, centre + radius * math.cos(t)) for t in angles]


def cylinder(radius, height, step=None):
    """Flat ends, axis z, centred."""
    z = height / 2
    profile = line((0.0, z), (radius, z), step, 0, 0.6) + line((radius, z), (radius, -z), step, 0.5, 0.5)
    return revolution(profile + line((radius, -z), (0.0, -z), step, 0.6, 0) + [(0.0, -z)], step)


def tip_line(p, q, step, end):
    """A cone's side from the tip on; rows crowd at the tip."""
    if step:
        return line(p, q, step, 0.6, end)
    return [tuple(a + (b - a) * (i / 36.0) ** 1.5 for a, b in zip(p, q)) for i in range(36)]


def cone(half_angle, radius, step=None):
    """Flat base; tip at z > 0, origin half way up; angle in degrees."""
    z = radius / math.tan(math.radians(half_angle)) / 2
    return revolution(tip_line((0.0, z), (radius, -z), step, 0.6) + line((radius, -z), (0.0, -z), step, 0.6, 0) + [(0.0, -z)], step)


def cone_sphere(half_angle, radius, step=None):
    """Tip at z > 0; the sphere is about the origin; angle in degrees."""
    t = math.radians(half_angle)
    seam = (radius * math.cos(t), radius * math.sin(t))
    return revolution(tip_line((0.0, radius / math.sin(t)), seam, step, 0) + arc(0.0, radius, math.pi / 2 - t, math.pi, step) + [(0.0, -radius)], step)


def capsule(radius, straight, step=None):
    """Cylinder between two half spheres, axis z, centred."""
    z = straight / 2
    profile = arc(z, radius, 0.0, math.pi / 2, step) + line((radius, z), (radius, -z), step, 0, 0, round(straight * 16))
    return revolution(profile + arc(-z, radius, math.pi / 2, math.pi, step) + [(0.0, -z - radius)], step)


def spheroid(polar, radius, step=None):
    """Half axes `polar` along z and `radius`; rows at equal angles crowd at the rim of a flat one."""
    count = pieces(math.pi * max(radius, polar), step or 0.06)
    angles = [math.pi * i / count for i in range(count)]
    return revolution([(radius * math.sin(t) if t else 0.0, polar * math.cos(t)) for t in angles] + [(0.0, -polar)], step)


def lens(chord, thickness):
    """Half the thickness of two equal arcs, by the place along the chord (0 to 1)."""
    h, c = thickness / 2, chord / 2
    radius = (c * c + h * h) / (2 * h)
    return lambda s: math.sqrt(max(0.0, radius ** 2 - (chord * s - c) ** 2)) - (radius - h)


def naca(chord, thickness):
    """Half the thickness of a symmetric NACA section, the trailing edge (s = 1) sharp."""
    return lambda s: 5 * thickness * chord * (0.2969 * math.sqrt(s) - 0.126 * s - 0.3516 * s ** 2 + 0.2843 * s ** 3 - 0.1036 * s ** 4)


def cap_column(x, y, h, step):
    """Points across the end cap, from the lower surface to the upper one."""
    count = pieces(2 * h, step)
    return [(x, y, h * (2.0 * i / count - 1.0)) for i in range(count + 1)]


def wing(chord, span, half, places, step=None, sweep=0.0):
    """Section along x, thickness 2 half(s) along z at places s, span along y with sweep in degrees and flat ends; centred."""
    slope = math.tan(math.radians(sweep))
    thick = [max(0.0, half(s)) if 0 < s < 1 else 0.0 for s in places]
    upper = [(chord * (s - 0.5), h) for s, h in zip(places, thick)]
    loop = upper[::-1] + [(x, -h) for x, h in upper[1:]]
    count, crowd = (pieces(span, step), 0.5) if step else (round(8 * span), 0.0)
    rows = []
    for t in spread(count, crowd, crowd):
        y = span * (t - 0.5)
        rows.append([(x + slope * y, y, z) for x, z in loop])
    triangles = turned(sheet(rows))
    for y, turn in ((-span / 2, True), (span / 2, False)):
        cap = sheet([cap_column(x + slope * y, y, h, step) for x, h in upper])
        triangles += turned(cap) if turn else cap
    return weld(triangles)


def lens_wing(chord, thickness, span, step=None, sweep=0.0):
    """Wing of lens section, sharp edges along y."""
    places = spread(pieces(1.15 * chord, step), 0.8, 0.8) if step else [(1 - math.cos(math.pi * i / 40)) / 2 for i in range(41)]
    return wing(chord, span, lens(chord, thickness), places, step, sweep)


def naca_wing(chord, thickness, span, step=None):
    """Wing of a symmetric NACA section (thickness by chord), round leading edge at x < 0, sharp trailing edge at x > 0."""
    count = pieces(1.5 * chord, step) if step else 64
    return wing(chord, span, naca(chord, thickness), [(1 - math.cos(math.pi * i / count)) / 2 for i in range(count + 1)], step)


BODIES = {
    "plate": lambda step=None: plate(3.0, 1.7, step),
    "box": lambda step=None: box(2.5, 1.5, 1.0, step),
    "prism 60": lambda step=None: prism(2.5, 2.0, step),
    "L-block": lambda step=None: l_block(2.5, 1.25, step),
    "cylinder": lambda step=None: cylinder(0.8, 2.5, step),
    "drum": lambda step=None: cylinder(1.25, 0.6, step),
    "cone": lambda step=None: cone(20.0, 0.9, step),
    "cone-sphere": lambda step=None: cone_sphere(25.0, 0.8, step),
    "capsule": lambda step=None: capsule(0.7, 2.0, step),
    "cushion": lambda step=None: spheroid(1.6 / 6, 1.6, step),
    "wing A": lambda step=None: lens_wing(2.5, 0.2, 2.5, step),
    "wing B": lambda step=None: lens_wing(2.0, 0.35, 3.0, step, 30.0),
    "NACA wing": lambda step=None: naca_wing(2.5, 0.12, 2.5, step),
}


def scaled(mesh, factor):
    """The mesh made larger."""
    corners, faces = mesh
    return [tuple(factor * x for x in corner) for corner in corners], faces


def body(name, step=None, wavelength=WAVELENGTH):
    """Corners and faces of a body of BODIES in metres."""
    return scaled(BODIES[name](step), wavelength)


def write_off(path, mesh):
    """Writes a mesh as OFF."""
    corners, faces = mesh
    with open(path, "w") as out:
        out.write("OFF\n%d %d 0\n" % (len(corners), len(faces)))
        out.writelines("%.12g %.12g %.12g\n" % corner for corner in corners)
        out.writelines("3 %d %d %d\n" % face for face in faces)

#!/usr/bin/env python3
"""Makes the meshes, look lists and closed-form references of the cases in this folder (standard library only).

    python3 cases/make_cases.py        # rewrites cases/*/{mesh, looks.csv, reference.csv}

Conventions are raytube's: e^{+j omega t}, direction from the target to the radar, S_pq in metres. Every reference is written
with its formula below; `reference.csv` has the key and S columns of rcs.csv."""
import cmath
import math
import os
import struct

HERE = os.path.dirname(os.path.abspath(__file__))
C0 = 299792458.0


# ---------------------------------------------------------------- writing
def write_off(path, vertices, facets):
    with open(os.path.join(HERE, path), "w") as f:
        f.write(f"OFF\n{len(vertices)} {len(facets)} 0\n")
        for v in vertices:
            f.write(" ".join(repr(float(x)) for x in v) + "\n")
        for t in facets:
            f.write(" ".join(map(str, (len(t), *t))) + "\n")


def write_ply(path, vertices, facets):
    """Binary little-endian PLY, double coordinates."""
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
              f"element face {len(facets)}\nproperty list uchar int vertex_indices\nend_header\n")
    with open(os.path.join(HERE, path), "wb") as f:
        f.write(header.encode())
        for v in vertices:
            f.write(struct.pack("<3d", *v))
        for t in facets:
            f.write(struct.pack("<B3i", 3, *t))


def write_obj(path, parts):
    """Groups by name, each (vertices, facets)."""
    with open(os.path.join(HERE, path), "w") as f:
        before = 1
        for name, (vertices, facets) in parts.items():
            f.write(f"g {name}\n" + "".join("v " + " ".join(f"{x:.9g}" for x in v) + "\n" for v in vertices))
            f.write("".join("f " + " ".join(str(i + before) for i in t) + "\n" for t in facets))
            before += len(vertices)


def write_stl(path, vertices, facets, name):
    """ASCII STL."""
    with open(os.path.join(HERE, path), "w") as f:
        f.write(f"solid {name}\n")
        for t in facets:
            a, b, c = (vertices[i] for i in t)
            u, w = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
            n = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
            size = math.sqrt(sum(x * x for x in n))
            f.write("facet normal " + " ".join(f"{x / size:.9g}" for x in n) + "\n outer loop\n")
            for p in (a, b, c):
                f.write("  vertex " + " ".join(f"{x:.17g}" for x in p) + "\n")
            f.write(" endloop\nendfacet\n")
        f.write(f"endsolid {name}\n")


def write_looks(path, looks):
    with open(os.path.join(HERE, path), "w") as f:
        f.write("theta_deg,phi_deg\n" + "".join(f"{t:.10g},{p:.10g}\n" for t, p in looks))


def head(provenance, run, compare, tolerance, table="rcs.csv"):
    """What cases/references.py needs to know."""
    return f"# provenance: {provenance}\n# run: {run}\n# table: {table}\n# compare: {compare}\n# tolerance: {tolerance}\n"


def write_reference(path, head_lines, freq, looks, amplitudes, transmit=None, times=None):
    """amplitudes: per look (S_vv, S_hh); the closed forms here have no cross-polarisation. `looks` are the receiver's directions; the
    transmitter is with it unless `transmit` says where; of a scene that moves each look has its time."""
    with open(os.path.join(HERE, path), "w") as f:
        f.write(head_lines)
        f.write("time_s," * bool(times) + "freq_hz,theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,re_vv,im_vv,re_vh,im_vh,re_hv,im_hv,re_hh,im_hh\n")
        for i, ((t, p), (vv, hh)) in enumerate(zip(looks, amplitudes)):
            keys = ",".join(f"{x:.10g}" for x in (*(times[i:i + 1] if times else ()), freq, *(transmit or (t, p)), t, p))
            f.write(f"{keys},{vv.real:.12g},{vv.imag:.12g},0,0,0,0,{hh.real:.12g},{hh.imag:.12g}\n")


# ---------------------------------------------------------------- closed forms
def sinc(x):
    return 1.0 if x == 0.0 else math.sin(x) / x


def plate_po(a, b, freq, theta, phi):
    """Rectangular plate a x b in z = 0, monostatic physical optics (Knott, Shaeffer & Tuley 2004, ch. 5)."""
    k = 2 * math.pi * freq / C0
    s = math.sin(theta)
    return -1j * a * b * k / (2 * math.pi) * abs(math.cos(theta)) * sinc(k * a * s * math.cos(phi)) * sinc(k * b * s * math.sin(phi))


def dihedral_po(w, b, freq, g):
    """Right-angled dihedral, faces w x b on +x and +y, elevation 0, azimuth g: single bounces of both faces and the double
    bounce over the lit aperture, all radiating. Returns (S_vv, S_hh)."""
    k = 2 * math.pi * freq / C0
    s, c = math.sin(g), math.cos(g)
    single = w * s * sinc(k * w * c) * cmath.exp(1j * k * w * c) + w * c * sinc(k * w * s) * cmath.exp(1j * k * w * s)
    double = 2 * w * min(s, c)
    return tuple(-1j * b * k / (2 * math.pi) * (single + sign * double) for sign in (-1, 1))


def slab_transmission(eps_r, thickness, freq, cosine):
    """(TE, TM) of a dielectric slab in vacuum, relative to the same way through vacuum (Born & Wolf 1999, section 1.6.4)."""
    k = 2 * math.pi * freq / C0
    q = cmath.sqrt(eps_r - 1 + cosine * cosine)
    once, way = cmath.exp(-1j * k * q * thickness), cmath.exp(1j * k * cosine * thickness)
    return tuple((1 - r * r) * once * way / (1 - (r * once) ** 2) for r in ((cosine - q) / (cosine + q), (eps_r * cosine - q) / (eps_r * cosine + q)))


def cube_po(a, freq, phi):
    """Cube of side a centred at the origin, theta = 90: the lit faces of azimuth 0, 90, 180, 270 deg, each a plate."""
    k = 2 * math.pi * freq / C0
    total = 0
    for face in range(4):
        g = phi - face * math.pi / 2
        if math.cos(g) > 1e-12:
            total += -1j * a * a * k / (2 * math.pi) * math.cos(g) * sinc(k * a * math.sin(g)) * cmath.exp(1j * k * a * math.cos(g))
    return total


def simpson(f, low, high, panels):
    h = (high - low) / panels
    return h / 3 * sum((1 if i in (0, panels) else 4 if i % 2 else 2) * f(low + i * h) for i in range(panels + 1))


def bessel_j1(x):
    return simpson(lambda t: math.cos(t - x * math.sin(t)), 0, math.pi, 400) / math.pi


def cylinder_po(a, b, freq, theta):
    """Closed circular cylinder of radius a, length b along z, centred: lit half of the side and the lit cap,
    S = -(j / lambda) INT (n.r) e^{2jk r.r'} dA."""
    k = 2 * math.pi * freq / C0
    s, c = math.sin(theta), math.cos(theta)
    if s < 1e-12:
        s = 0.0
    side = a * b * sinc(k * b * c) * s * simpson(lambda p: math.cos(p) * cmath.exp(2j * k * a * s * math.cos(p)), -math.pi / 2, math.pi / 2, 2000)
    x = 2 * k * a * s
    cap = math.pi * a * a * abs(c) * (1.0 if x == 0 else 2 * bessel_j1(x) / x) * cmath.exp(1j * k * b * abs(c)) if abs(c) > 1e-12 else 0
    return -1j * k / (2 * math.pi) * (side + cap)


def sphere_mie(a, freq, gamma=0.0):
    """S of a perfectly conducting sphere, exact series (Bohren & Huffman 1983, section 4.4, for a perfect conductor and e^{+j omega t});
    gamma is the angle between the directions to transmitter and receiver, 0 for backscatter. Returns (E in the scattering plane,
    E across it), each referred to basis vectors that coincide for gamma = 0."""
    k = 2 * math.pi * freq / C0
    x, u = k * a, -math.cos(gamma)
    nmax = int(x + 4 * x ** (1 / 3) + 20)
    y = [-math.cos(x) / x, -math.cos(x) / x ** 2 - math.sin(x) / x]
    for n in range(1, nmax + 1):
        y.append((2 * n + 1) / x * y[n] - y[n - 1])
    start = nmax + 60
    j = [0.0] * (start + 2)
    j[start] = 1e-280
    for n in range(start, 0, -1):
        j[n - 1] = (2 * n + 1) / x * j[n] - j[n + 1]
        if abs(j[n - 1]) > 1e200:
            j = [v * 1e-200 for v in j]
    scale = (math.sin(x) / x) / j[0]
    in_plane = across = 0
    pi_before, pi_now = 0.0, 1.0  # angle functions, by recurrence
    for n in range(1, nmax + 1):
        jn, jm = j[n] * scale, j[n - 1] * scale
        hn, hm = complex(jn, -y[n]), complex(jm, -y[n - 1])
        b_n = jn / hn
        a_n = (x * jm - n * jn) / (x * hm - n * hn)
        tau = n * u * pi_now - (n + 1) * pi_before
        weight = (2 * n + 1) / (n * (n + 1))
        in_plane += weight * (a_n * tau + b_n * pi_now)
        across += weight * (a_n * pi_now + b_n * tau)
        pi_before, pi_now = pi_now, ((2 * n + 1) * u * pi_now - (n + 1) * pi_before) / n
    return -in_plane / (1j * k), across / (1j * k)


def sphere_po(a, freq):
    """Backscatter of the lit half of a sphere, S = -(j / lambda) INT (n.r) e^{2jk r.r'} dA."""
    k = 2 * math.pi * freq / C0
    x = 2 * k * a
    return -1j * k * a * a * (cmath.exp(1j * x) * (1 / (1j * x) + 1 / x ** 2) - 1 / x ** 2)


def trihedral_triple(a, freq, theta, phi):
    """Triple bounce alone of a triangular trihedral of leg a: |S| = A / lambda with the aperture A of its legs' direction cosines
    (Siegel et al. 1955; Robertson 1947), any polarisation."""
    k = 2 * math.pi * freq / C0
    low, middle, high = sorted((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)))
    s = low + middle + high
    aperture = 4 * low * middle / s if low + middle <= high else s - 2 / s
    return max(aperture, 0.0) * a * a * k / (2 * math.pi)


# ---------------------------------------------------------------- meshes
def icosphere(subdivisions):
    p = (1 + math.sqrt(5)) / 2
    v = [(-1, p, 0), (1, p, 0), (-1, -p, 0), (1, -p, 0), (0, -1, p), (0, 1, p), (0, -1, -p), (0, 1, -p), (p, 0, -1), (p, 0, 1), (-p, 0, -1), (-p, 0, 1)]
    t = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
         (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    unit = lambda q: tuple(x / math.sqrt(sum(y * y for y in q)) for x in q)
    v = [unit(q) for q in v]
    for _ in range(subdivisions):
        middle, finer = {}, []

        def mid(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(v)
                v.append(unit([v[a][i] + v[b][i] for i in range(3)]))
            return middle[key]

        for a, b, c in t:
            ab, bc, ca = mid(a, b), mid(b, c), mid(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        t = finer
    return v, t


def cylinder(a, b, sides):
    ring = [(a * math.cos(2 * math.pi * i / sides), a * math.sin(2 * math.pi * i / sides)) for i in range(sides)]
    v = [(x, y, -b / 2) for x, y in ring] + [(x, y, b / 2) for x, y in ring]
    t = [tuple(reversed(range(sides))), tuple(range(sides, 2 * sides))]
    t += [(i, (i + 1) % sides, sides + (i + 1) % sides, sides + i) for i in range(sides)]
    return v, t


CUBE = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]


def main():
    # plate: 1.5 m in z = 0, 3 GHz; theta 45 ... 0 ... 45 degrees through phi = 180, then 0
    h = 0.75
    write_off("plate/plate.off", [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [(0, 1, 2), (0, 2, 3)])
    looks = [(45 - i / 10, 180) for i in range(450)] + [(i / 10, 0) for i in range(451)]
    write_looks("plate/looks.csv", looks)
    write_reference("plate/reference.csv", head("physical optics, closed form of a rectangular plate (Knott, Shaeffer & Tuley 2004, ch. 5)",
                                               "run case.toml", "--tolerance-db 1e-10 --within-db 40",
                                               "rounding only: k r is 100 rad, 2^-53 of it seen from 40 dB down is 1e-10 dB"), 3e9, looks,
                    [(plate_po(1.5, 1.5, 3e9, math.radians(t), math.radians(p)),) * 2 for t, p in looks])

    # convergence: 150 mm plate turned 33 degrees in z = 0
    c, s, h = math.cos(math.radians(33)), math.sin(math.radians(33)), 75.0
    write_off("convergence/plate33.off", [(x * c - y * s, x * s + y * c, 0) for x, y in ((-h, -h), (h, -h), (h, h), (-h, h))], [(0, 1, 2), (0, 2, 3)])

    # dihedral: 150 mm plates, 94 GHz; the whole interior range and a fine strip about the bisector
    w = 150.0
    v = [(0, 0, -w / 2), (w, 0, -w / 2), (w, 0, w / 2), (0, 0, w / 2), (0, w, -w / 2), (0, w, w / 2)]
    write_off("dihedral/dihedral.off", v, [(0, 3, 2), (0, 2, 1), (0, 4, 5), (0, 5, 3)])
    phis = sorted({round(i / 2, 2) for i in range(181)} | {round(43 + i / 20, 2) for i in range(81)})
    looks = [(90, p) for p in phis]
    write_looks("dihedral/looks.csv", looks)
    no_edges = "run case.toml --set edges.method=none"
    write_reference("dihedral/reference.csv", head("physical optics of both single bounces and the double bounce, closed form, no edges", no_edges,
                                                  "--tolerance-db 1e-10", "the reference holds 12 digits"), 94e9, looks,
                    [dihedral_po(0.15, 0.15, 94e9, math.radians(p)) for _, p in looks])

    # radome: the same dihedral at 77 GHz behind a slab of 3 mm whose normal has the azimuth 80 degrees, 320 mm from the fold. A rhombus, so that
    # no look along the plane z = 0 is across one of its edges; as large as all the beams of the dihedral from 30 to 60 degrees need
    normal = (math.cos(math.radians(80)), math.sin(math.radians(80)))
    corners = [(320 * normal[0] - t * normal[1], 320 * normal[1] + t * normal[0], z) for t, z in ((-737, 0), (-267, -155), (203, 0), (-267, 155))]
    write_off("radome/sheet.off", corners, [(0, 1, 2, 3)])
    looks = [(90, 30 + i / 2) for i in range(61)]
    amplitudes = [[s * t ** 2 for s, t in zip(dihedral_po(0.15, 0.15, 77e9, math.radians(p)),
                                              slab_transmission(2.6 - 0.03j, 3e-3, 77e9, math.cos(math.radians(p - 80))))] for _, p in looks]
    write_reference("radome/reference.csv", head("physical optics of the dihedral, closed form, times the square of what the slab lets through, no edges", no_edges,
                                                "--tolerance-db 0.02", "at 60 degrees what goes to and fro between slab and dihedral, 0.03 dB, meets the dihedral; the closed form is without it"),
                    77e9, looks, amplitudes)

    # powercube: 90 mm, 94 GHz, -10 ... 10 degrees
    v = [tuple(45.0 if i >> b & 1 else -45.0 for b in range(3)) for i in range(8)]
    write_stl("powercube/powercube.stl", v, CUBE, "powercube")
    looks = [(90, (i - 100) / 10) for i in range(201)]
    write_reference("powercube/reference.csv", head("physical optics of the lit faces, closed form, no edges", no_edges,
                                                   "--tolerance-db 1e-10 --within-db 40", "the reference holds 12 digits"), 94e9, looks,
                    [(cube_po(0.09, 94e9, math.radians(p)),) * 2 for _, p in looks])

    # trihedral: three right isosceles triangles of leg 1.5 m, opening to (+, +, +)
    write_off("trihedral/trihedral.off", [(0, 0, 0), (1.5, 0, 0), (0, 1.5, 0), (0, 0, 1.5)], [(0, 1, 2), (0, 2, 3), (0, 3, 1)])
    theta = math.acos(1 / math.sqrt(3))
    with open(os.path.join(HERE, "trihedral/reference.csv"), "w") as f:
        f.write(head("triple bounce alone, from the geometrical-optics aperture (Siegel et al. 1955; Robertson 1947); the same for vv and hh",
                     "run case.toml --parts", "--tolerance-db 1e-8 --result-columns re_vv=re_vv_bounce_3,im_vv=im_vv_bounce_3 "
                     "--reference-columns magnitude_vv=abs_s_triple*3.5449077018110318",
                     "the reference holds 12 digits; 2 sqrt(pi) |S| is the root of sigma", "parts.csv"))
        f.write("freq_hz,theta_deg,phi_deg,abs_s_triple\n")
        for i in range(181):
            f.write(f"{3e9:.10g},{math.degrees(theta):.15g},{i / 2:g},{trihedral_triple(1.5, 3e9, theta, math.radians(i / 2)):.12g}\n")

    # sphere: a = 1 m, 20 480 triangles, 64 looks spread evenly
    v, t = icosphere(5)
    write_ply("sphere/sphere.ply", v, t)
    looks = [(math.degrees(math.acos(1 - (2 * i + 1) / 64)), (i * 137.50776405) % 360) for i in range(64)]
    looks = [(round(a, 6), round(b, 6)) for a, b in looks]
    write_looks("sphere/looks.csv", looks)
    mie = "exact series (Mie) of a perfectly conducting sphere (Bohren & Huffman 1983, section 4.4)"
    write_reference("sphere/reference.csv", head(mie, "run case.toml", "--tolerance-db 0.03",
                                                "physical optics itself is .022 dB below Mie, the mesh .002 dB off that"),
                    3e9, looks, [sphere_mie(1.0, 3e9)[::-1]] * 64)
    receivers = [(90, i / 2) for i in range(361)]
    write_reference("sphere/reference_bistatic.csv", head(mie, "run bistatic.toml", "--tolerance-db 0.45 --only rx_phi_deg=0:60",
                                                         "physical optics itself: .33 dB rms for E in the plane to 60 degrees"), 3e9,
                    receivers, [sphere_mie(1.0, 3e9, math.radians(p))[::-1] for _, p in receivers], transmit=(90, 0))

    # two_spheres: radii 0.2 and 0.1 m, 2.3 m apart, 10 GHz, theta 90, phi -4.4 ... 4.4; what a sphere returns has its phase at its middle
    spheres = ((0.2, (-1.0, 0.6, 0.0)), (0.1, (0.9, -0.7, 0.0)))
    v, t = icosphere(3)
    write_ply("two_spheres/spheres.ply", [tuple(a * x + c for x, c in zip(p, middle)) for a, middle in spheres for p in v],
              [tuple(i + len(v) * n for i in f) for n in range(2) for f in t])
    looks = [(90, round(-4.4 + i * 0.22, 2)) for i in range(41)]
    k = 2 * math.pi * 10e9 / C0
    turned = lambda p, middle: cmath.exp(2j * k * (middle[0] * math.cos(math.radians(p)) + middle[1] * math.sin(math.radians(p))))
    write_reference("two_spheres/reference.csv", head("sum of the exact series (Mie) of either sphere alone, without what goes from one to the other",
                                                     "run case.toml --set frequency.ghz=10 --set tubes.max_bounces=1 --set surfaces.waves=true", "--tolerance-relative 0.004",
                                                     "without the waves physical optics is 1 / 2 k a off where light ends, 1.2 and 2.4 %; with them .3 % is left"), 10e9, looks,
                    [[sum(sphere_mie(a, 10e9)[::-1][q] * turned(p, middle) for a, middle in spheres) for q in range(2)] for _, p in looks])

    # cylinder: radius 90 mm, length 300 mm, 144 sides, 10 GHz, theta 0 ... 180
    v, t = cylinder(90.0, 300.0, 144)
    write_off("cylinder/cylinder.off", v, t)
    looks = [(i / 2, 0) for i in range(361)]
    write_reference("cylinder/reference.csv", head("physical optics of the lit side, by quadrature, and of the cap of the smooth cylinder, no edges",
                                                  no_edges, "--tolerance-relative 0.002",
                                                  "facets are taken as the cylinder they stand for to a phase of .012 rad, most far closer"), 10e9, looks,
                    [(cylinder_po(0.09, 0.3, 10e9, math.radians(t)),) * 2 for t, _ in looks])

    moving()


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def moving():
    """Targets that move: what each part returns has the phase 2 k r.p of its place p at the time."""
    def ball(radius, middle, subdivisions=2):
        v, t = icosphere(subdivisions)
        return [tuple(radius * x + m for x, m in zip(q, middle)) for q in v], t

    direction = lambda theta, phi: (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
    one_bounce = "run case.toml --set tubes.max_bounces=1 --set surfaces.waves=true"

    # rotor: a hub of 60 mm and two plates of 0.75 m by 60 mm that begin at 0.25 m, pitched by 30 degrees, 300 rev/min about +z, 10 GHz
    root, tip, chord, pitch, hub = 0.25, 1.0, 0.06, math.radians(30), 0.06

    def blade(turn):
        """Along it, along its chord, its normal, forward and up."""
        ahead = (-math.sin(turn), math.cos(turn), 0.0)
        return ((math.cos(turn), math.sin(turn), 0.0), (*(-math.sin(pitch) * x for x in ahead[:2]), math.cos(pitch)),
                (*(math.cos(pitch) * x for x in ahead[:2]), math.sin(pitch)))

    def blade_mesh(turn):
        along, across, _ = blade(turn)
        corner = lambda r, c: tuple(r * a + c * b for a, b in zip(along, across))
        return [corner(r, c) for r, c in ((root, -chord / 2), (tip, -chord / 2), (tip, chord / 2), (root, chord / 2))], [(0, 1, 2), (0, 2, 3)]

    write_obj("rotor/rotor.obj", {"hub": ball(hub, (0, 0, 0)), "blade_1": blade_mesh(0.0), "blade_2": blade_mesh(math.pi)})
    k, look = 2 * math.pi * 10e9 / C0, direction(math.radians(60), 0.0)
    times = [i * 2e-3 for i in range(51)]
    amplitudes = []
    for time in times:
        s = sphere_po(hub, 10e9)
        for turn in (0.0, math.pi):
            along, across, normal = blade(turn + 2 * math.pi * 5.0 * time)
            u, w, c = (dot(x, look) for x in (along, across, normal))
            s += (-1j * k / (2 * math.pi) * (tip - root) * chord * abs(c) * sinc(k * (tip - root) * u) * sinc(k * chord * w)
                  * cmath.exp(1j * k * (tip + root) * u))  # plate_po, of any place
        amplitudes.append((s, s))
    write_reference("rotor/reference.csv", head("physical optics of the hub and of both blades, closed form, no edges",
                                               "run case.toml --set motion.pulses.interval_s=2e-3 --set motion.pulses.count=51 --set edges.method=none "
                                               "--set tubes.max_bounces=1", "--tolerance-relative 0.005",
                                               "a hub of 320 triangles is 4 % of its .03 m off; with 1280 all is within .001"), 10e9,
                    [(60, 0)] * len(times), amplitudes, times=times)

    # wheel: three balls of 30 mm on a rim of 0.3 m, one on the axle, rolling along +x with 5 m/s, 24 GHz
    ball_radius, rim, speed = 0.03, 0.3, 5.0
    places = lambda time: [(speed * time + rim * math.sin(b + speed / rim * time), 0.0, rim + rim * math.cos(b + speed / rim * time))
                           for b in (2 * math.pi * i / 3 for i in range(3))]
    write_obj("wheel/wheel.obj", {"axle": ball(ball_radius, (0, 0, rim)), **{f"rim_{i + 1}": ball(ball_radius, q) for i, q in enumerate(places(0.0))}})
    k, look = 2 * math.pi * 24e9 / C0, direction(math.radians(80), math.radians(20))
    times = [i * 7.5e-3 for i in range(51)]
    one = sphere_mie(ball_radius, 24e9)[0]
    sums = [one * sum(cmath.exp(2j * k * dot(look, q)) for q in (*places(time), (speed * time, 0.0, rim))) for time in times]
    write_reference("wheel/reference.csv", head("sum of the exact series (Mie) of each ball alone, without what goes from one to another",
                                               one_bounce.replace("case.toml", "case.toml --set motion.pulses.interval_s=7.5e-3 --set motion.pulses.count=51"),
                                               "--tolerance-relative 0.006", "with the waves over the balls .4 % is left, as in two_spheres"), 24e9, [(80, 20)] * len(times),
                    [(s, s) for s in sums], times=times)

    # pendulum: a ball of 0.1 m, 1 m below its pivot, that swings by 20 degrees along x, once in two seconds; 10 GHz
    swing = lambda time: math.radians(20) * math.cos(math.pi * time)
    write_obj("pendulum/ball.obj", {"ball": ball(0.1, (0, 0, -1), 3)})
    with open(os.path.join(HERE, "pendulum/poses.csv"), "w") as f:
        f.write("time_s,x_m,y_m,z_m,qw,qx,qy,qz\n")
        for i in range(-2, 105):
            f.write(f"{i / 50:.10g},0,0,0,{math.cos(swing(i / 50) / 2):.15g},0,{-math.sin(swing(i / 50) / 2):.15g},0\n")
    k = 2 * math.pi * 10e9 / C0
    times = [i * 4e-2 for i in range(51)]
    one = sphere_mie(0.1, 10e9)[0]
    write_reference("pendulum/reference.csv", head("exact series (Mie) of the ball, turned by 2 k L sin of the angle",
                                                  one_bounce.replace("case.toml", "case.toml --set motion.pulses.interval_s=4e-2 --set motion.pulses.count=51"),
                                                  "--tolerance-relative 0.008", "with the waves over the ball .6 % is left, as in two_spheres of its small sphere"), 10e9, [(90, 0)] * len(times),
                    [(one * cmath.exp(2j * k * math.sin(swing(time))),) * 2 for time in times], times=times)


if __name__ == "__main__":
    main()

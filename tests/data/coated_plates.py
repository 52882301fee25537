"""Writes coated_plates.csv: scattering of coated metal plates without end, with their thickness, lit across, by boundary integrals.

    /usr/bin/python3 tests/data/coated_plates.py > tests/data/coated_plates.csv

Conventions and method of coated_cylinders.py. Metal of width w and thickness t about the x axis, coated on its upper side ("one"), on
both ("two") or all round ("round"); there the outer width is w. Monostatic, and from 40 degrees to observers all around.
"""
import numpy as np

from coated_cylinders import Boundary, graded, k0


def rectangle(left, right, low, high, tags, d, widest=0.2):
    """Sides below, right, above, left with these tags, anticlockwise; those without one are left out."""
    corners = [left + 1j * low, right + 1j * low, right + 1j * high, left + 1j * high]
    sides = []
    for i, tag in enumerate(tags):
        a, b = corners[i], corners[(i + 1) % 4]
        shortest = min(abs(b - a), 4 * d)
        if tag is not None:
            sides.append((a, b, graded(abs(b - a), widest, shortest / 4, 3), tag))
    return sides


def reversed_sides(sides):
    return [(b, a, (1 - np.array(breaks))[::-1], tag) for a, b, breaks, tag in sides]


def plate(body, w, t, d):
    h, low, high = w / 2, -t / 2, t / 2
    if body == "round":
        inner = rectangle(-h + d, h - d, low, high, [2, 2, 2, 2], d)
        return Boundary(rectangle(-h, h, low - d, high + d, [0, 0, 0, 0], d) + reversed_sides(inner))
    above = rectangle(-h, h, high, high + d, [2, 0, 0, 0], d)
    below = rectangle(-h, h, low - d, low, [0, 0, 2, 0], d)
    metal = rectangle(-h, h, low, high, [3, 3, None, 3] if body == "one" else [None, 3, None, 3], d)
    return Boundary(above + metal + (below if body == "two" else []))


def scattered(boundary, permittivity, permeability, pairs):
    """Tags: 0 outer face of the coat, 2 metal under it, 3 bare metal. Pairs of angles, of source and observer."""
    k2 = k0 * np.sqrt(complex(permittivity * permeability))
    k2 = -k2 if k2.imag > 0 else k2
    (s1, d1), (s2, d2) = boundary.layers(k0), boundary.layers(k2)
    half = 0.5 * np.eye(len(boundary.z))
    face, under, bare = (np.nonzero(boundary.tag == i)[0] for i in (0, 2, 3))
    outer, inner, nf, nu, nb = np.r_[face, bare], np.r_[face, under], len(face), len(under), len(bare)
    sources = np.unique([pair[0] for pair in pairs])
    for polarisation, ratio in (("tm", permeability), ("te", permittivity)):
        tm = polarisation == "tm"
        a = np.zeros((2 * nf + nu + nb,) * 2, complex)  # u, v on the face; bare metal; metal under the coat
        top, low = slice(0, nf + nb), slice(nf + nb, None)
        a[top, :nf], a[top, nf : 2 * nf] = (half - d1)[np.ix_(outer, face)], s1[np.ix_(outer, face)]
        a[low, :nf], a[low, nf : 2 * nf] = (half + d2)[np.ix_(inner, face)], -ratio * s2[np.ix_(inner, face)]
        a[top, 2 * nf : 2 * nf + nb] = (s1 if tm else half - d1)[np.ix_(outer, bare)]
        a[low, 2 * nf + nb :] = (-s2 if tm else half + d2)[np.ix_(inner, under)]
        b = np.zeros((len(a), len(sources)), complex)
        b[top] = np.array([boundary.wave(phi)[0][outer] for phi in sources]).T
        x = np.linalg.solve(a, b)
        for source, observer in pairs:
            of = x[:, np.searchsorted(sources, source)]
            wave, slope = boundary.wave(observer)
            u, v = np.zeros(len(boundary.z), complex), np.zeros(len(boundary.z), complex)
            u[face], v[face] = of[:nf], of[nf : 2 * nf]
            (v if tm else u)[bare] = of[2 * nf : 2 * nf + nb]
            yield polarisation, source, observer, np.sum((u * slope - wave * v) * boundary.weights) / 4j


ABSORBER, AT_TWICE, DIELECTRIC = (16.9 - 0.39j, 2.46 - 1.95j), (16.9 - 0.34j, 1.45 - 1.73j), (4 - 0.1j, 1 + 0j)
PLATES = [("one", 0.03, 0.02, ABSORBER), ("one", 0.05, 0.02, ABSORBER), ("one", 0.08, 0.02, ABSORBER), ("one", 0.05, 0.05, AT_TWICE),
          ("one", 0.05, 0.05, DIELECTRIC), ("two", 0.05, 0.02, ABSORBER), ("two", 0.05, 0.05, DIELECTRIC),
          ("round", 0.05, 0.02, ABSORBER), ("round", 0.03, 0.05, DIELECTRIC)]

if __name__ == "__main__":
    print("body,width,metal,thickness,re_eps,im_eps,re_mu,im_mu,polarisation,source_deg,angle_deg,re_p,im_p")
    above, around = np.arange(5.0, 91.0, 5.0), np.arange(10.0, 360.0, 10.0)
    for body, t, d, (eps, mu) in PLATES:
        same = np.concatenate([above, 360 - above]) if body == "one" else above
        pairs = [(a, a) for a in np.radians(same)] + [(np.radians(40.0), a) for a in np.radians(around)]
        for polarisation, source, observer, p in scattered(plate(body, 3.0, t, d), eps, mu, pairs):
            print(body, 3.0, t, d, eps.real, eps.imag, mu.real, mu.imag, polarisation, "%g" % np.degrees(source),
                  "%g" % np.degrees(observer), "%.6f" % p.real, "%.6f" % p.imag, sep=",")

"""Writes coated_cylinders.csv: monostatic scattering of coated metal cylinders without end, lit across, by boundary integrals.

    /usr/bin/python3 tests/data/coated_cylinders.py > tests/data/coated_cylinders.csv

u is E (tm) or H (te) along the cylinder, lengths in wavelengths, e^{+jwt}; u_s ~ P sqrt(2/(pi k rho)) e^{-j(k rho - pi/4)}, phase
reference in the middle. "strip": metal of width w and no thickness in y = 0, coated on y > 0; "square": a solid one, the coat's
outer side w. Angles from the x axis. Green's equation on the outer side of all that waves meet and on the inner side of the coat,
Nystroem on panels that are graded to the corners, near ones split dyadically; coarser panels change P by less than 1e-4 of its peak.
"""
import numpy as np
from scipy.special import hankel2

k0 = 2 * np.pi


def kernels(k, r, normal):
    """Single layer, and double layer of a source with this normal."""
    distance = abs(r)
    return hankel2(0, k * distance) / 4j, k * hankel2(1, k * distance) / 4j * (r * np.conj(normal)).real / distance


def graded(length, widest, first=0.1, levels=4):
    """Breaks of a side, from short panels at its ends to long ones."""
    left = [0.0] + [first * 2.0**-i for i in range(levels, -1, -1) if first * 2.0**-i < 0.4995 * length]
    while left[-1] < length / 2 - 1e-12:
        step = min(widest, left[-1])
        left.append(length / 2 if left[-1] + 1.4 * step >= length / 2 else left[-1] + step)
    return np.concatenate([left, (length - np.array(left))[::-1][1:]]) / length


class Boundary:
    """Sides (from, to, breaks, tag), normals to their right."""

    def __init__(self, sides, points=8):
        self.points = points
        self.x, weights = np.polynomial.legendre.leggauss(points)
        panels = [(a + (b - a) * s, a + (b - a) * t, tag) for a, b, breaks, tag in sides for s, t in zip(breaks[:-1], breaks[1:])]
        self.a, self.b = (np.array([p[i] for p in panels]) for i in (0, 1))
        self.length = abs(self.b - self.a)
        self.along = (self.b - self.a) / self.length
        self.z = (self.a[:, None] + (self.b - self.a)[:, None] * (self.x + 1) / 2).ravel()
        self.weights = (self.length[:, None] / 2 * weights).ravel()
        self.normal = np.repeat(-1j * self.along, points)
        self.tag = np.repeat([p[2] for p in panels], points)
        self.lagrange = np.linalg.inv(np.polynomial.legendre.legvander(self.x, points - 1))

    def layers(self, k):
        r = self.z[:, None] - self.z[None]
        np.fill_diagonal(r, 1.0)
        single, double = (m * self.weights for m in kernels(k, r, self.normal[None]))
        local = (self.z[:, None] - ((self.a + self.b) / 2)[None]) * np.conj(self.along)[None]
        beside = np.hypot(np.maximum(abs(local.real) - self.length / 2, 0), local.imag) < 1.2 * self.length
        for target, panel in zip(*np.nonzero(beside)):
            columns = slice(panel * self.points, (panel + 1) * self.points)
            single[target, columns], double[target, columns] = self.near(k, local[target, panel], panel)
        return single, double

    def near(self, k, at, panel):
        half = self.length[panel] / 2
        on_it = abs(at.imag) < 1e-13
        x, w = np.polynomial.legendre.leggauss(8)
        edges = np.concatenate([[0], 2.0 ** -np.arange(18, -1, -1)])
        s = (edges[:-1, None] + np.diff(edges)[:, None] * (x + 1) / 2).ravel()
        w = (np.diff(edges)[:, None] / 2 * w).ravel()
        foot = np.clip(at.real / half, -1, 1)
        t = np.concatenate([foot - (foot + 1) * s, foot + (1 - foot) * s])
        weights = np.concatenate([(foot + 1) * w, (1 - foot) * w]) * half
        offset = np.concatenate([(foot + 1) * s, -(1 - foot) * s]) * half + (at.real - foot * half)
        r = np.where(abs(offset + 1j * at.imag) < 1e-12, 1e-12, offset + 1j * (0.0 if on_it else at.imag)) * self.along[panel]
        single, double = kernels(k, r, -1j * self.along[panel])
        basis = np.polynomial.legendre.legvander(t, self.points - 1) @ self.lagrange
        return (single * weights) @ basis, (0 * basis[0] if on_it else (double * weights) @ basis)

    def wave(self, phi):
        towards = np.exp(1j * phi)
        u = np.exp(1j * k0 * (self.z * np.conj(towards)).real)
        return u, 1j * k0 * (self.normal * np.conj(towards)).real * u


def scattered(boundary, permittivity, permeability, angles):
    """Tags: 0 outer face of the coat, 1 metal that both sides meet, 2 metal under the coat only."""
    k2 = k0 * np.sqrt(complex(permittivity * permeability))
    k2 = -k2 if k2.imag > 0 else k2
    (s1, d1), (s2, d2) = boundary.layers(k0), boundary.layers(k2)
    half = 0.5 * np.eye(len(boundary.z))
    face, both, inner = (np.nonzero(boundary.tag == i)[0] for i in (0, 1, 2))
    outer, metal = np.concatenate([face, both]), np.concatenate([both, inner])
    nf, nb, no, n = len(face), len(both), len(outer), len(boundary.z)
    waves = [boundary.wave(phi) for phi in angles]
    for polarisation, ratio in (("tm", permeability), ("te", permittivity)):
        a = np.zeros((no + n, 2 * nf + nb + len(metal)), complex)  # u, v on the face; metal outside, inside
        a[:no, :nf], a[:no, nf : 2 * nf] = (half - d1)[np.ix_(outer, face)], s1[np.ix_(outer, face)]
        a[no:, :nf], a[no:, nf : 2 * nf] = (half + d2)[:, face], -ratio * s2[:, face]
        a[:no, 2 * nf : 2 * nf + nb] = (s1 if polarisation == "tm" else half - d1)[np.ix_(outer, both)]
        a[no:, 2 * nf + nb :] = (-s2 if polarisation == "tm" else half + d2)[:, metal]
        b = np.concatenate([np.array([u[outer] for u, _ in waves]).T, np.zeros((n, len(waves)))])
        x = np.linalg.solve(a, b)
        u, v = np.zeros((n, len(waves)), complex), np.zeros((n, len(waves)), complex)
        u[face], v[face] = x[:nf], x[nf : 2 * nf]
        (v if polarisation == "tm" else u)[both] = x[2 * nf : 2 * nf + nb]
        for i, (phi, (wave, slope)) in enumerate(zip(angles, waves)):
            yield polarisation, phi, np.sum((u[:, i] * slope - wave * v[:, i]) * boundary.weights) / 4j


def strip(w, d, widest=0.2):
    h, along, up = w / 2, graded(w, widest, d), graded(d, widest, d / 4, 2)
    return Boundary([(-h + 0j, h + 0j, along, 1), (h + 0j, h + 1j * d, up, 0), (h + 1j * d, -h + 1j * d, along, 0), (-h + 1j * d, -h + 0j, up, 0)])


def square(w, d, widest=0.2):
    corners = [-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j]
    outer, inner = [c * w / 2 for c in corners], [c * (w / 2 - d) for c in reversed(corners)]
    sides = [(outer[i], outer[(i + 1) % 4], graded(w, widest), 0) for i in range(4)]
    return Boundary(sides + [(inner[i], inner[(i + 1) % 4], graded(w - 2 * d, widest), 2) for i in range(4)])


if __name__ == "__main__":
    print("body,width,thickness,re_eps,im_eps,re_mu,im_mu,polarisation,angle_deg,re_p,im_p")
    above = np.arange(5.0, 91.0, 2.5)
    absorber, dielectric = (16.9 - 0.39j, 2.46 - 1.95j), (4 - 0.1j, 1 + 0j)
    for body, w, d, (eps, mu) in (("strip", 3.0, 0.02, absorber), ("strip", 3.0, 0.05, dielectric), ("square", 2.0, 0.02, absorber)):
        angles = np.concatenate([above, 360 - above]) if body == "strip" else above
        boundary = {"strip": strip, "square": square}[body](w, d)
        for polarisation, phi, p in scattered(boundary, eps, mu, np.radians(angles)):
            print(body, w, d, eps.real, eps.imag, mu.real, mu.imag, polarisation, "%g" % np.degrees(phi), "%.6f" % p.real, "%.6f" % p.imag, sep=",")

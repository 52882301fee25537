#!/usr/bin/env python3
"""Makes spheroids.csv and oblate_spheroids.csv, scattering amplitudes of perfectly conducting spheroids, with numpy:

    python3 tests/data/spheroids.py > tests/data/spheroids.csv                   # half a minute
    python3 tests/data/spheroids.py oblate > tests/data/oblate_spheroids.csv     # half a minute
    python3 tests/data/spheroids.py check                                        # the figures below

Method of auxiliary sources: the scattered field is that of Huygens sources (an electric and a magnetic dipole each) on a confocal
spheroid inside, where it is analytic down to the foci; they are chosen such that the tangential E vanishes at twice as many points of
the surface (least squares). Points and sources lie on rings at equal angles, so that azimuthal modes separate; the rings at the rim
of an oblate one are near the surface, and want the finer angles.
Convergence is exponential, no integral is singular, and combined sources have no spurious resonances.

Conventions: e^{+jwt}, wavelength 1, axis z, looks at theta from the axis, phi 0, v = theta, h = phi directions, phase reference at the centre,
E^s = S E^i e^{-jkr}/r.

Checked: spheres of ka 5, 10, 20 and 40 against Mie's series: 3e-12, 5e-12, 2e-9 and 2e-3 dB. Other sources, more of them and more
modes change the prolate spheroids by 4e-5 dB at most; the tangential E left over is at most 6e-5 of the incident one (rms).
"""
import sys
import numpy as np

K = 2 * np.pi


def rings(a, b, count):
    """Points (rho, z), unit tangents and outward normals of the meridian of a spheroid of half axes a (z) and b."""
    v = (np.arange(count) + 0.5) * np.pi / count
    point = np.stack([b * np.sin(v), a * np.cos(v)], -1)
    tangent = np.stack([b * np.cos(v), -a * np.sin(v)], -1)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    return point, tangent, np.stack([-tangent[:, 1], tangent[:, 0]], -1)


def in_space(rz, angle):
    """Vectors (rho, z) turned to all azimuths: (vector, angle, 3)."""
    rho, z = rz.T[:, :, None]
    return np.stack(np.broadcast_arrays(rho * np.cos(angle), rho * np.sin(angle), z), -1)


def field(r, p, m):
    """E of an electric and a magnetic dipole, less k^2/4 pi."""
    distance = np.linalg.norm(r, axis=-1)[..., None]
    n, x = r / distance, K * distance
    radial = n * (n * p).sum(-1)[..., None]
    e = p * (1 - 1j / x - 1 / x**2) - radial * (1 - 3j / x - 3 / x**2) - (1 - 1j / x) * np.cross(n, m)
    return e * np.exp(-1j * x) / distance


def axes(t):
    """The direction at theta = t, v and h."""
    return np.array([np.sin(t), 0, np.cos(t)]), np.array([np.cos(t), 0, -np.sin(t)]), np.array([0, 1.0, 0])


class Spheroid:
    """Half axes a (along z) and b; beta: minor axis of the spheroid of sources, in those of the body."""

    def __init__(self, a, b, beta=0.5, extra=40):
        self.modes, sources = int(K * b) + 12 + extra // 5, int(1.2 * K * max(a, b)) + extra
        major = np.sqrt(abs(a**2 - b**2) + (beta * min(a, b)) ** 2)
        source_a, source_b = (major, beta * b) if a >= b else (beta * a, major)
        slots = max(2 * self.modes + 2, int(14 * b / (b - source_b)))  # e^-14 of the field between rings' sources is left
        angle = 2 * np.pi * np.arange(slots) / slots
        phi = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], -1)
        meridian = rings(a, b, 2 * sources)[:2]
        self.points, along = (in_space(v, angle) for v in meridian)
        self.tangents = np.stack([along, np.broadcast_to(phi, along.shape)])
        inner = rings(source_a, source_b, sources)
        self.positions, along, normals = (in_space(v, angle) for v in inner)
        self.electric = np.stack([along, np.broadcast_to(phi, along.shape)])
        self.magnetic = np.cross(normals, self.electric)
        # Field on the first meridian of sources all round: the sum with e^{jm angle} is that of the mode m.
        blocks = np.empty((self.modes + 1, 2, 2 * sources, 2, sources), complex)
        for q in range(2 * sources):
            e = field(self.points[q, 0] - self.positions, self.electric, self.magnetic)
            for c in range(2):
                blocks[:, c, q] = np.moveaxis(self.in_modes(e @ self.tangents[c, q, 0]), -1, 0)
        self.matrices = blocks.reshape(self.modes + 1, 4 * sources, 2 * sources)

    def in_modes(self, values):
        """Sums over the angles with e^{jm angle}."""
        return values.shape[-1] * np.fft.ifft(values)[..., : self.modes + 1]

    def amplitudes(self, thetas, receive=None):
        """S_vv and S_hh at the angles, and the largest rms of the tangential E that is left on the surface."""
        waves, weights = [], []
        for t, u in zip(thetas, thetas if receive is None else receive):
            (s, *es), (r, *er) = axes(t), axes(u)
            for e, f in zip(es, er):
                incident = (self.tangents @ e) * np.exp(1j * K * (self.points @ s))
                waves.append(self.in_modes(incident.conj()).conj().reshape(-1, self.modes + 1) / incident.shape[-1])
                far = (self.electric @ f - self.magnetic @ np.cross(f, r)) * np.exp(1j * K * (self.positions @ r))
                weights.append(self.in_modes(far).reshape(-1, self.modes + 1))
        return self.solve(np.stack(waves, -1), np.stack(weights, -1))

    def solve(self, waves, weights):
        """S of pairs of incident waves and of weights of the sources, and the largest rms of the boundary condition that is left."""
        result, left = 0.0, 0.0
        for mode, matrix in enumerate(self.matrices):
            both = 1 if mode == 0 else 2  # m and -m give the same
            scale = np.linalg.norm(matrix, axis=0)[:, None]
            found = np.linalg.lstsq(matrix / scale.T, -waves[:, mode], rcond=1e-13)[0] / scale
            result = result + both * (weights[:, mode] * found).sum(0)
            left = left + both * (np.abs(matrix @ found + waves[:, mode]) ** 2).mean(0)
        return result.reshape(-1, 2), np.sqrt(left.max())


def mie(x):
    """|S| k of a sphere of ka = x, backwards."""
    top = int(x + 8 * x ** (1 / 3) + 10)
    n = np.arange(1, top + 1)
    j = np.zeros(top + 30)  # Riccati-Bessel functions: psi downwards, chi upwards
    j[-2] = 1e-200
    for i in range(len(j) - 2, 0, -1):
        j[i - 1] = (2 * i + 1) / x * j[i] - j[i + 1]
    j *= np.sin(x) / j[0] if abs(np.sin(x)) > 0.5 else (np.sin(x) / x - np.cos(x)) / j[1]
    y = [-np.cos(x), -np.cos(x) / x - np.sin(x)]
    for i in range(1, top):
        y.append((2 * i + 1) / x * y[i] - y[i - 1])
    psi, xi = j[: top + 1], j[: top + 1] - 1j * np.array(y)
    dpsi, dxi = (f[:-1] - n / x * f[1:] for f in (psi, xi))
    return abs(((-1.0) ** n * (2 * n + 1) * (dpsi / dxi - psi[1:] / xi[1:])).sum()) / 2


def db(found, expected):
    return np.abs(20 * np.log10(np.abs(found / expected))).max()


def check():
    for x in (5, 10, 20, 40):
        found, left = Spheroid(x / K, x / K).amplitudes(np.radians([0, 37, 90]))
        print(f"sphere, ka {x}: {db(K * found, mie(x)):.1e} dB from Mie's series; {left:.1e} of E left")
    for ratio, ka in BODIES:
        a = ka / K
        coarse, left = Spheroid(a, a / ratio).amplitudes(LOOKS)
        fine, less = Spheroid(a, a / ratio, 0.6, 70).amplitudes(LOOKS)
        print(f"{ratio}:1, ka {ka}: {db(coarse, fine):.1e} dB from finer; {left:.1e}, {less:.1e} of E left")
    for ratio, ka in OBLATE:
        a, looks = ka / K, np.radians(PAIRS).T
        coarse, left = Spheroid(a / ratio, a, extra=80).amplitudes(*looks)
        fine, less = Spheroid(a / ratio, a, 0.6, 100).amplitudes(*looks)
        print(f"1:{ratio}, ka {ka}: {db(coarse, fine):.1e} dB from finer; {left:.1e}, {less:.1e} of E left")


def write_oblate():
    print("# made by spheroids.py oblate; wavelength 1, ka: half major axis; antennas at phi 0")
    print("ratio,ka,theta_deg,rx_theta_deg,re_vv,im_vv,re_hh,im_hh")
    for ratio, ka in OBLATE:
        found = Spheroid(ka / K / ratio, ka / K, extra=80).amplitudes(*np.radians(PAIRS).T)[0]
        for (t, u), s in zip(PAIRS, found):
            print(f"{ratio},{ka},{t},{u}," + ",".join(f"{v:.7g}" for p in s for v in (p.real, p.imag)))


BODIES = [(ratio, ka) for ratio in (2, 4) for ka in (10, 20, 40)]
LOOKS = np.radians(np.arange(0, 91, 5))
OBLATE = ((3, 16), (6, 32))  # k rho 1.78 and 0.89 at the rim
PAIRS = [(t, t) for t in range(0, 91, 10)] + [(t, u) for t in (40, 90) for u in range(0, 181, 12)]

if __name__ == "__main__":
    if sys.argv[1:] == ["check"]:
        check()
        sys.exit()
    if sys.argv[1:] == ["oblate"]:
        write_oblate()
        sys.exit()
    print("# made by spheroids.py; wavelength 1, ka: half major axis")
    print("ratio,ka,theta_deg,re_vv,im_vv,re_hh,im_hh")
    for ratio, ka in BODIES:
        for theta, s in zip(LOOKS, Spheroid(ka / K, ka / K / ratio).amplitudes(LOOKS)[0]):
            print(f"{ratio},{ka},{np.degrees(theta):.0f}," + ",".join(f"{v:.7g}" for p in s for v in (p.real, p.imag)))

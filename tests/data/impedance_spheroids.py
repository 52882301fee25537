#!/usr/bin/env python3
"""Makes impedance_spheroids.csv, scattering amplitudes of prolate spheroids with an impedance, with numpy:

    python3 tests/data/impedance_spheroids.py > tests/data/impedance_spheroids.csv
    python3 tests/data/impedance_spheroids.py check                                  # the figures below

The method, the sources and the conventions of spheroids.py, with E - Z n x eta H in the place of E along the surface.
Beside monostatic looks those with the receiver 120 degrees on.

Checked: spheres of ka 5, 10 and 20 against their series, 3e-9 dB; the spheroids beside other sources and more of them, 6e-6 dB.
"""
import sys
import numpy as np
from spheroids import K, Spheroid, db, field, in_space, rings


class ImpedanceSpheroid(Spheroid):
    """Z over eta."""

    def __init__(self, a, b, impedance, beta=0.5, extra=40):
        super().__init__(a, b, beta, extra)
        sources = self.matrices.shape[2] // 2
        normals = in_space(rings(a, b, 2 * sources)[2], 2 * np.pi * np.arange(self.points.shape[1]) / self.points.shape[1])
        self.turned = impedance * np.cross(self.tangents, normals)  # u . n x H = H . (u x n)
        blocks = np.empty((self.modes + 1, 2, 2 * sources, 2, sources), complex)
        for q in range(2 * sources):
            h = field(self.points[q, 0] - self.positions, self.magnetic, -self.electric)
            for c in range(2):
                blocks[:, c, q] = np.moveaxis(self.in_modes(h @ self.turned[c, q, 0]), -1, 0)
        self.matrices = self.matrices - blocks.reshape(self.matrices.shape)

    def amplitudes(self, looks):
        """S_vv and S_hh of (incident theta, received theta), and the largest rms of the condition that is left on the surface."""
        waves, weights = [], []
        for t, r in looks:
            s, s_received = (np.array([np.sin(x), 0, np.cos(x)]) for x in (t, r))
            for e, p in ((np.array([np.cos(t), 0, -np.sin(t)]), np.array([np.cos(r), 0, -np.sin(r)])), (np.array([0, 1.0, 0]),) * 2):
                condition = (self.tangents @ e - self.turned @ np.cross(e, s)) * np.exp(1j * K * (self.points @ s))
                waves.append(self.in_modes(condition.conj()).conj().reshape(-1, self.modes + 1) / condition.shape[-1])
                far = (self.electric @ p - self.magnetic @ np.cross(p, s_received)) * np.exp(1j * K * (self.positions @ s_received))
                weights.append(self.in_modes(far).reshape(-1, self.modes + 1))
        return self.solve(np.stack(waves, -1), np.stack(weights, -1))


def series(x, impedance):
    """S k of a sphere of ka = x, backwards."""
    from scipy.special import spherical_jn, spherical_yn
    n = np.arange(1, int(x + 8 * x ** (1 / 3) + 10))
    j, y = spherical_jn(n, x), spherical_yn(n, x)
    psi, xi = x * j, x * (j - 1j * y)
    psi_slope, xi_slope = j + x * spherical_jn(n, x, True), j - 1j * y + x * (spherical_jn(n, x, True) - 1j * spherical_yn(n, x, True))
    a, b = ((psi_slope - load * psi) / (xi_slope - load * xi) for load in (1j * impedance, 1j / impedance))
    return abs(((-1.0) ** n * (2 * n + 1) * (a - b)).sum()) / 2


IMPEDANCES = (0.42 - 0.27j, 0.2 + 0.3j)
BODIES = [(2, 10), (2, 20), (2, 40), (4, 20), (4, 40)]
LOOKS = np.radians([(t, t) for t in range(0, 91, 5)] + [(t, t + 120) for t in range(0, 91, 5)])


def check():
    for impedance in IMPEDANCES:
        for x in (5, 10, 20):
            found, left = ImpedanceSpheroid(x / K, x / K, impedance).amplitudes(np.radians([(0, 0), (37, 37), (90, 90)]))
            print(f"sphere, ka {x}, Z {impedance}: {db(K * found, series(x, impedance)):.1e} dB from the series; {left:.1e} left")
        for ratio, ka in BODIES:
            a = ka / K
            coarse, left = ImpedanceSpheroid(a, a / ratio, impedance).amplitudes(LOOKS)
            fine, less = ImpedanceSpheroid(a, a / ratio, impedance, 0.6, 70).amplitudes(LOOKS)
            print(f"{ratio}:1, ka {ka}, Z {impedance}: {db(coarse, fine):.1e} dB from finer; {left:.1e}, {less:.1e} left", flush=True)


if __name__ == "__main__":
    if sys.argv[1:] == ["check"]:
        check()
        sys.exit()
    print("# made by impedance_spheroids.py; wavelength 1, ka: half major axis; Z over eta; from theta_deg to rx_theta_deg, both at phi 0")
    print("re_z,im_z,ratio,ka,theta_deg,rx_theta_deg,re_vv,im_vv,re_hh,im_hh")
    for z in IMPEDANCES:
        for ratio, ka in BODIES:
            for look, s in zip(np.degrees(LOOKS), ImpedanceSpheroid(ka / K, ka / K / ratio, z).amplitudes(LOOKS)[0]):
                print(f"{z.real},{z.imag},{ratio},{ka},{look[0]:.0f},{look[1]:.0f}," + ",".join(f"{v:.7g}" for p in s for v in (p.real, p.imag)))

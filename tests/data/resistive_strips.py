"""Writes resistive_strips.csv: monostatic scattering of resistive strips without end and without thickness, lit across.

    /usr/bin/python3 tests/data/resistive_strips.py > tests/data/resistive_strips.csv

E along the strip = R J, R over the impedance of vacuum; u is E (tm) or H (te) along the strip, lengths in wavelengths, e^{+jwt};
u_s ~ P sqrt(2/(pi k rho)) e^{-j(k rho - pi/4)}, phase reference in the middle, angles from the strip. E along it: an equation of the
second kind on panels graded to the edges (slab_strips.py). H along it: a spectral Galerkin method with the resistance as a mass term.
Both agree with finer ones to 1e-9 of the peak.
"""
import numpy as np
from scipy.special import hankel2, j0

from slab_strips import Boundary, graded, k0

width = 3.0


def along(resistance, angles):
    strip = Boundary([(-width / 2 + 0j, width / 2 + 0j, graded(width, 0.1, 0.15, 10), 0)], 12)
    single = strip.ops([k0])[0][0][0]
    x = strip.z.real
    waves = np.array([np.exp(1j * k0 * x * np.cos(a)) for a in angles])
    current = np.linalg.solve(resistance * np.eye(strip.N) + 1j * k0 * single, waves.T)
    return np.array([-0.25 * k0 * np.sum(current[:, i] * strip.W * waves[i]) for i in range(len(angles))])


def cosine_matrix(ka, count):
    """<cos m th, H0(ka |cos th - cos th'|) cos n th'>, its logarithm apart."""
    theta = (np.arange(count) + 0.5) * np.pi / count
    c, order = np.cos(theta), np.arange(1, count)
    cosines = np.cos(np.outer(theta, order))
    logarithm = (np.pi / count) * (-np.log(2) - (cosines * (2 / order)) @ cosines.T)
    r = np.abs(c[:, None] - c[None])
    filled = ka * r
    np.fill_diagonal(filled, 1.0)
    bessel = j0(ka * r)
    smooth = hankel2(0, filled) + 2j / np.pi * bessel * np.log(np.where(r > 0, r, 1))
    np.fill_diagonal(smooth, 1 - 2j / np.pi * (np.log(ka / 2) + np.euler_gamma))
    operator = (-2j / np.pi) * bessel * logarithm + smooth * np.pi / count
    tests = np.cos(np.outer(np.arange(count - 4), theta))
    return (tests * (np.pi / count)) @ operator @ tests.T, theta


def across(resistance, angles):
    ka = np.pi * width
    count = int(260 + 3 * ka)
    matrix, theta = cosine_matrix(ka, count)
    n = np.arange(1, len(matrix) - 2)
    product, slope = np.zeros((len(n), len(matrix))), np.zeros((len(n), len(matrix)))
    for i, order in enumerate(n):
        product[i, order - 1] += 0.5
        product[i, order + 1] -= 0.5
        slope[i, order] = order
    impedance = ka**2 * (product @ matrix @ product.T) - slope @ matrix @ slope.T

    def integral(q):
        return np.where(q % 2 == 0, 2.0 / (1.0 - np.where(q % 2 == 0, q, 0).astype(float) ** 2), 0.0)

    mass = 0.5 * (integral(abs(n[:, None] - n)) - integral(n[:, None] + n))
    weights = np.sin(np.outer(n, theta)) * np.sin(theta) * (np.pi / count)
    waves = np.array([weights @ np.exp(1j * ka * np.cos(theta) * np.cos(a)) for a in angles])
    current = np.linalg.solve(impedance / (4 * ka) + resistance * mass, (np.sin(angles)[:, None] * waves).T)
    return np.array([0.25 * np.sin(a) * ka * (current[:, i] @ waves[i]) for i, a in enumerate(angles)])


steep = np.radians(np.arange(5, 91, 1.0))
print("resistance,field,angle_deg,re_p,im_p")
for field, solve in (("tm", along), ("te", across)):
    for resistance in (0.01, 0.1, 1.0, 10.0):
        for angle, p in zip(steep, solve(resistance, steep)):
            print(f"{resistance:g},{field},{np.degrees(angle):g},{p.real:.9g},{p.imag:.9g}")

#!/usr/bin/env python3
"""Writes tip_table.h: what the tip of a conducting circular cone sends back to a radar behind it, E in the plane of its axis.

    S = (2 pi / jk) sum e^{j pi (nu - 1/2)} / (nu^2 - 1/4) { grad D(w) grad D(w) - [w x grad N](w) [w x grad N](w) }

over the modes D and N of the sphere outside the cone (Smyshlyaev, SIAM J. Appl. Math. 53, 670, 1993; docs/theory/corners.md): for each order m
of cos m phi, polynomials in theta that minimise Rayleigh's quotient. The factor e^{-(nu/X)^2} sums the series, X = 12; 8 changes what
is written by about 3 % up to 75 degrees from behind. The physical optics of the tip is not taken off: it is below .025/k up to 57 degrees and
.08/k at 75.

Needs numpy and scipy.    tip_table.py | clang-format > tip_table.h
"""
import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh, null_space

DEGREE, X = 110, 12


def basis(x, end):
    slopes = [legendre.legval(x, legendre.legder(row)) for row in np.eye(DEGREE + 1)]
    return legendre.legvander(x, DEGREE), np.stack(slopes, -1) * 2 / end


def modes(end, m, dirichlet):
    """nu and the coefficients of normalised modes on 0 <= theta <= end."""
    x, w = legendre.leggauss(2 * DEGREE)
    theta, w = end * (x + 1) / 2, w * end / 2
    roots = ([legendre.legvander([-1.0], DEGREE)[0]] if m else []) + ([legendre.legvander([1.0], DEGREE)[0]] if dirichlet else [])
    free = null_space(np.array(roots)) if roots else np.eye(DEGREE + 1)
    value, slope = (v @ free for v in basis(x, end))
    sine = np.sin(theta)
    quotient = (slope.T * (w * sine)) @ slope + m * m * (value.T * (w / sine)) @ value
    found, vectors = eigh(quotient, (value.T * (w * sine)) @ value)
    return np.sqrt(np.maximum(found + 0.25, 0)), free @ vectors


def amplitudes(half_angle, theta):
    """k S, E in the plane of the axis and across it, of looks at theta from the tip's outward axis."""
    end, sums = np.pi - half_angle, np.zeros((2, len(theta)), complex)
    values, slopes = basis(2 * theta / end - 1, end)
    for m in range(3 * X + 1):
        for dirichlet in (True, False):
            nu, vectors = modes(end, m, dirichlet)
            kept = (nu < 3.2 * X) & (nu > 0.51)
            h = np.exp(1j * np.pi * (nu - 0.5) - (nu / X) ** 2)[kept] / (nu[kept] ** 2 - 0.25) / (np.pi * (1 if m else 2))
            along, round_ = slopes @ vectors[:, kept], values @ vectors[:, kept] * (m / np.sin(theta))[:, None]
            sums += [along**2 @ h, round_**2 @ h] if dirichlet else [-(round_**2) @ h, -(along**2) @ h]
    return 2 * np.pi / 1j * sums


if __name__ == "__main__":
    angles, beyond = np.arange(5, 61, 5), (0, 5, 10, 15, 20, 30, 40, 60)
    print("// Made by tip_table.py, which says how.\n#pragma once\n\n#include <array>\n\n#include \"core/field.h\"\n\nnamespace raytube::tip_table {\n")
    print("inline constexpr double first_angle = 5.0, angle_step = 5.0;  // half angles of cones [deg]")
    print("// Of the look from behind, to where it grazes the cone [deg].")
    print(f"inline constexpr std::array<double, {len(beyond)}> beyond{{{', '.join(map(str, beyond))}}};")
    print("// k S tan(theta / 2), theta the angle of the look to the axis behind the tip, not above 90 degrees.")
    print(f"inline constexpr std::array<std::array<Complex, {len(beyond)}>, {len(angles)}> amplitudes{{{{")
    for angle in angles:
        behind = np.radians(np.clip(angle + np.array(beyond), angle + 0.1, 90))
        found = amplitudes(np.radians(angle), np.pi - behind)[0] * np.tan(behind / 2)
        print("{{" + ", ".join(f"{{{z.real:.3f}, {z.imag:.3f}}}" for z in found) + "}},")
    print("}};\n\n}  // namespace raytube::tip_table")

#!/usr/bin/env python3
"""Writes fock_contours.h: points of the contours on which impedance_fock.h integrates, and says how good they are.

The contours run as hyperbolas from infinity e^{j BACK} to infinity e^{j FORTH} past AT, in steps of the trapezoidal rule, which converges
exponentially on analytic integrands that end in themselves (Trefethen & Weideman 2014, SIAM Rev. 56, 385). On the way out they keep above
the real axis, below which the poles of waves that a coat guides lie. The errors are those beside straight contours with 3000 points and more,
of all of q below, xi from 0 to 10 in the dark and from -5 to 0 in the light, times 1 + |q|.
Needs numpy and scipy.    fock_contours.py | clang-format > fock_contours.h
"""
import numpy as np
from scipy.special import airy

TURN = np.exp(-2j * np.pi / 3)
DARK = dict(back=-120, forth=0, at=0.5 + 0.6j, step=0.25, first=-8, last=8)
LIT = dict(back=-155, forth=15, at=1j, step=0.7, first=-36, last=6)
Q = [0, .1j, .3 + .5j, 1j, 2 + 2j, 5j, -.5 + .1j, -1 + .1j, -1 + .5j, -2 + .3j, 10 + 3j, 5 + 30j, -.3, -1, 2, -10 + 10j]


def with_airy(tau, weight):
    value, slope, _, _ = airy(tau * TURN)
    return tau, weight * np.exp(1j * np.pi / 6) / (2 * np.pi), value, slope * TURN


def hyperbola(back, forth, at, step, first, last):
    end, begin = np.exp(1j * np.radians(forth)), np.exp(1j * np.radians(back))
    u = step * np.arange(np.floor(first / step), np.ceil(last / step) + 1)
    root = np.sqrt(u * u + 1)
    return with_airy(at + (end + begin) / 2 * root + (end - begin) / 2 * u, step * ((end + begin) / 2 * u / root + (end - begin) / 2))


def straight(back, forth):
    x, w = np.polynomial.legendre.leggauss(20)
    ends = np.linspace(0, 45, 151)
    r = ((ends[1:] + ends[:-1])[:, None] / 2 + np.diff(ends)[:, None] / 2 * x).ravel()
    w = (np.diff(ends)[:, None] / 2 * w).ravel()
    way = np.exp(1j * np.radians([forth, back]))
    return with_airy(np.r_[r * way[0], r * way[1]], np.r_[w * way[0], -w * way[1]])


def integral(points, xi, q):
    tau, weight, value, slope = points
    with np.errstate(all="ignore"):
        terms = weight * np.exp(-1j * xi * tau) / (slope + q * value)
    return np.sum(terms[np.isfinite(terms)])


def error(points, reference, xis):
    return max(abs(integral(points, xi, q) - integral(reference, xi, q)) * (1 + abs(q)) for q in Q for xi in xis)


def main():
    print("// Points of contours, with their weights, W and W' of impedance_fock.h. Written by fock_contours.py, which says how.\n#pragma once\n")
    print('#include <array>\n\n#include "core/field.h"\n\nnamespace raytube::fock_contours {\n')
    print("struct Point {\nComplex tau, weight, value, slope;\n};\n")
    for name, contour, reference, xis in (("dark", DARK, straight(-118, 6), np.linspace(0, 10, 21)), ("lit", LIT, straight(-155, 15), np.linspace(-5, -1e-9, 21))):
        points = hyperbola(**contour)
        print(f"// Error {error(points, reference, xis):.0e}.\ninline constexpr std::array<Point, {len(points[0])}> {name}{{{{")
        for row in zip(*points):
            print("    {" + ", ".join("{%.10g, %.10g}" % (v.real, v.imag) for v in row) + "},")
        print("}};\n")
    print("}  // namespace raytube::fock_contours")


main()

#!/usr/bin/env python3
"""Writes erfc_ray_fit.h: W(x) = e^{z^2} erfc(z), z = e^{j pi/4} x, as a complex polynomial over a real one, 0 <= x < infinity.

Least squares at Chebyshev points of (x - a)/(x + a), which is within a few per cent of the best uniform fit: error below 5e-16 / (1 + x).
The problem is made linear by multiplying with the denominator of the step before (Sanathanan and Koerner 1963, IEEE Trans. AC-8, 56).
Needs mpmath.    erfc_ray_fit.py | clang-format > erfc_ray_fit.h
"""
import mpmath as mp

mp.mp.dps = 100
DEGREE = 17  # of the denominator; the numerator has one less, since W falls off as 1/x
MIDDLE = mp.mpf(5) / 2
POINTS = 6 * DEGREE


def scaled_erfc(x):
    """By mpmath, which the far asymptotic series replaces where e^{z^2} and erfc(z) would cost too many digits."""
    z = mp.expjpi(mp.mpf(1) / 4) * x
    if x < 40:
        return mp.exp(z * z) * mp.erfc(z)
    term = total = 1 / (z * mp.sqrt(mp.pi))
    for m in range(1, 60):
        term *= -(2 * m - 1) / (2 * z * z)
        total += term
    return total


def solve(points, values, weights):
    """P and Q (P(0) = Q(0) = 1: W(0) = 1) that minimise sum |weight (P - W Q)|^2, powers of x/a as unknowns."""
    rows, right = [], []
    for x, value, weight in zip(points, values, weights):
        powers = [weight * (x / MIDDLE) ** m for m in range(1, DEGREE + 1)]
        zero = [mp.mpf(0)] * (DEGREE - 1)
        rows.append(powers[:-1] + zero + [-value.real * p for p in powers])
        rows.append(zero + powers[:-1] + [-value.imag * p for p in powers])
        right += [weight * (value.real - 1), weight * value.imag]
    matrix, right = mp.matrix(rows), mp.matrix(right)
    found = list(mp.lu_solve(matrix.T * matrix, matrix.T * right))
    scaled = lambda first, count: [found[first + m] / MIDDLE ** (m + 1) for m in range(count)]
    n = DEGREE - 1
    return [mp.mpf(1)] + scaled(0, n), [mp.mpf(0)] + scaled(n, n), [mp.mpf(1)] + scaled(2 * n, DEGREE)


def fit():
    cosines = [mp.cos(mp.pi * (i + mp.mpf(1) / 2) / POINTS) for i in range(POINTS)]
    points = [MIDDLE * (1 + s) / (1 - s) for s in cosines]
    values = [scaled_erfc(x) for x in points]
    below = [(1 + x / MIDDLE) ** DEGREE for x in points]
    for _ in range(4):
        real, imaginary, denominator = solve(points, values, [(1 + x) / q for x, q in zip(points, below)])
        below = [mp.polyval(denominator[::-1], x) for x in points]
    return real, imaginary, denominator


def array(name, coefficients):
    lines = ",\n    ".join(repr(float(c)) for c in coefficients)
    return f"inline constexpr std::array<double, {len(coefficients)}> {name} = {{\n    {lines}}};\n"


if __name__ == "__main__":
    parts = zip(("erfc_numerator_re", "erfc_numerator_im", "erfc_denominator"), fit())
    print("// Written by erfc_ray_fit.py: W(x) = numerator / denominator, coefficients of x^0, x^1, ...\n#pragma once\n\n#include <array>\n")
    print("namespace raytube {\n")
    print("\n".join(array(name, coefficients) for name, coefficients in parts))
    print("}  // namespace raytube")

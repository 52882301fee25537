#!/usr/bin/env python3
"""Writes fock_fit.h: Fock's functions G and F (fock.h) as polynomials, and says how good they are.

Reference, to 1e-11: quadrature along the contour of fock.h, its second part turned nearer to the negative axis where xi < 0 (no pole lies
between), and beyond xi = 0.7 one hundred residues; where both converge they agree to 3e-12. Fits interpolate at Chebyshev points, within a
few per cent of the best uniform ones.
Needs numpy and scipy.    fock_fit.py | clang-format > fock_fit.h
"""
import numpy as np
from scipy.special import ai_zeros, airy

DEGREE = 12
DARK_END, LIT_END = 4.0, 3.0  # of |xi|, for the polynomials in xi
FAR_POWERS = 4  # of xi^-3 beyond LIT_END, the first one known
TURN = np.exp(-1j * np.pi / 3)
SOFT_ZEROS, HARD_ZEROS, AI, AI_SLOPE = ai_zeros(100)
GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(20)


def ray(direction, end=45.0, panels=300):
    ends = np.linspace(0.0, end, panels + 1)
    half = 0.5 * np.diff(ends)[:, None]
    points = 0.5 * (ends[1:] + ends[:-1])[:, None] + half * GAUSS
    return points.ravel() * direction, (half * WEIGHTS).ravel() * direction


def by_contour(xi, hard):
    total = 0.0
    back = np.exp(-1j * np.radians(155 if xi < 0 else 120))
    for direction, sign in ((1.0, 1), (back, -1)):
        tau, weights = ray(direction)
        value, slope, _, _ = airy(tau * TURN**2)
        below = slope * TURN**2 if hard else value
        total += sign * np.sum(weights * np.exp(-1j * xi * tau - np.log(below)))
    return total * (np.exp(1j * np.pi / 6) if hard else TURN) / (2 * np.pi)


def modes(xi, hard, first=0, last=100):
    """Of the creeping waves from `first` to before `last`."""
    n = slice(first, last)
    if hard:
        return np.sum(np.exp(1j * xi * HARD_ZEROS[n] * TURN) / (-HARD_ZEROS[n] * AI[n]))
    return np.exp(-1j * np.pi / 6) * np.sum(np.exp(1j * xi * SOFT_ZEROS[n] * TURN) / AI_SLOPE[n])


def dark(xi, hard):
    """Without its first creeping wave's decay."""
    zero = (HARD_ZEROS if hard else SOFT_ZEROS)[0]
    return (by_contour(xi, hard) if xi < 0.7 else modes(xi, hard)) * np.exp(-1j * xi * zero * TURN)


def lit(xi, hard):
    return by_contour(xi, hard) * np.exp(-1j * xi**3 / 3)


def polynomial(function, hard, low, high):
    """Coefficients, highest power first, in the variable that runs from -1 to 1, and the largest error."""
    values = np.vectorize(lambda xi: function(xi, hard), otypes=[complex])
    fit = np.polynomial.Chebyshev.interpolate(values, DEGREE, [low, high])
    at = np.linspace(low, high, 101)
    coefficients = np.polynomial.chebyshev.cheb2poly(fit.coef)[::-1]
    error = np.abs(np.polyval(coefficients, (2 * at - low - high) / (high - low)) - values(at))
    return coefficients, error.max()


def far(hard):
    """Powers of u = (LIT_END / xi)^3 from the second on, highest first: the current over that of physical optics is 1 -+ j / 4 xi^3 + ..."""
    xi = -np.linspace(LIT_END, 5.0, 81)
    u = (LIT_END / xi)**3
    optical = np.array([lit(x, hard) / (2 if hard else -2 * x) for x in xi])
    rest = optical - 1 - (-0.25j if hard else 0.25j) / xi**3
    powers = np.stack([u**n for n in range(FAR_POWERS, 1, -1)], 1)
    fit = np.linalg.lstsq(powers / u[:, None]**2, rest / u**2, rcond=None)[0]
    return fit, np.abs(powers @ fit - rest).max()


def written(name, comment, fit):
    coefficients, error = fit
    pairs = ", ".join("{%.12g, %.12g}" % (c.real, c.imag) for c in coefficients)
    return f"// {comment}; error {error:.0e}.\ninline constexpr std::array<Complex, {len(coefficients)}> {name}{{{{{pairs}}}}};"


def main():
    print("// Fock's functions, fitted. Written by fock_fit.py, which says how; polynomials have their highest power first.\n#pragma once\n")
    print('#include <array>\n\n#include "core/field.h"\n\nnamespace raytube::fock_fit {\n')
    print(f"inline constexpr double dark_end = {DARK_END}, lit_end = {LIT_END};  // of |xi|\n")
    for name, symbol, hard in (("hard", "G", True), ("soft", "F", False)):
        zeros = -(HARD_ZEROS if hard else SOFT_ZEROS)
        second = modes(0.0, hard, 0, 1), modes(0.0, hard, 1, 2)
        print(f"// The first two creeping waves of {symbol}: -zeros of Ai{chr(39) if hard else ''}, amplitudes; beyond dark_end error "
              f"{abs(modes(DARK_END, hard, 2)):.0e}.")
        print(f"inline constexpr std::array<double, 2> {name}_zeros{{{zeros[0]:.12f}, {zeros[1]:.12f}}};")
        print(f"inline constexpr std::array<Complex, 2> {name}_modes{{{{" +
              ", ".join("{%.12g, %.12g}" % (c.real, c.imag) for c in second) + "}};")
        print(written(name + "_dark", f"{symbol} over its first creeping wave, in 2 xi / dark_end - 1", polynomial(dark, hard, 0.0, DARK_END)))
        print(written(name + "_lit", f"{symbol} e^{{-j xi^3/3}}, in 2 xi / lit_end + 1", polynomial(lit, hard, -LIT_END, 0.0)))
        print(written(name + "_far", "Beside 1 -+ j / 4 xi^3 of the current of physical optics: these times u^2, u = (lit_end / xi)^3", far(hard)))
        print()
    print("}  // namespace raytube::fock_fit")


main()

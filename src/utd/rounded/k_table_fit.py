#!/usr/bin/env python3
"""Writes k_table.h: how a rounded wedge answers the modes of the sharp one (rounded_wedge.h), from an exact solution with endless flanks.

Lengths are times k. Flanks phi = 0 and phi = n pi, arc of radius rho tangent to both at r = t. Beyond r = t the field is that of the sharp
wedge and SUM a_m H_nu(r) C(nu phi), nu = m / n; within it Green's identity over the closed curve of the circle r = t and the arc (Nystrom:
Kress 1991, J. Comput. Appl. Math. 61, 345, graded towards the corners), solved by least squares for the current on the arc and a = T c. With
m = 0 normalised T = -jK / (1 + jK), K real and symmetric: no power is lost.
Needs numpy and scipy.    k_table_fit.py | clang-format > k_table.h
"""
import numpy as np
import scipy.linalg
from scipy.special import h2vp, hankel1, hankel2, j0, j1, jv, jvp

pi = np.pi
ANGLES = (10, 20, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165)
DISTANCES = (0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.4, 2.0, 3.0)
PAIRS = ((0, 0), (0, 2), (0, 4), (2, 2), (2, 4), (4, 4), (1, 1), (1, 3), (1, 5), (3, 3), (3, 5), (5, 5))


def unit(angle):
    return np.stack([np.cos(angle), np.sin(angle)], -1)


def graded(t, p=6):
    """Kress's substitution on 0..1 and its derivative."""
    s = 2 * pi * t

    def v(s):
        return (1 / p - 0.5) * ((pi - s) / pi) ** 3 + (s - pi) / (p * pi) + 0.5

    def slope(s):
        return -3 * (1 / p - 0.5) * ((pi - s) / pi) ** 2 / pi + 1 / (p * pi)

    a, b = v(s) ** p, v(2 * pi - s) ** p
    da, db = p * v(s) ** (p - 1) * slope(s), -p * v(2 * pi - s) ** (p - 1) * slope(2 * pi - s)
    return a / (a + b), 2 * pi * (da * b - a * db) / (a + b) ** 2


def curve(arcs, count):
    """Points, derivatives and curvature on arcs (centre, radius, from, to), count points in all."""
    t = (np.arange(count) + 0.5) / count
    points, slopes, curvature = np.zeros((count, 2)), np.zeros((count, 2)), np.zeros(count)
    for i, (centre, radius, start, end) in enumerate(arcs):
        here = (t * len(arcs) >= i) & (t * len(arcs) < i + 1)
        w, dw = graded(t[here] * len(arcs) - i)
        angle, turn = start + (end - start) * w, end - start
        points[here] = centre + radius * unit(angle)
        slopes[here] = radius * turn * unit(angle + pi / 2) * dw[:, None] * len(arcs) / (2 * pi)
        curvature[here] = np.sign(turn) / radius
    return t, points, slopes, curvature


def layers(arcs, count):
    """Double layer 2 INT dG/dn_y and single layer 2 INT G on a closed curve, and its points and speeds."""
    t, points, slopes, curvature = curve(arcs, count)
    speed = np.hypot(*slopes.T)
    normal = np.stack([slopes[:, 1], -slopes[:, 0]], -1) / speed[:, None]
    turns, half, i = 2 * pi * t, count // 2, np.arange(count)
    away = points[:, None] - points[None]
    r = np.hypot(away[..., 0], away[..., 1])
    np.fill_diagonal(r, 1)
    log = np.log(4 * np.sin((turns[:, None] - turns[None]) / 2) ** 2 + np.eye(count))
    m = np.arange(1, half)
    row = -(2 * pi / half) * (np.cos(np.outer(turns - turns[0], m)) @ (1 / m)) - pi / half**2 * np.cos(half * (turns - turns[0]))
    weights = row[np.abs(i[:, None] - i[None])]
    across = np.einsum("ijk,jk->ij", away, normal) / r
    double, double_log = 0.5j * hankel1(1, r) * across * speed, -j1(r) / (2 * pi) * across * speed
    rest = double - double_log * log
    double_log[i, i], rest[i, i] = 0, -curvature * speed / (2 * pi)
    single, single_log = 0.5j * hankel1(0, r) * speed, -j0(r) / (2 * pi) * speed
    smooth = single - single_log * log
    single_log[i, i] = -speed / (2 * pi)
    smooth[i, i] = (0.5j - np.euler_gamma / pi - np.log(speed / 2) / pi) * speed
    step = pi / half
    return points, speed * step, (weights * double_log + step * rest).conj(), (weights * single_log + step * smooth).conj()


def t_matrix(alpha, t, hard):
    """T of the modes from m = 0 (hard) or 1 (soft), m = 0 normalised."""
    n, rho = 2 - alpha / pi, t * np.tan(alpha / 2)
    modes = np.arange(int(np.ceil(n * (t + 10 + 4 * t ** (1 / 3)))) + 1)[0 if hard else 1 :]
    nu, count = modes / n, int(2 * np.ceil(max(120, 28 * t / (2 * pi) * n * pi + 80) / 2)) * 2
    centre = rho / np.sin(alpha / 2) * unit(n * pi + alpha / 2)
    points, length, double, single = layers([(0 * centre, t, 0, n * pi), (centre, rho, n * pi - pi / 2, pi / 2)], count)
    circle, arc = np.arange(count // 2), np.arange(count // 2, count)
    phi = np.mod(np.arctan2(points[circle, 1], points[circle, 0]), 2 * pi)
    angular = (np.cos if hard else np.sin)(np.outer(phi, nu))
    values, slopes = (np.eye(count) + double)[:, circle] @ angular, single[:, circle] @ angular
    scale = np.abs(hankel2(nu, t))
    outgoing = (values * hankel2(nu, t) - slopes * h2vp(nu, t)) / scale
    regular = (values * jv(nu, t) - slopes * jvp(nu, t)) * scale
    current = (np.eye(count) + double)[:, arc] if hard else -single[:, arc] / length[arc]
    rows = np.sqrt(length / np.mean(length))[:, None]
    system = np.hstack([current, outgoing]) * rows
    columns = 1 / np.linalg.norm(system, axis=0)
    q, upper, order = scipy.linalg.qr(system * columns, mode="economic", pivoting=True)
    rank = int((np.abs(np.diag(upper)) > 1e-12 * abs(upper[0, 0])).sum())
    solution = np.zeros((system.shape[1], len(modes)), complex)
    solution[order[:rank]] = scipy.linalg.solve_triangular(upper[:rank, :rank], (q.conj().T @ (-regular * rows))[:rank])
    norm = np.where(modes == 0, np.sqrt(2), 1.0)
    return (solution * columns[:, None])[len(arc) :] / scale[:, None] / scale * norm[:, None] / norm


def k_matrix(alpha, t, hard):
    """K of modes 0 to 5; zero where there is none."""
    matrix = t_matrix(alpha, t, hard)
    k = (1j * np.linalg.solve((np.eye(len(matrix)) + matrix).T, matrix.T).T).real
    first = 0 if hard else 1
    result = np.zeros((6, 6))
    result[first:, first:] = ((k + k.T) / 2)[: 6 - first, : 6 - first]
    return result


def scaled(alpha, t, hard):
    k, n = k_matrix(alpha, t, hard), 2 - alpha / pi
    return [k[m, q] * t ** -((m + q) / n if m + q else 2) for m, q in PAIRS]


def main():
    print("// K of rounded wedges. Written by k_table_fit.py, which says how.\n#pragma once\n\n#include <array>\n")
    print("namespace raytube::k_table {\n")
    print(f"inline constexpr std::array<double, {len(ANGLES) + 1}> angles{{{', '.join(map(str, ANGLES))}, 180}};  // of the metal [deg]")
    print(f"inline constexpr std::array<double, {len(DISTANCES)}> distances{{{', '.join(map(str, DISTANCES))}}};  // kt\n")
    print("// K_mq (kt)^-((m + q) / n), K_00 (kt)^-2, of m, q = " + " ".join("%d%d" % p for p in PAIRS) + ".")
    print(f"using Blocks = std::array<std::array<std::array<double, {len(PAIRS)}>, distances.size()>, angles.size()>;\n")
    for hard in (False, True):
        print(f"inline constexpr Blocks {'hard' if hard else 'soft'}{{{{")
        for angle in ANGLES:
            print("{{" + ",\n".join("{" + ", ".join("%.5g" % v for v in scaled(np.radians(angle), t, hard)) + "}" for t in DISTANCES) + "}},")
        print("{}}};  // a plane has none\n")
    print("}  // namespace raytube::k_table")


main()

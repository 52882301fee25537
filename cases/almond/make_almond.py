#!/usr/bin/env python3
"""Makes almond.ply, the NASA almond by its formula (standard library only).

    python3 cases/almond/make_almond.py

A. C. Woo, H. T. G. Wang, M. J. Schuh, M. L. Sanders, Benchmark radar targets for the validation of computational electromagnetics
programs, IEEE Antennas Propag. Mag. 35(1), 84-89, 1993: two bodies of elliptic section about the x axis, d long together,

    -0.41667 < t < 0:  r = sqrt(1 - (t / 0.416667)^2),          y = 0.193333 d r cos psi,  z = 0.064444 d r sin psi
     0 < t < 0.58333:  r = sqrt(1 - (t / 2.08335)^2) - 0.96,    y = 4.83345 d r cos psi,   z = 1.61115 d r sin psi

x = t d. Sections lie in equal steps of an angle, close together where the outline bends: at the round end and at the tip. The mesh is its own
mirror image across y = 0 and z = 0."""
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, ".."))
from make_cases import write_ply  # noqa: E402

LENGTH = 9.936 * 25.4  # d [mm]
BACK, FRONT = 0.416667, 0.583333
BEHIND, AHEAD, AROUND = 40, 46, 88  # sections of either body, points round each


def half_axes(t):
    """Of the section at x = t d, over d."""
    if t < 0:
        r = math.sqrt(max(0.0, 1 - (t / BACK) ** 2))
        return 0.193333 * r, 0.064444 * r
    r = math.sqrt(1 - (t / 2.08335) ** 2) - 0.96
    return 4.83345 * r, 1.61115 * r


def sections():
    """t from the round end to the tip, both left out."""
    steps = [-BACK * math.cos(math.pi / 2 * i / BEHIND) for i in range(1, BEHIND)]
    return steps + [FRONT * math.sin(math.pi / 2 * i / AHEAD) for i in range(AHEAD)]


def ring(t):
    a, b = half_axes(t)
    angles = [2 * math.pi * i / AROUND for i in range(AROUND)]
    return [(t * LENGTH, a * LENGTH * math.cos(psi), b * LENGTH * math.sin(psi)) for psi in angles]


def almond():
    rings = [ring(t) for t in sections()]
    points = [p for r in rings for p in r] + [(-BACK * LENGTH, 0.0, 0.0), (FRONT * LENGTH, 0.0, 0.0)]
    end, tip, last = len(points) - 2, len(points) - 1, len(points) - 2 - AROUND
    triangles = []
    for i in range(AROUND):
        j = (i + 1) % AROUND
        triangles += [(end, j, i), (last + i, last + j, tip)]
        for at in range(0, last, AROUND):
            triangles += halves((at + i, at + j, at + AROUND + j, at + AROUND + i), mirrored=i // (AROUND // 4) % 2)
    return points, triangles


def halves(quad, mirrored):
    a, b, c, d = quad
    return [(a, b, d), (b, c, d)] if mirrored else [(a, b, c), (a, c, d)]


if __name__ == "__main__":
    write_ply("almond/almond.ply", *almond())

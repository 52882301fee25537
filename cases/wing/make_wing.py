#!/usr/bin/env python3
"""Makes wing.ply, a swept wing of lens section (standard library only).

    python3 cases/wing/make_wing.py

Millimetres; x forwards along the chord, y along the span, z up. The section is the same from root to tip: two equal arcs between
sharp edges, in planes of constant y; flat caps at both ends. The mesh is its own mirror image across z = 0."""
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, ".."))
from make_cases import write_ply  # noqa: E402

CHORD, SPAN, SWEEP = 400.0, 600.0, math.radians(25)
THICKNESS = 0.12  # of the chord
ARC = 48  # facets along each arc
STEPS = 10  # along the span


def outline():
    """(x, z) round the section, from the leading edge over the upper arc to the trailing edge and back."""
    rise = 0.5 * THICKNESS * CHORD
    radius = (0.25 * CHORD ** 2 + rise ** 2) / (2 * rise)
    half = math.asin(0.5 * CHORD / radius)
    upper = [half * (2 * i / ARC - 1) for i in range(ARC + 1)]
    arc = [(radius * math.sin(a), radius * (math.cos(a) - 1) + rise) for a in upper]
    arc[0], arc[-1] = (-0.5 * CHORD, 0.0), (0.5 * CHORD, 0.0)
    return arc + [(x, -z) for x, z in reversed(arc[1:-1])]


def wing():
    section, points, triangles = outline(), [], []
    n = len(section)
    for i in range(STEPS + 1):
        y = SPAN * (i / STEPS - 0.5)
        points += [(-x - y * math.tan(SWEEP), y, z) for x, z in section]
    for i in range(STEPS):
        for a in range(n):
            p, q, r, s = (i * n + x for x in (a, (a + 1) % n, n + (a + 1) % n, n + a))
            triangles += [(p, r, q), (p, s, r)] if a < ARC else [(p, s, q), (q, s, r)]
    for first, turned in ((0, False), (STEPS * n, True)):
        for a in range(1, ARC):
            up, down = (first + a, first + a + 1), (first + n - a, (first + n - a - 1))
            cap = [(up[0], up[1], down[0])] if a == ARC - 1 else [(up[0], up[1], down[1]), (up[0], down[1], down[0])]
            triangles += [t[::-1] if turned else t for t in cap]
        cap = (first, first + 1, first + n - 1)
        triangles.append(cap[::-1] if turned else cap)
    return points, triangles


if __name__ == "__main__":
    write_ply("wing/wing.ply", *wing())

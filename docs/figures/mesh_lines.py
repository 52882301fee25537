#!/usr/bin/env python3
"""The sides of the triangles of an ASCII PLY mesh, seen along two directions, for gnuplot (standard library only).

    mesh_lines.py MESH.ply AZIMUTH     columns: along rising azimuth, and away from a radar that stands there [degrees] in the plane z = 0
"""
import math
import sys


def main():
    lines = open(sys.argv[1]).read().split("\n")
    turn = math.radians(float(sys.argv[2]))
    count = [int(line.split()[2]) for line in lines if line.startswith("element")]
    body = lines[lines.index("end_header") + 1:]
    points = [tuple(map(float, line.split()[:2])) for line in body[:count[0]]]
    corners = [list(map(int, line.split()[1:])) for line in body[count[0]:sum(count)]]
    for a, b in sorted({(min(p), max(p)) for c in corners for p in zip(c, c[1:] + c[:1])}):
        for x, y in (points[a], points[b]):
            print(f"{y * math.cos(turn) - x * math.sin(turn):.4f},{-x * math.cos(turn) - y * math.sin(turn):.4f}")
        print()


if __name__ == "__main__":
    main()

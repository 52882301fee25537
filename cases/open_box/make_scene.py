#!/usr/bin/env python3
"""Makes the open box (standard library only): a cubic box without its +x wall, a small absorbing cube in its middle, and the case
file, whose source goes round it in steps.

    python3 cases/open_box/make_scene.py        # rewrites box.off, receiver.off and case.toml

Lengths in metres; all of them are ours."""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))

BOX, RECEIVER = 1.0, 0.1
RADIUS, HEIGHT, STEP_DEG = 2.0, 0.07, 5  # of the circle the source goes; a little off the plane of symmetry
MODELS, RAYS = ("random", "angles", "octahedron", "box-grid", "geometry"), 100000


def cube(side, open_side=None):
    """Corners and triangles of a centred cube, wound to face outward; open_side 5 is +x."""
    points = [[(-side / 2, side / 2)[i >> axis & 1] for axis in range(3)] for i in range(8)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for n, (a, b, c, d) in enumerate(sides) if n != open_side for t in ((a, b, c), (a, c, d))]


def write_off(name, points, triangles):
    with open(os.path.join(HERE, name), "w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines(" ".join(repr(x) for x in p) + "\n" for p in points)
        out.writelines("3 " + " ".join(map(str, t)) + "\n" for t in triangles)


def positions():
    for angle in range(0, 181, STEP_DEG):
        yield [round(RADIUS * math.cos(math.radians(angle)), 6), round(RADIUS * math.sin(math.radians(angle)), 6), HEIGHT]


def main():
    write_off("box.off", *cube(BOX, open_side=5))
    write_off("receiver.off", *cube(RECEIVER))
    half = 1.25 * RADIUS
    points = ",\n".join(f"  {point}" for point in positions())
    models = ", ".join(f'"{model}"' for model in MODELS)
    with open(os.path.join(HERE, "case.toml"), "w") as out:
        out.write(f"""# A source on a half circle round a box without its +x wall; hits on a receiver inside. Made by make_scene.py, see README.md.
title = "Open box, source at {STEP_DEG} degrees times position"

[scene]
box_m = [[{-half}, {-half}, {-half}], [{half}, {half}, {half}]]

[[scene.parts]]
name = "box"
mesh = "box.off"
unit = "m"
surface = "pec"

[[scene.parts]]
name = "receiver"
mesh = "receiver.off"
unit = "m"
surface = "absorber"

[source]
point_m = [
{points},
]
models = [{models}]
rays = {RAYS}
max_reflections = 10
counted = "receiver"
""")


if __name__ == "__main__":
    main()

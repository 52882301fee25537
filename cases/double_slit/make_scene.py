#!/usr/bin/env python3
"""Makes the meshes of the double slit (standard library only): 72 triangles, all of them sides of upright boxes.

    python3 cases/double_slit/make_scene.py        # rewrites room, ground, wall, lintel and screen

Lengths in metres. The published numbers are the room, the clearance of the screen, the count of triangles and the finest
detail; the others are ours."""
import os

HERE = os.path.dirname(os.path.abspath(__file__))

ROOM, HEIGHT = 24.0, 4.0  # published: 24 x 24 x 4
CLEARANCE = 0.4           # published: of the screen above the floor
DETAIL = 0.01             # published finest detail; ours: the thickness of wall and screen
WALL_WIDTH, WALL_HEIGHT = 8.0, 3.0
SLIT_WIDTH, SLIT_HEIGHT, SLIT_SPACING = 0.06, 2.5, 1.0  # spacing from middle to middle
SCREEN_PLACE, SCREEN_WIDTH, SCREEN_TOP = 2.0, 8.0, 3.0  # front of the screen behind the front of the wall


def box(low, high):
    """Corners and the twelve triangles of an upright box, wound to face outward."""
    points = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]


def joined(*solids):
    points, triangles = [], []
    for corners, faces in solids:
        triangles += [tuple(i + len(points) for i in face) for face in faces]
        points += corners
    return points, triangles


def without_floor(solid):
    points, triangles = solid
    return points, triangles[2:]


def floor_of(solid):
    points, triangles = solid
    return points[:4], triangles[:2]


def write_off(name, solid):
    points, triangles = solid
    with open(os.path.join(HERE, name), "w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines(" ".join(repr(x) for x in p) + "\n" for p in points)
        out.writelines("3 " + " ".join(map(str, t)) + "\n" for t in triangles)
    return len(triangles)


def main():
    room = box((-ROOM / 2, -ROOM / 2, 0.0), (ROOM / 2, ROOM / 2, HEIGHT))
    inner, outer, half = (SLIT_SPACING - SLIT_WIDTH) / 2, (SLIT_SPACING + SLIT_WIDTH) / 2, WALL_WIDTH / 2
    pillars = [box((0.0, left, 0.0), (DETAIL, right, SLIT_HEIGHT))
               for left, right in ((-half, -outer), (-inner, inner), (outer, half))]
    lintel = box((0.0, -half, SLIT_HEIGHT), (DETAIL, half, WALL_HEIGHT))
    screen = box((SCREEN_PLACE, -SCREEN_WIDTH / 2, CLEARANCE), (SCREEN_PLACE + DETAIL, SCREEN_WIDTH / 2, SCREEN_TOP))
    total = (write_off("room.off", without_floor(room)) + write_off("ground.off", floor_of(room)) +
             write_off("wall.off", joined(*pillars)) + write_off("lintel.off", lintel) + write_off("screen.off", screen))
    print(f"{total} triangles")


if __name__ == "__main__":
    main()

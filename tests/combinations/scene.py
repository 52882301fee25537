"""The small scene that every feature is tried on, and how a case of it is written."""

import math

WAVELENGTH = 0.1  # [m] at 2.99792458 GHz
PANELS = ("coat", "glass", "foam", "rock")  # the parts that features give a material of their own


def obj(parts):
    """Text of an OBJ file of quads: {group: [four corners, ...]}."""
    text, count = [], 0
    for group, quads in parts.items():
        text.append(f"g {group}")
        for quad in quads:
            text += ["v " + " ".join(f"{c:.9g}" for c in corner) for corner in quad]
            text.append("f " + " ".join(str(count + i) for i in (1, 2, 3, 4)))
            count += 4
    return "\n".join(text) + "\n"


def corner():
    """A dihedral of three wavelengths, above z = 0: a floor of metal, and a wall in four panels."""
    def panel(y, z):
        return [(0, y, z), (0, y + 0.15, z), (0, y + 0.15, z + 0.15), (0, y, z + 0.15)]

    places = [(-0.15, 0.1), (0, 0.1), (-0.15, 0.25), (0, 0.25)]
    floor = [(0, -0.15, 0.1), (0.3, -0.15, 0.1), (0.3, 0.15, 0.1), (0, 0.15, 0.1)]
    return obj({"floor": [floor], **{name: [panel(*place)] for name, place in zip(PANELS, places)}})


def ball(radius=0.12, middle=(0.25, 0, 0.4), rows=24, columns=48):
    """A sphere in four quarters, where the corner leaves room for it."""
    def point(row, column):
        theta, phi = math.pi * row / rows, 2 * math.pi * (column % columns) / columns
        way = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
        return tuple(m + radius * w for m, w in zip(middle, way))

    quads = {name: [] for name in PANELS}
    for column in range(columns):
        for row in range(rows):
            quads[PANELS[4 * column // columns]].append(
                [point(row, column), point(row + 1, column), point(row + 1, column + 1), point(row, column + 1)])
    return obj(quads)


def window():
    """A plane sheet before the corner."""
    return obj({"window": [[(0.4, -0.1, 0.1), (0.4, 0.1, 0.1), (0.3, 0.1, 0.5), (0.3, -0.1, 0.5)]]})


def block():
    """A closed box beside the corner, on which it casts no shadow."""
    (x, y, z), side = (0.05, 0.25, 0.15), 0.15
    at = lambda i, j, k: (x + side * i, y + side * j, z + side * k)
    faces = [[(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)], [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)],
             [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)]]
    opposite = [[tuple(1 - c for c in corner) for corner in face] for face in faces]
    return obj({"block": [[at(*corner) for corner in face] for face in faces + opposite]})


MESHES = {"corner.obj": corner, "ball.obj": ball, "window.obj": window, "block.obj": block}
BASE = {
    "target.mesh": ["corner.obj"], "target.unit": "m", "frequency.ghz": 0.299792458 / WAVELENGTH, "look.theta_deg": [50, 62],
    "look.phi_deg": [10], "output.plots": False}


def write_meshes(folder):
    for name, text in MESHES.items():
        (folder / name).write_text(text())


def value(v):
    if isinstance(v, bool):
        return str(v).lower()
    if isinstance(v, dict):
        return "{ " + ", ".join(f"{k} = {value(x)}" for k, x in v.items()) + " }"
    if isinstance(v, (list, tuple)):
        return "[" + ", ".join(map(value, v)) + "]"
    return f'"{v}"' if isinstance(v, str) else repr(v)


def case_text(settings):
    """TOML of dotted keys."""
    keys = ['"' + k + '"' if "/" in k else k for k in settings]
    return "".join(f"{key} = {value(v)}\n" for key, v in zip(keys, settings.values()) if v is not None)

"""Experiment one: a millimetre-wave radar of 94 GHz. Cube and dihedral in a chamber, and a haul truck."""
import math

import page
import pictures
from solves import CASES, Result, dbsm, manifest, published, relative_error, table

NO_CURVE = ("The published curve is not repeated as numbers: this project does not hold it. Ours are beside the closed form of physical "
            "optics (no edges, radar infinitely far away), and a radar at a finite distance, which is ours, beside an infinitely far one.")
NO_TRUCK = ("The published curve is of another truck, and not repeated as numbers: this project does not hold it. Time, memory and what dominates at "
            "the front are compared.")
WAVELENGTH_M = 299792458.0 / 94e9
WITHIN_DB = 40  # rows further below the peak are minima, in which estimates in dB say little


def both(show, values):
    """VV and HH in one cell."""
    vv, hh = (show(values[c]) for c in ("vv", "hh"))
    return vv if vv == hh else f"{vv} / {hh}"


def median_and_most(sizes):
    return f"{sizes[len(sizes) // 2]:.2g}, {sizes[-1]:.2g} dB"


def estimate(result, name, within_db=WITHIN_DB):
    return both(median_and_most, {c: result.near_peak(name, c, within_db) for c in ("vv", "hh")})


def level(result, phi):
    """σ of the row nearest to phi."""
    row = min(range(len(result.phi)), key=lambda i: abs(result.phi[i] - phi))
    return both(lambda x: f"{x:.2f}", {c: result.sigma[c][row] for c in ("vv", "hh")})


def cut_table(name, phi, closed, folders):
    """Closed form, edges off, edges on, chamber, side by side."""
    results = [Result(folder / "rcs.csv") for folder in folders]
    runs = [manifest(folder) for folder in folders]
    rows = [
        (f"σ at φ = {phi}° (dBsm), VV / HH", level(closed, phi), *(level(r, phi) for r in results)),
        ("relative error of S against the closed form", "–", f"{relative_error(results[0], closed):.1e}", "–", "–"),
        (f"numerical error, median and most within {WITHIN_DB} dB of the peak", "–", *(estimate(r, "err") for r in results)),
        (f"model uncertainty, median and most within {WITHIN_DB} dB of the peak", "–", *(estimate(r, "model") for r in results)),
        ("solve (s)", "–", *(f"{run['time']['solve_s']:.2g}" for run in runs)),
        ("looks", len(closed.rows), *(len(r.rows) for r in results)),
    ]
    head = ("", "closed form", "raytube, edges off", "raytube", "raytube, chamber")
    return page.table(name, "Closed form and raytube; VV / HH where they differ", head, rows)


def cut(program, name, heading, phi, titles, axes):
    folders = [program("run", f"{name}/{case}", f"{name}_{what}", "--set", "output.plots=false", *options)
               for what, case, options in (("off", "case", ("--set", 'edges.method="none"')), ("far", "case", ()), ("near", "chamber", ()))]
    closed = Result(CASES / name / "reference.csv")
    far, near = (Result(folder / "rcs.csv") for folder in folders[1:])
    file = program.work / f"{name}.png"
    pictures.cut(file, closed, far, near, titles, axes)
    return page.section(name, heading, page.note(NO_CURVE), page.picture(file, f"{heading}: {titles[0]}; {titles[1]}"),
                        cut_table(f"{name}-table", phi, closed, folders))


def cube(program):
    return cut(program, "powercube", "Cube of 90 mm", 0, ("far field", "chamber: radar at 2 m"), ("-10:10", "-35:25"))


def dihedral(program):
    return cut(program, "dihedral", "Dihedral of 150 mm", 45, ("far field", "chamber: radar at 5 m"), ("0:90", "0:35"))


# ---------------------------------------------------------------- truck
LIP_M = (0.125, 0.140)  # heights of the lip of the bucket (cases/haul_truck/README.md)
WINDOW = 6  # wavelengths, full width of the Hann window of image_window.png
CELLS = 10  # image cells per wavelength
STRIDE = 5  # cells between places at which the window is laid


def windowed(line):
    """Coherent sums under the window, at every STRIDE-th cell."""
    half = WINDOW * CELLS // 2
    weights = [math.cos(math.pi * k / (2 * half))**2 for k in range(-half, half + 1)]
    padded = [0.0] * half + line + [0.0] * half
    return [sum(w * s for w, s in zip(weights, padded[i:i + 2 * half + 1])) for i in range(0, len(line), STRIDE)]


def places(cells, channel):
    """[(σ, u, v)] of the windowed image."""
    columns = 1 + max(int(r["col"]) for r in cells)
    s = [complex(float(r[f"re_{channel}"]), float(r[f"im_{channel}"])) for r in cells]
    lines = [windowed(s[i:i + columns]) for i in range(0, len(s), columns)]
    sums = zip(*(windowed(list(column)) for column in zip(*lines)))
    return [(dbsm(x), float(cell["u_m"]), float(cell["v_m"])) for j, row in enumerate(sums)
            for x, cell in zip(row, cells[j * STRIDE * columns:(j * STRIDE + 1) * columns:STRIDE])]


def front(cells, channel):
    """The brightest place, whether it is on the lip, and by how much it is above the brightest whose window is clear of the lip."""
    found = places(cells, channel)
    sigma, u, v = max(found)
    clear = LIP_M[0] - WINDOW / 2 * WAVELENGTH_M
    below = sigma - max(place[0] for place in found if place[2] < clear)
    return sigma, u, v, LIP_M[0] <= v <= LIP_M[1], below


def front_table(image):
    cells = table(image)
    rows = []
    for c in ("vv", "hh"):
        sigma, u, v, on_lip, below = front(cells, c)
        rows.append((c.upper(), f"{sigma:.1f}", f"{u:.3f}", f"{v:.3f}", "bucket lip" if on_lip else "elsewhere", f"{below:.1f}",
                     published("haul_truck", "brightest at the front")["", ""]))
    head = ("", "σ (dBsm)", "u (m)", "v (m)", "raytube: brightest at the front", "above all that is clear of it (dB)", "published")
    return page.table("truck-front", "Look 0, image under a window of 6 wavelengths", head, rows)


def cost_table(run, looks):
    rows = []
    for what, key, ours in ((f"time for {looks} looks (s)", "seconds", run["time"]["solve_s"]),
                            ("memory (MB)", "megabytes", run["peak_rss_bytes"] / 1e6)):
        theirs = float(published("haul_truck", key)["", ""])
        rows.append((what, f"{theirs:g}", f"{ours:.1f}", page.ratio(ours, theirs)))
    return page.table("truck-cost", f"Cost: published on four cores of an i7-4770 for a truck of its own; raytube on {run['threads']} threads",
                      ("", "published", "raytube", "ratio"), rows)


def truck_estimates(result):
    rows = [(what, *(median_and_most(sorted(result.column(name, c))) for c in ("vv", "hh")))
            for what, name in (("numerical error", "err"), ("model uncertainty", "model"))]
    return page.table("truck-errors", "Estimates, median and most of all looks", ("", "VV", "HH"), rows)


def truck(program):
    folder = program("run", "haul_truck/case", "truck")
    image = program("run", "haul_truck/case", "front", "--set", "look.phi_deg=0", "--set", "output.image_look=0")
    result, file = Result(folder / "rcs.csv"), program.keep(folder / "rcs.png", "truck")
    pictures.estimates(program.work / "truck_estimates.png", result)
    front_picture = program.keep(image / "image_window.png", "truck_front")
    return page.section(
        "truck", "Haul truck of 0.3 m", page.note(NO_TRUCK), page.picture(file, "361 looks from the front (0°) past the side to the rear"),
        page.picture(program.work / "truck_estimates.png", "Estimated numerical error and model uncertainty"),
        cost_table(manifest(folder), len(result.rows)), truck_estimates(result),
        page.picture(front_picture, "Where the return of look 0 comes from; the bucket lip is the bar at the top"),
        front_table(image / "image.csv"))

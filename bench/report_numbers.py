"""What the report concludes from the numbers: crossings, laws, exponents, ratios."""
import math

ADAPTIVE, CURVED, RANDOM = "adaptive", "adaptive, curved", "Monte Carlo"
METHODS = ("uniform", ADAPTIVE, CURVED, RANDOM)
LEVEL_DB = 0.1
RAYS, TIME = "rays_per_look", "seconds_per_look"


def needed_by_tubes(points, what):
    """Rays or time a look from which on the rms error stays below LEVEL_DB: interpolated between two points on logarithmic axes.
    Returns (value, sign): "≤" if the coarsest does already, ">" if the finest does not yet, else ""."""
    good = len(points)
    while good and points[good - 1]["rms_db"] <= LEVEL_DB:
        good -= 1
    if good == len(points):
        return points[-1][what], ">"
    cheapest = min(p[what] for p in points[good:])  # finer cells may need fewer tubes
    if good == 0:
        return cheapest, "≤"
    above, below = points[good - 1], points[good]
    if below["rms_db"] < LEVEL_DB / 100:  # a jump to the exact answer is no curve to read off
        return cheapest, ""
    share = math.log(above["rms_db"] / LEVEL_DB) / math.log(above["rms_db"] / below["rms_db"])
    return min(cheapest, above[what] * (below[what] / above[what])**share), ""


def needed_at_random(points, what):
    """The same for rays at random, whose error falls as 1/√N: the constant of that law from the points in its range (below 1 dB), or
    from the finest one."""
    ruled = [p for p in points if p["rms_db"] < 1.0] or points[-1:]
    return sum(p["rms_db"]**2 * p[what] for p in ruled) / len(ruled) / LEVEL_DB**2, ""


def needed(body, what):
    """{method: (rays or seconds a look for LEVEL_DB, sign)}"""
    return {name: needed_at_random(points, what) if name == RANDOM else needed_by_tubes(points, what)
            for name, points in body["methods"].items()}


def default_tubes(body):
    """What raytube does unless told otherwise: surfaces that facets stand for are taken as such where there are any."""
    return CURVED if CURVED in body["methods"] else ADAPTIVE


def exponent(pairs):
    """Slope of the least-squares line through (log x, log y)."""
    logs = [(math.log(x), math.log(y)) for x, y in pairs]
    mean_x, mean_y = (sum(values) / len(logs) for values in zip(*logs))
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x)**2 for x, _ in logs)


def curve(growth, mode, what="solve_s"):
    """(x, seconds or rays) of one mode in a growth study."""
    return [(p["x"], p[what]) for p in growth["points"] if p["mode"] == mode]


def growths(data, variable):
    return [g for g in data["growth"] if g["variable"] == variable]


def body_named(data, name):
    return next(b for b in data["error"] if b["body"].startswith(name))


def at_sample(points, sample):
    """The point of a density or tolerance, or the finest one there is."""
    return next((p for p in points if p["samples"] == sample), points[-1])


def adaptive_against_grid(body):
    """Relative error of adaptive tubes, and their share of the rays of the uniform grid of ten cells per wavelength. Where they are the
    truth themselves, their distance from the finest uniform grid stands for the error: it is the larger by far."""
    grid, tubes = at_sample(body["methods"]["uniform"], 10), at_sample(body["methods"][ADAPTIVE], LEVEL_DB)
    return (body["check"] or tubes)["relative_error"], tubes[RAYS] / grid[RAYS]


def dihedral_ratios(data):
    """{(density, mode): (rays of uniform / rays, time of uniform / time)}"""
    rows = data["jobs"]["dihedral"]
    grid = {r["per_wavelength"]: r for r in rows if r["mode"] == "uniform"}
    return {(r["per_wavelength"], r["mode"]): tuple(grid[r["per_wavelength"]][what] / r[what] for what in ("rays", "solve_s"))
            for r in rows}


def embree_ratios(data, least_triangles=0):
    """Rays per second of the uniform mode over those of bare Embree; both shot the same rays."""
    return [t["bare_s"] / t["solve_s"] for t in data["throughput"] if t["triangles"] >= least_triangles]

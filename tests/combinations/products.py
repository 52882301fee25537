"""What is made of a case, each with a check of its own."""

import csv
import os
import random

from features import EXACT, Feature
from solver import CHANNELS, complex_of, difference, table


def image(solver, settings):
    """Cells add up to S of the look."""
    out = solver.run(settings)
    cells = [complex_of(cell, CHANNELS) for cell in table(out / "image.csv")]
    sums = [[sum(cell[c] for cell in cells) for c in range(4)]]
    apart = difference(sums, [complex_of(table(out / "rcs.csv")[0], CHANNELS)])
    return None if apart < 1e-11 else f"cells add up to S within {apart:.2g}"  # a table has 17 digits a cell


def parts(solver, settings):
    out = solver.run(settings, "--parts")
    rows = table(out / "parts.csv")
    names = [name[6:] for name in rows[0] if name.startswith("re_vv_")]
    sums = [[sum(complex_of(row, [f"{c}_{name}" for name in names])) for c in CHANNELS] for row in rows]
    apart = difference(sums, solver.s(settings))
    return None if apart < EXACT else f"parts add up to S within {apart:.2g}"


def trace(solver, settings):
    case, _ = solver.case(settings)
    text = solver.call("trace", case, "--look", 0, "--all", "--tubes", 400)
    return None if "bounce" in text else "no bounce in what trace prints"


def converge(solver, settings):
    case, place = solver.case(settings)
    solver.call("converge", case, "-o", place / "converge", "--quiet", "--densities", "5,10,20")
    return None if (place / "converge" / "converge.csv").exists() else "no converge.csv"


def whole(out):
    return (out / "rcs.csv").read_bytes()


def shards(solver, settings):
    case, place = solver.case(settings)
    for index in (2, 1):
        solver.call("run", case, "-o", place / "shards", "--quiet", "--shard", f"{index}/2")
    solver.call("merge", place / "shards", "--quiet")
    return None if whole(place / "shards") == whole(solver.run(settings)) else "shards have other bytes"


def ranks(solver, settings):
    out = solver.run(settings, launcher=("mpirun", "-n", "2"), name="ranks")
    return None if whole(out) == whole(solver.run(settings)) else "two ranks have other bytes"


def netcdf(solver, settings):
    case, place = solver.case(settings)
    out = solver.run({**settings, "output.netcdf": True})
    solver.call("convert", out / "rcs.nc", place / "back.csv")
    return None if (place / "back.csv").read_bytes() == whole(out) else "rcs.nc says other than rcs.csv"


def chance(solver, settings):
    """Means of runs of random tubes, within four standard errors of the deterministic answer (plus its own error)."""
    out = solver.run(settings, "--launch", "random", "--samples", "4000", "--repeat", "20", "--seed", "7")
    rows = table(out / "random.csv")
    peak = max(abs(complex(float(row["re_det"]), float(row["im_det"]))) for row in rows)
    for row in rows:
        bias = abs(complex(float(row["re_bias"]), float(row["im_bias"])))
        if bias > 4 * float(row["error_m"]) + 0.01 * peak:
            return f"bias {bias:.2g} m, standard error {row['error_m']} m"
    return None


SWEEP = {"frequency.ghz": {"start": 2.9, "stop": 3.1, "count": 5}}


def product(command, *options, sweep=True):
    def check(solver, settings):
        case, place = solver.case({**settings, **SWEEP} if sweep else settings)
        solver.call(command, case, "-o", place / command, "--quiet", *options)
        return None if (place / command / f"{command}.csv").exists() else f"no {command}.csv"
    return check


def isar(solver, settings):
    turned = "radar.turntable_deg" if "radar.turntable_deg" in settings else "look.phi_deg"
    case, place = solver.case({**settings, **SWEEP, "look.theta_deg": [60], turned: {"start": 8, "stop": 12, "count": 5}})
    solver.call("isar", case, "-o", place / "isar", "--quiet")
    return None if (place / "isar" / "isar.csv").exists() else "no isar.csv"


def report(solver, settings):
    out = solver.run({**settings, "output.netcdf": True})
    solver.call("report", out, "--looks", "0", "--quiet")
    return None if "<svg" in (out / "report.html").read_text() else "a report without a curve"


def python(solver, settings):
    import raytube
    case, _ = solver.case(settings)
    with open(solver.run(settings) / "rcs.csv") as f:
        rows = [complex_of(row, CHANNELS) for row in csv.DictReader(line for line in f if not line.startswith("#"))]
    s = raytube.run(case).S.values.reshape(-1, 4)
    apart = difference([list(row) for row in s], rows)
    return None if apart < EXACT else f"Python has S within {apart:.2g}"


PRODUCTS = [
    Feature("random tubes", {}, chance),
    Feature("image", {"output.image_look": 0, "output.image_per_wavelength": 4}, image),
    Feature("parts", {}, parts),
    Feature("trace", {}, trace),
    Feature("converge", {}, converge),
    Feature("shards", {}, shards),
    Feature("MPI", {}, ranks),
    Feature("netCDF", {}, netcdf),
    Feature("profile", {}, product("profile")),
    Feature("profile --direct", {}, product("profile", "--direct")),
    Feature("isar", {}, isar),
    Feature("centres", {}, product("centres", sweep=False)),
    Feature("report", {}, report),
    Feature("Python", {}, python),
]

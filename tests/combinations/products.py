"""What is made of a case, each with a check of its own."""

import csv
import functools
import shutil
import subprocess
import sys

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
    """The bytes of all tables."""
    return {file.name: file.read_bytes() for file in sorted(out.glob("*.csv"))}


def shards(solver, settings):
    case, place = solver.case(settings)
    out = place / "_".join(["shards", *solver.extra])
    parts = [option for option in solver.extra if option == "--parts"]  # of what is merged
    for index in (2, 1):
        solver.call("run", case, "-o", out, "--quiet", "--shard", f"{index}/2", *(o for o in solver.extra if o not in parts))
    solver.call("merge", out, "--quiet", *parts)
    return None if whole(out) == whole(solver.run(settings)) else "shards have other bytes"


RANKS = ("mpirun", "-n", "2")


def ranks(solver, settings):
    out = solver.run(settings, launcher=RANKS, name="ranks")
    return None if whole(out) == whole(solver.run(settings)) else "two ranks have other bytes"


def command_by_ranks(command):
    """The same of a command that shares its looks."""
    def check(solver, settings):
        options = ("--densities", "5,10,20") if command == "converge" else ()
        case, place = solver.case({**settings, **SWEEP, "look.phi_deg": {"start": 8, "stop": 12, "count": 5}, "look.theta_deg": [60]}
                                  if command != "converge" else settings)
        for name, launcher in (("one", ()), ("two", RANKS)):
            solver.call(command, case, "-o", place / f"{command}_{name}", "--quiet", *options, launcher=launcher)
        one, two = (table(place / f"{command}_{name}" / f"{command}.csv") for name in ("one", "two"))
        for row in [*one, *two]:
            row.pop("solve_s", None)  # the only time in a table
        return None if one == two else f"{command} by two ranks has other rows"
    return check


def netcdf(solver, settings):
    case, place = solver.case(settings)
    out = solver.run({**settings, "output.netcdf": True})
    back = place / "_".join(["back", *solver.extra])
    back.mkdir(parents=True, exist_ok=True)
    solver.call("convert", out / "rcs.nc", back / "rcs.csv")
    return None if whole(back)["rcs.csv"] == whole(out)["rcs.csv"] else "rcs.nc says other than rcs.csv"


SWEEP = {"frequency.ghz": {"start": 2.9, "stop": 3.1, "count": 5}}


def product(command, *options, sweep=True):
    def check(solver, settings):
        case, place = solver.case({**settings, **SWEEP} if sweep else settings)
        out = place / "_".join([command, *options])
        solver.call(command, case, "-o", out, "--quiet", *options)
        return None if (out / f"{command}.csv").exists() else f"no {command}.csv"
    return check


def isar(solver, settings):
    turned = "radar.turntable_deg" if "radar.turntable_deg" in settings else "look.phi_deg"
    case, place = solver.case({**settings, **SWEEP, "look.theta_deg": [60], turned: {"start": 8, "stop": 12, "count": 5}})
    solver.call("isar", case, "-o", place / "isar", "--quiet")
    return None if (place / "isar" / "isar.csv").exists() else "no isar.csv"


def report(solver, settings):
    out = solver.run({**settings, "output.netcdf": True})
    solver.call("report", out, "--quiet")
    return None if (out / "report.html").stat().st_size > 100_000 else "a report without a scene"


def python(solver, settings):
    import raytube
    case, _ = solver.case(settings)
    with open(solver.run(settings) / "rcs.csv") as f:
        rows = [complex_of(row, CHANNELS) for row in csv.DictReader(line for line in f if not line.startswith("#"))]
    s = raytube.run(case).S.values.reshape(-1, 4)
    apart = difference([list(row) for row in s], rows)
    return None if apart < EXACT else f"Python has S within {apart:.2g}"


NEEDED = "import raytube, xarray"


@functools.cache
def is_able():
    """Whether this Python has what the package needs."""
    return subprocess.run([sys.executable, "-c", NEEDED], capture_output=True).returncode == 0


def missing(feature):
    """Whether there is nothing here to try it with."""
    if feature.name == "Python":
        return not is_able()
    return feature.name == "MPI" and not shutil.which("mpirun")


PRODUCTS = [
    Feature("image", {"output.image_look": 0, "output.image_per_wavelength": 4}, image),
    Feature("parts", {}, parts, options=("--parts",)),
    Feature("trace", {}, trace),
    Feature("converge", {}, converge),
    Feature("shards", {}, shards),
    Feature("MPI", {}, ranks),
    Feature("netCDF", {"output.netcdf": True}, netcdf),
    Feature("profile", {}, product("profile")),
    Feature("profile --direct", {}, product("profile", "--direct")),
    Feature("isar", {}, isar),
    Feature("centres", {}, product("centres", sweep=False)),
    Feature("report", {}, report),
    Feature("Python", {}, python),
]

RUNS, WRAPPERS = ("image", "parts", "netCDF"), ("shards", "MPI")


def pair_checks(one, other):
    """What there is to try of two products: checks, each with the options of the other one; nothing of two commands."""
    names = (one.name, other.name)
    if one is other:
        return [(one.check, ())]
    if names[0] in RUNS and names[1] in RUNS:
        return [(one.check, other.options), (other.check, one.options)]
    for first, second in ((one, other), (other, one)):
        if first.name in RUNS and second.name in WRAPPERS:
            return [(second.check, first.options)]
        if first.name in ("converge", "profile", "isar") and second.name == "MPI":
            return [(command_by_ranks(first.name), ())]
        if {first.name, second.name} == {"image", "converge"}:
            return [(converge, ())]
    return []

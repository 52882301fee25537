"""The first table: what was asked of raytube's speed, what was measured, and whether it is reached."""
from report_format import number, ratio, seconds, table
from report_numbers import (ADAPTIVE, LEVEL_DB, RANDOM, RAYS, body_named, adaptive_against_grid, curve, default_tubes, dihedral_ratios, embree_ratios,
                            exponent, growths, needed)


def verdict(reached):
    return "yes" if reached else "**no**"


def short(growth):
    return growth["body"].split(",")[0]


def at_random(data):
    for name in ("dihedral", "sphere"):
        body = body_named(data, name)
        costs, tubes = needed(body, RAYS), needed(body, RAYS)[default_tubes(body)]
        yield [f"{name}: rays for {LEVEL_DB} dB, {RANDOM} / {default_tubes(body)}", "≥ 100", ratio(costs[RANDOM], tubes),
               verdict(costs[RANDOM][0] >= 100 * tubes[0])]


def dihedral(data):
    for density, rays, time in ((12, 40, 25), (25, 80, 50)):
        if (density, "adaptive") not in dihedral_ratios(data):
            continue
        fewer, faster = dihedral_ratios(data)[density, "adaptive"]
        yield [f"dihedral, λ/{density}: uniform / adaptive at equal error, rays; time", f"≥ {rays}; ≥ {time}",
               f"{number(fewer)}; {number(faster)}", verdict(fewer >= rays and faster >= time)]


def flat_bodies(data):
    for name in ("plate", "dihedral", "trihedral"):
        body = body_named(data, name)
        error, share = adaptive_against_grid(body)
        against = f" (against uniform, {body['check']['uniform_per_wavelength']:g} per λ)" if body["check"] else ""
        yield [f"{body['body']}, adaptive: relative error of S{against}; share of the uniform grid's rays", "≤ 10⁻⁴; ≤ 2 %",
               f"{number(error)}; {number(100 * share)} %", verdict(error <= 1e-4 and share <= 0.02)]


def jobs(data):
    limits = {"cases/plate/case.toml": 0.066, "bench/dihedral.toml": 0.132, "cases/sphere/case.toml": 0.7}  # [s], on such a machine
    for job in data["jobs"]["jobs"]:
        if job["case"] in limits:
            yield [f"`{job['case']}`, adaptive: time / bare `rtcIntersect16` on the uniform grid; time", f"–; ≤ {seconds(limits[job['case']])}",
                   f"{number(job['adaptive_s'] / job['bare_s'])}; {seconds(job['adaptive_s'])}", verdict(job["adaptive_s"] <= limits[job["case"]])]


def throughput(data):
    # Meshes of a few triangles cost Embree next to nothing; what is asked is about others.
    many = embree_ratios(data, least_triangles=10_000)
    if many:
        yield ["rays per second, uniform / bare `rtcIntersect16`, 10⁴ triangles and more: least; greatest", "≥ 0.5",
               f"{min(many):.2f}; {max(many):.2f}", verdict(min(many) >= 0.5)]


def frequency(data):
    (growth,) = growths(data, "GHz")
    grid, tubes = (curve(growth, mode) for mode in ("uniform", ADAPTIVE))
    yield [f"{short(growth)}, time against frequency, {grid[0][0]:g} to {grid[-1][0]:g} GHz: exponent, adaptive (uniform)", "≤ 0.6 (2)",
           f"{exponent(tubes):.2f} ({exponent(grid):.2f})", verdict(exponent(tubes) <= 0.6)]
    for growth in growths(data, "frequencies"):
        grid, tubes = (dict(curve(growth, mode)) for mode in ("uniform", ADAPTIVE))
        if 101 in grid:
            yield [f"{short(growth)}: time of 101 frequencies / 1, uniform (adaptive)", "≤ 2",
                   f"{grid[101] / grid[1]:.2f} ({tubes[101] / tubes[1]:.2f})", verdict(grid[101] <= 2 * grid[1])]


def threads(data):
    for growth in growths(data, "threads"):
        for mode in ("uniform", ADAPTIVE):
            times = dict(curve(growth, mode))
            yield [f"{short(growth)}, {mode}: speed of 2 threads / 1", "≥ 1.85", f"{times[1] / times[2]:.2f}",
                   verdict(times[1] >= 1.85 * times[2])]


def memory(data):
    peak = max(max(m["adaptive"], m["uniform"]) for m in data["memory"])
    yield ["greatest peak memory of a case", "≤ 110 MB", f"{peak / 1e6:.0f} MB", verdict(peak <= 110e6)]


def asked_and_measured(data):
    rows = [row for part in (at_random, dihedral, flat_bodies, jobs, throughput, frequency, threads, memory) for row in part(data)]
    return "## Asked and measured\n\n" + table(["what", "asked", "measured", "reached"], rows) + "\n"

"""The page: tables, pictures, and the sentences that follow from the numbers."""
import vehicles
from report_asked import asked_and_measured
from report_format import number, ratio, seconds, signed, table
from report_numbers import (ADAPTIVE, LEVEL_DB, METHODS, RANDOM, RAYS, TIME, body_named, curve, default_tubes, dihedral_ratios, embree_ratios,
                            exponent, growths, needed)


def head(data):
    m = data["machine"]
    warning = f"**Quick run: small sizes, {m['repeats']} repeats. Not to be quoted.**\n\n" if data["quick"] else ""
    return f"""# Benchmark report

{warning}Made by `bench/run` on {m['cpu']}, {m['cores']} cores; {m['threads']} threads unless said; {m['compiler']}; raytube for x86-64-v3,
Embree in {m['embree']}. Whatever is compared was run in turn in one run of one program; times are medians of {m['repeats']}. Ratios come first;
absolute times are this machine's. `tubes.mode` is set explicitly everywhere. A ray of adaptive tubes is one tube from one surface to the next.

"""


def truths(data):
    by_truth = {}
    for body in data["error"]:
        by_truth.setdefault(body["truth"], []).append(body["body"])
        if "smooth_truth" in body:
            by_truth.setdefault(body["smooth_truth"] + " (physical optics)", []).append(f"{body['body']}, curved")
    return "\n".join(f"- {truth}: {', '.join(names)}" for truth, names in by_truth.items())


def checks(data):
    checked = [b for b in data["error"] if b["check"]]
    distances = ", ".join(f"{number(b['check']['relative_error'])} ({b['body']})" for b in checked)
    return f"a uniform grid of {checked[0]['check']['uniform_per_wavelength']:g} cells per wavelength comes as close to them as {distances} of S"


def picture(name, text, plots):
    return f"![{text}](plots/{name}.png)\n\n" if name in plots else ""


def needed_table(data, what, text):
    rows = []
    for body in data["error"]:
        costs = needed(body, what)
        cells = [signed(text(costs[m][0]), costs[m][1]) if m in costs else "–" for m in METHODS]
        least = costs[default_tubes(body)]
        rows.append([body["body"], f"{body['triangles']:,}", ratio(costs[RANDOM], least), ratio(costs["uniform"], least), *cells])
    return table(["target", "triangles", f"{RANDOM} / default", "uniform / default", *METHODS], rows)


def random_sentence(data):
    parts = []
    for name in ("dihedral", "sphere"):
        body = body_named(data, name)
        costs = needed(body, RAYS)
        tubes, grid = (ratio(costs[RANDOM], costs[m]) for m in (default_tubes(body), "uniform"))
        parts.append(f"on the {name} {tubes} times as many as adaptive tubes, {grid} times as many as the uniform grid")
    return f"For {LEVEL_DB} dB, rays at random need " + "; ".join(parts) + ".\n"


def errors(data, plots):
    pictures = picture("error_rays", "rms error against rays per look", plots) + picture("error_time", "rms error against time per look", plots)
    return f"""## Error against rays and time

Ways to sample the same physical-optics currents, up to 8 bounces, edges off (`edges.method = "none"`): the **uniform** grid at several
densities; **adaptive** tubes, which end exactly at edges and shadows, refined
until their own estimate of the error is below a tolerance (facets kept flat); **adaptive, curved**, the same on the surface that facets stand for, the
default on tessellated bodies; and
**Monte Carlo**, rays from random places of the launch rectangle (Philox4x32-10, {data['machine']['repeats']} seeds), each one point sample of the
integrand, traced by the same tracer. Looks off every symmetry; rms over looks, seeds, VV and HH where the truth is within 20 dB of its peak.
Errors below 10⁻⁵ dB are drawn there.

The truth is

{truths(data)}

On flat facets adaptive tubes have no sampling error once cells outnumber facets;
{checks(data)}.
How far facets are from a smooth body is not counted where facets are kept.

{pictures}Rays per look for {LEVEL_DB} dB rms, interpolated on these curves; Monte Carlo by its law, error ∝ 1/√rays, through the points below 1 dB,
or the finest one.
`≤`: the coarsest density or tolerance does already; `>`: the finest does not yet.

{needed_table(data, RAYS, number)}
{random_sentence(data)}
Time per look for {LEVEL_DB} dB rms, in the same way:

{needed_table(data, TIME, seconds)}
"""


def throughput(data):
    rows = [[t["body"], f"{t['triangles']:,}", t["threads"], f"{100 * t['hit_share']:.0f} %", f"{share:.2f}",
             f"{t['rays'] / t['solve_s'] / 1e6:.1f}", f"{t['bare_rays'] / t['bare_s'] / 1e6:.1f}"]
            for t, share in zip(data["throughput"], embree_ratios(data))]
    ratios = embree_ratios(data)
    return f"""## Uniform mode against bare Embree

The uniform grid at 10 cells per wavelength, physical optics of both polarisations in double, against bare `rtcIntersect16` on the same rays,
reflected ones too, in the same order, flagged coherent, nothing done with the hits.

{table(["target", "triangles", "threads", "rays that hit", "ratio", "raytube, 10⁶ rays/s", "Embree, 10⁶ rays/s"], rows)}
With all the physics, {100 * min(ratios):.0f} to {100 * max(ratios):.0f} % of bare Embree's rays per second are left.

"""


def growth_row(growth):
    grid, tubes = (curve(growth, mode) for mode in ("uniform", ADAPTIVE))
    cells = [growth["body"], growth["variable"], f"{grid[0][0]:,.0f} – {grid[-1][0]:,.0f}"]
    for places in (grid, tubes):
        (_, first), (_, last) = places[0], places[-1]
        cells += [f"{last / first:.3g}", f"{exponent(places):.2f}", f"{seconds(first)}; {seconds(last)}"]
    return cells


def growth(data, plots):
    (frequency,) = growths(data, "GHz")
    grid, tubes = (exponent(curve(frequency, mode)) for mode in ("uniform", ADAPTIVE))
    columns = [f"{mode}: {what}" for mode in ("uniform", "adaptive") for what in ("last / first", "exponent", "first; last")]
    return f"""## Growth

Time at the last value over that at the first, and the exponent of the power law fitted through all values. 10 cells per wavelength at the highest
frequency; adaptive at a tolerance of 0.1 dB, facets kept flat, which on flat faces is exact at every frequency, so that its time is the time at a fixed tolerance.

{picture("growth", "growth of the time", plots)}{table(["target", "variable", "range", *columns], [growth_row(g) for g in data["growth"]])}
The uniform grid's time grows as frequency to the power {grid:.2f}, that of adaptive tubes to the power {tubes:.2f}.

"""


def jobs(data):
    ratios = dihedral_ratios(data)
    rows = [[f"λ/{r['per_wavelength']:g}", r["mode"], *(number(x) for x in ratios[r["per_wavelength"], r["mode"]]), number(r["relative_error"]),
             f"{r['rays']:,}", seconds(r["solve_s"])] for r in data["jobs"]["dihedral"]]
    work = [[f"`{j['case']}`", j["looks"], number(j["adaptive_s"] / j["bare_s"]), number(j["uniform_s"] / j["bare_s"]),
             number(j["uniform_s"] / j["adaptive_s"]), *(seconds(j[key]) for key in ("adaptive_s", "uniform_s", "bare_s"))]
            for j in data["jobs"]["jobs"]]
    return f"""## Dihedral of 150 mm, 94 GHz, four looks

Against the closed form, over VV and HH.

{table(["density", "tubes", "times fewer rays", "times less time", "relative error of S", "rays", "time"], rows)}
## Whole jobs

`time.solve_s` of cases as they stand but for `tubes.mode`, against bare `rtcIntersect16` on the rays of the uniform λ/10 grid of the same job.

{table(["case", "looks", "adaptive / Embree", "uniform / Embree", "uniform / adaptive", "adaptive", "uniform", "Embree"], work)}
"""


def memory(data):
    rows = [[f"`{m['case']}`", f"{m['adaptive'] / 1e6:.0f}", f"{m['uniform'] / 1e6:.0f}"] for m in data["memory"]]
    return f"""## Peak memory

`peak_rss_bytes` of `raytube run` on 2 threads, cases as they stand but for `tubes.mode`, in MB.

{table(["case", "adaptive", "uniform"], rows)}"""


def of_vehicles(data):
    return f"""## Vehicles

Five looks in the horizontal plane at defaults, on 2 threads. Seconds a look of all, and of the tubes alone
(`edges.method = "none"`), with AVX2 and, where the processor has it, with AVX-512; median true error of the tubes in VV against the
same at 80 cells per wavelength and 0.01 dB, and the median of what the rows tell as a multiple of it; microseconds to read and build,
a triangle; peak memory. Cars are those of `bench/car.py`; others are files of `--meshes`.

{table(["vehicle", "triangles", "GHz", "s a look", "tubes, s a look", "error, dB", "told / true", "build, μs", "MB"],
       list(vehicles.table_rows(data["vehicles"])))}"""


def report(data, plots):
    return (head(data) + asked_and_measured(data) + errors(data, plots) + throughput(data) + growth(data, plots) + jobs(data) + memory(data) +
            "\n" + of_vehicles(data))

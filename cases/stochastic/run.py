#!/usr/bin/env python3
"""Random rays beside tubes, S against time on one plot, and an image: run.py [PROGRAM]     (default build/raytube; over a minute)

Random rays are those of bench/monte_carlo, `monte_carlo` beside PROGRAM, which is built first where it is missing.

Writes out/error_time.csv and out/image/compare.csv and, with gnuplot, their pictures beside this file. Standard library only."""
import cmath
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "cases")]
from make_cases import C0, dihedral_po  # noqa: E402
from report_plots import STYLES, block, decades  # noqa: E402

RANDOM, UNIFORM, ADAPTIVE = "random rays", "uniform tubes", "adaptive tubes (default)"
PASSES = 3  # each setting this many times, in turn; the shortest time counts
RUNS = 10  # random runs whose errors make one point
EXACT = 1e-9  # rounding and the truth's own digits
LEAST = 1e-7  # errors below are drawn here: a logarithmic axis has no zero
IMAGE_SAMPLES = (10**4, 10**5)  # a look, of the random images
APERTURE = {"frequency": "{ghz={start=2.5,stop=3.5,count=21}}", "look": "{theta_deg=90.0,phi_deg={start=61.0,stop=73.0,count=21}}"}
PANELS = {"dihedral": "150 mm dihedral, 94 GHz", "sphere": "sphere of 1 m radius, 3 GHz"}


def sphere_po(a, freq):
    """Lit half of a sphere of radius a, monostatic physical optics in closed form (Knott, Shaeffer & Tuley 2004, ch. 5)."""
    k = 2 * math.pi * freq / C0
    jc = 2j * k * a
    return -1j * k * a * a * (cmath.exp(jc) / jc - (cmath.exp(jc) - 1) / jc**2)


def table(file):
    with open(file) as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def run(program, case, options, folder):
    """Runs the case on one thread; returns its folder."""
    command = [program, "run", HERE / f"{case}.toml", "-o", folder, "--threads", "1", "--quiet", "--set", "output.plots=false"]
    subprocess.run([*map(str, command), *options], check=True)
    return folder


def manifest(folder):
    return json.loads((folder / "run.json").read_text())


def copolar(folder):
    """S_vv and S_hh of every row."""
    return [complex(float(row[f"re_{c}"]), float(row[f"im_{c}"])) for row in table(folder / "rcs.csv") for c in ("vv", "hh")]


def norm(values):
    return math.sqrt(sum(abs(v)**2 for v in values))


def deterministic(program, case, options, truth, folder):
    """(seconds a look, relative error of complex S)"""
    s = copolar(run(program, case, options, folder))
    return 2 * manifest(folder)["time"]["solve_s"] / len(s), norm([a - b for a, b in zip(s, truth)]) / norm(truth)


def baseline_of(program):
    """The program of the Monte Carlo baseline, beside raytube."""
    baseline = program.parent / "monte_carlo"
    if not baseline.exists():
        subprocess.run(["cmake", "--build", program.parent, "--target", "monte_carlo"], check=True, stdout=subprocess.DEVNULL)
    return baseline


def drawn(program, case, options, folder):
    """Draws the case on one thread; returns its folder."""
    command = [baseline_of(program), HERE / f"{case}.toml", "-o", folder, "--threads", "1", *options]
    subprocess.run([*map(str, command)], check=True, stdout=subprocess.DEVNULL)
    return folder


def seconds_of_a_run(folder):
    return float(re.search(r"# run_s = (\S+):", (folder / "random.csv").read_text())[1])


def by_chance(program, case, samples, truth, folder):
    """The same of a single run, rms over the runs: the square is that of the mean's error and (R - 1) / R of the spread's."""
    folder = drawn(program, case, ["--samples", str(samples), "--repeat", str(RUNS)], folder / "drawn")
    rows = [row for row in table(folder / "random.csv") if row["channel"] in ("vv", "hh")]
    bias = norm([complex(float(row["re_mean"]), float(row["im_mean"])) - t for row, t in zip(rows, truth)])
    spread = norm([float(row["spread_m"]) for row in rows])
    return 2 * seconds_of_a_run(folder) / len(rows), math.hypot(bias, math.sqrt(1 - 1 / RUNS) * spread) / norm(truth)


def sets(**keys):
    return [word for key, value in keys.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


def truths(program, case, folder):
    """What a case tends to: of its surface, in closed form, and of the facets that random rays and uniform tubes meet."""
    if case == "dihedral":
        exact = [s for phi in (20.3, 31.7, 47.3, 69.1) for s in dihedral_po(0.15, 0.15, 94e9, math.radians(phi))]
        return exact, exact
    facets = sets(tubes__curved='"never"', tubes__per_wavelength=80, accuracy__tolerance_db="1e-9")
    return [sphere_po(1.0, 3e9)] * 8, copolar(run(program, case, facets, folder))


def settings(program, case, folder):
    """(method, setting, function that measures it)"""
    surface, facets = truths(program, case, folder)
    densities = (0.25, 0.5, 1, 2.5, 5, 10) if case == "dihedral" else (1, 2.5, 5, 10, 20, 40)
    for samples in (10**3, 10**4, 10**5):
        yield RANDOM, samples, lambda n=samples: by_chance(program, case, n, facets, folder)
    for density in densities:
        options = sets(tubes__mode='"uniform"', tubes__per_wavelength=density)
        yield UNIFORM, density, lambda o=options: deterministic(program, case, o, facets, folder)
    yield ADAPTIVE, 0.1, lambda: deterministic(program, case, [], surface, folder)  # accuracy.tolerance_db; others change nothing


def study(program, case, folder):
    """{method: [(setting, seconds, error), ...]}"""
    measured = {}
    for _ in range(PASSES):
        for method, setting, measure in settings(program, case, folder):
            seconds, error = measure()
            before = measured.setdefault(method, {}).get(setting, (math.inf, 0))[0]
            measured[method][setting] = min(before, seconds), error
    return {method: [(x, *point) for x, point in points.items()] for method, points in measured.items()}


def slope(points):
    """Exponent of error against time: a straight line through the logarithms."""
    xs, ys = [math.log(p[1]) for p in points], [math.log(p[2]) for p in points]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys)) / sum((a - x)**2 for a in xs)


def random_law(points):
    """c of error = c / sqrt(seconds), through the middle of the points."""
    return math.exp(sum(math.log(error * math.sqrt(seconds)) for _, seconds, error in points) / len(points))


def samples_law(points):
    """c of error = c / sqrt(samples), through the middle of the points (samples, error)."""
    return math.exp(sum(math.log(error * math.sqrt(samples)) for samples, error in points) / len(points))


def samples_for(law, error):
    return f"{(law / error)**2:.1e}" if error > EXACT else "no end"


def show(case, methods):
    law, by_samples = random_law(methods[RANDOM]), samples_law([(x, error) for x, _, error in methods[RANDOM]])
    print(f"\n{PANELS[case]}\n  {'':<26}{'setting':>9}{'ms a look':>11}{'rel. error':>12}{'random takes':>14}{'samples a look':>16}")
    for method, points in methods.items():
        for x, seconds, error in points:
            needs = f"{(law / error)**2 / seconds:.2g} x" if error > EXACT else "no end"
            needs = "" if method == RANDOM else f"{needs:>14}{samples_for(by_samples, error):>16}"
            print(f"  {method:<26}{x:>9g}{1e3 * seconds:>11.3g}{error:>12.2e}{needs}")
    print("  exponent of error against time: " + ", ".join(f"{m} {slope(methods[m]):.2f}" for m in (RANDOM, UNIFORM)))


def with_closed_form(rows, file):
    """The table of a run, with S of the sphere in closed form in the place of its own."""
    lines = [line for line in open(rows) if not line.startswith("#")]
    names = lines[0].rstrip("\n").split(",")
    with open(file, "w") as f:
        f.write(lines[0])
        for row in (dict(zip(names, line.rstrip("\n").split(","))) for line in lines[1:]):
            s = sphere_po(1.0, float(row["freq_hz"]))
            row.update({f"re_{c}": repr(s.real) for c in ("vv", "hh")} | {f"im_{c}": repr(s.imag) for c in ("vv", "hh")})
            f.write(",".join(row.values()) + "\n")


def image_of(program, rows, file):
    """Of a table of the aperture: a netCDF file."""
    subprocess.run([program, "isar", rows, "-o", file, "--size", "2.6", "2.6", "--quiet"], check=True)
    return file


def rows_of(program, folder, compute=run, options=()):
    """The table of the aperture; out of its folder, so that nothing but its rows is known."""
    compute(program, "sphere", [*sets(**APERTURE), *options], folder)
    return (folder / "rcs.csv").rename(folder.parent / f"{folder.name}.csv")


def image_error(program, image, reference, folder):
    """Relative error of complex pixels, as raytube compare has it; both images have the same pixels."""
    command = [program, "compare", image.name, reference.name, "-o", folder, "--no-register"]
    subprocess.run(command, cwd=image.parent, check=True, stdout=subprocess.DEVNULL)
    row = table(folder / "compare.csv")[0]
    return float(row["relative_error"]), row


def image_study(program, folder, out):
    """The sphere's image by adaptive tubes, beside its closed form and beside random images: ours, [(samples, theirs), ...]"""
    ours = rows_of(program, folder / "adaptive")
    with_closed_form(ours, folder / "exact.csv")
    image, exact = (image_of(program, rows, rows.with_suffix(".nc")) for rows in (ours, folder / "exact.csv"))
    points = []
    for samples in IMAGE_SAMPLES:  # the mean of two runs of half as many
        options = ["--samples", str(samples // 2), "--repeat", "2"]
        by_chance_rows = rows_of(program, folder / f"random_{samples}", drawn, options)
        random_image = image_of(program, by_chance_rows, by_chance_rows.with_suffix(".nc"))
        points.append((samples, *image_error(program, random_image, image, out)))
    return image_error(program, image, exact, folder / "ours")[0], points


def show_image(ours, points):
    law = samples_law([(samples, error) for samples, error, _ in points])
    print(f"\nimage of the sphere, 21 frequencies by 21 looks\n  {'':<26}{'samples a look':>16}{'rel. error':>12}{'rms dB':>9}{'SSIM':>8}")
    for samples, error, row in points:
        print(f"  {RANDOM:<26}{samples:>16g}{error:>12.2e}{float(row['rms_db']):>9.2f}{float(row['ssim']):>8.3f}")
    print(f"  {ADAPTIVE:<26}{'':>16}{ours:>12.2e}\n  random rays would need {samples_for(law, ours)} samples a look for this error of the image")


def panel(index, case, methods):
    blocks, plots = "", []
    for style, (method, points) in zip((5, 1, 3), methods.items()):
        blocks += block(f"b{index}s{style}", [(1e3 * seconds, max(error, LEAST)) for _, seconds, error in points])
        plots.append(f"$b{index}s{style} with linespoints ls {style} title '{method}'")
    times = [1e3 * seconds for points in methods.values() for _, seconds, _ in points]
    law = random_law(methods[RANDOM]) * math.sqrt(1e3)
    plots.append(f"{law:.6g} / sqrt(x) with lines lc rgb '#d9480f' dt 3 title 'time^{{−1/2}}'")
    return (f"{blocks}set title '{PANELS[case]}'\nset xrange {decades(times)}\nplot {', '.join(plots)}\n"
            "unset key\nset ylabel ''\n")


def draw(studies, file):
    script = (f"set encoding utf8\nset terminal pngcairo size 1100,480 font 'DejaVu Sans,11' background rgb 'white'\n"
              f"set output '{file}'\n{STYLES}set key at screen 0.5,0.97 center maxcols 4 maxrows 1 width -2\n"
              f"set yrange [{LEAST / 2}:30]\nset ytics add ('≤10^{{-7}}' {LEAST})\nset xlabel 'time per look (ms)'\n"
              "set ylabel 'relative error of complex S'\n"
              "set multiplot layout 1,2 margins 0.09,0.985,0.13,0.84 spacing 0.08,0\n")
    script += "".join(panel(i, case, methods) for i, (case, methods) in enumerate(studies.items()))
    subprocess.run(["gnuplot", "-d"], input=script + "unset multiplot\n", text=True, check=True)


def main():
    program = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "raytube").resolve()
    out = HERE / "out"
    out.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        studies = {case: study(program, case, pathlib.Path(folder)) for case in PANELS}
        image = image_study(program, pathlib.Path(folder), out / "image")
    with open(out / "error_time.csv", "w", newline="") as f:
        writer = csv.writer(f, lineterminator="\n")
        writer.writerow(["case", "method", "setting", "seconds_per_look", "relative_error"])
        writer.writerows((case, method, *p) for case, methods in studies.items() for method, points in methods.items() for p in points)
    for case, methods in studies.items():
        show(case, methods)
    show_image(*image)
    try:
        draw(studies, out / "error_time.png")
    except FileNotFoundError:
        print("no picture: gnuplot is not installed", file=sys.stderr)
    print(f"\nresults     {out}")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Counts the processor's instructions of twelve small jobs that stand for all paths, against table.csv (standard library only).

    bench/cost/cost.py check [--program build/raytube]     exit 1 if a job costs over 1 % more than the table says
    bench/cost/cost.py renew [--program build/raytube]     writes the table and shows what changed

A job is the case file of that name beside this script. Counted under valgrind's cachegrind, on one thread and with a clock that
stands still: unlike seconds, counts repeat to about 0.05 % and depend neither on load nor on the processor, for valgrind shows every
program the same one. They depend on the compiler, its options and the C library: `check` ends with 77, which ctest takes for
skipped, where these are not the table's, and where valgrind is missing."""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
TABLE = HERE / "table.csv"
JOBS = ["read", "flat", "curved", "vehicle", "edges", "between", "penumbra", "materials", "near_field", "sphere", "cube_band",
        "small_vehicle"]
MOST_PERCENT = 1.0
FELL_SHORT, BAD_INPUT, SKIPPED = 1, 2, 77

sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / "cases" / "haul_truck"))
import make_truck  # noqa: E402


def leave(code, sentence):
    print(f"cost.py: {sentence}", file=sys.stderr)
    sys.exit(code)


# ---------------------------------------------------------------- meshes
def truck_body():
    mesh = make_truck.Mesh()
    for part in (make_truck.bucket, make_truck.chassis, make_truck.front):
        part(mesh)
    return mesh


def half_truck():
    mesh = truck_body()
    for x, y in ((82.0, 53.0), (-66.0, 59.0), (-66.0, 30.5)):
        make_truck.tyre(mesh, x, y, 1)
    return mesh


def write_stl(path, mesh):
    with open(path, "w", encoding="ascii") as f:
        f.write("solid half_truck\n")
        for triangle in mesh.triangles:
            corners = "".join("vertex {:.12g} {:.12g} {:.12g}\n".format(*mesh.points[i]) for i in triangle)
            f.write(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        f.write("endsolid half_truck\n")


def make_meshes(folder):
    """Files of the jobs that no folder of cases holds, by job."""
    make_truck.STEP = 1000.0  # flat panels of two triangles each
    files = {"read": folder / "half_truck.stl", "vehicle": folder / "body.ply", "small_vehicle": folder / "car.ply"}
    write_stl(files["read"], half_truck())
    subprocess.run([sys.executable, HERE.parent / "car.py", files["small_vehicle"], "--facets", "2500"], check=True, capture_output=True)
    make_truck.write_ply(files["vehicle"], truck_body())
    return files


# ---------------------------------------------------------------- counting
def make_still_clock(folder):
    """Shared library in which the time never passes."""
    library = folder / "still_clock.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", HERE / "still_clock.c", "-o", library], check=True)
    return library


def instructions_of(program, job, mesh, folder, clock):
    """Of the whole run, from the first of the loader to the last."""
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", program, "run",
               HERE / f"{job}.toml", "-o", folder / job, "--threads", "1", "--instruction-set", "avx2", "--quiet",
               "--set", "output.plots=false"] + (["--set", f'target.mesh="{mesh}"'] if mesh else [])
    environment = {"LC_ALL": "C", "PATH": os.environ["PATH"], "LD_PRELOAD": str(clock)}
    ended = subprocess.run(command, env=environment, capture_output=True, text=True)
    found = re.search(r"I\s+refs:\s+([\d,]+)", ended.stderr)
    if ended.returncode or not found:
        leave(BAD_INPUT, f"{job} did not run to its end: {' '.join(map(str, command))}\n{ended.stderr}")
    return int(found[1].replace(",", ""))


def measure(program):
    """Instructions by job."""
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(min(2, os.cpu_count())) as pool:
        folder = pathlib.Path(name)
        meshes, clock = make_meshes(folder), make_still_clock(folder)
        runs = {job: pool.submit(instructions_of, program, job, meshes.get(job), folder, clock) for job in JOBS}
        return {job: run.result() for job, run in runs.items()}


# ---------------------------------------------------------------- what was built, and how
def values_of(path, pattern):
    return dict(re.findall(pattern, path.read_text(), re.MULTILINE)) if path.exists() else {}


def build_of(program):
    """One line that says what counts depend on besides the source; of a program outside its build folder: skipped."""
    cache = values_of(program.parent / "CMakeCache.txt", r"^((?:CMAKE|RAYTUBE)_\w+):\w+=(.*)$")
    compilers = sorted((program.parent / "CMakeFiles").glob("*/CMakeCXXCompiler.cmake"))
    if not cache or not compilers:
        leave(SKIPPED, f"{program} does not stand in its build folder, so that its compiler is not known")
    compiler = values_of(compilers[-1], r'^set\((CMAKE_CXX_COMPILER_\w+) "(.*)"\)$')
    kind = cache.get("CMAKE_BUILD_TYPE", "")
    options = " ".join(f"{cache.get('CMAKE_CXX_FLAGS', '')} {cache.get('CMAKE_CXX_FLAGS_' + kind.upper(), '')}".split())
    return (f"{compiler['CMAKE_CXX_COMPILER_ID']} {compiler['CMAKE_CXX_COMPILER_VERSION']}, {kind} {options}, "
            f"by room {cache.get('RAYTUBE_BY_ROOM', 'OFF')}, {' '.join(platform.libc_ver())}, {platform.machine()}")


def needed_build(program):
    if not os.access(program, os.X_OK):
        leave(BAD_INPUT, f"{program}: no such program; build it, or name it by --program")
    if not shutil.which("valgrind"):
        leave(SKIPPED, "valgrind is missing (package valgrind); nothing was counted")
    build = build_of(program)
    if ", Release " not in build or "-fsanitize" in build:
        leave(SKIPPED, f"counts are those of plain Release builds, this is: {build}")
    return build


# ---------------------------------------------------------------- the table
def read_table():
    """(build, instructions by job); of a table that is not there nothing."""
    if not TABLE.exists():
        return "", {}
    lines = TABLE.read_text().splitlines()
    build = next((line[len("# build: "):] for line in lines if line.startswith("# build: ")), "")
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return build, {row["job"]: int(row["instructions"]) for row in rows}


def write_table(build, counts):
    lines = ["# Instructions of each job. Written by: bench/cost/cost.py renew", f"# build: {build}",
             "job,instructions", *(f"{job},{count}" for job, count in counts.items())]
    TABLE.write_text("\n".join(lines) + "\n")


def percent(job, table, counts):
    return 100.0 * (counts[job] / table[job] - 1.0)


def show(table, counts):
    print(f"{'job':12} {'table':>15} {'now':>15} {'change':>9}")
    for job in JOBS:
        change = f"{percent(job, table, counts):+.2f} %" if job in table else "new"
        print(f"{job:12} {table.get(job, 0):15,} {counts[job]:15,} {change:>9}", flush=True)


def check(program):
    build, (table_build, table) = needed_build(program), read_table()
    if set(table) != set(JOBS):
        leave(BAD_INPUT, f"{TABLE} lists other jobs than there are; write it anew: bench/cost/cost.py renew")
    if build != table_build:
        leave(SKIPPED, f"the table was counted with another build ({table_build}) than this one ({build})")
    counts = measure(program)
    show(table, counts)
    changes = {job: percent(job, table, counts) for job in JOBS}
    for job in (job for job in JOBS if changes[job] < -MOST_PERCENT):
        print(f"cost.py: {job} costs {-changes[job]:.1f} % less than the table says; renew it, so that this stays: "
              "bench/cost/cost.py renew")
    dearer = [f"{job} costs {changes[job]:.1f} % more" for job in JOBS if changes[job] > MOST_PERCENT]
    if dearer:
        leave(FELL_SHORT, f"{', '.join(dearer)} instructions than bench/cost/table.csv says, {MOST_PERCENT:g} % are allowed. Make it "
              "cheaper; or, if it is worth its cost, renew the table in the commit that says why: bench/cost/cost.py renew")


def renew(program):
    build, (_, table) = needed_build(program), read_table()
    counts = measure(program)
    show(table, counts)
    write_table(build, counts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=["check", "renew"])
    parser.add_argument("--program", type=pathlib.Path, default=SOURCE / "build" / "raytube")
    options = parser.parse_args()
    {"check": check, "renew": renew}[options.action](options.program.resolve())


main()

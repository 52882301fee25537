#!/usr/bin/env python3
"""The same bytes on every system: cases against the hashes kept in hashes.csv, for several numbers of threads and instruction sets.

    tests/determinism/systems/systems.py check build/raytube [NAME ...]     exit 1 if a hash differs
    tests/determinism/systems/systems.py renew build/raytube                writes hashes.csv: on purpose, in the commit that says why

Hashed are rcs.csv and channels.csv. Also held: that the program calls no function of the C library whose last bit hangs on the version
of that library (src/math/special/elementary.h)."""
import argparse
import csv
import hashlib
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

from lumpy import lumpy

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
KEPT = HERE / "hashes.csv"
THREADS_AND_SETS = [(1, None), (2, "avx"), (7, "sse2"), (7, "sse4.2"), (2, "avx2")]  # None: the widest there is
# A case file, and what makes it a matter of a second.
CASES = {
    "plate": ("cases/plate/case.toml", []),
    "dihedral": ("cases/dihedral/case.toml", ["frequency.ghz=[15]"]),
    "interaction": ("bench/cost/between.toml", ["look.phi_deg=[20,27,40]", "edges.between_budget=20"]),
    "cylinder": ("cases/cylinder/case.toml", ["frequency.ghz=[2,5]", "look.theta_deg=[35,62,84]", "surfaces.waves=true"]),
    "almond": ("cases/almond/case.toml", ["frequency.ghz=[3.5]", "look.phi_deg=[0,130]"]),
    "truck": ("cases/haul_truck/case.toml", ["frequency.ghz=[3]", "look.phi_deg=[37]"]),
    "materials": ("bench/cost/materials.toml", ["frequency.ghz=[75,79]", "look.phi_deg=[31,45,58]"]),
    "solid": ("tests/determinism/systems/solid.toml", []),
    "near": ("bench/cost/near_field.toml", ["look.phi_deg=[5,13]"]),
    "ground": ("cases/box_on_ground/case.toml", ["look.theta_deg=[42,80]"]),
    "bistatic": ("cases/wing/case.toml", ["look.phi_deg=[25]", "receive.theta_deg=[80,90]", "receive.phi_deg=[25,70]"]),
    "lumpy": ("tests/determinism/systems/lumpy.toml", []),
}
# glibc 2.36, 2.41 and 2.43 round these differently. The gamma function is linked by the standard library's Bessel functions, which are asked
# where they do without (src/math/special/bessel.h); it and erfc serve `statistics`, whose tables show five digits.
UNSTEADY = {"acosh", "asinh", "atanh", "atan", "erf"}


def refuse(sentence):
    print(f"systems.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def case_file(name, scratch):
    """Where the case is: the random body is made beside its case file, in the scratch folder."""
    case = ROOT / CASES[name][0]
    if name != "lumpy":
        return case
    (scratch / "lumpy.off").write_text(lumpy(seed=2026))
    return pathlib.Path(shutil.copy(case, scratch))


def hashes(program, name, scratch, threads=1, instruction_set=None):
    out = scratch / "out"
    options = [word for setting in [*CASES[name][1], "output.plots=false"] for word in ("--set", setting)]
    if instruction_set:
        options += ["--instruction-set", instruction_set]
    command = [program, "run", case_file(name, scratch), "-o", out, "--quiet", "--threads", str(threads), *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    if done.returncode != 0:
        refuse(f"{name}: exit code {done.returncode}: {done.stderr}")
    found = [hashlib.sha256((out / table).read_bytes()).hexdigest() for table in ("rcs.csv", "channels.csv")]
    shutil.rmtree(out)
    return found


def differences(program, names, scratch, in_turn):
    with KEPT.open() as f:
        kept = {row["case"]: [row["rcs_csv"], row["channels_csv"]] for row in csv.DictReader(line for line in f if line[0] != "#")}
    for i, name in enumerate(names):
        for threads, instruction_set in [THREADS_AND_SETS[i % len(THREADS_AND_SETS)]] if in_turn else THREADS_AND_SETS:
            if hashes(program, name, scratch, threads, instruction_set) != kept.get(name):
                yield f"{name}: other bytes with {threads} threads, {instruction_set or 'the widest instruction set'}"


def unsteady_functions(program):
    if not shutil.which("nm"):
        return set()
    symbols = subprocess.run(["nm", "-D", "--undefined-only", program], capture_output=True, text=True, check=True).stdout
    return UNSTEADY & set(re.findall(r" U (\w+)", symbols))


def check(program, names, scratch, in_turn):
    system = f"{platform.freedesktop_os_release().get('PRETTY_NAME')}, {' '.join(platform.libc_ver())}"
    faults = [*differences(program, names, scratch, in_turn),
              *(f"{name}() is called: take that of src/math/special/elementary.h" for name in sorted(unsteady_functions(program)))]
    for fault in faults:
        print(f"systems.py: {fault}")
    print(f"systems.py: {len(names)} cases on {system}: {len(faults) or 'no'} faults")
    return 1 if faults else 0


def renew(program, scratch):
    lines = ["# SHA-256 of what each case writes. Written by: tests/determinism/systems/systems.py renew", "case,rcs_csv,channels_csv"]
    KEPT.write_text("\n".join(lines + [",".join([name, *hashes(program, name, scratch)]) for name in CASES]) + "\n")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["check", "renew"])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--in-turn", action="store_true", help="each case with one number of threads and instruction set, the next case with others")
    asked = parser.parse_args()
    for name in asked.names:
        if name not in CASES:
            refuse(f"{name}: no such case; choose among {', '.join(CASES)}")
    with tempfile.TemporaryDirectory() as folder:
        program, scratch = asked.program.resolve(), pathlib.Path(folder)
        if not program.is_file():
            refuse(f"{program}: no such program; build it first")
        sys.exit(renew(program, scratch) if asked.what == "renew" else check(program, asked.names or list(CASES), scratch, asked.in_turn))


if __name__ == "__main__":
    main()

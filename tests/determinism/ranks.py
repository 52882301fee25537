#!/usr/bin/env python3
"""The same bytes for any number of processes: by MPI, and by shards that are merged.

    tests/determinism/ranks.py build/raytube cases [--quick]

Five cases, as one process has them and then by 1, 2, 3 and 5 ranks with 1 and 2 threads each, and in one shard and in seven. Exit code 1
if any rcs.csv or rcs.nc differs; without mpirun the ranks are left out, and the exit code is 77 if nothing differs.
"""

import argparse
import hashlib
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from mpi_environment import MPI

CASES = {  # and what makes each a matter of seconds
    "plate": [], "dihedral": [], "trihedral": [], "powercube": ["look.phi_deg={start=0,stop=40,step=2}"],
    "sphere": ["frequency.ghz=[1,2]"]}
ALONE = os.environ | MPI


class Bench:
    def __init__(self, program, case, settings, folder):
        self.program, self.case, self.folder = program, case, folder
        self.settings = [word for setting in ["output.netcdf=true", "output.plots=false", *settings] for word in ("--set", setting)]
        self.wanted = self.hashes(self.run([], "one"))

    def call(self, command):
        done = subprocess.run(command, env=ALONE, capture_output=True, text=True, timeout=300)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}: {done.stderr}")

    def run(self, launcher, name, *options):
        out = self.folder / name
        self.call([*launcher, self.program, "run", self.case, "-o", out, "--quiet", *self.settings, *options])
        return out

    @staticmethod
    def hashes(out):
        return [hashlib.sha256((out / name).read_bytes()).hexdigest() for name in ("rcs.csv", "rcs.nc")]

    def ranks(self, count, threads):
        return self.hashes(self.run(["mpirun", "-n", str(count)], f"ranks_{count}_{threads}", "--threads", str(threads)))

    def shards(self, count):
        for index in range(count, 0, -1):
            out = self.run([], f"shards_{count}", "--shard", f"{index}/{count}")
        self.call([self.program, "merge", out, "--quiet"])
        return self.hashes(out)


def faults_of_launch(bench):
    """Ranks that were given different cases are refused; a shard without looks comes to its end."""
    # Not by "mpirun ... : ...": that of Open MPI 5.0.7 crashes there, whatever the programs.
    one = shlex.join(map(str, [bench.program, "run", bench.case, "-o", bench.folder / "mixed"]))
    mixed = ["mpirun", "-n", "2", "sh", "-c", f"[ $OMPI_COMM_WORLD_RANK = 0 ] && exec {one}; exec {one} --set frequency.ghz=9.125"]
    done = subprocess.run(mixed, env=ALONE, capture_output=True, text=True, timeout=60)
    if done.returncode != 2 or "was given frequency.ghz = 9.125 where rank 0 has" not in done.stderr:
        yield f"ranks of two cases: exit code {done.returncode}: {done.stderr}"
    bench.run(["mpirun", "-n", "2"], "empty", "--shard", "100000/100000")
    if not (bench.folder / "empty" / "shard_100000_of_100000.looks").exists():
        yield "an empty shard"


def differences(bench, with_mpi, quick):
    for count in (1, 7):
        if bench.shards(count) != bench.wanted:
            yield f"{count} shards"
    for count, threads in [(3, 2)] if quick else [(n, t) for n in (1, 2, 3, 5) for t in (1, 2)]:
        if with_mpi and bench.ranks(count, threads) != bench.wanted:
            yield f"{count} ranks of {threads} threads"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("cases", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="3 ranks of 2 threads alone")
    args = parser.parse_args()
    plugin = pathlib.Path(args.program).resolve().parent / "raytube_mpi.so"
    with_mpi = shutil.which("mpirun") is not None and plugin.exists()
    wrong = []
    for name, settings in CASES.items():
        with tempfile.TemporaryDirectory(prefix="raytube-ranks-") as scratch:
            bench = Bench(args.program, args.cases / name / "case.toml", settings, pathlib.Path(scratch))
            found = list(differences(bench, with_mpi, args.quick))
            found += faults_of_launch(bench) if with_mpi and name == "plate" else []
            print(f"{name}: rcs.csv {bench.wanted[0][:16]}, differs: {', '.join(found) or 'none'}")
            wrong += found
    sys.exit(1 if wrong else 0 if with_mpi else 77)


if __name__ == "__main__":
    main()

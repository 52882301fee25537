#!/usr/bin/env python3
"""Kills runs of a case at random moments, resumes them, and holds the results against those of a run that nobody touched.

    tests/stress/kill_and_resume.py build/raytube cases/powercube/case.toml [--kills 100] [--seed 1] [--signal KILL] [--ranks 3]
                                    [-- RUN OPTIONS]

A run is killed after a random time up to a little more than an untouched one takes, then resumed with another number of threads, perhaps
killed again, until one comes to its end; then its tables must be the same, byte for byte, and run.json but for times and memory. This goes
on until there were as many kills as wanted. Exit code 1 if anything differs. With --signal INT it also tells how long the program took
to end. With --ranks runs are jobs of up to so many processes by MPI, any one of which is killed; 77 where there is no MPI.
"""

import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from mpi_environment import MPI

HIDDEN = (".raytube.journal", ".raytube.lock")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("case")
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--signal", choices=["KILL", "INT", "TERM"], default="KILL")
    words = sys.argv[1:]
    end = words.index("--") if "--" in words else len(words)
    args = parser.parse_args(words[:end])
    args.options = words[end + 1:]  # of the run
    return args


def tables(folder):
    """What must not differ: every table, and run.json without times, threads and memory."""
    found = {path.name: path.read_bytes() for path in sorted(folder.iterdir()) if path.suffix in (".csv", ".vtu")}
    manifest = json.loads((folder / "run.json").read_text())
    for name in ("time", "peak_rss_bytes", "threads"):
        del manifest[name]
    found["run.json"] = json.dumps(manifest)
    return found


class Killer:
    def __init__(self, args, folder):
        self.args = args
        self.folder = folder
        self.random = random.Random(args.seed)
        self.kills = self.with_journal = self.finished = self.most_kills = 0
        self.longest_end = 0.0
        self.wrong = []

    def start(self, folder, *more):
        command = [self.args.program, "run", self.args.case, "-o", str(folder), "--quiet", "--parts", *more, *self.args.options]
        if self.args.ranks > 1:
            command = ["mpirun", "-n", str(self.random.randint(2, self.args.ranks)), *command]
        return subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env={**os.environ, **MPI})

    def kill(self, run):
        """The run, or one of its ranks: these are children of mpirun."""
        name = getattr(signal, "SIG" + self.args.signal)
        if self.args.ranks == 1:
            return run.send_signal(name)
        ranks = pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        if ranks:
            os.kill(int(self.random.choice(ranks)), name)

    def untouched(self):
        begin = time.monotonic()
        run = self.start(self.folder / "untouched")
        _, complaint = run.communicate()
        if run.returncode != 0:
            sys.exit(f"the run fails by itself: {complaint}")
        self.duration = time.monotonic() - begin
        self.wanted = tables(self.folder / "untouched")

    def killed(self, run):
        """Whether it was killed before it came to its end."""
        try:
            run.wait(self.random.uniform(0.0, 1.1 * self.duration))
        except subprocess.TimeoutExpired:
            begin = time.monotonic()
            self.kill(run)
            run.wait()
            self.longest_end = max(self.longest_end, time.monotonic() - begin)
        complaint = run.stderr.read()
        run.stderr.close()
        if run.returncode == 0:
            return False
        if self.args.ranks == 1 and run.returncode != (-9 if self.args.signal == "KILL" else 130):
            self.wrong.append(f"exit code {run.returncode}: {complaint}")
            return False
        return True

    def one(self):
        """A run with as many lives as it needs."""
        folder = self.folder / "killed"
        shutil.rmtree(folder, ignore_errors=True)
        kills = 0
        run = self.start(folder)
        while self.killed(run):
            kills += 1
            self.with_journal += (folder / HIDDEN[0]).exists()
            run = self.start(folder, "--resume", "--threads", str(self.random.choice([1, 2, 3])))
        self.kills += kills
        self.most_kills = max(self.most_kills, kills)
        self.finished += 1
        found = tables(folder) if (folder / "run.json").exists() else {}
        self.wrong += [f"{name} differs after {kills} kills" for name in self.wanted if found.get(name) != self.wanted[name]]
        self.wrong += [f"{name} is left" for name in HIDDEN if (folder / name).exists()]
        self.wrong += [f"{path.name} is left" for path in folder.glob(".*.part")]

    def report(self):
        print(f"{self.kills} kills (seed {self.args.seed}, signal {self.args.signal}) in {self.finished} runs of {self.duration:.1f} s, at most "
              f"{self.most_kills} in one; {self.with_journal} left a journal")
        if self.args.signal != "KILL":
            print(f"the program ended within {self.longest_end:.2f} s")
        for line in self.wrong:
            print(line)
        print(f"{len(self.wrong)} differences")


def main():
    args = arguments()
    if args.ranks > 1 and not (shutil.which("mpirun") and (pathlib.Path(args.program).parent / "raytube_mpi.so").exists()):
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="raytube-kill-") as scratch:
        killer = Killer(args, pathlib.Path(scratch))
        killer.untouched()
        while killer.kills < args.kills and not killer.wrong:
            killer.one()
        killer.report()
        sys.exit(1 if killer.wrong else 0)


if __name__ == "__main__":
    main()

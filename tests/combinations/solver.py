"""Runs of raytube on cases of the scene, each case once."""

import copy
import csv
import json
import os
import pathlib
import subprocess
import sys
import threading

import scene

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from mpi_environment import MPI

ALONE = os.environ | MPI


class Refused(Exception):
    """raytube has said no, in this sentence."""


def table(file):
    with open(file) as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


def complex_of(row, names):
    return [complex(float(row["re_" + name]), float(row["im_" + name])) for name in names]


CHANNELS = ("vv", "vh", "hv", "hh")


class Solver:
    def __init__(self, program, folder):
        self.program, self.folder, self.known = program, pathlib.Path(folder), {}
        self.lock, self.locks, self.extra = threading.Lock(), {}, ()
        scene.write_meshes(self.folder)

    def with_options(self, options):
        """The same, with these options on every run."""
        other = copy.copy(self)
        other.extra = options
        return other

    def call(self, *words, launcher=()):
        done = subprocess.run([*launcher, self.program, *map(str, words)], env=ALONE, capture_output=True, text=True, timeout=120)
        if done.returncode == 2:
            raise Refused(done.stderr)
        if done.returncode != 0:
            raise RuntimeError(f"exit code {done.returncode}: {done.stderr}")
        return done.stdout

    def case(self, settings):
        """The case file of these settings, and the folder for what is made of it."""
        text = scene.case_text(settings)
        with self.lock:
            if text not in self.known:
                self.known[text] = self.folder / f"{len(self.known)}.toml"
                self.known[text].write_text(text)
        return self.known[text], self.known[text].with_suffix("")

    def run(self, settings, *options, launcher=(), name="run"):
        """The folder of results."""
        case, place = self.case(settings)
        options = (*options, *(option for option in self.extra if option not in options))
        out = place / "_".join([name, *options])
        with self.lock:
            turn = self.locks.setdefault(out, threading.Lock())
        with turn:
            if (out / "rcs.csv").exists():
                return out
            self.call("run", case, "-o", out, "--quiet", "--threads", 1, *options, launcher=launcher)
        return out

    def s(self, settings):
        """S of every row, four channels each [m]."""
        return [complex_of(row, CHANNELS) for row in table(self.run(settings) / "rcs.csv")]

    def without(self, settings, key):
        """Why the mechanism of this key takes no part, as run.json has it; empty if it does."""
        mechanisms = json.loads((self.run(settings) / "run.json").read_text())["counts"]["mechanisms"]
        return next(m["why_not"] for m in mechanisms if m["key"] == key)


def difference(one, other):
    """The largest of S over the largest of `other`."""
    flat = [abs(b) for row in other for b in row]
    return max((abs(a - b) for x, y in zip(one, other, strict=True) for a, b in zip(x, y)), default=0.0) / max(max(flat), 1e-300)

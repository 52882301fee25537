"""Runs of the program and the tables it leaves."""
import csv
import json
import math
import pathlib
import shutil
import subprocess

CASES = pathlib.Path(__file__).resolve().parent.parent


class Failed(Exception):
    """The program ended with an error, which it has told in its own words."""


class Program:
    def __init__(self, path, work):
        self.path, self.work, self.warnings = path, work, []

    def __call__(self, command, case, name, *options):
        """Runs `raytube COMMAND cases/CASE.toml`; returns the folder of results. What it warns of is kept, each sentence once."""
        folder = self.work / name
        done = subprocess.run([self.path, command, CASES / f"{case}.toml", "-o", folder, "--quiet", *options], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True)
        if done.returncode:
            raise Failed(f"raytube {command} cases/{case}.toml ended with exit code {done.returncode}: {done.stderr.strip()}")
        said = [line.removeprefix("raytube: ") for line in done.stderr.splitlines()]
        self.warnings += [line for line in said if line not in self.warnings]
        return folder

    def keep(self, picture, name):
        """A picture that raytube drew, under the name it has beside the page."""
        if picture.exists():
            shutil.copy(picture, self.work / f"{name}.png")
        return self.work / f"{name}.png"


def table(file):
    with open(file) as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def published(case, quantity):
    """{(source, rays): value} of published.csv, as written there."""
    rows = table(CASES / "papers" / "published.csv")
    return {(r["source"], r["rays"]): r["value"] for r in rows if (r["case"], r["quantity"]) == (case, quantity)}


def manifest(folder):
    return json.loads((folder / "run.json").read_text())


def dbsm(amplitude):
    """σ = 4π |S|²."""
    return 10 * math.log10(4 * math.pi * max(abs(amplitude), 1e-30)**2)


class Result:
    """Rows of a rcs.csv, or of a reference.csv, which has no errors."""

    def __init__(self, file):
        self.rows = table(file)
        self.phi = [float(r["phi_deg"]) for r in self.rows]
        self.s = {c: [complex(float(r[f"re_{c}"]), float(r[f"im_{c}"])) for r in self.rows] for c in ("vv", "hh")}
        self.sigma = {c: [dbsm(s) for s in values] for c, values in self.s.items()}

    def column(self, name, channel):
        """err or model, in dB."""
        return [float(r[f"{name}_{channel}_db"]) for r in self.rows]

    def near_peak(self, name, channel, within_db):
        """The same, of the rows at most so far below the channel's peak, in order of size."""
        least = max(self.sigma[channel]) - within_db
        return sorted(x for x, level in zip(self.column(name, channel), self.sigma[channel]) if level >= least)


def relative_error(result, reference):
    """Of complex S, VV and HH together."""
    pairs = [pair for c in ("vv", "hh") for pair in zip(result.s[c], reference.s[c])]
    return math.sqrt(sum(abs(a - b)**2 for a, b in pairs) / sum(abs(b)**2 for _, b in pairs))

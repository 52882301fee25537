#!/usr/bin/env python3
"""Fits constants of src/uncertainty/constants.h, on references of our own that do not judge them.

    bench/calibrate_uncertainty.py [--data tests/data/mom] [--program build/raytube]

A constant multiplies one part of the model uncertainty. It is run where that part is most of all that is missing, and set so that
SHARE of the rows are covered: of every row in which the part is more than half of the squares that are told, how many times as
large it would have to be for both estimates together to be the true error of |S|, all else as it is; then the quantile over the
rows, every body as heavy as any other. Bodies: plates of 1 to 3.6 wavelengths and a cube by the method of moments (DATA, as
tests/data/mom), spheres by Mie's series. bench/model_uncertainty.py judges, on others: plate3, dihedral3, prism30, wing3, and the
curves of the Austin suite."""
import argparse
import collections
import math
import pathlib
import sys
import tempfile

import model_uncertainty as judge

SHARE = 0.9

# `name` in constants.h is `value` now; it multiplies `part`, run with the keys `sets` on the bodies whose group is in `groups`
Constant = collections.namedtuple("Constant", "name value part sets groups")
PLATES, SPHERES = ("cube2", "plate sizes"), ("spheres, ka 5 to 50",)
CONSTANTS = [
    Constant("corner_amplitude", 0.06, "corners", [], PLATES),
    Constant("corner_amplitude * untruncated_corners", 0.09, "corners", ["edges.order=1"], PLATES),
    Constant("second_order", 0.5, "edge_orders", ["edges.order=1"], PLATES),
    Constant("edge_amplitude", 1.2, "edges", ["edges.method=\"none\""], PLATES),
    Constant("boundary_amplitude", 2.5, "smooth_surfaces", ["surfaces.waves=false"], SPHERES),
    Constant("wave_error", 0.15, "smooth_surfaces", ["surfaces.waves=true"], SPHERES),
]


def needed(cut, rows, parts, part):
    """How many times as large `part` would have to be, of the rows and channels that it decides."""
    peak = max(level for row in cut.reference for level in (row[0], row[3]) if level is not None)
    found = []
    for row, split, reference in zip(rows, parts, cut.reference):
        amplitudes = {c: math.hypot(float(row[f"re_{c}"]), float(row[f"im_{c}"])) for c in judge.CHANNELS}
        least = 0.01 * max(amplitudes.values())
        for channel, level in zip(judge.CHANNELS, reference):
            names = [key for key in split if key.startswith("model_") and key.endswith(f"_{channel}_m")]
            squares = {key: float(split[key]) ** 2 for key in names}
            one = squares.get(f"model_{part}_{channel}_m", 0.0)
            if level is None or level <= peak - judge.RANGE_DB or one <= 0.5 * sum(squares.values()):
                continue
            missing = amplitudes[channel] - 10.0 ** ((level - judge.LEVEL) / 20.0)
            numerical = (10.0 ** (float(row[f"err_{channel}_db"]) / 20.0) - 1.0) * max(amplitudes[channel], least)
            found.append(math.sqrt(max(0.0, missing ** 2 - numerical ** 2 - sum(squares.values()) + one) / one))
    return found


def quantile(groups, share):
    """Of all values, each group as heavy as any other."""
    weighted = sorted((value, 1.0 / len(values)) for values in groups if values for value in values)
    limit, below = share * sum(weight for _, weight in weighted), 0.0
    for value, weight in weighted:
        below += weight
        if below >= limit:
            return value
    return math.nan


def fit(constant, cuts, work, options):
    groups = collections.defaultdict(list)
    for cut in cuts:
        if cut.group not in constant.groups:
            continue
        rows = judge.run(cut, work, argparse.Namespace(program=options.program, set=constant.sets), ["--parts"])
        groups[cut.group] += needed(cut, rows, judge.read_rows(work / "out" / "parts.csv"), constant.part)
    return quantile(groups.values(), SHARE), sum(map(len, groups.values()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path(__file__).parents[1] / "tests/data/mom")
    parser.add_argument("--program", default="build/raytube")
    options = parser.parse_args()
    print("| constant | is | rows | would cover 90 % |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        cuts = [*judge.moment_cuts(options.data, work), *judge.sphere_cuts(work)]
        for constant in CONSTANTS:
            factor, rows = fit(constant, cuts, work, options)
            print(f"| {constant.name} | {constant.value} | {rows} | {constant.value * factor:.2g} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Compares a result with a reference, row by row (standard library only).

    python3 cases/compare.py cases/plate/out/rcs.csv cases/plate/reference.csv
    python3 cases/compare.py --within 20 --only phi_deg -45 45 rcs.csv tests/data/mom/dihedral3.csv --cut az_th90

Prints for each co-polar channel the error in dB (at the reference's peak, rms, median, 95th percentile, largest) over the rows whose
reference is within --within dB of its own peak, and the complex error ||S - S_ref|| / ||S_ref|| over all rows compared."""
import argparse
import csv
import math


def read(path, cut=None):
    with open(path, newline="") as f:
        rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
    return [r for r in rows if cut is None or r["cut"] == cut]


def amplitude(row, channel):
    return complex(float(row["re_" + channel]), float(row["im_" + channel]))


def receiver(row):
    """The MoM tables hold the receiver in theta_deg, phi_deg; rcs.csv in rx_*."""
    return tuple(float(row.get("rx_" + key) or row[key]) for key in ("theta_deg", "phi_deg"))


def decibels(x):
    return 20 * math.log10(abs(x)) if x else -math.inf


def quantile(values, q):
    return sorted(values)[int(q * (len(values) - 1))]


def report(channel, pairs, within_db):
    peak = max(pairs, key=lambda p: abs(p[1]))
    errors = [abs(decibels(s) - decibels(ref)) for s, ref in pairs if decibels(ref) >= decibels(peak[1]) - within_db]
    relative = math.sqrt(sum(abs(s - ref) ** 2 for s, ref in pairs) / sum(abs(ref) ** 2 for _, ref in pairs))
    rms = math.sqrt(sum(e * e for e in errors) / len(errors))
    print(f"{channel}: {len(errors):4d} of {len(pairs)} rows; dB error at peak {decibels(peak[0]) - decibels(peak[1]):+.2g}, rms {rms:.2g}, "
          f"median {quantile(errors, 0.5):.2g}, 95 % {quantile(errors, 0.95):.2g}, largest {max(errors):.2g}; relative error of S {relative:.2g}")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("result")
    p.add_argument("reference")
    p.add_argument("--within", type=float, default=40.0, metavar="DB", help="rows whose reference is this close to its peak (default 40)")
    p.add_argument("--only", nargs=3, metavar=("COLUMN", "LOW", "HIGH"), help="rows of the result whose column lies in this range")
    p.add_argument("--cut", help="rows of the reference whose column 'cut' holds this")
    a = p.parse_args()
    result, reference = read(a.result), read(a.reference, a.cut)
    if len(result) != len(reference):
        raise SystemExit(f"{len(result)} rows against {len(reference)}: not the same sweep")
    for r, ref in zip(result, reference):
        if any(abs(x - y) > 1e-6 for x, y in zip(receiver(r), receiver(ref))):
            raise SystemExit(f"directions differ: {receiver(r)} against {receiver(ref)}")
    rows = list(zip(result, reference))
    if a.only:
        column, low, high = a.only[0], float(a.only[1]), float(a.only[2])
        rows = [(r, ref) for r, ref in rows if low - 1e-9 <= float(r[column]) <= high + 1e-9]
    for channel in ("vv", "hh"):
        report(channel.upper(), [(amplitude(r, channel), amplitude(ref, channel)) for r, ref in rows], a.within)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Every feature with every other, on a small scene."""

import argparse
import sys
import tempfile

from features import PHYSICS
from products import PRODUCTS
from scene import BASE
from solver import Refused, Solver


def together(one, other):
    settings = {**BASE, **one.settings, **other.settings}
    meshes = [f.settings.get("target.mesh", []) for f in (one, other)]
    if any("ball.obj" in m for m in meshes) and any("window.obj" in m for m in meshes):
        settings["target.mesh"] = ["ball.obj", "window.obj"]
    if "receive.theta_deg" in settings and "radar.range_m" in settings:
        settings["radar.receive_range_m"] = 4.0
    return settings


def outcome(solver, one, other):
    settings = together(one, other)
    found = []
    for feature in ([one, other] if other not in PRODUCTS else [other]):
        try:
            wrong = feature.check(solver, settings)
        except Refused as refused:
            return f"no: {str(refused).strip().splitlines()[-1]}"
        except Exception as e:
            wrong = f"{type(e).__name__}: {str(e)[-300:]}"
        if wrong:
            found.append(f"{feature.name}: {wrong}")
    return "; ".join(found) or "yes"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="raytube-combinations-") as folder:
        solver = Solver(args.program, folder)
        for i, one in enumerate(PHYSICS):
            for other in [*PHYSICS[i:], *PRODUCTS]:
                if set(one.keys) & set(other.keys) and one is not other:
                    continue
                if args.only and args.only not in (one.name, other.name):
                    continue
                print(f"{one.name:16} {other.name:16} {outcome(solver, one, other)}", flush=True)


if __name__ == "__main__":
    sys.exit(main())

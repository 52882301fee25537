#!/usr/bin/env python3
"""Time and memory of edge-face interaction with its budget, and how well `raytube check` predicts them.

    bench/interaction_budget.py PROGRAM MESH... [--ghz 3 10] [--looks 6] [--unit m] [--threads 1]

Each mesh is solved with and without `edges.between`; a line says the seconds of each, their ratio, the peak of memory over
what `check` says, and the time over what `check` says. The constants of src/utd/wedge/work.h were fitted to such lines: those of
tubes and edges to the seconds without, those of the interaction to the difference.
"""
import argparse
import json
import os
import re
import subprocess
import tempfile

UNITS = {"s": 1.0, "min": 60.0, "h": 3600.0, "MB": 1e6, "GB": 1e9}


def case_text(mesh, ghz, looks, unit):
    return (f'[target]\nmesh = "{os.path.abspath(mesh)}"\nunit = "{unit}"\n[frequency]\nghz = {ghz}\n'
            f'[look]\ntheta_deg = 80\nphi_deg = {{start = 3, stop = 353, step = {350 / max(looks - 1, 1)}}}\n')


def run(program, case, folder, between, threads, limit):
    """solve_s, wedges' work and peak memory [bytes] of a run; none if it took too long."""
    out = os.path.join(folder, "out")
    command = ["/usr/bin/time", "-f", "%M %U", "timeout", str(limit), program, "run", case, "--quiet", "--threads", str(threads),
               "--set", "output.plots=false", "--set", f"edges.between={between}", "-o", out]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        return None
    kilobytes, user = done.stderr.split()[-2:]
    with open(os.path.join(out, "run.json")) as file:
        manifest = json.load(file)
    subprocess.run(["rm", "-r", out], check=True)
    return manifest["time"]["solve_s"], float(kilobytes) * 1024, float(user)


def predicted(program, case):
    """Seconds and bytes that check says."""
    text = subprocess.run([program, "check", case], capture_output=True, text=True).stdout
    time = re.search(r"\ntime\n  (?:about|more than) ([\d.e+-]+) (s|min|h)\b", text)
    memory = re.search(r"at most about ([\d.e+-]+) (MB|GB)", text)
    return [float(m.group(1)) * UNITS[m.group(2)] if m else float("nan") for m in (time, memory)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--ghz", nargs="+", type=float, default=[3.0, 10.0])
    parser.add_argument("--looks", type=int, default=6)
    parser.add_argument("--unit", default="m")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds a run may take")
    args = parser.parse_args()
    print("mesh                     GHz   without s     with s  ratio  peak MB  /check  time/check")
    for mesh in args.meshes:
        for ghz in args.ghz:
            with tempfile.TemporaryDirectory() as folder:
                case = os.path.join(folder, "case.toml")
                with open(case, "w") as file:
                    file.write(case_text(mesh, ghz, args.looks, args.unit))
                without = run(args.program, case, folder, "false", args.threads, args.limit)
                full = run(args.program, case, folder, "true", args.threads, args.limit)
                seconds, memory = predicted(args.program, case)
                name = os.path.basename(mesh)[:24]
                if not without or not full:
                    print(f"{name:24} {ghz:4g}  not done in {args.limit} s: {without} {full}", flush=True)
                    continue
                print(f"{name:24} {ghz:4g} {without[0]:11.4f} {full[0]:10.4f} {full[0] / without[0]:6.2f} {full[1] / 1e6:8.1f} "
                      f"{full[1] / memory:7.2f} {full[0] / seconds:11.2f}", flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Runs raytube_test.m in Octave on results that the program writes now.

    run.py PROGRAM      exit code 77 where Octave or its package netcdf is missing; pictures need the font it draws with, too
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MESH = "OFF\n4 2 0\n0 0 0\n90 0 0\n90 60 0\n0 60 0\n3 0 1 2\n3 0 2 3\n"
CASE = """[target]
mesh = "plate.off"
unit = "mm"
[frequency]
ghz = 9.0
[look]
theta_deg = 10.0
phi_deg = [0, 5, 10]
"""
WISHES = {"far": ["frequency.ghz=[9,10]"],
          "near": ["receive.theta_deg=20", "receive.phi_deg=30", "radar.range_m=3", "radar.receive_range_m=4", "edges.method=none"]}
NO_FONT = "unable to load"  # Octave's default font is no dependency of it


def octave(*arguments, **options):
    return subprocess.run(["octave-cli", "--quiet", "--no-init-file", *arguments], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **options)


def skip(what):
    print(f"SKIPPED: there is no {what}")
    sys.exit(77)


def make_results(program, folder):
    (folder / "plate.off").write_text(MESH)
    (folder / "case.toml").write_text(CASE)
    for name, wishes in WISHES.items():
        settings = [word for wish in wishes for word in ("--set", wish)]
        subprocess.run([program, "run", "case.toml", "-o", name, "--parts", "--quiet", "--set", "output.netcdf=true", "--set",
                        "output.plots=false", *settings], cwd=folder, check=True)
    lines = (folder / "far/rcs.csv").read_text().splitlines(keepends=True)
    (folder / "rows.csv").write_text("".join(line for line in lines if not line.startswith("#")))


def main():
    program = Path(sys.argv[1]).resolve()
    if not shutil.which("octave-cli"):
        skip("octave-cli")
    if octave("--eval", "pkg load netcdf").returncode != 0:
        skip("package netcdf of Octave (octave-netcdf)")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make_results(program, folder)
        done = octave("--path", str(ROOT / "matlab"), "--path", str(ROOT / "tests/matlab"), "--eval", "raytube_test", cwd=folder)
        print(done.stdout)
        words = done.stdout.splitlines()
        if "read" in words and "drawn" not in words and NO_FONT in done.stdout:
            print("pictures SKIPPED: there is no font (fonts-freefont-otf)")
        elif done.returncode != 0 or "drawn" not in words:
            sys.exit(f"exit code {done.returncode}")
        else:
            for picture in ("lines.svg", "map.svg"):
                if "</svg>" not in (folder / picture).read_text(errors="replace"):
                    sys.exit(f"{picture} is no picture")


if __name__ == "__main__":
    main()

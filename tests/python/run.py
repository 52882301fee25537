#!/usr/bin/env python3
"""Runs tests of the Python package against a build tree, by a Python that has all they need.

    run.py FOLDER PROGRAM [pytest's arguments]     FOLDER holds the package, PROGRAM is raytube; exit code 77 where something is missing
"""
import os
import subprocess
import sys

NEEDED = "import raytube, pytest, xarray, pandas"


def main():
    folder, program, *arguments = sys.argv[1:]
    environment = os.environ | {"PYTHONPATH": folder, "RAYTUBE_PROGRAM": program, "PYTHONDONTWRITEBYTECODE": "1"}
    # Debian's packages are for Debian's own Python, which need not be the first one on the path.
    for python in (sys.executable, "/usr/bin/python3"):
        if os.path.exists(python) and subprocess.run([python, "-c", NEEDED], env=environment, capture_output=True).returncode == 0:
            return subprocess.run([python, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments], env=environment).returncode
    print(f"SKIPPED: no Python here can do: {NEEDED}")
    return 77


if __name__ == "__main__":
    sys.exit(main())

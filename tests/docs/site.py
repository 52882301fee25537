#!/usr/bin/env python3
"""The site builds without a warning, and every address in it leads somewhere. 77 where what it is built with is missing.

    site.py FOLDER PYTHON DRAWN       where it is built; the folder that holds the package raytube; that of the examples that have been run
"""
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
from check_site import faults  # noqa: E402

BUILD = Path(__file__).resolve().parents[2] / "docs/site/build.py"


def main():
    built = subprocess.run([BUILD, *sys.argv[1:]]).returncode
    if built:
        return built
    found = list(faults(Path(sys.argv[1], "html")))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""`pip install` of the module that is built, into a scratch folder: pip_test.py BUILD SOURCE SCRATCH    exit 77 (skipped) without pip

To be run by the Python that the module was built for. What is tried besides: nothing comes from the network, nothing is left in the
sources, and the version is that of CMakeLists.txt. packaging/try_pip builds the module as well, which takes minutes."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
USE = """
import sys
from importlib.metadata import version
from pathlib import Path
import raytube
plate = raytube.Target([[0, 0, 0], [.3, 0, 0], [.3, .3, 0], [0, .3, 0]], [[0, 1, 2, 3]], unit="m")
result = raytube.solve(plate, ghz=10.0, looks=raytube.monostatic(theta_deg=0, phi_deg=0))
assert result.S.shape == (1, 1, 2, 2)
assert (Path(raytube.__file__).parent / "py.typed").exists()
assert (Path(raytube.__file__).parent / "raytube_mpi.so").exists() == (sys.argv[1] == "mpi")
print(raytube.__version__, version("raytube"), Path(raytube.__file__).parent.parent)
"""


def run(*command, **variables):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, env={**os.environ, **variables})
    if done.returncode:
        sys.exit(f"failed ({done.returncode}): {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def pip(*arguments, build):
    run(sys.executable, "-m", "pip", *arguments, "--no-index", "--disable-pip-version-check", RAYTUBE_BUILD=str(build))


def check_no_trace(source):
    left = [str(path) for path in [*source.glob("*.egg-info"), *source.glob("build/lib*"), *source.glob("python/raytube/_core*.so")]]
    assert not left, f"pip left in the sources: {left}"


def main(build, source, scratch):
    if not importlib.util.find_spec("pip"):
        return SKIPPED
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    pip("install", "--no-deps", "--target", scratch / "package", source, build=build)  # a --target has none of the dependencies
    check_no_trace(source)
    wanted = re.search(r"^project\(raytube VERSION (\S+)", (source / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
    mpi = "mpi" if (build / "raytube_mpi.so").exists() else "no mpi"
    said = run(sys.executable, "-c", USE, mpi, PYTHONPATH=str(scratch / "package")).split()
    assert said == [wanted, wanted, str(scratch / "package")], said
    return 0


if __name__ == "__main__":
    sys.exit(main(*(Path(argument).resolve() for argument in sys.argv[1:4])))

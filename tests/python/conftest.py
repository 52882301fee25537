"""What the tests of the package share. They run against whatever `import raytube` finds: a build tree or an installed package."""
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import raytube as rt

CASES = Path(__file__).resolve().parents[2] / "cases"
SQUARE = [[0, 0, 0], [0.3, 0, 0], [0.3, 0.3, 0], [0, 0.3, 0]]


@pytest.fixture(scope="session")
def program():
    """The program, called with arguments: what it prints. No test looks at its pictures, so it finds no Python to draw them, but `with_python`."""
    found = os.environ.get("RAYTUBE_PROGRAM") or shutil.which("raytube")
    if not found:
        pytest.skip("there is no program raytube to compare with; name it in RAYTUBE_PROGRAM")

    def call(*arguments, with_python=False):
        environment = os.environ if with_python else os.environ | {"RAYTUBE_PYTHON": "false"}
        return subprocess.run([found, *map(str, arguments)], env=environment, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout

    return call


@pytest.fixture(scope="session")
def plate():
    return rt.Target(SQUARE, [[0, 1, 2, 3]], unit="m", parts=["plate"])


@pytest.fixture(scope="session")
def dihedral():
    return rt.Target.load(CASES / "dihedral/dihedral.off", unit="mm")


@pytest.fixture(scope="session")
def sphere():
    return rt.Target.load(CASES / "sphere/sphere.ply", unit="m")


@pytest.fixture(scope="session")
def sweep(dihedral):
    """Looks and frequencies, with parts."""
    looks = rt.monostatic(theta_deg=[80, 90], phi_deg=np.arange(0, 46, 15))
    return rt.solve(dihedral, [9.0, 10.0, 11.0], looks, edges={"order": 1}, title="dihedral", keep_mechanisms=True)

"""The package raytube for Python: pip install .     CMake builds its module; see docs/guide/install.md.

RAYTUBE_BUILD=FOLDER takes the module from a build that is there, brought up to date first, and builds nothing else."""
import atexit
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
# What else could be built is left out; without pybind11 or the headers of Python CMake stops in words.
CMAKE_OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}", "-DRAYTUBE_PYTHON=REQUIRED",
                 "-DRAYTUBE_TESTS=OFF", "-DRAYTUBE_BENCH=OFF", "-DRAYTUBE_INSTALL=OFF"]


def version():
    return re.search(r"^project\(raytube VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def cmake(*arguments, remedy="what it said stands above"):
    try:
        subprocess.run(["cmake", *arguments], check=True)
    except FileNotFoundError:
        sys.exit("raytube is built by CMake, which is not here: install the packages that docs/guide/install.md lists for pip")
    except subprocess.CalledProcessError as failure:
        sys.exit(f"cmake ended with {failure.returncode}; {remedy}")


class BuildByCMake(build_ext):
    """Builds raytube._core, and its plugin, where setuptools wants them."""

    def build_extension(self, extension):
        wanted = Path(self.get_ext_fullpath(extension.name)).resolve()
        built = self.build_folder() / "python" / "raytube" / wanted.name
        if not built.exists():
            sys.exit(f"{built.parent} has no {wanted.name}: it was built for another Python than {sys.executable}; unset RAYTUBE_BUILD")
        wanted.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, wanted)
        plugin = built.with_name("raytube_mpi.so")  # of builds where MPI is there; nothing needs it but comm=
        if plugin.exists():
            shutil.copy2(plugin, wanted.parent)

    def build_folder(self):
        build = ("--build", os.environ.get("RAYTUBE_BUILD") or Path(self.build_temp).resolve(), "--target", "raytube_python")
        if os.environ.get("RAYTUBE_BUILD"):
            cmake(*build, remedy=f"configure the build for Python: cmake {build[1]} -DRAYTUBE_PYTHON=REQUIRED")
        else:
            cmake("-S", ROOT, "-B", build[1], "-G", "Ninja", *CMAKE_OPTIONS)
            cmake(*build)
        return Path(build[1])


def temporary_folder():
    folder = tempfile.mkdtemp(prefix="raytube-pip-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


# setuptools would build in build/, which is CMake's here, and leave raytube.egg-info in the sources.
scratch = temporary_folder()
setup(version=version(), ext_modules=[Extension("raytube._core", sources=[])], cmdclass={"build_ext": BuildByCMake},
      options={"build": {"build_base": scratch}, "egg_info": {"egg_base": scratch}})

"""What pip calls to make a wheel or an archive of the sources (PEP 517), named in pyproject.toml. CMake builds the module.

It takes Python's standard library only, so that pip has nothing to fetch for it: the same with network and without, in an environment of
pip's own or not. RAYTUBE_BUILD=FOLDER takes the module from a build that is there, brought up to date first, and builds nothing else."""
import base64
import hashlib
import io
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCRIPTS = ROOT / "python" / "raytube"
# What else could be built is left out; without pybind11 or the headers of Python CMake stops in words.
CMAKE_OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}", "-DRAYTUBE_PYTHON=REQUIRED",
                 "-DRAYTUBE_TESTS=OFF", "-DRAYTUBE_BENCH=OFF", "-DRAYTUBE_INSTALL=OFF"]
SOURCES = ["pyproject.toml", "CMakeLists.txt", "LICENSE", "README.md", "CITATION.cff", "CHANGELOG.md", "src", "cmake", "python",
           "docs/site/CMakeLists.txt", "packaging/build_backend.py"]  # what CMake builds the module from
EXECUTABLE = 0o100755
FILE = 0o100644


def project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def version():
    return re.search(r"^project\(raytube VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def metadata(licences):
    """The text of METADATA; `licences` are names below the folder licenses/."""
    about = project()
    lines = ["Metadata-Version: 2.4", f"Name: {about['name']}", f"Version: {version()}", f"Summary: {about['description']}",
             f"Author: {about['authors'][0]['name']}", f"License-Expression: {about['license']}",
             *(f"License-File: {name}" for name in licences), *(f"Classifier: {text}" for text in about["classifiers"]),
             f"Requires-Python: {about['requires-python']}", *(f"Requires-Dist: {name}" for name in about["dependencies"])]
    for extra, names in about["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f"Requires-Dist: {name}; extra == '{extra}'" for name in names)]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (ROOT / about["readme"]).read_text()])


def tags(platform):
    abi = sysconfig.get_config_var("SOABI").split("-")[1]
    return f"cp{sys.version_info.major}{sys.version_info.minor}-cp{abi}-{platform}"


def cmake(*arguments, remedy="what it said stands above"):
    try:
        subprocess.run(["cmake", *arguments], check=True)
    except FileNotFoundError:
        sys.exit("raytube is built by CMake, which is not here: install the packages that docs/guide/install.md lists for pip")
    except subprocess.CalledProcessError as failure:
        sys.exit(f"cmake ended with {failure.returncode}; {remedy}")


def built_package(scratch):
    """The folder of the package in a build, which is in folder `scratch` unless RAYTUBE_BUILD names one."""
    build = os.environ.get("RAYTUBE_BUILD")
    if not build:
        cmake("-S", ROOT, "-B", scratch, "-G", "Ninja", *CMAKE_OPTIONS)
    cmake("--build", build or scratch, "--target", "raytube_python",
          remedy=f"configure the build for Python: cmake {build} -DRAYTUBE_PYTHON=REQUIRED" if build else "what it said stands above")
    return Path(build or scratch).resolve() / "python" / "raytube"


def package_files(package):
    """Contents by name of what a wheel holds beside its metadata. The plugin is of builds where MPI is there; only comm= asks for it."""
    modules = [package / f"{name}{sysconfig.get_config_var('EXT_SUFFIX')}" for name in ("_core", "_processor")]
    for module in modules:
        if not module.exists():
            sys.exit(f"{package} has no {module.name}: it was built for another Python than {sys.executable}; unset RAYTUBE_BUILD")
    scripts = [path for path in SCRIPTS.rglob("*") if path.suffix in (".py", ".pyi", ".typed", ".html", ".css", ".js")]
    files = {f"raytube/{path.relative_to(SCRIPTS).as_posix()}": path for path in scripts}
    files |= {f"raytube/{path.name}": path for path in [*modules, package / "raytube_mpi.so"]}
    return {name: path.read_bytes() for name, path in files.items() if path.exists()}


def write_wheel(folder, files, platform, licences):
    """Writes the wheel and returns its name. Equal contents give equal bytes."""
    about = f"raytube-{version()}.dist-info"
    files = files | {f"{about}/licenses/{name}": text for name, text in licences.items()} | {
        f"{about}/METADATA": metadata(sorted(licences)).encode(),
        f"{about}/WHEEL": f"Wheel-Version: 1.0\nGenerator: raytube\nRoot-Is-Purelib: false\nTag: {tags(platform)}\n".encode()}
    record = "".join(f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"
                     for name, data in sorted(files.items()))
    name = f"raytube-{version()}-{tags(platform)}.whl"
    with zipfile.ZipFile(Path(folder) / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in [*sorted(files.items()), (f"{about}/RECORD", (record + f"{about}/RECORD,,\n").encode())]:
            entry = zipfile.ZipInfo(path)  # of 1980: the time of no build
            entry.external_attr = (EXECUTABLE if ".so" in path else FILE) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return name


def own_licences():
    return {name: (ROOT / name).read_bytes() for name in project()["license-files"]}


# What PEP 517 names.


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory(prefix="raytube-pip-") as scratch:
        files = package_files(built_package(scratch))
    return write_wheel(wheel_directory, files, sysconfig.get_platform().replace("-", "_"), own_licences())


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = Path(metadata_directory) / f"raytube-{version()}.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(metadata(sorted(own_licences())))
    return folder.name


def build_sdist(sdist_directory, config_settings=None):
    top = f"raytube-{version()}"
    text = metadata(sorted(own_licences())).encode()
    with tarfile.open(Path(sdist_directory) / f"{top}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for name in SOURCES:
            archive.add(ROOT / name, f"{top}/{name}", filter=lambda entry: None if "__pycache__" in entry.name else entry)
        entry = tarfile.TarInfo(f"{top}/PKG-INFO")
        entry.size = len(text)
        archive.addfile(entry, io.BytesIO(text))
    return f"{top}.tar.gz"

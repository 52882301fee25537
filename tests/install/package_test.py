#!/usr/bin/env python3
"""The Debian package, without installing it: package_test.py BUILD SOURCE SCRATCH    exit 77 (skipped) where dpkg-deb is missing

Builds it of what is in BUILD, unpacks it into SCRATCH, looks at what it holds, and runs the program from there."""
import gzip
import os
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
HOLDS = """
usr/bin/raytube
usr/lib/libraytube.a
usr/lib/cmake/raytube/raytubeConfig.cmake
usr/include/raytube/solve/solve.h
usr/share/bash-completion/completions/raytube
usr/share/zsh/vendor-completions/_raytube
usr/share/man/man1/raytube.1.gz
usr/share/doc/raytube/copyright
usr/share/doc/raytube/changelog.gz
usr/share/doc/raytube/changelog.Debian.gz
usr/share/doc/raytube/README.md
usr/share/doc/raytube/docs/guide/install.md
usr/share/doc/raytube/cases/dihedral/case.toml
usr/share/doc/raytube/examples/library/main.cpp
usr/share/raytube/matlab/raytube_read.m
""".split()
PYTHON = "usr/lib/python3/dist-packages/raytube"  # in a package of a build with it
HOLDS_NOT = ["usr/share/zsh/site-functions", "usr/local"]


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode:
        sys.exit(f"failed ({done.returncode}): {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def built_package(build, scratch):
    """As target "deb" builds it, but beside: a package of the user's stays as it is."""
    run("cpack", "--config", build / "CPackConfig.cmake", "-B", scratch, cwd=build)
    (package,) = scratch.glob("raytube_*.deb")
    return package


def check_files(root, with_python):
    wanted = HOLDS + ([f"{PYTHON}/__init__.py", f"{PYTHON}/py.typed"] if with_python else [])
    missing = [name for name in wanted if not (root / name).is_file()]
    assert not with_python or list((root / PYTHON).glob("_core.*.so")), f"no module in {PYTHON}"
    surplus = [name for name in HOLDS_NOT if (root / name).exists()]
    assert not missing and not surplus, f"missing: {missing}; not to be there: {surplus}"


def check_program(root, source, scratch):
    """The program runs from where it was unpacked, and as the one in the build does."""
    program, case = root / "usr/bin/raytube", root / "usr/share/doc/raytube/cases/plate/case.toml"
    run(program, "run", case, "-o", scratch / "out", "--set", "output.plots=false", "--quiet")
    assert (scratch / "out/rcs.csv").stat().st_size > 1000
    assert str(source).encode() not in program.read_bytes(), "the program knows the folder it was built in"


def check_depends(package):
    """MPI is for those who have it."""
    depends = run("dpkg-deb", "-f", package, "Depends")
    assert "netcdf" in depends and not any(name in depends for name in ("openmpi", "mpich")), depends


def check_pages(root, program):
    """Each command has a page with each of its options, and the pages are in order for man."""
    pages = sorted((root / "usr/share/man/man1").glob("*.gz"))
    commands = [page.name.removesuffix(".1.gz").removeprefix("raytube-") for page in pages if page.name != "raytube.1.gz"]
    assert "run" in commands and len(commands) >= 6, commands
    for command in commands:
        text = gzip.decompress((root / f"usr/share/man/man1/raytube-{command}.1.gz").read_bytes()).decode().replace("\\-", "-")
        words = run(program, command, "--help").replace(",", " ").split()
        absent = [word for word in words if word.startswith("--") and word.strip("-") and f"{word.rstrip('.;)')}" not in text]
        assert not absent, f"raytube-{command}(1) lacks {absent}"
    if shutil.which("man"):
        for page in pages:
            warned = subprocess.run(["man", "--warnings", "-l", page], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
            assert not warned.stderr, warned.stderr


def check_completions(root):
    bash, zsh = root / "usr/share/bash-completion/completions/raytube", root / "usr/share/zsh/vendor-completions/_raytube"
    run("bash", Path(__file__).with_name("completion.bash"), bash)
    if shutil.which("zsh"):
        run("zsh", "-n", zsh)


def check_policy(package):
    if shutil.which("lintian"):
        run("lintian", "--allow-root", "--fail-on", "error,warning", package)


def main(build, source, scratch):
    if not shutil.which("dpkg-deb") or not (build / "CPackConfig.cmake").exists():
        return SKIPPED
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    package = built_package(build, scratch)
    root = scratch / "root"
    run("dpkg-deb", "-x", package, root)
    check_files(root, any((build / "python/raytube").glob("_core.*.so")))
    check_depends(package)
    check_program(root, source, scratch)
    check_pages(root, root / "usr/bin/raytube")
    check_completions(root)
    check_policy(package)
    return 0


if __name__ == "__main__":
    sys.exit(main(*(Path(argument).resolve() for argument in sys.argv[1:4])))

#!/usr/bin/env python3
"""Program and Python package on a processor without AVX2, that of qemu-user: processor_test.py PROGRAM [FOLDER-OF-THE-PACKAGE]

A sentence has to come in place of an illegal instruction. Exit 77 (skipped) without qemu-x86_64."""
import os
import shutil
import subprocess
import sys

SKIPPED = 77
SENTENCE = "this processor lacks the x86-64-v3 instructions (AVX2, FMA, BMI2); run raytube on one made since about 2015\n"
OLD = ["qemu-x86_64", "-cpu", "Nehalem"]  # x86-64-v2


def said(*command, **variables):
    done = subprocess.run([*OLD, *command], capture_output=True, text=True, env={**os.environ, **variables})
    return done.returncode, done.stderr


def main(program, package=None):
    if not shutil.which(OLD[0]):
        return SKIPPED
    assert said(program, "--version") == (2, f"raytube: {SENTENCE}"), said(program, "--version")
    if package:
        python = os.path.realpath(sys.executable)
        code, text = said(python, "-c", "import raytube", PYTHONPATH=package, PYTHONDONTWRITEBYTECODE="1")
        assert code == 1 and text.endswith(f"\nImportError: {SENTENCE}"), (code, text)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

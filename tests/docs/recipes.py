#!/usr/bin/env python3
"""Runs the blocks of docs/guide/recipes.md, one after the other, in a folder of their own.

    recipes.py PROGRAM [PAGE]     says what was run and what was skipped; exit code 1 at the first block that fails

The word behind the three backticks says what a block is: sh, python, octave are run; text is what the block before prints, in which the
last digit of a number may differ by one (rounding at a half); toml, off, csv carry the name under which they are saved. Python blocks
whose modules are missing, and those of Octave where it is missing, are skipped, and what they would print with them.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```(\w+) *(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"-?\d+(?:\.(\d+))?")
SAVED = ("toml", "off", "csv")


class Block(NamedTuple):
    line: int
    language: str
    name: str
    text: str


def blocks(page):
    text = page.read_text(encoding="utf-8")
    return [Block(text.count("\n", 0, match.start()) + 1, *match.groups()) for match in BLOCK.finditer(text)]


def has(python, modules):
    return subprocess.run([python, "-c", f"import {', '.join(modules)}"], capture_output=True).returncode == 0


def command(block):
    """How a block is run, or None and what is missing."""
    if block.language == "sh":
        return ["sh", "-e", "-c", block.text], ""
    if block.language == "octave":
        wants = "pkg load netcdf" if ".nc'" in block.text else ""
        if not shutil.which("octave-cli") or subprocess.run(["octave-cli", "--eval", wants], capture_output=True).returncode != 0:
            return None, "octave-cli" + (" with octave-netcdf" if wants else "")
        return ["octave-cli", "--quiet", "--eval", block.text], ""
    modules = re.findall(r"^(?:import|from) (\w+)", block.text, re.MULTILINE) or ["sys"]
    # Debian's packages of NumPy and pandas are for Debian's own Python, which need not be the first one on the path.
    for python in (sys.executable, "/usr/bin/python3"):
        if Path(python).exists() and has(python, modules):
            return [python, "-c", block.text], ""
    return None, " or ".join(modules)


def same(expected, printed):
    if NUMBER.split(expected)[0::2] != NUMBER.split(printed)[0::2]:
        return False
    for a, b in zip(NUMBER.finditer(expected), NUMBER.finditer(printed)):
        if abs(float(a[0]) - float(b[0])) > (1.01 * 10.0 ** -len(a[1]) if a[1] else 0.0):
            return False
    return True


def fail(page, block, why):
    sys.exit(f"{page.name}:{block.line}: {why}")


def run(page, block, folder):
    """What the block prints, or None if it was skipped."""
    arguments, missing = command(block)
    if arguments is None:
        print(f"{page.name}:{block.line}: {block.language}: SKIPPED, there is no {missing}")
        return None
    done = subprocess.run(arguments, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if done.returncode != 0:
        fail(page, block, f"exit code {done.returncode} of\n{block.text}\n{done.stdout}{done.stderr}")
    print(f"{page.name}:{block.line}: {block.language}: run")
    return done.stdout


def run_all(page, folder):
    printed = None
    for block in blocks(page):
        if block.language in SAVED:
            if not block.name:
                fail(page, block, f"a block of {block.language} wants the name under which it is saved")
            (folder / block.name).write_text(block.text, encoding="utf-8")
        elif block.language in ("sh", "python", "octave"):
            printed = run(page, block, folder)
        elif block.language != "text":
            fail(page, block, f"{block.language}: no block of this kind is known")
        elif printed is not None and not same(block.text, printed):
            fail(page, block, f"the page says\n{block.text}and the block before it prints\n{printed}")


def main():
    program, page = Path(sys.argv[1]).resolve(), Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "docs/guide/recipes.md")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "build").mkdir()
        os.symlink(program, folder / "build/raytube")
        for name in ("cases", "matlab"):
            os.symlink(ROOT / name, folder / name)
        run_all(page, folder)


if __name__ == "__main__":
    main()

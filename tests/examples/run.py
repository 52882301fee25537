#!/usr/bin/env python3
"""Runs one script of examples/python in a folder of its own: it leaves its figure, and what it prints agrees with the physics. One that
holds tests is run by pytest, too.

    run.py SCRIPT FOLDER        77 where raytube, matplotlib or what else it needs cannot be imported
"""
import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

NUMBER = r"(-?[\d.]+(?:e[-+]?\d+)?)"
# Of each script: what it prints, with the numbers in their places; what the numbers should be; how far off they may be, and why.
EXPECTED = {
    # Physical optics of one, two and three bounces is 33.06 (cases/trihedral), of which edges take less than .3 dB; the triple bounce
    # alone is 33.27 by the closed form.
    "sweep": [(f"on the axis {NUMBER} dBsm; geometrical optics {NUMBER} dBsm", (33.06, 33.27), (0.3, 0.006))],
    # The closed form is the double bounce alone; the single ones, seen at 45 degrees, add .002 dB. The theory is first order in the
    # error: half a degree shortens the aperture by a hundredth, some hundredths of a dB.
    "parameter_study": [(f"right angle, 94 GHz: {NUMBER} dBsm, 8 pi a\\^4 / lambda\\^2 {NUMBER} dBsm", (30.972, 30.972), (0.005, 0.001)),
                        (f"0.25 degrees off: {NUMBER} dB, theory", (-1.24,), (0.05,)),
                        (f"0.5 degrees off: {NUMBER} dB, theory", (-5.50,), (0.05,))],
    # Both lobes are physical optics of the whole plate, which edges leave as it is to the two decimals printed.
    "bistatic": [(f"mirror {NUMBER} dBsm, shadow {NUMBER} dBsm; .* {NUMBER} dBsm", (17.53, 17.53, 17.53), (0.011, 0.011, 0.006))],
    # At normal incidence the coat is a plane layer: the formula, to rounding. Least where the layer is a quarter of a wavelength thick.
    "materials": [(f"best {NUMBER} dB at {NUMBER} GHz; off the layer's reflection by {NUMBER} dB", (-31.1, 12.375, 0), (0.1, 0.006, 1e-9))],
    # The Fresnel integral leaves out the inclination and the amplitude at the plate's rim: (D / 2R)^2, .02 dB at 3 m.
    "finite_range": [(f"at {metres} m the peak loses {NUMBER} dB, Fresnel integral {NUMBER} dB", (loss, loss), (off, 0.006))
                     for metres, loss, off in ((12, 0.12, 0.01), (6, 0.48, 0.02), (3, 1.93, 0.03))],
    # A cell of the padded transform is 2.3 mm. The edges of a face, at its own distance, add less than .1 dB even to the least.
    "range_profile": [(f"face at {place} m, {NUMBER} dBsm: peak at {NUMBER} m, {NUMBER} dBsm", (level, float(place), level),
                       (0.006, 0.0025, 0.1))
                      for place, level in (("-1.20", 13.50), ("0.30", 1.46), ("0.90", 8.50))],
    # Windows of 24 pulses lie .4 ms apart. Two pi times five turns a second times one metre times the sine of 60 degrees.
    "rotor": [(f"first flash at {NUMBER} s, a quarter of a turn is {NUMBER} s", (0.05, 0.05), (0.0011, 0.0006)),
              (f"tips at up to {NUMBER} m/s, {NUMBER} Hz", (27.21, 1815), (0.06, 0.6))],
    # As in the tests of the solver against the same reference: .19 and .37 dB are what the theory is off, .02 dB is for rounding of both.
    "measured_curve": [(f"vv: rms {NUMBER} dB, correlation {NUMBER}", (0.19, 1), (0.02, 0.001)),
                       (f"hh: rms {NUMBER} dB, correlation {NUMBER}", (0.37, 1), (0.02, 0.002))],
    # What one and two bounces add to three is less than half a wavelength over the leg of the field; at 15 wavelengths it is known
    # (cases/trihedral).
    "futures_study": [(f"leg of 5 wavelengths: {NUMBER} dB", (0,), (0.85,)), (f"leg of 15 wavelengths: {NUMBER} dB", (-0.21,), (0.02,)),
                      (f"leg of 30 wavelengths: {NUMBER} dB", (0,), (0.15,))],
    # Looks are the same bits alone and beside others.
    "dask_sweep": [(f"12 sectors, 360 looks; off one solve of all by {NUMBER} m", (0,), (0,))],
    # The same binary gives the same bytes. Edges seen from 20 degrees above are as strong as what the faces return: .4 of the peak.
    "regression_test": [(f"same solver {NUMBER}, edges of first order {NUMBER}, tolerance 1e-06", (0, 0.4), (0, 0.2))],
}


NEEDED = {"futures_study": ["mpi4py"], "dask_sweep": ["dask", "distributed"]}  # beside what all need


def missing(name):
    needed = ["raytube", "matplotlib", "pandas", *NEEDED.get(name, [])]
    return [package for package in needed if not importlib.util.find_spec(package)]


def faults(name, printed):
    for pattern, expected, tolerances in EXPECTED[name]:
        found = re.search(pattern, printed)
        if not found:
            yield f"does not print {pattern}"
            continue
        for text, number, tolerance in zip(found.groups(), expected, tolerances, strict=True):
            if not abs(float(text) - number) <= tolerance:
                yield f"{found[0]}: {text} is not {number} to {tolerance}"


def run(script, folder):
    """What the script prints."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    printed = subprocess.run([sys.executable, "-B", script], cwd=folder, stdout=subprocess.PIPE, text=True, check=True).stdout
    print(printed)
    (folder / f"{script.stem}.txt").write_text(printed, encoding="utf-8")
    return printed


def run_tests(script, folder):
    """Exit code of pytest for a script that holds tests, where pytest is installed."""
    if "\ndef test_" not in script.read_text(encoding="utf-8") or not importlib.util.find_spec("pytest"):
        return 0
    return subprocess.run([sys.executable, "-B", "-m", "pytest", "-q", "-p", "no:cacheprovider", script], cwd=folder).returncode


def main():
    script, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    if absent := missing(script.stem):
        print(f"the example needs {', '.join(absent)}")
        return 77
    found = list(faults(script.stem, run(script, folder)))
    figure = folder / f"{script.stem}.png"
    if not (figure.is_file() and figure.read_bytes().startswith(b"\x89PNG")):
        found.append(f"leaves no {figure.name}")
    if run_tests(script, folder):
        found.append("its tests fail")
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

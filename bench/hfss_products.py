#!/usr/bin/env python3
"""Range profiles and images of HFSS' numbers beside those of our own solve of the same spheres, by the same engine.

    bench/hfss_products.py FOLDER [--threads N]

FOLDER is that of the examples that Ansys ships with its Radar Explorer Toolkit: range_profile/ and isar/ with results of three
conducting spheres, range_profile/geometry/ with their meshes. Needs the Python package (PYTHONPATH=build/python). Of each sphere:
how far our peak is from HFSS', in resolution cells, and in dB, and both levels beside pi radius^2 of geometrical optics; of the
image: the correlation of amplitudes, sum |a||b| / sqrt(sum |a|^2 sum |b|^2), of these less their means, and of complex values.
Exit code 1 beyond a tenth of a cell, 1 dB, or below 0.99. One sphere stands behind another: the profile does not have it, the
image from half of the angles, where its level hangs on the shadow's edge; it is told, not judged."""
import argparse
import pathlib
import sys
import warnings

import numpy as np
import raytube as rt

HIDDEN = (-8.0, 0.0, 0.2)  # x, y, radius [m]; the radar stands on +x
LIT = [(0.0, 0.0, 0.3), (3.0, 5.0, 0.2)]
MOST_CELLS, MOST_DB, LEAST_CORRELATION = 0.1, 1.0, 0.99
FINE = 32  # samples to a cell


def solved_like(theirs, spheres, threads):
    angles = {name: getattr(theirs.S, name).values for name in ("theta_deg", "phi_deg")}
    looks = rt.looks(angles["theta_deg"], angles["phi_deg"])
    return rt.solve(spheres, theirs.S.frequency.values / 1e9, looks, edges={"method": "none"}, tubes={"max_bounces": 3}, threads=threads)


def top(levels, x):
    """Where the largest of some samples is, and how high, by a parabola through it and its neighbours."""
    i = int(np.clip(np.argmax(levels), 1, len(levels) - 2))
    low, peak, high = levels[i - 1:i + 2]
    shift = 0.5 * (low - high) / (low - 2.0 * peak + high)
    return x[i] + shift * (x[1] - x[0]), peak - 0.25 * (low - high) * shift


def told(name, sphere, theirs, ours, cells):
    (their_place, their_level), (our_place, our_level) = theirs, ours
    away = np.atleast_1d((our_place - their_place) / cells)
    good = sphere == HIDDEN or np.max(np.abs(away)) <= MOST_CELLS and abs(our_level - their_level) <= MOST_DB
    print(f"  {name}, sphere at ({sphere[0]:g}, {sphere[1]:g}): ours lies {', '.join(f'{c:+.3f}' for c in away)} cells away, {our_level - their_level:+.2f} dB; "
          f"HFSS {their_level:.2f}, ours {our_level:.2f}, optics {10 * np.log10(np.pi * sphere[2]**2):.2f} dBsm"
          f"{'; partly hidden' if sphere == HIDDEN else ''}{'' if good else '   TOO FAR'}")
    return good


def compare_profiles(folder, spheres, threads):
    theirs = rt.read_radar_explorer(folder / "range_profile/HH_Spheres_Range.json")
    pair = [result.range_profile(padding=FINE) for result in (theirs, solved_like(theirs, spheres, threads))]
    cell = pair[0].attrs["range_unambiguous_m"] / theirs.S.sizes["frequency"]
    good = True
    for channel in ("vv", "hh"):
        for sphere in LIT:
            front = -sphere[0] - sphere[2]
            near = [p.sigma_dbsm.sel(channel=channel, range_m=slice(front - 0.3, front + 0.3)) for p in pair]
            good &= told(channel.upper(), sphere, *(top(n.values, n.range_m.values) for n in near), cell)
    return good


def peak_of_image(image, channel, x, y, radius):
    """Range and cross-range [m], level [dBsm]."""
    part = image.sigma_dbsm.sel(channel=channel, range_m=slice(-x - radius - 0.4, -x - radius + 0.4), cross_range_m=slice(y - 0.4, y + 0.4))
    row, column = np.unravel_index(int(part.values.argmax()), part.shape)
    at_range, level = top(part.values[:, column], part.range_m.values)
    at_cross_range, rise = top(part.values[row], part.cross_range_m.values)
    return np.array([at_range, at_cross_range]), level + rise - part.values[row, column]


def compare_images(folder, spheres, threads):
    theirs = rt.read_radar_explorer(folder / "isar/HH_Spheres_ISAR2D.json")
    ours = solved_like(theirs, spheres, threads)
    pair = [result.isar(20.0, pixels=8) for result in (theirs, ours)]
    cells = [pair[0].attrs[f"{axis}_unambiguous_m"] / n for axis, n in (("range", theirs.S.sizes["frequency"]), ("cross_range", theirs.S.sizes["look"]))]
    good = True
    for sphere in (HIDDEN, *LIT):
        good &= told("HH image", sphere, *(peak_of_image(image, "hh", *sphere) for image in pair), np.array(cells))
    a, b = (image.S.sel(channel="hh").values.ravel() for image in pair)
    amplitudes = np.vdot(abs(a), abs(b)) / np.sqrt(np.vdot(a, a).real * np.vdot(b, b).real)
    centred = np.corrcoef(abs(a), abs(b))[0, 1]
    coherence = abs(np.vdot(a, b)) / np.sqrt(np.vdot(a, a).real * np.vdot(b, b).real)
    print(f"  HH image: amplitudes correlate at {amplitudes:.4f} (less their means {centred:.4f}), complex values at {coherence:.4f}")
    return good and amplitudes >= LEAST_CORRELATION


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args()
    warnings.simplefilter("ignore", rt.RaytubeWarning)
    meshes = sorted((options.folder / "range_profile/geometry").glob("*.obj"))
    spheres = rt.Target.load(meshes, unit="m")
    results = []
    for name, compare in (("range profiles", compare_profiles), ("image", compare_images)):
        print(name)
        results.append(compare(options.folder, spheres, options.threads))
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()

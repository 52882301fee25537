"""``raytube compare`` of images: how far apart they are, printed, as a table and as a picture."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np

from raytube._command import Parser, new_files
from raytube._core import InputError
from raytube._image_comparison import CSV_COLUMNS, ImageComparison, are_images, read_image
from raytube._tables import dbsm, json_numbers, require_free, write_table

_FILES = ("compare.csv", "compare.png")
_SHOWN_DB = 40.0
_EXAMPLES = """\
An image is image.csv, what raytube isar writes, a table with a row for each pixel (col and row, or u_m and v_m [m]) and channels as in a table of
looks, or OpenEXR, whose channels are its columns. Image A is first shifted onto B. With -o it also writes compare.csv and compare.png.

Examples:
  raytube compare render.exr out/image.csv --result-columns magnitude_vv=VV.mag --free-scale -o comparison
  raytube compare out/isar.nc reference.csv --tolerance-db 1 --within-db 30
"""


def main(arguments: list[str]) -> int:
    parser = Parser("compare", "Measure how far an image is from a reference", _EXAMPLES)
    parser.add_argument("result", metavar="A", help="Image to be judged")
    parser.add_argument("reference", metavar="B", help="Image to judge it by")
    parser.add_argument("-o", "--output", metavar="DIR", default="", help="Folder for compare.csv and compare.png; none by default")
    parser.add_argument("--tolerance-db", metavar="X", type=float, help="Exit with 1 if the rms error of a channel exceeds this")
    parser.add_argument("--tolerance-relative", metavar="X", type=float,
                        help="Exit with 1 if ||A - B|| / ||B|| of complex pixels exceeds this, or if one image has channels of its own")
    parser.add_argument("--within-db", metavar="X", type=float, default=20.0,
                        help="Errors in dB are over pixels whose reference is this close to its peak; default 20")
    for name in ("result", "reference"):
        parser.add_argument(f"--{name}-columns", metavar="OURS=THEIRS,...", default="",
                            help=f"Names and units of the columns of the {name}: OURS=THEIRS[*FACTOR][+OFFSET],...")
    parser.add_argument("--free-scale", action="store_true", help="First multiply A by the one complex factor that brings it nearest to B")
    parser.add_argument("--no-register", action="store_true", help="Compare the images where they are, without looking for a shift first")
    parser.add_argument("--only", action="append", metavar="COLUMN=LOW:HIGH", help="Tables of looks only: images have no such rows")
    parser.add_argument("--json", action="store_true", help="Print the measures as JSON")
    asked = parser.parse_args(arguments)
    for option in ("tolerance_db", "tolerance_relative", "within_db"):
        if getattr(asked, option) is not None and not 0.0 <= getattr(asked, option) < np.inf:
            raise InputError(f"--{option.replace('_', '-')}: give 0 or more")
    if asked.only:
        raise InputError(f"--only {asked.only[0]}: images have no rows of looks; leave the option out")
    if asked.output:
        require_free(asked.output, _FILES, [asked.result, asked.reference])
    files = (asked.result, asked.result_columns), (asked.reference, asked.reference_columns)
    if not are_images(*files):
        raise InputError(f"{asked.result} and {asked.reference} are not images; give files with a row or cell for each pixel")
    images = read_image(*files[0], "--result-columns"), read_image(*files[1], "--reference-columns")
    found = ImageComparison(*images, asked.within_db, asked.free_scale, not asked.no_register)
    failure = _failure(found, asked.tolerance_db, asked.tolerance_relative)
    judged = asked.tolerance_db is not None or asked.tolerance_relative is not None
    if asked.output:
        with new_files(Path(asked.output)) as folder:
            write_table(folder / _FILES[0], found.comments, CSV_COLUMNS, found.csv_rows)
            _draw(found, folder / _FILES[1])
    if asked.json:
        document = {"result": asked.result, "reference": asked.reference, "shift": found.shift, "pixels": found.rows,
                    **json_numbers({"relative_error": found.relative_error}),
                    "channels": {name: json_numbers(measures) for name, measures in found.channels.items()}}
        sys.stdout.write(json.dumps({**document, "pass": not failure} if judged else document, indent=2) + "\n")
        return int(bool(failure))
    sys.stdout.write(found.text + (f"results in {asked.output}: {', '.join(_FILES)}\n" if asked.output else ""))
    if judged:
        sys.stdout.write("FAIL\n" if failure else "PASS\n")
    if failure:
        sys.stderr.write(f"raytube: {failure}\n")
    return int(bool(failure))


def _failure(found: ImageComparison, tolerance_db: float | None, tolerance_relative: float | None) -> str:
    if tolerance_db is not None and (above := found.above_tolerance(tolerance_db)):
        return f"rms error above the tolerance of {tolerance_db:g} dB: {above}"
    if tolerance_relative is None or found.relative_error <= tolerance_relative:
        return ""
    if np.isinf(found.relative_error):
        return "no relative error: one of the images has channels of its own, or no phase"
    return f"relative error {found.relative_error:.2g} of complex pixels above the tolerance of {tolerance_relative:g}"


def _draw(found: ImageComparison, file: Path) -> None:
    """Result, reference and their difference, in the same colours, a line of panels for each channel with a signal."""
    from matplotlib.figure import Figure

    reference = found.images[1]
    extent = []
    for (first, step, _), pixels in ((reference.across, found.across), (reference.up, found.up)):
        extent += [first + (step or 1.0) * (pixels[0] - 0.5), first + (step or 1.0) * (pixels[-1] + 0.5)]
    height = min(9.0, max(2.0, 4.2 * abs((extent[3] - extent[2]) / (extent[1] - extent[0]))))
    figure = Figure(figsize=(15.0, 1.0 + (0.7 + height) * len(found.channels)), layout="constrained")
    figure.suptitle(f"{found.images[0].file} against {reference.file}\n" + (
        f"registered: {found.shift[0]:+.3f} columns, {found.shift[1]:+.3f} rows" if found.registered else "not registered"))
    panels = figure.subplots(len(found.channels), 3, squeeze=False, sharex=True, sharey=True)
    top = np.ceil(max(levels.max() for pair in found.levels.values() for levels in pair))
    for axes, name in zip(panels, found.channels):
        for ax, title, levels in zip(axes, ("result", "reference", "result − reference"),
                                     (*found.levels[name], dbsm(found.pairs[name][0] - found.pairs[name][1]))):
            colours = ax.imshow(np.maximum(levels, top - _SHOWN_DB), origin="lower", extent=extent, vmin=top - _SHOWN_DB, vmax=top,
                                interpolation="nearest")
            ax.set_title(f"{name.upper()} {title}")
            ax.set_xlabel("across (m)" if reference.placed else "column")
        axes[0].set_ylabel("up (m)" if reference.placed else "row")
    figure.colorbar(colours, ax=panels, label="σ (dBsm)", fraction=0.03, pad=0.01)
    figure.savefig(file, dpi=100)

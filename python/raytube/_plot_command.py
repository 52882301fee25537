"""``raytube plot``: results and files of products become pictures; a single look is printed as a table."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from raytube._arguments import CHANNELS
from raytube._command import Parser, new_files
from raytube._core import InputError
from raytube._figures import Options, Pictures, figure_of_results, twice
from raytube._plots import TITLES, Style
from raytube._product_figures import figure_of_waterfall, product_pictures
from raytube._rows import Rows, read_rows
from raytube._tables import require_free

_KINDS, _UNITS, _STYLES = ("auto", "curves", "map", "polar", "sphere", "waterfall"), ("dbsm", "m2", "db-peak"), ("screen", "print")
_ENDINGS = (".png", ".svg", ".pdf")
_OTHERS = (".jpg", ".jpeg", ".eps", ".ps", ".gif", ".tif", ".tiff", ".bmp")
_LEAST_PIXELS, _MOST_PIXELS, _MOST_ELONGATED, _MOST_IN_ALL = 100, 20000, 4, 2e8
_DPI = 150

_DESCRIPTION = "Draws results as curves, maps or polar curves, and what profile, isar, doppler, centres, converge, compare, sources and run wrote beside them."
_EXAMPLES = """A result is rcs.csv, a netCDF file (.nc) of raytube's, or any table that compare takes. Sweeps over two quantities are maps, the
whole sphere in a projection of equal areas; several results are curves in one picture. A result of a single look is printed
as a table. Results become plot.png and plot.svg beside the first one; other files (parts.csv, image.csv, profile.csv or .nc,
isar.csv or .nc, doppler.csv, spectrogram.csv, centres.csv, converge.csv, compare.csv, sources.csv) become pictures of the same name beside each.
For a folder, all such files are drawn.

Examples:
  raytube plot out/rcs.csv
  raytube plot out
  raytube plot a/rcs.csv b/rcs.csv -o both.pdf --channels vv --style print
  raytube plot out/rcs.nc -o polar.png --kind polar --range 40 --size 1600x1400
  raytube plot out/isar.csv -o car.svg --style print
  raytube plot hfss.csv --columns hfss --unit db-peak --title \"Cube at 10 GHz\""""


def main(arguments: list[str]) -> int:
    """Runs the command; see `raytube.__main__.main`."""
    asked = _parser().parse_args(arguments)
    options = _options(asked)
    results, products = _sorted_files(asked.result, options)
    target = _target(asked.output)
    rows = [read_rows(file, options.columns) for file in results]
    if options.kind != "waterfall" and any(len(each.keys) == 1 for each in rows):
        if len(rows) > 1:
            raise InputError(f"{next(each.file for each in rows if len(each.keys) == 1)}: a single look makes no curve beside others; plot it "
                             "alone, and it is printed as a table")
        print(look_table(rows[0], options.channels), end="")
        rows = []
    draw_results = figure_of_waterfall if options.kind == "waterfall" else figure_of_results
    jobs = [(Path(results[0]).absolute().parent, twice("plot", partial(draw_results, rows, options)))] if rows else []
    jobs += [(Path(file).absolute().parent, draw(file, options)) for file, draw in products]
    if isinstance(target, tuple):
        if len(jobs) > 1:
            raise InputError(f"-o {asked.output}: {len(jobs)} pictures do not go into one file; name a folder")
        jobs = [(target[0], {target[1]: next(iter(pictures.values()))}) for _, pictures in jobs]
    _write([(target if isinstance(target, Path) else folder, pictures) for folder, pictures in jobs], options, asked)
    return 0


def _parser() -> Parser:
    parser = Parser("plot", _DESCRIPTION, _EXAMPLES)
    parser.add_argument("result", nargs="+", metavar="RESULT...", help="Tables, netCDF files or folders of results")
    parser.add_argument("-o", "--output", metavar="FILE|DIR", help="Picture (.png, .svg or .pdf), or folder for pictures of the usual names")
    parser.add_argument("--kind", default="auto", choices=_KINDS, help="Default auto: maps of sweeps over two quantities, otherwise curves")
    parser.add_argument("--channels", default="", metavar="PQ,...", help="Channels to draw: vv,vh,hv,hh; default those with a signal")
    parser.add_argument("--range", metavar="DB", type=float, help="Depth below the peak; default down to the lowest rows, maps 50 dB at most")
    parser.add_argument("--unit", default="dbsm", choices=_UNITS, help="dBsm, square metres, or dB below the peak; default dbsm")
    parser.add_argument("--size", metavar="WxH", help="Pixels, for example 1600x900; for a PDF hundredths of an inch. Text scales with it")
    parser.add_argument("--style", default="screen", choices=_STYLES, help="Colours, or black and grey; default screen")
    parser.add_argument("--title", default="", metavar="TEXT", help="Heading; default the case's title")
    parser.add_argument("--columns", default="", metavar="OURS=THEIRS,...", help="Columns of a table of another program, or its name")
    parser.add_argument("--no-model", action="store_true", help="Draw no bands of model uncertainty")
    parser.add_argument("--run", default="", metavar="DIR|CASE", help="Folder of the run, or case, whose title and outline are shown; default the file's")
    parser.add_argument("-q", "--quiet", action="store_true", help="Do not print what was written")
    return parser


def _options(asked: argparse.Namespace) -> Options:
    if asked.range is not None and not 0.0 < asked.range <= 300.0:
        raise InputError(f"--range: needs a number of decibels above 0, at most 300 (found {asked.range:g})")
    if asked.range is not None and asked.unit == "m2":
        raise InputError("--range: square metres have no range in dB; leave it out, or take --unit dbsm")
    channels = [word.strip().lower() for word in asked.channels.split(",")] if asked.channels else []
    if any(channel not in CHANNELS for channel in channels) or len(set(channels)) < len(channels):
        raise InputError(f"--channels {asked.channels!r}: write some of vv,vh,hv,hh, each once")
    style = Style(asked.style == "print", not asked.no_model, asked.unit, asked.range)
    return Options(asked.kind, sorted(map(CHANNELS.index, channels)), style, _size(asked.size), asked.title, asked.columns, asked.run)


def _size(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    width, height = (int(word) if word.isdecimal() and len(word) < 9 else 0 for word in (text.split("x") + [""] * 2)[:2])
    short, long = min(width, height), max(width, height)
    if text.count("x") != 1 or short < _LEAST_PIXELS or long > _MOST_PIXELS or long > _MOST_ELONGATED * short or width * height > _MOST_IN_ALL:
        raise InputError(f"--size {text!r}: write WIDTHxHEIGHT in pixels from {_LEAST_PIXELS} to {_MOST_PIXELS}, {_MOST_IN_ALL:g} together at most "
                         f"and one no more than {_MOST_ELONGATED} times the other, for example 1600x900")
    return width, height


def _target(output: str | None) -> Path | tuple[Path, str] | None:
    """A folder, or folder and name of a picture; None for the folder of each file."""
    if output is None:
        return None
    if not output:
        raise InputError("-o: needs the name of a picture or a folder")
    place, ending = Path(output).absolute(), Path(output).suffix
    if ending in _ENDINGS and not place.is_dir():
        return place.parent, place.name
    if ending.lower() in (*_ENDINGS, *_OTHERS):
        raise InputError(f"-o {output}: pictures of this kind cannot be drawn; name a .png, .svg or .pdf, or a folder")
    if place.exists() and not place.is_dir():
        raise InputError(f"-o {output}: is a file, not a folder; name a .png, .svg or .pdf, or a folder")
    return place


def _sorted_files(named: list[str], options: Options) -> tuple[list[str], list[tuple[str, Callable[[str, Options], Pictures]]]]:
    """Results, and files of other kinds with what draws them."""
    results, products = [], []
    for name in named:
        if not os.path.exists(name):
            raise InputError(f"{name}: there is no such file; name results or their folder")
        for file in _files_of_folder(name) if os.path.isdir(name) else [name]:
            if draw := None if options.columns else product_pictures(file):
                products.append((file, draw))
            else:
                results.append(file)
    return results, products


def _files_of_folder(folder: str) -> list[str]:
    found: dict[str, str] = {}
    for name in sorted(os.listdir(folder)):
        file, (stem, ending) = os.path.join(folder, name), os.path.splitext(name)
        if ending in (".csv", ".nc") and (stem == "rcs" or product_pictures(file)):
            found.setdefault(stem, file)  # .csv before .nc, which holds the same
    if not found:
        raise InputError(f"{folder}: holds nothing to draw, neither rcs.csv nor rcs.nc; name a result, or the folder of a run")
    return list(found.values())


def _write(jobs: list[tuple[Path, Pictures]], options: Options, asked: argparse.Namespace) -> None:
    import matplotlib

    for folder, pictures in jobs:
        require_free(str(folder), pictures, asked.result)
    for folder, pictures in jobs:
        with new_files(folder) as place, matplotlib.rc_context({"svg.hashsalt": "raytube", "svg.fonttype": "none", "axes.unicode_minus": True}):
            for name, draw in pictures.items():
                meta = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(Path(name).suffix)
                draw().savefig(place / name, dpi=100 if options.size else _DPI, metadata=meta)
        if not asked.quiet:
            print(f"{'pictures' if len(pictures) > 1 else 'picture'} in {folder}: {', '.join(pictures)}")


def look_table(rows: Rows, asked: list[int]) -> str:
    """A single look: levels, phases and errors by channel."""
    text = f"{rows.file}: a single look, as a table in place of a picture\n{rows.fixed(0)}\n  {'channel':<9}{'sigma, dBsm':>12}{'phase of S, °':>14}"
    text += f"{'numerical error, dB':>20}{'model uncertainty, dB':>24}\n" if rows.error is not None else "\n"
    for c in asked or range(4):
        if not rows.has_channel[c]:
            continue
        s = rows.S[0, c]
        phase = f"{np.degrees(np.angle(s)):.2f}" if rows.has_phase[c] and s != 0.0 else "-"
        text += f"  {TITLES[c]:<9}{rows.sigma[0, c]:>12.2f}{phase:>14}"
        if rows.error is not None and rows.model is not None:
            text += f"{rows.error[0, c]:>20.2g}{rows.model[0, c]:>24.2g}"
        text += "\n"
    return text

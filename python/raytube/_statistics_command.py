"""``raytube statistics``: the numbers printed, as tables and as a picture."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

from raytube._command import Parser, new_files
from raytube._core import InputError
from raytube._statistics import LAWS, Statistics, law_of, shares_of, statistics_of
from raytube._tables import KEYS, json_numbers, ranges_of_options, require_free, result_file, write_table

_TABLES, _PICTURES = ("statistics.csv", "fits.csv", "histogram.csv"), ("statistics.png", "statistics.svg")
_EXAMPLES = """\
A result is rcs.csv, a netCDF file (.nc) written by raytube, or any table that compare takes; each row counts once. Prints mean, median,
percentiles and standard deviation of sigma for each channel, and how well Swerling I and III, chi-square and log-normal laws fit. With -o it
also writes statistics.csv (with --window also for sliding sectors), fits.csv, histogram.csv, statistics.png and statistics.svg.

Examples:
  raytube statistics out/rcs.csv
  raytube statistics out/rcs.csv --window 10 --percentiles 5,50,95 -o statistics
  raytube statistics out/rcs.nc --only theta_deg=90 --only phi_deg=-45:45
"""


def main(arguments: list[str]) -> int:
    parser = Parser("statistics", "Mean, percentiles and distribution of sigma", _EXAMPLES)
    parser.add_argument("result", metavar="A.csv|A.nc|DIR", help="Table or netCDF file of a result, or the folder of a run")
    parser.add_argument("-o", "--output", metavar="DIR", default="", help="Folder for the tables and the picture; none by default")
    parser.add_argument("--window", metavar="DEG", type=float, help="Also for sectors of this width that slide along the swept angle")
    parser.add_argument("--percentiles", metavar="N,N,...", default="10,50,90", help="Shares of the rows that lie below; default 10,50,90")
    parser.add_argument("--only", metavar="COLUMN=LOW:HIGH", action="append", default=[],
                        help="Take only these rows: COLUMN=VALUE or COLUMN=LOW:HIGH; may be repeated")
    parser.add_argument("--columns", "--result-columns", metavar="OURS=THEIRS,...", default="",
                        help="Names and units of the table's columns, OURS=THEIRS[*FACTOR][+OFFSET],...")
    parser.add_argument("--json", action="store_true", help="Print the numbers as JSON")
    asked = parser.parse_args(arguments)
    if asked.window is not None and not 0.0 < asked.window <= 360.0:
        raise InputError("--window: needs a width in degrees above 0, up to 360")
    if asked.window and not asked.output:
        raise InputError("--window: what the sectors hold is written, not printed; name a folder with -o DIR")
    if asked.output:
        require_free(asked.output, _TABLES + _PICTURES, [asked.result])
    asked.result = str(result_file(asked.result))
    try:
        percentiles = [float(word) for word in asked.percentiles.split(",")]
    except ValueError:
        raise InputError(f"--percentiles {asked.percentiles}: write numbers such as 10,50,90") from None
    shares = shares_of(percentiles, f"--percentiles {asked.percentiles}")
    found = statistics_of(asked.result, shares, asked.window, ranges_of_options(asked.only), asked.columns, "--columns")
    sys.stdout.write(json.dumps(_document(found), indent=2) + "\n" if asked.json else repr(found))
    if asked.output:
        with new_files(Path(asked.output)) as folder:
            _write(found, folder)
            written = [*_TABLES, *(_PICTURES if _draw(found, folder) else ())]
        if not asked.json:
            sys.stdout.write(f"results in {asked.output}: {', '.join(written)}\n")
    return 0


def _document(found: Statistics) -> dict[str, Any]:
    whole = found.table[found.table["from_deg"].isna()].drop(columns=[*KEYS, "from_deg", "to_deg"], errors="ignore")
    channels = {line.pop("channel"): line for line in whole.to_dict("records")}
    for channel, line in channels.items():
        line["nearest_law"] = found.nearest_law(channel)
        line["laws"] = {fit.pop("law"): json_numbers(fit)
                        for fit in found.fits[found.fits["channel"] == channel].drop(columns="channel").to_dict("records")}
        channels[channel] = json_numbers(line)
    return {"file": found.file, "channels": channels}


def _write(found: Statistics, folder: Path) -> None:
    blank = {*KEYS, "from_deg", "to_deg"}
    for name, frame, comments in (
            ("statistics", found.table, [f"sigma over the rows of {Path(found.file).name}, each counted once; mean of sigma in m2, not of dB;",
                                         "percentiles by linear interpolation in dB; std_db of the decibels. The first rows: the whole result."]),
            ("fits", found.fits, ["Laws for sigma with maximum-likelihood parameters; degrees of freedom are 2 k; ks_distance: the largest",
                                  "difference between the shares of rows and of the law below any level (Kolmogorov-Smirnov), without zero sigma."]),
            ("histogram", found.histogram, ["Rows with sigma in from_dbsm ... to_dbsm; their share, and that predicted by the laws of fits.csv"])):
        columns = list(frame.columns)
        rows = (["" if name in blank and cell != cell else cell for name, cell in zip(columns, row)] for row in frame.itertuples(index=False))
        write_table(folder / f"{name}.csv", comments, columns, rows)


def _draw(found: Statistics, folder: Path) -> bool:
    """Histograms with the laws fitted to them; False where sigma is zero in every row."""
    from matplotlib.figure import Figure

    channels = list(dict.fromkeys(found.histogram["channel"]))
    if not channels:
        sys.stderr.write("raytube: warning: no picture, because sigma is zero in every row\n")
        return False
    across = min(2, len(channels))
    up = -(-len(channels) // across)
    figure = Figure(figsize=(8.5 * across, 5.0 * up + 0.6), layout="constrained")
    figure.suptitle(found.file)
    whole = found.table[found.table["from_deg"].isna()].set_index("channel")
    for place, channel in enumerate(channels):
        axes = figure.add_subplot(up, across, place + 1)
        bins = found.histogram[found.histogram["channel"] == channel]
        width = float(bins["to_dbsm"].diff().median()) if len(bins) > 1 else float(bins["to_dbsm"].iloc[0] - bins["from_dbsm"].iloc[0])
        shown = bins[np.isfinite(bins["from_dbsm"])]  # what lies below the picture has no width
        axes.bar(shown["from_dbsm"], 100.0 * shown["share"] / width, width, align="edge", color="0.8", edgecolor="0.6", label="rows")
        edges = np.arange(bins["to_dbsm"].iloc[0] - width, bins["to_dbsm"].iloc[-1] + 0.05, 0.1)
        fits = found.fits[found.fits["channel"] == channel].to_dict("records")
        for order, fit in enumerate(fits):
            freedom = f", {fit['degrees_of_freedom']:.2f} degrees of freedom" if fit["law"] == "chi_square" else ""
            axes.plot(edges, 1000.0 * np.diff(law_of(fit).cdf(10.0 ** (np.append(edges - 0.05, edges[-1] + 0.05) / 10.0))), f"C{order}",
                      linestyle=("-", "-.", "--", ":")[order], linewidth=2, label=f"{LAWS[fit['law']]}{freedom}: {fit['ks_distance']:.3f}")
        numbers = whole.loc[channel]
        title = f"{channel.upper()}: {int(numbers['rows'])} rows, mean {numbers['mean_dbsm']:.1f} dBsm, median {numbers['median_dbsm']:.1f} dBsm"
        axes.set(title=title, xlabel="σ (dBsm)", ylabel="rows (% per dB)", xlim=(edges[0], edges[-1]), ylim=(0.0, 1.6 * axes.get_ylim()[1]))
        axes.legend(loc="upper left", title="largest difference of shares", frameon=False)
    for name in _PICTURES:
        figure.savefig(folder / name, dpi=100, metadata={"Date": None} if name.endswith("svg") else None)
    return True

"""How sigma is distributed over the rows of a result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from raytube import _arguments
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._comparison import table_of
from raytube._rows import ANGLES, LABELS, PHI, RX_PHI, UNITS, Rows, cuts_of, goes_round
from raytube._tables import KEYS, Range, cell_text, chosen_rows, number_text, ranges_of

if TYPE_CHECKING:
    from pandas import DataFrame

LAWS = {"swerling_1": "Swerling I", "swerling_3": "Swerling III", "chi_square": "chi-square", "log_normal": "log-normal"}
_SIGNAL_DB = 80.0  # channels further below the highest peak have no signal
_SHOWN_DB = 60.0  # what is further below a channel's peak lies in the first bin of its histogram
_LEAST_ROWS = 10
_SLACK_DEG = 1e-9
Values = NDArray[np.float64]


@dataclass(frozen=True)
class Statistics:
    """Mean, percentiles and distribution of sigma.

    Attributes
    ----------
    file : str
        The result.
    percentiles : tuple of float
        Shares of the rows [%].
    table : pandas.DataFrame
        As statistics.csv: a row for each channel with a signal, then for each channel in each sector; ``mean_m2`` (of sigma [m^2]), ``mean_dbsm``,
        ``median_dbsm``, percentiles such as ``p10_dbsm``, ``std_db`` (of the levels in dB, n - 1; without rows of zero sigma).
    fits : pandas.DataFrame
        As fits.csv: laws with their maximum-likelihood parameters, and ``ks_distance``, the largest difference between the shares of the rows and of
        the law below any level (Kolmogorov-Smirnov). Empty for fewer than ten levels, or if all levels are equal.
    histogram : pandas.DataFrame
        As histogram.csv: rows with sigma between two levels, their share, and the share that each law predicts.
    """

    file: str
    percentiles: tuple[float, ...]
    table: DataFrame
    fits: DataFrame
    histogram: DataFrame

    def __repr__(self) -> str:
        rows, fits = self.table[self.table["from_deg"].isna()].set_index("channel"), self.fits.set_index(["law", "channel"])
        shares = [(f"{number_text(p)} % lie below, dBsm", f"p{number_text(p)}_dbsm", ".2f") for p in self.percentiles]
        lines = [self.file, _line("", [channel.upper() for channel in rows.index])]
        for name, column, form in [("rows", "rows", "d"), ("mean of sigma, m2", "mean_m2", ".4g"), ("mean of sigma, dBsm", "mean_dbsm", ".2f"),
                                   ("median, dBsm", "median_dbsm", ".2f"), *shares, ("standard deviation, dB", "std_db", ".4g")]:
            lines.append(_line(name, [cell_text(value, form) for value in rows[column]]))
        lines.append("largest difference of shares (Kolmogorov-Smirnov)")
        distances = fits["ks_distance"].unstack().reindex(index=list(LAWS), columns=rows.index)
        lines += [_line(title, [cell_text(value, ".3f") for value in distances.loc[law]]) for law, title in LAWS.items()]
        lines.append(_line("nearest", [self.nearest_law(channel) or "-" for channel in rows.index]))
        freedom = fits["degrees_of_freedom"].unstack().reindex(index=list(LAWS), columns=rows.index).loc["chi_square"]
        return "\n".join([*lines, _line("degrees of freedom of chi-square", [cell_text(value, ".4g") for value in freedom])]) + "\n"

    def nearest_law(self, channel: str) -> str:
        """The law with the smallest distance from the rows of a channel.

        Parameters
        ----------
        channel : str
            ``vv``, ``vh``, ``hv`` or ``hh``.

        Returns
        -------
        str
            Its title, such as ``Swerling I``; empty if none was fitted.
        """
        fits = self.fits[self.fits["channel"] == channel]
        return LAWS[fits.loc[fits["ks_distance"].idxmin(), "law"]] if len(fits) else ""


def statistics(result: Any, percentiles: Sequence[float] = (10.0, 50.0, 90.0), sector_deg: float | None = None,
               only: Mapping[str, Any] | None = None, columns: str | Mapping[str, str] = "") -> Statistics:
    """Mean, median, percentiles and distribution of sigma, over all rows and in sectors that slide along the swept angle.

    Parameters
    ----------
    result : Result or path
        A Result, or a file: ``.nc``, or a table with a header that `compare` takes. Each row counts once.
    percentiles : sequence of float
        Shares of the rows [%], ascending; percentiles are interpolated linearly in dB.
    sector_deg : float, optional
        Also evaluate sectors of this width about each row, if they lie within the sweep; over all azimuths, sectors continue across its ends.
    only : dict, optional
        Count only these rows: ``{"phi_deg": (-45, 45), "freq_hz": 10e9}``.
    columns : str or dict of str to str
        Columns of a table that have other names or units, as `compare` takes them.

    Returns
    -------
    Statistics
        Its ``repr`` is the table that ``raytube statistics`` prints.

    Raises
    ------
    InputError
        If a file cannot be read, if no row is left, or if no sector fits into the sweep.
    """
    sector = None if sector_deg is None else _arguments.number(sector_deg, "sector_deg")
    if sector is not None and not 0.0 < sector <= 360.0:
        raise InputError(f"sector_deg: needs a width in degrees above 0, up to 360 (found {sector:g})")
    return statistics_of(result, shares_of(_arguments.numbers(percentiles, "percentiles"), "percentiles"), sector, ranges_of(only), columns, "columns")


def shares_of(percentiles: Any, name: str) -> tuple[float, ...]:
    """Ascending shares [%]; `name` is what a sentence calls them."""
    shares = tuple(np.atleast_1d(percentiles).tolist())
    if not all(0.0 <= p <= 100.0 for p in shares) or not all(a < b for a, b in zip(shares, shares[1:])):
        raise InputError(f"{name}: give ascending numbers from 0 to 100, for example 10, 50, 90")
    return shares


def statistics_of(result: Any, percentiles: tuple[float, ...], sector: float | None, ranges: Sequence[Range], columns: Any,
                  option: str) -> Statistics:
    import pandas as pd

    table, file = table_of(result, "result", columns, option)
    keys = table.keys.copy()
    rows = chosen_rows(keys, table.has_key, ranges, file)
    keys, levels = keys[rows], np.where(table.has_channel, table.sigma_dbsm, -np.inf)[rows]
    peaks = levels.max(axis=0)
    channels = [c for c in range(4) if table.has_channel[c] and peaks[c] >= peaks.max() - _SIGNAL_DB]
    names = ["channel", "rows", "mean_m2", "mean_dbsm", "median_dbsm", *(f"p{number_text(p)}_dbsm" for p in percentiles), "std_db"]
    summaries = [{"channel": CHANNELS[c], **_summaries(levels[:, c][None], percentiles)} for c in channels]
    whole = pd.concat([pd.DataFrame(summary) for summary in summaries])
    parts = [whole] if sector is None else [whole, *_sectors(keys, table.has_key, levels, channels, percentiles, sector, file)]
    fits, histograms = [], []
    for c in channels:
        laws = _fits(levels[:, c])
        fits += [{"channel": CHANNELS[c], **fit} for fit in laws]
        histograms += [{"channel": CHANNELS[c], **line} for line in _histogram(levels[:, c], laws)]
    return Statistics(
        file, percentiles, pd.concat(parts, ignore_index=True).reindex(columns=[*(KEYS if table.has_key[-1] else KEYS[:-1]), "from_deg", "to_deg", *names]),
        pd.DataFrame(fits, columns=["channel", "law", "mean_m2", "degrees_of_freedom", "mean_of_db", "std_of_db", "ks_distance"]),
        pd.DataFrame(histograms, columns=["channel", "from_dbsm", "to_dbsm", "rows", "share", *LAWS]))


def _summaries(levels: Values, percentiles: Sequence[float]) -> dict[str, Any]:
    """Of levels [sector, row]; a zero counts in all but the standard deviation."""
    levels = np.sort(levels, axis=1)
    finite = np.isfinite(levels)
    count = finite.sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        middle = np.where(finite, levels, 0.0).sum(axis=1) / count
        squares = np.where(finite, (levels - middle[:, None]) ** 2, 0.0).sum(axis=1)
        spread = np.where(count > 1, np.sqrt(squares / (count - 1)), np.nan)
        mean = (10.0 ** (levels / 10.0)).mean(axis=1)
        return {"rows": levels.shape[1], "mean_m2": mean, "mean_dbsm": 10.0 * np.log10(mean), "median_dbsm": _percentile(levels, 50.0),
                **{f"p{number_text(p)}_dbsm": _percentile(levels, p) for p in percentiles}, "std_db": spread}


def _percentile(ascending: Values, percent: float) -> Values:
    """Definition 7 of Hyndman and Fan, Am. Stat. 50 (1996) 361, as NumPy's, which makes NaN of infinite levels."""
    rank = percent / 100.0 * (ascending.shape[1] - 1)
    low, high = ascending[:, int(rank)], ascending[:, min(int(rank) + 1, ascending.shape[1] - 1)]
    between: Values = np.where((low == high) | ~np.isfinite(low), low, low + (rank - int(rank)) * (high - low))
    return between


def _fits(dbsm: Values) -> list[dict[str, Any]]:
    """Laws with their likeliest parameters: Swerling I and III are chi-square laws of 2 and 4 degrees of freedom (Swerling, RAND RM-1217, 1954)."""
    from scipy import stats

    sigma = 10.0 ** (dbsm / 10.0)
    sigma, dbsm = sigma[sigma > 0.0], dbsm[sigma > 0.0]
    mean, ln = sigma.mean() if len(sigma) else np.nan, np.log(sigma)
    if len(sigma) < _LEAST_ROWS or np.log(mean) - ln.mean() <= 1e-9:  # less is rounding
        return []
    shapes = {"swerling_1": 1.0, "swerling_3": 2.0, "chi_square": stats.gamma.fit(sigma, floc=0.0)[0]}
    fits = [{"law": law, "mean_m2": mean, "degrees_of_freedom": 2.0 * shape, "mean_of_db": np.nan, "std_of_db": np.nan}
            for law, shape in shapes.items()]
    fits.append({"law": "log_normal", "mean_m2": np.exp(ln.mean() + 0.5 * ln.var()), "degrees_of_freedom": np.nan, "mean_of_db": dbsm.mean(),
                 "std_of_db": dbsm.std()})
    return [{**fit, "ks_distance": stats.kstest(sigma, law_of(fit).cdf, method="asymp").statistic} for fit in fits]


def law_of(fit: Mapping[str, Any]) -> Any:
    """The distribution of sigma [m^2], one of scipy.stats, for a row of fits.csv."""
    from scipy import stats

    if fit["law"] == "log_normal":
        return stats.lognorm(fit["std_of_db"] * np.log(10.0) / 10.0, scale=10.0 ** (fit["mean_of_db"] / 10.0))
    shape = 0.5 * fit["degrees_of_freedom"]
    return stats.gamma(shape, scale=fit["mean_m2"] / shape)


def _histogram(levels: Values, fits: Sequence[Mapping[str, Any]]) -> Iterator[dict[str, Any]]:
    """Bins of 0.5, 1, 2 or 5 dB, about as wide as Freedman and Diaconis (1981) ask for."""
    ascending = np.sort(levels)
    n = len(ascending)
    if not np.isfinite(ascending[-1]):
        return
    with np.errstate(invalid="ignore"):
        wanted = 2.0 * (ascending[3 * (n - 1) // 4] - ascending[(n - 1) // 4]) / np.cbrt(n)
    width = next((width for width in (0.5, 1.0, 2.0) if wanted <= 1.5 * width), 5.0)
    lowest = ascending[np.searchsorted(ascending, ascending[-1] - _SHOWN_DB)]
    edges = width * np.arange(np.floor(lowest / width), np.floor(ascending[-1] / width) + 2.0)
    if ascending[0] < edges[0]:
        edges[0] = -np.inf
    rows = np.diff(np.searchsorted(ascending, edges))
    expected = [np.diff(law_of(fit).cdf(10.0 ** (edges / 10.0))) for fit in fits] or [np.full(len(rows), np.nan)] * len(LAWS)
    for i, count in enumerate(rows):
        yield {"from_dbsm": edges[i], "to_dbsm": edges[i + 1], "rows": int(count), "share": count / n,
               **{law: shares[i] for law, shares in zip(LAWS, expected)}}


def _sectors(keys: Values, has_key: Sequence[bool], levels: Values, channels: Sequence[int], percentiles: Sequence[float], width: float,
             file: str) -> Iterator[DataFrame]:
    """Statistics of the sectors of one cut after the other: rows that differ in the swept angle alone."""
    import pandas as pd

    lying = Rows(file, keys / UNITS, list(has_key), [], levels, np.empty(0, complex), [])
    axis, found_cuts = cuts_of(lying)
    if axis not in ANGLES:
        raise InputError(f"--window: {file} is a sweep over {LABELS[axis]}, not over an angle; leave it out")
    cuts = [(cut.rows, cut.x, axis in (PHI, RX_PHI) and goes_round(cut.x)) for cut in found_cuts]
    widest = max(360.0 if turns else x[-1] - x[0] for _, x, turns in cuts)
    if width > widest + _SLACK_DEG:
        raise InputError(f"--window {number_text(width)}: {file} sweeps over {number_text(widest)} degrees only; take a narrower one")
    for rows, x, turns in cuts:
        line, along = x, rows
        if turns:  # three turns, with each direction once a turn
            turn = len(x) - int(x[-1] - x[0] > 360.0 - _SLACK_DEG)
            line, along = np.concatenate([x[:turn] + shift for shift in (-360.0, 0.0, 360.0)]), np.tile(rows[:turn], 3)
        low, high = x - 0.5 * width, x + 0.5 * width
        inside = np.full(len(x), True) if turns else (low >= x[0] - _SLACK_DEG) & (high <= x[-1] + _SLACK_DEG)
        low, high = low[inside], high[inside]
        first = np.searchsorted(line, low - _SLACK_DEG)
        # Both ends of a whole turn are one direction.
        counts = np.searchsorted(line, high + (-2.0 if width > 360.0 - _SLACK_DEG else 1.0) * _SLACK_DEG, "right") - first
        fixed = {key: keys[rows[0], i] for i, key in enumerate(KEYS) if lying.known[i] and i != axis}
        found = []
        for count in np.unique(counts):
            alike, step = np.flatnonzero(counts == count), max(1, 1_000_000 // count)
            for some in (alike[i:i + step] for i in range(0, len(alike), step)):
                sectors = along[first[some, None] + np.arange(count)]
                found += [pd.DataFrame({"at": some, "order": order, **fixed, "from_deg": low[some], "to_deg": high[some], "channel": CHANNELS[c],
                                        **_summaries(levels[sectors, c], percentiles)}) for order, c in enumerate(channels)]
        yield pd.concat(found).sort_values(["at", "order"]) if found else pd.DataFrame()


def _line(name: str, cells: Sequence[str]) -> str:
    return f"  {name:<36}" + "".join(f"{cell:>12}" for cell in cells)

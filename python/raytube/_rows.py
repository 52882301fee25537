"""Rows of results of any source, and how they lie: curves along one quantity, grids over two."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from raytube import _core
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._tables import Floats, is_coarse, keys_of, run_of

if TYPE_CHECKING:
    from raytube._result import Result

FREQUENCY, THETA, PHI, RX_THETA, RX_PHI, TIME, LOOK = range(7)
ANGLES = (THETA, PHI, RX_THETA, RX_PHI)
UNITS = np.array([1e9, 1.0, 1.0, 1.0, 1.0, 1.0])  # of keys: GHz, degrees and seconds
LABELS = ("frequency (GHz)", "polar angle θ (degrees)", "azimuth φ (degrees)", "polar angle θ of the receiver (degrees)",
          "azimuth φ of the receiver (degrees)", "time (s)", "look")
_SYMBOLS = ("", "θ", "φ", "θ of the receiver", "φ of the receiver", "t")
_ORDER = (PHI, THETA, RX_PHI, RX_THETA, TIME, FREQUENCY)  # the first of equally good ones is what curves run along
_LEAST_OF_A_LINE = 3.0
_DECIMALS = 9  # far above what computing an angle leaves, far below any step


@dataclass
class Rows:
    """Rows of a result: keys (row, 6) in GHz, degrees and seconds, levels (row, channel) in dBsm, errors in dB where they are known."""

    file: str
    keys: Floats
    known: list[bool]
    has_channel: list[bool]
    sigma: Floats
    S: NDArray[np.complex128]
    has_phase: list[bool]
    error: Floats | None = None
    model: Floats | None = None
    title: str = ""
    joined: bool = True  # False where steps are wider than the target's lobes, so that lines between rows would mislead
    name: str = field(default="", init=False)

    def __post_init__(self) -> None:
        self.keys = np.round(self.keys, _DECIMALS)
        apart = np.stack([self.keys[:, RX_THETA] - self.keys[:, THETA], (self.keys[:, RX_PHI] - self.keys[:, PHI] + 180.0) % 360.0 - 180.0])
        if np.all(np.abs(apart[self.known[RX_THETA:TIME]]) < 1e-9):  # a receiver at the transmitter tells no rows apart
            self.known = [*self.known[:RX_THETA], False, False, self.known[TIME]]
        self.keys[:, [not known for known in self.known]] = 0.0

    def peak(self, channels: list[int]) -> float:
        """Highest level [dBsm], -inf if there is none."""
        levels = self.sigma[:, channels]
        return float(np.max(levels[np.isfinite(levels)], initial=-np.inf))

    def peak_row(self, channels: list[int]) -> int:
        """The row of the highest level."""
        return int(np.nanargmax(np.max(np.where(np.isnan(self.sigma), -np.inf, self.sigma)[:, channels], axis=1)))

    def fixed(self, row: int, but: tuple[int, ...] = ()) -> str:
        """What the keys of a row are, in words, without those of `but`."""
        words = [f"{self.keys[row, key]:.8g} GHz" if key == FREQUENCY else f"{_SYMBOLS[key]} = {self.keys[row, key]:.8g}{'°' if key in ANGLES else ' s'}"
                 for key in range(LOOK) if self.known[key] and key not in but and not (LOOK in but and key != FREQUENCY)]
        return ", ".join(words)


@dataclass
class Cut:
    """Rows along one quantity: its values ascend."""

    fixed: str
    rows: NDArray[np.int64]
    x: Floats


@dataclass
class Grid:
    """Rows over two quantities: rows[up, across], -1 where there is none."""

    across: int
    up: int
    x: Floats
    y: Floats
    rows: NDArray[np.int64]
    fixed: str
    whole: bool

    def over(self, levels: Floats) -> Floats:
        """Values of rows (row, ...) at their places (up, across, ...), NaN where there is none."""
        held = levels[self.rows]
        held[self.rows < 0] = np.nan
        return held

    def covers_sphere(self) -> bool:
        """Azimuths all round, and polar angles over 60 degrees at least."""
        return (self.across in (PHI, RX_PHI) and self.up in (THETA, RX_THETA) and goes_round(self.x)
                and float(np.ptp(self.y)) >= 60.0)


def goes_round(degrees: Floats) -> bool:
    """Whether azimuths come back to where they began, in steps of 10 degrees at most."""
    return len(degrees) > 1 and degrees[0] + 360.0 - degrees[-1] <= 10.0 and bool(np.all(np.diff(degrees) <= 10.0))


def rows_of_result(result: Result, file: str = "") -> Rows:
    """The rows of a result of raytube's, frequency fastest."""
    stored = result._stored
    sigma, error, model = (values.reshape(-1, 4) for values in (stored.sigma_dbsm, stored.error_db, stored.model_db))
    has = (~np.isnan(sigma).all(axis=0)).tolist()
    return Rows(file, keys_of(stored) / UNITS, [True, True, True, stored.bistatic, stored.bistatic, stored.moving], has, sigma, stored.S.reshape(-1, 4), has,
                error, model, result.title, not is_coarse(result.warnings))


def read_rows(file: str, columns: str = "", option: str = "--columns") -> Rows:
    """The rows of a table or netCDF file of any source."""
    from raytube._result import load

    table = _core.Table.of_file(file, columns, option)
    try:
        stored = None if columns else load(file)
    except InputError:  # a table of another program
        stored = None
    if stored is not None:
        rows = rows_of_result(stored, file)
    else:
        sigma = np.where(table.has_channel, table.sigma_dbsm, np.nan)
        rows = Rows(file, table.keys / UNITS, list(table.has_key), list(table.has_channel), sigma, table.S, list(table.has_phase))
    run = run_of(file)
    rows.title = rows.title or run.get("case", {}).get("title", "")
    rows.joined = not is_coarse(stored.warnings if stored is not None and stored.warnings else run.get("warnings", []))
    return rows


def name_apart(results: list[Rows]) -> None:
    """Gives each result the shortest end of its path by which all differ."""
    paths = [Path(os.path.abspath(rows.file)).with_suffix("").parts for rows in results]
    while len(set(paths)) > 1 and all(len(parts) > 1 and parts[-1] == paths[0][-1] for parts in paths):
        paths = [parts[:-1] for parts in paths]
    depth = next((d for d in range(1, 64) if len({parts[-d:] for parts in paths}) == len(paths)), 0)
    for i, (rows, parts) in enumerate(zip(results, paths)):
        rows.name = "/".join(parts[-depth:]) if depth else f"{parts[-1]} ({i + 1})"


def cuts_of(rows: Rows) -> tuple[int, list[Cut]]:
    """The quantity along which rows make the fewest curves, and these."""
    looks = _groups(rows.keys[:, 1:])
    best, groups = -1, np.empty(0, dtype=np.int64)
    for quantity in _ORDER:
        others = _groups(np.delete(rows.keys, quantity, axis=1))
        if rows.known[quantity] and (best < 0 or others.max() < groups.max()):
            best, groups = quantity, others
    if best < 0 or (len(rows.keys) > 1 and 2 * (groups.max() + 1) > len(rows.keys)):
        best, groups = LOOK, _groups(rows.keys[:, :1])
    along = looks.astype(float) if best == LOOK else rows.keys[:, best]
    order = np.lexsort((along, groups))
    split = np.split(order, np.flatnonzero(np.diff(groups[order])) + 1)
    return best, [Cut(rows.fixed(int(members[0]), (best,)), members, along[members]) for members in split]


def choice_with(cuts: list[Cut], row: int, most: int) -> list[Cut]:
    """As many cuts as fit, spread evenly, one of them through the row."""
    count = min(most, len(cuts))
    chosen = [i * (len(cuts) - 1) // max(count - 1, 1) for i in range(count)]
    through = next(i for i, cut in enumerate(cuts) if row in cut.rows)
    chosen[int(np.argmin(np.abs(np.array(chosen) - through)))] = through
    return [cuts[i] for i in sorted(set(chosen))]


def grid_of(rows: Rows, row: int, most_cuts: int) -> Grid | None:
    """The grid over two quantities through a row; None for fewer curves than `most_cuts`, and for rows that make none."""
    across, cuts = cuts_of(rows)
    if across == LOOK or len(cuts) <= most_cuts:
        return None
    beside = {key: int(np.sum(np.all(np.delete(rows.keys, key, 1) == np.delete(rows.keys[row], key), axis=1)))
              for key in _ORDER if key != across and rows.known[key]}
    up = max(beside, key=lambda key: beside[key], default=across)
    if beside.get(up, 1) < 2:
        return None
    members = np.flatnonzero(np.all(np.delete(rows.keys, (across, up), 1) == np.delete(rows.keys[row], (across, up)), axis=1))
    if across in (THETA, RX_THETA) and up in (PHI, RX_PHI):
        across, up = up, across
    (x, column), (y, line) = (np.unique(rows.keys[members, key], return_inverse=True) for key in (across, up))
    if min(len(x), len(y)) <= most_cuts:
        return None
    grid = Grid(across, up, x, y, np.empty((0, 0), dtype=np.int64), rows.fixed(row, (across, up)), len(members) == len(rows.keys))
    if 2 * len(members) >= len(x) * len(y):
        grid.rows = np.full((len(y), len(x)), -1)
        grid.rows[line[::-1], column[::-1]] = members[::-1]  # the first of equal ones stays
        return grid
    return _from_lines(grid, members, rows.keys[members, across], line) if len(members) >= _LEAST_OF_A_LINE * len(y) else None


def _from_lines(grid: Grid, members: NDArray[np.int64], at: Floats, line: NDArray[np.int64]) -> Grid:
    """Lines of different lengths, as those of directions spread evenly over a sphere: each place holds the nearest row of its line."""
    grid.x = np.sort(at[line == np.argmax(np.bincount(line))])
    grid.rows = np.full((len(grid.y), len(grid.x)), -1)
    for up in range(len(grid.y)):
        there, values = members[line == up], at[line == up]
        away = np.abs(grid.x[:, None] - values[None, :])
        if grid.across in (PHI, RX_PHI):
            away = np.minimum(away % 360.0, -away % 360.0)
        step = max(float(np.ptp(values)) / max(len(values) - 1, 1), 1e-9) if len(values) > 1 else np.inf
        nearest = np.argmin(away, axis=1)
        grid.rows[up] = np.where(away[np.arange(len(grid.x)), nearest] <= step, there[nearest], -1)
    return grid


def channels_of(results: list[Rows], asked: list[int]) -> list[int]:
    """Channels to be drawn: those asked for, or else those of all results within 80 dB of the peak, of several results the co-polar ones."""
    for rows in results:
        for channel in asked:
            if not rows.has_channel[channel]:
                raise InputError(f"--channels {CHANNELS[channel]}: {rows.file} has no such channel; leave it out")
    if asked:
        return asked
    held = [c for c in range(4) if all(rows.has_channel[c] for rows in results)]
    if not held:
        raise InputError("the results have no channel in common; plot them one by one")
    peaks = {c: max(rows.peak([c]) for rows in results) for c in held}
    kept = [c for c in held if peaks[c] >= max(peaks.values()) - 80.0]
    co_polar = [c for c in kept if c in (0, 3)]
    return co_polar if len(results) > 1 and co_polar else kept


def _groups(keys: Floats) -> NDArray[np.int64]:
    """The number of each row's key among the different ones, in the order of their first rows."""
    import pandas

    return np.asarray(pandas.DataFrame(keys).groupby(list(range(keys.shape[1])), sort=False).ngroup())

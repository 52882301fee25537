"""Two results or images compared."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from raytube import _arguments, _core
from raytube._core import InputError
from raytube._image_comparison import ImageComparison, are_images, read_image
from raytube._radar_explorer import read_radar_explorer
from raytube._result import Result
from raytube._tables import ranges_of


class Comparison:
    """How far a result is from a reference, channel by channel.

    Attributes
    ----------
    channels : dict of str to dict
        Measures for each channel that both results have and that has a signal: ``rms_db``, ``mean_abs_db``,
        ``median_abs_db``, ``p95_abs_db``, ``largest_abs_db``, ``bias_db`` over the rows within `within_db` of the reference's peak;
        ``relative_error`` (complex), ``austin_db``, ``correlation`` over all rows.
    relative_error : float
        ``||S - S_ref|| / ||S_ref||`` over all rows and channels; infinite if either lacks rows, channels or phase.
    rows : int
        Rows that both have; for images, pixels.
    shift : tuple of float or None
        For images, the shift of the result along columns and rows that was removed [pixels of the reference]. Their `channels` also have
        ``ssim``, ``correlation`` (of magnitudes), ``magnitude_error`` and ``power_ratio_db``, but no ``austin_db``.
    """

    def __init__(self, core: _core.Comparison | ImageComparison) -> None:
        self._core = core
        self.shift: tuple[float, float] | None = None if isinstance(core, _core.Comparison) else core.shift
        self.channels: dict[str, dict[str, float]] = core.channels
        self.relative_error: float = core.relative_error
        self.rows: int = core.rows

    def within(self, tolerance_db: float) -> bool:
        """True if the rms error of no channel exceeds the tolerance.

        Parameters
        ----------
        tolerance_db : float
            Largest ``rms_db`` allowed in any of `channels` [dB].
        """
        return self._core.above_tolerance(_arguments.number(tolerance_db, "tolerance_db")) == ""

    def __repr__(self) -> str:
        return self._core.text


def compare(result: Any, reference: Any, within_db: float = 20.0, only: Mapping[str, Any] | None = None,
            free_scale: bool = False, result_columns: str | Mapping[str, str] = "", reference_columns: str | Mapping[str, str] = "",
            register: bool = True) -> Comparison:
    """Compares two results from any source in the rows with equal frequency and angles, or two registered images.

    Parameters
    ----------
    result, reference : Result or path
        What `solve`, `load` or `read_radar_explorer` gave, or a file: ``.nc``, a table with a header (``rcs.csv`` and others, see ``raytube compare --help``), or
        the ``.json`` of the Radar Explorer Toolkit. Images are files: ``image.csv``, what ``raytube isar`` writes, a table with a row
        for each pixel, OpenEXR.
    within_db : float
        Measures in dB cover the rows whose reference lies within this of its channel's peak.
    only : dict, optional
        Compare only these rows: ``{"phi_deg": (-45, 45), "freq_hz": 10e9}``.
    free_scale : bool
        Fit one complex factor first.
    result_columns, reference_columns : str or dict of str to str
        Columns of a table that have other names or units: ``{"phi_deg": "bearing*-1", "sigma_vv_dbsm": '"RCS [dBsm]"'}``, or one string in the
        form that ``raytube compare --reference-columns`` takes.
    register : bool
        For images: first shift one onto the other.

    Returns
    -------
    Comparison
        Its ``repr`` is the table that ``raytube compare`` prints.

    Raises
    ------
    InputError
        If a file cannot be read, or if the two have nothing in common.
    """
    ranges = {column: (low, high) for column, low, high in ranges_of(only)}
    within = _arguments.number(within_db, "within_db")
    if within < 0.0:
        raise InputError(f"within_db: give 0 or more decibels (found {within:g})")
    scale, registered = _arguments.flag(free_scale, "free_scale"), _arguments.flag(register, "register")
    both = (result, "result", result_columns), (reference, "reference", reference_columns)
    if not any(isinstance(source, Result) or str(source).lower().endswith(".json") for source, _, _ in both):  # which are no images
        files = [(_file(source, name), _columns(columns, f"{name}_columns")) for source, name, columns in both]
        if are_images(files[0], files[1]):
            if ranges:
                raise InputError("only: images have no rows of looks; leave it out")
            images = read_image(*files[0], "result_columns"), read_image(*files[1], "reference_columns")
            return Comparison(ImageComparison(*images, within, scale, registered))
    tables = [table_of(source, name, columns, f"{name}_columns")[0] for source, name, columns in both]
    return Comparison(_core.compare(tables[0], tables[1], ranges, within, scale))


def table_of(source: Any, name: str, columns: Any, option: str) -> tuple[_core.Table, str]:
    """The rows of a result of any source, and what sentences call it."""
    chosen = _columns(columns, option)
    stored = source if isinstance(source, Result) else None
    file = name if stored else _file(source, name)
    if file.lower().endswith(".json"):
        stored = read_radar_explorer(file)
    if stored is None:
        return _core.Table.of_file(file, chosen, option), file
    if chosen:
        raise InputError(f"{option}: {file} is not a table, so its columns have no other names; leave them out")
    return _core.Table.of_stored(stored._stored, file), file


def _file(source: Any, name: str) -> str:
    if not isinstance(source, (str, os.PathLike)):
        raise InputError(f"{name}: give a Result or the path of a file (found {_arguments.kind_of(source)})")
    return _arguments.path(source, name)


def _columns(columns: Any, name: str) -> str:
    if isinstance(columns, Mapping):
        return ",".join(f"{_arguments.text(ours, name)}={_arguments.text(theirs, name)}" for ours, theirs in columns.items())
    return _arguments.text(columns, name)

"""Interchange with the Radar Explorer Toolkit of Ansys: metadata in JSON, one channel in an HDF5 file that pandas reads."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from raytube import _arguments, _core
from raytube._arguments import CHANNELS
from raytube._command import new_files
from raytube._core import InputError
from raytube._result import Result
from raytube._tables import keys_of

# value = sqrt(4 pi) S: |value|^2 is sigma in m^2; time factor and angles are those of raytube.
_SCALE = np.sqrt(4.0 * np.pi)
_LEVELS = ["Freq", "IWavePhi", "IWaveTheta"]
_HERTZ = {"Hz": 1.0, "kHz": 1e3, "MHz": 1e6, "GHz": 1e9, "THz": 1e12}
_KEY = "df"


def write_radar_explorer(result: Result, folder: str | os.PathLike[str], name: str | None = None, channels: Sequence[str] = CHANNELS,
                         geometry: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] = ()) -> list[Path]:
    """See `Result.to_radar_explorer`."""
    if result._stored.bistatic:
        raise InputError("to_radar_explorer: these files hold monostatic results; this one is bistatic")
    directions = np.column_stack([result._stored.phi_deg, result._stored.theta_deg])
    if len(np.unique(directions, axis=0)) < len(directions) or len(np.unique(result._stored.frequency_hz)) < result.S.shape[1]:
        raise InputError("to_radar_explorer: a look or a frequency is there twice; these files hold each once")
    place = Path(_arguments.path(folder, "to_radar_explorer"))
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{place}: no folder can be made there ({error.strerror}); name another one") from None
    title = _arguments.text(name or result.title or "raytube", "to_radar_explorer: name")
    title = "".join(c if c.isalnum() or c in "-_" else "_" for c in title)
    given = [geometry] if isinstance(geometry, (str, os.PathLike)) else geometry
    files = [Path(_arguments.path(file, "to_radar_explorer: geometry")) for file in given]
    return [_write_channel(result, place, title, channel, files) for channel in channels]


def read_radar_explorer(file: str | os.PathLike[str]) -> Result:
    """Reads a result in the form of the Radar Explorer Toolkit.

    Parameters
    ----------
    file : path
        The metadata file of one channel (``.json``). Those of other channels are read as well if they lie beside it under the same name
        with another channel at its beginning: ``HH_name.json``, ``VV_name.json``.

    Returns
    -------
    Result
        Channels without a file are NaN. Its ``attributes`` hold the metadata.

    Raises
    ------
    InputError
        If a file is missing or holds something else.
    """
    path = Path(_arguments.path(file, "read_radar_explorer"))
    channel, frame, metadata = _read_channel(path)
    frames = {channel: frame}
    for other in CHANNELS if path.name[:2].lower() == channel else ():
        beside = path.with_name(other.upper() + path.name[2:])
        if other != channel and beside.is_file():
            found, frame, _ = _read_channel(beside)
            frames[found] = frame
    return _result_of(frames, metadata, path)


def _write_channel(result: Result, folder: Path, name: str, channel: str, geometry: list[Path]) -> Path:
    import pandas

    hertz, theta, phi, *_ = keys_of(result._stored).T
    index, upper = pandas.MultiIndex.from_arrays([hertz / 1e9, phi, theta], names=_LEVELS), channel.upper()
    frame = pandas.DataFrame({upper: _SCALE * result._stored.S.reshape(-1, 4)[:, CHANNELS.index(channel)]}, index).sort_index()
    with new_files(folder) as beside:
        frame.to_hdf(beside / f"{upper}_data_{name}.h5", key=_KEY, mode="w", format="table")
        text = {"solution": name, "monostatic_file": f"{upper}_data_{name}.h5", "model_units": "meter", "frequency_units": "GHz",
                "model_info": {part.stem: [part.name, [143, 175, 143], 1.0, "meter"] for part in geometry}}
        (beside / f"{upper}_{name}.json").write_text(json.dumps(text, indent=2))
    return folder / f"{upper}_{name}.json"


def _read_channel(path: Path) -> tuple[str, Any, dict[str, Any]]:
    import pandas

    try:
        metadata = json.loads(path.read_text(encoding="utf-8"))
        data = path.parent / metadata["monostatic_file"]
        unit = metadata["frequency_units"]
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); give a metadata file of the Radar Explorer Toolkit") from None
    except (ValueError, KeyError, TypeError):
        raise InputError(f"{path}: is no metadata file of the Radar Explorer Toolkit: no JSON with monostatic_file and frequency_units") from None
    if unit not in _HERTZ:
        raise InputError(f"{path}: frequency_units {unit!r} is unknown; write one of {', '.join(_HERTZ)}")
    try:
        frame = pandas.read_hdf(data)
    except (OSError, ValueError, KeyError, TypeError, RuntimeError):  # what pandas and PyTables throw for odd files
        raise InputError(f"{data}, named in {path}: cannot be read as a table of pandas; give the .h5 that belongs to it") from None
    if list(frame.index.names) != _LEVELS or len(frame.columns) != 1 or str(frame.columns[0]).lower() not in CHANNELS:
        raise InputError(f"{data}: needs one column named after a channel (HH, HV, VH, VV) and the index {', '.join(_LEVELS)}")
    channel = str(frame.columns[0]).lower()
    frame = frame.rename(columns={frame.columns[0]: channel})
    frame.index = frame.index.set_levels(np.round(frame.index.levels[0] * _HERTZ[unit], 6), level=0)
    return channel, frame, metadata


def _result_of(frames: dict[str, Any], metadata: dict[str, Any], path: Path) -> Result:
    import pandas

    table = pandas.concat(frames.values(), axis=1).sort_index()
    frequencies = table.index.levels[0].to_numpy()
    directions = table.index.droplevel(0).unique()
    looks = np.array([[theta, phi, theta, phi] for phi, theta in directions])
    if len(table) != len(frequencies) * len(looks):
        raise InputError(f"{path}: not every direction is there at every frequency; raytube's results have all of them")
    columns = table.reindex(columns=list(CHANNELS), fill_value=complex(np.nan, np.nan)).to_numpy().reshape(len(frequencies), len(looks), 2, 2)
    s = np.ascontiguousarray(columns.swapaxes(0, 1)) / _SCALE
    attributes = [("title", str(metadata.get("solution", path.stem))), ("source", "Radar Explorer Toolkit"),
                  ("radar_explorer", json.dumps(metadata))]
    return Result(_core.Stored.from_arrays(frequencies, looks, False, s, attributes))

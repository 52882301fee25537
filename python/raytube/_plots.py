"""Pictures of results, profiles and images. The only module that imports matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from raytube._core import InputError

if TYPE_CHECKING:
    from xarray import DataArray

    from raytube._products import IsarImage, RangeProfiles
    from raytube._result import Result

_ANGLES = {"phi_deg": "azimuth φ (degrees)", "theta_deg": "polar angle θ (degrees)", "rx_phi_deg": "azimuth φ of the receiver (degrees)",
           "rx_theta_deg": "polar angle θ of the receiver (degrees)"}
_SYMBOLS = {"theta_deg": "θ", "phi_deg": "φ", "rx_theta_deg": "θ of the receiver", "rx_phi_deg": "φ of the receiver"}
_DEPTH = 80.0  # below the peak there is nothing to see [dB]
_MAP_DEPTH = 50.0  # and in colours less


def plot(result: Result, channels: tuple[str, ...], ax: Any) -> Any:
    import matplotlib.pyplot as plt

    ax = ax or plt.subplots(constrained_layout=True)[1]
    looks, frequencies = result.S.shape[:2]
    grid = _grid(result) if frequencies == 1 else None
    if looks > 1 and frequencies > 1:
        x, label = _swept(result)
        _map(result, channels[0], ax, (x, label), (result._stored.frequency_hz / 1e9, "frequency (GHz)"), False)
    elif grid:
        _map(result, channels[0], ax, *grid)
    elif frequencies > 1:
        _curves(result, channels, ax, result._stored.frequency_hz / 1e9, "frequency (GHz)", 0)
    else:
        x, label = _swept(result)
        _curves(result, channels, ax, x, label, 1)
    ax.set_title(_title(result))
    return ax


def plot_polar(result: Result, channels: tuple[str, ...], ax: Any) -> Any:
    import matplotlib.pyplot as plt

    x, label = _swept(result)
    if "azimuth" not in label or result.S.shape[1] != 1:
        raise InputError("plot_polar: needs looks that differ in one azimuth, at one frequency; choose these, or use plot")
    ax = ax or plt.subplots(subplot_kw={"projection": "polar"}, constrained_layout=True)[1]
    floor = _peak(result.sigma_dbsm.sel(channel=list(channels)).values) - 60.0
    for channel in channels:
        ax.plot(np.radians(x), np.maximum(result.sigma_dbsm.sel(channel=channel).values[:, 0], floor), label=channel.upper())
    ax.set_rlabel_position(90)
    ax.set_ylim(bottom=floor)
    ax.set_title(f"{_title(result)}\nσ (dBsm) against {label}")
    ax.legend(loc="lower left", bbox_to_anchor=(-0.15, -0.1))
    return ax


def plot_profiles(profiles: RangeProfiles, channels: tuple[str, ...], ax: Any) -> Any:
    import matplotlib.pyplot as plt

    ax = ax or plt.subplots(constrained_layout=True)[1]
    sigma, ranges = profiles["sigma_dbsm"].sel(channel=list(channels)), profiles["range_m"].values
    if "look" in sigma.dims:
        varying = [name for name in _ANGLES if name in profiles.coords and np.ptp(profiles[name].values) > 0.0]
        y, label = (profiles[varying[0]].values, _ANGLES[varying[0]]) if len(varying) == 1 else (np.arange(sigma.sizes["look"]), "look")
        levels = sigma.sel(channel=channels[0]).transpose("look", "range_m").values
        _colours(ax, (ranges, "range (m)"), (y, label), levels, channels[0])
    else:
        for channel in channels:
            ax.plot(ranges, sigma.sel(channel=channel).values, label=channel.upper())
        ax.set_ylim(bottom=max(ax.get_ylim()[0], _peak(sigma.values) - _DEPTH))
        ax.set_xlabel("range (m)")
        ax.set_ylabel("σ (dBsm)")
        ax.grid(alpha=0.3)
        ax.legend()
    ax.set_title(profiles.attrs["title"])
    return ax


def plot_isar(image: IsarImage, channel: str, ax: Any, edges: DataArray | None) -> Any:
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection

    ax = ax or plt.subplots(constrained_layout=True)[1]
    sigma, up = image["sigma_dbsm"].sel(channel=channel), "range"
    if "height_m" in sigma.dims:
        sigma, up = sigma.max("range_m"), "height"
    levels = sigma.transpose(f"{up}_m", "cross_range_m").values
    _colours(ax, (image["cross_range_m"].values, "cross-range (m)"), (image[f"{up}_m"].values, f"{up} (m)"), levels, channel)
    if edges is not None:
        axes = np.array([image.attrs["cross_range_direction"], image.attrs[f"{up}_direction"]])
        limits = ax.get_xlim(), ax.get_ylim()
        ax.add_collection(LineCollection(list(edges.transpose("edge", "end", "xyz").values @ axes.T), colors="white", linewidths=0.4, alpha=0.6))
        ax.set(xlim=limits[0], ylim=limits[1])
    ax.set_aspect("equal")
    ax.set_title(image.attrs["title"])
    return ax


def _title(result: Result) -> str:
    """The title of the case, and what all rows have in common."""
    words = [result.title] if result.title else []
    if result.S.shape[1] == 1:
        words.append(f"{result._stored.frequency_hz[0] / 1e9:g} GHz")
    for name, symbol in _SYMBOLS.items():
        angles = getattr(result._stored, name)
        if np.ptp(angles) == 0.0 and (result._stored.bistatic or not name.startswith("rx_")):
            words.append(f"{symbol} = {angles[0]:g}°")
    return ", ".join(words)


def _peak(sigma: NDArray[np.float64]) -> float:
    return float(np.max(sigma[np.isfinite(sigma)], initial=-300.0))


def _varying(result: Result) -> list[str]:
    varying = [name for name in _ANGLES if np.ptp(getattr(result._stored, name)) > 0.0]
    return varying if result._stored.bistatic else [name for name in varying if not name.startswith("rx_")]


def _grid(result: Result) -> tuple[tuple[NDArray[Any], str], tuple[NDArray[Any], str], bool] | None:
    """Two angles, each value of one with each of the other: what goes across and up, and whether looks run across first."""
    varying = _varying(result)
    if len(varying) != 2:
        return None
    across, up = varying  # an azimuth comes before its polar angle
    for fast, slow, across_first in ((across, up, True), (up, across, False)):
        fast_values, slow_values = getattr(result._stored, fast), getattr(result._stored, slow)
        run = int(np.argmax(slow_values != slow_values[0]))
        if run > 1 and len(fast_values) % run == 0:
            rows, columns = fast_values.reshape(-1, run), slow_values.reshape(-1, run)
            if np.all(rows == rows[0]) and np.all(columns == columns[:, :1]):
                values = {fast: rows[0], slow: columns[:, 0]}
                return (values[across], _ANGLES[across]), (values[up], _ANGLES[up]), across_first
    return None


def _swept(result: Result) -> tuple[NDArray[Any], str]:
    varying = _varying(result)
    if len(varying) == 1:
        return getattr(result._stored, varying[0]), _ANGLES[varying[0]]
    return np.arange(result.S.shape[0]), "look"


def _curves(result: Result, channels: tuple[str, ...], ax: Any, x: NDArray[Any], label: str, axis: int) -> None:
    marker = "o" if len(x) == 1 else ""
    for channel in channels:
        sigma = result.sigma_dbsm.sel(channel=channel).values
        ax.plot(x, sigma[:, 0] if axis == 1 else sigma[0], marker=marker, label=channel.upper())
    peak = _peak(result.sigma_dbsm.sel(channel=list(channels)).values)
    ax.set_ylim(bottom=max(ax.get_ylim()[0], peak - _DEPTH))
    ax.set_xlabel(label)
    ax.set_ylabel("σ (dBsm)")
    ax.grid(alpha=0.3)
    ax.legend()


def _map(result: Result, channel: str, ax: Any, across: tuple[NDArray[Any], str], up: tuple[NDArray[Any], str], across_first: bool) -> None:
    (x, x_label), (y, y_label) = across, up
    sigma = result.sigma_dbsm.sel(channel=channel).values.reshape((len(y), len(x)) if across_first else (len(x), len(y)))
    _colours(ax, (x, x_label), (y, y_label), sigma if across_first else sigma.T, channel)


def _colours(ax: Any, across: tuple[NDArray[Any], str], up: tuple[NDArray[Any], str], sigma: NDArray[Any], channel: str) -> None:
    """Levels [up, across]."""
    peak = _peak(sigma)
    lowest = max(float(np.min(sigma[np.isfinite(sigma)], initial=peak)), peak - _MAP_DEPTH)
    mesh = ax.pcolormesh(across[0], up[0], sigma, shading="nearest", vmin=lowest, vmax=peak)
    ax.set_xlabel(across[1])
    ax.set_ylabel(up[1])
    ax.figure.colorbar(mesh, ax=ax, label=f"σ, {channel.upper()} (dBsm)")

"""Pictures of results. The only module that imports matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from raytube._core import InputError

if TYPE_CHECKING:
    from raytube._result import Result

_ANGLES = {"phi_deg": "azimuth φ (degrees)", "theta_deg": "polar angle θ (degrees)", "rx_phi_deg": "azimuth φ of the receiver (degrees)",
           "rx_theta_deg": "polar angle θ of the receiver (degrees)"}


def plot(result: Result, channels: tuple[str, ...], ax: Any) -> Any:
    import matplotlib.pyplot as plt

    ax = ax or plt.subplots(constrained_layout=True)[1]
    looks, frequencies = result.S.shape[:2]
    if looks > 1 and frequencies > 1:
        _map(result, channels[0], ax)
    elif frequencies > 1:
        _curves(result, channels, ax, result._stored.frequency_hz / 1e9, "frequency (GHz)", 0)
    else:
        x, label = _swept(result)
        _curves(result, channels, ax, x, label, 1)
    ax.set_title(result.title)
    return ax


def plot_polar(result: Result, channels: tuple[str, ...], ax: Any) -> Any:
    import matplotlib.pyplot as plt

    x, label = _swept(result)
    if "azimuth" not in label or result.S.shape[1] != 1:
        raise InputError("plot_polar: needs looks that differ in one azimuth, at one frequency; choose these, or use plot")
    ax = ax or plt.subplots(subplot_kw={"projection": "polar"}, constrained_layout=True)[1]
    floor = np.nanmax(result.sigma_dbsm.values) - 60.0
    for channel in channels:
        ax.plot(np.radians(x), np.maximum(result.sigma_dbsm.sel(channel=channel).values[:, 0], floor), label=channel.upper())
    ax.set_rlabel_position(90)
    ax.set_title(f"{result.title}\nσ in dBsm")
    ax.legend(loc="lower left", bbox_to_anchor=(-0.1, -0.1))
    return ax


def _swept(result: Result) -> tuple[np.ndarray, str]:
    varying = [name for name in _ANGLES if np.ptp(getattr(result._stored, name)) > 0.0]
    if not result._stored.bistatic:
        varying = [name for name in varying if not name.startswith("rx_")]
    if len(varying) == 1:
        return getattr(result._stored, varying[0]), _ANGLES[varying[0]]
    return np.arange(result.S.shape[0]), "look"


def _curves(result: Result, channels: tuple[str, ...], ax: Any, x: np.ndarray, label: str, axis: int) -> None:
    marker = "o" if len(x) == 1 else ""
    for channel in channels:
        sigma = result.sigma_dbsm.sel(channel=channel).values
        ax.plot(x, sigma[:, 0] if axis == 1 else sigma[0], marker=marker, label=channel.upper())
    ax.set_xlabel(label)
    ax.set_ylabel("σ (dBsm)")
    ax.grid(alpha=0.3)
    ax.legend()


def _map(result: Result, channel: str, ax: Any) -> None:
    x, label = _swept(result)
    sigma = result.sigma_dbsm.sel(channel=channel).values
    peak = np.nanmax(sigma)
    mesh = ax.pcolormesh(x, result._stored.frequency_hz / 1e9, sigma.T, shading="nearest", vmin=peak - 50.0, vmax=peak)
    ax.set_xlabel(label)
    ax.set_ylabel("frequency (GHz)")
    ax.figure.colorbar(mesh, ax=ax, label=f"σ, {channel.upper()} (dBsm)")

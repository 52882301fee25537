"""Range profiles and images of results, as datasets that draw themselves. The only module that needs xarray when it is loaded."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from raytube import _arguments, _core
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._geometry import Outline, drawn_lines
from raytube._tables import dbsm

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from raytube._result import Result
    from raytube._target import Target

    _Dataset: Any  # xarray's own types come with some of its versions alone
else:
    _Dataset = xr.Dataset

_WINDOWS = ("rectangular", "hann", "hamming", "taylor", "kaiser")
_SHAPED = ("taylor", "kaiser")
_USUAL_SIDELOBE_DB = 35.0
_AXES = {"range_m": "range", "cross_range_m": "cross-range", "height_m": "height"}
_MOST_PADDING, _MOST_PIXELS, _LONGEST = 64, 32.0, 1e6


class RangeProfiles(_Dataset):  # type: ignore[misc]
    """Range profiles of one look (range_m, channel), or of many (look, range_m, channel). Made by `Result.range_profile` and
    `Result.waterfall`.

    ``S`` is p(R) [m], complex; ``sigma_dbsm`` its level; ``error_dbsm`` and ``model_dbsm`` (channel) what numerical error and model
    uncertainty come to if all of either were at one range. ``range_m`` [m] counts from the origin of the mesh's coordinates along the line of
    sight, away from the radar; of a bistatic look it is half of the additional path. ``attrs``: ``range_resolution_m`` (3 dB width of a
    point), ``range_unambiguous_m`` (what is so much farther appears at the same range), ``window``.
    """

    __slots__ = ()

    def plot(self, channels: Any = ("vv", "hh"), ax: Axes | None = None) -> Axes:
        """Draws sigma against range, a curve a channel; of many looks a map of the first channel over range and looks.

        Parameters
        ----------
        channels : str or tuple of str
            Among "vv", "vh", "hv", "hh".
        ax : matplotlib Axes, optional
            Default: a new figure.

        Returns
        -------
        matplotlib Axes
        """
        from raytube import _plots

        return _plots.plot_profiles(self, _arguments.channels(channels, "plot"), ax)


class IsarImage(_Dataset):  # type: ignore[misc]
    """An image in the coordinates range_m, cross_range_m and, in space, height_m. Made by `Result.isar` and `Result.isar_3d`.

    ``S`` is I(x) [m], complex; ``sigma_dbsm`` its level; ``outline`` has the ends of the target's edges and of its silhouette across the
    image, in its own coordinates [m], where the target is known. ``attrs``: of each axis ``..._direction``, a unit vector in the coordinates of the target (a cell's place is the
    sum of its coordinates times these), ``..._resolution_m`` and ``..._unambiguous_m``; ``frequency_hz``, ``theta_deg``,
    ``phi_deg``: the lowest and the highest one of the sweep. Range is away from the radar in the middle of the
    angles, height upwards as seen from there; with azimuth alone range and cross-range lie in the plane z = 0.
    """

    __slots__ = ()

    def plot(self, channel: str | None = None, ax: Axes | None = None,
             target: Target | None = None) -> Axes:
        """Draws sigma, range upwards and cross-range to the right, and over it edges and silhouette of the target where it is known; of
        an image in space what the radar sees: height upwards, the strongest cell along the range.

        Parameters
        ----------
        channel : str, optional
            "vv", "vh", "hv" or "hh"; default "vv", or the first one that has numbers.
        ax : matplotlib Axes, optional
            Default: a new figure.
        target : Target, optional
            Its edges and silhouette are drawn, for an image that does not know them.

        Returns
        -------
        matplotlib Axes
        """
        from raytube import _plots
        from raytube._jobs import outline_of

        known = [name for name in CHANNELS if not np.all(np.isnan(self["sigma_dbsm"].sel(channel=name).values))]
        chosen = _arguments.channels(channel, "plot")[0] if channel is not None else (known or ["vv"])[0]
        return _plots.plot_isar(self, chosen, ax,
                                outline_over(self, outline_of(target)) if target is not None else self.get("outline"))


def range_profile(result: Result, look: Any, window: Any, sidelobe_db: Any, padding: Any) -> RangeProfiles:
    """See `Result.range_profile`."""
    index = _arguments.whole(look, "look")
    looks = result.S.sizes["look"]
    if index >= looks:
        raise InputError(f"look {index}: there are {looks} direction pair(s), counted from 0; choose among these")
    profiles: RangeProfiles = _profiles(result, index, window, sidelobe_db, padding).isel(look=0)
    return profiles


def waterfall(result: Result, window: Any, sidelobe_db: Any, padding: Any) -> RangeProfiles:
    """See `Result.waterfall`."""
    return _profiles(result, None, window, sidelobe_db, padding)


def isar(result: Result, size: Any, pixels: Any, window: Any, sidelobe_db: Any, axes: int) -> IsarImage:
    """See `Result.isar` and `Result.isar_3d`."""
    kind, sidelobes = _window(window, sidelobe_db)
    density = _between(pixels, "pixels", 1.0, _MOST_PIXELS)
    lengths = _size(size, axes)
    _check_angles(result, axes)
    outermost = result._outline[0] if result._outline is not None else np.empty((0, 3))
    found, s = _core.isar(result._stored, outermost.tolist(), lengths, density, kind, sidelobes)
    names = tuple(_AXES)[:axes]
    coordinates = {name: (name, axis["at_m"], {"units": "m", "long_name": _AXES[name]}) for name, axis in zip(names, found)}
    stored = result._stored
    attributes: dict[str, Any] = {"title": result.title, "window": _window_text(kind, sidelobes)}
    for name, values in (("frequency_hz", stored.frequency_hz), ("theta_deg", stored.theta_deg), ("phi_deg", stored.phi_deg)):
        attributes[name] = (float(values.min()), float(values.max()))
    for name, axis in zip(names, found):
        plain = name.removesuffix("_m")
        attributes |= {f"{plain}_direction": axis["direction"], f"{plain}_resolution_m": axis["resolution_m"],
                       f"{plain}_unambiguous_m": axis["unambiguous_m"]}
    variables = _levels((*names, "channel"), s, "ISAR image I")
    image = IsarImage(variables, coordinates | {"channel": list(CHANNELS)}, attributes)
    if result._outline is not None:
        image["outline"] = outline_over(image, result._outline)
    return image


def outline_over(image: xr.Dataset, outline: Outline) -> xr.DataArray:
    """Edges and silhouette of a target as they are seen across an image."""
    up = "height" if "height_m" in image.dims else "range"
    lines, last = drawn_lines(outline, [image.attrs["cross_range_direction"], image.attrs[f"{up}_direction"]])
    return xr.DataArray(lines, dims=("edge", "end", "xyz"),
                        attrs={"units": "m", "long_name": "edges of the target, and last its silhouette", "silhouette": last})


def _profiles(result: Result, look: int | None, window: Any, sidelobe_db: Any, padding: Any) -> RangeProfiles:
    kind, sidelobes = _window(window, sidelobe_db)
    ranges = _arguments.whole(padding, "padding", _MOST_PADDING)
    if ranges == 0:
        raise InputError(f"padding: give a whole number from 1 to {_MOST_PADDING} (found 0)")
    outermost = result._outline[0].tolist() if result._outline is not None else []
    made = _core.range_profiles(result._stored, look, outermost, kind, sidelobes, ranges)
    angles = {name: result.S.coords[name] for name in result.S.coords if result.S.coords[name].dims == ("look",)}
    if look is not None:
        angles = {name: values.isel(look=[look]) for name, values in angles.items()}
    coordinates = angles | {"range_m": ("range_m", made["range_m"], {"units": "m", "long_name": "range"}), "channel": list(CHANNELS)}
    variables = _levels(("look", "range_m", "channel"), made["S"], "range profile p")
    for name, values, text in (("error_dbsm", made["error_m"], "numerical error if all of it were at one range"),
                               ("model_dbsm", made["model_m"], "model uncertainty if all of it were at one range")):
        variables[name] = (("look", "channel"), dbsm(values[:, 0]), {"units": "dBsm", "long_name": text})
    attributes = {"title": result.title, "window": _window_text(kind, sidelobes), "range_resolution_m": made["resolution_m"],
                  "range_unambiguous_m": made["unambiguous_m"],
                  "range_direction": "away from the radar along the line of sight, from the origin of the mesh's coordinates; of a bistatic "
                                     "look half of the additional path"}
    return RangeProfiles(variables, coordinates, attributes)


def _levels(dims: tuple[str, ...], s: NDArray[np.complex128], name: str) -> dict[str, Any]:
    return {"S": (dims, s, {"units": "m", "long_name": name}),
            "sigma_dbsm": (dims, dbsm(s), {"units": "dBsm", "long_name": "radar cross-section"})}


def _window(window: Any, sidelobe_db: Any) -> tuple[str, float]:
    kind = _arguments.text(window, "window").lower()
    if kind not in _WINDOWS:
        raise InputError(f"window: choose among {', '.join(_WINDOWS)} (found {kind!r:.40})")
    level = _between(sidelobe_db, "sidelobe_db", *_core.sidelobe_limits_db())
    if kind not in _SHAPED and level != _USUAL_SIDELOBE_DB:
        raise InputError(f"sidelobe_db: a {kind} window has side lobes of its own; leave it out, or choose taylor or kaiser")
    return kind, level


def _window_text(kind: str, sidelobe_db: float) -> str:
    return f"{kind}, {sidelobe_db:g} dB" if kind in _SHAPED else kind


def _between(value: Any, name: str, least: float, most: float) -> float:
    number = _arguments.number(value, name)
    if not least <= number <= most:
        raise InputError(f"{name}: give a number from {least:g} to {most:g} (found {number:g})")
    return number


def _size(size: Any, axes: int) -> list[float]:
    if size is None:
        return []
    lengths = _arguments.numbers(size, "size")
    if lengths.shape == ():
        lengths = np.full(axes, float(lengths))
    if lengths.shape != (axes,) or not np.all(np.isfinite(lengths) & (lengths > 0.0) & (lengths <= _LONGEST)):
        raise InputError(f"size: give a positive length in metres, or {axes} of them along {', '.join(list(_AXES.values())[:axes])}")
    return [float(length) for length in lengths]


def _check_angles(result: Result, axes: int) -> None:
    both = np.ptp(result._stored.theta_deg) > 0.0 and np.ptp(result._stored.phi_deg) > 0.0
    if both and axes == 2:
        raise InputError("isar: the looks vary in theta and in phi, which makes an image in space; use isar_3d, or choose looks of one theta")
    if not both and axes == 3:
        raise InputError("isar_3d: an image in space needs looks over theta and phi both; use isar for one of them")


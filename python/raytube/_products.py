"""Range profiles, images and Doppler of results, as datasets that draw themselves. The only module that needs xarray when it is loaded."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from raytube import _arguments, _core
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._tables import Floats, dbsm

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from raytube._result import Result
    from raytube._target import Target

    _Dataset: Any  # xarray's own types come with some of its versions alone
else:
    _Dataset = xr.Dataset

Outline = tuple[Floats, Floats, NDArray[np.float32]]  # points as wide as the target, its edges, its triangles [m]
_SILHOUETTE_PIXELS = 1600  # along its longer side
_WINDOWS = ("rectangular", "hann", "hamming", "taylor", "kaiser")
_SHAPED = ("taylor", "kaiser")
_USUAL_SIDELOBE_DB = 35.0
_AXES = {"range_m": "range", "cross_range_m": "cross-range", "height_m": "height"}
_MOST_PADDING, _MOST_PIXELS, _LONGEST = 64, 32.0, 1e6
_MOST_OVERLAP, _LIGHT = 0.999, 299792458.0


class RangeProfiles(_Dataset):  # type: ignore[misc]
    """Range profiles of one look (range_m, channel), or of many (look, range_m, channel). Made by `Result.range_profile` and
    `Result.waterfall`.

    ``S`` is p(R) [m], complex; ``sigma_dbsm`` its level; ``error_dbsm`` and ``model_dbsm`` (channel) are the levels of the numerical error and
    of the model uncertainty if all of either were at one range. ``range_m`` [m] is counted from the origin of the mesh's coordinates along the
    line of sight, away from the radar; for a bistatic look it is half of the additional path. ``attrs``: ``range_resolution_m`` (3 dB width of a
    point), ``range_unambiguous_m`` (a point farther away by this appears at the same range), ``window``.
    """

    __slots__ = ()

    def plot(self, channels: Any = ("vv", "hh"), ax: Axes | None = None) -> Axes:
        """Draws sigma against range, one curve per channel; for many looks, a map of the first channel over range and looks.

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

    ``S`` is I(x) [m], complex; ``sigma_dbsm`` its level; ``outline``, if the target is known, has the ends of its edges and of its silhouette
    across the image, in the target's coordinates [m]. ``attrs``: for each axis ``..._direction``, a unit vector in the coordinates of the
    target (a cell's place is the sum of its coordinates times these), ``..._resolution_m`` and ``..._unambiguous_m``; ``frequency_hz``,
    ``theta_deg``, ``phi_deg``: lowest and highest value of the sweep. Range increases away from the radar at the middle of the angles, height
    upwards as seen from there; for a sweep over azimuth alone, range and cross-range lie in the plane z = 0.
    """

    __slots__ = ()

    def plot(self, channel: str | None = None, ax: Axes | None = None,
             target: Target | None = None) -> Axes:
        """Draws sigma, range upwards and cross-range to the right, and over it edges and silhouette of the target if it is known. An image
        in space is drawn as the radar sees it: height upwards, the strongest cell along range.

        Parameters
        ----------
        channel : str, optional
            "vv", "vh", "hv" or "hh"; default "vv", or the first channel with values.
        ax : matplotlib Axes, optional
            Default: a new figure.
        target : Target, optional
            Target whose edges and silhouette are drawn, for an image without ``outline``.

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


class DopplerMap(_Dataset):  # type: ignore[misc]
    """A range-Doppler map in the coordinates range_m and velocity_m_per_s, with an array also cosine; of one frequency the Doppler spectrum,
    without range_m. Made by `Result.doppler`.

    ``S`` is M(R, v) [m], complex; ``sigma_dbsm`` its level. ``velocity_m_per_s`` is counted towards the radar, of a bistatic look half the rate
    at which the path shortens; ``doppler_hz`` the Doppler frequency 2 v / lambda. ``range_m`` [m] is that in the middle of the pulses, ``time_s``.
    ``cosine`` is that between the direction from the array and ``array_direction``. ``attrs``: ``doppler_frequency_hz``, the middle of the band;
    ``..._resolution...`` and ``..._unambiguous...`` of every axis; ``window``.
    """

    __slots__ = ()

    def plot(self, channel: str = "vv", ax: Axes | None = None) -> Axes:
        """Draws sigma: velocity to the right and range upwards, with an array the strongest cell along its cosine; of one frequency a curve.

        Parameters
        ----------
        channel : str
            "vv", "vh", "hv" or "hh".
        ax : matplotlib Axes, optional
            Default: a new figure.

        Returns
        -------
        matplotlib Axes
        """
        from raytube import _plots

        return _plots.plot_doppler(self, _arguments.channels(channel, "plot")[0], ax)


class Spectrogram(_Dataset):  # type: ignore[misc]
    """Velocities over time, in the coordinates time_s and velocity_m_per_s. Made by `Result.spectrogram`.

    ``sigma_dbsm``: the level of what has this velocity in the window of pulses about this time. Velocities as in `DopplerMap`. ``attrs``:
    ``doppler_frequency_hz``, ``velocity_resolution_m_per_s``, ``velocity_unambiguous_m_per_s``, ``window``, ``window_pulses``.
    """

    __slots__ = ()

    def plot(self, channel: str = "vv", ax: Axes | None = None) -> Axes:
        """Draws sigma, time to the right and velocity upwards.

        Parameters
        ----------
        channel : str
            "vv", "vh", "hv" or "hh".
        ax : matplotlib Axes, optional
            Default: a new figure.

        Returns
        -------
        matplotlib Axes
        """
        from raytube import _plots

        return _plots.plot_spectrogram(self, _arguments.channels(channel, "plot")[0], ax)


class RawData(_Dataset):  # type: ignore[misc]
    """The cube of data of pulses: ``S`` (pulse, frequency, receiver, receive, transmit) [m], complex. Made by `Result.raw`.

    A receiver is a look of a pulse. Coordinates: ``time_s`` (pulse) and ``frequency`` [Hz]; of antennas at a finite distance
    ``transmitter_m`` and ``receiver_m`` (pulse, receiver, xyz), their places in the coordinates of the mesh, of others
    ``transmitter_direction`` and ``receiver_direction``, unit vectors towards them. S has the phase of the path beyond that by the origin.
    """

    __slots__ = ()

    def plot(self, channel: str = "vv", ax: Axes | None = None) -> Axes:
        """Draws the level of S of the first receiver over time and frequency; of one frequency a curve over time.

        Parameters
        ----------
        channel : str
            "vv", "vh", "hv" or "hh".
        ax : matplotlib Axes, optional
            Default: a new figure.

        Returns
        -------
        matplotlib Axes
        """
        from raytube import _plots

        return _plots.plot_raw(self, _arguments.channels(channel, "plot")[0], ax)


def isar(result: Result, size: Any, pixels: Any, window: Any, sidelobe_db: Any, axes: int) -> IsarImage:
    """See `Result.isar` and `Result.isar_3d`."""
    kind, sidelobes = _window(window, sidelobe_db)
    density = _between(pixels, "pixels", 1.0, _MOST_PIXELS)
    lengths = _size(size, axes)
    both = np.ptp(result._stored.theta_deg) > 0.0 and np.ptp(result._stored.phi_deg) > 0.0
    if both and axes == 2:
        raise InputError("isar: the looks vary in theta and in phi, which makes an image in space; use isar_3d, or choose looks of one theta")
    if not both and axes == 3:
        raise InputError("isar_3d: an image in space needs looks over theta and phi both; use isar for one of them")
    found, s = _core.isar(result._stored, _outermost(result), lengths, density, kind, sidelobes)
    names = tuple(_AXES)[:axes]
    coordinates = {name: (name, axis["at_m"], {"units": "m", "long_name": _AXES[name]}) for name, axis in zip(names, found)}
    attributes: dict[str, Any] = {"title": result.title, "window": _window_text(kind, sidelobes)}
    for name in ("frequency_hz", "theta_deg", "phi_deg"):
        values = getattr(result._stored, name)
        attributes[name] = (float(values.min()), float(values.max()))
    for name, axis in zip(names, found):
        attributes |= {f"{name.removesuffix('_m')}_{fact}": axis[fact] for fact in ("direction", "resolution_m", "unambiguous_m")}
    image = IsarImage(_levels((*names, "channel"), s, "ISAR image I"), coordinates | {"channel": list(CHANNELS)}, attributes)
    if result._outline is not None:
        image["outline"] = outline_over(image, result._outline)
    return image


def outline_over(image: xr.Dataset, outline: Outline) -> xr.DataArray:
    """Edges and silhouette of a target as they are seen across an image."""
    up = "height" if "height_m" in image.dims else "range"
    lines, last = drawn_lines(outline, [image.attrs["cross_range_direction"], image.attrs[f"{up}_direction"]])
    return xr.DataArray(lines, dims=("edge", "end", "xyz"),
                        attrs={"units": "m", "long_name": "edges of the target, and last its silhouette", "silhouette": last})


def range_profiles(result: Result, look: int | None, window: Any, sidelobe_db: Any, padding: Any) -> RangeProfiles:
    """See `Result.range_profile`, and for all looks `Result.waterfall`."""
    looks = len(result._stored.theta_deg)
    if look is not None and look >= looks:
        raise InputError(f"look {look}: there are {looks} direction pair(s), counted from 0; choose among these")
    kind, sidelobes = _window(window, sidelobe_db)
    made = _core.range_profiles(result._stored, look, _outermost(result), kind, sidelobes, _padding(padding))
    chosen = slice(None) if look is None else [look]
    angles = {name: values.isel(look=chosen) for name, values in result.S.coords.items() if values.dims == ("look",)}
    coordinates = angles | {"range_m": ("range_m", made["range_m"], {"units": "m", "long_name": "range"}), "channel": list(CHANNELS)}
    variables = _levels(("look", "range_m", "channel"), made["S"], "range profile p")
    for name, values, text in (("error_dbsm", made["error_m"], "numerical error if all of it were at one range"),
                               ("model_dbsm", made["model_m"], "model uncertainty if all of it were at one range")):
        variables[name] = (("look", "channel"), dbsm(values[:, 0]), {"units": "dBsm", "long_name": text})
    attributes = {"title": result.title, "window": _window_text(kind, sidelobes), "range_resolution_m": made["resolution_m"],
                  "range_unambiguous_m": made["unambiguous_m"],
                  "range_direction": "away from the radar along the line of sight, from the origin of the mesh's coordinates; of a bistatic "
                                     "look half of the additional path"}
    profiles: RangeProfiles = RangeProfiles(variables, coordinates, attributes)
    if look is not None:
        profiles = profiles.isel(look=0)
    return profiles


def doppler(result: Result, look: Any, angle: Any, middle: tuple[Any, Any], mechanism: Any, window: Any, sidelobe_db: Any,
            padding: Any) -> DopplerMap:
    """See `Result.doppler`."""
    kind, sidelobes = _window(window, sidelobe_db)
    made = _core.doppler(result._stored, _arguments.whole(look, "look"), bool(angle), *_of_pulses(mechanism, middle), kind, sidelobes, _padding(padding))
    s, axes = made.pop("S"), ["range_m", "velocity_m_per_s", "cosine"]
    for at in (2, 0):
        if s.shape[at] == 1:
            s = s.squeeze(at)
            made.pop(axes.pop(at))
    coordinates = _velocities(made)
    for name in axes:
        if name in made:
            coordinates[name] = (name, made.pop(name), {"units": "m" if name == "range_m" else "1", "long_name": name.removesuffix("_m")})
    return DopplerMap(_levels((*axes, "channel"), s, "range-Doppler map M"), coordinates | {"channel": list(CHANNELS)},
                      {"title": result.title, "window": _window_text(kind, sidelobes)} | made)


def spectrogram(result: Result, look: Any, length: Any, overlap: Any, gate_m: Any, middle: tuple[Any, Any], mechanism: Any, window: Any,
                sidelobe_db: Any, padding: Any) -> Spectrogram:
    """See `Result.spectrogram`."""
    kind, sidelobes = _window(window, sidelobe_db)
    pulses = 0 if length is None else _arguments.whole(length, "length")
    if length is not None and pulses < 2:
        raise InputError(f"length: a window has 2 pulses or more (found {pulses})")
    gate = None if gate_m is None else _between(gate_m, "gate_m", 0.0, _LONGEST)
    made = _core.spectrogram(result._stored, _arguments.whole(look, "look"), pulses, _between(overlap, "overlap", 0.0, _MOST_OVERLAP), gate,
                             *_of_pulses(mechanism, middle), kind, sidelobes, _padding(padding))
    coordinates = _velocities(made) | {"time_s": ("time_s", made.pop("time_s"), {"units": "s", "long_name": "time"}), "channel": list(CHANNELS)}
    with np.errstate(divide="ignore"):
        levels = 10.0 * np.log10(made.pop("sigma_m2"))
    return Spectrogram({"sigma_dbsm": (("time_s", "velocity_m_per_s", "channel"), levels, {"units": "dBsm", "long_name": "radar cross-section"})},
                       coordinates, {"title": result.title, "window": _window_text(kind, sidelobes)} | made)


def raw(result: Result) -> RawData:
    """See `Result.raw`."""
    stored, times = result._stored, np.array(_core.pulse_times(result._stored))
    pulses, (looks, frequencies) = len(times), stored.S.shape[:2]
    receivers = looks // pulses
    far = not np.all(np.isfinite(stored.range_m))
    coordinates: dict[str, Any] = {"time_s": ("pulse", times, {"units": "s", "long_name": "time of the pulse"}),
                                   "frequency": ("frequency", stored.frequency_hz, {"units": "Hz", "long_name": "frequency"}),
                                   "receive": ["v", "h"], "transmit": ["v", "h"], "xyz": ["x", "y", "z"]}
    for name, prefix in (("transmitter", ""), ("receiver", "rx_")):
        theta, phi, distance = (getattr(stored, f"{prefix}{key}") for key in ("theta_deg", "phi_deg", "range_m"))
        sine = np.sin(np.radians(theta))
        towards = np.column_stack([sine * np.cos(np.radians(phi)), sine * np.sin(np.radians(phi)), np.cos(np.radians(theta))])
        values, text = (towards, "unit vector towards the ") if far else (towards * distance[:, None], "place of the ")
        coordinates[f"{name}_direction" if far else f"{name}_m"] = (
            ("pulse", "receiver", "xyz"), values.reshape(pulses, receivers, 3), {"units": "1" if far else "m", "long_name": text + name})
    s = stored.S.reshape(pulses, receivers, frequencies, 2, 2).transpose(0, 2, 1, 3, 4)
    return RawData({"S": (("pulse", "frequency", "receiver", "receive", "transmit"), s, {"units": "m", "long_name": "scattering amplitude S"})},
                   coordinates, {"title": result.title})


def _of_pulses(mechanism: Any, middle: tuple[Any, Any]) -> tuple[str, float, float]:
    name = "" if mechanism is None else _arguments.text(mechanism, "mechanism")
    return name, _between(middle[0], "middle_range_m", -_LONGEST, _LONGEST), _between(middle[1], "middle_velocity_m_per_s", -_LIGHT, _LIGHT)


def _velocities(made: dict[str, Any]) -> dict[str, Any]:
    return {"velocity_m_per_s": ("velocity_m_per_s", made.pop("velocity_m_per_s"), {"units": "m s-1", "long_name": "velocity towards the radar"}),
            "doppler_hz": ("velocity_m_per_s", made.pop("doppler_hz"), {"units": "Hz", "long_name": "Doppler frequency"})}


def _padding(padding: Any) -> int:
    number = _arguments.whole(padding, "padding", _MOST_PADDING)
    if number == 0:
        raise InputError(f"padding: give a whole number from 1 to {_MOST_PADDING} (found 0)")
    return number


def _outermost(result: Result) -> list[list[float]]:
    return [] if result._outline is None else list(result._outline[0].tolist())


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
    lengths = np.full(axes, lengths) if lengths.shape == () else lengths
    if lengths.shape != (axes,) or not np.all(np.isfinite(lengths) & (lengths > 0.0) & (lengths <= _LONGEST)):
        raise InputError(f"size: give a positive length in metres, or {axes} of them along {', '.join(list(_AXES.values())[:axes])}")
    return list(lengths.tolist())


def target_of_run(run: dict[str, Any]) -> Outline | None:
    """The target of a run, if its case and its meshes are where the run had them, and still the same."""
    job = _core.job_of_run(json.dumps(run))
    return None if job is None else _core.outline(job)


def drawn_lines(outline: Outline, plane: Any) -> tuple[Floats, int]:
    """Edges of a target, and then its silhouette in the plane of two unit vectors: ends of lines (n, 2, 3); how many of it there are."""
    silhouette = _silhouette(outline[2] @ np.asarray(plane).T) @ np.asarray(plane)
    return np.concatenate([outline[1], silhouette]), len(silhouette)


def _silhouette(triangles: NDArray[Any]) -> Floats:
    """The border of the union of triangles (n, 3, 2) in a plane: ends of lines (m, 2, 2)."""
    try:
        from contourpy import contour_generator
        from PIL import Image, ImageDraw
    except ImportError:  # they come with matplotlib, without which nothing is drawn
        return np.empty((0, 2, 2))
    low = triangles.reshape(-1, 2).min(axis=0)
    extent = triangles.reshape(-1, 2).max(axis=0) - low
    pixel = max(float(extent.max()), 1e-12) / _SILHOUETTE_PIXELS
    image = Image.new("L", tuple(int(n) + 5 for n in extent / pixel))
    draw = ImageDraw.Draw(image)
    for corners in ((triangles - low) / pixel + 2.0).reshape(-1, 6).tolist():
        draw.polygon(corners, fill=1, outline=1)
    lines = contour_generator(z=np.asarray(image, dtype=float)).lines(0.5)
    ends = []
    for line in lines:  # without the steps of its pixels: means over a few neighbours, some left out
        closed = np.concatenate([line[-4:-1], line, line[1:4]])
        smooth = np.lib.stride_tricks.sliding_window_view(closed, 7, axis=0).mean(axis=-1)
        corners = np.concatenate([smooth[:-1:3], smooth[:1]])
        ends.append(np.stack([corners[:-1], corners[1:]], axis=1))
    return np.asarray(np.concatenate([np.empty((0, 2, 2)), *ends]) * pixel + low - 2.0 * pixel)

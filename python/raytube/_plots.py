"""What is drawn into one pair of axes. Together with `_figures` and `_product_figures` the only modules that draw; matplotlib is imported here alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import matplotlib.patches
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MultipleLocator
from numpy.typing import NDArray

from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._rows import ANGLES, FREQUENCY, LABELS, LOOK, PHI, RX_PHI, RX_THETA, THETA, TIME, Cut, Grid, Rows, cuts_of, goes_round, grid_of, rows_of_result
from raytube._tables import KEYS, Floats, dbsm, largest_of_blocks

if TYPE_CHECKING:
    from xarray import DataArray

    from raytube._products import DopplerMap, IsarImage, RangeProfiles, RawData, Spectrogram
    from raytube._result import Result

CURVE_DEPTH, PROFILE_DEPTH, MAP_DEPTH, IMAGE_DEPTH = 80.0, 60.0, 50.0, 40.0  # below the peak there is nothing to see [dB]
LEAST_DEPTH = 10.0  # less would show rounding [dB]
TITLES = tuple(channel.upper() for channel in CHANNELS)
_COLOURS = ("#0072b2", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#e69f00", "#000000", "#7f7f7f")  # Okabe and Ito
_GREYS = ("#000000", "#808080", "#b0b0b0", "#606060", "#000000", "#808080", "#b0b0b0", "#606060")
_DASHES = ("-", (0, (1, 1.5)), (0, (6, 2, 1, 2)), (0, (5, 2)))  # by channel
MARKERS = "osD^vP*X"
_VELOCITY = "velocity towards the radar (m/s)"
_FEW_POINTS = 60
_MOST_CELLS = 1500  # along an axis: more than a picture has pixels
_ANGLE_STEPS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0)


@dataclass(frozen=True)
class Style:
    """How pictures look: for paper in greys, or on a screen in colours that all eyes part; with the model uncertainty or without."""

    printed: bool = False
    model: bool = True
    unit: str = "dbsm"
    range_db: float | None = None

    @property
    def colour_map(self) -> str:
        return "Greys" if self.printed else "viridis"

    @property
    def ink(self) -> str:
        """What lines over a map are drawn in."""
        return "#404040" if self.printed else "white"

    @property
    def colours(self) -> tuple[str, ...]:
        return _GREYS if self.printed else _COLOURS

    def line(self, result: int, results: int, channel: int, points: int, joined: bool = True) -> dict[str, Any]:
        """Keywords of a curve: of one result by channel, of several by result, dashed by channel. Points that are not joined have markers alone."""
        if not joined:
            return self.line(result, results, channel, 1) | {"markersize": 2.5}
        marked = points <= _FEW_POINTS or (self.printed and results > 2)
        return {"color": self.colours[channel if results == 1 else result], "linestyle": _DASHES[channel] if points > 1 else "",
                "marker": MARKERS[channel if results == 1 else result] if marked else "", "markersize": 4,
                "markevery": max(1, points // 12) if points > _FEW_POINTS else 1}


@dataclass(frozen=True)
class Scale:
    """What stands for levels: dBsm, dB below the peak, or square metres, from bottom to top."""

    unit: str
    peak_dbsm: float
    bottom: float
    top: float
    colour_map: str = "viridis"

    @property
    def mesh(self) -> dict[str, Any]:
        """Keywords of a mesh whose colours are levels."""
        return {"vmin": self.bottom, "vmax": self.top, "cmap": self.colour_map}

    @property
    def label(self) -> str:
        return {"dbsm": "σ (dBsm)", "db-peak": "σ (dB below the peak)", "m2": "σ (m²)"}[self.unit]

    def of(self, sigma_dbsm: Any) -> Floats:
        levels = np.asarray(sigma_dbsm, dtype=float)
        if self.unit == "m2":
            return np.asarray(10.0 ** (levels / 10.0))
        return np.asarray(np.maximum(levels - (self.peak_dbsm if self.unit == "db-peak" else 0.0), self.bottom - 20.0))


def scale_of(levels: Any, style: Style, depth: float, exact: bool = False) -> Scale:
    """A scale that holds levels [dBsm] down to `depth` below their peak; in round numbers, or exactly."""
    finite = np.asarray(levels, dtype=float)
    finite = finite[np.isfinite(finite)]
    peak = float(finite.max()) if finite.size else 0.0
    if style.unit == "m2":
        return Scale("m2", peak, 0.0, 10.0 ** (peak / 10.0) * (1.0 if exact else 1.05), style.colour_map)
    least, top = peak - (style.range_db or depth), peak
    lowest = least if style.range_db else min(float(finite[finite >= least].min(initial=peak)), peak - LEAST_DEPTH)
    if not exact:
        lowest, top = lowest if style.range_db else 10.0 * np.floor(lowest / 10.0), 5.0 * np.ceil((peak + 2.0) / 5.0)
    shift = peak if style.unit == "db-peak" else 0.0
    return Scale(style.unit, peak, lowest - shift, top - shift, style.colour_map)


def angle_ticks(axis: Any, key: int, most: int = 9) -> None:
    """Ticks at degrees that divide a circle: 15, 30, 45."""
    extent = abs(np.diff(axis.get_view_interval())[0])
    if key in ANGLES and extent > _ANGLE_STEPS[0]:
        axis.set_major_locator(MultipleLocator(next((step for step in _ANGLE_STEPS if extent / step <= most), 90.0)))


def ends_of(cuts: list[Cut], joined: bool) -> tuple[float, float]:
    """The ends of an axis along cuts; beside points that are not joined with room for whole markers."""
    first, last = min(cut.x[0] for cut in cuts), max(cut.x[-1] for cut in cuts)
    room = 1.0 if first == last else 0.0 if joined else 0.02 * (last - first)
    return first - room, last + room


def draw_cut(ax: Any, rows: Rows, cut: Cut, key: int, channels: list[int], scale: Scale, style: Style, place: tuple[int, int] = (0, 1),
             name: str = "") -> None:
    """Curves of one result, the model uncertainty as bands; `place`: which of how many results it is."""
    angle = ax.name == "polar"
    x = np.radians(cut.x) if angle else cut.x
    closed = angle and key in (PHI, RX_PHI) and goes_round(cut.x) and 1e-6 < cut.x[0] + 360.0 - cut.x[-1] < 1.5 * np.mean(np.diff(cut.x))
    order = np.append(cut.rows, cut.rows[:1]) if closed else cut.rows
    x = np.append(x, x[:1] + 2.0 * np.pi) if closed else x
    for channel in channels:
        sigma, look = rows.sigma[order, channel], style.line(*place, channel, len(x), rows.joined)
        ax.plot(x, np.maximum(scale.of(sigma), scale.bottom) if angle else scale.of(sigma), label=f"{name} {TITLES[channel]}".strip(), **look)
        if style.model and rows.model is not None and place[1] == 1 and np.any(rows.model[order, channel] > 0.0):
            model = rows.model[order, channel]  # how much larger the amplitude may be [dB]; by as much it may be smaller
            with np.errstate(divide="ignore"):
                low, high = scale.of(sigma + 20.0 * np.log10(np.maximum(2.0 - 10.0 ** (model / 20.0), 0.0))), scale.of(sigma + model)
            if rows.joined:
                ax.fill_between(x, low, high, color=look["color"], alpha=0.18, linewidth=0.0)
            else:
                ax.vlines(x, low, high, colors=look["color"], alpha=0.3)
    if not angle:
        ax.set(xlabel=LABELS[key], ylabel=scale.label, xlim=ends_of([cut], rows.joined), ylim=(scale.bottom, scale.top))
        ax.grid(alpha=0.3)
        angle_ticks(ax.xaxis, key)


def add_key(ax: Any, beside: bool = True) -> None:
    """A key of what is drawn, beside the axes; bands are explained with it, if there are any."""
    handles, labels = ax.get_legend_handles_labels()
    if any(isinstance(band, (LineCollection, PolyCollection)) for band in ax.collections):
        handles, labels = [*handles, matplotlib.patches.Patch(color="#808080", alpha=0.3, linewidth=0.0)], [*labels, "model uncertainty"]
    if handles:
        place = {"loc": "upper left", "bbox_to_anchor": (1.1 if ax.name == "polar" else 1.01, 1.0), "borderaxespad": 0.0, "frameon": False}
        ax.legend(handles, labels, **(place if beside else {}))


def dress_polar(ax: Any, scale: Scale, key: int) -> None:
    """Rings in whole tens of decibels, labelled on white over the curves; polar angles run clockwise from the top."""
    if key in (THETA, RX_THETA):
        ax.set_theta_zero_location("N")
        ax.set_theta_direction(-1)
    ax.set_ylim(scale.bottom, scale.top)
    ax.set_xticks(np.radians(np.arange(0, 360, 30)))
    if scale.unit != "m2":
        ax.yaxis.set_major_locator(MultipleLocator(10.0))
    ax.set_rlabel_position(7.5 if key in (PHI, RX_PHI) else 90.0)
    ax.grid(alpha=0.4)
    for label in ax.yaxis.get_ticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.8})


def polar_scale(levels: Floats, style: Style) -> Scale:
    """Whole rings down to what a tenth of the rows stay below, and a ring more: nulls would push all else to the rim."""
    finite = levels[np.isfinite(levels)]
    plain = scale_of(finite, style, CURVE_DEPTH)
    if style.unit == "m2":
        return plain
    peak = 0.0 if style.unit == "db-peak" else plain.peak_dbsm
    top = 10.0 * np.ceil(peak / 10.0)
    low = max(float(np.percentile(finite, 10.0)) if finite.size else 0.0, plain.peak_dbsm - CURVE_DEPTH) - plain.peak_dbsm + peak
    bottom = top - 10.0 * np.ceil(style.range_db / 10.0) if style.range_db else min(10.0 * np.floor(low / 10.0) - 10.0, top - 20.0)
    return replace(plain, bottom=bottom, top=top)


def draw_grid(ax: Any, grid: Grid, levels: Floats, **colours: Any) -> Any:
    """A map of levels [up, across]: the whole sphere on axes of a projection, else on plain axes with theta downwards."""
    if ax.name == "hammer":
        return _draw_sphere(ax, grid, levels, **colours)
    mesh = draw_cells(ax, grid.x, grid.y, levels, **colours)
    ax.set(xlabel=LABELS[grid.across], ylabel=LABELS[grid.up])
    if grid.across in (PHI, RX_PHI) and grid.up in (THETA, RX_THETA):
        ax.invert_yaxis()  # the upper side of the target is above
    angle_ticks(ax.xaxis, grid.across)
    angle_ticks(ax.yaxis, grid.up)
    return mesh


def draw_cells(ax: Any, x: Floats, y: Floats, levels: Floats, **colours: Any) -> Any:
    """Levels [up, across] as coloured cells; of more cells than pixels the strongest, so that no peak is lost."""
    levels, middles = np.asarray(levels), []
    for axis, at in enumerate((y, x)):
        levels, size = largest_of_blocks(levels, axis, _MOST_CELLS)
        starts = np.arange(0, len(at), size)
        middles.append(np.add.reduceat(np.asarray(at), starts) / np.diff(np.append(starts, len(at))))
    ax.set_facecolor("#ececec")
    return ax.pcolormesh(middles[1], middles[0], levels, shading="nearest", rasterized=True, **colours)


def _draw_sphere(ax: Any, grid: Grid, levels: Floats, **colours: Any) -> Any:
    phi = (grid.x + 180.0) % 360.0 - 180.0
    order = np.unique(phi, return_index=True)[1]
    phi, levels = np.append(phi[order], phi[order[0]] + 360.0), np.concatenate([levels[:, order], levels[:, order[:1]]], axis=1)
    east = np.concatenate([[-180.0], 0.5 * (phi[:-1] + phi[1:]), [180.0]])
    middle = 0.5 * (grid.y[:-1] + grid.y[1:])
    theta = np.concatenate([[max(0.0, 2.0 * grid.y[0] - middle[0])], middle, [min(180.0, 2.0 * grid.y[-1] - middle[-1])]])
    ax.grid(False)
    mesh = ax.pcolormesh(np.radians(east), np.radians(90.0 - theta), levels, rasterized=True, **colours)
    ax.grid(True, color="white", alpha=0.4, linewidth=0.6)
    ax.set_xticks(np.radians(np.arange(-120, 121, 60)), [f"φ {phi}°" if phi == 0 else f"{phi}°" for phi in range(-120, 121, 60)])
    ax.set_yticks(np.radians(np.arange(60, -61, -30)), [f"θ {theta}°" for theta in range(30, 151, 30)])
    for label in ax.xaxis.get_ticklabels():
        label.set(fontsize="small", bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.75})
    return mesh


def draw_lines(ax: Any, lines: Any, silhouette: int, plane: NDArray[Any], ink: str) -> None:
    """Lines of a target (n, 2, 3) in the plane of two unit vectors, thin; the last ones, its silhouette, stronger."""
    ends = list(np.asarray(lines) @ plane.T)
    for part, width, alpha in ((ends[:len(ends) - silhouette], 0.4, 0.5), (ends[len(ends) - silhouette:], 0.9, 0.9)):
        ax.add_collection(LineCollection(part, colors=ink, linewidths=width, alpha=alpha))


def radar_arrow(ax: Any, ink: str) -> None:
    """Where the radar is: below, range grows upwards."""
    ax.annotate("", (0.05, 0.2), (0.05, 0.08), "axes fraction", arrowprops={"arrowstyle": "-|>", "color": ink, "linewidth": 1.2})
    ax.text(0.05, 0.02, "radar", transform=ax.transAxes, color=ink, ha="center", va="bottom", fontsize="small", clip_on=False)


def image_levels(image: IsarImage) -> tuple[str, Floats]:
    """What goes up in the picture of an image, and its levels [up, cross-range, channel]: in space the strongest cell along range."""
    sigma, up = image["sigma_dbsm"], "range"
    if "height_m" in sigma.dims:
        sigma, up = sigma.max("range_m"), "height"
    return up, np.asarray(sigma.transpose(f"{up}_m", "cross_range_m", "channel").values)


def draw_image(ax: Any, image: IsarImage, levels: Floats | None, up: str, edges: Any, ink: str = "white", **colours: Any) -> Any:
    """An image in its metres, the target over it, and where the radar is; without levels the axes and lines alone."""
    x, y = image["cross_range_m"].values, image[f"{up}_m"].values
    mesh = draw_cells(ax, x, y, levels, **colours) if levels is not None else None
    xlim, ylim = ax.get_xlim(), ax.get_ylim()
    if edges is not None:
        plane = np.array([image.attrs["cross_range_direction"], image.attrs[f"{up}_direction"]])
        draw_lines(ax, edges.transpose("edge", "end", "xyz").values, edges.attrs.get("silhouette", 0), plane, ink)
    ax.set(xlim=xlim, ylim=ylim, xlabel="cross-range (m)", ylabel=f"{up} (m)", aspect="equal")
    if up == "range":
        radar_arrow(ax, ink)
    return mesh


def sweep_text(frequency_hz: Any, theta_deg: Any, phi_deg: Any) -> str:
    """Middle frequency, band, and angles of a sweep, in words."""
    low, high = float(np.min(frequency_hz)) / 1e9, float(np.max(frequency_hz)) / 1e9
    words = []
    for symbol, angles in (("θ", theta_deg), ("φ", phi_deg)):
        half = 0.5 * float(np.max(angles) - np.min(angles))
        words.append(f"{symbol} = {float(np.min(angles)) + half:.5g}°" + (f" ± {half:.4g}°" if half > 0.0 else ""))
    words.append(f"f₀ = {0.5 * (low + high):.5g} GHz")
    return ", ".join([*words, f"B = {high - low:.4g} GHz"] if high > low else words)


def image_text(image: Any) -> str:
    """The sweep of an image and its resolution, in words."""
    words = [sweep_text(*(image.attrs[name] for name in ("frequency_hz", "theta_deg", "phi_deg")))] if "phi_deg" in image.attrs else []
    resolution = [f"{image.attrs[f'{name}_resolution_m']:.3g} m" for name in ("range", "cross_range", "height")
                  if f"{name}_resolution_m" in image.attrs]
    return "\n".join([*words, f"resolution {' × '.join(resolution)}"])


def draw_profile(ax: Any, ranges: Floats, sigma: dict[str, Floats], style: Style) -> None:
    """Levels against range, a curve a channel."""
    scale = scale_of(np.concatenate(list(sigma.values())), style, PROFILE_DEPTH)
    for channel, levels in sigma.items():
        ax.plot(ranges, levels, label=channel.upper(), **style.line(0, 1, CHANNELS.index(channel), _FEW_POINTS + 1) | {"marker": ""})
    ax.set(xlabel="range (m)", ylabel="σ (dBsm)", xlim=(ranges[0], ranges[-1]), ylim=(scale.bottom, scale.top))
    ax.grid(alpha=0.3)


def doppler_levels(data: Any) -> Floats:
    """Levels of a map [range, velocity, channel], of a spectrum [velocity, channel]; of an array the strongest along its cosine."""
    sigma = data["sigma_dbsm"]
    sigma = sigma.max("cosine") if "cosine" in sigma.dims else sigma
    return np.asarray(sigma.transpose(*(name for name in ("range_m", "velocity_m_per_s", "channel") if name in sigma.dims)).values)


def _add_doppler(axis: Any, place: str, data: Any) -> None:
    """Doppler frequencies beside velocities."""
    add = axis.secondary_xaxis if place == "top" else axis.secondary_yaxis
    hertz = float(2.0 * data.attrs["doppler_frequency_hz"] / 299792458.0)
    unit, scale = ("kHz", 1e-3 * hertz) if hertz * float(abs(data["velocity_m_per_s"]).max()) >= 1e3 else ("Hz", hertz)
    beside = add(place, functions=(lambda v: v * scale, lambda shown: shown / scale))
    (beside.set_xlabel if place == "top" else beside.set_ylabel)(f"Doppler frequency ({unit})")


def draw_doppler(ax: Any, data: Any, levels: Floats, **colours: Any) -> Any:
    """Levels [range, velocity] as a map, with Doppler frequencies at the top."""
    mesh = draw_cells(ax, data["velocity_m_per_s"].values, data["range_m"].values, levels, **colours)
    ax.set(xlabel=_VELOCITY, ylabel="range (m)")
    _add_doppler(ax, "top", data)
    return mesh


def draw_velocities(ax: Any, data: Any, sigma: dict[str, Floats], style: Style) -> None:
    """Levels against velocity, a curve a channel."""
    draw_profile(ax, data["velocity_m_per_s"].values, sigma, style)
    ax.set(xlabel=_VELOCITY)
    _add_doppler(ax, "top", data)


def draw_spectrogram(ax: Any, data: Any, levels: Floats, **colours: Any) -> Any:
    """Levels [velocity, time] as a map, with Doppler frequencies at the right."""
    mesh = draw_cells(ax, data["time_s"].values, data["velocity_m_per_s"].values, levels, **colours)
    ax.set(xlabel=LABELS[TIME], ylabel=_VELOCITY)
    _add_doppler(ax, "right", data)
    return mesh


def looks_axis(profiles: Any) -> tuple[Floats, int]:
    """What differs from look to look: one angle, or else their number."""
    angles = {key: profiles[KEYS[key]].values for key in (PHI, THETA, RX_PHI, RX_THETA, TIME) if KEYS[key] in profiles.coords}
    varying = [key for key, values in angles.items() if np.ptp(values) > 0.0]
    if len(varying) > 1:  # a receiver that goes along with its radar
        varying = [key for key in varying if key not in (RX_THETA, RX_PHI) or np.any(angles[key] != angles[key - 2])]
    if len(varying) == 1 and np.all(np.diff(angles[varying[0]]) > 0.0):
        return angles[varying[0]], varying[0]
    return np.arange(profiles.sizes["look"]), LOOK


def draw_waterfall(ax: Any, profiles: Any, levels: Floats, **colours: Any) -> Any:
    """Levels [look, range] as a map."""
    y, key = looks_axis(profiles)
    mesh = draw_cells(ax, profiles["range_m"].values, y, levels, **colours)
    ax.set(xlabel="range (m)", ylabel=LABELS[key])
    angle_ticks(ax.yaxis, key)
    return mesh


def plot(result: Result, channels: tuple[str, ...], ax: Any) -> Any:
    """See `Result.plot`."""
    rows, (looks, frequencies), style = rows_of_result(result), result.S.shape[:2], Style()
    chosen = [CHANNELS.index(channel) for channel in channels]
    key, cuts = cuts_of(rows)
    if looks > 1 and frequencies > 1:
        varying = [k for k in (*ANGLES, TIME) if rows.known[k] and np.ptp(rows.keys[:, k]) > 0.0]
        across = varying[0] if len(varying) == 1 else LOOK
        x = rows.keys[::frequencies, across] if across != LOOK else np.arange(float(looks))
        numbers = np.arange(looks * frequencies).reshape(looks, frequencies).T
        grid: Grid | None = Grid(across, FREQUENCY, x, rows.keys[:frequencies, FREQUENCY], numbers, "", True)
    else:
        grid = grid_of(rows, rows.peak_row(chosen), 1) if np.any(np.isfinite(rows.sigma[:, chosen])) else None
    ax = ax or _new_axes()
    if grid:
        _add_map(ax, partial(draw_grid, grid=grid), grid.over(rows.sigma[:, chosen[0]]), channels[0])
    else:
        cut = cuts[0] if len(cuts) == 1 else Cut("", np.arange(len(rows.keys)), np.arange(float(len(rows.keys))))
        scale = scale_of(rows.sigma[:, chosen], style, CURVE_DEPTH)
        draw_cut(ax, rows, cut, key if len(cuts) == 1 else LOOK, chosen, scale, style)
        add_key(ax, beside=False)
    ax.set_title(_title(rows))
    return ax


def plot_polar(result: Result, channels: tuple[str, ...], ax: Any) -> Any:
    """See `Result.plot_polar`."""
    rows, style, chosen = rows_of_result(result), Style(), [CHANNELS.index(channel) for channel in channels]
    key, cuts = cuts_of(rows)
    if key not in (PHI, RX_PHI) or len(cuts) != 1:
        raise InputError("plot_polar: needs looks that differ in one azimuth, at one frequency; choose these, or use plot")
    ax = ax or _new_axes("polar")
    scale = polar_scale(rows.sigma[:, chosen], style)
    draw_cut(ax, rows, cuts[0], key, chosen, scale, style)
    dress_polar(ax, scale, key)
    ax.set_title(f"{_title(rows)}\nσ (dBsm) against {LABELS[key]}")
    add_key(ax)
    return ax


def plot_profiles(profiles: RangeProfiles, channels: tuple[str, ...], ax: Any) -> Any:
    """See `RangeProfiles.plot`."""
    ax, sigma = ax or _new_axes(), profiles["sigma_dbsm"].sel(channel=list(channels))
    if "look" in sigma.dims:
        levels = sigma.sel(channel=channels[0]).transpose("look", "range_m").values
        _add_map(ax, partial(draw_waterfall, profiles=profiles), levels, channels[0])
    else:
        draw_profile(ax, profiles["range_m"].values, {c: sigma.sel(channel=c).values for c in channels}, Style())
        add_key(ax, beside=False)
    ax.set_title(profiles.attrs["title"])
    return ax


def plot_isar(image: IsarImage, channel: str, ax: Any, edges: DataArray | None) -> Any:
    """See `IsarImage.plot`."""
    ax, (up, levels) = ax or _new_axes(), image_levels(image.sel(channel=[channel]))
    _add_map(ax, partial(draw_image, image=image, up=up, edges=edges), levels[..., 0], channel)
    ax.set_title("\n".join(text for text in (image.attrs.get("title", ""), image_text(image)) if text), fontsize="medium")
    return ax


def plot_doppler(data: DopplerMap, channel: str, ax: Any) -> Any:
    """See `DopplerMap.plot`."""
    ax, levels = ax or _new_axes(), doppler_levels(data.sel(channel=[channel]))
    if levels.ndim == 3:
        _add_map(ax, partial(draw_doppler, data=data), levels[..., 0], channel)
    else:
        draw_velocities(ax, data, {channel: levels[:, 0]}, Style())
    ax.set_title(data.attrs["title"])
    return ax


def plot_spectrogram(data: Spectrogram, channel: str, ax: Any) -> Any:
    """See `Spectrogram.plot`."""
    ax = ax or _new_axes()
    _add_map(ax, partial(draw_spectrogram, data=data), data["sigma_dbsm"].sel(channel=channel).transpose("velocity_m_per_s", "time_s").values, channel)
    ax.set_title(data.attrs["title"])
    return ax


def plot_raw(data: RawData, channel: str, ax: Any) -> Any:
    """See `RawData.plot`."""
    ax, times = ax or _new_axes(), data["time_s"].values
    levels = dbsm(data["S"].isel(receiver=0).sel(receive=channel[0], transmit=channel[1]).transpose("frequency", "pulse").values)
    if len(levels) > 1:
        _add_map(ax, lambda ax, levels, **colours: draw_cells(ax, times, data["frequency"].values / 1e9, levels, **colours), levels, channel)
        ax.set(xlabel=LABELS[TIME], ylabel=LABELS[FREQUENCY])
    else:
        ax.plot(times, levels[0])
        ax.set(xlabel=LABELS[TIME], ylabel=f"σ, {channel.upper()} (dBsm)")
    ax.set_title(data.attrs["title"])
    return ax


def _add_map(ax: Any, draw: Callable[..., Any], levels: Floats, channel: str) -> None:
    """Levels [dBsm] as colours, with a bar."""
    mesh = draw(ax, levels=levels, **scale_of(levels, Style(), MAP_DEPTH, exact=True).mesh)
    ax.figure.colorbar(mesh, ax=ax, label=f"σ, {channel.upper()} (dBsm)")


def _new_axes(projection: str | None = None) -> Any:
    import matplotlib.pyplot as plt

    return plt.subplots(constrained_layout=True, subplot_kw={"projection": projection})[1]


def _title(rows: Rows) -> str:
    """The title of the case, and what all rows have in common."""
    varying = tuple(key for key in range(LOOK) if np.ptp(rows.keys[:, key]) > 0.0)
    return ", ".join(text for text in (rows.title, rows.fixed(0, varying)) if text)

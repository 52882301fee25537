"""Whole pictures of the files that the program's commands write beside results."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MaxNLocator, NullFormatter

from raytube import _plots
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._figures import (MOST_PANELS, Options, Pictures, canvas, centre_heading, heat_panels, map_panels, mapped_channels, panels_of_cuts,
                              twice)
from raytube._plots import CURVE_DEPTH, IMAGE_DEPTH, MAP_DEPTH, TITLES, Style, scale_of
from raytube._products import drawn_lines, outline_over, target_of_run
from raytube._rows import FREQUENCY, LABELS, LOOK, PHI, THETA, UNITS, Grid, Rows, choice_with, cuts_of, grid_of, name_apart, read_rows
from raytube._tables import (KEYS, Floats, amplitudes_of, centres_of, comments, dbsm, header_of, is_coarse, mechanism_text, mechanisms_of, read_csv,
                             run_of)

_MOST_LABELLED = 10  # centres, as many as the command lists
_WINDOW = 6.0  # wavelengths: faces turned by 10 degrees and more then show their edges only
_SYMBOLS = "os^DvpX*"  # of centres, by mechanism
_DARK = Style(printed=True).ink  # on white


def _title_beside(file: str, options: Options) -> str:
    """That of the run; else the names of the file and its folder, but for one in which a command is still writing."""
    names = [name for name in Path(file).absolute().parts[-2:] if not name.startswith(".")]
    return options.title or str(options.described(file).get("case", {}).get("title", "")) or "/".join(names)


def _signal(sigma: Floats, depth: float, asked: list[int]) -> list[int]:
    """Channels (last axis) that have anything within `depth` of the peak."""
    peaks = [float(np.max(sigma[..., c], initial=-np.inf, where=np.isfinite(sigma[..., c]))) for c in range(4)]
    return asked or [c for c in range(4) if peaks[c] >= max(peaks) - depth and np.isfinite(peaks[c])] or [0]


def _product(file: str, dims: tuple[str, ...]) -> Any:
    """Range profiles or an image as a dataset (..., channel) of ``S`` and ``sigma_dbsm``, from netCDF or from a table."""
    import xarray as xr

    if file.lower().endswith(".nc"):
        with xr.open_dataset(file) as stored:
            flat = stored.load().stack(channel=("receive", "transmit")).reset_index("channel", drop=True).assign_coords(channel=list(CHANNELS))
        return flat.assign(S=flat["S_re"] + 1j * flat["S_im"])
    table, text = read_csv(file), " ".join(comments(file))
    profiles = dims == ("range_m",)
    if profiles:
        table["look"] = np.arange(len(table)) // table["range_m"].nunique()
        dims = ("look", *dims)
    columns, channel = table.set_index([*dims]).to_xarray(), xr.DataArray(list(CHANNELS), dims="channel", name="channel")
    s = xr.concat([columns[f"re_{c}"] + 1j * columns[f"im_{c}"] for c in CHANNELS], channel).transpose(*dims, "channel")
    data = xr.Dataset({"S": s, "sigma_dbsm": (s.dims, dbsm(s.values))})
    if profiles:  # one value a look stands in each of its rows
        looks = columns.isel(range_m=0, drop=True)
        data = data.assign_coords({name: looks[name] for name in KEYS[1:] if name in looks})
        for level in ("error", "model"):
            data[f"{level}_dbsm"] = xr.concat([looks[f"{level}_{c}_dbsm"] for c in CHANNELS], channel).transpose("look", "channel")
    for name, x, y, z, width in re.findall(r"(\w+)_m along \(?([-\d.e+]+),? ([-\d.e+]+),? ([-\d.e+]+)\)?: peaks ([\d.e+-]+) m wide", text):
        data.attrs |= {f"{name}_direction": tuple(map(float, (x, y, z))), f"{name}_resolution_m": float(width)}
    for name, words in (("resolution", r"Peaks are ([\d.e+-]+) m wide"), ("unambiguous", r"what is ([\d.e+-]+) m farther")):
        if found := re.search(words, text):
            data.attrs[f"range_{name}_m"] = float(found[1])
    return data


def profile_pictures(file: str, options: Options) -> Pictures:
    """``profile.*`` of the strongest look, ``waterfall.*`` of all."""
    return _profile_pictures(_product(file, ("range_m",)), _title_beside(file, options), options)


def _profile_pictures(data: Any, title: str, options: Options) -> Pictures:
    sigma = data["sigma_dbsm"].transpose("look", "range_m", "channel").values
    resolution = f"resolution {data.attrs['range_resolution_m']:.3g} m, unambiguous {data.attrs['range_unambiguous_m']:.4g} m"

    def profile() -> Figure:
        look = int(np.nanargmax(np.max(sigma, axis=(1, 2))))
        figure = canvas(9.5, 4.8, options)
        ax = figure.add_subplot()
        shown = _signal(sigma[look], 60.0, options.channels)
        _plots.draw_profile(ax, data["range_m"].values, {CHANNELS[c]: sigma[look, :, c] for c in shown}, options.style)
        for name, text, dash in (("model_dbsm", "model uncertainty", "--"), ("error_dbsm", "numerical error", ":")):
            level = float(np.max(data[name].values.reshape(len(sigma), 4)[look, [0, 3]])) if name in data else -np.inf
            if ax.get_ylim()[0] <= level and (options.style.model or name != "model_dbsm"):
                ax.axhline(level, color="#808080", linestyle=dash, linewidth=1.0, label=f"{text},\nif all at one range")
        _plots.add_key(ax)
        at = f"θ = {float(data['theta_deg'][look]):.5g}°, φ = {float(data['phi_deg'][look]):.5g}°"
        ax.set_title(f"{title}\nrange profile, {at}; {resolution}")
        return figure

    def waterfall() -> Figure:
        channels = [c for c in options.channels or (0, 3) if np.any(np.isfinite(sigma[..., c]))] or [0]
        heading = f"{title}\nrange profiles by look; {resolution}"
        return map_panels(partial(_plots.draw_waterfall, profiles=data), sigma, channels, heading, options, (5.4, 3.6))

    return twice("profile", profile) | (twice("waterfall", waterfall) if len(sigma) > 1 else {})


def figure_of_waterfall(results: list[Rows], options: Options) -> Figure:
    """Range profiles of a result of raytube's."""
    from raytube._result import load

    if len(results) > 1:
        raise InputError(f"--kind waterfall: {len(results)} results; a waterfall shows one, give one file")
    result = load(results[0].file)
    title = options.title or result.title or _title_beside(results[0].file, options)
    *_, draw = _profile_pictures(result.waterfall(), title, options).values()  # of one look its profile
    return draw()


def doppler_pictures(file: str, options: Options) -> Pictures:
    """``doppler.png``: a map over velocity and range of the strongest look, of one frequency curves over velocity."""
    data = _strongest_look(_of_velocities(file, [name for name in ("range_m", "velocity_m_per_s", "cosine") if name in header_of(file)]))
    levels, limits = _plots.doppler_levels(data), data.attrs
    heading = f"{_title_beside(file, options)}\n" + ("range-Doppler map" if levels.ndim == 3 else "Doppler spectrum") + f": {_velocity_text(limits)}"
    chosen = _signal(levels, MAP_DEPTH, options.channels)

    def doppler() -> Figure:
        if levels.ndim == 3:
            return map_panels(partial(_plots.draw_doppler, data=data), levels, chosen, heading, options, (5.4, 4.2))
        figure = canvas(9.5, 4.8, options)
        ax = figure.add_subplot()
        _plots.draw_velocities(ax, data, {CHANNELS[c]: levels[:, c] for c in chosen}, options.style)
        _plots.add_key(ax)
        ax.set_title(heading)
        return figure

    return {"doppler.png": doppler}


def spectrogram_pictures(file: str, options: Options) -> Pictures:
    """``spectrogram.png``: a map over time and velocity of the strongest look."""
    data = _strongest_look(_of_velocities(file, ["time_s", "velocity_m_per_s"]))
    levels = data["sigma_dbsm"].transpose("velocity_m_per_s", "time_s", "channel").values
    heading = f"{_title_beside(file, options)}\nspectrogram: {_velocity_text(data.attrs)}"
    draw = partial(_plots.draw_spectrogram, data=data)
    return {"spectrogram.png": partial(map_panels, draw, levels, _signal(levels, MAP_DEPTH, options.channels), heading, options, (6.6, 3.8))}


def _of_velocities(file: str, axes: list[str]) -> Any:
    """A map or a spectrogram as a dataset (look, ..., channel) of ``sigma_dbsm``, from netCDF or from a table."""
    import xarray as xr

    if file.lower().endswith(".nc"):
        with xr.open_dataset(file) as stored:
            return stored.load().stack(channel=("receive", "transmit")).reset_index("channel", drop=True).assign_coords(channel=list(CHANNELS))
    table, text = read_csv(file), " ".join(comments(file))
    columns = table.set_index(["look", *axes]).to_xarray()
    sigma = xr.concat([columns[f"sigma_{c}_dbsm"] for c in CHANNELS], xr.DataArray(list(CHANNELS), dims="channel", name="channel"))
    numbers = re.search(r"at ([-\d.e+]+) Hz\..*?Peaks are ([\d.e+-]+) m/s wide.*?what is ([\d.e+-]+) m/s", text)
    names = ("doppler_frequency_hz", "velocity_resolution_m_per_s", "velocity_unambiguous_m_per_s")
    return xr.Dataset({"sigma_dbsm": sigma}, attrs=dict(zip(names, map(float, numbers.groups() if numbers else ()))))


def _strongest_look(data: Any) -> Any:
    return data.isel(look=int(data["sigma_dbsm"].max([name for name in data["sigma_dbsm"].dims if name != "look"]).argmax()))


def _velocity_text(limits: Any) -> str:
    return (f"f₀ = {limits['doppler_frequency_hz'] / 1e9:.5g} GHz\nresolution {limits['velocity_resolution_m_per_s']:.3g} m/s, "
            f"unambiguous {limits['velocity_unambiguous_m_per_s']:.4g} m/s")


def _sweep_beside(file: str) -> dict[str, Any]:
    """Frequencies and angles of the result beside an image."""
    for name in ("rcs.csv", "rcs.nc"):
        beside = Path(file).parent / name
        if beside.exists():
            keys = read_rows(str(beside)).keys
            return {"frequency_hz": 1e9 * keys[:, FREQUENCY], "theta_deg": keys[:, THETA], "phi_deg": keys[:, PHI]}
    return {}


def isar_pictures(file: str, options: Options) -> Pictures:
    """``isar.png`` of the channels with a signal, and of an image in a plane ``isar_pauli.png``."""
    data = _product(file, ("range_m", "cross_range_m", "height_m")[:3 if "height_m" in header_of(file) else 2])
    data.attrs |= _sweep_beside(options.beside(file))
    target = target_of_run(options.described(file))
    edges = outline_over(data, target) if target is not None else None
    up, levels = _plots.image_levels(data)
    heading = f"{_title_beside(file, options)}\nISAR: {_plots.image_text(data)}"
    aspect = float(np.ptp(data[f"{up}_m"].values) / max(np.ptp(data["cross_range_m"].values), 1e-9))
    height = float(np.clip(4.6 * aspect, 2.2, 6.5))

    def isar() -> Figure:
        seen = "" if up == "range" else "\nas the radar sees it: the strongest cell along the line of sight"
        draw = partial(_plots.draw_image, image=data, up=up, edges=edges, ink=options.style.ink)
        return map_panels(draw, levels, _signal(levels, MAP_DEPTH, options.channels), heading + seen, options, (4.6, height))

    def pauli() -> Figure:
        s = data["S"].transpose("range_m", "cross_range_m", "channel").values
        amplitudes = np.abs(np.stack([s[..., 3] - s[..., 0], s[..., 1] + s[..., 2], s[..., 3] + s[..., 0]], axis=-1))
        colours, top = pauli_colours(amplitudes)
        figure = canvas(7.4, height + 2.2, options)
        ax = figure.add_subplot()
        x, y = data["cross_range_m"].values, data["range_m"].values
        half = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
        ax.imshow(colours, origin="lower", extent=(x[0] - half[0], x[-1] + half[0], y[0] - half[1], y[-1] + half[1]), interpolation="nearest")
        _plots.draw_image(ax, data, None, "range", edges)
        key = (("#ff0000", "|HH − VV|: even number of bounces"), ("#00ff00", "|HV + VH|: turned"), ("#0000ff", "|HH + VV|: odd number of bounces"))
        handles = [Patch(color=colour, label=text) for colour, text in key]
        ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.16 / max(height / 4.6, 0.5)), ncol=1, frameon=False,
                  title=f"from {top - IMAGE_DEPTH:.0f} dBsm (dark) to {top:.0f} dBsm (bright)")
        ax.set_title(heading)
        return figure

    return {"isar.png": isar} | ({"isar_pauli.png": pauli} if up == "range" else {})


def pauli_colours(amplitudes: Floats) -> tuple[Floats, float]:
    """Red, green, blue of amplitudes (..., 3) by their levels; one cell in a thousand of those that count may be brighter than the top."""
    level = dbsm(amplitudes / np.sqrt(2.0))
    strong = level[level >= level.max() - IMAGE_DEPTH]
    top = float(np.percentile(strong, 99.0)) if strong.size else 0.0
    return np.clip(1.0 + (level - top) / IMAGE_DEPTH, 0.0, 1.0) ** 1.2, top


def centres_pictures(file: str, options: Options) -> Pictures:
    """``centres.*``: places from above the line of sight, by mechanism and level."""
    (theta, phi, frequency, _), table = centres_of(file)
    table = table[table["centre"] != "rest"]
    s, c, sp, cp = np.sin(np.radians(theta)), np.cos(np.radians(theta)), np.sin(np.radians(phi)), np.cos(np.radians(phi))
    plane = np.array([[-sp, cp, 0.0], [-s * cp, -s * sp, -c]])
    at = table[["x_m", "y_m", "z_m"]].to_numpy() @ plane.T
    level = np.maximum(table["sigma_vv_dbsm"].to_numpy(), table["sigma_hh_dbsm"].to_numpy())
    mechanisms = [name.removeprefix("share_") for name in table.columns if name.startswith("share_")]
    target = target_of_run(options.described(file))

    def centres() -> Figure:
        top = float(np.max(level, initial=0.0 if not len(level) else -np.inf))
        shown = np.flatnonzero(level >= top - IMAGE_DEPTH)[::-1]  # the strongest lies over the others
        extent = np.ptp(np.concatenate([at, *([] if target is None else [target[0] @ plane.T])]), axis=0) if len(at) else np.ones(2)
        height = float(np.clip(6.2 * extent[1] / max(extent[0], 1e-9), 2.2, 6.2))
        figure = canvas(8.2, height + 1.9, options)
        ax = figure.add_subplot()
        if target is not None:
            _plots.draw_lines(ax, *drawn_lines(target, plane), plane, _DARK)
        size = matplotlib.rcParams["lines.markersize"] ** 2
        handles = []
        for marker, mechanism in zip(_SYMBOLS, mechanisms):
            of = shown[table["mechanism"].to_numpy()[shown] == mechanism]
            if not len(of):
                continue
            dots = ax.scatter(at[of, 0], at[of, 1], size * (0.7 + 2.3 * (1.0 - (top - level[of]) / IMAGE_DEPTH)), level[of], marker,
                              cmap=options.style.colour_map, vmin=top - IMAGE_DEPTH, vmax=top, edgecolors="#202020", linewidths=0.6, zorder=3)
            handles.append(Line2D([], [], marker=marker, linestyle="", color="#606060", label=mechanism_text(mechanism)))
        for text, place in _numbers(at[shown[shown < _MOST_LABELLED][::-1]], shown[shown < _MOST_LABELLED][::-1], 0.02 * np.ptp(ax.dataLim, 0).max()):
            ax.annotate(text, place, (5, 4), textcoords="offset points", zorder=4, fontsize="small")
        ax.set_aspect("equal")
        ax.margins(0.05)
        ax.set(xlabel="cross-range (m)", ylabel="range (m)")
        _plots.radar_arrow(ax, _DARK)
        if handles:
            figure.colorbar(dots, ax=ax, label="σ of VV or HH, the larger (dBsm)")
            ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.55 / height), ncol=3, frameon=False)
        ax.set_title(f"{_title_beside(file, options)}\nscattering centres: {_plots.sweep_text([frequency], [theta], [phi])}\n{len(shown)} of "
                     f"{len(level)} within {IMAGE_DEPTH:g} dB of the strongest")
        return figure

    return twice("centres", centres)


def _numbers(at: Floats, numbers: Any, apart: float) -> list[tuple[str, Floats]]:
    """Numbers of places from 1, those that would cover one another as one."""
    labels: list[tuple[str, Floats]] = []
    for place, number in zip(at, numbers):
        near = next((i for i, (_, other) in enumerate(labels) if np.hypot(*(other - place)) < apart), None)
        if near is None:
            labels.append((f"{number + 1}", place))
        else:
            labels[near] = f"{labels[near][0]}, {number + 1}", labels[near][1]
    return labels


def rows_of_table(file: str, table: Any, s: Any, title: str) -> Rows:
    """Rows with the keys of a table of the program's."""
    known = [name in table for name in KEYS]
    return Rows(file, table.reindex(columns=KEYS, fill_value=0.0).to_numpy(dtype=float) / UNITS, known, [True] * 4, dbsm(s), s, [True] * 4, title=title)


def parts_pictures(file: str, options: Options) -> Pictures:
    """``parts.*``: mechanisms along the cut through the peak, VV and HH."""
    table = read_csv(file)
    amplitudes = mechanisms_of(table)
    rows = rows_of_table(file, table, sum(amplitudes.values()), _title_beside(file, options))
    rows.joined = not is_coarse(run_of(options.beside(file)).get("warnings", []))

    def parts() -> Figure:
        channels = options.channels or [0, 3]
        key, cuts = cuts_of(rows)
        cut = choice_with(cuts, rows.peak_row(channels), 1)[0]
        levels = np.stack([rows.sigma, *map(dbsm, amplitudes.values())])[:, cut.rows][..., channels]
        scale = scale_of(levels, options.style, 60.0 if len(amplitudes) > 1 else CURVE_DEPTH)
        figure = canvas(10.0, 3.7 * len(channels) + 0.6, options)
        for i, channel in enumerate(channels):
            ax = figure.add_subplot(len(channels), 1, i + 1)
            _plots.draw_cut(ax, rows, cut, key, [channel], scale, Style(printed=True, unit=options.style.unit))
            ax.lines[0].set(label="all together", linewidth=2.0 * ax.lines[0].get_linewidth(), color="black")
            if rows.joined and len(cut.x) > 1:
                ax.lines[0].set(linestyle="-")
            for number, (name, s) in enumerate(amplitudes.items()):
                levels = scale.of(dbsm(s[cut.rows, channel]))
                if np.any(levels >= scale.bottom):
                    look = options.style.line(number % 8, 9, 0 if name.startswith("bounce_") else 3, len(cut.x), rows.joined)
                    ax.plot(cut.x, levels, label=mechanism_text(name), **look)
            ax.set_title(TITLES[channel] + (f"; {cut.fixed}" if cut.fixed else ""))
            _plots.add_key(ax)
        through = " (cut through the peak)" if len(cuts) > 1 else ""
        centre_heading(figure, f"{rows.title}: by mechanism, which add up with their phases{through}")
        return figure

    return twice("parts", parts)


def image_pictures(file: str, options: Options) -> Pictures:
    """``image.png``, ``image_phase.png``, ``image_window.png`` of the cells of a look."""
    table, stem, text = read_csv(file), Path(file).stem, " ".join(comments(file))
    shape = int(table["row"].max()) + 1, int(table["col"].max()) + 1
    s = amplitudes_of(table).reshape(*shape, 4)
    u, v = table["u_m"].to_numpy().reshape(shape)[0], table["v_m"].to_numpy().reshape(shape)[:, 0]
    look = re.search(r"Look (\d+), theta ([\d.e+-]+) phi ([\d.e+-]+) deg to the transmitter.*?([\d.e+-]+) Hz", text)
    frequency = float(look[4]) if look else float("nan")
    cell = [float(axis[1] - axis[0]) if len(axis) > 1 else 1.0 for axis in (u, v)]
    where = f"look {look[1]}: {_plots.sweep_text([frequency], [float(look[2])], [float(look[3])])}; " if look else ""
    heading = f"{_title_beside(file, options)}\n{where}cells of {1e3 * cell[0]:.3g} × {1e3 * cell[1]:.3g} mm"
    empty = np.all(s == 0.0, axis=-1)

    def draw(amplitude: Any, label: str, note: str, phase: bool = False) -> Figure:
        level = np.where(empty[..., None], np.nan, dbsm(amplitude))
        norms = np.sort(np.nanmax(level, axis=-1, initial=-np.inf)[~empty])
        top = float(np.ceil(norms[-1 - len(norms) // 1000])) if len(norms) else 0.0  # edges seen end-on outshine all else
        lowest, channels = top - IMAGE_DEPTH, _signal(level, IMAGE_DEPTH, options.channels)
        colours = {"vmin": -180.0, "vmax": 180.0, "cmap": "twilight"} if phase else {"vmin": lowest, "vmax": top, "cmap": options.style.colour_map}

        def panel(ax: Any, c: int) -> Any:
            shown = np.degrees(np.angle(amplitude[..., c])) if phase else np.maximum(level[..., c], lowest)
            ax.set(xlabel="u (m)", ylabel="v (m)", aspect="equal")
            return _plots.draw_cells(ax, u, v, np.where(level[..., c] > lowest, shown, np.nan) if phase else shown, **colours)

        row, column, c = map(int, np.unravel_index(int(np.nanargmax(np.nan_to_num(level, nan=-np.inf))), level.shape))
        weak = [TITLES[k] for k in range(4) if k not in channels]
        below = f"; {', '.join(weak)} below {lowest:.0f} dBsm" if weak and not options.channels else ""
        strongest = f"\nstrongest {TITLES[c]}: {level[row, column, c]:.1f} dBsm at u = {u[column]:.4g}, v = {v[row]:.4g} m"
        height = float(np.clip(4.4 * len(v) * cell[1] / (len(u) * cell[0]), 1.5, 7.0))
        words = heading + note + ("" if phase else strongest) + below
        return heat_panels([(TITLES[c], partial(panel, c=c)) for c in channels], label, words, options, (4.4, height),
                           ticks=np.arange(-180, 181, 45) if phase else None)

    width = _WINDOW * 299792458.0 / frequency
    return {f"{stem}.png": lambda: draw(s, "σ of a cell (dBsm)", ""),
            f"{stem}_phase.png": lambda: draw(s, "phase of a cell (°)", "", True),
            f"{stem}_window.png": lambda: draw(through_window(s, cell, width), "σ in the window (dBsm)",
                                               f"\nwindow of {1e3 * width:.3g} mm ({_WINDOW:g} λ)")}


def through_window(s: Any, cell: list[float], width: float) -> Any:
    """Sums of cells [v, u, channel] under a Hann window of this width [m] about each."""
    from scipy.ndimage import convolve1d

    for axis, step in ((1, cell[0]), (0, cell[1])):
        side = np.arange(0.0, 0.5 * width, step)
        weights = np.cos(np.pi * np.concatenate([-side[:0:-1], side]) / width) ** 2
        s = convolve1d(s.real, weights, axis, mode="constant") + 1j * convolve1d(s.imag, weights, axis, mode="constant")
    return s


def convergence_pictures(file: str, options: Options) -> Pictures:
    """``converge.*``: estimated error by tubes per wavelength and by time."""
    table, text = read_csv(file), " ".join(comments(file))
    if not np.any(np.isfinite(table["estimated_relative_error"])):
        raise InputError(f"{file}: three densities are needed for the errors that its picture shows; study more")
    density, error = table["per_wavelength"].to_numpy(), np.maximum(table["estimated_relative_error"].to_numpy(), 1e-17)
    timed = bool(np.all(np.isfinite(table["solve_s"])))
    cost = np.maximum(table["solve_s"].to_numpy(), 1e-6) if timed else table["rays"].to_numpy()
    order, recommended = re.search(r"([\d.]+) on average", text), re.search(r"tubes\.per_wavelength = ([\d.e+-]+)", text)

    def converge() -> Figure:
        figure, colours = canvas(11.0, 4.8, options), options.style.colours
        for i, (x, label) in enumerate(((density, "tubes per wavelength"), (cost, "time (s)" if timed else "rays"))):
            ax = figure.add_subplot(1, 2, i + 1)
            ax.loglog(x, error, "o-", color=colours[0], label="error")
            ax.loglog(x[-1:], error[-1:], "o", markersize=2.0 * matplotlib.rcParams["lines.markersize"], fillstyle="none", color=colours[3],
                      label="finest: estimated by the order")
            if i == 0:
                if order:
                    ax.loglog(x, error[-1] * (x / x[-1]) ** -float(order[1]), "--", color="#808080", label=f"order {order[1]}, the mean")
                if recommended:
                    ax.axvline(float(recommended[1]), color=colours[1], linestyle=":", label=f"recommended: {recommended[1]}")
                ax.set_xticks(density, [f"{d:g}" for d in density], minor=False)
                ax.set_xticks([], minor=True)
            for at, e, d in zip(x, error, density) if i else ():
                ax.annotate(f"{d:g}", (at, e), (6, 4), textcoords="offset points")
            ax.set(xlabel=label, ylabel="estimated relative error of S")
            ax.grid(alpha=0.3)
            for axis in (ax.xaxis, ax.yaxis)[1 - i:]:
                plain_decades(axis)
            ax.set_ylim(10.0 ** np.floor(np.log10(error.min())), 10.0 ** np.ceil(np.log10(error.max())))
            ax.legend(loc="best")
        centre_heading(figure, f"{_title_beside(file, options)}: convergence")
        return figure

    return twice("converge", converge)


def plain_decades(axis: Any) -> None:
    """0.001 and not a power of ten."""
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def comparison_pictures(file: str, options: Options) -> Pictures:
    """``compare.*`` of the two tables that ``compare.csv`` names: curves and their differences, or maps."""
    lines = comments(file)
    named = re.match(r"result: (.*), \d+ rows; reference: (.*), \d+ rows$", lines[0] if lines else "")
    if not named:
        raise InputError(f"{file} names no two tables; images are compared and drawn by raytube compare")
    asked = dict(line.split(" ", 1) for line in lines if re.match(r"--[a-z-]+ ", line))
    first, second = (_table_named(name, file, asked.get(f"--{what}-columns", ""), f"--{what}-columns")
                     for name, what in zip(named.groups(), ("result", "reference")))
    scaled = re.search(r"the result by ([-+\d.e]+) dB", " ".join(lines))
    within = re.search(r"within ([\d.e+-]+) dB of its peak", " ".join(lines))
    pairs = common_rows(first, second)
    result, reference = (Rows(r.file, r.keys[of], r.known, r.has_channel, r.sigma[of], r.S[of], r.has_phase) for r, of in zip((first, second), pairs))
    result.sigma = result.sigma + (float(scaled[1]) if scaled else 0.0)

    def compare() -> Figure:
        return comparison_figure(result, reference, float(within[1]) if within else 20.0, options)

    return twice("compare", compare)


def _table_named(name: str, beside: str, columns: str, option: str) -> Rows:
    for place in (Path(name), Path(beside).parent / name):
        if place.exists():
            return read_rows(str(place), columns, option)
    raise InputError(f"{beside} compares {name}, which does not exist here; compare again, or go to its folder")


def common_rows(first: Rows, second: Rows) -> tuple[Any, Any]:
    """Numbers of the rows that two results have in common, by the keys that both have."""
    import pandas

    by = [key for key in range(LOOK) if first.known[key] and second.known[key]]
    frames = [pandas.DataFrame(np.round(rows.keys[:, by] / np.array([1e-6, 1e-4, 1e-4, 1e-4, 1e-4, 1e-9])[by])).reset_index(names="row")
              for rows in (first, second)]
    found = frames[0].merge(frames[1].drop_duplicates(list(range(len(by)))), on=list(range(len(by))), suffixes=("", "_of_second"))
    if found.empty:
        raise InputError(f"{first.file} and {second.file} have no row in common; compare what does")
    return found["row"].to_numpy(), found["row_of_second"].to_numpy()


def comparison_figure(result: Rows, reference: Rows, within: float, options: Options) -> Figure:
    """Two results in equal rows: over two quantities maps of both and of the difference, else curves over the difference."""
    channels = [c for c in options.channels or range(4) if result.has_channel[c] and reference.has_channel[c]]
    channels = [c for c in channels if reference.peak([c]) >= reference.peak(channels) - MAP_DEPTH] or channels[:1]
    floor = np.array([reference.peak([c]) - MAP_DEPTH for c in range(4)])
    with np.errstate(invalid="ignore"):
        difference = np.maximum(result.sigma, floor) - np.maximum(reference.sigma, floor)
        near = np.where(reference.sigma >= floor + MAP_DEPTH - within, difference, np.nan)
    largest = float(np.nanmax(np.abs(near[:, channels]), initial=0.0))
    span = min(1.15 * largest, 20.0) if largest > 0.0 else 1.0
    name_apart([result, reference])
    heading = options.title or f"{result.name} against {reference.name}"
    peak = reference.peak_row(channels)
    grid = grid_of(reference, peak, MOST_PANELS) if options.kind != "curves" else None
    if grid:
        return _comparison_maps(result, reference, difference, grid, channels, span, heading, options)
    key, all_cuts, panels = panels_of_cuts([reference], peak, 3)
    scale = scale_of(np.stack([result.sigma[:, channels], reference.sigma[:, channels]]), options.style, CURVE_DEPTH)
    figure = canvas(8.0 + 4.5 * (len(panels) - 1), 6.6, options)
    axes = figure.subplots(2, len(panels), squeeze=False, sharex="col", height_ratios=(3, 2))
    for column, (fixed, (cut,)) in enumerate(panels):
        for rows, name in ((reference, "reference"), (result, "result")):
            _plots.draw_cut(axes[0, column], rows, cut, key, channels, scale, options.style, (0, 1), "")
            for line in axes[0, column].lines[-len(channels):]:
                line.set(label=f"{line.get_label()} {name}")
                if rows is reference:
                    line.set(alpha=0.35, linewidth=3.5 * line.get_linewidth(), linestyle="-", marker="")
        for c in channels:
            look = options.style.line(0, 1, c, len(cut.x))
            axes[1, column].plot(cut.x, difference[cut.rows, c], **look | {"alpha": 0.35, "linewidth": 1.0})
            axes[1, column].plot(cut.x, near[cut.rows, c], label=TITLES[c], **look)
        axes[0, column].set(title=fixed, xlabel="")
        axes[1, column].set(xlabel=LABELS[key], ylabel="result − reference (dB)", ylim=(-span, span))
        axes[1, column].grid(alpha=0.3)
        _plots.angle_ticks(axes[1, column].xaxis, key)
    _plots.add_key(axes[0, -1])
    _plots.add_key(axes[1, -1])
    axes[1, -1].get_legend().set_title(f"pale: reference more than\n{within:g} dB below its peak")
    shown = "" if len(panels) == all_cuts else f" ({len(panels)} of {all_cuts} cuts)"
    centre_heading(figure, heading + shown)
    return figure


def _comparison_maps(result: Rows, reference: Rows, difference: Floats, grid: Grid, channels: list[int], span: float, heading: str,
                     options: Options) -> Figure:
    channels, grey = mapped_channels(reference, channels, options), options.style.printed
    levels = np.stack([grid.over(result.sigma), grid.over(reference.sigma)])
    scale = scale_of(levels[..., channels], options.style, MAP_DEPTH, exact=True)
    apart = grid.over(np.abs(difference) if grey else difference)
    figure = canvas(14.0, 3.6 * len(channels) + 1.0, options)
    axes = figure.subplots(len(channels), 3, squeeze=False, subplot_kw={"projection": "hammer" if grid.covers_sphere() else None})
    for line, c in zip(axes, channels):
        for ax, shown in zip(line, scale.of(levels[..., c])):
            mesh = _plots.draw_grid(ax, grid, shown, **scale.mesh)
        other = _plots.draw_grid(line[2], grid, apart[..., c], vmin=0.0 if grey else -span, vmax=span, cmap="Greys" if grey else "RdBu_r")
        for ax, name in zip(line, ("result", "reference", "result − reference")):
            ax.set_title(f"{TITLES[c]} {name}")
            ax.set_ylabel(ax.get_ylabel() if name == "result" else "")
    figure.colorbar(mesh, ax=list(axes[:, :2].ravel()), label=scale.label)
    figure.colorbar(other, ax=list(axes[:, 2]), label="magnitude of the difference (dB)" if grey else "difference (dB)")
    centre_heading(figure, heading + ("" if grid.whole else f"\nrows at {grid.fixed}, through the peak"))
    return figure


def sources_pictures(file: str, options: Options) -> Pictures:
    """``sources.*``: errors by rays and time, or of many positions the shares by position; of hits.ply and launch.ply beside the table
    ``hits.*`` and ``launch.*``."""
    table = read_csv(file)
    launch, hits = (_read_points(Path(file).with_name(name)) for name in ("launch.ply", "hits.ply"))
    part = hits[0].removeprefix("hits on ")
    chosen = table[table["part"] == part]
    columns = (("direct_percent", "share of the rays, as counted"), ("estimate_percent", "each ray weighted by its solid angle"))

    def sources() -> Figure:
        several = chosen["position"].max() > 0
        figure = canvas(11.0, 7.4, options)
        axes = figure.subplots(2, 1 if several else 2, squeeze=False)
        finest = chosen[chosen["rays_asked"] == chosen["rays_asked"].max()] if several else chosen
        for line, (column, name) in enumerate(columns):
            shown = "response_percent" if several and line == 0 else column
            for ax, x in zip(axes[line], ("position",) if several else ("rays", "seconds")):
                for number, (model, of) in enumerate(finest.groupby("model", sort=False)):
                    value = of[shown] if several else np.maximum(100.0 * np.abs(of[column] - of["exact_percent"]) / of["exact_percent"], 1e-6)
                    if np.any(np.isfinite(value)):
                        ax.plot(of[x], value, marker=_plots.MARKERS[number], color=options.style.colours[number % 8], label=str(model))
                    if several and line == 1 and number == 0:
                        ax.plot(of[x], of["exact_percent"], "k--", label="exact")
                ax.set(xlabel="position of the source, counted from 0" if several else x,
                       ylabel="percent" if several else "error (% of the exact share)",
                       title="direct and reflected: hits per hundred rays" if shown == "response_percent" else name)
                ax.grid(alpha=0.3)
                if not several:
                    ax.set(xscale="log", yscale="log")
                    plain_decades(ax.xaxis)
                    plain_decades(ax.yaxis)
            _plots.add_key(axes[line, -1])
        centre_heading(figure, f"{_title_beside(file, options)}\n{part}")
        return figure

    def clouds(what: str, models: dict[str, Any], flat: bool) -> Figure:
        columns = min(len(models), 3) or 1
        lines = -(-len(models) // columns) or 1
        spread = np.max([np.ptp(points[:, :3], axis=0) for points in models.values()] or [(1.0, 1.0, 0.0)], axis=0)
        x, y = sorted(np.argsort(spread)[1:])  # the plane in which they spread most
        height = float(np.clip(4.4 * spread[y] / max(spread[x], 1e-9), 1.2, 4.4)) if flat else 4.0
        figure = canvas(4.4 * columns + 1.0, (height + 0.8) * lines + 0.8, options)
        axes = figure.subplots(lines, columns, squeeze=False, sharex=flat, sharey=flat, subplot_kw={"projection": None if flat else "3d"})
        most = max([1.0, *(float(points[:, 4].max()) for points in models.values() if flat)])
        for ax, (model, points) in zip(axes.flat, models.items()):
            ax.set_title(f"{model}: {len(points)} points")
            if flat:
                dots = ax.scatter(points[:, x], points[:, y], 6.0, points[:, 4], vmin=0.0, vmax=most, cmap=options.style.colour_map, rasterized=True)
                ax.set(xlabel=f"{'xyz'[x]} (m)", ylabel=f"{'xyz'[y]} (m)", aspect="equal")
                ax.label_outer()
            else:
                ax.scatter(*points[:, :3].T, s=1.0, color=options.style.colours[0], rasterized=True)
                ax.set(xlabel="x (m)", ylabel="y (m)", zlabel="z (m)")
                ax.set_box_aspect((4.0, 4.0, 3.0), zoom=0.8)  # leaves room for the labels
                ax.set_aspect("equal")
                ax.locator_params(nbins=4)
        for ax in axes.flat[len(models):]:
            ax.remove()
        if flat and models:
            figure.colorbar(dots, ax=list(axes.flat[:len(models)]), label="bounces before", ticks=MaxNLocator(integer=True))
        centre_heading(figure, f"{_title_beside(file, options)}\n{what}")
        return figure

    return twice("sources", sources) | twice("hits", partial(clouds, *hits, True)) | twice("launch", partial(clouds, *launch, False))


def _read_points(file: Path) -> tuple[str, dict[str, Any]]:
    """What a cloud of points of sources shows, and by model its rows x, y, z, model and of hits bounce."""
    try:
        head, _, body = file.read_text(encoding="utf-8").partition("end_header\n")
        what, names = re.search(r"comment (.*), lengths in m; model:(.*)", head).groups()  # type: ignore[union-attr]
        rows = np.array(body.split(), dtype=float).reshape(int(re.search(r"vertex (\d+)", head)[1]), -1)  # type: ignore[index]
    except (OSError, ValueError, AttributeError, TypeError) as error:
        raise InputError(f"{file}: is not a point cloud from raytube sources ({error}); run raytube sources again") from None
    names_of = dict(zip(names.split()[::2], names.split()[1::2]))
    return what, {names_of[str(int(model))]: rows[rows[:, 3] == model] for model in np.unique(rows[:, 3])} if len(rows) else {}


# By columns that nothing else has.
_KNOWN: tuple[tuple[set[str], Callable[[str, Options], Pictures]], ...] = (
    ({"cross_range_m"}, isar_pictures),
    ({"time_s", "velocity_m_per_s"}, spectrogram_pictures),
    ({"velocity_m_per_s"}, doppler_pictures),
    ({"range_m", "model_vv_dbsm"}, profile_pictures),
    ({"range_m", "model_dbsm"}, profile_pictures),
    ({"centre", "mechanism", "x_m"}, centres_pictures),
    ({"row", "col", "u_m", "v_m"}, image_pictures),
    ({"per_wavelength", "estimated_relative_error"}, convergence_pictures),
    ({"channel", "result_peak_dbsm", "reference_peak_dbsm"}, comparison_pictures),
    ({"re_vv_bounce_1"}, parts_pictures),
    ({"position", "model", "response_percent"}, sources_pictures),
)


def product_pictures(file: str) -> Callable[[str, Options], Pictures] | None:
    """What draws a file, if it is one of those that commands write beside results."""
    header = set(header_of(file))
    return next((draw for columns, draw in _KNOWN if columns <= header), None)

"""Whole pictures of results of sigma, and what all pictures share."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from raytube import _plots
from raytube._core import InputError
from raytube._plots import CURVE_DEPTH, MAP_DEPTH, TITLES, Style, scale_of
from raytube._rows import ANGLES, LABELS, LOOK, Cut, Grid, Rows, channels_of, choice_with, cuts_of, grid_of, name_apart
from raytube._tables import Floats, run_of

MOST_PANELS, _MOST_RESULTS = 4, 8
_CROSS_POLAR = 20.0  # a map of a channel that stays this far below the peak shows nothing [dB]


@dataclass
class Options:
    """What the command line asks for."""

    kind: str = "auto"
    channels: list[int] = field(default_factory=list)
    style: Style = field(default_factory=Style)
    size: tuple[int, int] | None = None
    title: str = ""
    columns: str = ""
    run: str = ""  # folder of the run that a file was made of, or its case; empty: the folder of the file

    def beside(self, file: str) -> str:
        """A file in the folder of the run."""
        return str(Path(self.run) / "rcs.csv") if self.run else file

    def described(self, file: str) -> dict[str, Any]:
        """``run.json`` of the run, or as much of it as its case says."""
        if not self.run.endswith(".toml"):
            return run_of(self.beside(file))
        with open(self.run, "rb") as case:
            return {"case": {"title": tomllib.load(case).get("title", "")}, "case_file": self.run}


Pictures = dict[str, Callable[[], Figure]]


def twice(name: str, draw: Callable[[], Figure]) -> Pictures:
    """A picture in dots and in lines, drawn once."""
    once = cache(draw)
    return {f"{name}.png": once, f"{name}.svg": once}


def canvas(width: float, height: float, options: Options) -> Figure:
    """An empty picture of this size in inches, or of the size asked for, with text scaled to it."""
    usual = width * height
    if options.size:
        width, height = ((pixels + 0.01) / 100.0 for pixels in options.size)  # of a fraction matplotlib keeps what is whole
    grown = (width * height / usual) ** 0.5
    for name in ("font.size", "lines.linewidth", "lines.markersize", "axes.linewidth", "grid.linewidth", "patch.linewidth", "axes.titlepad",
                 "axes.labelpad", *(f"{xy}tick.{what}" for xy in "xy" for what in ("major.size", "major.width", "major.pad"))):
        matplotlib.rcParams[name] = matplotlib.rcParamsDefault[name] * grown
    matplotlib.rcParams["axes.titlesize"] = "medium"
    return Figure(figsize=(width, height), layout="constrained")


def centre_heading(figure: Figure, text: str) -> None:
    """Puts the heading over the middle of the panels, not of panels and colour bar together."""
    heading = figure.suptitle(text, fontsize="large")
    figure.draw_without_rendering()
    boxes = [ax.get_position() for ax in figure.axes if ax.get_label() != "<colorbar>"]
    heading.set_x(0.5 * (min(box.x0 for box in boxes) + max(box.x1 for box in boxes)))


def figure_of_results(results: list[Rows], options: Options) -> Figure:
    """Curves, maps or polar curves of results of sigma."""
    if len(results) > _MOST_RESULTS:
        raise InputError(f"{len(results)} results: more than {_MOST_RESULTS} in one picture cannot be told apart; plot fewer")
    name_apart(results)
    channels = channels_of(results, options.channels)
    title = options.title or (results[0].title or results[0].file if len(results) == 1 else ", ".join(rows.name for rows in results))
    first, kind = results[0], options.kind
    if kind in ("map", "sphere") and len(results) > 1:
        raise InputError(f"--kind {kind}: {len(results)} results; a map shows one, give one file")
    peak = first.peak_row(channels) if np.isfinite(first.peak(channels)) else 0
    if kind == "polar":
        return _polar(results, peak, channels, title, options)
    grid = grid_of(first, peak, 1 if kind in ("map", "sphere") else MOST_PANELS) if len(results) == 1 and kind != "curves" else None
    if kind == "sphere" and not (grid and grid.covers_sphere()):
        raise InputError(f"--kind sphere: {first.file} does not hold azimuths all round with polar angles; use --kind map or curves")
    if kind == "map" and not grid:
        raise InputError(f"--kind map: {first.file} holds no grid over two quantities; use --kind curves")
    return _map(first, grid, peak, channels, title, options) if grid else _curves(results, peak, channels, title, options)


def panels_of_cuts(results: list[Rows], peak: int, most: int) -> tuple[int, int, list[tuple[str, list[Cut]]]]:
    """The quantity that curves run along, how many cuts there are, and those to be shown, with one of each result."""
    planned = [cuts_of(rows) for rows in results]
    key, cuts = planned[0]
    for rows, (other, _) in zip(results, planned):
        if other != key:
            raise InputError(f"{results[0].file} is a sweep over {LABELS[key]}, {rows.file} one over {LABELS[other]}; plot them one by one")
    if all(len(each) == 1 for _, each in planned):
        alike = {each[0].fixed for _, each in planned}
        return key, 1, [(alike.pop() if len(alike) == 1 else "", [each[0] for _, each in planned])]
    by_text = [{cut.fixed: cut for cut in each} for _, each in planned]
    shared = [cut for cut in cuts if all(cut.fixed in known for known in by_text)]
    if not shared:
        raise InputError(f"no cut of {results[0].file} ({cuts[0].fixed} ...) is in all other results; plot them one by one")
    through = peak if any(peak in cut.rows for cut in shared) else int(shared[0].rows[0])
    return key, len(cuts), [(cut.fixed, [known[cut.fixed] for known in by_text]) for cut in choice_with(shared, through, most)]


def _draw_cuts(ax: Any, results: list[Rows], cuts: list[Cut], key: int, channels: list[int], scale: _plots.Scale, style: Style) -> None:
    differ = len({cut.fixed for cut in cuts}) > 1
    for i, (rows, cut) in enumerate(zip(results, cuts)):
        name = "" if len(results) == 1 else f"{rows.name}, {cut.fixed}" if differ else rows.name
        _plots.draw_cut(ax, rows, cut, key, channels, scale, style, (i, len(results)), name)


def _levels(results: list[Rows], cuts: list[Cut], channels: list[int]) -> Floats:
    return np.concatenate([rows.sigma[cut.rows][:, channels].ravel() for rows, cut in zip(results, cuts)])


def _curves(results: list[Rows], peak: int, channels: list[int], title: str, options: Options) -> Figure:
    key, all_cuts, panels = panels_of_cuts(results, peak, MOST_PANELS)
    scale = scale_of(np.concatenate([_levels(results, cuts, channels) for _, cuts in panels]), options.style, CURVE_DEPTH)
    columns = 1 if len(panels) == 1 else 2
    lines = -(-len(panels) // columns)
    figure = canvas(9.0 if columns == 1 else 12.0, 4.8 if lines == 1 else 7.6, options)
    for i, (fixed, cuts) in enumerate(panels):
        ax = figure.add_subplot(lines, columns, i + 1)
        _draw_cuts(ax, results, cuts, key, channels, scale, options.style)
        ax.set_xlim(_plots.ends_of(cuts, all(rows.joined for rows in results)))
        _plots.angle_ticks(ax.xaxis, key)
        if i == columns - 1 or len(panels) == 1:
            _plots.add_key(ax)
        ax.set_title(f"{title}\n{fixed}".strip() if len(panels) == 1 else fixed)
    if len(panels) > 1:
        shown = "" if len(panels) == all_cuts else f" ({len(panels)} of {all_cuts} cuts, with that through the peak)"
        centre_heading(figure, title + shown)
    return figure


def _polar(results: list[Rows], peak: int, channels: list[int], title: str, options: Options) -> Figure:
    key, _, panels = panels_of_cuts(results, peak, 1)
    if key not in ANGLES:
        raise InputError(f"--kind polar: {results[0].file} is a sweep over {LABELS[key]}, not over an angle; use --kind curves")
    fixed, cuts = panels[0]
    scale = _plots.polar_scale(_levels(results, cuts, channels), options.style)
    figure = canvas(9.2, 6.6, options)
    ax = figure.add_subplot(projection="polar")
    _draw_cuts(ax, results, cuts, key, channels, scale, options.style)
    _plots.dress_polar(ax, scale, key)
    ax.set_title(f"{title}\n{fixed}{'; ' if fixed else ''}{scale.label} over {LABELS[key]}")
    _plots.add_key(ax)
    return figure


def map_panels(draw: Callable[..., Any], levels: Floats, channels: list[int], heading: str, options: Options, size: tuple[float, float],
               projection: str | None = None) -> Figure:
    """Levels [dBsm] of channels, their last axis, as colours: `draw` takes axes, levels and keywords of a mesh."""
    scale = scale_of(levels[..., channels], options.style, MAP_DEPTH, exact=True)
    panels = [(TITLES[c], partial(draw, levels=scale.of(levels[..., c]), **scale.mesh)) for c in channels]
    return heat_panels(panels, scale.label, heading, options, size, projection)


def heat_panels(panels: Sequence[tuple[str, Callable[[Any], Any]]], label: str, heading: str, options: Options, size: tuple[float, float],
                projection: str | None = None, ticks: Any = None) -> Figure:
    """Panels of colours, each drawn by a callable that returns its mesh, with one colour bar; `size` of each in inches."""
    columns = min(len(panels), 2)
    lines = -(-len(panels) // columns)
    figure = canvas(size[0] * columns + 1.5, (size[1] + 0.5) * lines + 1.0, options)
    axes = [figure.add_subplot(lines, columns, i + 1, projection=projection) for i in range(len(panels))]
    for ax, (title, draw) in zip(axes, panels):
        mesh = draw(ax)
        ax.set_title(title)
    figure.colorbar(mesh, ax=axes, label=label, ticks=ticks)
    centre_heading(figure, heading)
    return figure


def mapped_channels(rows: Rows, channels: list[int], options: Options) -> list[int]:
    """Those asked for; else co-polar ones, and cross-polar ones near the peak."""
    highest = rows.peak(channels)
    return channels if options.channels else [c for c in channels if c in (0, 3) or rows.peak([c]) >= highest - _CROSS_POLAR]


def _map(rows: Rows, grid: Grid, peak: int, channels: list[int], title: str, options: Options) -> Figure:
    channels, sphere = mapped_channels(rows, channels, options), options.kind == "sphere" or grid.covers_sphere()
    strongest = channels[int(np.argmax(rows.sigma[peak, channels]))]
    part = "" if grid.whole else f"rows at {grid.fixed}, through the peak; "
    heading = f"{title}\n{part}peak {rows.sigma[peak, strongest]:.1f} dBsm, {TITLES[strongest]}, at {rows.fixed(peak)}"
    wide = 7.5 if len(channels) == 1 else 5.4
    return map_panels(partial(_plots.draw_grid, grid=grid), grid.over(rows.sigma), channels, heading, options,
                      (wide, wide / (2.0 if sphere else 1.6)), "hammer" if sphere else None)

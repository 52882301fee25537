"""Two images beside each other: read, registered, measured."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raytube import _core
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._tables import cell_text, dbsm

_PLACES = (("u_m", "v_m"), ("cross_range_m", "range_m"), ("col", "row"), ("x", "y"))
_LOOKS = {"freq_hz", "freq_ghz", "theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"}
_MOST_PIXELS = 4_000_000
_DYNAMIC_RANGE_DB = 80.0  # channels further below the highest peak have no signal, and the result's levels count as no lower than that
_LINES = {"result_peak_dbsm": "peak of the result, dBsm", "reference_peak_dbsm": "peak of the reference, dBsm",
          "#within": "dB error, result minus reference, where the reference is within {within:g} dB of its peak", "pixels_within": "pixels",
          "rms_db": "rms", "mean_abs_db": "mean |error|", "median_abs_db": "median |error|", "p95_abs_db": "95th percentile of |error|",
          "largest_abs_db": "largest |error|", "bias_db": "bias (mean error)", "at_peak_db": "error at the reference's peak",
          "ssim": "SSIM (Wang et al. 2004) of {within:g} dB below that peak", "#all": "over all {pixels} pixels",
          "correlation": "correlation of magnitudes", "magnitude_error": "relative rms error of magnitudes",
          "relative_error": "relative rms error of complex pixels", "power_ratio_db": "power, result over reference, dB"}
_MEASURES = [name for name in _LINES if not name.startswith("#")]
CSV_COLUMNS = ("channel", *_MEASURES[:2], "shift_columns", "shift_rows", "pixels", *_MEASURES[2:], "largest_column", "largest_row")
Values = NDArray[Any]
Axis = tuple[float, float, int]  # middle of the first pixel, step, pixels


@dataclass
class Image:
    """Amplitudes [m] of each channel, [row, column]; those of a channel without phase are magnitudes."""

    file: str
    placed: bool  # axes are in metres; else they number the pixels
    up: Axis
    across: Axis
    S: dict[str, Values]
    phase: frozenset[str]


def are_images(result: tuple[str, str], reference: tuple[str, str]) -> bool:
    """Of files and their maps of columns; one image beside a table is refused."""
    both = [_core.is_image_file(*result), _core.is_image_file(*reference)]
    if both[0] != both[1]:
        image, table = (result[0], reference[0])[::1 if both[0] else -1]
        raise InputError(f"{image} is an image and {table} is not; compare two images, or two tables of looks")
    return both[0]


def read_image(file: str, columns: str, option: str) -> Image:
    """Throws InputError for what is no image of a rectangle."""
    ending = os.path.splitext(file)[1].lower()
    if ending != ".nc":
        return (_read_openexr if ending == ".exr" else _read_pixels)(file, columns, option)
    if columns:
        raise InputError(f"{option}: {file} has variables, no columns; leave the option out")
    return _read_isar(file)


def _choices(columns: str) -> dict[str, str]:
    """A map of columns, in which a name of theirs may stand in double quotes, with whatever signs it holds."""
    return {ours.strip().lower(): theirs for ours, theirs in re.findall(r'([^=,]+)=((?:"[^"]*"|[^",])*)', columns)}


def _place_columns(file: str, columns: str) -> tuple[tuple[str, str] | tuple[()], set[str]]:
    """The columns that place pixels, and all there are."""
    line = ""
    if os.path.isfile(file):
        with open(file, encoding="utf-8-sig", errors="replace") as lines:
            stripped = (line.strip(' \t\r\n"') for line in iter(lambda: lines.readline(1_000_000), ""))
            line = next((line for line in stripped if line and not line.startswith("#")), "")
    names = {cell.strip(' \t"').lower() for cell in line.split(next((sign for sign in ",;" if sign in line), None))} | set(_choices(columns))
    return next((pair for pair in _PLACES if names >= set(pair) and (pair[0] != "x" or not names & _LOOKS)), ()), names


def _read_pixels(file: str, columns: str, option: str) -> Image:
    pair, names = _place_columns(file, columns)
    if not pair:
        raise InputError(f"{file}: no columns place its pixels; give u_m and v_m [m], or col and row, as in {option} col=NAME,row=NAME")
    if "height_m" in names:
        raise InputError(f"{file}: is an image in space; compare images in a plane, of one angle and frequency")
    chosen = _choices(columns)
    places = {"rx_phi_deg": chosen.pop(pair[0], f'"{pair[0]}"'), "rx_theta_deg": chosen.pop(pair[1], f'"{pair[1]}"')}
    try:  # a table whose looks are places of pixels
        table = _core.Table.of_file(file, ",".join(f"{ours}={theirs}" for ours, theirs in {**places, **chosen}.items()), option)
    except InputError as error:
        raise InputError(str(error).replace("write an angle in degrees, a frequency or a time in seconds", "write where the pixel is")) from None
    axes, index = [], []
    for values, name in ((table.keys[:, 3], pair[1]), (table.keys[:, 4], pair[0])):
        ascending = np.sort(values)
        steps = np.diff(ascending)
        steps = steps[steps > 1e-6 * np.ptp(values) / len(values)]
        usual = float(np.median(steps)) if len(steps) else 0.0
        if np.any(np.abs(steps - usual) > 1e-3 * usual):
            uneven = float(steps[np.argmax(np.abs(steps - usual))])
            raise InputError(f"{file}: {name} are not in even steps: one is {uneven:.6g}, others are {usual:.6g}; give every pixel of a rectangle")
        axes.append((float(ascending[0]), float(np.ptp(values)) / max(1, len(steps)), len(steps) + 1))
        index.append(np.rint((values - ascending[0]) / (axes[-1][1] or 1.0)).astype(int))
    flat = index[0] * axes[1][2] + index[1]
    repeated = np.flatnonzero(np.bincount(flat)[flat] > 1)
    if len(repeated):
        raise InputError(f"{file}: the pixel at {table.keys[repeated[0], 4]:g}, {table.keys[repeated[0], 3]:g} stands there twice; remove one")
    if len(flat) != axes[0][2] * axes[1][2]:
        raise InputError(f"{file}: has {len(flat)} rows for {axes[1][2]} x {axes[0][2]} pixels; give each pixel of a rectangle once")
    order = np.argsort(flat)
    S = {name: table.S[order, c].reshape(axes[0][2], axes[1][2]) for c, name in enumerate(CHANNELS) if table.has_channel[c]}
    return Image(file, pair[0].endswith("_m"), axes[0], axes[1], S, frozenset(name for c, name in enumerate(CHANNELS) if table.has_phase[c]))


def _read_isar(file: str) -> Image:
    import netCDF4

    with netCDF4.Dataset(file) as open_file:
        if "height_m" in open_file.dimensions:
            raise InputError(f"{file}: is an image in space; compare images in a plane, of one angle and frequency")
        S = np.asarray(open_file["S_re"][:]) + 1j * np.asarray(open_file["S_im"][:])  # [range_m, cross_range_m, receive, transmit]
        up, across = (np.asarray(open_file[name][:]) for name in ("range_m", "cross_range_m"))
    if not np.isfinite(S).all():
        raise InputError(f"{file}: holds a pixel that is not a finite number; make the image again")
    axes = [(float(axis[0]), float(axis[-1] - axis[0]) / max(1, len(axis) - 1), len(axis)) for axis in (up, across)]
    return Image(file, True, axes[0], axes[1], {name: S[..., c // 2, c % 2] for c, name in enumerate(CHANNELS)}, frozenset(CHANNELS))


def _read_openexr(file: str, columns: str, option: str) -> Image:
    """Lines run downwards in the file, rows upwards in the image; channels are columns."""
    import OpenImageIO as oiio
    import pandas as pd

    image = oiio.ImageInput.open(file)
    if image is None:
        raise InputError(f"{file}: cannot be read as OpenEXR ({' '.join(oiio.geterror().split())}); give the path of a flat image")
    spec = image.spec()
    if spec.deep or image.seek_subimage(1, 0):
        raise InputError(f"{file}: its pixels have depths, or it has several parts; save one flat image")
    if spec.width * spec.height > _MOST_PIXELS:
        raise InputError(f"{file}: has {spec.width} x {spec.height} pixels, more than {_MOST_PIXELS}; cut it")
    image.seek_subimage(0, 0)
    values = image.read_image("float")
    if values is None:
        raise InputError(f"{file}: cannot be read as OpenEXR ({' '.join(image.geterror().split())}); give the path of a flat image")
    values = np.asarray(values, float).reshape(spec.height * spec.width, -1)
    lines, across = np.divmod(np.arange(len(values)), spec.width)
    table = pd.DataFrame({"col": across, "row": spec.height - 1 - lines, **dict(zip((f'"{name}"' for name in spec.channelnames), values.T))})
    with tempfile.TemporaryDirectory() as folder:
        beside = os.path.join(folder, "pixels.csv")
        table.to_csv(beside, index=False, na_rep="nan", quoting=3)
        try:
            pixels = _read_pixels(beside, columns, option)
        except InputError as error:
            raise InputError(re.sub(rf"{re.escape(beside)}(, line \d+)?", lambda _: file, str(error))) from None
    pixels.file = file
    return pixels


def _axis_map(result: Axis, reference: Axis, placed: bool, shift: float) -> tuple[Values, Values]:
    """Pixels of the reference along an axis that lie within the result, and where they are in pixels of the result."""
    scale, offset = 1.0, 0.0
    step = result[1] or reference[1]
    if placed and step:
        scale, offset = (reference[1] or step) / step, (reference[0] - result[0]) / step
        if abs(scale - 1.0) * reference[2] < 1e-4:  # tables round
            scale = 1.0
        if abs(offset - round(offset)) < 1e-4:
            offset = round(offset)
    pixels = np.arange(reference[2])
    places = scale * (pixels + shift) + offset
    inside = (places > -1e-9) & (places < result[2] - 1 + 1e-9)
    return pixels[inside], np.clip(places[inside], 0.0, result[2] - 1)


def _sampled(S: Values, rows: Values, columns: Values) -> Values:
    """As it is at whole numbers, between them by cubic splines: magnitudes, and phases after their mean advance from pixel to pixel is taken off."""
    from scipy import ndimage

    whole = np.rint(rows).astype(int), np.rint(columns).astype(int)
    if max(np.abs(rows - whole[0]).max(), np.abs(columns - whole[1]).max()) < 1e-9:
        return np.asarray(S[np.ix_(*whole)])
    places = np.meshgrid(rows, columns, indexing="ij")
    advance = [np.angle(np.sum(S[1:] * S[:-1].conj())), np.angle(np.sum(S[:, 1:] * S[:, :-1].conj()))]
    turned = S * np.exp(-1j * (advance[0] * np.arange(S.shape[0])[:, None] + advance[1] * np.arange(S.shape[1])))
    phase = np.angle(ndimage.map_coordinates(turned, places, mode="nearest")) + advance[0] * places[0] + advance[1] * places[1]
    magnitude = ndimage.map_coordinates(np.abs(S), places, mode="nearest")
    return np.asarray(np.maximum(magnitude, 0.0) * np.exp(1j * phase))  # cubics overshoot


def best_shift(result: Values, reference: Values) -> tuple[float, float]:
    """The shift along rows and columns for which result(x + shift) correlates best with reference(x): the best whole number, up to half an image,
    until what both show lies still, then, of that, the highest value of the same sum of waves (Guizar-Sicairos, Thurman & Fienup, Opt. Lett. 33
    (2008) 156) to a thousandth of a pixel. What images have everywhere alike, their medians, is taken off."""
    from scipy import fft, optimize, signal

    a, b, whole = result, reference, np.zeros(2, int)
    for _ in range(5):
        correlation = signal.correlate(a - np.median(a), b - np.median(b), method="fft")
        lags = np.meshgrid(*(np.arange(1 - n, n) for n in a.shape), indexing="ij")
        near = np.maximum(np.abs(lags[0]) / a.shape[0], np.abs(lags[1]) / a.shape[1]) <= 0.5
        highest = correlation[near].max()
        near &= correlation >= highest - 1e-12 * abs(highest)
        step = np.array([lag[near][np.argmin(np.hypot(*lags)[near])] for lag in lags])  # of equal ones the nearest
        if not step.any() or np.any(2 * np.abs(whole + step) > result.shape):
            break
        whole += step
        (i, j), (k, m) = np.maximum(whole, 0), np.maximum(-whole, 0)
        a, b = result[i:len(result) - k, j:result.shape[1] - m], reference[k:len(result) - i, m:result.shape[1] - j]
    size = [fft.next_fast_len(n + n // 2) if n > 1 else 1 for n in a.shape]
    waves = fft.fft2(a - np.median(a), size) * fft.fft2(b - np.median(b), size).conj()
    k, m = (2j * np.pi * fft.fftfreq(n) for n in size)
    scale = float(np.abs(waves).sum()) or 1.0
    fine = optimize.minimize(lambda d: -float((np.exp(d[0] * k) @ waves @ np.exp(d[1] * m)).real) / scale, [0.0, 0.0],
                             bounds=[(-1.0, 1.0) if n > 1 else (0.0, 0.0) for n in size], method="L-BFGS-B", options={"ftol": 1e-15, "gtol": 1e-9})
    shift = whole + np.round(fine.x, 3)
    return float(shift[0]) + 0.0, float(shift[1]) + 0.0


def similarity(a: Values, b: Values, within_db: float) -> float:
    """Structural similarity (Wang, Bovik, Sheikh & Simoncelli, IEEE Trans. IP 13 (2004) 600, eq. 13) of levels above a floor, with a Gaussian window
    of 11 x 11 pixels, 1.5 wide, in means over pixels within the image: the mean over pixels where one is above the floor."""
    from scipy.ndimage import gaussian_filter

    smooth = partial(gaussian_filter, sigma=1.5, truncate=3.4, mode="constant")
    whole = smooth(np.ones_like(a))
    mean_a, mean_b, squares, product = (smooth(values) / whole for values in (a, b, a * a + b * b, a * b))
    c1, c2 = (0.01 * within_db) ** 2, (0.03 * within_db) ** 2
    luminance, means = 2.0 * mean_a * mean_b, mean_a**2 + mean_b**2
    index = (luminance + c1) * (2.0 * product - luminance + c2) / ((means + c1) * (squares - means + c2))
    shown = (a > 0.0) | (b > 0.0)
    return float(index[shown].mean()) if shown.any() else 1.0


class ImageComparison:
    """How far an image is from a reference, at the pixels of the reference that both show."""

    def __init__(self, result: Image, reference: Image, within_db: float, free_scale: bool, registered: bool) -> None:
        self.images, self.within_db, self.registered = (result, reference), within_db, registered
        self.compared = [name for name in CHANNELS if name in result.S and name in reference.S]
        if not self.compared:
            raise InputError(f"{result.file} and {reference.file} have no channel in common; name one in --result-columns or --reference-columns, "
                             "as in magnitude_vv=NAME")
        self._place((0.0, 0.0))
        if registered:
            self._place(best_shift(*(np.sqrt(sum(np.abs(pair[i]) ** 2 for pair in self.pairs.values())) for i in (0, 1))))
        self.rows = self.up.size * self.across.size
        self.factor = self._scale() if free_scale else None
        self._measure()

    def _place(self, shift: tuple[float, float]) -> None:
        (result, reference), self.shift = self.images, (shift[1], shift[0])
        placed = result.placed and reference.placed
        if not placed and (result.up[2], result.across[2]) != (reference.up[2], reference.across[2]):
            raise InputError(f"{result.file} has {result.across[2]} x {result.up[2]} pixels, {reference.file} {reference.across[2]} x "
                             f"{reference.up[2]}, and not both say where they are; give columns u_m and v_m in metres, or images of one size")
        self.up, rows = _axis_map(result.up, reference.up, placed, shift[0])
        self.across, columns = _axis_map(result.across, reference.across, placed, shift[1])
        if not self.up.size or not self.across.size:
            raise InputError(f"{result.file} and {reference.file} do not overlap: u from {result.across[0]:g} m, v from {result.up[0]:g} m against "
                             f"{reference.across[0]:g} m, {reference.up[0]:g} m; compare images of the same place")
        self.pairs = {}
        for name in self.compared:
            a, b = result.S[name], reference.S[name]
            if name not in result.phase or name not in reference.phase:
                a, b = np.abs(a), np.abs(b)
            self.pairs[name] = (_sampled(a, rows, columns), b[np.ix_(self.up, self.across)])

    def has_phase(self, name: str) -> bool:
        return name in self.images[0].phase and name in self.images[1].phase

    def _scale(self) -> complex:
        """The factor of the result that brings it nearest to the reference, by least squares."""
        a, b = (np.stack([pair[i] for pair in self.pairs.values()]) for i in (0, 1))
        if not all(map(self.has_phase, self.compared)):
            a, b = np.abs(a), np.abs(b)
        square = float(np.vdot(a, a).real)
        factor = complex(np.vdot(a, b)) / square if square > 0.0 else 0j
        if not 0.0 < abs(factor) < np.inf:
            raise InputError(f"--free-scale: {self.images[0].file} and {self.images[1].file} have no signal in common; leave the option out")
        self.pairs = {name: (factor * pair[0], pair[1]) for name, pair in self.pairs.items()}
        return factor

    def _measure(self) -> None:
        self.levels = {name: tuple(dbsm(S) for S in pair) for name, pair in self.pairs.items()}
        self.peaks = {name: (float(a.max()), float(b.max())) for name, (a, b) in self.levels.items()}
        highest = max(peak for _, peak in self.peaks.values())
        if highest == -np.inf:
            raise InputError(f"{self.images[1].file}: zero in every pixel compared; give a reference with a signal")
        signal = [name for name in self.compared if self.peaks[name][1] >= highest - _DYNAMIC_RANGE_DB]
        self.unexpected = [name for name in self.compared if name not in signal and self.peaks[name][0] >= highest - self.within_db]
        self.channels = {name: self._measures(name) for name in signal}

    def _measures(self, name: str) -> dict[str, float]:
        (a, b), peak = self.levels[name], self.peaks[name][1]
        a, floor = np.maximum(a, peak - _DYNAMIC_RANGE_DB), peak - self.within_db
        within = b >= floor
        error = (a - b)[within]
        size, place = np.abs(error), np.flatnonzero(within)[np.argmax(np.abs(error))]
        x, y = (np.abs(S) / np.abs(self.pairs[name][1]).max() for S in self.pairs[name])
        z = (self.pairs[name][0] - self.pairs[name][1]) / np.abs(self.pairs[name][1]).max()
        return {"result_peak_dbsm": self.peaks[name][0], "reference_peak_dbsm": peak, "pixels_within": int(within.sum()),
                "rms_db": float(np.sqrt(np.mean(error**2))), "mean_abs_db": float(size.mean()), "median_abs_db": float(np.median(size)),
                "p95_abs_db": float(np.percentile(size, 95)), "largest_abs_db": float(size.max()), "bias_db": float(error.mean()),
                "at_peak_db": float((a - b).flat[np.argmax(b)]),
                "ssim": similarity(np.maximum(a - floor, 0.0), np.maximum(b - floor, 0.0), self.within_db) if self.within_db > 0.0 else np.nan,
                "correlation": float(np.corrcoef(x.ravel(), y.ravel())[0, 1]) if min(x.std(), y.std()) > 1e-9 else np.nan,
                "magnitude_error": float(np.linalg.norm(x - y) / np.linalg.norm(y)),
                "relative_error": float(np.linalg.norm(z) / np.linalg.norm(y)) if self.has_phase(name) else np.nan,
                "power_ratio_db": 20.0 * float(np.log10(np.linalg.norm(x) / np.linalg.norm(y))),
                "largest_column": int(self.across[place % self.across.size]), "largest_row": int(self.up[place // self.across.size])}

    @property
    def relative_error(self) -> float:
        """Over all channels; infinite where one of the images lacks channels or phase."""
        if self.images[0].S.keys() != self.images[1].S.keys() or not all(map(self.has_phase, self.compared)):
            return np.inf
        a, b = (np.stack([pair[i] for pair in self.pairs.values()]) for i in (0, 1))
        largest = np.abs(b).max()
        return float(np.linalg.norm((a - b) / largest) / np.linalg.norm(b / largest))

    def above_tolerance(self, tolerance_db: float) -> str:
        """Channels whose rms error exceeds the tolerance; a channel that the reference lacks exceeds any."""
        rms = {name: np.inf if name in self.unexpected else self.channels[name]["rms_db"] for name in self.compared
               if name in self.unexpected or name in self.channels}
        return ", ".join(f"{name} {error:.4g} dB" for name, error in rms.items() if error > tolerance_db)

    @property
    def text(self) -> str:
        """What ``raytube compare`` prints."""
        lines = [f"{what:<12}{image.file}, {image.across[2]} x {image.up[2]} pixels" for what, image in zip(("result", "reference"), self.images)]
        lines.append(f"{'compared':<12}{self.across.size} x {self.up.size} pixels of the reference")
        lies = f"the result lies {self.shift[0]:+.3f} pixels along columns, {self.shift[1]:+.3f} along rows; taken back"
        lines.append(f"{'registered':<12}{lies if self.registered else 'no (--no-register)'}")
        lines += [*([self.scale_text] if self.factor is not None else []), "", f"  {'':<48}" + "".join(f"{name:>12}" for name in self.channels)]
        for measure, title in _LINES.items():
            values = [measures[measure] for measures in self.channels.values()] if not measure.startswith("#") else []
            cells = [f"{cell_text(value, 'd' if isinstance(value, int) else '.4g'):>12}" for value in values]
            title = title.format(within=self.within_db, pixels=self.rows)
            lines.append(f"  {title:<48}{''.join(cells)}" if cells else title)
        for name in CHANNELS:
            inside = [name in image.S for image in self.images]
            if any(inside) and not all(inside):
                lines.append(f"{name}: in the {'result' if inside[0] else 'reference'} alone")
            elif all(inside) and name not in self.channels:
                peaks = self.peaks[name]
                lines.append(f"{name}: no signal in the reference (peak {peaks[1]:.4g} dBsm); the result's peak is {peaks[0]:.4g} dBsm"
                             + (", above any tolerance" if name in self.unexpected else ""))
        return "\n".join(lines) + "\n"

    @property
    def comments(self) -> list[str]:
        return [f"result: {self.images[0].file}; reference: {self.images[1].file}", *([self.scale_text] if self.factor is not None else []),
                f"Columns pixels_within to ssim: result minus reference where the reference is within {self.within_db:g} dB of its peak."]

    @property
    def csv_rows(self) -> Iterator[list[Any]]:
        """Of compare.csv; a channel whose reference has no signal has nan."""
        for name in self.compared:
            known = {"channel": name, "shift_columns": f"{self.shift[0]:.3f}", "shift_rows": f"{self.shift[1]:.3f}", "pixels": self.rows,
                     "pixels_within": 0, "result_peak_dbsm": self.peaks[name][0], "reference_peak_dbsm": self.peaks[name][1],
                     **self.channels.get(name, {})}
            yield [known.get(column, np.nan) for column in CSV_COLUMNS]

    @property
    def scale_text(self) -> str:
        factor = self.factor or 1.0
        phase = f", {np.degrees(np.angle(factor)):+.4g} degrees" if all(map(self.has_phase, self.compared)) else ""
        return f"{'scaled':<12}the result by {20.0 * np.log10(abs(factor)):+.4g} dB{phase}, fitted (--free-scale)"

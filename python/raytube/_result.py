"""What comes out of a solve."""

from __future__ import annotations

import json
import os
import tempfile
import threading
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from raytube import _arguments, _core
from raytube._arguments import CHANNELS
from raytube._core import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    import pandas
    import xarray as xr
    from matplotlib.axes import Axes

    from raytube._geometry import Outline
    from raytube._products import IsarImage, RangeProfiles

_Choice = str | tuple[str, ...] | list[str]
_S_UNITS = {"units": "m", "long_name": "scattering amplitude S"}


class RaytubeWarning(UserWarning):
    """What a result may not be meant to be: of mesh, case or rows, in a sentence with the remedy."""


class Result:
    """Complex scattering amplitudes of looks and frequencies, with their errors. Made by `solve`, `run` and `load`.

    Arrays are read-only views of the result, labelled by xarray: ``result.S.values`` is the NumPy array itself.
    """

    _stored: _core.Stored
    _outline: Outline | None

    def __init__(self, stored: _core.Stored, outline: Outline | None = None) -> None:
        self.__dict__["_stored"] = stored
        self.__dict__["_outline"] = outline

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a result does not change, so its {name} cannot be set; change a copy: result.to_xarray()")

    @cached_property
    def S(self) -> xr.DataArray:
        """Scattering amplitudes [m], complex, dimensions (look, frequency, receive, transmit).

        ``E_p(scattered) = S_pq E_q(incident) exp(-j k r) / r``; at a finite range apparent ones.
        """
        return self._array(self._stored.S, ("receive", "transmit"), _S_UNITS)

    @cached_property
    def sigma_dbsm(self) -> xr.DataArray:
        """Radar cross-section [dBsm], dimensions (look, frequency, channel); -inf for zero. Channel ``vh`` is receive V, transmit H."""
        return self._channels(self._stored.sigma_dbsm, {"units": "dBsm", "long_name": "radar cross-section"})

    @cached_property
    def error_db(self) -> xr.DataArray:
        """Estimated numerical error [dB], dimensions (look, frequency, channel): ``20 log10(1 + error / max(|S_pq|, S_max / 100))``."""
        return self._channels(self._stored.error_db, {"units": "dB", "long_name": "estimated numerical error"})

    @cached_property
    def model_db(self) -> xr.DataArray:
        """Model uncertainty [dB], dimensions (look, frequency, channel): what asymptotic physics may leave out, as `error_db`."""
        return self._channels(self._stored.model_db, {"units": "dB", "long_name": "model uncertainty"})

    @property
    def mechanisms(self) -> xr.Dataset:
        """S by mechanism [m], complex, one variable each: ``bounce_1``, ``bounce_2``, ..., ``edges_order_1``, ``edges_order_2_on``,
        ``interaction``, ``surface_waves``; they add up to S to rounding.

        Raises
        ------
        InputError
            If the result was made without ``keep_mechanisms=True``.
        """
        mechanisms = self._stored.mechanisms
        if not mechanisms:
            raise InputError("mechanisms: the result does not keep its mechanisms apart; solve with keep_mechanisms=True")
        import xarray as xr

        return xr.Dataset({name: self._array(values, ("receive", "transmit"), _S_UNITS) for name, values in mechanisms.items()})

    @property
    def incoherent_m2(self) -> xr.DataArray | None:
        """Radar cross-section that rough surfaces scatter incoherently [m^2], by transmit polarisation, both receive polarisations
        together; to be added as power. None where no surface is rough."""
        values = self._stored.incoherent_m2
        return None if values is None else self._array(values, ("transmit",), {"units": "m2"})

    @property
    def title(self) -> str:
        """Title of the case."""
        return self.attributes.get("title", "")

    @property
    def attributes(self) -> dict[str, str]:
        """Texts that the result carries: title, version, resolved case, hashes."""
        return self._stored.attributes

    @property
    def case(self) -> dict[str, Any]:
        """The case as it was understood, every default filled in; empty where it is not known."""
        case: dict[str, Any] = self._json("case", {})
        return case

    @property
    def counts(self) -> dict[str, Any]:
        """What was counted in the solve: rays, tubes, hits, lost rays and more, as in ``run.json``; empty where they are not known."""
        counts: dict[str, Any] = self._json("counts", {})
        return counts

    @property
    def skipped(self) -> list[dict[str, Any]]:
        """What was left out, how often, and why."""
        skipped: list[dict[str, Any]] = self.counts.get("skipped", [])
        return skipped

    @property
    def warnings(self) -> list[str]:
        """Sentences about what may not be meant."""
        sentences: list[str] = self._json("warnings", [])
        return sentences

    @property
    def model_parts(self) -> list[dict[str, Any]]:
        """What the model uncertainty is made of, the largest share first, with remedies."""
        parts: list[dict[str, Any]] = self._json("model_uncertainty", [])
        return parts

    def to_xarray(self) -> xr.Dataset:
        """The result as a dataset.

        Returns
        -------
        xarray.Dataset
            ``S`` (look, frequency, receive, transmit), ``sigma_dbsm``, ``error_db``, ``model_db`` (look, frequency, channel), with
            ``frequency`` [Hz] and the angles of each look as coordinates.
        """
        import xarray as xr

        variables = {"S": self.S, "sigma_dbsm": self.sigma_dbsm, "error_db": self.error_db, "model_db": self.model_db}
        return xr.Dataset(variables, attrs=self.attributes)

    def to_dataframe(self) -> pandas.DataFrame:
        """The result as a table: one row for each look and frequency, frequency fastest.

        Returns
        -------
        pandas.DataFrame
            Columns ``freq_hz``, ``theta_deg``, ``phi_deg``, ``rx_theta_deg``, ``rx_phi_deg`` and, for each channel, ``S_vv`` [m], complex,
            ``sigma_vv_dbsm``, ``err_vv_db``, ``model_vv_db``.
        """
        import pandas

        looks, frequencies = self.S.shape[:2]
        columns: dict[str, NDArray[Any]] = {"freq_hz": np.tile(self._stored.frequency_hz, looks)}
        for name in ("theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"):
            columns[name] = np.repeat(getattr(self._stored, name), frequencies)
        for i, channel in enumerate(CHANNELS):
            columns[f"S_{channel}"] = self._stored.S.reshape(-1, 4)[:, i]
        for name, values in (("sigma_{}_dbsm", self._stored.sigma_dbsm), ("err_{}_db", self._stored.error_db),
                             ("model_{}_db", self._stored.model_db)):
            for i, channel in enumerate(CHANNELS):
                columns[name.format(channel)] = values.reshape(-1, 4)[:, i]
        return pandas.DataFrame(columns)

    def plot(self, channels: _Choice = ("vv", "hh"), ax: Axes | None = None) -> Axes:
        """Draws sigma against what is swept: a curve a channel, or a map of the first one over looks and frequencies, or over two angles.

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

        return _plots.plot(self, _arguments.channels(channels, "plot"), ax)

    def plot_polar(self, channels: _Choice = ("vv", "hh"), ax: Axes | None = None) -> Axes:
        """Draws sigma against azimuth all round, in a polar diagram.

        Parameters
        ----------
        channels : str or tuple of str
            Among "vv", "vh", "hv", "hh".
        ax : matplotlib polar Axes, optional
            Default: a new figure.

        Returns
        -------
        matplotlib Axes

        Raises
        ------
        InputError
            If the looks differ in anything but one azimuth.
        """
        from raytube import _plots

        return _plots.plot_polar(self, _arguments.channels(channels, "plot_polar"), ax)

    def range_profile(self, look: int = 0, *, window: str = "taylor", sidelobe_db: float = 35.0, padding: int = 4) -> RangeProfiles:
        """The range profile of one look: where along the line of sight its return comes from.

        ``p(R) = sum of w S exp(2 j k R) / sum of w`` over the frequencies; a point of sigma reads sigma at its peak.

        Parameters
        ----------
        look : int
            Direction pair, counted from 0.
        window : {"taylor", "rectangular", "hann", "hamming", "kaiser"}
            Weights w of the frequencies.
        sidelobe_db : float
            Of "taylor" and "kaiser": side lobes so far below the peak, 15 to 100 dB.
        padding : int
            Ranges to a resolution cell c/2B, at least; 1 to 64.

        Returns
        -------
        xarray.Dataset
            A `RangeProfiles` of the dimensions (range_m, channel), with a method ``plot``.

        Raises
        ------
        InputError
            For one frequency, or frequencies in uneven steps; and where the target is known, for steps too coarse for its depth.

        Notes
        -----
        The same numbers as those of ``raytube profile`` [1]_.

        References
        ----------
        .. [1] D. L. Mensa, High Resolution Radar Cross-Section Imaging, 1991, ch. 2.
        """
        from raytube import _products

        return _products.range_profile(self, look, window, sidelobe_db, padding)

    def waterfall(self, *, window: str = "taylor", sidelobe_db: float = 35.0, padding: int = 4) -> RangeProfiles:
        """The range profiles of all looks.

        Parameters
        ----------
        window, sidelobe_db, padding
            As in `range_profile`.

        Returns
        -------
        xarray.Dataset
            A `RangeProfiles` with the dimension ``look`` first, and ``theta_deg`` and ``phi_deg`` as its coordinates.

        Raises
        ------
        InputError
            As `range_profile` does.
        """
        from raytube import _products

        return _products.waterfall(self, window, sidelobe_db, padding)

    def isar(self, size: Any = None, pixels: float = 4.0, *, window: str = "taylor", sidelobe_db: float = 35.0) -> IsarImage:
        """The image of a sweep over frequency and one angle, in a plane: where on the target its return comes from.

        ``I(x) = sum of w S exp(-j K . x) / sum of w``, ``K = 2 k s``, over frequencies and looks; a point of sigma that all looks see alike
        reads sigma. Exact to 1e-7 of the sum of abs(S) however wide the angle is, by gridding [2]_; at a finite range with the paths of
        every cell.

        Parameters
        ----------
        size : float or sequence of float, optional
            Along range and cross-range about the origin of the mesh's coordinates [m]. Default: as wide as the target, for what `solve`
            and `run` made; else all that is unambiguous.
        pixels : float
            Cells of the image to a resolution cell; 1 to 32.
        window, sidelobe_db
            As in `range_profile`, over frequencies and angles.

        Returns
        -------
        xarray.Dataset
            An `IsarImage` of the dimensions (range_m, cross_range_m, channel), with a method ``plot``.

        Raises
        ------
        InputError
            For bistatic looks, one frequency or look, uneven steps, looks over two angles; and where the target is known, for steps too
            coarse for its width.

        Notes
        -----
        The same numbers as those of ``raytube isar`` [1]_.

        References
        ----------
        .. [1] D. L. Mensa, High Resolution Radar Cross-Section Imaging, 1991, ch. 4.
        .. [2] A. H. Barnett, J. Magland and L. af Klinteberg, SIAM J. Sci. Comput. 41 (2019), C479.
        """
        from raytube import _products

        return _products.isar(self, size, pixels, window, sidelobe_db, 2)

    def isar_3d(self, size: Any = None, pixels: float = 4.0, *, window: str = "taylor", sidelobe_db: float = 35.0) -> IsarImage:
        """The image of a sweep over frequency, azimuth and polar angle, in space.

        Parameters
        ----------
        size : float or sequence of float, optional
            Along range, cross-range and height [m], as in `isar`.
        pixels, window, sidelobe_db
            As in `isar`.

        Returns
        -------
        xarray.Dataset
            An `IsarImage` with the dimension ``height_m`` behind ``cross_range_m``.

        Raises
        ------
        InputError
            As `isar` does, and for looks over one angle alone.
        """
        from raytube import _products

        return _products.isar(self, size, pixels, window, sidelobe_db, 3)

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the result to a file, which appears when it is complete.

        Parameters
        ----------
        file : path
            ``.nc``: everything, as netCDF-4, which `load`, xarray, MATLAB, Octave and ParaView read. ``.csv``: the table ``rcs.csv``.

        Raises
        ------
        InputError
            For another suffix, and for a place where no file can be.
        """
        file = _arguments.path(file, "save")
        kind = os.path.splitext(file)[1].lower()
        if kind not in (".nc", ".csv"):
            raise InputError(f"{file}: results are saved as .nc or .csv; give one of these suffixes")
        if os.path.isdir(file) or not os.access(os.path.dirname(os.path.abspath(file)), os.W_OK):
            raise InputError(f"{file}: no file can be written there; name one in a folder that exists and that you may write to")
        beside = f"{file}.{os.getpid()}.{threading.get_ident()}.part{kind}"
        try:
            (self._stored.write_netcdf if kind == ".nc" else self._stored.write_csv)(beside)
            os.replace(beside, file)
        finally:
            if os.path.exists(beside):
                os.remove(beside)

    def to_radar_explorer(self, folder: str | os.PathLike[str], name: str | None = None, channels: _Choice | None = None,
                          geometry: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] = ()) -> list[Path]:
        """Writes what the Radar Explorer Toolkit of Ansys opens: for each channel ``HH_name.json`` and ``HH_data_name.h5``.

        Parameters
        ----------
        folder : path
            Is made if it is not there.
        name : str, optional
            Of the solution; default the title.
        channels : str or tuple of str, optional
            Among "vv", "vh", "hv", "hh"; default all that the result has numbers of.
        geometry : path or sequence of paths, optional
            OBJ files in metres to be shown with the result, named in the metadata; they are not copied.

        Returns
        -------
        list of pathlib.Path
            The metadata files.

        Raises
        ------
        InputError
            For a bistatic result.
        """
        from raytube._radar_explorer import write_radar_explorer

        return write_radar_explorer(self, folder, name, self._known(channels), geometry)

    def __deepcopy__(self, memo: dict[int, Any]) -> Result:
        return self  # nothing of it changes

    def __reduce__(self) -> tuple[Any, ...]:
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "result.nc")
            self._stored.write_netcdf(file)
            with open(file, "rb") as stream:
                return _unpickled, (stream.read(), self._outline)

    def _known(self, channels: _Choice | None) -> tuple[str, ...]:
        if channels is not None:
            return _arguments.channels(channels, "to_radar_explorer")
        return tuple(channel for i, channel in enumerate(CHANNELS) if not np.all(np.isnan(self._stored.S.reshape(-1, 4)[:, i])))

    def __repr__(self) -> str:
        looks, frequencies = self.S.shape[:2]
        kind = "bistatic" if self._stored.bistatic else "monostatic"
        ghz = self._stored.frequency_hz / 1e9
        span = f"{ghz[0]:g} GHz" if frequencies == 1 else f"{frequencies} frequencies from {ghz[0]:g} to {ghz[-1]:g} GHz"
        lines = [f"Result: {self.title}" if self.title else "Result", f"  {looks} {kind} look{'s' if looks > 1 else ''}, {span}", f"  peak {self._peak_text()}"]
        for name, values in (("numerical error", self._stored.error_db), ("model uncertainty", self._stored.model_db)):
            near = values[self._near_peak()]
            if near.size and not np.all(np.isnan(near)):
                lines.append(f"  {name} within 20 dB of the peak: median {np.nanmedian(near):.2g} dB, at most {np.nanmax(near):.2g} dB")
        lines += [f"  warning: {sentence}" for sentence in self.warnings]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        import html

        return f"<pre style=\"white-space: pre-wrap\">{html.escape(repr(self))}</pre>{self.to_xarray()._repr_html_()}"

    def _near_peak(self) -> NDArray[np.bool_]:
        sigma = self._stored.sigma_dbsm
        peak = np.max(sigma[np.isfinite(sigma)], initial=-np.inf)
        near: NDArray[np.bool_] = (sigma >= peak - 20.0) & np.isfinite(sigma)
        return near

    def _peak_text(self) -> str:
        sigma = self.sigma_dbsm.values
        if not np.any(np.isfinite(sigma)):
            return "none: no return"
        look, frequency, channel = np.unravel_index(np.nanargmax(sigma), sigma.shape)
        place = f"theta {self._stored.theta_deg[look]:g} deg, phi {self._stored.phi_deg[look]:g} deg"
        return f"{sigma[look, frequency, channel]:.2f} dBsm in {CHANNELS[channel]} at {self._stored.frequency_hz[frequency] / 1e9:g} GHz, {place}"

    def _json(self, name: str, otherwise: Any) -> Any:
        text = self.attributes.get(name)
        return json.loads(text) if text else otherwise

    @cached_property
    def _coordinates(self) -> dict[str, Any]:
        stored = self._stored
        coordinates: dict[str, Any] = {"frequency": ("frequency", stored.frequency_hz, {"units": "Hz", "long_name": "frequency"})}
        names = {"theta_deg": "polar angle to the transmitter", "phi_deg": "azimuth to the transmitter"}
        if stored.bistatic:
            names |= {"rx_theta_deg": "polar angle to the receiver", "rx_phi_deg": "azimuth to the receiver"}
        for name, what in names.items():
            coordinates[name] = ("look", getattr(stored, name), {"units": "degree", "long_name": what})
        if np.all(np.isfinite(stored.range_m)):
            for name, what in (("range_m", "distance of the transmitter"), ("rx_range_m", "distance of the receiver")):
                coordinates[name] = ("look", getattr(stored, name), {"units": "m", "long_name": what})
        return coordinates

    def _array(self, values: NDArray[Any], more: tuple[str, ...], attributes: dict[str, str]) -> xr.DataArray:
        import xarray as xr

        polarisations = {name: (name, ["v", "h"]) for name in more}
        return xr.DataArray(values, dims=("look", "frequency", *more), coords=self._coordinates | polarisations, attrs=attributes)

    def _channels(self, values: NDArray[Any], attributes: dict[str, str]) -> xr.DataArray:
        import xarray as xr

        channels = {"channel": ("channel", list(CHANNELS))}
        return xr.DataArray(values.reshape(*values.shape[:2], 4), dims=("look", "frequency", "channel"),
                            coords=self._coordinates | channels, attrs=attributes)


def _unpickled(content: bytes, outline: Outline | None) -> Result:
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "result.nc")
        with open(file, "wb") as stream:
            stream.write(content)
        return Result(_core.Stored.read_netcdf(file), outline)


def load(file: str | os.PathLike[str]) -> Result:
    """Reads a result that raytube has written.

    Parameters
    ----------
    file : path
        ``.nc``, or ``rcs.csv`` (which knows neither parts nor the case).

    Returns
    -------
    Result

    Raises
    ------
    InputError
        If the file cannot be read or holds something else. Tables of other programs are read by `compare`.
    """
    file = _arguments.path(file, "load")
    kind = os.path.splitext(file)[1].lower()
    if kind not in (".nc", ".csv"):
        raise InputError(f"{file}: results are loaded from .nc or .csv; for the .json of the Radar Explorer Toolkit there is read_radar_explorer")
    return Result(_core.Stored.read_netcdf(file) if kind == ".nc" else _core.Stored.read_csv(file))

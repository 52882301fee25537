"""The result of a solve."""

from __future__ import annotations

import json
import os
import tempfile
import threading
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from raytube import _arguments, _core
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._tables import KEYS, keys_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas
    import xarray as xr
    from matplotlib.axes import Axes

    from raytube._products import DopplerMap, IsarImage, Outline, RangeProfiles, RawData, Spectrogram

_Choice = str | tuple[str, ...] | list[str]
_S_UNITS = {"units": "m", "long_name": "scattering amplitude S"}


class RaytubeWarning(UserWarning):
    """Something in the mesh, the case or the result that may be unintended: a sentence with the remedy."""


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
        return self._array(self._stored.S, _S_UNITS)

    @cached_property
    def sigma_dbsm(self) -> xr.DataArray:
        """Radar cross-section [dBsm], dimensions (look, frequency, channel); -inf for zero. Channel ``vh`` is receive V, transmit H."""
        return self._array(self._stored.sigma_dbsm, {"units": "dBsm", "long_name": "radar cross-section"}, "channel")

    @cached_property
    def error_db(self) -> xr.DataArray:
        """Estimated numerical error [dB], dimensions (look, frequency, channel): ``20 log10(1 + error / max(|S_pq|, S_max / 100))``."""
        return self._array(self._stored.error_db, {"units": "dB", "long_name": "estimated numerical error"}, "channel")

    @cached_property
    def model_db(self) -> xr.DataArray:
        """Model uncertainty [dB], dimensions (look, frequency, channel): what asymptotic physics may leave out, in the form of `error_db`."""
        return self._array(self._stored.model_db, {"units": "dB", "long_name": "model uncertainty"}, "channel")

    @property
    def mechanisms(self) -> xr.Dataset:
        """S by mechanism [m], complex, one variable each: ``bounce_1``, ``bounce_2``, ..., ``surface_waves``, ``rounded_edges``,
        ``flat_tips``, ``round_tips``, ``edges_order_1``, ``edges_order_2_on``, ``material_edges_order_1``,
        ``material_edges_order_2_on``, ``plate_corners``, ``thin_ends``, ``solid_corners``, ``interaction``; they add up to S to rounding.

        Raises
        ------
        InputError
            If the result was made without ``keep_mechanisms=True``.
        """
        mechanisms = self._stored.mechanisms
        if not mechanisms:
            raise InputError("mechanisms: the result does not keep its mechanisms apart; solve with keep_mechanisms=True")
        import xarray as xr

        return xr.Dataset({name: self._array(values, _S_UNITS) for name, values in mechanisms.items()})

    @property
    def incoherent_m2(self) -> xr.DataArray | None:
        """Radar cross-section that rough surfaces scatter incoherently [m^2], by transmit polarisation, both receive polarisations
        together; to be added as power. None if no surface is rough."""
        values = self._stored.incoherent_m2
        return None if values is None else self._array(values, {"units": "m2"}, "transmit")

    @property
    def title(self) -> str:
        """Title of the case."""
        return self.attributes.get("title", "")

    @property
    def attributes(self) -> dict[str, str]:
        """Texts stored with the result: title, version, resolved case, hashes."""
        return self._stored.attributes

    @property
    def case(self) -> dict[str, Any]:
        """The resolved case, with every default filled in; empty if it is not known."""
        return dict(self._json("case") or {})

    @property
    def counts(self) -> dict[str, Any]:
        """Counts from the solve: rays, tubes, hits, lost rays and more, as in ``run.json``; empty if they are not known."""
        return dict(self._json("counts") or {})

    @property
    def skipped(self) -> list[dict[str, Any]]:
        """What was left out, how often, and why."""
        return list(self.counts.get("skipped", []))

    @property
    def warnings(self) -> list[str]:
        """Sentences about what may be unintended, with remedies."""
        return list(self._json("warnings") or [])

    @property
    def model_parts(self) -> list[dict[str, Any]]:
        """Contributions to the model uncertainty, the largest share first, with remedies."""
        return list(self._json("model_uncertainty") or [])

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
            Columns ``freq_hz``, ``theta_deg``, ``phi_deg``, ``rx_theta_deg``, ``rx_phi_deg``, of a scene that moves ``time_s``, and, for each channel,
            ``S_vv`` [m], complex, ``sigma_vv_dbsm``, ``err_vv_db``, ``model_vv_db``.
        """
        import pandas

        stored = self._stored
        columns: dict[str, NDArray[Any]] = dict(zip(KEYS if stored.moving else KEYS[:-1], keys_of(stored).T))
        for name, values in (("S_{}", stored.S), ("sigma_{}_dbsm", stored.sigma_dbsm), ("err_{}_db", stored.error_db),
                             ("model_{}_db", stored.model_db)):
            columns |= zip(map(name.format, CHANNELS), values.reshape(-1, 4).T)
        return pandas.DataFrame(columns)

    def plot(self, channels: _Choice = ("vv", "hh"), ax: Axes | None = None) -> Axes:
        """Draws sigma over the swept quantity: one curve per channel, or a map of the first one over looks and frequencies or over two angles.

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
            For "taylor" and "kaiser": level of the side lobes below the peak, 15 to 100 dB.
        padding : int
            Least number of ranges per resolution cell c/2B; 1 to 64.

        Returns
        -------
        xarray.Dataset
            A `RangeProfiles` of the dimensions (range_m, channel), with a method ``plot``.

        Raises
        ------
        InputError
            For a single frequency or frequencies in uneven steps; if the target is known, also for steps too coarse for its depth.

        Notes
        -----
        The numbers are those of ``raytube profile`` [1]_.

        References
        ----------
        .. [1] D. L. Mensa, High Resolution Radar Cross-Section Imaging, 1991, ch. 2.
        """
        from raytube import _products

        return _products.range_profiles(self, _arguments.whole(look, "look"), window, sidelobe_db, padding)

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

        return _products.range_profiles(self, None, window, sidelobe_db, padding)

    def isar(self, size: Any = None, pixels: float = 4.0, *, window: str = "taylor", sidelobe_db: float = 35.0) -> IsarImage:
        """The image of a sweep over frequency and one angle, in a plane: where on the target the return comes from.

        ``I(x) = sum of w S exp(-j K . x) / sum of w``, ``K = 2 k s``, over frequencies and looks; a point of sigma that all looks see alike
        reads sigma. Exact to 1e-7 of the sum of abs(S) for any width of the angle, by gridding [2]_; at a finite range, with the paths of
        each cell.

        Parameters
        ----------
        size : float or sequence of float, optional
            Extent along range and cross-range about the origin of the mesh's coordinates [m]. Default: that of the target, for results of
            `solve` and `run`; else all that is unambiguous.
        pixels : float
            Cells of the image per resolution cell; 1 to 32.
        window, sidelobe_db
            As in `range_profile`, over frequencies and angles.

        Returns
        -------
        xarray.Dataset
            An `IsarImage` of the dimensions (range_m, cross_range_m, channel), with a method ``plot``.

        Raises
        ------
        InputError
            For bistatic looks, a single frequency or look, uneven steps, looks over two angles; if the target is known, also for steps too
            coarse for its width.

        Notes
        -----
        The numbers are those of ``raytube isar`` [1]_.

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
            Extent along range, cross-range and height [m], as in `isar`.
        pixels, window, sidelobe_db
            As in `isar`.

        Returns
        -------
        xarray.Dataset
            An `IsarImage` with the dimension ``height_m`` after ``cross_range_m``.

        Raises
        ------
        InputError
            As `isar` does, and for looks over only one angle.
        """
        from raytube import _products

        return _products.isar(self, size, pixels, window, sidelobe_db, 3)

    def doppler(self, look: int = 0, *, angle: bool = False, mechanism: str | None = None, middle_range_m: float = 0.0,
                middle_velocity_m_per_s: float = 0.0, window: str = "taylor", sidelobe_db: float = 35.0, padding: int = 2) -> DopplerMap:
        """The range-Doppler map of a scene that moves: where its return comes from, and how fast that comes nearer.

        ``M(R, v) = sum of w S exp(2 j k (R - v t)) / sum of w`` over pulses and frequencies, t from the middle of the pulses; a point of sigma
        reads sigma at its peak. What approaches has a positive velocity and a positive Doppler frequency, 2 v / lambda. What crosses ranges
        meanwhile stays at its place: the keystone transform [1]_, exact at every frequency.

        Parameters
        ----------
        look : int
            Of the looks of a pulse, counted from 0.
        angle : bool
            Also over the angle: the looks of a pulse are antennas in even steps on a straight line, at places (``radar.position_m``).
        mechanism : str, optional
            S of this one of `mechanisms` alone.
        middle_range_m, middle_velocity_m_per_s : float
            Middle of what is shown [m], [m/s]; as much is shown as is unambiguous.
        window, sidelobe_db
            As in `range_profile`, over frequencies, pulses and antennas.
        padding : int
            Number of ranges and velocities per resolution cell; 1 to 64.

        Returns
        -------
        xarray.Dataset
            A `DopplerMap` of the dimensions (range_m, velocity_m_per_s, channel), with ``angle`` cosine before channel, of one frequency without
            range_m; with a method ``plot``.

        Raises
        ------
        InputError
            If nothing moves, for a single pulse, pulses in uneven steps, and with ``angle`` for looks that are no array.

        Notes
        -----
        The numbers are those of ``raytube doppler``.

        References
        ----------
        .. [1] R. P. Perry, R. C. DiPietro and R. L. Fante, IEEE Trans. Aerosp. Electron. Syst. 35 (1999), 188.
        """
        from raytube import _products

        return _products.doppler(self, look, angle, (middle_range_m, middle_velocity_m_per_s), mechanism, window, sidelobe_db, padding)

    def spectrogram(self, look: int = 0, *, length: int | None = None, overlap: float = 0.75, gate_m: float | None = None,
                    mechanism: str | None = None, middle_range_m: float = 0.0, middle_velocity_m_per_s: float = 0.0, window: str = "taylor",
                    sidelobe_db: float = 35.0, padding: int = 2) -> Spectrogram:
        """Velocities over time, of windows of pulses one after the other: micro-Doppler.

        Parameters
        ----------
        look : int
            Of the looks of a pulse, counted from 0.
        length : int, optional
            Pulses of a window. Default: the root of their number, for as many cells of time as of velocity.
        overlap : float
            Share of a window that the next one has in common with it, 0 to 0.999.
        gate_m : float, optional
            Width of the ranges that count, about the middle one [m]; 0 for that one alone. Default: all. Their powers are added; a point in
            the middle of the gate reads its sigma.
        mechanism, middle_range_m, middle_velocity_m_per_s, window, sidelobe_db, padding
            As in `doppler`.

        Returns
        -------
        xarray.Dataset
            A `Spectrogram` of the dimensions (time_s, velocity_m_per_s, channel), with a method ``plot``.

        Raises
        ------
        InputError
            As `doppler` does, and for a window of more pulses than there are.

        Notes
        -----
        The numbers are those of ``raytube doppler --spectrogram``.
        """
        from raytube import _products

        return _products.spectrogram(self, look, length, overlap, gate_m, (middle_range_m, middle_velocity_m_per_s), mechanism, window,
                                     sidelobe_db, padding)

    def raw(self) -> RawData:
        """The cube of data of a scene that moves, for processing of your own.

        Returns
        -------
        xarray.Dataset
            A `RawData`: S of the dimensions (pulse, frequency, receiver, receive, transmit) with the times of pulses and the places of antennas.

        Raises
        ------
        InputError
            If nothing moves, and for a single pulse.
        """
        from raytube import _products

        return _products.raw(self)

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the result to a file, which appears once it is complete.

        Parameters
        ----------
        file : path
            ``.nc``: everything, as netCDF-4, which `load`, xarray, MATLAB, Octave and ParaView read. ``.csv``: the table ``rcs.csv``.

        Raises
        ------
        InputError
            For another suffix, or a place where no file can be written.
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
            Created if it does not exist.
        name : str, optional
            Name of the solution; default the title.
        channels : str or tuple of str, optional
            Among "vv", "vh", "hv", "hh"; default all channels with values.
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

        known = tuple(channel for channel, s in zip(CHANNELS, self._stored.S.reshape(-1, 4).T) if not np.all(np.isnan(s)))
        chosen = known if channels is None else _arguments.channels(channels, "to_radar_explorer")
        return write_radar_explorer(self, folder, name, chosen, geometry)

    def __deepcopy__(self, memo: dict[int, Any]) -> Result:
        return self  # it never changes

    def __reduce__(self) -> tuple[Any, ...]:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "result.nc")
            self._stored.write_netcdf(str(file))
            return _unpickled, (file.read_bytes(), self._outline)

    def __repr__(self) -> str:
        looks, frequencies = self.S.shape[:2]
        kind = "bistatic" if self._stored.bistatic else "monostatic"
        ghz = self._stored.frequency_hz / 1e9
        span = f"{ghz[0]:g} GHz" if frequencies == 1 else f"{frequencies} frequencies from {ghz[0]:g} to {ghz[-1]:g} GHz"
        lines = [f"Result: {self.title}" if self.title else "Result", f"  {looks} {kind} look{'s' if looks > 1 else ''}, {span}", f"  peak {self._peak_text()}"]
        sigma = self._stored.sigma_dbsm
        near_peak = np.isfinite(sigma) & (sigma >= np.max(sigma, initial=-np.inf, where=np.isfinite(sigma)) - 20.0)
        for name, values in (("numerical error", self._stored.error_db), ("model uncertainty", self._stored.model_db)):
            near = values[near_peak]
            if near.size and not np.all(np.isnan(near)):
                lines.append(f"  {name} within 20 dB of the peak: median {np.nanmedian(near):.2g} dB, at most {np.nanmax(near):.2g} dB")
        lines += [f"  warning: {sentence}" for sentence in self.warnings]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        import html

        return f"<pre style=\"white-space: pre-wrap\">{html.escape(repr(self))}</pre>{self.to_xarray()._repr_html_()}"

    def _peak_text(self) -> str:
        sigma = self.sigma_dbsm.values
        if not np.any(np.isfinite(sigma)):
            return "none: no return"
        look, frequency, channel = np.unravel_index(np.nanargmax(sigma), sigma.shape)
        place = f"theta {self._stored.theta_deg[look]:g} deg, phi {self._stored.phi_deg[look]:g} deg"
        if self._stored.moving:
            place += f", t {self._stored.time_s[look]:g} s"
        return f"{sigma[look, frequency, channel]:.2f} dBsm in {CHANNELS[channel]} at {self._stored.frequency_hz[frequency] / 1e9:g} GHz, {place}"

    def _json(self, name: str) -> Any:
        return json.loads(self.attributes.get(name) or "null")

    @cached_property
    def _coordinates(self) -> dict[str, Any]:
        stored = self._stored
        of_looks = {"theta_deg": ("degree", "polar angle to the transmitter"), "phi_deg": ("degree", "azimuth to the transmitter")}
        if stored.bistatic:
            of_looks |= {"rx_theta_deg": ("degree", "polar angle to the receiver"), "rx_phi_deg": ("degree", "azimuth to the receiver")}
        if np.all(np.isfinite(stored.range_m)):
            of_looks |= {"range_m": ("m", "distance of the transmitter"), "rx_range_m": ("m", "distance of the receiver")}
        if stored.moving:
            of_looks |= {"time_s": ("s", "time of the look")}
        return {"frequency": ("frequency", stored.frequency_hz, {"units": "Hz", "long_name": "frequency"}),
                **{name: ("look", getattr(stored, name), {"units": unit, "long_name": text}) for name, (unit, text) in of_looks.items()}}

    def _array(self, values: NDArray[Any], attributes: dict[str, str], *more: str) -> xr.DataArray:
        import xarray as xr

        more = more or ("receive", "transmit")
        labels = [list(CHANNELS) if name == "channel" else ["v", "h"] for name in more]
        return xr.DataArray(values.reshape(*values.shape[:2], *map(len, labels)), self._coordinates | dict(zip(more, labels)),
                            ("look", "frequency", *more), attrs=attributes)


def _unpickled(content: bytes, outline: Outline | None) -> Result:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "result.nc")
        file.write_bytes(content)
        return Result(_core.Stored.read_netcdf(str(file)), outline)


def load(file: str | os.PathLike[str]) -> Result:
    """Reads a result written by raytube.

    Parameters
    ----------
    file : path
        ``.nc``, or ``rcs.csv`` (which holds neither mechanisms nor the case).

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

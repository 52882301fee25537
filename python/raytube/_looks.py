"""Directions from the target towards the radar."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from raytube import _arguments
from raytube._core import InputError

_MOST = 1_000_000  # values of a range in a case file


class Looks:
    """Pairs of directions, to the transmitter and to the receiver. Made by `monostatic`, `bistatic` and `looks`.

    Their number is ``len``; for a list in a file, number and angles are not known before the solve.
    """

    def __init__(self, sections: dict[str, Any], rows: NDArray[np.float64] | None, bistatic: bool) -> None:
        self._sections = sections  # [look] and [receive] of a case; empty where `rows` stand instead
        self._rows = rows
        self._bistatic = bistatic

    @property
    def bistatic(self) -> bool:
        """True if transmitter and receiver may be apart; False for a list in a file, which is read when it is solved."""
        return self._bistatic

    def __len__(self) -> int:
        return len(self._all())

    def __repr__(self) -> str:
        if self._rows is None and "looks_csv" in self._sections.get("look", {}):
            return f"Looks listed in {self._sections['look']['looks_csv']}"
        return f"{len(self)} {'bistatic' if self.bistatic else 'monostatic'} look{'s' if len(self) != 1 else ''}"

    @property
    def theta_deg(self) -> NDArray[np.float64]:
        """Polar angle to the transmitter of each look [deg]."""
        return self._all()[:, 0]

    @property
    def phi_deg(self) -> NDArray[np.float64]:
        """Azimuth to the transmitter of each look [deg]."""
        return self._all()[:, 1]

    @property
    def rx_theta_deg(self) -> NDArray[np.float64]:
        """Polar angle to the receiver of each look [deg]; for monostatic looks that to the transmitter."""
        return self._all()[:, 2]

    @property
    def rx_phi_deg(self) -> NDArray[np.float64]:
        """Azimuth to the receiver of each look [deg]; for monostatic looks that to the transmitter."""
        return self._all()[:, 3]

    def _all(self) -> NDArray[np.float64]:
        if self._rows is not None:
            return self._rows
        look = self._sections["look"]
        if "looks_csv" in look:
            raise InputError(f"{look['looks_csv']}: a list of looks is read when it is solved; its angles are those of the result")
        transmit = _pairs(look["theta_deg"], look["phi_deg"])
        if not self.bistatic:
            return np.hstack([transmit, transmit])
        receive = _pairs(self._sections["receive"]["theta_deg"], self._sections["receive"]["phi_deg"])
        return np.hstack([np.repeat(transmit, len(receive), axis=0), np.tile(receive, (len(transmit), 1))])


def monostatic(theta_deg: Any, phi_deg: Any) -> Looks:
    """Looks with transmitter and receiver in one place: every theta with every phi, theta slowest.

    Parameters
    ----------
    theta_deg, phi_deg : float, sequence of float or dict
        Polar angle from +z, 0 to 180, and azimuth from +x towards +y, of the direction towards the radar [deg]. A dict is a range as
        in a case file: ``{"start": 0, "stop": 90, "step": 1}`` (or ``"count"``).

    Returns
    -------
    Looks

    Raises
    ------
    InputError
        For anything but numbers or a range.
    """
    return Looks({"look": _angles("monostatic", theta_deg, phi_deg)}, None, False)


def bistatic(theta_deg: Any, phi_deg: Any, rx_theta_deg: Any, rx_phi_deg: Any) -> Looks:
    """Looks with transmitter and receiver apart: every direction to one with every direction to the other, the receiver's fastest.

    Parameters
    ----------
    theta_deg, phi_deg : float, sequence of float or dict
        Directions from the target to the transmitter [deg], as in `monostatic`.
    rx_theta_deg, rx_phi_deg : float, sequence of float or dict
        Directions from the target to the receiver [deg].

    Returns
    -------
    Looks

    Raises
    ------
    InputError
        For anything but numbers or a range.
    """
    receive = _angles("bistatic", rx_theta_deg, rx_phi_deg, "rx_")
    return Looks({"look": _angles("bistatic", theta_deg, phi_deg), "receive": receive}, None, True)


def looks(source: Any, phi_deg: ArrayLike | None = None, rx_theta_deg: ArrayLike | None = None,
          rx_phi_deg: ArrayLike | None = None) -> Looks:
    """A list of looks: a file, or arrays of equal length.

    Parameters
    ----------
    source : path or array of float, shape (looks,)
        A CSV file with the columns theta_deg, phi_deg[, rx_theta_deg, rx_phi_deg], or the theta of each look [deg].
    phi_deg : array of float, shape (looks,), optional
        Azimuth of each look [deg], unless `source` is a file.
    rx_theta_deg, rx_phi_deg : arrays of float, shape (looks,), optional
        Directions to the receiver [deg]; without them the looks are monostatic.

    Returns
    -------
    Looks

    Raises
    ------
    InputError
        If the arrays differ in length, or one is missing.
    """
    if isinstance(source, (str, os.PathLike)):
        if phi_deg is not None or rx_theta_deg is not None or rx_phi_deg is not None:
            raise InputError("looks: a file holds all angles; give a file or arrays")
        return Looks({"look": {"looks_csv": _arguments.path(source, "looks")}}, None, False)
    if phi_deg is None or (rx_theta_deg is None) != (rx_phi_deg is None):
        raise InputError("looks: give theta_deg and phi_deg, or all four of theta_deg, phi_deg, rx_theta_deg and rx_phi_deg")
    columns = [source, phi_deg] + ([source, phi_deg] if rx_theta_deg is None else [rx_theta_deg, rx_phi_deg])
    arrays = [np.atleast_1d(_arguments.numbers(column, "looks")) for column in columns]
    if any(array.shape != arrays[0].shape or array.ndim != 1 for array in arrays):
        raise InputError("looks: the arrays differ in length; give one number of each for every look")
    return Looks({}, np.column_stack(arrays), rx_theta_deg is not None)


def _angles(name: str, theta: Any, phi: Any, prefix: str = "") -> dict[str, Any]:
    return {"theta_deg": _values(theta, f"{name}: {prefix}theta_deg"), "phi_deg": _values(phi, f"{name}: {prefix}phi_deg")}


def _values(angles: Any, name: str) -> Any:
    if isinstance(angles, Mapping):
        _expanded(dict(angles), name)  # refuses now what no case could make use of
        return dict(angles)
    values = _arguments.numbers(angles, name)
    if values.ndim > 1:
        raise InputError(f"{name}: give a number or a list of numbers (found an array of {values.ndim} dimensions)")
    return float(values) if values.ndim == 0 else values


def _expanded(angles: Any, name: str = "angles") -> NDArray[np.float64]:
    if not isinstance(angles, dict):
        return np.atleast_1d(_arguments.numbers(angles, name))
    if set(angles) not in ({"start", "stop", "step"}, {"start", "stop", "count"}):
        raise InputError(f"{name}: a range has start, stop and step, or start, stop and count (found {', '.join(map(str, angles))})")
    start, stop = _arguments.number(angles["start"], f"{name}: start"), _arguments.number(angles["stop"], f"{name}: stop")
    if "count" in angles:
        return np.linspace(start, stop, _arguments.whole(angles["count"], f"{name}: count", _MOST))
    step = _arguments.number(angles["step"], f"{name}: step")
    if step == 0.0 or not 0.0 <= (stop - start) / step < _MOST:
        raise InputError(f"{name}: steps of {step:g} lead from {start:g} to {stop:g} in no number from 1 to {_MOST}; choose another step")
    return start + step * np.arange(np.floor((stop - start) / step + 1e-9) + 1)


def _pairs(theta: Any, phi: Any) -> NDArray[np.float64]:
    thetas, phis = _expanded(theta), _expanded(phi)
    return np.column_stack([np.repeat(thetas, len(phis)), np.tile(phis, len(thetas))])

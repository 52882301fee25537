"""Directions from the target towards the radar."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from raytube._core import InputError


class Looks:
    """Pairs of directions, to the transmitter and to the receiver. Made by `monostatic`, `bistatic` and `looks`.

    Angles are arrays of float, shape (looks,); those of a file are not known before the solve.

    Attributes
    ----------
    bistatic : bool
        Whether transmitter and receiver are apart.
    """

    def __init__(self, sections: dict[str, Any], rows: np.ndarray | None, bistatic: bool):
        self._sections = sections  # [look] and [receive] of a case; empty where `rows` stand instead
        self._rows = rows
        self.bistatic = bistatic

    def __len__(self) -> int:
        return len(self._all())

    def __repr__(self) -> str:
        if self._rows is None and "looks_csv" in self._sections.get("look", {}):
            return f"Looks listed in {self._sections['look']['looks_csv']}"
        return f"{len(self)} {'bistatic' if self.bistatic else 'monostatic'} looks"

    @property
    def theta_deg(self) -> np.ndarray:
        """Polar angle from +z of the direction to the transmitter [deg]."""
        return self._all()[:, 0]

    @property
    def phi_deg(self) -> np.ndarray:
        """Azimuth from +x of the direction to the transmitter [deg]."""
        return self._all()[:, 1]

    @property
    def rx_theta_deg(self) -> np.ndarray:
        """Polar angle of the direction to the receiver [deg]."""
        return self._all()[:, 2]

    @property
    def rx_phi_deg(self) -> np.ndarray:
        """Azimuth of the direction to the receiver [deg]."""
        return self._all()[:, 3]

    def _all(self) -> np.ndarray:
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
    """
    return Looks({"look": {"theta_deg": _values(theta_deg), "phi_deg": _values(phi_deg)}}, None, False)


def bistatic(theta_deg: Any, phi_deg: Any, rx_theta_deg: Any, rx_phi_deg: Any) -> Looks:
    """Looks with transmitter and receiver apart: every direction of one with every direction of the other, the receiver's fastest.

    Parameters
    ----------
    theta_deg, phi_deg : float, sequence of float or dict
        Directions from the target to the transmitter [deg], as in `monostatic`.
    rx_theta_deg, rx_phi_deg : float, sequence of float or dict
        Directions from the target to the receiver [deg].

    Returns
    -------
    Looks
    """
    return Looks({"look": {"theta_deg": _values(theta_deg), "phi_deg": _values(phi_deg)},
                  "receive": {"theta_deg": _values(rx_theta_deg), "phi_deg": _values(rx_phi_deg)}}, None, True)


def looks(source: Any, phi_deg: ArrayLike | None = None, rx_theta_deg: ArrayLike | None = None,
          rx_phi_deg: ArrayLike | None = None) -> Looks:
    """A list of looks: a file, or arrays of equal length.

    Parameters
    ----------
    source : path or array of float, shape (looks,)
        A CSV file with the columns theta_deg, phi_deg[, rx_theta_deg, rx_phi_deg], or the theta of each look [deg].
    phi_deg : array of float, shape (looks,), optional
        Azimuth of each look [deg], where `source` is no file.
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
        return Looks({"look": {"looks_csv": os.fspath(source)}}, None, False)
    if phi_deg is None or (rx_theta_deg is None) != (rx_phi_deg is None):
        raise InputError("looks: give theta_deg and phi_deg, or all four of theta_deg, phi_deg, rx_theta_deg and rx_phi_deg")
    columns = [source, phi_deg] + ([source, phi_deg] if rx_theta_deg is None else [rx_theta_deg, rx_phi_deg])
    arrays = [np.atleast_1d(np.asarray(column, dtype=float)) for column in columns]
    if any(array.shape != arrays[0].shape or array.ndim != 1 for array in arrays):
        raise InputError("looks: the arrays differ in length; give one number of each for every look")
    return Looks({}, np.column_stack(arrays), rx_theta_deg is not None)


def _values(angles: Any) -> Any:
    return angles if isinstance(angles, dict) else np.atleast_1d(np.asarray(angles, dtype=float)) if not np.isscalar(angles) else angles


def _expanded(angles: Any) -> np.ndarray:
    if not isinstance(angles, dict):
        return np.atleast_1d(np.asarray(angles, dtype=float))
    if "count" in angles:
        return np.linspace(angles["start"], angles["stop"], int(angles["count"]))
    steps = np.floor((angles["stop"] - angles["start"]) / angles["step"] + 1e-9)
    return angles["start"] + angles["step"] * np.arange(steps + 1)


def _pairs(theta: Any, phi: Any) -> np.ndarray:
    thetas, phis = _expanded(theta), _expanded(phi)
    return np.column_stack([np.repeat(thetas, len(phis)), np.tile(phis, len(thetas))])

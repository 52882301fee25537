"""Bodies that move, as the section ``[motion]`` of a case."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from raytube import _arguments
from raytube._core import InputError


class Motion(dict[str, Any]):
    """Times at which a scene is looked at, and the bodies that move meanwhile: a section of a case, as `solve` takes it.

    Give times, or pulses by their interval and number. Bodies are added by `body`; without any, everything stands.

    Parameters
    ----------
    times : sequence of float, optional
        Ascending times [s].
    interval, count : float, int, optional
        Instead of them: so many pulses, this far apart [s].
    start : float
        Time of the first pulse [s].
    retrace : str
        "every": every time is traced. "auto": so many as the motion asks for, S between them from the phases of the bodies.
    reference : float
        Time at which steadily moving bodies are where the mesh has them [s].

    Raises
    ------
    InputError
        Unless either `times` or both `interval` and `count` are given.

    Examples
    --------
    >>> import raytube as rt
    >>> plate = rt.Target([[0, 0, 0], [0, .3, 0], [0, .3, .3], [0, 0, .3]], [[0, 1, 2, 3]], unit="m")
    >>> motion = rt.Motion(interval=1e-3, count=4).body("plate", velocity=(2.0, 0.0, 0.0))
    >>> result = rt.solve(plate, 10.0, rt.monostatic(90, 0), motion=motion)
    >>> result.S.shape                   # a look for each pulse
    (4, 1, 2, 2)
    """

    def __init__(self, times: Any = None, *, interval: float | None = None, count: int | None = None, start: float = 0.0,
                 retrace: str = "every", reference: float = 0.0) -> None:
        super().__init__()
        if (times is None) == (interval is None or count is None):
            raise InputError("Motion: give times, or interval and count")
        if times is not None:
            self["times_s"] = _arguments.numbers(times, "times").ravel().tolist()
        else:
            self["pulses"] = {"start_s": _arguments.number(start, "start"), "interval_s": _arguments.number(interval, "interval"),
                              "count": _arguments.whole(count, "count")}
        self["retrace"] = _arguments.text(retrace, "retrace")
        self["reference_s"] = _arguments.number(reference, "reference")
        self["bodies"] = {}

    def body(self, name: str, parts: str | Sequence[str] | None = None, *, on: str | None = None, velocity: Any = None, axis: Any = None,
             through: Any = None, rev_per_min: float | None = None, deg_per_s: float | None = None, angle_deg: float | None = None,
             poses: Any = None) -> Motion:
        """Adds a rigid body.

        Parameters
        ----------
        name : str
            By which other bodies and sentences call it.
        parts : str or sequence of str, optional
            Names in the mesh (`Target.parts`); by default what no other body has.
        on : str, optional
            The body that carries it.
        velocity : sequence of float, optional
            Steady velocity [m/s], in the axes of what carries it.
        axis, through : sequence of float, optional
            Axis of rotation, right-handed, and a point on it [m], as the mesh has them.
        rev_per_min, deg_per_s : float, optional
            How fast it turns; one of the two.
        angle_deg : float, optional
            How far it has turned at the reference time [deg].
        poses : array_like, optional
            Rows ``[time_s, x_m, y_m, z_m, qw, qx, qy, qz]``, or the first four of these: where the mesh's origin goes, and the unit
            quaternion that turns the mesh.

        Returns
        -------
        Motion
            This one.

        Raises
        ------
        InputError
            For a name that is there already.
        """
        if name in self["bodies"]:
            raise InputError(f"Motion.body: there is a body {name!r} already; give each a name of its own")
        keys = {"parts": parts, "on": on, "velocity_m_per_s": _listed(velocity, "velocity"), "axis": _listed(axis, "axis"),
                "through_m": _listed(through, "through"), "rev_per_min": rev_per_min, "deg_per_s": deg_per_s, "angle_deg": angle_deg,
                "poses": _listed(poses, "poses")}
        self["bodies"][name] = {key: value for key, value in keys.items() if value is not None}
        return self

    def radar(self, velocity: Any, aim_moves: bool = False) -> Motion:
        """Lets the antennas move, whose places at the reference time `solve` is given as ``radar={"position_m": ...}``.

        Parameters
        ----------
        velocity : sequence of float
            Steady velocity [m/s].
        aim_moves : bool
            What the antennas are aimed at moves with them; else it stands.

        Returns
        -------
        Motion
            This one.
        """
        self["radar"] = {"velocity_m_per_s": _listed(velocity, "velocity"), "aim_moves": _arguments.flag(aim_moves, "aim_moves")}
        return self


def _listed(values: Any, name: str) -> Any:
    return None if values is None else np.asarray(_arguments.numbers(values, name)).tolist()

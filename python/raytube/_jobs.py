"""What can be asked of a target, or of a case file."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from raytube import _core
from raytube._core import InputError
from raytube._looks import Looks
from raytube._result import RaytubeWarning, Result
from raytube._target import Target

_Progress = bool | Callable[[float], Any]


def solve(target: Target, ghz: Any, looks: Looks | None = None, *, material: str | None = None, parts: Mapping[str, str] | None = None,
          facets: Mapping[str, Any] | None = None, materials: Mapping[str, Any] | None = None, tubes: Mapping[str, Any] | None = None,
          edges: Mapping[str, Any] | None = None, surfaces: Mapping[str, Any] | None = None, radar: Mapping[str, Any] | None = None,
          accuracy: Mapping[str, Any] | None = None, title: str | None = None, keep_parts: bool = False, threads: int = 0,
          progress: _Progress = False) -> Result:
    """Computes the scattering amplitudes of a target.

    The same bits for any number of threads, and the same as those of ``raytube run`` for a case with these keys.

    Parameters
    ----------
    target : Target
        Is made ready on the first call; later ones with the same materials and creases take what is there.
    ghz : float, sequence of float or dict
        Frequencies [GHz]; a dict is a range as in a case file: ``{"start": 9, "stop": 11, "count": 101}``.
    looks : Looks, optional
        From `monostatic`, `bistatic` or `looks`. May be left out where `radar` has the positions of the antennas.
    material : str, optional
        What the target is made of where nothing else is said: "pec" (default), "absorber", or a name in `materials`.
    parts : dict of str to str, optional
        Materials of parts of the mesh, by their names (``Target.parts``).
    facets : dict, optional
        Materials of single facets, counted from 0: ``{"glass": [0, [10, 20]]}``.
    materials, tubes, edges, surfaces, radar, accuracy : dict, optional
        Sections of a case file, with its keys: ``edges={"order": 2}``, ``materials={"coat": {"kind": "coated", "eps_r": [4, 0.1],
        "thickness_mm": 2}}``.
    title : str, optional
        Of pictures and files.
    keep_parts : bool
        Keep the mechanisms apart (`Result.parts`).
    threads : int
        0: all cores.
    progress : bool or callable
        True: a progress bar, where tqdm is installed. A callable is given the finished share, 0 to 1, now and then.

    Returns
    -------
    Result

    Raises
    ------
    InputError
        For a key or a value that a case file would be refused for, and for want of memory: one sentence with the remedy.
    KeyboardInterrupt
        At most half a second after Ctrl-C.

    Warns
    -----
    RaytubeWarning
        For each sentence of `Result.warnings`.

    Notes
    -----
    Other Python threads go on meanwhile, and may solve at the same time.
    """
    sections = {"materials": materials, "tubes": tubes, "edges": edges, "surfaces": surfaces, "radar": radar, "accuracy": accuracy, "title": title,
                "target": {"material": material, "parts": parts, "facets": facets}}
    return _solved(_job_of_target(target, ghz, looks, sections, "solve"), keep_parts, threads, progress)


def run(case: str | os.PathLike, overrides: Mapping[str, Any] | None = None, *, keep_parts: bool = False, threads: int = 0,
        progress: _Progress = False) -> Result:
    """Computes a case file, as ``raytube run`` does, but writes nothing: see `Result.save`.

    Parameters
    ----------
    case : path
        Case file (TOML).
    overrides : dict, optional
        Values in the place of the file's, by dotted key: ``{"tubes.max_bounces": 5, "look.phi_deg": [0, 1, 2]}``.
    keep_parts, threads, progress
        As in `solve`.

    Returns
    -------
    Result

    Raises
    ------
    InputError, KeyboardInterrupt
        As in `solve`.
    """
    return _solved(_job_of_file(case, overrides), keep_parts, threads, progress)


class CheckReport(dict):
    """What a solve would do: a dict of resolved case, mesh, wedges, what is skipped, warnings, memory and time. Its ``repr`` is what
    ``raytube check`` prints."""

    def __init__(self, text: str, data: Mapping[str, Any]):
        super().__init__(data)
        self._text = text

    def __repr__(self) -> str:
        return self._text


def check(what: Any, *args: Any, threads: int = 0, **keywords: Any) -> CheckReport:
    """Says what a solve would do, without doing it: mesh report, wedges, what will be skipped and why, cost.

    Parameters
    ----------
    what : Target or path
        A target, followed by what `solve` takes; or a case file, followed by overrides as `run` takes them.
    threads : int
        Of the solve whose time is predicted; 0: all cores.

    Returns
    -------
    CheckReport

    Raises
    ------
    InputError
        For whatever the solve would be refused for.

    Examples
    --------
    >>> report = raytube.check("cases/dihedral/case.toml", {"edges.method": "none"})
    >>> report["wedges"]["count"]
    """
    text, data = _core.check(_job(what, args, keywords, "check"), threads)
    return CheckReport(text, data)


def image(what: Any, *args: Any, look: int = 0, per_wavelength: float = 10.0, threads: int = 0, progress: _Progress = False,
          **keywords: Any) -> xr.Dataset:
    """The image of one look: where on the target its return comes from, as seen from the radar.

    Parameters
    ----------
    what : Target or path
        As in `check`.
    look : int
        Direction pair, counted from 0.
    per_wavelength : float
        Cells per wavelength.
    threads, progress
        As in `solve`.

    Returns
    -------
    xarray.Dataset
        ``S`` [m], complex, and ``sigma_dbsm`` (v, u, receive, transmit), with the coordinates ``u`` along phi-hat and ``v`` along minus
        theta-hat [m], counted from the origin of the mesh's coordinates. The cells add up to the S of the look. At the middle frequency
        of the list, which is in ``attrs["frequency_hz"]``.

    Raises
    ------
    InputError
        As `solve` does, and for too many cells.
    """
    job = _job(what, args, keywords, "image")
    with _Reported(progress) as report:
        frequency, u, v, cells = _core.image(job, look, per_wavelength, threads, report)
    with np.errstate(divide="ignore"):
        sigma = 20.0 * np.log10(np.abs(cells)) + 10.0 * np.log10(4.0 * np.pi)
    dims = ("v", "u", "receive", "transmit")
    coordinates = {"u": ("u", u, {"units": "m"}), "v": ("v", v, {"units": "m"}), "receive": ["v", "h"], "transmit": ["v", "h"]}
    return xr.Dataset({"S": (dims, cells, {"units": "m"}), "sigma_dbsm": (dims, sigma, {"units": "dBsm"})}, coordinates,
                      {"frequency_hz": frequency, "look": look, "title": job.title})


def trace(what: Any, *args: Any, look: int = 0, u: float = 0.0, v: float = 0.0, **keywords: Any) -> dict[str, Any]:
    """Follows one tube, bounce by bounce.

    Parameters
    ----------
    what : Target or path
        As in `check`.
    look : int
        Direction pair, counted from 0.
    u, v : float
        Launch coordinates along phi-hat and minus theta-hat, from the origin of the mesh's coordinates [m].

    Returns
    -------
    dict
        ``bounces``: a list of dicts with ``point_m``, ``normal``, ``direction_out``, ``path_m``, ``triangle``, ``field_v`` and ``field_h``
        (complex vectors reflected for unit incident V and H); ``end``: why the tube ended.

    Raises
    ------
    InputError
        As `solve` does, and for a place outside the launch rectangle.
    """
    return _core.trace(_job(what, args, keywords, "trace"), look, u, v)


class Convergence(dict):
    """A study over tube density: ``densities``, a list of dicts with ``per_wavelength``, ``S``, ``relative_change``, ``order`` and
    ``rms_db``; ``recommended``, the coarsest one fine enough, where there is one; ``extrapolated_S``. Its ``repr`` is the table that
    ``raytube converge`` prints."""

    def __init__(self, text: str, data: Mapping[str, Any]):
        super().__init__(data)
        self._text = text

    def __repr__(self) -> str:
        return self._text


def converge(what: Any, *args: Any, densities: Any = (2, 4, 8, 16, 32, 64), threads: int = 0, progress: _Progress = False,
             **keywords: Any) -> Convergence:
    """Solves with finer and finer uniform tubes: how fast it converges, and to what.

    Parameters
    ----------
    what : Target or path
        As in `check`.
    densities : sequence of float
        Tubes per wavelength, three or more.
    threads, progress
        As in `solve`.

    Returns
    -------
    Convergence

    Raises
    ------
    InputError
        As `solve` does, and for fewer than three densities.
    """
    job = _job(what, args, keywords, "converge")
    with _Reported(progress) as report:
        text, data = _core.converge(job, [float(density) for density in densities], threads, report)
    return Convergence(text, data)


class _Reported:
    """A callable for the finished share, or None; closes its progress bar."""

    def __init__(self, progress: _Progress):
        self._bar = None
        self._call = progress if callable(progress) else None
        if progress is True:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=100.0, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}")
            self._call = self._show

    def _show(self, share: float) -> None:
        self._bar.update(100.0 * share - self._bar.n)

    def __enter__(self) -> Callable[[float], Any] | None:
        return self._call

    def __exit__(self, *_: Any) -> None:
        if self._bar is not None:
            self._bar.close()


def _solved(job: Any, keep_parts: bool, threads: int, progress: _Progress) -> Result:
    with _Reported(progress) as report:
        result = Result(_core.solve(job, threads, keep_parts, report))
    for sentence in result.warnings:
        warnings.warn(sentence, RaytubeWarning, stacklevel=3)
    return result


def _job(what: Any, args: tuple[Any, ...], keywords: dict[str, Any], name: str) -> Any:
    if not isinstance(what, Target):
        return _job_of_file(what, *args, **keywords)
    names = dict(zip(("ghz", "looks"), args)) | keywords
    target = {"material": names.pop("material", None), "parts": names.pop("parts", None), "facets": names.pop("facets", None)}
    return _job_of_target(what, names.pop("ghz", None), names.pop("looks", None), names | {"target": target}, name)


def _job_of_file(case: str | os.PathLike, overrides: Mapping[str, Any] | None = None) -> Any:
    texts = [f"{key}={_toml(value)}" for key, value in (overrides or {}).items()]
    return _core.job_of_file(os.fspath(case), texts)


def _job_of_target(target: Target, ghz: Any, looks: Looks | None, sections: dict[str, Any], name: str) -> Any:
    if not isinstance(target, Target):
        raise InputError(f"{name}: the first argument is {type(target).__name__}, no Target; use run for a case file")
    if looks is not None and not isinstance(looks, Looks):
        raise InputError(f"{name}: looks are made by raytube.monostatic, raytube.bistatic or raytube.looks (found {type(looks).__name__})")
    values = sections | {"frequency": {"ghz": ghz}} | (looks._sections if looks is not None else {})
    values["target"] = {"mesh": target._core.name, "unit": target.unit} | values["target"]
    return _core.job_of_target(target._core, values, name, None if looks is None else looks._rows, looks is not None and looks.bistatic)


def _toml(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(str(key))} = {_toml(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if np.ndim(value) > 0:
        return "[" + ", ".join(_toml(entry) for entry in value) + "]"
    return repr(value.item() if isinstance(value, np.generic) else value)

"""What the package does with a target, or with a case file: solve, check, converge, image, trace, centres."""

from __future__ import annotations

import difflib
import os
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, Protocol, overload

import numpy as np

from raytube import _arguments, _core
from raytube._core import InputError
from raytube._looks import Looks, monostatic
from raytube._result import RaytubeWarning, Result
from raytube._tables import dbsm
from raytube._target import Target

if TYPE_CHECKING:
    import xarray as xr

    from raytube._products import Outline

_Progress = bool | Callable[[float], Any]
_Section = Mapping[str, Any] | None  # of a case file


class Communicator(Protocol):
    """An intracommunicator of mpi4py."""

    def py2f(self) -> int:
        """Its handle in Fortran."""


@overload
def solve(target: Target, ghz: Any, looks: Looks | None = ..., *, material: str | None = ..., parts: Mapping[str, str] | None = ...,
          facets: _Section = ..., materials: _Section = ..., tubes: _Section = ..., edges: _Section = ..., surfaces: _Section = ...,
          radar: _Section = ..., ground: _Section = ..., motion: _Section = ..., accuracy: _Section = ..., title: str | None = ...,
          keep_mechanisms: bool = ..., threads: int = ..., progress: _Progress = ..., comm: None = ...) -> Result: ...


@overload
def solve(target: Target, ghz: Any, looks: Looks | None = ..., *, material: str | None = ..., parts: Mapping[str, str] | None = ...,
          facets: _Section = ..., materials: _Section = ..., tubes: _Section = ..., edges: _Section = ..., surfaces: _Section = ...,
          radar: _Section = ..., ground: _Section = ..., motion: _Section = ..., accuracy: _Section = ..., title: str | None = ...,
          keep_mechanisms: bool = ..., threads: int = ..., progress: _Progress = ..., comm: Communicator) -> Result | None: ...


def solve(target: Target, ghz: Any, looks: Looks | None = None, *, material: str | None = None, parts: Mapping[str, str] | None = None,
          facets: _Section = None, materials: _Section = None, tubes: _Section = None, edges: _Section = None, surfaces: _Section = None,
          radar: _Section = None, ground: _Section = None, motion: _Section = None, accuracy: _Section = None, title: str | None = None,
          keep_mechanisms: bool = False, threads: int = 0, progress: _Progress = False, comm: Communicator | None = None) -> Result | None:
    """Computes the scattering amplitudes of a target.

    The same bits for any number of threads, and the same as those of ``raytube run`` for a case with these keys.

    Parameters
    ----------
    target : Target
        Prepared on the first call; later calls with the same materials and creases reuse it.
    ghz : float, sequence of float or dict
        Frequencies [GHz]; a dict is a range as in a case file: ``{"start": 9, "stop": 11, "count": 101}``.
    looks : Looks, optional
        From `monostatic`, `bistatic` or `looks`. May be omitted if `radar` gives the positions of the antennas.
    material : str, optional
        Material of everything that `parts` and `facets` leave out: "pec" (default), "absorber", or a name in `materials`.
    parts : dict of str to str, optional
        Materials of parts of the mesh, by the part's name (``Target.parts``).
    facets : dict, optional
        Materials of single facets, counted from 0: ``{"glass": [0, [10, 20]]}``.
    materials, tubes, edges, surfaces, radar, ground, motion, accuracy : dict, optional
        Sections of a case file, with its keys: ``edges={"order": 2}``, ``materials={"coat": {"kind": "coated", "eps_r": [4, 0.1],
        "thickness_mm": 2}}``. `Motion` makes that of bodies that move.
    title : str, optional
        Title for pictures and files.
    keep_mechanisms : bool
        Keep the mechanisms apart (`Result.mechanisms`).
    threads : int
        0: all cores.
    progress : bool or callable
        True: a progress bar, if tqdm is installed. A callable is called from time to time with the share that is done, 0 to 1.
    comm : mpi4py.MPI.Intracomm, optional
        Processes that share the looks: all ranks of this mpi4py communicator call with the same arguments. `threads` then counts for
        each rank; 0 is its part of its machine's cores. `progress` is called on rank 0.

    Returns
    -------
    Result
        With `comm` on rank 0 only; None on the others.

    Raises
    ------
    InputError
        For a key or a value for which a case file would be refused, and if memory does not suffice: one sentence with the remedy. Also for a
        `comm` that is not from mpi4py, or whose MPI this raytube cannot use.
    RuntimeError
        With `comm`: if another rank fails, with its sentence. If it failed with an InputError, so do the others.
    KeyboardInterrupt
        At most half a second after Ctrl-C.

    Warns
    -----
    RaytubeWarning
        For each sentence of `Result.warnings`.

    Notes
    -----
    Other Python threads keep running, and may solve at the same time; with `comm` they must neither solve nor call MPI. With `comm` only
    rank 0 warns.
    """
    keywords = {"material": material, "parts": parts, "facets": facets, "materials": materials, "tubes": tubes, "edges": edges,
                "surfaces": surfaces, "radar": radar, "ground": ground, "motion": motion, "accuracy": accuracy,
                "title": title}
    return _solved(lambda: _job_of_target("solve", target, ghz, looks, keywords), keep_mechanisms, threads, progress, comm)


@overload
def run(case: str | os.PathLike[str], overrides: Mapping[str, Any] | None = ..., *, keep_mechanisms: bool = ..., threads: int = ...,
        progress: _Progress = ..., comm: None = ...) -> Result: ...


@overload
def run(case: str | os.PathLike[str], overrides: Mapping[str, Any] | None = ..., *, keep_mechanisms: bool = ..., threads: int = ...,
        progress: _Progress = ..., comm: Communicator) -> Result | None: ...


def run(case: str | os.PathLike[str], overrides: Mapping[str, Any] | None = None, *, keep_mechanisms: bool = False, threads: int = 0,
        progress: _Progress = False, comm: Communicator | None = None) -> Result | None:
    """Computes a case file, as ``raytube run`` does, but writes nothing: see `Result.save`.

    Parameters
    ----------
    case : path
        Case file (TOML).
    overrides : dict, optional
        Values that replace those in the file, by dotted key: ``{"tubes.max_bounces": 5, "look.phi_deg": [0, 1, 2]}``.
    keep_mechanisms, threads, progress, comm
        As in `solve`.

    Returns
    -------
    Result
        With `comm` on rank 0 only; None on the others.

    Raises
    ------
    InputError, RuntimeError, KeyboardInterrupt
        As in `solve`.
    """
    return _solved(lambda: _job_of_file("run", case, overrides), keep_mechanisms, threads, progress, comm)


class _Printed(dict[str, Any]):
    """Data, and the text that the program prints for them."""

    def __init__(self, text: str, data: Mapping[str, Any]) -> None:
        super().__init__(data)
        self._text = text

    def __repr__(self) -> str:
        return self._text


class CheckReport(_Printed):
    """What a solve would do: a dict of resolved case, mesh, wedges, what is skipped, warnings, memory and time. Its ``repr`` is what
    ``raytube check`` prints."""


def check(what: Any, *args: Any, threads: int = 0, **keywords: Any) -> CheckReport:
    """Reports what a solve would do, without doing it: mesh report, wedges, what will be skipped and why, cost.

    Parameters
    ----------
    what : Target or path
        A target, or a case file.
    *args, **keywords
        For a target ``ghz``, ``looks`` and the sections as in `solve`; for a case file ``overrides`` as in `run`.
    threads : int
        Number of threads for which the time of the solve is predicted; 0: all cores.

    Returns
    -------
    CheckReport

    Raises
    ------
    InputError
        For input that the solve would refuse.

    Examples
    --------
    >>> import raytube as rt
    >>> plate = rt.Target([[0, 0, 0], [.3, 0, 0], [.3, .3, 0], [0, .3, 0]], [[0, 1, 2, 3]], unit="m")
    >>> rt.check(plate, 10.0, rt.monostatic(0, 0))["looks_computed"]
    1
    """
    text, data = _core.check(_job("check", what, args, keywords), _arguments.whole(threads, "threads"))
    return CheckReport(text, data)


def image(what: Any, *args: Any, look: int = 0, per_wavelength: float = 10.0, threads: int = 0, progress: _Progress = False,
          **keywords: Any) -> xr.Dataset:
    """The image of one look: where on the target its return comes from, as seen from the radar.

    Parameters
    ----------
    what : Target or path
        A target, or a case file.
    *args, **keywords
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
        theta-hat (both turned if ``tubes.up`` is set) [m], counted from the origin of the mesh's coordinates; from a finite distance in the
        antenna's perspective, drawn to scale at the middle of the target. The cells add up to the S of the look. At the middle frequency
        of the list, which is in ``attrs["frequency_hz"]``.

    Raises
    ------
    InputError
        As `solve` does, and for too many cells.
    """
    import xarray as xr

    look, density = _arguments.whole(look, "look"), _arguments.number(per_wavelength, "per_wavelength")
    if density <= 0.0:
        raise InputError(f"per_wavelength: give a positive number of cells (found {density:g})")
    job = _job("image", what, args, keywords)
    with _reported(progress) as report:
        frequency, u, v, cells = _core.image(job, look, density, _arguments.whole(threads, "threads"), report)
    dims = ("v", "u", "receive", "transmit")
    coordinates = {"u": ("u", u, {"units": "m", "long_name": "u, along the rows of the launch plane"}),
                   "v": ("v", v, {"units": "m", "long_name": "v, along its columns"}), "receive": ["v", "h"], "transmit": ["v", "h"]}
    variables = {"S": (dims, cells, {"units": "m", "long_name": "scattering amplitude S of a cell"}),
                 "sigma_dbsm": (dims, dbsm(cells), {"units": "dBsm", "long_name": "radar cross-section of a cell"})}
    return xr.Dataset(variables, coordinates, {"frequency_hz": frequency, "look": look, "title": job.title})


def centres(what: Any, *args: Any, look: int = 0, count: int = 50, resolution: float | None = None, threads: int = 0,
            progress: _Progress = False, **keywords: Any) -> xr.Dataset:
    """The scattering centres of one monostatic look: the strongest places from which it returns, without a sweep.

    Parameters
    ----------
    what : Target or path
        A target, or a case file.
    *args, **keywords
        As in `check`.
    look : int
        Direction pair, counted from 0.
    count : int
        Largest number of centres.
    resolution : float, optional
        Side of the cube to which each is resolved [m]; default from the case's band, for a single frequency a sixtieth of the target; at least
        two wavelengths.
    threads, progress
        As in `solve`.

    Returns
    -------
    xarray.Dataset
        The strongest first. ``S`` (centre, receive, transmit) [m], complex, phase reference the origin, and ``sigma_dbsm``; ``place``
        (centre, xyz) in the mesh's coordinates [m]; ``mechanism``; ``persistence_hz``, ``persistence_azimuth_deg`` and
        ``persistence_elevation_deg``, over which the sum of the pieces within the cube stays within 3 dB of its maximum; ``rest`` [m], with
        which the centres add up to S of the look at ``attrs["frequency_hz"]``, the middle of the list.

    Raises
    ------
    InputError
        As `solve` does; for bistatic looks, antennas at a finite distance and materials; for a resolution too fine for the target.
    """
    import xarray as xr

    number, cell = _arguments.whole(count, "count"), 0.0 if resolution is None else _arguments.number(resolution, "resolution")
    if number < 1 or (resolution is not None and cell <= 0.0):
        raise InputError(f"centres: count and resolution must be positive (found {number}, {cell:g})")
    job = _job("centres", what, args, keywords)
    with _reported(progress) as report:
        found = _core.centres(job, _arguments.whole(look, "look"), number, cell, _arguments.whole(threads, "threads"), report)
    dims = ("centre", "receive", "transmit")
    variables: dict[str, Any] = {"S": (dims, found["S"], {"units": "m"}), "sigma_dbsm": (dims, dbsm(found["S"]), {"units": "dBsm"}),
                                 "place": (("centre", "xyz"), found["place"], {"units": "m"}), "mechanism": ("centre", found["mechanism"]),
                                 "rest": (("receive", "transmit"), found["rest"], {"units": "m"})}
    for i, name in enumerate(("persistence_hz", "persistence_azimuth_deg", "persistence_elevation_deg")):
        variables[name] = ("centre", found["persistence"][:, i])
    coordinates = {"xyz": ["x", "y", "z"], "receive": ["v", "h"], "transmit": ["v", "h"]}
    facts = {"frequency_hz": found["frequency_hz"], "resolution_m": found["resolution_m"], "look": look, "title": job.title}
    return xr.Dataset(variables, coordinates, facts)


def trace(what: Any, *args: Any, look: int = 0, u: float = 0.0, v: float = 0.0, **keywords: Any) -> dict[str, Any]:
    """Follows one tube, bounce by bounce.

    Parameters
    ----------
    what : Target or path
        A target, or a case file.
    *args, **keywords
        As in `check`.
    look : int
        Direction pair, counted from 0.
    u, v : float
        Launch coordinates along phi-hat and minus theta-hat (both turned if ``tubes.up`` is set), from the origin of the mesh's coordinates [m].

    Returns
    -------
    dict
        ``bounces``: a list of dicts with ``point_m``, ``normal``, ``direction_out``, ``path_m``, ``triangle``, ``field_v`` and ``field_h``
        (complex vectors reflected for unit incident V and H) of what surfaces reflect; ``end``: why the tube ended.

    Raises
    ------
    InputError
        As `solve` does, and for a place outside the launch rectangle.
    """
    job = _job("trace", what, args, keywords)
    return _core.trace(job, _arguments.whole(look, "look"), _arguments.number(u, "u"), _arguments.number(v, "v"))


class Convergence(_Printed):
    """A study of convergence with tube density: ``densities``, a list of dicts with ``per_wavelength``, ``S``, ``relative_change``, ``order`` and
    ``rms_db``; ``recommended``, the coarsest density that is fine enough, if there is one; ``extrapolated_S``; ``warnings`` about rows that must not
    be used. Its ``repr`` is the table that ``raytube converge`` prints."""


@overload
def converge(what: Any, *args: Any, comm: None = ..., **keywords: Any) -> Convergence: ...


@overload
def converge(what: Any, *args: Any, comm: Communicator, **keywords: Any) -> Convergence | None: ...


def converge(what: Any, *args: Any, densities: Any = (2, 4, 8, 16, 32, 64), threads: int = 0, progress: _Progress = False,
             comm: Communicator | None = None, **keywords: Any) -> Convergence | None:
    """Solves with finer and finer uniform tubes: how fast the result converges, and to what.

    Parameters
    ----------
    what : Target or path
        A target, or a case file.
    *args, **keywords
        As in `check`.
    densities : sequence of float
        Tubes per wavelength: three or more values.
    threads, progress, comm
        As in `solve`.

    Returns
    -------
    Convergence
        A dict whose ``repr`` is the table. With `comm` on rank 0 only; None on the others.

    Raises
    ------
    InputError
        As `solve` does, and for fewer than three densities.
    """
    ranks = _ranks_of(comm)
    with _telling(ranks):
        finer = np.atleast_1d(_arguments.numbers(densities, "densities"))
        if finer.ndim != 1 or not np.all(np.isfinite(finer) & (finer > 0.0)):
            raise InputError("densities: give three or more positive numbers of tubes per wavelength, for example (4, 8, 16)")
        job, count = _job("converge", what, args, keywords), _arguments.whole(threads, "threads")
        reported = _reported(progress if ranks is None or ranks.leads else False)
    with reported as report:
        found = _core.converge(job, finer.tolist(), count, report, ranks)
    if found is None:
        return None
    text, data = found
    _warn(data["warnings"])
    return Convergence(text, data)


def outline_of(target: Any) -> Outline:
    """Points as wide as the target (n, 3), the ends of its edges (n, 2, 3), and its triangles (n, 3, 3) [m]."""
    return _core.outline(_job_of_target("plot", target, 1.0, monostatic(0.0, 0.0), {}))


def _ranks_of(comm: Any) -> _core.Ranks | None:
    """Those of a communicator, all of which call this; None for None."""
    if comm is None:
        return None
    try:
        from mpi4py import MPI
    except ImportError:
        raise InputError(f"comm: give an intracommunicator of mpi4py, which cannot be imported here (found {_arguments.kind_of(comm)})") from None
    if not isinstance(comm, MPI.Intracomm) or comm == MPI.COMM_NULL:
        raise InputError(f"comm: give an intracommunicator of mpi4py, for example MPI.COMM_WORLD (found {_arguments.kind_of(comm)})")
    if MPI.Query_thread() < MPI.THREAD_SERIALIZED:
        raise InputError("comm: MPI was started for programs of one thread; leave mpi4py.rc.thread_level at \"multiple\", or set it to "
                         "\"serialized\", before mpi4py.MPI is imported")
    return _core.ranks_of(comm.py2f(), os.path.dirname(_core.__file__))


@contextmanager
def _telling(ranks: _core.Ranks | None) -> Iterator[None]:
    """If this rank fails before it meets the others, they raise as well instead of waiting for it."""
    try:
        yield
    except BaseException as error:
        if ranks is not None:
            ranks.give_up(str(error) or type(error).__name__, isinstance(error, InputError), isinstance(error, Exception))
        raise


def _reported(progress: Any) -> AbstractContextManager[Callable[[float], Any] | None]:
    """Gives a callable for the finished share: the user's own, or that of a progress bar where tqdm is installed; else None."""
    if callable(progress):
        return nullcontext(progress)
    if _arguments.flag(progress, "progress (or a callable)"):
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return nullcontext()
        return _shown(tqdm(total=100.0, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}"))
    return nullcontext()


@contextmanager
def _shown(bar: Any) -> Iterator[Callable[[float], Any]]:
    with bar:
        yield lambda share: bar.update(100.0 * share - bar.n)


def _solved(make_job: Callable[[], Any], keep_mechanisms: Any, threads: Any, progress: Any, comm: Any) -> Result | None:
    ranks = _ranks_of(comm)
    with _telling(ranks):
        job, count, kept = make_job(), _arguments.whole(threads, "threads"), _arguments.flag(keep_mechanisms, "keep_mechanisms")
        reported = _reported(progress if ranks is None or ranks.leads else False)
    with reported as report:
        found = _core.solve(job, count, kept, report, ranks)
    if found is None:
        return None
    result = Result(found, _core.outline(job))
    _warn(result.warnings, 4)
    return result


def _warn(sentences: list[str], level: int = 3) -> None:
    for sentence in sentences:
        warnings.warn(sentence, RaytubeWarning, stacklevel=level)


# Sections of a case that are keywords; those of [target] first.
_OF_TARGET = ("material", "parts", "facets")
_SECTIONS = ("materials", "tubes", "edges", "surfaces", "radar", "ground", "motion", "accuracy")
_KEYWORDS = (*_OF_TARGET, *_SECTIONS, "title")


def _job(name: str, what: Any, args: tuple[Any, ...], keywords: dict[str, Any]) -> Any:
    of_target = isinstance(what, Target)
    known: tuple[str, ...] = ("ghz", "looks") if of_target else ("overrides",)
    accepted = known + _KEYWORDS if of_target else known
    if len(args) > len(known):
        raise InputError(f"{name}: too many arguments; after the {_arguments.kind_of(what)} come {' and '.join(known)}, the rest by keyword")
    given = dict(zip(known, args))
    for keyword in keywords:
        if keyword in given:
            raise InputError(f"{name}: {keyword} is given twice, by place and by keyword; leave out one")
        if keyword not in accepted:
            near = difflib.get_close_matches(keyword, accepted, 1)
            remedy = ("what a case file says is changed by overrides, for example {\"edges.order\": 2}" if not of_target else
                      f"did you mean {near[0]!r}?" if near else f"choose among {', '.join(accepted)}")
            raise InputError(f"{name}: there is no keyword {keyword!r} here; {remedy}")
    given |= keywords
    if not of_target:
        return _job_of_file(name, what, given.get("overrides"))
    return _job_of_target(name, what, given.pop("ghz", None), given.pop("looks", None), given)


def _job_of_file(name: str, case: Any, overrides: Any) -> Any:
    if isinstance(case, Target):
        raise InputError(f"{name}: takes a case file; targets are solved by solve")
    given = {} if overrides is None else _arguments.table(overrides, f"{name}: overrides")
    texts = [f"{key}={_toml(value, str(key))}" for key, value in given.items() if value is not None]
    return _core.job_of_file(_arguments.path(case, name), texts)


def _job_of_target(name: str, target: Any, ghz: Any, looks: Any, keywords: dict[str, Any]) -> Any:
    if not isinstance(target, Target):
        raise InputError(f"{name}: the first argument is {_arguments.kind_of(target)}, no Target; give Target.load(mesh, unit), or use run for a case file")
    if looks is not None and not isinstance(looks, Looks):
        raise InputError(f"{name}: looks are made by raytube.monostatic, raytube.bistatic or raytube.looks "
                         f"(found {_arguments.kind_of(looks)})")
    if ghz is None:
        raise InputError(f"{name}: ghz is missing; give a number, a list, or a range {{'start': 9, 'stop': 11, 'count': 101}}")
    if looks is None and not keywords.get("radar"):
        raise InputError(f"{name}: looks are missing; give raytube.monostatic(theta_deg, phi_deg), bistatic or looks")
    for key, value in keywords.items():
        if key in _SECTIONS and value is not None and not isinstance(value, Mapping):
            raise InputError(f"{name}: {key} must be a section, a dictionary of its keys (found {_arguments.kind_of(value)})")
    of_target = {key: keywords.get(key) for key in _OF_TARGET}
    values = {key: value for key, value in keywords.items() if key not in _OF_TARGET}
    values |= {"frequency": {"ghz": ghz}} | (looks._sections if looks is not None else {})
    meshes = target._core.meshes
    values["target"] = {"mesh": meshes if len(meshes) > 1 else meshes[0], "unit": target.unit} | of_target
    return _core.job_of_target(target._core, values, name, None if looks is None else looks._rows, looks is not None and looks.bistatic)


def _toml(value: Any, key: str) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_quoted(str(name), key)} = {_toml(entry, key)}" for name, entry in value.items()) + "}"
    if isinstance(value, (str, os.PathLike)):
        return _quoted(os.fsdecode(value), key)
    if isinstance(value, (list, tuple, range, np.ndarray)):
        if isinstance(value, np.ndarray) and value.ndim == 0:
            return _toml(value.item(), key)
        return "[" + ", ".join(_toml(entry, key) for entry in (value.tolist() if isinstance(value, np.ndarray) else value)) + "]"
    try:
        whole = isinstance(value, (int, np.integer)) and abs(int(value)) < 2**63
        return repr(int(value) if whole else float(value))
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"overrides: {key}: {_arguments.kind_of(value)} is nothing that a case can hold; "
                         "give numbers, texts, lists and dictionaries of these") from None


def _quoted(text: str, key: str) -> str:
    if any(0xD800 <= ord(c) < 0xE000 for c in text):
        raise InputError(f"overrides: {key}: a text that cannot be written as UTF-8; give whole characters")
    return '"' + "".join(c if c.isprintable() and c not in '"\\' else f"\\U{ord(c):08x}" for c in text) + '"'

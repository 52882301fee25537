"""What a report shows, as one dict for the scripts of its page: arrays are base64 of little-endian numbers."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raytube import _core
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._result import Result
from raytube._rows import LABELS, Rows, cuts_of, grid_of, rows_of_result
from raytube._tables import (KEYS, Floats, amplitudes_of, centres_of, comments, dbsm, keys_of, largest_of_blocks, mechanism_text, mechanisms_of,
                             read_csv)

_SCRIPTS = ("data", "scales", "plot", "curves", "heat", "centres", "space", "words", "page")  # in the order in which they run
_NOTHING = -32768  # hundredths of a decibel: stands for no return at all
_MOST_VALUES = 600_000  # of two bytes: 1.6 MB of a page
_MAP_COLUMNS, _MAP_ROWS = 240, 200
_MOST_RANGES, _MOST_LOOKS, _MOST_ACROSS = 500, 200, 240
_MOST_ISAR_CELLS, _MOST_PIXELS, _RANGES_A_CELL, _VELOCITIES_A_CELL = 2e6, 4.0, 8, 4  # smooth to the eye
_MOST_CENTRES = 1000  # more only hide one another
_LONGEST_LIST = 8
_READ_ONE_BY_ONE = ("warnings", "model_uncertainty", "skipped", "mechanisms")  # lists of run.json
_WINDOW, _SIDELOBE_DB = "taylor", 35.0
_QUANTITIES = ("ghz", "theta", "phi", "rx_theta", "rx_phi", "time")  # by key
_ALL = list(range(4))  # channels
_MOST_LOOKS_IN_SPACE, _MOST_CELLS, _MOST_TUBES, _MOST_EDGES = 3, 200, 600, 5000  # ten megabytes hold no more
_LONG_LOOK = 30.0  # seconds to solve a look without --looks
_NUMBER = r"([-+.\deE]+)"
_Corners = NDArray[np.int64]


@dataclass
class Source:
    """A result, and what lies beside it."""

    file: Path
    stored: _core.Stored
    run: dict[str, Any] | None  # run.json, or what a netCDF file says of its run
    title: str
    job: _core.Job | None = None  # the case and its target, where both are as the run had them
    mechanisms: dict[str, NDArray[np.complex128]] = field(default_factory=dict)  # S by mechanism [m], (row, channel)
    incoherent_m2: Floats | None = None  # sigma without phase [m^2], (row, transmit polarisation)
    notes: list[str] = field(default_factory=list)  # what the report lacks, and why


def data_of(file: Path, looks: list[int]) -> dict[str, Any]:
    """Everything that the page shows for a result file of raytube's, with the return of these looks in space (none given: those whose images the
    run has kept, or the strongest). Raises InputError for files that raytube has not written, and for looks that cannot be shown."""
    source = _source(file)
    rows = rows_of_result(Result(source.stored), str(file))
    data: dict[str, Any] = {"title": source.title, "file": file.name, "sentences": _sentences(source, rows), "sweep": _sweep(source, rows)}
    for name, words, view in (("map", "Map", lambda: _map(rows)), ("profiles", "Range profiles", lambda: _profiles(source)),
                              ("doppler", "Doppler", lambda: _doppler(source)), ("isar", "ISAR image", lambda: _isar(source)), ("centres", "Scattering centres", lambda: _centres(source))):
        data[name] = _or_note(source, words, view)
    data["scene"] = _scene(source, looks)
    return data | {"record": _record(source.run), "notes": source.notes}


def page(data: dict[str, Any], libraries: str) -> str:
    """The page as text. `libraries`: three.js and OrbitControls, or empty for a page without a view in space."""
    folder = Path(__file__).parent / "report"
    text = {file.name: file.read_text(encoding="utf-8") for file in folder.iterdir()}
    packed = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")  # no "</script" ends them
    parts: dict[str, str] = {"title": escape(data["title"]), "style": text["style.css"], "data": packed, "three": libraries,
             "script": "\n".join(text[f"{name}.js"] for name in _SCRIPTS)}
    filled = re.sub("@(title|style|data|three|script)@", lambda mark: parts[str(mark[1])], text["page.html"])
    return "<!DOCTYPE html><!-- report of raytube -->\n" + filled


# --- arrays made small ---


def packed(values: Any, kind: str = "<f4") -> str:
    """Base64 of numbers of this NumPy type."""
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode()


def packed_levels(levels_db: Floats) -> str:
    """Levels in hundredths of a decibel as Int16, which is finer than a page shows: -327.68 stands for -inf and whatever is weaker."""
    hundredths = np.nan_to_num(np.round(100.0 * levels_db), nan=_NOTHING, posinf=32767, neginf=_NOTHING)
    return packed(np.clip(hundredths, _NOTHING, 32767), "<i2")


def four_levels(levels_db: Floats) -> list[str]:
    """The four channels, which are the last axis, each packed."""
    return [packed_levels(levels_db[..., channel]) for channel in range(4)]


def _block_axis(at: Floats, size: int) -> dict[str, Any]:
    """The middles of the first and the last block of values in even steps."""
    step = float(at[-1] - at[0]) / max(len(at) - 1, 1)
    middle, blocks = at[0] + 0.5 * (size - 1) * step, -(-len(at) // size)
    return {"first": middle, "last": middle + size * step * (blocks - 1), "count": blocks}


# --- what lies in the folder ---


def _source(file: Path) -> Source:
    read = _core.Stored.read_netcdf if file.suffix.lower() == ".nc" else _core.Stored.read_csv
    stored, beside = read(str(file)), file.absolute().parent
    attributes = stored.attributes
    run = _run_json(beside / "run.json") or _run_of_attributes(attributes)
    source = Source(file, stored, run, attributes.get("title", file.name))
    table = attributes.get("rcs_csv_sha256") if file.suffix.lower() == ".nc" else hashlib.sha256(file.read_bytes()).hexdigest()
    if table and _member(run, "rcs_csv_sha256") == table:
        source.title = _member(run, "case", "title") or source.title
        source.job = _core.job_of_run(json.dumps(run))
    source.mechanisms = {name: s.reshape(-1, 4) for name, s in stored.mechanisms.items()}
    source.incoherent_m2 = None if stored.incoherent_m2 is None else stored.incoherent_m2.reshape(-1, 2)
    if not source.mechanisms and (beside / "parts.csv").exists():
        source.mechanisms = mechanisms_of(_table(beside / "parts.csv", stored))
    elif not source.mechanisms:
        source.notes.append("Curves by mechanism: the run kept its mechanisms together; raytube run --parts keeps them apart.")
    source.mechanisms = {name: s for name, s in source.mechanisms.items() if np.any(s)}  # others have no curve
    if source.incoherent_m2 is None and (beside / "incoherent.csv").exists():
        source.incoherent_m2 = 10.0 ** (_table(beside / "incoherent.csv", stored).iloc[:, -2:].to_numpy() / 10.0)
    return source


def _run_json(file: Path) -> dict[str, Any] | None:
    if not file.exists():
        return None
    try:
        run = json.loads(file.read_text(encoding="utf-8"))
    except ValueError:
        run = None
    if not isinstance(run, dict):
        raise InputError(f"{file}: is not the JSON that a run writes; run the case again, or delete the file")
    return run


def _run_of_attributes(attributes: dict[str, str]) -> dict[str, Any] | None:
    known = ("case", "warnings", "counts", "model_uncertainty")
    run = {name: json.loads(text) for name, text in attributes.items() if name in known}
    return run | ({"version": attributes["raytube_version"]} if "raytube_version" in attributes else {}) or None


def _member(run: Any, *names: str) -> Any:
    """A member of nested dicts, or None."""
    for name in names:
        run = run.get(name) if isinstance(run, dict) else None
    return run


def _table(file: Path, stored: _core.Stored) -> Any:
    """A table beside the result, which must have the rows of it."""
    table, keys = read_csv(file), keys_of(stored)[:, :3]
    if len(table) != len(keys) or not np.array_equal(table.iloc[:, :3], keys):
        raise InputError(f"{file}: does not have the rows of the result beside it; run the case again, or delete the file")
    return table


def _or_note(source: Source, name: str, view: Callable[[], Any]) -> Any:
    """The view; where the run does not allow it, a note that says why."""
    try:
        return view()
    except InputError as error:
        source.notes.append(f"{name}: {error}.")
        return None


# --- rows, curves and a map ---


def _sweep(source: Source, rows: Rows) -> dict[str, Any]:
    stored, kept = source.stored, shown_rows(rows, 12 + 4 * len(source.mechanisms))
    levels = {name: four_levels(values.reshape(-1, 4)[kept]) for name, values in
              (("sigma", stored.sigma_dbsm), ("error", stored.error_db), ("model", stored.model_db))}
    with np.errstate(divide="ignore"):
        incoherent = None if source.incoherent_m2 is None else [packed_levels(10.0 * np.log10(values)) for values in source.incoherent_m2[kept].T]
    of_looks = KEYS[1:] if stored.moving else KEYS[1:-1]
    return {"ghz": (stored.frequency_hz / 1e9).tolist(),
            "looks": {name: getattr(stored, key).tolist() for name, key in zip(_QUANTITIES[1:], of_looks)}, "bistatic": stored.bistatic,
            "total": len(rows.keys), "rows": packed(kept, "<u4"), **levels, "incoherent": incoherent,
            "mechanisms": [{"label": mechanism_text(name), "sigma": four_levels(dbsm(s[kept]))} for name, s in source.mechanisms.items()]}


def shown_rows(rows: Rows, values_a_row: int) -> NDArray[np.int64]:
    """All rows, or of a sweep too large for a page the strongest and the weakest of every few neighbours along its curves."""
    count, most = len(rows.keys), _MOST_VALUES // values_a_row
    if count <= most:
        return np.arange(count)
    largest, length = np.fmax.reduce(rows.sigma, axis=1), -(-2 * count // most)
    near = [cut.rows[first:first + length] for cut in cuts_of(rows)[1] for first in range(0, len(cut.rows), length)]
    return np.asarray(np.unique([some[at] for some in near for at in (np.argmin(largest[some]), np.argmax(largest[some]))]))


def _map(rows: Rows) -> dict[str, Any] | None:
    grid = grid_of(rows, rows.peak_row(_ALL), 2)
    if grid is None:
        return None
    levels, axes = grid.over(rows.sigma), {}
    for name, key, values, most in (("x", grid.across, grid.x, _MAP_COLUMNS), ("y", grid.up, grid.y, _MAP_ROWS)):
        steps = np.diff(values)
        if np.any(np.abs(steps - np.median(steps)) > 1e-3 * abs(np.median(steps))):
            raise InputError(f"{LABELS[key]} is not in even steps; a sweep in even steps gives a map")
        levels, size = largest_of_blocks(levels, 1 if name == "x" else 0, most)
        axes[name] = _block_axis(values, size) | {"quantity": _QUANTITIES[key]}
    return axes | {"fixed": grid.fixed, "sigma": four_levels(levels)}


# --- range profiles, the ISAR image, centres ---


def _outermost(source: Source) -> list[list[float]]:
    return list(_core.outline(source.job)[0].tolist()) if source.job is not None else []


def _profiles(source: Source) -> dict[str, Any]:
    made = _core.range_profiles(source.stored, None, _outermost(source), _WINDOW, _SIDELOBE_DB, _RANGES_A_CELL)
    at, (amplitude, size) = made["range_m"], largest_of_blocks(np.abs(made["S"]), 0, _MOST_LOOKS)
    amplitude, ranges = largest_of_blocks(amplitude, 1, _MOST_RANGES)
    model = dbsm(largest_of_blocks(np.fmax(made["model_m"][:, 0, 0], made["model_m"][:, 0, 3]), 0, _MOST_LOOKS)[0])
    return {"range": _block_axis(at, ranges), "looks_a_block": size, "blocks": len(amplitude),
            "resolution": made["resolution_m"], "unambiguous": made["unambiguous_m"], "window": _WINDOW.capitalize(),
            "model": [level if np.isfinite(level) else None for level in model.tolist()], "sigma": four_levels(dbsm(amplitude))}


def _doppler(source: Source) -> dict[str, Any] | None:
    """Of a scene that moves, the strongest look of a pulse over velocity and range; of one frequency over time and velocity."""
    stored = source.stored
    if not stored.moving:
        return None
    looks = len(stored.theta_deg) // len(_core.pulse_times(stored))
    look, asked = int(np.nanargmax(np.abs(stored.S).max(axis=(1, 2, 3)))) % looks, ("", 0.0, 0.0, _WINDOW, _SIDELOBE_DB, _VELOCITIES_A_CELL)
    if len(stored.frequency_hz) > 1:
        made, names = _core.doppler(stored, look, False, *asked), ("range_m", "velocity_m_per_s")
        power = 4.0 * np.pi * np.abs(made["S"][:, :, 0]) ** 2
    else:
        made, names = _core.spectrogram(stored, look, 0, 0.75, None, *asked), ("velocity_m_per_s", "time_s")
        power = made["sigma_m2"].transpose(1, 0, 2)
    axes = {}
    for i, (axis, name) in enumerate(zip("yx", names)):
        power, size = largest_of_blocks(power, i, _MOST_ACROSS)
        axes[axis] = _block_axis(made[name], size) | {"quantity": name}
    with np.errstate(divide="ignore"):
        return axes | {"sigma": four_levels(10.0 * np.log10(power)), "look": look if looks > 1 else None, "window": _WINDOW.capitalize(),
                       **{name: made[f"velocity_{name}_m_per_s"] for name in ("resolution", "unambiguous")}}


def _isar(source: Source) -> dict[str, Any]:
    outermost = _outermost(source)
    cells = _core.isar_cells(source.stored, outermost)
    pixels = min(_MOST_PIXELS, (_MOST_ISAR_CELLS / float(np.prod(cells))) ** (1.0 / len(cells)))
    if pixels < 1.0:
        raise InputError(f"{np.prod(cells):.3g} resolution cells are too many for a page; raytube isar computes the image")
    axes, s = _core.isar(source.stored, outermost, [], pixels, _WINDOW, _SIDELOBE_DB)
    amplitude = np.abs(s) if len(axes) == 2 else np.fmax.reduce(np.abs(s), axis=2)
    data: dict[str, Any] = {"in_space": len(axes) > 2, "window": _WINDOW.capitalize()}
    for i, name in enumerate(("range", "cross")):
        amplitude, size = largest_of_blocks(amplitude, i, _MOST_ACROSS)
        data[name] = _block_axis(axes[i]["at_m"], size)
        data[f"{name}_axis"], data[f"{name}_resolution"] = axes[i]["direction"], axes[i]["resolution_m"]
    return data | {"sigma": four_levels(dbsm(amplitude))}


def _centres(source: Source) -> dict[str, Any] | None:
    file, remedy = source.file.absolute().parent / "centres.csv", "raytube centres CASE.toml --look I -o FOLDER, with the result's folder, writes it"
    if source.stored.bistatic:
        return None
    if not file.exists():
        raise InputError(f"there is no centres.csv; {remedy}")
    (theta, phi, hertz, side), table = centres_of(file)
    stored = source.stored
    look = np.flatnonzero(np.isclose(stored.theta_deg, theta, 1e-9, 1e-9) & np.isclose(stored.phi_deg, phi, 1e-9, 1e-9))
    frequency = np.flatnonzero(np.isclose(stored.frequency_hz, hertz, 1e-9, 0.0))
    if not (len(look) and len(frequency)):
        raise InputError(f"centres.csv is for θ = {theta:g}°, φ = {phi:g}° at {hertz / 1e9:g} GHz, which the result does not have; {remedy}")
    shown = table[table["centre"] != "rest"].head(_MOST_CENTRES)
    s, persistence = amplitudes_of(table), ["persistence_ghz", "persistence_azimuth_deg", "persistence_elevation_deg"]
    return {"look": int(look[0]), "ghz": hertz / 1e9, "side": side, "total": int(np.sum(table["centre"] != "rest")),
            "places": packed(shown[["x_m", "y_m", "z_m"]]), "persistence": packed(shown[persistence]), "mechanism": [mechanism_text(name) for name in shown["mechanism"]],
            "part": shown["part"].fillna("").tolist(), "sigma": four_levels(dbsm(amplitudes_of(shown))),
            "doubt": _doubt(s.sum(axis=0), stored.S[look[0], frequency[0]].reshape(4))}


def _doubt(found: NDArray[np.complex128], s: NDArray[np.complex128]) -> str:
    """Centres add up to S of the look but for what refined tubes change in it, 2 % on a large truck. Empty if there is no doubt."""
    if np.linalg.norm(found - s) <= 0.25 * np.linalg.norm(s):
        return ""
    channel = 3 if abs(s[3]) > abs(s[0]) else 0
    return (f"With the rest they add up to {dbsm(found[channel]):.2f} dBsm {CHANNELS[channel].upper()}, but the result has "
            f"{dbsm(s[channel]):.2f} dBsm: centres.csv may belong to other settings, or to another target.")


# --- the target in space, in the coordinates of its mesh [m] ---


def _scene(source: Source, asked: list[int]) -> dict[str, Any] | None:
    """Facets and edges of the target, and of some looks the return of each: looks that are asked for, else those whose images the run has
    kept, else the strongest if it is quick to solve. What cannot be shown is noted in `source`. Raises InputError for looks that are asked
    for and cannot be had."""
    looks = source.stored.S.shape[0]
    if len(asked) > _MOST_LOOKS_IN_SPACE:
        raise InputError(f"--looks: a report shows {_MOST_LOOKS_IN_SPACE} at most; leave out {len(asked) - _MOST_LOOKS_IN_SPACE}")
    if beyond := next((look for look in asked if look >= looks), 0):
        raise InputError(f"--looks {beyond}: {source.file} has {looks} look{'s' if looks > 1 else ''}, counted from 0; choose among these")
    target = None if source.job is None else _core.traced_target(source.job)
    vertices, triangles = (None, None) if target is None else (target["vertices"], target["triangles"].astype(np.int64))
    shown: list[dict[str, Any]] = []
    if asked:
        _require_target(source, target)
        shown = [_solved(source, target, look) for look in asked]
    else:
        for kept in _kept(source):
            if triangles is None:
                vertices, triangles = kept["vertices"], kept["corners"]
            if len(kept["triangles"]) == len(triangles):
                shown.append(kept | (_or_note(source, "Tubes", partial(_tubes, source, target, kept["look"])) or {}))
        if not shown and target is not None:
            shown = _or_note(source, "Colours of the target", partial(_strongest, source, target)) or []
    if vertices is None or triangles is None:
        source.notes.append("The target in space: the case or the mesh is not where the run had it, or has changed.")
        return None
    points, corners, shown_as = shown_mesh(vertices, triangles, 40_000 if len(shown) > 1 else 60_000)
    lines = _core.outline(source.job)[1] if source.job is not None else np.empty((0, 2, 3))
    return {"vertices": packed(points), "triangles": packed(corners, "<u4"), "traced": len(triangles), "shown": len(corners), "lines": packed(lines),
            "looks": [_look_data(look, shown_as, len(corners)) for look in shown]}


def _require_target(source: Source, target: dict[str, Any] | None) -> None:
    if target is None:
        raise InputError(f"--looks: {source.file} has no target: its case or mesh is not where the run had it, or has changed")
    if (target["looks"], target["frequencies"]) != source.stored.S.shape[:2]:
        raise InputError(f"{_member(source.run, 'case_file')}: has other looks or frequencies than {source.file}; run it again")


def _tubes(source: Source, target: dict[str, Any] | None, look: int) -> dict[str, Any]:
    if source.job is None:
        return {}
    _require_target(source, target)
    return {"tubes": _core.tubes(source.job, look, _MOST_TUBES)}


def _solved(source: Source, target: dict[str, Any] | None, look: int) -> dict[str, Any]:
    assert source.job is not None
    return _core.look_in_space(source.job, look, _MOST_CELLS) | {"look": look} | _tubes(source, target, look)


def _strongest(source: Source, target: dict[str, Any]) -> list[dict[str, Any]]:
    looks, frequencies = source.stored.S.shape[:2]
    if (_member(source.run, "time", "solve_s") or 0.0) / looks > _LONG_LOOK:
        raise InputError("a look takes long to solve; raytube report --looks I computes one")
    _require_target(source, target)
    amplitude = np.abs(source.stored.S[:, frequencies // 2]).reshape(looks, 4)
    return [_solved(source, target, int(np.argmax(np.nan_to_num(amplitude.max(axis=1)))))]


# --- images that the run has kept ---


def _kept(source: Source) -> list[dict[str, Any]]:
    looks = _member(source.run, "case", "output", "image_look")
    looks = [] if looks is None else looks if isinstance(looks, list) else [looks]
    if len(looks) > _MOST_LOOKS_IN_SPACE:
        source.notes.append(f"Looks in space: the first {_MOST_LOOKS_IN_SPACE} of {len(looks)} images; raytube report --looks chooses others.")
    found = []
    for look in looks[:_MOST_LOOKS_IN_SPACE]:
        stem = source.file.absolute().parent / (f"image_{look}" if len(looks) > 1 else "image")
        mesh, cells = stem.with_name(stem.name + "_mesh.vtu"), stem.with_name(stem.name + ".csv")
        if look < source.stored.S.shape[0] and mesh.exists():
            hertz = source.stored.frequency_hz[len(source.stored.frequency_hz) // 2]
            found.append({"look": look, "frequency_hz": hertz} | _read_mesh(mesh) | (_read_cells(cells) if cells.exists() else {}))
    return found


def _read_mesh(file: Path) -> dict[str, Any]:
    """Vertices and corners of the facets, their amplitudes, and the ends and amplitudes of edges."""
    arrays = {name: np.array(text.split(), dtype=float) for name, text in
              re.findall(r'<DataArray [^>]*Name="(\w+)"[^>]*>([^<]*)<', file.read_text(encoding="utf-8"))}
    try:
        points, corners, ends = arrays["points"].reshape(-1, 3), arrays["connectivity"].astype(int), arrays["offsets"].astype(int)
        s = np.column_stack([arrays[f"re_{c}"] + 1j * arrays[f"im_{c}"] for c in CHANNELS])
        sizes = np.diff(ends, prepend=0)
        facets = np.count_nonzero(sizes == 3)
        if len(s) != len(sizes) or not np.all(sizes[:facets] == 3) or not np.all(sizes[facets:] == 2):
            raise ValueError
        return {"vertices": points[:len(points) - 2 * (len(sizes) - facets)], "corners": corners[:3 * facets].reshape(-1, 3), "triangles": s[:facets],
                "edge_ends": points[corners[3 * facets:]].reshape(-1, 2, 3), "edges": s[facets:]}
    except (KeyError, ValueError, IndexError):
        raise InputError(f"{file}: is not the image of a look that raytube run writes; run the case again") from None


def _read_cells(file: Path) -> dict[str, Any]:
    """The cells of an image, as large as a page shows them."""
    table, head = read_csv(file), " ".join(comments(file))
    vector = rf"\({_NUMBER}, {_NUMBER}, {_NUMBER}\)"
    lattice = re.search(rf"(\d+) columns of {_NUMBER} m along u = {vector}, (\d+) rows of {_NUMBER} m along v = {vector}", head)
    try:
        facts = [float(text) for text in lattice.groups()]  # type: ignore[union-attr]
        columns, count = int(facts[0]), int(facts[5])
        cells = amplitudes_of(table).reshape(count, columns, 4)
    except (AttributeError, KeyError, ValueError):
        raise InputError(f"{file}: is not the image of a look that raytube run writes; run the case again") from None
    u, v, cell = np.array(facts[2:5]), np.array(facts[7:10]), np.array([facts[1], facts[6]])
    side = -(-max(columns, count) // _MOST_CELLS)
    for axis in (0, 1):
        cells = np.add.reduceat(cells, np.arange(0, cells.shape[axis], side), axis)
    corner = table.iloc[0, 2:4].to_numpy(dtype=float) - 0.5 * cell + _shift_of_perspective(head, u, v)
    return {"cells": cells, "u": u.tolist(), "v": v.tolist(), "corner": corner.tolist(), "cell": (side * cell).tolist()}


def _shift_of_perspective(head: str, u: Floats, v: Floats) -> Floats:
    """From where a finite distance shows the middle of the target to where parallel rays would."""
    found = re.search(rf"Perspective from {_NUMBER} m before the middle of the target, \({_NUMBER}, {_NUMBER}, {_NUMBER}\)", head)
    if found is None:
        return np.zeros(2)
    distance, *middle = (float(text) for text in found.groups())
    along = np.array([u @ middle, v @ middle])
    return np.asarray(along - along / (1.0 + (np.cross(u, v) @ middle) / distance))


# --- made small ---


def _look_data(look: dict[str, Any], shown_as: _Corners, facets: int) -> dict[str, Any]:
    largest = np.zeros((facets, 4))
    np.maximum.at(largest, shown_as, np.abs(look["triangles"]))
    strongest = np.argsort(-np.abs(look["edges"]).max(axis=1, initial=0.0), kind="stable")[:_MOST_EDGES]
    ends, bounces, met = look.get("tubes", (np.empty(0), np.empty(0), 0))
    cells = look.get("cells")
    return {"look": look["look"], "ghz": look["frequency_hz"] / 1e9, "sigma": four_levels(dbsm(largest)),
            "edges": {"ends": packed(look["edge_ends"][strongest]), "sigma": four_levels(dbsm(look["edges"][strongest]))},
            "tubes": {"ends": packed(ends), "bounces": packed(bounces, "<u4"), "paths": met},
            "cells": None if cells is None or not cells.size else
            {name: look[name] for name in ("u", "v", "corner", "cell")}
            | {"columns": cells.shape[1], "rows": cells.shape[0], "sigma": four_levels(dbsm(cells))}}


def shown_mesh(vertices: Floats, triangles: _Corners, most: int) -> tuple[Floats, _Corners, _Corners]:
    """A mesh of at most this many triangles: itself, or else one whose vertices are the means of those in each cell of a grid, the finest that is
    coarse enough; and for each triangle given that which stands for it. (Rossignac and Borrel, 1993: vertex clustering.)"""
    if len(triangles) <= most:
        return vertices, triangles, np.arange(len(triangles))
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    cell = 0.25 * np.sqrt(area / most)
    while len((coarse := _clustered(vertices, triangles, cell))[1]) > most:
        cell *= 1.15
    return coarse


def _clustered(vertices: Floats, triangles: _Corners, cell: float) -> tuple[Floats, _Corners, _Corners]:
    _, cluster = np.unique(np.floor(vertices / cell).astype(np.int64), axis=0, return_inverse=True)
    cluster = cluster.reshape(-1)
    count = np.bincount(cluster)
    means = np.column_stack([np.bincount(cluster, vertices[:, i]) / count for i in range(3)])
    moved = cluster[triangles]
    corners = np.sort(moved, axis=1)
    flat = (corners[:, 0] == corners[:, 1]) | (corners[:, 1] == corners[:, 2])
    _, first, number = np.unique(corners[~flat], axis=0, return_index=True, return_inverse=True)
    shown_as = np.full(len(triangles), -1)
    shown_as[~flat] = number.reshape(-1)
    at_corner = np.full(len(means), -1)  # for what became a line: a triangle at one of its corners
    at_corner[moved[~flat]] = shown_as[~flat, None]
    shown_as[flat] = at_corner[moved[flat]].max(axis=1, initial=-1)
    return means, moved[~flat][first], np.maximum(shown_as, 0)  # 0: a body smaller than a cell


# --- words ---


def _sentences(source: Source, rows: Rows) -> dict[str, str]:
    row = rows.peak_row(_ALL)
    channel = int(np.argmax(np.nan_to_num(rows.sigma[row], nan=-np.inf)))
    numerical, model = _core.error_sentences(source.stored)
    return {"peak": f"The strongest return is {rows.sigma[row, channel]:.2f} dBsm in {CHANNELS[channel].upper()}, at {rows.fixed(row)} "
                    f"(look {row // source.stored.S.shape[1]}).",
            "error": f"Numerical error of the tubes: {numerical}.",
            "model": f"Model uncertainty, what asymptotic physics leaves out: {model}.{_largest_cause(source.run)}"}


def _largest_cause(run: dict[str, Any] | None) -> str:
    causes = _member(run, "model_uncertainty")
    if not causes or not {"what", "share", "remedy"} <= set(causes[0]):
        return ""
    remedy = causes[0]["remedy"]
    handle = "no key reduces it" + remedy.removeprefix("none") if remedy.startswith("none") else f"remedy: {remedy}"
    return f" It is mostly {causes[0]['what']} ({100.0 * causes[0]['share']:.0f} %); {handle}."


def _record(run: dict[str, Any] | None) -> dict[str, Any] | None:
    """What run.json says; long lists of numbers as their extent, but for those that are read one by one."""
    kept = ("version", "case", "mesh", "threads", "counts", "time", "warnings", "model_uncertainty")
    return None if run is None else {name: _shortened(name, run[name]) for name in kept if name in run}


def _shortened(name: str, value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _shortened(key, each) for key, each in value.items()}
    if not isinstance(value, list) or name in _READ_ONE_BY_ONE:
        return value
    if len(value) <= _LONGEST_LIST:
        return [_shortened("", each) for each in value]
    numbers = all(isinstance(each, (int, float)) for each in value)
    return f"{len(value)} values from {min(value):g} to {max(value):g}" if numbers else f"a list of {len(value)}"

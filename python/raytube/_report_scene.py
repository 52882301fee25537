"""The target in space as a report shows it, and where the return of chosen looks comes from. All in the mesh's own coordinates [m]."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raytube import _core
from raytube._arguments import CHANNELS
from raytube._core import InputError
from raytube._report import Source, four_levels, member, packed
from raytube._tables import amplitudes_of, comments, dbsm, read_csv

_MOST_LOOKS, _MOST_CELLS, _MOST_TUBES, _MOST_EDGES = 3, 200, 600, 5000  # ten megabytes hold no more
_LONG_LOOK = 30.0  # seconds, of a look that nobody has asked for
_NUMBER = r"([-+.\deE]+)"
_Floats = NDArray[np.float64]
_Corners = NDArray[np.int64]


def scene_of(source: Source, asked: list[int]) -> dict[str, Any] | None:
    """Facets and edges of the target, and of some looks the return of each: looks that are asked for, else those whose images the run has
    kept, else the strongest if it is quick to solve. What cannot be shown is noted in `source`. Raises InputError for looks that are asked
    for and cannot be had."""
    _check(source, asked)
    target = None if source.job is None else _core.traced_target(source.job)
    vertices, triangles = (None, None) if target is None else (target["vertices"], target["triangles"].astype(np.int64))
    shown: list[dict[str, Any]] = []
    if asked:
        _require_target(source, target)
        shown = [_solved(source, look) for look in asked]
    else:
        for kept in _kept(source):
            if triangles is None:
                vertices, triangles = kept["vertices"], kept["corners"]
            if len(kept["triangles"]) == len(triangles):
                shown.append(_with_tubes(source, target, kept))
        if not shown and target is not None:
            shown = _strongest(source, target)
    if vertices is None or triangles is None:
        source.notes.append("The target in space: the case or the mesh is not where the run had it, or has changed.")
        return None
    points, corners, shown_as = shown_mesh(vertices, triangles, 40_000 if len(shown) > 1 else 60_000)
    lines = _core.outline(source.job)[1] if source.job is not None else np.empty((0, 2, 3))
    return {"vertices": packed(points), "triangles": packed(corners, "<u4"), "traced": len(triangles), "shown": len(corners), "lines": packed(lines),
            "looks": [_look_data(look, shown_as, len(corners)) for look in shown]}


def _check(source: Source, asked: list[int]) -> None:
    looks = source.stored.S.shape[0]
    if len(asked) > _MOST_LOOKS:
        raise InputError(f"--looks: a report shows {_MOST_LOOKS} at most; leave out {len(asked) - _MOST_LOOKS}")
    for look in asked:
        if look >= looks:
            raise InputError(f"--looks {look}: {source.file} has {looks} look{'s' if looks > 1 else ''}, counted from 0; choose among these")


def _require_target(source: Source, target: dict[str, Any] | None) -> None:
    if target is None:
        raise InputError(f"--looks: {source.file} has no target: its case or mesh is not where the run had it, or has changed")
    if (target["looks"], target["frequencies"]) != source.stored.S.shape[:2]:
        raise InputError(f"{member(source.run, 'case_file')}: has other looks or frequencies than {source.file}; run it again")


def _solved(source: Source, look: int) -> dict[str, Any]:
    assert source.job is not None
    return _core.look_in_space(source.job, look, _MOST_CELLS) | {"look": look, "tubes": _core.tubes(source.job, look, _MOST_TUBES)}


def _with_tubes(source: Source, target: dict[str, Any] | None, kept: dict[str, Any]) -> dict[str, Any]:
    if source.job is None:
        return kept
    try:
        _require_target(source, target)
        return kept | {"tubes": _core.tubes(source.job, kept["look"], _MOST_TUBES)}
    except InputError as error:
        source.notes.append(f"Tubes: {error}.")
        return kept


def _strongest(source: Source, target: dict[str, Any]) -> list[dict[str, Any]]:
    looks, frequencies = source.stored.S.shape[:2]
    if (member(source.run, "time", "solve_s") or 0.0) / looks > _LONG_LOOK:
        source.notes.append("Colours of the target: a look takes long to solve; raytube report --looks I computes one.")
        return []
    try:
        _require_target(source, target)
        amplitude = np.abs(source.stored.S[:, frequencies // 2]).reshape(looks, 4)
        return [_solved(source, int(np.argmax(np.nan_to_num(amplitude.max(axis=1)))))]
    except InputError as error:
        source.notes.append(f"Colours of the target: {error}.")
        return []


# --- images that the run has kept ---


def _kept(source: Source) -> list[dict[str, Any]]:
    looks = member(source.run, "case", "output", "image_look")
    looks = [] if looks is None else looks if isinstance(looks, list) else [looks]
    if len(looks) > _MOST_LOOKS:
        source.notes.append(f"Looks in space: the first {_MOST_LOOKS} of {len(looks)} images; raytube report --looks chooses others.")
    found = []
    for look in looks[:_MOST_LOOKS]:
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


def _shift_of_perspective(head: str, u: _Floats, v: _Floats) -> _Floats:
    """From where a finite distance shows the middle of the target to where parallel rays would."""
    found = re.search(rf"Perspective from {_NUMBER} m before the middle of the target, \({_NUMBER}, {_NUMBER}, {_NUMBER}\)", head)
    if found is None:
        return np.zeros(2)
    distance, *middle = (float(text) for text in found.groups())
    along = np.array([u @ middle, v @ middle])
    shift: _Floats = along - along / (1.0 + (np.cross(u, v) @ middle) / distance)
    return shift


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


def shown_mesh(vertices: _Floats, triangles: _Corners, most: int) -> tuple[_Floats, _Corners, _Corners]:
    """A mesh of at most so many triangles: itself, or else one whose vertices are the means of those in each cell of a grid, the finest that is
    coarse enough; and for each triangle given that which stands for it. (Rossignac and Borrel, 1993: vertex clustering.)"""
    if len(triangles) <= most:
        return vertices, triangles, np.arange(len(triangles))
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    cell = 0.25 * np.sqrt(area / most)
    while True:
        coarse = _clustered(vertices, triangles, cell)
        if len(coarse[1]) <= most:
            return coarse
        cell *= 1.15


def _clustered(vertices: _Floats, triangles: _Corners, cell: float) -> tuple[_Floats, _Corners, _Corners]:
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

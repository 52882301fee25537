"""Meshes."""

from __future__ import annotations

import operator
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from raytube import _arguments, _core
from raytube._core import InputError


class Target:
    """A mesh, read once and prepared for rays once for every choice of materials and creases: solve it as often as you like.

    Parameters
    ----------
    vertices : array of float, shape (vertices, 3)
        Coordinates in `unit`.
    faces : array of int, shape (faces, 3) or wider
        Corners of each polygon, counted from 0; polygons with fewer corners than the widest end with -1. Lists of different lengths
        work as well.
    unit : {"m", "cm", "mm", "um", "in", "ft"}
        Length of one unit of the mesh. There is no default: a wrong unit is the most common error.
    parts : sequence of str, or dict of str to sequence of int, optional
        The name of the part that each face belongs to, or the faces of each part. `solve` gives materials to parts by these names.

    Raises
    ------
    InputError
        For arrays of another shape, coordinates that are not finite, and corners that are not vertices. `check` reports whatever else is
        wrong with a mesh.

    See Also
    --------
    Target.load : reads a file.
    """

    def __init__(self, vertices: ArrayLike, faces: Any, unit: str, parts: Sequence[str] | Mapping[str, Any] | None = None) -> None:
        corners = _corners(faces)
        names = _names(parts, len(corners) if corners.ndim else 0)
        self._core = _core.Target.of_arrays(_arguments.numbers(vertices, "vertices"), corners, names, _unit(unit))

    @classmethod
    def load(cls, file: str | os.PathLike[str] | Sequence[str | os.PathLike[str]], unit: str) -> Target:
        """Reads a mesh file, or several as one target.

        Parameters
        ----------
        file : path or sequence of paths
            In any of the formats that a case takes (STL, OBJ, PLY, OFF and more, also compressed: ``.gz``).
        unit : {"m", "cm", "mm", "um", "in", "ft"}
            Length of one unit of the mesh.

        Returns
        -------
        Target

        Raises
        ------
        InputError
            If a file cannot be read: one sentence with file, line and remedy.
        """
        files = file if isinstance(file, (tuple, list)) else [file]
        target = cls.__new__(cls)
        target._core = _core.Target.of_files([_arguments.path(name, "Target.load") for name in files], _unit(unit))
        return target

    @property
    def unit(self) -> str:
        """Length of one unit of the mesh."""
        return self._core.unit

    @property
    def parts(self) -> list[str]:
        """Names of parts, to which `solve` can give materials."""
        return self._core.parts

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Coordinates in `unit`, shape (vertices, 3): a copy."""
        return self._core.vertices

    @property
    def faces(self) -> list[list[int]]:
        """Corners of each polygon."""
        return self._core.polygons

    def __len__(self) -> int:
        """Number of polygons."""
        return self._core.facets

    def __copy__(self) -> Target:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Target:
        return self  # it never changes

    def __repr__(self) -> str:
        size = " x ".join(f"{length:.4g}" for length in np.ptp(self.vertices, axis=0))
        return f"Target: {self._core.name}, {len(self)} facets, {size} {self.unit}"


def _unit(unit: Any) -> str:
    return unit if isinstance(unit, str) else repr(unit)  # the core checks it


def _corners(faces: Any) -> NDArray[np.int64]:
    try:
        array = np.asarray(faces)
    except ValueError:  # polygons of different lengths
        array = np.empty(0, object)
    if array.dtype != object:
        if array.size and (array.dtype.kind not in "iu" or array.max() > np.iinfo(np.int64).max):
            raise InputError("faces: corners are whole numbers, counted from 0; give an array of integers")
        return array.astype(np.int64)
    try:
        polygons = [[operator.index(corner) for corner in face] for face in faces]
        widest = max(map(len, polygons))
        return np.array([polygon + [-1] * (widest - len(polygon)) for polygon in polygons], dtype=np.int64)
    except (TypeError, ValueError, OverflowError):
        raise InputError("faces: give the corners of each face, whole numbers counted from 0") from None


def _names(parts: Any, faces: int) -> list[str]:
    if parts is None:
        return []
    if isinstance(parts, Mapping):
        return _names_of_members(parts, faces)
    if isinstance(parts, (str, bytes)) or np.ndim(parts) != 1:
        raise InputError("parts: give the name of each face's part, or a dictionary with the faces of each part")
    if len(parts) != faces:
        raise InputError(f"parts: {len(parts)} names for {faces} faces; give one for each, or the faces of each part")
    return [_arguments.text(name, "parts") for name in parts]


def _names_of_members(parts: Mapping[Any, Any], faces: int) -> list[str]:
    names = [""] * faces
    for name, members in parts.items():
        array = np.atleast_1d(np.asarray(members))
        if array.ndim != 1 or (array.size and array.dtype.kind not in "iu"):
            raise InputError(f"parts: {name!r} wants the numbers of its faces, counted from 0 (found {members!r:.40})")
        for face in array:
            if not 0 <= face < faces:
                raise InputError(f"parts: {name!r} has the face {face}, but there are {faces}, counted from 0")
            names[face] = _arguments.text(name, "parts")
    return names

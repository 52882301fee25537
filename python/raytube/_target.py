"""Meshes."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from raytube import _core
from raytube._core import InputError


class Target:
    """A mesh, read once and made ready for rays once for every choice of materials and creases: solve it as often as you like.

    Parameters
    ----------
    vertices : array of float, shape (vertices, 3)
        Coordinates in `unit`.
    faces : array of int, shape (faces, 3) or wider
        Corners of each polygon, counted from 0; a polygon with fewer corners than the widest ends with -1. Lists of different lengths
        will do.
    unit : {"m", "cm", "mm", "um", "in", "ft"}
        Length of one unit of the mesh. There is no default: a wrong unit is the commonest error.
    parts : sequence of str, or dict of str to sequence of int, optional
        The name of the part that each face belongs to, or the faces of each part. `solve` gives materials to parts by these names.

    Raises
    ------
    InputError
        For arrays of another shape, and for corners that are no vertices. What else is wrong with a mesh, `check` reports.

    See Also
    --------
    Target.load : reads a file.
    """

    def __init__(self, vertices: ArrayLike, faces: Any, unit: str, parts: Sequence[str] | Mapping[str, Sequence[int]] | None = None):
        corners = _rectangular(faces)
        names = _names(parts, len(corners))
        self._core = _core.Target.of_arrays(np.asarray(vertices, dtype=float), corners, names, unit)

    @classmethod
    def load(cls, file: str | os.PathLike | Sequence[str | os.PathLike], unit: str) -> Target:
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
        files = [file] if isinstance(file, (str, os.PathLike)) else list(file)
        target = cls.__new__(cls)
        target._core = _core.Target.of_files([os.fspath(name) for name in files], unit)
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
    def vertices(self) -> np.ndarray:
        """Coordinates in `unit`, shape (vertices, 3): a copy."""
        return self._core.vertices

    @property
    def faces(self) -> list[list[int]]:
        """Corners of each polygon."""
        return self._core.polygons

    def __len__(self) -> int:
        """Number of polygons."""
        return self._core.facets

    def __repr__(self) -> str:
        return f"Target: {self._core.name}, {len(self)} facets, unit {self.unit}"


def _rectangular(faces: Any) -> np.ndarray:
    try:
        array = np.asarray(faces)
    except ValueError:
        array = np.asarray(faces, dtype=object)
    if array.dtype != object:
        if array.size and not np.issubdtype(array.dtype, np.integer):
            raise InputError("faces: corners are whole numbers; give an array of integers")
        return array.astype(np.int64)
    widest = max(len(face) for face in faces)
    return np.array([list(face) + [-1] * (widest - len(face)) for face in faces], dtype=np.int64)


def _names(parts: Any, faces: int) -> list[str]:
    if parts is None:
        return []
    if isinstance(parts, Mapping):
        names = [""] * faces
        for name, members in parts.items():
            for face in members:
                if not 0 <= face < faces:
                    raise InputError(f"parts: {name!r} has the face {face}, but there are {faces}, counted from 0")
                names[face] = name
        return names
    if len(parts) != faces:
        raise InputError(f"parts: {len(parts)} names for {faces} faces; give one for each, or the faces of each part")
    return [str(name) for name in parts]

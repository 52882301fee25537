"""The target of a result, and how it looks from one side."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from raytube import _core

Floats = NDArray[np.float64]
Outline = tuple[Floats, Floats, NDArray[np.float32]]  # points as wide as the target, its edges, its triangles [m]
_PIXELS = 1600  # of a silhouette along its longer side


def target_of_run(run: dict[str, Any]) -> Outline | None:
    """The target of a run, if its case and its meshes are where the run had them, and still the same."""
    job = _core.job_of_run(json.dumps(run))
    return None if job is None else _core.outline(job)


def drawn_lines(outline: Outline, plane: Any) -> tuple[Floats, int]:
    """Edges of a target, and then its silhouette in the plane of two unit vectors: ends of lines (n, 2, 3); how many of it there are."""
    silhouette = _silhouette(outline[2] @ np.asarray(plane).T) @ np.asarray(plane)
    return np.concatenate([outline[1], silhouette]), len(silhouette)


def _silhouette(triangles: NDArray[Any]) -> Floats:
    """The border of the union of triangles (n, 3, 2) in a plane: ends of lines (m, 2, 2)."""
    try:
        from contourpy import contour_generator
        from PIL import Image, ImageDraw
    except ImportError:  # they come with matplotlib, without which nothing is drawn
        return np.empty((0, 2, 2))
    low = triangles.reshape(-1, 2).min(axis=0)
    extent = triangles.reshape(-1, 2).max(axis=0) - low
    pixel = max(float(extent.max()), 1e-12) / _PIXELS
    image = Image.new("L", tuple(int(n) + 5 for n in extent / pixel))
    draw = ImageDraw.Draw(image)
    for corners in ((triangles - low) / pixel + 2.0).reshape(-1, 6).tolist():
        draw.polygon(corners, fill=1, outline=1)
    lines = contour_generator(z=np.asarray(image, dtype=float)).lines(0.5)
    ends = [np.stack([line[:-1], line[1:]], axis=1) for line in map(_straightened, lines)]
    found: Floats = np.concatenate([np.empty((0, 2, 2)), *ends]) * pixel + low - 2.0 * pixel
    return found


def _straightened(line: Floats) -> Floats:
    """A border without the steps of its pixels: means of its points over a few neighbours, some left out."""
    closed = np.concatenate([line[-4:-1], line, line[1:4]])
    smooth = np.stack([np.convolve(closed[:, k], np.full(7, 1 / 7), mode="valid") for k in (0, 1)], axis=1)
    return np.concatenate([smooth[:-1:3], smooth[:1]])

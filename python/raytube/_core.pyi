"""Types of what the package calls in C++."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

class InputError(ValueError): ...

class Target:
    name: str
    unit: str
    meshes: list[str]
    parts: list[str]
    facets: int
    vertices: NDArray[np.float64]
    polygons: list[list[int]]
    @staticmethod
    def of_files(files: Sequence[str], unit: str, /) -> Target: ...
    @staticmethod
    def of_arrays(vertices: NDArray[np.float64], faces: NDArray[np.int64], names: Sequence[str], unit: str, /) -> Target: ...

class Job:
    title: str

class Ranks:
    leads: bool
    def give_up(self, sentence: str, is_input: bool, wait: bool, /) -> None: ...

class Stored:
    frequency_hz: NDArray[np.float64]
    theta_deg: NDArray[np.float64]
    phi_deg: NDArray[np.float64]
    rx_theta_deg: NDArray[np.float64]
    rx_phi_deg: NDArray[np.float64]
    range_m: NDArray[np.float64]
    rx_range_m: NDArray[np.float64]
    bistatic: bool
    comment: str
    S: NDArray[np.complex128]
    sigma_dbsm: NDArray[np.float64]
    error_db: NDArray[np.float64]
    model_db: NDArray[np.float64]
    error_m: NDArray[np.float64] | None
    model_m: NDArray[np.float64] | None
    parts: dict[str, NDArray[np.complex128]]
    model_parts: dict[str, NDArray[np.float64]]
    incoherent_m2: NDArray[np.float64] | None
    attributes: dict[str, str]
    @staticmethod
    def from_arrays(frequency_hz: NDArray[np.float64], looks: NDArray[np.float64], bistatic: bool, s: NDArray[np.complex128],
                    attributes: Sequence[tuple[str, str]], /) -> Stored: ...
    @staticmethod
    def read_netcdf(file: str, /) -> Stored: ...
    @staticmethod
    def read_csv(file: str, /) -> Stored: ...
    def write_netcdf(self, file: str, /) -> None: ...
    def write_csv(self, file: str, /) -> None: ...

class Table:
    @staticmethod
    def of_file(file: str, columns: str, name: str, /) -> Table: ...
    @staticmethod
    def of_stored(stored: Stored, name: str, /) -> Table: ...

class Comparison:
    text: str
    rows: int
    channels: dict[str, dict[str, float]]
    relative_error: float
    def above_tolerance(self, tolerance_db: float, /) -> str: ...

class NamedFile:
    def __init__(self, file: str, columns: str, name: str, /) -> None: ...

class ImageComparison:
    text: str
    rows: int
    channels: dict[str, dict[str, float]]
    relative_error: float
    shift: tuple[float, float]
    def above_tolerance(self, tolerance_db: float, /) -> str: ...

def all_threads() -> int: ...
def job_of_file(file: str, overrides: Sequence[str], /) -> Job: ...
def job_of_target(target: Target, values: dict[str, Any], name: str, looks: NDArray[np.float64] | None, bistatic: bool, /) -> Job: ...
def ranks_of(communicator: int, folder: str, /) -> Ranks: ...
def solve(job: Job, threads: int, parts: bool, progress: Callable[[float], Any] | None, ranks: Ranks | None, /) -> Stored | None: ...
def check(job: Job, threads: int, /) -> tuple[str, dict[str, Any]]: ...
def image(job: Job, look: int, per_wavelength: float, threads: int, progress: Callable[[float], Any] | None,
          /) -> tuple[float, list[float], list[float], NDArray[np.complex128]]: ...
def centres(job: Job, look: int, count: int, resolution: float, threads: int, progress: Callable[[float], Any] | None, /) -> dict[str, Any]: ...
def trace(job: Job, look: int, u: float, v: float, /) -> dict[str, Any]: ...
def converge(job: Job, densities: Sequence[float], threads: int, progress: Callable[[float], Any] | None, ranks: Ranks | None,
             /) -> tuple[str, dict[str, Any]] | None: ...
def sidelobe_limits_db() -> tuple[float, float]: ...
def outline(job: Job, /) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def range_profiles(result: Stored, look: int | None, outermost: list[list[float]], window: str, sidelobe_db: float, padding: int,
                   /) -> dict[str, Any]: ...
def isar(result: Stored, outermost: list[list[float]], size: list[float], pixels: float, window: str, sidelobe_db: float,
         /) -> tuple[list[dict[str, Any]], NDArray[np.complex128]]: ...
def compare(result: Table, reference: Table, only: Mapping[str, tuple[float, float]], within_db: float, free_scale: bool, /) -> Comparison: ...
def are_images(result: NamedFile, reference: NamedFile, /) -> bool: ...
def compare_images(result: NamedFile, reference: NamedFile, within_db: float, free_scale: bool, registered: bool, /) -> ImageComparison: ...

"""Tables and what stands beside them: reading, rows that a user chooses, numbers as text, writing."""

from __future__ import annotations

import itertools
import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from raytube import _arguments
from raytube._arguments import CHANNELS
from raytube._core import InputError

if TYPE_CHECKING:
    from pandas import DataFrame

    from raytube._core import Stored

Floats = NDArray[np.float64]
KEYS = ("freq_hz", "theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg", "time_s")  # the last one of scenes that move
_MECHANISMS = {"bounce_3_on": "bounce 3 and later", "edges_order_1": "edges, order 1", "edges_order_2_on": "edges, orders 2 and 3",
               "material_edges_order_1": "edges of materials, order 1", "material_edges_order_2_on": "edges of materials, orders 2 and 3",
               "interaction": "edge–face interaction", "surface_waves": "waves over curved surfaces"}
Range = tuple[str, float, float]  # column, lowest, highest


def dbsm(amplitude: Any) -> Floats:
    """Levels of amplitudes in metres."""
    with np.errstate(divide="ignore"):
        return np.asarray(20.0 * np.log10(np.abs(amplitude)) + 10.0 * np.log10(4.0 * np.pi))


def largest_of_blocks(values: NDArray[Any], axis: int, most: int) -> tuple[NDArray[Any], int]:
    """At most this many blocks along an axis, each as large as the largest of its values, and their length."""
    size = max(1, -(-values.shape[axis] // most))
    return np.fmax.reduceat(values, np.arange(0, values.shape[axis], size), axis), size


def keys_of(stored: Stored) -> Floats:
    """`KEYS` of the rows of a result, frequency fastest."""
    looks, frequencies = stored.S.shape[:2]
    angles = (np.repeat(getattr(stored, name), frequencies) for name in KEYS[1:])
    return np.column_stack([np.tile(stored.frequency_hz, looks), *angles])


def comments(file: str | Path) -> list[str]:
    """The lines before a table, without their #."""
    with open(file, encoding="utf-8", errors="replace") as stream:
        return [line[1:].strip() for line in itertools.takewhile(lambda line: line.startswith("#"), stream)]


def read_csv(file: str | Path) -> DataFrame:
    """A table written by the program, by its columns."""
    import pandas

    try:
        return pandas.read_csv(file, skiprows=len(comments(file)), float_precision="round_trip")
    except (ValueError, UnicodeDecodeError) as error:
        raise InputError(f"{file} is not the table that its header promises ({error}); write it again") from None


def header_of(file: str) -> list[str]:
    """Names of the columns of a table, or of the variables of a netCDF file; none for what is neither."""
    if file.lower().endswith(".nc"):
        import xarray as xr

        try:
            with xr.open_dataset(file) as stored:
                return [*map(str, stored.variables), *map(str, stored.dims)]
        except (OSError, ValueError):
            return []
    with open(file, encoding="utf-8", errors="replace") as stream:
        return next((line.strip().split(",") for line in stream if line.strip() and not line.startswith("#")), [])


def amplitudes_of(table: Any, suffix: str = "") -> NDArray[np.complex128]:
    """S [m] of the rows of a table, (row, channel)."""
    return np.stack([table[f"re_{c}{suffix}"].to_numpy() + 1j * table[f"im_{c}{suffix}"].to_numpy() for c in CHANNELS], axis=-1)


def mechanisms_of(table: Any) -> dict[str, NDArray[np.complex128]]:
    """S [m] by mechanism, (row, channel), in a table such as parts.csv."""
    return {name: amplitudes_of(table, f"_{name}") for name in (name[6:] for name in table.columns if name.startswith("re_vv_"))}


def centres_of(file: str | Path) -> tuple[tuple[float, float, float, float], DataFrame]:
    """Polar angle, azimuth [deg], frequency [Hz] and resolution [m] of centres.csv, and its rows."""
    table, number = read_csv(file), r"([-+.\deE]+)"
    head = re.search(rf"look theta {number}, phi {number} degrees at {number} Hz, resolved to cubes \w+ {number} m", " ".join(comments(file)))
    if not head or not {"centre", "mechanism", "part", "x_m", "persistence_ghz", "re_vv"} <= set(table):
        raise InputError(f"{file} is not as raytube centres writes it; run raytube centres again, or delete the file")
    theta, phi, hertz, side = map(float, head.groups())
    return (theta, phi, hertz, side), table


def result_file(given: str) -> Path:
    """The result in a folder of a run, or the file itself. Raises InputError where there is none."""
    path = Path(given)
    if not path.exists():
        raise InputError(f"{given}: does not exist; give the folder of a run, or its rcs.csv or netCDF file")
    if not path.is_dir():
        if path.suffix.lower() == ".toml":
            raise InputError(f"{given}: is a case, not a result; run it first (raytube run)")
        return path
    found = [path / name for name in ("rcs.csv", "rcs.nc") if (path / name).is_file()]
    if not found:
        raise InputError(f"{given}: holds neither rcs.csv nor rcs.nc; give the folder of a raytube run")
    return found[0]


def run_of(file: str) -> dict[str, Any]:
    """``run.json`` beside a result, if it describes the result or the table that is there with it; else nothing."""
    folder = Path(file).resolve().parent
    try:
        run: dict[str, Any] = json.loads((folder / "run.json").read_bytes())
        table = folder / "rcs.csv"
        alike = sha256(table.read_bytes()).hexdigest() == run.get("rcs_csv_sha256") if table.exists() else True
    except (OSError, ValueError, AttributeError):
        return {}
    return run if alike else {}


def mechanism_text(name: str) -> str:
    """A mechanism in words, by its name in files."""
    return _MECHANISMS.get(name, name.replace("_", " "))


def number_text(value: float) -> str:
    """The shortest text that reads back as the same number; "0" for both zeros."""
    return repr(float(value)).removesuffix(".0") if value else "0"


def cell_text(value: float, form: str) -> str:
    """A number in a printed table."""
    return "-" if math.isnan(value) else format(value, form)


def json_numbers(values: Mapping[str, Any]) -> dict[str, Any]:
    """JSON has no infinities, and no undefined numbers."""
    return {name: None if isinstance(value, float) and not math.isfinite(value) else value for name, value in values.items()}


def write_table(file: Path, comments: Iterable[str], columns: Sequence[str], rows: Iterable[Iterable[Any]]) -> None:
    """Texts stand in the file as they are, numbers in their shortest form."""
    with open(file, "w", encoding="utf-8") as out:
        out.writelines(f"# {''.join(c if c >= ' ' else ' ' for c in comment)}\n" for comment in comments)
        out.write(",".join(columns) + "\n")
        out.writelines(",".join(cell if isinstance(cell, str) else number_text(cell) for cell in row) + "\n" for row in rows)


def require_free(folder: str, names: Iterable[str], inputs: Iterable[str]) -> None:
    """Refuses results that would replace what is read."""
    for file in inputs:
        if Path(file).resolve() in [Path(folder, name).resolve() for name in names]:
            raise InputError(f"-o {folder}: a result would replace {file}, which is read; name another folder")
    if Path(folder).exists() and not Path(folder).is_dir():
        raise InputError(f"-o {folder}: is a file; name a folder")


def is_coarse(warnings: list[str]) -> bool:
    """Whether a run warns that its steps are wider than the target's lobes."""
    return any(str(warning).startswith("sampling:") and "lobes" in warning for warning in warnings)  # others: too wide for range profiles


def ranges_of_options(options: Iterable[str]) -> list[Range]:
    """``--only`` COLUMN=VALUE or COLUMN=LOW:HIGH."""
    only = [option.partition("=")[::2] for option in options]
    try:
        return [_range(column, [float(end) for end in text.split(":")], KEYS) for column, text in only]
    except (InputError, ValueError):
        raise InputError(f"--only {' '.join(map('='.join, only))}: write COLUMN=VALUE or COLUMN=LOW:HIGH with {', '.join(KEYS[:-1])} or {KEYS[-1]}, "
                         "for example --only phi_deg=-45:45") from None


def ranges_of(only: Mapping[str, Any] | None) -> list[Range]:
    """``{"phi_deg": (-45, 45), "freq_hz": 10e9}``."""
    return [_range(_arguments.text(key, "only"), _arguments.numbers(value, f"only: {key}")) for key, value in _arguments.table(only or {}, "only").items()]


def _range(column: str, ends: Any, known: Sequence[str] = ()) -> Range:
    ends = np.atleast_1d(ends)
    if (known and column not in known) or ends.shape not in ((1,), (2,)) or not ends[0] <= ends[-1]:
        raise InputError(f"only: {column}: give a value, or the lowest and the highest one")
    return column, float(ends[0]), float(ends[-1])


def chosen_rows(keys: Floats, has_key: Sequence[bool], ranges: Iterable[Range], file: str) -> NDArray[np.bool_]:
    """Rows in all ranges, ends included; an azimuth may lie there by full turns, which are then taken off it in `keys`."""
    chosen = np.ones(len(keys), bool)
    for column, low, high in ranges:
        if column not in KEYS:
            raise InputError(f"only: there is no column {column}; choose among {', '.join(KEYS)}")
        if not has_key[KEYS.index(column)]:
            raise InputError(f"--only {column}: {file} has no such column; leave the option out")
        values = keys[:, KEYS.index(column)]
        slack = 1e-12 * high if column == "freq_hz" else 1e-9  # 0.1 + 0.2 is not 0.3
        outside = (values < low - slack) | (values > high + slack)
        if column.endswith("phi_deg"):
            values[outside] -= 360.0 * np.floor((values[outside] - low + slack) / 360.0)
        chosen &= (values >= low - slack) & (values <= high + slack)
        if not chosen.any():
            raise InputError(f"{file}: no row has {column} from {number_text(low)} to {number_text(high)}; widen --only")
    return chosen

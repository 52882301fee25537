"""Arguments of callers in the form that the core takes; one sentence for any other."""

from __future__ import annotations

import operator
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from raytube._core import InputError

CHANNELS = ("vv", "vh", "hv", "hh")


def kind_of(value: Any) -> str:
    """The type of a value, for messages."""
    return "None" if value is None else type(value).__name__


def whole(value: Any, name: str, most: int = 2**31 - 1) -> int:
    """A whole number, 0 or more."""
    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{name}: give a whole number (found {kind_of(value)})") from None
    if isinstance(value, (bool, np.bool_)) or not 0 <= number <= most:
        raise InputError(f"{name}: give a whole number from 0 to {most} (found {value!r:.40})")
    return number


def number(value: Any, name: str) -> float:
    """A finite number."""
    try:
        result = float(value) if not isinstance(value, (str, bytes, bytearray)) else np.nan
    except (TypeError, ValueError, OverflowError):
        result = np.nan
    if not np.isfinite(result):
        raise InputError(f"{name}: give a finite number (found {value!r:.40})")
    return result


def numbers(value: Any, name: str) -> npt.NDArray[np.float64]:
    """An array of numbers, which need not be finite, of any shape."""
    try:
        array = np.asarray(value)
        masked = isinstance(value, np.ma.MaskedArray) and np.any(value.mask)  # a Series has a method of that name
        if array.dtype.kind not in "iufO" or masked or (array.dtype == object and None in array.ravel().tolist()):
            raise TypeError
        return array.astype(float)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name}: give numbers, or an array or list of them with rows of one length (found {kind_of(value)})") from None


def flag(value: Any, name: str) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise InputError(f"{name}: give True or False (found {kind_of(value)})")
    return bool(value)


def text(value: Any, name: str) -> str:
    """A text."""
    if not isinstance(value, str):
        raise InputError(f"{name}: give a text (found {kind_of(value)})")
    return value


def path(value: Any, name: str) -> str:
    """The name of a file or folder."""
    if not isinstance(value, (str, os.PathLike)):
        raise InputError(f"{name}: give the path of a file (found {kind_of(value)})")
    file = os.fsdecode(value)
    if not file or "\0" in file:
        raise InputError(f"{name}: {file!r} names no file")
    return file


def table(value: Any, name: str) -> dict[Any, Any]:
    """A dictionary."""
    if not isinstance(value, Mapping):
        raise InputError(f"{name}: give a dictionary (found {kind_of(value)})")
    return dict(value)


def channels(value: Any, name: str) -> tuple[str, ...]:
    """Names of channels in lower case; a single one may stand alone."""
    chosen = (value,) if isinstance(value, str) else tuple(value) if isinstance(value, (tuple, list)) else ()
    lower = tuple(str(channel).lower() for channel in chosen)
    if not lower or any(channel not in CHANNELS for channel in lower):
        raise InputError(f"{name}: channels are {', '.join(CHANNELS)}; give one or several of these (found {value!r:.60})")
    return lower

"""Processes that share a solve: the ranks of a communicator of mpi4py."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol

from raytube import _arguments, _core
from raytube._core import InputError


class Communicator(Protocol):
    """An intracommunicator of mpi4py."""

    def py2f(self) -> int:
        """Its handle in Fortran."""


def leads(ranks: _core.Ranks | None) -> bool:
    """Whether this process has the result."""
    return ranks is None or ranks.leads


def ranks_of(comm: Any) -> _core.Ranks | None:
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
def telling(ranks: _core.Ranks | None) -> Iterator[None]:
    """What befalls this rank before it meets the others, these raise, too, and wait for nothing."""
    try:
        yield
    except BaseException as error:
        if ranks is not None:
            ranks.give_up(str(error) or type(error).__name__, isinstance(error, InputError), isinstance(error, Exception))
        raise

"""Rank 0 and the others: handing out work, and failing together.

An error on one rank is raised on all of them; or the others would wait for that rank for ever.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm


T = TypeVar("T")


def on_root(comm: Intracomm, work: Callable[[], T]) -> T | None:
    """The result of work that rank 0 does, None on the other ranks; its error is everyone's."""
    result, error = _attempt(work) if comm.rank == 0 else (None, None)
    error = comm.bcast(error)
    if error is not None:
        raise error
    return result


def on_every_rank(comm: Intracomm, work: Callable[[], T]) -> T:
    """The result of work that every rank does without the others; an error is everyone's."""
    return _agreed(comm, *_attempt(work))


def scatter(comm: Intracomm, make: Callable[[int], T] | None) -> T:
    """``make(rank)`` on each rank, made on rank 0 and sent; an error is everyone's.

    One object after the other: rank 0 never holds those of the others together.

    Parameters
    ----------
    make : callable
        On rank 0; the other ranks may pass None.
    """
    # Sends buffers as they are, without a pickled copy, and of more than 2 GiB.
    from mpi4py.util import pkl5

    channel = pkl5.Intracomm(comm)
    if comm.rank > 0:
        return _agreed(comm, *channel.recv(source=0))
    assert make is not None
    for rank in range(1, comm.size):
        channel.send(_attempt(lambda: make(rank)), rank)  # noqa: B023  (it is called at once)
    return _agreed(comm, *_attempt(lambda: make(0)))


def gathered_on_root(comm: Intracomm, mine: T) -> list[T] | None:
    """What each rank has, on rank 0; None on the others."""
    from mpi4py.util import pkl5

    return pkl5.Intracomm(comm).gather(mine)


def _attempt(work: Callable[[], T]) -> tuple[T | None, Exception | None]:
    try:
        return work(), None
    except Exception as error:
        return None, _portable(error)


def _portable(error: Exception) -> Exception:
    """The error, or one that says the same if it cannot be sent to other ranks."""
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        return RuntimeError(f"{type(error).__name__}: {error}")
    return error


def _agreed(comm: Intracomm, result: T | None, error: Exception | None) -> T:
    for failure in comm.allgather(error):
        if failure is not None:
            raise failure
    assert result is not None, "work without an error has a result"
    return result

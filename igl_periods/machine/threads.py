"""Threads of linear algebra: only one where callers work in parallel, none that a fork left behind.

BLAS has one number of threads for the process.  Whoever wants it to be one holds it there
(:func:`one_thread`); the number returns to what it was when the last holder lets go, however the
calls of different threads overlap.  OpenMP has a number for each thread that asks.

Threads wait for each other at the end of every product or factor, and turn round while they wait.
Where other processes are busy, one of them waits until the other gets its turn, some milliseconds:
ten times as long as a small product takes.  So only large ones are divided (:func:`threads_for`).

A process that was forked has the books of its parent about threads of OpenMP, but not the threads:
waiting for them would take for ever.  There the thread that was forked works alone
(:func:`without_lost_threads`): no level of parallel regions may be active, which also holds for
regions that ask for a number of threads, as those of CHOLMOD do.  Threads started later have books
of their own.
"""

from __future__ import annotations

import os
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Sized
from contextlib import contextmanager
from functools import cache, wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

import threadpoolctl
from threadpoolctl import ThreadpoolController

M = TypeVar("M", bound=Sized)
P = ParamSpec("P")
R = TypeVar("R")

# Operations from which on threads gain more than they lose beside other processes: 0.1 s of one.
_WORTH_THREADS = 1e9


@cache
def _libraries(user_api: str) -> ThreadpoolController:
    # Of one kind: limits restore the numbers of all libraries that they know of.
    return ThreadpoolController().select(user_api=user_api)


def _let_any_thread_change_blas() -> None:
    """Newer threadpoolctl leaves BLAS to the thread that changed it last; holders take turns."""
    clear = getattr(
        getattr(threadpoolctl, "OpenBLASController", None), "clear_controlling_thread", None
    )
    if clear is not None:
        clear(force=True)


class _SharedLimit:
    """The limit of BLAS to one thread, held by any number of threads, each as often as it likes."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._holders: Counter[int] = Counter()
        self._limit: Any = None

    def hold(self) -> None:
        with self._lock:
            if not self._holders:
                _let_any_thread_change_blas()
                self._limit = _libraries("blas").limit(limits=1)
            self._holders[threading.get_ident()] += 1

    def release(self) -> None:
        with self._lock:
            me = threading.get_ident()
            self._holders[me] -= 1
            if not self._holders[me]:
                del self._holders[me]
            if not self._holders:
                self._restore()

    def forget_other_threads(self) -> None:
        """In a child: only the thread that was forked is left."""
        self._lock = threading.Lock()
        held, me = bool(self._holders), threading.get_ident()
        self._holders = Counter({me: self._holders[me]} if me in self._holders else {})
        if held and not self._holders:
            self._restore()

    def _restore(self) -> None:
        _let_any_thread_change_blas()
        self._limit.restore_original_limits()
        _let_any_thread_change_blas()


_blas = _SharedLimit()
# The thread that was forked, in a process that was.
_orphan: int | None = None


@contextmanager
def one_thread() -> Iterator[None]:
    """Linear algebra with one thread: for callers that work in parallel themselves."""
    _blas.hold()
    try:
        with _libraries("openmp").limit(limits=1):
            yield
    finally:
        _blas.release()


@contextmanager
def threads_for(operations: float) -> Iterator[None]:
    """All threads that BLAS has for a large piece of linear algebra, one for a small one.

    Parameters
    ----------
    operations : float
        How many floating-point operations there are before all threads have to meet again.
    """
    if operations < _WORTH_THREADS:
        with one_thread():
            yield
    else:
        yield


def threads_by_size(function: Callable[Concatenate[M, P], R]) -> Callable[Concatenate[M, P], R]:
    """A function of a square matrix with :func:`threads_for` its size; a decorator."""

    @wraps(function)
    def with_threads(matrix: M, /, *args: P.args, **kwargs: P.kwargs) -> R:
        with threads_for(2.0 * len(matrix) ** 3):
            return function(matrix, *args, **kwargs)

    return with_threads


@contextmanager
def without_lost_threads() -> Iterator[None]:
    """OpenMP without the threads that a fork left behind; elsewhere nothing changes."""
    runtimes = _openmp_runtimes() if threading.get_ident() == _orphan else []
    levels = [runtime.omp_get_max_active_levels() for runtime in runtimes]
    for runtime in runtimes:
        runtime.omp_set_max_active_levels(0)
    try:
        yield
    finally:
        for runtime, level in zip(runtimes, levels, strict=True):
            runtime.omp_set_max_active_levels(level)


def _openmp_runtimes() -> list[Any]:
    libraries = [library.dynlib for library in _libraries("openmp").lib_controllers]
    return [library for library in libraries if hasattr(library, "omp_set_max_active_levels")]


def _after_fork() -> None:
    global _orphan
    _orphan = threading.get_ident()
    _blas.forget_other_threads()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)

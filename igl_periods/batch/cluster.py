"""Files computed on a cluster of workers, with :mod:`dask.distributed`.

A worker that dies, whatever the reason, is replaced, and what it was doing is done again elsewhere.
A file whose workers die repeatedly is a suspect only, for it had neighbours that may have taken
the memory or caused the crash: it is handed back, to be tried alone.
"""

from __future__ import annotations

import gc
import logging
import queue
import signal
import traceback
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from multiprocessing import resource_tracker
from pathlib import Path
from typing import Any

import dask
from distributed import Client, Future, KilledWorker, LocalCluster
from distributed import TimeoutError as DaskTimeoutError
from distributed.utils import silence_logging_cmgr

from igl_periods.errors import BatchError

from .rows import BatchOptions, Row, compute_file, refused_row

Rows = list[Row]
# The name of a file, and its rows or the number of workers that died on it.
Outcome = tuple[str, Rows | int]
# What decides the rows, and what the cluster speaks: the same everywhere, or rows could differ.
_SAME_VERSIONS = (
    "igl_periods",
    "libigl",
    "numpy",
    "python-flint",
    "scikit-sparse",
    "scipy",
    "dask",
    "distributed",
)
_CONFIG = {
    # One task at a time is in the hands of a worker, so that no other one dies with it.
    "distributed.scheduler.worker-saturation": 1.0,
    "distributed.scheduler.work-stealing": False,
    "distributed.scheduler.allowed-failures": 1,
    # A factorisation may keep the interpreter busy for minutes; the process that started the
    # worker sees if it ends.
    "distributed.scheduler.worker-ttl": None,
    # A worker that is slow to come back after its death, or dies again, is not given up.
    "distributed.deploy.lost-worker-timeout": "1000 days",
    # Nothing large is stored on workers: they have no reason to pause or to write to disk.
    "distributed.worker.memory.target": False,
    "distributed.worker.memory.spill": False,
    "distributed.worker.memory.pause": False,
    "distributed.worker.memory.terminate": 0.95,
    "distributed.worker.profile.enabled": False,
    "distributed.nanny.pre-spawn-environ.OMP_NUM_THREADS": 1,
    "distributed.nanny.pre-spawn-environ.MKL_NUM_THREADS": 1,
    "distributed.nanny.pre-spawn-environ.OPENBLAS_NUM_THREADS": 1,
    "distributed.nanny.pre-spawn-environ.DASK_LOGGING__DISTRIBUTED": "critical",
}
_POLL = 1.0
# How long a cluster may have no worker at all, in seconds.
_PATIENCE = 120.0
# How long to wait for a scheduler, and for a first worker of it.
_CONNECTING = 15.0


@contextmanager
def local_cluster(workers: int) -> Iterator[Client]:
    """A cluster of processes on this machine, with one thread each and equal parts of its memory.

    Parameters
    ----------
    workers : int
        How many processes.
    """
    with dask.config.set(_CONFIG), _interrupts_blocked() as allow_interrupts:
        cluster = LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            silence_logs=logging.CRITICAL,
            dashboard_address=None,
            # Where the scheduler answers requests about its health: any port that is free.
            scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},
        )
        try:
            with Client(cluster, set_as_default=False) as client:
                allow_interrupts()
                yield client
                if workers:
                    # A worker that is just being started anew cannot be closed in order.
                    with suppress(DaskTimeoutError):
                        client.wait_for_workers(workers, timeout=_CONNECTING)
        finally:
            # All that counts has arrived; what cannot be closed ends with this process.
            with suppress(Exception):
                cluster.close()


@contextmanager
def remote_cluster(address: str) -> Iterator[Client]:
    """A cluster that runs already.

    Parameters
    ----------
    address : str
        Of its scheduler, such as ``tcp://host:8786``.

    Raises
    ------
    BatchError
        If it cannot be reached, has no workers, or has other versions of what decides the rows.
    """
    # What goes wrong is said in the error.
    with silence_logging_cmgr(logging.CRITICAL, root="distributed.client"):
        try:
            client = Client(address, timeout=_CONNECTING, set_as_default=False)
        except (OSError, ValueError) as error:
            # What was half made closes itself when it is collected.  Let that be now: within a lock
            # that the next client takes, it would wait for itself.
            traceback.clear_frames(error.__traceback__)
            gc.collect()
            raise BatchError(
                f"there is no scheduler at {address} that can be reached ({error}). Start one with "
                "'dask scheduler' and give the address that it prints."
            ) from error
        with client:
            _check_workers(client, address)
            yield client


def outcomes(
    client: Client, files: dict[str, Path], options: BatchOptions
) -> Generator[list[Outcome]]:
    """The outcomes of files as they arrive, all that are there at once.

    Parameters
    ----------
    client : Client
    files : dict of str to Path
        The paths, as the workers see them, by the names for the rows.
    options : BatchOptions

    Raises
    ------
    BatchError
        If the cluster is lost, or left without workers.
    """
    done: queue.SimpleQueue[Future[Rows]] = queue.SimpleQueue()
    names = list(files)
    paths = [str(path) for path in files.values()]
    futures = client.map(compute_file, paths, names, options=options, pure=False)
    waiting = {future.key: name for future, name in zip(futures, names)}
    for future in futures:
        future.add_done_callback(done.put)
    try:
        while waiting:
            arrived = [(waiting.pop(future.key), future) for future in _arrivals(done, client)]
            yield [
                (name, _rows_or_deaths(future, name, files[name], options))
                for name, future in arrived
            ]
    finally:
        if waiting and client.status == "running":
            client.cancel([future for future in futures if future.key in waiting])


def _arrivals(done: queue.SimpleQueue[Future[Rows]], client: Client) -> Iterator[Future[Rows]]:
    """All futures that are done, one at least."""
    yield _first(done, client)
    with suppress(queue.Empty):
        while True:
            yield done.get_nowait()


def _first(done: queue.SimpleQueue[Future[Rows]], client: Client) -> Future[Rows]:
    deserted = 0
    while deserted * _POLL < _PATIENCE:
        with suppress(queue.Empty):
            return done.get(timeout=_POLL)
        staffed = client.status == "running" and client.nthreads()
        deserted = 0 if staffed else deserted + 1
    raise BatchError(
        f"for {_PATIENCE:.0f} s the cluster has had no worker. What was finished is kept: start "
        "workers, and run the same command again."
    )


def _rows_or_deaths(
    future: Future[Rows], name: str, path: Path, options: BatchOptions
) -> Rows | int:
    try:
        return future.result()
    except KilledWorker as error:
        return error.allowed_failures + 1
    except CancelledError as error:
        raise BatchError(
            "the scheduler has been lost. What was finished is kept: start it again, and run the "
            "same command."
        ) from error
    except Exception as error:
        # Nothing that a file raises gets here: this worker cannot do what it is asked for.
        kind = type(error).__name__
        return [refused_row(name, path, options, error=str(error) or kind, error_kind=kind)]


def _check_workers(client: Client, address: str) -> None:
    try:
        client.wait_for_workers(1, timeout=_CONNECTING)
    except DaskTimeoutError as error:
        raise BatchError(
            f"the scheduler at {address} has no workers. Start some: 'dask worker {address} "
            "--nthreads 1', where the package is installed and the files are seen."
        ) from error
    found: Any = client.get_versions(packages=list(_SAME_VERSIONS))
    here = found["client"]["packages"]
    for worker, there in found["workers"].items():
        for name in _SAME_VERSIONS:
            if there["packages"].get(name) != here[name]:
                raise BatchError(
                    f"the worker {worker} has {name} {there['packages'].get(name) or '(none)'}, "
                    f"and here it is {here[name]}: rows could differ. Install the same versions "
                    "on all machines."
                )


@contextmanager
def _interrupts_blocked() -> Iterator[Callable[[], None]]:
    """Keep Ctrl-C from processes that are started meanwhile; yields how to allow it here again.

    A terminal sends it to all processes, and workers are to be closed by the one that started
    them.  They inherit which signals are blocked.
    """
    # Starting this process of Python's own would unblock signals again.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})

    def allow() -> None:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)

    try:
        yield allow
    finally:
        allow()

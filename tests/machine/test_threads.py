"""Threads of linear algebra: limits that nest however calls overlap; processes that were forked."""

import multiprocessing
import os
import subprocess
import sys
import threading

import numpy as np
import pytest
from threadpoolctl import ThreadpoolController

from igl_periods.machine import (
    one_thread,
    threads_by_size,
    threads_for,
    without_lost_threads,
)


def blas_threads():
    return [
        library.num_threads
        for library in ThreadpoolController().select(user_api="blas").lib_controllers
    ]


@pytest.fixture
def two_threads():
    with ThreadpoolController().limit(limits=2, user_api="blas"):
        yield


def test_overlapping_limits_end_with_the_last_one(two_threads):
    # One begins, the other begins, the first ends, the other ends.
    before = blas_threads()
    assert max(before) == 2
    entered, leave = threading.Event(), threading.Event()

    def other():
        with one_thread():
            entered.set()
            leave.wait()

    thread = threading.Thread(target=other)
    with one_thread():
        thread.start()
        entered.wait()
        assert max(blas_threads()) == 1
    assert max(blas_threads()) == 1
    leave.set()
    thread.join()
    assert blas_threads() == before


def test_small_pieces_of_work_get_one_thread_and_large_ones_those_that_there_are(two_threads):
    before = blas_threads()
    with threads_for(1e3):
        assert max(blas_threads()) == 1
        # What is inside of something small is small, whatever it says.
        with threads_for(1e12):
            assert max(blas_threads()) == 1
    with threads_for(1e12):
        assert blas_threads() == before
        with threads_for(1e3):
            assert max(blas_threads()) == 1
        assert blas_threads() == before
    assert blas_threads() == before


def test_functions_of_matrices_get_threads_by_their_size(two_threads):
    @threads_by_size
    def threads_with(matrix, *, more):
        return max(blas_threads()) + more

    assert threads_with(np.eye(3), more=10) == 11
    # Two thousand rows are enough; they need not be there.
    assert threads_with(range(2_000), more=20) == 22
    assert max(blas_threads()) == 2


def test_limits_nest_in_one_thread_and_end_with_an_exception(two_threads):
    before = blas_threads()
    with pytest.raises(KeyError), one_thread():  # noqa: PT012
        with one_thread():
            assert max(blas_threads()) == 1
        assert max(blas_threads()) == 1
        raise KeyError
    assert blas_threads() == before


def test_many_callers_at_once_leave_the_number_of_threads_as_it_was(two_threads):
    before = blas_threads()
    rng = np.random.default_rng(0)

    def work(pauses):
        for pause in pauses:
            with one_thread():
                threading.Event().wait(pause)

    threads = [threading.Thread(target=work, args=(rng.uniform(0, 1e-3, 20),)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert blas_threads() == before


def test_nothing_changes_in_a_process_that_was_not_forked():
    def levels():
        return [
            library.dynlib.omp_get_max_active_levels()
            for library in ThreadpoolController().select(user_api="openmp").lib_controllers
        ]

    before = levels()
    with without_lost_threads():
        assert levels() == before
    assert levels() == before


PROGRAM = """
import multiprocessing
import sys

import numpy as np

import igl_periods as ip

n = 60
a, b = np.meshgrid(*(2 * np.pi * np.arange(k) / k for k in (n, n + 1)), indexing="ij")
V = np.stack([np.cos(a), np.sin(a), np.cos(b), np.sin(b)], axis=-1).reshape(-1, 4)
corner = np.arange(n * (n + 1)).reshape(n, n + 1)
right, up = np.roll(corner, -1, 0), np.roll(corner, -1, 1)
both = np.roll(right, -1, 1)
triangles = np.stack([corner, right, both, corner, both, up], axis=-1).reshape(-1, 3)


def bound(options):
    return ip.period_matrix(V, triangles, **options).bound


if __name__ == "__main__":
    options = eval(sys.argv[1])
    here = bound(options)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        there = pool.apply_async(bound, (options,)).get(timeout=120)
    assert here == there, (here, there)
"""


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork here")
@pytest.mark.parametrize("options", [{}, {"degree": 3}, {"tolerance": 1e-5}], ids=str)
def test_a_forked_child_computes_the_same(options, tmp_path):
    # In a process of its own, with threads of OpenMP that a fork can lose.
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    threads = {"OMP_NUM_THREADS": "2", "OPENBLAS_NUM_THREADS": "2"}
    environment = {**os.environ, **threads, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, program, repr(options)], env=environment, timeout=240, capture_output=True
    )
    assert done.returncode == 0, done.stderr.decode()

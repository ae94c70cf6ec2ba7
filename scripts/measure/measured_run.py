"""One computation in a process of its own: its time, its stages and its peak memory, as JSON.

    python scripts/measure/measured_run.py period_matrix mesh.npz     V and F
    python scripts/measure/measured_run.py cholmod matrix.npz amd 4   a sparse matrix, 4 right sides
    python scripts/measure/measured_run.py idle

The process of CHOLMOD imports nothing of the library, so that its memory is that of CHOLMOD.
"""

import json
import logging
import sys
import time
from pathlib import Path

import numpy as np


def cholmod(path, ordering, n_columns):
    """Analyse, factor and solve; the time of each."""
    from scipy.sparse import load_npz
    from sksparse.cholmod import analyze

    matrix = load_npz(path)
    right_sides = np.random.default_rng(0).normal(size=(matrix.shape[0], int(n_columns)))
    start = time.perf_counter()
    factor = analyze(matrix, mode="supernodal", ordering_method=ordering)
    analysed = time.perf_counter()
    factor.cholesky_inplace(matrix)
    factored = time.perf_counter()
    factor(right_sides)
    end = time.perf_counter()
    stages = {"analysis": analysed - start, "factorisation": factored - analysed}
    return {"seconds": end - start, "stages": stages | {"solution": end - factored}}


def period_matrix(path, *options):
    """``period_matrix(V, F)``, and its Siegel reduction unless told otherwise."""
    import igl_periods as ip
    from igl_periods.run_log import logger

    stages = Stages()
    logger.addHandler(stages)
    logger.setLevel(logging.INFO)
    with np.load(path) as arrays:
        V, F = arrays["V"], arrays["F"]
    settings = json.loads(options[0]) if options else {}
    reduce = settings.pop("reduce", True)
    start = time.perf_counter()
    pm = ip.period_matrix(V, F, **settings)
    bound = pm.bound
    computed = time.perf_counter() - start
    if reduce:
        bound = pm.reduced().bound
    seconds = time.perf_counter() - start
    return {
        "seconds": seconds,
        "reduction": seconds - computed,
        "stages": stages.seconds,
        "genus": pm.genus,
        "bound": bound,
        "rounding": pm.rounding_allowance,
    }


def idle():
    """Nothing but what every computation loads."""
    import igl_periods  # noqa: F401

    return {}


class Stages(logging.Handler):
    """Collects the times of the stages of a computation."""

    def __init__(self):
        super().__init__()
        self.seconds = {}

    def emit(self, record):
        if getattr(record, "seconds", None) is not None:
            self.seconds[record.stage] = self.seconds.get(record.stage, 0.0) + record.seconds


def peak_bytes():
    """The most memory that this process has held; getrusage would count its parent's as well."""
    lines = Path("/proc/self/status").read_text().splitlines()
    status = dict(line.split(":", 1) for line in lines)
    return 1024 * int(status["VmHWM"].split()[0])


if __name__ == "__main__":
    computations = {"cholmod": cholmod, "period_matrix": period_matrix, "idle": idle}
    result = computations[sys.argv[1]](*sys.argv[2:])
    sys.stdout.write(json.dumps({**result, "peak_bytes": peak_bytes()}) + "\n")

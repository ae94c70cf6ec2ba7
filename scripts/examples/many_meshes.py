"""
A thousand meshes with Dask, results in pandas
==============================================

A batch computes one row for each component of each mesh, on all cores or on a Dask cluster, and can
be interrupted at any time.  Here the meshes are noisy tori; set ``COUNT`` to 1000 at home.
"""

import os
import tempfile
from pathlib import Path

import igl
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from igl_periods.batch import BatchOptions, find_files, run_batch
from igl_periods.surfaces import torus_of_revolution

COUNT = int(os.environ.get("IGL_PERIODS_EXAMPLE_MESHES", "12"))

# %%
# A folder of meshes: tori of random radii, with noise.  One file is not a mesh.


def write_meshes(folder):
    rng = np.random.default_rng(0)
    for k in range(COUNT):
        V, F = torus_of_revolution(2.0, rng.uniform(0.4, 1.4), 24, 12)
        igl.writeOFF(str(folder / f"torus_{k:04}.off"), V + rng.normal(0, 0.01, V.shape), F)
    (folder / "broken.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n")


# %%
# The batch, and its table.  Workers are processes, which import this script: so it runs below.


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_meshes(folder)
        table = folder / "results.parquet"
        result = run_batch(find_files(folder), table, BatchOptions(tolerance=1e-4), workers=2)
        print(result)
        return pd.read_parquet(table)


# %%
# pandas takes it from here.  A refused mesh is a row, too, and says why.

if __name__ == "__main__":
    frame = main()
    print(frame[["file", "genus", "bound", "error"]].head())
    good = frame[frame["error"].isna()]
    assert len(good) == COUNT
    assert (good["bound"] <= 1e-4).all()
    tau = np.array([row[0] for row in good["matrix_real"]]) + 1j * np.array(
        [row[0] for row in good["matrix_imag"]]
    )
    plt.plot(tau.real, tau.imag, "o")
    plt.xlabel("Re τ")
    plt.ylabel("Im τ")
    plt.title("Moduli of noisy tori, Siegel reduced")
    plt.show()

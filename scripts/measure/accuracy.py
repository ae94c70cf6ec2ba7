"""Digits against unknowns and seconds: piecewise linear forms, their refinement, and high degree.

    python scripts/measure/accuracy.py                                   square-tiled surfaces
    python scripts/measure/accuracy.py eight.off fertility.off           and meshes

For every surface: piecewise linear forms on the triangulation as it is and refined by midpoints,
elements of degree p on flat triangles alone, and with conical elements at cone points.  The digits
are those of the certified bound, rounding included.  Writes a table, a CSV and a plot.
"""

from __future__ import annotations

import argparse
import sys
import time
from functools import partial
from pathlib import Path

import igl
import numpy as np

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.midpoint_subdivision import split
from igl_periods.elements.least_energy import (
    dirichlet_matrix,
    high_order_forms,
    least_energy_forms,
    rounding_allowance,
)
from igl_periods.elements.placement import flat_elements, separate_cones
from igl_periods.harmonic.energies import linear_energies
from igl_periods.periods.rounding import LEAST_ALLOWANCE
from igl_periods.surfaces import square_tiled_surface

sys.path.append(str(Path(__file__).resolve().parents[1] / "paper"))
import tables

METHODS = {
    "linear": "o-",
    "degree p, flat elements": "s--",
    "degree p, conical elements": "D-",
}


def main():
    options = arguments()
    surfaces = {name: square_tiled_surface(name) for name in ("omega_1", "omega_2", "omega_3")}
    for path in options.mesh:
        surfaces[path.name] = ip.DeltaComplex.from_mesh(*igl.read_triangle_mesh(path))
    rows = []
    for name, K in surfaces.items():
        K, cochains = intrinsic_delaunay(K, ip.cohomology_basis(K))
        rows.extend({"surface": name, **row} for row in measured(K, cochains, options.unknowns))
    tables.write(options.output, "accuracy", rows, [])
    plot(options.output / "accuracy.svg", rows)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", type=Path, nargs="*", help="mesh files")
    parser.add_argument("--output", type=Path, default=Path("results"), help="folder for results")
    parser.add_argument("--unknowns", type=int, default=200_000, help="most unknowns of a system")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    return options


def measured(K, cochains, most_unknowns):
    """Rows of all methods, until a method is at rounding or takes too many unknowns."""
    for method, attempts in (
        ("linear", linear(K, cochains)),
        ("degree p, flat elements", flat(K, cochains)),
        ("degree p, conical elements", conical(K, cochains)),
    ):
        for step, unknowns, compute in attempts:
            if unknowns > most_unknowns:
                break
            (D, allowance), seconds = timed(compute)
            pm = ip.PeriodMatrix(D, True, cochains, K, max(allowance, LEAST_ALLOWANCE))
            yield {
                "method": method,
                "step": step,
                "unknowns": unknowns,
                "seconds": seconds,
                "bound": pm.bound,
            }
            if pm.bound < 2.0 * pm.rounding_allowance:
                break


def timed(compute):
    """The result, and the least time of a second of repetitions."""
    times = []
    while sum(times) < 1.0 and len(times) < 20:
        start = time.perf_counter()
        result = compute()
        times.append(time.perf_counter() - start)
    return result, min(times)


def linear(K, cochains):
    for step in range(12):
        if step:
            K, cochains = split(K, cochains)
        yield step, K.n_vertices, partial(linear_energies, K, cochains)


def flat(K, cochains):
    K, cochains = separate_cones(K, cochains)
    for degree in range(2, 17):
        yield degree, unknowns(K, degree), partial(flat_energies, K, cochains, degree)


def flat_energies(K, cochains, degree):
    elements = flat_elements(K, degree, np.arange(K.n_faces))
    return certified(least_energy_forms(K, cochains, (elements,)))


def certified(forms):
    """The energies of forms, and what rounding can change in them."""
    D = dirichlet_matrix(forms)
    return D, rounding_allowance(forms, D)


def conical(K, cochains):
    separated, _ = separate_cones(K, cochains)
    for degree in range(2, 19):
        yield degree, unknowns(separated, degree), partial(conical_energies, K, cochains, degree)


def conical_energies(K, cochains, degree):
    return certified(high_order_forms(K, cochains, degree))


def unknowns(K, degree):
    return K.n_vertices + (degree - 1) * K.n_edges


def plot(path, rows):
    """Digits against unknowns above, against seconds below, one column for each surface."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    names = list(dict.fromkeys(row["surface"] for row in rows))
    size = (3.2 * len(names), 6)
    figure, axes = plt.subplots(
        2, len(names), figsize=size, sharey=True, squeeze=False, layout="constrained"
    )
    for column, name in enumerate(names):
        for method, style in METHODS.items():
            chosen = [row for row in rows if (row["surface"], row["method"]) == (name, method)]
            digits = [-np.log10(row["bound"]) for row in chosen]
            for line, quantity in enumerate(("unknowns", "seconds")):
                values = [row[quantity] for row in chosen]
                axes[line, column].semilogx(values, digits, style, label=method, markersize=4)
        axes[0, column].set(title=name, xlabel="unknowns")
        axes[1, column].set(xlabel="seconds")
    for axis in axes.flat:
        axis.set_ylim(0, 15)
        axis.grid(True, linewidth=0.3)
    for axis in axes[:, 0]:
        axis.set_ylabel("certified digits")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=9)
    figure.savefig(path)
    plt.close(figure)


if __name__ == "__main__":
    main()

"""From polygons to algebraic curves: the table of equations that are recognised in proved digits.

    python scripts/measure/curves.py                       50 digits
    python scripts/measure/curves.py --digits 30 --only octagon "L(3)"
    python scripts/measure/curves.py --controls 20         and random ones without a name

Every surface is enclosed in balls (``ip.enclose``); exact matrices are taken where a surface is
given by one.  ``digits`` are those of the matrix that are proved, ``left over`` those that speak
for the coefficients of the equation, seconds are CPU time of both steps.  Writes a table and a CSV.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import flint
import numpy as np

import igl_periods as ip
from igl_periods.surfaces import exact_matrices

sys.path.append(str(Path(__file__).resolve().parents[1] / "paper"))
import tables


def quaternion_origami():
    """Eight squares numbered by ±1, ±i, ±j, ±k; to the right is · i, up is · j."""
    return ip.surfaces.origami("(1,2,3,4)(5,6,7,8)", "(1,5,3,7)(2,8,4,6)")


def silhol():
    """((1 + i)/2) [[2, 1, 1], [1, 2, 1], [1, 1, 2]]."""
    half = flint.acb(1, 1) / 2
    return flint.acb_mat([[half * x for x in row] for row in ([2, 1, 1], [1, 2, 1], [1, 1, 2])])


SURFACES = {
    "octagon": (lambda: ip.surfaces.regular_polygon(8), "y² = x⁵ − x"),
    "decagon": (lambda: ip.surfaces.regular_polygon(10), "y² = x⁵ − 1"),
    "double pentagon": (lambda: ip.surfaces.double_polygon(5), "y² = x⁵ − 1"),
    "double heptagon": (lambda: ip.surfaces.double_polygon(7), "y² = x⁷ − 1"),
    "12-gon": (lambda: ip.surfaces.regular_polygon(12), "y² = x⁷ − x"),
    "L(2) = Omega_1": (lambda: ip.surfaces.origami("(1,2)(3)", "(1,3)(2)"), "a sextic"),
    "Omega_2": (lambda: ip.surfaces.square_tiled_surface("omega_2"), "y² = x⁵ − x"),
    "Omega_3": (lambda: ip.surfaces.square_tiled_surface("omega_3"), "y² = x⁶ − 1"),
    "L(3)": (lambda: ip.surfaces.l_shape(3), "a sextic"),
    "L(3/2)": (lambda: exact_matrices.rational_l(3, 2), "a sextic over Q(√2)"),
    "golden L": (exact_matrices.golden_l, "real multiplication by √5"),
    "quaternion origami": (quaternion_origami, "Fermat's quartic"),
    "56 triangles {3,7}": (lambda: ip.surfaces.regular_map_surface("klein"), "Klein's quartic"),
    "Silhol's matrix": (silhol, "a quartic"),
    "Bring's curve": (exact_matrices.bring, "not hyperelliptic"),
}


def main():
    options = arguments()
    rows = [measured(name, *SURFACES[name], options.digits) for name in options.only or SURFACES]
    rows += [control(seed, options.digits) for seed in range(options.controls)]
    tables.write(options.output, "curves", rows, [])


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--digits", type=int, default=50)
    parser.add_argument("--only", nargs="*", choices=list(SURFACES), metavar="NAME")
    parser.add_argument("--controls", type=int, default=0, metavar="N")
    parser.add_argument("--output", type=Path, default=Path("results"))
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    return options


def measured(name, build, expected, digits):
    start = time.process_time()
    with flint.ctx.workdps(digits + 10):
        surface = build()
        Pi = surface if isinstance(surface, flint.acb_mat) else ip.enclose(surface, digits=digits)
        curve = ip.curve(Pi)
    return row(name, expected, curve, time.process_time() - start)


def control(seed, digits):
    """An L-shape of generic arms: its curve is none with small coefficients."""
    rng = np.random.default_rng(seed)
    start = time.process_time()
    right, up = (int(x) / 2**20 for x in rng.integers(2**19, 2**22, size=2))
    K = ip.surfaces.l_shape(1.0 + right, 1.0 + up)
    curve = ip.curve(ip.enclose(K, digits=digits), degree=10)
    return row(f"L({1 + right:.4f}, {1 + up:.4f})", "nothing", curve, time.process_time() - start)


def row(name, expected, curve, seconds):
    evidence = curve.evidence
    return {
        "surface": name,
        "expected": expected,
        "genus": curve.genus,
        "digits": curve.digits,
        "equation": curve.equation if curve.is_recognised else f"none ({curve.model})",
        "field": str(curve.field) if curve.is_recognised else "",
        "left over": f"{evidence.left_over:.0f}" if evidence and curve.is_recognised else "",
        "field of moduli": str(curve.field_of_moduli or "not recognised"),
        "seconds": f"{seconds:.1f}",
    }


if __name__ == "__main__":
    main()

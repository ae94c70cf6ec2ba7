"""Effective conductivities: Keller's duality, arrays of discs, minimal surfaces, flat tori."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from support.random_domains import circle
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import double_areas
from igl_periods.domains.homogenisation import effective_conductivity
from igl_periods.surfaces import triply_periodic_minimal_surface

EXAMPLE = runpy.run_path(
    str(Path(__file__).parents[2] / "scripts" / "examples" / "effective_conductivity.py")
)
plate = EXAMPLE["perforated_plate"]
ELL = 0.2 + 0.2j + 0.3 * np.array([0, 2, 2 + 1j, 1 + 1j, 1 + 2j, 2j])
ROTATION = np.array([[0.0, -1.0], [1.0, 0.0]])


def between(lower, upper):
    return np.linalg.eigvalsh(upper - lower)[0] >= -1e-13 * np.abs(upper).max()


def check(sigma):
    lower, upper = sigma.bounds
    assert between(lower, sigma.tensor)
    assert between(sigma.tensor, upper)
    return lower, upper


@pytest.mark.parametrize("hole", [ELL, 0.5 + 0.5j + 0.3 * circle(5)])
@pytest.mark.parametrize("degree", [1, 5])
def test_keller_s_duality(hole, degree):
    K = plate(hole)
    insulating = effective_conductivity(K, degree=degree)
    conducting = effective_conductivity(K, degree=degree, conducting_holes=True)
    lower, upper = check(insulating)
    other_lower, other_upper = check(conducting)
    # Holes that insulate lower the conductivity, others raise it.
    if degree > 1:
        assert between(upper, np.eye(2))
        assert between(np.eye(2), other_lower)
    dual = [ROTATION @ np.linalg.inv(s) @ ROTATION.T for s in (other_upper, other_lower)]
    assert between(lower, dual[1])
    assert between(dual[0], upper)


def published(part):
    """Perfectly conducting discs in a square array, by their part of the area.

    Perrins, McKenzie, McPhedran, "Transport properties of regular arrays of cylinders", Proc. R.
    Soc. A 369 (1979), after Rayleigh.
    """
    f4, f8 = part**4, part**8
    return 1 + 2 * part / (1 - part - 0.305827 * f4 / (1 - 1.402958 * f8) - 0.013362 * f8)


@pytest.mark.parametrize("part", [0.3, 0.5])
def test_square_arrays_of_discs(part):
    n, radius = 48, np.sqrt(part / np.pi)
    found = []
    for r in (radius, radius / np.cos(np.pi / n)):
        K = plate(0.5 + 0.5j + r * circle(n), n=10)
        found.append(effective_conductivity(K, conducting_holes=True, tolerance=1e-5).bounds)
    # The disc contains the inscribed polygon, and is in the circumscribed one: proved bounds of σ.
    low, high = found[0].lower[0, 0], found[1].upper[0, 0]
    assert low < published(part) < high
    assert high - low < 0.03 * published(part)
    # Polygons of the same area are off by n^-2 and less.
    values = []
    for k in (24, 48):
        same_area = np.sqrt(2 * part / k / np.sin(2 * np.pi / k))
        K = plate(0.5 + 0.5j + same_area * circle(k), n=10)
        values.append(effective_conductivity(K, conducting_holes=True, tolerance=1e-5).tensor[0, 0])
    assert (4 * values[1] - values[0]) / 3 == pytest.approx(published(part), rel=1e-4)


def test_sheets_have_determinant_one():
    K = EXAMPLE["corrugated_sheet"](10)
    sigma = effective_conductivity(K, tolerance=1e-5)
    lower, upper = (bound[:2, :2] for bound in check(sigma))
    assert np.linalg.det(lower) <= 1 <= np.linalg.det(upper)
    assert np.abs(sigma.tensor[2]).max() == 0
    # τ in the marking of both translations gives the same tensor.
    tau = complex(ip.period_matrix(K, tolerance=1e-7).reduced().matrix[0, 0])
    flat = EXAMPLE["tensor_of"](tau)
    assert np.linalg.det(flat) == pytest.approx(1)
    L = K.cell.lattice[:, :2]
    N = np.linalg.inv(L.T) @ sigma.tensor[:2, :2] @ np.linalg.inv(L) * np.linalg.det(L)
    w = (-N[0, 1] + 1j * np.sqrt(np.linalg.det(N))) / N[1, 1]
    assert ip.symplectic_isomorphisms([[w]], [[tau]], tolerance=1e-4) or (
        ip.symplectic_isomorphisms([[-np.conj(w)]], [[tau]], tolerance=1e-4)
    )


@pytest.mark.parametrize("name", ["P", "D", "G"])
def test_minimal_surfaces_conduct_two_thirds_of_their_area(name):
    errors = []
    for n in (2, 4):
        V, F, lattice = triply_periodic_minimal_surface(name, n)
        K = ip.DeltaComplex.from_mesh(V, F, lattice=lattice)
        area = double_areas(K.lengths).sum() / 2
        sigma = effective_conductivity(K, degree=3)
        check(sigma)
        # Cubic symmetry: the tensor is a multiple of 1.
        assert np.allclose(sigma.tensor, sigma.tensor[0, 0] * np.eye(3), atol=1e-3)
        errors.append(sigma.tensor[0, 0] * abs(np.linalg.det(lattice)) / area - 2 / 3)
    # What chords miss has order 2.
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.35)
    assert abs(4 * errors[1] - errors[0]) / 3 < 2e-3


def test_strips_conduct_along_the_translation_alone():
    V = [[0.0, 0], [2, 0], [2, 1], [0, 1]]
    K = ip.DeltaComplex.from_mesh(V, [[0, 1, 2], [0, 2, 3]], lattice=[[2, 0]])
    sigma = effective_conductivity(K, degree=1)
    assert np.allclose(sigma.tensor, [[1, 0], [0, 0]], atol=1e-12)
    with pytest.raises(ip.ComplexError, match="leads from cell to cell"):
        effective_conductivity(K, conducting_holes=True)
    assert repr(sigma).startswith("EffectiveConductivity, bound ")
    assert np.asarray(sigma) is sigma.tensor


def test_other_surfaces_are_refused():
    with pytest.raises(ip.ComplexError, match="that of a periodic surface"):
        effective_conductivity(*noisy_torus(5, 5, 0.1, 1))


def test_the_example_runs(capsys):
    EXAMPLE["main"]()
    out = capsys.readouterr().out
    assert "determinant 1.000000" in out or "determinant 0.999999" in out
    assert "G: σ = " in out

"""The period matrix within PyTorch and JAX, as the examples have it."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip

EXAMPLES = Path(__file__).resolve().parents[2] / "scripts" / "examples"
V, F = noisy_torus(8, 6, 0.05, 0)


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def expected():
    """The gradient of (Im Π)² + 3 Re Π."""
    pm = ip.period_matrix(V, F, keep_forms=True)
    return pm.gradient(3.0 + 2j * pm.matrix.imag).vertices


def test_pytorch():
    torch = pytest.importorskip("torch", reason="PyTorch is not installed")
    positions = torch.from_numpy(V).requires_grad_()
    Pi = example("torch_period_matrix").PeriodMatrix.apply(positions, F)
    (Pi[1] ** 2 + 3 * Pi[0]).sum().backward()
    assert np.allclose(positions.grad.numpy(), expected(), rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("compiled", [False, True])
def test_jax(compiled):
    jax = pytest.importorskip("jax", reason="JAX is not installed")
    Pi = example("jax_period_matrix").period_matrix_of(F, 1)

    def objective(positions):
        return (Pi(positions)[1] ** 2 + 3 * Pi(positions)[0]).sum()

    gradient = jax.grad(objective)
    found = (jax.jit(gradient) if compiled else gradient)(V)
    assert np.allclose(found, expected(), rtol=1e-12, atol=1e-14)

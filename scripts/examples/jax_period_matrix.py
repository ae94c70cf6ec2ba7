"""
Π as a function that JAX can differentiate
==========================================

The period matrix as a function that JAX can differentiate, also compiled::

    Pi = period_matrix_of(F, genus)           # a function of V: (2, g, g), real and imaginary parts
    jax.grad(lambda V: Pi(V)[1].trace())(V)
"""

import jax
import numpy as np

import igl_periods as ip

jax.config.update("jax_enable_x64", True)


def period_matrix_of(F, genus):
    def forward(V):
        matrix = ip.period_matrix(np.asarray(V), F).matrix
        return np.stack([matrix.real, matrix.imag])

    def backward(V, by_matrix):
        by_real, by_imaginary = np.asarray(by_matrix)
        pm = ip.period_matrix(np.asarray(V), F, keep_forms=True)
        return pm.gradient(by_real + 1j * by_imaginary).vertices

    shape = jax.ShapeDtypeStruct((2, genus, genus), np.float64)
    call = jax.custom_vjp(lambda V: jax.pure_callback(forward, shape, V))
    call.defvjp(
        lambda V: (call(V), V),
        lambda V, by_matrix: (jax.pure_callback(backward, V, V, by_matrix),),
    )
    return call

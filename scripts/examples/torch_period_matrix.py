"""
Π as a function that PyTorch can differentiate
==============================================

The period matrix as a function that PyTorch can differentiate::

    Pi = PeriodMatrix.apply(V, F)             # (2, g, g): real and imaginary parts
    Pi[1].diagonal().sum().backward()         # V.grad
"""

import numpy as np
import torch

import igl_periods as ip


class PeriodMatrix(torch.autograd.Function):
    @staticmethod
    def forward(ctx, V, F):
        ctx.pm = ip.period_matrix(V.detach().numpy(), np.asarray(F), keep_forms=True)
        return torch.from_numpy(np.stack([ctx.pm.matrix.real, ctx.pm.matrix.imag]))

    @staticmethod
    def backward(ctx, by_matrix):
        by_real, by_imaginary = by_matrix.numpy()
        return torch.from_numpy(ctx.pm.gradient(by_real + 1j * by_imaginary).vertices), None

"""x"""

from .pipeline import period_matrix as period_matrix

"""Names for arrays of each kind of number, for annotations; results that stay as they are."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import issparse

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Bytes = NDArray[np.uint8]
Complexes = NDArray[np.complex128]
Values = NDArray[Any]


class ReadOnlyArrays:
    """A dataclass whose arrays are read-only, also when it is copied or comes from a pickle.

    Of sparse matrices the values are.
    """

    def __post_init__(self) -> None:
        self._protect()

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._protect()

    def _protect(self) -> None:
        for value in self.__dict__.values():
            array = value.data if issparse(value) else value
            if isinstance(array, np.ndarray):
                array.flags.writeable = False

"""Names for arrays of each kind of number, as annotations use them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Bytes = NDArray[np.uint8]
Complexes = NDArray[np.complex128]
Values = NDArray[Any]

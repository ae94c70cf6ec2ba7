"""Packages that only an extra of the installation brings, asked for before they are imported.

Period matrices of arrays and files need none of them.
"""

from __future__ import annotations

import re
from importlib.util import find_spec

from igl_periods.errors import MissingExtraError

# The extras of pyproject.toml, by what their packages are called in an import.
EXTRAS = {
    "pictures": ("k3d", "matplotlib", "open3d", "PIL"),
    "batch": ("dask", "distributed", "pyarrow", "tqdm"),
    "domains": ("svgelements",),
    "completion": ("argcomplete",),
    "distributed": ("mpi4py", "petsc4py"),
}

# Debian's packages of the libraries that Open3D loads.
_PACKAGES = {
    "libEGL": "libegl1",
    "libGL": "libgl1",
    "libX11": "libx11-6",
    "libgomp": "libgomp1",
    "libidn2": "libidn2-0",
    "libusb-1.0": "libusb-1.0-0",
    "libvulkan": "mesa-vulkan-drivers",
}


def require(purpose: str, *packages: str) -> None:
    """Raise unless packages of an extra can be imported.

    Parameters
    ----------
    purpose : str
        What needs them, as the beginning of a sentence.
    packages : str
        Their names in an import, all of one extra.

    Raises
    ------
    MissingExtraError
        The message has one line, which ends with the command that installs them.
    """
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        (extra,) = (name for name, brought in EXTRAS.items() if missing[0] in brought)
        raise MissingExtraError(
            f"{purpose} needs {' and '.join(missing)}: pip install 'igl_periods[{extra}]'"
        )


def missing_library(error: Exception) -> str:
    """What to install for a package that cannot be loaded, from the error of the loader."""
    library = re.search(r"(lib[\w.+-]*?)\.so[.\d]*", str(error))
    if library is None:
        return f"{error}."
    package = _PACKAGES.get(library[1])
    hint = f" (on Debian and Ubuntu: apt-get install {package})" if package else ""
    return f"the system library {library[0]} is missing{hint}."

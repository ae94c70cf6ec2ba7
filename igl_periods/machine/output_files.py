"""Files that are to be written, checked before hours are spent on what they shall hold."""

from __future__ import annotations

import os
from pathlib import Path


def check_output(output: str | os.PathLike[str], *sources: str | os.PathLike[str]) -> None:
    """Refuse a file that could not be written in the end, without touching it.

    Parameters
    ----------
    output : path-like
    *sources : path-like
        Files that will be read, none of which it may be.

    Raises
    ------
    FileNotFoundError
        If its folder does not exist.
    IsADirectoryError, NotADirectoryError
        If it is a folder, or lies in something that is none.
    FileExistsError
        If it is one of the sources.
    PermissionError
        If it must not be written, or nothing in its folder.

    Examples
    --------
    >>> check_output("no-such-folder/picture.png")
    Traceback (most recent call last):
    FileNotFoundError: there is no folder 'no-such-folder' for 'picture.png'
    """
    place = Path(output)
    folder = place.parent
    if not folder.exists():
        raise FileNotFoundError(f"there is no folder {str(folder)!r} for {place.name!r}")
    if not folder.is_dir():
        raise NotADirectoryError(
            f"{str(folder)!r} is not a folder, so {place.name!r} cannot be there"
        )
    if place.is_dir():
        raise IsADirectoryError(f"the output {str(place)!r} is a folder")
    if any(_is_same(place, Path(source)) for source in sources):
        raise FileExistsError(f"the output {str(place)!r} would replace what is read")
    if place.exists() and not os.access(place, os.W_OK):
        raise PermissionError(f"the output {str(place)!r} is there and must not be written")
    if not place.exists() and not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(f"nothing can be written in the folder {str(folder)!r}")


def _is_same(one: Path, other: Path) -> bool:
    return one.exists() and other.exists() and one.samefile(other)

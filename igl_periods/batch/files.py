"""The files of a batch: those of folders, of lists, and single ones."""

from __future__ import annotations

import os
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

from igl_periods.errors import MeshError
from igl_periods.meshes import SURFACE_EXTENSIONS, is_surface_file


def find_files(*sources: str | PathLike[str]) -> dict[str, Path]:
    """The files that hold, or should hold, the surfaces of a batch.

    Parameters
    ----------
    *sources : path-like
        A folder, which is searched with all folders in it for meshes and gluings, hidden files
        and folders left out; a text file with a path on each line, relative to its own folder,
        blank lines and lines that begin with ``#`` skipped; or a mesh.  Meshes and the files of a
        list need not exist.

    Returns
    -------
    dict of str to Path
        The absolute path of each file, by its name: the path relative to the folder, or to that
        of the list; with several sources, the path as given.  Folders are sorted, lists are not.

    Raises
    ------
    FileNotFoundError
        If there is no such folder or list.
    MeshError
        If there is no file in one, or it is something else.
    """
    found = {}
    for place in map(Path, sources):
        folder, paths = _contents(place)
        for path in paths:
            name = path if len(sources) == 1 else folder / path
            found[_text(name)] = (folder / path).absolute()
    return found


def _contents(place: Path) -> tuple[Path, list[Path]]:
    """A folder, and paths relative to it."""
    if place.is_dir():
        found = sorted(path.relative_to(place) for path in _below(place))
        if not found:
            known = " ".join(SURFACE_EXTENSIONS)
            raise MeshError(f"there is no mesh in the folder {str(place)!r} or below it ({known}).")
        return place, found
    if is_surface_file(place.name):
        return place.parent, [Path(place.name)]
    if not place.exists():
        raise FileNotFoundError(f"there is no folder and no list of paths {str(place)!r}")
    return place.parent, _listed(place)


def _below(folder: Path) -> Iterator[Path]:
    for here, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        for path in (Path(here, name) for name in names if not name.startswith(".")):
            # Links to nothing are missing files; pipes and devices are not files at all.
            if is_surface_file(path.name) and (path.is_file() or not path.exists()):
                yield path


def _listed(file: Path) -> list[Path]:
    data = file.read_bytes().removeprefix(b"\xef\xbb\xbf")
    if b"\0" in data:
        raise MeshError(f"{file}: this is neither a folder nor a mesh nor a text file with paths.")
    lines = [line.strip() for line in data.splitlines()]
    paths = [Path(os.fsdecode(line)) for line in lines if line and not line.startswith(b"#")]
    if not paths:
        raise MeshError(f"{file}: there is no path in this list.")
    return paths


def _text(path: Path) -> str:
    """A path as text; bytes that are not text are written as escapes."""
    return os.fsencode(path).decode("utf-8", "backslashreplace")

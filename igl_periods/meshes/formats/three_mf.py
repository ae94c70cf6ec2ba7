"""3MF: a zip archive with XML, in which a build places meshes and compositions of them.

An object is a mesh, or components: other objects, each with a transform, also from other parts of
the archive (production extension).  The items of the build are objects with transforms.  Rows are
multiplied from the left, x ↦ x M + t; a transform of negative determinant is a reflection, and the
faces are turned.  Everything is in the unit of the first part.

References
----------
3MF Consortium, "3D Manufacturing Format, Core Specification" 1.3 and "Production Extension" 1.1.
"""

from __future__ import annotations

import io
import posixpath
import zipfile
import zlib
from dataclasses import dataclass, field
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.complexes import MOST_TRIANGLES
from igl_periods.errors import MeshError
from igl_periods.machine import available_memory

from .mesh_file import MeshFile, mesh_of_triangles
from .placement import Part, assembled, placed
from .text import indices, numbers

_MILLIMETRES = {
    "micron": 1e-3,
    "millimeter": 1.0,
    "centimeter": 10.0,
    "inch": 25.4,
    "foot": 304.8,
    "meter": 1000.0,
}
# Extensions without any effect on positions and triangles, by the last words of their names.
_HARMLESS = ("production", "material", "slice", "trianglesets", "securecontent")
_ROOT = "3D/3dmodel.model"


@dataclass
class _Object:
    """An object while it is read: coordinates and corners as words, and components."""

    vertices: list[str] = field(default_factory=list)
    corners: list[str] = field(default_factory=list)
    components: list[tuple[str, str, Floats]] = field(default_factory=list)


class _Model:
    """What the parser calls with every element of one part of the archive."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.unit = 1.0
        self.objects: dict[str, _Object] = {}
        self.items: list[tuple[str, str, Floats]] = []
        self._current = _Object()
        self._namespaces: dict[str, str] = {}

    def doctype(self, *_: str) -> None:
        raise MeshError("3MF has no document type: the file is corrupt, or an attack.")

    def start_ns(self, prefix: str, uri: str) -> None:
        self._namespaces[prefix] = uri

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        space, _, word = tag.rpartition("}")
        # Extensions have vertices too, of slices for example.
        match word if "/core/" in space or not space else "":
            case "model":
                self.unit = _MILLIMETRES[attributes.get("unit", "millimeter")]
                self._check_extensions(attributes.get("requiredextensions", ""))
            case "object":
                self._current = self.objects[attributes["id"]] = _Object()
            case "vertex":
                self._current.vertices += (attributes[c] for c in "xyz")
            case "triangle":
                self._current.corners += (attributes[c] for c in ("v1", "v2", "v3"))
            case "component":
                self._current.components.append(self._use(attributes))
            case "item":
                self.items.append(self._use(attributes))

    def _use(self, attributes: dict[str, str]) -> tuple[str, str, Floats]:
        """Which part of the archive, which object in it, and its transform."""
        paths = [value for key, value in attributes.items() if key.endswith("}path")]
        name = paths[0].lstrip("/") if paths else self.name
        return name, attributes["objectid"], _matrix(attributes.get("transform"))

    def _check_extensions(self, prefixes: str) -> None:
        for prefix in prefixes.split():
            name = self._namespaces.get(prefix, prefix)
            if not any(word in name for word in _HARMLESS):
                raise MeshError(f"the file requires the extension {name}, which is not read here.")


class _Archive:
    """The parts of an archive, parsed when they are needed."""

    def __init__(self, archive: zipfile.ZipFile) -> None:
        self._archive = archive
        self._models: dict[str, _Model] = {}
        self._sizes: dict[tuple[str, str], int] = {}

    def model(self, name: str) -> _Model:
        if name not in self._models:
            model = _Model(name)
            parser = ET.XMLParser(target=model)
            parser.feed(_member(self._archive, name))
            parser.close()
            self._models[name] = model
        return self._models[name]

    def size(self, name: str, number: str, above: tuple[tuple[str, str], ...] = ()) -> int:
        """Triangles of an object with all its components; also checks that it is not in itself."""
        key = (name, number)
        if key in above:
            raise MeshError(f"object {number} has itself as a component.")
        if key not in self._sizes:
            found = self._object(name, number)
            below = sum(self.size(*use[:2], (*above, key)) for use in found.components)
            self._sizes[key] = 1 + len(found.corners) // 3 + below
        return self._sizes[key]

    def parts(self, name: str, number: str, matrix: Floats) -> list[Part]:
        """The meshes of an object and of its components, in their places."""
        found = self._object(name, number)
        parts = []
        if found.corners:
            words = [word.encode() for word in found.vertices]
            V = numbers(words).reshape(-1, 3)
            F = indices([word.encode() for word in found.corners]).reshape(-1, 3)
            if F.min() < 0 or F.max() >= len(V):
                raise MeshError(f"a triangle has vertex {F.max()}, and its object has {len(V)}.")
            parts.append(placed(Part(V, F), matrix))
        for other, component, local in found.components:
            parts += self.parts(other, component, matrix @ self._scaled(name, other) @ local)
        return parts

    def items(self) -> list[Part]:
        """Everything that the build places."""
        root = _root(self._archive)
        items = self.model(root).items
        if not items:
            raise MeshError("the build of this 3MF file is empty: it places no object.")
        if sum(self.size(*use[:2]) for use in items) > MOST_TRIANGLES:
            raise MeshError("instances of its objects have too many triangles together.")
        parts = []
        for name, number, matrix in items:
            parts += self.parts(name, number, matrix @ self._scaled(root, name))
        return parts

    def _scaled(self, name: str, other: str) -> Floats:
        """From the unit of one part to that of another."""
        scale = self.model(other).unit / self.model(name).unit
        return np.diag([scale, scale, scale, 1.0])

    def _object(self, name: str, number: str) -> _Object:
        objects = self.model(name).objects
        if number not in objects:
            raise MeshError(f"object {number} of {name} is used, and there is none.")
        return objects[number]


def mesh_from_3mf(data: bytes) -> MeshFile:
    """The mesh in a 3MF file."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = _Archive(archive).items()
    except MeshError:
        raise
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, OSError) as error:
        raise MeshError(
            f"the file is not a zip archive, or truncated or corrupt ({error})."
        ) from error
    except (ET.ParseError, LookupError, ValueError, RecursionError) as error:
        words = f"{type(error).__name__}: {error}"[:120]
        raise MeshError(f"the archive holds no 3MF as it should be ({words}).") from error
    except RuntimeError as error:
        raise MeshError(f"the archive cannot be opened: {error}.") from error
    if not parts:
        raise MeshError("the mesh is empty: the objects of this 3MF file have no triangles.")
    return mesh_of_triangles(*assembled(parts))


def _root(archive: zipfile.ZipFile) -> str:
    """The name of the part with the build."""
    if "_rels/.rels" in archive.namelist():
        for element in ET.fromstring(_member(archive, "_rels/.rels")).iter():
            if element.get("Type", "").endswith("/3dmodel"):
                return posixpath.normpath(element.get("Target", "").lstrip("/"))
    return _ROOT


def _member(archive: zipfile.ZipFile, name: str) -> bytes:
    """A file of the archive; names are compared without regard to case."""
    names = {known.lower(): known for known in archive.namelist()}
    if name.lower() not in names:
        raise MeshError(f"the archive has no {name}: it is no 3MF file.")
    known = archive.getinfo(names[name.lower()])
    if known.file_size > available_memory() / 8:
        raise MeshError(f"{name} has {known.file_size / 1e9:.3g} GB, too much for the memory.")
    return archive.read(known)


def _matrix(transform: str | None) -> Floats:
    """The matrix of columns for twelve numbers, three in each row, the translation last."""
    matrix: Any = np.eye(4)
    if transform is not None:
        matrix[:3] = numbers(transform.encode().split()).reshape(4, 3).T
    if not np.isfinite(matrix).all():
        raise MeshError("a transform of this 3MF file has infinite entries.")
    return np.asarray(matrix)

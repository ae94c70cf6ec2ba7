"""What was in a mesh file, and what was done to it, for people and for programs."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass
from typing import Any

from igl_periods.wording import counted

from .facts import MeshFacts


@dataclass(frozen=True)
class RepairStep:
    """One step of a repair: its name, and how many things it changed (0: nothing to do)."""

    name: str
    changed: int


@dataclass(frozen=True)
class MeshReport:
    """What was in a mesh file, and what was done to it.

    Attributes
    ----------
    file : str
    faces : int
        Faces in the file, polygons counted once.
    polygons_fanned : int
        Faces with more than three corners, replaced by the triangles of their fans.
    stl_corners_welded : int
        Vertices saved by giving STL corners at the same position one vertex.
    loaded : MeshFacts
        The mesh as it was read.
    repair : tuple of RepairStep
        Empty without repair.
    result : MeshFacts
        The mesh after repair; the same as ``loaded`` without.
    """

    file: str
    faces: int
    polygons_fanned: int
    stl_corners_welded: int
    loaded: MeshFacts
    repair: tuple[RepairStep, ...]
    result: MeshFacts

    def as_dict(self) -> dict[str, Any]:
        """All of it, as dictionaries, lists, numbers and strings."""
        document = asdict(self)
        for key in ("loaded", "result"):
            facts: MeshFacts = getattr(self, key)
            document[key]["components"] = [asdict(part) for part in facts.components]
            document[key]["defects"] = facts.defects()
        document["repair"] = [asdict(step) for step in self.repair]
        return document

    def __str__(self) -> str:
        """Lines to be read by a person."""
        lines = [f"{self.file}: {_size(self.loaded)}"]
        if self.polygons_fanned:
            fanned = counted(self.polygons_fanned, "polygon", "polygons")
            lines.append(f"  {self.faces} faces in the file; {fanned} divided into triangles")
        if self.stl_corners_welded:
            lines.append(f"  {self.stl_corners_welded} STL corners welded to an equal one")
        if self.loaded.unreferenced_vertices:
            unused = counted(self.loaded.unreferenced_vertices, "vertex", "vertices")
            lines.append(f"  {unused} without triangles")
        lines += [f"  {line}" for line in _parts(self.loaded)]
        lines += [f"  defect: {defect}" for defect in self.loaded.defects()]
        if any(step.changed for step in self.repair):
            lines += [f"  repair: {s.name}: {s.changed}" for s in self.repair if s.changed]
            lines.append(f"after repair: {_size(self.result)}")
            lines += [f"  {line}" for line in _parts(self.result)]
            lines += [f"  remaining defect: {defect}" for defect in self.result.defects()]
        elif self.repair:
            lines.append("  repair: nothing to do")
        return "\n".join(lines)


def _size(facts: MeshFacts) -> str:
    return f"{facts.vertices} vertices, {facts.triangles} triangles"


def _parts(facts: MeshFacts) -> list[str]:
    """Equal components on one line; the five most frequent kinds."""
    kinds = Counter(str(part) for part in facts.components).most_common()
    lines = [f"{count} × {kind}" if count > 1 else kind for kind, count in kinds[:5]]
    return lines + [f"and {len(kinds) - 5} other kinds of components"] * (len(kinds) > 5)

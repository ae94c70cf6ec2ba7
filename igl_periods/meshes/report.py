"""What was in a mesh file, and what was done to it, for people and for programs."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass
from typing import Any

from igl_periods.display import counted, lines_html

from .facts import MeshFacts


@dataclass(frozen=True)
class RepairStep:
    """One step of a repair.

    Attributes
    ----------
    name : str
    changed : int
        How many things it changed (0: nothing to do).
    distance : float
        How far apart vertices were that became one.
    """

    name: str
    changed: int
    distance: float = 0.0

    def __str__(self) -> str:
        """In words."""
        far = f", up to {self.distance:.2g} apart" if self.distance else ""
        return f"{self.name}: {self.changed}{far}"


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
    polygons_clipped : int
        Those divided otherwise: concave ones, and those with straight corners.
    polygons_not_planar : int
        Those whose corners leave the plane that fits them by more than 1e-6 of their size.
    unevenness : float
        The most by which corners of a polygon leave its plane, in parts of its size.
    repeated_corners : int
        Corners of polygons left out because they repeat the one before.
    stl_corners_welded : int
        Vertices saved by giving STL corners at the same position one vertex.
    warnings : tuple of str
        What is odd about the file.
    loaded : MeshFacts
        The mesh as it was read.
    repair : tuple of RepairStep
        Empty without repair.
    result : MeshFacts
        The mesh after repair; the same as ``loaded`` without.

    Examples
    --------
    >>> import igl_periods as ip
    >>> report = ip.load_mesh(ip.sample_files()["lawson_2_1"])[2]
    >>> report.faces, report.repair
    (1536, ())
    """

    file: str
    faces: int
    polygons_fanned: int
    polygons_clipped: int
    polygons_not_planar: int
    unevenness: float
    repeated_corners: int
    stl_corners_welded: int
    warnings: tuple[str, ...]
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

    def __repr__(self) -> str:
        defects = counted(len(self.result.defects()), "defect", "defects")
        steps = sum(step.changed > 0 for step in self.repair)
        repaired = f", {counted(steps, 'step', 'steps')} of repair" if self.repair else ""
        return f"MeshReport({self.file!r}: {_size(self.result)}, {defects}{repaired})"

    def _repr_html_(self) -> str:
        return lines_html("MeshReport", str(self).splitlines())

    def __str__(self) -> str:
        """Lines to be read by a person."""
        lines = [f"{self.file}: {_size(self.loaded)}"]
        lines += [f"  {line}" for line in self._polygons()]
        lines += [f"  warning: {warning}" for warning in self.warnings]
        if self.stl_corners_welded:
            lines.append(f"  {self.stl_corners_welded} STL corners welded to an equal one")
        if self.loaded.unreferenced_vertices:
            unused = counted(self.loaded.unreferenced_vertices, "vertex", "vertices")
            lines.append(f"  {unused} without triangles")
        lines += [f"  {line}" for line in _parts(self.loaded)]
        lines += [f"  defect: {defect}" for defect in self.loaded.defects()]
        if any(step.changed for step in self.repair):
            lines += [f"  repair: {step}" for step in self.repair if step.changed]
            lines.append(f"after repair: {_size(self.result)}")
            lines += [f"  {line}" for line in _parts(self.result)]
            lines += [f"  remaining defect: {defect}" for defect in self.result.defects()]
        elif self.repair:
            lines.append("  repair: nothing to do")
        return "\n".join(lines)

    def _polygons(self) -> list[str]:
        """What was made of polygons."""
        n = self.polygons_fanned + self.polygons_clipped
        lines = []
        if n:
            divided = counted(n, "polygon", "polygons")
            lines.append(f"{self.faces} faces in the file; {divided} divided into triangles")
        if self.polygons_clipped:
            lines[0] += f", {self.polygons_clipped} of them concave or with straight corners"
        if self.polygons_not_planar:
            uneven = counted(self.polygons_not_planar, "polygon is", "polygons are")
            lines.append(
                f"{uneven} not planar, by up to {self.unevenness:.2g} of their size: "
                "other triangles would make another surface"
            )
        if self.repeated_corners:
            repeated = counted(self.repeated_corners, "corner", "corners")
            lines.append(f"{repeated} of polygons left out, equal to the one before")
        return lines


def _size(facts: MeshFacts) -> str:
    return f"{facts.vertices} vertices, {facts.triangles} triangles"


def _parts(facts: MeshFacts) -> list[str]:
    """Equal components on one line; the five most frequent kinds."""
    kinds = Counter(str(part) for part in facts.components).most_common()
    lines = [f"{count} × {kind}" if count > 1 else kind for kind, count in kinds[:5]]
    return lines + [f"and {len(kinds) - 5} other kinds of components"] * (len(kinds) > 5)

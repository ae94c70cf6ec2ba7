"""What to do with a mesh that is not one closed, oriented surface, nearest remedy first."""

from __future__ import annotations

from .report import MeshReport


def way_out(report: MeshReport) -> str:
    """What to do next, in sentences; empty for a closed, oriented surface.

    Damage comes first: the double of a torn surface is a surface too, of another genus.
    """
    facts, repaired = report.result, bool(report.repair)
    orientable = all(part.orientable for part in facts.components)
    seams = f"{facts.seam_edges} boundary edges lie in pairs at the same place"
    damaged = (
        facts.collapsed_triangles
        or facts.nonmanifold_edges
        or facts.nonmanifold_vertices
        or (facts.inconsistent_edges and orientable)
    )
    if (damaged or facts.seam_edges) and not repaired:
        found = f"{seams}: they are seams, where the file tears the surface apart. " * bool(
            facts.seam_edges
        )
        return f"{found}Repair the mesh first: load_mesh(…, repair=True), --repair."
    words = []
    if facts.seam_edges:
        words.append(f"{seams}, and welding them would spoil triangles: look at them.")
    if facts.boundary_edges > facts.seam_edges:
        words.append(
            "Holes that do not belong to the surface can be filled: load_mesh(…, repair=True, "
            "largest_hole=SIZE), --fill-holes SIZE, up to SIZE edges each. Boundaries that do: "
            "take the double (igl_periods.double, --double)."
        )
    elif not orientable:
        words.append("Take the double, which is orientable (igl_periods.double, --double).")
    if len(facts.components) > 1:
        words.append("Take components one by one: K.components(), --component.")
    return " ".join(words)

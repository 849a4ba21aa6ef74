# SPDX-License-Identifier: GPL-3.0-or-later
"""What the library answers, said to users of Blender: what is wrong, where, and what to do."""

from contextlib import contextmanager

from . import found
from .fairmesh import ElementKind, FairmeshError, FillOutcome, FillReason, Outcome, Status

_ADVICE = {
    Status.NON_MANIFOLD_EDGE: "An edge must not have more than two faces here: delete the extra faces",
    Status.NON_MANIFOLD_VERTEX: "Faces that meet in this vertex only: split it (Mesh > Split, Rip) or deselect it",
    Status.INCONSISTENT_ORIENTATION: "Make the normals consistent: Mesh > Normals > Recalculate Outside",
    Status.DUPLICATE_TRIANGLE: "Delete the doubled face: Mesh > Clean Up > Merge by Distance",
    Status.REPEATED_INDEX: "Delete the broken face: Mesh > Clean Up > Degenerate Dissolve",
    Status.INDEX_OUT_OF_RANGE: "The mesh is corrupt: leave Edit mode and call Mesh.validate()",
    Status.NOT_FINITE: "The vertex has no valid position: delete it",
    Status.NOTHING_FIXED: "A whole piece of the mesh is selected: leave the part unselected that has to stay",
    Status.NO_NORMAL: "The faces around this vertex have no area: merge or dissolve them, or select them, too",
    Status.OUT_OF_MEMORY: "Select a smaller region, or close other programs",
    Status.THREADS: "Close other programs",
}


@contextmanager
def about(subject):
    """Notes in errors which `Snapshot` they are about."""
    try:
        yield
    except FairmeshError as why:
        why.subject = subject
        raise


def refused(why, subject):
    """The text for a `fairmesh.FairmeshError`; what it names can be selected then. `subject`: the `Snapshot`."""
    where = ""
    found.remember(None)
    if subject is not None:
        vertices, faces = _named(why, subject)
        if vertices or faces:
            kind = "vertex" if len(vertices) == 1 else "edge of vertices" if vertices else "face"
            numbers = " and ".join(str(i) for i in vertices or faces)
            where = f" ({kind} {numbers} of {subject.object.name})"
            found.remember(found.Found(subject.object, subject.counts, f"{kind} {numbers}", vertices, faces))
    advice = _ADVICE.get(why.status, "")
    ending = f". {advice}" if advice else ""
    return f"{why.message}{where}. The mesh is unchanged{ending}"


def _named(why, subject):
    """The vertices and the faces of Blender's mesh that an error is about."""
    if why.element is None:
        return [], []
    if why.element_kind == ElementKind.VERTEX:
        return [why.element], []
    if why.element_kind == ElementKind.EDGE:
        return [why.element, why.other], []
    if why.element_kind == ElementKind.TRIANGLE:
        return [], [int(subject.face_of[why.element])]
    return [], []


def faired(report):
    """How a fairing went: ("INFO" or "WARNING", text)."""
    vertices = f"{report.free_vertices} vertices faired in {report.iterations} iterations"
    reached = f"{100 * report.reached:.0f} %"
    texts = {
        Outcome.CONVERGED: ("INFO", f"{vertices}"),
        Outcome.CONVERGED_POOR_TRIANGLES: (
            "WARNING",
            f"{vertices}, but {report.poor_triangle_count} triangles are folded or thinner than 1 degree. "
            "Try another Distribution, or improve the mesh there",
        ),
        Outcome.CONVERGED_LOOSELY: ("WARNING", f"{vertices}, with a reservation: {report.reason}"),
        Outcome.NORMALS_NOT_REACHABLE: (
            "WARNING",
            f"No fair surface meets the surroundings with their tangent planes ({reached} of the way); a rough one was "
            "made. Select a larger region, or choose Averaged boundary normals",
        ),
        Outcome.TARGET_NOT_REACHABLE: (
            "WARNING",
            f"No surface is bulged that much ({reached} of the way); a rough one was made. Lower Bulge",
        ),
        Outcome.NOT_CONVERGED: (
            "WARNING",
            "No fair surface was found; a rough one was made. Select a larger or a smoother region",
        ),
        Outcome.ITERATION_LIMIT: (
            "WARNING",
            f"Not at its end after {report.iterations} iterations: raise Iterations, or lower Accuracy",
        ),
    }
    return texts.get(report.outcome, ("WARNING", f"{vertices}: {report.outcome}"))


_OPEN = {
    FillReason.NON_MANIFOLD: "its boundary runs into an edge with more than two faces",
    FillReason.OUTER_BOUNDARY: "it is the outer boundary of an open surface",
    FillReason.TOO_MANY_EDGES: "it has more edges than Largest Hole",
    FillReason.NO_TRIANGULATION: "every way to close it uses an edge that the mesh has already",
    FillReason.NOT_FINITE: "a vertex of its boundary has no valid position, or all are the same point",
    FillReason.CANCELLED: "it was cancelled",
    FillReason.NO_INNER_VERTEX: "it is too small to have vertices inside",
    FillReason.UNSOUND: "no fair surface was found",
    FillReason.REFUSED: "the mesh around it is defective",
}


def filled(loops):
    """How a filling went: ("INFO" or "WARNING", text). `loops`: a list of `fairmesh.LoopReport`."""
    closed = [loop for loop in loops if loop.outcome is not FillOutcome.LEFT_OPEN]
    text = f"{len(closed)} {'hole' if len(closed) == 1 else 'holes'} filled"
    rough = [loop for loop in closed if _is_rough(loop)]
    still = [loop for loop in loops if loop.outcome is FillOutcome.LEFT_OPEN]
    if rough:
        text += f", {len(rough)} of them not fair: {_reason(rough[0])}"
    if still:
        text += f"; {len(still)} left open: {_reason(still[0])}"
    coarse = sum(loop.coarsened for loop in closed)
    if coarse:
        text += f"; {coarse} coarser than asked, to keep the number of vertices"
    return ("WARNING" if rough or still or coarse else "INFO"), text


def _is_rough(loop):
    if loop.outcome is FillOutcome.FLAT:
        return loop.reason not in (FillReason.NOT_ASKED, FillReason.NO_INNER_VERTEX)
    return loop.outcome is not FillOutcome.FAIRED or not loop.report.outcome.is_success


def _reason(loop):
    if loop.reason in _OPEN:
        return f"{_OPEN[loop.reason]} ({loop.edge_count} edges)"
    if loop.report is not None:
        return faired(loop.report)[1]
    return str(loop.reason)

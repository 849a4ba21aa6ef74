# SPDX-License-Identifier: GPL-3.0-or-later
"""What the library answers, said to users of Blender: what is wrong, where, and what to do."""

from contextlib import contextmanager

from . import advice, found
from .fairmesh import ElementKind, FairmeshError, FillOutcome, FillReason, LooseReason, Outcome, SharpFate

# How much of it there is. `r` is the report.
_FIGURES = {
    Outcome.CONVERGED_POOR_TRIANGLES: " ({r.poor_triangle_count} triangles)",
    Outcome.POOR_WHEN_ROUNDED: " ({r.poor_triangle_count} triangles)",
    Outcome.BOUNDARY_CREASE: " ({r.creased_vertex_count} vertices, up to {r.boundary_kink:.0f} degrees)",
    Outcome.SELF_INTERSECTING: " ({r.intersection_count} pairs, {r.intersections_in_input} before the fairing)",
    Outcome.TARGET_NOT_REACHABLE: " ({reached:.0f} % of it)",
    Outcome.NEAREST_MEMBER: " (w = {r.member_weight:.3g} between the shapes Natural, 0, and Elastic Sheet, 1)",
}


@contextmanager
def about(subject, face_of=None):
    """Notes in errors which `Snapshot` they are about, and which of its faces the triangles are of, if not of all."""
    try:
        yield
    except FairmeshError as why:
        why.subject = subject
        why.face_of = subject.face_of if face_of is None else face_of
        raise


def name_before(parts, part):
    """The name of the object that a part is of, where there are several."""
    return f"{part.mesh.object.name}: " if len(parts) > 1 else ""


def refused(why, subject):
    """The text for a `fairmesh.FairmeshError`; what it names can be selected then. `subject`: the `Snapshot`."""
    # Where nothing of Blender's is named, the library may have an argument to name.
    text = why.message
    found.remember(None)
    if subject is not None:
        vertices, faces = _named(why)
        if vertices or faces:
            kind = "vertex" if len(vertices) == 1 else "edge of vertices" if vertices else "face"
            numbers = " and ".join(str(i) for i in vertices or faces)
            text = f"{kind.capitalize()} {numbers} of {subject.object.name}: {advice.meaning(why.status)}"
            found.remember(found.Found(subject.object, subject.counts, f"{kind} {numbers}", vertices, faces))
    return _sentences(text, "The mesh is unchanged", advice.remedy(why.status))


def _sentences(*parts):
    return ". ".join(part for part in parts if part)


def _named(why):
    """The vertices and the faces of Blender's mesh that an error is about."""
    if why.element is None:
        return [], []
    if why.element_kind == ElementKind.VERTEX:
        return [why.element], []
    if why.element_kind == ElementKind.EDGE:
        return [why.element, why.other], []
    if why.element_kind == ElementKind.TRIANGLE:
        return [], [int(why.face_of[why.element])]
    return [], []


def faired(report, continuity=0.0, is_patch=False):
    """How a fairing, or that of new faces, went; curvature was to go on so far, or "auto": ("INFO" or "WARNING", text)."""
    count = _many(report.iterations, "iteration", "iterations")
    vertices = f"{_many(report.free_vertices, 'vertex', 'vertices')} faired in {count}"
    short = _curvature([report], continuity) + ("" if is_patch else _sharp_edges([report]))
    if report.outcome is Outcome.CONVERGED:
        return "INFO", vertices + short
    figures = _FIGURES.get(report.outcome, "").format(r=report, reached=100 * report.reached)
    answer = report.loose_reason if report.outcome is Outcome.CONVERGED_LOOSELY else report.outcome
    text = f"{vertices}{_components(report)}: {advice.meaning(answer)}{figures}"
    return "WARNING", _sentences(text, advice.remedy(answer, is_patch)) + short


def _curvature(reports, asked):
    """Where curvature is continued unasked, or not as far as was asked; empty where all is as asked."""
    if asked == 0 or not reports:
        return ""
    loops = [loop for report in reports for component in report.components for loop in component.continuity]
    if asked == "auto":
        count = sum(loop.reached > 0 for loop in loops)
        return f"; curvature goes on along {count} of {_many(len(loops), 'boundary', 'boundaries')}" if count else ""
    if not loops:
        return "; curvature is not continued: no boundary has surroundings and vertices enough, or no surface was found"
    # Where the jump is no larger than the doubt about it, there is nothing to be continued.
    short = [loop for loop in loops if loop.reached < 0.9 * asked and loop.jump_before > loop.uncertainty]
    if not short:
        return ""
    least = min(short, key=lambda loop: loop.reached)
    where = f"the boundary of {least.vertex_count} vertices at vertex {least.vertex}"
    return f"; curvature is continued by {least.reached:.2f} in place of {asked:.2f} along {where}"


def _sharp_edges(reports):
    """How many sharp edges go on, and where one does not and why; empty where there are none."""
    edges = [edge for report in reports for edge in report.sharp_edges]
    ended = [edge for edge in edges if edge.fate not in {SharpFate.GOES_ON, SharpFate.CORNER}]
    text = f"; {_many(len(edges) - len(ended), 'sharp edge goes', 'sharp edges go')} on" if len(ended) < len(edges) else ""
    if ended:
        end = ended[0].ends[0]
        text += f"; {_many(len(ended), 'sharp edge ends', 'sharp edges end, one')}"
        text += f" at vertex {end.vertex} ({end.angle:.0f} degrees)"
        if all(report.loose_reason is not LooseReason.SHARP_EDGE for report in reports):
            text += _sentences(f": {advice.meaning(ended[0].fate)}", advice.remedy(ended[0].fate))
    return text


def _components(report):
    """How many components of the region are fair, where some are and some are not."""
    bad = [component for component in report.components if not component.outcome.is_success]
    fair = len(report.components) - len(bad)
    if not fair or not bad:
        return ""
    return f" ({fair} of {len(report.components)} separate parts are fair; one that is not is at vertex {bad[0].vertex})"


def filled(loops, places, continuity=0.0, size=1.0):
    """How a filling went: ("INFO" or "WARNING", text). `loops`: a list of `fairmesh.LoopReport`; `size`: of their unit.

    `places`: by the library's numbers of loops, a vertex of each.
    """
    closed = [loop for loop in loops if loop.outcome is not FillOutcome.LEFT_OPEN]
    text = _count(closed) + _moved(closed, size)
    rough = [loop for loop in closed if not loop.is_success]
    still = [loop for loop in loops if loop.outcome is FillOutcome.LEFT_OPEN]
    if rough:
        text += f", {len(rough)} of them not fair: {reason(rough[0], places)}"
    if still:
        text += f"; {len(still)} left open: {reason(still[0], places)}"
    coarse = sum(loop.coarsened for loop in closed)
    if coarse:
        text += f"; {coarse} coarser than asked, to keep the number of vertices"
    reports = [loop.report for loop in closed if loop.report is not None]
    text += _curvature(reports, continuity) + _sharp_edges(reports)
    return ("WARNING" if rough or still or coarse else "INFO"), text


def bridged(result, is_faired):
    """How a bridge went: ("INFO" or "WARNING", text)."""
    text = f"bridge of {result.new_face_count} faces"
    loops = [result.strip, *result.rest]
    reports = [result.whole] if result.whole is not None else [loop.report for loop in loops if loop.report is not None]
    if not is_faired or result.is_success:
        return "INFO", text + _sharp_edges(reports)
    if result.whole is not None:
        return "WARNING", f"{text}; together, {faired(result.whole)[1]}"
    rough = [loop for loop in loops if loop.outcome is FillOutcome.LEFT_OPEN or not loop.is_success]
    return "WARNING", text + (f", not fair: {reason(rough[0], {})}" if rough else "") + _sharp_edges(reports)


def rounded(mesh, result):
    """How rounding went: ("INFO" or "WARNING", text). What stays sharp, or is narrower than asked, can be selected then."""
    done = [crease for crease in result.creases if crease.is_rounded]
    sharp = [crease for crease in result.creases if crease.is_unsolved]
    narrow = [crease for crease in done if crease.part < 0.999]
    text = f"{_many(len(done), 'run', 'runs')} of edges rounded"
    if sharp:
        text += f"; {_many(len(sharp), 'run stays', 'runs stay')} sharp, as no sound blend was found"
    if len(result.sharp_corners):
        text += f"; {_many(len(result.sharp_corners), 'corner stays', 'corners stay')} sharp, and blends end before"
    if narrow:
        least = min(crease.part for crease in narrow)
        text += f"; {len(narrow)} narrower than asked, where there is less room: down to {100 * least:.0f} %"
    report = result.report
    if report.loose_reason is LooseReason.SHARP_EDGE:
        text += "; sharp edges that are not rounded end at blends"
    elif not result.is_success and not sharp and not len(result.sharp_corners):
        text = _sentences(text, faired(report, is_patch=True)[1])
    return ("INFO" if result.is_success and not narrow else "WARNING"), text


def faces(count):
    """The subject of a sentence."""
    return _many(count, "face was", "faces were")


def _many(count, one, more):
    return f"{count} {one if count == 1 else more}"


def _count(closed):
    """How many holes were filled, and how many loops joined."""
    joined = [loop for loop in closed if len(loop.loop_indices) > 1]
    parts = []
    if len(joined) < len(closed):
        parts.append(f"{_many(len(closed) - len(joined), 'hole', 'holes')} filled")
    if joined:
        count = sum(len(loop.loop_indices) for loop in joined)
        parts.append(f"{count} loops joined by {_many(len(joined), 'patch', 'patches')}")
    return ", ".join(parts) or "nothing filled"


def _moved(closed, size):
    """How many vertices around the holes moved, and how far."""
    moved = [loop.moved for loop in closed if loop.moved is not None and loop.moved.count]
    if not moved:
        return ""
    count, largest = sum(each.count for each in moved), size * max(each.largest for each in moved)
    return f"; {count} vertices around moved, by {largest:.3g} at most"


def reason(loop, places):
    """Why a loop is open or its patch not fair, and what to do."""
    if loop.moved is not None and loop.moved.unsound:
        text = f"{loop.moved.unsound} old faces beside it are folded or intersect since the rim moved"
        return _sentences(text, advice.named("Change {relax_rim}"))
    if loop.outcome is FillOutcome.SELF_INTERSECTING:
        text = f"{advice.meaning(loop.outcome)} ({len(loop.intersections)} pairs of faces)"
        return _sentences(text, advice.remedy(loop.outcome))
    if loop.report is not None and loop.reason in {FillReason.NONE, FillReason.UNSOUND}:
        return faired(loop.report, is_patch=True)[1]
    return _sentences(f"{advice.meaning(loop.reason)}{_place(loop, places)}", advice.remedy(loop.reason))


def why(answer):
    """What is said of a loop that was left out for this."""
    return f"{advice.meaning(answer)}. {advice.remedy(answer)}"


def _place(loop, places):
    """Where it is, in Blender's numbers where it has some."""
    if loop.reason is FillReason.OPPOSITE_SIDES and all(index in places for index in loop.reason_elements):
        return " (the loops at vertices {} and {})".format(*(places[index] for index in loop.reason_elements))
    if loop.reason in {FillReason.NON_MANIFOLD, FillReason.INCONSISTENT}:
        return " (vertices {} and {})".format(*loop.reason_elements)
    if loop.reason in {FillReason.SHARED_VERTEX, FillReason.HANGING, FillReason.NOT_FINITE} and loop.reason_elements:
        return f" (vertex {loop.reason_elements[0]})"
    return f" ({loop.edge_count} edges)"

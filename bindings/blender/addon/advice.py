# SPDX-License-Identifier: GPL-3.0-or-later
"""What the library's answers mean and what to do about them, in the words that Blender's user has before him.

`{option}`, `{option.CHOICE}` and `{fairmesh_operator}` stand for the labels of what they name: each is written once, where
it is declared. An answer that is not here is told as the library does: then it names no option.
"""

import re

import bpy

from .fairmesh import FillOutcome, FillReason, LooseReason, Outcome, SharpFate, Status

#: By enumeration, as some have members of the same name: what an answer means (None: the library says it well), what to do.
_WORDS = {
    Status: {
        Status.OUT_OF_MEMORY: (None, "Select a smaller region, or close other programs"),
        Status.NOT_FINITE: ("a coordinate is not a finite number", "Repair the vertex, or select a region away from it"),
        Status.THREADS: (None, "Close other programs"),
        Status.NON_MANIFOLD_EDGE: (
            None,
            "Repair the mesh there (Select > Select All by Trait > Non Manifold), or select less",
        ),
        Status.NON_MANIFOLD_VERTEX: (
            None,
            "Faces that meet in this vertex only: split it (Mesh > Split > Faces & Edges by Vertices) or deselect it",
        ),
        Status.INCONSISTENT_ORIENTATION: (
            "two faces at an edge face opposite ways",
            "Make the normals consistent: Mesh > Normals > Recalculate Outside",
        ),
        Status.DUPLICATE_TRIANGLE: (None, "Delete the doubled face: Mesh > Clean Up > Merge by Distance"),
        Status.REPEATED_INDEX: (None, "Delete the broken face: Mesh > Clean Up > Degenerate Dissolve"),
        Status.INDEX_OUT_OF_RANGE: (None, "The mesh is corrupt: leave Edit mode and call Mesh.validate()"),
        Status.NO_NORMAL: (None, "The faces around this vertex have no area: merge or dissolve them, or select them, too"),
        Status.NOTHING_FIXED: ("a part of the selection has nothing around it that stays", "Deselect some of its vertices"),
        Status.NOT_ORIENTABLE: (None, "Cut it open (Mesh > Split), or deselect it"),
        Status.BAD_GUIDE: (
            "a pair does not join two boundary vertices that one patch can have an edge between",
            "Select pairs of vertices of one loop that are no neighbours, or of two loops that are joined, each once",
        ),
        Status.GUIDES_CROSS: ("two pairs cross each other", "Deselect one of them, or switch {guides} off"),
        Status.BAD_CHAIN: (
            "what is selected is no run of edges of one boundary loop",
            "Select edges one after the other along a boundary",
        ),
        Status.NO_FAIR_PATCH: (None, "Run {fairmesh_fair}, or use {fairmesh_erase_and_fill} with {on_failure.BEST}"),
        Status.NO_BUMP: (None, "Select the bump"),
        Status.NO_CREASE: (None, "Select sharp edges"),
        Status.BAD_EDIT: (None, "Begin {fairmesh_live} again"),
    },
    Outcome: {
        Outcome.CONVERGED: ("smooth, and the surface is sound", ""),
        Outcome.CONVERGED_LOOSELY: ("smooth, and no face is poor, but there is something to be said of it", ""),
        Outcome.CONVERGED_POOR_TRIANGLES: (
            "smooth, but faces are flipped or have an angle below one degree",
            "Look at these faces; {inner_fairness.UNIFORM}, or {fairmesh_erase_and_fill}, usually cures them",
        ),
        Outcome.TARGET_NOT_REACHABLE: (
            "a surface was found for a part of {constant} only; that of least bending is written",
            "Give less {constant}, or select a smaller region",
        ),
        Outcome.NOT_CONVERGED: (
            "no sound surface was found; that of least bending is written",
            "Select more, set {boundary_normals.AVERAGED}, or use {fairmesh_erase_and_fill}",
        ),
        Outcome.ITERATION_LIMIT: (
            "the iterations ran out; the best surface so far is written",
            "Allow more {max_iterations}, or run it once more",
        ),
        Outcome.CANCELLED: ("it was stopped", "Run it again, to its end"),
        Outcome.BOUNDARY_CREASE: (
            "smooth, but with a crease along the boundary of the selection",
            "Move the boundary away from sharp features or noise: select more or less there, or subdivide the faces there",
        ),
        Outcome.SELF_INTERSECTING: (
            "smooth, but faces intersect each other or the rest of the mesh",
            "Look at these faces; select more, or use {fairmesh_erase_and_fill}",
        ),
        Outcome.POOR_WHEN_ROUNDED: (
            "smooth, but Blender's single precision flips faces or leaves them without angles",
            "Move the mesh near to the origin of its object, and scale it up",
        ),
        Outcome.NEAREST_MEMBER: (
            "no surface is {target.HARMONIC}; a smooth one with these tangents, towards {target.MINIMAL_ENERGY}, is written",
            "Look at it. {target.MINIMAL_ENERGY} often suits elbows; another selection may have one that is",
        ),
    },
    LooseReason: {
        LooseReason.SUSPICIOUS_NORMALS: (
            "faces around the selection seem to face the other way",
            "Mesh > Normals > Recalculate Outside, or set {boundary_normals.AVERAGED}",
        ),
        LooseReason.ROUNDING: (
            "as smooth as the rounding of the positions allows",
            "Nothing needs to be done; near to the origin of its object the mesh is more exact",
        ),
        LooseReason.BUMP: (
            None,
            "Look at it; {inner_fairness.CONFORMAL}, a larger selection, or one with a smoother boundary, usually cures it",
        ),
        LooseReason.TOLERANCE: (
            "the steps have become as small as they can be here, but not as small as {digits} asks for",
            "Ask for less {digits}",
        ),
        LooseReason.DRAWN_NORMALS: (
            "no sound surface over this hole goes on smoothly from the faces around it everywhere",
            "Look at it; set {relax_rim} or {trim}, or select faces around it, too, and use {fairmesh_erase_and_fill}",
        ),
        LooseReason.CURVATURE: (
            "less than half of {continuity} was reached: the surroundings are too rough, or no sound surface has it",
            "Look at it; ask for less {continuity}, or select a larger region",
        ),
        LooseReason.SHARP_EDGE: (
            "a sharp edge ends at the selection and does not go on in it",
            "Select so much that the sharp edge ends outside, or leaves the selection again; or set {sharp.OFF}",
        ),
    },
    SharpFate: {
        SharpFate.ALONE: (
            "no other end fits it: inside, the surface is smooth",
            "Select so much that it ends outside, or leaves the selection again",
        ),
        SharpFate.NO_PATH: (
            "no path of edges can follow it: inside, the surface is smooth",
            "Use {fairmesh_erase_and_fill}",
        ),
    },
    FillOutcome: {
        FillOutcome.SELF_INTERSECTING: (
            None,
            "Look at these faces; set {relax_rim} or {trim}, or delete faces around the hole",
        ),
    },
    FillReason: {
        FillReason.NON_MANIFOLD: (
            "the boundary runs into an edge with more than two faces",
            "Repair the mesh there: Select > Select All by Trait > Non Manifold finds it",
        ),
        FillReason.OUTER_BOUNDARY: ("it is the outer boundary of an open surface", "Switch on {outer} to fill it"),
        FillReason.TOO_MANY_EDGES: ("it has more edges than {max_edges}", "Allow more"),
        FillReason.NO_TRIANGULATION: (
            "every way to fill it has an edge or a face that the mesh has already",
            "Delete the faces that span the hole",
        ),
        FillReason.NOT_FINITE: (None, "Delete these vertices"),
        FillReason.OPPOSITE_SIDES: (
            "two of the loops to be joined fit only if the faces at one of them faced the other way",
            "Turn the normals of one of the two parts around: select it (L), Mesh > Normals > Flip",
        ),
        FillReason.SHARED_VERTEX: (
            None,
            "Fill each by itself, or split the vertex (Mesh > Split > Faces & Edges by Vertices)",
        ),
        FillReason.NOT_ASKED_FOR: (None, "Select it"),
        FillReason.NOT_FAIR: (
            "no patch was found that is fair, and {on_failure.OPEN} is set",
            "Set {on_failure.BEST}, join it to its neighbours by {fairmesh_join_loops}, or delete faces around it",
        ),
        FillReason.INTERSECTS: (
            "every patch that was tried intersects itself or the mesh",
            "Join the loop to its neighbours by {fairmesh_join_loops}, set {trim}, or delete faces around it",
        ),
        FillReason.HANGING: (
            "it is the outer boundary of faces that hang at the rest of the mesh by single vertices only",
            "Delete these faces, or switch on {outer} to fill it",
        ),
        FillReason.INCONSISTENT: (
            "the boundary runs into an edge whose two faces face opposite ways",
            "Make the normals consistent: Mesh > Normals > Recalculate Outside",
        ),
        FillReason.NOT_ASKED: ("{smooth} is off", ""),
        FillReason.REFUSED: (None, "Repair the mesh there"),
        FillReason.INTERSECTING: (None, "Set {relax_rim} or {trim}, or delete faces around the hole"),
    },
}
# New faces are selected, so that they can be faired by themselves; a single hole has a limit of its own.
_PATCH = {
    Outcome.ITERATION_LIMIT: (
        "Run {fairmesh_fair} with {region.FACES} on the new faces; between the ends of tubes allow more {max_iterations}, "
        "in a single hole they are 64 at most"
    ),
    Outcome.BOUNDARY_CREASE: "Set {relax_rim} or {trim}, or delete sharp faces around the hole and fill it again",
    Outcome.SELF_INTERSECTING: "Look at these faces; set {relax_rim} or {trim}, or delete faces around the hole",
}


def meaning(answer):
    """What an answer of the library says."""
    text = _words(answer)[0]
    return named(text) if text else answer.text.replace("triangle", "face")


def remedy(answer, is_patch=False):
    """What to do about it, a sentence without its end; empty where there is nothing to do. `is_patch`: of new faces."""
    text = (_PATCH.get(answer) if is_patch and isinstance(answer, Outcome) else None) or _words(answer)[1]
    return named(text) if text is not None else _sentence(answer.remedy.replace("triangle", "face"))


def _words(answer):
    return _WORDS.get(type(answer), {}).get(answer, (None, None))


def named(text):
    """The text with the labels that are asked for."""
    return re.sub(r"\{(\w+)(?:\.(\w+))?\}", _label, text)


def _label(match):
    name, choice = match.groups()
    if name.startswith("fairmesh_"):
        return getattr(bpy.ops.mesh, name).get_rna_type().name
    option = bpy.types.Scene.bl_rna.properties["fairmesh"].fixed_type.properties[name]
    return f"{option.name}: {option.enum_items[choice].name}" if choice else option.name


def _sentence(text):
    return text[:1].upper() + text[1:]

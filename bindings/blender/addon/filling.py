# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators that make patches have in common: their options, the library's call, what is written and said."""

from dataclasses import dataclass, field

import bpy
import numpy as np

from . import advice, custom_normals, fairmesh, found, messages, pairs, patch, rows, snapshot
from .fairing_options import FairingOptions
from .job import for_each
from .patch_options import PatchOptions, RimOptions

_HIDDEN = "vertices around a hole would move that are hidden: show them (Alt-H), or let fewer move by {relax_rim}"


@dataclass
class Holes:
    """What is to be filled of one object."""

    mesh: snapshot.Snapshot
    #: [(its number, the loop)]; those of `triangles`.
    loops: list
    #: The mesh that is filled, (m, 3), and the faces of the object that are not in it.
    triangles: np.ndarray
    erased: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))
    #: How many of these were trimmed away.
    trimmed: int = 0
    #: Which of the loops get one patch, as `fairmesh.fill_holes` takes it; of a bridge its two runs of vertices.
    join: object = "none"
    #: Pairs of vertices that the patch is to begin with an edge between.
    guides: list = field(default_factory=list)
    #: Loops that are left out although they are meant: [(how many, why)].
    skipped: list = field(default_factory=list)
    result: object = None

    def listed(self):
        """The loops that are filled by themselves, or looked at for joining."""
        return [] if isinstance(self.join, list) else [index for index, _ in self.loops]

    @property
    def face_of(self):
        """The face of the object that each of `triangles` is a part of."""
        of = self.mesh.face_of
        return of[~np.isin(of, self.erased)]

    def places(self):
        """By the library's number of each loop, a vertex of it."""
        return {index: int(loop.vertices[0]) for index, loop in self.loops}

    def moved(self):
        """The old vertices that the result has elsewhere: rims that were allowed to move."""
        now = self.result.vertices[: len(self.mesh.vertices)]
        # A coordinate that is no number stays one.
        return np.flatnonzero(((now != self.mesh.seen()) & np.isfinite(now)).any(axis=1))


class Filling(FairingOptions, PatchOptions):
    """Mixed into operators that make patches."""

    def draw_filling(self, layout):
        """What the patch is to be."""
        self.draw_patch(layout)
        if self.smooth:
            self.draw_fairing(layout)

    def patch_keywords(self, extent):
        """The options for the library; `extent`: that of the holes, for the constant of the target."""
        return {
            **self.own_keywords(),
            **self.fairing_keywords(extent),
        }

    def told(self, holes):
        """How it went."""
        return messages.filled(holes.result.loops, holes.places(), self.asked_continuity(), holes.mesh.size)

    def work_on(self, chosen):
        """A function for the thread that fills all of `chosen`, a list of `Holes`."""
        # The thread reads no properties.
        keywords = self.patch_keywords(
            largest_diagonal((holes.mesh, loop.vertices) for holes in chosen for _, loop in holes.loops)
        )

        has_rows = self.faces != "TRIANGLES" and self.smooth and not getattr(self, "relax_rim", 0)
        density, fairing = self.density, {name: keywords[name] for name in self.fairing_keywords(1.0)}
        marked_keywords = self.marked_keywords()
        rim_keywords = self.rim_keywords() if isinstance(self, RimOptions) else lambda size: {}

        def compute(holes, monitor):
            mesh = holes.mesh
            filled = fairmesh.fill_holes(
                mesh.seen(),
                holes.triangles,
                loops=holes.listed(),
                join=holes.join,
                guides=np.array(holes.guides) if holes.guides else None,
                cancel=monitor,
                **rim_keywords(mesh.size),
                **marked_keywords(mesh),
                **keywords,
            )
            # Pairs say how the loops are turned against each other.
            return rows.instead(holes, filled, density, fairing, monitor) if has_rows and not holes.guides else filled

        return for_each(chosen, compute)

    def finish(self, context, chosen):
        """Writes what was found, if there is no objection to any of it."""
        for holes in chosen:
            why = self.objection(holes)
            if why is not None:
                self.tell({"ERROR"}, f"{messages.name_before(chosen, holes)}{why}. The mesh is unchanged")
                return {"CANCELLED"}
        return self.write(chosen)

    def objection(self, holes):
        """Why a result is not to be written; None: it is."""
        if holes.trimmed and not holes.result.new_face_count:
            return messages.filled(holes.result.loops, holes.places())[1]
        return None

    def write(self, chosen):
        """Puts the patches into the meshes, and says how it went."""
        for holes in chosen:
            snapshot.edit_mesh(holes.mesh)  # all are still there, before the first is changed
            if holes.mesh.vertex_hidden[holes.moved()].any():
                self.tell({"ERROR"}, f"{messages.name_before(chosen, holes)}{advice.named(_HIDDEN)}. The mesh is unchanged")
                return {"CANCELLED"}
        bpy.ops.mesh.select_all(action="DESELECT")
        for holes in chosen:
            custom_normals.mark(holes.mesh)
            patch.add(holes.mesh, holes.result, holes.erased, holes.moved(), pair=self.faces == "QUADS")
            kind, text = self.told(holes)
            more = len(holes.erased) - np.count_nonzero(holes.mesh.face_selected[holes.erased])
            if holes.trimmed:
                text += f"; {messages.faces(holes.trimmed)} trimmed away"
            elif more:
                text += f"; {messages.faces(more)} erased besides: they hung loose or would have spoilt the rim"
            for count, why in holes.skipped:
                text += f"; {count} left open: {why}"
            self.tell({kind}, messages.name_before(chosen, holes) + text)
        custom_normals.put_back(holes.mesh for holes in chosen)
        return {"FINISHED"}


def read(obj):
    """The `Holes` of an object: all of its loops."""
    mesh = snapshot.read(obj)
    with messages.about(mesh):
        loops = list(enumerate(fairmesh.boundary_loops(mesh.seen(), mesh.triangles)))
    return Holes(mesh, loops, mesh.triangles)


def hanging(holes):
    """Of the loops, by `id`, those around faces that hang at larger pieces of the mesh by single vertices only.

    Such faces are remembered, so that they can be selected.
    """
    mesh = holes.mesh
    outer = [loop for _, loop in holes.loops if loop.kind is fairmesh.LoopKind.OUTER_BOUNDARY]
    if not outer:
        return set()
    of = fairmesh.components(mesh.seen(), holes.triangles)
    largest = np.zeros(len(mesh.vertices), np.int64)
    np.maximum.at(largest, holes.triangles, np.bincount(of)[of][:, None])
    made = [loop for loop in outer if largest[loop.vertices].max() > loop.component_faces]
    if made:
        faces = np.unique(holes.face_of[np.isin(of, [loop.component for loop in made])])
        found.remember(
            found.Found(mesh.object, mesh.counts, f"{len(faces)} faces that hang by single vertices", faces=faces)
        )
    return {id(loop) for loop in made}


def trimmed(holes, chosen, most, area):
    """Takes faces away at the loops `chosen` that would spoil their patches.

    `most`: so many triangles; `area`: of so much area, as seen in the scene, 0: of any. Faces go as a whole. Returns all
    loops of what is left, and what became of those chosen.
    """
    mesh = holes.mesh
    with messages.about(mesh):
        left = fairmesh.trim_boundary(
            mesh.seen(),
            holes.triangles,
            most,
            loops=[index for index, _ in chosen],
            max_area=area / mesh.size**2 if area > 0 else None,
        )
        gone = np.ones(len(holes.triangles), bool)
        gone[left.kept_faces] = False
        holes.erased = np.unique(mesh.face_of[gone])
        gone = np.isin(mesh.face_of, holes.erased)
        holes.triangles = mesh.triangles[~gone]
        loops = list(enumerate(fairmesh.boundary_loops(mesh.seen(), holes.triangles)))
    holes.trimmed = len(holes.erased)
    near = np.zeros(len(mesh.vertices), bool)
    near[mesh.triangles[gone]] = True
    for _, loop in chosen:
        near[loop.vertices] = True
    return loops, [(index, loop) for index, loop in loops if near[loop.vertices].all()]


def guide(operator, chosen):
    """Sets the guides, if the operator is to have any, to the pairs of vertices that are selected; False: it found none."""
    if not operator.guides:
        return True
    why = ""
    for holes in chosen:
        holes.guides, why_not = pairs.of(holes.mesh)
        why = why or why_not
    if any(holes.guides for holes in chosen):
        return True
    operator.tell({"ERROR"}, why)
    return False


def largest_diagonal(rims):
    """Of the bounding boxes as seen in the scene; `rims`: (mesh, its vertices around what is to be filled)."""
    return max(float(np.linalg.norm(np.ptp(mesh.seen()[vertices], axis=0))) for mesh, vertices in rims)


def selected(holes, at_least=1):
    """Loops whose edges are all selected; where these are fewer, those with a selected edge; then with a selected vertex."""
    marks = _marks(holes)
    for level in range(3):
        chosen = [loop for loop, mark in zip(holes.loops, marks) if mark[level]]
        if len(chosen) >= at_least:
            break
    return chosen


def _marks(holes):
    """Per loop: whether all of its edges are selected; any edge; any vertex."""
    mesh = holes.mesh
    selected = _keys(snapshot.selected_edges(mesh.object), len(mesh.vertices))
    made = []
    for _, loop in holes.loops:
        ends = np.stack([loop.vertices, np.roll(loop.vertices, -1)], axis=1)
        edges = np.isin(_keys(ends, len(mesh.vertices)), selected)
        made.append((edges.all(), edges.any(), mesh.vertex_selected[loop.vertices].any()))
    return made


def remember_refused(holes):
    """Offers to select what a patch was refused for: two loops, a vertex."""
    for report in holes.result.loops:
        if report.outcome is not fairmesh.FillOutcome.LEFT_OPEN or not report.reason_elements:
            continue
        vertices, what = list(report.reason_elements), "what keeps a hole open"
        if report.reason is fairmesh.FillReason.OPPOSITE_SIDES:
            loops = dict(holes.loops)
            vertices = np.concatenate([loops[index].vertices for index in report.reason_elements])
            what = "two loops that face opposite ways"
        found.remember(found.Found(holes.mesh.object, holes.mesh.counts, what, vertices=vertices))
        return


def _keys(edges, count):
    """A number for each edge, the same for both directions."""
    edges = edges.astype(np.int64)
    return edges.min(axis=1) * count + edges.max(axis=1)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A region under Fair Live: its solver, its boundary loops, and edits in force. Knows nothing of windows and events."""

from dataclasses import replace

import numpy as np

from . import fairmesh, live_edits, live_loops, region

# Beyond, one cannot speak of frames any more, and the first surface alone takes a minute.
MOST_FREE = 250_000
# The step of a frame, in diagonals, beyond which nobody would want to see it, and beyond which it is not as good as fair.
WILD, ROUGH = 0.05, 1e-3
# So far from its place a mirror image may lie, in lengths of the loop's edges.
NEAR = 0.02


class LiveRegion:
    """The free vertices of one object, and the surface between the loops around them, as it stands."""

    def __init__(self, mesh, free, symmetry, keywords):
        self.mesh = mesh
        self.free = free
        self.loops = live_loops.loops_of(mesh, free)
        self.result = None
        self._symmetry = symmetry
        self._keywords = keywords
        self._seen = self._shown = self._settled = mesh.seen()
        self._solver = None
        #: Frames get no nearer to the fair surface; what is shown is the last one that settled then, or one that is near.
        self.is_stuck = False

    def start(self, monitor):
        """Makes the solver and fairs as Fair Selection does, on any thread."""
        keywords = {**self._keywords, "cancel": monitor}
        self._solver = fairmesh.Solver(self._seen, self.mesh.triangles, free=self.free, **keywords)
        self._solver.run()
        given = self._solver.result()
        self._shown = self._settled = given.vertices
        # Normals are no directions: a shape that stretches them would turn them away from the surface.
        shape = np.eye(3) if self.mesh.shape is None else self.mesh.shape
        normals = given.boundary_normals @ shape
        self._normals = np.zeros_like(self._seen)
        self._normals[given.boundary_vertices] = normals / np.linalg.norm(normals, axis=1)[:, None]

    def edit(self, edits, axes):
        """Puts these edits in force, and their mirror images across the axes."""
        wanted = [each for each in self.with_images(edits, axes) if not each.is_nothing]
        self._solver.edit([live_edits.for_library(each, self) for each in wanted])

    def update(self, seconds):
        """One frame; says whether the surface has settled. Where frames are stuck, `recover` is next, with other edits."""
        frame = self._solver.update(seconds=seconds)
        if frame.is_settled or frame.step < WILD:
            self._shown = self._solver.vertices
        if frame.is_settled:
            self._settled = self._shown
        elif frame.evaluations == 0:
            self.is_stuck = True
            if frame.step > ROUGH:
                self._shown = self._settled
        return frame.is_settled

    def recover(self):
        """Finds the surface from the beginning; says whether there is one. Takes about as long as the first one."""
        is_found = self._solver.finish().outcome.is_success
        if is_found:
            self._shown = self._settled = self._solver.vertices
            self.is_stuck = False
        return is_found

    def finish(self):
        """The converged surface, with its report and what there is to select; kept as `result`, too."""
        self._solver.finish()
        self.result = self._solver.result()
        return self.result

    def close(self):
        """Frees the memory and threads of the solver, if there is one."""
        if self._solver is not None:
            self._solver.close()
            self._solver = None

    def positions(self):
        """All vertices as they stand, (n, 3), in the object's coordinates, and which of them have moved, (n,)."""
        seen = self._shown if self.result is None else self.result.vertices
        moved = self.free | (seen != self._seen).any(axis=1)
        positions = self.mesh.vertices.copy()
        positions[moved] = self.mesh.unseen(seen[moved])
        return positions, moved

    def final(self):
        """The vertices that are to be written and their positions, made symmetric where mirror editing asks for it."""
        positions, moved = self.positions()
        if self._symmetry.axes:
            positions = self._symmetry.apply(positions)
        indices = np.flatnonzero(moved)
        return indices, positions[indices]

    def normal(self, vertex):
        """The unit normal of the surface at a boundary vertex, in the object's coordinates."""
        return self.normals()[vertex]

    def normals(self):
        """Those of all, (n, 3); elsewhere 0."""
        return self._normals

    def loop_with(self, vertex):
        """The loop that a vertex lies on; None: it lies on none."""
        return next((loop for loop in self.loops if vertex in loop.vertices), None)

    def with_images(self, edits, axes):
        """The edits and their mirror images, those of images included."""
        every = list(edits)
        for axis in axes:
            every = [each for edit in every for each in self._on_both_sides(edit, axis)]
        return every

    def _on_both_sides(self, edit, axis):
        image = -1 if edit.kind == live_edits.BULGE else self.image(edit.vertex, axis)
        if image < 0:
            return [edit]
        other = live_edits.mirrored(edit, axis, image)
        is_same_loop = self.loop_with(edit.vertex) is self.loop_with(image)
        if is_same_loop and edit.kind == live_edits.MOVE:
            # Within the plane: the part across it would tear the loop off its image.
            return [replace(edit, way=tuple(0.0 if number == axis else x for number, x in enumerate(edit.way)))]
        if is_same_loop and edit.kind == live_edits.TILT and (edit.falloff == 0.0 or image == edit.vertex):
            return [edit]
        return [edit, other]

    def image(self, vertex, axis):
        """The vertex on a loop that is the mirror image of another one across an axis of the object; -1: there is none."""
        vertices = self.mesh.vertices
        wanted = vertices[vertex].copy()
        wanted[axis] *= -1
        every = np.concatenate([loop.vertices for loop in self.loops])
        away = np.linalg.norm(vertices[every] - wanted, axis=1)
        at = int(np.argmin(away))
        loop = self.loop_with(vertex)
        edge = 0.0 if loop is None or loop.is_point else self.edge_of(loop)
        return int(every[at]) if away[at] <= max(region.MIRROR_DISTANCE, NEAR * edge) else -1

    def edge_of(self, loop):
        """The mean length of a loop's edges, in the object's coordinates."""
        points = self.mesh.vertices[loop.vertices]
        return float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).mean())

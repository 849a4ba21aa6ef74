# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh > Clean Up > Fair Selection."""

from dataclasses import dataclass

import bpy
import numpy as np

from . import custom_normals, fairmesh, found, menus, messages, region, snapshot, triangulation
from .fairing_options import FairingOptions, RegionOptions
from .job import Background, for_each

#: The library's reports of the last run, one per object.
last_reports = []


@dataclass
class Region:
    """What is to be faired of one object."""

    mesh: snapshot.Snapshot
    free: np.ndarray
    symmetry: region.Symmetry
    keywords: dict
    result: object = None


class MESH_OT_fairmesh_fair(Background, RegionOptions, FairingOptions, bpy.types.Operator):
    """Fairs the selected region of each object in Edit mode."""

    bl_idname = "mesh.fairmesh_fair"
    bl_label = "Fair Selection"
    # Blender cuts what is longer than 239 bytes.
    bl_description = (
        "Replace the selected region by the smoothest surface that meets its surroundings tangentially. "
        "In face select mode the vertices inside the selected faces move, otherwise the selected vertices"
    )

    def draw_options(self, layout):
        self.draw_region(layout)
        self.draw_fairing(layout)

    def prepare(self, context):
        every = [self._region(context, obj) for obj in context.objects_in_mode_unique_data]
        regions = [r for r in every if r.free.any()]
        if not regions:
            self.tell({"ERROR"}, ": ".join(self.nothing_free(context)))
            return None

        def compute(part, monitor):
            mesh = part.mesh
            return fairmesh.fair(mesh.seen(), mesh.triangles, free=part.free, cancel=monitor, **part.keywords)

        return for_each(regions, compute)

    def _region(self, context, obj):
        mesh = snapshot.read(obj)
        free = region.free_mask(mesh, self.is_by_faces(context))
        symmetry = region.Symmetry(mesh, free)
        mesh.triangles = triangulation.cut_evenly(mesh, free)
        keywords = {**self.fairing_keywords(region.diagonal(mesh, free)), **self.marked_keywords()(mesh)}
        return Region(mesh, free, symmetry, keywords)

    def finish(self, context, regions):
        moved = [_positions(part) for part in regions]
        for part in regions:
            snapshot.edit_mesh(part.mesh)  # all are still there, before the first is changed
        for part, (indices, positions) in zip(regions, moved):
            custom_normals.mark(part.mesh)
            snapshot.write_positions(part.mesh, indices, positions)
        custom_normals.put_back(part.mesh for part in regions)
        last_reports[:] = [part.result.report for part in regions]
        for part in regions:
            kind, text = messages.faired(part.result.report, self.asked_continuity())
            self.tell({kind}, messages.name_before(regions, part) + text)
            remember(part)
        return {"FINISHED"}


def _positions(part):
    """The free vertices and their new positions in the object's coordinates."""
    mesh = part.mesh
    indices = np.flatnonzero(part.free)
    if not part.symmetry.axes:
        return indices, mesh.unseen(part.result.vertices[indices])
    return indices, part.symmetry.apply(mesh.unseen(part.result.vertices))[indices]


def remember(part):
    """Offers to select what the result has reservations about."""
    mesh, result = part.mesh, part.result
    if len(result.poor_triangles):
        faces = np.unique(mesh.face_of[result.poor_triangles])
        found.remember(found.Found(mesh.object, mesh.counts, f"{len(faces)} poor faces", faces=faces))
    elif len(result.creased_vertices):
        vertices = result.creased_vertices
        what = f"{len(vertices)} boundary vertices with a crease"
        found.remember(found.Found(mesh.object, mesh.counts, what, vertices=vertices))
    elif len(result.intersections):
        faces = np.unique(mesh.face_of[result.intersections])
        found.remember(found.Found(mesh.object, mesh.counts, f"{len(faces)} intersecting faces", faces=faces))


register, unregister = menus.registration(
    MESH_OT_fairmesh_fair,
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_vertices",
    "VIEW3D_MT_edit_mesh_edges",
    "VIEW3D_MT_edit_mesh_faces",
    select_modes=("VERT", "EDGE", "FACE"),
)

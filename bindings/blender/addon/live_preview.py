# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows the surface of Fair Live while it changes, without writing the mesh.

Blender takes about ten times as long to draw an edit mesh that has changed as to draw these triangles over the rest.
The faces in question are hidden meanwhile, by their flags alone: the selection stays.
"""

import bmesh
import bpy
import numpy as np

from . import snapshot

_LIGHT, _DARK = (0.96, 0.83, 0.66), (0.20, 0.17, 0.15)
_LOOP, _EDITED, _HANDLE = (1.0, 0.55, 0.1, 0.9), (0.2, 0.85, 1.0, 1.0), (1.0, 1.0, 1.0, 1.0)
# Two lamps, and the normal at which the first one is reflected.
_LAMPS = np.array([[-0.4, 0.5, 0.77], [0.7, -0.1, 0.7], [-0.21, 0.27, 0.94]])
# 4.0 has dropped the prefix.
_PREFIX = "3D_" if bpy.app.version < (4, 0, 0) else ""


class Preview:
    """The surface, the loops and the handle, in all 3D views of the scene."""

    def __init__(self, mesh):
        self._mesh = mesh
        self._hidden, self._edit_mesh = [], None
        self._covered = np.zeros(len(mesh.vertices), bool)
        self._positions = None
        self._surface = None
        self._eye = None
        #: Curves to draw over it: (points (k, 3), colours (k, 4), width, whether the curve is closed).
        self.curves = []
        self._drawn = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_VIEW")

    def show(self, positions, moved):
        """Shows the surface with these positions, (n, 3), of which those have moved, (n,)."""
        if (moved & ~self._covered).any():
            self._cover(moved | self._covered)
        self._positions = positions
        self._surface = None

    def _cover(self, moved):
        """Takes the faces at these vertices out of Blender's hands."""
        self._covered = moved
        mesh = self._mesh
        touched = np.unique(mesh.face_of[moved[mesh.triangles].any(axis=1)])
        triangles = mesh.triangles[np.isin(mesh.face_of, touched)]
        around = np.zeros(len(moved), bool)
        around[triangles] = True
        # Those beside count in the normals at the boundary, and are not drawn.
        beside = mesh.triangles[around[mesh.triangles].any(axis=1)]
        self._used, local = np.unique(beside, return_inverse=True)
        self._around = local.reshape(-1, 3)
        number = np.zeros(len(moved), np.int32)
        number[self._used] = np.arange(len(self._used), dtype=np.int32)
        self._triangles = np.ascontiguousarray(number[triangles])
        self._index = None
        self._hide(touched, moved)

    def _hide(self, faces, moved):
        # Elements are valid only as long as Python knows their mesh.
        self._edit_mesh = edit_mesh = snapshot.edit_mesh(self._mesh)
        edit_mesh.faces.ensure_lookup_table()
        chosen = [edit_mesh.faces[f] for f in faces.tolist()]
        edges = {edge for v in np.flatnonzero(moved).tolist() for edge in edit_mesh.verts[v].link_edges}
        chosen += [*edges, *(edit_mesh.verts[v] for v in np.flatnonzero(moved).tolist())]
        for element in chosen:
            if not element.hide:
                # The flag alone: hide_set() would deselect it.
                element.hide = True
                self._hidden.append(element)
        bmesh.update_edit_mesh(self._mesh.object.data, loop_triangles=False, destructive=False)

    def close(self):
        """Takes everything back; the mesh is as it was."""
        if self._drawn is None:
            return
        bpy.types.SpaceView3D.draw_handler_remove(self._drawn, "WINDOW")
        self._drawn = None
        for element in self._hidden:
            if element.is_valid:
                element.hide = False
        self._hidden, self._edit_mesh = [], None
        try:
            snapshot.edit_mesh(self._mesh)
        except snapshot.Stale:
            return
        bmesh.update_edit_mesh(self._mesh.object.data, loop_triangles=False, destructive=False)

    def _draw(self):
        import gpu  # not in background mode

        try:
            matrix = self._mesh.object.matrix_world
        except ReferenceError:
            return
        with gpu.matrix.push_pop():
            gpu.matrix.multiply_matrix(matrix)
            if self._positions is not None:
                self._draw_surface(gpu, matrix)
            self._draw_curves(gpu)

    def _draw_surface(self, gpu, matrix):
        eye = np.array(bpy.context.region_data.view_matrix.to_3x3() @ matrix.to_3x3())
        if self._surface is None or not np.array_equal(eye, self._eye):
            self._eye = eye
            self._surface = self._batch(gpu, eye)
        gpu.state.depth_test_set("LESS_EQUAL")
        gpu.state.depth_mask_set(True)
        shader = gpu.shader.from_builtin(_PREFIX + "SMOOTH_COLOR")
        shader.bind()
        self._surface.draw(shader)
        gpu.state.depth_mask_set(False)
        gpu.state.depth_test_set("NONE")

    def _batch(self, gpu, eye):
        points = np.ascontiguousarray(self._positions[self._used], np.float32)
        colors = _shades(_normals(points, self._around) @ np.linalg.inv(eye))
        form = gpu.types.GPUVertFormat()
        form.attr_add(id="pos", comp_type="F32", len=3, fetch_mode="FLOAT")
        form.attr_add(id="color", comp_type="F32", len=4, fetch_mode="FLOAT")
        buffer = gpu.types.GPUVertBuf(form, len(points))
        buffer.attr_fill("pos", points)
        buffer.attr_fill("color", colors)
        if self._index is None:
            self._index = gpu.types.GPUIndexBuf(type="TRIS", seq=self._triangles)
        return gpu.types.GPUBatch(type="TRIS", buf=buffer, elem=self._index)

    def _draw_curves(self, gpu):
        from gpu_extras.batch import batch_for_shader

        shader = gpu.shader.from_builtin(_PREFIX + "POLYLINE_SMOOTH_COLOR")
        gpu.state.blend_set("ALPHA")
        for points, colors, width, is_closed in self.curves:
            if is_closed:
                points, colors = np.concatenate([points, points[:1]]), np.concatenate([colors, colors[:1]])
            attributes = {"pos": points.tolist(), "color": colors.tolist()}
            batch = batch_for_shader(shader, "LINE_STRIP", attributes)
            shader.bind()
            shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
            shader.uniform_float("lineWidth", width)
            batch.draw(shader)
        gpu.state.blend_set("NONE")


def _normals(points, triangles):
    """Normals at points, (n, 3), as long as the areas around are large."""
    x, y, z = points.T
    corners = [triangles[:, k] for k in range(3)]
    (ax, bx, cx), (ay, by, cy), (az, bz, cz) = ([u[corner] for corner in corners] for u in (x, y, z))
    bx, by, bz, cx, cy, cz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    faces = (by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx)
    return np.stack([sum(np.bincount(corner, n, len(points)) for corner in corners) for n in faces], axis=1)


def _shades(normals):
    """Colours, (n, 4), of normals in the view's directions: two lamps at the viewer's side, and a highlight."""
    normals = normals / np.maximum(np.sqrt((normals * normals).sum(axis=1)), 1e-300)[:, None]
    lit, fill, shine = np.clip(normals @ _LAMPS.T, 0, 1).T
    shade = np.clip(0.72 * lit + 0.25 * fill, 0, 1)[:, None]
    for _ in range(5):
        shine = shine * shine
    colors = np.ones((len(normals), 4), np.float32)
    colors[:, :3] = np.minimum(np.array(_DARK) + shade * (np.array(_LIGHT) - _DARK) + 0.35 * shine[:, None], 1)
    return colors


def loop_curves(region, positions, edited, weights):
    """The loops as curves at these positions, the stretch that is edited, with weights (k,), in another colour."""
    curves = []
    for loop in region.loops:
        if loop.is_point:
            continue
        points = positions[loop.vertices]
        colors = np.tile(_LOOP, (len(points), 1))
        if loop is edited:
            share = weights[:, None]
            colors = share * _EDITED + (1 - share) * colors
        curves.append((points, colors, 5.0 if loop is edited else 2.5, True))
    return curves


def handle_curve(start, end):
    """The handle at a vertex: from there along the surface's normal."""
    points = np.array([start, end])
    return points, np.tile(_HANDLE, (2, 1)), 4.0, False


def circle_curve(centre, right, up, radius):
    """How far a move reaches."""
    angle = np.linspace(0, 2 * np.pi, 65)[:-1, None]
    points = centre + radius * (np.cos(angle) * right + np.sin(angle) * up)
    return points, np.tile(_EDITED, (64, 1)), 1.5, True

# SPDX-License-Identifier: GPL-3.0-or-later
"""From the pointer to angles and ways: drags that go on past the edge of the view, and what they mean there."""

import math

import numpy as np
from bpy_extras import view3d_utils
from mathutils import Vector

#: A right angle is so many pixels.
RADIANS = math.pi / 2 / 300
PRECISE = 0.1
_MARGIN = 8
# How long a handle is seen, and the shortest normal that says which way is outward.
_HANDLE, _SHORT = 70.0, 20.0


class View:
    """The 3D view in which an operator was begun, and the object in it."""

    def __init__(self, context, obj):
        self.window, self.area = context.window, context.area
        # A button of the sidebar is not in the region of the view.
        found = context.region
        if found.type != "WINDOW":
            found = next(region for region in self.area.regions if region.type == "WINDOW")
        self.region = found
        self._data = context.region_data or self.area.spaces.active.region_3d
        self.object = obj

    @staticmethod
    def is_there(context):
        """Whether there is one."""
        return context.area is not None and context.area.type == "VIEW_3D"

    @property
    def _matrix(self):
        return self.object.matrix_world

    def inside(self, event):
        """Where the pointer is in it, (2,)."""
        return np.array([event.mouse_x - self.region.x, event.mouse_y - self.region.y], float)

    def on_screen(self, positions):
        """Where points of the object, (n, 3), are seen, (n, 2); NaN: behind the viewer."""
        whole = np.array(self._data.perspective_matrix @ self._matrix)
        seen = positions @ whole[:3, :3].T + whole[:3, 3]
        depth = positions @ whole[3, :3] + whole[3, 3]
        depth = np.where(depth > 0, depth, np.nan)[:, None]
        return (seen[:, :2] / depth + 1) / 2 * (self.region.width, self.region.height)

    def faces(self, positions, normals):
        """Whether the surface is seen from its outer side at points of the object, (n,)."""
        inverse = (self._data.view_matrix @ self._matrix).inverted_safe()
        if self._data.is_perspective:
            return ((np.array(inverse.translation) - positions) * normals).sum(axis=1) > 0
        return normals @ np.array(inverse.to_3x3().col[2]) > 0

    def outward(self, point, normal):
        """The direction, (2,), in which a drag turns the surface outward: its normal's, or up where that faces one."""
        ends = self.on_screen(np.array([point, self.handle_end(point, normal)]))
        way = ends[1] - ends[0]
        long = np.linalg.norm(way)
        return way / long if long > _SHORT else np.array([0.0, 1.0])

    def handle_end(self, point, normal):
        """The end of a handle that is as long as usual in the view."""
        here = self._matrix @ Vector(point)
        there = self._moved(here, np.array([_HANDLE, 0.0]))
        long = np.linalg.norm(np.array(self._matrix.to_3x3()) @ normal)
        return point + normal * ((there - here).length / max(long, 1e-300))

    def _moved(self, place, pixels):
        """A place in the scene, moved so far in the plane of the view."""
        at = view3d_utils.location_3d_to_region_2d(self.region, self._data, place, default=Vector((0, 0)))
        return view3d_utils.region_2d_to_location_3d(self.region, self._data, at + Vector(pixels), place)

    def way(self, point, pixels):
        """What a drag means as a move of a point in the plane of the view, in the object's coordinates, (3,)."""
        here = self._matrix @ Vector(point)
        return np.array(self._matrix.to_3x3().inverted_safe() @ (self._moved(here, pixels) - here))

    def axes(self):
        """To the right and up in the view, of the scene's length 1, in the object's coordinates."""
        turned = np.array(self._data.view_matrix.to_3x3() @ self._matrix.to_3x3().normalized())
        scale = np.linalg.norm(np.array(self._matrix.to_3x3()), axis=0).mean()
        return turned[0] / scale, turned[1] / scale


class Drag:
    """The way of the pointer since it began, in pixels. Shift makes it precise; it goes on past the edge of the view."""

    def __init__(self, view, event):
        self.way = np.zeros(2)
        self._view = view
        self._last = view.inside(event)

    def move(self, event):
        now = self._view.inside(event)
        self.way += (now - self._last) * (PRECISE if event.shift else 1.0)
        self._last = self._kept_inside(now)

    def _kept_inside(self, now):
        """Lets the pointer come in again at the other side, as Blender's own transformations do."""
        region = self._view.region
        room = np.array([region.width, region.height]) - 2 * _MARGIN
        wrapped = _MARGIN + (now - _MARGIN) % room
        if np.array_equal(wrapped, now):
            return now
        self._view.window.cursor_warp(int(wrapped[0]) + region.x, int(wrapped[1]) + region.y)
        return np.trunc(wrapped)

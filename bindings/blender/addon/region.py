# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertices are free: what is selected, and with mirror editing its mirror image."""

import numpy as np
from mathutils import kdtree

# What Blender takes for mirror images of each other, in the object's unit (BM_SEARCH_MAXDIST_MIRR).
MIRROR_DISTANCE = 2e-5


def free_mask(snapshot, by_faces):
    """The free vertices, (n,).

    By faces: vertices all of whose faces are selected. Otherwise: selected vertices. Vertices without faces, on the boundary
    of the mesh, hidden or with a hidden face are never free.
    """
    if by_faces:
        selected = snapshot.face_selected[snapshot.face_of]
        chosen = _corners(snapshot, snapshot.triangles[selected])
        chosen &= ~_corners(snapshot, snapshot.triangles[~selected])
    else:
        chosen = snapshot.vertex_selected
    return chosen & movable_mask(snapshot)


def movable_mask(snapshot):
    """The vertices that are free if they are selected, (n,)."""
    movable = _corners(snapshot, snapshot.triangles) & ~snapshot.vertex_hidden
    movable &= ~_corners(snapshot, snapshot.triangles[snapshot.face_hidden[snapshot.face_of]])
    return movable & ~snapshot.on_surface_boundary


def _corners(snapshot, triangles):
    mask = np.zeros(len(snapshot.vertices), bool)
    mask[triangles] = True
    return mask


def diagonal(snapshot, free):
    """The diagonal of the bounding box of the triangles around the free vertices, as seen in the scene."""
    corners = snapshot.triangles[free[snapshot.triangles].any(axis=1)]
    around = snapshot.seen()[_corners(snapshot, corners)]
    return float(np.linalg.norm(np.ptp(around, axis=0))) if len(around) else 0.0


class Symmetry:
    """Mirror editing: free vertices on both sides, and a result that is the same on both sides."""

    def __init__(self, snapshot, free):
        """Adds the mirror images of the free vertices to the mask `free`, if mirror editing is on."""
        self.axes = [axis for axis, name in enumerate("xyz") if getattr(snapshot.object.data, f"use_mirror_{name}")]
        self._pairs = []
        if not self.axes:
            return
        self._vertices = snapshot.vertices
        self._selected = free.copy()
        self._tree = _tree(snapshot.vertices)
        movable = movable_mask(snapshot)
        # The second round finds images of images.
        for axis in self.axes * 2:
            images = self._images(np.flatnonzero(free), axis)
            images = images[images >= 0]
            free[images[movable[images]]] = True
        for axis in self.axes:
            left = np.flatnonzero(free)
            right = self._images(left, axis)
            both = (right >= 0) & free[right]
            self._pairs.append((axis, left[both], right[both]))

    def _images(self, indices, axis):
        """The vertex that is the mirror image of each, -1 where there is none."""
        reflected = _reflected(self._vertices[indices], axis)
        found = np.full(len(indices), -1, np.int64)
        for at, position in enumerate(reflected):
            _, index, distance = self._tree.find(position)
            if distance <= MIRROR_DISTANCE:
                found[at] = index
        return found

    def apply(self, positions):
        """The positions of all vertices, (n, 3), made symmetric; in the object's coordinates.

        The side that was selected is copied. Not where the region crosses the plane: there the surface is symmetric by
        itself, and vertices that are spread differently within it on both sides would be torn off it.
        """
        for axis, left, right in self._pairs:
            if (left == right).any():
                continue
            as_selected = self._selected[left] == self._selected[right]
            copied = np.where(as_selected, self._vertices[left, axis] < 0, self._selected[right])
            positions[left[copied]] = _reflected(positions[right[copied]], axis)
        return positions


def _reflected(positions, axis):
    reflected = positions.copy()
    reflected[:, axis] *= -1
    return reflected


def _tree(vertices):
    tree = kdtree.KDTree(len(vertices))
    for index, position in enumerate(vertices):
        tree.insert(position, index)
    tree.balance()
    return tree

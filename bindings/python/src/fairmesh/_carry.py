"""What belongs to the vertices and faces of a mesh, carried over to one that was made of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Names that libraries give to unit normals at vertices, in lower case.
NORMALS = ("normals", "normal", "vertex_normals", "obj:vn")


@dataclass(frozen=True)
class Change:
    """A mesh that was made of another one: first what is left of that, then what is new."""

    #: All vertices and faces, (n, 3) and (m, 3).
    vertices: NDArray[Any]
    faces: NDArray[Any]
    #: The faces of the mesh before.
    faces_before: NDArray[Any]
    #: The numbers before of the vertices and faces that are left.
    kept_vertices: NDArray[np.intp]
    kept_faces: NDArray[np.intp]
    #: Per new vertex three vertices before, and their weights, (k, 3).
    parents: NDArray[np.intp]
    weights: NDArray[np.float64]

    def of_vertices(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values at the vertices before, (n, ...), to values at those now.

        New vertices get real numbers and colours (8 bits) by their parents' weights, anything else from the nearest.
        """
        kept = values[self.kept_vertices]
        if len(self.parents) == 0:
            return kept
        return np.concatenate([kept, blended(values, self.parents, self.weights)])

    def of_faces(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values of the faces before, (m, ...), to values of those now.

        New faces get real numbers and colours of the faces around their vertices' parents, by weights; of anything else
        the value that weighs most there.
        """
        kept = values[self.kept_faces]
        if len(self.faces) == len(self.kept_faces):
            return kept
        near, weights = self._faces_near
        if not _is_blended(values):
            _, label = np.unique(values, axis=0, return_inverse=True)
            labels = label.reshape(-1)[near]
            votes = (weights[:, None, :] * (labels[:, :, None] == labels[:, None, :])).sum(axis=2)
            return np.concatenate([kept, values[near[np.arange(len(near)), votes.argmax(axis=1)]]])
        return np.concatenate([kept, blended(values, near, weights)])

    def of_corners(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values at the corners of the faces before, (m, 3, ...), to values at those now.

        In new faces a vertex has the value that it had in its first face, new vertices those of their parents.
        """
        at_vertices = np.zeros((self._vertex_count, *values.shape[2:]), values.dtype)
        at_vertices[self.faces_before[::-1].ravel()] = values[::-1].reshape(-1, *values.shape[2:])
        new = self.of_vertices(at_vertices)[self.faces[len(self.kept_faces) :]]
        return np.concatenate([values[self.kept_faces], new])

    def numbers_now(self) -> NDArray[np.intp]:
        """Per vertex before its number now; -1 if it is gone."""
        return _inverse(self.kept_vertices, self._vertex_count)

    def face_numbers_now(self) -> NDArray[np.intp]:
        """Per face before its number now; -1 if it is gone."""
        return _inverse(self.kept_faces, len(self.faces_before))

    @cached_property
    def _vertex_count(self) -> int:
        """At least as many as there were before, as far as anything that is asked for depends on it."""
        lists = (self.faces_before, self.kept_vertices, self.parents)
        return max((int(each.max()) + 1 for each in lists if each.size), default=0)

    @cached_property
    def _faces_near(self) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Per new face nine faces before, the first one at each parent of each corner, and their weights."""
        every = np.zeros((len(self.kept_vertices), 3))
        every[:, 0] = 1.0
        parents = np.concatenate([np.repeat(self.kept_vertices[:, None], 3, axis=1), self.parents])
        weights = np.concatenate([every, self.weights])
        first = np.full(self._vertex_count, -1)
        first[self.faces_before[::-1].ravel()] = np.repeat(np.arange(len(self.faces_before))[::-1], 3)
        corners = self.faces[len(self.kept_faces) :]
        near = first[parents[corners]].reshape(-1, 9)
        weight = np.where(near < 0, 0.0, weights[corners].reshape(-1, 9))
        total = weight.sum(axis=1, keepdims=True)
        return np.maximum(near, 0), weight / np.where(total == 0.0, 1.0, total)


def _is_blended(values: NDArray[Any]) -> bool:
    """Real numbers, and colours of 8 bits."""
    is_colour = values.dtype == np.uint8 and values.ndim == 2 and values.shape[1] in (3, 4)
    return values.dtype.kind in "fc" or is_colour


def blended(values: NDArray[Any], near: NDArray[np.intp], weights: NDArray[np.float64]) -> NDArray[Any]:
    """Per row the weighted mean of the values near; of what has no mean, the value with the largest weight."""
    if not _is_blended(values):
        heaviest: NDArray[Any] = values[near[np.arange(len(near)), weights.argmax(axis=1)]]
        return heaviest
    by = weights.reshape(*weights.shape, *(1,) * (values.ndim - 1))
    # What has no weight counts for nothing, also where its value is not a number.
    with np.errstate(invalid="ignore"):
        mean = np.where(by == 0.0, 0.0, values[near] * by).sum(axis=1)
    if values.dtype == np.uint8:
        mean = np.clip(np.rint(mean), 0, 255)
    made: NDArray[Any] = mean.astype(values.dtype)
    return made


def _inverse(kept: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    numbers = np.full(count, -1)
    numbers[kept] = np.arange(len(kept))
    return numbers


def vertex_normals(vertices: NDArray[Any], faces: NDArray[Any]) -> NDArray[np.float64]:
    """Unit normals at all vertices: those of the faces around, weighted by their angles. Zero where there are none."""
    corners = np.asarray(vertices, float)[faces]
    normals = np.zeros((len(vertices), 3))
    edges = [corners[:, (k + 1) % 3] - corners[:, k] for k in range(3)]
    cross = np.cross(edges[0], -edges[2])
    double = np.linalg.norm(cross, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        unit = np.nan_to_num(cross / double[:, None])
        for k in range(3):
            # The sine of each angle is twice the area, over the lengths of its sides.
            angle = np.arctan2(double, (edges[k] * -edges[k - 1]).sum(axis=1))
            for axis in range(3):
                normals[:, axis] += np.bincount(faces[:, k], unit[:, axis] * angle, len(vertices))
        made: NDArray[np.float64] = np.nan_to_num(normals / np.linalg.norm(normals, axis=1)[:, None])
        return made


def renewed(
    normals: NDArray[Any], before: tuple[NDArray[Any], NDArray[Any]], after: tuple[NDArray[Any], NDArray[Any]]
) -> NDArray[Any]:
    """Normals at the vertices after, (n, 3), where they may have changed; others are kept.

    Args:
        normals: Those carried over from before.
        before, after: Vertices and faces. Where there are fewer before, the first ones are the same vertices.

    """
    old, new = before[0], after[0]
    count = min(len(old), len(new))
    changed = np.ones(len(new), bool)
    changed[:count] = (np.asarray(old[:count]) != np.asarray(new[:count])).any(axis=1)
    touched = changed.copy()
    touched[after[1][changed[after[1]].any(axis=1)]] = True
    if not np.array_equal(before[1], after[1]):
        touched[:] = True
    made = np.array(normals)
    around = after[1][touched[after[1]].any(axis=1)]
    made[touched] = vertex_normals(new, around)[touched]
    return made

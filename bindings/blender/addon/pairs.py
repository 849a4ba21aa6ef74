# SPDX-License-Identifier: GPL-3.0-or-later
"""Guides: boundary vertices that were selected two by two, between which a patch is to begin with an edge."""

import bmesh
import numpy as np

from . import advice


def of(mesh):
    """The pairs of a `Snapshot`, and why there are none: ([(a, b)], "") or ([], text)."""
    chosen = np.flatnonzero(mesh.vertex_selected & mesh.on_boundary).tolist()
    if len(chosen) == 2:
        return [tuple(chosen)], ""
    order = [index for index in _in_order(mesh.object) if mesh.on_boundary[index]]
    if chosen and len(order) % 2 == 0 and sorted(order) == chosen:
        return list(zip(order[::2], order[1::2])), ""
    return [], (
        f"{advice.named('{guides}')}: select pairs of boundary vertices, one vertex after the other (Shift-click); "
        f"{len(chosen)} {'is' if len(chosen) == 1 else 'are'} selected, {len(order)} of them one by one"
    )


def _in_order(obj):
    """The selected vertices in the order in which they were."""
    edit_mesh = bmesh.from_edit_mesh(obj.data)
    edit_mesh.verts.index_update()
    return [each.index for each in edit_mesh.select_history if isinstance(each, bmesh.types.BMVert) and each.select]

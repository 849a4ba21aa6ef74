# SPDX-License-Identifier: GPL-3.0-or-later
"""Fairing of selected regions, filling of holes and curvature display with the fairmesh library.

An add-on for Blender 3.4 to 4.1 (`bl_info`) and an extension for 4.2 and later (blender_manifest.toml).
"""

import importlib.util
import sys

bl_info = {
    "name": "Fairmesh",
    "description": "Fill holes, remove bumps, blend and join, exactly smooth; shows curvature",
    "author": "fairmesh developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Edit Mode: Mesh > Clean Up and Delete, Vertex, Edge, Face and context menus, Sidebar > Fairmesh",
    "category": "Mesh",
    "support": "COMMUNITY",
}

# Blender reloads this file alone after an update: without this the old modules would stay in use.
for _name in [name for name in sys.modules if name.startswith(__name__ + ".")]:
    del sys.modules[_name]
    globals().pop(_name.rpartition(".")[2], None)

# Debian's Blender comes without it.
HAS_NUMPY = importlib.util.find_spec("numpy") is not None

if HAS_NUMPY:
    from . import (
        bridge_operator,
        curvature_operator,
        erase_operator,
        fair_operator,
        fill_operator,
        found,
        job,
        join_operator,
        live_edits,
        live_operator,
        live_tool,
        manual,
        panel,
        presets,
        round_operator,
        selected,
        settings,
    )

    _PARTS = (
        settings,
        selected,
        found,
        fair_operator,
        live_edits,
        live_operator,
        live_tool,
        fill_operator,
        join_operator,
        bridge_operator,
        erase_operator,
        round_operator,
        curvature_operator,
        manual,
        presets,
        panel,
    )
else:
    from . import no_numpy

    _PARTS = (no_numpy,)


def register():
    for part in _PARTS:
        part.register()


def unregister():
    if HAS_NUMPY:
        # No thread may be inside the library when its code goes away.
        job.stop_all()
    for part in reversed(_PARTS):
        part.unregister()

# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual inside the add-on, and Online Manual in the right-click menus of its buttons, which opens it."""

from pathlib import Path

import bpy

_FILE = Path(__file__).resolve().parent / "manual" / "index.html"

# The sections of the page; build.sh makes it from README.md.
_SECTIONS = (
    ("bpy.ops.mesh.fairmesh_fair*", "fair-selection"),
    ("bpy.ops.mesh.fairmesh_live*", "fair-live"),
    ("bpy.types.fairmesh_pg_live_edit*", "fair-live"),
    ("bpy.ops.mesh.fairmesh_fill_holes*", "fill-hole-and-fair"),
    ("bpy.ops.mesh.fairmesh_fill_all_holes*", "fill-hole-and-fair"),
    ("bpy.ops.mesh.fairmesh_join_loops*", "join-loops-and-fair"),
    ("bpy.ops.mesh.fairmesh_bridge*", "bridge-edges-and-fair"),
    ("bpy.ops.mesh.fairmesh_erase_and_fill*", "erase-and-fill"),
    ("bpy.ops.mesh.fairmesh_round_edges*", "round-edges"),
    ("bpy.ops.mesh.fairmesh_show_curvature*", "show-curvature"),
    ("bpy.ops.mesh.fairmesh_hide_curvature*", "show-curvature"),
    ("bpy.ops.mesh.fairmesh_select_found*", "fair-selection"),
    ("bpy.types.fairmesh_pg_settings*", "options"),
)


def url(section=""):
    """The address of the manual, or of one of its sections."""
    return _FILE.as_uri() + (f"#{section}" if section else "")


def _map():
    return _FILE.parent.as_uri() + "/", tuple((name, f"{_FILE.name}#{section}") for name, section in _SECTIONS)


def register():
    bpy.utils.register_manual_map(_map)


def unregister():
    bpy.utils.unregister_manual_map(_map)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar: which buttons are grey and why, and presets."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import part

common.install(runner.arguments()[0])
AXES = np.array([1.0, 0.7, 0.8])


# All that need something.
OPERATORS = ("fair", "live", "erase_and_fill", "join_loops", "bridge", "fill_holes", "fill_all_holes")


def lit():
    """The buttons of the sidebar that can be pressed."""
    bpy.context.view_layer.update()
    with bpy.context.temp_override(fairmesh_sidebar=bpy.context.scene.fairmesh):
        return {name for name in OPERATORS if getattr(bpy.ops.mesh, f"fairmesh_{name}").poll()}


def grey(name, *parts):
    """Has to be refused, for a reason with these parts, which is the button's tooltip."""
    assert name not in lit(), name
    with bpy.context.temp_override(fairmesh_sidebar=bpy.context.scene.fairmesh):
        runner.raises(getattr(bpy.ops.mesh, f"fairmesh_{name}"), "poll()", *parts)


def test_what_cannot_run_is_grey_and_says_why():
    obj = common.irregular_sphere(8)
    assert not lit()
    grey("fair", "Edit mode", "Tab")
    common.edit(obj)
    assert not lit(), "nothing is selected, and there is no hole"
    grey("fair", "Nothing is selected")
    grey("fill_all_holes", "The mesh has no hole")
    next(iter(bmesh.from_edit_mesh(obj.data).faces)).select_set(True)
    bmesh.update_edit_mesh(obj.data)
    assert lit() == {"erase_and_fill"}, lit()
    grey("fair", "No vertex can move", "Region: Selected Vertices")
    grey("join_loops", "select two or more boundary loops")
    grey("fill_holes", "Alt-click")
    bpy.context.scene.fairmesh.region = "VERTICES"
    assert lit() == {"erase_and_fill", "fair", "live"}, lit()
    bpy.context.scene.fairmesh.reset()
    bpy.ops.mesh.select_all(action="SELECT")
    grey("erase_and_fill", "Nothing is left around")
    bpy.ops.mesh.select_all(action="DESELECT")
    common.select_faces(obj, lambda face: face.calc_center_median().z > 0)
    assert lit() == {"erase_and_fill", "fair", "live"}, lit()


def test_loops_and_runs_light_their_buttons():
    obj = common.tubes((1, (0, 0, 0), (0, 0, 2)), (1, (0, 0, 3), (0, 0, 5)))
    assert lit() == {"fill_all_holes"}, lit()
    common.select_boundary(obj, lambda edge: abs(edge.verts[0].co.z - 2) < 0.1)
    assert lit() == {"fill_all_holes", "fill_holes"}, lit()
    grey("bridge", "Whole loops", "Join Loops and Fair")
    common.select_boundary(obj, lambda edge: abs(edge.verts[0].co.z - 3) < 0.1)
    assert lit() == {"fill_all_holes", "fill_holes", "join_loops"}, lit()
    bpy.ops.mesh.select_all(action="DESELECT")
    near = [e for e in common.boundary_edges(obj) if 1.9 < e.verts[0].co.z < 3.1]
    for edge in near:
        edge.select_set(all(v.co.x > 0.8 for v in edge.verts))
    bmesh.update_edit_mesh(obj.data)
    assert lit() == {"fill_all_holes", "fill_holes", "join_loops", "bridge"}, lit()


def test_a_large_mesh_is_not_looked_through():
    obj = common.uv_sphere(200, 140)
    common.edit(obj)
    next(iter(bmesh.from_edit_mesh(obj.data).faces)).select_set(True)
    bmesh.update_edit_mesh(obj.data)
    assert lit() == set(OPERATORS), lit()


def take(preset):
    """Loads a preset as its entry in the sidebar does."""
    path = part("presets")._OURS / f"{preset}.py"
    assert bpy.ops.script.execute_preset(filepath=str(path), menu_idname="FAIRMESH_PT_presets") == {"FINISHED"}


def fill():
    """What the sidebar's button does; the new vertices."""

    class Button:
        pass

    button = Button()
    bpy.context.scene.fairmesh.hand_to(button, part("fill_operator").MESH_OT_fairmesh_fill_holes)
    obj = bpy.context.edit_object
    common.select_boundary(obj)
    assert bpy.ops.mesh.fairmesh_fill_holes(**vars(button)) == {"FINISHED"}
    new = [v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.select and not v.is_boundary]
    return common.coordinates(obj)[new]


def open_sphere(change, height):
    common.clear()
    obj = common.irregular_sphere(24)
    common.move(obj, change(common.coordinates(obj)))
    common.delete_faces(obj, lambda face: face.calc_center_median().z > height)


def rms(radius):
    return float(np.sqrt(np.mean((radius - 1) ** 2)))


def noisy(points):
    return points * (1 + 0.01 * np.random.default_rng(2).standard_normal(len(points)))[:, None]


def test_a_preset_for_scans_and_one_for_clean_parts():
    errors = {}
    for preset in ("Default", "Scan_Hole", "CAD", "Tangent"):
        take("Default" if preset == "Tangent" else preset)
        if preset == "Tangent":
            bpy.context.scene.fairmesh.curvature = "PART"
        open_sphere(noisy, 0.6)
        errors[preset, "scan"] = rms(np.linalg.norm(fill(), axis=1))
        open_sphere(lambda points: points * AXES, 0.5)
        errors[preset, "part"] = rms(np.linalg.norm(fill() / AXES, axis=1))
    assert errors["Scan_Hole", "scan"] < errors["Default", "scan"] / 5, errors
    assert errors["CAD", "part"] < errors["Tangent", "part"] / 3.5, errors
    assert errors["Default", "part"] < errors["Tangent", "part"] / 3.5, errors


def test_a_preset_leaves_nothing_of_another_one():
    settings = bpy.context.scene.fairmesh
    settings.density = 3.0
    take("Scan_Hole")
    assert (settings.relax_rim, settings.density) == (3, 1.0)
    take("CAD")
    assert (settings.relax_rim, settings.curvature, settings.continuity) == (0, "PART", 1.0)
    take("Default")
    assert (settings.curvature, settings.continuity) == ("AUTO", 0.0)


def test_users_add_presets_of_their_own():
    settings = bpy.context.scene.fairmesh
    settings.reset()
    settings.relax_rim, settings.target, settings.join = 5, "MINIMAL_ENERGY", True
    assert bpy.ops.scene.fairmesh_preset_add(name="My Scanner") == {"FINISHED"}
    (folder,) = bpy.utils.preset_paths("fairmesh")
    path = Path(folder) / "My_Scanner.py"
    settings.reset()
    assert bpy.ops.script.execute_preset(filepath=str(path), menu_idname="FAIRMESH_PT_presets") == {"FINISHED"}
    assert (settings.relax_rim, settings.target, settings.join) == (5, "MINIMAL_ENERGY", True)
    assert bpy.ops.scene.fairmesh_preset_add(name="My Scanner", remove_name=True) == {"FINISHED"}
    assert not path.exists()
    settings.reset()


runner.run(sys.modules[__name__])

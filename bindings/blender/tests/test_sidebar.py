# SPDX-License-Identifier: GPL-3.0-or-later
"""What the sidebar hands to the operators: presets."""

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
    for preset in ("Default", "Scan_Hole", "CAD"):
        take(preset)
        open_sphere(noisy, 0.6)
        errors[preset, "scan"] = rms(np.linalg.norm(fill(), axis=1))
        open_sphere(lambda points: points * AXES, 0.5)
        errors[preset, "part"] = rms(np.linalg.norm(fill() / AXES, axis=1))
    assert errors["Scan_Hole", "scan"] < errors["Default", "scan"] / 5, errors
    assert errors["CAD", "part"] < errors["Default", "part"] / 3.5, errors


def test_a_preset_leaves_nothing_of_another_one():
    settings = bpy.context.scene.fairmesh
    settings.density = 3.0
    take("Scan_Hole")
    assert (settings.relax_rim, settings.density) == (3, 1.0)
    take("CAD")
    assert settings.relax_rim == 0 and settings.continuity == 1.0
    take("Default")
    assert settings.continuity == 0.0


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

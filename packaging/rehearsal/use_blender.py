"""One fair and one fill on a sphere, by the zip of the add-on, which is installed first: blender -b --python use_blender.py -- TESTS ZIP"""

import sys

tests, archive = sys.argv[-2:]
sys.path.insert(0, tests)
import bpy  # isort: skip
import common  # isort: skip
import numpy as np  # isort: skip

common.install(archive)


def radial_error(obj):
    """The largest distance from the unit sphere."""
    return np.abs(np.linalg.norm(common.coordinates(obj), axis=1) - 1).max()


obj = common.irregular_sphere(16)
common.flatten_cap(obj)
assert bpy.ops.mesh.fairmesh_fair() == {"FINISHED"}
assert radial_error(obj) < 1e-5, radial_error(obj)

count = len(obj.data.vertices)
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.delete(type="VERT")
bpy.ops.mesh.select_all(action="SELECT")
assert bpy.ops.mesh.fairmesh_fill_all_holes() == {"FINISHED"}
bpy.ops.object.mode_set(mode="OBJECT")
assert len(obj.data.vertices) > count // 2 and radial_error(obj) < 1e-4, radial_error(obj)
print("Blender", bpy.app.version_string)

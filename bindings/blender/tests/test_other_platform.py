# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip for another platform: an old Blender installs it and says which one to take; from 4.2 on it is refused."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import common
import runner

ZIP = runner.arguments()[0]


def test_it_says_which_zip_to_take():
    if common.EXTENSIONS:
        # Blender prints "This platform (linux-x64) isn't one of (windows-x64)", and its operator goes on.
        try:
            common.install(ZIP)
        except AssertionError:
            assert not hasattr(bpy.types, "MESH_OT_fairmesh_fair")
            return
        raise AssertionError("it was installed")
    common.install(ZIP)
    common.flatten_cap(common.irregular_sphere(16))
    message = runner.raises(bpy.ops.mesh.fairmesh_fair, "is for windows-x64, and Blender runs on linux-x64 here: install")
    assert message.rstrip().endswith("the zip whose name ends with linux_x64"), message


if __name__ == "__main__":
    runner.run(sys.modules[__name__])

# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on disabled, enabled, updated over itself and removed, while it has been and is being used: no crash."""

import contextlib
import importlib
import io
import os
import re
import sys
import tempfile
import threading
import time
import unittest.mock
import zipfile
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import common
import runner

ZIP = runner.arguments()[0]
OPERATORS = (
    "fairmesh_fair",
    "fairmesh_fill_holes",
    "fairmesh_fill_all_holes",
    "fairmesh_join_loops",
    "fairmesh_bridge",
    "fairmesh_erase_and_fill",
    "fairmesh_round_edges",
    "fairmesh_live",
    "fairmesh_show_curvature",
    "fairmesh_hide_curvature",
    "fairmesh_select_found",
)
MENUS = (
    "VIEW3D_MT_edit_mesh_clean",
    "VIEW3D_MT_edit_mesh_vertices",
    "VIEW3D_MT_edit_mesh_edges",
    "VIEW3D_MT_edit_mesh_faces",
    "VIEW3D_MT_edit_mesh_delete",
    "VIEW3D_MT_edit_mesh_context_menu",
)


def has_tool():
    """Whether Fair Live is in the tool bar of Edit mode, in a place of its own and with an icon of its own."""
    from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active

    # Groups are tuples in it.
    found = [each for each in VIEW3D_PT_tools_active._tools["EDIT_MESH"] if getattr(each, "idname", None) == "fairmesh.live"]
    if found:
        assert bpy.app.icons.new_triangles_from_file(f"{found[0].icon}.dat") or bpy.app.background
    return bool(found)


def registered():
    return [name for name in OPERATORS if hasattr(bpy.types, f"MESH_OT_{name}")]


def use():
    common.clear()
    obj = common.irregular_sphere(16)
    free = common.flatten_cap(obj)
    assert bpy.ops.mesh.fairmesh_fair() == {"FINISHED"}
    assert common.radial_error(obj, free) < 1e-5


def module():
    return sys.modules[common.NAME]


def mapped():
    """The files of the library that this process has mapped."""
    lines = Path("/proc/self/maps").read_text().splitlines()
    return {line.split(maxsplit=5)[5] for line in lines if "libfairmesh" in line}


common.install(ZIP)


def test_the_library_runs_from_a_file_that_nobody_can_write_over():
    use()
    if sys.platform == "linux":
        assert mapped() and all(path.endswith("(deleted)") for path in mapped()), mapped()
    (installed,) = (Path(module().__file__).parent / "lib").glob("*-*/*fairmesh*")
    content = installed.read_bytes()
    # Cut short and written again, in place: that kills a process that has the file mapped, and Windows does not allow it.
    with installed.open("r+b") as file:
        file.truncate(0)
    use()
    installed.write_bytes(content)
    use()


def test_copies_that_windows_has_kept_are_removed():
    with tempfile.TemporaryDirectory() as folder:

        def copy(name, file, days):
            path = Path(folder) / name
            path.mkdir()
            (path / file).touch()
            os.utime(path, (time.time() - 86400 * days,) * 2)
            return path

        old = copy("fairmesh-blender-old", "fairmesh.dll", 2)
        kept = [
            copy("fairmesh-blender-new", "fairmesh.dll", 0),
            copy("fairmesh-blender-more", "mesh.blend", 2),
            copy("fairmesh-work", "fairmesh.dll", 2),
        ]
        module().native.remove_kept(folder, "fairmesh.dll")
        assert not old.exists() and all(any(path.iterdir()) for path in kept)
    if sys.platform == "win32":
        # What is loaded stays, however old it is.
        use()
        copies = list(Path(tempfile.gettempdir()).glob("fairmesh-blender-*/fairmesh.dll"))
        assert copies
        for path in copies:
            os.utime(path.parent, (time.time() - 2 * 86400,) * 2)
        module().native.remove_kept(tempfile.gettempdir(), "fairmesh.dll")
        assert any(path.exists() for path in copies)


def test_the_zip_has_what_this_platform_needs_and_no_more():
    with zipfile.ZipFile(ZIP) as file:
        names = file.namelist()
        manifest = file.read("fairmesh_blender/blender_manifest.toml").decode()
    (platform,) = re.findall(r'^platforms = \["(.*)"\]$', manifest, re.MULTILINE)
    binary = [name for name in names if name.endswith((".so", ".dll", ".dylib", ".pyd", ".whl"))]
    assert len(binary) == 1 and binary[0].startswith(f"fairmesh_blender/lib/{platform}/"), binary
    assert not [name for name in names if "_host_" in name], "files for meshes of other packages"
    assert re.search(r'^website = "https://', manifest, re.MULTILINE)


def test_disabled_and_enabled():
    for _ in range(3):
        use()
        bpy.ops.preferences.addon_disable(module=common.NAME)
        assert not registered() and not hasattr(bpy.types.Scene, "fairmesh") and not has_tool()
        bpy.ops.preferences.addon_enable(module=common.NAME)
        assert registered() == list(OPERATORS) and has_tool()
    use()


def test_updated_over_itself():
    for _ in range(2):
        use()
        before = module().fair_operator
        common.install(ZIP)
        assert registered() == list(OPERATORS)
        assert module().fair_operator is not before, "the old modules are still in use"
        use()


def test_disabled_while_the_library_works():
    obj = common.irregular_sphere(100)
    common.flatten_cap(obj)
    jobs, library = module().job, module().fairmesh
    module().native.load()
    mesh = module().snapshot.read(obj)
    free = module().region.free_mask(mesh, True)
    started = threading.Event()

    def work(monitor):
        def tell(_):
            started.set()
            while not monitor.is_cancelled:
                time.sleep(0.01)

        return library.fair(mesh.vertices, mesh.triangles, free=free, cancel=monitor, progress=tell)

    job = jobs.Job(work)
    job.start()
    assert started.wait(100)
    bpy.ops.preferences.addon_disable(module=common.NAME)
    assert not [t for t in threading.enumerate() if t.name == "fairmesh"]
    assert job.result().outcome == "cancelled"
    bpy.ops.preferences.addon_enable(module=common.NAME)
    use()


def test_the_menus_are_left_as_they_were():
    bpy.ops.preferences.addon_disable(module=common.NAME)
    bpy.ops.preferences.addon_enable(module=common.NAME)
    for menu in MENUS:
        drawn = getattr(bpy.types, menu).draw._draw_funcs
        ours = [f for f in drawn if f.__module__.startswith(common.NAME)]
        wanted = {"clean": 8, "vertices": 3, "edges": 6, "faces": 4, "delete": 1, "menu": 7}
        assert len(ours) == wanted[menu.rpartition("_")[2]], ours


def test_the_right_click_menu_has_what_the_select_mode_is_for():
    def entries(*mode):
        found = []
        layout = SimpleNamespace(operator=found.append)
        context = SimpleNamespace(tool_settings=SimpleNamespace(mesh_select_mode=mode))
        for draw in bpy.types.VIEW3D_MT_edit_mesh_context_menu.draw._draw_funcs:
            if draw.__module__.startswith(common.NAME):
                draw(SimpleNamespace(layout=layout), context)
        return {name.partition("fairmesh_")[2] for name in found}

    assert entries(True, False, False) == {"fair", "live", "fill_holes"}
    assert entries(False, True, False) == {"fair", "live", "fill_holes", "join_loops", "bridge", "round_edges"}
    assert entries(False, False, True) == {"fair", "live", "erase_and_fill"}


def test_tooltips_are_short_enough_for_blender():
    for name in OPERATORS:
        # Blender keeps 239 bytes.
        kind = getattr(bpy.ops.mesh, name).get_rna_type()
        assert 20 < len(kind.description.encode()) < 239, kind.description
        for option in kind.properties:
            if option.identifier != "rna_type":
                assert 15 < len(option.description) and option.description[-1] not in ".,:;", option.description


def test_the_sidebar_has_every_option():
    """But for which of two buttons it is, the range of colours, and what is dragged."""
    settings = set(bpy.types.Scene.bl_rna.properties["fairmesh"].fixed_type.properties.keys())
    for name in OPERATORS[:7]:
        options = set(getattr(bpy.ops.mesh, name).get_rna_type().properties.keys())
        assert options - settings <= {"rna_type", "scope", "edits", "mirror", "kind", "vertex", "hold"}, (
            name,
            options - settings,
        )


def test_the_manual_has_a_section_for_every_operator():
    manual = sys.modules[f"{common.NAME}.manual"]
    page = Path(module().__file__).parent / "manual" / "index.html"
    text = page.read_text(encoding="utf-8")
    assert manual.url() == page.as_uri()
    prefix, sections = manual._map()
    for name, place in sections:
        file, _, section = place.partition("#")
        assert prefix + file == page.as_uri() and f'id="{section}"' in text, (name, place)
    named = {name.rstrip("*").rpartition(".")[2] for name, _ in sections}
    assert set(OPERATORS) <= named
    for picture in re.findall(r'src="([^"]+)"', text):
        assert (page.parent / picture).is_file(), picture


def test_without_numpy_it_says_what_to_install():
    bpy.ops.preferences.addon_disable(module=common.NAME)
    said = io.StringIO()
    with unittest.mock.patch.dict(sys.modules, {"numpy": None}), contextlib.redirect_stdout(said):
        without = importlib.reload(module())
        without.register()
        assert hasattr(bpy.types, "VIEW3D_PT_fairmesh_no_numpy") and not registered()
        without.unregister()
    lines = said.getvalue().splitlines()
    assert len(lines) == 1 and "apt-get install python3-numpy" in lines[0], lines
    importlib.reload(module())
    bpy.ops.preferences.addon_enable(module=common.NAME)
    assert not hasattr(bpy.types, "VIEW3D_PT_fairmesh_no_numpy")
    use()


def test_removed():
    use()
    if common.EXTENSIONS:
        repositories = bpy.context.preferences.extensions.repos
        index = [r.module for r in repositories].index("user_default")
        bpy.ops.extensions.package_uninstall(repo_index=index, pkg_id="fairmesh")
    else:
        # The operator redraws the area that it is called from.
        window = bpy.context.window_manager.windows[0]
        with bpy.context.temp_override(window=window, area=window.screen.areas[0]):
            bpy.ops.preferences.addon_remove(module=common.NAME)
    assert not registered()
    assert common.NAME not in bpy.context.preferences.addons
    # And back.
    common.install(ZIP)
    use()


if __name__ == "__main__":
    runner.run(sys.modules[__name__])

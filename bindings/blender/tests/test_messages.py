# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said to the user: in Blender's labels and numbers, with advice that can be followed here."""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # isort: skip
import bmesh
import common
import numpy as np
import runner
from common import part, said

common.install(runner.arguments()[0])

ENUMERATIONS = ("Status", "Outcome", "LooseReason", "FillOutcome", "FillReason", "SharpFate")
# Of programs alone: arguments of a call, which the add-on's own calls do not get wrong.
OF_CALLS = range(1, 12)
# What the library's options are called there and, or so, everywhere.
EVERYWHERE = set("fair sharp smooth open loops vertices faces check free join input flat best threads fill single".split())
EVERYWHERE |= set("all angle creases edges".split())


def labels():
    """The names of all options and choices, and of the operators."""
    found = set()
    for option in bpy.context.scene.fairmesh.bl_rna.properties:
        found.add(option.name)
        if option.type == "ENUM":
            found |= {f"{option.name}: {item.name}" for item in option.enum_items}
    names = [name for name in dir(bpy.ops.mesh) if name.startswith("fairmesh_")]
    return found | {getattr(bpy.ops.mesh, name).get_rna_type().name for name in names}


def library_words():
    """What the library calls its options and their choices, as they stand in a text."""
    schema = sys.modules[f"{common.NAME}.fairmesh._schema"]
    words = set()
    for options in vars(schema).values():
        for name, form in getattr(options, "__annotations__", {}).items():
            words |= {name, *re.findall(r"'(\w+)'", str(form).replace('"', "'"))}
    assert {"inner_fairness", "conformal", "max_iterations", "relax_rim"} <= words, words
    return {word.replace("_", " ") for word in words} - EVERYWHERE


def answers():
    library = part("fairmesh")
    every = [answer for name in ENUMERATIONS for answer in getattr(library, name)]
    return [answer for answer in every if not (isinstance(answer, library.Status) and int(answer) in OF_CALLS)]


def test_every_answer_names_what_this_host_has():
    """No meaning and no advice has a word of the library for an option: each is one of Blender's labels."""
    known, words, advice = sorted(labels(), key=len, reverse=True), library_words(), part("advice")
    assert "Distribution: Even" in known and "uniform" in words
    assert len(answers()) > 60
    wrong = []
    for answer in answers():
        for text in (advice.meaning(answer), advice.remedy(answer), advice.remedy(answer, is_patch=True)):
            assert "{" not in text and "see the remedy" not in text or answer.value == 0, text
            rest = text
            for label in known:
                rest = rest.replace(label, "")
            named = [word for word in words if re.search(rf"\b{word}\b", rest, re.IGNORECASE)]
            wrong += [(answer, text, named)] if named else []
    assert not wrong, wrong


def test_uniform_inner_fairness_is_called_even():
    outcome = part("fairmesh").Outcome
    advice = part("advice").remedy(outcome.CONVERGED_POOR_TRIANGLES)
    assert "Distribution: Even" in advice and "Erase and Fill" in advice, advice
    patch = part("advice").remedy(outcome.ITERATION_LIMIT, is_patch=True)
    assert "Fair Selection with Region: Inside Faces" in patch and "64 at most" in patch, patch


def test_a_patch_whose_iterations_ran_out_is_faired_once_more():
    """A single hole has a limit of its own: the advice names what helps, and it does."""
    obj = common.irregular_sphere(16)
    common.delete_faces(obj, lambda face: face.calc_center_median().z > 0.3)
    common.select_boundary(obj)
    bpy.ops.mesh.fairmesh_fill_holes(max_iterations=1)
    assert "in 1 iteration:" in said() and "Fair Selection with Region: Inside Faces" in said(), said()
    new = np.array([v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.select and not v.is_boundary])
    assert bpy.ops.mesh.fairmesh_fair(region="FACES") == {"FINISHED"}
    assert ":" not in said() and common.radial_error(obj, new) < 0.01, said()


def test_faces_that_hang_at_single_vertices_are_no_open_surface():
    """A closed head with triangles that hang at one vertex each."""
    common.clear()
    obj = common.irregular_sphere(8)
    common.edit(obj)
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    tips = list(mesh.verts)[:70:7]
    for tip in tips:
        others = [mesh.verts.new(1.3 * tip.co + 0.1 * (k - 0.5) * tip.normal.orthogonal()) for k in range(2)]
        mesh.faces.new([tip, *others])
    bmesh.update_edit_mesh(obj.data)
    runner.raises(bpy.ops.mesh.fairmesh_fill_all_holes, "10 left open", "hang", "Delete these faces")
    assert "outer boundary of an open surface" not in said(), said()
    assert bpy.ops.mesh.fairmesh_select_found() == {"FINISHED"}
    assert sum(face.select for face in bmesh.from_edit_mesh(obj.data).faces) == 10


def test_faces_have_blenders_numbers():
    """A quad is one face here and two triangles in the library; the place is told first."""
    common.clear()
    obj = common.uv_sphere(24, 12)
    common.edit(obj)
    common.select_faces(obj, lambda face: face.calc_center_median().z > 0.3)
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.faces.ensure_lookup_table()
    quad = max((face for face in mesh.faces if len(face.verts) == 4), key=lambda face: face.calc_center_median().z)
    # The same face once more, turned about a corner, which Blender allows as other corners are between.
    new = mesh.faces.new([quad.verts[0], quad.verts[1], quad.verts[2]])
    new.select_set(True)
    bmesh.update_edit_mesh(obj.data)
    message = runner.raises(bpy.ops.mesh.fairmesh_fair, f"of {obj.name}: ", "The mesh is unchanged")
    numbers = [int(number) for number in re.findall(r"\d+", message.split(" of ")[0])]
    named = part("found")._last
    assert numbers == (named.faces or named.vertices), message
    assert "triangle" not in message, message


def test_the_whole_message_stays_for_the_sidebar():
    obj = common.tubes((1, (0, 0, 0), (0, 0, 2)))
    bpy.ops.mesh.select_all(action="SELECT")
    message = runner.raises(bpy.ops.mesh.fairmesh_bridge, "Whole loops")
    assert said() in message
    common.select_boundary(obj)
    assert bpy.ops.mesh.fairmesh_fill_holes() == {"FINISHED"}
    assert said().startswith("2 holes filled"), said()
    assert [good for good, _ in part("found").said(bpy.context)] == [True]
    common.clear()
    common.edit(common.geodesic_sphere(4))
    assert not part("found").said(bpy.context), "that was of another object"


runner.run(sys.modules[__name__])

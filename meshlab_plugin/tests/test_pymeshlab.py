# SPDX-License-Identifier: MIT OR Apache-2.0
"""The plugin in PyMeshLab: python test_pymeshlab.py PLUGIN"""

import ctypes
import importlib.metadata
import json
import pathlib
import sys
import tempfile
import unittest

import meshes
import numpy as np
import pymeshlab

FAIR = "apply_coord_fairing_to_selection"
CLOSE = "meshing_close_holes_and_fair"
ERASE = "meshing_erase_and_fill_selection"
BRIDGE = "meshing_bridge_boundaries"
ROUND = "meshing_round_edges"
CURVATURE = "compute_scalar_by_smooth_mean_curvature_per_vertex"
PLUGIN = str(pathlib.Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else ""


# What PyMeshLab 2022.2 cannot do by itself: it writes beyond its memory when it is given an attribute of points, takes no texture
# coordinates from arrays, and its Close Holes does not refine.
OLD = "2022" in importlib.metadata.version("pymeshlab")
unless_old = unittest.skipIf(OLD, "PyMeshLab 2022.2 lacks what the test needs, or crashes by itself")


def mesh_set(vertices, faces, **more):
    ms = pymeshlab.MeshSet(verbose=False)
    ms.add_mesh(pymeshlab.Mesh(np.array(vertices, float), np.array(faces, np.int32), **more))
    return ms


def state(mesh):
    """Everything that a mesh carries, to be compared bit by bit."""
    parts = {
        "vertices": mesh.vertex_matrix(),
        "faces": mesh.face_matrix(),
        "vertex normals": mesh.vertex_normal_matrix(),
        "face normals": mesh.face_normal_matrix(),
        "vertex quality": mesh.vertex_scalar_array(),
        "vertex colours": mesh.vertex_color_matrix(),
        "vertex selection": mesh.vertex_selection_array(),
        "face selection": mesh.face_selection_array(),
    }
    optional = {
        "vertex texture": (mesh.has_vertex_tex_coord, mesh.vertex_tex_coord_matrix),
        "wedge texture": (mesh.has_wedge_tex_coord, mesh.wedge_tex_coord_matrix),
        "face colours": (mesh.has_face_color, mesh.face_color_matrix),
        "face quality": (mesh.has_face_scalar, mesh.face_scalar_array),
    }
    parts.update({name: get() for name, (has, get) in optional.items() if has()})
    return {name: np.array(part) for name, part in parts.items()}


# PyMeshLab's own checks of parameters.
WRONG_PARAMETER = (RuntimeError, pymeshlab.PyMeshLabException, pymeshlab.pmeshlab.InvalidEnumException)


class Case(unittest.TestCase):
    def same(self, before, after, but=()):
        self.assertEqual(before.keys(), after.keys())
        for name in before.keys() - set(but):
            self.assertEqual(before[name].tobytes(), after[name].tobytes(), name)

    def on_sphere(self, ms, bar, text):
        mesh = ms.current_mesh()
        vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
        worst = np.abs(np.linalg.norm(vertices, axis=1) - 1).max()
        ratios = meshes.crease_ratios(vertices, faces, mesh.face_selection_array())
        print(f"{text}: {len(vertices)} vertices, |r - 1| at most {worst:.1e}, crease {ratios[0]:.4f} / {ratios[1]:.4f} of the sphere's")
        self.assertLess(worst, bar)
        self.assertLess(max(ratios), 1.2)

    def refused(self, ms, name, *words, **parameters):
        """The filter fails with a message that has these words, and the mesh stays exactly as it was."""
        before = state(ms.current_mesh())
        with self.assertRaises(pymeshlab.PyMeshLabException) as caught:
            ms.apply_filter(name, **parameters)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.same(before, state(ms.current_mesh()))


def dented_sphere(level=4, radius=1.0):
    """A sphere whose cap z > 0.6 is dented and selected."""
    vertices, faces = meshes.icosphere(level)
    vertices = meshes.jittered(vertices, 0.01, 3)
    ms = mesh_set(radius * vertices, faces)
    ms.compute_selection_by_condition_per_face(condselect=f"(z0+z1+z2)/3 > {0.6 * radius}")
    mesh = ms.current_mesh()
    inside = meshes.strictly_inside(len(vertices), faces, mesh.face_selection_array())
    vertices[inside] *= 0.9
    fresh = mesh_set(radius * vertices, faces, f_scalar_array=mesh.face_selection_array().astype(float))
    fresh.compute_selection_by_condition_per_face(condselect="fq > 0.5")
    return fresh, inside


class Sphere(Case):
    def test_close_holes_then_fair(self):
        ms = mesh_set(*meshes.open_sphere())
        old = ms.current_mesh().vertex_number()
        if not OLD:
            ms.meshing_close_holes(maxholesize=10000, newfaceselected=True, selfintersection=False, refinehole=True)
        else:
            ms.meshing_close_holes(maxholesize=10000, newfaceselected=True, selfintersection=False)
            length = pymeshlab.AbsoluteValue(0.05)
            ms.meshing_isotropic_explicit_remeshing(iterations=8, selectedonly=True, targetlen=length, reprojectflag=False)
        filled = np.linalg.norm(ms.current_mesh().vertex_matrix()[old:], axis=1)
        self.assertLess(filled.min(), 0.8, "MeshLab's own filling is flat")
        values = ms.apply_filter(FAIR)
        self.assertTrue(values["converged"])
        self.assertEqual(values["outcome"], 0)
        self.assertEqual(values["free_vertices"], ms.current_mesh().vertex_number() - old)
        self.on_sphere(ms, 1e-6, "Close Holes, then Fairmesh: Fair Selected Region")

    def test_a_seam_across_the_dent(self):
        ms, _ = dented_sphere()
        vertices, faces = ms.current_mesh().vertex_matrix(), ms.current_mesh().face_matrix()
        selected = ms.current_mesh().face_selection_array().astype(float)
        vertices, faces, seam = meshes.split_along(vertices, faces, vertices[faces].mean(axis=1)[:, 0] > 0)
        old = len(vertices) - len(seam)

        def faired(**parameters):
            ms = mesh_set(vertices, faces, f_scalar_array=selected)
            ms.compute_selection_by_condition_per_face(condselect="fq > 0.5")
            values = ms.apply_filter(FAIR, **parameters)
            return values, ms.current_mesh().vertex_matrix()

        values, after = faired()
        self.assertTrue(values["converged"])
        self.assertEqual(after[seam].tobytes(), after[old:].tobytes())
        self.assertLess(np.abs(np.linalg.norm(after, axis=1) - 1).max(), 1e-6)
        self.assertGreater((after[seam] != vertices[seam]).any(axis=1).sum(), 10)
        _, apart = faired(join_distance=-1)
        self.assertEqual(apart[seam].tobytes(), vertices[seam].tobytes())

    def test_own_filling(self):
        ms = mesh_set(*meshes.open_sphere())
        values = ms.apply_filter(CLOSE)
        self.assertEqual((values["closed"], values["left_open"], values["not_fair"]), (1, 0, 0))
        self.assertEqual((values["converged"], values["outcome"], values["fill_outcome"]), (True, 0, 0))
        self.assertGreater(values["new_vertices"], 500)
        self.assertEqual(ms.current_mesh().selected_face_number(), values["new_faces"])
        self.on_sphere(ms, 1e-6, "Fairmesh: Close Holes")

    @unless_old
    def test_given_normals(self):
        # A cap that ends at its boundary: nothing but the given normals says that it is a sphere.
        vertices, faces = meshes.icosphere(4)
        vertices, faces = meshes.without(vertices, faces, vertices[faces].mean(axis=1)[:, 2] < 0.5)
        normals = 3 * vertices
        flat = vertices.copy()
        flat[~meshes.on_boundary(len(vertices), faces), 2] = 0.55

        # Meshes made from arrays get normals of their own; those of a file are kept.
        file = pathlib.Path(tempfile.mkdtemp()) / "cap.ply"
        own = {f"n{'xyz'[axis]}": ("double", normals[:, axis]) for axis in range(3)}
        meshes.write_ply(file, flat, faces, vertex=own, kind="double")

        def worst(parameters, prepare):
            ms = pymeshlab.MeshSet(verbose=False)
            ms.load_new_mesh(str(file))
            prepare(ms.current_mesh())
            ms.set_selection_all()
            ms.apply_filter(FAIR, **parameters)
            return np.abs(np.linalg.norm(ms.current_mesh().vertex_matrix(), axis=1) - 1).max()

        def three_numbers(mesh):
            for axis in range(3):
                mesh.add_vertex_custom_scalar_attribute(np.ascontiguousarray(normals[:, axis]), "n_" + "xyz"[axis])

        def nothing(mesh):
            pass

        def a_point(mesh):
            mesh.add_vertex_custom_point_attribute(normals, "n")

        self.assertGreater(worst({}, nothing), 0.01)
        self.assertLess(worst({"boundary_normals": "Vertex normals"}, nothing), 1e-6)
        attribute = {"boundary_normals": "Attribute", "normal_attribute": "n"}
        self.assertLess(worst(attribute, a_point), 1e-6)
        self.assertLess(worst(attribute, three_numbers), 1e-6)


class Answers(Case):
    """The library's answers, tests/answers.json, come through: each parameter arrives. Parameters are floats here."""

    FILE = json.loads((pathlib.Path(__file__).resolve().parents[2] / "tests" / "answers.json").read_text())
    VALUES = {
        "inner_fairness": {"conformal": "Keep shapes", "convex": "Keep shapes, robust"},
        "target": {"minimal_energy": "Elastic sheet"},
        "boundary_normals": {"averaged": "Averaged"},
        "join": {"auto": "What belongs together", "none": "No"},
        "cap": {"fair": "Fair", "flat": "Plane"},
        "on_failure": {"best": "Best there is", "flat": "Flat", "open": "Nothing"},
    }
    SAME = ("continuity", "tolerance", "max_iterations", "max_new_vertices", "relax_rim", "relax_within")
    SAME += ("max_edges", "max_length", "max_area", "max_diagonal", "except_longest")

    def parameters(self, options, size):
        """None: the filters have no parameter for one of them. `size` is the diagonal of what is chosen."""
        made = {}
        for name, value in options.items():
            if name in self.VALUES and isinstance(value, str):
                made[name] = self.VALUES[name][value]
            elif name == "target":
                made.update(target="Bulged", bulge=value * size**3)
            elif name == "density":
                made["density"] = value / 2**0.5
            elif name == "intersections":
                made["check_intersections"] = value != "skip"
            elif name in self.SAME:
                made[name] = value
            else:
                return None
        return made

    def run_case(self, case):
        """The mesh afterwards and what the filter tells; nothing if it cannot be said here."""
        mesh = self.FILE["meshes"][case["mesh"]]
        vertices, faces = np.array(mesh["vertices"]), np.array(mesh["faces"])
        chosen = np.isin(faces, mesh["free"]).any(axis=1)
        size = np.linalg.norm(np.ptp(vertices[faces[chosen]].reshape(-1, 3), axis=0)) if chosen.any() else 0.0
        parameters = self.parameters(case["options"], size)
        filters = {"fair": FAIR, "fill_holes": CLOSE}
        if parameters is None or case["call"] not in filters:
            return None
        ms = mesh_set(vertices, faces, f_scalar_array=chosen.astype(float))
        ms.compute_selection_by_condition_per_face(condselect="fq > 0.5")
        return ms.current_mesh, ms.apply_filter(filters[case["call"]], **parameters)

    def test_all(self):
        done = []
        for case in (case for case in self.FILE["cases"] if "answer" in case):
            found, answer = self.run_case(case), case["answer"]
            if found is None:
                continue
            mesh, values = found
            with self.subTest(case["name"]):
                vertices = mesh().vertex_matrix()
                for vertex, place in answer["positions"]:
                    np.testing.assert_allclose(vertices[vertex], place, rtol=0, atol=1e-6)
                self.assertEqual(len(vertices), answer.get("vertex_count", len(vertices)))
                if case["call"] == "fair":
                    report = answer["report"]
                    self.assertEqual(values["converged"], report["outcome"] == "converged")
                    self.assertEqual(values["free_vertices"], report["free_vertices"])
                    self.assertAlmostEqual(values["smallest_angle"], report["worst_angle"], 4)
                else:
                    closed = [loop for loop in answer["loops"] if loop["outcome"] != "left_open"]
                    self.assertEqual(values["closed"], len(closed))
                done.append(case["name"])
        self.assertGreater(len(done), 22)


class Curvature(Case):
    def test_of_a_sphere(self):
        vertices, faces = meshes.icosphere(4)
        ms = mesh_set(2 * meshes.jittered(vertices, 0.005, 1), faces)
        before = state(ms.current_mesh())
        values = ms.apply_filter(CURVATURE)
        quality = ms.current_mesh().vertex_scalar_array()
        self.assertLess(np.abs(quality + 0.5).max(), 1e-6)
        self.assertAlmostEqual(values["curvature_mean"], -0.5, 6)
        self.assertEqual(values["vertices"], len(vertices))
        self.same(before, state(ms.current_mesh()), but=["vertex quality"])

    def test_of_a_faired_region(self):
        ms, inside = dented_sphere(radius=2.0)
        ms.apply_filter(FAIR, curvature_to_quality=True)
        quality = ms.current_mesh().vertex_scalar_array()
        self.assertLess(np.abs(quality[inside] + 0.5).max(), 1e-6)
        outside = ~inside
        outside[np.unique(ms.current_mesh().face_matrix()[ms.current_mesh().face_selection_array()])] = False
        self.assertEqual(np.abs(quality[outside]).max(), 0)


def decorated():
    """A dented sphere with everything that a mesh can carry."""
    plain, inside = dented_sphere()
    mesh = plain.current_mesh()
    vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
    random = np.random.default_rng(5)
    ms = mesh_set(
        vertices,
        faces,
        v_scalar_array=random.random(len(vertices)),
        v_color_matrix=random.random((len(vertices), 4)),
        v_tex_coords_matrix=random.random((len(vertices), 2)),
        w_tex_coords_matrix=random.random((3 * len(faces), 2)),
        f_color_matrix=random.random((len(faces), 4)),
        f_scalar_array=mesh.face_selection_array().astype(float),
    )
    ms.current_mesh().add_vertex_custom_scalar_attribute(random.random(len(vertices)), "number")
    ms.current_mesh().add_vertex_custom_point_attribute(random.random((len(vertices), 3)), "point")
    ms.compute_selection_by_condition_per_face(condselect="fq > 0.5")
    ms.compute_selection_by_condition_per_vertex(condselect="x > 0.5")
    return ms, inside


def attributes(mesh):
    return {
        "number": mesh.vertex_custom_scalar_attribute_array("number"),
        "point": mesh.vertex_custom_point_attribute_matrix("point"),
    }


class Survives(Case):
    @unless_old
    def test_fair(self):
        ms, inside = decorated()
        before = {**state(ms.current_mesh()), **attributes(ms.current_mesh())}
        ms.apply_filter(FAIR)
        after = {**state(ms.current_mesh()), **attributes(ms.current_mesh())}
        moves = ["vertices", "vertex normals", "face normals"]
        self.same(before, after, but=moves)
        self.assertEqual(before["vertices"][~inside].tobytes(), after["vertices"][~inside].tobytes())
        self.assertTrue((before["vertices"][inside] != after["vertices"][inside]).any(axis=1).all())
        # Normals are those of the new surface there, of length one for faces, and what they were elsewhere.
        unit = after["vertex normals"] / np.linalg.norm(after["vertex normals"], axis=1)[:, None]
        self.assertLess(np.abs(unit - after["vertices"]).max(), 0.02)
        a, b, c = after["vertices"][after["faces"]].transpose(1, 0, 2)
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        self.assertLess(np.abs(after["face normals"] - normals).max(), 1e-12)

    @unless_old
    def test_close(self):
        ms, _ = decorated()
        ms.meshing_remove_selected_faces()
        ms.meshing_remove_unreferenced_vertices()
        ms.set_selection_none()
        ms.compute_selection_by_condition_per_face(condselect="z0 < -0.5")
        mesh = ms.current_mesh()
        before, marks = state(mesh), attributes(mesh)
        old_vertices, old_faces = mesh.vertex_number(), mesh.face_number()
        values = ms.apply_filter(CLOSE)
        after, new_marks = state(ms.current_mesh()), attributes(ms.current_mesh())
        self.assertGreater(values["new_vertices"], 10)
        for name in before:
            per_wedge = 3 if name == "wedge texture" else 1
            count = old_vertices if len(before[name]) == old_vertices else old_faces * per_wedge
            if name in ("vertex normals", "face normals"):
                continue
            self.assertEqual(before[name].tobytes(), after[name][:count].tobytes(), name)
        for name in marks:
            self.assertEqual(marks[name].tobytes(), new_marks[name][:old_vertices].tobytes(), name)
        self.assertTrue(after["face selection"][old_faces:].all())
        # Means of random numbers between 0 and 1: neither 0, nor all the same, nor outside.
        for name, numbers in [*after.items(), *new_marks.items()]:
            if name in ("vertex quality", "vertex texture", "number", "point"):
                new = numbers[old_vertices:]
                self.assertTrue(new.min() > 0 and new.max() < 1 and new.std() > 0.01, name)
        wedges = after["wedge texture"][3 * old_faces :]
        self.assertTrue(wedges.min() > 0 and wedges.max() < 1 and wedges.std() > 0.01)

    @unless_old
    def test_erase(self):
        ms, _ = decorated()
        mesh = ms.current_mesh()
        before, marks = state(mesh), attributes(mesh)
        ms.apply_filter(ERASE)
        after, new_marks = state(ms.current_mesh()), attributes(ms.current_mesh())
        erased = before["face selection"]
        stay = np.unique(before["faces"][~erased])
        old = len(stay)
        # What is left keeps its bits, in its order; around the selection some triangles hung loose.
        self.assertGreater(old, 500)
        for name in ("vertices", "vertex quality", "vertex colours", "vertex texture"):
            kept = after[name][np.isin(after["vertices"], before["vertices"]).all(axis=1)]
            self.assertTrue(np.isin(kept, before[name][stay]).all(), name)
            self.assertGreater(len(kept), old - 20)
        self.assertEqual(after["vertices"][:100].tobytes(), before["vertices"][stay][:100].tobytes())
        self.assertEqual(new_marks["point"][:100].tobytes(), marks["point"][stay][:100].tobytes())
        for name, numbers in [*after.items(), *new_marks.items()]:
            if name in ("vertex quality", "vertex texture", "number", "point"):
                new = numbers[old:]
                self.assertTrue(new.min() > 0 and new.max() < 1 and new.std() > 0.01, name)
        self.assertEqual(int(after["face selection"].sum()), len(after["faces"]) - np.flatnonzero(after["face selection"])[0])


class Close(Case):
    def two_holes(self):
        vertices, faces = meshes.icosphere(4)
        height = vertices[faces].mean(axis=1)[:, 2]
        return mesh_set(*meshes.without(vertices, faces, (height > 0.9) | (height < -0.95)))

    def test_at_the_selection(self):
        ms = self.two_holes()
        ms.compute_selection_by_condition_per_face(condselect="z0 < -0.8")
        values = ms.apply_filter(CLOSE, touching_selection=True, selection_after="New faces")
        self.assertEqual(values["closed"], 1)
        mesh = ms.current_mesh()
        self.assertEqual(mesh.selected_face_number(), values["new_faces"])
        self.assertLess(mesh.vertex_matrix()[mesh.face_matrix()[mesh.face_selection_array()]][:, :, 2].max(), -0.9)

    def test_outer_boundary_stays_open(self):
        vertices, faces = meshes.icosphere(3)
        sheet = meshes.without(vertices, faces, vertices[faces].mean(axis=1)[:, 2] < 0.9)
        ms = mesh_set(*sheet)
        self.assertEqual(ms.apply_filter(CLOSE)["closed"], 0)
        self.assertEqual(ms.apply_filter(CLOSE, outer_boundaries=True)["closed"], 1)

    def test_density_and_bulge_mean_the_same_at_any_size(self):
        vertices, faces = meshes.open_sphere(4)
        made = {}
        for size in (1.0, 100.0):
            for density in (1.0, 2.0):
                ms = mesh_set(size * vertices, faces)
                values = ms.apply_filter(CLOSE, density=density, target="Bulged", bulge=50.0)
                self.assertTrue(values["converged"], values)
                made[size, density] = ms.current_mesh().vertex_matrix() / size
        self.assertLess(np.abs(made[1.0, 1.0] - made[100.0, 1.0]).max(), 1e-6)
        self.assertGreater(np.linalg.norm(made[1.0, 1.0], axis=1).max(), 1.01)
        new = [len(made[1.0, density]) - len(vertices) for density in (1.0, 2.0)]
        self.assertTrue(3 < new[1] / new[0] < 5, new)

    def test_holes_that_no_patch_can_close_are_counted(self):
        vertices, faces = meshes.open_sphere(4)
        a, b = meshes.boundary_edge(faces)
        fins = [[b, a, len(vertices)], [b, a, len(vertices) + 1]]
        points = np.vstack([vertices, vertices[a] * 1.2, vertices[a] * 0.8])
        ms = mesh_set(points, np.vstack([faces, fins]))
        values = ms.apply_filter(CLOSE)
        self.assertFalse(values["converged"], values)
        self.assertGreaterEqual(values["left_open"], 1)


class Join(Case):
    def whole_sphere(self, ms, bar=1e-8):
        mesh = ms.current_mesh()
        vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
        self.assertEqual(ms.apply_filter("get_topological_measures")["genus"], 0)
        self.assertEqual(len(vertices) - len(faces) // 2, 2)
        self.assertFalse(meshes.on_boundary(len(vertices), faces).any())
        self.assertLess(np.abs(np.linalg.norm(vertices, axis=1) - 1).max(), bar)

    def test_a_sphere_without_a_band(self):
        for join in ("What belongs together", "All loops at the selection"):
            ms = mesh_set(*meshes.band_missing())
            ms.set_selection_all()
            values = ms.apply_filter(CLOSE, join=join, selection_after="New faces")
            self.assertTrue(values["converged"])
            self.assertEqual((values["closed"], values["joined"], values["left_open"]), (1, 2, 0))
            self.assertEqual(ms.current_mesh().selected_face_number(), values["new_faces"])
            self.whole_sphere(ms)

    def test_a_part_that_is_turned_around_is_refused_with_both_loops(self):
        vertices, faces = meshes.band_missing()
        below = vertices[faces[:, 0], 2] < 0
        ms = mesh_set(vertices, np.where(below[:, None], faces[:, ::-1], faces))
        ms.set_selection_all()
        before = state(ms.current_mesh())
        values = ms.apply_filter(CLOSE, join="All loops at the selection")
        self.assertEqual((values["converged"], values["left_open"], values["new_faces"]), (False, 1, 0))
        self.same(before, state(ms.current_mesh()))

    def test_one_loop_alone_is_refused(self):
        ms = mesh_set(*meshes.band_missing())
        ms.compute_selection_by_condition_per_face(condselect="z0 > 0")
        before = state(ms.current_mesh())
        with self.assertRaisesRegex(pymeshlab.PyMeshLabException, "there is one alone"):
            ms.apply_filter(CLOSE, join="All loops at the selection")
        self.same(before, state(ms.current_mesh()))


class Erase(Case):
    def bumpy(self):
        vertices, faces = meshes.icosphere(4)
        vertices = vertices.copy()
        cap = vertices[:, 2] > 0.85
        vertices[cap] *= np.random.RandomState(3).uniform(0.8, 1.2, (cap.sum(), 1))
        selected = cap[faces].any(axis=1)
        ms = mesh_set(vertices, faces)
        ms.compute_selection_by_condition_per_face(condselect="x0*x0+y0*y0 < 0.01 && z0 > 0")
        for _ in range(40):
            if (ms.current_mesh().face_selection_array() | ~selected).all():
                break
            ms.apply_filter("apply_selection_dilatation")
        return ms

    def test_a_bump_is_replaced(self):
        ms = self.bumpy()
        faces = ms.current_mesh().face_number()
        selected = ms.current_mesh().selected_face_number()
        values = ms.apply_filter(ERASE)
        self.assertTrue(values["converged"])
        self.assertGreaterEqual(values["erased_faces"], selected)
        mesh = ms.current_mesh()
        self.assertEqual(mesh.face_number(), faces - values["erased_faces"] + values["new_faces"])
        self.assertEqual(mesh.selected_face_number(), values["new_faces"])
        Join.whole_sphere(self, ms)
        # Once more, elsewhere.
        ms.compute_selection_by_condition_per_face(condselect="x0 > 0.8")
        ms.apply_filter(ERASE)
        Join.whole_sphere(self, ms)

    def test_refusals_leave_the_mesh_as_it_was(self):
        vertices, faces = meshes.icosphere(3)
        sheet = meshes.without(vertices, faces, vertices[faces].mean(axis=1)[:, 2] < 0.9)
        for condition, message in (
            ("x0 > 2", "No face is selected"),
            ("z0 < 0.95 && x0 > 0", "outer boundary of an open surface"),
            ("z0 > 0", "Nothing is left around"),
        ):
            ms = mesh_set(*sheet)
            ms.compute_selection_by_condition_per_face(condselect=condition)
            before = state(ms.current_mesh())
            with self.assertRaisesRegex(pymeshlab.PyMeshLabException, message):
                ms.apply_filter(ERASE)
            self.same(before, state(ms.current_mesh()))


class Bridge(Case):
    def two_rims(self, condition, half=0.25):
        """A sphere without a band; selected is a stretch of both rims, by vertices or by faces."""
        ms = mesh_set(*meshes.band_missing())
        mesh = ms.current_mesh()
        ms.set_selection_none()
        rim = meshes.on_boundary(mesh.vertex_number(), mesh.face_matrix())
        self.assertGreater(rim.sum(), 40)
        if condition == "vertices":
            ms.compute_selection_by_condition_per_vertex(condselect=f"x > 0 && abs(y) < {half} && abs(z) < 0.5")
        else:
            ms.compute_selection_by_condition_per_face(condselect=f"x0 > 0 && abs(y0+y1+y2) < {3 * half} && abs(z0+z1+z2) < 1.4")
        return ms

    def test_between_two_rims(self):
        for condition in ("vertices", "faces"):
            ms = self.two_rims(condition)
            before = state(ms.current_mesh())
            old_vertices, old_faces = ms.current_mesh().vertex_number(), ms.current_mesh().face_number()
            values = ms.apply_filter(BRIDGE)
            mesh = ms.current_mesh()
            self.assertEqual((values["converged"], values["outcome"], values["fill_outcome"]), (True, 0, 0))
            self.assertLess(abs(values["twist"]), 1)
            self.assertEqual(mesh.vertex_number(), old_vertices + values["new_vertices"])
            self.assertEqual(mesh.face_number(), old_faces + values["new_faces"])
            self.assertEqual(mesh.selected_face_number(), values["new_faces"])
            self.assertEqual(mesh.vertex_matrix()[:old_vertices].tobytes(), before["vertices"].tobytes())
            # One boundary is left, of a sheet that goes around it: a tube with a hole in its side, closed at both ends.
            boundary = meshes.on_boundary(mesh.vertex_number(), mesh.face_matrix())
            self.assertTrue(boundary.any())
            self.assertLess(np.abs(np.linalg.norm(mesh.vertex_matrix(), axis=1) - 1).max(), 0.01)

    def test_and_what_is_left_is_filled(self):
        for parameters, half in (({}, 0.25), ({"width": 0.5}, 0.04)):
            ms = self.two_rims("vertices", half)
            values = ms.apply_filter(BRIDGE, fill_rest=True, **parameters)
            self.assertEqual((values["converged"], values["closed"], values["left_open"]), (True, 1, 0))
            Join.whole_sphere(self, ms)

    def test_attributes_are_interpolated(self):
        vertices, faces = meshes.band_missing()
        height = (vertices[:, 2] + 1) / 2
        ms = mesh_set(vertices, faces, v_scalar_array=height)
        ms.compute_selection_by_condition_per_vertex(condselect="x > 0 && abs(y) < 0.25 && abs(z) < 0.5")
        ms.apply_filter(BRIDGE)
        after = ms.current_mesh()
        quality, positions = after.vertex_scalar_array(), after.vertex_matrix()
        self.assertEqual(quality[: len(height)].tobytes(), height.tobytes())
        self.assertLess(np.abs(quality - (positions[:, 2] + 1) / 2).max(), 0.1)

    def test_what_is_no_pair_of_stretches(self):
        ms = self.two_rims("vertices")
        ms.set_selection_none()
        self.refused(ms, BRIDGE, "Select two stretches of boundary", "0 are selected")
        ms.compute_selection_by_condition_per_vertex(condselect="x > 0 && abs(y) < 0.25 && z > 0 && z < 0.5")
        self.refused(ms, BRIDGE, "1 is selected")
        ms.set_selection_all()
        self.refused(ms, BRIDGE, "All of the boundary at vertex", "Join loops")
        vertices, faces = meshes.band_missing()
        below = vertices[faces[:, 0], 2] < 0
        ms = mesh_set(vertices, np.where(below[:, None], faces[:, ::-1], faces))
        ms.compute_selection_by_condition_per_vertex(condselect="x > 0 && abs(y) < 0.25 && abs(z) < 0.5")
        self.refused(ms, BRIDGE, "No bridge was made", "Invert Faces Orientation")


class Rounded(Case):
    def test_a_cube_gets_cylinders_and_its_faces_stay_planes(self):
        for parameters in ({"width": 0.2}, {"radius": 0.2, "creases": "That stand out", "angle": 40}):
            ms = mesh_set(*meshes.centred_cube(2))
            values = ms.apply_filter(ROUND, **parameters)
            mesh = ms.current_mesh()
            self.assertTrue(values["converged"])
            self.assertEqual((values["creases"], values["rounded"], values["unsolved"], values["sharp_corners"]), (12, 12, 0, 0))
            self.assertEqual(mesh.selected_face_number(), values["new_faces"])
            vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
            self.assertFalse(meshes.on_boundary(len(vertices), faces).any())
            self.assertLess(meshes.off_rounded_cube(vertices, 0.2), 1e-3)
            flat = vertices[faces[~mesh.face_selection_array()]]
            self.assertTrue((np.abs(flat).min(axis=1).max(axis=1) == 1).all())

    def test_only_selected_edges(self):
        ms = mesh_set(*meshes.centred_cube(2))
        self.refused(ms, ROUND, "No edge is selected", width=0.2, creases="Selected edges")
        ms.apply_filter("compute_selection_crease_per_edge")
        self.assertEqual(ms.apply_filter(ROUND, width=0.2, creases="Selected edges")["rounded"], 12)

    def test_one_end_is_larger_than_the_other(self):
        vertices, faces = meshes.centred_cube(2)
        # An open tray: the rim's corners are the ends of upright edges.
        ms = mesh_set(vertices, faces[(vertices[faces][:, :, 2] < 0.999).any(axis=1) & (vertices[faces][:, :, 2] > -0.999).any(axis=1)])
        self.assertTrue(ms.apply_filter(ROUND, width=0.2, taper=2)["converged"])
        points = ms.current_mesh().vertex_matrix()
        ends = [np.linalg.norm(points[np.abs(points[:, 2] - z) < 1e-6] - (1, 1, z), axis=1).min() for z in (-1, 1)]
        np.testing.assert_allclose(np.sort(ends), (np.sqrt(2) - 1) * 0.2 * np.array((1, 2)), rtol=0.02)

    def test_what_faces_carry_goes_on(self):
        vertices, faces = meshes.centred_cube(4)
        corners = vertices[faces]
        side = np.abs(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])).argmax(axis=1)
        wedges = np.array([np.delete(three, axis, axis=1) for three, axis in zip(corners, side, strict=True)]).reshape(-1, 2)
        colors = np.ones((len(faces), 4))
        colors[:, :3] = 0.25 * (1 + side[:, None] == 1 + np.arange(3)) + 0.5
        more = {} if OLD else {"w_tex_coords_matrix": wedges}
        ms = mesh_set(vertices, faces, f_color_matrix=colors, v_scalar_array=vertices[:, 2], **more)
        ms.apply_filter(ROUND, width=0.2)
        mesh = ms.current_mesh()
        after, new = mesh.vertex_matrix()[mesh.face_matrix()], mesh.face_selection_array()
        side = np.abs(np.cross(after[:, 1] - after[:, 0], after[:, 2] - after[:, 0])).argmax(axis=1)
        expected = 0.25 * (side[:, None] == np.arange(3)) + 0.5
        self.assertLess(np.abs(mesh.face_color_matrix()[:, :3] - expected)[~new].max(), 1 / 200)
        self.assertLess(np.abs(mesh.vertex_scalar_array() - mesh.vertex_matrix()[:, 2]).max(), 0.2)
        if not OLD:
            found = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
            flat = np.array([np.delete(three, axis, axis=1) for three, axis in zip(after, side, strict=True)])
            self.assertLess(np.abs(found - flat)[~new].max(), 1e-5)

    def test_what_cannot_be(self):
        ms = mesh_set(*meshes.centred_cube(2))
        self.refused(ms, ROUND, "Give a width or a radius")
        self.refused(ms, ROUND, "Give a width or a radius", width=0.1, radius=0.1)
        self.refused(ms, ROUND, "Parameter width is negative", width=-0.1)
        self.refused(ms, ROUND, "No edge bends enough", width=0.1, creases="In folds")


class Guides(Case):
    def slit(self):
        """The unit sphere without a narrow strip along the equator's front."""
        vertices, faces = meshes.icosphere(4)
        inside = (np.abs(vertices[faces][:, :, 2]) < 0.1).all(axis=1) & (vertices[faces][:, :, 0] > 0.3).all(axis=1)
        return meshes.without(vertices, faces, inside)

    def ends(self, vertices, faces):
        """Two vertices that face each other across the slit."""
        rim = np.flatnonzero(meshes.on_boundary(len(vertices), faces))
        front = vertices[rim] @ [1, 0.2, 0]
        return [int(rim[np.argmax(np.where(side * vertices[rim, 2] > 0, front, -1))]) for side in (1, -1)]

    def test_named_and_selected(self):
        vertices, faces = self.slit()
        a, b = self.ends(vertices, faces)
        for parameters in ({"guides": f"{a} {b}"}, {"guides": f" {b},{a}; "}, {"guide_selected": True}):
            ms = mesh_set(vertices, faces)
            ms.compute_selection_by_condition_per_vertex(condselect=f"vi == {a} || vi == {b}")
            self.assertTrue(ms.apply_filter(CLOSE, **parameters)["converged"])
            Join.whole_sphere(self, ms)

    def test_reach_the_library(self):
        vertices, faces = self.slit()
        a, b = self.ends(vertices, faces)
        rim = np.flatnonzero(meshes.on_boundary(len(vertices), faces))
        far = [int(rim[np.argmax(side * vertices[rim, 1])]) for side in (1, -1)]
        inner = int(np.argmin(vertices[:, 0]))
        refuse = self.refused
        refuse(mesh_set(vertices, faces), CLOSE, "12 13 14", "is no pair of vertices", guides="12 13 14")
        refuse(mesh_set(vertices, faces), CLOSE, "is no pair of vertices", guides="a b")
        refuse(mesh_set(vertices, faces), CLOSE, str(inner), guides=f"{a} {inner}")
        refuse(mesh_set(vertices, faces), CLOSE, "cross", guides=f"{a} {b}; {far[0]} {far[1]}")
        refuse(mesh_set(vertices, faces), CLOSE, "0 are selected", guide_selected=True)


class RoughRims(Case):
    def noisy(self):
        """A sphere without a cap, whose rim is noise of a fifth of an edge."""
        vertices, faces = meshes.open_sphere(4)
        noise = np.random.default_rng(2).normal(0, 0.2 * 0.07, len(vertices))
        return vertices * (1 + noise * (vertices[:, 2] > 0.55))[:, None], faces

    def test_old_vertices_are_written_back(self):
        vertices, faces = self.noisy()
        random = np.random.default_rng(4)
        colors, height = random.random((len(vertices), 4)), random.random(len(vertices))

        def filled(**parameters):
            ms = mesh_set(vertices, faces, v_color_matrix=colors, v_scalar_array=height)
            before = state(ms.current_mesh())
            values = ms.apply_filter(CLOSE, **parameters)
            return ms, before, values

        ms, before, values = filled()
        self.assertEqual((values["moved_vertices"], values["moved_largest"]), (0, 0))
        stiff = np.linalg.norm(ms.current_mesh().vertex_matrix()[len(vertices) :], axis=1) - 1
        ms, before, values = filled(relax_rim=4)
        self.assertEqual((values["closed"], values["left_open"]), (1, 0))
        after = state(ms.current_mesh())
        moved = (after["vertices"][: len(vertices)] != vertices).any(axis=1)
        self.assertEqual(values["moved_vertices"], moved.sum())
        self.assertGreater(moved.sum(), 100)
        self.assertGreater(vertices[moved, 2].min(), 0.4)
        how_far = np.linalg.norm(after["vertices"][: len(vertices)] - vertices, axis=1)
        self.assertAlmostEqual(values["moved_largest"], how_far.max(), 9)
        soft = np.linalg.norm(after["vertices"][len(vertices) :], axis=1) - 1
        self.assertLess(np.sqrt((soft**2).mean()), 0.5 * np.sqrt((stiff**2).mean()))
        # What they carry stays, and their normals are those of the surface as it is now.
        for name in ("vertex colours", "vertex quality"):
            self.assertEqual(before[name].tobytes(), after[name][: len(vertices)].tobytes(), name)
        a, b, c = after["vertices"][after["faces"]].transpose(1, 0, 2)
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        self.assertLess(np.abs(after["face normals"] - normals).max(), 1e-6)
        # No further than asked.
        _, _, values = filled(relax_rim=4, relax_within=0.002)
        self.assertAlmostEqual(values["moved_largest"], 0.002, 9)

    def test_erase(self):
        vertices, faces = self.noisy()
        ms = mesh_set(vertices, faces)
        ms.apply_filter(CLOSE, selection_after="New faces")
        values = ms.apply_filter(ERASE, relax_rim=3)
        self.assertGreater(values["moved_vertices"], 50)

    def test_as_many_rings_as_are_advised(self):
        moved = [mesh_set(*self.noisy()).apply_filter(CLOSE, relax_rim=rings)["moved_vertices"] for rings in (3, -1)]
        self.assertEqual(*moved)

    def test_wrong_numbers(self):
        vertices, faces = self.noisy()
        self.refused(mesh_set(vertices, faces), CLOSE, "relax_rim is -2: it must be at least -1", relax_rim=-2)
        self.refused(mesh_set(vertices, faces), CLOSE, "relax_within", relax_rim=2, relax_within=-1.0)


class Trim(Case):
    def ragged(self):
        """A sphere with two holes; at the upper one hangs a fin, at the lower one another."""
        vertices, faces = meshes.icosphere(4)
        height = vertices[faces].mean(axis=1)[:, 2]
        vertices, faces = meshes.without(vertices, faces, (height > 0.9) | (height < -0.95))
        edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
        unique, count = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
        rim = {tuple(edge) for edge in unique[count == 1].tolist()}
        added, fins = list(vertices), []
        for side in (1, -1):
            a, b = next((a, b) for a, b in edges.tolist() if tuple(sorted((a, b))) in rim and side * vertices[a, 2] > 0)
            added.append((vertices[a] + vertices[b]) / 2 * 1.3)
            fins.append([b, a, len(added) - 1])
        return np.array(added), np.vstack([faces, fins])

    def test_at_the_holes_that_are_closed(self):
        vertices, faces = self.ragged()
        ms = mesh_set(vertices, faces)
        ms.compute_selection_by_condition_per_face(condselect="z0 > 0.8 && z0 < 1.05 && z1 < 1.05 && z2 < 1.05")
        values = ms.apply_filter(CLOSE, trim=10, touching_selection=True)
        self.assertEqual((values["converged"], values["closed"]), (True, 1))
        self.assertTrue(1 <= values["trimmed_faces"] <= 10)
        self.assertGreater(values["trimmed_area"], 0)
        mesh = ms.current_mesh()
        self.assertEqual(mesh.face_number(), len(faces) - values["trimmed_faces"] + values["new_faces"])
        # The other one keeps its fin.
        outside = np.linalg.norm(mesh.vertex_matrix(), axis=1) > 1.1
        self.assertEqual((outside.sum(), mesh.vertex_matrix()[outside, 2].max() < 0), (1, True))
        values = ms.apply_filter(CLOSE, trim=10)
        self.assertEqual((values["converged"], values["closed"]), (True, 1))
        Join.whole_sphere(self, ms)

    def test_not_unless_asked(self):
        ms = mesh_set(*self.ragged())
        values = ms.apply_filter(CLOSE)
        self.assertEqual((values["closed"], values["trimmed_faces"]), (2, 0))
        self.refused(mesh_set(*self.ragged()), CLOSE, "trim is -1", trim=-1)
        self.refused(mesh_set(*self.ragged()), CLOSE, "area", trim=3, trim_area=-1.0)

    def test_beside_erased_faces(self):
        vertices, faces = self.ragged()
        ms = mesh_set(vertices, faces)
        ms.compute_selection_by_condition_per_face(condselect="x0 > 0.8")
        values = ms.apply_filter(ERASE, clean_boundary=5)
        self.assertTrue(values["converged"])
        self.assertLessEqual(values["cleaned_faces"], 5)


class Words(Case):
    def test_names_for_python(self):
        # Filters of plugins that are loaded are no methods: PyMeshLab makes these when it is imported.
        for name in (FAIR, CLOSE, ERASE, BRIDGE, CURVATURE):
            self.assertTrue(name in pymeshlab.filter_list(), name)
            self.assertFalse(hasattr(pymeshlab.MeshSet(verbose=False), name))

    def test_defaults_are_within_reason(self):
        ms, _ = dented_sphere(2)
        for name in (FAIR, CLOSE, ERASE, BRIDGE):
            numbers = {k: v for k, v in ms.filter_parameter_values(name).items() if type(v) in (int, float)}
            self.assertGreater(len(numbers), 4)
            for parameter, value in numbers.items():
                self.assertLess(abs(value), 1e6, (name, parameter))

    def test_every_filter_tells_its_outcome_and_counts(self):
        ms, _ = dented_sphere(3)
        told = {FAIR: ms.apply_filter(FAIR), ERASE: ms.apply_filter(ERASE), CURVATURE: ms.apply_filter(CURVATURE)}
        ms = mesh_set(*meshes.open_sphere(3))
        told[CLOSE] = ms.apply_filter(CLOSE)
        self.assertEqual(ms.apply_filter(CLOSE)["closed"], 0)
        told[BRIDGE] = Bridge.two_rims(self, "vertices").apply_filter(BRIDGE)
        wanted = {"converged", "outcome", "iterations", "seconds"}
        made = {"new_vertices", "new_faces", "fill_outcome", "left_open", "closed"}
        self.assertLessEqual(wanted | {"free_vertices", "intersections", "components"}, told[FAIR].keys())
        self.assertLessEqual(wanted | made | {"not_fair", "joined", "moved_vertices", "trimmed_faces"}, told[CLOSE].keys())
        self.assertLessEqual(wanted | made | {"erased_faces", "cleaned_faces", "moved_vertices"}, told[ERASE].keys())
        self.assertLessEqual(wanted | made | {"twist"}, told[BRIDGE].keys())
        self.assertLessEqual({"vertices", "curvature_min", "curvature_max", "curvature_mean", "seconds"}, told[CURVATURE].keys())


class Sharp(Case):
    """A ridge that leads into the region."""

    def faired(self, sharp, is_fading=False):
        """The largest distance from the roof, and what the filter tells."""
        vertices, faces, inside = meshes.roof(is_fading)
        ms = mesh_set(vertices, faces, f_scalar_array=inside[faces].any(axis=1).astype(float))
        ms.compute_selection_by_condition_per_face(condselect="fq > 0.5")
        values = ms.apply_filter(FAIR, sharp=sharp)
        at = ms.current_mesh().vertex_matrix()
        return np.abs(at[:, 2] + np.abs(at[:, 1])).max(), values

    def test_it_goes_on_where_that_is_asked_for(self):
        off, values = self.faired(20)
        self.assertLess(off, 1e-5)
        self.assertEqual((values["sharp_edges"], values["converged"]), (1, True))
        off, values = self.faired(0)
        self.assertGreater(off, 0.1)
        self.assertEqual(values["sharp_edges"], 0)

    def test_selected_edges_go_on_however_little_they_bend(self):
        vertices, faces, inside = meshes.roof(False)
        for selected in (False, True):
            ms = mesh_set(vertices * [1, 1, 0.1], faces, f_scalar_array=inside[faces].any(axis=1).astype(float))
            ms.compute_selection_by_condition_per_face(condselect="fq > 0.5")
            if selected:
                ms.compute_selection_crease_per_edge(angledegneg=-5, angledegpos=5)
            values = ms.apply_filter(FAIR, sharp=90)
            at = ms.current_mesh().vertex_matrix()
            off = np.abs(at[:, 2] + 0.1 * np.abs(at[:, 1])).max()
            self.assertEqual((values["sharp_edges"], off < 1e-5), (int(selected), selected), off)

    def test_one_that_ends_is_no_success(self):
        _, values = self.faired(20, is_fading=True)
        self.assertEqual((values["sharp_edges"], values["converged"]), (1, False))

    def test_it_goes_on_through_a_patch(self):
        vertices, faces, inside = meshes.roof(False)
        ms = mesh_set(vertices, faces, f_scalar_array=inside[faces].any(axis=1).astype(float))
        ms.compute_selection_by_condition_per_face(condselect="fq > 0.5")
        values = ms.apply_filter(ERASE, sharp=20)
        at = ms.current_mesh().vertex_matrix()
        self.assertLess(np.abs(at[:, 2] + np.abs(at[:, 1])).max(), 1e-4)
        self.assertEqual((values["closed"], values["converged"]), (1, True))


class Refused(Case):
    def test_no_selection(self):
        ms, _ = dented_sphere()
        ms.set_selection_none()
        self.refused(ms, FAIR, "No face is selected")
        self.refused(ms, CLOSE, "no face and no vertex is selected", touching_selection=True)

    def test_too_small_a_selection(self):
        ms, _ = dented_sphere()
        ms.set_selection_none()
        ms.compute_selection_by_condition_per_face(condselect="fi == 100")
        self.refused(ms, FAIR, "No vertex is free", "select more faces")

    def test_everything_selected(self):
        ms, _ = dented_sphere()
        ms.set_selection_all()
        self.refused(ms, FAIR, "Nothing is fixed in the component of vertex 0", "leave some of its vertices out of the selection")

    def test_non_manifold(self):
        ms, inside = dented_sphere()
        mesh = ms.current_mesh()
        vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
        edge = next(face for face in faces if inside[face].all())
        fin = [[edge[0], edge[1], len(vertices)]]
        bad = mesh_set(np.vstack([vertices, [[0, 0, 3]]]), np.vstack([faces, fin]))
        bad.compute_selection_by_condition_per_face(condselect="(z0+z1+z2)/3 > 0.4")
        a, b = sorted((int(edge[0]), int(edge[1])))
        self.refused(bad, FAIR, f"Edge ({a}, {b})", "more than two", "repair the mesh there")

    def test_not_a_number(self):
        ms, inside = dented_sphere()
        mesh = ms.current_mesh()
        vertices = mesh.vertex_matrix().copy()
        bad = int(np.flatnonzero(inside)[5])
        vertices[bad, 1] = np.nan
        selected = mesh.face_selection_array().astype(float)
        broken = mesh_set(vertices, mesh.face_matrix(), f_scalar_array=selected)
        broken.compute_selection_by_condition_per_face(condselect="fq > 0.5")
        self.refused(broken, FAIR, f"Vertex {bad} has a coordinate that is not finite")
        self.refused(broken, CURVATURE, f"Vertex {bad} has a coordinate that is not finite")

    def test_far_from_the_region_nan_is_no_matter(self):
        ms, inside = dented_sphere()
        mesh = ms.current_mesh()
        vertices = mesh.vertex_matrix().copy()
        far = int(np.argmin(vertices[:, 2]))
        vertices[far] = np.nan
        broken = mesh_set(vertices, mesh.face_matrix(), f_scalar_array=mesh.face_selection_array().astype(float))
        broken.compute_selection_by_condition_per_face(condselect="fq > 0.5")
        self.assertTrue(broken.apply_filter(FAIR)["converged"])
        after = broken.current_mesh().vertex_matrix()
        self.assertTrue(np.isnan(after[far]).all())
        self.assertLess(np.abs(np.linalg.norm(after[inside], axis=1) - 1).max(), 1e-6)

    def test_no_faces(self):
        cloud = mesh_set(np.random.default_rng(1).random((50, 3)), np.zeros((0, 3)))
        for name in (FAIR, CLOSE, CURVATURE):
            with self.assertRaises(pymeshlab.PyMeshLabException):
                cloud.apply_filter(name)
        self.assertEqual(cloud.current_mesh().vertex_number(), 50)

    def test_no_mesh(self):
        for name in (FAIR, CLOSE, CURVATURE):
            with self.assertRaises(pymeshlab.PyMeshLabException):
                pymeshlab.MeshSet(verbose=False).apply_filter(name)

    def test_parameters(self):
        ms, _ = dented_sphere()
        range_ = "it must be at least 1e-15, the precision of double numbers, and less than 1"
        self.refused(ms, FAIR, f"Option tolerance is 2: {range_}", tolerance=2.0)
        self.refused(ms, FAIR, "Option continuity is", continuity=float("nan"))
        self.refused(ms, FAIR, "max_iterations is -5", max_iterations=-5)
        self.refused(ms, FAIR, "Option target is", target="Bulged", bulge=float("inf"))
        self.refused(ms, FAIR, "its name is not given", boundary_normals="Attribute")
        self.refused(ms, FAIR, "no per-vertex attribute 'there'", boundary_normals="Attribute", normal_attribute="there")
        ms = mesh_set(*meshes.open_sphere(3))
        self.refused(ms, CLOSE, "Option density is", density=1000.0)
        self.refused(ms, CLOSE, "max_edges is 2", "at least 3", max_edges=2)
        self.refused(ms, CLOSE, "max_new_vertices is -1", max_new_vertices=-1)
        ms, _ = dented_sphere()
        for wrong in ({"inner_fairness": "None such"}, {"boundary_normals": 17}, {"tolerance": "small"}, {"no_such": 1}):
            with self.assertRaises(WRONG_PARAMETER):
                ms.apply_filter(FAIR, **wrong)

    @unless_old
    def test_nan_normal(self):
        ms, inside = dented_sphere()
        mesh = ms.current_mesh()
        normals = mesh.vertex_matrix().copy()
        faces = mesh.face_matrix()[mesh.face_selection_array()]
        boundary = int(np.setdiff1d(faces, np.flatnonzero(inside))[0])
        normals[boundary] = np.nan
        mesh.add_vertex_custom_point_attribute(normals, "n")
        words = f"normal given for vertex {boundary}"
        self.refused(ms, FAIR, words, boundary_normals="Attribute", normal_attribute="n")


class Outcomes(Case):
    @unless_old
    def test_normals_that_no_surface_has_end_as_not_converged(self):
        ms, _ = dented_sphere()
        mesh = ms.current_mesh()
        mesh.add_vertex_custom_point_attribute(mesh.vertex_matrix()[:, [1, 2, 0]], "turned")
        values = ms.apply_filter(FAIR, boundary_normals="Attribute", normal_attribute="turned")
        self.assertEqual((values["outcome"], values["converged"]), (5, False))
        self.assertLess(values["reached"], 1)
        self.assertTrue(np.isfinite(ms.current_mesh().vertex_matrix()).all())

    def test_the_nearest_member_is_a_result_with_a_remark(self):
        ms = mesh_set(*meshes.flared_tube())
        ms.compute_selection_by_condition_per_face(condselect="(z0+z1+z2)/3 > 0 && (z0+z1+z2)/3 < 3")
        before = ms.current_mesh().vertex_matrix()
        values = ms.apply_filter(FAIR)
        self.assertEqual((values["outcome"], values["converged"]), (11, False))
        self.assertTrue(0 < values["member_weight"] <= 1)
        self.assertGreater(values["bending_energy"], 0)
        self.assertFalse(np.array_equal(before, ms.current_mesh().vertex_matrix()))

    def test_a_crease_is_no_success(self):
        # The top of a coarse cube cannot meet the normals of its walls.
        ms = mesh_set(*meshes.cube(4))
        ms.compute_selection_by_condition_per_face(condselect="(z0+z1+z2)/3 > 3.9")
        values = ms.apply_filter(FAIR, sharp=0)
        self.assertEqual((values["outcome"], values["converged"]), (8, False))
        self.assertGreater(values["creased_vertices"], 0)
        self.assertGreater(values["boundary_kink"], 45)

    def test_a_surface_that_intersects_is_no_success(self):
        ms, _ = dented_sphere()
        vertices, faces = ms.current_mesh().vertex_matrix(), ms.current_mesh().face_matrix()
        selected = np.append(ms.current_mesh().face_selection_array(), [False] * 4).astype(float)
        needle, sides = meshes.needle(0.95, 1.5)
        both = np.vstack([vertices, needle]), np.vstack([faces, sides + len(vertices)])

        def faired(**parameters):
            ms = mesh_set(*both, f_scalar_array=selected)
            ms.compute_selection_by_condition_per_face(condselect="fq > 0.5")
            return ms.apply_filter(FAIR, **parameters)

        values = faired()
        self.assertEqual((values["outcome"], values["converged"]), (9, False))
        self.assertGreaterEqual(values["intersections"], 3)
        unseen = faired(check_intersections=False)
        self.assertEqual((unseen["outcome"], unseen["converged"], unseen["intersections"]), (0, True, 0))

    def test_iterations_run_out(self):
        ms, _ = dented_sphere()
        values = ms.apply_filter(FAIR, max_iterations=1)
        self.assertEqual(values["outcome"], 6)
        self.assertFalse(values["converged"])
        ms = mesh_set(*meshes.open_sphere(4))
        values = ms.apply_filter(CLOSE, max_iterations=1)
        self.assertEqual((values["converged"], values["not_fair"], values["outcome"]), (False, 1, 6))

    def test_values(self):
        ms, inside = dented_sphere()
        values = ms.apply_filter(FAIR)
        self.assertEqual(values["free_vertices"], inside.sum())
        self.assertLess(values["defect"], 1e-5)
        self.assertLess(values["step"], 1e-8)
        self.assertGreater(values["smallest_angle"], 10)
        self.assertLess(values["seconds_solve"], values["seconds"])
        self.assertEqual(values["components"], 1)


class Loading(Case):
    def test_again(self):
        with self.assertRaises(pymeshlab.PyMeshLabException) as caught:
            pymeshlab.load_plugin(PLUGIN)
        self.assertIn("already loaded", str(caught.exception))
        for name in (FAIR, CLOSE, CURVATURE):
            self.assertTrue(name in pymeshlab.filter_list(), name)

    def test_unloads(self):
        # A copy, because the host keeps its own one.
        copy = pathlib.Path(PLUGIN).with_name("copy.so")
        copy.write_bytes(pathlib.Path(PLUGIN).read_bytes())
        close = ctypes.CDLL(None).dlclose
        close.argtypes = [ctypes.c_void_p]
        for _ in range(3):
            library = ctypes.CDLL(str(copy))
            self.assertIn("copy.so", pathlib.Path("/proc/self/maps").read_text())
            library.qt_plugin_instance()
            close(library._handle)
            self.assertNotIn("copy.so", pathlib.Path("/proc/self/maps").read_text())
        copy.unlink()


if __name__ == "__main__":
    pymeshlab.load_plugin(PLUGIN)
    unittest.main()

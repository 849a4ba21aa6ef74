# SPDX-License-Identifier: MIT OR Apache-2.0
"""The plugin in Debian's meshlabserver (2020.09, float): python test_meshlabserver.py PLUGIN FAIRMESH"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import meshes
import numpy as np
from server import BRIDGE, CLOSE, CURVATURE, ERASE, FAIR, ROUND, SCRIPTS, Server, script

FOLDER = pathlib.Path(tempfile.mkdtemp())
FLOAT = 1.2e-7  # half a unit in the last place of 1, rounded up for sums


def flags(selected):
    """The selection as MeshLab stores it."""
    return {"flags": ("int", np.where(selected, meshes.SELECTED, 0))}


def dented_sphere():
    """A sphere whose cap z > 0.6 is dented and selected: (vertices, faces, selected faces, free vertices)."""
    vertices, faces = meshes.icosphere(4)
    vertices = meshes.jittered(vertices, 0.01, 3)
    selected = vertices[faces].mean(axis=1)[:, 2] > 0.6
    inside = meshes.strictly_inside(len(vertices), faces, selected)
    vertices[inside] *= 0.9
    return vertices, faces, selected, inside


class Case(unittest.TestCase):
    def run_script(self, mesh_in, *filters, save="vq"):
        mesh_out = FOLDER / "out.ply"
        mesh_out.unlink(missing_ok=True)
        code, text = SERVER.run(mesh_in, filters, mesh_out, save)
        return code, text, meshes.read_ply(mesh_out) if mesh_out.exists() else None

    def applied(self, mesh_in, *filters, save="vq"):
        code, text, mesh = self.run_script(mesh_in, *filters, save=save)
        self.assertEqual(code, 0, text)
        return mesh, text

    def refused(self, mesh_in, name, *words, **changed):
        """meshlabserver says why and ends by itself: no abort (134), no crash (139)."""
        code, text, mesh = self.run_script(mesh_in, (name, changed))
        self.assertEqual(code, 255, text)
        self.assertIsNone(mesh)
        for word in words:
            self.assertIn(word, text)
        self.assertIn("Problem with filter: " + name, text)

    def on_sphere(self, mesh, old_faces, text):
        vertices, faces = meshes.points(mesh), mesh["face"]["vertex_indices"].astype(int)
        worst = np.abs(np.linalg.norm(vertices, axis=1) - 1).max()
        ratios = meshes.crease_ratios(vertices, faces, np.arange(len(faces)) >= old_faces)
        print(f"{text}: {len(vertices)} vertices, |r - 1| at most {worst:.1e}, crease {ratios[0]:.4f} / {ratios[1]:.4f} of the sphere's")
        self.assertLess(worst, 1e-5)
        self.assertLess(max(ratios), 1.2)


class Sphere(Case):
    def setUp(self):
        self.vertices, self.faces = meshes.open_sphere()
        self.file = FOLDER / "open.ply"
        meshes.write_ply(self.file, self.vertices, self.faces)

    def test_close_holes_then_fair(self):
        refine = ("Remeshing: Isotropic Explicit Remeshing", {})
        filters = [("Close Holes", {}), refine]
        mesh, _ = self.applied(self.file, *filters)
        self.assertLess(np.linalg.norm(meshes.points(mesh), axis=1).min(), 0.8, "MeshLab's own filling is flat")
        mesh, text = self.applied(self.file, *filters, (FAIR, {}))
        self.assertIn("Fairing converged", text)
        faces = mesh["face"]["vertex_indices"].astype(int)
        heights = meshes.points(mesh)[faces].mean(axis=1)[:, 2]
        old_faces = int((heights < 0.75).sum())
        self.on_sphere(reordered(mesh, heights < 0.75), old_faces, "Close Holes, Isotropic Remeshing, Fairmesh: Fair Selected Region")

    def test_own_filling(self):
        mesh, text = self.applied(self.file, (CLOSE, {}))
        self.assertIn("Holes closed: 1", text)
        old = meshes.points(mesh)[: len(self.vertices)]
        self.assertEqual(np.abs(old - self.vertices.astype(np.float32)).max(), 0)
        self.on_sphere(mesh, len(self.faces), "Fairmesh: Close Holes")


class Scripts(Case):
    """The scripts that come with the plugin list every parameter, or the program would abort."""

    def test_scripts_are_those_that_the_tests_run(self):
        folder = pathlib.Path(__file__).parents[1] / "scripts"
        self.assertEqual({file.stem for file in folder.iterdir()}, set(SCRIPTS))
        for name, filter_name in SCRIPTS.items():
            # Written by: python -c 'import server; ...script((filter, {}))'.
            self.assertEqual((folder / f"{name}.mlx").read_text(), script((filter_name, {})), name)


class Join(Case):
    def whole_sphere(self, mesh):
        vertices, faces = meshes.points(mesh), mesh["face"]["vertex_indices"].astype(int)
        self.assertFalse(meshes.on_boundary(len(vertices), faces).any())
        self.assertEqual(len(vertices) - len(faces) // 2, 2)
        self.assertLess(np.abs(np.linalg.norm(vertices, axis=1) - 1).max(), 1e-6)

    def test_a_sphere_without_a_band(self):
        vertices, faces = meshes.band_missing()
        file = FOLDER / "band.ply"
        meshes.write_ply(file, vertices, faces, face=flags(np.ones(len(faces), bool)))
        for join in (1, 2):
            mesh, text = self.applied(file, (CLOSE, {"join": join}))
            self.assertIn("Loops that share a patch with others: 2", text)
            self.whole_sphere(mesh)

    def test_a_part_that_is_turned_around_is_told_with_both_loops(self):
        vertices, faces = meshes.band_missing()
        below = vertices[faces[:, 0], 2] < 0
        file = FOLDER / "turned.ply"
        meshes.write_ply(file, vertices, np.where(below[:, None], faces[:, ::-1], faces), face=flags(np.ones(len(faces), bool)))
        mesh, text = self.applied(file, (CLOSE, {"join": 2}))
        self.assertEqual(len(mesh["face"]["vertex_indices"]), len(faces))
        self.assertRegex(text, r"Warning, 2 loops of \d+ edges at vertices \d+, \d+: left open")
        self.assertRegex(text, r"the loops at vertices \d+ and \d+: select the faces of one of the two parts")

    def test_a_bridge_and_the_rest(self):
        vertices, faces = meshes.band_missing()
        height = vertices[faces].mean(axis=1)
        near = (height[:, 0] > 0) & (np.abs(height[:, 1]) < 0.25) & (np.abs(height[:, 2]) < 0.45)
        file = FOLDER / "band.ply"
        meshes.write_ply(file, vertices, faces, face=flags(near))
        mesh, text = self.applied(file, (BRIDGE, {"fill_rest": "true"}))
        self.assertRegex(text, r"Bridge from \d+ vertices to \d+, twisted by -?0\.\d degrees: .*holes closed beside it: 1; left open: 0")
        self.whole_sphere(mesh)

    def test_edges_are_rounded(self):
        vertices, faces = meshes.centred_cube(2)
        file = FOLDER / "cube.ply"
        meshes.write_ply(file, vertices, faces)
        mesh, text = self.applied(file, (ROUND, {"width": 0.2}))
        self.assertRegex(text, r"Sharp edges from \d+\.?\d* degrees on: 12 from corner to corner, 12 of them rounded")
        self.assertLess(meshes.off_rounded_cube(meshes.points(mesh), 0.2), 1e-3)
        mesh, text = self.applied(file, ("Select Crease Edges", {}), (ROUND, {"radius": 0.1, "creases": 3}))
        self.assertRegex(text, r"12 from corner to corner, 12 of them rounded")

    def test_rough_rims_are_relaxed(self):
        vertices, faces = meshes.open_sphere(4)
        noise = np.random.default_rng(2).normal(0, 0.015, len(vertices)) * (vertices[:, 2] > 0.55)
        file = FOLDER / "rough.ply"
        meshes.write_ply(file, vertices * (1 + noise)[:, None], faces)
        mesh, text = self.applied(file, (CLOSE, {"relax_rim": 4}))
        self.assertRegex(text, r"Old vertices around the holes that moved: \d+, by 0\.\d+ at most")
        new = np.linalg.norm(meshes.points(mesh)[len(vertices) :], axis=1) - 1
        self.assertLess(np.sqrt((new**2).mean()), 0.01)

    def test_a_dent_is_erased(self):
        vertices, faces, selected, _ = dented_sphere()
        file = FOLDER / "dent.ply"
        meshes.write_ply(file, vertices, faces, face=flags(selected))
        mesh, text = self.applied(file, (ERASE, {}))
        self.assertIn("Faces erased: ", text)
        self.whole_sphere(mesh)


def reordered(mesh, first):
    """The mesh with some faces before the others."""
    order = np.argsort(~first, kind="stable")
    return {**mesh, "face": {name: values[order] for name, values in mesh["face"].items()}}


class CommandLine(Case):
    def test_same_result(self):
        # The paper's own input, and a dented sphere.
        thing, free = FOLDER / "thing.ply", FOLDER / "free.txt"
        subprocess.run([FAIRMESH, "generate", "cylinder-blend", "--vertices", "2000", "-o", thing, "--free", free], check=True)
        mesh = meshes.read_ply(thing)
        vertices, faces = meshes.points(mesh), mesh["face"]["vertex_indices"].astype(int)
        touched = np.isin(faces, np.loadtxt(free, int)).any(axis=1)
        for name, case in (("blend", (vertices, faces, touched)), ("sphere", dented_sphere()[:3])):
            with self.subTest(name):
                self.compare(name, *case)

    def compare(self, name, vertices, faces, selected):
        selected_file, result = FOLDER / "selected.ply", FOLDER / "cli.ply"
        meshes.write_ply(selected_file, vertices, faces, face=flags(selected))
        done = subprocess.run([FAIRMESH, "fair", selected_file, "-o", result, "--selection", "face:flags"], capture_output=True, text=True)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        theirs = meshes.points(meshes.read_ply(result))
        ours = meshes.points(self.applied(selected_file, (FAIR, {}))[0])
        size = np.ptp(vertices, axis=0).max()
        moved = (np.abs(theirs - vertices).max(axis=1) > 1e-6 * size).sum()
        worst = np.abs(ours - theirs).max() / size
        print(f"command line, {name}: {moved} vertices moved, largest difference {worst:.1e} of the size")
        self.assertGreater(moved, 100)
        self.assertLess(worst, 1e-6)


def decorations(vertices, faces):
    """Colours and quality of the vertices, texture coordinates of the wedges."""
    random = np.random.default_rng(5)
    colours = random.integers(20, 255, (len(vertices), 3))
    marks = {name: ("uchar", colours[:, i]) for i, name in enumerate(("red", "green", "blue"))}
    marks["quality"] = ("float", random.random(len(vertices)).astype(np.float32))
    wedges = random.random((len(faces), 6)).astype(np.float32)
    return marks, wedges


class Survives(Case):
    def test_fair(self):
        vertices, faces, selected, inside = dented_sphere()
        marks, wedges = decorations(vertices, faces)
        file = FOLDER / "decorated.ply"
        meshes.write_ply(file, vertices, faces, vertex=marks, face=flags(selected), wedges=wedges)
        mesh, _ = self.applied(file, (FAIR, {}), save="vc vq ff wt")
        for name, (_, values) in marks.items():
            self.assertTrue((mesh["vertex"][name] == values).all(), name)
        self.assertTrue(((mesh["face"]["flags"] & meshes.SELECTED > 0) == selected).all())
        self.assertTrue((mesh["face"]["texcoord"] == wedges).all())
        after = meshes.points(mesh)
        self.assertTrue((after[~inside] == vertices[~inside].astype(np.float32)).all())
        self.assertLess(np.abs(np.linalg.norm(after[inside], axis=1) - 1).max(), 1e-5)

    def test_close(self):
        vertices, faces = meshes.open_sphere(4)
        marks, wedges = decorations(vertices, faces)
        file = FOLDER / "decorated.ply"
        meshes.write_ply(file, vertices, faces, vertex=marks, wedges=wedges)
        mesh, _ = self.applied(file, (CLOSE, {}), save="vc vq ff wt")
        count = len(vertices)
        for name, (_, values) in marks.items():
            self.assertTrue((mesh["vertex"][name][:count] == values).all(), name)
            new = mesh["vertex"][name][count:].astype(float)
            self.assertTrue(new.min() > 0 and new.max() <= values.max() and new.std() > 0.01, name)
        self.assertTrue((mesh["face"]["texcoord"][: len(faces)] == wedges).all())
        new = mesh["face"]["texcoord"][len(faces) :]
        self.assertTrue(new.min() > 0 and new.max() < 1 and new.std() > 0.01)
        selected = mesh["face"]["flags"] & meshes.SELECTED > 0
        self.assertTrue((selected == (np.arange(len(selected)) >= len(faces))).all())


class Options(Case):
    def test_normals_of_the_file(self):
        vertices, faces = meshes.icosphere(4)
        vertices, faces = meshes.without(vertices, faces, vertices[faces].mean(axis=1)[:, 2] < 0.5)
        flat = vertices.copy()
        flat[~meshes.on_boundary(len(vertices), faces), 2] = 0.55
        own = {f"n{'xyz'[axis]}": ("float", 3 * vertices[:, axis]) for axis in range(3)}
        file = FOLDER / "cap.ply"
        meshes.write_ply(file, flat, faces, vertex=own, face=flags(np.ones(len(faces), bool)))
        fitted = meshes.points(self.applied(file, (FAIR, {}))[0])
        given = meshes.points(self.applied(file, (FAIR, {"boundary_normals": 2}))[0])
        self.assertGreater(np.abs(np.linalg.norm(fitted, axis=1) - 1).max(), 0.01)
        self.assertLess(np.abs(np.linalg.norm(given, axis=1) - 1).max(), 1e-5)

    def test_curvature_to_quality(self):
        vertices, faces, selected, inside = dented_sphere()
        file = FOLDER / "dent.ply"
        meshes.write_ply(file, 2 * vertices, faces, face=flags(selected))
        mesh, _ = self.applied(file, (FAIR, {"curvature_to_quality": "true"}))
        self.assertLess(np.abs(mesh["vertex"]["quality"][inside] + 0.5).max(), 1e-4)

    def test_mean_curvature(self):
        vertices, faces = meshes.icosphere(3)
        file = FOLDER / "sphere.ply"
        meshes.write_ply(file, 2 * vertices, faces)
        mesh, text = self.applied(file, (CURVATURE, {}))
        self.assertLess(np.abs(mesh["vertex"]["quality"] + 0.5).max(), 1e-4)
        self.assertIn("Mean curvature -0.5", text)

    def test_deleted_elements(self):
        # meshlabserver does not compact a mesh between filters.
        vertices, faces, _, _ = dented_sphere()
        file = FOLDER / "dent.ply"
        meshes.write_ply(file, vertices, faces)
        select = "Conditional Face Selection"
        drop = [(select, {"condSelect": "z0 &lt; -0.9"}), ("Delete Selected Faces", {})]
        choose = (select, {"condSelect": "(z0+z1+z2)/3 &gt; 0.55"})
        whole = meshes.points(self.applied(file, choose, (FAIR, {}))[0])
        self.assertLess(np.abs(np.linalg.norm(whole, axis=1) - 1).max(), 1e-5)
        less = meshes.points(self.applied(file, *drop, choose, (FAIR, {}))[0])
        both = {tuple(point) for point in whole.tolist()} & {tuple(point) for point in less.tolist()}
        self.assertEqual(len(both), len(less))
        filled = meshes.points(self.applied(file, *drop, choose, (FAIR, {}), (CLOSE, {}))[0])
        self.assertLess(np.abs(np.linalg.norm(filled, axis=1) - 1).max(), 1e-5)

    def test_faces_are_named_by_the_host_numbers(self):
        vertices, faces, selected, inside = dented_sphere()
        turned = next(i for i in range(len(faces) - 1, 0, -1) if inside[faces[i]].all())
        faces = faces.copy()
        faces[turned] = faces[turned][::-1]
        file = FOLDER / "turned.ply"
        meshes.write_ply(file, vertices, faces)
        select = "Conditional Face Selection"
        code, text, _ = self.run_script(
            file,
            (select, {"condSelect": "z0 &lt; -0.5"}),
            ("Delete Selected Faces", {}),
            (select, {"condSelect": "(z0+z1+z2)/3 &gt; 0.5"}),
            (FAIR, {}),
        )
        self.assertEqual(code, 255)
        self.assertRegex(text, rf"[Ff]aces (\d+ and {turned}|{turned} and \d+) run through edge")


class Refused(Case):
    def case(self, vertices, faces, selected):
        file = FOLDER / "bad.ply"
        meshes.write_ply(file, vertices, faces, face=flags(selected))
        return file

    def test_selection(self):
        vertices, faces, selected, _ = dented_sphere()
        none, everything = np.zeros(len(faces), bool), np.ones(len(faces), bool)
        self.refused(self.case(vertices, faces, none), FAIR, "No face is selected")
        one = none.copy()
        one[100] = True
        self.refused(self.case(vertices, faces, one), FAIR, "No vertex is free")
        self.refused(self.case(vertices, faces, everything), FAIR, "Nothing is fixed in the component of vertex 0")

    def test_non_manifold(self):
        vertices, faces, selected, inside = dented_sphere()
        corner = next(face for face in faces if inside[face].all())
        fin = [[corner[0], corner[1], len(vertices)]]
        file = self.case(np.vstack([vertices, [[0, 0, 3]]]), np.vstack([faces, fin]), np.append(selected, True))
        a, b = sorted((int(corner[0]), int(corner[1])))
        self.refused(file, FAIR, f"Edge ({a}, {b}) has more than two")

    def test_not_a_number(self):
        vertices, faces, selected, inside = dented_sphere()
        bad = int(np.flatnonzero(inside)[5])
        vertices[bad, 1] = np.nan
        file = FOLDER / "nan.ply"
        write_binary(file, vertices, faces, selected)
        self.refused(file, FAIR, f"Vertex {bad} has a coordinate that is not finite")
        self.refused(file, CURVATURE, f"Vertex {bad} has a coordinate that is not finite")

    def test_no_faces(self):
        file = FOLDER / "cloud.ply"
        meshes.write_ply(file, np.random.default_rng(1).random((50, 3)), [])
        for name in (FAIR, CLOSE, CURVATURE):
            self.refused(file, name, "The mesh has no faces")

    def test_parameters(self):
        vertices, faces, selected, _ = dented_sphere()
        file = self.case(vertices, faces, selected)
        self.refused(file, FAIR, "Option continuity is", continuity=2)
        self.refused(file, FAIR, "Parameter max_iterations is 0", max_iterations=0)
        self.refused(file, FAIR, "no per-vertex attribute 'there'", boundary_normals=3, normal_attribute="there")
        self.refused(file, CLOSE, "Parameter max_edges is 2", max_edges=2)

    def test_sharp_edges_are_told(self):
        for sharp, is_fading, said in (
            (20, False, r"Sharp edge, vertex \d+ \(90 degrees\), \d+ \(90 degrees\): .*from end to end, along \d+ vertices"),
            (20, True, r"Sharp edge, vertex \d+ \(53.13 degrees\): no other end fits it.*; select so much"),
            (0, False, "Fairing converged"),
        ):
            vertices, faces, inside = meshes.roof(is_fading)
            file = self.case(vertices, faces, inside[faces].any(axis=1))
            _, text = self.applied(file, (FAIR, {"sharp": sharp}))
            self.assertRegex(text, said)
            self.assertEqual("Sharp edge" in text, sharp > 0)

    def test_selected_edges_are_sharp(self):
        vertices, faces, inside = meshes.roof(False)
        file = self.case(vertices * [1, 1, 0.1], faces, inside[faces].any(axis=1))
        for select in ((), (("Select Crease Edges", {"AngleDegNeg": -5, "AngleDegPos": 5}),)):
            mesh, text = self.applied(file, *select, (FAIR, {"sharp": 90}))
            at = meshes.points(mesh)
            self.assertEqual(np.abs(at[:, 2] + 0.1 * np.abs(at[:, 1])).max() < 1e-5, bool(select))
            self.assertEqual("(11.42 degrees)" in text, bool(select), text)

    def test_figures_are_those_of_the_floats_that_are_stored(self):
        vertices, faces, selected, inside = dented_sphere()
        file = self.case(vertices + 2.0**14, faces, selected)
        mesh, text = self.applied(file, (FAIR, {}))
        told = float(re.search(r"Smallest angle ([0-9.]+) degrees", text).group(1))
        moved = inside[faces].any(axis=1)
        self.assertAlmostEqual(told, meshes.smallest_angle(meshes.points(mesh), faces[moved]), delta=0.006)
        # Farther away rounding flips triangles.
        file = self.case(vertices + 2.0**19, faces, selected)
        code, text, _ = self.run_script(file, (FAIR, {}))
        self.assertIn("Warning, poor_when_rounded: ", text)
        self.assertIn("write the mesh in double precision, or move it near to the origin", text)

    def test_warning(self):
        vertices, faces, selected, _ = dented_sphere()
        file = self.case(vertices, faces, selected)
        _, text = self.applied(file, (FAIR, {"max_iterations": 1}))
        self.assertIn("Warning, iteration_limit: the iterations ran out", text)


def write_binary(path, vertices, faces, selected):
    """A PLY that can hold NaN."""
    table = np.zeros(len(faces), [("n", "u1"), ("v", "<i4", 3), ("flags", "<i4")])
    table["n"], table["v"], table["flags"] = 3, faces, np.where(selected, meshes.SELECTED, 0)
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
    header += "property float x\nproperty float y\nproperty float z\n"
    header += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nproperty int flags\nend_header\n"
    path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + table.tobytes())


if __name__ == "__main__":
    FAIRMESH = sys.argv.pop(2)
    SERVER = Server(sys.argv.pop(1))
    unittest.main()

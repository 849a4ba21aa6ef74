"""Meshes of other packages are taken, and given back as what they are, with what belongs to them."""

import copy
import subprocess
import sys

import meshio
import numpy as np
import open3d
import pytest
import pyvista
import trimesh

import fairmesh
from meshes import band_missing, dented_sphere, off_sphere, sphere, sphere_with_hole

VERTICES, FACES, FREE, EXACT = dented_sphere()
WHOLE = fairmesh.fair(VERTICES, FACES, free=FREE)
HOLE = sphere_with_hole()
#: Which hole fills are compared with; new vertices are the last.
FILLED = fairmesh.fill_holes(*HOLE)


def of_trimesh(vertices, faces):
    return trimesh.Trimesh(vertices, faces, process=False)


def of_pyvista(vertices, faces):
    return pyvista.PolyData.from_regular_faces(vertices, faces)


def of_open3d(vertices, faces):
    utility = open3d.utility
    return open3d.geometry.TriangleMesh(utility.Vector3dVector(vertices), utility.Vector3iVector(faces))


def of_tensors(vertices, faces):
    tensor = open3d.core.Tensor
    return open3d.t.geometry.TriangleMesh(tensor(vertices), tensor(np.ascontiguousarray(faces)))


def of_meshio(vertices, faces):
    return meshio.Mesh(vertices, [("triangle", faces)])


def of_arrays(vertices, faces):
    return vertices, faces


KINDS = {made.__name__: made for made in (of_trimesh, of_pyvista, of_open3d, of_tensors, of_meshio, of_arrays)}


def arrays(mesh):
    """Vertices and faces, read without the package."""
    if isinstance(mesh, tuple):
        return mesh
    if isinstance(mesh, trimesh.Trimesh):
        return np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if isinstance(mesh, pyvista.PolyData):
        return np.asarray(mesh.points), mesh.regular_faces
    if isinstance(mesh, meshio.Mesh):
        return mesh.points, mesh.cells_dict["triangle"]
    if isinstance(mesh, open3d.t.geometry.TriangleMesh):
        return mesh.vertex.positions.numpy(), mesh.triangle.indices.numpy()
    return np.asarray(mesh.vertices), np.asarray(mesh.triangles)


@pytest.mark.parametrize("make", KINDS.values(), ids=KINDS)
class TestEveryKind:
    def test_fair(self, make):
        given = make(VERTICES, FACES)
        result = fairmesh.fair(given, FREE)
        assert type(result.mesh) is type(given) and result.mesh is result.mesh
        vertices, faces = arrays(result.mesh)
        assert np.array_equal(vertices, WHOLE.vertices) and np.array_equal(faces, FACES)
        assert np.array_equal(arrays(given)[0], VERTICES), "the mesh given is not written"

    def test_fill(self, make):
        given = make(*HOLE)
        filled = fairmesh.fill_holes(given)
        vertices, faces = arrays(filled.mesh)
        assert type(filled.mesh) is type(given)
        assert np.array_equal(vertices, FILLED.vertices) and np.array_equal(faces, FILLED.faces)
        assert fairmesh.boundary_loops(filled.mesh) == [] and len(fairmesh.boundary_loops(given)) == 1

    def test_join_and_what_is_told_of_a_mesh(self, make):
        given = make(*band_missing())
        assert len(fairmesh.suggest_joins(given)) == 1 and set(fairmesh.components(given)) == {0, 1}
        filled = fairmesh.fill_holes(given, join=[[0, 1]])
        assert off_sphere(arrays(filled.mesh)[0]) < 1e-6
        assert np.array_equal(fairmesh.mean_curvature(given), fairmesh.mean_curvature(*band_missing()), equal_nan=True)
        assert len(fairmesh.self_intersections(filled.mesh)) == 0

    def test_regions(self, make):
        given = make(*band_missing())
        parts = fairmesh.components(given)
        mask = fairmesh.select_halfspace(given, [0, 0, 0], [0, 0, 1])
        assert np.array_equal(mask, fairmesh.select_component(given, [0, 0, 1]))
        assert np.array_equal(~mask, parts != parts[np.argmax(mask)])
        dented = fairmesh.select_ball(given, [0, 0, 1], 0.5)
        assert np.array_equal(fairmesh.shrink(given, fairmesh.grow(given, dented, 2), 2) & dented, dented)
        assert fairmesh.fair(given, free_faces=dented).outcome.is_success
        assert len(fairmesh.erase(given, dented).faces) == (~dented).sum()

    def test_bridge(self, make):
        given = make(*HOLE)
        loop = fairmesh.boundary_loops(given)[0].vertices
        start, end = loop[0:5], loop[len(loop) // 2 : len(loop) // 2 + 5]
        made = fairmesh.bridge(given, start, end, fill=True)
        assert type(made.mesh) is type(given)
        assert np.array_equal(arrays(made.mesh)[0], fairmesh.bridge(*HOLE, start, end, fill=True).vertices)

    def test_erase_and_fill(self, make):
        vertices, faces = sphere(4)
        given = make(vertices, faces)
        left = fairmesh.erase(given, (vertices[faces, 2] > 0.9).all(axis=1))
        assert type(left.mesh) is type(given) and len(arrays(left.mesh)[1]) == len(left.faces)
        filled = fairmesh.fill_holes(left.mesh, loops=left.loops)
        at = arrays(filled.mesh)[0]
        assert off_sphere(at[np.unique(arrays(filled.mesh)[1])]) < 1e-6

    def test_remesh_and_fair(self, make):
        given = make(VERTICES, FACES)
        new = fairmesh.remesh(given, FREE, density=2.0)
        assert type(new.mesh) is type(given) and len(arrays(new.mesh)[0]) == len(new.vertices)
        result = fairmesh.fair(new.mesh, new.free_vertices)
        assert result.outcome.is_success and off_sphere(arrays(result.mesh)[0]) < 1e-6

    def test_in_steps(self, make):
        given = make(VERTICES, FACES)
        with fairmesh.Solver(given, FREE) as solver:
            solver.run()
            assert type(solver.mesh) is type(given)
            assert np.array_equal(arrays(solver.result().mesh)[0], WHOLE.vertices)

    def test_by_keyword(self, make):
        assert np.array_equal(fairmesh.fair(mesh=make(VERTICES, FACES), free=FREE).vertices, WHOLE.vertices)
        with pytest.raises(TypeError, match="has faces of its own: give no faces"):
            fairmesh.fair(make(VERTICES, FACES), faces=FACES)


def test_trimesh_keeps_what_belongs_to_the_mesh():
    mesh = of_trimesh(*HOLE)
    height = HOLE[0][:, 2]
    mesh.metadata["scanner"] = "third"
    mesh.vertex_attributes["height"] = height
    mesh.vertex_attributes["label"] = np.where(height > 0, "up", "down")
    mesh.face_attributes["octant"] = (HOLE[0][HOLE[1]].mean(axis=1) > 0) @ [1, 2, 4]
    mesh.visual.vertex_colors = np.stack([*(np.rint(127.5 + 127 * HOLE[0])).T, 0 * height + 200], -1).astype(np.uint8)
    filled = fairmesh.fill_holes(mesh)
    made, new = filled.mesh, filled.new_vertices
    assert made.metadata["scanner"] == "third" and made.metadata is not mesh.metadata
    assert np.array_equal(made.vertex_attributes["height"][: new.start], height)
    # Of the loop's vertices, at z near .8; the patch bulges beyond them.
    assert np.ptp(made.vertex_attributes["height"][new]) < 0.1
    assert set(made.vertex_attributes["label"][new]) == {"up"}
    assert set(made.face_attributes["octant"][filled.new_faces]) == {4, 5, 6, 7}
    middle = made.triangles_center[filled.new_faces]
    agree = (made.face_attributes["octant"][filled.new_faces] == (middle > 0) @ [1, 2, 4]).mean()
    assert agree > 0.8
    colours = np.asarray(made.visual.vertex_colors)
    assert np.array_equal(colours[: new.start], mesh.visual.vertex_colors) and set(colours[new, 3]) == {200}
    assert np.abs(colours[new, :2] - (127.5 + 127 * filled.vertices[new, :2])).max() < 10
    # trimesh makes the normals anew.
    assert np.abs(made.vertex_normals - made.vertices).max() < 0.02


def test_trimesh_keeps_textures():
    vertices, faces = HOLE
    uv = vertices[:, :2] / 2 + 0.5
    material = trimesh.visual.material.SimpleMaterial(name="skin")
    visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    mesh = trimesh.Trimesh(vertices, faces, process=False, visual=visual)
    faired = fairmesh.fair(mesh, vertices[:, 2] < -0.8).mesh
    assert np.array_equal(faired.visual.uv, uv) and faired.visual.material.name == "skin"
    filled = fairmesh.fill_holes(mesh)
    assert filled.mesh.visual.material.name == "skin"
    assert np.array_equal(filled.mesh.visual.uv[: len(uv)], uv)
    expected = filled.vertices[filled.new_vertices, :2] / 2 + 0.5
    assert np.abs(filled.mesh.visual.uv[filled.new_vertices] - expected).max() < 0.05


def test_a_trimesh_primitive_and_a_subclass():
    class Bone(trimesh.Trimesh):
        pass

    ball = trimesh.primitives.Sphere(subdivisions=3)
    result = fairmesh.fair(ball, ball.vertices[:, 2] > 0.7)
    assert type(result.mesh) is trimesh.Trimesh and off_sphere(result.vertices) < 1e-4
    # As of any copy that trimesh makes.
    bone = Bone(VERTICES, FACES, process=False)
    assert type(fairmesh.fair(bone, FREE).mesh) is type(bone.copy())


def test_pyvista_keeps_data_and_makes_normals_anew():
    mesh = of_pyvista(VERTICES, FACES).compute_normals(split_vertices=False)
    mesh["height"] = VERTICES[:, 2]
    mesh.cell_data["number"] = np.arange(len(FACES))
    mesh.field_data["scanner"] = ["third"]
    mesh["selected"] = FREE
    mesh.set_active_scalars("height")
    stale = np.abs(mesh.point_data["Normals"] - EXACT)[FREE].max()
    made = fairmesh.fair(mesh, "selected").mesh
    assert np.array_equal(made["height"], VERTICES[:, 2]) and made.active_scalars_name == "height"
    assert np.array_equal(made.cell_data["number"], np.arange(len(FACES))) and made.field_data["scanner"] == "third"
    assert np.abs(made.point_data["Normals"] - EXACT)[FREE].max() < 0.02 < stale
    away = WHOLE.boundary_vertices
    fixed = np.setdiff1d(np.flatnonzero(~FREE), away)
    assert np.array_equal(made.point_data["Normals"][fixed], mesh.point_data["Normals"][fixed])
    assert "Normals" not in made.cell_data, "normals of faces that are no more"


def test_pyvista_fills_with_data():
    mesh = of_pyvista(HOLE[0].astype(np.float32), HOLE[1]).compute_normals(split_vertices=False, cell_normals=False)
    mesh["uv"] = HOLE[0][:, :2]
    mesh.point_data.active_texture_coordinates_name = "uv"
    mesh.cell_data["part"] = (np.arange(len(HOLE[1])) % 3).astype(np.uint8)
    filled = fairmesh.fill_holes(mesh)
    made = filled.mesh
    assert made.points.dtype == filled.vertices.dtype == np.float32
    assert made.active_texture_coordinates.shape == (made.n_points, 2)
    assert set(made.cell_data["part"][filled.new_faces]) <= {0, 1, 2} and made.n_cells == len(filled.faces)
    assert np.abs(made.point_data["Normals"] - made.points).max() < 0.02


def test_open3d_keeps_colours_textures_and_normals():
    mesh = of_open3d(*HOLE)
    mesh.vertex_colors = open3d.utility.Vector3dVector(HOLE[0] / 2 + 0.5)
    mesh.compute_vertex_normals()
    corners = HOLE[0][HOLE[1]][:, :, :2].reshape(-1, 2)
    mesh.triangle_uvs = open3d.utility.Vector2dVector(corners)
    mesh.triangle_material_ids = open3d.utility.IntVector(np.full(len(HOLE[1]), 3, np.int32))
    filled = fairmesh.fill_holes(mesh)
    made, new = filled.mesh, filled.new_vertices
    assert np.abs(np.asarray(made.vertex_colors)[new, :2] - filled.vertices[new, :2] / 2 - 0.5).max() < 0.03
    assert np.abs(np.asarray(made.vertex_normals) - filled.vertices).max() < 0.02
    assert len(made.triangle_normals) == len(filled.faces)
    uvs = np.asarray(made.triangle_uvs).reshape(-1, 3, 2)
    assert np.array_equal(uvs[: len(HOLE[1])].reshape(-1, 2), corners)
    assert np.abs(uvs - filled.vertices[filled.faces][:, :, :2]).max() < 0.1
    assert set(np.asarray(made.triangle_material_ids)) == {3}


def test_open3d_tensors_keep_attributes():
    mesh = of_tensors(HOLE[0].astype(np.float32), HOLE[1].astype(np.int32))
    mesh.compute_vertex_normals()
    mesh.vertex["quality"] = open3d.core.Tensor(HOLE[0][:, :1].astype(np.float32))
    mesh.triangle["part"] = open3d.core.Tensor(np.full((len(HOLE[1]), 1), 7, np.int32))
    filled = fairmesh.fill_holes(mesh)
    made = filled.mesh
    assert made.vertex.positions.numpy().dtype == np.float32 and made.triangle.indices.numpy().dtype == np.int32
    assert made.vertex["quality"].numpy().shape == (len(filled.vertices), 1)
    assert set(made.triangle["part"].numpy().ravel()) == {7} and len(made.triangle["part"]) == len(filled.faces)
    assert np.abs(made.vertex.normals.numpy() - filled.vertices).max() < 0.02
    facing = made.triangle.normals.numpy()
    assert np.abs(np.linalg.norm(facing, axis=1) - 1).max() < 1e-5 and len(facing) == len(filled.faces)


def test_meshio_keeps_blocks_sets_and_data():
    half = len(HOLE[1]) // 2
    rim = fairmesh.boundary_loops(*HOLE)[0].vertices
    lines = np.stack([rim, np.roll(rim, -1)], -1)
    mesh = meshio.Mesh(
        HOLE[0],
        [("triangle", HOLE[1][:half]), ("line", lines), ("triangle", HOLE[1][half:])],
        point_data={"height": HOLE[0][:, 2], "Normals": HOLE[0]},
        cell_data={"part": [np.zeros(half, int), np.ones(len(lines), int), np.full(len(HOLE[1]) - half, 2)]},
        cell_sets={"few": [np.array([1, 2]), None, np.array([0, 5])]},
        point_sets={"rim": rim},
        field_data={"skin": np.array([1, 2])},
    )
    filled = fairmesh.fill_holes(mesh)
    made = filled.mesh
    assert [block.type for block in made.cells] == ["triangle", "line", "triangle"]
    assert np.array_equal(made.cells[0].data, HOLE[1][:half]) and np.array_equal(made.cells[1].data, lines)
    assert np.array_equal(made.cells[2].data, filled.faces[half:])
    assert [len(part) for part in made.cell_data["part"]] == [len(block) for block in made.cells]
    assert len(made.point_data["height"]) == len(filled.vertices)
    assert np.abs(made.point_data["Normals"] - made.points).max() < 0.02
    assert [None if of is None else of.tolist() for of in made.cell_sets["few"]] == [[1, 2], None, [0, 5]]
    assert np.array_equal(made.point_sets["rim"], rim) and made.field_data["skin"].tolist() == [1, 2]
    away = fairmesh.erase(mesh, [1, half + 5])
    assert [None if of is None else of.tolist() for of in away.mesh.cell_sets["few"]] == [[1], None, [0]]
    gone = np.setdiff1d(np.arange(len(VERTICES)), fairmesh.remesh(VERTICES, FACES, FREE, density=0.5).kept_vertices)
    line = meshio.Mesh(VERTICES, [("triangle", FACES), ("line", [[0, gone[0]]])])
    with pytest.raises(ValueError, match="cells of type 'line' at vertices that are replaced"):
        _ = fairmesh.remesh(line, FREE, density=0.5).mesh
    with pytest.raises(ValueError, match="cells of type 'quad': all faces have to be triangles"):
        fairmesh.fair(meshio.Mesh(VERTICES, [("quad", [[0, 1, 2, 3]])]))


def test_masks_by_name():
    mesh = of_trimesh(VERTICES, FACES)
    mesh.vertex_attributes["chosen"] = FREE.astype(np.float32)
    inner = FREE[FACES].any(axis=1)
    mesh.face_attributes["inner"] = inner.astype(np.uint8)
    for result in (fairmesh.fair(mesh, "chosen"), fairmesh.fair(mesh, free_faces="inner")):
        assert np.array_equal(result.vertices, WHOLE.vertices)
    assert np.array_equal(fairmesh.erase(mesh, "inner").kept_faces, np.flatnonzero(~inner))
    mesh.vertex_attributes["height"] = VERTICES[:, 2]
    for name, message in (
        ("inner", "free: the vertex_attributes of the mesh have no 'inner'"),
        ("height", "free: 'height' of the mesh is no mask: it has values that are neither 0 nor 1"),
    ):
        with pytest.raises(ValueError) as error:
            fairmesh.fair(mesh, name)
        assert str(error.value) == message
    with pytest.raises(ValueError, match="free_faces: arrays have no names such as 'inner'"):
        fairmesh.fair(VERTICES, FACES, free_faces="inner")
    lines = of_pyvista(VERTICES, FACES)
    lines.lines = [2, 0, 1]
    lines.cell_data["inner"] = np.concatenate([[0], inner])
    assert np.array_equal(fairmesh.fair(lines, free_faces="inner").mesh.points, WHOLE.vertices)
    with pytest.raises(ValueError, match="has vertices or lines beside its faces"):
        _ = fairmesh.fill_holes(lines).mesh


def test_what_is_no_mesh_of_triangles_is_told_what_to_do():
    quads, several = pyvista.Cube(), trimesh.Scene([trimesh.creation.box()])
    for mesh, message in (
        (quads, "the PolyData has faces that are no triangles: give mesh.triangulate()"),
        (pyvista.ImageData(), "an ImageData is no surface of triangles: give mesh.extract_surface().triangulate()"),
        (several, "a Scene has meshes inside: give scene.to_mesh(), or one of scene.geometry.values()"),
        (trimesh.PointCloud(VERTICES), "a PointCloud has no faces"),
        (open3d.geometry.PointCloud(), "a PointCloud has no faces"),
    ):
        with pytest.raises((TypeError, ValueError)) as error:
            fairmesh.boundary_loops(mesh)
        assert str(error.value) == message
    assert fairmesh.boundary_loops(quads.triangulate()) == []
    assert fairmesh.boundary_loops(several.to_mesh()) == []
    with pytest.raises(TypeError, match="not the name of a file: read it first"):
        fairmesh.fair("scan.ply")


def test_a_mesh_that_was_changed_meanwhile_is_told():
    mesh = of_trimesh(VERTICES, FACES)
    result = fairmesh.fair(mesh, FREE)
    mesh.faces = FACES[:-1]
    with pytest.raises(ValueError, match="has other vertices or faces now"):
        _ = result.mesh
    # Other positions, for example the new ones, are no matter.
    points = of_pyvista(VERTICES, FACES).compute_normals(split_vertices=False)
    result = fairmesh.fair(points, FREE)
    points.points[:] = result.vertices
    assert np.abs(result.mesh.point_data["Normals"] - EXACT)[FREE].max() < 0.02


@pytest.fixture
def unwelded(tmp_path):
    """An STL as trimesh reads it with process=False: each triangle has vertices of its own."""
    of_trimesh(VERTICES, FACES).export(tmp_path / "part.stl")
    mesh = trimesh.load_mesh(tmp_path / "part.stl", process=False)
    assert len(mesh.vertices) == 3 * len(FACES)
    return mesh


def test_unwelded_triangles_are_welded_for_the_solve_and_written_back(unwelded):
    assert len(fairmesh.boundary_loops(unwelded)) == 1
    inner = FREE[FACES].any(axis=1)
    made = fairmesh.fair(unwelded, free_faces=inner).mesh
    assert np.array_equal(made.faces, unwelded.faces) and len(made.vertices) == 3 * len(FACES)
    assert np.abs(made.vertices - WHOLE.vertices[FACES].reshape(-1, 3)).max() < 1e-6
    made.merge_vertices()
    assert len(made.vertices) == len(VERTICES), "copies of a vertex have stayed together, to the last bit"


def test_a_hole_in_unwelded_triangles_is_filled():
    corners = HOLE[0][HOLE[1]].reshape(-1, 3)
    mesh = of_trimesh(corners, np.arange(len(corners)).reshape(-1, 3))
    mesh.vertex_attributes["height"] = corners[:, 2]
    filled = fairmesh.fill_holes(mesh)
    assert filled.outcomes == ["faired"] and off_sphere(filled.vertices) < 1e-6
    assert np.ptp(filled.mesh.vertex_attributes["height"][filled.new_vertices]) < 0.1
    whole = filled.mesh
    whole.merge_vertices()
    assert whole.is_watertight and not mesh.is_watertight


def test_nearly_equal_copies_need_a_distance(unwelded):
    inner = FREE[FACES].any(axis=1)
    shaken = unwelded.copy()
    shaken.vertices = unwelded.vertices + np.random.RandomState(1).uniform(-1e-7, 1e-7, unwelded.vertices.shape)
    with pytest.raises(fairmesh.InputError) as error:
        fairmesh.fair(shaken, free_faces=inner)
    assert "coincident" in error.value.remedy + str(error.value)
    made = fairmesh.fair(shaken, free_faces=inner, coincident=1e-6).mesh
    assert np.abs(made.vertices - WHOLE.vertices[FACES].reshape(-1, 3)).max() < 1e-5


def test_a_seam_whose_copies_nearly_meet_is_no_silent_boundary():
    """Faces were selected: the vertices along the seam are on the boundary of the mesh, and would stay in the dent."""
    vertices, faces, seam = seamed(1e-8)
    with pytest.warns(
        fairmesh.SeamWarning, match="apart and are not one: as a boundary of the mesh they stayed"
    ) as told:
        fairmesh.fair(vertices, faces, free_faces=FREE[FACES].any(axis=1))
    assert len(told) == 1 and told[0].filename == __file__
    advice = float(str(told[0].message).split("coincident=")[1].split()[0])
    made = fairmesh.fair(vertices, faces, free_faces=FREE[FACES].any(axis=1), coincident=advice)
    assert np.abs(made.vertices[:441] - WHOLE.vertices).max() < 1e-6
    assert np.abs(made.vertices[441:] - WHOLE.vertices[seam]).max() < 1e-6


def seamed(apart):
    """The dented sphere with the vertices of its middle column there twice, so far apart; and which these are."""
    seam = np.flatnonzero(np.arange(441) % 21 == 10)
    copies = np.arange(441)
    copies[seam] = 441 + np.arange(len(seam))
    beyond = (FACES % 21).sum(axis=1) > 30
    faces = np.where(beyond[:, None], copies[FACES], FACES)
    return np.concatenate([VERTICES, VERTICES[seam] + apart]), faces, seam


def test_a_seam_of_a_textured_mesh_is_kept():
    """Vertices along the seam are there twice, with texture coordinates of their own."""
    vertices, faces, seam = seamed(0.0)
    uv = np.concatenate([VERTICES[:, :2], VERTICES[seam, :2] + 5])
    visual = trimesh.visual.TextureVisuals(uv=uv)
    mesh = trimesh.Trimesh(vertices, faces, process=False, visual=visual)
    made = fairmesh.fair(mesh, free_faces=FREE[FACES].any(axis=1)).mesh
    assert np.array_equal(made.vertices[:441], WHOLE.vertices) and np.array_equal(made.visual.uv, uv)
    assert np.array_equal(made.vertices[441:], WHOLE.vertices[seam])


def test_no_package_is_imported_that_the_program_has_not_imported():
    program = (
        "import sys, fairmesh; from meshes import dented_sphere as d; v, f, free, _ = d(); fairmesh.fair(v, f, free);"
        "print([name for name in ('trimesh', 'pyvista', 'open3d', 'meshio', 'vtkmodules') if name in sys.modules])"
    )
    folder = copy.copy(__file__).rsplit("test_hosts.py")[0]
    command = [sys.executable, "-c", f"import sys; sys.path.insert(0, {folder!r}); {program}"]
    assert subprocess.run(command, check=True, capture_output=True, text=True).stdout == "[]\n"

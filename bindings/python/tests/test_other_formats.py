"""Files that the command line does not read: the two lines of Python that it tells do make a PLY file of them."""

import os
import re
import subprocess
import sys

import pytest

PROGRAM = os.environ["FAIRMESH_TEST_PROGRAM"]


def written_by_trimesh(path):
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.icosphere(subdivisions=2)
    mesh.update_faces(mesh.triangles_center[:, 2] < 0.8)
    mesh.export(path)


def written_by_pyvista(path):
    pyvista = pytest.importorskip("pyvista")
    sphere = pyvista.Icosphere(nsub=2)
    sphere.extract_cells(sphere.cell_centers().points[:, 2] < 0.4).extract_surface(algorithm="dataset_surface").save(
        path
    )


@pytest.mark.parametrize(
    ("name", "written"),
    [("scan.glb", written_by_trimesh), ("scan.vtp", written_by_pyvista), ("scan.vtk", written_by_pyvista)],
)
def test_the_lines_make_a_mesh_of_it(tmp_path, name, written):
    written(tmp_path / name)

    def holes(of):
        return subprocess.run([PROGRAM, "holes", of], cwd=tmp_path, capture_output=True, text=True, check=False)

    refused = holes(name)
    assert refused.returncode == 2
    lines = re.search(r"import (\w+); \1\..*", refused.stderr).group()
    subprocess.run([sys.executable, "-W", "ignore", "-c", lines], cwd=tmp_path, check=True)
    read = holes("scan.ply")
    assert read.returncode == 0 and read.stdout.count(" hole") == 1, read.stdout + read.stderr

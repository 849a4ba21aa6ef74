"""The programs in README.md and examples run, and say what they are said to say."""

import re
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
import pyvista
import trimesh

import fairmesh
from meshes import band_missing, cube, dented_sphere, sphere_with_hole

PROJECT = Path(__file__).resolve().parents[1]
README = (PROJECT / "README.md").read_text()
PROGRAMS = re.findall(r"^```python\n(.*?)^```", README, re.M | re.S)


def test_all_programs_were_found():
    assert len(PROGRAMS) == README.count("```python") == 15


@pytest.mark.parametrize("number", range(15))
def test_programs(number, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    sphere = dented_sphere()
    text = PROGRAMS[number]
    shown, results = [], []
    mesh = (sphere.vertices, sphere.faces)
    if "suggest_joins" in text:
        mesh = band_missing()
    elif "round_edges" in text:
        mesh = cube(2)[:2]
    elif "fill_holes" in text and "hole_size" not in text:
        mesh = sphere_with_hole()
    whole = trimesh.Trimesh(sphere.vertices, sphere.faces, process=False)
    names = {
        "np": np,
        "trimesh": trimesh,
        "mesh": whole,
        "surface": pyvista.PolyData.from_regular_faces(*sphere_with_hole()),
        "V": sphere.vertices,
        "F": sphere.faces,
        "fairmesh": fairmesh,
        "threading": threading,
        "vertices": mesh[0],
        "faces": mesh[1],
        "selected": (np.linalg.norm(mesh[0][mesh[1]] - [0, 0, 1], axis=2) < 0.3).all(axis=1),
        "mask": np.arange(441) == 3 if "InputError" in text else sphere.free,
        "colours_given": np.ones((len(mesh[0]), 4)),
        "show": lambda *arrays: shown.append(arrays),
        "results": results,
    }
    exec(compile(text, f"README.md, program {number}", "exec"), names)
    if "thread" in names:
        names["thread"].join()
        assert results[0].outcome in ("cancelled", "converged")
    said = capsys.readouterr().out
    if "icosphere" in text:
        assert said.startswith("converged ")
        assert np.abs(np.linalg.norm(names["mesh"].vertices, axis=1) - 1).max() < 1e-6
    if "suggest_joins" in text:
        assert said.startswith("[0 1] ") and names["filled"].outcomes == ["faired"]
        assert np.unique(names["part"]).tolist() == [0, 1]
    elif "fill_holes" in text and "hole_size" not in text:
        assert said.startswith("0 ") and "faired none" in said and "hole" in said
        assert np.allclose(names["colours"], 1) and len(names["colours"]) == names["filled"].new_vertex_count
    if "round_edges" in text:
        assert said.count("90.0 True 1.0") == 12 and len(names["faces"]) > 1000
    if "InputError" in text:
        assert said.splitlines()[0].startswith("free vertex 3 lies on the boundary of the mesh; ")
        assert said.splitlines()[1].endswith("3 None None")
    if "igl.harmonic" in text:
        assert np.array_equal(names["U"], fairmesh.fair(*sphere[:3]).vertices)
    if "filter_laplacian" in text or text.startswith("result = fairmesh.fair(mesh, mask)"):
        made = names["mesh"] if "filter" in text else names["result"].mesh
        assert isinstance(made, trimesh.Trimesh)
        assert "filter" in text or np.abs(np.linalg.norm(made.vertices, axis=1) - 1).max() < 1e-6
    if "hole_size" in text:
        assert isinstance(names["closed"], pyvista.PolyData) and names["closed"].n_open_edges == 0
    if "Solver" in text:
        assert len(shown) > 3 and names["result"].outcome.is_success


def test_the_program_in_the_top_readme(monkeypatch, capsys):
    monkeypatch.chdir(PROJECT.parents[1])
    section = Path("README.md").read_text().split("## From Python\n")[1]
    (program,) = re.findall(r"^```python\n(.*?)^```", section.split("\n## ")[0], re.M | re.S)
    names = {}
    exec(compile(program, "README.md", "exec"), names)
    assert capsys.readouterr().out.startswith("converged (-1.0000")
    assert np.abs(np.linalg.norm(names["mesh"].vertices, axis=1) - 1).max() < 1e-8


def test_every_public_name_is_described():
    for name in fairmesh.__all__:
        assert getattr(fairmesh, name).__doc__, name
        assert re.search(rf"\b{name}\b", README), name


def test_the_example(tmp_path):
    picture = tmp_path / "picture.png"
    command = [sys.executable, PROJECT / "examples" / "dented_sphere.py", picture]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert re.fullmatch(r"converged faired\nlargest distance to the sphere: \d\.\de-\d\d\n", said)
    assert float(said.split()[-1]) < 1e-9
    assert picture.read_bytes()[:4] == b"\x89PNG" and picture.stat().st_size > 50_000

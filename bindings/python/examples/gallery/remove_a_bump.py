# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # Remove a bump from an STL
#
# An STL names no vertices: `trimesh` with `process=False` gives each triangle three of its own. That is no obstacle:
# vertices at the same place are joined while the surface is computed, and every triangle gets its corners back.

# %%
import tempfile
from pathlib import Path

import numpy as np
import pyvista as pv
import trimesh
from pictures import picture, stripes
from pymeshfix import examples

import fairmesh

scan = pv.PolyData(examples.bunny_scan)
scan = fairmesh.erase(scan, fairmesh.components(scan) != 0).mesh  # without loose triangles
before = trimesh.Trimesh(scan.points, scan.regular_faces, process=False)

# %% [markdown]
# The damage: a weld bead of 1.5 with noise, on the back of the bunny (which is 50 high), written as STL.

# %%
place = before.vertices[np.linalg.norm(before.vertices - [8.8, -3.4, 31.4], axis=1).argmin()]
away = np.linalg.norm(before.vertices - place, axis=1)
height = np.where(away < 5, 1.5 * np.cos(np.pi * away / 10) ** 2, 0) * np.random.RandomState(1).uniform(
    0.7, 1, len(away)
)
damaged = before.copy()
damaged.vertices = before.vertices + height[:, None] * before.vertex_normals
with tempfile.TemporaryDirectory() as folder:
    damaged.export(Path(folder, "bunny.stl"))
    stl = trimesh.load_mesh(Path(folder, "bunny.stl"), process=False)
print(len(stl.faces), "triangles,", len(stl.vertices), "vertices")
assert len(stl.vertices) == 3 * len(stl.faces)

# %% [markdown]
# Everything within 6 of the place may move.

# %%
ball = np.linalg.norm(stl.vertices - place, axis=1) < 6
result = fairmesh.fair(stl, ball)
print(result)
mended = result.mesh
assert isinstance(mended, trimesh.Trimesh) and np.array_equal(mended.faces, stl.faces)
assert result.outcome.is_success

# %% [markdown]
# How far is that from the surface that was there before? The scan's own waves under the bead are lost, of course; the
# bead is gone.

# %%
original = np.asarray(before.vertices)[before.faces].reshape(-1, 3)
bead = np.linalg.norm(stl.vertices - original, axis=1).max()
left = np.abs(((mended.vertices - original) * before.vertex_normals[before.faces].reshape(-1, 3)).sum(axis=1)).max()
print(f"the bead stood out by {bead:.2f}; now the surface is within {left:.2f} of the one before")
assert bead > 1.2 and left < 0.25 * bead
assert np.array_equal(mended.vertices[~ball], stl.vertices[~ball])

# %% [markdown]
# Stripes by the direction of the normals are as smooth in the region as around it.


# %%
def shown(mesh: trimesh.Trimesh) -> pv.PolyData:
    welded = pv.wrap(mesh).clean(tolerance=0)
    welded["stripes"] = stripes(welded)
    return welded


how = {"scalars": "stripes", "cmap": "gray"}
side = [place + np.array([35, -25, 25]), place, (0, 0, 1)]
picture("remove_a_bump", ("Damaged", shown(stl), how), ("Faired", shown(mended), how), view=side, zoom=1.3)

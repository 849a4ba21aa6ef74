# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # Erase a damaged part and fill it, with colours
#
# What is worse than noise, torn or folded over, is better deleted than faired. `erase` deletes faces and what would
# hang loose then, `fill_holes` makes a new patch, and the new vertices get colours from those around. The mesh is one
# of Open3D.

# %%
import numpy as np
import open3d as o3d
import pyvista as pv
from pictures import picture
from pymeshfix import examples

import fairmesh

scan = pv.PolyData(examples.bunny_scan)
scan = fairmesh.erase(scan, fairmesh.components(scan) != 0).mesh
mesh = o3d.geometry.TriangleMesh(
    o3d.utility.Vector3dVector(scan.points), o3d.utility.Vector3iVector(scan.regular_faces)
)
mesh.compute_vertex_normals()

# %% [markdown]
# Colours by height, as a scanner would have measured them, and a crumpled place with black dirt.

# %%
points = np.array(mesh.vertices)
height = (points[:, 2] - points[:, 2].min()) / np.ptp(points[:, 2])
colours = np.stack([0.9 - 0.5 * height, 0.6 + 0.2 * height, 0.4 + 0.5 * height], axis=1)
place = points[np.linalg.norm(points - [0, -19, 20], axis=1).argmin()]
dirty = np.linalg.norm(points - place, axis=1) < 4
points[dirty] += np.random.RandomState(2).normal(0, 0.6, (dirty.sum(), 3))
colours[dirty] = 0
mesh.vertices = o3d.utility.Vector3dVector(points)
mesh.vertex_colors = o3d.utility.Vector3dVector(colours)

# %%
faces = np.asarray(mesh.triangles)
left = fairmesh.erase(mesh, dirty[faces].any(axis=1))
filled = fairmesh.fill_holes(left.mesh, loops=left.loops)
whole = filled.mesh
print(left.loops, filled.loops[0], filled.loops[0].report)

# %% [markdown]
# The patch is fair, nothing black is left in it, and its colours run on from those around.

# %%
assert isinstance(whole, o3d.geometry.TriangleMesh)
assert [loop.report.outcome.is_success for loop in filled.loops if loop.report] == [True]
new = filled.new_vertices
made = np.asarray(whole.vertex_colors)[new]
tone = (filled.vertices[new, 2] - points[:, 2].min()) / np.ptp(points[:, 2])
print(f"blue is {np.abs(made[:, 2] - (0.4 + 0.5 * tone)).max():.3f} off at most")
assert made.min() > 0.3 and np.abs(made[:, 2] - (0.4 + 0.5 * tone)).max() < 0.02
# Vertices of the erased faces stay in the list, without faces; Open3D drops them.
whole.remove_unreferenced_vertices()
assert len(whole.vertices) < len(filled.vertices)


# %%
def shown(mesh: o3d.geometry.TriangleMesh) -> pv.PolyData:
    made = pv.PolyData.from_regular_faces(np.asarray(mesh.vertices), np.asarray(mesh.triangles))
    made["rgb"] = np.asarray(mesh.vertex_colors)
    return made


side = [(place[0] + 5, place[1] - 45, place[2] + 10), tuple(place), (0, 0, 1)]
how = {"scalars": "rgb", "rgb": True}
shots = [(title, shown(each), how) for title, each in (("Damaged", mesh), ("Erased", left.mesh), ("Filled", whole))]
picture("erase_and_fill", *shots, view=side, zoom=1.3)

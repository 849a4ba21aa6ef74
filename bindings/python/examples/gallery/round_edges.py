# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # Round the edges of a boolean
#
# `manifold3d` unites solids exactly: what comes out has long thin triangles, and sharp edges where the parts meet.

# %%
import manifold3d
import numpy as np
import pyvista as pv
from pictures import picture

import fairmesh

plate = manifold3d.Manifold.cube([4, 4, 0.8], center=True)
boss = manifold3d.Manifold.cylinder(1.6, 1.0, circular_segments=64)
bore = manifold3d.Manifold.cylinder(4, 0.5, circular_segments=64, center=True)
part = (plate + boss) - bore
sharp = part.to_mesh()
vertices, faces = np.asarray(sharp.vert_properties, float)[:, :3], np.asarray(sharp.tri_verts)
print(len(faces), "triangles, volume", round(part.volume(), 3))

# %% [markdown]
# All sharp edges at once: the plate's, those of the boss and the bore, and the groove around the boss. A width of 0.15
# on both sides of each; between planes that is a radius of 0.15.

# %%
rounded = fairmesh.round_edges(vertices, faces, width=0.15)
print(rounded, "sharp from", round(rounded.angle, 1), "degrees on")
assert rounded.is_success and all(crease.is_rounded for crease in rounded.creases)
for crease in rounded.creases:
    if len(crease.vertices) > 20:
        print(f"{len(crease.vertices) - 1} edges that bend by {crease.bend:.0f} degrees")

# %% [markdown]
# Faces stay where they were, and the result is a solid again: it goes back into the next boolean.

# %%
mesh = manifold3d.Mesh(rounded.vertices.astype(np.float32), rounded.faces.astype(np.uint32))
solid = manifold3d.Manifold(mesh)
print("volume", round(solid.volume(), 3), "genus", solid.genus())
assert solid.status() == manifold3d.Error.NoError and solid.genus() == part.genus()
assert 0.95 * part.volume() < solid.volume() < part.volume()
assert np.isin(vertices[:, 2].max(), rounded.vertices[:, 2])

# %% [markdown]
# Such as this one, which cuts it open.

# %%
half = solid - manifold3d.Manifold.cube([9, 9, 9]).translate([0, -9, -4])
cut = half.to_mesh()
assert half.num_tri() > 0


def shown(points: np.ndarray, triangles: np.ndarray) -> pv.PolyData:
    made: pv.PolyData = pv.PolyData.from_regular_faces(points, triangles)
    split: pv.PolyData = made.compute_normals(feature_angle=30, split_vertices=True)
    return split


smooth = {"smooth_shading": True}
seen = [(6, -8, 7), (0, 0, 0.3), (0, 0, 1)]
shots = (
    ("As it came", shown(vertices, faces), smooth),
    ("Rounded", shown(rounded.vertices, rounded.faces), smooth),
    ("Cut open", shown(cut.vert_properties[:, :3], cut.tri_verts), smooth),
)
picture("round_edges", *shots, view=seen, zoom=1.0)

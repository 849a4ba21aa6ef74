# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # If you come from `igl.harmonic(k=2)`
#
# A biharmonic surface minimizes a quadratic energy of the input's triangles: one linear solve, smooth in the
# interior, tangent to two fixed rows of vertices. Mean curvature says more about a shape than the input's triangles
# do. Where the answer is known, a sphere, the two differ.

# %%
import igl
import numpy as np
import pyvista as pv
import trimesh
from pictures import picture, stripes

import fairmesh

ball = trimesh.creation.icosphere(subdivisions=4)
V, F = np.array(ball.vertices), np.array(ball.faces, dtype=int)
mask = V[:, 2] > 0.4
V[mask] *= [1, 1, 0.5]

# %% [markdown]
# With libigl all vertices that are not free are fixed, and their positions are the boundary values:

# %%
b = np.flatnonzero(~mask)
U = igl.harmonic(V, F, b, V[b], 2)

# %% [markdown]
# With fairmesh the same arrays go in, and no boundary values:

# %%
result = fairmesh.fair(V, F, mask)
W = result.vertices
assert result.outcome.is_success

off = {
    name: np.abs(np.linalg.norm(X, axis=1) - 1).max() for name, X in (("igl.harmonic(k=2)", U), ("fairmesh.fair", W))
}
print(off)
assert off["fairmesh.fair"] < 1e-8 and off["igl.harmonic(k=2)"] > 1e-2

# %% [markdown]
# Nor does the biharmonic surface find the sphere where the triangles that it starts from are the sphere's own:

# %%
sphere = np.array(ball.vertices)
best = igl.harmonic(sphere, F, b, sphere[b], 2)
print("igl.harmonic(k=2) of the exact sphere:", np.abs(np.linalg.norm(best, axis=1) - 1).max())
assert np.abs(np.linalg.norm(best, axis=1) - 1).max() > 1e-2

# %% [markdown]
# A linear surface needs no iterations, of course, and is a good start where only a rough idea of a shape is asked
# for. It depends on the input's triangles: dent the same region otherwise, and it is another surface, while a fair
# surface is the same.

# %%
other = V.copy()
other[mask] = V[mask] * [1, 1, 0.2] + [0, 0, 0.3]
again = fairmesh.fair(other, F, mask).vertices
linear = igl.harmonic(other, F, b, other[b], 2)
print("differs by", np.abs(linear - U).max(), "and by", np.abs(again - W).max())
assert np.abs(linear - U).max() > 1e-2 and np.abs(again - W).max() < 1e-8


# %%
def shown(vertices: np.ndarray) -> pv.PolyData:
    made = pv.PolyData.from_regular_faces(vertices, F)
    made["stripes"] = stripes(made)
    return made


how = {"scalars": "stripes", "cmap": "gray"}
shots = [(title, shown(X), how) for title, X in (("Given", V), ("igl.harmonic(k=2)", U), ("fairmesh.fair", W))]
picture("from_libigl", *shots, view=[(0, -6, 2.5), (0, 0, 0), (0, 0, 1)], zoom=1.4)

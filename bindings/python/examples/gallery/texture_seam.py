# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # A dent across a texture seam
#
# Along the seam of a texture a mesh has each vertex twice, once for either side of the picture. The globe of
# `pyvista` has one from pole to pole. To most smoothing functions it is a boundary, and tears; here copies of a
# vertex are one vertex of the surface, and move alike.

# %%
import numpy as np
from pictures import picture
from pyvista import examples

import fairmesh

globe = examples.load_globe()
globe.points /= np.linalg.norm(globe.points, axis=1).max()
globe = globe.extract_surface(algorithm=None).triangulate().subdivide(2, "linear")
globe.points /= np.linalg.norm(globe.points, axis=1)[:, None]
print(globe.n_points, "points,", globe.n_open_edges, "open edges")

# %% [markdown]
# A dent of a fifth of the radius, right on the seam.

# %%
seam = globe.extract_feature_edges(feature_edges=False, non_manifold_edges=False, manifold_edges=False).points
place = seam[np.abs(seam[:, 2]).argmin()]
away = np.linalg.norm(globe.points - place, axis=1)
dented = globe.copy()
dented.points = globe.points * (1 - 0.2 * np.clip(1 - (away / 0.4) ** 2, 0, None))[:, None]
dented["dent"] = away < 0.45
assert (np.linalg.norm(seam - place, axis=1) < 0.4).sum() > 10

# %% [markdown]
# The mask is data of the mesh, and may be given by its name. Points of `pyvista` are in single precision, and this
# globe's copies differ in the last bits, so they are not joined by themselves. That is refused, and the message says
# what to do:

# %%
try:
    fairmesh.fair(dented, "dent")
    raise AssertionError("copies that differ are a boundary")
except fairmesh.InputError as error:
    print(error)
    assert "coincident=3e-06" in str(error)

# %%
result = fairmesh.fair(dented, "dent", coincident=3e-6)
mended = result.mesh
print(result)
before, after = (np.abs(np.linalg.norm(mesh.points, axis=1) - 1).max() for mesh in (dented, mended))
print(f"off the sphere by {before:.1e} before, {after:.1e} after")
assert result.outcome.is_success and after < 1e-5 < 0.1 < before

# %% [markdown]
# The texture coordinates are what they were, and the seam is still one.

# %%
assert np.array_equal(mended.active_texture_coordinates, globe.active_texture_coordinates)
assert mended.n_open_edges == globe.n_open_edges

# %%
texture = {"texture": examples.load_globe_texture(), "color": None, "smooth_shading": False}
seen = [tuple(4 * place + [0, 0, 0.8]), (0, 0, 0), (0, 0, 1)]
picture("texture_seam", ("Dented across the seam", dented, texture), ("Faired", mended, texture), view=seen, zoom=1.0)

# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # Close the holes of a scan
#
# The Stanford bunny as it comes with `pymeshfix`: 50,000 points with five holes and 66 loose triangles. The mesh is
# one of `pyvista`, and so is what comes back.

# %%
import numpy as np
import pyvista as pv
from pictures import picture
from pymeshfix import examples

import fairmesh

scan = pv.PolyData(examples.bunny_scan)
part = fairmesh.components(scan)
print(scan.n_points, "points,", part.max() + 1, "parts, the largest of", np.bincount(part).max(), "faces")

# %% [markdown]
# The small parts are triangles that lie on the surface and hang at nothing. `erase` takes them away; what is left is
# a `PolyData` again.

# %%
clean = fairmesh.erase(scan, part != 0)
loops = fairmesh.boundary_loops(clean.mesh)
for number, loop in enumerate(loops):
    print(number, loop.kind, len(loop.vertices), "edges,", round(loop.length, 1), "long")
assert [loop.kind for loop in loops] == ["hole"] * 5

# %% [markdown]
# One call triangulates all holes, refines the triangles to the size of those around, and moves the new vertices until
# the mean curvature is harmonic.

# %%
closed = fairmesh.fill_holes(clean.mesh)
for made in closed.loops:
    print(made, made.report.text if made.report else "", f"{made.worst_angle:.0f} degrees")
whole = closed.mesh

# %% [markdown]
# Each loop says how it went. What was there before has kept its numbers and bits.

# %%
assert all(made.report and made.report.outcome.is_success for made in closed.loops)
assert whole.n_open_edges == 0 and fairmesh.boundary_loops(whole) == []
assert np.array_equal(whole.points[: scan.n_points], scan.points) and whole.points.dtype == scan.points.dtype
assert min(made.worst_angle for made in closed.loops) > 15
assert len(fairmesh.self_intersections(whole, among=np.arange(whole.n_cells)[closed.new_faces])) == 0

# %%
new = np.zeros(whole.n_cells, bool)
new[closed.new_faces] = True
patches = {"scalars": new, "cmap": ["lightgray", "orange"]}
below = [(0, 3, -150), (0, 0, 22), (0, 1, 0)]
picture("close_a_scan", ("The scan from below", clean.mesh, {}), ("Closed", whole, patches), view=below, zoom=1.6)

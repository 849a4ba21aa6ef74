# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # Join three tubes
#
# Three tubes of `trimesh` that end in the air, and one surface between them that is tangent to each.

# %%
import numpy as np
import pyvista as pv
import trimesh
from pictures import picture, stripes

import fairmesh


def tube(radius: float, axis: list[float]) -> trimesh.Trimesh:
    """From 2 to 4 along an axis, open at both ends."""
    around, along = np.arange(48) / 48 * 2 * np.pi, np.linspace(2, 4, 16)
    angle, z = np.meshgrid(around, along)
    angle = angle + (np.arange(16) % 2 * np.pi / 48)[:, None]
    vertices = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1).reshape(-1, 3)
    a = np.arange(15 * 48)
    b = a // 48 * 48 + (a + 1) % 48
    odd = (a // 48 % 2 == 1)[:, None]
    faces = (
        np.where(odd, np.c_[a, b, b + 48], np.c_[a, b, a + 48]),
        np.where(odd, np.c_[a, b + 48, a + 48], np.c_[b, b + 48, a + 48]),
    )
    made = trimesh.Trimesh(vertices, np.concatenate(faces), process=False)
    return made.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], axis))


parts = [tube(0.8, [0, 0, 1]), tube(1.0, [0.9, 0, -0.5]), tube(0.6, [-0.8, 0.3, -0.5])]
tubes: trimesh.Trimesh = trimesh.util.concatenate(parts)  # type: ignore[assignment]
colours = np.array([[220, 90, 80], [90, 160, 220], [120, 190, 90]], np.uint8)
tubes.face_attributes["colour"] = np.repeat(colours, [len(part.faces) for part in parts], axis=0)
loops = fairmesh.boundary_loops(tubes)
print([(loop.kind.value, len(loop.vertices)) for loop in loops])

# %% [markdown]
# Six loops. Those near the origin are the inner ones: they get one patch, the others stay open.

# %%
inner = [i for i, loop in enumerate(loops) if np.linalg.norm(tubes.vertices[loop.vertices].mean(axis=0)) < 3]
assert len(inner) == 3
joined = fairmesh.fill_holes(tubes, join=[inner])
(loop,) = joined.loops
print(loop, loop.report)
assert loop.outcome == "faired" and loop.report is not None and loop.report.outcome.is_success

# %% [markdown]
# It is tangent to all three: the kink along the boundary is no more than between any two triangles of a tube.

# %%
print(f"kink at the boundary: {loop.report.boundary_kink:.2f} degrees; between faces of a tube: {360 / 48:.1f}")
assert loop.report.boundary_kink < 360 / 48
assert len(fairmesh.boundary_loops(joined.mesh)) == 3 and joined.mesh.body_count == 1

# %%
smooth = pv.wrap(joined.mesh)
smooth["stripes"] = stripes(smooth)
colour = {"scalars": joined.mesh.face_attributes["colour"], "rgb": True}
before = {"scalars": tubes.face_attributes["colour"], "rgb": True}
seen = [(2, -14, 3), (0, 0, 0.3), (0, 0, 1)]
striped = {"scalars": "stripes", "cmap": "gray"}
shots = (
    ("Three tubes", pv.wrap(tubes), before),
    ("Joined", pv.wrap(joined.mesh), colour),
    ("In stripes", smooth, striped),
)
picture("join_tubes", *shots, view=seen, zoom=0.85)

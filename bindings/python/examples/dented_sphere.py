"""Repairs a sphere and shows it before and after: python dented_sphere.py [picture.png]

A part of the surface is dented and noisy, another is missing. The dent is faired, the hole is filled; colours are the
mean curvature, which is -1 on the unit sphere. Needs trimesh and matplotlib.
"""

from __future__ import annotations

import sys

import matplotlib as mpl
import numpy as np
import trimesh

mpl.use("agg")
import matplotlib.pyplot as plt
from mpl_toolkits.mplot3d import Axes3D
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import fairmesh


def draw(axes: Axes3D, vertices: np.ndarray, faces: np.ndarray, title: str) -> None:
    """A mesh in colours of its mean curvature."""
    curvature = fairmesh.mean_curvature(vertices, faces)[faces].mean(axis=1)
    colours = mpl.colormaps["coolwarm"]((np.clip(curvature, -3, 1) + 3) / 4)
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    light = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])
    colours[:, :3] *= (0.35 + 0.65 * np.clip(np.abs(normals @ light), 0, 1))[:, None]
    axes.add_collection3d(Poly3DCollection(corners, facecolors=colours, edgecolors=(0, 0, 0, 0.25), linewidths=0.15))
    axes.set(xlim=(-0.75, 0.75), ylim=(-0.75, 0.75), zlim=(-0.75, 0.75), title=title)
    axes.set_box_aspect((1, 1, 1))
    axes.view_init(elev=25, azim=-60)
    axes.set_axis_off()


def main() -> None:
    """Makes the picture."""
    mesh = trimesh.creation.icosphere(subdivisions=5)
    vertices, faces = np.array(mesh.vertices), np.array(mesh.faces)

    # The damage: a dent with noise on one side, and a hole on the other.
    dented = vertices @ [0.55, -0.8, 0.2] > 0.8
    vertices[dented] *= np.random.RandomState(1).uniform(0.75, 0.85, (dented.sum(), 1))
    damaged = trimesh.Trimesh(vertices, faces[~(vertices[faces] @ [-0.5, -0.5, 0.7] > 0.9).any(axis=1)], process=False)

    result = fairmesh.fair(damaged.vertices, damaged.faces, free=dented)
    filled = fairmesh.fill_holes(result.vertices, damaged.faces)
    print(result.outcome, filled.outcomes[0])
    used = filled.vertices[np.unique(filled.faces)]
    off = np.abs(np.linalg.norm(used, axis=1) - 1).max()
    print(f"largest distance to the sphere: {off:.1e}")

    figure = plt.figure(figsize=(9, 4.6), layout="constrained")
    draw(figure.add_subplot(1, 2, 1, projection="3d"), damaged.vertices, damaged.faces, "dented, noisy, with a hole")
    draw(figure.add_subplot(1, 2, 2, projection="3d"), filled.vertices, filled.faces, "faired and filled")
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "dented_sphere.png", dpi=80, bbox_inches="tight")


if __name__ == "__main__":
    main()

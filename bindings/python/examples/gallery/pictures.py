"""Pictures of the gallery: meshes side by side, in stripes that show how smooth a surface is."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pyvista


def stripes(mesh: pyvista.PolyData) -> Any:
    """Black and white by the direction of the normals: stripes have a corner where the surface has a kink."""
    smooth = mesh.compute_normals(cell_normals=False, split_vertices=False, auto_orient_normals=False)
    leaning = np.asarray(smooth.point_data["Normals"]) @ np.array([0.48, 0.6, 0.64])
    return 0.5 + 0.5 * np.tanh(4 * np.sin(25 * leaning))


def picture(
    name: str, *shown: tuple[str, pyvista.PolyData, dict[str, Any]], view: Any = "xy", zoom: float = 1.3
) -> Any:
    """Meshes side by side; written to the folder that FAIRMESH_PICTURES names, and returned for notebooks."""
    columns = []
    for title, mesh, how in shown:
        plotter = pyvista.Plotter(off_screen=True, window_size=[480, 480])
        plotter.add_text(title, font_size=10, color="black")
        plotter.add_mesh(mesh, **{"color": "lightgray", "show_scalar_bar": False, **how})
        plotter.camera_position = view
        plotter.camera.zoom(zoom)
        plotter.background_color = pyvista.Color("white")
        columns.append(np.asarray(plotter.screenshot(return_img=True)))
        plotter.close()
    pixels = np.hstack(columns)
    folder = os.environ.get("FAIRMESH_PICTURES")
    if folder:
        from PIL import Image

        Image.fromarray(pixels).quantize(128).save(Path(folder) / f"{name}.png", optimize=True)
    return _Shown(pixels)


class _Shown:
    """Pixels as notebooks show them."""

    def __init__(self, pixels: Any) -> None:
        self.pixels = pixels

    def _repr_png_(self) -> bytes:
        import io

        from PIL import Image

        made = io.BytesIO()
        Image.fromarray(self.pixels).save(made, "png")
        return made.getvalue()

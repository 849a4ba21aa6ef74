# SPDX-License-Identifier: MIT OR Apache-2.0
"""The filter's own time beside the solve, and that of a preview: benchmark.py PLUGIN [LEVEL]."""

import sys
import time

import meshes
import numpy as np
import pymeshlab

level = int(sys.argv[2]) if len(sys.argv) > 2 else 7
pymeshlab.load_plugin(sys.argv[1])
vertices, faces = meshes.icosphere(level)
vertices = meshes.jittered(vertices, 0.1 * 2.0**-level, 3)
for _ in range(3):
    ms = pymeshlab.MeshSet(verbose=False)
    ms.add_mesh(pymeshlab.Mesh(vertices, faces.astype(np.int32)))
    ms.compute_selection_by_condition_per_face(condselect="(z0+z1+z2)/3 > -0.25")
    values = ms.apply_filter("apply_coord_fairing_to_selection", curvature_to_quality=True)
    own = values["seconds"] - values["seconds_solve"]
    print(
        f"{values['free_vertices']} free of {len(vertices)} vertices: {values['seconds']:.2f} s; "
        f"beside the solve {own:.3f} s, {own / values['seconds']:.1%}"
    )
assert values["converged"]

# A preview is the filter. Processor time, as others may use the machine.
vertices, faces = meshes.icosphere(6)
ms = pymeshlab.MeshSet(verbose=False)
ms.add_mesh(pymeshlab.Mesh(meshes.jittered(vertices, 0.1 / 64, 3), faces.astype(np.int32)))
ms.compute_selection_by_condition_per_face(condselect="(z0+z1+z2)/3 > 0")
start = time.process_time()
values = ms.apply_filter("apply_coord_fairing_to_selection")
spent = time.process_time() - start
print(f"{values['free_vertices']} free vertices: {spent:.2f} s of one processor")
assert values["free_vertices"] > 20000 and spent < 1

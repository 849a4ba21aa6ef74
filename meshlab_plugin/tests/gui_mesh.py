# SPDX-License-Identifier: MIT OR Apache-2.0
"""Writes a dented sphere with the dent selected: gui_mesh.py FILE"""

import sys

import meshes
from test_meshlabserver import dented_sphere, flags

vertices, faces, selected, _ = dented_sphere()
turn = [[1, 0, 0], [0, 0.6, -0.8], [0, 0.8, 0.6]]  # so that the dent is seen from the side
meshes.write_ply(sys.argv[1], vertices @ turn, faces, face=flags(selected))

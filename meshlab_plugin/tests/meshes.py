# SPDX-License-Identifier: MIT OR Apache-2.0
"""Test meshes, made here, and what is measured on them."""

import numpy as np


def icosphere(level):
    """Unit sphere: (vertices, faces), 20 * 4**level faces, outward orientation."""
    g = (1 + 5**0.5) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g)]
    points += [(0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4)]
    faces += [(11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8)]
    faces += [(3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    vertices, faces = np.array(points, float), np.array(faces)
    for _ in range(level):
        vertices, faces = split(vertices, faces)
    return vertices / np.linalg.norm(vertices, axis=1)[:, None], faces


def flared_tube(around=12, rows=7, outer=3, flare=40.0):
    """A tube of radius 1 from z = 0 to z = 3 whose ends flare outwards like cones, by an angle in degrees."""
    step, tilt = 3 / (rows - 1), np.radians(flare)
    row = np.arange(-outer, rows + outer)
    inside = np.clip(row, 0, rows - 1)
    r = 1 + step * np.abs(row - inside) * np.sin(tilt)
    z = step * (inside + (row - inside) * np.cos(tilt))
    turn = 2 * np.pi * np.arange(around) / around
    vertices = np.stack([np.outer(r, np.cos(turn)), np.outer(r, np.sin(turn)), np.outer(z, np.ones(around))], axis=-1)
    a = np.arange(len(row) * around).reshape(-1, around)
    b, c, d = np.roll(a, -1, axis=1)[:-1], a[1:], np.roll(a, -1, axis=1)[1:]
    faces = np.vstack([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a[:-1], b, d), (a[:-1], d, c))])
    return vertices.reshape(-1, 3), faces


def off_rounded_cube(vertices, radius):
    """How far vertices are from the cube whose edges are cylinders of this radius, away from its corners."""
    away = (np.abs(vertices) < 1 - 3 * radius).any(axis=1)
    inner = np.clip(vertices, radius - 1, 1 - radius)
    return np.abs(np.linalg.norm(vertices - inner, axis=1) - radius)[away].max()


def split(vertices, faces):
    """Every face into four."""
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, which = np.unique(edges, axis=0, return_inverse=True)
    middle = vertices[unique].mean(axis=1)
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    a, b, c = (len(vertices) + which.reshape(3, -1)).tolist()
    v0, v1, v2 = faces.T.tolist()
    parts = [(v0, a, c), (a, v1, b), (c, b, v2), (a, b, c)]
    faces = np.vstack([np.array(part).T for part in parts])
    norms = np.linalg.norm(vertices, axis=1)
    return np.vstack([vertices / norms[:, None], middle]), faces


def jittered(vertices, amount, seed):
    """Points moved on the unit sphere by about `amount`, so that the mesh is irregular."""
    moved = vertices + np.random.default_rng(seed).normal(0, amount, vertices.shape)
    return moved / np.linalg.norm(moved, axis=1)[:, None]


def without(vertices, faces, drop):
    """The mesh without the faces where `drop`, and without vertices that lose all their faces."""
    kept = faces[~drop]
    used, numbers = np.unique(kept, return_inverse=True)
    return vertices[used], numbers.reshape(-1, 3)


def band_missing(level=4, half=0.3):
    """The unit sphere without a band around the equator."""
    vertices, faces = icosphere(level)
    return without(vertices, faces, (np.abs(vertices[faces, 2]) < half).any(axis=1))


def split_along(vertices, faces, beyond):
    """The same surface with copies of the vertices between faces `beyond` and the others: (vertices, faces, originals)."""
    seam = np.intersect1d(faces[beyond], faces[~beyond])
    number = np.arange(len(vertices))
    number[seam] = len(vertices) + np.arange(len(seam))
    split_faces = faces.copy()
    split_faces[beyond] = number[faces[beyond]]
    return np.vstack([vertices, vertices[seam]]), split_faces, seam


def needle(low, high):
    """A closed thin needle along the z axis: (vertices, faces)."""
    vertices = np.array([[0.11, 0.07, low], [0.13, 0.08, low], [0.12, 0.1, low], [0.12, 0.085, high]])
    return vertices, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])


def cube(cells):
    """The surface of a cube in so many cells along each edge: (vertices, faces), outward orientation."""
    u, v = np.meshgrid(np.arange(cells + 1), np.arange(cells + 1), indexing="ij")
    i = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)
    a, b, c, d = (part.ravel() for part in (i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]))
    side = np.vstack([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    points, faces = [], []
    for axis in range(3):
        for height in (0, cells):
            faces.append((side if height else side[:, ::-1]) + len(points) * i.size)
            points.append(np.stack(np.roll([np.full(u.shape, height), u, v], axis, axis=0), axis=-1).reshape(-1, 3))
    vertices, number = np.unique(np.vstack(points), axis=0, return_inverse=True)
    return vertices.astype(float), number.ravel()[np.vstack(faces)]


def centred_cube(cells):
    """The same from -1 to 1."""
    vertices, faces = cube(cells)
    return 2 * vertices / cells - 1, faces


def roof(is_fading):
    """A roof whose ridge, along the x axis, is flattened in the middle; or one that leads into it, and beyond the surface is flat.

    Vertices, faces, and which vertices are in the middle.
    """
    line = np.arange(15) - 7.0
    x, y = (grid.ravel() for grid in np.meshgrid(line, line))
    inside = (np.abs(x) < 4) & (np.abs(y) < 4)
    far = np.clip((x + 3) / 6, 0, 1)
    z = -np.abs(y) * (1 - far * far * (3 - 2 * far)) / 2 if is_fading else np.where(inside, -3.0, -np.abs(y))
    i = np.arange(15 * 15).reshape(15, 15)
    a, b, c, d = i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]
    faces = np.concatenate([np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])
    return np.stack([x, y, z], axis=1), faces, inside


def smallest_angle(vertices, faces):
    """In degrees."""
    corners = vertices[faces]
    first, second = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))
    sine = np.linalg.norm(np.cross(first, second), axis=2)
    return np.degrees(np.arctan2(sine, (first * second).sum(axis=2))).min()


def open_sphere(level=5, seed=7):
    """Irregular unit sphere without the cap z > 0.75."""
    vertices, faces = icosphere(level)
    vertices = jittered(vertices, 0.12 * 2.0**-level, seed)
    return without(vertices, faces, vertices[faces].mean(axis=1)[:, 2] > 0.75)


def boundary_crease(vertices, faces, selected):
    """Dihedral angles in degrees along the edges between selected and other faces: (mean, maximum)."""
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    beside = {}
    for f, (a, b, c) in enumerate(faces.tolist()):
        for edge in ((a, b), (b, c), (c, a)):
            beside.setdefault(tuple(sorted(edge)), []).append(f)
    pairs = np.array([p for p in beside.values() if len(p) == 2 and selected[p[0]] != selected[p[1]]])
    cosines = (normals[pairs[:, 0]] * normals[pairs[:, 1]]).sum(axis=1)
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    return angles.mean(), angles.max()


def crease_ratios(vertices, faces, selected):
    """The crease along the patch boundary over that of the same triangulation with all vertices on the unit sphere: mean, max."""
    exact = vertices / np.linalg.norm(vertices, axis=1)[:, None]
    ours, sphere = boundary_crease(vertices, faces, selected), boundary_crease(exact, faces, selected)
    return ours[0] / sphere[0], ours[1] / sphere[1]


def strictly_inside(vertex_count, faces, selected):
    """Vertices with faces, all of which are selected."""
    inside = np.zeros(vertex_count, bool)
    inside[faces[selected]] = True
    inside[faces[~selected]] = False
    return inside


def on_boundary(vertex_count, faces):
    """Vertices with an edge that has one face only."""
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    boundary = np.zeros(vertex_count, bool)
    boundary[unique[count == 1]] = True
    return boundary


SELECTED = 32  # the bit of MeshLab's flags


def boundary_edge(faces):
    """An edge that one face has, in the order that it has it."""
    edges = {(int(face[k]), int(face[(k + 1) % 3])) for face in faces for k in range(3)}
    return next((a, b) for a, b in sorted(edges) if (b, a) not in edges)


def write_ply(path, vertices, faces, vertex=None, face=None, wedges=None, kind="float"):
    """ASCII PLY. `vertex` and `face` are further properties: name -> (type, array); `wedges` is (faces, 6)."""
    vertex, face = vertex or {}, face or {}
    with open(path, "w") as out:
        out.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n")
        out.write("".join(f"property {kind} {axis}\n" for axis in "xyz"))
        out.write("".join(f"property {kind} {name}\n" for name, (kind, _) in vertex.items()))
        out.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\n")
        out.write("".join(f"property {kind} {name}\n" for name, (kind, _) in face.items()))
        out.write("property list uchar float texcoord\n" if wedges is not None else "")
        out.write("end_header\n")
        for i, point in enumerate(vertices):
            row = [repr(float(x)) for x in point] + [str(values[i]) for _, values in vertex.values()]
            out.write(" ".join(row) + "\n")
        for i, corners in enumerate(faces):
            row = ["3", *map(str, corners)] + [str(values[i]) for _, values in face.values()]
            if wedges is not None:
                row += ["6", *map(str, wedges[i])]
            out.write(" ".join(row) + "\n")


TYPES = {"float": "<f4", "double": "<f8", "int": "<i4", "uint": "<u4", "uchar": "u1", "char": "i1", "short": "<i2"}


def read_ply(path):
    """Binary or ASCII PLY of triangles as {element: {property: array}}."""
    with open(path, "rb") as file:
        header, body = file.read().split(b"end_header\n", 1)
    lines = [line.split() for line in header.decode().splitlines()]
    ascii_ = ["format", "ascii", "1.0"] in lines
    elements = []
    for line in lines:
        if line[0] == "element":
            elements.append((line[1], int(line[2]), []))
        elif line[0] == "property":
            elements[-1][2].append(line[1:])
    return read_ascii(body, elements) if ascii_ else read_binary(body, elements)


def read_binary(body, elements):
    mesh, at = {}, 0
    for name, count, properties in elements:
        fields = []
        for p in properties:
            if p[0] == "list":  # three corners, or the six texture coordinates of a triangle
                size = body_list_size(p[-1])
                fields += [(p[-1] + "#", TYPES[p[1]]), (p[-1], TYPES[p[2]], (size,))]
            else:
                fields.append((p[-1], TYPES[p[0]]))
        table = np.frombuffer(body, np.dtype(fields), count, at)
        at += table.nbytes
        mesh[name] = {field: table[field] for field in table.dtype.names}
    return mesh


def body_list_size(name):
    return 6 if name == "texcoord" else 3


def read_ascii(body, elements):
    mesh, rows = {}, body.decode().splitlines()
    for name, count, properties in elements:
        table = np.array([row.split() for row in rows[:count]], float)
        rows, at, mesh[name] = rows[count:], 0, {}
        for p in properties:
            size = body_list_size(p[-1]) if p[0] == "list" else 1
            at += p[0] == "list"
            column = table[:, at : at + size]
            mesh[name][p[-1]] = column if p[0] == "list" else column[:, 0]
            at += size
    return mesh


def points(mesh):
    return np.stack([mesh["vertex"][axis] for axis in "xyz"], axis=1).astype(float)

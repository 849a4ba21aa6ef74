"""Which arrays are taken, and which without a copy."""

import numpy as np
import pytest

import fairmesh
from fairmesh import _arrays
from meshes import dented_sphere

VERTICES, FACES, FREE, EXACT = dented_sphere()
WHOLE = fairmesh.fair(VERTICES, FACES, free=FREE)


def spread(array, columns):
    """The same numbers with ``columns`` others in every row."""
    wide = np.full((len(array), columns), 99, array.dtype)
    wide[:, :3] = array
    return wide[:, :3]


def same(vertices=VERTICES, faces=FACES, **selection):
    result = fairmesh.fair(vertices, faces, **(selection or {"free": FREE}))
    assert np.array_equal(result.vertices, WHOLE.vertices)


READ_WHERE_THEY_ARE = {
    "packed": VERTICES,
    "in wider rows": spread(VERTICES, 7),
    "every second row": np.repeat(VERTICES, 2, axis=0)[::2],
    "float32": VERTICES.astype(np.float32),
    "float32 in wider rows": spread(VERTICES.astype(np.float32), 4),
    "field of a struct": np.array([(v, 1) for v in VERTICES], [("p", "f8", 3), ("q", "i8")])["p"],
    "one row": VERTICES[:1],
}
COPIED = {
    "Fortran order": np.asfortranarray(VERTICES),
    "backwards": VERTICES[::-1].copy()[::-1],
    "columns swapped twice": VERTICES[:, ::-1].copy()[:, ::-1],
    "misaligned": np.frombuffer(b"x" + VERTICES.tobytes(), np.uint8)[1:].view(np.float64).reshape(-1, 3),
    "broadcast": np.broadcast_to(VERTICES[0], VERTICES.shape),
    "big-endian": VERTICES.astype(">f8"),
    "a packed struct's field": np.array([(v, 1) for v in VERTICES], [("p", "f8", 3), ("q", "i1")])["p"],
}


@pytest.mark.parametrize("array", READ_WHERE_THEY_ARE.values(), ids=READ_WHERE_THEY_ARE)
def test_vertices_read_where_they_are(array):
    assert np.shares_memory(_arrays.points(array, "vertices"), array)


@pytest.mark.parametrize("array", COPIED.values(), ids=COPIED)
def test_vertices_copied(array):
    read = _arrays.points(array, "vertices")
    assert not np.shares_memory(read, array)
    assert np.array_equal(read, array) and read.flags.c_contiguous and read.dtype == np.float64


@pytest.mark.parametrize("name", [name for name in {**READ_WHERE_THEY_ARE, **COPIED} if "one" not in name])
def test_any_layout_of_vertices(name):
    array = {**READ_WHERE_THEY_ARE, **COPIED}[name]
    if name == "broadcast":
        return
    result = fairmesh.fair(array, FACES, free=FREE)
    if array.dtype == np.float32:
        assert result.vertices.dtype == np.float32
        assert np.abs(result.vertices - WHOLE.vertices).max() < 1e-6
    else:
        assert result.vertices.dtype == np.float64
        assert np.array_equal(result.vertices, WHOLE.vertices)


@pytest.mark.parametrize("dtype", [np.float16, np.longdouble, np.int8, np.uint64])
def test_other_real_numbers_become_doubles(dtype):
    given = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype)
    read = _arrays.points(given, "vertices")
    assert read.dtype == np.float64 and np.array_equal(read, given)


def test_big_endian_floats_stay_floats():
    result = fairmesh.fair(VERTICES.astype(">f4"), FACES, free=FREE)
    assert result.vertices.dtype == np.float32


def test_lists_and_array_likes():
    same(VERTICES.tolist(), FACES.tolist(), free=FREE.tolist())
    same(VERTICES, FACES, free=np.flatnonzero(FREE).tolist())


INTEGERS = [np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, ">i4", ">i8"]


@pytest.mark.parametrize("dtype", INTEGERS, ids=str)
def test_any_integers_as_faces(dtype):
    same(faces=FACES.astype(dtype))
    same(faces=np.asfortranarray(FACES.astype(dtype)))
    same(free=np.flatnonzero(FREE).astype(dtype))


@pytest.mark.parametrize("dtype", [np.int32, np.uint32])
def test_faces_read_where_they_are(dtype):
    for faces in (FACES.astype(dtype), spread(FACES.astype(dtype), 4)):
        assert np.shares_memory(_arrays.triangles(faces)[0], faces)
        same(faces=faces)


def test_read_only_arrays():
    vertices, faces, free = VERTICES.copy(), FACES.astype(np.uint32), FREE.copy()
    normals = np.zeros_like(vertices)
    for array in (vertices, faces, free, normals):
        array.flags.writeable = False
    same(vertices, faces, free=free)
    result = fairmesh.fair(vertices, faces, free=free, boundary_normals=normals)
    assert np.array_equal(result.vertices, WHOLE.vertices) and result.vertices.flags.writeable
    assert len(fairmesh.fill_holes(vertices, faces).vertices) >= len(vertices)


def test_inputs_are_never_written():
    arrays = [VERTICES.copy(), FACES.astype(np.uint32), FREE.copy()]
    before = [array.copy() for array in arrays]
    result = fairmesh.fair(arrays[0], arrays[1], free=arrays[2])
    fairmesh.fill_holes(arrays[0], arrays[1])
    assert all(np.array_equal(a, b) for a, b in zip(arrays, before))
    assert not any(np.shares_memory(result.vertices, array) for array in arrays)


def test_all_ways_to_select():
    chosen = np.flatnonzero(FREE)
    inner = FREE[FACES].any(axis=1)  # the faces around free vertices: their other vertices have faces outside, too
    same(free=FREE)
    same(free=np.repeat(FREE, 3)[::3])
    same(free=chosen)
    same(free=chosen[::-1])
    same(free=tuple(chosen))
    # Whole numbers that are all 0 or 1, one for each vertex, are a mask.
    for dtype in (np.uint8, np.int8, np.int32, np.int64):
        same(free=FREE.astype(dtype))
        same(fixed=(~FREE).astype(dtype))
        same(free_faces=inner.astype(dtype))
    assert np.array_equal(fairmesh.fair(VERTICES, FACES, FREE).vertices, WHOLE.vertices)
    same(fixed=~FREE)
    same(fixed=np.flatnonzero(~FREE))
    same(free_faces=inner)
    same(free_faces=np.flatnonzero(inner))


def test_without_a_selection_everything_inside_is_free():
    boundary = fairmesh.boundary_loops(VERTICES, FACES)[0].vertices
    result = fairmesh.fair(VERTICES, FACES)
    # Those in the corners have no free neighbour.
    assert set(result.boundary_vertices) < set(boundary) and len(result.boundary_vertices) >= len(boundary) - 4
    assert result.report.free_vertices == len(VERTICES) - len(boundary)


def test_normals_of_any_layout():
    boundary = WHOLE.boundary_vertices
    vectors = EXACT[boundary]
    expected = fairmesh.fair(VERTICES, FACES, free=FREE, boundary_normals=(boundary, vectors)).vertices
    for given in ((boundary.astype(np.int32), np.asfortranarray(vectors)), (boundary.tolist(), vectors.tolist())):
        assert np.array_equal(fairmesh.fair(VERTICES, FACES, free=FREE, boundary_normals=given).vertices, expected)
    assert np.array_equal(fairmesh.fair(VERTICES, FACES, free=FREE, boundary_normals=EXACT).vertices, expected)
    single = fairmesh.fair(VERTICES, FACES, free=FREE, boundary_normals=EXACT.astype(np.float32)).vertices
    assert np.abs(single - expected).max() < 1e-6


def test_subclasses_and_foreign_arrays():
    class Tracked(np.ndarray):
        pass

    result = fairmesh.fair(VERTICES.view(Tracked), FACES.view(Tracked), free=FREE)
    assert type(result.vertices) is np.ndarray and np.array_equal(result.vertices, WHOLE.vertices)

    class Foreign:
        def __array__(self, dtype=None, copy=None):
            return np.array(VERTICES, dtype)

    same(Foreign())


def test_padded_faces():
    # Of libraries that put the number of corners before each triangle.
    padded = np.concatenate([np.full((len(FACES), 1), 3), FACES], axis=1).ravel()
    same(faces=padded.reshape(-1, 4)[:, 1:])

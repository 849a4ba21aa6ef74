"""What the package itself refuses, and exceptions. Refusals of the library are in test_answers.py."""

import ctypes
import re

import numpy as np
import pytest

import fairmesh
from fairmesh import ElementKind, Status, _abi
from fairmesh._errors import error_of
from meshes import dented_sphere

VERTICES, FACES, FREE, EXACT = dented_sphere()
INSIDE = 10 * 21 + 10


def fair(vertices=VERTICES, faces=FACES, **options):
    options.setdefault("free", FREE)
    return fairmesh.fair(vertices, faces, **options)


def changed(array, at, value):
    copy = array.copy()
    copy[at] = value
    return copy


def refused(status, message, kind=ElementKind.NONE, element=None, other=None, argument=None, **call):
    """The call is refused in exactly this way."""
    with pytest.raises(fairmesh.InputError) as error:
        fair(**call)
    why = error.value
    assert isinstance(why, fairmesh.FairmeshError) and isinstance(why, ValueError)
    assert (why.status, why.element_kind, why.element, why.other, why.argument) == (
        status,
        kind,
        element,
        other,
        argument,
    )
    assert str(why) == why.message == message


@pytest.mark.parametrize("value", [-1, 2**32, -(2**62)])
def test_an_index_that_is_no_uint32(value):
    refused(
        Status.INDEX_OUT_OF_RANGE,
        f"triangle 7 names vertex {value}",
        ElementKind.TRIANGLE,
        7,
        value,
        # On Windows numpy 1 has 32 bits by default.
        faces=changed(FACES.astype(np.int64), (7, 2), value),
    )


def test_negative_int32_are_not_taken_for_large_numbers():
    refused(
        Status.INDEX_OUT_OF_RANGE,
        "triangle 7 names vertex -1",
        ElementKind.TRIANGLE,
        7,
        -1,
        faces=changed(FACES.astype(np.int32), (7, 2), -1),
    )


@pytest.mark.parametrize("nothing", [[], np.zeros(441, bool), np.empty(0, np.int64)], ids=["list", "mask", "indices"])
def test_nothing_is_free(nothing):
    message = "no vertex is free: the selection holds no vertex all of whose triangles may move"
    refused(Status.EMPTY_REGION, message, free=nothing)
    refused(Status.EMPTY_REGION, message, free=None, free_faces=[])


@pytest.mark.parametrize("vertices", [[], np.empty((0, 3)), np.empty((0, 3), np.float32)])
def test_an_empty_mesh(vertices):
    message = "no vertex is free: the selection holds no vertex all of whose triangles may move"
    refused(Status.EMPTY_REGION, message, vertices=vertices, faces=[], free=None)
    refused(Status.EMPTY_REGION, message, vertices=vertices, faces=np.empty((0, 3), np.uint32), free=None)
    assert fairmesh.boundary_loops(vertices, []) == []
    assert fairmesh.mean_curvature(vertices, []).shape == (0,)
    filled = fairmesh.fill_holes(vertices, [])
    assert filled.vertices.shape == filled.faces.shape == filled.parents.shape == (0, 3)
    assert filled.vertices.dtype == np.asarray(vertices).dtype


@pytest.mark.parametrize("name", ["free", "fixed"])
def test_a_selection_out_of_range(name):
    for value in (-1, 2**32):
        refused(
            Status.SELECTION_OUT_OF_RANGE,
            f"{name} names element {value}",
            ElementKind.VERTEX,
            value,
            **{"free": None, name: [INSIDE, value]},
        )


@pytest.mark.parametrize("vector", [[0, 0, 2], [0, 0, np.inf], [np.nan, 0, 1]])
def test_a_normal_that_is_no_unit_vector(vector):
    boundary = int(fair().boundary_vertices[5])
    message = (
        f"the normal given for vertex {boundary} is not a finite unit vector, "
        "or contradicts that of a coincident vertex"
    )
    refused(Status.BAD_NORMAL, message, ElementKind.VERTEX, boundary, boundary_normals=([boundary], [vector]))
    rows = changed(np.zeros_like(VERTICES), boundary, vector)
    refused(Status.BAD_NORMAL, message, ElementKind.VERTEX, boundary, boundary_normals=rows)


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.nan])
def test_a_curvature_that_is_not_finite(value):
    message = "the mean curvature given for vertex 40 is not finite"
    refused(Status.BAD_OPTION, message, ElementKind.VERTEX, 40, boundary_curvature={40: value})
    refused(Status.BAD_OPTION, message, ElementKind.VERTEX, 40, boundary_curvature=([40], [value]))
    if np.isinf(value):
        rows = changed(np.full(len(VERTICES), np.nan), 40, value)
        refused(Status.BAD_OPTION, message, ElementKind.VERTEX, 40, boundary_curvature=rows)


WRONG_TYPES = {
    "faces: integers are needed, not float64": {"faces": FACES.astype(float)},
    "faces: integers are needed, not bool": {"faces": FACES.astype(bool)},
    "vertices: real numbers are needed, not complex128": {"vertices": VERTICES.astype(complex)},
    "vertices: real numbers are needed, not object": {"vertices": VERTICES.astype(object)},
    "vertices: real numbers are needed, not <U1": {"vertices": np.full((441, 3), "a")},
    "vertices: real numbers are needed, not bool": {"vertices": VERTICES.astype(bool)},
    "free: a mask of bool or indices of integers are needed, not float64": {"free": FREE.astype(float)},
    "free: uint8 is neither a mask (bool, or 441 times 0 or 1) nor indices (16 bits and more)": {
        "free": 255 * FREE.astype(np.uint8)
    },
    "free: int8 is neither a mask (bool, or 441 times 0 or 1) nor indices (16 bits and more)": {
        "free": FREE.astype(np.int8)[1:]
    },
    "tolerance: a number is needed, not str": {"tolerance": "1e-8"},
    "continuity: a number is needed, not bool": {"continuity": True},
    "boundary_curvature: real numbers are needed, not bool": {"boundary_curvature": ([1], [True])},
    "tolerance: a number is needed, not bool": {"tolerance": True},
    "threads: an integer is needed, not float": {"threads": 2.0},
    "threads: an integer is needed, not bool": {"threads": True},
    "target: a number is needed, not list": {"target": [0]},
    "unknown option 'tolerence'; did you mean 'tolerance'?": {"tolerence": 1e-8},
    "unknown option 'quite_another'": {"quite_another": 1},
    "unknown option 'tol'; did you mean 'tolerance'?": {"tol": 1e-8},
    "unknown option 'maxiter'; did you mean 'max_iterations'?": {"maxiter": 9},
    "unknown option 'face_mask'; did you mean 'free_faces'?": {"face_mask": []},
    "unknown option 'density'": {"density": 2.0},
    "unknown option 'coincidence'; did you mean 'coincident'?": {"coincidence": "join"},
    "progress: a callable is needed, not bool": {"progress": True},
    "cancel: an object with is_set() is needed, not bool": {"cancel": True},
}


@pytest.mark.parametrize(("message", "call"), WRONG_TYPES.items(), ids=WRONG_TYPES)
def test_wrong_types(message, call):
    with pytest.raises(TypeError) as error:
        fair(**call)
    assert str(error.value) == message


WRONG_VALUES = {
    "vertices: the shape has to be (n, 3), not (441, 2)": {"vertices": VERTICES[:, :2]},
    "vertices: the shape has to be (n, 3), not (1323,)": {"vertices": VERTICES.ravel()},
    "vertices: the shape has to be (n, 3), not (441, 3, 1)": {"vertices": VERTICES[:, :, None]},
    "vertices: the shape has to be (n, 3), not ()": {"vertices": 1.0},
    "faces: the shape has to be (m, 3), not (800, 4)": {"faces": np.ones((800, 4), int)},
    "faces: the shape has to be (m, 3), not (2400,)": {"faces": FACES.ravel()},
    "free: a mask has to have the shape (441,), not (440,)": {"free": FREE[1:]},
    "free: a mask has to have the shape (441,), not (21, 21)": {"free": FREE.reshape(21, 21)},
    "free: the shape has to be (k,), not (1, 2)": {"free": [[1, 2]]},
    "fixed: a mask has to have the shape (441,), not (442,)": {"free": None, "fixed": np.ones(442, bool)},
    "free_faces: a mask has to have the shape (800,), not (441,)": {"free": None, "free_faces": FREE},
    "free: a mask of 0 and 1 has to have 441 entries, not 440": {"free": FREE.astype(np.int64)[1:]},
    "free: a mask has to have the shape (441,), not (800,); a mask of faces is given as free_faces": {
        "free": np.ones(800, bool)
    },
    "free: index 7 is given 2 times; np.unique(free) has each once": {"free": [7, 8, 7]},
    "free_faces: index 3 is given 3 times; np.unique(free_faces) has each once": {
        "free": None,
        "free_faces": [3, 3, 4, 3],
    },
    "coincident: 'merge' is neither 'join' nor 'separate' nor a distance": {"coincident": "merge"},
    "coincident: True is neither 'join' nor 'separate' nor a distance": {"coincident": True},
    "only one of free and fixed can be given": {"fixed": ~FREE},
    "only one of free and fixed and free_faces can be given": {"fixed": ~FREE, "free_faces": [0]},
    "boundary_normals: 440 rows, but 441 are needed": {"boundary_normals": EXACT[1:]},
    "boundary_normals: 1 rows, but 2 are needed": {"boundary_normals": ([1, 2], [[0, 0, 1]])},
    "boundary_normals: the shape has to be (n, 3), not (3,)": {"boundary_normals": [0, 0, 1]},
    "boundary_normals: 'flat' is neither 'fitted' nor 'averaged' nor an array": {"boundary_normals": "flat"},
    "continuity: 'g3' is neither 'auto' nor 'g1' nor 'g2' nor a number": {"continuity": "g3"},
    "sharp: 'on' is neither 'auto' nor 'off' nor a number": {"sharp": "on"},
    "boundary_curvature: 'exact' is neither 'estimated' nor a mapping nor an array": {"boundary_curvature": "exact"},
    "boundary_curvature: 440 numbers, but 441 are needed": {"boundary_curvature": EXACT[1:, 0]},
    "boundary_curvature: 1 numbers, but 2 are needed": {"boundary_curvature": ([1, 2], [0.5])},
    "boundary_curvature: the shape has to be (k,), not (441, 3)": {"boundary_curvature": EXACT},
    "target: 'flat' is neither 'harmonic' nor 'minimal_energy' nor a number": {"target": "flat"},
    "inner_fairness: 'even' is none of 'uniform', 'conformal', 'convex'": {"inner_fairness": "even"},
    "interior_normals: 0 is none of 'smooth', 'input'": {"interior_normals": 0},
    "discretization: 'slow' is none of 'second_order', 'paper'": {"discretization": "slow"},
    "inner_fairness: 'unifrom' is none of 'uniform', 'conformal', 'convex'; did you mean 'uniform'?": {
        "inner_fairness": "unifrom"
    },
    "threads: -1 is not between 0 and 2**32 - 1": {"threads": -1},
    "max_iterations: 18446744073709551616 is not between 0 and 2**64 - 1": {"max_iterations": 2**64},
}


@pytest.mark.parametrize(("message", "call"), WRONG_VALUES.items(), ids=WRONG_VALUES)
def test_wrong_shapes_and_names(message, call):
    with pytest.raises(ValueError) as error:
        fair(**call)
    assert str(error.value) == message and not isinstance(error.value, fairmesh.FairmeshError)


class Trimesh:
    """As other packages have meshes."""

    vertices = VERTICES
    faces = FACES


def test_a_mesh_object_is_told_to_give_its_arrays():
    message = (
        "a Trimesh is no mesh of a package that is known: give mesh.vertices and mesh.faces in its place, "
        "as vertices and faces"
    )
    functions = (fairmesh.fair, fairmesh.Solver, fairmesh.fill_holes, fairmesh.boundary_loops, fairmesh.remesh)
    for function in (*functions, fairmesh.suggest_joins, fairmesh.erase, fairmesh.components):
        with pytest.raises(TypeError) as error:
            function(Trimesh())
        assert str(error.value) == message
    with pytest.raises(TypeError, match=message):
        fairmesh.mean_curvature(vertices=Trimesh(), faces=FACES)


def test_misspelt_keywords_of_other_functions():
    for function, given, meant in (
        (fairmesh.fill_holes, "max_edge", "max_edges"),
        (fairmesh.fill_holes, "on_fail", "on_failure"),
        (fairmesh.boundary_loops, "coincidence", "coincident"),
        (fairmesh.suggest_joins, "loop", "loops"),
        (fairmesh.remesh, "max_vertex", "max_vertices"),
        (fairmesh.bridge, "widht", "width"),
        (fairmesh.erase, "erase", "erased"),
        (fairmesh.Solver, "targett", "target"),
    ):
        with pytest.raises(TypeError) as error:
            function(VERTICES, FACES, **{given: 1})
        assert str(error.value) == f"unknown option {given!r}; did you mean {meant!r}?"
    with pytest.raises(ValueError, match=re.escape("on_failure: 'opne' is none of 'best', 'flat', 'open'; did you")):
        fairmesh.fill_holes(VERTICES, FACES, on_failure="opne")


def test_a_mask_of_two_faces_is_not_guessed_at():
    with pytest.raises(ValueError, match=re.escape("erased: [0, 1] can be a mask or indices; give a mask as bool")):
        fairmesh.erase(VERTICES[:4], [[0, 1, 2], [0, 2, 3]], [0, 1])


def test_arguments_that_are_missing_or_given_twice():
    for message, call in {
        "a mesh is needed: a mesh object, or vertices and faces": lambda: fairmesh.fair(),
        "faces are needed as well: give vertices and faces, or a mesh object": lambda: fairmesh.fair(VERTICES),
        "the faces are given twice": lambda: fairmesh.fair(VERTICES, FACES, faces=FACES),
        "the mesh is given twice": lambda: fairmesh.fair((VERTICES, FACES), mesh=(VERTICES, FACES)),
    }.items():
        with pytest.raises(TypeError) as error:
            call()
        assert str(error.value) == message


def test_other_functions_check_the_same():
    functions = (fairmesh.fill_holes, fairmesh.boundary_loops, fairmesh.mean_curvature, fairmesh.remesh)
    for function in (*functions, fairmesh.suggest_joins, fairmesh.components):
        with pytest.raises(ValueError, match="vertices: the shape"):
            function(VERTICES[:, :2], FACES)
        with pytest.raises(fairmesh.InputError) as error:
            function(VERTICES, changed(FACES, (7, 2), 441))
        assert (error.value.status, error.value.element) == (Status.INDEX_OUT_OF_RANGE, 7)


def test_every_status_has_an_exception():
    assert [(m.name, int(m)) for m in Status] == [(m.name, int(m)) for m in _abi.fairmesh_status]
    for status in set(Status) - {Status.OK}:
        struct = _abi.fairmesh_error(status, 0, _abi.NO_ELEMENT, _abi.NO_ELEMENT, b"why")
        error = error_of("fairmesh_fair", status, struct)
        assert (error.status, str(error)) == (status, "why")
        assert isinstance(error, MemoryError) == (status is Status.OUT_OF_MEMORY)
    unknown = error_of("fairmesh_fair", 77, _abi.fairmesh_error(77, 9, 1, 2, b""))
    assert unknown.status is Status.INTERNAL and "77" in str(unknown)


def test_a_refused_call_makes_nothing(live_handles):
    for call in ({"free": []}, {"tolerance": 0.0}, {"faces": changed(FACES, (7, 2), 441)}):
        with pytest.raises(fairmesh.InputError):
            fair(**call)
        with pytest.raises(fairmesh.InputError):
            fairmesh.Solver(**{"vertices": VERTICES, "faces": FACES, "free": FREE, **call})
    assert live_handles("result") == live_handles("solver") == 0
    assert ctypes.sizeof(_abi.fairmesh_error) == 256

"""Keyword arguments to the library's options. Defaults are the library's: what is None is not touched."""

from __future__ import annotations

import copy
import ctypes
from collections import abc
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _abi, _arrays
from ._calls import of_names
from ._enums import Status
from ._errors import error_of
from ._keywords import DEFAULTS
from ._library import load
from ._schema import KINDS, FairingOptions

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from ._forms import Curvature, HowFar, LoopContinuity, Normals, Sharp, Target

Struct = TypeVar("Struct", bound=ctypes.Structure)


def initial(struct: type[Struct]) -> Struct:
    """A struct filled with the library's defaults."""
    made, function = struct(), f"{struct.__name__}_init"
    status = getattr(load(), function)(made, ctypes.sizeof(struct))
    if status != Status.OK:
        raise error_of(function, status, _abi.fairmesh_error(status, 0, _abi.NO_ELEMENT, _abi.NO_ELEMENT))
    return made


def keep(struct: Struct, *alive: Any) -> Struct:
    """The struct, which keeps arrays that it points to, or structs that do and that it has a copy of."""
    vars(struct).setdefault("alive", []).extend(alive)
    return struct


def options_of(struct: type[Struct], given: Mapping[str, Any]) -> Struct:
    """A struct of plain options with the library's defaults where nothing is given."""
    made = initial(struct)
    set_options(made, given)
    return made


def real(value: Any, name: str) -> float:
    """A real number."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{name}: a number is needed, not {type(value).__name__}")
    return float(value)


def whole(value: Any, name: str, bits: int = 64) -> int:
    """A number without sign of so many bits."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name}: an integer is needed, not {type(value).__name__}")
    if not 0 <= value < 2**bits:
        raise ValueError(f"{name}: {value} is not between 0 and 2**{bits} - 1")
    return int(value)


def flag(value: Any, name: str) -> int:
    """Yes or no."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: True or False is needed, not {type(value).__name__}")
    return int(value)


def positive(value: Any, name: str) -> float:
    """A real number; 0 would be the default for the library."""
    number = real(value, name)
    if number == 0.0:
        raise ValueError(f"{name}: it has to be positive")
    return number


def set_options(struct: ctypes.Structure, given: Mapping[str, Any]) -> None:
    """Sets what is given of a struct's options, but those with a form of Python's."""
    for name, kind in KINDS[type(struct).__name__].items():
        value = given.get(name)
        if value is None or kind == "form":
            continue
        how, _, of = kind.partition(" ")
        if how == "choice":
            setattr(struct, name, _number(value, name, getattr(_abi, of)))
        elif how == "count":
            setattr(struct, name, whole(value, name, int(of)))
        elif how == "rings":
            setattr(struct, name, _abi.RELAX_AUTO if value == "auto" else whole(value, name, 64))
        elif how in ("pairs", "indices"):
            listed = _arrays.pairs(value, name) if how == "pairs" else _arrays.indices(value, name)
            setattr(keep(struct, listed), name, _arrays.indices_view(listed))
        else:
            setattr(struct, name, {"real": real, "positive": positive, "flag": flag}[how](value, name))


def fairing_options(vertices: NDArray[Any], given: Mapping[str, Any]) -> _abi.fairmesh_options:
    """The library's options of fairing."""
    struct = initial(_abi.fairmesh_options)
    if vertices.dtype == np.float32:
        struct.output_precision = _abi.fairmesh_output_precision.SINGLE
    set_options(struct, given)
    if given.get("continuity") is not None:
        struct.continuity = how_far(given["continuity"], "continuity")
    if given.get("sharp") is not None:
        struct.sharp = sharp_angle(given["sharp"])
    if given.get("target") is not None:
        struct.target = target_struct(given["target"])
    for name, view_of in VIEWS.items():
        if given.get(name) is not None:
            view = view_of(given[name], len(vertices))
            setattr(keep(struct, view), name, view)
    return struct


def _number(value: Any, name: str, of: Any) -> int:
    names: dict[str, int] = {member.name.lower(): member for member in of}
    if not isinstance(value, str) or value not in names:
        raise ValueError(of_names(value, name, names))
    return names[value]


def how_far(value: HowFar, name: str) -> float:
    """From 0 to 1 or auto, if the library agrees."""
    return _real_or_word(value, name, {"auto": _abi.CONTINUITY_AUTO, "g1": 0.0, "g2": 1.0})


def sharp_angle(value: Sharp) -> float:
    """The angle from which on sharp edges go on, in degrees, if the library agrees."""
    return _real_or_word(value, "sharp", {"auto": _abi.SHARP_AUTO, "off": 0.0})


def _real_or_word(value: Any, name: str, words: Mapping[str, float]) -> float:
    if not isinstance(value, str):
        return real(value, name)
    if value not in words:
        raise ValueError(f"{name}: {value!r} is neither {' nor '.join(map(repr, words))} nor a number")
    return words[value]


def target_struct(value: Target) -> _abi.fairmesh_target:
    """The right-hand side of the equation, as the library reads it."""
    kinds = _abi.fairmesh_target_kind
    if isinstance(value, str):
        if value == "harmonic":
            return _abi.fairmesh_target(kinds.HARMONIC, 0, 0.0)
        if value == "minimal_energy":
            return _abi.fairmesh_target(kinds.MINIMAL_ENERGY, 0, 0.0)
        raise ValueError(f"target: {value!r} is neither 'harmonic' nor 'minimal_energy' nor a number")
    return _abi.fairmesh_target(kinds.CONSTANT, 0, real(value, "target"))


def normals_view(given: Normals, vertex_count: int) -> _abi.fairmesh_boundary_normals:
    """Boundary normals, as the library reads them."""
    kinds = _abi.fairmesh_boundary_normals_kind
    if isinstance(given, str):
        if given not in ("fitted", "averaged"):
            raise ValueError(f"boundary_normals: {given!r} is neither 'fitted' nor 'averaged' nor an array")
        return _abi.fairmesh_boundary_normals(kinds[given.upper()])
    vectors, indices = _rows(given, "boundary_normals", _arrays.points, vertex_count)
    if indices is None:
        vectors = _none_as_zero(vectors)
    views = (_arrays.points_view(vectors), _arrays.list_view(indices) or _abi.fairmesh_indices())
    return keep(_abi.fairmesh_boundary_normals(kinds.GIVEN, 0, *views), vectors, indices)


def curvature_view(given: Curvature, vertex_count: int) -> _abi.fairmesh_boundary_curvature:
    """Mean curvature at the boundary, as the library reads it."""
    kinds, name = _abi.fairmesh_boundary_curvature_kind, "boundary_curvature"
    estimated = _abi.fairmesh_boundary_curvature(kinds.ESTIMATED)
    if isinstance(given, str):
        if given != "estimated":
            raise ValueError(f"{name}: {given!r} is neither 'estimated' nor a mapping nor an array")
        return estimated
    if isinstance(given, abc.Mapping):
        given = (list(given), list(given.values()))
    values, indices = _rows(given, name, _arrays.numbers, vertex_count)
    if indices is not None and len(indices) == 0:
        # For the library, no list of vertices is one number for each.
        return estimated
    views = (_arrays.numbers_view(values), _arrays.list_view(indices) or _abi.fairmesh_indices())
    return keep(_abi.fairmesh_boundary_curvature(kinds.GIVEN, 0, *views), values, indices)


def loops_view(given: LoopContinuity, vertex_count: int = 0) -> _abi.fairmesh_loop_continuity:
    """How far single loops are continued, as the library reads it."""
    del vertex_count
    name = "loop_continuity"
    if not isinstance(given, abc.Mapping):
        raise TypeError(f"{name}: a mapping from vertices to numbers is needed, not {type(given).__name__}")
    indices = _arrays.indices(list(given), name)
    values = np.array([how_far(value, name) for value in given.values()], float)
    views = (_arrays.numbers_view(values), _arrays.indices_view(indices)) if given else ()
    return keep(_abi.fairmesh_loop_continuity(*views), indices, values)


#: Options that name arrays.
VIEWS: dict[str, Callable[[Any, int], ctypes.Structure]] = {
    "boundary_normals": normals_view,
    "boundary_curvature": curvature_view,
    "loop_continuity": loops_view,
}


def _rows(given: Any, name: str, read: Callable[..., NDArray[Any]], count: int) -> tuple[NDArray[Any], Any]:
    """What is given of all vertices, and None; or of a pair, of these vertices, and their indices."""
    if isinstance(given, tuple) and len(given) == 2:
        indices = _arrays.indices(given[0], name)
        return read(given[1], name, rows=len(indices)), indices
    return read(given, name, rows=count), None


def _none_as_zero(vectors: NDArray[Any]) -> NDArray[Any]:
    """Rows of NaN say that no normal is given: for the library, zeros do."""
    empty = np.isnan(vectors).all(axis=1)
    if not empty.any():
        return vectors
    copy = np.array(vectors, order="C")
    copy[empty] = 0.0
    return copy


def default_options() -> FairingOptions:
    """All fairing options with their defaults: ``fair(v, f, **default_options())`` is ``fair(v, f)``."""
    return _defaults(FairingOptions.__annotations__)  # type: ignore[return-value]


def default_fill_options() -> dict[str, Any]:
    """The defaults of `fill_holes` besides those of the fairing."""
    return _defaults([*KINDS["fairmesh_fill_options"], "join", "max_edges", "except_longest"])


def default_remesh_options() -> dict[str, Any]:
    """The defaults of `remesh`."""
    return _defaults(KINDS["fairmesh_remesh_options"])


def _defaults(names: Iterable[str]) -> dict[str, Any]:
    return copy.deepcopy({name: DEFAULTS.get(name) for name in names})

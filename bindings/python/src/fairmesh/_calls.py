"""What all functions of meshes have in common: a mesh in one argument or two, known names, what ``help`` shows."""

from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, get_args, get_origin

from ._arrays import Mesh
from ._hosts import Host, host_of
from ._keywords import DEFAULTS, MeshKeywords

_KEYWORD = inspect.Parameter.KEYWORD_ONLY

#: What other packages, and the flags of the command line, call it.
_SYNONYMS = {
    "continuity_at": "loop_continuity",
    "component": "of_components",
    "no_fair": "fair",
    "from_": "start",
    "to": "end",
    "mask": "free",
    "selection": "free",
    "vertex_mask": "free",
    "face_mask": "free_faces",
    "pinned": "fixed",
    "tol": "tolerance",
    "eps": "tolerance",
    "maxiter": "max_iterations",
    "max_iter": "max_iterations",
    "iterations": "max_iterations",
    "n_iter": "max_iterations",
    "n_jobs": "threads",
    "num_threads": "threads",
    "callback": "progress",
    "merge": "coincident",
    "weld": "coincident",
    "hole_size": "max_length",
    "nbe": "max_edges",
    "normals": "boundary_normals",
    "center": "centre",
}


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """What may have been meant by a name that is not known, as the end of a sentence; empty if nothing is like it."""
    names = list(known)
    low = name.lower()
    near = difflib.get_close_matches(low, names, n=1)
    near = near or [each for each in names if len(low) > 2 and (each.startswith(low) or each.endswith(low))][:1]
    if _SYNONYMS.get(low) in names:
        near = [_SYNONYMS[low]]
    return f"; did you mean {near[0]!r}?" if near else ""


def of_names(given: Any, name: str, known: Iterable[str]) -> str:
    """The sentence for a value that is none of these names."""
    names = list(known)
    hint = did_you_mean(given, names) if isinstance(given, str) else ""
    return f"{name}: {given!r} is none of {', '.join(map(repr, names))}{hint}"


class Shown:
    """An annotation as ``help`` shall print it: no string, which would be shown in quotes and evaluated."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


def of_mesh(keywords: type | None = MeshKeywords) -> Callable[[Callable[..., Any]], Any]:
    """Makes of a function of a `Mesh` one that takes a mesh object, or vertices and faces.

    ``keywords`` is the typed dictionary of the keywords that it takes besides those it names. All are in the signature
    that ``help`` shows, and what is none of them is refused with what may have been meant. For type checkers the
    function's overloads say what it takes.
    """

    def decorated(function: Callable[..., Any]) -> Any:
        signature = inspect.signature(function)
        given = list(signature.parameters.values())
        first = 1 if given[0].name == "self" else 0
        where = function.__globals__
        shown = [_shown(each, where) for each in given if each.kind is not inspect.Parameter.VAR_KEYWORD]
        for name, annotation in (keywords.__annotations__ if keywords else {}).items():
            text = getattr(annotation, "__forward_arg__", annotation)
            made = inspect.Parameter(name, _KEYWORD, default=DEFAULTS.get(name), annotation=text)
            shown.append(_shown(made, where))
        names = [each.name for each in shown[first + 1 :]]

        @functools.wraps(function)
        def taking(*given: Any, **named: Any) -> Any:
            unknown = sorted(set(named) - {*names, "mesh", "vertices", "faces"})
            if unknown:
                raise TypeError(f"unknown option {unknown[0]!r}{did_you_mean(unknown[0], names)}")
            positional = _with_host(list(given), named, first)
            coincident = named.pop("coincident", None) if "coincident" in names else None
            positional[first : first + 2] = [Mesh(positional[first], positional[first + 1], coincident)]
            return function(*positional, **named)

        returned = signature.return_annotation
        mesh = shown[first].replace(annotation=Shown("MeshLike | (vertices, faces)"))
        taking.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=[*shown[:first], mesh, *shown[first + 1 :]],
            return_annotation=Shown(returned) if isinstance(returned, str) else returned,
        )
        return taking

    return decorated


def _shown(parameter: inspect.Parameter, where: Mapping[str, Any]) -> inspect.Parameter:
    """A parameter as ``help`` shall show it: its type in the words of users, strings with what they may be."""
    text = parameter.annotation
    if not isinstance(text, str):
        return parameter
    text = text.replace("_arrays.", "")
    if parameter.default is not None and text.endswith(" | None"):
        # None is the default, too; which one it is stands there.
        text = text[: -len(" | None")]
    alias = where.get(text)
    if get_origin(alias) is Literal:
        text = f"Literal{list(get_args(alias))}"
    return parameter.replace(annotation=Shown(text))


def _with_host(given: list[Any], named: dict[str, Any], first: int) -> list[Any]:
    """The arguments with a host, or with two arrays, in the first two places."""
    if (len(given) > first) + ("mesh" in named) + ("vertices" in named) > 1:
        raise TypeError("the mesh is given twice")
    if "mesh" in named:
        given.append(named.pop("mesh"))
    if len(given) > first:
        mesh = given[first]
    elif "vertices" in named:
        mesh = named.pop("vertices")
        given.append(mesh)
    else:
        raise TypeError("a mesh is needed: a mesh object, or vertices and faces")
    host = mesh if isinstance(mesh, Host) else host_of(mesh)
    if host is not None:
        if "faces" in named:
            raise TypeError(f"a {type(mesh).__name__} has faces of its own: give no faces")
        given[first : first + 1] = [host, None]
    elif len(given) == first + 1:
        if "faces" not in named:
            raise TypeError("faces are needed as well: give vertices and faces, or a mesh object")
        given.append(named.pop("faces"))
    elif "faces" in named:
        raise TypeError("the faces are given twice")
    return given

"""What all functions of meshes have in common: a mesh in one argument or two, known names, what ``help`` shows."""

from __future__ import annotations

import difflib
import functools
import inspect
import sys
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, get_args, get_origin

from ._hosts import Host, host_of

#: What other packages call it.
_SYNONYMS = {
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


def of_mesh(
    options: type | None = None, defaults: Mapping[str, Any] | None = None
) -> Callable[[Callable[..., Any]], Any]:
    """Lets a function of ``(vertices, faces, ...)`` take a mesh object in place of these two.

    ``options`` is the typed dictionary of the keywords that it takes besides those it names. All are in the signature
    that ``help`` shows, and what is none of them is refused with what may have been meant. For type checkers the
    function's overloads say what it takes.
    """

    def decorated(function: Callable[..., Any]) -> Any:
        signature = inspect.signature(function)
        given = list(signature.parameters.values())
        first = 1 if given[0].name == "self" else 0
        where = function.__globals__
        shown = [_shown(each, where) for each in given if each.kind is not inspect.Parameter.VAR_KEYWORD]
        if options is not None:
            where = vars(sys.modules[options.__module__])
            for name, annotation in options.__annotations__.items():
                default = (defaults or {}).get(name)
                text = getattr(annotation, "__forward_arg__", annotation)
                made = inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=text)
                shown.append(_shown(made, where))
        names = [each.name for each in shown[first:]]

        @functools.wraps(function)
        def taking(*given: Any, **named: Any) -> Any:
            unknown = sorted(set(named) - {*names, "mesh"})
            if unknown:
                raise TypeError(f"unknown option {unknown[0]!r}{did_you_mean(unknown[0], names)}")
            return function(*_with_host(list(given), named, first), **named)

        mesh = shown[first].replace(name="mesh", annotation=Shown("MeshLike | (vertices, faces)"))
        returned = signature.return_annotation
        taking.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=[*shown[:first], mesh, *shown[first + 2 :]],
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
    if "mesh" in named:
        if len(given) > first or "vertices" in named:
            raise TypeError("the mesh is given twice")
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

#!/usr/bin/env python3
"""Writes the page of all names, fairmesh.html, with pdoc: build_api.py FOLDER. Warnings are errors."""

from __future__ import annotations

import inspect
import re
import sys
import warnings
from pathlib import Path
from typing import Any

import pdoc
import pdoc.doc
import pdoc.doc_types
import pdoc.render

import fairmesh
from fairmesh._calls import Shown


def functions() -> list[Any]:
    """All that can be called with a mesh."""
    found = [getattr(fairmesh, name) for name in fairmesh.__all__]
    return [each for each in found if inspect.isfunction(each)] + [fairmesh.Solver.__init__]


def as_written(annotation: Any, *_: Any, **__: Any) -> Any:
    """Annotations as the sources have them: what numpy's are made of fills pages."""
    return Shown(annotation.replace("_arrays.", "")) if isinstance(annotation, str) else annotation


def main() -> None:
    """The command line."""
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    warnings.simplefilter("error")
    # pdoc looks through decorators to the signature behind, which does not have the options.
    for function in functions():
        vars(function).pop("__wrapped__", None)
    pdoc.doc.safe_eval_type = pdoc.doc_types.safe_eval_type = as_written
    pdoc.render.configure(docformat="google", show_source=False, search=True)
    pdoc.pdoc("fairmesh", output_directory=Path(sys.argv[1]))
    page = Path(sys.argv[1], "fairmesh.html")
    text = page.read_text(encoding="utf-8")
    text = re.sub(r'<div class="decorator decorator-functools.wraps">.*?</div>', "", text, flags=re.S)
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()

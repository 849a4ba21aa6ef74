"""What type checkers say of a wrong call can be read."""

import textwrap
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1]

WRONG = """
    import numpy as np
    import trimesh

    import fairmesh

    mesh = trimesh.Trimesh()
    fairmesh.fair(mesh, tolerence=1e-6)
    fairmesh.fill_holes(np.zeros((3, 3)))
    fairmesh.mean_curvature()
    fairmesh.select_ball(mesh, "centre", 1.0)
"""


def test_a_wrong_call_is_named_in_lines_that_can_be_read(tmp_path, monkeypatch):
    api = pytest.importorskip("mypy.api")
    monkeypatch.setenv("MYPYPATH", str(PACKAGE / "src"))
    path = tmp_path / "wrong.py"
    path.write_text(textwrap.dedent(WRONG))
    said, _, _ = api.run(["--strict", f"--cache-dir={tmp_path / 'cache'}", str(path)])
    lines = said.splitlines()
    assert any('did you mean "tolerance"?' in line for line in lines)
    for number in (7, 8, 9, 10):
        assert any(f":{number + 1}: error" in line for line in lines), said
    # The keywords of fill_holes are 31 by their names; numpy's array types in them would make 3,000 characters of it.
    assert max(map(len, lines)) < 2200, said
    assert "_NestedSequence" not in said

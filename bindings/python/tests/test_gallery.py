"""The notebooks of the gallery are executed as Jupyter would: every cell, with what each of them asserts."""

import os
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "examples" / "gallery"
NOTEBOOKS = sorted(path for path in FOLDER.glob("*.py") if path.name != "pictures.py")


def test_each_is_in_the_list_with_its_picture():
    page = (FOLDER / "README.md").read_text()
    for path in NOTEBOOKS:
        assert f"({path.name})" in page and f"({path.stem}.png)" in page
        assert (FOLDER / f"{path.stem}.png").stat().st_size > 20_000
        assert path.read_text().count("assert ") >= 2
    assert len(NOTEBOOKS) >= 8


@pytest.mark.skipif(not os.environ.get("FAIRMESH_TEST_LONG"), reason="long tests only")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_notebooks(path, tmp_path, monkeypatch):
    executed(path, tmp_path, monkeypatch)


def test_a_cluster_accounts_for_a_thousand_scans_and_a_worker_that_dies(tmp_path, monkeypatch):
    executed(FOLDER / "many_scans.py", tmp_path, monkeypatch)


def executed(path, tmp_path, monkeypatch):
    jupytext = pytest.importorskip("jupytext")
    nbclient = pytest.importorskip("nbclient")
    # The kernel is a process of its own.
    monkeypatch.setenv("FAIRMESH_PICTURES", str(tmp_path))
    notebook = jupytext.read(path)
    assert sum(cell.cell_type == "code" for cell in notebook.cells) >= 4
    client = nbclient.NotebookClient(
        notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": FOLDER}}
    )
    client.execute()
    made = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.execution_count for cell in made)
    assert "image/png" in made[-1].outputs[-1]["data"] and (tmp_path / f"{path.stem}.png").exists()

"""The page of all names is built without a warning, and has them all."""

import html
import re
import subprocess
import sys
from pathlib import Path

import fairmesh

PROJECT = Path(__file__).resolve().parents[1]


def test_the_page(tmp_path):
    subprocess.run([sys.executable, PROJECT / "build_api.py", tmp_path], check=True)
    page = (tmp_path / "fairmesh.html").read_text(encoding="utf-8")
    for name in fairmesh.__all__:
        assert f'id="{name}"' in page, name
    text = " ".join(html.unescape(re.sub(r"<[^>]+>", "", page)).split())
    assert "inner_fairness: Literal['uniform', 'conformal', 'convex'] = 'uniform'" in text
    assert "tolerance: float = 1e-08" in text and "_SupportsArray" not in text and "_arrays" not in text

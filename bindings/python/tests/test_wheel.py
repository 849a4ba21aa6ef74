"""The wheel: what is in it, where it runs, and that the repository can be installed."""

import json
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import fairmesh

PROJECT = Path(__file__).resolve().parents[1]
ROOT = PROJECT.parents[1]
WHEEL = Path(os.environ["FAIRMESH_TEST_WHEEL"])


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """The library in the wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    with zipfile.ZipFile(WHEEL) as archive:
        return Path(archive.extract("fairmesh/lib/libfairmesh.so", folder))


def test_the_tests_run_against_the_wheel(library):
    installed = Path(fairmesh.load().path)
    assert installed.parts[-3:] == ("fairmesh", "lib", "libfairmesh.so") and "site-packages" in installed.parts
    assert installed.read_bytes() == library.read_bytes()


def test_its_name_and_contents():
    version = re.search(r'^version = "(.*)"', (ROOT / "Cargo.toml").read_text(), re.M).group(1)
    assert WHEEL.name == f"fairmesh-{version}-py3-none-manylinux_2_28_x86_64.whl"
    with zipfile.ZipFile(WHEEL) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
        metadata = archive.read(f"fairmesh-{version}.dist-info/METADATA").decode()
        tags = archive.read(f"fairmesh-{version}.dist-info/WHEEL").decode()
    sources = {f"fairmesh/{path.name}" for path in (PROJECT / "src" / "fairmesh").glob("*.py")}
    assert "fairmesh/__init__.py" in sources
    others = {"libfairmesh.so", "LICENSE-MIT", "LICENSE-APACHE"}
    assert names == sources | {"fairmesh/py.typed"} | {f"fairmesh/lib/{name}" for name in others}
    assert "Requires-Dist: numpy>=1.21\n" in metadata and "Requires-Python: >=3.9\n" in metadata
    assert "Root-Is-Purelib: false\n" in tags


def test_it_shows_the_interface_only(library):
    """That it fits its platform and is stripped is checked when it is built."""
    shown = [line.split()[-1] for line in output("nm", "-D", "--defined-only", library).splitlines()]
    assert sorted(shown) == sorted(fairmesh._abi.FUNCTIONS)
    assert library.stat().st_size < 8e6


def test_auditwheel_agrees():
    said = " ".join(output(sys.executable, "-m", "auditwheel", "show", WHEEL).split())
    assert 'is consistent with the following platform tag: "manylinux_2_28_x86_64"' in said, said


INSTALLED = """
import sys
sys.path.insert(0, sys.argv[1])
import numpy as np, fairmesh
vertices = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], float)
result = fairmesh.fair(vertices, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])
print(result.report.free_vertices, fairmesh.load().path)
"""


def test_the_repository_can_be_installed(tmp_path):
    """``pip install ./bindings/python``: plain cargo, a wheel for this machine."""
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "-q", "--no-deps"]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("FAIRMESH_")}
    subprocess.run([*pip, "--target", tmp_path, PROJECT], check=True, env=environment)
    (tags,) = tmp_path.glob("fairmesh-*.dist-info/WHEEL")
    assert "Tag: py3-none-linux_x86_64\n" in tags.read_text()
    said = output(sys.executable, "-c", INSTALLED, tmp_path, env=environment)
    assert said == f"1 {tmp_path}/fairmesh/lib/libfairmesh.so\n"


def test_a_source_distribution_has_what_is_compiled_alone(tmp_path):
    """Cargo takes its manifests as they are, with the versions of the repository."""
    folder = tmp_path / "rust"
    subprocess.run([sys.executable, PROJECT / "rust_sources.py", folder], check=True)
    told = json.loads(output("cargo", "metadata", "--format-version", "1", "--locked", cwd=folder))
    crates = {package["name"] for package in told["packages"]}
    assert "fairmesh-capi" in crates and not crates & {"fairmesh-cli", "fairmesh-shapes", "proptest"}
    files = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert {"Cargo.lock", "src/lib.rs", "src/linear/lib.rs", "src/capi/lib.rs"} <= files
    assert not any(name.startswith(("src/cli/", "src/shapes/", "tests/")) for name in files)
    here = set(re.findall(r"^name = .*\nversion = .*", (ROOT / "Cargo.lock").read_text(), re.M))
    assert set(re.findall(r"^name = .*\nversion = .*", (folder / "Cargo.lock").read_text(), re.M)) < here

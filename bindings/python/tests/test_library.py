"""Finding the shared library, and refusing a wrong one."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import fairmesh
from fairmesh import _library

PACKAGE = Path(fairmesh.__file__).parent
NAME = _library.file_name()


def compiled(folder, code):
    source = folder / "fake.c"
    source.write_text(code)
    library = folder / NAME
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source], check=True)
    return library


def version_function(major, minor, patch):
    return f"unsigned fairmesh_version(void) {{ return {major}u << 16 | {minor}u << 8 | {patch}u; }}\n"


@pytest.fixture
def keep_loaded(monkeypatch):
    """The library in use is the same after the test."""
    monkeypatch.setattr(_library, "_loaded", _library._loaded)


def python(code, *, package, **environment):
    """Runs a program with another copy of the package, and with no library from elsewhere."""
    cleared = {key: value for key, value in os.environ.items() if key not in ("FAIRMESH_LIBRARY", "PYTHONPATH")}
    program = f"import sys; sys.path.insert(0, {str(package.parent)!r})\n{code}"
    command = [sys.executable, "-c", program]
    run = subprocess.run(command, env={**cleared, **environment}, capture_output=True, text=True, timeout=60)
    assert run.returncode == 0, run.stderr
    return run.stdout.strip()


@pytest.fixture
def vendored(tmp_path):
    """The package as a subpackage of another, without a library."""
    outer = tmp_path / "outer"
    outer.mkdir()
    (outer / "__init__.py").touch()
    shutil.copytree(PACKAGE, outer / "fairmesh", ignore=shutil.ignore_patterns("lib", "__pycache__"))
    return outer


MISSING = """
from outer import fairmesh
try:
    fairmesh.mean_curvature([[0, 0, 0]], [])
except fairmesh.LibraryError as error:
    print(isinstance(error, OSError), error)
"""


def test_a_missing_library_says_where_it_was_looked_for(vendored):
    beside = vendored.resolve() / "fairmesh" / "lib" / NAME
    assert python(MISSING, package=vendored) == (
        "True the fairmesh library was not found: FAIRMESH_LIBRARY is not set, "
        f"there is no {beside}, and the system has no library fairmesh"
    )


def test_a_library_that_the_environment_names_wrongly(vendored):
    said = python(MISSING, package=vendored, FAIRMESH_LIBRARY="/nowhere/libfairmesh.so")
    assert said.startswith("True cannot load the fairmesh library /nowhere/libfairmesh.so: ")


def test_vendored_as_a_subpackage(vendored):
    library = Path(fairmesh.load().path)
    code = "from outer import fairmesh\nprint(fairmesh.load().path, fairmesh.version())"
    assert python(code, package=vendored, FAIRMESH_LIBRARY=str(library)) == f"{library} {fairmesh.__version__}"
    (vendored / "fairmesh" / "lib").mkdir()
    beside = vendored / "fairmesh" / "lib" / NAME
    shutil.copy(library, beside)
    assert python(code, package=vendored) == f"{beside.resolve()} {fairmesh.__version__}"
    # The environment comes first.
    assert python(code, package=vendored, FAIRMESH_LIBRARY=str(library)).startswith(f"{library} ")


MAJOR, MINOR, PATCH = (int(number) for number in fairmesh.__version__.split("."))


# Before 1.0 every minor version is another one.
@pytest.mark.parametrize("version", [(9, 0, 0), (MAJOR + 1, MINOR, 0)] + [(0, MINOR + 1, 0)] * (MAJOR == 0))
@pytest.mark.usefixtures("keep_loaded")
def test_another_version_is_refused(tmp_path, version):
    library = compiled(tmp_path, version_function(*version))
    with pytest.raises(fairmesh.LibraryError) as error:
        fairmesh.load(library)
    number = ".".join(map(str, version))
    assert str(error.value) == f"the fairmesh library {library} has version {number}, but {MAJOR}.{MINOR} is needed"


@pytest.mark.usefixtures("keep_loaded")
def test_a_library_without_a_function_is_refused(tmp_path):
    library = compiled(tmp_path, version_function(MAJOR, MINOR, PATCH + 7))
    with pytest.raises(fairmesh.LibraryError) as error:
        fairmesh.load(library)
    assert str(error.value).startswith(f"{library} is no fairmesh library: it has no function fairmesh_")


@pytest.mark.usefixtures("keep_loaded")
def test_something_else_is_refused(tmp_path):
    other = compiled(tmp_path, "int something_else;\n")
    with pytest.raises(fairmesh.LibraryError, match=r"it has no function fairmesh_version$"):
        fairmesh.load(other)
    text = tmp_path / "text.so"
    text.write_text("no library")
    with pytest.raises(fairmesh.LibraryError) as error:
        fairmesh.load(text)
    assert str(error.value).startswith(f"cannot load the fairmesh library {text}: ")


def test_a_refused_library_does_not_replace_the_one_in_use(tmp_path):
    before = fairmesh.load()
    with pytest.raises(fairmesh.LibraryError):
        fairmesh.load(tmp_path / "nothing.so")
    assert fairmesh.load() is before
    assert before.version == fairmesh.version() and Path(before.path).exists()
    assert before.path in repr(before)


@pytest.mark.usefixtures("keep_loaded")
def test_a_later_patch_is_taken(tmp_path):
    functions = "".join(f"void {name}(void) {{}}\n" for name in fairmesh._abi.FUNCTIONS if name != "fairmesh_version")
    library = compiled(tmp_path, version_function(MAJOR, MINOR, PATCH + 7) + functions)
    assert fairmesh.load(library).version == f"{MAJOR}.{MINOR}.{PATCH + 7}"
    assert fairmesh.load() is fairmesh.load()


def test_names_on_other_systems(monkeypatch):
    for platform, name in (("win32", "fairmesh.dll"), ("darwin", "libfairmesh.dylib"), ("linux", "libfairmesh.so")):
        monkeypatch.setattr(sys, "platform", platform)
        assert _library.file_name() == name

"""The words of the command line and of Python agree: whoever knows one finds the other."""

import inspect
import os
import re
import subprocess

import pytest

import fairmesh
from fairmesh import _calls

PROGRAM = os.environ["FAIRMESH_TEST_PROGRAM"]
#: What only one of them has: callbacks, arrays in place of files, and the surface of patches.
OF_PROGRAMS = {"mesh", "progress", "cancel", "output_precision", "fixed", "fair"}
OF_PATCHES = {"boundary_normals", "discretization", "inner_fairness", "interior_normals", "target"}
OF_BRIDGES = OF_PATCHES | {"boundary_curvature", "continuity", "loop_continuity", "on_failure"}


def flags(command):
    page = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True, check=True).stdout
    return {name.replace("-", "_") for name in re.findall(r"--([a-z][a-z-]+)", page)}


@pytest.mark.parametrize(
    ("command", "function", "not_there"),
    [
        ("fair", fairmesh.fair, set()),
        ("fill", fairmesh.fill_holes, OF_PATCHES),
        ("bridge", fairmesh.bridge, OF_BRIDGES),
    ],
)
def test_an_option_of_python_is_a_flag(command, function, not_there):
    options = set(inspect.signature(function).parameters) - OF_PROGRAMS
    assert options - flags(command) == not_there


@pytest.mark.parametrize(
    ("flag", "option", "function"),
    [
        ("normals", "boundary_normals", fairmesh.fair),
        ("continuity_at", "loop_continuity", fairmesh.fair),
        ("loop", "loops", fairmesh.fill_holes),
        ("guide", "guides", fairmesh.fill_holes),
        ("component", "of_components", fairmesh.fill_holes),
        ("no_fair", "fair", fairmesh.fill_holes),
        ("to", "end", fairmesh.bridge),
    ],
)
def test_a_flag_is_known_in_python(flag, option, function):
    assert f"did you mean {option!r}?" in _calls.did_you_mean(flag, inspect.signature(function).parameters)

"""The declarations in `_abi` are those of fairmesh.h, and lie in memory as a C compiler lays them."""

import ctypes
import inspect
import re
import subprocess
from pathlib import Path

import pytest

import fairmesh
from fairmesh import _abi, _schema
from fairmesh._keywords import DEFAULTS
from fairmesh._options import initial

INCLUDE = Path(__file__).resolve().parents[3] / "include"
HEADER = re.sub(r"/\*.*?\*/", "", (INCLUDE / "fairmesh.h").read_text(), flags=re.S)


def declared(kind):
    """The classes of `_abi` that are of a kind."""
    return {
        name: value
        for name, value in vars(_abi).items()
        if name.startswith("fairmesh_") and isinstance(value, type) and issubclass(value, kind)
    }


def test_nothing_is_missing():
    assert set(declared(ctypes.Structure)) == set(re.findall(r"typedef struct (\w+) \{", HEADER))
    assert set(declared(_abi.enum.IntEnum)) == set(re.findall(r"enum (fairmesh_\w+)\n#if", HEADER))
    assert set(_abi.FUNCTIONS) == set(re.findall(r"^FAIRMESH_API[^;(]*?(fairmesh_\w+)\(", HEADER, re.M))


def test_the_callback():
    assert re.search(r"int32_t \(\*fairmesh_progress_fn\)\(const struct fairmesh_progress \*\w+, void \*\w+\)", HEADER)
    callback = _abi.fairmesh_progress_fn
    assert callback._restype_ is ctypes.c_int32
    assert callback._argtypes_ == (ctypes.POINTER(_abi.fairmesh_progress), ctypes.c_void_p)


def test_versions():
    numbers = dict(re.findall(r"#define FAIRMESH_VERSION_(\w+) (\d+)", HEADER))
    assert numbers == {
        "MAJOR": str(_abi.VERSION_MAJOR),
        "MINOR": str(_abi.VERSION_MINOR),
        "PATCH": str(_abi.VERSION_PATCH),
    }
    assert fairmesh.__version__ == fairmesh.version() == ".".join(numbers[part] for part in ("MAJOR", "MINOR", "PATCH"))


def test_layout_is_the_compilers(tmp_path):
    lines, expected = [], []
    for struct, made in declared(ctypes.Structure).items():
        lines.append(f'printf("{struct} %zu\\n", sizeof(struct {struct}));')
        expected.append(f"{struct} {ctypes.sizeof(made)}")
        for field, *_ in made._fields_:
            size = f"sizeof ((struct {struct} *)0)->{field}"
            lines.append(f'printf("{struct}.{field} %zu %zu\\n", offsetof(struct {struct}, {field}), {size});')
            place = getattr(made, field)
            expected.append(f"{struct}.{field} {place.offset} {place.size}")
    lines.append('printf("%llu\\n", (unsigned long long)FAIRMESH_NO_ELEMENT);')
    expected.append(str(_abi.NO_ELEMENT))
    source = tmp_path / "layout.c"
    source.write_text("#include <fairmesh.h>\n#include <stdio.h>\nint main(void) {\n" + "\n".join(lines) + "\n}\n")
    subprocess.run(["cc", "-I", INCLUDE, "-o", tmp_path / "layout", source], check=True)
    printed = subprocess.run([tmp_path / "layout"], check=True, capture_output=True, text=True).stdout
    assert printed.splitlines() == expected
    assert len(expected) > 130


TOLD = (
    (fairmesh.Outcome, "outcome"),
    (fairmesh.LooseReason, "loose_reason"),
    (fairmesh.AttemptEnd, "attempt_end"),
    (fairmesh.FillOutcome, "fill_outcome"),
    (fairmesh.FillReason, "fill_reason"),
    (fairmesh.LoopKind, "loop_kind"),
    (fairmesh.SharpFate, "sharp_fate"),
    (fairmesh.Status, "status"),
)


@pytest.mark.parametrize(("public", "name"), TOLD)
def test_texts_are_those_of_the_library(public, name):
    def ask(number, text):
        return fairmesh.load().fairmesh_describe(_abi.fairmesh_answer[name.upper()], number, text)

    members = [member for member in public if member.name != "OTHER"]
    numbers = getattr(_abi, f"fairmesh_{name}")
    assert [member.name for member in members] == [member.name for member in numbers]
    for member in members:
        number = numbers[member.name]
        assert ask(number, _abi.fairmesh_text.NAME).decode() == member.name.lower()
        assert ask(number, _abi.fairmesh_text.MEANING).decode() == member.text
        assert ask(number, _abi.fairmesh_text.REMEDY).decode() == member.remedy
    assert ask(999, _abi.fairmesh_text.NAME) == b"unknown"
    assert public is fairmesh.Status or public.of(999) is public.OTHER


def test_element_kinds_are_those_of_the_library():
    assert [member.name for member in fairmesh.ElementKind] == [member.name for member in _abi.fairmesh_element]


@pytest.mark.parametrize("struct", _schema.KINDS)
def test_default_options(struct):
    """What the package states is what the library has."""
    found = initial(getattr(_abi, struct))
    for name, kind in _schema.KINDS[struct].items():
        how, _, of = kind.partition(" ")
        value = getattr(found, name)
        if how == "choice":
            value = getattr(_abi, of)(value).name.lower()
        elif hasattr(value, "kind"):
            value = getattr(_abi, f"fairmesh_{name}_kind")(value.kind).name.lower()
        elif name == "loop_continuity":
            value = dict.fromkeys(range(value.vertices.count))
        elif how in ("indices", "pairs"):
            value = value.data
        # None: that of the vertices, or what the library takes 0 for.
        assert DEFAULTS[name] == value or (DEFAULTS[name] is None and value in ("double", 0.0)), name
    if hasattr(found, "join"):
        assert (DEFAULTS["join"], found.join.kind) == ("none", _abi.fairmesh_join_kind.NONE)


def test_defaults_are_those_of_no_option():
    from meshes import dented_sphere, sphere_with_hole

    vertices, faces, free, _ = dented_sphere()
    plain = fairmesh.fair(vertices, faces, free=free)
    asked = fairmesh.fair(vertices, faces, free=free, **fairmesh.default_options())
    nones = fairmesh.fair(vertices, faces, free=free, **dict.fromkeys(fairmesh.FairingOptions.__annotations__))
    assert plain.vertices.tobytes() == asked.vertices.tobytes() == nones.vertices.tobytes()
    mesh = sphere_with_hole()
    options = fairmesh.default_fill_options()
    assert fairmesh.fill_holes(*mesh, **options).vertices.tobytes() == fairmesh.fill_holes(*mesh).vertices.tobytes()


def test_signatures_show_the_options_with_their_types_and_defaults():
    shown = inspect.signature(fairmesh.fair).parameters
    defaults = fairmesh.default_options()
    assert {name: shown[name].default for name in defaults} == defaults
    assert str(shown["inner_fairness"]) == "inner_fairness: Literal['uniform', 'conformal', 'convex'] = 'uniform'"
    assert str(shown["tolerance"]) == "tolerance: float = 1e-08"
    filling = inspect.signature(fairmesh.fill_holes).parameters
    for name, value in {**fairmesh.default_fill_options(), **defaults}.items():
        assert filling[name].default == value, name
    assert inspect.signature(fairmesh.remesh).parameters["density"].default == 2**0.5
    for name in fairmesh.__all__:
        function = getattr(fairmesh, name)
        if inspect.isfunction(function):
            assert not any(p.kind is p.VAR_KEYWORD for p in inspect.signature(function).parameters.values()), name

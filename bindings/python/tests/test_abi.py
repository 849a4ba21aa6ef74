"""The declarations in `_abi` are those of fairmesh.h, and lie in memory as a C compiler lays them."""

import ctypes
import re
import subprocess
from pathlib import Path

import pytest

import fairmesh
from fairmesh import _abi

INCLUDE = Path(__file__).resolve().parents[3] / "include"
HEADER = re.sub(r"/\*.*?\*/", "", (INCLUDE / "fairmesh.h").read_text(), flags=re.S)
STRUCTS = dict(re.findall(r"typedef struct (\w+) \{(.*?)\n\} \1;", HEADER, re.S))
ENUMS = dict(re.findall(r"enum (fairmesh_\w+)\n#if.*?\{\n(.*?)\n\};", HEADER, re.S))
PROTOTYPE = r"^(?:FAIRMESH_API\s+)((?:const char \*|fairmesh_status |uint32_t ))\s*(fairmesh_\w+)\(([^;]*?)\);"
FUNCTIONS = {name: (result.strip(), parameters) for result, name, parameters in re.findall(PROTOTYPE, HEADER, re.M)}

PLAIN = {
    "uint32_t": ctypes.c_uint32,
    "int32_t": ctypes.c_int32,
    "uint64_t": ctypes.c_uint64,
    "size_t": ctypes.c_size_t,
    "double": ctypes.c_double,
    "fairmesh_status": ctypes.c_int32,
    "fairmesh_progress_fn": _abi.fairmesh_progress_fn,
}
HANDLES = ("fairmesh_result", "fairmesh_solver")


def declared(kind):
    """The classes of `_abi` that are of a kind."""
    return {
        name: value
        for name, value in vars(_abi).items()
        if name.startswith("fairmesh_") and isinstance(value, type) and issubclass(value, kind)
    }


def c_type(text, in_struct):
    """What a type of the header is in ctypes."""
    text = " ".join(text.replace("const ", "").replace("struct ", "").split())
    base, stars = re.fullmatch(r"(\w+) ?(\**)", text).groups()
    if not stars:
        return PLAIN.get(base) or getattr(_abi, base)
    if base == "char":
        return ctypes.c_char_p
    if base in HANDLES:
        return ctypes.c_void_p if stars == "*" else ctypes.POINTER(ctypes.c_void_p)
    if base == "void" or in_struct or base == "uint32_t":  # arrays: their address
        return ctypes.c_void_p
    return ctypes.POINTER(PLAIN.get(base) or getattr(_abi, base))


def fields(body):
    """The fields of a struct in the header: names and ctypes."""
    for line in filter(None, (line.strip() for line in body.split(";"))):
        kind, name, length = re.fullmatch(r"(.*?)(\w+)(?:\[(\d+)\])?", line, re.S).groups()
        if length:
            yield name, {"double": ctypes.c_double, "char": ctypes.c_char}[kind.strip()] * int(length)
        else:
            yield name, c_type(kind.strip(), in_struct=True)


def test_the_header_was_read():
    assert len(STRUCTS) == 19 and len(ENUMS) == 19 and len(FUNCTIONS) == 32
    assert HEADER.count("FAIRMESH_API") == 2 + len(FUNCTIONS)  # 2: its own definition


def test_nothing_is_missing():
    assert set(declared(ctypes.Structure)) == set(STRUCTS)
    assert set(declared(_abi.enum.IntEnum)) == set(ENUMS)
    assert set(_abi.FUNCTIONS) == set(FUNCTIONS)


@pytest.mark.parametrize("name", STRUCTS)
def test_fields(name):
    assert list(getattr(_abi, name)._fields_) == list(fields(STRUCTS[name]))


@pytest.mark.parametrize("name", ENUMS)
def test_enumerations(name):
    prefix = f"{name.upper()}_"
    numbers = {key: int(value) for key, value in re.findall(r"(FAIRMESH_\w+) = (\d+),", ENUMS[name])}
    assert numbers == {prefix + member.name: member.value for member in getattr(_abi, name)}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions(name):
    result, text = FUNCTIONS[name]
    texts = [re.sub(r"(\w+)$", "", each.strip()) for each in text.split(",") if each.strip() != "void"]
    parameters = tuple(c_type(each.strip(), in_struct=False) for each in texts)
    assert _abi.FUNCTIONS[name] == (c_type(result, in_struct=False), parameters)


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


def test_public_enumerations_have_all_members():
    pairs = (
        (fairmesh.Outcome, _abi.fairmesh_outcome),
        (fairmesh.LoopKind, _abi.fairmesh_loop_kind),
        (fairmesh.FillOutcome, _abi.fairmesh_fill_outcome),
        (fairmesh.FillReason, _abi.fairmesh_fill_reason),
        (fairmesh.ElementKind, _abi.fairmesh_element),
    )
    for public, numbers in pairs:
        assert [member.name for member in public] == [member.name for member in numbers]
        assert [member.value for member in public] == [member.name.lower() for member in numbers]
    for member in set(_abi.fairmesh_outcome) - {_abi.fairmesh_outcome.OTHER}:
        name = fairmesh.load().fairmesh_outcome_name(member).decode()
        assert name.replace(" ", "_") == fairmesh.Outcome[member.name]
    for member in fairmesh.Status:
        name = fairmesh.load().fairmesh_status_name(member).decode()
        assert name.replace(" ", "_").replace("-", "_").upper() == member.name


def test_default_options():
    documented = fairmesh.FairingOptions.__doc__
    defaults = fairmesh.default_options()
    assert list(defaults) == list(fairmesh.FairingOptions.__annotations__)
    for name, value in defaults.items():
        text = re.search(rf"^ +{name}: (.*?)(?=^ +\w+: |\Z)", documented, re.M | re.S).group(1)
        shown = {"inf": "infinite", "1e-08": "1e-8", "1e-06": "1e-6"}.get(str(value), str(value))
        stated = re.search(r"(\S+) \(default\)", text) or re.search(r"Default:? (\S+?)[;.]*( |$)", text, re.M)
        assert stated and stated.group(1).strip('";:') == shown, (name, value, text)
    assert fairmesh.default_fill_options() == {
        "fair": True,
        "max_edges": None,
        "density": 2**0.5,
        "max_new_vertices": 200000,
    }
    assert fairmesh.default_remesh_options() == {"density": 2**0.5, "max_vertices": 200000}


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

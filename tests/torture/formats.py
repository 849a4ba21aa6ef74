"""Reads and writes PLY, OBJ, OFF and STL strictly, and tells where in a file the coordinates of each vertex stand.

Nothing here comes from fairmesh: it is the second opinion on what a file says.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

# What each format can hold; the name before the first hyphen is the file's ending.
FORMATS = [
    "ply-ascii-float",
    "ply-ascii-double",
    "ply-binary-float",
    "ply-binary-double",
    "obj",
    "off",
    "stl-ascii",
    "stl-binary",
]
SCALARS = {
    "char": "i1",
    "int8": "i1",
    "uchar": "u1",
    "uint8": "u1",
    "short": "i2",
    "int16": "i2",
    "ushort": "u2",
    "uint16": "u2",
    "int": "i4",
    "int32": "i4",
    "uint": "u4",
    "uint32": "u4",
    "float": "f4",
    "float32": "f4",
    "double": "f8",
    "float64": "f8",
}
NUMBER = re.compile(rb"[^\s]+")


class UnreadableError(Exception):
    """The file does not say what it should."""


@dataclass
class File:
    """Positions in the numbers of the file, polygons, and per vertex the byte ranges that hold its coordinates.

    `facet_spans` are the ranges of the facet normals of an STL, one per polygon.
    """

    points: np.ndarray
    polygons: list[tuple[int, ...]]
    spans: list[list[tuple[int, int]]] = field(default_factory=list)
    facet_spans: list[tuple[int, int]] = field(default_factory=list)
    single: bool = False

    def triangles(self) -> np.ndarray:
        """Every polygon as a fan."""
        rows = [(p[0], p[i], p[i + 1]) for p in self.polygons for i in range(1, len(p) - 1)]
        return np.array(rows, dtype=np.int64).reshape(-1, 3)


def ending(name: str) -> str:
    return "." + name.split("-", maxsplit=1)[0]


def is_single(name: str) -> bool:
    return name.startswith("stl") or name.endswith("float")


def read(path: Path) -> File:
    data = path.read_bytes()
    reader = {".ply": read_ply, ".obj": read_obj, ".off": read_off, ".stl": read_stl}[path.suffix.lower()]
    try:
        file = fast(path.suffix.lower(), data) or reader(data)
    except (ValueError, IndexError, OverflowError, KeyError, UnicodeDecodeError, MemoryError) as error:
        raise UnreadableError(str(error)) from error
    corners = [v for polygon in file.polygons for v in polygon]
    if corners and not 0 <= min(corners) <= max(corners) < len(file.points):
        raise UnreadableError("a face names a vertex that does not exist")
    return file


def as_points(rows: list) -> np.ndarray:
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def words(line: bytes, at: int) -> list[tuple[bytes, int, int]]:
    """The words of a line up to a comment, with their places in the file."""
    line = line.split(b"#", 1)[0]
    return [(m.group(), at + m.start(), at + m.end()) for m in NUMBER.finditer(line)]


def lines(data: bytes, at: int = 0) -> list[tuple[bytes, int]]:
    found = []
    for line in data[at:].split(b"\n"):
        found.append((line, at))
        at += len(line) + 1
    return found


def three(row: list[tuple[bytes, int, int]]) -> tuple[list[float], list[tuple[int, int]]]:
    return [float(w[0]) for w in row[:3]], [(row[0][1], row[2][2])]


def read_off(data: bytes) -> File:
    rows = [w for w in (words(*line) for line in lines(data)) if w]
    head = rows.pop(0)
    if not re.fullmatch(rb"(ST)?C?N?OFF", head[0][0]):
        raise UnreadableError("no OFF header")
    counts = head[1:] or rows.pop(0)
    n, m = int(counts[0][0]), int(counts[1][0])
    if n < 0 or m < 0 or len(rows) < n + m:
        raise UnreadableError("fewer lines than the header says")
    both = [three(row) for row in rows[:n]]
    polygons = []
    for row in rows[n : n + m]:
        corners = int(row[0][0])
        if corners < 0 or len(row) < corners + 1:
            raise UnreadableError("a face has fewer corners than it says")
        polygons.append(tuple(int(w[0]) for w in row[1 : corners + 1]))
    return File(as_points([p for p, _ in both]), polygons, [s for _, s in both])


def read_obj(data: bytes) -> File:
    points, spans, polygons = [], [], []
    for line, at in lines(data):
        row = words(line, at)
        if row and row[0][0] == b"v":
            if len(row) < 4:
                raise UnreadableError("a vertex has fewer than three coordinates")
            p, span = three(row[1:])
            points.append(p)
            spans.append(span)
        elif row and row[0][0] == b"f":
            corners = [int(w[0].split(b"/")[0]) for w in row[1:]]
            if 0 in corners:
                raise UnreadableError("vertex 0 in an OBJ")
            polygons.append(tuple(c - 1 if c > 0 else len(points) + c for c in corners))
    return File(as_points(points), polygons, spans)


def ply_header(data: bytes) -> tuple[str, list, int]:
    end = re.search(rb"(?m)^end_header\r?\n", data)
    if not data.startswith(b"ply") or end is None:
        raise UnreadableError("no PLY header")
    kind, elements = "", []
    for line in data[: end.start()].decode("ascii").splitlines()[1:]:
        row = line.split()
        if row and row[0] == "format":
            kind = row[1]
        elif row and row[0] == "element":
            elements.append((row[1], int(row[2]), []))
        elif row and row[0] == "property":
            elements[-1][2].append(row[1:])
        elif row and row[0] not in ("comment", "obj_info"):
            raise UnreadableError(f"PLY header: {line}")
    if kind not in ("ascii", "binary_little_endian", "binary_big_endian"):
        raise UnreadableError("PLY format")
    return kind, elements, end.end()


def read_ply(data: bytes) -> File:
    kind, elements, at = ply_header(data)
    points, spans, polygons, single = [], [], [], False
    # One cursor over words or over bytes.
    take = ascii_cursor(data, at) if kind == "ascii" else binary_cursor(data, at, kind.endswith("big_endian"))
    if any(count < 0 or count > len(data) for _, count, _ in elements):
        raise UnreadableError("more elements than bytes")
    for name, count, properties in elements:
        names = [p[-1] for p in properties]
        if name == "vertex":
            single = properties[names.index("x")][0] in ("float", "float32")
        for _ in range(count):
            values, places = {}, {}
            for p in properties:
                if p[0] == "list":
                    length = int(take(SCALARS[p[1]])[0])
                    if length < 0 or length > len(data):
                        raise UnreadableError("a list is longer than the file")
                    values[p[-1]] = [take(SCALARS[p[2]])[0] for _ in range(length)]
                else:
                    value, start, end = take(SCALARS[p[0]])
                    values[p[-1]], places[p[-1]] = value, (start, end)
            if name == "vertex":
                points.append([values["x"], values["y"], values["z"]])
                spans.append(joined([places["x"], places["y"], places["z"]], kind))
            elif name == "face":
                corners = values["vertex_indices"] if "vertex_indices" in values else values["vertex_index"]
                polygons.append(tuple(int(c) for c in corners))
    file = File(as_points(points), polygons, spans, single=single)
    if single and kind == "ascii":
        with np.errstate(over="ignore"):
            file.points = file.points.astype(np.float32).astype(np.float64)
    return file


def joined(places: list[tuple[int, int]], kind: str) -> list[tuple[int, int]]:
    """Of text, with the blanks between the coordinates."""
    return [(places[0][0], places[2][1])] if kind == "ascii" else places


def ascii_cursor(data: bytes, at: int):
    words_left = NUMBER.finditer(data, at)

    def take(scalar: str):
        word = next(words_left, None)
        if word is None:
            raise UnreadableError("the file ends too early")
        value = float(word.group()) if scalar[0] == "f" else int(word.group())
        return value, word.start(), word.end()

    return take


def binary_cursor(data: bytes, at: int, big: bool):
    import struct

    codes = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "f4": "f", "f8": "d"}
    forms = {k: struct.Struct((">" if big else "<") + c) for k, c in codes.items()}

    def take(scalar: str):
        nonlocal at
        form = forms[scalar]
        start = at
        at += form.size
        if at > len(data):
            raise UnreadableError("the file ends too early")
        return form.unpack_from(data, start)[0], start, at

    return take


def welded(corners: np.ndarray, spans: list[tuple[int, int]], facet_spans: list[tuple[int, int]]) -> File:
    """Corners with equal coordinates become one vertex, in the order of first appearance."""
    corners = corners.reshape(-1, 3).astype(np.float64) + 0.0
    if len(corners) == 0:
        return File(corners, [], [], facet_spans, single=True)
    _, first, inverse = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")
    index = np.argsort(order)[inverse.ravel()]
    at: list[list] = [[] for _ in first]
    for i, span in zip(index.tolist(), spans, strict=True):
        at[i].append(span)
    polygons = list(map(tuple, index.reshape(-1, 3).tolist()))
    return File(corners[first[order]], polygons, at, facet_spans, single=True)


STL_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("bytes", "<u2")])


def read_stl(data: bytes) -> File:
    if len(data) >= 84:
        count = int.from_bytes(data[80:84], "little")
        # Some programs write more behind the last facet.
        if count and len(data) >= 84 + 50 * count and (len(data) == 84 + 50 * count or not data.startswith(b"solid")):
            facets = np.frombuffer(data, STL_FACET, count, 84)
            starts = [84 + 50 * i for i in range(count)]
            corners = [(s + 12 * k, s + 12 * k + 12) for s in starts for k in (1, 2, 3)]
            return welded(facets["corners"], corners, [(s, s + 12) for s in starts])
    if not data.lstrip().startswith(b"solid"):
        raise UnreadableError("neither a binary nor an ASCII STL")
    corners, spans, normals = [], [], []
    for line, at in lines(data):
        row = [(m.group(), at + m.start(), at + m.end()) for m in NUMBER.finditer(line)]
        if row and row[0][0] == b"vertex":
            if len(row) != 4:
                raise UnreadableError("a vertex of an STL with other than three coordinates")
            p, span = three(row[1:])
            corners.append(p)
            spans.append(span[0])
        elif row and row[0][0] == b"facet" and len(row) >= 5:
            normals.append((row[2][1], row[4][2]))
    if len(corners) % 3 or not corners:
        raise UnreadableError("a facet of an STL with other than three corners")
    return welded(as_points(corners), spans, normals)


def fast(suffix: str, data: bytes) -> File | None:
    """The same for plain files of triangles, by whole arrays; None if the file is anything else."""
    reader = {".ply": fast_ply, ".off": fast_off, ".obj": fast_obj, ".stl": fast_stl}[suffix]
    try:
        return reader(data)
    except (ValueError, IndexError, UnreadableError):
        return None


def block(rows: list[bytes], width: int, scalar: type) -> np.ndarray:
    values = b" ".join(rows).split()
    if len(values) != width * len(rows):
        raise ValueError("rows of other widths")
    return np.array(values, dtype=scalar).reshape(-1, width)


def plain(rows: list[bytes], at: int, vertices: int, faces: int) -> File:
    """Rows of coordinates that begin at this byte, then rows '3 a b c'."""
    if len(rows) < vertices + faces or any(rows[vertices + faces :]):
        raise ValueError("more or fewer rows")
    corners = block(rows[vertices : vertices + faces], 4, np.int64)
    if (corners[:, 0] != 3).any():
        raise ValueError("no triangles")
    ends = at + np.cumsum([len(row) + 1 for row in rows[:vertices]])
    starts = [at, *ends.tolist()]
    spans = [[(starts[i], starts[i + 1] - 1)] for i in range(vertices)]
    points = block(rows[:vertices], 3, np.float64)
    return File(points, list(map(tuple, corners[:, 1:].tolist())), spans)


def fast_off(data: bytes) -> File | None:
    head, counts, rest = data.split(b"\n", 2)
    if head != b"OFF":
        return None
    n, m, _ = (int(w) for w in counts.split())
    return plain(rest.split(b"\n"), len(data) - len(rest), n, m)


def fast_ply(data: bytes) -> File | None:
    kind, elements, at = ply_header(data)
    if [name for name, _, _ in elements] != ["vertex", "face"] or kind == "binary_big_endian":
        return None
    (_, n, vertex), (_, m, face) = elements
    if [p[-1] for p in vertex] != ["x", "y", "z"] or len(face) != 1 or len({p[0] for p in vertex}) != 1:
        return None
    scalar = SCALARS[vertex[0][0]]
    if kind == "ascii":
        file = plain(data[at:].split(b"\n"), at, n, m)
        file.single = scalar == "f4"
        file.points = file.points.astype(scalar).astype(np.float64)
        return file
    width = int(scalar[1]) * 3
    rows = np.dtype([("n", "<" + SCALARS[face[0][1]]), ("c", "<" + SCALARS[face[0][2]], 3)])
    if len(data) != at + n * width + m * rows.itemsize:
        return None
    points = np.frombuffer(data, "<" + scalar, 3 * n, at).reshape(-1, 3).astype(np.float64)
    faces = np.frombuffer(data, rows, m, at + n * width)
    if (faces["n"] != 3).any():
        return None
    third = width // 3
    places = [
        [(s, s + third), (s + third, s + 2 * third), (s + 2 * third, s + width)]
        for s in range(at, at + n * width, width)
    ]
    return File(points, list(map(tuple, faces["c"].tolist())), places, single=scalar == "f4")


def fast_obj(data: bytes) -> File | None:
    rows = data.split(b"\n")
    of = [row[:2] for row in rows]
    vertices = [i for i, kind in enumerate(of) if kind == b"v "]
    faces = [i for i, kind in enumerate(of) if kind == b"f "]
    if len(vertices) + len(faces) != sum(kind[:1] in (b"v", b"f") or b"#" in kind[1:] for kind in of) or b"/" in data:
        return None
    points = block([rows[i][2:] for i in vertices], 3, np.float64)
    corners = block([rows[i][2:] for i in faces], 3, np.int64) - 1
    if corners.min(initial=0) < 0:
        return None
    ends = np.cumsum([len(row) + 1 for row in rows])
    spans = [[(int(ends[i]) - 1 - len(rows[i]) + 2, int(ends[i]) - 1)] for i in vertices]
    return File(points, list(map(tuple, corners.tolist())), spans)


STL_ROW = rb"\s*facet normal (\S+ \S+ \S+)\s+outer loop" + 3 * rb"\s+vertex (\S+ \S+ \S+)" + rb"\s+endloop\s+endfacet"


def fast_stl(data: bytes) -> File | None:
    start = data.find(b"\n")
    end = data.rfind(b"endsolid")
    if not data.startswith(b"solid") or end < 0 or data[:start].count(b"facet"):
        return None
    corners, spans, normals, at = [], [], [], start
    for m in re.finditer(STL_ROW, data[:end]):
        if data[at : m.start()].strip():
            return None
        corners += [m.group(2), m.group(3), m.group(4)]
        spans += [m.span(2), m.span(3), m.span(4)]
        normals.append(m.span(1))
        at = m.end()
    if data[at:end].strip() or not normals:
        return None
    return welded(block(corners, 3, np.float64), spans, normals)


def write(path: Path, name: str, points: np.ndarray, triangles: np.ndarray) -> None:
    if is_single(name):
        points = points.astype(np.float32)
    kind = name.split("-", maxsplit=1)[0]
    {"ply": write_ply, "obj": write_obj, "off": write_off, "stl": write_stl}[kind](path, name, points, triangles)


def rows(points: np.ndarray, before: str = "") -> str:
    # As many digits as bring the same number back.
    form = "%.9g" if points.dtype == np.float32 else "%.17g"
    line = f"{before}{form} {form} {form}\n"
    return "".join([line % tuple(p) for p in points.tolist()])


def write_ply(path: Path, name: str, points: np.ndarray, triangles: np.ndarray) -> None:
    _, kind, scalar = name.split("-")
    head = f"ply\nformat {'ascii' if kind == 'ascii' else 'binary_little_endian'} 1.0\ncomment torture\n"
    head += f"element vertex {len(points)}\n" + "".join(f"property {scalar} {c}\n" for c in "xyz")
    head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    if kind == "ascii":
        path.write_text(head + rows(points) + "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles.tolist()))
        return
    faces = np.empty(len(triangles), np.dtype([("n", "u1"), ("c", "<i4", 3)]))
    faces["n"], faces["c"] = 3, triangles
    path.write_bytes(head.encode() + np.ascontiguousarray(points).tobytes() + faces.tobytes())


def write_obj(path: Path, _name: str, points: np.ndarray, triangles: np.ndarray) -> None:
    faces = "".join(f"f {a} {b} {c}\n" for a, b, c in (triangles + 1).tolist())
    path.write_text("# torture\n" + rows(points, "v ") + "g all\n" + faces)


def write_off(path: Path, _name: str, points: np.ndarray, triangles: np.ndarray) -> None:
    faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles.tolist())
    path.write_text(f"OFF\n{len(points)} {len(triangles)} 0\n" + rows(points) + faces)


def write_stl(path: Path, name: str, points: np.ndarray, triangles: np.ndarray) -> None:
    facets = np.zeros(len(triangles), STL_FACET)
    facets["corners"] = points[triangles]
    if name == "stl-binary":
        path.write_bytes(b"torture".ljust(80) + len(facets).to_bytes(4, "little") + facets.tobytes())
        return
    text = ["solid torture\n"]
    for corners in facets["corners"]:
        text.append("facet normal 0 0 0\nouter loop\n" + rows(corners, "vertex ") + "endloop\nendfacet\n")
    path.write_text("".join(text) + "endsolid torture\n")


def without(data: bytes, spans: list[tuple[int, int]]) -> bytes:
    """The bytes outside of these ranges."""
    kept, at = [], 0
    for start, end in sorted(spans):
        kept.append(data[at:start])
        at = end
    return b"\0".join([*kept, data[at:]])

"""Writes docs/gallery.md and its pictures: `gallery.py FAIRMESH`. gallery.sh builds the program and fetches the scans before.

The commands that the page shows are those that are run, and what it quotes is what they print. Everything else that is made goes to
target/gallery; of the scans nothing is kept in this repository but pictures.
"""

import math
import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "target/gallery"
PICTURES = ROOT / "docs/gallery"
# Lines of a report that the page quotes.
TOLD = ("converged", "loop", "  free vertices", "  iterations", "  continuity", "  distance", "  to the first", "  from the first")
# Bytes of a picture.
LARGEST = 200_000

Mesh = tuple[list[tuple[float, ...]], list[tuple[int, ...]]]


def write_obj(name: str, mesh: Mesh) -> None:
    """A mesh as an OBJ file."""
    vertices, faces = mesh
    lines = ["v " + " ".join(f"{x:.6f}" for x in vertex) for vertex in vertices]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in faces]
    (WORK / name).write_text("\n".join(lines) + "\n")


def tube(radius: float, start: float, axis: tuple[float, float], around: int = 40, rings: int = 16) -> Mesh:
    """An open tube in a direction of the plane y = 0, from a distance from the origin on."""
    (x, z), step = axis, 2 * math.pi * radius / around
    vertices = []
    for ring in range(rings):
        along = start + 0.9 * step * ring
        for k in range(around):
            angle = 2 * math.pi * (k + 0.5 * (ring % 2)) / around
            across, side = radius * math.cos(angle), radius * math.sin(angle)
            vertices.append((along * x + across * z, side, along * z - across * x))
    faces = []
    for ring in range(rings - 1):
        for k in range(around):
            here, beside = ring * around + k, ring * around + (k + 1) % around
            corners = (here, beside, here + around, beside + around)
            a, b, c, d = corners
            faces += [(a, b, c), (b, d, c)] if ring % 2 == 0 else [(a, b, d), (a, d, c)]
    return vertices, faces


def together(*meshes: Mesh) -> Mesh:
    """Several meshes as one."""
    vertices: list[tuple[float, ...]] = []
    faces: list[tuple[int, ...]] = []
    for some, others in meshes:
        faces += [tuple(v + len(vertices) for v in face) for face in others]
        vertices += some
    return vertices, faces


def read_columns(path: Path) -> list[tuple[float, ...]]:
    """Numbers in rows."""
    return [tuple(map(float, line.split())) for line in path.read_text().splitlines() if line.strip()]


def opened(mesh: Mesh, centre: tuple[float, ...], radius: float) -> Mesh:
    """A mesh without the faces whose corners are all in a ball."""
    vertices, faces = mesh
    inside = [math.dist(vertex, centre) < radius for vertex in vertices]
    return vertices, [face for face in faces if not all(inside[v] for v in face)]


def make_inputs(scans: Path) -> None:
    """The meshes that `fairmesh generate` does not make."""
    write_obj("tubes.obj", together(tube(0.5, 0.7, (0, 1)), tube(0.7, 0.6, (0.8, -0.6))))
    folder = scans / "tvb_data/surfaceData/outer_skull_4096"
    # They face inwards there. The piece is at the side, above the temple; the scan is in millimetres.
    corners = [tuple(map(int, reversed(face))) for face in read_columns(folder / "triangles.txt")]
    skull = (read_columns(folder / "vertices.txt"), corners)
    write_obj("skull.obj", skull)
    write_obj("open.obj", opened(skull, (62.0, 10.0, 40.0), 34.0))
    (WORK / "mannequin.off").write_bytes((scans / "data/meshes/mannequin-devil.off").read_bytes())


class Picture(NamedTuple):
    """Meshes beside each other: the picture's name, the files, their captions with bars between, and how they are shown."""

    name: str
    meshes: str
    captions: str
    look: str


class Page:
    """The page as it grows."""

    def __init__(self, program: str) -> None:
        """Begins with its head."""
        self.program = program
        self.text = HEAD

    def run(self, command: str) -> str:
        """Runs a command line of `fairmesh`; what it printed."""
        words = [self.program, *shlex.split(command)[1:]]
        ran = subprocess.run(words, cwd=WORK, capture_output=True, text=True, check=False)
        if ran.returncode != 0:
            sys.exit(f"{command}\n{ran.stdout}{ran.stderr}")
        return ran.stdout

    def entry(self, title: str, words: str, commands: list[str], picture: Picture) -> None:
        """A section: a picture of some meshes, the commands that made them, and what the last one said."""
        said = "".join(self.run(command) for command in commands).splitlines()
        shown = picture.captions.split("|")
        path = PICTURES / f"{picture.name}.png"
        captions = " ".join(f"--caption {shlex.quote(caption)}" for caption in shown)
        self.run(f"fairmesh render {picture.meshes} -o {shlex.quote(str(path))} {captions} {picture.look}")
        size = path.stat().st_size
        if size > LARGEST:
            sys.exit(f"{path.name} has {size} bytes")
        self.text += f"\n## {title}\n\n{words}\n\n![{title}: from left to right, {'; '.join(shown)}](gallery/{path.name})\n"
        for lines in (commands, [line for line in said if line.startswith(TOLD)]):
            self.text += "\n```console\n" + "\n".join(lines) + "\n```\n"


HEAD = """# Gallery

Results, and the commands that made them. The mesh before is left. The rows below show reflections of rings of light: a crease breaks these
lines, a jump of [curvature](glossary.md) kinks them. This page and its pictures are written by

```console
site/gallery.sh
```

The mannequin comes with Debian's `libcgal-demo`, the skull with `tvb-data` from PyPI (GPL 3). More pictures:
[the paper's figures](../REPRODUCTION.md), [continuous curvature](g2.md), the
[notebooks](../bindings/python/examples/gallery/README.md) of the Python package.
"""


def main(program: str, scans: Path) -> None:
    """Makes everything."""
    WORK.mkdir(parents=True, exist_ok=True)
    PICTURES.mkdir(exist_ok=True)
    make_inputs(scans)
    page = Page(program)
    both = "--shade flat,reflection"
    page.entry(
        "Three tubes, blended",
        "The paper's first example. The ends of three tubes are given, and the directions of the surface there; between them was noise.",
        [
            "fairmesh generate cylinder-blend --start noise --noise 0.4 -o rough.ply --free free.txt --normals normals.txt",
            "fairmesh fair rough.ply -o blend.ply --free free.txt --normals normals.txt",
        ],
        Picture("blend", "rough.ply blend.ply", "three tubes, roughly|blended", f"{both} --view 0.45,-0.75,0.8 --size 290x250"),
    )
    page.entry(
        "Two tubes, joined",
        "One patch for both loops, tangent to each tube.",
        ["fairmesh fill tubes.obj -o joined.obj --join 0,2"],
        Picture("tubes", "tubes.obj joined.obj", "two tubes|joined", f"{both} --view 0.2,-1,0.25 --size 340x300"),
    )
    page.entry(
        "A third eye and two horns, gone",
        "Erased, because their shape is of no use, and the hole filled. The forehead is smooth again, in the reflections, too.",
        [
            "fairmesh fill mannequin.off -o calm.off --erase --ball 0,-12,11.4,5.3 --ball -7,-8.5,16.5,4.6 --ball 7,-8.5,16.5,4.6",
        ],
        Picture("mannequin", "mannequin.off calm.off", "a mannequin|erased and filled", f"{both} --view 0.6,-1,0.15 --size 260x330"),
    )
    page.entry(
        "An ear, removed",
        "As in the paper's Figure 9: the faces in a ball around the ear stay, and only move.",
        ["fairmesh fair calm.off -o one-ear.off --ball 9.2,2.6,0.8,5.6"],
        Picture("ear", "calm.off one-ear.off", "with an ear|without", f"{both} --view 1,-0.25,0.1 --size 280x320"),
    )
    page.entry(
        "A skull, closed",
        "The outer surface of a skull, from a scan of a head; a piece nearly seven centimetres wide was cut out, and is filled.\n"
        "Colours are the distance from what was there, in millimetres.",
        [
            "fairmesh fill open.obj -o closed.obj",
            "fairmesh render skull.obj closed.obj -o distance.png --shade distance",
        ],
        Picture(
            "skull",
            "skull.obj open.obj closed.obj",
            "the skull|a piece cut out|closed",
            "--shade flat,distance --view 1,0.2,0.45 --size 240x220",
        ),
    )
    page.entry(
        "The tetra thing",
        "The paper's Figure 8: one closed surface through six circles on the edges of a tetrahedron, with the directions of tubes.",
        [
            "fairmesh generate tetra-thing --vertices 13308 --start noise --noise 0.5 -o thing.ply --free free.txt --normals normals.txt",
            "fairmesh fair thing.ply -o fair-thing.ply --free free.txt --normals normals.txt",
        ],
        Picture("tetra", "thing.ply fair-thing.ply", "noise around six circles|faired", f"{both} --size 230x230"),
    )
    page.entry(
        "The curvature of the surroundings, too",
        "A flattened cap of an ellipsoid is faired; colours are the curvature. With tangent planes alone (left) an edge shows around it;\n"
        "where it is certain it goes on, too (right).",
        [
            "fairmesh generate ellipsoid --vertices 4000 --triangulation irregular --start flat --outside 10 -o flat.ply --free cap.txt",
            "fairmesh fair flat.ply -o tangent.ply --free cap.txt --continuity g1",
            "fairmesh fair flat.ply -o curved.ply --free cap.txt",
        ],
        Picture(
            "continuity",
            "tangent.ply curved.ply",
            "tangent|curvature, too",
            "--shade curvature,reflection --view 0.3,-0.5,1 --size 320x300",
        ),
    )
    (ROOT / "docs/gallery.md").write_text(page.text)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))

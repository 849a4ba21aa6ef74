"""Writes the pictures of docs/guides/sharp-edges.md: `sharp_edges.py FAIRMESH MESHES`. gallery.sh calls it."""

import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "target/gallery"
PICTURES = ROOT / "docs/guides/sharp-edges"


class Region(NamedTuple):
    """A region of a part: the picture's name, the mesh, the vertex in the middle, and how far it reaches."""

    name: str
    part: str
    vertex: int
    radius: float


REGIONS = (
    Region("edge", "fandisk", 3742, 0.0565),
    Region("corner", "fandisk", 1450, 0.07),
    Region("edges", "fandisk", 2795, 0.126),
    Region("anchor", "anchor_dense", 539, 0.174),
    Region("anchor-rim", "anchor_dense", 675, 0.078),
    Region("cube-edge", "cube-meshed", 762, 0.506),
    Region("cube-corner", "cube-meshed", 818, 0.72),
    Region("handle", "handle", 35, 0.231),
    Region("turbine", "turbine", 881, 0.098),
    Region("rotor", "rotor", 17, 0.325),
)
CAPTIONS = ("as it came", "without edges", "edges go on")


def direction(mesh: Path, faces: Path) -> str:
    """From where these faces are seen: along their mean normal, and a little from the side."""
    numbers = mesh.read_text().split()
    count = int(numbers[1])
    places = [tuple(map(float, numbers[4 + 3 * v : 7 + 3 * v])) for v in range(count)]
    total = [0.0, 0.0, 0.0]
    for face in map(int, faces.read_text().split()):
        start = 5 + 3 * count + 4 * face
        a, b, c = (places[int(v)] for v in numbers[start : start + 3])
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            total[k] += (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i])
    size = sum(abs(x) for x in total)
    return ",".join(f"{x / size + tilt:.3f}" for x, tilt in zip(total, (0.25, -0.1, 0.15), strict=True))


def main(program: str, meshes: Path) -> None:
    """Makes all pictures."""

    def run(*words: str) -> None:
        done = subprocess.run([program, *words], cwd=WORK, capture_output=True, text=True, check=False)
        # Without edges it may be no success (3).
        if done.returncode not in ((0, 3) if "off" in words else (0,)):
            sys.exit(f"{words}\n{done.stderr}")

    PICTURES.mkdir(parents=True, exist_ok=True)
    for region in REGIONS:
        mesh = str(meshes / f"{region.part}.off")
        place = f"--geodesic={region.vertex},{region.radius}"
        run("select", mesh, f"--geodesic={region.vertex},{2 * region.radius}", "-o", "around.txt")
        for sharp in ("off", "auto"):
            run("fair", mesh, place, "--sharp", sharp, "-o", f"{sharp}.ply")
        for number, whole in enumerate((mesh, "off.ply", "auto.ply")):
            run("select", whole, "--faces", "around.txt", "-o", f"{number}.ply")
        captions = [word for caption in CAPTIONS for word in ("--caption", caption)]
        look = [f"--view={direction(Path(mesh), WORK / 'around.txt')}", "--size", "260x220"]
        picture = str(PICTURES / f"{region.name}.png")
        run("render", "0.ply", "1.ply", "2.ply", "-o", picture, *captions, *look)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]).resolve())

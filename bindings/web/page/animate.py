"""Makes an animation of pictures: `animate.py FOLDER FILE.gif`, in the order of their names, 12 a second."""

import sys
from pathlib import Path

from PIL import Image

WIDTH = 760
# Of one palette for all, so that what stands still stays the same.
COLORS = 160


def main(folder: Path, file: Path) -> None:
    """Reads all, writes one."""
    pictures = [Image.open(path).convert("RGB") for path in sorted(folder.glob("*.png"))]
    height = round(WIDTH * pictures[0].height / pictures[0].width)
    small = [picture.resize((WIDTH, height), Image.Resampling.LANCZOS) for picture in pictures]
    palette = small[len(small) // 2].quantize(COLORS, method=Image.Quantize.MAXCOVERAGE, kmeans=4)
    frames = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in small]
    frames[0].save(file, save_all=True, append_images=frames[1:], duration=83, loop=0, optimize=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))

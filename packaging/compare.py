"""Compares what answers.c has printed on two targets, bit by bit: compare.py FOLDER FOLDER, each with files 1 to 10."""

import struct
import sys
from pathlib import Path


def coordinates(text):
    """The numbers behind the first line."""
    words = " ".join(text.split("\n")[1:]).split()
    return struct.unpack(f">{len(words)}d", bytes.fromhex("".join(words)))


def main():
    a, b = Path(sys.argv[1]), Path(sys.argv[2])
    wrong = []
    for case in range(1, 11):
        texts = [(folder / str(case)).read_text() for folder in (a, b)]
        if texts[0] == texts[1]:
            continue
        x, y = map(coordinates, texts)
        if len(x) == len(y):
            wrong.append(f"{case} by {max(abs(p - q) for p, q in zip(x, y)):.1e}")
        else:
            wrong.append(f"{case} in its size")
    print(f"{a.name} and {b.name}: {10 - len(wrong)} of 10 answers are equal")
    if wrong:
        sys.exit(f"answers that differ: {', '.join(wrong)}")


main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the manual inside the add-on of README.md, with its pictures: manual_page.py FOLDER"""

import re
import shutil
import sys
from pathlib import Path

import markdown

HERE = Path(__file__).resolve().parent
# What is for users of the command line and for developers stays out, as do the measurements.
LEFT_OUT = ("Beside Fair Tangency", "Licence", "Development")
STYLE = """body { font: 16px/1.5 sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #222 }
img { max-width: 100% } td, th { background: #f2f2f2; padding: .3rem .6rem; text-align: left; vertical-align: top }
code, pre { background: #eee } pre { padding: .6rem; overflow: auto }"""


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True)
    parts = re.split(r"^(?=## )", (HERE / "README.md").read_text(encoding="utf-8"), flags=re.MULTILINE)
    text = "".join(part for part in parts if not part.startswith(tuple(f"## {name}\n" for name in LEFT_OUT)))
    # Pages of the repository are not there.
    text = re.sub(r" \[[^\]]*\]\(\.\./[^)]*\) says\s+more\.", "", text)
    page = markdown.markdown(text, extensions=["tables", "toc", "fenced_code"])
    # Recordings would be a quarter of the add-on.
    page = re.sub(r'<p><img [^>]*src="[^"]+\.gif"[^>]*></p>\n?', "", page)
    for picture in re.findall(r'src="([^"]+)"', page):
        name = Path(picture).name
        shutil.copy(HERE / picture, folder / name)
        page = page.replace(f'src="{picture}"', f'src="{name}"')
    left = re.findall(r'href="(?!https?:)([^"]+)"', page)
    if left:
        sys.exit(f"links that lead nowhere: {left}")
    head = (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>Fairmesh</title><style>{STYLE}</style></head>'
    )
    (folder / "index.html").write_text(f"{head}\n<body>\n{page}\n</body></html>\n", encoding="utf-8")


main()

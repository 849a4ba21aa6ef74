"""Copies the pages of the site, and the files that they show or link to, into an empty folder: `gather.py FOLDER`.

docs/SUMMARY.md names the pages, and is the navigation. Everything keeps its place in the repository, so that a link is the
same in a clone and on the site; only its words change from the name of a file to the title of the page. A link to a Markdown file that
is no page, or to a folder, is an error, and so is a file of docs/ that is no page.
"""

import os
import re
import shutil
import sys
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parent.parent
SUMMARY = Path("docs/SUMMARY.md")
LINK = re.compile(r"(\]\()([^)\s]+)(\))")
TITLE = re.compile(r"\[([^\]]+)\]\(([^)\s]+)\)")
FENCE = re.compile(r"^(```|~~~).*?^\1[^\n]*$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]+`")


def links(text: str) -> list[str]:
    """Where the Markdown links and pictures lead that stay in the repository, without anchors."""
    prose = CODE.sub("", FENCE.sub("", text))
    found = (unquote(target.split("#")[0]) for _, target, _ in LINK.findall(prose) if "://" not in target)
    return [target for target in found if target]


def place(page: Path, link: str) -> Path:
    """The file that a link on a page means, from the root of the repository on."""
    return Path(os.path.normpath(page.parent / link))


def titled(text: str, page: Path, titles: dict[Path, str]) -> str:
    """The text of a page with links by title, where they go by the name of a Markdown file."""

    def title(match: re.Match[str]) -> str:
        words, link = match.groups()
        found = titles.get(place(page, link.split("#")[0]))
        return f"[{found}]({link})" if found and words.endswith(".md") else match[0]

    return TITLE.sub(title, text)


def main(folder: Path) -> int:
    """Copies everything; the number of links that lead nowhere."""
    summary = (ROOT / SUMMARY).read_text()
    titles = {place(SUMMARY, link): words for words, link in TITLE.findall(summary)}
    pages = list(titles)
    written = {path.relative_to(ROOT) for path in (ROOT / "docs").rglob("*.md")}
    wrong = [f"{page}: no page of {SUMMARY}" for page in sorted(written - {SUMMARY, *pages})]
    files = set(pages)
    for page in pages:
        if not (ROOT / page).is_file():
            wrong.append(f"{SUMMARY}: there is no {page}")
            continue
        for target in (place(page, link) for link in links((ROOT / page).read_text())):
            if not (ROOT / target).is_file():
                wrong.append(f"{page}: {target} is no file")
            elif target.suffix == ".md" and target not in pages:
                wrong.append(f"{page}: {target} is no page of {SUMMARY}")
            files.add(target)
    for line in wrong:
        print(line, file=sys.stderr)
    if not wrong:
        for file in sorted(files):
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            if file in titles:
                (folder / file).write_text(titled((ROOT / file).read_text(), file, titles))
            else:
                shutil.copy(ROOT / file, folder / file)
        # mdBook wants it at the top.
        there = LINK.sub(lambda m: m[1] + place(SUMMARY, m[2]).as_posix() + m[3], summary)
        (folder / "SUMMARY.md").write_text(there)
    return len(wrong)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])) > 0)

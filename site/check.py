"""Checks the pages of a site that was written to a folder: `check.py FOLDER`.

Every page is in the navigation; every link and every anchor leads somewhere; pictures say in words what they show; nothing
is loaded from the network. Links to other sites are not followed.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

# Pages of mdBook's own: the navigation for browsers without scripts, and the one that leads to the first page.
NAVIGATION = "toc.html"
ENTRY = "index.html"
# The page of live fairing, where it was handed over: a program in one file, no page of text.
LIVE = "live/index.html"
# Attributes whose files a browser fetches by itself.
FETCHED = {"src", "data", "poster", "srcset"}
REMOTE = re.compile(r"^(https?:)?//")


class Page(HTMLParser):
    """Anchors, links, fetched files, and pictures without words of a page."""

    def __init__(self, text: str) -> None:
        """Reads the page."""
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.without_words: list[str] = []
        # Outside of it are mdBook's own buttons, whose names their <button> has.
        self.in_main = False
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        """Takes down what matters of a tag."""
        given = {name: value or "" for name, value in attributes}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        self.fetched += [given[name] for name in FETCHED if name in given]
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        elif tag == "link" and "href" in given:
            self.fetched.append(given["href"])
        elif tag == "img" and not given.get("alt", "").strip():
            self.without_words.append(given.get("src", ""))
        elif tag == "svg" and self.in_main and not given.get("aria-label") and given.get("aria-hidden") != "true":
            self.without_words.append("svg")
        self.in_main |= tag == "main"

    def handle_endtag(self, tag: str) -> None:
        """Knows where the text ends."""
        self.in_main &= tag != "main"


def defects(folder: Path) -> list[str]:
    """What is wrong with the site, a line each."""
    pages = {path.relative_to(folder).as_posix(): Page(path.read_text()) for path in sorted(folder.rglob("*.html"))}
    wrong = []

    def lead(name: str, link: str) -> str | None:
        """The file that a link leads to, as a name; None where it leaves the site."""
        target, anchor = urldefrag(link)
        if re.match(r"^[a-z]+:|^//", target):
            return None
        path = (folder / name).parent / unquote(target) if target else folder / name
        if target.startswith("/") or not path.is_file() or not path.resolve().is_relative_to(folder.resolve()):
            wrong.append(f"{name}: {link} leads nowhere")
            return None
        found = path.resolve().relative_to(folder.resolve()).as_posix()
        if anchor and found in pages and unquote(anchor) not in pages[found].anchors:
            wrong.append(f"{name}: {link}: no such anchor")
        return found

    for name, page in pages.items():
        for link in page.links:
            lead(name, link)
        for link in page.fetched:
            if REMOTE.match(link):
                wrong.append(f"{name}: {link} is loaded from the network")
            elif not link.startswith("data:"):
                lead(name, link)
        wrong += [f"{name}: {picture} has no words beside it" for picture in page.without_words]
    for path in sorted([*folder.rglob("*.css"), *folder.rglob("*.svg")]):
        remote = re.findall(r"(?:url\(|@import)\s*[\"']?((?:https?:)?//[^\"')\s]+)", path.read_text())
        wrong += [f"{path.relative_to(folder)}: {link} is loaded from the network" for link in remote]
    navigation = pages.get(NAVIGATION)
    listed = {lead(NAVIGATION, link) for link in navigation.links} if navigation else set()
    lost = pages.keys() - listed - {NAVIGATION, ENTRY, LIVE}
    wrong += [f"{name}: not in the navigation" for name in sorted(lost)]
    if len(pages) < 3:
        wrong.append(f"{folder}: no site")
    return wrong


if __name__ == "__main__":
    found = defects(Path(sys.argv[1]))
    print("\n".join(found), file=sys.stderr, end="\n" if found else "")
    sys.exit(1 if found else 0)

"""Planted defects of a site are found."""

import tempfile
import unittest
from pathlib import Path

from check import defects
from gather import links, titled

GOOD = {
    "toc.html": '<a href="a.html">A</a><a href="docs/b.html">B</a>',
    "index.html": '<a href="a.html">A</a>',
    "a.html": '<h1 id="top">A</h1><a href="docs/b.html#end">B</a><img src="p.png" alt="A sphere"><a href="https://x.y">X</a>',
    "docs/b.html": '<h2 id="end">B</h2><a href="../a.html#top">A</a><a href="#end">here</a>',
    "p.png": "",
    "style.css": "h1 { background: url(p.png) }",
}


def found(changes: dict[str, str]) -> list[str]:
    """The defects of the good site with other files."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (GOOD | changes).items():
            path = Path(folder, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        return defects(Path(folder))


class Planted(unittest.TestCase):
    """One defect each."""

    def test_none(self) -> None:
        """A good site has none."""
        self.assertEqual(found({}), [])

    def test_each(self) -> None:
        """What is wrong is said, and nothing else."""
        for name, text, said in [
            ("docs/b.html", '<h2 id="end">B</h2><a href="c.html">C</a>', "docs/b.html: c.html leads nowhere"),
            ("docs/b.html", '<h2 id="other">B</h2>', "a.html: docs/b.html#end: no such anchor"),
            ("docs/b.html", '<h2 id="end">B</h2><a href="/a.html">A</a>', "docs/b.html: /a.html leads nowhere"),
            ("c.html", "<p>lost</p>", "c.html: not in the navigation"),
            ("index.html", '<img src="p.png">', "index.html: p.png has no words beside it"),
            ("index.html", "<svg></svg><main><svg></svg></main>", "index.html: svg has no words beside it"),
            (
                "index.html",
                '<script src="https://x.y/z.js"></script>',
                "index.html: https://x.y/z.js is loaded from the network",
            ),
            (
                "index.html",
                '<link rel="stylesheet" href="//x.y/z.css">',
                "index.html: //x.y/z.css is loaded from the network",
            ),
            ("style.css", '@import "https://x.y/f.css";', "style.css: https://x.y/f.css is loaded from the network"),
        ]:
            with self.subTest(said):
                self.assertEqual(found({name: text}), [said])

    def test_live_page(self) -> None:
        """The page of live fairing is in no navigation; it may load nothing either."""
        self.assertEqual(found({"live/index.html": '<main><svg aria-hidden="true"></svg></main>'}), [])
        said = "live/index.html: https://x.y/z.js is loaded from the network"
        self.assertEqual(found({"live/index.html": '<script src="https://x.y/z.js"></script>'}), [said])

    def test_links_in_code_are_none(self) -> None:
        """Brackets and parentheses of code are no links."""
        text = "[a](b.md#c) `d[e](f)`\n```cpp\nauto g = [h](i) {};\n```\n![j](k.png) [l](https://m.n) [o](#p)"
        self.assertEqual(links(text), ["b.md", "k.png"])

    def test_links_by_name_get_titles(self) -> None:
        """The name of a file becomes the title of its page, and other words stay."""
        titles = {Path("docs/b.md"): "All of B"}
        text = "[b.md](b.md#end) [docs/b.md](b.md) [that](b.md) [c.md](c.md)"
        expected = "[All of B](b.md#end) [All of B](b.md) [that](b.md) [c.md](c.md)"
        self.assertEqual(titled(text, Path("docs/a.md"), titles), expected)


if __name__ == "__main__":
    unittest.main()

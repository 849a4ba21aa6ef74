#!/usr/bin/env python3
"""Stands in for crates.io in a rehearsal: a sparse index and the calls of `cargo publish`, for crates that it keeps in a folder. Of all others it has
the index of crates.io, and sends cargo there.

crates_io.py FOLDER PORT

As long as FOLDER/fail-CRATE is there, CRATE is refused, once: the file is deleted then.
"""

import hashlib
import json
import sys
import urllib.error
import urllib.request
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

INDEX = "https://index.crates.io"
FILES = "https://static.crates.io/crates"
# What crates.io's own index says of where a dependency is.
CRATES_IO = "https://github.com/rust-lang/crates.io-index"


def index_line(asked, content):
    """What the index says of a crate, from what cargo says of it (doc.rust-lang.org/cargo/reference/registry-web-api.html)."""
    dependencies = [
        {
            "name": each.get("explicit_name_in_toml") or each["name"],
            "package": each["name"] if each.get("explicit_name_in_toml") else None,
            "req": each["version_req"],
            "features": each["features"],
            "optional": each["optional"],
            "default_features": each["default_features"],
            "target": each["target"],
            "kind": each["kind"],
            "registry": None if each["registry"] in (None, CRATES_IO) else each["registry"],
        }
        for each in asked["deps"]
    ]
    # `dep:` and `?` are for a newer cargo, in a field of their own.
    return {
        "name": asked["name"],
        "vers": asked["vers"],
        "deps": dependencies,
        "cksum": hashlib.sha256(content).hexdigest(),
        "features": {},
        "features2": asked["features"],
        "yanked": False,
        "links": asked["links"],
        "rust_version": asked.get("rust_version"),
        "v": 2,
    }


class Registry(BaseHTTPRequestHandler):
    """One request."""

    def do_GET(self):
        """The index, and files."""
        parts = self.path.strip("/").split("/")
        if parts[0] == "files":
            self.send_file(*parts[1:3])
        elif parts == ["index", "config.json"]:
            here = f"http://{self.headers['Host']}"
            self.answer(200, json.dumps({"dl": f"{here}/files/{{crate}}/{{version}}", "api": here}).encode())
        else:
            self.send_index(parts[1:])

    def send_file(self, crate, version):
        """Ours, or where crates.io has it."""
        ours = folder / f"{crate}-{version}.crate"
        if ours.exists():
            self.answer(200, ours.read_bytes())
        else:
            self.send_response(302)
            self.send_header("Location", f"{FILES}/{crate}/{crate}-{version}.crate")
            self.send_header("Content-Length", "0")
            self.end_headers()

    def send_index(self, path):
        """Ours; of all others that of crates.io."""
        ours = folder / f"{path[-1]}.index"
        if ours.exists():
            self.answer(200, ours.read_bytes())
            return
        try:
            with urllib.request.urlopen(f"{INDEX}/{'/'.join(path)}", timeout=60) as found:
                self.answer(200, found.read())
        except urllib.error.HTTPError as error:
            self.answer(error.code, b"")

    def do_PUT(self):
        """Publishes a crate: lengths and contents of its metadata and its file."""
        body = self.rfile.read(int(self.headers["Content-Length"]))
        size = int.from_bytes(body[:4], "little")
        asked, content = json.loads(body[4 : 4 + size]), body[8 + size :]
        name = asked["name"]
        file, index, planned = (
            folder / f"{name}-{asked['vers']}.crate",
            folder / f"{name}.index",
            folder / f"fail-{name}",
        )
        if planned.exists():
            planned.unlink()
            self.refuse(500, "this failure is planned")
        elif not self.headers["Authorization"]:
            self.refuse(403, "no token")
        elif file.exists():
            self.refuse(400, f"crate version `{asked['vers']}` is already uploaded")
        else:
            file.write_bytes(content)
            with index.open("a") as lines:
                lines.write(json.dumps(index_line(asked, content), separators=(",", ":")) + "\n")
            self.answer(200, b'{"warnings": {"invalid_categories": [], "invalid_badges": [], "other": []}}')

    def refuse(self, code, why):
        """As crates.io says it."""
        self.answer(code, json.dumps({"errors": [{"detail": why}]}).encode())

    def answer(self, code, body):
        """Sends it."""
        self.send_response(code)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        """Says nothing."""


folder = Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
ThreadingHTTPServer(("127.0.0.1", int(sys.argv[2])), Registry).serve_forever()

"""Puts the shared library into the wheel, and the platform into its name; Rust sources into the source distribution."""

from __future__ import annotations

import os
import platform
import re
import shutil
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

sys.path.insert(0, str(Path(__file__).resolve().parent))
import build_library

LICENCES = ("LICENSE-MIT", "LICENSE-APACHE")


class Addresses(MetadataHookInterface):
    """The links that PyPI shows."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Called by hatchling, but not in a source distribution, which has them already."""
        repository = stated("repository")
        metadata["urls"] = {
            "Homepage": repository,
            "Documentation": "https://docs.rs/fairmesh",
            "Source": repository,
            "Issues": f"{repository}/issues",
            "Changelog": f"{repository}/blob/main/CHANGELOG.md",
        }


class LibraryHook(BuildHookInterface):  # type: ignore[type-arg]
    """Builds the library with cargo, unless FAIRMESH_WHEEL_LIBRARY (and _PLATFORM) name one."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before a build."""
        build_library.declare()
        if self.target_name == "sdist":
            self._add_sources(build_data)
            return
        given = os.environ.get("FAIRMESH_WHEEL_LIBRARY")
        library = Path(given) if given else build_library.build()
        tag = os.environ.get("FAIRMESH_WHEEL_PLATFORM") if given else None
        tag = tag or this_platform()
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{tag}"
        if version == "editable":
            beside = Path(self.root, "src", "fairmesh", "lib")
            beside.mkdir(exist_ok=True)
            shutil.copy2(library, beside / build_library.file_name())
            return
        build_data["force_include"][str(library)] = f"fairmesh/lib/{build_library.file_name(tag)}"
        # In a source distribution they are where `license-files` finds them.
        for name in LICENCES:
            if not Path(self.root, name).exists():
                build_data["force_include"][str(build_library.ROOT / name)] = f"fairmesh/lib/{name}"

    def _add_sources(self, build_data: dict[str, Any]) -> None:
        """What is outside of this folder in the repository, and in it in a source distribution."""
        if Path(self.root, "rust").is_dir():
            return
        import rust_sources

        folder = build_library.TARGET / "python" / "rust"
        rust_sources.copy(folder)
        build_data["force_include"][str(folder)] = "rust"
        for name in LICENCES:
            build_data["force_include"][str(build_library.ROOT / name)] = name


def stated(field: str) -> str:
    """What Cargo.toml at the top says."""
    text = (build_library.ROOT / "Cargo.toml").read_text(encoding="utf-8")
    found = re.search(rf'^{field} = "(.*)"$', text, re.MULTILINE)
    if found is None:
        raise SystemExit(f"Cargo.toml has no {field}")
    return found[1]


def this_platform() -> str:
    """What wheels for this machine are called."""
    if sys.platform == "darwin":
        # Python may be for two processors and older systems; the library is not.
        return f"macosx_11_0_{platform.machine()}"
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")

"""Puts the shared library into the wheel, and the platform into its name."""

from __future__ import annotations

import os
import shutil
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

sys.path.insert(0, str(Path(__file__).resolve().parent))
import build_library


class LibraryHook(BuildHookInterface):  # type: ignore[type-arg]
    """Builds the library with cargo, unless FAIRMESH_WHEEL_LIBRARY (and _PLATFORM) name one."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before a build."""
        if self.target_name != "wheel":
            raise SystemExit("fairmesh has no source distribution: its Rust sources are in the repository")
        given = os.environ.get("FAIRMESH_WHEEL_LIBRARY")
        library = Path(given) if given else build_library.build()
        platform = os.environ.get("FAIRMESH_WHEEL_PLATFORM") if given else None
        platform = platform or sysconfig.get_platform().replace("-", "_").replace(".", "_")
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{platform}"
        if version == "editable":
            beside = Path(self.root, "src", "fairmesh", "lib")
            beside.mkdir(exist_ok=True)
            shutil.copy2(library, beside / build_library.file_name())
            return
        build_data["force_include"][str(library)] = f"fairmesh/lib/{build_library.file_name()}"
        for name in ("LICENSE-MIT", "LICENSE-APACHE"):
            build_data["force_include"][str(build_library.ROOT / name)] = f"fairmesh/lib/{name}"

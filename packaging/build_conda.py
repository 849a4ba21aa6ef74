"""Builds a conda package of a recipe on linux-64, and unpacks it: build_conda.py RECIPE FOLDER.

In place of conda-forge there is a channel of empty packages: the compilers and tools that the recipe asks for are those of this machine. Needs
py-rattler-build.
"""

import io
import json
import sys
import tarfile
from pathlib import Path

from rattler_build import EnvironmentIsolation, Stage0Recipe, ToolConfiguration, VariantConfig

#: What conda-forge calls compilers, the C library and the tools on linux-64.
STAND_INS = ("gcc_linux-64", "rust_linux-64", "sysroot_linux-64", "cargo-bundle-licenses", "make")


def stand_in(folder, name):
    """An empty package; returns what the channel's index says of it."""
    index = {"name": name, "version": "99", "build": "0", "build_number": 0, "depends": [], "arch": None, "platform": None, "subdir": "noarch"}
    with tarfile.open(folder / f"{name}-99-0.tar.bz2", "w:bz2") as archive:
        for file, content in (("info/index.json", json.dumps(index)), ("info/paths.json", '{"paths": [], "paths_version": 1}'), ("info/files", "")):
            entry = tarfile.TarInfo(file)
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content.encode()))
    return index


def channel(folder):
    """One with the stand-ins alone."""
    for part in ("noarch", "linux-64"):
        (folder / part).mkdir(parents=True)
    packages = {f"{name}-99-0.tar.bz2": stand_in(folder / "noarch", name) for name in STAND_INS}
    (folder / "noarch/repodata.json").write_text(json.dumps({"packages": packages}), encoding="utf-8")
    (folder / "linux-64/repodata.json").write_text('{"packages": {}}', encoding="utf-8")
    return folder.resolve().as_uri()


def main():
    recipe, folder = Path(sys.argv[1]), Path(sys.argv[2])
    results = Stage0Recipe.from_file(recipe).run_build(
        variant_config=VariantConfig({"c_compiler": ["gcc"], "rust_compiler": ["rust"], "c_stdlib": ["sysroot"]}),
        tool_config=ToolConfiguration(test_strategy="native"),
        output_dir=folder / "built",
        channels=[channel(folder / "channel")],
        package_format="tar.bz2",
        env_isolation=EnvironmentIsolation.NONE,
    )
    (package,) = (Path(path) for result in results for path in result.packages)
    with tarfile.open(package) as archive:
        archive.extractall(folder / "unpacked")
    print(f"conda: {package.name}, {package.stat().st_size} bytes")


main()

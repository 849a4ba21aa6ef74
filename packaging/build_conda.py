"""Builds a conda package of a recipe, without a channel, and unpacks it: build_conda.py RECIPE FOLDER.

Needs py-rattler-build.
"""

import sys
import tarfile
from pathlib import Path

from rattler_build import Stage0Recipe, ToolConfiguration


def main():
    recipe, folder = Path(sys.argv[1]), Path(sys.argv[2])
    # An empty one stands for conda-forge: it is not needed.
    channel = folder / "channel"
    (channel / "noarch").mkdir(parents=True)
    (channel / "noarch/repodata.json").write_text('{"packages": {}}', encoding="utf-8")
    results = Stage0Recipe.from_file(recipe).run_build(
        tool_config=ToolConfiguration(test_strategy="native"),
        output_dir=folder / "built",
        channels=[channel.resolve().as_uri()],
        package_format="tar.bz2",
    )
    (package,) = (Path(path) for result in results for path in result.packages)
    with tarfile.open(package) as archive:
        archive.extractall(folder / "unpacked")
    print(f"conda: {package.name}, {package.stat().st_size} bytes")


main()

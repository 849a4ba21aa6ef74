#!/usr/bin/env bash
# Makes the Python wheel for one target into target/packaging/dist, of the shared library that build.sh has built and of the source
# distribution, which sdist.sh makes. Needs cargo and python3 with venv. Two runs give the same bytes.
#   packaging/wheel.sh linux-x86_64|linux-aarch64|windows-x86_64|macos-x86_64|macos-aarch64
set -euo pipefail
. "$(dirname "$0")/tools.sh"
target=${1-}
platform=$(wheel_platform "$target")
file=$(library_file "$target")
staged=$out/stage/$target/fairmesh-$version-$target
library=$staged/$file
[ -e "$library" ] || fail "$library is not there: packaging/build.sh $target"
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct 2>/dev/null || echo 1704067200)}
export SOURCE_DATE_EPOCH
"$root/packaging/sdist.sh" >&2
work=$out/stage/$target/wheel
rm -rf "$work"
mkdir -p "$work"
tar -xzf "$dist/fairmesh-$version.tar.gz" -C "$work"
cp "$staged/share/doc/fairmesh/THIRD-PARTY.txt" "$work/fairmesh-$version"
FAIRMESH_WHEEL_LIBRARY=$library FAIRMESH_WHEEL_PLATFORM=$platform \
    "$out/python-build/bin/python" -m build --wheel --no-isolation --outdir "$dist" "$work/fairmesh-$version" >&2
echo "$dist/fairmesh-$version-py3-none-$platform.whl"

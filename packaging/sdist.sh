#!/usr/bin/env bash
# Makes the source distribution of the Python package, into target/packaging/dist: bindings/python, and the Rust sources that the library in
# it is compiled from. Needs cargo and python3 with venv. Two runs give the same bytes.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
stage=$out/stage/sdist
name=fairmesh-$version
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct 2>/dev/null || echo 1704067200)}
export SOURCE_DATE_EPOCH
export CARGO_TARGET_DIR=$out
# shellcheck disable=SC2086
environment "$out/python-build" $PYTHON_BUILD
# sdist FROM TO
sdist() { "$out/python-build/bin/python" -m build --sdist --no-isolation --outdir "$2" "$1" >&2; }
umask 022
rm -rf "$stage"
mkdir -p "$stage" "$dist"
sdist "$root/bindings/python" "$stage"
tar -xzf "$stage/$name.tar.gz" -C "$stage"
# Once more from what is in it: only there are the licences where PKG-INFO names them.
sdist "$stage/$name" "$dist"
echo "$dist/$name.tar.gz"

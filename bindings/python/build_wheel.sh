#!/usr/bin/env bash
# Builds the wheel for any Linux x86_64 with glibc 2.28 or newer into target/python/wheels, and prints its path; nothing
# else on stdout. Needs cargo, binutils and python3-venv. Wheels that are published are made by packaging/wheel.sh.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "${CARGO_TARGET_DIR:-$here/../../target}"
. "$here/../../packaging/tools.sh"
wheels=${out%/*}/python/wheels
mkdir -p "$wheels"

library=$("$here/build_library.sh")

# shellcheck disable=SC2086
environment "$out/python-build" $PYTHON_BUILD
rm -f "$wheels"/*.whl
FAIRMESH_WHEEL_LIBRARY=$library FAIRMESH_WHEEL_PLATFORM=$(wheel_platform linux-x86_64) \
    "$out/python-build/bin/python" -m build --wheel --no-isolation --outdir "$wheels" "$here" >&2
ls "$wheels"/*.whl

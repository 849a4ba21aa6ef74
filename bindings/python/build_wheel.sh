#!/usr/bin/env bash
# Builds the wheel for any Linux x86_64 with glibc 2.28 or newer into target/python/wheels, and prints its path; nothing
# else on stdout. Needs cargo, binutils and python3-venv.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
target=${CARGO_TARGET_DIR:-$here/../../target}
mkdir -p "$target/python/wheels"
target=$(cd "$target" && pwd)

library=$("$here/build_library.sh")

tools=$target/python/build
requirements="build==1.3.0 hatchling==1.27.0"
if [ "$(cat "$tools/installed" 2>/dev/null)" != "$requirements" ]; then
    rm -rf "$tools"
    python3 -m venv "$tools"
    # shellcheck disable=SC2086
    "$tools/bin/pip" --disable-pip-version-check install -q $requirements >&2
    echo "$requirements" >"$tools/installed"
fi

rm -f "$target"/python/wheels/*.whl
FAIRMESH_WHEEL_LIBRARY=$library FAIRMESH_WHEEL_PLATFORM=manylinux_2_28_x86_64 \
    "$tools/bin/python" -m build --wheel --no-isolation --outdir "$target/python/wheels" "$here" >&2
ls "$target"/python/wheels/*.whl

#!/usr/bin/env bash
# Tests the Python package: builds the wheel, installs it into virtual environments under target/python, and runs the tests
# there with numpy 2 and numpy 1. Installs what it needs (Debian, Ubuntu). `test.sh long` executes the notebooks of the
# gallery in their place.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../.. && pwd)
mkdir -p "${CARGO_TARGET_DIR:-$root/target}/python"
target=$(cd "${CARGO_TARGET_DIR:-$root/target}" && pwd)
unset PYTHONPATH FAIRMESH_LIBRARY

. "$root/packaging/install.sh"

install_tools() {
    local missing=()
    command -v python3 >/dev/null || missing+=(python3)
    python3 -c 'import ensurepip, venv' 2>/dev/null || missing+=(python3-venv)
    command -v objdump >/dev/null || missing+=(binutils)
    command -v cc >/dev/null || missing+=(build-essential)
    # What Open3D loads.
    local library
    for library in libGL.so.1:libgl1 libEGL.so.1:libegl1 libX11.so.6:libx11-6 libusb-1.0.so.0:libusb-1.0-0; do
        ldconfig -p | grep -q "${library%:*} " || missing+=("${library#*:}")
    done
    [ ${#missing[@]} -eq 0 ] || install_packages "${missing[@]}"
}

# A virtual environment with these packages, made anew when they change.
environment() {
    local home=$1 wanted
    shift
    wanted=$(printf '%s\n' "$@")
    if [ "$(cat "$home/installed" 2>/dev/null)" != "$wanted" ]; then
        rm -rf "$home"
        python3 -m venv "$home"
        "$home/bin/pip" --disable-pip-version-check install -q "$@"
        printf '%s\n' "$wanted" >"$home/installed"
    fi
}

install_tools
python3 -c 'import sys; assert sys.version_info >= (3, 11), "the tests need Python 3.11 or newer"'

mapfile -t packages < <(grep -v '^#' requirements-test.txt)
environment "$target/python/test" "${packages[@]}"
environment "$target/python/numpy1" numpy==1.24.2 pytest==9.2.0    # those of Debian 12
bin=$target/python/test/bin

"$root/bindings/declarations.sh" python
"$bin/ruff" format --check . ../../site ../../reproduction ../../benchmark
"$bin/ruff" check . ../../site ../../reproduction ../../benchmark
"$bin/mypy" src
MYPYPATH=src "$bin/mypy" tests/typed.py
MYPYPATH=src:examples/gallery "$bin/mypy" examples/*.py examples/gallery/*.py

hooks=$(python3 build_library.py --portable --hooks)
wheel=$(./build_wheel.sh)
for python in "$bin/python" "$target/python/numpy1/bin/python"; do
    "$python" -m pip --disable-pip-version-check install -q --force-reinstall --no-deps "$wheel"
done

(cd "$root" && cargo build --release --locked --quiet)
export FAIRMESH_TEST_WHEEL=$wheel FAIRMESH_TEST_PROGRAM=$target/release/fairmesh FAIRMESH_TEST_HOOKS=$hooks
if [ "${1:-}" = long ]; then
    FAIRMESH_TEST_LONG=1 "$bin/python" -m pytest tests/test_gallery.py
    exit
fi
"$bin/python" -m pytest
# What depends on numpy.
"$target/python/numpy1/bin/python" -m pytest tests/test_arrays.py tests/test_errors.py tests/test_answers.py tests/test_results.py

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT OR Apache-2.0
# Builds the plugin for the pinned hosts and tests it in them. Installs what it needs (Debian 12); downloads and everything that is built
# stay in target/meshlab. A step of ../test.sh.
#   test.sh           all
#   test.sh gui       also the window of MeshLab 2020.09: menu, dialog, preview, apply, error box
set -euo pipefail
cd "$(dirname "$0")"
work=$PWD/../target/meshlab
. ./hosts.sh
. ../packaging/install.sh

install_tools() {
    local missing=()
    command -v meshlabserver >/dev/null || missing+=(meshlab)
    command -v Xvfb >/dev/null || missing+=(xvfb)
    command -v xdotool >/dev/null || missing+=(xdotool)
    command -v import >/dev/null || missing+=(imagemagick)
    command -v clang-format >/dev/null || missing+=(clang-format)
    command -v cmake >/dev/null || missing+=(cmake)
    command -v c++ >/dev/null || missing+=(g++)
    command -v make >/dev/null || missing+=(make)
    command -v curl >/dev/null || missing+=(curl ca-certificates)
    command -v xz >/dev/null || missing+=(xz-utils)
    compgen -G '/usr/lib/*/dri/swrast_dri.so' >/dev/null || missing+=(libgl1-mesa-dri)
    compgen -G '/usr/include/*/qt5/QtWidgets' >/dev/null || missing+=(qtbase5-dev)
    compgen -G '/usr/include/*/qt5/QtOpenGL' >/dev/null || missing+=(libqt5opengl5-dev)
    [ -e /usr/include/GL/glew.h ] || missing+=(libglew-dev libglu1-mesa-dev)
    [ -e /usr/include/eigen3/Eigen/Core ] || missing+=(libeigen3-dev)
    python3 -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
    [ ${#missing[@]} -gt 0 ] || return 0
    install_packages "${missing[@]}"
}

# The linters of the tests, in a pinned version.
lint() {
    clang-format --dry-run -Werror src/*.cpp src/*.h tests/*.cpp
    "$work/venv-pymeshlab/bin/pip" install --quiet --disable-pip-version-check ruff==0.14.5
    "$work/venv-pymeshlab/bin/ruff" check --quiet tests
    "$work/venv-pymeshlab/bin/ruff" format --quiet --check tests
}

install_tools
# 2023.12 is built and tested in packaging/check_meshlab.sh.
for host in debian pymeshlab pymeshlab-2022; do
    printf 'building for %s\n' "$host"
    FAIRMESH_WARNINGS=error ./build.sh "$host" >/dev/null
done
lint
tests/test_build.sh
cmake --build "$work/build-debian" --target cancel --parallel 2 >"$work/build-cancel.log" || { tail -30 "$work/build-cancel.log" && exit 1; }
"$work/build-debian/cancel"
for host in pymeshlab pymeshlab-2022; do
    printf 'in %s\n' "$host"
    "$work/venv-$host/bin/python" tests/test_pymeshlab.py "$work/$host/libfilter_fairmesh.so"
done
cargo build --release --locked --quiet
printf 'in meshlabserver\n'
"$work/venv-pymeshlab/bin/python" tests/test_meshlabserver.py "$work/debian/libfilter_fairmesh.so" ../target/release/fairmesh
"$work/venv-pymeshlab/bin/python" tests/benchmark.py "$work/pymeshlab/libfilter_fairmesh.so"
if [ "${1:-}" = gui ]; then tests/gui.sh "$work/pictures"; fi
printf 'The MeshLab plugin has passed.\n'

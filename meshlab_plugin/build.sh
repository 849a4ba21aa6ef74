#!/usr/bin/env bash
# SPDX-License-Identifier: MIT OR Apache-2.0
# Builds the plugin for one program and lays out what is to be installed in target/meshlab/<host>/.
#   build.sh debian                    MeshLab 2020.09 of Debian 11, 12 or Ubuntu 22.04
#   build.sh pymeshlab [PYTHON]        PyMeshLab 2025.7, in this Python's packages; default: in a venv of its own
#   build.sh pymeshlab-2023 [PYTHON]   PyMeshLab 2023.12
#   build.sh pymeshlab-2022 [PYTHON]   PyMeshLab 2022.2
#   build.sh other NAME SOURCE LIBRARY another one: MeshLab's source tree (with vcglib) of the same version, its libmeshlab-common.so
# FAIRMESH_TREE=FOLDER takes the library from an unpacked archive (docs/releasing.md) and does not build it. MESHLAB_RELEASE=2023.12: as hosts.sh says.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")
work=$root/target/meshlab
. "$here/hosts.sh"
. "$here/fetch.sh"

fail() {
    printf 'build.sh: %s\n' "$*" >&2
    exit 1
}

# need PROGRAM PACKAGE
need() {
    command -v "$1" >/dev/null || fail "$1 is missing: apt-get install $2"
}

# python_of: the Python given, or one with the pinned PyMeshLab in a venv.
python_of() {
    if [ -n "${1:-}" ]; then
        python=$1
        return
    fi
    local venv=$work/venv-$host
    if [ ! -e "$venv/ok-$pypi" ]; then
        python3 -m venv "$venv" || fail "no venv can be made: apt-get install python3-venv"
        "$venv/bin/pip" install --quiet --disable-pip-version-check "$pypi" numpy==1.26.4
        touch "$venv/ok-$pypi"
    fi
    python=$venv/bin/python
}

library_of() {
    case "$host" in
    debian)
        library=$(compgen -G '/usr/lib/*/meshlab/libmeshlab-common.so' | head -1) || fail "MeshLab is missing: apt-get install meshlab"
        ;;
    *)
        python_of "${1:-}"
        library=$("$python" -c 'import importlib.util, pathlib
print(pathlib.Path(importlib.util.find_spec("pymeshlab").origin).parent / "lib" / "libmeshlab-common.so")' 2>/dev/null) ||
            fail "$python has no pymeshlab"
        ;;
    esac
}

host=${1:-}
case "$host" in
other)
    [ $# -eq 4 ] || fail "other NAME SOURCE LIBRARY"
    host=$2 source=$3 library=$4
    ;;
*)
    host "$host" || fail "which host? One of: $HOSTS, other"
    MESHLAB_RELEASE=$release
    need curl curl
    fetch_sources
    unpack_sources
    library_of "${2:-}"
    ;;
esac
need cmake cmake
need c++ g++
need make make
compgen -G '/usr/include/*/qt5/QtOpenGL' >/dev/null ||
    fail "Qt 5 is missing: apt-get install qtbase5-dev libqt5opengl5-dev libglew-dev libglu1-mesa-dev libeigen3-dev"

if [ -n "${FAIRMESH_TREE:-}" ]; then
    fairmesh=$FAIRMESH_TREE
else
    need cargo 'cargo, from https://rustup.rs'
    fairmesh=$work/fairmesh
    make -C "$root" --silent install PREFIX="$fairmesh" >/dev/null
fi
cmake -S "$here" -B "$work/build-$host" -DCMAKE_BUILD_TYPE=Release -DMESHLAB_SOURCE="$source" -DMESHLAB_LIBRARY="$library" \
    -DMESHLAB_SCALAR="${MESHLAB_SCALAR:-}" -DMESHLAB_RELEASE="${MESHLAB_RELEASE:-}" -Dfairmesh_DIR="$fairmesh/lib/cmake/fairmesh" ${FAIRMESH_WARNINGS:+-DCMAKE_CXX_FLAGS=-Werror} >"$work/build-$host.log" ||
    fail "see above, and $work/build-$host.log"
cmake --build "$work/build-$host" --parallel "${JOBS:-2}" >>"$work/build-$host.log" ||
    { tail -40 "$work/build-$host.log" >&2; fail "the plugin could not be built"; }

out=$work/$host
rm -rf "$out"
mkdir -p "$out"
install -m 644 -s "$work/build-$host/libfilter_fairmesh.so" "$out/"
# The binary holds MeshLab's and vcglib's code, and so is under their licence.
install -m 644 "$source/LICENSE.txt" "$out/COPYING"
install -m 644 "$here/README.md" "$out/"
printf '%s\n' "$out/libfilter_fairmesh.so"

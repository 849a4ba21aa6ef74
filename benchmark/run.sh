#!/usr/bin/env bash
# Runs the benchmark, and writes docs/benchmark.md and benchmark/results.json. Installs what it needs (Debian 12 with Rust): meshes of Debian's
# libcgal-demo, the programs from PyPI, CGAL's headers, and from GitHub PMP, into target/benchmark.
#   benchmark/run.sh                            everything, in about half an hour on two cores
#   benchmark/run.sh --only fairmesh            this program anew; of the others the last results stay
#   benchmark/run.sh --only fairmesh --quick    a third of the cases, compared with the committed results
#   benchmark/run.sh test                       tests of the measures
set -euo pipefail
cd "$(dirname "$0")/.."
work=${CARGO_TARGET_DIR:-target}/benchmark
mkdir -p "$work"
work=$(cd "$work" && pwd)

. packaging/install.sh

# environment NAME FILE...: a virtual environment with the packages of these files, made anew when they change.
environment() {
    local home=$work/environments/$1 wanted
    shift
    wanted=$(cat "$@")
    if [ "$(cat "$home/installed" 2>/dev/null)" != "$wanted" ]; then
        rm -rf "$home"
        python3 -m venv "$home"
        local file
        for file in "$@"; do "$home/bin/pip" --disable-pip-version-check install -q -r "$file"; done
        printf '%s\n' "$wanted" >"$home/installed"
    fi
}

# is_wanted NAME ARGUMENT...: whether --only is not there, or names it.
is_wanted() {
    local name=$1
    shift
    case "$*" in *--only*"$name"*) return 0 ;; *--only*) return 1 ;; esac
}

# compiled NAME FLAG...: benchmark/programs/NAME/main.cpp, compiled when it or off.hpp has changed.
compiled() {
    local source=benchmark/programs/$1/main.cpp made=$BUILT_PROGRAMS/$1
    shift
    if [ "$source" -nt "$made" ] || [ benchmark/programs/off.hpp -nt "$made" ]; then
        g++ -std=c++17 -O2 -DNDEBUG -I/usr/include/eigen3 "$source" -o "$made" "$@"
    fi
}

# The sources of PMP, which no registry has: FAIRMESH_PMP_SOURCE names a directory with them, else they are cloned.
pmp_source() {
    local source=${FAIRMESH_PMP_SOURCE:-$work/pmp-$PMP_VERSION}
    [ -e "$source/src/pmp" ] || git clone -q --depth 1 --branch "$PMP_VERSION" https://github.com/pmp-library/pmp-library "$source" || return
    echo "$source/src"
}

missing=()
python3 -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
# What Blender and Open3D load.
for library in libGL.so.1:libgl1 libEGL.so.1:libegl1 libX11.so.6:libx11-6 libXi.so.6:libxi6 libXxf86vm.so.1:libxxf86vm1 \
    libXfixes.so.3:libxfixes3 libXrender.so.1:libxrender1 libSM.so.6:libsm6 libxkbcommon.so.0:libxkbcommon0; do
    ldconfig -p | grep -q "${library%:*} " || missing+=("${library#*:}")
done
for header in CGAL/version.h:libcgal-dev eigen3/Eigen/Core:libeigen3-dev c++/12/vector:g++; do
    [ -e "/usr/include/${header%:*}" ] || missing+=("${header#*:}")
done
archive=/usr/share/doc/libcgal-demo/data.tar.gz
[ -e $archive ] || missing+=(libcgal-demo)
[ ${#missing[@]} -eq 0 ] || install_packages "${missing[@]}"
data=$work/data/meshes
[ -e "$data" ] || tar -xzf $archive -C "$work" data/meshes

common=()
for program in benchmark/programs/*/; do
    [ -e "$program/requirements.txt" ] || continue
    if grep -q '^own_environment = true' "$program/program.toml"; then
        is_wanted "$(basename "$program")" "$@" || continue
        environment "$(basename "$program")" "$program/requirements.txt"
    else
        common+=("$program/requirements.txt")
    fi
done
environment common benchmark/requirements.txt "${common[@]}"

export PYTHONPATH=$PWD/benchmark
python=$work/environments/common/bin/python
if [ "${1:-}" = test ]; then exec "$python" -m pytest -q benchmark/tests; fi
export BUILT_PROGRAMS=$work/programs PMP_VERSION=3.0.0
mkdir -p "$BUILT_PROGRAMS"
if is_wanted cgal_headers "$@"; then compiled cgal_headers -DCGAL_EIGEN3_ENABLED -lgmp -lmpfr; fi
if ! is_wanted pmp "$@"; then :; elif pmp=$(pmp_source); then
    compiled pmp -DPMP_SCALAR_TYPE_64 "-I$pmp" "$pmp"/pmp/surface_mesh.cpp \
        "$pmp"/pmp/algorithms/{hole_filling,fairing,laplace,normals,numerics,differential_geometry}.cpp
else
    echo "benchmark/run.sh: PMP is left out, as its source could not be cloned; FAIRMESH_PMP_SOURCE may name a directory with it" >&2
    set -- "$@" --only "$(cd benchmark/programs && printf '%s\n' */ | tr -d / | grep -vx pmp | paste -sd,)"
fi
cargo build --release --locked --quiet -p fairmesh-cli
FAIRMESH_PROGRAM=$(cd "${CARGO_TARGET_DIR:-target}" && pwd)/release/fairmesh
export FAIRMESH_PROGRAM
exec "$python" -m fairbench --data "$data" --environments "$work/environments" --work "$work" "$@"

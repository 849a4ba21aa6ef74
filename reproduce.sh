#!/usr/bin/env bash
# Writes REPRODUCTION.md and docs/reproduction/*.png: the paper's figures, table and claims, measured.
#   ./reproduce.sh [--scan NAME MESH FREE-VERTICES VIEW]... [--runs N]
# Scans are for Figures 9 and 10: a name that says where the scan comes from, the mesh, its free vertices (one number
# per line, from 0), and from where they are seen ('right', '0,1,0.3', ...).
#   ./reproduce.sh measurements
# writes docs/measurements.md: accuracy, times, holes and known shortfalls, in a few minutes.
#   ./reproduce.sh continuity [--scan NAME MESH FREE-VERTICES VIEW[/UP]]...
# writes docs/g2.md and docs/g2/*.png: curvature continuity beside tangent continuity, libigl and CGAL (Debian's
# libcgal-dev, installed where it is missing).
#   ./reproduce.sh ladder
# writes docs/ladder.md: which of the solver's attempts finds the surface, over regions and holes of Debian's libcgal-demo (installed where
# it is missing).
# The measurements are Python, in reproduction/: numpy, scipy and libigl come from PyPI, into target/reproduction/python.
set -euo pipefail
cd "$(dirname "$0")"

. packaging/install.sh

wanted="numpy==2.4.6 scipy==1.17.1 libigl==2.6.3"
home=target/reproduction/python
if [ "$(cat "$home/wanted" 2>/dev/null)" != "$wanted" ]; then
    python3 -c 'import ensurepip, venv' 2>/dev/null || install_packages python3-venv
    rm -rf "$home"
    python3 -m venv "$home"
    # shellcheck disable=SC2086
    "$home/bin/pip" --disable-pip-version-check install -q $wanted
    echo "$wanted" >"$home/wanted"
fi
cargo build --release --locked --bin fairmesh
case "${1:-}" in continuity | ladder)
    # What the command line does not print: mean curvature of any mesh, fitted normals, or a thousand reports quickly.
    bindings/declarations.sh python
    FAIRMESH_LIBRARY=$(python3 bindings/python/build_library.py)
    export FAIRMESH_LIBRARY PYTHONPATH=bindings/python/src
    ;;
esac
if [ "${1:-}" = ladder ]; then
    meshes=target/reproduction/data/meshes
    archive=/usr/share/doc/libcgal-demo/data.tar.gz
    [ -e $archive ] || install_packages libcgal-demo
    [ -e $meshes ] || tar -xzf $archive -C target/reproduction
    set -- "$@" --meshes $meshes
fi
if [ "${1:-}" = continuity ]; then
    if [ ! -e /usr/include/CGAL/Polygon_mesh_processing/fair.h ] || ! command -v g++ >/dev/null; then
        install_packages g++ libcgal-dev libeigen3-dev
    fi
fi
exec "$home/bin/python" -m reproduction --program "${CARGO_TARGET_DIR:-target}/release/fairmesh" "$@"

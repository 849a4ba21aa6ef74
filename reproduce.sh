#!/usr/bin/env bash
# Writes REPRODUCTION.md and docs/reproduction/*.png: the paper's figures, table and claims, measured.
#   ./reproduce.sh [--scan NAME MESH FREE-VERTICES VIEW]... [--runs N]
# Scans are for Figures 9 and 10: a name that says where the scan comes from, the mesh, its free vertices (one number
# per line, from 0), and from where they are seen ('right', '0,1,0.3', ...).
#   ./reproduce.sh measurements
# writes docs/measurements.md: accuracy, times, holes and known shortfalls, in a few minutes.
#   ./reproduce.sh continuity [--scan NAME MESH FREE-VERTICES VIEW[/UP]]...
# writes docs/g2.md and docs/g2/*.png: curvature continuity beside tangent continuity, libigl (from PyPI, into
# target/continuity) and CGAL (Debian's libcgal-dev, installed where it is missing).
set -euo pipefail
cd "$(dirname "$0")"
cargo build --release --locked --bin fairmesh --example reproduce
release=${CARGO_TARGET_DIR:-target}/release
if [ "${1:-}" = continuity ]; then
    wanted="numpy==2.4.6 scipy==1.17.1 libigl==2.6.3"
    home=target/continuity
    if [ "$(cat "$home/wanted" 2>/dev/null)" != "$wanted" ]; then
        rm -rf "$home"
        python3 -m venv "$home"
        # shellcheck disable=SC2086
        "$home/bin/pip" --disable-pip-version-check install -q $wanted
        echo "$wanted" >"$home/wanted"
    fi
    if [ ! -e /usr/include/CGAL/Polygon_mesh_processing/fair.h ] || ! command -v g++ >/dev/null; then
        as_root=""
        [ "$(id -u)" -eq 0 ] || as_root=sudo
        $as_root apt-get update -qq
        $as_root apt-get install -y -qq --no-install-recommends g++ libcgal-dev libeigen3-dev
    fi
    set -- "$@" --python "$home/bin/python"
fi
exec "$release/examples/reproduce" "$release/fairmesh" "$@"

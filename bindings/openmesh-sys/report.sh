#!/usr/bin/env bash
# Writes docs/openmesh.md and its pictures: OpenMesh's smoother and fairmesh on the same meshes. Needs libopenmesh-dev.
#   bindings/openmesh-sys/report.sh [--vertices N] [--scan NAME MESH FREE-VERTICES VIEW]...
# Scans as in reproduce.sh: a name that says where the scan comes from, the mesh, its free vertices (one number per
# line, from 0), and from where they are seen ('right', '0,1,0.3', ...).
set -euo pipefail
cd "$(dirname "$0")/../.."
cargo build --release --locked --workspace --bin fairmesh --example report
exec target/release/examples/report target/release/fairmesh "$@"

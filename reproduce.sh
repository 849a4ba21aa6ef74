#!/usr/bin/env bash
# Writes REPRODUCTION.md and docs/reproduction/*.png: the paper's figures, table and claims, measured.
#   ./reproduce.sh [--scan NAME MESH FREE-VERTICES VIEW]... [--runs N]
# Scans are for Figures 9 and 10: a name that says where the scan comes from, the mesh, its free vertices (one number
# per line, from 0), and from where they are seen ('right', '0,1,0.3', ...).
#   ./reproduce.sh measurements
# writes docs/measurements.md: accuracy, times, holes and known shortfalls, in a few minutes.
set -euo pipefail
cd "$(dirname "$0")"
cargo build --release --locked --bin fairmesh --example reproduce
exec target/release/examples/reproduce target/release/fairmesh "$@"

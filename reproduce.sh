#!/usr/bin/env bash
# Writes REPRODUCTION.md and docs/reproduction/*.png: the paper's figures, table and claims, measured.
#   ./reproduce.sh [--scan NAME MESH FREE-VERTICES]... [--runs N]
# Scans are only measured and shown in target/reproduction; they do not become part of the document's pictures.
set -euo pipefail
cd "$(dirname "$0")"
cargo build --release --locked --bin fairmesh --example reproduce
exec target/release/examples/reproduce target/release/fairmesh "$@"

#!/usr/bin/env bash
# Writes docs/speed.md anew, measured on this machine: some minutes, 2 GB.
#   site/speed.sh [LARGEST]     at most so many free vertices, a million by default
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --locked --quiet -p fairmesh-cli
python3 site/speed.py "${CARGO_TARGET_DIR:-target}/release/fairmesh" "$@"

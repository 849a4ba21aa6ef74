#!/usr/bin/env bash
# Writes what a package repeats of the C interface beside its sources: declarations.sh python|web. Needs cargo.
set -euo pipefail
cd "$(dirname "$0")/.."
case $1 in
python) folder=bindings/python/src/fairmesh ;;
web) folder=bindings/web/src ;;
esac
exec cargo run --release --locked --quiet -p fairmesh-declarations -- "$1" "$folder"

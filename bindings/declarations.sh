#!/usr/bin/env bash
# Writes what is made of the library's tables and schemas, and of src/capi, beside the sources that need it: declarations.sh capi|python|web.
# Needs cargo.
set -euo pipefail
cd "$(dirname "$0")/.."
case $1 in
capi) folder=src/capi ;;
python) folder=bindings/python/src/fairmesh ;;
web) folder=bindings/web/src ;;
esac
exec cargo run --release --locked --quiet -p fairmesh-declarations -- "$1" "$folder"

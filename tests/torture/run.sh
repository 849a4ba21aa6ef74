#!/usr/bin/env bash
# The torture run: tests the checker on planted defects, then runs the program on public and on damaged meshes and judges
# every result. Installs what it needs (Debian, PyPI) under target/torture. Arguments are those of torture.py (--help).
set -euo pipefail
cd "$(dirname "$0")/../.."
home=${CARGO_TARGET_DIR:-target}/torture
wanted="numpy==2.4.6 pytest==9.2.0 ruff==0.17.5"

. packaging/install.sh
python3 -c 'import ensurepip, venv' 2>/dev/null || install_packages python3-venv
# Nothing of Debian's package is installed, but its name has to be known: without names the lists alone are fetched.
[ -e "$home/meshes/fetched" ] || apt-cache show libcgal-demo >/dev/null 2>&1 || install_packages
if [ "$(cat "$home/venv/wanted" 2>/dev/null)" != "$wanted" ]; then
    rm -rf "$home/venv"
    python3 -m venv "$home/venv"
    # shellcheck disable=SC2086
    "$home/venv/bin/pip" --disable-pip-version-check install -q $wanted
    echo "$wanted" >"$home/venv/wanted"
fi

bin=$home/venv/bin
"$bin/ruff" format --check tests/torture
"$bin/ruff" check tests/torture
"$bin/python" -m pytest -q -p no:cacheprovider tests/torture/test_checker.py
[[ " $* " == *" --program "* ]] || cargo build --release --locked --quiet -p fairmesh-cli
"$bin/python" tests/torture/torture.py --program "${CARGO_TARGET_DIR:-target}/release/fairmesh" \
    --cache "$home/meshes" --work "$home/work" "$@"

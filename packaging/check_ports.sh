#!/usr/bin/env bash
# Tries the ports of ports.sh with the archives of target/packaging/dist, on linux-x86_64: conda's by its program, which comes from PyPI, with this machine's
# compilers in place of conda-forge's; of Homebrew's only the syntax, and the hashes.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
PROGRAMS="py-rattler-build==0.73.0"
LICENCES="cargo-bundle-licenses@5.0.0"
home=$out/port-tools
work=$out/check/ports
need cmake cmake
need ruby ruby
need patchelf patchelf
if [ "$(cat "$home/installed" 2>/dev/null)" != "$PROGRAMS" ]; then
    rm -rf "$home"
    python3 -m venv "$home"
    "$home/bin/pip" --disable-pip-version-check install -q "$PROGRAMS"
    echo "$PROGRAMS" >"$home/installed"
fi
"$root/packaging/manifest.sh" --list >/dev/null
ports=$("$root/packaging/ports.sh" "file://$dist")
rm -rf "$work"
mkdir -p "$work"

# client FOLDER: the example in C finds the library that is installed there.
client() {
    cmake -S "$root/examples/c" -B "$work/client-${1%/*}" -DCMAKE_PREFIX_PATH="$work/$1" -DCMAKE_BUILD_TYPE=Release >"$work/client.log"
    grep -q "^fairmesh_DIR:PATH=$work/$1/" "$work/client-${1%/*}/CMakeCache.txt" || fail "CMake has found another library than that of $1"
    cmake --build "$work/client-${1%/*}" >>"$work/client.log" || fail "$(cat "$work/client.log")"
    "$work/client-${1%/*}/smooth_dent" | tail -1 | grep '^converged' || fail "the client of $1 has failed"
}

# Whether it compiles is asked, not how fast it is.
conda_package() {
    [ -x "$home/cargo/bin/cargo-bundle-licenses" ] ||
        cargo install --locked --quiet --debug --root "$home/cargo" "$LICENCES" >"$work/conda.log" 2>&1 || fail "$(tail "$work/conda.log")"
    PATH=$home/cargo/bin:$PATH CARGO_PROFILE_RELEASE_OPT_LEVEL=0 CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 \
        env -u CARGO_TARGET_DIR "$home/bin/python" "$root/packaging/build_conda.py" "$ports/conda/recipe.yaml" "$work/conda" >"$work/conda.log" 2>&1 || fail "$(cat "$work/conda.log")"
    client conda/unpacked
    tail -1 "$work/conda.log"
}

homebrew_formula() {
    ruby -c "$ports/homebrew/fairmesh.rb" >/dev/null || fail "the formula is no Ruby"
    echo "Homebrew: the formula is Ruby; it was not run"
}

conda_package
homebrew_formula

#!/usr/bin/env bash
# Packs the crates that are published into target/packaging/dist, each compiled by cargo from its .crate file alone, and installs the command line
# from them and runs it. Then `cargo binstall`'s entries in src/cli/Cargo.toml are compared with the archives of build.sh that are there.
#   packaging/crates.sh
# The C interface is not among them: programs take it as an archive (build.sh), with its headers.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
names=()
for crate in "${CRATES[@]}"; do names+=(-p "$crate"); done
cd "$root"
work=$out/crates
# Whether it compiles is asked, not how fast it is: the program that is installed has its own profile.
export CARGO_TARGET_DIR=$work/target CARGO_PROFILE_DEV_OPT_LEVEL=0

# All that cargo may warn of: tests of the command line lie outside its folder, and so outside its crate, and fairmesh's Cargo.toml has the
# workspace's profiles, which speak of crates that it does not use.
EXPECTED='ignoring (test|example|benchmark) .* is not included in the published package|profile package spec .* did not match any packages'
pack() {
    rm -rf "$CARGO_TARGET_DIR/package"
    # For cargo a version never changes; before it is published it does.
    rm -rf "${CARGO_HOME:-$HOME/.cargo}"/registry/{src,cache}/*/fairmesh*-"$version"* "$CARGO_TARGET_DIR"/*/.fingerprint/fairmesh*
    cargo package --locked --allow-dirty "${names[@]}" 2>&1 | tee "$work/log"
    if grep '^warning' "$work/log" | grep -vE "$EXPECTED"; then
        fail "cargo package has warned"
    fi
}

# has CRATE FILE...: in the .crate file.
has() {
    local crate=$1 file list
    shift
    list=$(tar -tzf "$CARGO_TARGET_DIR/package/$crate-$version.crate")
    for file in "$@"; do
        grep -qx "$crate-$version/$file" <<<"$list" || fail "$crate has no $file"
    done
}

# What crates.io shows, and the texts of the licences.
check_contents() {
    local crate field
    for crate in "${CRATES[@]}"; do
        has "$crate" Cargo.toml Cargo.lock README.md LICENSE-MIT LICENSE-APACHE
        tar -xzf "$CARGO_TARGET_DIR/package/$crate-$version.crate" -C "$work/unpacked"
        for field in description documentation repository readme keywords categories license rust-version; do
            grep -q "^$field = " "$work/unpacked/$crate-$version/Cargo.toml" || fail "$crate has no $field"
        done
        if grep -rlF -e "$root" "$work/unpacked/$crate-$version"; then fail "a path of this machine is in $crate"; fi
    done
}

# As users install it, with the crates beside it instead of crates.io's.
install_command_line() {
    {
        printf '[workspace]\nmembers = ["*-%s"]\nresolver = "3"\n[patch.crates-io]\n' "$version"
        for crate in "${CRATES[@]}"; do echo "$crate = { path = '$crate-$version' }"; done
    } >"$work/unpacked/Cargo.toml"
    cargo install --path "$work/unpacked/fairmesh-cli-$version" --root "$work/root" --force
    [ "$("$work/root/bin/fairmesh" --version)" = "fairmesh $version" ] || fail "the installed program has another version"
    "$work/root/bin/fairmesh" fair docs/dented.ply -o "$work/faired.ply" --selection free | grep '^converged' ||
        fail "the installed program has found nothing"
}

rm -rf "$work/unpacked" "$work/root"
mkdir -p "$work/unpacked" "$dist"
pack
check_contents
install_command_line
python3 packaging/binstall.py "$dist" "$version"
for crate in "${CRATES[@]}"; do cp "$CARGO_TARGET_DIR/package/$crate-$version.crate" "$dist"; done
echo "${#CRATES[@]} crates are packed, and the command line runs that is installed from them"

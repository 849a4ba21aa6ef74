# Sourced by build.sh and check.sh: what they have in common. Tools that are no packages of the system go to target/packaging/tools.
# shellcheck shell=bash disable=SC2034
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
PATH=$PATH:$HOME/.cargo/bin
[ ! -d "${CARGO_TARGET_DIR:-}" ] || CARGO_TARGET_DIR=$(cd "$CARGO_TARGET_DIR" && pwd)
out=${CARGO_TARGET_DIR:-$root/target}/packaging
dist=$out/dist
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$root/Cargo.toml" | head -1)
major=${version%%.*}
minor=${version#*.}
minor=${minor%%.*}
TARGETS="linux-x86_64 linux-aarch64 windows-x86_64 macos-x86_64 macos-aarch64 wasm32"
# Of the wheels as well (bindings/python/build_library.py): the oldest glibc, and the tools that link for it.
GLIBC=2.28
PINNED="ziglang==0.17.0 cargo-zigbuild==0.24.0"
# The oldest macOS that the standard library of Rust 1.89 and later supports on both processors.
MACOS=11.0

fail() {
    echo "$*" >&2
    exit 1
}

# What cargo calls a target.
triple() {
    case $1 in
    linux-x86_64) echo x86_64-unknown-linux-gnu ;;
    linux-aarch64) echo aarch64-unknown-linux-gnu ;;
    windows-x86_64) echo x86_64-pc-windows-gnu ;;
    macos-x86_64) echo x86_64-apple-darwin ;;
    macos-aarch64) echo aarch64-apple-darwin ;;
    wasm32) echo wasm32-unknown-unknown ;;
    *) fail "no such target: $1; there are $TARGETS" ;;
    esac
}

# Files whose programs are looked for, and the package that has them on Debian.
need() {
    command -v "$1" >/dev/null || fail "$1 was not found: apt-get install $2"
}

# zig, as a C compiler and linker for every system, and what hands it to cargo.
install_zig() {
    local home=$out/tools
    if [ "$(cat "$home/installed" 2>/dev/null)" != "$PINNED" ]; then
        rm -rf "$home"
        python3 -m venv "$home"
        # shellcheck disable=SC2086
        "$home/bin/pip" --disable-pip-version-check install -q $PINNED
        printf '#!/bin/sh\nexec "%s/bin/python" -m ziglang "$@"\n' "$home" >"$home/bin/zig"
        chmod +x "$home/bin/zig"
        echo "$PINNED" >"$home/installed"
    fi
    PATH=$home/bin:$PATH
}

# Rust's own LLVM: it reads the files of every system.
install_llvm() {
    local host sysroot
    host=$(rustc -vV | sed -n 's/^host: //p')
    sysroot=$(rustc --print sysroot)
    llvm=$sysroot/lib/rustlib/$host/bin
    [ -x "$llvm/llvm-objcopy" ] || rustup component add llvm-tools
    # llvm-readobj is another program by this name.
    # shellcheck disable=SC2329
    llvm_readelf() { "$llvm/llvm-readobj" --elf-output-style=GNU "$@"; }
}

# The functions of the header, one a line.
header_functions() {
    tr '\n' ' ' <"$root/include/fairmesh.h" | grep -oE 'FAIRMESH_API [^;]*;' | grep -oE 'fairmesh_[a-z0-9_]+ *\(' | tr -d ' (' |
        sort -u
}

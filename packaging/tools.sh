# Sourced by build.sh and check.sh: what they have in common. Tools that are no packages of the system go to target/packaging/tools.
# shellcheck shell=bash disable=SC2034
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
PATH=$PATH:$HOME/.cargo/bin
[ ! -d "${CARGO_TARGET_DIR:-}" ] || CARGO_TARGET_DIR=$(cd "$CARGO_TARGET_DIR" && pwd)
out=${CARGO_TARGET_DIR:-$root/target}/packaging
dist=$out/dist
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$root/Cargo.toml" | head -1)
# Where the project is published: what is packed takes all its addresses from here.
repository=$(sed -n 's/^repository = "\(.*\)"/\1/p' "$root/Cargo.toml" | head -1)
major=${version%%.*}
minor=${version#*.}
minor=${minor%%.*}
# What programs that are linked with the library rely on: the end of its SONAME.
interface=$major
[ "$major" != 0 ] || interface=0.$minor
TARGETS="linux-x86_64 linux-aarch64 windows-x86_64 macos-x86_64 macos-aarch64 wasm32"
# Those that are published, each after those that it needs.
CRATES=(fairmesh-linear fairmesh-shapes fairmesh-process fairmesh fairmesh-cli)
# bindings/python/build_library.py reads them here: the oldest glibc, and the tools that link for it.
GLIBC=2.28
PINNED="ziglang==0.17.0 cargo-zigbuild==0.24.0"
# What makes wheels and source distributions.
PYTHON_BUILD="build==1.3.0 hatchling==1.27.0"
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

# How the archives of a target are packed.
archive_kind() {
    case $1 in
    windows-*) echo zip ;;
    *) echo tar.gz ;;
    esac
}

# Where the shared library lies in a target's tree.
library_file() {
    case $1 in
    linux-*) echo "lib/libfairmesh.so.$version" ;;
    windows-*) echo bin/fairmesh.dll ;;
    macos-*) echo "lib/libfairmesh.$version.dylib" ;;
    *) fail "there is no shared library for $1" ;;
    esac
}

# What Blender calls a target. It has no others but windows-arm64.
blender_platform() {
    case $1 in
    linux-x86_64) echo linux-x64 ;;
    windows-x86_64) echo windows-x64 ;;
    macos-x86_64) echo macos-x64 ;;
    macos-aarch64) echo macos-arm64 ;;
    *) fail "Blender has no platform $1" ;;
    esac
}

# What a wheel's name says of the system.
wheel_platform() {
    case $1 in
    linux-*) echo "manylinux_${GLIBC/./_}_${1#linux-}" ;;
    windows-x86_64) echo win_amd64 ;;
    macos-x86_64) echo "macosx_${MACOS/./_}_x86_64" ;;
    macos-aarch64) echo "macosx_${MACOS/./_}_arm64" ;;
    *) fail "there is no wheel for $1" ;;
    esac
}

# environment FOLDER REQUIREMENT...: a virtual environment with these packages, made anew when they change.
environment() {
    local home=$1
    shift
    [ "$(cat "$home/installed" 2>/dev/null)" != "$*" ] || return 0
    rm -rf "$home"
    python3 -m venv "$home"
    "$home/bin/pip" --disable-pip-version-check install -q "$@" >&2
    echo "$*" >"$home/installed"
}

# zig, as a C compiler and linker for every system, and what hands it to cargo.
install_zig() {
    local home=$out/tools
    # shellcheck disable=SC2086
    environment "$home" $PINNED
    if [ ! -x "$home/bin/zig" ]; then
        printf '#!/bin/sh\nexec "%s/bin/python" -m ziglang "$@"\n' "$home" >"$home/bin/zig"
        chmod +x "$home/bin/zig"
    fi
    PATH=$home/bin:$PATH
}

# in_tree FOLDER COMMAND...: in the system that lies in this folder. Needs root.
in_tree() {
    # shellcheck disable=SC2016
    unshare -m sh -c 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" &&
        exec env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$0" "$@"' "$@"
}

# Wine 10: that of Debian 12 has no bcryptprimitives.dll, which Rust's standard library asks for.
install_wine() {
    need debootstrap debootstrap
    # A link into itself.
    [ -L "$out/wine/usr/bin/wine" ] ||
        debootstrap --variant=minbase --include=wine,wine64 trixie "$out/wine" http://deb.debian.org/debian >"$out/wine.log"
    mkdir -p "$out/wine/programs"
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

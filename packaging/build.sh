#!/usr/bin/env bash
# Builds what is published for one target, into target/packaging/dist: the archive of the C library, and that of the command line.
#   packaging/build.sh linux-x86_64|linux-aarch64|windows-x86_64|macos-x86_64|macos-aarch64|wasm32
# Needs cargo by rustup and python3 with venv; for Windows Debian's gcc-mingw-w64-x86-64. Everything else is installed into
# target/packaging. Two builds in one place give the same bytes.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
target=${1-}
triple=$(triple "$target")
cd "$root"
export CARGO_TARGET_DIR=$out/cargo
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 1704067200)}
# No path of this machine gets into what others run: of this folder, of the crates, of the standard library's sources, if they are installed.
remap() { printf -- '--remap-path-prefix=%s=%s' "$1" "$2"; }
RUSTFLAGS="$(remap "$root" /fairmesh) $(remap "${CARGO_HOME:-$HOME/.cargo}/registry/src" /crates) \
    $(remap "$(rustc --print sysroot)/lib/rustlib/src/rust" /rust)"
export RUSTFLAGS
built=$CARGO_TARGET_DIR/$triple/release
stage=$out/stage/$target
name=fairmesh-$version-$target
program=fairmesh-cli-$version-$target

# zig leaves out the list of exported names, so Rust's own linker is taken, and of zig what names the functions of macOS. That linker does not know
# the newest kind of processor there, and the names for it are those for all arm64.
install_apple_linker() {
    install_zig
    mkdir -p "$out/apple"
    sed 's/arm64e\.x1-/arm64-/g' "$(zig env | sed -nE 's/.*lib_dir *[=:] *"([^"]*)".*/\1/p' | head -1)/libc/darwin/libSystem.tbd" \
        >"$out/apple/libSystem.tbd"
    export APPLE_LLD=$llvm/gcc-ld/ld64.lld APPLE_LIBRARIES=$out/apple
    export "CARGO_TARGET_$(tr a-z- A-Z_ <<<"$1")_LINKER=$root/packaging/apple_linker.py"
}

# build TARGET PACKAGE...: with the linker of that system.
build() {
    local target=$1 triple packages=()
    local -x RUSTFLAGS=$RUSTFLAGS MACOSX_DEPLOYMENT_TARGET=$MACOS
    triple=$(triple "$1")
    shift
    for package in "$@"; do packages+=(-p "$package"); done
    local command=(build)
    case $target in
    linux-*)
        install_zig
        command=(zigbuild)
        triple=$triple.$GLIBC
        ;;
    macos-*)
        # Rust's own strip is for ELF: without -x the names of what is inside stay, a fourteenth of the file.
        RUSTFLAGS="$RUSTFLAGS -C link-arg=-Wl,-x"
        [ "$(uname -s)" = Darwin ] || install_apple_linker "$triple"
        ;;
    # All browsers have SIMD since 2023, Node since 16.4: a third less time, and the same bits. LLVM inlines up to 225 by itself: 4 % more
    # bytes, gzipped, and no less time; at 100 half of that.
    wasm32) RUSTFLAGS="$RUSTFLAGS -C target-feature=+simd128 -C link-arg=--strip-all -C llvm-args=-inline-threshold=50" ;;
    windows-*)
        need x86_64-w64-mingw32-gcc gcc-mingw-w64-x86-64
        RUSTFLAGS="$RUSTFLAGS -C link-arg=-Wl,--no-insert-timestamp"
        ;;
    esac
    # Optimized as one: the library for Windows has 3.6 MB, otherwise 4.8, since GNU's linker keeps there what no function of the header calls.
    cargo "${command[@]}" --release --locked --target "$triple" "${packages[@]}" \
        --config 'profile.release.lto="fat"' --config 'profile.release.strip="symbols"'
}

# strip_windows FROM TO: GNU's linker leaves the table of symbols, a seventh of the file.
strip_windows() {
    "$llvm/llvm-objcopy" --strip-all "$1" "$2"
}

# One object of all members, whose only global symbols are those of the header: two Rust libraries in one program do not meet.
# For Windows and macOS the archive stays as rustc has made it: there GNU's linker makes an object whose thread-locals are broken, and Rust's none.
static_library() {
    local whole=$out/whole-$target.o keep=$out/keep-$target
    if [[ $target != linux-* ]]; then
        "$llvm/llvm-objcopy" --strip-debug "$built/libfairmesh.a" "$1/lib/libfairmesh.a"
        return
    fi
    rm -f "$whole"
    header_functions >"$keep"
    "$llvm/rust-lld" -flavor gnu -r -o "$whole" --whole-archive "$built/libfairmesh.a"
    "$llvm/llvm-objcopy" --strip-debug --remove-section=.llvmbc --remove-section=.llvmcmd --keep-global-symbols="$keep" "$whole"
    "$llvm/llvm-ar" rcsD "$1/lib/libfairmesh.a" "$whole"
    rm "$whole"
}

# What a static library asks of the system, as rustc says it.
private_libraries() {
    case $target in
    linux-*) echo -lgcc_s -lutil -lrt -lpthread -lm -ldl ;;
    windows-*) echo -lkernel32 -lntdll -luserenv -lws2_32 -ldbghelp ;;
    macos-*) echo -liconv -lSystem -lc -lm ;;
    esac
}

# fill TEMPLATE FILE: for a tree that lies anywhere.
fill() {
    local libraries
    libraries=$(private_libraries)
    [ "${2##*.}" != cmake ] || libraries=$(echo "$libraries" | sed 's/-l//g; s/ /;/g')
    # shellcheck disable=SC2016
    sed -e 's|@PREFIX@|${pcfiledir}/../..|' -e 's|@LIBDIR@|${prefix}/lib|' -e 's|@INCLUDEDIR@|${prefix}/include|' \
        -e 's|@INCLUDEDIR_FROM_CMAKE@|../../../include|' -e "s|@VERSION@|$version|g" -e "s|@MAJOR@|$major|g" \
        -e "s|@MINOR@|$minor|g" -e "s|@INTERFACE@|$interface|g" -e "s|@PRIVATE_LIBS@|$libraries|" "packaging/$1" >"$2"
}

# licences CRATE FOLDER
licences() {
    mkdir -p "$2"
    cp LICENSE-MIT LICENSE-APACHE "$2"
    python3 packaging/third_party.py "$1" "$triple" >"$2/THIRD-PARTY.txt"
    python3 packaging/sbom.py "$1" "$triple" >"$dist/${1/-capi/}-$version-$target.cdx.json"
}

library() {
    local tree=$stage/$name
    rm -rf "$tree"
    mkdir -p "$tree/lib" "$tree/include"
    cp include/*.h include/*.hpp "$tree/include"
    case $target in
    linux-*)
        install -D -m 644 packaging/fairmesh.supp "$tree/share/fairmesh/valgrind/fairmesh.supp"
        cp "$built/libfairmesh.so" "$tree/lib/libfairmesh.so.$version"
        ln -s "libfairmesh.so.$version" "$tree/lib/libfairmesh.so.$interface"
        ln -s "libfairmesh.so.$interface" "$tree/lib/libfairmesh.so"
        ;;
    macos-*)
        cp "$built/libfairmesh.dylib" "$tree/lib/libfairmesh.$version.dylib"
        ln -s "libfairmesh.$version.dylib" "$tree/lib/libfairmesh.$interface.dylib"
        ln -s "libfairmesh.$interface.dylib" "$tree/lib/libfairmesh.dylib"
        ;;
    windows-*)
        mkdir "$tree/bin"
        strip_windows "$built/fairmesh.dll" "$tree/bin/fairmesh.dll"
        # For GCC, and for Microsoft's linker.
        install_zig
        { echo EXPORTS; header_functions; } >"$out/fairmesh.def"
        zig dlltool -m i386:x86-64 -D fairmesh.dll -d "$out/fairmesh.def" -l "$tree/lib/fairmesh.lib"
        cp "$tree/lib/fairmesh.lib" "$tree/lib/libfairmesh.dll.a"
        ;;
    wasm32) cp "$built/fairmesh.wasm" "$tree/lib" ;;
    esac
    static_library "$tree"
    if [ "$target" != wasm32 ]; then
        mkdir -p "$tree/lib/pkgconfig" "$tree/lib/cmake/fairmesh"
        fill fairmesh.pc.in "$tree/lib/pkgconfig/fairmesh.pc"
        fill fairmesh-config.cmake.in "$tree/lib/cmake/fairmesh/fairmesh-config.cmake"
        fill fairmesh-config-version.cmake.in "$tree/lib/cmake/fairmesh/fairmesh-config-version.cmake"
    fi
    licences fairmesh-capi "$tree/share/doc/fairmesh"
}

command_line() {
    local tree=$stage/$program native=$built/fairmesh
    rm -rf "$tree"
    mkdir -p "$tree/completions"
    case $target in
    windows-*) strip_windows "$built/fairmesh.exe" "$tree/fairmesh.exe" ;;
    *) cp "$built/fairmesh" "$tree" ;;
    esac
    # A program of another system does not run here; its pages and completions are those of this one.
    if ! "$native" --version >/dev/null 2>&1; then
        build linux-x86_64 fairmesh-cli
        native=$CARGO_TARGET_DIR/$(triple linux-x86_64)/release/fairmesh
    fi
    "$native" completions bash >"$tree/completions/fairmesh.bash"
    "$native" completions zsh >"$tree/completions/_fairmesh"
    "$native" completions fish >"$tree/completions/fairmesh.fish"
    "$native" completions powershell >"$tree/completions/fairmesh.ps1"
    "$native" man "$tree/man/man1" >/dev/null
    licences fairmesh-cli "$tree"
}

install_llvm
rustup target list --installed | grep -qx "$triple" || rustup target add "$triple"
mkdir -p "$dist" "$stage"
# What the build before has answered says nothing about this one.
rm -rf "$out/answers/$target"*
kind=$(archive_kind "$target")
if [ "$target" = wasm32 ]; then
    build "$target" fairmesh-capi
else
    build "$target" fairmesh-capi fairmesh-cli
    command_line
    python3 packaging/archive.py "$stage/$program" "$dist/$program.$kind"
fi
library
python3 packaging/archive.py "$stage/$name" "$dist/$name.$kind"

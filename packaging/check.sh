#!/usr/bin/env bash
# Checks what build.sh has made for one target, from its archives alone: what it shows and needs, its size, and that programs that find the
# library by CMake and by pkg-config run. Then prints what the library answers to ten inputs, as SHA-256, and
# fails if another target that was checked before has answered otherwise (docs/releasing.md).
#   packaging/check.sh [TARGET...]      without one: all of them, one after the other
# Runs arm64 in qemu-aarch64-static, Windows in Wine 10 (a Debian 13 under target/packaging, which needs root and debootstrap), wasm32 in
# node and wasmtime. What is for macOS runs on macOS only; elsewhere its files are looked at, and that is said.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
if [ $# -ne 1 ]; then
    read -ra targets <<<"${*:-$TARGETS}"
    rm -rf "$out/answers"
    for target in "${targets[@]}"; do "$0" "$target"; done
    exit
fi
target=$1
triple "$target" >/dev/null
kind=$(archive_kind "$target")
work=$out/check/$target
tree=$work/fairmesh-$version-$target
program=$work/fairmesh-cli-$version-$target
[ "$target" = wasm32 ] || library=$tree/$(library_file "$target")
# What a host is willing to carry; what they are is told below.
LIBRARY_BYTES=$((4 * 1024 * 1024))
PROGRAM_BYTES=$((10 * 1000 * 1000))
WASM_BYTES=$((1000 * 1000))

say() { echo "$target: $*"; }
bad() { fail "$target: $*"; }

# at_most BYTES FILE WHAT
at_most() {
    local size
    size=$(wc -c <"$2")
    [ "$size" -le "$1" ] || bad "$3 has $size bytes, more than $1"
    say "$3: $size bytes"
}

# shows WHAT: the names on stdin are those of the header; $2 are more that may be there.
shows() {
    local names
    names=$(sort -u | grep -vxE "${2:-}" || true)
    [ "$names" = "$(header_functions)" ] ||
        bad "$1 shows other names than the header: $(diff <(header_functions) <(echo "$names") | grep '^[<>]' | head -5)"
    say "$1 shows the $(echo "$names" | wc -l) functions of the header, and nothing else"
}

# needs WHAT PATTERN: every library on stdin is one of the system's.
needs() {
    local names
    names=$(sort -u)
    if echo "$names" | grep -vixE "$2"; then bad "$1 needs libraries that the system may not have"; fi
    say "$1 needs $(echo "$names" | tr '\n' ' ')"
}

# No path of the machine that built it.
no_paths() {
    if grep -aqF -e "$root" -e "$HOME/" "$@"; then bad "a path of this machine is in one of $*"; fi
}

check_linux() {
    local file
    for file in "$library" "$program/fairmesh"; do
        llvm_readelf --dyn-symbols "$file" | grep -oE '@GLIBC_[0-9.]+' | sort -u | sed 's/@GLIBC_//' >"$work/glibc"
        echo "$GLIBC" >>"$work/glibc"
        [ "$(sort -V "$work/glibc" | tail -1)" = "$GLIBC" ] || bad "$file needs glibc $(sort -V "$work/glibc" | tail -1)"
        llvm_readelf -d "$file" | grep NEEDED | sed 's/.*\[\(.*\)\].*/\1/' |
            needs "${file##*/}" '(lib(c\.so\.6|m\.so\.6|dl\.so\.2|pthread\.so\.0|rt\.so\.1|util\.so\.1|gcc_s\.so\.1)|ld-linux-.*)'
        if llvm_readelf -S "$file" | grep -q '\.symtab'; then bad "$file is not stripped"; fi
    done
    llvm_readelf -d "$library" | grep -q "soname: \[libfairmesh.so.$interface\]" || bad "the SONAME is another"
    "$llvm/llvm-nm" -D --defined-only -j "$tree/lib/libfairmesh.so" | shows libfairmesh.so
    "$llvm/llvm-nm" -g --defined-only -j "$tree/lib/libfairmesh.a" | grep -v ':$' | grep . | shows libfairmesh.a
    at_most $LIBRARY_BYTES "$library" libfairmesh.so
}

check_windows() {
    local file
    for file in "$library" "$program/fairmesh.exe"; do
        "$llvm/llvm-readobj" --coff-imports "$file" | sed -n 's/^ *Name: //p' | grep -i '\.dll' |
            needs "${file##*/}" '(kernel32|ntdll|msvcrt|user32|userenv|ws2_32|advapi32|bcrypt|bcryptprimitives|dbghelp|api-ms-win-[a-z0-9-]*)\.dll'
        "$llvm/llvm-readobj" --file-headers "$file" | grep -q 'SymbolCount: 0$' || bad "$file is not stripped"
    done
    "$llvm/llvm-readobj" --coff-exports "$library" | sed -n 's/^ *Name: \(fairmesh_.*\|[a-zA-Z_].*\)/\1/p' | grep -v '\.dll$' |
        shows fairmesh.dll
    at_most $LIBRARY_BYTES "$library" fairmesh.dll
}

check_macos() {
    local file told
    told=$("$llvm/llvm-objdump" --macho --dylib-id "$library" | tail -1)
    [ "$told" = "@rpath/libfairmesh.$interface.dylib" ] || bad "the install name is $told"
    for file in "$library" "$program/fairmesh"; do
        told=$("$llvm/llvm-objdump" --macho --private-headers "$file" | grep -A4 -E 'LC_BUILD_VERSION|LC_VERSION_MIN_MACOSX' |
            sed -nE 's/^ *(minos|version) //p' | head -1)
        [ "$told" = $MACOS ] || bad "${file##*/} is for macOS $told, not $MACOS"
        "$llvm/llvm-objdump" --macho --dylibs-used "$file" | sed -nE 's/^\t([^ ]*).*/\1/p' |
            grep -v '@rpath/libfairmesh' | needs "${file##*/}" '/usr/lib/lib(System\.B)\.dylib'
    done
    "$llvm/llvm-nm" -g --defined-only -j "$library" | sed 's/^_//' | shows "${library##*/}"
    at_most $LIBRARY_BYTES "$library" "${library##*/}"
    say "install name, names and oldest macOS ($MACOS) are right"
}

check_wasm() {
    gzip -9c "$tree/lib/fairmesh.wasm" >"$work/fairmesh.wasm.gz"
    at_most $WASM_BYTES "$work/fairmesh.wasm.gz" "fairmesh.wasm, gzipped,"
    need node nodejs
    node "$root/packaging/check_wasm.mjs" "$tree/lib/fairmesh.wasm" >"$work/exports"
    shows fairmesh.wasm 'memory|__indirect_function_table|__data_end|__heap_base|fairmesh_wasm_(allocate|free)' <"$work/exports"
    say "node has faired a mesh"
}

# run PROGRAM ARGUMENTS...: as its system does.
run() {
    case $target in
    linux-aarch64) qemu-aarch64-static -L /usr/aarch64-linux-gnu "$@" ;;
    windows-*)
        cp "$1" "$library" "$out/wine/programs"
        local file=/programs/${1##*/}
        shift
        in_tree "$out/wine" env WINEDEBUG=-all wine "$file" "$@" 2>"$work/wine.log" | tr -d '\r'
        ;;
    wasm32) "$out/wasmtime/bin/python" "$root/packaging/run_wasi.py" "$@" ;;
    *) "$@" ;;
    esac
}

# The compiler of programs for the target, and how CMake calls its system.
choose_compiler() {
    system=()
    case $target in
    linux-aarch64)
        need aarch64-linux-gnu-gcc "gcc-aarch64-linux-gnu libc6-dev-arm64-cross"
        need qemu-aarch64-static qemu-user-static
        compiler=aarch64-linux-gnu-gcc
        system=(-DCMAKE_SYSTEM_NAME=Linux)
        ;;
    windows-*)
        need x86_64-w64-mingw32-gcc gcc-mingw-w64-x86-64
        install_wine
        compiler=x86_64-w64-mingw32-gcc
        system=(-DCMAKE_SYSTEM_NAME=Windows)
        ;;
    *) compiler=cc ;;
    esac
}

# The example that users copy, by CMake, shared and static; then the same by pkg-config.
clients() {
    local end="" way flags
    [[ $target != windows-* ]] || end=.exe
    need cmake cmake
    need pkg-config pkg-config
    choose_compiler
    for way in OFF ON; do
        cmake -S "$root/examples/c" -B "$work/cmake-$way" -DCMAKE_C_COMPILER="$compiler" "${system[@]}" -DCMAKE_BUILD_TYPE=Release \
            -Dfairmesh_DIR="$tree/lib/cmake/fairmesh" -DFAIRMESH_USE_STATIC=$way >"$work/cmake.log"
        cmake --build "$work/cmake-$way" >>"$work/cmake.log" || bad "$(cat "$work/cmake.log")"
        run "$work/cmake-$way/smooth_dent$end" | tail -1 | grep '^converged' || bad "the client of CMake has failed (static: $way)"
    done
    export PKG_CONFIG_LIBDIR=$tree/lib/pkgconfig
    read -ra flags < <(pkg-config --cflags --libs fairmesh)
    "$compiler" "$root/examples/c/smooth_dent.c" -o "$work/shared$end" "${flags[@]}" -lm "-Wl,-rpath,$tree/lib"
    read -ra flags < <(pkg-config --cflags --libs --static fairmesh | sed 's/-lfairmesh//')
    "$compiler" "$root/examples/c/smooth_dent.c" -o "$work/static$end" "$tree/lib/libfairmesh.a" "${flags[@]}" -lm
    for way in shared static; do
        run "$work/$way$end" | tail -1 | grep '^converged' || bad "the client of pkg-config has failed ($way)"
    done
    "$compiler" -O2 -ffp-contract=off "$root/packaging/answers.c" -o "$work/answers$end" "-I$tree/include" "$tree/lib/libfairmesh.a" \
        "${flags[@]}" -lm
    answers=$work/answers$end
    say "clients of CMake and pkg-config have run, shared and static"
}

wasi_client() {
    install_zig
    [ -x "$out/wasmtime/bin/python" ] || python3 -m venv "$out/wasmtime"
    "$out/wasmtime/bin/pip" --disable-pip-version-check install -q wasmtime==50.0.1
    answers=$work/answers.wasm
    zig cc -target wasm32-wasi -O2 -ffp-contract=off "$root/packaging/answers.c" -o "$answers" "-I$tree/include" "$tree/lib/libfairmesh.a"
    # Its callback is told of the progress, on the only thread.
    zig cc -target wasm32-wasi "$root/examples/c/smooth_dent.c" -o "$work/client.wasm" "-I$tree/include" "$tree/lib/libfairmesh.a"
    run "$work/client.wasm" >"$work/client.log"
    if ! tail -1 "$work/client.log" | grep '^converged' || ! grep -q '%' "$work/client.log"; then bad "the C program for WASI has failed"; fi
    say "a C program for WASI has run"
}

# The command line fairs the file that README.md begins with.
command_line() {
    local file=$program/fairmesh
    [[ $target != windows-* ]] || file=$file.exe
    local mesh=$root/docs/dented.ply result=$work/faired.ply
    if [[ $target == windows-* ]]; then
        cp "$mesh" "$out/wine/programs"
        mesh='Z:\programs\dented.ply'
        result='Z:\programs\faired.ply'
    fi
    run "$file" fair "$mesh" -o "$result" --selection free >"$work/command.log" || bad "the command line has failed"
    grep '^converged' "$work/command.log" || bad "the command line has found nothing"
    [[ $target != windows-* ]] || cp "$out/wine/programs/faired.ply" "$work"
    at_most $PROGRAM_BYTES "$file" "the command line"
    say "the command line has run; SHA-256 of its result $(sha256sum <"$work/faired.ply" | cut -c1-16)"
}

# The Debian package, if deb.sh has made it: the same program, and all that it lists.
debian_package() {
    local architecture=amd64 package
    [ "$target" = linux-x86_64 ] || architecture=arm64
    package=$dist/fairmesh_${version}_$architecture.deb
    [ -e "$package" ] || return 0
    dpkg-deb -R "$package" "$work/deb"
    cmp "$work/deb/usr/bin/fairmesh" "$program/fairmesh" || bad "the Debian package has another program: packaging/deb.sh $target"
    (cd "$work/deb" && md5sum --quiet -c DEBIAN/md5sums) || bad "the Debian package is damaged"
    [ "$(dpkg-deb -f "$package" Version)-$(dpkg-deb -f "$package" Architecture)" = "$version-$architecture" ] || bad "the Debian package is another"
    say "the Debian package has the same program"
}

# answer WHERE COMMAND...: what the library answers, in answers/WHERE. Every other target that was checked before has answered the same.
answer() {
    local folder=$out/answers/$1 k other
    shift
    rm -rf "$folder"
    mkdir -p "$folder"
    for k in 1 2 3 4 5 6 7 8 9 10; do
        "$@" "$answers" "$k" >"$folder/$k" || bad "no answer $k"
        say "$k $(sha256sum <"$folder/$k" | cut -d' ' -f1) $(head -1 "$folder/$k")"
    done
    for other in "$out/answers"/*; do
        [ "$other" = "$folder" ] || python3 "$root/packaging/compare.py" "$other" "$folder" || bad "the answers have to be the same"
    done
}

install_llvm
rm -rf "$work"
mkdir -p "$work"
for archive in "$dist/${tree##*/}.$kind" "$dist/${program##*/}.$kind"; do
    [ "$target" != wasm32 ] || [ "$archive" = "$dist/${tree##*/}.$kind" ] || continue
    [ -e "$archive" ] || fail "$archive is not there: packaging/build.sh $target"
    case $kind in
    zip) python3 -m zipfile -e "$archive" "$work" ;;
    *) tar -xzf "$archive" -C "$work" ;;
    esac
done
case $target in
linux-*) check_linux ;;
windows-*) check_windows ;;
macos-*) check_macos ;;
wasm32) check_wasm ;;
esac
find "$work" -type f \( -name '*fairmesh*.so.*' -o -name '*.dll' -o -name '*.dylib' -o -name '*.wasm' -o -name '*.a' -o -path "$program/fairmesh*" \) \
    -print0 | while IFS= read -r -d '' file; do no_paths "$file"; done
case $target in
macos-*)
    if [ "$(uname -s)" != Darwin ]; then
        say "looked at, not run: that takes macOS"
        exit
    fi
    clients
    command_line
    ;;
wasm32) wasi_client ;;
*)
    clients
    command_line
    [[ $target != linux-* ]] || debian_package
    ;;
esac
answer "$target" run
if [ "$target" = linux-x86_64 ]; then
    # A processor of 2009, without AVX and fused multiply-add.
    need qemu-x86_64-static qemu-user-static
    answer "$target-2009" qemu-x86_64-static -cpu Nehalem
fi
say "passed"
